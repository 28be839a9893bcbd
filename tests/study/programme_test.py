#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study's programme: its scenes are read by tangency-dem, and its options are checked.

Usage: programme_test.py DEM_STUDY TANGENCY_DEM
"""
import os
import subprocess
import sys
import tomllib
import unittest

sys.dont_write_bytecode = True
STUDY, TOOL = (os.path.abspath(word) for word in sys.argv[1:3])
sys.path.insert(0, STUDY)

import programme  # noqa: E402
import uses  # noqa: E402
from scenes import scene_text  # noqa: E402


def study(*words):
    return subprocess.run([sys.executable, os.path.join(STUDY, "study"), *words],
                          capture_output=True,
                          text=True, check=False)


class ProgrammeTest(unittest.TestCase):
    plan = programme.Programme(programme.Scale())

    def scene(self, run):
        return scene_text(run.body, self.plan.stages_of(run.name), run.output)

    def test_text_reads_back_to_what_was_given(self):
        for run in self.plan.runs.values():
            scene = tomllib.loads(self.scene(run))
            self.assertEqual(scene["stage"], self.plan.stages_of(run.name), run.name)
            self.assertEqual(scene["particles"], run.body["particles"], run.name)

    def test_every_run_resumes_one_of_the_same_particles(self):
        for run in self.plan.runs.values():
            for before in self.plan.ancestors(run.name):
                self.assertEqual([keys["count"] for keys in before.body["particles"].values()],
                                 [keys["count"] for keys in run.body["particles"].values()],
                                 run.name)

    def test_parts_have_what_they_resume(self):
        for part in (*programme.PARTS, *programme.APART):
            names = [run.name for run in self.plan.of_parts((part,))]
            self.assertTrue(names, part)
            for name in names:
                after = self.plan.runs[name].after
                self.assertTrue(after is None or names.index(after) < names.index(name), name)

    def test_every_stage_is_of_a_kind_that_readers_know(self):
        class Job:
            status = "complete"
        found = list(uses.lines(self.plan, dict.fromkeys(self.plan.runs, Job)))
        self.assertEqual({len(line) for line in found}, {len(uses.COLUMNS)})
        self.assertEqual({line[uses.COLUMNS.index("run")] for line in found},
                         set(self.plan.runs))


class OptionsTest(unittest.TestCase):
    def test_wrong_options_are_one_line_and_status_2(self):
        for words in (["--seeds", "0"], ["--seeds", "x"], ["--only", "nothing"], ["--jobs", "-1"],
                      ["--unknown"], ["word"], ["--tool", "/nowhere/tangency-dem", "--out",
                                                "/tmp"]):
            done = study(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_list_names_runs_of_a_part_alone(self):
        done = study("--list", "--only", "loose", "--seeds", "2")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(done.stdout.splitlines()), 8)
        self.assertNotIn("sphere-", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
