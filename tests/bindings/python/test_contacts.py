# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts from NumPy: forms of input, answers, errors."""

import dataclasses
import signal
import subprocess
import sys
import threading
import unittest
from pathlib import Path

import numpy as np
from hypothesis import given, seed, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import tangency
from sample import BALL, NAMES, Refusals, drawn, near


def same(left, right):
    return all(np.array_equal(one, other) for (_, one), (_, other) in zip(left, right, strict=True))


class FormsOfInput(unittest.TestCase):
    def setUp(self):
        self.a, self.b = drawn(300, 1), drawn(300, 2)
        self.expected = tangency.contacts(self.a, self.b)

    def test_pairs_beyond_a_cutoff_have_a_lower_bound_and_others_do_not_notice(self):
        limited = tangency.contacts(self.a, self.b, up_to=0.1)
        beyond = limited.status == tangency.Status.beyond
        self.assertTrue(beyond.any() and not beyond.all())
        self.assertTrue((limited.gap[beyond] > 0.1).all())
        self.assertTrue((limited.gap[beyond] <= (self.expected.gap + self.expected.gap_error)[beyond]).all())
        self.assertTrue(np.isinf(limited.gap_error[beyond]).all() and not limited.normal[beyond].any())
        for (_, one), (_, other) in zip(limited, self.expected, strict=True):
            np.testing.assert_array_equal(one[~beyond], other[~beyond])
        derivatives = tangency.gap_derivatives(limited, self.a, self.b)
        self.assertTrue((derivatives.status[beyond] == tangency.DerivativeStatus.degenerate).all())

    def check(self, a, b, **options):
        self.assertTrue(same(tangency.contacts(a, b, **options), self.expected))

    def test_lists_arrays_and_any_stride_of_rows_have_the_same_answers(self):
        self.check(self.a.tolist(), self.b.tolist())
        wide = np.full((600, 13), np.nan)
        wide[::2, 1:11] = self.a
        self.check(wide[::2, 1:11], self.b)
        self.check(self.a[::-1].copy()[::-1], self.b, threads=2)
        self.check(np.asfortranarray(self.a), self.b)

    def test_structured_arrays_and_data_frames_are_read_by_the_names_of_the_file_formats(self):
        grains = np.zeros(300, [("id", "i4"), ("mass", "f4"), *((name, "f8") for name in NAMES)])
        scattered = np.zeros(300, [("b." + name, "f8") for name in reversed(NAMES)])
        for k, name in enumerate(NAMES):
            grains[name] = self.a[:, k]
            scattered["b." + name] = self.b[:, k]
        self.check(grains, scattered)

        class Frame:  # what of pandas.DataFrame is asked for; pandas_check.py has a true one
            def __init__(self, columns):
                self.columns = list(columns)
                self.table = columns

            def __len__(self):
                return 300

            def __getitem__(self, name):
                return self.table[name]

            def to_numpy(self):
                raise AssertionError

        self.check(Frame({"a." + name: self.a[:, k] for k, name in enumerate(NAMES)}), self.b)

    def test_a_row_of_a_structured_array_is_read_by_its_names(self):
        table = np.zeros(2, [("id", "i4"), *((name, "f8") for name in reversed(NAMES))])
        for k, name in enumerate(NAMES):
            table[name] = self.a[:2, k]
        self.assertEqual(tangency.contact(table[0], table[1]).gap, tangency.contact(self.a[0], self.a[1]).gap)
        many = tangency.contacts(table[0], self.b)
        self.assertTrue(same(many, tangency.contacts(self.a[0], self.b)))
        with self.assertRaisesRegex(tangency.TangencyError, "^b: there is no column x or b.x$"):
            tangency.contact(table[0], table[["y", "z"]][1])

    def test_empty_lists_are_no_rows(self):
        for a, b in (([], []), (self.a[:1], []), ([], self.b[:1])):
            self.assertEqual(len(tangency.contacts(a, b)), 0)
        for none in (tangency.Bodies([]), tangency.neighbours([]), tangency.points([], [])):
            self.assertEqual(len(none), 0)

    def test_bodies_without_a_quaternion_are_not_turned(self):
        rows = drawn(5, 3)
        rows[:, 6:] = [1, 0, 0, 0]
        short = np.zeros(5, [(name, "f8") for name in NAMES[:6]])
        for k, name in enumerate(NAMES[:6]):
            short[name] = rows[:, k]
        self.assertTrue(same(tangency.contacts(short, self.b[:5]), tangency.contacts(rows, self.b[:5])))

    def test_float32_rows_mean_their_values(self):
        a, b = self.a.astype(np.float32), self.b.astype(np.float32)
        self.assertTrue(same(tangency.contacts(a, b), tangency.contacts(a.astype(float), b.astype(float))))

    def test_pairs_name_rows_of_both_arrays_or_of_one(self):
        pairs = np.stack([np.arange(300)[::-1], np.arange(300)[::-1]], 1)
        found = tangency.contacts(self.a, self.b, pairs)
        np.testing.assert_array_equal(found.gap, self.expected.gap[::-1])
        joined = np.vstack([self.a, self.b])
        self.assertTrue(same(tangency.contacts(joined, pairs=pairs + [0, 300]), found))
        bodies = tangency.Bodies(joined)
        self.assertTrue(same(tangency.contacts(bodies, pairs=pairs + [0, 300]), found))
        self.assertTrue(same(tangency.contacts(bodies), self.expected))

    def test_one_row_stands_for_many(self):
        many = tangency.contacts(self.a[:1].repeat(300, 0), self.b)
        self.assertTrue(same(tangency.contacts(self.a[0], self.b), many))
        self.assertTrue(same(tangency.contacts(self.a[:1], self.b, columns=[n for n, _ in many]), many))
        np.testing.assert_array_equal(tangency.overlaps(self.a[0], self.b), many.gap < 0)

    def test_separations_stand_for_those_of_the_centres(self):
        found = tangency.contacts(self.a, self.b, separations=np.full((300, 3), [9.0, 0, 0]))
        moved = self.b.copy()
        moved[:, :3] = self.a[:, :3] + [9, 0, 0]
        np.testing.assert_allclose(found.gap, tangency.contacts(self.a, moved).gap, rtol=0, atol=1e-13)


