# SPDX-License-Identifier: MIT
"""Grades a function against the exact truth, by ``tangency-verify grade``."""

from __future__ import annotations

import csv
import json
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tangency import _programs
from tangency._programs import ProgramError

__all__ = ["CORPORA", "GRADED", "Grade", "ProgramError", "grade"]

#: Those of pairs of ellipsoids.
CORPORA = ("classes", "near", "touching", "symmetric", "nested", "extreme", "deep", "profiles")

#: Columns that a function may answer.
GRADED = ("relation", "overlaps", "gap", "gap_error", "normal", "nx", "ny", "nz", "status")

#: What a function is given: rows x y z r1 r2 r3 qw qx qy qz of all A and of all B.
Rows = NDArray[np.float64]
Answers = Mapping[str, Any]


@dataclass(frozen=True)
class Grade:
    """Grade of one corpus.

    Attributes
    ----------
    corpus : str
    passed : bool
        Nothing is wrong or missing, and every threshold is kept.
    verdict : str
        The last line of the table.
    table : str
        As ``tangency-verify grade`` prints it, family by family.
    values : dict
        Name to (value, unit).
    """

    corpus: str
    passed: bool
    verdict: str
    table: str
    values: dict[str, tuple[float, str]]


def grade(function: Callable[[Rows, Rows], Answers], corpora: Sequence[str] = CORPORA, *,
          max_gap_error: float | None = None, max_normal_error: float | None = None,
          definition: str = "common-normal", program: str | None = None) -> list[Grade]:
    """Asks a function about the pairs of corpora, and grades what it answers.

    Parameters
    ----------
    function : callable
        ``function(a, b)`` of two arrays (N, 10) returns columns of N rows by name, any of `GRADED`: ``relation``
        (names, or numbers of `tangency.Relation`), ``overlaps``, ``gap``, ``gap_error``, ``normal`` (N, 3) or
        ``nx ny nz``, ``status``.
    corpora : sequence of str
        Of `CORPORA`.
    max_gap_error, max_normal_error : float, optional
        Thresholds: |gap - truth| over the size of the pair, and the length of the normal's error.
    definition : str
        What gap and normal mean: common-normal, perram-wertheim, midpoint-potential or centre-line.
    program : str, optional
        By default TANGENCY_VERIFY of the environment, or ``tangency-verify`` on the path.

    Raises
    ------
    ProgramError
        A program, corpus or definition that there is not.
    ValueError
        A column that is not graded, or of another shape.
    """
    path = _programs.found("tangency-verify", program)
    options = ["--definition", definition]
    for name, value in (("--max-gap-error", max_gap_error), ("--max-normal-error", max_normal_error)):
        if value is not None:
            options += [name, repr(float(value))]
    with tempfile.TemporaryDirectory(prefix="tangency-grade-") as folder:
        return [_graded(path, corpus, function, options, Path(folder)) for corpus in corpora]


def _graded(path: str, corpus: str, function: Callable[[Rows, Rows], Answers], options: list[str],
            folder: Path) -> Grade:
    inputs = _inputs(path, corpus, folder)
    answers = _flat(function(inputs[:, :10].copy(), inputs[:, 10:].copy()), len(inputs))
    with open(folder / "answers.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["row", *answers])
        for k in range(len(inputs)):
            writer.writerow([k, *(_cell(column[k]) for column in answers.values())])
    report = folder / "grade.json"
    done = _programs.run([path, "grade", "--answers", str(folder / "answers.csv"), "--corpus", corpus,
                          "--json", str(report), *options], good=(0, 1))
    values = {each["name"]: (each["value"], each["unit"]) for each in json.loads(report.read_text())}
    return Grade(corpus, done.returncode == 0, done.stdout.strip().splitlines()[-1], done.stdout, values)


def _inputs(path: str, corpus: str, folder: Path) -> Rows:
    """A corpus as the grader hands it to a tool, which here keeps it and answers nothing."""
    file = folder / f"{corpus}.csv"
    done = _programs.ended([path, "grade", "--tool", "cat > inputs.csv", "--corpus", corpus], folder)
    kept = folder / "inputs.csv"
    if not kept.exists():
        said = done.stderr.strip().splitlines()
        raise ProgramError(said[-1] if said else f"{corpus}: no inputs", done.returncode)
    kept.rename(file)
    with open(file, newline="", encoding="utf-8") as lines:
        reader = csv.reader(lines)
        if next(reader)[0] != "a.x":
            raise ValueError(f"corpora: {corpus!r}: must be of {' '.join(CORPORA)}")
        return np.array([[float.fromhex(cell) for cell in row] for row in reader])


def _flat(answers: Answers, count: int) -> dict[str, Any]:
    from tangency import Relation  # which loads the library: a function under test may do without

    if not isinstance(answers, Mapping):
        raise ValueError(f"the function answered {type(answers).__name__}: must be a mapping of columns by name, "
                         f"any of {' '.join(GRADED)}")
    flat: dict[str, Any] = {}
    for name, column in answers.items():
        if name not in GRADED:
            raise ValueError(f"{name}: is not graded: must be of {' '.join(GRADED)}")
        rows = np.asarray(column)
        shape = (count, 3) if name == "normal" else (count,)
        if rows.shape != shape:
            raise ValueError(f"{name}: shape {rows.shape}: must be {shape}")
        if name == "normal":
            flat.update(nx=rows[:, 0], ny=rows[:, 1], nz=rows[:, 2])
        elif name == "relation" and rows.dtype.kind in "iu":
            wrong = np.flatnonzero((rows < 0) | (rows >= len(Relation)))
            if len(wrong):
                raise ValueError(f"relation: row {wrong[0]}: {rows[wrong[0]]}: must be from 0 to {len(Relation) - 1}")
            flat[name] = [Relation(value).name for value in rows]
        elif name == "status" and rows.dtype.kind in "iu":
            flat[name] = ["ok" if value == 0 else "local" for value in rows]
        elif name == "overlaps":
            flat[name] = rows.astype(int)
        else:
            flat[name] = rows
    return flat


def _cell(value: Any) -> str:
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)
