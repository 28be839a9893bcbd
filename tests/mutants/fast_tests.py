# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests of the merge gate that geometry/ can fail, in the order that finds a mutant soonest."""
import collections
import dataclasses
import functools
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
import time

PROPERTY_SEED = "seed=20261122 max_success=1000"  # the gate's
GTESTS = {"tests_geometry": "geometry", "tests_geometry_allocation": "geometry",
          "tests_tool": "tool", "tests_grade": "grade"}
PAIR_CORPORA = ("classes", "near", "touching", "symmetric", "nested", "extreme", "deep")
# The gate's own commands beside its GoogleTest programs: tests/grade and tests/verify.
GRADE = ["{tangency-verify}", "grade", "--max-wrong", "0"]
PAIRS = [word for corpus in PAIR_CORPORA for word in ("--corpus", corpus)]
PRECISE = ["--max-gap-error", "8.9e-16"]
COMMANDS = {
    "grade/pairs": GRADE + PAIRS + PRECISE + ["--tool", "{tangency} contact"],
    "grade/perram-wertheim": GRADE + PAIRS + PRECISE + [
        "--definition", "perram-wertheim", "--tool", "{tangency} contact --method perram-wertheim"],
    "grade/midpoint-potential": GRADE + PAIRS + PRECISE + [
        "--definition", "midpoint-potential",
        "--tool", "{tangency} contact --method midpoint-potential"],
    "grade/ellipses": GRADE + PRECISE + ["--corpus", "ellipses", "--tool", "{tangency} ellipse"],
    "grade/quadrics": GRADE + ["--corpus", "quadrics", "--tool", "{tangency} classify"],
    "verify/relation": ["{relation_agreement}", "--per-class", "2000", "--adversarial", "2000"],
    "verify/gap": ["{gap_agreement}", "--per-family", "100"],
    "verify/primitives": ["{primitives_agreement}", "--count", "5000"],
    "verify/ray": ["{ray_agreement}", "--count", "5000"],
    "verify/quartic": ["{quartic_agreement}", "--count", "4000"],
    "verify/time_of_contact": ["{time_of_contact_agreement}", "--count", "1200", "--spins", "1000"],
    "verify/ellipses": ["{ellipse_agreement}", "--share", "0.01", "--numbers", "20"],
    "verify/batch": ["{batch_agreement}", "--per-family", "100", "--with-oracle", "2"],
}
# Whose tests these are, as the rooms of the others follow from their names.
ROOMS = {"grade/pairs": "geometry/tool/contact", "grade/perram-wertheim": "geometry/tool/contact",
         "grade/midpoint-potential": "geometry/tool/contact",
         "grade/ellipses": "geometry/tool/ellipse", "grade/quadrics": "geometry/tool/classify",
         **{name: f"tests/{name}_agreement" for name in COMMANDS if name.startswith("verify/")}}
OF_THE_TOOL = ("tests_tool/", "tests_grade/", "grade/")
FAR = 4  # includes: where the tests of the tool's commands stand, which start it

# A hang is a kill. CPU seconds, so that others' work on the machine does not count; chosen.
SLOWER = 5.0
SLACK = 10.0
IDLE, LOOK = 60.0, 5.0  # wall seconds without CPU time: a deadlock; how often that is looked at
MEMORY = 6 << 30
CHUNK = 2.0  # clean CPU seconds of tests in one process; chosen
NAMES = re.compile(r"(?:^|\n)(?:TYPED_|RC_GTEST_)?(?:TEST(?:_F|_P)?|(?:FIXTURE_)?PROP)\((\w+),\s*(\w+)")
INCLUDE = re.compile(r"#include <tangency/([\w/.-]+)>")


@dataclasses.dataclass
class Outcome:
    passed: bool
    by: str = ""  # what failed, and how
    seconds: float = 0.0


def _room(name):
    """What a header declares the source of its name defines, so the two are one."""
    return re.sub(r"\.[ch]pp$", "", name)


