#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/peers/board asks programs, grades what they answer and writes the board of them; the
adapters in Python ask SciPy and LAMMPS what we mean, where these are installed.

Usage: board_test.py FOLDER_OF_PEERS GRADER
"""
import html.parser
import math
import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PEERS, GRADER = (os.path.abspath(path) for path in sys.argv[1:3])
sys.path.insert(0, PEERS)
import adapter  # noqa: E402

MARKS = "before\n<!-- tables made by x -->\n\nold\n<!-- end of the tables -->\nafter\n"
FAKE = """#!/bin/sh
[ "$1" != --version ] || { echo 'tangency 9.9'; exit; }
[ "$1" != --list ] || { printf 'quiet\\tQuiet\\t1.2\\tcall\\tno options\\tcommon-normal\\n'; exit; }
echo asked >> '%s'
cat > /dev/null
echo row,overlaps,gap
echo '3 pairs failed, 1 ended the program, 2 hung' >&2
"""


class Board(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.program, cls.asked = cls.folder / "program", cls.folder / "asked"
        cls.program.write_text(FAKE % cls.asked)
        cls.program.chmod(stat.S_IRWXU)
        cls.page, cls.html = cls.folder / "page.md", cls.folder / "page.html"
        cls.page.write_text(MARKS)
        cls.first = cls.board("quiet")

    @classmethod
    def board(cls, only):
        return subprocess.run(
            [f"{PEERS}/board", "--grader", GRADER, "--answers", cls.program, "--tangency",
             cls.program, "--work", cls.folder / "work", "--page", cls.page, "--html", cls.html,
             "--only", only], text=True, capture_output=True, check=False)

    def test_silence_earns_the_lowest_grade_and_is_counted(self):
        self.assertEqual((self.first.returncode, self.first.stderr), (0, ""))
        self.assertTrue(self.first.stdout.startswith("E "), self.first.stdout)
        self.assertIn("| Quiet 1.2 `call`, no options | common-normal | E | 0 | 0 | 2894 | 2894 | - |",
                      self.page.read_text())

    def test_what_stands_outside_of_the_marks_stays(self):
        text = self.page.read_text()
        self.assertTrue(text.startswith("before\n<!-- tables made by x -->\n\n### All corpora, 2894"))
        self.assertTrue(text.endswith("\n<!-- end of the tables -->\nafter\n"))
        self.assertNotIn("old", text)

    def test_counts_of_the_adapter_stand_in_the_table_of_each_corpus(self):
        self.assertEqual(self.page.read_text().count("| 3 / 1 / 2 |"), 8)

    def test_the_page_has_a_row_a_code_in_each_table(self):
        rows = []

        class Reader(html.parser.HTMLParser):
            def handle_starttag(self, tag, attrs):
                rows.append(tag)
        Reader().feed(self.html.read_text())
        self.assertEqual((rows.count("table"), rows.count("tr")), (9, 18))

    def test_answers_are_kept_until_the_program_is_newer(self):
        def times_asked():
            return self.asked.read_text().count("asked")
        before = times_asked()
        self.board("quiet")
        self.assertEqual(times_asked(), before)
        later = self.program.stat().st_mtime + 1e6
        os.utime(self.program, (later, later))
        self.board("quiet")
        self.assertEqual(times_asked(), before + 8)

    def test_a_name_that_no_code_has_is_refused(self):
        refused = self.board("nobody")
        self.assertEqual((refused.returncode, refused.stderr),
                         (1, "board: --only = nobody: it is found in the name of no code\n"))


def ask(program, code, bodies):
    """Rows of what the adapter answers to pairs of bodies, ten numbers each."""
    names = [f"{who}.{field}" for who in "ab" for field in adapter.FIELDS]
    table = ",".join(names) + "\n" + "".join(
        ",".join(float(v).hex() for body in pair for v in body) + "\n" for pair in bodies)
    done = subprocess.run([program, code], input=table, text=True, capture_output=True, check=True)
    return [line.split(",") for line in done.stdout.splitlines()[1:]]


def needle(centre, angle=0.0, length=1.0):
    """Long in x, turned by an angle about z; the quaternion has any length."""
    return (*centre, 2, 0.5, 0.5, length * math.cos(angle / 2), 0, 0, length * math.sin(angle / 2))


def codes_of(program):
    """A program without its package names no code."""
    lines = subprocess.run([program, "--list"], text=True, capture_output=True, check=True)
    return [line.split("\t")[0] for line in lines.stdout.splitlines()]


class Adapters(unittest.TestCase):
    def each(self, folder):
        program = f"{PEERS}/{folder}/answers.py"
        codes = codes_of(program)
        if not codes:
            self.skipTest(f"the package of {folder} is not installed")
        return [(program, code) for code in codes]

    def test_scipy_reads_the_quaternion_as_the_turn_from_body_to_space(self):
        tip = (math.cos(0.5), math.sin(0.5), 0)
        ball = (*(2.125 * t for t in tip), 0.25, 0.25, 0.25, 1, 0, 0, 0)
        for program, code in self.each("scipy"):
            (row,) = ask(program, code, [(needle((0, 0, 0), 0.5, 3), ball)])
            self.assertEqual(row[:2], ["0", "1"], code)
            self.assertAlmostEqual(float(row[2]), -0.125, 6, code)
            for seen, true in zip(row[3:], tip):
                self.assertAlmostEqual(float(seen), true, 4, code)

    def test_scipy_finds_a_normal_that_is_not_the_line_of_centres(self):
        turn = 0.7

        def in_space(x, y):
            return (x * math.cos(turn) - y * math.sin(turn),
                    x * math.sin(turn) + y * math.cos(turn), 0.0)
        for program, code in self.each("scipy"):
            pairs, truth = [], []
            for t, gap in ((0.3, 0.25), (1.2, -0.0625), (2.5, 1)):
                outward = (math.cos(t) / 2, math.sin(t) / 0.5)
                normal = [n / math.hypot(*outward) for n in outward]
                centre = in_space(2 * math.cos(t) + (0.25 + gap) * normal[0],
                                  0.5 * math.sin(t) + (0.25 + gap) * normal[1])
                pairs.append((needle((0, 0, 0), turn), (*centre, 0.25, 0.25, 0.25, 1, 0, 0, 0)))
                truth.append((gap, in_space(*normal)))
            rows = ask(program, code, pairs)
            self.assertEqual(len(rows), len(pairs), code)
            for row, (gap, normal) in zip(rows, truth):
                self.assertAlmostEqual(float(row[2]), gap, 8, code)
                for seen, true in zip(row[3:], normal):
                    self.assertAlmostEqual(float(seen), true, 4, code)

    def test_lammps_turns_bodies_so_and_is_exact_for_equal_ones_in_parallel(self):
        along = (4.5 * math.cos(0.5), 4.5 * math.sin(0.5), 0)
        pairs = [(needle((0, 0, 0), 0.5, 3), needle(along, 0.5)),
                 (needle((0, 0, 0)), needle((0, 0.75, 0)))]
        for program, code in self.each("lammps"):
            apart, overlapping = ask(program, code, pairs)
            self.assertEqual((apart[1], overlapping[1]), ("0", "1"))
            self.assertAlmostEqual(float(apart[2]), 0.5, 12)
            self.assertAlmostEqual(float(overlapping[2]), -0.25, 12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
