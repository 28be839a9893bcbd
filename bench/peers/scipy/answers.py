#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""SciPy's optimiser (Debian's python3-scipy), as an engineer asks it for a contact in one function.

The signed gap is the largest value over unit vectors n of n.d - h_A(n) - h_B(n), with
h(n) = |diag(r) R' n| the support function and d the line of centres: `common-normal`. It is handed to
scipy.optimize.minimize with method BFGS and its gradient, as a function of a vector of any length.
It starts from the line of centres, or from the x axis where the centres coincide.

Options: gtol, the norm of the gradient at which BFGS stops, in the unit of length; SciPy's default
1e-5, and 1e-12. Where rounding stops it first (status 2) its last point is taken as an answer; any
other status than 0 is none. BFGS finds one maximum, which of several need not be the largest.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from adapter import Code, Contact, main  # noqa: E402

try:
    import numpy as np
    import scipy
    from scipy.optimize import minimize
except ImportError:
    scipy = None


def rotation(quaternion):
    """Columns are the body's axes in space."""
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def contact(a, b, gtol):
    d = np.subtract(b.centre, a.centre)
    roots = [(rotation(e.quaternion) * e.semi_axes).T for e in (a, b)]  # |root n| is h(n)

    def negative_gap(v):
        length = np.linalg.norm(v)
        n = v / length
        value, gradient = n @ d, d.copy()
        for root in roots:
            image = root @ n
            support = np.linalg.norm(image)
            value -= support
            gradient -= root.T @ image / support
        return -value, -(gradient - n * (n @ gradient)) / length

    distance = np.linalg.norm(d)
    start = d / distance if distance > 0 else np.array([1.0, 0.0, 0.0])
    found = minimize(negative_gap, start, jac=True, method="BFGS", options={"gtol": gtol})
    if found.status not in (0, 2) or not np.isfinite(found.fun):
        return None
    gap = -float(found.fun)
    return Contact(gap < 0, gap, tuple(found.x / np.linalg.norm(found.x)))


def contacts(gtol):
    def answers(pairs):
        with np.errstate(all="ignore"):
            for a, b in pairs:
                yield contact(a, b, gtol)
    return answers


def codes():
    if scipy is None:
        return []
    return [Code(f"scipy-bfgs-{gtol:.0e}", "SciPy", scipy.__version__, "optimize.minimize",
                 f"BFGS, gtol {gtol:.0e}", "common-normal", contacts(gtol))
            for gtol in (1e-5, 1e-12)]


if __name__ == "__main__":
    sys.exit(main(codes()))
