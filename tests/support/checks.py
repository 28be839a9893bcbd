# SPDX-License-Identifier: GPL-3.0-or-later
"""What checks that are programs say and how they end: 1 with the first difference."""
import pathlib
import sys


def require(condition, what):
    """Ends the program with its name and what does not hold."""
    if not condition:
        sys.exit(f"{pathlib.Path(sys.argv[0]).stem}: {what}")


def near(what, here, there, bound):
    """Arrays of one shape that differ by at most `bound` of the largest; prints by how much."""
    import numpy as np  # not every check has it

    here, there = np.asarray(here, float), np.asarray(there, float)
    require(here.shape == there.shape, f"{what}: {here.shape} numbers, not {there.shape}")
    error = np.abs(here - there).max() / max(np.abs(there).max(), 1e-300)
    require(error <= bound, f"{what}: off by {error:.3g} of the largest, more than {bound:.3g}")
    print(f"{what}: {error:.2g}")
