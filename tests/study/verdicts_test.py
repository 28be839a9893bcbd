#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars and verdicts of the study's rows, and that each row of the programme stands in the table.

Usage: verdicts_test.py DEM_STUDY TANGENCY_DEM
"""
import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.abspath(sys.argv[1]))

import verdicts  # noqa: E402
from measures import NotRun, Unmeasurable  # noqa: E402
from rows import all_rows  # noqa: E402
from verdicts import DOUBTFUL, NOT_REPRODUCED, NOT_RUN, REPORTED, REPRODUCED  # noqa: E402
from verdicts import Finding, Row, Sample  # noqa: E402


def verdict(met, **keys):
    row = Row("1", "s", "t", "p", "b", lambda study: Finding("1", met=met), **keys)
    return verdicts.evaluate(row, None).verdict


def fails(error):
    def find(_):
        raise error
    return verdicts.evaluate(Row("1", "s", "t", "p", "b", find), None)


class VerdictTest(unittest.TestCase):
    def test_a_bar_decides(self):
        self.assertEqual(verdict(True), REPRODUCED)
        self.assertEqual(verdict(False), NOT_REPRODUCED)
        self.assertEqual(verdict(None), REPORTED)

    def test_a_doubt_decides_only_where_the_bar_is_not_met(self):
        self.assertEqual(verdict(True, doubt="[C] x"), REPRODUCED)
        self.assertEqual(verdict(False, doubt="[C] x"), DOUBTFUL)
        self.assertEqual(verdict(None, doubt="[?] x"), DOUBTFUL)

    def test_a_corrected_statement_is_never_a_reproduction_of_the_text(self):
        self.assertEqual(verdict(True, doubt="[E2] x", corrected=True), DOUBTFUL)
        self.assertEqual(verdict(False, doubt="[E2] x", corrected=True), NOT_REPRODUCED)

    def test_missing_runs_and_faults_are_told_apart(self):
        self.assertEqual(fails(NotRun("some-run")).verdict, NOT_RUN)
        self.assertIn("some-run", fails(NotRun("some-run")).note)
        self.assertEqual(fails(Unmeasurable("no rows")).verdict, NOT_REPRODUCED)
        self.assertEqual(fails(KeyError("x")).verdict, verdicts.FAULT)


class BarTest(unittest.TestCase):
    def test_near_takes_its_edge_and_not_more(self):
        self.assertTrue(verdicts.near(Sample([1.06, 1.06]), 1.0, absolute=0.0600001).met)
        self.assertFalse(verdicts.near(Sample([1.07, 1.07]), 1.0, relative=0.06).met)
        self.assertFalse(verdicts.near(Sample([0.93, 0.93]), 1.0, relative=0.06).met)
        self.assertTrue(verdicts.near(Sample([1.0, 1.1]), 1.0, relative=0.06).met)

    def test_inside(self):
        self.assertTrue(verdicts.inside(Sample([2.0]), 1.0, 2.0).met)
        self.assertFalse(verdicts.inside(Sample([2.1]), 1.0, 2.0).met)

    def test_strict_order_refuses_equal_and_turned_values(self):
        def met(values, rising):
            return verdicts.order({str(k): Sample([v]) for k, v in enumerate(values)}, rising).met
        self.assertTrue(met([1, 2, 3], True))
        self.assertFalse(met([1, 2, 2], True))
        self.assertFalse(met([1, 3, 2], True))
        self.assertTrue(met([3, 2, 1], False))

    def test_order_within_the_scatter_of_a_seed(self):
        wide = {"a": Sample([1.0, 3.0]), "b": Sample([0.9, 2.9])}
        sharp = {"a": Sample([2.0, 2.001]), "b": Sample([1.9, 1.901])}
        self.assertTrue(verdicts.order(wide, True, within_scatter=True).met)
        self.assertFalse(verdicts.order(sharp, True, within_scatter=True).met)

    def test_sets_that_disagree_are_doubtful(self):
        sets = {"one": (1,), "two": (1, 2)}
        both = verdicts.on_sets(sets, lambda keys: Finding("x", met=True))
        some = verdicts.on_sets(sets, lambda keys: Finding("x", met=len(keys) == 1))
        none = verdicts.on_sets(sets, lambda keys: Finding("x", met=False))
        row = Row("1", "s", "t", "p", "b", None)
        self.assertEqual([verdicts.verdict_of(row, one) for one in (both, some, none)],
                         [REPRODUCED, DOUBTFUL, NOT_REPRODUCED])
        self.assertIn("two: not met", some.note)

    def test_all_of_needs_each(self):
        self.assertFalse(verdicts.all_of(Finding("1", met=True), Finding("2", met=False)).met)
        self.assertTrue(verdicts.all_of(Finding("1", met=True), Finding("2")).met)
        self.assertIsNone(verdicts.all_of(Finding("1"), Finding("2")).met)

    def test_text_of_numbers(self):
        self.assertEqual([verdicts.text(x, 4) for x in (12.5, 1.27e10, 0.144, 0.0, None)],
                         ["12.50", "1.270e10", "0.1440", "0.000", "-"])

    def test_each_takes_the_seeds_that_are_there(self):
        class Study:
            seeds = (1, 2, 3)

        def some(seed):
            if seed == 2:
                raise NotRun("x")
            return float(seed)
        self.assertEqual(verdicts.each(Study, some), (1.0, 3.0))
        with self.assertRaises(NotRun):
            verdicts.each(Study, lambda seed: some(2))


class TableTest(unittest.TestCase):
    def test_rows_have_names_of_their_own_and_say_all(self):
        rows = all_rows()
        self.assertEqual(len({row.id for row in rows}), len(rows))
        for row in rows:
            for words in (row.section, row.statement, row.published, row.bar):
                self.assertTrue(words, row.id)
            self.assertTrue(not row.corrected or row.doubt, row.id)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
