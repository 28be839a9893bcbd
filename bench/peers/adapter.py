# SPDX-License-Identifier: GPL-3.0-or-later
"""What the adapters in Python share: the grader's tables, and the two forms of their command line.

    PROGRAM --list   a line a code, tab between: its name here, library, version, call and options,
                     and the --definition that it is graded by; none where its package is not there
    PROGRAM NAME     reads a table of pairs on standard input, answers it on standard output

A pair of which a code has no answer has no line; the last line on standard error counts them.
"""
import csv
import sys
from dataclasses import dataclass
from typing import Callable, Iterable, Optional

FIELDS = ("x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz")


@dataclass(frozen=True)
class Body:
    """Centre, semi-axes along body axes, and a quaternion w x y z of any length but 0."""

    centre: tuple
    semi_axes: tuple
    quaternion: tuple


@dataclass(frozen=True)
class Contact:
    """Gap > 0 apart, < 0 overlapping; a unit normal from a to b, where the code has one."""

    overlaps: bool
    gap: float
    normal: Optional[tuple] = None


@dataclass(frozen=True)
class Code:
    """One code with its options; `answers` takes all pairs and gives a Contact or None for each."""

    name: str
    library: str
    version: str
    call: str
    options: str
    definition: str
    answers: Callable[[list], Iterable[Optional[Contact]]]


def number(text: str) -> float:
    return float.fromhex(text) if "x" in text else float(text)


def read_pairs(lines: Iterable[str]) -> list:
    """The pairs (a, b) of a table with the columns a.x ... b.qz."""
    pairs = []
    for row in csv.DictReader(lines):
        bodies = []
        for who in "ab":
            v = [number(row[f"{who}.{field}"]) for field in FIELDS]
            bodies.append(Body(tuple(v[:3]), tuple(v[3:6]), tuple(v[6:])))
        pairs.append(tuple(bodies))
    return pairs


def answer(code: Code) -> None:
    failed = 0
    print("row,overlaps,gap,nx,ny,nz")
    for row, contact in enumerate(code.answers(read_pairs(sys.stdin))):
        if contact is None:
            failed += 1
            continue
        normal = ["", "", ""] if contact.normal is None else [f"{n:.17g}" for n in contact.normal]
        print(row, int(contact.overlaps), f"{contact.gap:.17g}", *normal, sep=",")
    print(f"{failed} pairs failed, 0 ended the program, 0 hung", file=sys.stderr)


def main(codes: list) -> int:
    if len(sys.argv) != 2:
        print(f"usage: {sys.argv[0]} --list | NAME", file=sys.stderr)
        return 2
    if sys.argv[1] == "--list":
        for c in codes:
            print(c.name, c.library, c.version, c.call, c.options, c.definition, sep="\t")
        return 0
    for code in codes:
        if code.name == sys.argv[1]:
            answer(code)
            return 0
    print(f"{sys.argv[0]}: {sys.argv[1]} is no code; --list names all", file=sys.stderr)
    return 2
