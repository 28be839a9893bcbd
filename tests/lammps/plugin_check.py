#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What tangencyplugin.so does that tangency-lammps cannot: superellipsoids of LAMMPS of 2026.

Usage: plugin_check.py TANGENCY_DEM LAMMPS SCENE FOLDER

LAMMPS has to find the plugin: LAMMPS_PLUGIN_PATH names its folder. Ends with 1 where a bound is passed.
"""
import os
import sys

from lammps_check import HEAD, LINEAR, PAIR, STRAIN, Check, off, require, within

SUPER = "atom_style ellipsoid superellipsoid"


def superellipsoids(folder, exponents):
    """The sample's data file with two exponents a body; those of the last body are the argument."""
    with open(os.path.join(folder, "sample.data"), encoding="ascii") as file:
        head, bodies = file.read().split("\nEllipsoids\n")
    rows = [row for row in bodies.splitlines() if row.strip()]
    last = max(int(row.split()[0]) for row in rows)
    with open(os.path.join(folder, "super.data"), "w", encoding="ascii") as file:
        print(head, "\nEllipsoids # superellipsoids\n", sep="", file=file)
        for row in rows:
            words = row.split()
            own = exponents if int(words[0]) == last else "2.0 2.0"
            print(*words, own, file=file)
    return last


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    check = Check(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), *sys.argv[3:5])
    move = STRAIN[:STRAIN.index("fix damp")] + "timestep 0.002\nrun 200\n"
    plain = check.lammps("plain", move)
    superellipsoids(check.folder, "2.0 2.0")
    head = HEAD.replace("atom_style ellipsoid", SUPER).replace("sample.data", "super.data")
    for ranks in (1, 2):
        run = check.lammps("super", move, ranks, head=head)
        what = f"superellipsoids of exponents 2 and 2, 200 strained steps, {ranks} ranks"
        within(f"{what}: energy", abs(run.last["PotEng"] / plain.last["PotEng"] - 1.0), 1e-11)
        within(f"{what}: forces", off(run.forces(), plain.forces()), 1e-7)
    last = superellipsoids(check.folder, "2.0 3.0")
    script = (head + PAIR).format(newton="on", style="", law=LINEAR, skin=2.0)
    without = script[:script.index("pair_style")] + "pair_style zero 45.0\npair_coeff * *\n"
    for name, fix in (("Pair style tangency", "nve/asphere"), ("fix tangency/move", "tangency/move"),
                      ("fix wall/tangency", "wall/tangency plane 0 0 0 0 0 1 law hooke 1e9")):
        own = without.replace("p p p", "p p f") if "wall" in fix else without
        text = (script if fix == "nve/asphere" else own) + f"fix move all {fix}\ntimestep 0.002\nrun 1\n"
        done = check.start("refused", text, 1)
        lines = [line for line in done.stdout.splitlines() if line.startswith("ERROR")]
        require(done.returncode != 0 and len(lines) == 1 and "the exponents 2 and 2 are allowed" in lines[0],
                f"{fix}: status {done.returncode}, {done.stdout[-400:]}{done.stderr[-200:]}")
        require(f"{name}: atom {last} " in lines[0], f"{lines[0]}: not {name} and atom {last}")
        print(lines[0])
    print("plugin_check: all as it should be")


if __name__ == "__main__":
    main()
