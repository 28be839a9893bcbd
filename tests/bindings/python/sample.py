# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python package share."""

import unittest

import numpy as np

import tangency

NAMES = ["x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"]
BALL = [0.0, 0, 0, 1, 1, 1, 1, 0, 0, 0]


def drawn(count, seed, box=2.0):
    """Bodies of aspect ratios to 4, most of which meet some others."""
    generator = np.random.default_rng(seed)
    rows = np.empty((count, 10))
    rows[:, :3] = generator.uniform(-box, box, (count, 3))
    rows[:, 3:6] = generator.uniform(0.5, 2, (count, 3))
    rows[:, 6:] = generator.normal(size=(count, 4))
    return rows


def near(count, seed):
    """Pairs of bodies that touch or nearly do: what the library is quick at."""
    a, b = drawn(count, seed), drawn(count, seed + 1)
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    b[:, :3] = a[:, :3] + 2.2 * directions / np.linalg.norm(directions, axis=1)[:, np.newaxis]
    return a, b


class Refusals(unittest.TestCase):
    """Tests of what is refused: by which message, and of which row."""

    def refused(self, message, row, ask, *arguments, **options):
        with self.assertRaises(tangency.TangencyError) as caught:
            ask(*arguments, **options)
        self.assertEqual(str(caught.exception), message)
        self.assertEqual(caught.exception.row, row)
