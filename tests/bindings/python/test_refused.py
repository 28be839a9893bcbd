# SPDX-License-Identifier: GPL-3.0-or-later
"""What is refused before the library is called: it would write past an array, or take other numbers than were given."""

import copy
import pickle
import unittest

import numpy as np

import tangency
from sample import BALL, NAMES, Refusals, drawn


class Out(Refusals):
    """An earlier answer whose columns are not as they were made."""

    def setUp(self):
        self.a, self.b = drawn(4, 51), drawn(4, 52)

    def found(self, **columns):
        out = tangency.contacts(self.a, self.b)
        for name, array in columns.items():
            setattr(out, name, array)
        return out

    def refused_out(self, message, out, **options):
        pairs = np.stack([np.arange(4), np.arange(4)], 1)
        self.refused(message, None, tangency.contacts, self.a, self.b, out=out, **options)
        self.refused(message, None, tangency.contacts, self.a, self.b, pairs, out=out, **options)

    def test_of_another_question(self):
        self.refused_out("out: Relations: must be Contacts", tangency.relations(self.a, self.b))
        self.refused_out("out: dict: must be Contacts", {"gap": np.zeros(4)})

    def test_of_another_shape_or_type(self):
        rule = "must be (4, 3), by the number of pairs"
        self.refused_out(f"out.normal: shape (4,): {rule}", self.found(normal=np.zeros(4)))
        self.refused_out(f"out.normal: shape (1, 3): {rule}", self.found(normal=np.zeros((1, 3))))
        self.refused_out("out.gap: shape (3,): must be (4,), by the number of pairs",
                         tangency.contacts(self.a[:3], self.b[:3]))
        self.refused_out("out.gap: numbers of type float32: must be float64", self.found(gap=np.zeros(4, np.float32)))
        self.refused_out("out.status: numbers of type int64: must be int32", self.found(status=np.zeros(4, np.int64)))
        self.refused_out("out.gap: numbers of type >f8: must be float64", self.found(gap=np.zeros(4, ">f8")))
        self.refused_out("out.gap: list: must be an array", self.found(gap=[0.0] * 4))

    def test_of_memory_that_is_not_its_own_rows(self):
        rule = "out.gap: must be C-contiguous, writeable and aligned"
        wide = np.arange(8.0)
        self.refused_out(rule, self.found(gap=wide[::2]))
        np.testing.assert_array_equal(wide, np.arange(8.0))
        fixed = np.zeros(4)
        fixed.flags.writeable = False
        self.refused_out(rule, self.found(gap=fixed))
        np.testing.assert_array_equal(fixed, 0)
        self.refused_out(rule, self.found(gap=np.zeros(33, np.uint8)[1:].view(np.float64)))

    def test_with_columns(self):
        self.refused_out("columns: must be None where out is given: its columns are written", self.found(),
                         columns=["gap"])

    def test_statuses_of_other_pairs(self):
        found = self.found(status=np.zeros(1, np.int32))
        self.refused("found.status: shape (1,): must be (4,)", None, tangency.gap_derivatives, found, self.a, self.b)


class Copies(unittest.TestCase):
    def test_bodies_and_ellipses_are_not_copied(self):
        for made in (tangency.Bodies([BALL]), tangency.Ellipses([[0, 0, 1, 1, 1, 0]])):
            for ask in (copy.copy, copy.deepcopy, pickle.dumps):
                with self.assertRaisesRegex(TypeError, f"^{type(made).__name__} cannot be copied or pickled"):
                    ask(made)
            self.assertEqual(len(made), 1)


