# SPDX-License-Identifier: MIT
"""Runs of the simulator: start them, and read what they write.

A table is a structured array, whose columns are those of the file: ``history["friction_angle_deg"]``, and
``pandas.DataFrame(history)`` is a data frame. Lengths, masses and times are in the units of the scene;
compression is positive in stress and in axial strain, volumetric strain is positive in dilation.
"""

from __future__ import annotations

import csv
import json
import os
import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tangency import _programs
from tangency._programs import ProgramError

__all__ = ["Frame", "ProgramError", "Run", "Sweep", "contacts", "frames", "history", "particles", "read_table",
           "run"]

PathLike = str | os.PathLike[str]


def read_table(path: PathLike) -> NDArray[Any]:
    """A CSV table as a structured array: columns of numbers as float64, others as text.

    Raises
    ------
    ValueError
        A row that is shorter or longer than the header.
    """
    with open(path, newline="", encoding="utf-8") as lines:
        return _table(lines, str(path))


def _table(lines: Iterable[str], name: str) -> NDArray[Any]:
    reader = csv.reader(line for line in lines if line.strip() and not line.lstrip().startswith("#"))
    header = [cell.strip() for cell in next(reader)]
    rows = list(reader)
    for k, row in enumerate(rows):
        if len(row) != len(header):
            raise ValueError(f"{name}: row {k}: {len(row)} cells: must be {len(header)}")
    columns = [_column([row[i] for row in rows]) for i in range(len(header))]
    table = np.empty(len(rows), [(title, column.dtype) for title, column in zip(header, columns)])
    for title, column in zip(header, columns):
        table[title] = column
    return table


def _column(cells: list[str]) -> NDArray[Any]:
    try:
        return np.array([float(cell) if cell.strip() else np.nan for cell in cells])
    except ValueError:
        return np.array([cell.strip() for cell in cells])


def history(path: PathLike) -> NDArray[Any]:
    """The samples of a run: `path` is its folder or its ``history.csv``."""
    place = Path(path)
    return read_table(place / "history.csv" if place.is_dir() else place)


@dataclass
class Frame:
    """One frame of ``frames.xyz``.

    Attributes
    ----------
    columns : dict of ndarray
        By name, of each particle; ``species`` as text, others (N,) or (N, k).
    cell : ndarray, shape (3, 3)
        Edge vectors, one a row (length).
    properties : dict of str
        The other words of the frame's line, ``Time`` and ``cycle``.
    """

    columns: dict[str, NDArray[Any]]
    cell: NDArray[np.float64]
    properties: dict[str, str]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))


def frames(path: PathLike) -> Iterator[Frame]:
    """The frames of a run, one after the other: `path` is its folder or its ``frames.xyz`` (extended XYZ).

    Raises
    ------
    ValueError
        A frame that breaks off.
    """
    place = Path(path)
    place = place / "frames.xyz" if place.is_dir() else place
    with open(place, encoding="utf-8") as lines:
        for number, count in enumerate(lines):
            if not count.strip():
                continue
            words = dict(word.split("=", 1) for word in shlex.split(next(lines)) if "=" in word)
            rows = [line.split() for _, line in zip(range(int(count)), lines)]
            if len(rows) != int(count):
                raise ValueError(f"{place}: frame {number}: {len(rows)} particles: must be {int(count)}")
            yield _frame(words, rows)


def _frame(words: dict[str, str], rows: list[list[str]]) -> Frame:
    described = words.pop("Properties").split(":")
    cell = np.array(words.pop("Lattice").split(), np.float64).reshape(3, 3)
    columns: dict[str, NDArray[Any]] = {}
    at = 0
    for name, kind, width in zip(described[::3], described[1::3], map(int, described[2::3])):
        dtype: Any = {"R": np.float64, "I": np.int64, "S": str}[kind]
        block = np.array([row[at:at + width] for row in rows], dtype)
        columns[name] = block[:, 0] if width == 1 else block
        at += width
    return Frame(columns, cell, words)


@dataclass(frozen=True, init=False)
class Run:
    """A run: one that `run` has started, or ``Run("out")`` of an earlier day.

    Attributes
    ----------
    folder : Path
        What it wrote.
    messages : str
        What it said meanwhile, where `run` has started it.
    """

    folder: Path
    messages: str

    def __init__(self, folder: PathLike, messages: str = "") -> None:
        object.__setattr__(self, "folder", Path(folder))
        object.__setattr__(self, "messages", messages)

    @property
    def history(self) -> NDArray[Any]:
        return history(self.folder)

    @property
    def summary(self) -> dict[str, Any]:
        """``summary.json``."""
        result: dict[str, Any] = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        return result

    @property
    def final_state(self) -> Path:
        return self.folder / "final.state"

    def frames(self) -> Iterator[Frame]:
        return frames(self.folder)


