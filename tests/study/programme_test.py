#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study's programme: its scenes are read by tangency-dem, and its options are checked.

Usage: programme_test.py DEM_STUDY TANGENCY_DEM
"""
import dataclasses
import os
import subprocess
import sys
import tempfile
import tomllib
import unittest

sys.dont_write_bytecode = True
STUDY, TOOL = (os.path.abspath(word) for word in sys.argv[1:3])
sys.path.insert(0, STUDY)

import programme  # noqa: E402
import running  # noqa: E402
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

    def test_check_has_nothing_to_change_in_any_scene(self):
        last = {run.name for run in self.plan.runs.values() if run.seed == 1}
        last -= {run.after for run in self.plan.runs.values()}  # whose stages the others have too
        with tempfile.TemporaryDirectory() as folder:
            scene = os.path.join(folder, "scene.toml")
            for name in sorted(last):
                with open(scene, "w", encoding="utf-8") as file:
                    file.write(self.scene(self.plan.runs[name]))
                done = subprocess.run([TOOL, "check", scene], capture_output=True, text=True,
                                      check=False)
                self.assertEqual(done.returncode, 0, name + done.stdout + done.stderr)

    def test_a_run_is_known_by_what_changes_its_numbers(self):
        def key(**changes):
            run = self.plan.runs["spheroid-growth-s1"]
            self.plan.runs[run.name] = dataclasses.replace(run, body=dict(run.body, **changes))
            try:
                return running.Job(self.plan.runs[run.name], self.plan, "nowhere", "0").key
            finally:
                self.plan.runs[run.name] = run
        self.assertEqual(key(intended=["gravity"]), key())
        self.assertNotEqual(key(contact={"normal_stiffness": 1.0}), key())

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
