# SPDX-License-Identifier: MIT
"""What questions have in common: bodies and pairs, accuracies, and columns for the answers."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from tangency._bodies import NAMES, Bodies, float_rows, pair_rows, rows_of
from tangency._checks import TangencyError, integer, real
from tangency._columns import Columns
from tangency._library import call
from tangency._table import AccuracyStruct, Form

Answer = TypeVar("Answer", bound=Columns)

#: Not computed unless they are named: they take longer than the rest.
ON_DEMAND = {"normal_bound", "arm_a_bound", "arm_b_bound"}

#: Accuracies by name, as (of_size, length, normals).
ACCURACIES = {"standard": (0.0, 0.0, False), "certified": (0.0, 0.0, True), "fast": (2.0**-20, 0.0, False)}


def accuracy_pointer(accuracy: str | float, up_to: float | None = None) -> tuple[int | None, Any]:
    """Address of the C struct, or None, and what has to live as long as it is used."""
    if accuracy == "standard" and up_to is None:
        return None, None
    if isinstance(accuracy, str) and accuracy in ACCURACIES:
        of_size, length, normals = ACCURACIES[accuracy]
    else:
        try:
            of_size, length, normals = 0.0, real(accuracy, "accuracy"), False
        except TangencyError:
            raise TangencyError(f"accuracy = {accuracy!r}: must be {', '.join(ACCURACIES)}, or a length") from None
    cutoff = 0.0 if up_to is None else real(up_to, "up_to")
    if not cutoff >= 0.0:
        raise TangencyError(f"up_to = {cutoff:.17g}: must be >= 0")
    struct = AccuracyStruct(ctypes.sizeof(AccuracyStruct), of_size, length, int(normals), int(up_to is not None),
                            cutoff)
    return ctypes.addressof(struct), struct


def names_of(columns: Iterable[str] | None) -> tuple[str, ...] | None:
    """Names that may be read more than once. A single text is refused: it would be taken for its letters."""
    if columns is None:
        return None
    if isinstance(columns, (str, bytes)) or not isinstance(columns, Iterable):
        example = f"[{columns!r}]" if isinstance(columns, str) else "['gap']"
        raise TangencyError(f"columns = {columns!r}: must be a list of names, as {example}")
    return tuple(columns)


def columns_for(kind: type[Answer], count: int, columns: Iterable[str] | None, out: Answer | None = None) -> Answer:
    """The columns that are asked for: those named, all that take no longer, or those of an earlier answer."""
    if out is not None:
        _require_writable(kind, count, columns, out)
        return out
    known = [column.name for column in kind.fields]
    wanted = names_of(columns)
    if wanted is None:
        wanted = tuple(name for name in known if name not in ON_DEMAND)
    for name in wanted:
        if name not in known:
            raise TangencyError(f"columns: {name!r}: must be of {' '.join(known)}")
    answers: Answer = kind.allocated(count, wanted)
    return answers


def _require_writable(kind: type[Answer], count: int, columns: Iterable[str] | None, out: Answer) -> None:
    """Refuses an earlier answer where the library would write past a column, or what is no column's memory."""
    if type(out) is not kind:
        raise TangencyError(f"out: {type(out).__name__}: must be {kind.__name__}")
    if columns is not None:
        raise TangencyError("columns: must be None where out is given: its columns are written")
    held = vars(out)
    for column in kind.fields:
        if column.name not in held:
            continue
        array, shape = held[column.name], (count, *column.shape)
        place = f"out.{column.name}"
        if not isinstance(array, np.ndarray):
            raise TangencyError(f"{place}: {type(array).__name__}: must be an array")
        if array.shape != shape:
            raise TangencyError(f"{place}: shape {array.shape}: must be {shape}, by the number of pairs")
        if array.dtype != column.dtype:
            raise TangencyError(f"{place}: numbers of type {array.dtype}: must be {column.dtype}")
        flags = array.flags
        if not (flags.c_contiguous and flags.writeable and flags.aligned):
            raise TangencyError(f"{place}: must be C-contiguous, writeable and aligned")


def ask(name: str, *arguments: object, answers: Answer, threads: Any) -> Answer:
    """Has tangency_NAME write into the columns of answers."""
    call(name, *arguments, ctypes.byref(answers.pointers()), integer(threads, "threads"))
    return answers


class Asked:
    """Bodies and pairs of a question, however they were given."""

    def __init__(self, a: Any, b: Any, pairs: Any, separations: Any = None) -> None:
        if isinstance(a, Bodies):
            if b is not None:
                raise TangencyError("b: must be None where a are Bodies; append() joins two arrays")
            self.bodies = a
            self.pairs = None if pairs is None else pair_rows(pairs)
            self.count = len(a) // 2 if self.pairs is None else len(self.pairs)
        else:
            self._take_rows(a, b, pairs)
        self.separations = (None if separations is None
                            else float_rows(separations, 3, self.count, "separations"))

    def _take_rows(self, a: Any, b: Any, pairs: Any) -> None:
        self.bodies = Bodies(a, argument="a")
        first = len(self.bodies)
        self.pairs = None if pairs is None else pair_rows(pairs)
        if b is None:
            if self.pairs is None:
                raise TangencyError("pairs: must be given where b is not")
            self.count = len(self.pairs)
            return
        others = rows_of(b, NAMES[Form.axes], "b")
        if self.pairs is None:
            if first == 1 or len(others) == 1:
                self._repeat(a, others)
                return
            if len(others) != first:
                raise TangencyError(f"b: {len(others)} rows: must be {first}, as many as of a")
            self.count = first
        else:
            self._require_index(self.pairs[:, 0], first, "a")
            self._require_index(self.pairs[:, 1], len(others), "b")
            self.pairs = self.pairs + np.array([0, first], np.uint32)
            self.count = len(self.pairs)
        self.bodies.append(others, argument="b")

    def _repeat(self, a: Any, others: NDArray[Any]) -> None:
        """One body against many, or against none."""
        first, second = len(self.bodies), len(others)
        self.count = max(first, second) if first and second else 0
        self.pairs = np.empty((self.count, 2), np.uint32)
        self.pairs[:, 0] = np.arange(first)
        self.pairs[:, 1] = first + np.arange(second)
        self.bodies.append(others, argument="b")

    @staticmethod
    def _require_index(indices: NDArray[np.uint32], count: int, entry: str) -> None:
        wrong = np.flatnonzero(indices >= count)
        if len(wrong):
            row = int(wrong[0])
            raise TangencyError(f"pairs: row {row}: {entry} = {indices[row]}: must be below {count}, the number of "
                                "bodies", row)

    def arguments(self) -> tuple[Any, ...]:
        return (self.bodies.pointer, data_of(self.pairs), self.count, data_of(self.separations))


def data_of(array: NDArray[Any] | None) -> int | None:
    return None if array is None else array.ctypes.data
