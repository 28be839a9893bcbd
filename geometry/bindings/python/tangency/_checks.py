# SPDX-License-Identifier: MIT
"""What is refused, and numbers that are checked before the library is called."""

from __future__ import annotations

import operator
from enum import IntEnum
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Enumeration = TypeVar("Enumeration", bound=IntEnum)


class TangencyError(ValueError):
    """Numbers that the library refuses.

    Attributes
    ----------
    row : int or None
        The row of the argument that was refused, from 0.
    """

    def __init__(self, message: str, row: int | None = None) -> None:
        super().__init__(message)
        self.row = row


def integer(value: Any, name: str, least: int = -2**31, most: int = 2**31 - 1) -> int:
    """An integer, by default one that a C int holds: ctypes would cut others without a word."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or not least <= number <= most:
        raise TangencyError(f"{name} = {value!r}: must be an integer from {least} to {most}")
    return number


def real(value: Any, name: str) -> float:
    """A number, of whatever type; its range is the library's matter."""
    if not isinstance(value, (str, bytes, bytearray, complex, np.complexfloating)):
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            pass
    raise TangencyError(f"{name} = {value!r}: must be a real number of double precision")


def member(kind: type[Enumeration], value: Any, name: str) -> Enumeration:
    """A value of an enumeration, or its number; not one of another enumeration with the same number."""
    if not isinstance(value, IntEnum) or isinstance(value, kind):
        try:
            return kind(operator.index(value))
        except (TypeError, ValueError):
            pass
    names = ", ".join(f"{kind.__name__}.{each.name}" for each in kind)
    raise TangencyError(f"{name} = {value!r}: must be of {names}")


def _ragged(given: Any, argument: str, error: ValueError) -> TangencyError:
    """Which row of a list has another length than the first."""
    lengths = [len(row) if hasattr(row, "__len__") else 1 for row in given] if isinstance(given, (list, tuple)) else []
    for row, length in enumerate(lengths):
        if length != lengths[0]:
            return TangencyError(f"{argument}: row {row}: {length} numbers: must be {lengths[0]}, as many as of row 0",
                                 row)
    return TangencyError(f"{argument}: {error}")


def plain(given: Any, argument: str, kinds: str = "fiub", rule: str = "real numbers") -> NDArray[Any]:
    """An array of numbers of some kinds of NumPy type. Entries that are masked are refused."""
    try:
        array = np.asarray(given)
    except ValueError as error:  # lists of unequal lengths
        raise _ragged(given, argument, error) from error
    if array.size and array.dtype.kind not in kinds:
        raise TangencyError(f"{argument}: numbers of type {array.dtype}: must be {rule}")
    if isinstance(given, np.ma.MaskedArray):
        masked = np.argwhere(np.atleast_1d(np.broadcast_to(given.mask, array.shape)))
        if len(masked):
            row = int(masked[0][0])
            raise TangencyError(f"{argument}: row {row}: masked: must be a number", row)
    return array
