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


#: Words in the names of columns whose last axis is x, y and, in space, z.
_VECTORS = frozenset(("normal", "arm", "arms", "point", "separation", "gradient", "directions"))


@dataclass(frozen=True)
class Column:
    """One column: its name, NumPy type, shape of a row, and whose values its numbers are."""

    name: str
    dtype: str
    shape: tuple[int, ...] = ()
    enum: type[IntEnum] | None = None

    def labels(self, place: tuple[int, ...]) -> list[str]:
        """What `Columns.flat` calls a number of a row."""
        labels = [str(index) for index in place]
        if labels and not _VECTORS.isdisjoint(self.name.split("_")) and self.shape[-1] <= len("xyz"):
            labels[-1] = "xyz"[place[-1]]
        elif self.name == "pairs":
            labels[-1] = "ab"[place[-1]]
        return labels


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
        """Columns of single numbers, as ``pandas.DataFrame`` takes them; the same ones whatever was found.

        Vectors by axes, ``normal_x``; pairs by bodies, ``pairs_a``; others by places from 0, ``t_0``,
        ``b_directions_1_z``.
        """
        result = {}
        for column in self.fields:
            if column.name in self.__dict__:
                array = self.__dict__[column.name]
                for place in np.ndindex(column.shape):
                    result["_".join([column.name, *column.labels(place)])] = array[(slice(None), *place)]
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
