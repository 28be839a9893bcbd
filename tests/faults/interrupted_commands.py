#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that write one file, interrupted at their calls that change files and at their allocations.

After each fault the file is what it was before or all that the command writes; a command that failed
says why in one line and has the status 2. Where memory ends within GMP its line and abort() are
allowed (docs/decisions/0009-broken-contracts-end-the-process.md).

    interrupted_commands.py KERNEL-TOOL SIMULATOR LIBRARY SCENE FOLDER [--cases N]

Ends with a line of counts; status 1 where a file was lost or a command ended otherwise.
"""
import argparse
import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

EARLIER = b"what was there before\n"
# How each kind fails, what is counted, and what is said.
KINDS = {
    "kill": ("files", "{}:kill", None),
    "full": ("files", "{}+:%d" % errno.ENOSPC, os.strerror(errno.ENOSPC)),
    "input-output": ("files", "{}:%d" % errno.EIO, os.strerror(errno.EIO)),
    "memory": ("memory", "{}:%d" % errno.ENOMEM, "memory"),
    "memory-ends": ("memory", "{}+:%d" % errno.ENOMEM, "memory"),
}
# Two spheres at a touch and two nearly, which the exact tier decides, among others.
PAIRS = "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n" + "".join(
    f"0,0,0,1,1,1,{x},0,0,1,1,1\n0,0,0,3,2,1,{x + 2},0.5,0.25,1,2,3\n0,0,0,1,2,3,0,{x + 1},0,3,2,1\n"
    for x in (2, 2.0000000000000004, 1.5, 4))


def run(command, library, fault=None, counts=None):
    environment = dict(os.environ, LD_PRELOAD=str(library))
    if fault:
        environment["TANGENCY_FAULT"] = fault
    if counts:
        environment["TANGENCY_FAULT_COUNT"] = str(counts)
    return subprocess.run([str(word) for word in command], env=environment, capture_output=True,
                          check=False)


def chosen(events, cases):
    """So many events, spread over all; each of them for 0."""
    if cases == 0 or cases >= events:
        return range(1, events + 1)
    return [1 + k * (events - 1) // max(cases - 1, 1) for k in range(cases)]


def fault_of(ended, reason, content, wanted):
    """What a command must not have done; nothing where all is well."""
    if content not in (EARLIER, wanted):
        return "its file is neither the earlier one nor whole"
    if reason is None:
        return None if ended.returncode == -signal.SIGKILL else "it was not killed"
    if ended.returncode == 0:
        return None if content == wanted else "it says that it is done, and is not"
    if ended.returncode == -signal.SIGABRT and b"GNU MP" in ended.stderr:
        return None
    if ended.returncode != 2:
        return f"it ended with {ended.returncode}: {ended.stderr.decode().strip()}"
    if reason.encode() not in ended.stderr or ended.stderr.count(b"\n") != 1:
        return f"it does not say why in one line: {ended.stderr.decode().strip()}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("kernel", "simulator", "library", "scene", "folder"):
        parser.add_argument(name, type=lambda path: Path(path).absolute())
    parser.add_argument("--cases", type=int, default=0)
    words = parser.parse_args()
    words.folder.mkdir(parents=True, exist_ok=True)
    pairs, out = words.folder / "pairs.csv", words.folder / "out"
    pairs.write_text(PAIRS)
    made = words.folder / "run"
    subprocess.run([words.simulator, "run", words.scene, "--out", made, "--quiet", "--replace"],
                   check=True, capture_output=True)
    state = made / "final.state"
    commands = {
        "contact": [words.kernel, "contact", "--out", out, pairs],
        "overlap": [words.kernel, "overlap", "--out", out, pairs],
        "contacts": [words.simulator, "contacts", state, "--out", out],
        "micro": [words.simulator, "micro", state, "--json", out],
        "export": [words.simulator, "export", state, "--format", "gsd", "--out", out],
    }
    faults = lost = 0
    for name, command in commands.items():
        out.write_bytes(EARLIER)
        first = run(command, words.library, counts=words.folder / "counts")
        if first.returncode not in (0, 1):
            raise SystemExit(f"{name} ended with {first.returncode}: {first.stderr.decode()}")
        files, memory = map(int, (words.folder / "counts").read_text().split())
        wanted, events = out.read_bytes(), {"files": files, "memory": memory}
        told = []
        for kind, (what, how, reason) in KINDS.items():
            events_of_kind = chosen(events[what], words.cases)
            told.append(f"{len(events_of_kind)} {kind}")
            for event in events_of_kind:
                out.write_bytes(EARLIER)
                ended = run(command, words.library, f"{what}:{how.format(event)}")
                faults += 1
                if fault := fault_of(ended, reason, out.read_bytes(), wanted):
                    lost += 1
                    print(f"{name}, {kind} at {event}: {fault}", flush=True)
        print(f"{name}: {', '.join(told)}; of {files} calls and {memory} allocations", flush=True)
    print(f"{faults} faults, {lost} with a loss")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