class Answers(unittest.TestCase):
    def test_a_single_pair_is_the_pair_of_many_to_the_bit(self):
        a, b = drawn(50, 4), drawn(50, 5)
        many = tangency.contacts(a, b)
        for k in range(50):
            one = tangency.contact(a[k], b[k].tolist())
            for name in ("gap", "gap_error", "normal", "arm_a", "arm_b", "point", "status", "tier"):
                np.testing.assert_array_equal(getattr(one, name), getattr(many, name)[k])
            self.assertIsInstance(one.status, tangency.Status)

    def test_answers_of_one_call_are_not_those_of_the_next(self):
        first = tangency.contact(BALL, [3.0, *BALL[1:]])
        normal = first.normal.copy()
        tangency.contact(BALL, [0.0, 3, *BALL[2:]])
        np.testing.assert_array_equal(first.normal, normal)

    def test_columns_are_those_that_are_asked_for(self):
        found = tangency.contacts(drawn(3, 6), drawn(3, 7), columns=["gap", "normal_bound"])
        self.assertEqual([name for name, _ in found], ["gap", "normal_bound"])
        once = tangency.contacts(drawn(3, 6).astype(np.float32), drawn(3, 7), columns=iter(["gap"]))
        self.assertEqual([name for name, _ in once], ["gap"])
        with self.assertRaisesRegex(AttributeError, "normal was not asked for"):
            found.normal
        with self.assertRaisesRegex(tangency.TangencyError, "columns: 'depth': must be of gap"):
            tangency.contacts(drawn(3, 6), drawn(3, 7), columns=["depth"])

    def test_results_are_data_classes_and_flatten(self):
        found = tangency.contacts(drawn(3, 6), drawn(3, 7))
        self.assertIn("normal", [each.name for each in dataclasses.fields(found)])
        flat = found.flat()
        np.testing.assert_array_equal(flat["normal_y"], found.normal[:, 1])
        self.assertTrue(all(column.shape == (3,) for column in flat.values()))
        self.assertEqual(set(found.names("status")), {"ok"})
        self.assertEqual(list(tangency.contacts(np.empty((0, 10)), np.empty((0, 10))).flat()), list(flat))

    def test_flat_columns_are_named_by_axes_bodies_or_places(self):
        near = tangency.neighbours([BALL, BALL]).flat()
        for name in ("pairs_a", "pairs_b", "images_2", "normal_z", "separation_x", "gap"):
            self.assertIn(name, near)
        self.assertEqual((near["pairs_a"][0], near["pairs_b"][0]), (0, 1))
        met = tangency.rays([BALL], [0, 0, -5, 0, 0, 1])
        self.assertEqual([met.flat()[name][0] for name in ("t_0", "t_1")], met.t[0].tolist())
        self.assertEqual(met.flat()["arm_1_z"][0], met.arm[0, 1, 2])
        pair = drawn(1, 6), drawn(1, 7)
        found = tangency.contacts(*pair)
        curved = tangency.contact_curvatures(found, *pair)
        flat = curved.flat()
        self.assertEqual([name for name in flat if name.startswith("a")],
                         ["a_0", "a_1", *(f"a_directions_{k}_{axis}" for k in (0, 1) for axis in "xyz")])
        self.assertEqual(flat["a_directions_1_x"][0], curved.a_directions[0, 1, 0])
        derivatives = tangency.gap_derivatives(found, *pair)
        self.assertEqual(derivatives.flat()["hessian_3_17"][0], derivatives.hessian[0, 3, 17])
        plane = tangency.plane_contacts([[0, 0, 2, 1, 1, 0]], [[1, 0, 2, 1, 0, 1]], columns=None)
        self.assertEqual(plane.flat()["crossing_arms_3_y"][0], plane.crossing_arms[0, 3, 1])
        self.assertEqual(plane.flat()["chord_normal_y"][0], plane.chord_normal[0, 1])

    def test_out_is_written_over(self):
        out = tangency.contacts(drawn(9, 8), drawn(9, 9))
        again = tangency.contacts(drawn(9, 10), drawn(9, 11), out=out)
        self.assertIs(again, out)
        self.assertTrue(same(out, tangency.contacts(drawn(9, 10), drawn(9, 11))))

    def test_out_with_bounds_is_written_over(self):
        pair = drawn(9, 10), drawn(9, 11)
        for names in (["gap", "arm_a_bound"], ["arm_b_bound", "gap"], ["normal_bound"]):
            out = tangency.contacts(drawn(9, 8), drawn(9, 9), columns=names)
            tangency.contacts(*pair, out=out)
            self.assertTrue(same(out, tangency.contacts(*pair, columns=names)))

    def test_a_single_pair_may_be_asked_about_while_another_is_converted(self):
        class Lazy:
            def __init__(self, row):
                self.row = row

            def __len__(self):
                return 10

            def __array__(self, dtype=None, copy=None):
                tangency.contact([50.0, *BALL[1:]], [99.0, *BALL[1:]])
                return np.array(self.row)

        class Item(float):
            def __float__(self):
                tangency.contact([50.0, *BALL[1:]], [99.0, *BALL[1:]])
                return float.__float__(self)

        other = [5.0, *BALL[1:]]
        for b in (Lazy(other), [Item(value) for value in other]):
            self.assertEqual(tangency.contact(BALL, b).gap, 3.0)

    def test_a_single_pair_may_be_asked_about_in_a_signal_handler(self):
        # A signal may arrive between any two steps of a call: here one does at each.
        def ask(*_):
            tangency.contact([50.0, *BALL[1:]], [99.0, *BALL[1:]])

        previous = signal.signal(signal.SIGUSR1, ask)
        trace = sys.gettrace()

        def step(frame, event, argument):
            frame.f_trace_opcodes = True
            if frame.f_code is tangency.contact.__code__ and event == "opcode":
                sys.settrace(None)
                signal.raise_signal(signal.SIGUSR1)
                sys.settrace(step)
            return step

        try:
            for x in (2.5, 3.0, 4.0):
                sys.settrace(step)
                found = tangency.contact(BALL, [x, *BALL[1:]])
                sys.settrace(trace)
                self.assertEqual(found.gap, x - 2)
                self.assertEqual(found.normal.tolist(), [1, 0, 0])
        finally:
            sys.settrace(trace)
            signal.signal(signal.SIGUSR1, previous)

    def test_previous_normals_are_followed(self):
        a, b = drawn(40, 12), drawn(40, 13)
        bodies = tangency.Bodies(np.vstack([a, b]))
        found = tangency.contacts(bodies)
        again = tangency.contacts(bodies, previous_normals=found.normal)
        near = found.status == tangency.Status.ok
        np.testing.assert_allclose(again.gap[near], found.gap[near], rtol=0, atol=1e-12)

    @seed(21)
    @settings(max_examples=60, deadline=None, database=None)
    @given(arrays.arrays(np.float64, (4, 20), elements=st.floats(0.125, 8, width=32)))
    def test_exchange_and_scaling_by_a_power_of_two(self, numbers):
        a, b = numbers[:, :10], numbers[:, 10:]
        found, exchanged = tangency.contacts(a, b), tangency.contacts(b, a)
        scale = np.array([4.0] * 6 + [1.0] * 4)
        scaled = tangency.contacts(a * scale, b * scale)
        both = found.gap_error + exchanged.gap_error
        proven = (found.status == 0) & (exchanged.status == 0)
        self.assertTrue(np.all(np.abs(found.gap - exchanged.gap)[proven] <= both[proven]))
        proven = (found.status == 0) & (scaled.status == 0)
        self.assertTrue(np.all(np.abs(4 * found.gap - scaled.gap)[proven]
                               <= (4 * found.gap_error + scaled.gap_error)[proven]))
        np.testing.assert_array_equal(found.gap < 0, tangency.overlaps(a, b))


