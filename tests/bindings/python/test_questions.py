# SPDX-License-Identifier: GPL-3.0-or-later
"""The other questions from NumPy: shapes, and what is known of simple bodies."""

import math
import unittest

import numpy as np

import tangency
from sample import BALL, drawn


def ball(x, y=0.0, z=0.0, radius=1.0):
    return [x, y, z, radius, radius, radius, 1, 0, 0, 0]


class Pairs(unittest.TestCase):
    def test_relations_and_overlaps_of_balls(self):
        others = [ball(3), ball(2), ball(1), ball(0.5, radius=0.5), ball(0.25, radius=0.5), ball(0, radius=2), ball(0)]
        found = tangency.relations(BALL, others)
        self.assertEqual(found.names("relation"),
                         ["separate", "external_touch", "overlap", "internal_touch", "b_in_a", "a_in_b", "equal"])
        np.testing.assert_array_equal(tangency.overlaps(BALL, others), [False, False] + 5 * [True])
        filtered = tangency.overlaps_by_filter(BALL, others)
        known = filtered < 2
        np.testing.assert_array_equal(filtered[known] == 1, tangency.overlaps(BALL, others)[known])
        self.assertEqual(tangency.Relation(found.relation[2]), tangency.Relation.overlap)

    def test_bounded_gaps_enclose_the_gap(self):
        a, b = drawn(200, 31), drawn(200, 32)
        gap, bounded = tangency.contacts(a, b), tangency.bounded_gaps(a, b)
        proven = gap.status == 0
        self.assertTrue(np.all((bounded.gap - bounded.gap_error <= gap.gap + gap.gap_error)[proven]))
        self.assertTrue(np.all((gap.gap - gap.gap_error <= bounded.gap + bounded.above)[proven]))

    def test_numbers_of_balls(self):
        pair = [BALL], [ball(1.5)]
        factors = tangency.perram_wertheim_factors(*pair)
        self.assertAlmostEqual(factors.factor[0], (1.5 / 2) ** 2, 15)
        volume = tangency.common_volumes(*pair)
        lens = math.pi * (4 * 1 + 1.5) * (2 - 1.5) ** 2 / 12
        self.assertLessEqual(abs(volume.volume[0] - lens), volume.volume_error[0] + 1e-15)
        inside = tangency.containments([ball(0.25, radius=0.5)], [BALL])
        self.assertAlmostEqual(inside.clearance[0], 0.25, 15)
        self.assertAlmostEqual(inside.margin[0], 1.5, 15)
        found = tangency.contacts(*pair)
        derivatives = tangency.gap_derivatives(found, *pair)
        np.testing.assert_allclose(derivatives.gradient[0, 9:12], found.normal[0], atol=1e-14)
        self.assertEqual(derivatives.hessian.shape, (1, 18, 18))
        curved = tangency.contact_curvatures(found, *pair)
        np.testing.assert_allclose(curved.relative[0], [2, 2], atol=1e-13)
        for definition in tangency.Definition:
            other = tangency.other_gaps(definition, *pair)
            np.testing.assert_allclose(other.gap, [-0.5], atol=1e-13)

    def test_times_of_contact_of_balls_that_approach(self):
        rows = [BALL, ball(5)]
        motions = np.zeros((2, 9))
        motions[1, 0] = -2  # a gap of 3
        found = tangency.times_of_contact(rows, motions, [[0, 1]], 10, 1e-9)
        self.assertEqual(found.names("status"), ["contact"])
        self.assertTrue(found.time[0] <= 1.5 <= found.latest[0] <= found.time[0] + 1e-9)