class Kinds(Refusals):
    """Arrays whose numbers are not real, or not all there."""

    def test_of_numbers(self):
        rows = drawn(3, 53)
        for given, kind in ((rows + 0j, "complex128"), (rows.astype(str), "<U32"), (rows.astype(object), "object")):
            message = f"numbers of type {kind}: must be real numbers"
            self.refused(f"a: {message}", None, tangency.contacts, given, rows)
            self.refused(f"b: {message}", None, tangency.relations, rows, given)
            self.refused(f"rows: {message}", None, tangency.Bodies, given)
            self.refused(f"walls: {message}", None, tangency.walls, rows, given[:, :4])
            self.refused(f"rays: {message}", None, tangency.rays, rows, given[:, :6])
        self.refused("a: numbers of type <U10: must be real numbers", None, tangency.contact, "1234567890", BALL)
        self.refused("b: numbers of type <U1: must be real numbers", None, tangency.contact, BALL, list("1234567890"))
        self.refused("b: numbers of type complex128: must be real numbers", None, tangency.contact, BALL, [1j] * 10)
        self.refused("b: numbers of type object: must be real numbers", None, tangency.contact, BALL, [10**400] * 10)
        self.refused("a: shape (10, 1): must be (10,), the numbers x y z r1 r2 r3 qw qx qy qz", None,
                     tangency.contact, [[1.0]] * 10, BALL)
        self.assertEqual(tangency.contact([int(value) for value in BALL], (3, *BALL[1:])).gap, 1)

    def test_of_masked_arrays(self):
        rows = np.ma.array(drawn(3, 54))
        self.assertEqual(len(tangency.contacts(rows, rows)), 3)  # none is masked
        rows[2, 4] = np.ma.masked
        message = "row 2: masked: must be a number"
        self.refused(f"a: {message}", 2, tangency.contacts, rows, rows.data)
        self.refused(f"rows: {message}", 2, tangency.Bodies, rows)
        self.refused(f"points: {message}", 2, tangency.points, rows.data, rows[:, 3:6])
        self.refused("b: row 4: masked: must be a number", 4, tangency.contact, BALL, rows[2])
        table = np.ma.zeros(3, [(name, "f8") for name in NAMES])
        for k, name in enumerate(NAMES):
            table[name] = rows.data[:, k]
        self.assertEqual(len(tangency.Bodies(table)), 3)
        table["r2"][1] = np.ma.masked
        self.refused("rows: column r2: row 1: masked: must be a number", 1, tangency.Bodies, table)

    def test_of_columns_of_tables(self):
        table = np.zeros(2, [(name, "U3" if name == "y" else "f8") for name in NAMES])
        self.refused("rows: column y: numbers of type <U3: must be real numbers", None, tangency.Bodies, table)

    def test_bodies_in_place_of_rows(self):
        rows = drawn(2, 55)
        self.refused("b: Bodies: must be rows; append() joins two arrays", None, tangency.contacts, rows,
                     tangency.Bodies(rows))


class Numbers(Refusals):
    """Arguments that are single numbers: each is named, with its value and what it must be."""

    def test_of_threads(self):
        rows = drawn(2, 56)
        limits = "must be an integer from -2147483648 to 2147483647"
        for value in (None, 2**31, -2**40, 1.5, "2"):
            for ask in (tangency.contacts, tangency.overlaps, tangency.relations, tangency.overlaps_by_filter):
                self.refused(f"threads = {value!r}: {limits}", None, ask, rows, rows, threads=value)
            self.refused(f"threads = {value!r}: {limits}", None, tangency.neighbours, rows, threads=value)

    def test_of_real_numbers(self):
        rows = drawn(2, 57)
        real = "must be a real number of double precision"
        for value in (None, "1", 1j, np.complex64(1), 10**400):
            self.refused(f"tolerance = {value!r}: {real}", None, tangency.common_volumes, rows, rows, tolerance=value)
            self.refused(f"level = {value!r}: {real}", None, tangency.Bodies, rows, level=value)
            self.refused(f"reach = {value!r}: {real}", None, tangency.neighbours, rows, value)
            self.refused(f"confidence = {value!r}: {real}", None, tangency.level_of_confidence, value)
            self.refused(f"accuracy = {value!r}: must be standard, certified, fast, or a length", None,
                         tangency.contacts, rows, rows, accuracy=value)
            self.refused(f"horizon = {value!r}: {real}", None, tangency.times_of_contact, rows, np.zeros((2, 9)),
                         [[0, 1]], value, 1)
        self.assertEqual(len(tangency.common_volumes(rows, rows, tolerance=np.float32(0.5))), 2)

    def test_of_places(self):
        bodies = tangency.Bodies(drawn(2, 58))
        for value in (-1, None, 0.5):
            message = rf"^first = {value}: must be an integer from 0 to \d+$"
            with self.assertRaisesRegex(tangency.TangencyError, message):
                bodies.set([BALL], value)

    def test_of_enumerations(self):
        rows = drawn(2, 59)
        forms = "must be of Form.axes, Form.shape, Form.precision, Form.vectors, Form.quadric"
        for value in (9, None, 1.0, tangency.PlaneForm.direction):
            self.refused(f"form = {value!r}: {forms}", None, tangency.Bodies, rows, value)
        answers = ", ".join(f"NeighbourAnswers.{each.name}" for each in tangency.NeighbourAnswers)
        self.refused(f"answers = 'gaps': must be of {answers}", None, tangency.neighbours, rows, answers="gaps")
        with self.assertRaisesRegex(tangency.TangencyError, "^definition = 9: must be of Definition.perram_wertheim, "):
            tangency.other_gaps(9, rows, rows)


if __name__ == "__main__":
    unittest.main()
