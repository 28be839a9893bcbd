#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the code blocks of a page, and compares what they print.

Usage: page.py PAGE KIND SCRATCH COMMAND ...
Every block of kind KIND is followed by a block of kind text, which is what it prints; without one it prints
nothing. python: the blocks of a page are parts of one program, run by COMMAND; python,matplotlib: those that
draw, too. Other kinds: each block is a program; COMMAND compiles it
where it names {program}, or runs it, and {source} is its file. Ends with 1 where an output differs, or where
there is no block.
"""

import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "guide"))
from blocks import blocks_of  # noqa: E402

ENDINGS = {"c": "c", "fortran": "f90", "octave": "m", "python": "py"}
SEPARATOR = "---- the next block"


def blocks(page, kind):
    """Code, what it prints, and the line where it stands."""
    every = blocks_of(page.parent, page.name)
    found = []
    for block, after in zip(every, [*every[1:], None]):
        if block.kind in kind.split(","):
            found.append((block.text, after.text if after and after.kind == "text" else "", block.line - 1))
    return found


def output(arguments, folder):
    done = subprocess.run(arguments, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    return done.stdout if done.returncode == 0 else f"{done.stdout}(ended with {done.returncode})\n"


def outputs(kind, code, folder, command):
    """What each block prints."""
    if kind.startswith("python"):
        source = folder / "page.py"
        source.write_text(f'\nprint("{SEPARATOR}")\n'.join(code), encoding="utf-8")
        return output([*command, str(source)], folder).split(SEPARATOR + "\n")
    printed = []
    for number, block in enumerate(code):
        source, program = folder / f"block{number}.{ENDINGS[kind]}", folder / f"block{number}"
        source.write_text(block, encoding="utf-8")
        words = [word.format(source=source, program=program) for word in command]
        printed.append(output(words, folder))
        if any("{program}" in word for word in command) and not printed[-1]:
            printed[-1] = output([str(program)], folder)
    return printed


def main():
    page, kind, folder, command = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]).resolve(), sys.argv[4:]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    all_blocks = blocks(page, kind)
    printed = outputs(kind, [code for code, _, _ in all_blocks], folder, command)
    differ = len(printed) != len(all_blocks)
    for (_, expected, line), found in zip(all_blocks, printed):
        if found != expected:
            differ = True
            print(f"{page}:{line}: the page says\n{expected}it prints\n{found}")
    print(f"{page}: {len(all_blocks)} blocks of {kind}")
    sys.exit(differ or not all_blocks)


main()