class Errors(Refusals):
    def test_of_rows_name_argument_row_field_value_and_rule(self):
        good, bad = drawn(10, 14), drawn(10, 15)
        bad[7, 4] = -1
        rule = "row 7: r2 = -1: a semi-axis must be finite and > 0"
        self.refused("a: " + rule, 7, tangency.contacts, bad, good)
        self.refused("b: " + rule, 7, tangency.contacts, good, bad)
        self.refused("b: " + rule, 7, tangency.contacts, good, bad, np.array([[0, 0]]))
        self.refused("rows: " + rule, 7, tangency.Bodies, bad)
        self.refused("bodies: " + rule, 7, tangency.neighbours, bad)
        self.refused("b: row 0: r2 = -1: a semi-axis must be finite and > 0", 0, tangency.contact, good[0], bad[7])

    def test_of_shapes_and_pairs(self):
        rows = drawn(4, 16)
        names = "x y z r1 r2 r3 qw qx qy qz"
        self.refused(f"a: shape (4, 9): must be (N, 10), the columns {names}", None, tangency.contacts, rows[:, :9],
                     rows)
        self.refused("b: 3 rows: must be 4, as many as of a", None, tangency.contacts, rows, rows[:3])
        self.refused("pairs: row 1: b = 4: must be below 4, the number of bodies", 1, tangency.contacts, rows,
                     pairs=[[0, 1], [2, 4]])
        self.refused("pairs: row 0: -1: must be an index from 0", 0, tangency.contacts, rows, pairs=[[-1, 1]])
        self.refused("pairs: row 0: a = 5: must be below 4, the number of bodies", 0, tangency.contacts, rows, rows,
                     [[5, 1]])
        self.refused("pairs: numbers of type float64: must be integers", None, tangency.contacts, rows,
                     pairs=[[0.5, 1]])
        self.refused(f"a: shape (1,): must be (10,), the numbers {names}", None, tangency.contact, [1.0], rows[0])
        self.refused("accuracy = 'best': must be standard, certified, fast, or a length", None, tangency.contacts,
                     rows, rows, accuracy="best")
        self.refused("up_to = -1: must be >= 0", None, tangency.contacts, rows, rows, up_to=-1.0)
        self.refused("separations: row 2: z = nan: must be finite", 2, tangency.contacts, rows, rows,
                     separations=[[1, 1, 1], [1, 1, 1], [1, 1, np.nan], [1, 1, 1]])
        self.refused("a: row 2: 9 numbers: must be 10, as many as of row 0", 2, tangency.contacts,
                     [BALL, BALL, BALL[:9]], rows[:3])
        self.refused("b: row 1: 1 numbers: must be 10, as many as of row 0", 1, tangency.relations, rows[:2], (BALL, 7))
        for ask in (tangency.contacts, tangency.relations):
            for columns in ("gap", b"gap", 3):
                self.refused(f"columns = {columns!r}: must be a list of names, as ['gap']", None, ask, rows, rows,
                             columns=columns)
        broken = np.zeros(2, [(name, "f8") for name in NAMES if name != "r3"])
        self.refused("a: there is no column r3", None, tangency.contacts, broken, rows[:2])


