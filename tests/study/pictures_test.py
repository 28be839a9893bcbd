#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the study's pictures: means and bands, slopes, charts, directions as surfaces, bodies.

Usage: pictures_test.py DEM_STUDY TANGENCY_DEM
Needs gnuplot.
"""
import csv
import itertools
import math
import os
import random
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path[:0] = [os.path.abspath(sys.argv[1]), os.path.dirname(os.path.abspath(__file__))]

import charts  # noqa: E402
import directions  # noqa: E402
import figures_local  # noqa: E402
import figures_states  # noqa: E402
import made_up  # noqa: E402
import results  # noqa: E402
import series  # noqa: E402
from charts import Chart, Curve  # noqa: E402

NAN = math.nan


class Series(unittest.TestCase):
    def test_means_are_over_curves_of_other_abscissas(self):
        x, mean, low, high = series.mean_and_band([([0.0, 1.0], [0.0, 2.0]),
                                                   ([0.0, 0.3, 1.0], [1.0, 1.6, 3.0])])
        self.assertEqual((x[0], x[-1]), (0.0, 1.0))
        for a, m, least, most in zip(x, mean, low, high):
            self.assertAlmostEqual(m, 2 * a + 0.5, places=12)
            self.assertAlmostEqual(least, 2 * a, places=12)
            self.assertAlmostEqual(most, 2 * a + 1, places=12)

    def test_a_mean_is_never_of_one_curve_alone_at_the_end(self):
        curves = [([0.0, end], [k, k]) for k, end in enumerate((0.4, 0.395, 0.2))]
        x, mean, _, _ = series.mean_and_band(curves)
        self.assertEqual(x[-1], 0.395)
        self.assertEqual(mean[-1], 0.5)

    def test_one_curve_has_no_band_and_gaps_stay(self):
        x, mean, low, high = series.mean_and_band([([0, 1, 2], [5, NAN, 7]), ([0, 1], [NAN, NAN])])
        self.assertEqual((x, mean[0], mean[2], low, high), ([0, 1, 2], 5, 7, None, None))
        self.assertTrue(math.isnan(mean[1]))

    def test_what_goes_back_is_left_out(self):
        self.assertEqual(series.ascending([0, 1, 0.5, NAN, 2], [1, 2, 3, 4, 5]),
                         ([0, 1, 2], [1, 2, 5]))

    def test_values_beyond_the_ends_are_none(self):
        for x in (-0.1, 2.1):
            self.assertTrue(math.isnan(series.at([0.0, 2.0], [1.0, 3.0], x)))
        self.assertEqual(series.at([0.0, 2.0], [1.0, 3.0], 2.0), 3.0)
        self.assertEqual(series.at([0.0, 2.0], [1.0, 3.0], 0.5), 1.5)

    def test_slopes_are_those_of_lines_and_even_parabolas(self):
        x = [0.01 * k for k in range(101)]
        for slope in series.slope(x, [3.0 * a + 1.0 for a in x], 0.05):
            self.assertAlmostEqual(slope, 3.0, places=9)
        slopes = series.slope(x, [a * a for a in x], 0.105)
        for a, slope in list(zip(x, slopes))[6:-6]:
            self.assertAlmostEqual(slope, 2 * a, places=9)
        # Two points at the ends are too few.
        ends = series.slope([0.0, 1.0, 2.0], [0, 1, 2], 2.0)
        self.assertEqual([math.isnan(slope) for slope in ends], [True, False, True])

    def test_running_means_are_of_the_window_and_of_numbers_alone(self):
        means = series.running_mean([0, 1, 2, 3, 10], [1.0, 2.0, NAN, 5.0, 7.0], 2.5)
        self.assertEqual(means, [1.5, 1.5, 3.5, 5.0, 7.0])
        self.assertTrue(math.isnan(series.running_mean([0.0], [NAN], 1.0)[0]))

    def test_a_stage_begins_with_what_it_resumes_at_no_strain(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "history.csv")
            made_up.write_table(file, [{"stage": stage, "axial_strain": x, "volumetric_strain": x,
                                        "porosity": y}
                                       for stage, x, y in (("p30", 0.7, 0.1), ("p30", 0.8, 0.2),
                                                           ("shear", 0.1, 0.3),
                                                           ("shear", 0.2, ""))])
            table = series.Columns.of(file, "shear")
        self.assertEqual(table.column("axial_strain"), [0.0, 0.1, 0.2])
        self.assertEqual(table.column("volumetric_strain")[0], 0.0)
        self.assertEqual(table.column("porosity")[:2], [0.2, 0.3])
        self.assertTrue(math.isnan(table.column("porosity")[2]))
        self.assertTrue(all(map(math.isnan, table.column("no such column"))))
        self.assertEqual(table.column(lambda row: row["axial_strain"] + 1)[1], 1.1)
        self.assertTrue(math.isnan(table.column(lambda row: 1 / row["axial_strain"])[0]))


class Runs(unittest.TestCase):
    def test_runs_of_a_stem_are_by_seed_and_of_no_longer_stem(self):
        with tempfile.TemporaryDirectory() as out:
            for stem, seed in (("a-shear", 10), ("a-shear", 2), ("a-shear-slow", 1),
                               ("b-a-shear", 1)):
                made_up.write_run(out, stem, seed)
            found = results.Results(out).folders("a-shear")
            self.assertEqual([os.path.basename(f) for f in found], ["a-shear-s2", "a-shear-s10"])

    def test_averages_have_the_shape_that_the_history_has_at_their_cycle(self):
        with tempfile.TemporaryDirectory() as out:
            folder = made_up.write_run(out, "a", stage="grow")
            table = results.Results(out).table(folder, "micro")
            for x, elongation in zip(table.column("axial_strain"), table.column("elongation")):
                self.assertAlmostEqual(elongation, 1 + x, places=9)

    def test_a_strain_that_a_run_does_not_reach_is_lacking(self):
        with tempfile.TemporaryDirectory() as out:
            found = results.Results(out)
            folder = made_up.write_run(out, "a")
            self.assertAlmostEqual(found.value_at(folder, "porosity", 0.2), 0.26, places=9)
            self.assertEqual(found.take_lacking(), [])
            self.assertTrue(math.isnan(found.value_at(folder, "porosity", 0.5)))
            self.assertEqual(found.take_lacking(), ["a-s1 beyond a strain of 0.4"])

    def test_a_chain_goes_as_far_as_its_seed_has_it(self):
        with tempfile.TemporaryDirectory() as out:
            for stem, seed in (("a", 1), ("a", 2), ("b", 2), ("c", 1), ("c", 3)):
                made_up.write_run(out, stem, seed)
            chains = results.Results(out).seeds(("a", "b", "c"))
            self.assertEqual([[os.path.basename(folder) for folder in chain] for chain in chains],
                             [["a-s1"], ["a-s2", "b-s2"]])
            lines = results.Results(out).lines(("a", "b"), "axial_strain", "porosity")
            self.assertEqual([len(x) for x, _ in lines], [81, 2 * 81])


class Charts(unittest.TestCase):
    def drawn(self, chart):
        with tempfile.TemporaryDirectory() as folder:
            charts.draw([chart], folder)
            with open(os.path.join(folder, chart.key + ".svg"), encoding="utf-8") as file:
                svg = file.read()
            with open(os.path.join(folder, chart.key + ".csv"), encoding="utf-8") as file:
                return svg, list(csv.DictReader(file))

    def test_a_long_curve_keeps_its_peak_and_its_ends(self):
        y = [0.0] * 5000
        y[3217], y[100] = 9.0, -4.0
        thin = charts.thinned(Curve("c", list(range(5000)), y))
        self.assertLess(len(thin.x), 1.2 * charts.MOST_POINTS)
        self.assertEqual((max(thin.y), min(thin.y), thin.x[0], thin.x[-1]), (9.0, -4.0, 0, 4999))
        self.assertEqual(thin.x[thin.y.index(9.0)], 3217)

    def test_a_table_has_what_is_drawn(self):
        _, rows = self.drawn(Chart("k", "T", "x", "y",
                                   [Curve("one", [0, 1], [2, NAN], [1, NAN], [3, NAN]),
                                                        Curve("two", [0, 1], [5, 6])]))
        self.assertEqual([tuple(row.values()) for row in rows],
                         [("one", "0.0", "2.0", "1.0", "3.0"), ("one", "1.0", "", "", ""),
                          ("two", "0.0", "5.0", "", ""), ("two", "1.0", "6.0", "", "")])

    def test_texts_are_those_of_the_chart(self):
        svg, _ = self.drawn(Chart("k", "It's", "strain", "stress, MPa",
                                  [Curve("red", [0, 1], [2, 3]),
                                                                         Curve("blue", [0, 1],
                                                                               [3, 1])]))
        for text in ("It's", "strain", "stress, MPa", "red", "blue"):
            self.assertIn(text, svg.replace("&apos;", "'").replace("&#39;", "'"))

    def test_every_style_is_drawn(self):
        for style in charts.STYLES:
            svg, _ = self.drawn(Chart("k", "T", "x", "y",
                                      [Curve("c", [0, 1, 2], [2, 3, 1], [1, 2, 0],
                                                                 [3, 4, 2], "#123456", style)]))
            self.assertRegex(svg, r"rgb\( *18, *52, *86\)", style)

    def test_axes_keep_their_names_where_numbers_are_long(self):
        svg, _ = self.drawn(Chart("k", "T", "x", "height",
                                  [Curve("c", [0, 1], [1.23456e-5, 1.23457e-5])]))
        self.assertIn(">height<", svg)

    def test_values_that_hardly_differ_get_a_wide_axis(self):
        low, high = charts.heights_of(Chart("k", "T", "x", "y", [Curve("c", [0, 1], [5.0, 5.0])]))
        self.assertLess(low, 4.95)
        self.assertGreater(high, 5.05)
        chart = Chart("k", "T", "x", "y", [Curve("c", [0, 1], [5.0, 7.0])])
        self.assertEqual(charts.heights_of(chart), (None, None))

    def test_what_shows_nothing_is_not_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            charts.draw([Chart("k", "T", "x", "y", [Curve("c", [0], [NAN])])], folder)
            self.assertEqual(os.listdir(folder), [])


class Directions(unittest.TestCase):
    def test_areas_add_up_to_the_sphere(self):
        for n in (1, 2, 4, 5):
            areas = [directions.area_of(place, n) for place in directions.all_places(n)]
            self.assertEqual(len(areas), 24 * n * n)
            self.assertAlmostEqual(sum(areas), 4 * math.pi, places=12)
        # dem/micromechanics/sphere_partition.hpp: 1.278 for 4.
        areas = [directions.area_of(place, 4) for place in directions.all_places(4)]
        self.assertAlmostEqual(max(areas) / min(areas), 1.278, places=3)

    def test_the_middle_of_a_class_is_in_it(self):
        for n in (1, 3, 4):
            for place in directions.all_places(n):
                d = directions.direction_at(place, 0.5, 0.5, n)
                self.assertAlmostEqual(directions.dot(d, d), 1.0, places=12)
                self.assertEqual(directions.place_of(d, n), place)

    def test_patches_are_of_known_numbers_of_classes_alone(self):
        self.assertEqual(directions.patches_of(384), 4)
        for classes in (0, 23, 25, 648):
            self.assertRaises(ValueError, directions.patches_of, classes)

    def test_spikes_reach_as_far_as_their_values(self):
        places = directions.all_places(2)
        mesh = directions.spikes({places[0]: 3.0, places[1]: NAN, places[2]: 0.0, places[3]: 1.0},
                                 2)
        self.assertAlmostEqual(mesh.reach(), 3.0, places=12)
        self.assertEqual(len(mesh.triangles), 2 * (8 + 8))
        self.assertLess(max(max(t) for t in mesh.triangles), len(mesh.points))

    def test_a_smooth_surface_lies_where_its_function_says(self):
        def value(d):
            return 1.0 + 0.5 * d[2] * d[2]

        mesh = directions.smooth(value)
        for point in mesh.points:
            self.assertAlmostEqual(math.sqrt(directions.dot(point, point)),
                                   value(directions.unit(point)),
                                   places=12)

    def test_models_are_the_contractions_of_their_tensors(self):
        draw = random.Random(7)
        symmetric = {tuple(sorted(i)): draw.gauss(0, 1) for i in itertools.product(range(3),
                                                                                   repeat=4)}
        b = [[[[symmetric[tuple(sorted((i, j, k, m)))] for m in range(3)] for k in range(3)]
              for j in range(3)] for i in range(3)]
        a = [[draw.gauss(0, 1) for _ in range(3)] for _ in range(3)]
        for _ in range(20):
            n = directions.unit([draw.gauss(0, 1) for _ in range(3)])
            for fourth in (None, b):
                vector = [sum(a[i][j] * n[j] for j in range(3)) for i in range(3)]
                if fourth:
                    vector = [v + sum(b[i][j][k][m] * n[j] * n[k] * n[m] for j in range(3)
                                      for k in range(3) for m in range(3))
                              for i, v in enumerate(vector)]
                normal = directions.dot(vector, n)
                model = directions.Model(a, fourth)
                self.assertAlmostEqual(model.factor(n), 1.0 + normal, places=12)
                tangent = [v - normal * c for v, c in zip(vector, n)]
                self.assertAlmostEqual(model.tangential(n),
                                       math.sqrt(directions.dot(tangent, tangent)),
                                       places=9)


class Bodies(unittest.TestCase):
    def row(self, turn, axis):
        """A body turned by an angle about a unit axis."""
        s = math.sin(0.5 * turn)
        return {"qw": math.cos(0.5 * turn), "qx": s * axis[0], "qy": s * axis[1], "qz": s * axis[2],
                "r1": 3.0, "r2": 2.0, "r3": 1.0, "x": 10.0, "y": 20.0, "z": 30.0}

    def test_the_long_axis_is_body_axis_0(self):
        x, y, z = figures_states.long_axis(self.row(math.pi / 2, (0, 0, 1)))
        for value, wanted in zip((x, y, z), (0, 1, 0)):
            self.assertAlmostEqual(value, wanted, places=12)
        upright = figures_states.long_axis(self.row(-math.pi / 2, (0, 1, 0)))
        self.assertAlmostEqual(figures_states.inclination(upright), 0.0, places=5)
        self.assertAlmostEqual(figures_states.inclination((1, 0, 0)), 90.0, places=9)

    def test_a_body_is_its_axes_at_its_place(self):
        for axis, turned in (((0, 0, 1), (0, 3, 0, -2, 0, 0, 0, 0, 1)),
                             ((1, 0, 0), (3, 0, 0, 0, 0, 2, 0, -1, 0)),
                             ((0, 1, 0), (0, 0, -3, 0, 2, 0, 1, 0, 0))):
            text = figures_states.body(self.row(math.pi / 2, axis))
            matrix = [float(v) for v in text.split("<")[1].split(">")[0].split(",")]
            for value, wanted in zip(matrix, (*turned, 10, 20, 30)):
                self.assertAlmostEqual(value, wanted, places=4)

    def test_the_density_of_long_axes_adds_up_to_1(self):
        rows = made_up.bodies("particles")
        with tempfile.TemporaryDirectory() as folder:
            made_up.write_table(os.path.join(folder, "p.csv"), rows)
            values, n = figures_states.axes_of(series.Columns.of(os.path.join(folder, "p.csv")))
        self.assertAlmostEqual(sum(v * directions.area_of(p, n) for p, v in values.items()), 1.0,
                               places=12)


class ClosedForms(unittest.TestCase):
    """What the page draws without a run, against the numbers of the specification."""

    def test_shares_of_contact_vectors_by_length(self):
        # b/a = 0.7, a1 = 0.75: 0.5405 short; lengths beyond b + (a - b)/3.
        a, b = 1 / 0.7, 1.0
        length = b + (a - b) / 3
        beta = math.acos(math.sqrt((1 / b**2 - 1 / length**2) / (1 / b**2 - 1 / a**2)))
        self.assertAlmostEqual(1 - 2 * figures_local.cumulated(0.75, beta), 0.5405, places=4)
        self.assertAlmostEqual(1 - 2 * figures_local.area_share(a / b, beta), 0.5827, places=4)

    def test_both_laws_go_from_0_to_a_half_at_the_equator(self):
        for law in (lambda t: figures_local.cumulated(0.6, t),
                    lambda t: figures_local.area_share(1.4, t)):
            self.assertAlmostEqual(law(0.0), 0.0, places=12)
            self.assertAlmostEqual(law(math.pi / 2), 0.5, places=12)

    def test_the_largest_deviation(self):
        angles = [math.degrees(figures_local.deviation_of(1 / 0.7, math.radians(0.01 * k)))
                  for k in range(9001)]
        self.assertAlmostEqual(max(angles), 20.016, places=3)
        self.assertAlmostEqual(0.01 * angles.index(max(angles)), 34.99, places=1)
        self.assertAlmostEqual(angles[0] + angles[-1], 0.0, places=5)

    def test_anisotropy_by_arc_length(self):
        for ratio, wanted in ((1.1, 0.0478), (1 / 0.7, 0.18524), (2.0, 0.38987), (10.0, 1.4518)):
            self.assertAlmostEqual(figures_local.arc_anisotropy(ratio), wanted, places=4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