class Meetings(unittest.TestCase):
    OTHERS = ((tangency.walls, 4), (tangency.points, 3), (tangency.balls, 4), (tangency.rays, 6))

    def test_of_walls_points_balls_and_rays(self):
        bodies = [ball(0), ball(0, 0, 3)]
        wall = tangency.walls(bodies, [0, 0, 2, -2])  # z <= -1
        np.testing.assert_allclose(wall.gap, [0, 3], atol=1e-15)
        self.assertEqual(wall.names("relation"), ["external_touch", "separate"])
        np.testing.assert_allclose(tangency.walls(bodies, [[0, 0, 1, 0.5]], sheets=True).gap, [-0.5, 1.5], atol=1e-15)
        point = tangency.points(bodies, [[0, 0, 0.5]])
        np.testing.assert_allclose(point.distance, [-0.5, 1.5], atol=1e-15)
        np.testing.assert_allclose(tangency.balls(bodies, [0, 0, 1.5, 0.25]).gap, [0.25, 0.25], atol=1e-15)
        ray = tangency.rays(bodies, [0, 0, -5, 0, 0, 1])
        np.testing.assert_array_equal(ray.count, [2, 2])
        np.testing.assert_allclose(ray.t, [[4, 6], [7, 9]], atol=1e-14)
        segment = tangency.rays(bodies, [[0, 0, -5, 0, 0, 1, 0, 5]], [[1, 0], [0, 0]])
        self.assertEqual(segment.names("status"), ["miss", "hit"])

    def test_one_against_none_is_no_pair(self):
        none, one = np.empty((0, 10)), np.array([BALL])
        for ask in (tangency.contacts, tangency.relations, tangency.overlaps, tangency.bounded_gaps,
                    tangency.common_volumes, tangency.containments, tangency.perram_wertheim_factors):
            self.assertEqual((len(ask(one, none)), len(ask(none, one)), len(ask(none, none))), (0, 0, 0))
        self.assertEqual(len(tangency.contacts(one, none, columns=["normal_bound"])), 0)
        for ask, width in self.OTHERS:
            self.assertEqual((len(ask(none, np.ones((1, width)))), len(ask(one, np.ones((0, width))))), (0, 0))

    def test_others_are_as_many_as_bodies_or_one(self):
        bodies = drawn(4, 41)
        for ask, width in self.OTHERS:
            for count in (3, 9, 0):
                with self.assertRaises(tangency.TangencyError) as caught:
                    ask(bodies, np.ones((count, width)))
                self.assertEqual(str(caught.exception), f"{ask.__name__}: {count} rows: must be 4, as many as of "
                                                        "bodies, or one, where no pairs are given")
            others = np.random.default_rng(42).normal(size=(4, width)) ** 2 + 0.5
            each, first = ask(bodies, others), ask(bodies, others[0])
            self.assertEqual((len(each), len(first), len(ask(bodies[0], others))), (4, 4, 4))
            for name, column in ask(bodies, others, [[2, 2], [3, 0]]):
                np.testing.assert_array_equal(column, [getattr(each, name)[2], getattr(first, name)[3]])

    def test_neighbours_in_a_lattice(self):
        rows = [ball(0.5), ball(2.5), ball(9.5)]
        found = tangency.neighbours(rows, edges=10 * np.eye(3))
        np.testing.assert_array_equal(found.pairs, [[0, 1], [0, 2]])
        np.testing.assert_array_equal(found.images, [[0, 0, 0], [-1, 0, 0]])
        np.testing.assert_allclose(found.gap, [0, -1], atol=1e-15)
        alone = tangency.neighbours(rows, edges=10 * np.eye(3), periodic=[False] * 3,
                                    answers=tangency.NeighbourAnswers.pairs)
        np.testing.assert_array_equal(alone.pairs, [[0, 1]])
        with self.assertRaises(AttributeError):
            alone.gap

    def test_columns_of_neighbours_are_those_that_are_asked_for_of_no_pairs_too(self):
        apart, near = [ball(0), ball(9)], [ball(0), ball(1)]
        numbers = []
        for answers in tangency.NeighbourAnswers:
            none, some = tangency.neighbours(apart, answers=answers), tangency.neighbours(near, answers=answers)
            self.assertEqual((len(none), len(some)), (0, 1))
            self.assertEqual([name for name, _ in none], [name for name, _ in some])
            for (_, empty), (_, array) in zip(none, some):
                self.assertEqual((empty.shape[1:], empty.dtype), (array.shape[1:], array.dtype))
            numbers.append(len(list(some)))
        self.assertEqual(numbers, [2, 3, 6, 10])
        some.gap[0] = 7  # an array of its own, as every other answer
        self.assertEqual(some.gap[0], 7)


class Forms(unittest.TestCase):
    def test_forms_of_the_same_ball_are_equal(self):
        covariance = [0, 0, 0, .25, .25, .25, 0, 0, 0]
        quadric = [1, 1, 1, 0, 0, 0, 0, 0, 0, -1]
        vectors = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]
        bodies = tangency.Bodies(covariance, tangency.Form.shape, 4.0)
        bodies.append(quadric, tangency.Form.quadric)
        bodies.append(vectors, tangency.Form.vectors)
        bodies.append([0, 0, 0, 4, 4, 4, 0, 0, 0], tangency.Form.precision, 4.0)
        bodies.append(BALL)
        self.assertEqual(len(bodies), 5)
        pairs = [[0, k] for k in range(1, 5)]
        self.assertEqual(tangency.relations(bodies, pairs=pairs).names("relation"), ["equal"] * 4)

    def test_bodies_move(self):
        bodies = tangency.Bodies([BALL, ball(3)])
        bodies.set([ball(2.5)], 1)
        self.assertAlmostEqual(tangency.contacts(bodies).gap[0], 0.5, 14)
        with self.assertRaisesRegex(tangency.TangencyError, "first = 2"):
            bodies.set([BALL], 2)


class Plane(unittest.TestCase):
    def test_circles(self):
        a = [[0, 0, 1, 1, 1, 0]] * 3
        b = [[1, 0, 1, 1, 1, 0], [2, 0, 1, 1, 0, 1], [0, 0, 0.5, 0.5, 1, 1]]
        found = tangency.plane_contacts(a, b, columns=None)
        self.assertEqual(found.names("relation"), ["overlap", "external_touch", "b_in_a"])
        np.testing.assert_array_equal(found.crossings, [2, 1, 0])
        np.testing.assert_allclose(found.gap, [-1, 0, -1.5], atol=1e-15)
        lens = 2 * math.pi / 3 - math.sqrt(3) / 2
        np.testing.assert_allclose(found.area, [lens, 0, math.pi / 4], atol=1e-14)
        self.assertEqual(found.crossing_arms.shape, (3, 4, 2))
        points = tangency.plane_points(a, [[3, 0], [0.5, 0], [0, 1]])
        np.testing.assert_allclose(points.distance, [2, -0.5, 0], atol=1e-15)

    def test_quadrics(self):
        found = tangency.classify([[1, 1, 1, 0, 0, 0, 0, 0, 0, -1], [0] * 9 + [1]])
        self.assertEqual(found.names("type"), ["real_ellipsoid", "no_points"])


class Library(unittest.TestCase):
    def test_it_tells_what_it_is(self):
        self.assertEqual(tangency.__version__, tangency.version())
        self.assertRegex(tangency.version(), r"^\d+\.\d+\.\d+$")
        self.assertGreater(len(tangency.instruction_set()), 2)
        from tangency._library import INSTALLED
        self.assertEqual(INSTALLED, "libtangency_c.so." + ".".join(tangency.version().split(".")[:2]))
        self.assertAlmostEqual(tangency.level_of_confidence(0.95, 2), -2 * math.log(0.05), 12)


if __name__ == "__main__":
    unittest.main()
