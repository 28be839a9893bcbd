#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds fix tangency/move and fix tangency/servo, and the scripts of `tangency-dem export --lammps`.

Usage: fixes_check.py TANGENCY_DEM TANGENCY_LAMMPS FOLDER [CHECK...]    (CHECK: of those below)

What is compared with tangency-dem is the same scene, run by both.
- free:    spinning bodies that touch nothing, in a strained cell: the law of motion, damping, the
           affine motion, and the box, on one rank and on two
- deform:  the same, strained by fix deform with `remap none`
- flips:   a box in simple shear is described anew; bodies move as with a box that is not
- refused: commands that are wrong end LAMMPS with a line that says why
Exit status: 0, or 1 with the first difference. Packages: .ci/setup lammps
"""
import csv
import os
import random
import re
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import near, require  # noqa: E402

SEED = 24
HEAD = """schema = 1
[cell]
size = [100.0, 100.0, 100.0]
[particles.grain]
count = 12
mean_radius = 3.0
elongation = 1.5
flatness = 1.2
[contact]
normal_stiffness = 1e8
[[stage]]
kind = "place"
arrangement = "explicit"
"""
STAGE = """[[stage]]
kind = "servo"
duration = {cycles}
damping = {damping}
strain_rate = {rate}
simple_shear_rate = {shear}
[output]
frame_interval = 0
"""
NO_CONTACTS = "pair_style zero 4.5\npair_coeff * *\n"


def columns(text, names):
    rows = list(csv.DictReader(text.splitlines()))
    return np.array([[float(row[name]) for name in names.split()] for row in rows])


def lattice_of_bodies(draw):
    """12 bodies on places of a lattice that is wider than they are, with all that moves drawn."""
    text = ""
    for k in range(12):
        place = [20.0 + 30.0 * (k % 3), 20.0 + 30.0 * (k // 3 % 2), 20.0 + 30.0 * (k // 6)]
        numbers = {"position": [x + draw.uniform(-2, 2) for x in place],
                   "orientation": [draw.gauss(0, 1) for _ in range(4)],
                   "velocity": [draw.uniform(-1, 1) for _ in range(3)],
                   "angular_velocity": [draw.uniform(-6, 6) for _ in range(3)]}
        text += '[[body]]\ntype = "grain"\n'
        text += "".join(f"{key} = {value}\n" for key, value in numbers.items())
    return text


class Check:
    def __init__(self, dem, lammps, folder):
        self.dem, self.lammps, self.folder = map(os.path.abspath, (dem, lammps, folder))
        os.makedirs(folder, exist_ok=True)
        self.bodies = lattice_of_bodies(random.Random(SEED))
        print(f"seed {SEED}")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), encoding="ascii") as file:
            return file.read()

    def tool(self, *words):
        done = subprocess.run([self.dem, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        require(done.returncode == 0, f"{' '.join(words)}: {done.stderr}")
        return done.stdout

    def engine(self, script, ranks=1, status=0, variables=()):
        """Runs a script; returns what LAMMPS printed."""
        mpirun = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)]
        done = subprocess.run([*(mpirun if ranks > 1 else []), self.lammps, "-in", script, "-log", "none",
                               *variables],
                              cwd=self.folder, capture_output=True, text=True, check=False)
        require((done.returncode == 0) == (status == 0),
                f"{script} on {ranks} ranks: {(done.stdout + done.stderr)[-800:]}")
        return done.stdout + done.stderr

    def both(self, name, cycles, damping=0.02, rate=(0.02, 0.0, -0.01), shear=(0.0, 0.0, 0.0)):
        """The scene by tangency-dem, and the script of it in a folder of the name."""
        stage = STAGE.format(cycles=cycles, damping=damping, rate=list(rate), shear=list(shear))
        self.write(name + ".toml", HEAD + self.bodies + stage)
        self.tool("run", name + ".toml", "--out", name + ".run", "--quiet", "--replace")
        self.tool("export", "--lammps", name, "--scene", name + ".toml")
        script = []
        for line in self.read(f"{name}/in.{name}").splitlines():
            if line.startswith("pair_coeff") or line.startswith("compute balance"):
                continue
            line = line.replace(" c_balance[4] c_balance[5]", "")
            script.append(NO_CONTACTS if line.startswith("pair_style") else line)
        return "\n".join(script) + "\n"

    def compare(self, name, script, ranks, what, bound=1e-12):
        self.write(f"{name}/in.free", script.replace(f"write_data {name}.end", f"write_data {name}.{ranks}"))
        lines = self.in_folder(name, "in.free", ranks)
        there = self.tool("particles", f"{name}.run/final.state")
        here = self.tool("import", f"{name}/{name}.{ranks}.data")
        for names in ("x y z", "qw qx qy qz", "vx vy vz", "wx wy wz"):
            a, b = columns(here, names), columns(there, names)
            if names == "qw qx qy qz":  # q and -q are one
                a *= np.sign((a * b).sum(axis=1))[:, None]
            if names == "x y z":
                a, b = self.in_cell(name, ranks, a), self.in_cell(name, ranks, b)
            near(f"{what} on {ranks} ranks, {names}", a, b, bound)
        return lines

    def in_cell(self, name, ranks, places):
        """In parts of the edges, less whole ones."""
        edges = self.edges(f"{name}/{name}.{ranks}.data")
        parts = np.linalg.solve(edges, places.T).T
        return (parts + 1e-9) % 1.0

    def edges(self, data):
        edges = np.zeros((3, 3))
        for line in self.read(data).splitlines()[:20]:
            words = line.split()
            for k, axis in enumerate("xyz"):
                if words[2:] == [axis + "lo", axis + "hi"]:
                    edges[k, k] = float(words[1]) - float(words[0])
            if words[3:] == ["xy", "xz", "yz"]:
                edges[0, 1], edges[0, 2], edges[1, 2] = (float(word) for word in words[:3])
        return edges

    def unwrapped(self, data):
        """Places of a data file with the edges that bodies have crossed, in the order of ids."""
        atoms = re.search("Atoms # ellipsoid\n\n(.*?)\n\n", self.read(data), re.DOTALL).group(1)
        rows = sorted((line.split() for line in atoms.splitlines()), key=lambda row: int(row[0]))
        places = np.array([row[4:7] for row in rows], float)
        crossed = np.array([row[7:10] if len(row) > 7 else [0, 0, 0] for row in rows], float)
        return places + crossed @ self.edges(data).T

    def in_folder(self, name, script, ranks=1, status=0):
        return Check.engine_in(self, name, script, ranks, status)

    def engine_in(self, name, script, ranks, status):
        inner = Check.__new__(Check)
        inner.lammps, inner.folder = self.lammps, self.path(name)
        return inner.engine(script, ranks, status)

    # The checks.

    def free(self):
        script = self.both("free", 2000)
        for ranks in (1, 2):
            self.compare("free", script, ranks, "free bodies")

    def at_rest(self, name, load, steps, tilted):
        """Bodies without velocities, carried by a box alone: their places before and after, in
        parts of the edges, and the edges before and after."""
        self.bodies = re.sub("velocity = .*", "velocity = [0.0, 0.0, 0.0]", self.bodies)
        script = self.both(name, 1)
        script = re.sub("(?m)^fix load.*", ("change_box all triclinic\n" if tilted else "") + load, script)
        script = re.sub("(?m)^run 1\n", f"run {steps}\n", script)
        self.write(f"{name}/in.rest", script)
        self.in_folder(name, "in.rest", 2)
        places = [columns(self.tool("import", f"{name}/{data}"), "x y z")
                  for data in (f"{name}.data", f"{name}.end.data")]
        edges = [self.edges(f"{name}/{data}") for data in (f"{name}.data", f"{name}.end.data")]
        return places, edges

    def deform(self):
        """Carried by fix deform with remap none: at the same place in parts of the edges."""
        for name, load, tilted in (
                ("deform", "fix load all deform 1 x trate 0.5 z trate -0.2 remap none", False),
                ("tilt", "fix load all deform 1 xy erate 8.0 remap none", True)):
            places, edges = self.at_rest(name, load, 400, tilted)
            require(np.abs(edges[1] - edges[0]).max() > 1.0, f"{name}: the box stays as it is")
            step = float(re.search("(?m)^timestep (.*)", self.read(f"{name}/in.{name}")).group(1))
            now = edges[1]
            if tilted:  # other edges describe the lattice since
                now = np.array([[1.0, 8.0 * 400 * step, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]) @ edges[0]
                require(now[0, 1] > 2.0 * now[0, 0] and abs(edges[1][0, 1]) < 0.6 * now[0, 0],
                        "tilt: the box was not flipped")
            apart = np.linalg.solve(now, places[1].T).T - np.linalg.solve(edges[0], places[0].T).T
            near(f"{name}: carried by the box", apart - np.round(apart) + 1.0, np.ones_like(apart), 1e-11)

    def flips(self):
        """Through many flips of a sheared box: x = (1 + rate dt)^steps x0."""
        steps = 600
        _, edges = self.at_rest(
            "flips", "fix load all tangency/servo rate xy 9.0 rate xz -5.0 rate yz 7.0 rate xx 0.1", steps,
            True)
        step = float(re.search("(?m)^timestep (.*)", self.read("flips/in.flips")).group(1))
        gradient = np.array([[0.1, 9.0, -5.0], [0.0, 0.0, 7.0], [0.0, 0.0, 0.0]])
        total = np.linalg.matrix_power(np.eye(3) + gradient * step, steps)
        require(total[0, 1] > 2.0 and total[1, 2] > 2.0, "flips: the box shears too little to flip")
        require(abs(edges[1][0, 1]) <= 0.5001 * edges[1][0, 0], "flips: the box stays skewed")
        whole = np.linalg.solve(edges[1], total @ edges[0])
        near("flips: the lattice", whole, np.round(whole), 1e-9)
        # Whole edges count: the data file says which images bodies are in.
        start, end = (self.unwrapped(f"flips/flips{data}") for data in (".data", ".end.data"))
        apart = np.linalg.solve(edges[1], (end - start @ total.T).T).T
        near("flips: bodies follow", apart + 1.0, np.ones_like(apart), 1e-9)

    def refused(self):
        script = self.both("refused", 1)
        good = next(line for line in script.splitlines() if line.startswith("fix motion"))
        servo = next(line for line in script.splitlines() if line.startswith("fix load"))
        wrong = {
            "fix motion all tangency/move damping -1": "damping = -1: a number >= 0",
            "fix motion all tangency/move damping inf": "damping = inf: a finite number",
            "fix motion all tangency/move damping": "damping: missing",
            "fix motion all tangency/move speed 2": "keyword = speed:",
            "fix motion all tangency/move damping fire rotational 2": "damping fire:",
            "fix motion all tangency/move damping 1e9": "at most 2",
        }
        for line, message in wrong.items():
            self.refuse("refused", script.replace(good, line), message)
        for line, message in {
            "fix load all tangency/servo": "nothing to do",
            "fix load all tangency/servo rate xy 0.1": "change_box all triclinic",
            "fix load all tangency/servo mean 1e6": "max: missing",
            "fix load all tangency/servo mean 1e6 max 0.1": "give a modulus",
            "fix load all tangency/servo mean 1e6 x 1e6 y 1e6 z 1e6 max 0.1": "combination",
            "fix load all tangency/servo lode 2 max 0.1": "lode = 2",
            "fix load all tangency/servo rate xx 0.1 rate xx 0.2": "rate = xx: each component once",
            "fix load all deform 1 x trate 0.1 remap x": "remap none",
        }.items():
            self.refuse("refused", script.replace(servo, line), message)
        self.refuse("refused", script.replace(servo, "").replace(good, good + "\n" + servo),
                    "stands before fix tangency/servo")
        # Of numbers that are none the wall knows without our pair style, too.
        wall = ("variable big atom 1e300*1e300\nset atom 1 angmom v_big 0.0 0.0\n"
                "fix wall all wall/tangency plane 0 0 -1000 0 0 1 law hooke 1e8\n")
        self.refuse("refused", script.replace("boundary p p p", "boundary p p f").replace(servo, wall),
                    "fix wall/tangency: atom 1 has a place, a turn or a motion")

    def refuse(self, name, script, message):
        self.write(f"{name}/in.wrong", script)
        printed = self.in_folder(name, "in.wrong", status=1)
        require(message in printed, f"no message \"{message}\" in {printed[-600:]}")
        print(f"refused: {message}")


CHECKS = ("free", "deform", "flips", "refused")

if __name__ == "__main__":
    require(len(sys.argv) > 3, __doc__)
    check = Check(*sys.argv[1:4])
    for chosen in sys.argv[4:] or CHECKS:
        getattr(check, chosen)()
