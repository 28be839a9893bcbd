# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that are read and started, and functions that are graded."""

import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import tangency
from tangency import dem, grade

SCENE = """schema = 1
[cell]
[particles.candy]
count = 20
mean_radius = 1.0
flatness = 1.9
density = 1.0
[contact]
normal_stiffness = 1e5
[[stage]]
kind = "place"
arrangement = "random"
seed = 7
bounding_fraction = 0.1
[[stage]]
kind = "compress"
mean_stress = 50.0
max_strain_rate = 5.0
max_cycles = 60000
[output]
history_interval = 500
frame_interval = 2000
"""


class Runs(unittest.TestCase):
    def test_a_run_is_started_and_its_files_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "scene.toml"
            scene.write_text(SCENE)
            run = dem.run(scene, Path(folder) / "out")
            self.assertEqual(set(run.history["stage"]), {"place", "compress"})
            self.assertEqual(run.history["cycle"][-1], run.summary["cycle"])
            contacts, particles = dem.contacts(run.final_state), dem.particles(run.final_state)
            self.assertEqual(len(contacts), run.summary["contacts"])
            # Without friction a contact slides whatever it bears; the scene's stage has none of its own.
            np.testing.assert_array_equal(dem.contacts(run.final_state, scene=scene), contacts)
            with self.assertRaisesRegex(dem.ProgramError, "no-scene.toml"):
                dem.contacts(run.final_state, scene=Path(folder) / "no-scene.toml")
            with self.assertRaisesRegex(dem.ProgramError, "the scene has 12"):
                dem.contacts(run.final_state, scene=scene, settings={"particles.candy.count": 12})
            frames = list(run.frames())
            self.assertGreater(len(frames), 1)
            self.assertEqual(frames[-1].columns["pos"].shape, (20, 3))
            self.assertEqual(float(frames[0].properties["Time"]), 0)

            # The simulator's contacts are those that the kernel finds among its particles.
            found = tangency.neighbours(particles, edges=frames[-1].cell)
            np.testing.assert_array_equal(found.pairs[found.gap < 0],
                                          np.stack([contacts["a"], contacts["b"]], 1).astype(int))
            np.testing.assert_allclose(found.gap[found.gap < 0], contacts["gap"], atol=1e-12)

            scene.write_text(SCENE.replace("flatness", "flatnes"))
            with self.assertRaisesRegex(dem.ProgramError, r"scene.toml:6.*flatnes"):
                dem.run(scene, Path(folder) / "other")

    def test_an_earlier_run_is_read_and_only_taken_away_where_that_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            scene, out = Path(folder) / "scene.toml", Path(folder) / "out"
            scene.write_text(SCENE)
            self.assertEqual(dem.run(scene, out).summary["particles"], 20)
            again = dem.Run(str(out))
            self.assertEqual((again.summary["particles"], again.messages), (20, ""))
            with self.assertRaisesRegex(dem.ProgramError, "--replace takes them away"):
                dem.run(scene, out)
            settings = {"particles.candy.count": np.int64(12), "motion.rotation": "none",
                        "motion.gravity": [np.int64(0), np.float64(0.0), 0]}
            dem.run(scene, out, replace=True, settings=settings)
            self.assertEqual(again.summary["particles"], 12)
            self.assertEqual(len(again.summary["set"]), 3)
            with self.assertRaisesRegex(dem.ProgramError, "friction.*no such key"):
                dem.run(scene, out, replace=True, settings={"stage.compress.friction": 0.5})

    def test_a_sweep_is_one_table_of_its_runs_and_one_of_their_histories(self):
        with tempfile.TemporaryDirectory() as folder:
            scene, out = Path(folder) / "scene.toml", Path(folder) / "out"
            scene.write_text(SCENE + '[sweep]\n"stage.compress.mean_stress" = [50.0, 60.0]\n"stage.place.seed" = [1, 2]\n')
            dem.run(scene, out)
            sweep = dem.Sweep(str(out))
            self.assertEqual([list(row) for row in sweep.table[["stage.compress.mean_stress", "stage.place.seed"]].tolist()],
                             [[50, 1], [50, 2], [60, 1], [60, 2]])
            rows = sweep.history
            self.assertEqual(rows.dtype.names[:4],
                             ("folder", "stage.compress.mean_stress", "stage.place.seed", "cycle"))
            self.assertEqual(len(rows), sum(len(run.history) for run in sweep.runs))
            for run, of_table in zip(sweep.runs, sweep.table):
                own = rows[rows["folder"] == run.folder.name]
                np.testing.assert_array_equal(own["mean_stress"], run.history["mean_stress"])
                self.assertEqual(set(own["stage.place.seed"]), {of_table["stage.place.seed"]})
                self.assertEqual(own["mean_stress"][-1], of_table["mean_stress"])
            for run in sweep.runs:
                (run.folder / "history.csv").unlink()
            with self.assertRaisesRegex(ValueError, "no run has a history.csv yet"):
                sweep.history

    def test_a_table_is_refused_by_its_row(self):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "table.csv"
            table.write_text("# remark\na, name\n1,x\n2\n")
            with self.assertRaisesRegex(ValueError, r"table.csv: row 1: 1 cells: must be 2"):
                dem.read_table(table)
            table.write_text('a,name\n1,x\n,"y, z"\n')
            read = dem.read_table(table)
            self.assertEqual(list(read["name"]), ["x", "y, z"])
            self.assertTrue(np.isnan(read["a"][1]))