@functools.lru_cache
def _users(root):
    """Of a room, those that include it. A source without a header of its name defines something of
    those that it includes from its folder, so these count as its users too."""
    users = collections.defaultdict(set)
    for folder in ("geometry", "tests", "verify/families", "verify"):
        for path in pathlib.Path(root, folder).rglob("*.[ch]pp"):
            name = path.relative_to(root).as_posix()
            for used in INCLUDE.findall(path.read_text()):
                users[_room(used)].add(_room(name))
                if not path.with_suffix(".hpp").exists() and (
                        used.rpartition("/")[0] == name.rpartition("/")[0]):
                    users[_room(name)].add(_room(used))
    return users


def distances(root, file):
    """How many includes away from a file of geometry/ each room is that may depend on it."""
    users = _users(root)
    away, waiting = {_room(file): 0}, [_room(file)]
    for used in waiting:
        for user in sorted(users[used] - set(away)):
            away[user] = away[used] + 1
            waiting.append(user)
    return away


class FastTests:
    """
    @param tree     built without a mutant
    @param slowest  CPU seconds: tests that take longer without a mutant are left out
    """

    def __init__(self, tree, slowest):
        self.tree, self.slowest = tree, slowest
        self.paths = {p.name: p for p in tree.build.rglob("*")
                      if p.is_file() and os.access(p, os.X_OK) and "CMakeFiles" not in p.parts}
        self.seconds = {}  # of each test without a mutant
        self.room_of = self._rooms()
        self.killers = collections.defaultdict(list)  # of a file, latest first

    def measure(self, digest):
        """Runs all of them without a mutant, but those that were too slow before; none where it is
        known that texts of this digest pass. Returns what failed."""
        memory = self.tree.place / "seconds.json"
        before = json.loads(memory.read_text()) if memory.exists() else {}
        known = before.get("seconds", {})
        if before.get("digest") == digest and before["slowest"] >= self.slowest:
            self._take(known)
            return []
        failed = []
        for program in GTESTS:
            slow = [t.split("/", 1)[1] for t, s in known.items()
                    if t.startswith(program + "/") and s > self.slowest]
            with tempfile.NamedTemporaryFile(suffix=".json") as report:
                outcome = self._run([self.paths[program], f"--gtest_output=json:{report.name}",
                                     f"--gtest_filter=-{':'.join(slow)}"], 1e6)
                if not outcome.passed:
                    failed.append(outcome.by)
                    continue
                suites = json.load(report)["testsuites"]
            took = {f"{program}/{suite['name']}.{test['name']}": float(test["time"].rstrip("s"))
                    for suite in suites for test in suite["testsuite"]}
            cpu_share = outcome.seconds / max(outcome.seconds, sum(took.values()))
            self.seconds.update({name: cpu_share * wall for name, wall in took.items()})
        for name in COMMANDS:
            outcome = self._run(self._command(name), 1e6)
            self.seconds[name] = outcome.seconds
            if not outcome.passed:
                failed.append(f"{name}: {outcome.by}")
        self._take({**known, **self.seconds})
        if not failed:
            memory.write_text(json.dumps({"digest": digest, "slowest": self.slowest,
                                          "seconds": {**known, **self.seconds}}))
        return failed

    def _take(self, seconds):
        self.seconds = {t: s for t, s in seconds.items() if s <= self.slowest or t in COMMANDS}

    def run(self, file):
        """All tests that the file can fail, until one does."""
        spent = 0.0
        for tests in self._chunks(file):
            clean = sum(self.seconds[t] for t in tests)
            if tests[0] in COMMANDS:
                outcome = self._run(self._command(tests[0]), clean)
            else:
                program = tests[0].split("/")[0]
                names = ":".join(t.split("/", 1)[1] for t in tests)
                outcome = self._run([self.paths[program], "--gtest_fail_fast",
                                     f"--gtest_filter={names}"], clean)
            spent += outcome.seconds
            if not outcome.passed:
                name = self._remember(file, tests, outcome)
                return Outcome(False, name, spent)
        return Outcome(True, "", spent)

    def _remember(self, file, tests, outcome):
        culprit = next((t for t in tests if t.split("/", 1)[1] in outcome.by), tests[0])
        killers = self.killers[file]
        if culprit in killers:
            killers.remove(culprit)
        killers.insert(0, culprit)
        return outcome.by if culprit.split("/", 1)[1] in outcome.by else f"{culprit}: {outcome.by}"

    def _rooms(self):
        rooms = {}
        for path in pathlib.Path(self.tree.source, "tests").rglob("*_test.cpp"):
            room = path.relative_to(self.tree.source).with_suffix("").as_posix()
            for suite, name in NAMES.findall(path.read_text()):
                rooms[f"{suite}.{name}"] = room
        return rooms

    def _chunks(self, file):
        """Lists of tests, each of one program. First what killed mutants of the file before, then
        the nearest tests, and of those the cheap ones first. Left out are those which no includes
        lead to."""
        away = distances(self.tree.source, file)
        of_tool = file.startswith(("geometry/tool/", "geometry/tables/"))

        def far(test):
            room = ROOMS.get(test) or self.room_of.get(test.split("/", 1)[1], "")
            return away.get(room, FAR if of_tool or "tool/" in room and "command" in room else None)

        reached = {t: far(t) for t in self.seconds
                   if far(t) is not None and (not of_tool or t.startswith(OF_THE_TOOL))}
        known = [t for t in self.killers[file][:4] if t in reached]
        chunks, open_chunks = [[t] for t in known], {}
        for test in sorted(reached.keys() - set(known),
                           key=lambda t: (2.0 ** reached[t] * (0.05 + self.seconds[t]), t)):
            program = test if test in COMMANDS else test.split("/")[0]
            chunk = open_chunks.get(program)
            if chunk is None or sum(self.seconds[t] for t in chunk) + self.seconds[test] > CHUNK:
                chunk = open_chunks[program] = []
                chunks.append(chunk)
            chunk.append(test)
        return chunks

    def _command(self, name):
        return [re.sub(r"\{([\w-]+)\}", lambda found: str(self.paths[found[1]]), word)
                for word in COMMANDS[name]]

    def _run(self, command, clean):
        limit = SLOWER * clean + SLACK
        def prepare():
            os.setsid()
            resource.setrlimit(resource.RLIMIT_CPU, (int(limit) + 1, int(limit) + 6))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile() as output:
            child = subprocess.Popen(
                [str(word) for word in command], stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, cwd=folder, preexec_fn=prepare,
                env={**os.environ, "RC_PARAMS": PROPERTY_SEED, "TMPDIR": folder})
            idle, seconds = _wait(child)
            output.seek(0)
            text = output.read().decode(errors="replace")
        if child.returncode == 0:
            return Outcome(True, "", seconds)
        return Outcome(False, _culprit(text, child.returncode, idle), seconds)


