# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes one run and no turns: instructions, phases, a million particles, the published chain."""

import dataclasses
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib

import making
import specs
import sessions

# Cycles between which instructions are counted: the difference leaves out what is done before.
FEW_CYCLES, MORE_CYCLES = 10, 60

# Of the published study (Table 5.2), Pa: the dense sample and what it is unloaded to.
DENSE_PRESSURE = 100e6
# Of its test 4a as the table has it: b/a = 0.8; the growth of the others goes on to 0.7.
EARLY_ELONGATION = 1.25


def measured(command, output=None):
    """Runs a program to its end. Seconds of processor and of clock, and its largest memory, bytes."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output or subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    errors = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise sessions.Failure(f"{' '.join(command)}: ended with {process.returncode}: {errors.strip()}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start, 1024 * usage.ru_maxrss


# Instructions


def count_of(program, scene, level, cycles):
    """Instructions of a run of so many cycles, and the pairs that they had listed, by cycle."""
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
               program, scene, "--threads", "1"] + (["--level", level] if level else [])
    run = subprocess.run(command, input=f"cycles {cycles}\n", capture_output=True, text=True, check=False)
    counted = re.search(r"I\s+refs:\s+([\d,]+)", run.stderr)
    if run.returncode or not counted:
        raise sessions.Failure(f"{' '.join(command)}: ended with {run.returncode}: {run.stderr[-300:]}")
    return int(counted[1].replace(",", "")), json.loads(run.stdout.splitlines()[-1])["pair_cycles"]


def instructions(given, maker):
    """Valgrind has no AVX-512: the best level there is AVX2."""
    if not shutil.which("valgrind"):
        raise sessions.Failure("there is no valgrind: apt-get install valgrind")
    print(f"{'instructions':28}  {'a cycle':>12}  a listed pair")
    for name in given.scenes:
        for build, program in sessions.binaries(given):
            for level in given.level or [""]:
                few, few_pairs = count_of(program, given.scene_file(name), level, FEW_CYCLES)
                more, more_pairs = count_of(program, given.scene_file(name), level, MORE_CYCLES)
                label = f"{build}{name} {level}".strip()
                print(f"{label:28}  {(more - few) / (MORE_CYCLES - FEW_CYCLES):12.0f}  "
                      f"{(more - few) / (more_pairs - few_pairs):13.1f}", flush=True)
    return 0


# Phases


def phases(given, maker):
    """tangency-dem's own profile of the timed stage and the one before, in which a sample settles."""
    if given.cycles < 1:
        raise sessions.Failure(f"--cycles {given.cycles}: allowed is at least 1")
    for name in given.scenes:
        scene = given.scene_file(name)
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        ended = text.replace(f"duration = {specs.WITHOUT_END}", f"duration = {given.cycles}")
        if ended == text:
            raise sessions.Failure(f"{name}: phases needs a scene of make_scene that is not sheared")
        with tempfile.TemporaryDirectory(dir=given.folder) as folder:
            copy = os.path.join(folder, "phases.toml")
            table = tomllib.loads(text)["stage"][0]["file"]
            shutil.copy(os.path.join(os.path.dirname(scene), table), folder)
            making.write_whole(copy, ended)
            command = [given.tool, "run", copy, "--out", os.path.join(folder, "out"), "--quiet", "--profile",
                       "--threads", str(given.threads[0])]
            run = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if run.returncode:
            raise sessions.Failure(f"{name}: {given.tool} ended with {run.returncode}: {run.stderr.strip()}")
        print(f"{name}\n{run.stdout}", end="", flush=True)
        print(run.stderr, end="", file=sys.stderr, flush=True)
    return 0


# A million particles


def loose_scene(particles):
    """Spheroids placed at random, and one cycle: what a user's large scene starts with."""
    text = specs.sample_text(specs.Spec(particles=particles, elongation=1 / 0.7, state="loose"))
    return text.replace(f"frame_interval = {specs.WITHOUT_END}", "frame_interval = 0")


def dense_scene(particles):
    """Name and Spec of so many spheroids at rest, copies of one sample in an order by chance."""
    one = making.named()["spheroid-1.43-1000"]
    copies = round((max(particles, 0) / one.particles) ** (1 / 3))
    if copies < 1 or one.particles * copies**3 != particles:
        raise sessions.Failure(f"--particles {particles}: allowed are 1000, 8000, ... 1000 n^3")
    if copies == 1:
        return "spheroid-1.43-1000", one
    return f"spheroid-1.43-{particles}-shuffled", dataclasses.replace(one, copies=copies, shuffle=1)