class Grades(unittest.TestCase):
    def test_a_right_function_passes_and_a_wrong_one_fails(self):
        def right(a, b):
            found = tangency.contacts(a, b)
            return {"relation": tangency.relations(a, b).relation, "gap": found.gap, "gap_error": found.gap_error,
                    "normal": found.normal, "status": found.status}

        def wrong(a, b):
            return {"relation": np.full(len(a), tangency.Relation.separate)}

        for each in grade.grade(right, ["touching", "nested"], max_gap_error=1e-15):
            self.assertTrue(each.passed, each.table)
            self.assertGreater(len(each.values), 10)
        (failed,) = grade.grade(wrong, ["touching"])
        self.assertFalse(failed.passed)
        self.assertRegex(failed.verdict, "FAILED")

    def test_a_program_is_named_by_a_path_from_this_folder_too_and_has_to_be_there(self):
        program = os.environ["TANGENCY_VERIFY"]
        near = os.path.relpath(program)
        self.assertFalse(os.path.isabs(near))
        (found,) = grade.grade(lambda a, b: {"overlaps": tangency.overlaps(a, b)}, ["touching"], program=near)
        self.assertTrue(found.passed, found.table)
        with self.assertRaisesRegex(grade.ProgramError, "^program = './nowhere': must be a program that may be run"):
            grade.grade(lambda a, b: {}, ["touching"], program="./nowhere")
        with self.assertRaisesRegex(dem.ProgramError, "^program = 'nowhere'"):
            dem.run("scene.toml", "out", program="nowhere")
        with tempfile.TemporaryDirectory() as folder:
            broken = Path(folder) / "broken"
            broken.write_text("\x7fELF and no more")
            broken.chmod(0o700)
            with self.assertRaisesRegex(dem.ProgramError, "broken cannot be started"):
                dem.particles("a.state", program=broken)

    def test_columns_of_another_shape_and_unknown_corpora_are_refused(self):
        for answer, message in (
                (lambda n: {"gap": [1.0]}, r"^gap: shape \(1,\): must be \(\d+,\)$"),
                (lambda n: {"gap": 1.0}, r"^gap: shape \(\): must be \(\d+,\)$"),
                (lambda n: {"normal": np.zeros(n)}, r"^normal: shape \(\d+,\): must be \(\d+, 3\)$"),
                (lambda n: {"gapp": np.zeros(n)}, "^gapp: is not graded: must be of relation overlaps gap "),
                (lambda n: {"relation": np.full(n, 9)}, "^relation: row 0: 9: must be from 0 to 6$"),
                (lambda n: np.zeros(n), "^the function answered ndarray: must be a mapping of columns by name")):
            with self.assertRaisesRegex(ValueError, message):
                grade.grade(lambda a, b: answer(len(a)), ["touching"])
        with self.assertRaisesRegex(grade.ProgramError, "nope"):
            grade.grade(lambda a, b: {}, ["nope"])
        with self.assertRaisesRegex(ValueError, "quadrics"):
            grade.grade(lambda a, b: {}, ["quadrics"])


if __name__ == "__main__":
    unittest.main()
