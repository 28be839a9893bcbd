#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the study reads from histories, on histories that are made up.

Usage: measures_test.py DEM_STUDY TANGENCY_DEM
"""
import math
import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.abspath(sys.argv[1]))

import measures  # noqa: E402
from measures import Table, Test, Unmeasurable  # noqa: E402

NAMES = ["stage", "axial_strain", "volumetric_strain", "s_xx", "s_yy", "s_zz", "s_xy", "s_yz",
         "s_zx",
         "value"]
STEP = 0.0005


def strength(x):
    """A ratio that rises to a peak of 1.5 at 0.1 and softens to 1."""
    return 1.5 * x * (0.2 - x) / 0.01 if x <= 0.1 else 1.0 + 0.5 * math.exp(-((x - 0.1) / 0.05)**2)


def volume(x):
    """Dilates at a rate of 0.6 from 0.06 to 0.2, and neither before nor after."""
    return 0.6 * (min(x, 0.2) - min(x, 0.06))


def made_test(stretch=1.0, end=0.4):
    table = Table(NAMES, [])
    for k in range(round(end / STEP) + 1):
        x, p = k * STEP, 2e6
        deviator = strength(x) * p  # s1 - s3 of an axisymmetric state
        row = ["shear", x, volume(x), p - deviator / 3, p - deviator / 3, p + 2 * deviator / 3, 0.0,
               0.0,
               0.0, 10 * x]
        for name, cell in zip(NAMES, row):
            table.columns[name].append(cell)
    return Test(table, {"peak_friction_angle_deg": 36.9, "strain_at_peak_friction": 0.1}, stretch)


class TestOfATest(unittest.TestCase):
    def test_shear_stress_ratio_is_that_of_the_principal_stresses(self):
        test = made_test()
        self.assertAlmostEqual(test["a_s"][200], 1.5, places=12)
        table = Table(NAMES, [])
        for name, cell in zip(NAMES, ["s", 0, 0, 3.0, 3.0, 3.0, 1.0, 0.0, 0.0, 0]):
            table.columns[name].append(cell)
        # Principal stresses 4, 3, 2: sqrt(3/2) sqrt(2) / 3.
        self.assertAlmostEqual(measures.shear_stress_ratio(table)[0], math.sqrt(3.0) / 3.0,
                               places=12)

    def test_means_are_those_of_the_window(self):
        test = made_test()
        self.assertAlmostEqual(test.mean_at("value", 0.2), 2.0, places=9)
        self.assertAlmostEqual(test.last("value"), 10 * (0.4 - 0.005), places=9)
        self.assertEqual(test.start("value"), 0.0)

    def test_strains_are_in_proportion_to_the_tests_end(self):
        self.assertAlmostEqual(made_test(0.25, 0.1).mean_at("value", 0.2), 0.5, places=9)

    def test_slopes_are_those_of_lines(self):
        test = made_test()
        self.assertAlmostEqual(test.slope_at("value", 0.1, 0.01), 10.0, places=9)
        slope, at = test.peak_dilation(0.01)
        self.assertAlmostEqual(slope, 0.6, places=6)
        self.assertLess(at, 0.2)

    def test_windows_are_fully_there(self):
        x = [0.001 * k for k in range(21)]
        found = measures.sloping_windows(x, [2 * a for a in x], 0.01)
        self.assertEqual(len(found), len([b for b in x if b >= 0.009 - 1e-12]))
        for middle, slope in found:
            self.assertAlmostEqual(slope, 2.0, places=9)
            self.assertGreaterEqual(middle, 0.0045 - 1e-12)

    def test_points_are_by_their_rules(self):
        points = made_test().points
        # B: the slope 300 (0.1 - x) falls to a fifth of its largest at 0.08.
        self.assertAlmostEqual(points["B"], 0.08, delta=0.001)
        self.assertEqual(points["C"], 0.1)
        # D: a window of 0.05 whose slope is below 0.02 lies nearly past 0.2.
        self.assertTrue(0.2 < points["D"] < 0.23)
        self.assertFalse(points["D_is_last"])

    def test_a_volume_that_never_stays_ends_at_the_last_row(self):
        test = made_test(end=0.2)
        self.assertTrue(test.points["D_is_last"])
        self.assertEqual(test.points["D"], test.end)

    def test_correlation_and_what_cannot_be_measured(self):
        self.assertAlmostEqual(measures.correlation([1, 2, 3], [2, 4, 6]), 1.0)
        self.assertAlmostEqual(measures.correlation([1, 2, 3], [1, 0, 1]), 0.0)
        with self.assertRaises(Unmeasurable):
            measures.correlation([1, 2, 3], [1, 1, 1])
        with self.assertRaises(Unmeasurable):
            measures.least_squares_slope([1, 1], [1, 2])

    def test_a_missing_column_is_a_fault_and_an_empty_one_is_not(self):
        with self.assertRaises(KeyError):
            made_test().last("no such column")
        test = made_test()
        test.table.columns["value"] = [None] * len(test.strain)
        with self.assertRaises(Unmeasurable):
            test.last("value")

    def test_a_column_of_the_ratio_is_taken_as_it_is(self):
        test = made_test()
        test.table.columns["a_s"] = [7.0] * len(test.strain)
        self.assertEqual(test.start("a_s"), 7.0)


class TestOfATable(unittest.TestCase):
    def test_empty_cells_are_none_and_are_left_out_of_means(self):
        table = Table(["stage", "axial_strain", "x"],
                      [["a", "0", "1"], ["a", "0.001", ""], ["b", "0.002", "3"]])
        self.assertEqual(table["x"], [1.0, None, 3.0])
        self.assertEqual(Test(table, {}).mean_at("x", 0.001), 2.0)
        self.assertEqual(table.where(lambda k: table["stage"][k] == "b")["x"], [3.0])

    def test_tables_join_by_the_names_of_columns(self):
        one = Table(["stage", "x"], [["a", "1"]])
        other = Table(["x", "y", "stage"], [["2", "5", "b"]])
        both = one.joined(other)
        self.assertEqual((both["stage"], both["x"], both["y"]),
                         (["a", "b"], [1.0, 2.0], [None, 5.0]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