class Memory(unittest.TestCase):
    def test_rows_are_read_where_they_are(self):
        from tangency._bodies import NAMES as FORMS
        from tangency._bodies import rows_of
        names = FORMS[tangency.Form.axes]
        rows = drawn(100, 17)
        structured = rows.view([(name, "f8") for name in NAMES])[:, 0]
        for given_rows in (rows, rows[::3], rows[::-1], structured, rows.astype(np.float32)):
            self.assertTrue(np.shares_memory(rows_of(given_rows, names, "a"), given_rows))

    def test_a_call_takes_no_memory_but_that_of_its_answers(self):
        # In a process of its own, whose largest size is not that of an earlier test. 200,000 rows are 16 MB.
        code = """
import resource
import numpy as np
import tangency
from sample import near
size = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # kB
some_a, some_b = near(1000, 18)
a, b = np.empty((200_000, 10)), np.empty((200_000, 10))
for k in range(200):
    a[1000 * k:1000 * k + 1000], b[1000 * k:1000 * k + 1000] = some_a, some_b
out = tangency.contacts(some_a, some_b, columns=["gap"])
before = size()
out = tangency.contacts(a, b, columns=["gap"])  # 1.6 MB
print(size() - before)
"""
        done = subprocess.run([sys.executable, "-c", code], cwd=Path(__file__).parent, stdout=subprocess.PIPE, text=True,
                              check=True)
        self.assertLess(int(done.stdout), 8_000)