def large(given, maker):
    """Set-up by tangency-dem, memory, cycles, and a checkpoint beside a plain write."""
    count = given.particles
    name, spec = dense_scene(count)
    os.makedirs(given.folder, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=given.folder) as folder:
        scene = os.path.join(folder, "random.toml")
        making.write_whole(scene, loose_scene(count))
        sessions.note("tangency-dem: random places, one cycle")
        cpu, wall, peak = measured([given.tool, "run", scene, "--out", os.path.join(folder, "out"),
                                    "--quiet", "--threads", str(given.threads[0])])
        written = sum(os.path.getsize(os.path.join(at, name)) for at, _, names in os.walk(folder)
                      for name in names)
        print(f"tangency-dem, {count} spheroids at random, one cycle, results of {written / 1e6:.0f} MB: "
              f"{wall:.2f} s, {cpu:.2f} s of processor, at most {peak / 1e9:.3f} GB, "
              f"{peak / count / 1e3:.2f} kB a particle", flush=True)
        dense = maker.scene(name, spec)
        sessions.note(f"setting up {name}")
        session = sessions.Ours(name, given.program, dense, threads=given.threads[0])
        set_up = session.ready["set_up"]
        print(f"{name} from its table: {set_up['wall_seconds']:.2f} s, at most "
              f"{set_up['peak_bytes'] / 1e9:.3f} GB", flush=True)
        block = session.block(2 * sessions.WARM_UP)
        print(f"cycles: {block.wall / block.cycles:.4f} s, "
              f"{1e9 * block.wall / block.pair_cycles:.1f} ns a listed pair, at most "
              f"{block.end['peak_bytes'] / 1e9:.3f} GB")
        some = [session.ask(f"checkpoint {os.path.join(folder, 'checkpoint.state')}")
                for _ in range(given.rounds)]
        session.close()
    middle = lambda values: statistics.median(list(values))
    for clock in ("wall_seconds", "cpu_seconds"):
        saved, plain = middle(one[clock] for one in some), middle(one["plain"][clock] for one in some)
        print(f"checkpoint, {some[0]['bytes'] / 1e6:.1f} MB, {clock.replace('_', ' ')}: {saved:.3f}; as many "
              f"plain bytes: {plain:.3f}; {saved / plain:.2f} x")
    print(f"memory with the checkpoints: at most {some[-1]['peak_bytes'] / 1e9:.3f} GB")
    return 0


# The published chain


class Chain:
    """Runs of tangency-dem, of which each goes on from the state of another one."""

    def __init__(self, tool, threads, folder, head, stages):
        self.command = [tool, "run", "--quiet", "--threads", str(threads)]
        self.folder, self.head, self.stages = folder, head, stages
        self.cpu = self.wall = 0.0
        self.cycles = 0

    def run(self, name, stages, start=None):
        """The state at the end of these stages, which begin with those of `start`; their summary."""
        scene, out = os.path.join(self.folder, name + ".toml"), os.path.join(self.folder, name)
        making.write_whole(scene, self.head + "".join(stages))
        resume = ["--resume", start["state"]] if start else []
        cpu, wall, _ = measured(self.command + [scene, "--out", out] + resume)
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        cycles = summary["cycles"] - (start["cycles"] if start else 0)
        self.cpu, self.wall, self.cycles = self.cpu + cpu, self.wall + wall, self.cycles + cycles
        angle = f", peak friction angle {summary['peak_friction_angle_deg']:.2f} deg" \
            if "peak_friction_angle_deg" in summary else ""
        print(f"{name:12} {cycles:7} cycles, {cpu:7.2f} s of processor, mean stress "
              f"{summary['mean_stress']:.4g} Pa, coordination {summary['coordination_number']:.2f}{angle}",
              flush=True)
        return {"state": os.path.join(out, "final.state"), "cycles": summary["cycles"], "stages": stages}


def shear_text(pressure, strain):
    return specs.stage_text(kind="shear", mean_stress=pressure, axial_strain_rate=0.005,
                            axial_strain=strain, **specs.MOTION)


def chain(given, maker):
    """Growth, five pressures, and a shear test at each and at the table's early elongation."""
    file = given.scenes[0] if given.scenes else os.path.join(given.root, "dem", "scenes", "unload-1000.toml")
    with open(file, encoding="utf-8") as text:
        head, *stages = re.split(r"(?=^\[\[stage\]\])", text.read(), flags=re.MULTILINE)
    stages[-1], output = re.split(r"(?=^\[output\])", stages[-1], flags=re.MULTILINE)
    grown = next(k for k, stage in enumerate(stages) if 'kind = "grow"' in stage)
    with tempfile.TemporaryDirectory() as folder:
        run = Chain(given.tool, given.threads[0], folder, head + output, stages)
        compact = run.run("compact", stages[:grown])
        states = {DENSE_PRESSURE: run.run("growth", stages[: grown + 2], compact)}
        for k in range(grown + 2, len(stages)):
            pressure = float(re.search(r"mean_stress = (\S+)", stages[k])[1])
            states[pressure] = run.run(f"p{pressure / 1e6:.0f}", stages[: k + 1],
                                       list(states.values())[-1])
        early = [re.sub(r"(?m)^elongation = .*", f"elongation = {EARLY_ELONGATION}", stage)
                 for stage in stages[: grown + 2]]
        early = run.run("early", early, compact)
        tests = [(f"shear-{pressure / 1e6:.0f}", pressure, state) for pressure, state in states.items()]
        for name, pressure, state in tests + [("shear-early", DENSE_PRESSURE, early)]:
            run.run(name, state["stages"] + [shear_text(pressure, given.strain)], state)
    print(f"the chain: {run.cycles} cycles, {run.cpu:.1f} s of processor, {run.wall:.1f} s, "
          f"{given.threads[0]} threads; {1e6 * run.cpu / run.cycles:.0f} us a cycle")
    return 0
