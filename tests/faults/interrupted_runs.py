#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Interrupts a run at its calls that change files, and at its allocations, and resumes it.

After each fault: what the run said and how it ended, no half file under a whole name, every state
readable, the history as far as it goes that of the undisturbed run. Then the run goes on from its
checkpoint, or anew where there was none, and everything in its directory has to be, to the byte,
what the undisturbed run wrote.

    interrupted_runs.py TOOL LIBRARY SCENE FOLDER [--cases N] [KIND...]

LIBRARY is that of faults.cpp. KIND: kill, half, full, once, quota, input-output, memory,
memory-ends; all of them where none is given. --cases: so many of each kind, spread over all events
of the run; 0 takes each event. Ends with a line of counts; status 1 where anything was lost.
"""
import argparse
import csv
import errno
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

# How each kind fails: what is counted, how it ends, and what the message has to say.
KINDS = {
    "kill": ("files", "{}:kill", None),
    "half": ("files", "{}:half", None),
    "full": ("files", "{}+:%d" % errno.ENOSPC, os.strerror(errno.ENOSPC)),
    "once": ("files", "{}:%d" % errno.ENOSPC, os.strerror(errno.ENOSPC)),
    "quota": ("files", "{}+:%d" % errno.EDQUOT, os.strerror(errno.EDQUOT)),
    "input-output": ("files", "{}:%d" % errno.EIO, os.strerror(errno.EIO)),
    "memory": ("memory", "{}:%d" % errno.ENOMEM, "memory"),
    "memory-ends": ("memory", "{}+:%d" % errno.ENOMEM, "memory"),
}
# Lines of summary.json that differ between two runs of one scene.
TIMES = re.compile(rb'^ *"(wall_seconds|ns_per_listed_pair_per_cycle)".*\n', re.MULTILINE)


class Lost(Exception):
    """Something that a fault must not do."""


class Runs:
    def __init__(self, tool, library, scene, folder):
        self.tool, self.library, self.scene = tool, library, scene
        self.out = folder / "out"
        folder.mkdir(parents=True, exist_ok=True)
        self.counts = folder / "counts"
        self.clear()
        ended = self.run(count=True)
        if ended.returncode != 0:
            raise SystemExit(f"the undisturbed run ended with {ended.returncode}: {ended.stderr}")
        files, memory = map(int, self.counts.read_text().split())
        self.events = {"files": files, "memory": memory}
        self.wanted = self.contents()
        self.rows = self.wanted["history.csv"].splitlines()

    def clear(self):
        shutil.rmtree(self.out, ignore_errors=True)

    def run(self, *more, fault=None, count=False):
        environment = dict(os.environ)
        if fault or count:
            environment["LD_PRELOAD"] = str(self.library)
        if fault:
            environment["TANGENCY_FAULT"] = fault
        if count:
            environment["TANGENCY_FAULT_COUNT"] = str(self.counts)
        command = [self.tool, "run", self.scene, "--out", self.out, "--quiet", "--threads", "1"]
        return subprocess.run([*map(str, command), *map(str, more)], env=environment,
                              capture_output=True, text=True, check=False)

    def contents(self):
        """Every file of the run's directory by its path there."""
        files = {}
        for file in sorted(self.out.rglob("*")):
            if file.is_file():
                files[str(file.relative_to(self.out))] = TIMES.sub(b"", file.read_bytes())
        return files

    def check_what_is_there(self, killed):
        """Whole files are whole; parts are left by a kill alone."""
        if not self.out.exists():
            return
        for file in self.out.rglob("*"):
            if file.suffix == ".part" and not killed and file.name != "frames.xyz.part":
                raise Lost(f"{file.name} was left")
            if file.suffix == ".state":
                read = subprocess.run([str(self.tool), "particles", str(file)], text=True,
                                      capture_output=True, check=False)
                if read.returncode != 0:
                    raise Lost(f"{file.name} cannot be read: {read.stderr.strip()}")
        history = self.out / "history.csv"
        if history.exists():
            rows = history.read_bytes().splitlines()
            if rows != self.rows[: len(rows)]:
                raise Lost("history.csv has other rows")
            if not history.read_bytes().endswith(b"\n"):
                raise Lost("history.csv ends within a row")
            for row in csv.reader(history.read_text().splitlines()):
                if len(row) != len(rows[0].split(b",")):
                    raise Lost("history.csv has a short row")

    def go_on(self):
        """From the checkpoint, or anew; what there is then."""
        checkpoint = self.out / "checkpoint.state"
        resumes = checkpoint.exists()
        ended = self.run("--resume", checkpoint) if resumes else self.run("--replace")
        if ended.returncode != 0:
            raise Lost(f"it does not go on: {ended.returncode}: {ended.stderr.strip()}")
        there = self.contents()
        # A state is kept at an event: one from before the fault is as good.
        if there.keys() != self.wanted.keys():
            raise Lost(f"other files: {sorted(there.keys() ^ self.wanted.keys())[:5]}")
        for name, content in there.items():
            if content != self.wanted[name]:
                raise Lost(f"{name} differs")
        return resumes

    def interrupt(self, kind, event):
        """One fault and what comes after. Returns how the run ended and whether it resumed."""
        what, how, reason = KINDS[kind]
        self.clear()
        ended = self.run(fault=f"{what}:{how.format(event)}")
        killed = reason is None
        if killed and ended.returncode != -9:
            raise Lost(f"it ended with {ended.returncode} where it was to be killed")
        if not killed and ended.returncode not in (0, 2):
            raise Lost(f"it ended with {ended.returncode}: {ended.stderr.strip()}")
        if ended.returncode == 2 and reason not in ended.stderr:
            raise Lost(f"it does not say why: {ended.stderr.strip()}")
        self.check_what_is_there(killed)
        if ended.returncode == 0 and self.contents() != self.wanted:
            raise Lost("it says that it is complete, and is not")
        return ended.returncode, self.go_on()


def chosen(events, cases):
    """So many events, spread over all; each of them for 0."""
    if cases == 0 or cases >= events:
        return range(1, events + 1)
    return [1 + k * (events - 1) // max(cases - 1, 1) for k in range(cases)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tool", type=lambda name: Path(name).absolute())
    parser.add_argument("library", type=lambda name: Path(name).absolute())
    parser.add_argument("scene", type=lambda name: Path(name).absolute())
    parser.add_argument("folder", type=lambda name: Path(name).absolute())
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--cases", type=int, default=0)
    words = parser.parse_intermixed_args()
    if unknown := set(words.kinds) - set(KINDS):
        parser.error(f"{', '.join(sorted(unknown))}: one of {', '.join(KINDS)}")
    runs = Runs(words.tool, words.library, words.scene, words.folder)
    lost = faults = 0
    for kind in words.kinds or KINDS:
        counts = {"faults": 0, "ended": 0, "survived": 0, "resumed": 0, "anew": 0, "lost": 0}
        for event in chosen(runs.events[KINDS[kind][0]], words.cases):
            counts["faults"] += 1
            try:
                status, resumed = runs.interrupt(kind, event)
                counts["survived" if status == 0 else "ended"] += 1
                counts["resumed" if resumed else "anew"] += 1
            except Lost as why:
                counts["lost"] += 1
                print(f"{kind} at {event}: {why}", flush=True)
        print(f"{kind}: " + ", ".join(f"{count} {name}" for name, count in counts.items()),
              f"of {runs.events[KINDS[kind][0]]} events", flush=True)
        lost += counts["lost"]
        faults += counts["faults"]
    print(f"{faults} faults, {lost} with a loss")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
