# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs that run blocks of cycles of one scene when asked to, so that they can be timed by turns."""

import dataclasses
import json
import math
import os
import statistics
import subprocess
import sys

# Cycles of the first block, which is not counted: caches and threads warm up. Chosen.
WARM_UP = 5

# By how much answers may differ that should be the same. At rest only the order of sums differs,
# and a contact that barely touches may open; a shear forgets its first roundings in some thousand
# cycles, and then holds its stress (docs/simulator.md: within 0.1 %) by other contacts.
AT_REST = {"mean_stress": 1e-6, "touching": 2e-3}
SHEARED = {"mean_stress": 1e-2, "touching": 5e-2}


class Failure(Exception):
    """One line that says what went wrong."""


@dataclasses.dataclass
class Block:
    """Times of a block of cycles, in s; what stands at its end."""

    cycles: int
    cpu: float
    wall: float
    pair_cycles: float  # sum over the cycles of the listed pairs
    end: dict  # particles, listed, touching, mean_stress (Pa)


class Program:
    """A program that answers lines on its standard input by lines on its standard output."""

    def __init__(self, label, command, environment=None):
        self.label, self.command = label, command
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            bufsize=1, env=dict(os.environ, **(environment or {})))
        self.last = ""

    def tell(self, line):
        try:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            raise self.failure() from None

    def next_line(self):
        line = self.process.stdout.readline()
        if not line:
            raise self.failure()
        self.last = line.strip()
        return self.last

    def failure(self):
        """Of a program that has ended, by its last line."""
        rest = self.close().strip().splitlines()
        said = rest[-1] if rest else self.last
        return Failure(f"{self.label}: ended with {self.process.returncode}: {said}")

    def close(self):
        """Lets it end; the rest of what it says."""
        try:
            self.process.stdin.close()
        except BrokenPipeError:  # it has ended before
            pass
        rest = self.process.stdout.read()
        self.process.wait()
        self.process.stdout.close()
        return rest


class Ours(Program):
    """bench_dem_scene with a scene."""

    def __init__(self, label, binary, scene, level="", threads=1):
        command = [binary, scene, "--threads", str(threads)] + (["--level", level] if level else [])
        # For --old alone: builds before docs/decisions/0012-threads.md have OpenMP's threads, which
        # wait busily unless they are told to sleep, as tangency-dem had it; the user may choose.
        policy = os.environ.get("OMP_WAIT_POLICY", "passive")
        super().__init__(label, command, {"OMP_WAIT_POLICY": policy})
        self.scene, self.threads = scene, threads
        self.build = binary, level
        self.ready = self.answer()

    def answer(self):
        line = self.next_line()
        try:
            return json.loads(line)
        except ValueError:
            self.close()
            raise Failure(f"{self.label}: {line}") from None

    def ask(self, command):
        self.tell(command)
        return self.answer()

    def block(self, cycles):
        got = self.ask(f"cycles {cycles}")
        return Block(cycles, got["cpu_seconds"], got["wall_seconds"], got["pair_cycles"], got)


@dataclasses.dataclass
class Row:
    """What came of a session: medians over the rounds, and the least and largest."""

    session: object
    end: dict
    cycle: float  # s
    pair: float  # ns a listed pair
    pair_range: tuple
    share: float  # of a processor, least over the rounds: below 1 (threads) others used it too


def by_turns(sessions, rounds, seconds, log=lambda text: None):
    """Rows of the sessions, in each round of which every session has one block of about `seconds`,
    first the one and then the other. Sessions of one scene run the same number of cycles."""
    warm = {id(s): s.block(WARM_UP) for s in sessions}
    length = {}
    for s in sessions:
        scene = s.scene, isinstance(s, Ours)
        length[scene] = max(length.get(scene, 0.0), warm[id(s)].wall / WARM_UP)
    blocks = {id(s): [] for s in sessions}
    for turn in range(rounds):
        order = sessions if turn % 2 == 0 else sessions[::-1]
        for s in order:
            cycles = max(1, round(seconds / length[s.scene, isinstance(s, Ours)]))
            blocks[id(s)].append(s.block(cycles))
        log(f"round {turn + 1} of {rounds}")
    clock = any(s.threads > 1 for s in sessions)
    return [row_of(s, blocks[id(s)], clock) for s in sessions]


def row_of(session, blocks, clock):
    """Of times on the clock, or of processor time."""
    time = [b.wall if clock else b.cpu for b in blocks]
    pairs = [1e9 * t / max(b.pair_cycles, 1.0) for t, b in zip(time, blocks)]
    return Row(session=session, end=blocks[-1].end,
               cycle=statistics.median(t / b.cycles for t, b in zip(time, blocks)),
               pair=statistics.median(pairs), pair_range=(min(pairs), max(pairs)),
               share=min(b.cpu / b.wall for b in blocks))


def differences(rows):
    """What answers of one scene do not agree, one line each."""
    found = []
    first, twins = {}, {}
    for row in rows:
        s, end = row.session, row.end
        if not all(math.isfinite(end[key]) for key in ("mean_stress", "touching")):
            found.append(f"{s.label}: its stress is not finite")
        if not isinstance(s, Ours):
            continue
        other = first.setdefault(s.scene, row)
        if other.end["particles"] != end["particles"]:
            found.append(f"{s.label}: {end['particles']} particles, not {other.end['particles']}")
        # Rows of one scene have run the same cycles, and threads must not show.
        twin = twins.setdefault((s.scene, s.build), row)
        if twin is not row and twin.session.ask("hash") != s.ask("hash"):
            found.append(f"{s.label}: its state has other bits than that of {twin.session.label}")
        limits = SHEARED if s.ready["shears"] else AT_REST
        for key, most in limits.items():
            if abs(end[key] - other.end[key]) > most * abs(other.end[key]):
                found.append(f"{s.label}: {key} is {end[key]:.10g}, and of {other.session.label} "
                             f"{other.end[key]:.10g}")
    return found


def binaries(given):
    """What builds are called, and their programs."""
    if given.old or given.new:
        return [(name, file) for name, file in (("old ", given.old), ("new ", given.new)) if file]
    return [("", given.program)]


def note(text):
    print(text, file=sys.stderr, flush=True)
