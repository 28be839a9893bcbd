#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is counted as run, as not run and as no code, of an export written down by hand."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
from counts import counted, is_ours, line_counts

SOURCE = """int f(int x) {
  if (x > 0) {
    return 1;
  }
  assert(x < 9);

  // a remark
  return x ? 2 : 3;
}
""".splitlines()
# [line, column, count, has count, begins a region, is a gap]
SEGMENTS = [[1, 14, 5, True, True, False], [2, 14, 0, True, True, False], [4, 4, 5, True, False, False],
            [8, 14, 0, True, True, False], [8, 15, 5, True, False, False], [9, 2, 0, False, False, False]]
BRANCHES = [[2, 7, 2, 12, 0, 5, 0, 0, 4], [5, 3, 5, 16, 5, 0, 0, 0, 4], [8, 10, 8, 11, 0, 4, 0, 0, 4]]


class Counts(unittest.TestCase):
    def test_a_line_is_run_where_any_region_that_begins_in_it_or_reaches_into_it_is(self):
        self.assertEqual({1: 5, 2: 5, 3: 0, 4: 0, 5: 5, 6: 5, 7: 5, 8: 5, 9: 5}, line_counts(SEGMENTS))

    def test_what_is_not_run_is_named_by_line_and_by_the_way_that_is_not_taken(self):
        counts = counted([{"segments": SEGMENTS, "branches": BRANCHES}], SOURCE)
        self.assertEqual([3, 4], counts.missed_lines)
        self.assertEqual([(2, "true"), (8, "true")], counts.missed_branches)
        self.assertEqual((9, 7), (counts.lines, counts.lines_run))

    def test_the_failing_side_of_an_assertion_is_no_branch(self):
        self.assertEqual(4, counted([{"segments": SEGMENTS, "branches": BRANCHES}], SOURCE).branches)

    def test_a_branch_counts_once_for_all_templates_and_instruction_sets(self):
        again = BRANCHES + [[2, 7, 2, 12, 3, 0, 0, 0, 4]]
        counts = counted([{"segments": SEGMENTS, "branches": again}], SOURCE)
        self.assertEqual((4, [(8, "true")]), (counts.branches, counts.missed_branches))

    def test_a_header_that_was_compiled_by_two_names_is_one_file(self):
        other = [segment[:2] + [7] + segment[3:] if segment[:2] == [2, 14] else segment for segment in SEGMENTS]
        taken = [[2, 7, 2, 12, 3, 0, 0, 0, 4]]
        counts = counted([{"segments": other, "branches": taken}, {"segments": SEGMENTS, "branches": BRANCHES}], SOURCE)
        self.assertEqual((9, []), (counts.lines, counts.missed_lines))
        self.assertEqual((4, [(8, "true")]), (counts.branches, counts.missed_branches))

    def test_only_code_of_the_folders_asked_for_is_counted(self):
        self.assertTrue(is_ours(pathlib.Path("geometry/gap.cpp"), ["geometry"]))
        self.assertFalse(is_ours(pathlib.Path("tests/geometry/gap_test.cpp"), ["geometry"]))
        self.assertFalse(is_ours(pathlib.Path("geometry/README.md"), ["geometry"]))


if __name__ == "__main__":
    unittest.main()
