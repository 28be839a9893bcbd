#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs pair_style tangency in LAMMPS, and compares it with the simulator, with itself on other numbers
of ranks, and with LAMMPS' own granular spheres.

Usage: lammps_check.py TANGENCY_DEM TANGENCY_LAMMPS SCENE FOLDER [CHECK ...]

SCENE is run by the simulator first; its final state is the sample. A CHECK is the name of a function
below without check_; without one all are run, in order. Each prints what it measured, and ends the
program with 1 where a bound is passed. Programs of MPI run with as many ranks as they are told, on any
number of cores. Packages: .ci/setup lammps
"""
import csv
import json
import os
import re
import resource
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import require  # noqa: E402

STIFFNESS = 1.5e10  # of the scene's contacts, normal and shear
DENSITY = 1000.0

# What every script begins with; {name} are filled in.
HEAD = """units si
atom_style ellipsoid
boundary p p p
newton {newton}
atom_modify map array
comm_modify vel yes
neighbor {skin} bin
read_data sample.data
"""
PAIR = """pair_style tangency {style}
pair_coeff * * {law}
"""
RANKS = ((1, "on"), (2, "on"), (4, "on"), (1, "off"), (4, "off"))
LINEAR = "hooke 1.5e10 tangential linear 1.5e10 0.5"
HERTZ = """
[contact]
law = "hertz"
young_modulus = 1e10
poisson_ratio = 0.25
friction_coefficient = 0.5
"""
CONTACT = """
[contact]
normal_stiffness = 1.5e10
friction_coefficient = 0.5
"""
# Laws as a scene and as pair_coeff have them.
LAWS = {
    "linear": (CONTACT, LINEAR),
    "restitution": (CONTACT + "restitution = 0.5\n", LINEAR + " restitution 0.5"),
    "hertz": (HERTZ, "hertz/material 1e10 0.25 tangential mindlin 0.5"),
}
OUTPUT = """thermo_style custom step pe ke pxx pyy pzz pxy pxz pyz
thermo_modify format float %.17g norm no
thermo {every}
compute w all pair tangency
dump d all custom {every} {name}.dump id xu yu zu fx fy fz tqx tqy tqz
dump_modify d format float %.17g sort id
"""
# A line a listed pair.
LOCAL_COLUMNS = 27
LOCAL = """compute who all property/local patom1 patom2
compute local all pair/local {columns}
dump local all local 300 columns.local c_who[1] c_who[2] {all}
dump_modify local format float %.17g
"""
SPHERES = """units si
atom_style {style}
boundary p p p
comm_modify vel yes
neighbor 2.0 bin
read_data {data}
{pair}
fix move all {move}
timestep 0.002
"""
# What a script says, and words of the line that refuses it, or several of which one is there. The first
# replaces the words in a script.
REFUSED = (
    ("comm_modify vel yes", "", "velocities of ghosts"),
    ("pair_style tangency ", "pair_style tangency accuracy best", "certified or standard is allowed"),
    ("pair_style tangency ", "pair_style tangency branch", "follow or global is allowed"),
    ("pair_style tangency ", "pair_style tangency skin 1", "branch, accuracy or timing is allowed"),
    ("pair_style tangency ", "pair_style tangency timing", "timing = : yes or no is allowed"),
    ("hooke 1.5e10", "hooke -1", "kn = -1: a number > 0"),
    ("hooke 1.5e10", "hooke 1.5e1O", "kn = 1.5e1O: a finite number"),
    ("tangential linear 1.5e10 0.5", "tangential mindlin 0.5", "tangential = mindlin: linear, with hooke"),
    ("hooke 1.5e10 tangential linear 1.5e10", "hertz/material 1e9 0.7 tangential mindlin",
     "nu = 0.7: a number from 0 to 0.5"),
    ("tangential linear 1.5e10 0.5", "restitution 0", "restitution = 0: a number from 0.05 to 1"),
    ("tangential linear 1.5e10 0.5", "tangential linear 1.5e10", "mu: missing at the end of the command"),
    ("tangential linear 1.5e10 0.5", "adhesion 1", "keyword = adhesion: tangential, cohesion or restitution"),
    ("pair_coeff * * hooke 1.5e10 tangential linear 1.5e10 0.5", "pair_coeff * * ",
     "hooke or hertz/material: missing at the end of the command"),
    ("neighbor 2.0 bin", "neighbor 90.0 bin", "lest a pair meet twice"),
    # Before LAMMPS copies atoms for as many images of the box as the skin spans, which no memory holds.
    ("neighbor 2.0 bin", "neighbor 1e9 bin", "skin, 1e+09, is needed, lest a pair meet twice"),
    # A box that is thick enough at first, and shrinks.
    ("run 10", "neighbor 70.0 bin\nneigh_modify every 1 delay 0 check no\n"
     "fix squeeze all deform 1 x scale 0.9 remap x\nrun 10", "skin, 70, is needed, lest a pair meet twice"),
    ("read_data sample.data\npair_style tangency \npair_coeff * *",
     "read_data sample.data extra/atom/types 1\npair_style tangency\npair_coeff 2 2 hooke 1e9\npair_coeff 1 1",
     "pair_coeff 1 2 is missing: laws are not mixed"),
    ("read_data sample.data\npair_style tangency \npair_coeff * *",
     "read_data sample.data extra/atom/types 1\npair_style tangency\npair_coeff * 2 hertz/material 1e9 0.2\n"
     "pair_coeff 1 1", "need the law hooke, or all hertz/material"),
    ("run 10", "run_style respa 2 2\nrun 10", "run_style respa"),
    ("run 10", "create_atoms 1 single 5.0 5.0 5.0\nunfix move\nrun 10", "atom 1001 is no ellipsoid"),
    # LAMMPS of 2026 sees it before the pair style does.
    ("timestep 0.002", "timestep 1e305", ("that is no finite number", "Non-numeric atom coords")),
    ("run 10", "variable inf atom 1e300*1e300\nset atom 7 angmom v_inf 0.0 0.0\nrun 10", "atom 7 has a place, a turn or a motion"),
    ("run 10", "variable inf atom 1e300*1e300\nset atom 7 mass v_inf\nrun 10", "atom 7 has a mass that is not > 0 and finite"),
)
MEMORY = 4 << 30  # bytes of a program that is to refuse: eight times what one of them takes
STRAIN = """fix strain all deform 1 x trate -0.01 y trate -0.01 z trate -0.01 remap x
fix move all nve/asphere
fix damp all langevin 0.0 0.0 0.5 1 angmom 1.0
timestep 0.002
"""


def within(what, value, bound):
    print(f"{what}: {value:.2g} (bound {bound:.0e})", flush=True)
    require(value <= bound, f"{what}: {value:.3g}, more than {bound:.0e}")


def off(here, there):
    """The largest difference in parts of the root mean square of `there`."""
    here, there = np.asarray(here), np.asarray(there)
    require(here.shape == there.shape and here.size > 0, f"{here.shape} numbers, not {there.shape}")
    return np.abs(here - there).max() / np.sqrt((there**2).mean())


def mean_off(here, there):
    """The root mean square of the difference in parts of that of `there`."""
    return np.sqrt(((here - there)**2).mean() / (there**2).mean())


def table(text):
    rows = list(csv.DictReader(text.splitlines()))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def columns(of, names):
    return np.array([of[name] for name in names.split()]).T


class Run:
    """What a run of LAMMPS left: the rows of its log by step, and of its dump the last frame."""

    def __init__(self, folder, name):
        self.rows = {}
        with open(os.path.join(folder, f"{name}.log"), encoding="ascii") as file:
            names = None
            for line in file:
                words = line.split()
                if words[:2] == ["Step", "PotEng"]:
                    names = words
                elif line.startswith("Loop time"):
                    names = None
                elif names and len(words) == len(names) and words[0].isdigit():
                    self.rows[int(words[0])] = dict(zip(names, map(float, words)))
                elif words[:4] == ["Neighbor", "list", "builds", "="]:
                    self.builds = int(words[4])
        self.last = self.rows[max(self.rows)]
        with open(os.path.join(folder, f"{name}.dump"), encoding="ascii") as file:
            lines = file.read().splitlines()
        head = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        names = lines[head].split()[2:]
        values = np.array([[float(word) for word in line.split()] for line in lines[head + 1:]])
        self.atoms = dict(zip(names, values.T))

    def stress(self):
        """By contacts and velocities; where a script has asked for it, by contacts alone."""
        names = ("Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz")
        if "c_push[1]" in self.last:
            names = [f"c_push[{k}]" for k in range(1, 7)]
        return np.array([self.last[name] for name in names])

    def forces(self):
        return columns(self.atoms, "fx fy fz")

    def moments(self):
        return columns(self.atoms, "tqx tqy tqz")


class Check:
    def __init__(self, simulator, program, scene, folder):
        self.simulator, self.program, self.folder = simulator, program, folder
        os.makedirs(folder, exist_ok=True)
        self.tell("run", os.path.abspath(scene), "--out", "sample", "--quiet", "--replace")
        self.tell("export", "sample/final.state", "--format", "lammps-data", "--out", "sample.data")
        # Both engines begin with these bodies, whose contacts have no memory.
        state = self.simulate("start", "")
        self.contacts = table(self.tell("contacts", state))
        self.bodies = table(self.tell("particles", state))

    def tell(self, *words):
        done = subprocess.run([self.simulator, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        require(done.returncode == 0, f"{' '.join(words)}: {done.stderr}")
        return done.stdout

    def simulate(self, name, stages, contact=CONTACT):
        """Places the sample's bodies and goes through stages; the path of the final state."""
        self.tell("import", "sample.data", "--out", f"{name}.csv", "--scene", f"{name}.toml")
        with open(os.path.join(self.folder, f"{name}.toml"), "a", encoding="ascii") as file:
            file.write(contact + stages)
        self.tell("run", f"{name}.toml", "--out", name, "--quiet", "--replace")
        return os.path.join(name, "final.state")

    def start(self, name, script, ranks, **variables):
        with open(os.path.join(self.folder, f"in.{name}"), "w", encoding="ascii") as file:
            file.write(script)
        for old in (f"{name}.dump", f"{name}.log"):
            if os.path.exists(os.path.join(self.folder, old)):
                os.remove(os.path.join(self.folder, old))
        start = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           OMP_NUM_THREADS="1", **variables)
        return subprocess.run(start + [self.program, "-in", f"in.{name}", "-log", f"{name}.log"],
                              cwd=self.folder, capture_output=True, text=True, check=False,
                              env=environment)

    def lammps(self, name, text, ranks=1, head=HEAD, **values):
        """Runs a script: head, pair style, output and `text`."""
        values = {"newton": "on", "style": "", "law": LINEAR, "every": 100, "skin": 2.0, **values}
        script = (head + PAIR + OUTPUT).format(name=name, **values) + text
        done = self.start(name, script, ranks)
        require(done.returncode == 0, f"{name}: {done.stdout[-600:]}{done.stderr[-300:]}")
        return Run(self.folder, name)

    # Checks, in the order in which they are run.

    # dem/lammps/pair_tangency.hpp (4)
    def check_configuration(self):
        """Forces of one configuration whose shear memory is empty are those of the simulator."""
        c = self.contacts
        count = len(self.bodies["id"])
        push = c["fn"][:, None] * columns(c, "nx ny nz")
        a, b = c["a"].astype(int), c["b"].astype(int)
        branch, arm = columns(c, "bx by bz"), columns(c, "ax ay az")
        force, moment = np.zeros((count, 3)), np.zeros((count, 3))
        np.add.at(force, a, -push)
        np.add.at(force, b, push)
        np.add.at(moment, a, -np.cross(arm, push))
        np.add.at(moment, b, np.cross(arm - branch, push))
        energy = 0.5 * STIFFNESS * (c["gap"]**2).sum()
        volume = self.volume()
        stress = np.einsum("ki,kj->ij", push, branch) / volume
        kinetic = self.kinetic_stress(volume)
        for ranks, newton in RANKS:
            # The simulator asks with this accuracy.
            run = self.lammps("one", "run 0\n", ranks, newton=newton, style="accuracy standard")
            what = f"one configuration, {ranks} ranks, newton {newton}"
            within(f"{what}: forces", mean_off(run.forces(), force), 1e-12)
            within(f"{what}: moments", mean_off(run.moments(), moment), 1e-12)
            # Which is what a normal of this accuracy may differ by for another rounding of a place.
            within(f"{what}: the force that is farthest off", off(run.forces(), force), 1e-11)
            within(f"{what}: energy", abs(run.last["PotEng"] / energy - 1.0), 1e-12)
            pair = run.stress() - kinetic
            symmetric = 0.5 * (stress + stress.T)
            there = symmetric[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
            within(f"{what}: stress", np.abs(pair - there).max() / np.trace(stress) * 3.0, 1e-12)

    def edges(self):
        """Columns: the edges of the box that was written for LAMMPS."""
        edges = np.zeros((3, 3))
        with open(os.path.join(self.folder, "sample.data"), encoding="ascii") as file:
            for line in file:
                words = line.split()
                for k, axis in enumerate("xyz"):
                    if words[2:] == [f"{axis}lo", f"{axis}hi"]:
                        edges[k, k] = float(words[1]) - float(words[0])
                if words[3:] == ["xy", "xz", "yz"]:
                    edges[0, 1], edges[0, 2], edges[1, 2] = map(float, words[:3])
        return edges

    def volume(self):
        return np.linalg.det(self.edges())

    def kinetic_stress(self, volume):
        mass = DENSITY * 4.0 / 3.0 * np.pi * columns(self.bodies, "r1 r2 r3").prod(axis=1)
        v = columns(self.bodies, "vx vy vz")
        all_of_it = np.einsum("k,ki,kj->ij", mass, v, v) / volume
        return all_of_it[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]

    # dem/lammps/pair_tangency.hpp (2)
    def check_trajectories(self):
        """2000 strained steps by each law end where those of the simulator end."""
        for law in LAWS:
            self.trajectory(law, RANKS if law == "linear" else RANKS[:2])

    def strain(self, contact, cycles):
        """Strains the sample by the simulator: its final state, and the script of the same."""
        stage = f'[[stage]]\nkind = "servo"\nduration = {cycles}\nstrain_rate = [0.01, 0.01, 0.01]\n'
        state = self.simulate("strained", stage, contact)
        # Time step, strain and law of motion as the simulator's own export has them.
        self.tell("export", "--lammps", "script", "--scene", "strained.toml")
        with open(os.path.join(self.folder, "script", "in.strained"), encoding="ascii") as file:
            script = file.read()
        return state, script[script.rindex("timestep "):script.index(f"run {cycles}")]

    def trajectory(self, law, all_ranks):
        contact, coefficients = LAWS[law]
        state, text = self.strain(contact, 2000)
        with open(os.path.join(self.folder, "strained", "summary.json"), encoding="ascii") as file:
            summary = json.load(file)
        c, count = table(self.tell("contacts", state)), len(self.bodies["id"])
        force = np.zeros((count, 3))
        on_b = columns(c, "fx fy fz")
        np.add.at(force, c["a"].astype(int), -on_b)
        np.add.at(force, c["b"].astype(int), on_b)
        stress = np.array([summary[name] for name in ("s_xx", "s_yy", "s_zz", "s_xy", "s_zx", "s_yz")])
        text = ("compute push all pressure NULL virial\n" +
                "thermo_style custom step pe ke c_push[1] c_push[2] c_push[3] c_push[4] c_push[5] c_push[6]\n" +
                "thermo_modify format float %.17g norm no\n" + text + "run 2000\n")
        for ranks, newton in all_ranks:
            run = self.lammps("strained", text, ranks, newton=newton, law=coefficients,
                              style="accuracy standard")
            what = f"{law}: 2000 steps at -0.01/s beside tangency-dem, {ranks} ranks, newton {newton}"
            within(f"{what}: energy", abs(run.last["PotEng"] / summary["elastic_energy"] - 1.0), 1e-11)
            within(f"{what}: stress", off(run.stress(), stress), 1e-9)
            within(f"{what}: forces", off(run.forces(), force), 1e-7)

    # docs/lammps.md: compute pair/local
    def check_columns(self):
        """Of a strained sample the columns of compute pair/local are those of the simulator's table."""
        for law in ("linear", "hertz"):
            contact, coefficients = LAWS[law]
            state, text = self.strain(contact, 300)
            there = table(self.tell("contacts", state))
            for ranks, newton in ((1, "on"), (4, "on"), (4, "off")):
                dump = LOCAL.format(columns=" ".join(f"p{k}" for k in range(1, LOCAL_COLUMNS + 1)),
                                    all=" ".join(f"c_local[{k}]" for k in range(1, LOCAL_COLUMNS + 1)))
                self.lammps("columns", text + dump + "run 300\n", ranks, law=coefficients, style="accuracy standard",
                            newton=newton)
                p = self.compare_columns(f"{law}, {ranks} ranks, newton {newton}", there)
                if law == "linear":
                    self.compare_springs(p)

    def compare_columns(self, what, there):
        with open(os.path.join(self.folder, "columns.local"), encoding="ascii") as file:
            lines = file.read().splitlines()
        head = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ENTRIES"))
        rows = np.array([[float(word) for word in line.split()] for line in lines[head + 1:]])
        a, b, p = rows[:, 0] - 1, rows[:, 1] - 1, rows[:, 2:]
        p, a, b = p[p[:, 14] > 0.0], a[p[:, 14] > 0.0], b[p[:, 14] > 0.0]
        require(len(p) == len(there["a"]) > 2000, f"{what}: {len(p)} contacts, not {len(there['a'])}")
        # The table has the smaller number first.
        turned = a > b
        side = np.where(turned, -1.0, 1.0)[:, None]
        order = np.lexsort((np.maximum(a, b), np.minimum(a, b)))
        arm, branch = p[:, 8:11], side * p[:, 11:14]
        arm = np.where(turned[:, None], arm + branch, arm)
        here = {"gap": -p[:, 14], "fn": p[:, 4], "nx ny nz": side * p[:, 5:8], "bx by bz": branch,
                "ax ay az": arm, "sx sy sz": side * -p[:, :3], "fx fy fz": side * -p[:, 18:21],
                "vx vy vz": side * p[:, 22:25], "curvature_min curvature_max": p[:, 25:27]}
        for names, values in here.items():
            values = values[order]
            within(f"pair/local, {what}: {names}", off(values, np.squeeze(columns(there, names))), 1e-8)
        slides = p[:, 21][order] != there["sliding"]
        require(not slides.any() and 0 < there["sliding"].sum() < len(p),
                f"{what}: {slides.sum()} contacts slide in one program alone, of {there['sliding'].sum():.0f}")
        print(f"pair/local, {what}: the same {there['sliding'].sum():.0f} contacts slide", flush=True)
        return p

    def compare_springs(self, p):
        """What the table has not: of linear springs stiffness and energies follow from their forces."""
        within("pair/local, size of the shear force", off(p[:, 3], np.linalg.norm(p[:, :3], axis=1)), 1e-12)
        within("pair/local, normal stiffness", off(p[:, 15], np.full(len(p), STIFFNESS)), 1e-12)
        within("pair/local, normal energy", off(p[:, 16], 0.5 * p[:, 4]**2 / STIFFNESS), 1e-12)
        within("pair/local, shear energy", off(p[:, 17], 0.5 * p[:, 3]**2 / STIFFNESS), 1e-12)

    # dem/lammps/pair_tangency.hpp (1)
    def check_ranks(self):
        """A strained sample does the same on any number of ranks, with newton on and off."""
        first = None
        for ranks, newton in RANKS:
            run = self.lammps("ranks", STRAIN + "run 1000\n", ranks, newton=newton)
            what = f"1000 steps at -0.01/s, {ranks} ranks, newton {newton}"
            if first is None:
                first = run
                continue
            within(f"{what}: forces", off(run.forces(), first.forces()), 1e-7)
            within(f"{what}: energy", abs(run.last["PotEng"] / first.last["PotEng"] - 1.0), 1e-11)
            within(f"{what}: stress", off(run.stress(), first.stress()), 1e-9)

    def check_drift(self):
        """Once through the box: contacts keep their memory on their way from rank to rank."""
        # In 1000 steps of 0.002. Damping would take the drift: both run without.
        edge = np.diag(self.edges())
        speed = edge * (0.5, 0.3, 0.2)
        text = STRAIN.replace("fix damp", "#")
        drift = f"velocity all set {speed[0]} {speed[1]} {speed[2]} sum yes\n"
        still = self.lammps("still", text + "run 1000\n")
        for ranks, newton in ((1, "on"), (4, "on"), (2, "off")):
            run = self.lammps("drift", text + drift + "run 1000\n", ranks, newton=newton)
            what = f"through the box, {run.builds} lists ({still.builds} at rest), {ranks} ranks, newton {newton}"
            require(run.builds > 5 * still.builds, f"{what}: too few lists")
            within(f"{what}: energy", abs(run.last["PotEng"] / still.last["PotEng"] - 1.0), 1e-8)

    def spheres(self, style, pair, steps):
        """The sample's centres as equal spheres that touch, at rest; runs them with a pair style."""
        own = style == "ellipsoid"
        with open(os.path.join(self.folder, f"{style}.data"), "w", encoding="ascii") as file:
            count, edge = len(self.bodies["id"]), self.edges()
            print("Equal spheres\n", f"{count} atoms", sep="\n", file=file)
            print(f"{count} ellipsoids" if own else "", "1 atom types", sep="\n", file=file)
            for k, axis in enumerate("xyz"):
                print(0.0, repr(edge[k, k]), f"{axis}lo {axis}hi", file=file)
            print("\nAtoms\n", file=file)
            for k, centre in enumerate(columns(self.bodies, "x y z")):
                print(k + 1, 1, f"1 {DENSITY}" if own else f"20.0 {DENSITY}", *map(repr, map(float, centre)),
                      file=file)
            if own:
                print("\nEllipsoids\n", file=file)
                for k in range(count):
                    print(k + 1, "20.0 20.0 20.0 1.0 0.0 0.0 0.0", file=file)
        move = "nve/asphere" if own else "nve/sphere"
        text = SPHERES.format(style=style, data=f"{style}.data", pair=pair, move=move)
        output = OUTPUT if own else OUTPUT.replace("compute w all pair tangency\n", "").replace("tq", "t")
        text += output.format(name=style, every=steps) + f"run {steps}\n"
        if not own:
            text = text.replace(" tx ty tz", " tqx tqy tqz")
        done = self.start(style, text, 1)
        require(done.returncode == 0, f"{style}: {done.stdout[-400:]}")
        return Run(self.folder, style)

    def check_spheres(self):
        """Equal spheres without friction do what LAMMPS' own granular spheres do."""
        for friction in (0.0, 0.5):
            own = self.spheres("ellipsoid", "pair_style tangency\npair_coeff * * hooke 1.5e10 tangential "
                               f"linear 1.5e10 {friction}", 200)
            there = self.spheres("sphere", "pair_style gran/hooke/history 1.5e10 1.5e10 0 0 "
                                 f"{friction} 0\npair_coeff * *", 200)
            what = f"equal spheres, friction {friction}, 200 steps beside gran/hooke/history"
            kinetic = abs(own.last["KinEng"] / there.last["KinEng"] - 1.0)
            if friction == 0.0:
                within(f"{what}: kinetic energy", kinetic, 1e-9)
                within(f"{what}: forces", off(own.forces(), there.forces()), 1e-7)
            else:
                # The lever arm there is the radius, here to the middle of the overlap; its memory is
                # projected on the new plane, ours is turned.
                print(f"{what}: kinetic energy {kinetic:.2g}: other lever arms, another turn")

    def check_refusals(self):
        """What is refused is said in one line."""
        whole = (HEAD + PAIR).format(newton="on", style="", law=LINEAR, skin="2.0")
        whole += "fix move all nve/asphere\ntimestep 0.002\nrun 10\n"
        # A skin that is not refused would take all memory of the machine.
        before = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, before[1]))
        for here, there, words in REFUSED:
            require(here in whole, f"{here}: not in the script")
            done = self.start("refused", whole.replace(here, there), 1)
            lines = [line for line in done.stdout.splitlines() if line.startswith("ERROR")]
            allowed = (words,) if isinstance(words, str) else words
            require(done.returncode != 0 and len(lines) == 1 and any(word in lines[0] for word in allowed),
                    f"{there}: status {done.returncode}, {done.stdout[-300:]}{done.stderr[-300:]}")
            print(lines[0])
        resource.setrlimit(resource.RLIMIT_AS, before)
        self.refuses_a_host_that_flushes(whole)

    def refuses_a_host_that_flushes(self, script):
        """As what is linked with -ffast-math, from the start of the program."""
        with open(os.path.join(self.folder, "flush.c"), "w", encoding="ascii") as file:
            file.write("#include <xmmintrin.h>\n__attribute__((constructor)) static void flush(void) "
                       "{ _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON); }\n")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", "flush.so", "flush.c"], cwd=self.folder, check=True)
        done = self.start("flush", script, 1, LD_PRELOAD=os.path.abspath(f"{self.folder}/flush.so"))
        lines = [line for line in done.stdout.splitlines() if line.startswith("ERROR")]
        require(done.returncode != 0 and len(lines) == 1 and "subnormal numbers" in lines[0],
                f"flush to zero: status {done.returncode}, {done.stdout[-300:]}{done.stderr[-300:]}")
        print(lines[0])

    def check_hybrid(self):
        """Atoms that are something beside ellipsoids move and are measured alike: atom_style hybrid."""
        with open(os.path.join(self.folder, "sample.data"), encoding="ascii") as file:
            head, rest = re.split(r"\nAtoms[^\n]*\n", file.read())
        atoms, *others = re.split(r"\n(?=[A-Z])", rest.strip("\n"))
        with open(os.path.join(self.folder, "hybrid.data"), "w", encoding="ascii") as file:
            print(head, "\nAtoms # hybrid\n", file=file)
            for row in filter(str.strip, atoms.splitlines()):
                number, kind, flag, density, *place = row.split()[:7]
                print(number, kind, *place, flag, density, 0.0, file=file)
            print("", *others, sep="\n", file=file)
        whole = HEAD.replace("atom_style ellipsoid", "atom_style hybrid ellipsoid charge")
        text = "fix move all tangency/move damping 0.5\ntimestep 0.002\ncompute b all tangency/balance\n"
        text += "thermo_style custom step pe ke c_b[1] c_b[2] c_b[3]\nrun 200\n"
        plain, other = (self.lammps("hybrid", text, 2, head=head)
                        for head in (HEAD, whole.replace("sample.data", "hybrid.data")))
        for name, value in plain.last.items():
            within(f"hybrid, 200 steps: {name}", abs(other.last[name] - value) / max(abs(value), 1e-300), 1e-9)
        within("hybrid, 200 steps: forces", off(other.forces(), plain.forces()), 1e-7)

    # dem/lammps/pair_tangency.hpp (3)
    def check_restart(self):
        """A run that goes on from a restart file, on other ranks, is the run that was not stopped."""
        # Strained first, so that contacts remember shear. Forces are computed anew at a restart:
        # fix deform has moved the box since the last ones, and fix langevin damps other velocities.
        first = STRAIN + "run 300\nunfix strain\nunfix damp\n"
        move = "fix move all nve/asphere\ntimestep 0.002\n"
        for name, (_, law) in LAWS.items():
            whole = self.lammps("whole", first + "run 700\n", law=law)
            for before, after in ((1, 1), (1, 2), (4, 1)):
                text = first + "run 200\nwrite_restart half.restart\n"
                self.lammps("half", text, before, law=law)
                on = HEAD.replace("read_data sample.data", "read_restart half.restart") + OUTPUT
                on = on.format(name="on", newton="on", every=100, skin=2.0)
                done = self.start("on", on + move + "run 500\n", after)
                require(done.returncode == 0, f"on: {done.stdout[-400:]}")
                run = Run(self.folder, "on")
                require(max(run.rows) == 1000, "the run that goes on ends at step 1000")
                what = f"{name}: restart from {before} to {after} ranks"
                within(f"{what}: stress", off(run.stress(), whole.stress()), 1e-10)
                within(f"{what}: forces", off(run.forces(), whole.forces()), 1e-7)


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    check = Check(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), *sys.argv[3:5])
    names = sys.argv[5:] or [name[6:] for name in vars(Check) if name.startswith("check_")]
    for name in names:
        getattr(check, f"check_{name}")()
    print("lammps_check: all as it should be")


if __name__ == "__main__":
    main()
