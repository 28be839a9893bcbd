# SPDX-License-Identifier: MIT
"""Columns of answers: what the classes of _table.py have in common."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Column:
    """One column: its name, NumPy type, shape of a row, and whose values its numbers are."""

    name: str
    dtype: str
    shape: tuple[int, ...] = ()
    enum: type[IntEnum] | None = None


class Columns:
    """Answers by columns, each an array as long as the pairs that were asked about.

    A column that was not asked for is no attribute.
    """

    struct: ClassVar[type[ctypes.Structure]]
    fields: ClassVar[tuple[Column, ...]]

    @classmethod
    def allocated(cls, count: int, names: tuple[str, ...]) -> Any:
        """Columns of `count` rows that the library writes into."""
        answers = cls()
        for column in cls.fields:
            if column.name in names:
                setattr(answers, column.name, np.empty((count, *column.shape), column.dtype))
        return answers

    def pointers(self) -> ctypes.Structure:
        """The struct of the C interface, whose pointers lead into these arrays."""
        columns = type(self).struct()
        columns.size = ctypes.sizeof(columns)
        for name, array in self:
            setattr(columns, name, array.ctypes.data)
        return columns

    def names(self, column: str) -> list[str]:
        """The values of a column of an enumeration, as files write them.

        Raises
        ------
        ValueError
            The column is of numbers.
        """
        enum = next((each.enum for each in self.fields if each.name == column), None)
        if enum is None:
            raise ValueError(f"{column} is not a column of names")
        values = tuple(member.name for member in enum)
        return [values[value] for value in getattr(self, column)]

    def flat(self) -> dict[str, NDArray[Any]]:
        """Columns of single numbers, ``normal_x`` and the like, as ``pandas.DataFrame`` takes them."""
        result = {}
        for name, array in self:
            rows = array.reshape(len(array), -1) if array.size else array.reshape(len(array), 0)
            if array.ndim == 1:
                result[name] = array
            elif array.ndim == 2 and rows.shape[1] <= 3:
                result.update({f"{name}_{axis}": rows[:, k] for k, axis in enumerate("xyz"[:rows.shape[1]])})
            else:
                result.update({f"{name}_{k}": rows[:, k] for k in range(rows.shape[1])})
        return result

    def __iter__(self) -> Iterator[tuple[str, NDArray[Any]]]:
        return ((each.name, self.__dict__[each.name]) for each in self.fields if each.name in self.__dict__)

    def __len__(self) -> int:
        return next((len(array) for _, array in self), 0)

    def __getattr__(self, name: str) -> Any:
        if any(each.name == name for each in type(self).fields):
            raise AttributeError(f"{name} was not asked for: columns= names it")
        raise AttributeError(f"{type(self).__name__} has no column {name}")

    def __repr__(self) -> str:
        return f"{type(self).__name__} of {len(self)}: " + ", ".join(name for name, _ in self)
