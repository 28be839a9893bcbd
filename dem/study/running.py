# SPDX-License-Identifier: MIT
"""Runs the programme: as many jobs at once as wanted, each one thread; killed, it goes on.

A directory runs/NAME of OUT has what tangency-dem writes, and
  scene.toml   the whole scene: the stages of what it resumes, then its own
  key          a hash of the scene, of the run's tables and of the keys of what it resumes; written
               before the run starts
  tables/      averages of its states, by `tangency-dem micro`; there when all of the run is done
  done         the key again, when all is there
  seconds      processor time that it took since its key was written
A run whose `done` is its key is complete and is not run again. One that has its key, but is not
done, goes on from its checkpoint. Any other one is taken away and starts afresh, and so does what
resumes it.

One process for all, no threads: its children end when it dies (on Linux), each after its cycle and
with a checkpoint. A lock on OUT/lock, which children hold too, keeps a second study out until the
last of them has gone.
"""
import ctypes
import fcntl
import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time

from scenes import scene_text

PR_SET_PDEATHSIG = 1  # of <sys/prctl.h>


class StudyError(Exception):
    """One line for the user."""


def lock(out, say=print):
    """An open file that holds OUT; waits until what an earlier study started has ended."""
    os.makedirs(out, exist_ok=True)
    file = open(os.path.join(out, "lock"), "w", encoding="utf-8")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say("waiting for another study in the same directory to end")
        fcntl.flock(file, fcntl.LOCK_EX)
    os.set_inheritable(file.fileno(), True)
    return file


def dies_with(parent):
    """In a child, before it becomes the program: TERM when the parent is gone."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(1)


def last_words(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else "no message"


def text_of_numbers(body, stages, output):
    """The text by which a run is known: without what is intended, which changes no number."""
    return scene_text(dict(body, intended=()), stages, output)


class Job:
    """A run with its place on the disk."""

    def __init__(self, run, programme, out, tool_version):
        self.run = run
        self.folder = os.path.join(out, "runs", run.name)
        stages = programme.stages_of(run.name)
        self.scene = scene_text(run.body, stages, run.output)
        told = [tool_version]
        for one in programme.ancestors(run.name):
            told += [text_of_numbers(one.body, one.stages, one.output)]
        told += [text_of_numbers(run.body, stages, run.output), *run.tables]
        self.key = hashlib.sha256("\0".join(told).encode()).hexdigest()
        self.resumes = run.after and os.path.join(out, "runs", run.after, "final.state")
        self.status = "complete" if self._holds("done") else "waiting"
        self.words = ""  # why it failed

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def _holds(self, name):
        try:
            with open(self.path(name), encoding="utf-8") as file:
                return file.read().strip() == self.key
        except OSError:
            return False

    def _write(self, name, text):
        beside = self.path(name + ".part")
        with open(beside, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(beside, self.path(name))

    def prepare(self):
        """What belongs to other scenes goes; scene and key are written."""
        if not self._holds("key"):
            shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.path("tables"), exist_ok=True)
        self._write("scene.toml", self.scene)
        self._write("key", self.key + "\n")

    def commands(self, tool):
        """What is left to do, one command after the other."""
        if not os.path.exists(self.path("summary.json")):
            command = [tool, "run", self.path("scene.toml"), "--out", self.folder, "--threads", "1",
                       "--quiet"]
            checkpoint = self.path("checkpoint.state")
            if os.path.exists(checkpoint):
                yield command + ["--resume", checkpoint]
            elif self.resumes:
                yield command + ["--resume", self.resumes, "--replace"]
            else:
                yield command + ["--replace"]
        for state in self.run.tables:
            name = table_name(state)
            if not os.path.exists(self.path("tables", name)):
                # Written beside and renamed by the tool.
                file, _, partition = state.partition("@")
                yield [tool, "micro", self.path(file), "--partition", partition or "near-uniform",
                       "--json", self.path("tables", name)]

    def seconds(self):
        try:
            with open(self.path("seconds"), encoding="utf-8") as file:
                return float(file.read())
        except (OSError, ValueError):
            return 0.0

    def add_seconds(self, more):
        self._write("seconds", f"{self.seconds() + more:.2f}\n")

    def finish(self):
        self._write("done", self.key + "\n")


def table_name(state):
    """tables/NAME of a state's averages: shear-A.json, shear-C.polar.json."""
    return os.path.basename(state).replace(".state", "").replace("@", ".") + ".json"


