#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study's runner: what is run, what is not run again, what a kill, a change or a failure does.

A made-up tool stands for tangency-dem. Nothing waits for a time: a run that is to be killed says
that it is there, and the lock says when the last of them has gone.

Usage: runner_test.py DEM_STUDY TANGENCY_DEM
"""
import fcntl
import os
import signal
import subprocess
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True
STUDY = os.path.abspath(sys.argv[1])
sys.path.insert(0, STUDY)

import running  # noqa: E402
import stages  # noqa: E402
from programme import Programme, Run  # noqa: E402

# Logs each call; says so and waits where the file `hang` is for this run; fails where `fail` is.
TOOL = r'''#!/usr/bin/env python3
import os, signal, sys, time
words = sys.argv[1:]
if words == ["--version"]:
    print("made up")
    sys.exit(0)
here = os.path.dirname(os.path.abspath(__file__))
def write(path, text):
    with open(path, "w") as file:
        file.write(text)
if words[0] == "micro":
    write(words[words.index("--json") + 1], "{}")
    sys.exit(0)
out = words[words.index("--out") + 1]
name = os.path.basename(out)
with open(os.path.join(here, "log"), "a") as log:
    resumed = words[words.index("--resume") + 1] if "--resume" in words else "-"
    log.write(f"{name} {'/'.join(resumed.split('/')[-2:])}\n")
if os.path.exists(os.path.join(here, "fail." + name)):
    print("first words")
    sys.exit("last words")
hang = os.path.join(here, "hang." + name)
if os.path.exists(hang):
    signals = {signal.SIGTERM, signal.SIGINT}
    signal.pthread_sigmask(signal.SIG_BLOCK, signals)
    write(os.path.join(out, "checkpoint.state"), "half")
    with open(hang, "w") as event:  # a fifo, once
        event.write(name)
    os.unlink(hang)
    signal.sigwait(signals)
    sys.exit(143)
for file in ("final.state", "history.csv", "summary.json"):
    write(os.path.join(out, file), "{}")
'''


def programme_of(rates):
    """a; b and c that resume it: each with a stage of its own rate."""
    made = types.SimpleNamespace(runs={})
    for name, after in (("a", None), ("b", "a"), ("c", "a")):
        made.runs[name] = Run(name, "part", 1, stages.body(8),
                              ({"kind": "relax", "name": name, "mean_stress": rates[name]},), after,
                              {"history_interval": 50}, ("final.state",))
    made.ancestors = lambda name: Programme.ancestors(made, name)
    made.stages_of = lambda name: Programme.stages_of(made, name)
    return made


def drive(out, tool, rates, jobs=1):
    plan = programme_of(rates)
    runner = running.Runner(plan, out, tool, running.lock(out), jobs, "made up")
    runner.run(list(plan.runs))
    return runner


RATES = {"a": 1e6, "b": 2e6, "c": 3e6}


class RunnerTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.out = os.path.join(self.folder.name, "out")
        self.tool = self.file("tool")
        with open(self.tool, "w", encoding="utf-8") as file:
            file.write(TOOL)
        os.chmod(self.tool, 0o755)

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def log(self):
        with open(self.file("log"), encoding="utf-8") as file:
            return file.read().split("\n")[:-1]

    def run_all(self, rates=None, **keys):
        runner = drive(self.out, self.tool, rates or RATES, **keys)
        runner.held.close()
        return {name: job.status for name, job in runner.jobs.items()}

    def started(self, event):
        """A study in a process of its own, once the run with this event has its checkpoint."""
        os.mkfifo(event)
        code = (f"import sys; sys.argv[1:] = {sys.argv[1:]!r}; sys.path.insert(0, {HERE!r})\n"
                "import signal, runner_test\n"
                "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                f"runner_test.drive({self.out!r}, {self.tool!r}, runner_test.RATES)")
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL)
        with open(event, encoding="utf-8") as told:
            self.assertEqual(told.read(), os.path.basename(event).removeprefix("hang."))
        return process

    def wait_until_all_have_gone(self):
        with open(os.path.join(self.out, "lock"), "w", encoding="utf-8") as file:
            fcntl.flock(file, fcntl.LOCK_EX)

    def test_each_run_is_made_once_and_after_what_it_resumes(self):
        self.assertEqual(set(self.run_all(jobs=2).values()), {"complete"})
        self.assertEqual(self.log()[0], "a -")
        self.assertEqual(sorted(self.log()[1:]), ["b a/final.state", "c a/final.state"])
        self.assertTrue(os.path.exists(os.path.join(self.out, "runs", "b", "tables", "final.json")))
        self.run_all()
        self.assertEqual(len(self.log()), 3)

    def test_a_killed_study_goes_on_from_its_checkpoints(self):
        process = self.started(self.file("hang.b"))
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.wait_until_all_have_gone()  # the child has ended with its parent
        before = self.log()
        self.assertEqual(self.run_all()["b"], "complete")
        self.assertEqual(before[0], "a -")
        self.assertNotIn("a -", self.log()[1:])
        self.assertEqual([line for line in self.log() if line.startswith("b ")],
                         ["b a/final.state", "b b/checkpoint.state"])

    def test_an_interrupted_study_ends_its_runs(self):
        process = self.started(self.file("hang.c"))
        process.send_signal(signal.SIGINT)
        self.assertNotEqual(process.wait(), 0)
        self.wait_until_all_have_gone()
        self.assertEqual(self.run_all()["c"], "complete")
        self.assertEqual(self.log()[-1], "c c/checkpoint.state")

    def test_a_changed_scene_is_run_again_and_what_resumes_it_too(self):
        self.run_all()
        self.run_all(dict(RATES, c=4e6))
        self.assertEqual(self.log()[3:], ["c a/final.state"])
        self.run_all(dict(RATES, a=5e6))
        self.assertEqual(sorted(self.log()[4:]), ["a -", "b a/final.state", "c a/final.state"])

    def test_a_checkpoint_of_another_scene_is_not_resumed(self):
        process = self.started(self.file("hang.b"))
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.wait_until_all_have_gone()
        self.run_all(dict(RATES, b=6e6))
        self.assertEqual([line for line in self.log() if line.startswith("b ")],
                         ["b a/final.state"] * 2)

    def test_a_failure_is_told_with_its_last_words_and_others_go_on(self):
        open(self.file("fail.b"), "w", encoding="utf-8").close()
        runner = drive(self.out, self.tool, RATES)
        runner.held.close()
        self.assertEqual(runner.jobs["b"].status, "failed")
        self.assertEqual(runner.jobs["b"].words, "last words")
        self.assertEqual(runner.jobs["c"].status, "complete")

    def test_what_resumes_a_failed_run_is_not_run(self):
        open(self.file("fail.a"), "w", encoding="utf-8").close()
        self.assertEqual(self.run_all(), {"a": "failed", "b": "not run", "c": "not run"})
        os.unlink(self.file("fail.a"))
        self.assertEqual(set(self.run_all().values()), {"complete"})


HERE = os.path.dirname(os.path.abspath(__file__))

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
