#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Triaxial compression of five samples by tangency-dem and, from the same placed bodies, all by
tangency-lammps with the script of `export --lammps`: compressed without friction, then sheared with it.

Usage: curves_check.py TANGENCY_DEM TANGENCY_LAMMPS FOLDER

Prints the deviatoric stress over the mean one by axial strain: the mean of the seeds by each program, the
standard deviation between seeds, and how far the programs are apart for one seed. Ends with 1 where
that is more than a hundredth of the least scatter between seeds.
Packages: .ci/setup lammps
"""
import sys

import numpy as np

from fixes_check import require
from servo_check import OUTPUT, PRESS, SAMPLE, Study

SEEDS = range(1, 6)
STRAINS = np.arange(1, 11) / 100.0
PART = 1e-2  # of the scatter. Chosen: an engine that nobody can tell from another by a curve
SHEAR = f"""[[stage]]
kind = "shear"
axial_strain_rate = 0.02
axial_strain = 0.105
lateral_stress = {PRESS}
"""


def at_strains(strain, axial, lateral):
    """q/p at each of STRAINS."""
    strain, axial, lateral = map(np.asarray, (strain, axial, lateral))
    require(strain[-1] >= STRAINS[-1], f"sheared to {strain[-1]:.3g} alone")
    return np.interp(STRAINS, strain, 3.0 * (axial - lateral) / (axial + 2.0 * lateral))


def by_simulator(study, name):
    rows = study.rows(name, "shear")
    column = lambda key: np.array([float(row[key]) for row in rows])
    return at_strains(column("axial_strain"), column("s_zz"), 0.5 * (column("s_xx") + column("s_yy")))


def by_lammps(study, name):
    printed = study.in_folder(name, f"in.{name}", 2)
    # The last run of the script is the shear.
    rows = study.thermo(printed[printed.rindex("\n", 0, printed.rindex("Step ")):])
    column = lambda key: np.array([row[key] for row in rows])
    return at_strains(np.log(rows[0]["Lz"] / column("Lz")), column("c_push[3]"),
                      0.5 * (column("c_push[1]") + column("c_push[2]")))


def main():
    require(len(sys.argv) == 4, __doc__)
    study = Study(*sys.argv[1:4])
    curves = {"tangency-dem": [], "tangency-lammps": []}
    for seed in SEEDS:
        name = f"curve-{seed}"
        study.write(name + ".toml", SAMPLE.replace('kind = "place"', f'kind = "place"\nseed = {seed}') + SHEAR + OUTPUT)
        study.tool("run", name + ".toml", "--out", name + ".run", "--quiet", "--replace")
        study.tool("export", "--lammps", name, "--scene", name + ".toml")
        curves["tangency-dem"].append(by_simulator(study, name))
        curves["tangency-lammps"].append(by_lammps(study, name))
    dem, lammps = (np.array(rows) for rows in curves.values())
    scatter = dem.std(axis=0, ddof=1)
    print(f"q/p of 125 bodies, seeds {SEEDS[0]} to {SEEDS[-1]}\n"
          f"{'strain':>6}{'tangency-dem':>14}{'tangency-lammps':>17}{'between seeds':>15}{'same seed, at most':>20}")
    for k, strain in enumerate(STRAINS):
        print(f"{strain:6.2f}{dem[:, k].mean():14.4f}{lammps[:, k].mean():17.4f}{scatter[k]:15.4f}"
              f"{np.abs(lammps - dem)[:, k].max():20.1e}")
    off = np.abs(lammps - dem).max()
    print(f"one seed by two programs: {off:.2g} apart at most (bound {PART * scatter.min():.2g})")
    require(off <= PART * scatter.min(), "the curves of the two programs are further apart than that")


if __name__ == "__main__":
    main()
