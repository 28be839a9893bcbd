#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a scene on a real file system that is too small for it, makes it larger, and goes on.

What has to hold is that of interrupted_runs.py: the system's reason, no half file under a whole name,
and in the end, to the byte, the files of the undisturbed run.

    unshare --map-root-user --mount small_disk.py TOOL LIBRARY SCENE FOLDER [--cases N]

It mounts a tmpfs for each case, which needs a mount namespace of its own, and root in it. LIBRARY is
that of faults.cpp, here only to count. --cases: so many sizes, spread over all from one page to what
the undisturbed run takes; 0 takes each. Ends with a line of counts; status 1 where anything was lost.
"""
import argparse
import errno
import os
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
from interrupted_runs import Lost, Runs, chosen

PAGE = os.sysconf("SC_PAGE_SIZE")
FULL = os.strerror(errno.ENOSPC)


class SmallDisk(Runs):
    def __init__(self, tool, library, scene, folder):
        super().__init__(tool, library, scene, folder)
        self.pages = sum(-(-file.stat().st_size // PAGE) for file in self.out.rglob("*") if file.is_file())
        self.clear()
        self.disk = folder / "disk"
        self.disk.mkdir(exist_ok=True)
        self.out = self.disk / "out"

    def mount(self, options):
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(self.disk)], check=True)

    def run_out_of_space(self, pages):
        """Returns how the run ended, and whether it went on from a checkpoint then."""
        self.mount(f"size={pages * PAGE}")
        try:
            ended = self.run()
            if ended.returncode not in (0, 2):
                raise Lost(f"it ended with {ended.returncode}: {ended.stderr.strip()}")
            if ended.returncode == 2 and FULL not in ended.stderr:
                raise Lost(f"it does not say why: {ended.stderr.strip()}")
            self.check_what_is_there(killed=False)
            if ended.returncode == 0 and self.contents() != self.wanted:
                raise Lost("it says that it is complete, and is not")
            self.mount(f"remount,size={8 * self.pages * PAGE}")
            return ended.returncode, self.go_on()
        finally:
            subprocess.run(["umount", str(self.disk)], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("tool", "library", "scene", "folder"):
        parser.add_argument(name, type=lambda word: Path(word).absolute())
    parser.add_argument("--cases", type=int, default=0)
    words = parser.parse_args()
    runs = SmallDisk(words.tool, words.library, words.scene, words.folder)
    counts = {"sizes": 0, "too small": 0, "resumed": 0, "anew": 0, "lost": 0}
    for pages in chosen(runs.pages, words.cases):
        counts["sizes"] += 1
        try:
            status, resumed = runs.run_out_of_space(pages)
            counts["too small"] += status != 0
            counts["resumed" if resumed else "anew"] += 1
        except Lost as why:
            counts["lost"] += 1
            print(f"{pages} pages: {why}", flush=True)
    print("small disk: " + ", ".join(f"{count} {name}" for name, count in counts.items()) +
          f"; the run takes {runs.pages} pages")
    if counts["too small"] == 0:
        print("no size was too small: this check cannot fail")
    return 1 if counts["lost"] or counts["too small"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
