#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds tangency-lammps-scaling to sums that are done here step by step, and to its refusals.

Usage: scaling_check.py TANGENCY_LAMMPS_SCALING
Exit status: 0, or 1 with the first difference.
"""
import csv
import math
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import require  # noqa: E402


def run(*words):
    return subprocess.run([sys.argv[1], *words], capture_output=True, text=True, check=False)


def table(*words):
    done = run(*words)
    require(done.returncode == 0, done.stderr)
    return list(csv.DictReader(done.stdout.splitlines()))


def near(what, here, there, bound):
    require(abs(here - there) <= bound * abs(there), f"{what}: {here}, not {there}")
    print(f"{what}: {here}")


# One row by hand: 10,000 particles a rank on 1e4 ranks, in microseconds.
row = table("--particles", "1e8", "--ranks", "1e4")[0]
ghosts = (10000 ** (1 / 3) + 2.82) ** 3 - 10000
own = 10000 * 1.05
sent = ghosts * 152
step = (own + ghosts * 0.25 + 4 * 0.5 * 100 * 1.05 + sent * 0.21 * 128 / 25e9 * 1e6 +
        3 * sent / 5e9 * 1e6 + 12 * 2 + 2 * math.log2(1e4) * 2)
near("ms a step", float(row["step_ms"]), step / 1000, 0.005)
near("efficiency", float(row["efficiency"]), own / step, 0.01)
near("ghosts", float(row["ghosts_per_own"]), ghosts / 10000, 0.02)

# One rank has nothing to wait for or to send to others: ghosts alone are left.
alone = table("--particles", "64000", "--ranks", "1,2")
require(float(alone[0]["efficiency"]) > float(alone[1]["efficiency"]) > 0.8, "1 and 2 ranks")
speed_up = float(alone[0]["step_ms"]) / float(alone[1]["step_ms"])
print(f"64,000 on 2 ranks: {speed_up / 2:.2f} of twice the speed")
require(0.9 < speed_up / 2 < 1.0, "64,000 on 2 ranks")


# dem/lammps/scaling.hpp (1)
def more_particles_are_more_efficient():
    """On as many ranks; more ranks than particles have no row."""
    rows = table("--particles", "1e4,1e6,1e8", "--ranks", "1e4,1e5")
    require(len(rows) == 5, "rows of more ranks than particles")
    of_1e4 = [float(row["efficiency"]) for row in rows if row["ranks"] == "10000"]
    require(of_1e4 == sorted(set(of_1e4)), f"efficiencies {of_1e4}")


more_particles_are_more_efficient()

for words in (("--particles", "0"), ("--particles", "many"), ("--ranks", "1,,2"), ("--own", "-1"),
              ("--own", "nan"), ("--steps", "0"), ("--speed", "1")):
    done = run(*words)
    require(done.returncode == 2 and done.stderr.count("\n") == 1 and not done.stdout,
            f"{' '.join(words)}: status {done.returncode}, {done.stderr}")
print("refusals: as they should be")
