#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Has other programs read what `tangency-dem export` writes, and imports what they write again.

Usage: exchange_check.py TANGENCY_DEM LMP FOLDER    (LMP: the program lammps)

A sample of two types of ellipsoids is made, and
- LAMMPS reads the data file and writes a dump and a data file of its own: imported, bodies must be
  those of the state, to the last digits (it normalises quaternions);
- python3-gsd reads the GSD file: box, radii, places, orientations, spins, masses, to 32 bits; and a
  GSD file that it writes itself, of two frames, is imported;
- ASE reads the extended XYZ file, to the bit;
- VTK reads the frames of contacts, whose forces must be those of the table of contacts.
Exit status: 0, or 1 with the first difference. Packages: .ci/setup long; .ci/setup frames
"""
import csv
import os
import subprocess
import sys

import ase.io
import gsd.hoomd
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import near, require  # noqa: E402

SCENE = """schema = 1
[particles.grain]
count = 30
mean_radius = 10.0
elongation = 1.4
flatness = 1.2
[particles.stone]
count = 20
mean_radius = 12.0
density = 2650.0
[contact]
normal_stiffness = 1.5e10
friction_coefficient = 0.5
[[stage]]
kind = "place"
[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 0.05
[[stage]]
kind = "servo"
duration = 30
strain_rate = [0.02, 0.0, -0.01]
[output]
contact_frames = true
"""

LAMMPS = """units si
atom_style ellipsoid
boundary p p p
read_data sample.data
pair_style zero 1.0
pair_coeff * *
compute s all property/atom shapex shapey shapez
compute q all property/atom quatw quati quatj quatk
fix 1 all nve/asphere
dump d all custom 1 lammps.dump id type xu yu zu vx vy vz c_s[1] c_s[2] c_s[3] c_q[1] c_q[2] c_q[3] &
     c_q[4] mass
dump_modify d format float %.17g
run 0
write_data lammps.data
"""
NAMES = {f"c_s[{k + 1}]": name for k, name in enumerate(("shapex", "shapey", "shapez"))}
NAMES.update({f"c_q[{k + 1}]": name for k, name in enumerate(("quatw", "quati", "quatj", "quatk"))})


def table(text):
    rows = list(csv.DictReader(text.splitlines()))
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def columns(bodies, names):
    return np.array([bodies[name].astype(float) for name in names.split()]).T


class Check:
    def __init__(self, tool, folder):
        self.tool, self.folder = tool, folder
        os.makedirs(folder, exist_ok=True)
        with open(self.path("scene.toml"), "w", encoding="ascii") as file:
            file.write(SCENE)
        self.run("run", "scene.toml", "--out", "out", "--quiet", "--replace")
        self.state = self.path("out/final.state")
        self.bodies = table(self.run("particles", self.state))
        self.edges = None

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *words):
        done = subprocess.run([self.tool, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        require(done.returncode == 0, f"{' '.join(words)}: {done.stderr}")
        return done.stdout

    def export(self, form, name):
        self.run("export", self.state, "--format", form, "--out", name)

    def imported(self, what, name, bounds):
        there = table(self.run("import", name))
        for names, bound in bounds.items():
            near(f"{what}, {names}", columns(there, names), columns(self.bodies, names), bound)

    def lammps(self, lmp):
        self.export("lammps-data", "sample.data")
        with open(self.path("in.check"), "w", encoding="ascii") as file:
            file.write(LAMMPS)
        done = subprocess.run([lmp, "-in", "in.check", "-log", "none"], cwd=self.folder, check=False,
                              capture_output=True, text=True)
        require(done.returncode == 0, f"{lmp}: {done.stdout[-400:]}")
        with open(self.path("lammps.dump"), encoding="ascii") as file:
            lines = file.read().splitlines()
        head = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        lines[head] = " ".join(NAMES.get(word, word) for word in lines[head].split())
        with open(self.path("named.dump"), "w", encoding="ascii") as file:
            file.write("\n".join(lines) + "\n")
        self.imported("LAMMPS' dump", "named.dump",
                      {"x y z": 1e-15, "r1 r2 r3": 0.0, "qw qx qy qz": 3e-16, "vx vy vz": 0.0})
        # Places are wrapped, with the edges that they have crossed at the end of the row.
        self.imported("LAMMPS' data file", "lammps.data",
                      {"r1 r2 r3": 0.0, "qw qx qy qz": 3e-16, "vx vy vz": 0.0, "wx wy wz": 1e-14})

    def gsd(self):
        self.export("gsd", "sample.gsd")
        with gsd.hoomd.open(self.path("sample.gsd"), "rb") as file:
            require(len(file) == 1 and file.file.schema == "hoomd", "sample.gsd: a frame of hoomd")
            frame = file[0]
        frame.validate()
        part = frame.particles
        shapes = np.array([[part.type_shapes[t][k] for k in "abc"] for t in part.typeid])
        near("gsd, radii", shapes, columns(self.bodies, "r1 r2 r3"), 0.0)
        near("gsd, orientation", part.orientation, columns(self.bodies, "qw qx qy qz"), 6e-8)
        near("gsd, velocity", part.velocity, columns(self.bodies, "vx vy vz"), 6e-8)
        box = frame.configuration.box[:3].astype(float)
        away = part.position + box / 2 + part.image * box - columns(self.bodies, "x y z")
        near("gsd, places", away / box + 1, np.ones_like(away), 3e-7)
        w, v = part.orientation[:, :1], part.orientation[:, 1:]
        s, u = part.angmom[:, :1], part.angmom[:, 1:]
        spin = 0.5 * (w * u - s * v - np.cross(v, u)) / part.moment_inertia  # conj(q) P / 2, in body
        t = 2.0 * np.cross(v, spin)
        near("gsd, spins", spin + w * t + np.cross(v, t), columns(self.bodies, "wx wy wz"), 2e-6)
        with gsd.hoomd.open(self.path("two.gsd"), "wb") as file:
            for step in (0, 7):  # the first with the places of the others
                frame.configuration.step = step
                for name in ("position", "image"):
                    setattr(part, name, getattr(part, name)[::-1].copy())
                file.append(frame)
        self.imported("gsd of its own, last of two", "two.gsd",
                      {"r1 r2 r3": 0.0, "qw qx qy qz": 6e-8, "vx vy vz": 6e-8})
        last, first = (table(self.run("import", "two.gsd", *words)) for words in
                       ((), ("--frame", "0")))
        near("gsd, frames", columns(first, "x y z")[::-1], columns(last, "x y z"), 0.0)

    def ase(self):
        self.export("xyz", "sample.xyz")
        atoms = ase.io.read(self.path("sample.xyz"), format="extxyz")
        near("ase, places", atoms.positions, columns(self.bodies, "x y z"), 0.0)
        near("ase, radii", atoms.arrays["aspherical_shape"], columns(self.bodies, "r1 r2 r3"), 0.0)
        near("ase, x y z w", atoms.arrays["orientation"], columns(self.bodies, "qx qy qz qw"), 0.0)
        near("ase, spins", atoms.arrays["angular_velocity"], columns(self.bodies, "wx wy wz"), 0.0)

    def vtk(self):
        contacts = table(self.run("contacts", self.state))
        cycles = [int(name.split(".")[0]) for name in os.listdir(self.path("out/frames"))]
        for ending, of in (("contacts", "GetPointData"), ("chains", "GetCellData")):
            reader = vtk.vtkXMLPolyDataReader()
            reader.SetFileName(self.path(f"out/frames/{max(cycles)}.{ending}.vtp"))
            reader.Update()
            data = getattr(reader.GetOutput(), of)()
            force = vtk_to_numpy(data.GetArray("normal_force"))
            near(f"vtk, {ending}", force, contacts["fn"].astype(float), 6e-8)
        require(reader.GetOutput().GetNumberOfLines() == len(force), "a line a contact")


def main(tool, lmp, folder):
    check = Check(os.path.abspath(tool), os.path.abspath(folder))
    check.lammps(lmp)
    check.gsd()
    check.ase()
    check.vtk()
    print(f"{len(check.bodies['id'])} bodies: as they should be")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
