#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pair costs in LAMMPS, and what a second rank gives.

Usage: measure.py cost  TANGENCY_DEM FOLDER PROGRAM [PROGRAM ...] [--steps N] [--rounds N]
       measure.py ranks TANGENCY_DEM FOLDER PROGRAM [--copies N] [--steps N] [--rounds N] [--ranks N]

PROGRAM is tangency-lammps, or a LAMMPS that finds tangencyplugin.so (LAMMPS_PLUGIN_PATH names its
folder); of several the first is the one that others are checked against.

cost: nanoseconds of pair styles a listed pair and step, on one rank, in rounds by turns: the least of
them, and the median. 1,000 spheroids of dem/scenes/assembly-1000.toml, axes 0.7, strained at -0.01/s, by
pair_style tangency with its parts, gayberne, and granular/superellipsoid where the program has it; their
centres as equal spheres by pair_style tangency and gran/hooke/history. First each answers for what it
computes: energies beside tangency-dem's contacts, beside gran/hooke/history without friction, or beside
the other program; the mean stress of granular/superellipsoid, which has another depth, to 1 %.

ranks: 64,000 of the same (--copies 4: copies along each axis, stirred, compressed until they have moved
apart), on one rank and on --ranks (2), by turns: seconds, efficiency. Energies of both have to agree.