class Progress:
    """A line on a terminal that is written over; else a line now and then."""

    def __init__(self, total, jobs, stream=sys.stderr):
        self.stream, self.live = stream, stream.isatty()
        self.total, self.jobs, self.done, self.cost, self.all = total, jobs, 0, 0.0, 0.0
        self.start = self.told = time.monotonic()

    def step(self, run):
        self.done += 1
        self.cost += run.cost
        now = time.monotonic()
        if self.live or now - self.told > 30 or self.done == self.total:
            self.told = now
            left = (now - self.start) * (self.all - self.cost) / self.cost if self.cost else 0.0
            text = (f"{now - self.start:4.0f} s  {self.done} of {self.total} runs, "
                    f"about {left:.0f} s left")
            self.stream.write(f"\r\033[K{text}" if self.live else f"{text}\n")
            self.stream.flush()

    def say(self, text):
        self.stream.write(("\r\033[K" if self.live else "") + text + "\n")
        self.stream.flush()

    def end(self):
        if self.live:
            self.stream.write("\n")


class Runner:
    """@param held  what lock() gave; children hold it too"""

    def __init__(self, programme, out, tool, held, jobs=None, version=""):
        self.programme, self.out, self.tool, self.held = programme, out, tool, held
        self.at_once = jobs or os.cpu_count() or 1
        self.jobs = {name: Job(run, programme, out, version)
                     for name, run in programme.runs.items()}
        self.running = {}  # process id: (job, process, its remaining commands)

    def run(self, names):
        """Brings these runs to their end. Those which a failure leaves undone have the status
        `failed`, or `not run` where what they resume failed."""
        left = [self.jobs[name] for name in names if self.jobs[name].status != "complete"]
        urgency = self._urgencies(left)
        left.sort(key=lambda job: -urgency[job.run.name])
        self.progress = Progress(len(left), self.at_once)
        self.progress.all = sum(job.run.cost for job in left)
        try:
            while left or self.running:
                self._start_what_can(left)
                if self.running:
                    self._wait_for_one()
        except BaseException:  # Ctrl-C above all
            self._end_all()
            raise
        finally:
            self.progress.end()

    def _urgencies(self, left):
        """Cost of a run and of the longest chain that waits for it."""
        urgency = {}
        for job in reversed(left):  # descendants stand after their ancestors
            own = urgency.get(job.run.name, 0.0) + job.run.cost
            urgency[job.run.name] = own
            if job.run.after:
                urgency[job.run.after] = max(urgency.get(job.run.after, 0.0), own)
        return urgency

    def _start_what_can(self, left):
        for job in list(left):
            before = self.jobs[job.run.after].status if job.run.after else "complete"
            if before in ("failed", "not run"):
                job.status = "not run"
                left.remove(job)
                self.progress.step(job.run)
            elif before == "complete" and len(self.running) < self.at_once:
                left.remove(job)
                job.status = "running"
                job.prepare()
                self._next_command(job, job.commands(self.tool))

    def _next_command(self, job, commands):
        command = next(commands, None)
        if command is None:
            job.finish()
            job.status = "complete"
            self.progress.step(job.run)
            return
        parent = os.getpid()
        with open(job.path("messages"), "a", encoding="utf-8") as messages:
            process = subprocess.Popen(command, stdout=messages, stderr=messages,
                                       stdin=subprocess.DEVNULL, process_group=0,
                                       pass_fds=(self.held.fileno(),),
                                       preexec_fn=lambda: dies_with(parent))
        self.running[process.pid] = (job, process, commands)

    def _wait_for_one(self):
        pid, status, used = os.wait4(-1, 0)
        if pid not in self.running:
            return
        job, process, commands = self.running.pop(pid)
        job.add_seconds(used.ru_utime + used.ru_stime)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode == 0:
            self._next_command(job, commands)
            return
        with open(job.path("messages"), encoding="utf-8", errors="replace") as messages:
            job.words = last_words(messages.read())
        if process.returncode < 0:
            job.words = f"ended by signal {-process.returncode}: {job.words}"
        job.status = "failed"
        self.progress.say(f"{job.run.name} failed: {job.words}")
        self.progress.step(job.run)

    def _end_all(self):
        """Each child ends after its cycle, with a checkpoint."""
        for _, process, _ in self.running.values():
            process.send_signal(signal.SIGINT)
        for _, process, _ in self.running.values():
            process.wait()
        self.running.clear()
