#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds loading, moving and measuring by tangency-lammps to tangency-dem: one study by both.

Usage: servo_check.py TANGENCY_DEM TANGENCY_LAMMPS FOLDER [CHECK...]    (CHECK: of those below)

125 spheroids are compressed without friction by tangency-dem, which leaves no shear forces, and go
on from there in both programs, with friction; LAMMPS by the script of `export --lammps`.
- move:     2,000 strained steps: stresses, and places, turns and speeds
- hold:     7,000 steps at a mean stress, which is held within 1e-6 at the end
- triaxial: 10 % of axial compression: how well the lateral stresses are held, by both
- ring:     a simple shear with a plane mean and a direction held, through the pair's own stiffness
- relax:    velocities run downhill to rest, and the script ends the stage where tangency-dem does
- fabric:   tensors and balance of one state, on one rank and on two, newton on and off
- rubbed:   tensors of contacts with friction, after 500 steps
- wall:     spheroids that slide and tumble down a slope into a corner, walls and all
- energy:   the account of energies closes as that of tangency-dem does
- examples: the scripts of dem/lammps/examples run one after the other, as their heads say
- restart:  an axial compression, stopped half way and resumed on another number of ranks
Exit status: 0, or 1 with the first difference. Packages: .ci/setup lammps
"""
import csv
import json
import os
import re
import sys

import numpy as np

from fixes_check import Check, columns, near, require

SAMPLE = """schema = 1
[particles.spheroid]
count = 125
mean_radius = 10.0
elongation = 1.4285714285714286
[contact]
normal_stiffness = 1.5e10
friction_coefficient = 0.5
[[stage]]
kind = "place"
[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 0.05
friction_coefficient = 0.0
"""
OUTPUT = "[output]\nframe_interval = 0\nhistory_interval = 50\n"
PRESS = 10e6
WALL = """schema = 1
[cell]
size = [1.0, 0.3, 0.6]
walls = "xz"
[[wall]]
point = [0.0, 0.0, 0.5]
normal = [1.0, 0.0, 2.0]
[motion]
gravity = [0.0, 0.0, -9.81]
[particles.grain]
count = 3
mean_radius = 0.02
elongation = 1.5
flatness = 1.1
density = 2500.0
[contact]
normal_stiffness = 1e5
friction_coefficient = 0.2
[[stage]]
kind = "place"
arrangement = "explicit"
[[body]]
type = "grain"
position = [0.08, 0.05, 0.51]
[[body]]
type = "grain"
position = [0.16, 0.07, 0.47]
orientation = [0.9, 0.1, 0.4, 0.0]
[[body]]
type = "grain"
position = [0.25, 0.2, 0.42]
angular_velocity = [0.0, 3.0, 1.0]
[[stage]]
kind = "servo"
duration = 1500
damping = 0.0
[output]
frame_interval = 0
"""
STRESSES = "s_xx s_yy s_zz s_xy s_zx s_yz"


class Study(Check):
    def __init__(self, dem, lammps, folder):
        super().__init__(dem, lammps, folder)
        self.write("sample.toml", SAMPLE + OUTPUT)
        self.tool("run", "sample.toml", "--out", "sample", "--quiet", "--replace")

    def both(self, name, stage):
        """Goes on from the sample with one stage more by tangency-dem, and exports the same."""
        self.write(name + ".toml", SAMPLE + "[[stage]]\n" + stage + OUTPUT)
        # A scene with another stage goes on from the state of the shorter one.
        self.tool("run", name + ".toml", "--resume", "sample/final.state", "--out", name + ".run",
                  "--quiet", "--replace")
        self.tool("export", "sample/final.state", "--lammps", name, "--scene", name + ".toml")
        return self.read(f"{name}/in.{name}")

    def rows(self, name, stage):
        """Of tangency-dem's history, of a stage."""
        rows = csv.DictReader(self.read(name + ".run/history.csv").splitlines())
        return [row for row in rows if row["stage"] == stage]

    def thermo(self, printed):
        """The rows that LAMMPS printed, by the names of its columns."""
        names, rows = [], []
        for line in printed.splitlines():
            words = line.split()
            if words[:1] == ["Step"]:
                names = words
            elif names and len(words) == len(names) and re.fullmatch(r"[-+.0-9e ]+", line.strip()):
                rows.append(dict(zip(names, map(float, words))))
        return rows

    def compare(self, name, ranks, bounds, suffix=""):
        there = self.tool("particles", f"{name}.run/final.state")
        here = self.tool("import", f"{name}/{name}.end{suffix}.data")
        for names, bound in bounds.items():
            a, b = columns(here, names), columns(there, names)
            if names == "qw qx qy qz":
                a *= np.sign((a * b).sum(axis=1))[:, None]
            if names == "x y z":
                edges = self.edges(f"{name}/{name}.end{suffix}.data")
                a, b = (np.linalg.solve(edges, v.T).T for v in (a, b))
                a -= np.round(a - b)
            near(f"{name} on {ranks} ranks, {names}", a, b, bound)

    # The checks.

    def move(self):
        stage = ('kind = "servo"\nduration = 2000\ndamping = 0.1\n'
                 "strain_rate = [0.01, 0.01, 0.01]\n")
        script = self.both("move", stage)
        for ranks in (1, 2):
            rows = self.thermo(self.in_folder("move", "in.move", ranks))
            last = self.rows("move", "servo")[-1]
            here = [rows[-1][f"c_push[{k}]"] for k in range(1, 7)]
            near(f"move on {ranks} ranks, stresses", here,
                 [float(last[column]) for column in STRESSES.split()], 1e-9)
            near(f"move on {ranks} ranks, elastic energy", [rows[-1]["PotEng"]],
                 [float(last["elastic_energy"])], 1e-9)
            self.compare("move", ranks, {"x y z": 1e-9, "qw qx qy qz": 1e-9, "vx vy vz": 1e-5,
                                         "wx wy wz": 1e-5})
        return script

    def hold(self):
        script = self.both("hold", f'kind = "servo"\nduration = 7000\nmean_stress = {PRESS}\n'
                                   "max_strain_rate = 0.05\n")
        rows = self.thermo(self.in_folder("hold", "in.hold", 2))
        last = self.rows("hold", "servo")[-1]
        here = np.mean([rows[-1][f"c_push[{k}]"] for k in (1, 2, 3)]) / PRESS - 1.0
        there = float(last["mean_stress"]) / PRESS - 1.0
        print(f"hold: off by {here:.2g} of the mean stress, tangency-dem by {there:.2g}")
        require(abs(here) <= 1e-6, "hold: more than 1e-6 off")
        return script

    def triaxial(self):
        self.both("triaxial", 'kind = "shear"\naxial_strain_rate = 0.02\naxial_strain = 0.1\n'
                              f"lateral_stress = {PRESS}\n")
        rows = self.thermo(self.in_folder("triaxial", "in.triaxial", 2))
        there = self.rows("triaxial", "shear")
        half = len(there) // 2  # the servo settles before
        off = {"tangency-lammps": [abs(row[f"c_push[{k}]"] / PRESS - 1.0)
                                   for row in rows[len(rows) // 2:] for k in (1, 2)],
               "tangency-dem": [abs(float(row[name]) / PRESS - 1.0) for row in there[half:]
                                for name in ("s_xx", "s_yy")]}
        for program, values in off.items():
            print(f"triaxial: lateral stresses off by {max(values):.2g} at most and "
                  f"{np.mean(values):.2g} in the mean, {program}")
        require(max(off["tangency-lammps"]) <= 2.0 * max(off["tangency-dem"]),
                "triaxial: lateral stresses are held worse")
        axial = {float(row["cycle"]): float(row["s_zz"]) for row in there}
        both = [(row["c_push[3]"], axial[row["Step"]]) for row in rows if row["Step"] in axial]
        require(len(both) > 20, "triaxial: too few rows of the same steps")
        near(f"triaxial: axial stress of {len(both)} steps", *np.array(both).T, 1e-6)

    def ring(self):
        self.both("ring", f'kind = "servo"\nduration = 4000\nplane_mean_stress = {PRESS}\n'
                          "strain_rate = [0.0, 0.0, 0.01]\nmajor_direction = 20.0\n"
                          "max_strain_rate = 0.05\n")
        rows = self.thermo(self.in_folder("ring", "in.ring", 2))
        last = rows[-1]
        plane = (last["c_push[1]"] + last["c_push[2]"]) / 2.0 / PRESS - 1.0
        angle = 0.5 * np.arctan2(2.0 * last["c_push[5]"], last["c_push[3]"] - last["c_push[1]"])
        print(f"ring: plane mean off by {plane:.2g}, direction {np.degrees(angle):.4g} degrees")
        require(abs(plane) <= 1e-2 and abs(np.degrees(angle) - 20.0) <= 1.0, "ring: not held")

    def relax(self):
        self.both("relax", f'kind = "relax"\nmean_stress = {PRESS}\nmax_strain_rate = 0.05\n'
                           "max_unbalanced_ratio = 1e-5\n")
        last = int(self.rows("relax", "relax")[-1]["cycle"])
        for ranks in (1, 2):
            rows = self.thermo(self.in_folder("relax", "in.relax", ranks))
            data = self.read("relax/relax.end.data").splitlines()[0]
            step = int(re.search(r"timestep = (\d+)", data).group(1))
            print(f"relax on {ranks} ranks: at rest at step {step}, tangency-dem {last}")
            require(0 <= step - last < 10, "relax: another end")
            near(f"relax on {ranks} ranks, stresses", [rows[-1][f"c_push[{k}]"] for k in (1, 2, 3)],
                 [PRESS] * 3, 0.2)
            self.compare("relax", ranks, {"x y z": 1e-6, "qw qx qy qz": 1e-5})

    def fabric_of(self, state):
        """The columns of compute tangency/fabric, by tangency-dem."""
        seen = json.loads(self.tool("micro", state, "--json", "-"))

        def of(tensor):
            return [tensor[i][j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]

        numbers = of(seen["fabric"]["second"])
        for key in ("normal_force", "tangential_force", "branch_normal", "branch_tangential"):
            numbers += of(seen[key]["second"])
        return numbers + [seen["f0"], seen["z0"], seen["contact_density"], seen["contacts"]]

    def rubbed(self):
        """The fabric of contacts with friction: its tensor of tangential forces is none of rounding."""
        self.both("rubbed", 'kind = "servo"\nduration = 500\ndamping = 0.1\n'
                            "strain_rate = [0.01, 0.0, 0.02]\n")
        there = np.array(self.fabric_of("rubbed.run/final.state"))
        require(np.abs(there[12:18]).max() > 1e-3, "rubbed: no friction")
        names = " ".join(f"c_fabric[{k}]" for k in range(1, 35))
        script = re.sub("(?m)^thermo_style.*", "compute fabric all tangency/fabric\n"
                        "thermo_style custom step " + names, self.read("rubbed/in.rubbed"))
        self.write("rubbed/in.look", script)
        for ranks in (1, 2):
            row = self.thermo(self.in_folder("rubbed", "in.look", ranks))[-1]
            here = np.array([row[f"c_fabric[{k}]"] for k in range(1, 35)])
            for what, columns_of in (("normals", slice(0, 6)), ("normal forces", slice(6, 12)),
                                     ("tangential forces", slice(12, 18)), ("branches", slice(18, 30)),
                                     ("numbers", slice(30, 34))):
                near(f"rubbed on {ranks} ranks, {what}", here[columns_of], there[columns_of], 1e-9)

    def fabric(self):
        self.both("fabric", 'kind = "servo"\nduration = 1\n')
        head = self.read("fabric/in.fabric").split("# Stage")[0]
        there = self.fabric_of("sample/final.state")
        last = list(csv.DictReader(self.read("sample/history.csv").splitlines()))[-1]
        for ranks, newton in ((1, "on"), (2, "on"), (2, "off")):
            names = " ".join(f"c_fabric[{k}]" for k in range(1, 35))
            self.write("fabric/in.look", head.replace("newton on", "newton " + newton) +
                       "compute fabric all tangency/fabric\nthermo_style custom step " + names +
                       " c_balance[1] c_balance[2] c_balance[3] c_balance[7]\nrun 0\n")
            row = self.thermo(self.in_folder("fabric", "in.look", ranks))[-1]
            here = [row[f"c_fabric[{k}]"] for k in range(1, 35)]
            what = f"on {ranks} ranks, newton {newton}"
            # The tangential force of contacts without friction is rounding: its tensor is not held.
            scale = np.r_[np.full(30, 1.0), np.abs(there[30:])]
            keep = [k for k in range(34) if not 12 <= k < 18]
            # tangency-dem's normals, of the standard accuracy, are within some 1e-8 of the true ones.
            near("fabric " + what, 1.0 + (np.array(here) / scale)[keep],
                 1.0 + (np.array(there) / scale)[keep], 1e-7)
            for k, name in ((1, "contacts"), (2, "mean_normal_force"), (7, "mechanical_coordination")):
                near(f"{name} {what}", [row[f"c_balance[{k}]"]], [float(last[name])], 1e-7)
            near("unbalanced " + what, [row["c_balance[3]"]], [float(last["inertial_fraction"])], 1e-6)

    def wall(self):
        """A scene of its own: bodies in front of a plane, with gravity, friction and restitution."""
        self.write("wall.toml", WALL)
        self.tool("run", "wall.toml", "--out", "wall.run", "--quiet", "--replace")
        self.tool("export", "--lammps", "wall", "--scene", "wall.toml")
        moved = columns(self.tool("particles", "wall.run/final.state"), "x y z")
        start = columns(self.tool("import", "wall/wall.data"), "x y z")
        require(np.abs(moved - start).max() > 0.05, "wall: nothing slides")
        for ranks in (1, 2):
            printed = self.in_folder("wall", "in.wall", ranks)
            require("WARNING" not in printed, printed[-600:])
            self.compare("wall", ranks, {"x y z": 1e-9, "qw qx qy qz": 1e-8, "vx vy vz": 1e-7,
                                         "wx wy wz": 1e-7})
        # Stopped while a body touches the slope, and resumed on another number of ranks.
        script = self.read("wall/in.wall")
        steps, stop = int(re.search("(?m)^run (.*)", script).group(1)), 400
        self.write("wall/in.first", re.sub(
            "(?m)^run .*", f"thermo_style custom step f_wall4_1[4]\nrun {stop}\nwrite_restart half.restart",
            script).split("unfix motion")[0])
        rows = self.thermo(self.in_folder("wall", "in.first", 2))
        require(rows[-1]["f_wall4_1[4]"] >= 1.0, "wall: nothing touches the slope where it is stopped")
        kept = [line for line in script.splitlines() if re.match(
            "fix |group |neigh|comm_modify|timestep", line)]
        self.write("wall/in.second", "read_restart half.restart\n" + "\n".join(kept) +
                   f"\nrun {steps - stop}\nwrite_data wall.end.resumed.data\n")
        self.in_folder("wall", "in.second", 1)
        self.compare("wall", "resumed", {"x y z": 1e-9, "vx vy vz": 1e-7}, ".resumed")

    # dem/lammps/pair_tangency.hpp (4)
    def energy(self):
        self.both("energy", 'kind = "servo"\nduration = 2000\ndamping = 0.1\n'
                            "strain_rate = [0.01, 0.0, 0.02]\n")
        script = self.read("energy/in.energy")
        script = re.sub("(?m)^(fix motion.*)", r"\1\ncompute works all pair tangency\n"
                        "thermo_style custom step pe f_motion[1] f_motion[2] c_works[1] c_works[2] "
                        "c_works[3] c_works[4]\nthermo_modify format float %.15g", script)
        self.write("energy/in.account", script.split("unfix motion")[0])
        for ranks in (1, 2):
            rows = self.thermo(self.in_folder("energy", "in.account", ranks))

            def sum_of(row):
                return (row["PotEng"] + row["f_motion[2]"] + row["f_motion[1]"] + row["c_works[1]"] +
                        row["c_works[4]"] - row["c_works[2]"] - row["c_works[3]"])

            through = abs(rows[-1]["c_works[2]"])
            here = (sum_of(rows[-1]) - sum_of(rows[0])) / through
            last, first = self.rows("energy", "servo")[-1], list(csv.DictReader(
                self.read("sample/history.csv").splitlines()))[-1]
            there = (float(last["energy_error"]) - float(first["energy_error"])) / through
            print(f"energy on {ranks} ranks: error {here:.2g} of the work of the boundary, "
                  f"tangency-dem {there:.2g}")
            require(abs(here - there) <= 1e-6 and abs(here) < 1e-2, "energy: the account does not close")

    def restart(self):
        self.both("again", 'kind = "shear"\naxial_strain_rate = 0.02\naxial_strain = 0.1\n'
                           f"lateral_stress = {PRESS}\n")
        script = re.sub("(?m)^(variable (height|first|ended)|fix end|if|unfix end).*\n", "",
                        self.read("again/in.again"))
        run = re.compile("(?m)^run .*")
        self.write("again/in.whole", run.sub("run 1500", script))
        whole = self.thermo(self.in_folder("again", "in.whole", 1))[-1]
        self.write("again/in.first", run.sub("run 700\nwrite_restart half.restart", script)
                   .split("unfix motion")[0])
        self.in_folder("again", "in.first", 1)
        kept = [line for line in script.splitlines() if re.match(
            "fix |compute |thermo|neigh|comm_modify|timestep", line)]
        self.write("again/in.second", "read_restart half.restart\n" + "\n".join(kept) + "\nrun 800\n")
        resumed = self.thermo(self.in_folder("again", "in.second", 2))[-1]
        require(resumed["Step"] == whole["Step"], "restart: other steps")
        for column in ("PotEng", "c_push[1]", "c_push[2]", "c_push[3]", "Lx"):
            near(f"restart: {column}", [resumed[column]], [whole[column]], 1e-8)

    def examples(self):
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "dem")
        for script in ("compress", "triaxial", "replicate", "large"):
            with open(os.path.join(root, "lammps", "examples", "in." + script), encoding="ascii") as file:
                self.write("in." + script, file.read())
        self.tool("export", "--lammps", "start", "--scene", os.path.join(root, "scenes", "assembly-1000.toml"))
        for script, ranks, values in (("compress", 2, {}), ("triaxial", 1, {"strain": 0.01}),
                                      ("replicate", 2, {"n": 2, "steps": 20}),
                                      ("large", 2, {"n": 1, "steps": 300, "every": 200}),
                                      ("large", 1, {"n": 1, "steps": 400, "from": 200})):
            words = [str(word) for pair in values.items() for word in ("-var", *pair)]
            last = self.thermo(self.engine("in." + script, ranks, variables=words))[-1]
            print(f"in.{script} on {ranks} ranks {values}: step {last['Step']:.0f}, "
                  f"mean stress {np.mean([last[f'c_push[{k}]'] for k in (1, 2, 3)]):.4g}")
            require(abs(last["c_push[1]"] / PRESS - 1.0) < 0.01, f"in.{script}: lateral stress is not held")
        require(last["Step"] == 400.0, "in.large: does not go on from its restart")


CHECKS = ("move", "hold", "triaxial", "ring", "relax", "fabric", "rubbed", "wall", "energy", "restart",
          "examples")

if __name__ == "__main__":
    require(len(sys.argv) > 3, __doc__)
    study = Study(*sys.argv[1:4])
    for chosen in sys.argv[4:] or CHECKS:
        getattr(study, chosen)()
