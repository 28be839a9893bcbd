#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/peers/hunts grades and hunts a code with the same features left out, and writes the table.

Usage: hunts_test.py FOLDER_OF_PEERS GRADER
"""
import importlib.machinery
import importlib.util
import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PEERS, GRADER = (os.path.abspath(path) for path in sys.argv[1:3])
sys.path.insert(0, PEERS)

MARKS = "before\n<!-- hunts made by x -->\n\nold\n<!-- end of the hunts -->\nafter\n"
# Says yes to all.
FAKE = """#!/bin/sh
[ "$1" != --list ] || { printf 'yes\\tYes\\t1.2\\tcall\\tno options\\tcommon-normal\\n'; exit; }
echo asked >> '%s'
awk 'BEGIN { print "row,overlaps" } NR > 1 { print NR - 2 ",1" }'
"""
PRINTED = """finding 1: overlaps 1 where separate (round), from near, answer 8
  a  centre 0 0 0  semi-axes 1 1 1  orientation 1 0 0 0
  b  centre 2.25 0 0  semi-axes 1e-03 1 1  orientation 0 0 -2e-05 0
  true: separate, gap 0.25; answered: overlaps 1
finding 2: overlaps 1 where separate (long), from near, answer 7
  a  centre 0 0 0  semi-axes 1 1 1  orientation 1 0 0 0
  b  centre 2.125 0 0  semi-axes 1 1 1  orientation 1 0 0 0
  true: separate, gap 0.125; answered: overlaps 1
fault no answer: 3 answers, the first is answer 4
fault overlaps 1 where separate: 12 answers, the first is answer 5
not claimed: 6 answers, which are not judged
FAILED: 30 answers: 2 kinds of faults, 2 findings
"""


def hunts_module():
    loader = importlib.machinery.SourceFileLoader("hunts", f"{PEERS}/hunts")
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("hunts", loader))
    sys.modules["hunts"] = module
    loader.exec_module(module)
    return module


class Hunts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.program, cls.asked = cls.folder / "program", cls.folder / "asked"
        cls.program.write_text(FAKE % cls.asked)
        cls.program.chmod(stat.S_IRWXU)
        cls.page = cls.folder / "page.md"
        cls.page.write_text(MARKS)
        cls.first = cls.hunts("yes")

    @classmethod
    def hunts(cls, only):
        return subprocess.run(
            [f"{PEERS}/hunts", "--grader", GRADER, "--answers", cls.program, "--work",
             cls.folder / "work", "--page", cls.page, "--only", only, "--asked", "48"],
            text=True, capture_output=True, check=False)

    def test_a_wrong_yes_is_counted_in_the_corpora_and_hunted(self):
        self.assertEqual((self.first.returncode, self.first.stderr), (0, ""))
        row = next(line for line in self.page.read_text().splitlines() if line.startswith("| Yes 1.2"))
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        self.assertRegex(cells[1], r"^[1-9]\d* of 1644$")
        self.assertEqual(cells[3], "overlaps 1 where separate")
        self.assertLessEqual(int(cells[7]), 3)  # digits

    def test_what_stands_outside_of_the_marks_stays(self):
        text = self.page.read_text()
        self.assertTrue(text.startswith("before\n<!-- hunts made by x -->\n\ntangency-verify "), text)
        self.assertIn("seed 1, 48 answers of each code; not claimed: touching,near,extreme.", text)
        self.assertTrue(text.endswith("\n<!-- end of the hunts -->\nafter\n"))
        self.assertNotIn("old", text)

    def test_a_name_that_no_code_has_is_refused(self):
        refused = self.hunts("nobody")
        self.assertEqual((refused.returncode, refused.stderr),
                         (1, "hunts: --only = nobody: it is found in the name of no code\n"))

    def test_of_each_kind_the_first_finding_is_taken(self):
        hunts = hunts_module()
        faults, left_out = hunts.faults_in(PRINTED)
        self.assertEqual(left_out, 6)
        self.assertEqual([(f.kind, f.count, f.first) for f in faults],
                         [("overlaps 1 where separate", 12, 5), ("no answer", 3, 4)])
        self.assertEqual(hunts.pair_cell(faults[0]),
                         "`axes 1 1 1` and `axes 1e-03 1 1 at 2.25 0 0 turned 0 0 -2e-05 0`")
        self.assertEqual([hunts.digits(f) for f in faults], ["3", "-"])
        self.assertEqual(faults[0].truth, "separate, gap 0.25; answered: overlaps 1")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
