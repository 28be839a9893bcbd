#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/compare holds the least times of two programs against each other. The programs are fakes,
which write times that are known; no time is taken.

Usage: compare_test.py COMPARE
"""

import json
import os
import subprocess
import sys
import tempfile
import textwrap
import unittest

COMPARE = os.path.abspath(sys.argv[1])


def run(name, time, unit="ns", kind="iteration", aggregate="", real=1e9):
    """A run as Google Benchmark writes it."""
    return {"name": f"{name}_{aggregate}" if aggregate else name, "run_name": name,
            "run_type": kind, "aggregate_name": aggregate, "cpu_time": time, "real_time": real,
            "time_unit": unit}


class Compare(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.log = os.path.join(self.folder.name, "log")

    def build(self, name, rounds, program="bench_batch", status=0, words=""):
        """A build whose program writes the runs of its next round each time, and what it was asked
        to the log."""
        build = os.path.join(self.folder.name, name)
        os.makedirs(os.path.join(build, "bench"))
        file = os.path.join(build, "bench", program)
        with open(file, "w", encoding="utf-8") as text:
            text.write(textwrap.dedent(f"""\
                #!{sys.executable}
                import json, sys
                with open({self.log!r}, "a+") as log:
                    log.write({name!r} + " " + " ".join(sys.argv[1:]) + "\\n")
                    log.seek(0)
                    turn = sum(line.startswith({name!r} + " ") for line in log) - 1
                rounds = json.loads({json.dumps(rounds)!r})
                out = [a.split("=", 1)[1] for a in sys.argv if a.startswith("--benchmark_out=")][0]
                runs = rounds[turn % len(rounds)]
                with open(out, "w") as text:  # empty where no benchmark ran, as Google Benchmark leaves it
                    text.write(json.dumps({{"benchmarks": runs}}) if runs else "")
                print({words!r}, file=sys.stderr)
                sys.exit({status})
                """))
        os.chmod(file, 0o755)
        return build

    def compare(self, *arguments):
        return subprocess.run([sys.executable, COMPARE, *arguments], capture_output=True, text=True,
                              check=False)

    def rows(self, *arguments):
        """Cells by name: old, new, new/old."""
        ended = self.compare(*arguments)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        lines = ended.stdout.splitlines()
        self.assertEqual(lines[0].split(), ["old,", "ns", "new,", "ns", "new/old"])
        return {line.split()[0]: line.split()[1:] for line in lines[1:]}

    def turns(self):
        with open(self.log, encoding="utf-8") as log:
            return [line.split()[0] for line in log]

    def test_the_least_time_of_each_name_counts(self):
        old = self.build("old", [[run("cold", 50), run("warm", 30)], [run("cold", 40), run("warm", 35)]])
        new = self.build("new", [[run("cold", 21), run("warm", 18)], [run("cold", 20), run("warm", 15)]])
        self.assertEqual(self.rows(old, new, "--rounds", "2"),
                         {"cold": ["40", "20", "0.500"], "warm": ["30", "15", "0.500"]})

    def test_both_run_once_a_round_and_begin_by_turns(self):
        old, new = self.build("old", [[run("cold", 2)]]), self.build("new", [[run("cold", 1)]])
        self.rows(old, new, "--rounds", "3")
        self.assertEqual(self.turns(), ["old", "new", "new", "old", "old", "new"])

    def test_a_name_that_one_of_them_lacks_is_shown(self):
        old = self.build("old", [[run("both", 4), run("gone", 5)]])
        new = self.build("new", [[run("fresh", 6), run("both", 1)]])
        self.assertEqual(list(self.rows(old, new).items()),
                         [("fresh", ["-", "6", "-"]), ("both", ["4", "1", "0.250"]),
                          ("gone", ["5", "-", "-"])])

    def test_of_aggregates_only_the_least_counts(self):
        aggregates = [run("cold", time, kind="aggregate", aggregate=name)
                      for name, time in (("mean", 1), ("min", 8), ("stddev", 0.1), ("cv", 0.01))]
        old, new = self.build("old", [aggregates]), self.build("new", [[run("cold", 2)]])
        self.assertEqual(self.rows(old, new), {"cold": ["8", "2", "0.250"]})

    def test_units_are_told_apart_and_threads_take_the_time_that_passes(self):
        old = self.build("old", [[run("cold", 1, "us"), run("four/real_time/threads:4", 9, real=2)]])
        new = self.build("new", [[run("cold", 500), run("four/real_time/threads:4", 9, real=1)]])
        self.assertEqual(self.rows(old, new), {"cold": ["1000", "500", "0.500"],
                                               "four/real_time/threads:4": ["2", "1", "0.500"]})

    def test_filter_and_program_are_those_asked_for(self):
        for name in ("old", "new"):
            self.build(name, [[run("cold", 1)]], program="bench_other")
        here = lambda name: os.path.join(self.folder.name, name)
        self.rows(here("old"), here("new"), "--program", "bench_other", "--filter", "co.d", "--rounds", "1")
        with open(self.log, encoding="utf-8") as log:
            for line in log:
                self.assertIn("--benchmark_filter=co.d", line.split())

    def test_what_cannot_be_compared_is_refused_in_one_line(self):
        good = self.build("good", [[run("cold", 1)]])
        fails = self.build("fails", [[run("cold", 1)]], status=3, words="no such pair")
        none = self.build("none", [[]], words="matched nothing")
        broken = self.build("broken", [[{**run("cold", 1), "error_occurred": True,
                                         "error_message": "wrong answer"}]])
        empty = os.path.join(self.folder.name, "empty")
        for arguments, said in (((good, empty), "there is no program bench_batch"),
                                ((good, fails), "ended with 3: no such pair"),
                                ((good, broken), "cold: wrong answer"),
                                ((none, none, "--filter", "x"), "--filter x: no benchmark has such a name: matched nothing"),
                                ((good, good, "--rounds", "0"), "0: rounds are 1 to 1000")):
            ended = self.compare(*arguments)
            self.assertEqual((ended.returncode, ended.stdout), (2, ""))
            self.assertIn(said, ended.stderr.strip().split("\n")[-1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