class Threads(unittest.TestCase):
    def test_single_pairs_of_threads_are_their_own(self):
        wrong, interval = [], sys.getswitchinterval()

        def ask(x):
            for _ in range(1000):
                if tangency.contact(BALL, [x, *BALL[1:]]).gap != x - 2:
                    wrong.append(x)

        sys.setswitchinterval(1e-6)  # s: threads change places within calls
        try:
            threads = [threading.Thread(target=ask, args=(x,)) for x in (3.0, 4.0, 5.0, 6.0)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        finally:
            sys.setswitchinterval(interval)
        self.assertEqual(wrong, [])

    def test_another_thread_runs_during_a_call(self):
        # It sees a call that has begun to answer and has not ended: impossible where the lock is held. A
        # machine that is busy may let a whole call pass before this thread's turn; then there is another.
        a, b = (np.tile(rows, (100, 1)) for rows in near(1000, 19))
        out = tangency.contacts(a, b, columns=["gap"])
        seen, ended = threading.Event(), threading.Event()

        def watch():
            while not seen.is_set() and not ended.is_set():
                if not np.isnan(out.gap[0]) and np.isnan(out.gap[-1]):
                    seen.set()

        watcher = threading.Thread(target=watch)
        watcher.start()
        for _ in range(30):
            out.gap[:] = np.nan
            tangency.contacts(a, b, out=out)
            if seen.is_set():
                break
        ended.set()
        watcher.join()
        self.assertTrue(seen.is_set())


if __name__ == "__main__":
    unittest.main()
