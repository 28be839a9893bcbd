#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the blocks of kind console of README and guide with the tools as they are built, and compares what they print.

A line that begins with "$ " is a command, the lines after it are what it prints on both streams. `$ cat NAME`
of a file that is not there shows a table to be made: it is written. Blocks of a page share a directory, which
looks like the root of a clone; their tools are the first on the path.
Usage: console_blocks.py ROOT SCRATCH TOOL_FOLDER ...
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from blocks import blocks_of, user_pages


def commands_of(block):
    """(command, expected output) of a block."""
    parts = re.split(r"(?m)^\$ (.*)\n", block.text)
    if parts[0]:
        raise SystemExit(f"{block.place()}: the first line of a console has to be a command, '$ ...'")
    return list(zip(parts[1::2], parts[2::2]))


def run_block(block, place, environment):
    """What differs, as text; empty where nothing does."""
    differences = ""
    for command, expected in commands_of(block):
        shown = re.fullmatch(r"cat ([\w.-]+)", command)
        if shown and not (place / shown[1]).exists():
            (place / shown[1]).write_text(expected, encoding="utf-8")
        # `#` begins a remark for the reader, as in a shell.
        done = subprocess.run(["bash", "-c", command], cwd=place, env=environment, text=True, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.stdout != expected:
            differences += f"{block.place()}: $ {command}\n--- the page says\n{expected}+++ it prints\n{done.stdout}"
    return differences


def main():
    root, scratch = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    environment = dict(os.environ, LC_ALL="C.UTF-8")
    environment["PATH"] = os.pathsep.join([*(str(pathlib.Path(folder).resolve()) for folder in sys.argv[3:]),
                                           environment["PATH"]])
    shutil.rmtree(scratch, ignore_errors=True)
    differences, commands = "", 0
    for page in user_pages(root):
        place = scratch / page.replace("/", "_")
        place.mkdir(parents=True)
        for entry in root.iterdir():
            if not entry.name.startswith(".") and entry.name != "build":
                (place / entry.name).symlink_to(entry)
        for block in blocks_of(root, page):
            if block.kind == "console":
                differences += run_block(block, place, environment)
                commands += len(commands_of(block))
    print(differences, end="")
    print(f"{commands} commands, {differences.count('+++ it prints')} differ")
    return 1 if differences or not commands else 0


sys.exit(main())