def _group_ticks(group):
    """CPU ticks of the living processes of a session, and whether any of them is stopped, or would
    go on if the machine let it."""
    ticks, stopped = 0, False
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[3]) == group:
            ticks += int(fields[11]) + int(fields[12])
            stopped |= fields[0] in "TRD"
    return ticks, stopped


def _wait(child):
    """Waits for the end of the child. One whose processes stand still without being stopped has
    locked itself up and is ended. Returns whether it did, and the CPU seconds."""
    still, last, pause, next_look = 0.0, -1, 0.002, time.monotonic() + LOOK
    while not os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT):
        time.sleep(pause)
        pause = min(0.1, 1.5 * pause)
        if time.monotonic() < next_look:
            continue
        next_look = time.monotonic() + LOOK
        ticks, stopped = _group_ticks(child.pid)
        still = 0.0 if ticks != last or stopped else still + LOOK
        last = ticks
        if still >= IDLE:
            break
    os.killpg(child.pid, signal.SIGKILL)  # and what it left behind
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return still >= IDLE, usage.ru_utime + usage.ru_stime


def _culprit(text, status, idle):
    failed = re.search(r"\[  FAILED  \] ([\w/]+\.[\w/]+)", text)
    if failed and failed[1] + " (" in text:
        return failed[1]
    running = re.findall(r"\[ RUN      \] ([\w/]+\.[\w/]+)", text)
    where = running[-1] + ": " if running else ""
    if idle:
        return where + "stands still"
    if status in (-signal.SIGXCPU, -signal.SIGKILL):
        return where + "does not end"
    if status < 0:
        return where + signal.Signals(-status).name
    return where + f"exit status {status}" if not failed else failed[1]