Times are LAMMPS' own, of a clock on the wall: they hold where nothing else runs. The column `cpu` is
the share of a core that the run had: below 98 % the row says `busy`. Exit status: 0, 1 where an answer is
wrong or a program fails, 2 for a wrong command.
"""
import argparse
import csv
import os
import re
import statistics
import subprocess
import sys

STIFFNESS = 1.5e10
FRICTION = 0.5
DENSITY = 1000.0
DIAMETER = 20.0
BUSY = 98.0  # %. Chosen: what a quiet machine gives a process that waits for nothing
HEAD = """units si
atom_style {style}
boundary p p p
newton on
atom_modify map array
comm_modify vel yes
neighbor 2.0 bin
read_data {data}
"""
STRAIN = """fix strain all deform 1 x trate -0.01 y trate -0.01 z trate -0.01 remap x
fix move all nve/asphere
fix calm all langevin 0.0 0.0 0.5 1 angmom 1.0
timestep 0.002
"""
# The cell's damping and stiffness are those of the scene; the others' laws are given the same numbers.
TANGENCY = "pair_style tangency {words}\npair_coeff * * hooke 1.5e10 tangential linear 1.5e10 {friction}\n"
HOOKE = "pair_style gran/hooke/history 1.5e10 1.5e10 0 0 {friction} {tangential}\npair_coeff * *\n"
SUPER = ("pair_style granular/superellipsoid\npair_coeff * * hooke 1.5e10 0.0 tangential linear_history 1.5e10 0.0 "
         "{friction} damping mass_velocity\n")
# Too weak to move a body: all styles see the same places.
GAYBERNE = "pair_style gayberne 1.0 1.0 1.0 28.0\npair_coeff * * 1.0 8.0 1.0 1.0 1.0 1.0 1.0 1.0 26.0\n"
PARTS = ("bodies", "gather", "kernel", "law and forces")


def fail(message):
    print(f"measure.py: {message}", file=sys.stderr)
    sys.exit(1)


def call(words, folder):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0:
        fail(f"{' '.join(words)}: {done.stdout[-400:]}{done.stderr[-300:]}")
    return done.stdout


class Run:
    """What LAMMPS printed of its last run."""

    def __init__(self, text):
        self.rows, names = [], None
        for line in text.splitlines():
            words = line.split()
            if words[:1] == ["Step"]:
                names, self.rows = words, []
            elif line.startswith("Loop time"):
                names = None
            elif names and len(words) == len(names) and re.fullmatch(r"\d+", words[0]):
                self.rows.append(dict(zip(names, map(float, words))))

        def last(pattern):
            found = re.findall(pattern, text)
            if not found:
                fail(f"no {pattern!r} in what the program printed: is it LAMMPS? {text[-200:]}")
            return float(found[-1])

        self.steps = last(r"Loop time of \S+ on \d+ procs for (\d+) steps")
        self.seconds = last(r"Loop time of (\S+) on")
        self.pair = last(r"\nPair *\|[^|]*\| *(\S+)")
        self.cpu = last(r"\n *([\d.]+)% CPU use")
        self.listed = last(r"Total # of neighbors = (\d+)")

    def each(self, seconds):
        """In ns a listed pair and step."""
        return seconds / self.steps / self.listed * 1e9


class Sample:
    """1,000 spheroids that touch, as data files of three atom styles."""

    def __init__(self, simulator, folder):
        self.folder = folder
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        scene = os.path.join(root, "dem", "scenes", "assembly-1000.toml")
        call([simulator, "run", os.path.abspath(scene), "--out", "sample", "--quiet", "--replace"], folder)
        call([simulator, "export", "sample/final.state", "--format", "lammps-data", "--out", "sample.data"], folder)
        contacts = list(csv.DictReader(call([simulator, "contacts", "sample/final.state"], folder).splitlines()))
        self.contacts = len(contacts)
        self.energy = sum(0.5 * STIFFNESS * float(row["gap"])**2 for row in contacts)
        with open(os.path.join(folder, "sample.data"), encoding="ascii") as file:
            self.text = file.read()
        head, bodies = self.text.split("\nEllipsoids\n")
        rows = [row + " 2.0 2.0" if row.strip() else row for row in bodies.splitlines()]
        self.write("super.data", head + "\nEllipsoids\n" + "\n".join(rows) + "\n")
        self.spheres(list(csv.DictReader(call([simulator, "particles", "sample/final.state"], folder).splitlines())))

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="ascii") as file:
            file.write(text)

    def spheres(self, particles):
        """The centres as equal spheres that touch, at rest."""
        box = [line for line in self.text.splitlines() if line.endswith(("xlo xhi", "ylo yhi", "zlo zhi"))]
        head = ["Equal spheres", "", f"{len(particles)} atoms", "1 atom types", *box]
        places = [f"{row['x']} {row['y']} {row['z']}" for row in particles]
        self.write("sphere.data", "\n".join(head + ["", "Atoms", ""] + [
            f"{k + 1} 1 {DIAMETER} {DENSITY} {place}" for k, place in enumerate(places)]) + "\n")
        self.write("round.data", "\n".join(head[:3] + [f"{len(particles)} ellipsoids"] + head[3:] + ["", "Atoms", ""] + [
            f"{k + 1} 1 1 {DENSITY} {place}" for k, place in enumerate(places)] + ["", "Ellipsoids", ""] + [
                f"{k + 1} {DIAMETER} {DIAMETER} {DIAMETER} 1.0 0.0 0.0 0.0" for k in range(len(places))]) + "\n")

    def run(self, program, script, ranks=1):
        self.write("in.measure", script)
        start = ["mpirun", "--bind-to", "none", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        return Run(call(start + [program, "-in", "in.measure", "-log", "none"], self.folder))


class Style:
    """A pair style on its sample."""

    def __init__(self, name, style, data, pair, move):
        self.name, self.style, self.data, self.pair, self.move = name, style, data, pair, move

    def script(self, steps, friction=FRICTION, words="timing yes"):
        tangential = 1 if friction > 0.0 else 0
        pair = self.pair.format(friction=friction, words=words, tangential=tangential)
        works = self.pair == TANGENCY
        text = HEAD.format(style=self.style, data=self.data) + pair + self.move
        if works:
            text += "compute works all pair tangency\n"
        parts = " c_works[5] c_works[6] c_works[7] c_works[8]" if works else ""
        return (text + f"thermo_style custom step pe ke pxx pyy pzz{parts}\nthermo {max(steps, 1)}\n"
                "thermo_modify format float %.17g norm no\n" + f"run {steps}\n")


ROUND = "fix move all {}\ntimestep 0.002\n"
STYLES = (
    Style("tangency", "ellipsoid", "sample.data", TANGENCY, STRAIN),
    Style("gayberne", "ellipsoid", "sample.data", GAYBERNE, STRAIN),
    Style("granular/superellipsoid", "ellipsoid superellipsoid", "super.data", SUPER,
          STRAIN.replace("fix calm all langevin 0.0 0.0 0.5 1 angmom 1.0\n", "")),
    Style("tangency, spheres", "ellipsoid", "round.data", TANGENCY, ROUND.format("nve/asphere")),
    Style("gran/hooke/history", "sphere", "sphere.data", HOOKE, ROUND.format("nve/sphere")),
)


def near(what, value, there, bound):
    off = abs(value / there - 1.0)
    print(f"{what}: {off:.1g} off (bound {bound:.0e})", flush=True)
    if not off <= bound:
        fail(f"{what}: {value:.17g}, not {there:.17g}")


def mean_stress(run):
    return sum(run.rows[0][name] for name in ("Pxx", "Pyy", "Pzz")) / 3.0


def has_superellipsoids(program, folder):
    words = call([program, "-help"], folder)
    return "granular/superellipsoid" in words


def check_answers(sample, programs, styles_of):
    """Each style answers for what it computes."""
    by_name = {style.name: style for style in STYLES}
    first = {}
    for label, program in programs.items():
        here = {name: sample.run(program, by_name[name].script(0)) for name in styles_of[label]}
        near(f"{label}, tangency: energy beside tangency-dem", here["tangency"].rows[0]["PotEng"], sample.energy, 1e-9)
        near(f"{label}, gayberne: energy beside the first program", here["gayberne"].rows[0]["PotEng"],
             first.setdefault("gayberne", here["gayberne"].rows[0]["PotEng"]), 1e-9)
        if "granular/superellipsoid" in here:
            near(f"{label}, granular/superellipsoid: mean stress beside tangency",
                 mean_stress(here["granular/superellipsoid"]), mean_stress(here["tangency"]), 1e-2)
        two = [sample.run(program, by_name[name].script(200, friction=0.0)).rows[-1]["KinEng"]
               for name in ("tangency, spheres", "gran/hooke/history")]
        near(f"{label}, spheres without friction, 200 steps: kinetic energy", two[0], two[1], 1e-9)


def cost(words):
    sample = Sample(words.simulator, words.folder)
    programs = {f"{k + 1}": program for k, program in enumerate(words.program)}
    for label, program in programs.items():
        version = re.search(r"\d+ \w+ \d{4}[^-\n]*", call([program, "-help"], words.folder))
        print(f"program {label}: {os.path.basename(program)}, LAMMPS {version[0].strip() if version else '?'}")
    styles_of = {label: [style.name for style in STYLES if style.name != "granular/superellipsoid"
                         or has_superellipsoids(program, words.folder)] for label, program in programs.items()}
    check_answers(sample, programs, styles_of)
    runs = {}
    for turn in range(words.rounds):
        order = [(label, style) for label in programs for style in STYLES if style.name in styles_of[label]]
        for label, style in order if turn % 2 == 0 else reversed(order):
            run = sample.run(programs[label], style.script(words.steps))
            runs.setdefault((label, style.name), []).append(run)
    print(f"\n{words.steps} steps, {words.rounds} rounds; ns a listed pair and step, least and median of the rounds")
    print(f"{'program':8}{'pair style':26}{'listed':>8}{'least':>9}{'median':>9}{'cpu':>7}  {'parts of the least'}")
    for (label, name), all_of_it in sorted(runs.items(), key=lambda item: (item[0][0], [s.name for s in STYLES].index(item[0][1]))):
        least = min(all_of_it, key=lambda run: run.pair)
        median = statistics.median(run.each(run.pair) for run in all_of_it)
        parts = ""
        if name.startswith("tangency"):
            first, last = least.rows[0], least.rows[-1]
            spent = [last[f"c_works[{k}]"] - first[f"c_works[{k}]"] for k in range(5, 9)]
            parts = ", ".join(f"{part} {least.each(seconds):.1f}" for part, seconds in zip(PARTS, spent))
        busy = "  busy" if least.cpu < BUSY else ""
        print(f"{label:8}{name:26}{least.listed:8.0f}{least.each(least.pair):9.1f}{median:9.1f}{least.cpu:6.0f}%  {parts}{busy}")


def ranks(words):
    sample = Sample(words.simulator, words.folder)
    program = words.program[0]
    text = HEAD.format(style="ellipsoid", data="sample.data")
    text += f"replicate {words.copies} {words.copies} {words.copies}\n"
    text += TANGENCY.format(words="", friction=FRICTION) + STRAIN
    text += "velocity all create 1e26 4711 dist gaussian\n"
    text += "thermo_style custom step pe ke pxx\nthermo_modify format float %.17g norm no\n"
    text += f"thermo {words.steps}\nrun {words.steps}\nrun {words.steps}\n"
    runs = {1: [], words.ranks: []}
    for turn in range(words.rounds):
        for count in (1, words.ranks) if turn % 2 == 0 else (words.ranks, 1):
            runs[count].append(sample.run(program, text, count))
    last = {count: all_of_it[0].rows[-1] for count, all_of_it in runs.items()}
    near(f"{words.ranks} ranks beside one: energy after {2 * words.steps} steps", last[words.ranks]["PotEng"],
         last[1]["PotEng"], 1e-9)
    print(f"\n{1000 * words.copies**3} particles, {words.steps} steps after as many, {words.rounds} rounds")
    print(f"{'ranks':>6}{'seconds':>10}{'us a particle and step':>25}{'cpu':>7}")
    least = {}
    for count, all_of_it in runs.items():
        least[count] = min(all_of_it, key=lambda run: run.seconds)
        each = least[count].seconds * count / words.steps / (1000 * words.copies**3) * 1e6
        busy = "  busy" if least[count].cpu < BUSY else ""
        print(f"{count:6}{least[count].seconds:10.3f}{each:25.3f}{least[count].cpu:6.0f}%{busy}")
    print(f"efficiency of {words.ranks} ranks: {least[1].seconds / least[words.ranks].seconds / words.ranks:.3f}")


def program_at(word):
    if not os.path.isfile(word) or not os.access(word, os.X_OK):
        raise argparse.ArgumentTypeError(f"{word}: the path of a program is allowed")
    return os.path.abspath(word)


def positive(word):
    value = int(word)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{word}: an integer >= 1 is allowed")
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("cost", "ranks"))
    parser.add_argument("simulator", type=program_at)
    parser.add_argument("folder")
    parser.add_argument("program", nargs="+", type=program_at)
    parser.add_argument("--steps", type=positive, default=None)
    parser.add_argument("--rounds", type=positive, default=5)
    parser.add_argument("--copies", type=positive, default=4)
    parser.add_argument("--ranks", type=positive, default=2)
    words = parser.parse_args()
    try:
        os.makedirs(words.folder, exist_ok=True)
    except OSError as error:
        parser.error(f"folder: {words.folder}: {error.strerror}")
    if words.what == "ranks" and (len(words.program) > 1 or words.ranks < 2):
        parser.error("ranks: one PROGRAM, and --ranks of 2 or more, are allowed")
    if words.steps is None:
        words.steps = 400 if words.what == "cost" else 60
    {"cost": cost, "ranks": ranks}[words.what](words)


if __name__ == "__main__":
    main()
