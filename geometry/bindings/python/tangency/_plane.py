# SPDX-License-Identifier: MIT
"""Questions about ellipses in the plane."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from numpy.typing import ArrayLike

from tangency._asked import ask, columns_for, data_of
from tangency._bodies import Ellipses, float_rows, pair_rows
from tangency._checks import TangencyError
from tangency._table import PlaneContacts, PlanePoints

#: By default: what takes no more than some microseconds a pair.
PLANE_COLUMNS = ("relation", "inner", "crossings", "gap", "gap_error", "normal", "arm_a", "arm_b", "status", "area")


def plane_contacts(a: Any, b: Any = None, pairs: ArrayLike | None = None, *,
                   columns: Iterable[str] | None = PLANE_COLUMNS, threads: int = 1) -> PlaneContacts:
    """Relation, gap, common area, crossings and more of pairs of ellipses.

    Parameters
    ----------
    a, b : array_like, shape (N, 6), or Ellipses
        Rows ``x y r1 r2 ux uy`` (`Ellipses`). Pair k is row k of both.
    pairs : array_like of int, shape (P, 2), optional
        Rows of `a`, where `b` is not given.
    columns : iterable of str, optional
        Of `PlaneContacts`; None for all.
    threads : int
    """
    known = a if isinstance(a, Ellipses) else Ellipses(a, argument="a")
    if b is not None:
        if isinstance(a, Ellipses) or pairs is not None:
            raise TangencyError("b: must be None where a are Ellipses or pairs are given")
        count = len(known)
        known.append(b, argument="b")
        if len(known) != 2 * count:
            raise TangencyError(f"b: {len(known) - count} rows: must be {count}, as many as of a")
    list_ = None if pairs is None else pair_rows(pairs)
    if list_ is None and b is None and not isinstance(a, Ellipses):
        raise TangencyError("pairs: must be given where b is not")
    count = len(known) // 2 if list_ is None else len(list_)
    answers = columns_for(PlaneContacts, count, columns)
    return ask("plane_contacts", known.pointer, data_of(list_), count, answers=answers, threads=threads)


def plane_points(ellipses: Any, points: ArrayLike, *, columns: Iterable[str] | None = None,
                 threads: int = 1) -> PlanePoints:
    """Closest points of boundaries to points (N, 2), one an ellipse, and signed distances."""
    known = ellipses if isinstance(ellipses, Ellipses) else Ellipses(ellipses, argument="ellipses")
    rows = float_rows(points, 2, len(known), "points")
    answers = columns_for(PlanePoints, len(known), columns)
    return ask("plane_points", known.pointer, rows.ctypes.data, len(rows), None, len(known), answers=answers,
               threads=threads)


__all__ = ["PLANE_COLUMNS", "plane_contacts", "plane_points"]