@dataclass(frozen=True, init=False)
class Sweep:
    """The runs of a scene with ``[sweep]``: ``Sweep("out")``.

    Attributes
    ----------
    folder : Path
        What they wrote.
    """

    folder: Path

    def __init__(self, folder: PathLike) -> None:
        object.__setattr__(self, "folder", Path(folder))

    @property
    def table(self) -> NDArray[Any]:
        """``sweep.csv``, a row a run: `folder`, `status`, what is varied, and the numbers of its ``summary.json``."""
        return read_table(self.folder / "sweep.csv")

    @property
    def runs(self) -> list[Run]:
        """Those of the table, in its order."""
        return [Run(self.folder / str(name)) for name in self.table["folder"]]

    @property
    def history(self) -> NDArray[Any]:
        """The histories of all runs that have one, one below the other.

        Before the columns of ``history.csv`` stand `folder` and what is varied, as in `table`.

        Raises
        ------
        ValueError
            No run has one yet.
        """
        table = self.table
        own = ["folder", *(name for name in table.dtype.names or () if "." in name)]  # keys by their path
        parts = []
        for row, one in zip(table, self.runs):
            if not (one.folder / "history.csv").exists():
                continue
            part = one.history
            whole = np.empty(len(part), [(name, table.dtype[name]) for name in own] + part.dtype.descr)
            for name in whole.dtype.names or ():
                whole[name] = row[name] if name in own else part[name]
            parts.append(whole)
        if not parts:
            raise ValueError(f"{self.folder}: no run has a history.csv yet")
        return np.concatenate(parts)


def run(scene: PathLike, out: PathLike, *, settings: Mapping[str, Any] | None = None, threads: int = 1,
        resume: PathLike | None = None, replace: bool = False, program: str | None = None) -> Run:
    """Runs a scene, as ``tangency-dem run`` does. `Sweep` reads what one with ``[sweep]`` leaves.

    Parameters
    ----------
    scene : path
        A TOML file; ``tangency-dem schema`` names its keys.
    out : path
        Folder for the results.
    settings : mapping, optional
        Keys by their path, and the values that they have in this run: ``{"stage.place.seed": 2}``, as ``--set``.
    threads : int
        They change no bit.
    resume : path, optional
        A state to go on from.
    replace : bool
        Whether results that `out` has from an earlier run are taken away, as by ``--replace``.
    program : str, optional
        By default TANGENCY_DEM of the environment, or ``tangency-dem`` on the path.

    Raises
    ------
    ProgramError
        A scene that is refused: its file, line, key and what is allowed.
    """
    arguments = [_programs.found("tangency-dem", program), "run", os.fspath(scene), "--out", os.fspath(out),
                 "--threads", str(threads), "--quiet"]
    if resume is not None:
        arguments += ["--resume", os.fspath(resume)]
    if replace:
        arguments.append("--replace")
    return Run(Path(out), _programs.run(arguments + _set(settings)).stderr)


def _set(settings: Mapping[str, Any] | None) -> list[str]:
    return [word for key, value in (settings or {}).items() for word in ("--set", f"{key}={_toml_text(value)}")]


def _toml_text(value: Any) -> str:
    """A value of a key as TOML writes it: texts, numbers, truths and lists are those of JSON."""

    def plain(one: Any) -> Any:
        return one.tolist() if isinstance(one, (np.ndarray, np.generic)) else os.fspath(one)
    return json.dumps(value, default=plain)


def contacts(state: PathLike, *, scene: PathLike | None = None, settings: Mapping[str, Any] | None = None,
             program: str | None = None) -> NDArray[Any]:
    """The contacts of a state, a row each: ``a b ix iy iz x y z nx ny nz gap ...``.

    Parameters
    ----------
    state : path
        A ``final.state``, ``checkpoint.state`` or one of ``states/`` of a run.
    scene : path, optional
        The scene of the run. It is needed where a stage has a `friction_coefficient` of its own: the column `sliding`
        then goes by the friction to which the state's stage has come.
    settings : mapping, optional
        Those of the run.
    program : str, optional
        As of `run`.
    """
    of_scene = [] if scene is None else ["--scene", os.fspath(scene)]
    return _of_state("contacts", state, program, of_scene + _set(settings))


def particles(state: PathLike, *, program: str | None = None) -> NDArray[Any]:
    """The particles of a state, a row each; `tangency.contacts` takes them as they are."""
    return _of_state("particles", state, program)


def _of_state(command: str, state: PathLike, program: str | None, more: Sequence[str] = ()) -> NDArray[Any]:
    done = _programs.run([_programs.found("tangency-dem", program), command, os.fspath(state), *more])
    return _table(done.stdout.splitlines(keepends=True), os.fspath(state))
