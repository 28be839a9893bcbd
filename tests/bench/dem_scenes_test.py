#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of the simulator's benchmarks are what they are called, and what times them compares
answers. No times are looked at.

Usage: dem_scenes_test.py BENCH_DEM_SCENES TANGENCY_DEM BENCH_DEM_SCENE
"""

import itertools
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import types
import unittest

sys.dont_write_bytecode = True
SCRIPTS, TOOL, PROGRAM = (os.path.abspath(argument) for argument in sys.argv[1:4])
sys.path.insert(0, SCRIPTS)

import bodies  # noqa: E402
import costs  # noqa: E402
import lammps  # noqa: E402
import making  # noqa: E402
import sessions  # noqa: E402
import specs  # noqa: E402

SPHEROIDS = specs.Spec(particles=27, elongation=1 / 0.7)
LATTICE = specs.Spec(particles=4, state="lattice", copies=3)


def measure(*arguments, path=None):
    command = [sys.executable, os.path.join(SCRIPTS, "measure"), *arguments, "--tool", TOOL,
               "--program", PROGRAM, "--folder", FOLDER.name]
    environment = dict(os.environ, PATH=path) if path else None
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


def executable(name, text):
    """A program of the shell in FOLDER; its file."""
    file = os.path.join(FOLDER.name, name)
    os.makedirs(os.path.dirname(file), exist_ok=True)
    making.write_whole(file, f"#!/bin/sh\n{text}\n")
    os.chmod(file, 0o755)
    return file


class Scenes(unittest.TestCase):
    def ready(self, name, spec):
        session = sessions.Ours(name, PROGRAM, MAKER.scene(name, spec))
        session.close()
        return session.ready

    def test_copies_side_by_side_bear_what_the_sample_bears(self):
        one = self.ready("one", SPHEROIDS)["placed"]
        self.assertLess(abs(one["mean_stress"] / SPHEROIDS.pressure - 1.0), 0.01)
        for name, keys in {"eight": {}, "eight-shuffled": {"shuffle": 3}}.items():
            spec = making.dataclasses.replace(SPHEROIDS, copies=2, **keys)
            eight = self.ready(name, spec)["placed"]
            self.assertEqual(eight["particles"], 8 * one["particles"])
            self.assertEqual(eight["touching"], 8 * one["touching"])
            # Of the sum of some thousand forces in another order, at shifted places.
            self.assertLess(abs(eight["mean_stress"] / one["mean_stress"] - 1.0), 1e-11)
        tables = [bodies.read_table(os.path.join(FOLDER.name, name + ".csv"))
                  for name in ("eight", "eight-shuffled")]
        self.assertNotEqual(*tables)
        self.assertEqual(*map(sorted, tables))

    def test_a_lattice_has_twelve_neighbours_and_the_stress_of_its_overlaps(self):
        seen = self.ready("lattice", LATTICE)["placed"]
        self.assertEqual(seen["touching"], 6 * seen["particles"])
        places = bodies.read_table(os.path.join(FOLDER.name, "lattice.csv"))
        edge = 3 * specs.lattice_edge()
        virial = 0.0  # force times distance, over all pairs of nearest images
        for a, b in itertools.combinations(places, 2):
            d = math.dist([x - edge * round(x / edge) for x in (p - q for p, q in zip(a, b))], (0, 0, 0))
            virial += specs.STIFFNESS * max(0.0, 2 * specs.RADIUS - d) * d
        self.assertLess(abs(3 * edge**3 * seen["mean_stress"] / virial - 1.0), 1e-12)

    def test_every_scene_with_a_name_is_one(self):
        for name, spec in making.named().items():
            self.assertEqual(spec.fault(), "", name)
            scene = tomllib.loads(specs.scene_text(spec, [1.0] * 3, spec.copies**3, "x.csv"))
            count = sum(kind["count"] for kind in scene["particles"].values())
            self.assertEqual(count, (spec.particles + spec.large) * spec.copies**3, name)
            self.assertEqual(scene["stage"][-1]["name"], "timed")
            self.assertTrue(spec.has_room(), name)
            if spec.state not in ("loose", "lattice"):
                tomllib.loads(specs.sample_text(spec.sample()))

    def test_a_cell_has_room_where_no_particle_can_touch_two_images_of_another(self):
        # docs/simulator.md: possible where the cell is thinner than 2 (a_1 + a_2).
        def thinnest(particles, elongation):
            return specs.Spec(particles=particles, elongation=elongation).has_room()
        for elongation in (1.0, 3.0, 10.0):
            a = specs.RADIUS * elongation ** (2 / 3)
            least = (4 * a) ** 3 * (1 - specs.ROOM_POROSITY) / (4 / 3 * math.pi * specs.RADIUS**3)
            self.assertFalse(thinnest(math.floor(least), elongation))
            self.assertTrue(thinnest(math.ceil(least), elongation))
        # One large one has no other: a_1 + a_2 is of it and a small one.
        self.assertTrue(specs.Spec(particles=1000, large=1, size_ratio=5.0).has_room())
        self.assertFalse(specs.Spec(particles=1000, large=2, size_ratio=5.0).has_room())
        half = specs.Spec(particles=1000, elongation=5.0)
        self.assertTrue(half.has_room())
        self.assertFalse(making.dataclasses.replace(half, state="sheared").has_room())

    def test_long_bodies_have_shorter_steps_in_sample_and_scene(self):
        for elongation, factor in {3.0: 0.3, 5.0: 0.15, 10.0: 0.15}.items():
            spec = specs.Spec(elongation=elongation, state="sheared")
            for text in (specs.sample_text(spec.sample()), specs.scene_text(spec, [1.0] * 3, 1, "x.csv")):
                factors = {s["time_step_factor"] for s in tomllib.loads(text)["stage"] if "time_step_factor" in s}
                self.assertEqual(factors, {factor})

    def test_a_scene_is_made_anew_where_another_one_has_its_name(self):
        def made(spec):
            file = MAKER.scene("again", spec)
            with open(file, encoding="utf-8") as text:
                return os.stat(file).st_mtime_ns, tomllib.loads(text.read())
        first = made(LATTICE)
        self.assertEqual(made(LATTICE), first)
        rough = made(making.dataclasses.replace(LATTICE, friction=0.25))
        self.assertEqual(rough[1]["contact"]["friction_coefficient"], 0.25)
        # The text of the scene is the same, and its bodies are not.
        table = os.path.join(FOLDER.name, "again.csv")
        other = making.dataclasses.replace(LATTICE, friction=0.25, seed=2)
        before = bodies.read_table(table)
        made(other)
        after = bodies.read_table(table)
        self.assertTrue(after != before)
        os.remove(table)
        made(other)
        self.assertTrue(bodies.read_table(table) == after)

    def test_a_reader_that_has_enough_is_no_error(self):
        reader, writer = os.pipe()
        os.close(reader)
        run = subprocess.run([sys.executable, os.path.join(SCRIPTS, "make_scene"), "--list"], stdout=writer,
                             stderr=subprocess.PIPE, text=True, check=False)
        os.close(writer)
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_growth_changes_no_semi_axis_by_more_than_is_allowed(self):
        def axes(part, spec):
            e, f = 1 + part * (spec.elongation - 1), 1 + part * (spec.flatness - 1)
            c = (e * f * f) ** (-1 / 3)
            return c * f * e, c * f, c
        for spec in making.named().values():
            count = specs.increments_of(spec)
            for k in range(count):
                now, then = axes(k / count, spec), axes((k + 1) / count, spec)
                self.assertLess(max(abs(b / a - 1.0) for a, b in zip(now, then)), 0.01)

    def test_all_bodies_of_a_drifting_scene_have_one_velocity_past_any_skin(self):
        spec = specs.Spec(particles=60, large=1, size_ratio=3.0, state="loose", drift=True)
        session = sessions.Ours("drifting", PROGRAM, MAKER.scene("drifting", spec))
        with open(os.path.join(FOLDER.name, "drifting.csv"), encoding="utf-8") as table:
            velocities = {tuple(map(float, line.split(",")[8:])) for line in list(table)[1:]}
        self.assertEqual(len(velocities), 1)
        shift = math.hypot(*velocities.pop()) * session.ready["time_step"]
        self.assertGreater(shift, 2.0 * session.ready["largest_radius"])
        session.block(3)
        session.close()

    def test_what_is_no_scene_is_refused_with_a_reason(self):
        with self.assertRaisesRegex(ValueError, "stands alone"):
            MAKER.scene("walls", specs.Spec(walls="z", copies=2))
        run = measure("time", "no-such-scene")
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("no-such-scene: no scene has this name", run.stderr)


class Measuring(unittest.TestCase):
    def test_two_builds_answer_alike_by_turns(self):
        scene = MAKER.scene("one", SPHEROIDS)
        run = measure("time", scene, "--old", PROGRAM, "--new", PROGRAM, "--rounds", "2", "--seconds", "0.01")
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        self.assertRegex(run.stdout, r"(?m)^old one +27 .*\nnew one +27 ")

    def test_answers_that_differ_are_said(self):
        def row(stress, touching):
            session = sessions.Ours.__new__(sessions.Ours)
            session.label, session.scene, session.ready = f"{stress}", "scene", {"shears": False}
            session.build, session.ask = object(), None
            return types.SimpleNamespace(session=session, end={
                "particles": 27, "touching": touching, "mean_stress": stress})
        self.assertEqual(sessions.differences([row(1e8, 160), row(1e8 * (1 + 1e-9), 160)]), [])
        self.assertEqual(len(sessions.differences([row(1e8, 160), row(1e8 * (1 + 1e-5), 160)])), 1)
        self.assertEqual(len(sessions.differences([row(1e8, 160), row(1e8, 150)])), 1)
        self.assertEqual(len(sessions.differences([row(math.nan, 160)])), 1)

    def test_other_bits_on_other_threads_are_said(self):
        end = {"particles": 27, "touching": 160, "mean_stress": 1e8}
        def rows(*hashes):
            some = []
            for one in hashes:
                session = sessions.Ours.__new__(sessions.Ours)
                session.label, session.scene, session.build = one, "scene", "build"
                session.ready = {"shears": False}
                session.ask = lambda command, one=one: {"state_hash": one}
                some.append(types.SimpleNamespace(session=session, end=end))
            return some
        self.assertEqual(sessions.differences(rows("1", "1")), [])
        self.assertEqual(len(sessions.differences(rows("1", "2"))), 1)

    def test_threads_of_a_scene_have_the_same_bits(self):
        # So many that threads share all loops: dem/parallel.hpp, kParallelThreshold.
        spec = making.dataclasses.replace(SPHEROIDS, copies=3)
        scene = MAKER.scene("many", spec)
        run = measure("time", scene, "--threads", "1", "2", "--rounds", "1", "--seconds", "0.01")
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        self.assertRegex(run.stdout, r"(?m)^many 1 threads +729 .*\nmany 2 threads +729 ")

    def test_lists_compares_the_answers_of_two_builds(self):
        loose = specs.Spec(particles=60, state="loose")
        scene = MAKER.scene("few", loose)
        MAKER.scene("few-drifting", making.dataclasses.replace(loose, drift=True))
        other = executable("other", f"\"{PROGRAM}\" \"$@\" | sed -u 's/\"touching\":0/\"touching\":3/'")
        for new, status in ((PROGRAM, 0), (other, 1)):
            run = measure("lists", scene, "--old", PROGRAM, "--new", new, "--rounds", "1", "--seconds", "0.01")
            self.assertEqual(run.returncode, status, run.stderr + run.stdout)
            self.assertRegex(run.stdout, r"(?m)^new few: 60 particles, \d+ pairs, one list ")
            self.assertEqual("NOT SO: new few: touching is 3, and of old few 0" in run.stdout, status == 1)

    @unittest.skipUnless(shutil.which("valgrind"), "there is no valgrind")
    def test_instructions_of_one_old_build_alone(self):
        run = measure("instructions", MAKER.scene("lattice", LATTICE), "--old", PROGRAM)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"(?m)^old \S*lattice\S* +[1-9]\d+ +\d+\.\d$")

    def test_large_scenes_are_those_that_have_a_name_and_all_between(self):
        for count in (1000, 8000, 10**6):
            name, spec = costs.dense_scene(count)
            self.assertEqual(making.named()[name], spec)
        self.assertEqual(costs.dense_scene(27000)[1].copies, 3)
        for count in (0, -1000, 999, 27001):
            run = measure("large", "--particles", str(count))
            self.assertEqual((run.returncode, run.stdout), (2, ""))
            self.assertIn(f"--particles {count}: allowed are 1000, 8000", run.stderr)

    def test_phases_are_those_of_the_cycles_that_were_asked_for(self):
        run = measure("phases", MAKER.scene("one", SPHEROIDS), "--cycles", "30")
        self.assertEqual(run.returncode, 0, run.stderr)
        cycles = 30 + specs.SETTLING["linear"]
        self.assertRegex(run.stdout, rf"(?m)^gaps +\d.*\n(?:.*\n)*cycles +{cycles}\.0$")

    def test_all_tables_need_programs_and_say_which_levels_are_missing(self):
        command = [os.path.join(SCRIPTS, "measure_all"), os.path.join(FOLDER.name, "tables"), "contact"]
        def measure_all(build):
            return subprocess.run(command, env=dict(os.environ, TANGENCY_BUILD=build), capture_output=True,
                                  text=True, check=False)
        run = measure_all("/nowhere")
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("/nowhere/bench/bench_dem_scene is not there: build bench_dem_scene", run.stderr)
        said = "--level ?: this machine and build have ssse3"
        executable("build/bench/bench_dem_scene", f"echo '{said}'; exit 1")
        executable("build/dem/tool/tangency-dem", "exit 1")
        run = measure_all(os.path.join(FOLDER.name, "build"))
        self.assertEqual(run.returncode, 1)
        self.assertIn(f"no row by level: neither avx512, avx2 nor sse4 is in what bench_dem_scene said: {said}",
                      run.stderr)
        self.assertIn("measure time spheroid-1.43-1000 --lammps lattice-4000\n", run.stdout)
        self.assertIn("not so: contact", run.stderr)

    def test_a_program_that_ends_is_a_failure_with_its_reason(self):
        with self.assertRaisesRegex(sessions.Failure, "missing.toml"):
            sessions.Ours("none", PROGRAM, os.path.join(FOLDER.name, "missing.toml"))
        with self.assertRaisesRegex(sessions.Failure, "this machine and build have"):
            sessions.Ours("none", PROGRAM, MAKER.scene("one", SPHEROIDS), "mmx")

    def test_without_lammps_it_says_how_to_get_it(self):
        scene = MAKER.scene("lattice", LATTICE)
        run = measure("time", scene, "--lammps", scene, path="/nowhere")
        self.assertEqual(run.returncode, 2)
        self.assertIn(lammps.MISSING, run.stderr)

    @unittest.skipUnless(lammps.is_there(), lammps.MISSING)
    def test_lammps_bears_the_same_stress_by_the_same_contacts(self):
        scene = MAKER.scene("lattice", LATTICE)
        run = measure("time", scene, "--lammps", scene, "--rounds", "1", "--seconds", "0.01")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"(?m)^lammps lattice +108 +6.000")
        # Fewer than touch: no skin leaves those out.
        run = measure("time", scene, "--lammps", scene, "--listed", "1")
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertRegex(run.stderr, r"no skin lists 1\.0000 pairs a particle; one of \S+ m lists 6\.0000")

    def test_the_chain_counts_the_cycles_of_all_its_runs(self):
        with open(os.path.join(SCRIPTS, "..", "..", "dem", "scenes", "unload-1000.toml"), encoding="utf-8") as file:
            text = file.read().replace("count = 1000", "count = 27")
        scene = os.path.join(FOLDER.name, "unload-27.toml")
        making.write_whole(scene, text)
        run = measure("chain", scene, "--strain", "0.005")
        self.assertEqual(run.returncode, 0, run.stderr)
        *rows, total = run.stdout.splitlines()
        self.assertEqual(len(rows), 13)
        self.assertEqual(sum("peak friction angle" in row for row in rows), 6)
        self.assertEqual(int(re.search(r"the chain: (\d+) cycles", total)[1]),
                         sum(int(row.split()[1]) for row in rows))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        FOLDER = types.SimpleNamespace(name=folder)
        MAKER = making.Maker(folder, TOOL)
        unittest.main(argv=sys.argv[:1], verbosity=2)
