# SPDX-License-Identifier: MIT
"""Questions about pairs of ellipsoids, and of ellipsoids and other things."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tangency._asked import ON_DEMAND, Answer, Asked, accuracy_pointer, ask, columns_for, data_of, names_of
from tangency._bodies import NAMES, Bodies, float_rows, pair_rows, rows_of
from tangency._checks import TangencyError, integer, member, plain, real
from tangency._library import call, functions
from tangency._table import (BoundedGaps, CommonVolumes, Containments, Contacts, Curvatures,
                             Definition, Derivatives, Factors, Form, NeighbourAnswers, NeighbourColumnsStruct,
                             NeighbourQuestionStruct, Neighbours, OtherGaps, Points, Quadrics, Rays, Relations, Times,
                             Walls)


def contacts(a: Any, b: Any = None, pairs: ArrayLike | None = None, *, separations: ArrayLike | None = None,
             previous_normals: ArrayLike | None = None, accuracy: str | float = "standard",
             up_to: float | None = None, columns: Iterable[str] | None = None, threads: int = 1,
             out: Contacts | None = None) -> Contacts:
    """Signed gap, normal and witness points of pairs of ellipsoids.

    Parameters
    ----------
    a, b : array_like, shape (N, 10), or Bodies
        Rows ``x y z r1 r2 r3 qw qx qy qz`` (`Bodies`), or structured arrays or data frames with these columns, as they
        are or with the prefix ``a.`` and ``b.``. Pair k is row k of both; a single row stands for as many as
        the other has. Without pairs, separations and previous normals, float64 rows whose ten numbers lie side by
        side are read where they are; others are copied.
    pairs : array_like of int, shape (P, 2), optional
        Rows of `a` and of `b`; without `b` both of `a`.
    separations : array_like, shape (P, 3), optional
        Centre of B less centre of A in place of that of the centres: for periodic images (length).
    previous_normals : array_like, shape (P, 3), optional
        Normals of a moment ago: the branch that they lead to is followed. Rows of zeros: the global gap.
    accuracy : {"standard", "certified", "fast"} or float
        Standard: gaps to rounding. Certified: normals and points too. Fast: gaps to 2^-20 of the size. A number: to
        that length. Sign, status and gap_error are proven at any.
    up_to : float, optional
        No answer is wanted of pairs whose gap is above this length, at least 0. They cost little: their status is
        ``beyond``, gap a lower bound of the true one, gap_error infinite and the rest 0. Other pairs do not notice.
        Not for bodies by matrices. `gap_derivatives` takes such rows, as ``degenerate``; `contact_curvatures` does not.
    columns : iterable of str, optional
        Which of `Contacts` are wanted; by default all but the bounds, which take longer.
    threads : int
        That may work on it.
    out : Contacts, optional
        An earlier answer for as many pairs, whose columns are written over. It has to be of this function,
        `columns` None, and each column as it was made: dtype, shape, C-contiguous and writeable.

    Returns
    -------
    Contacts

    Raises
    ------
    TangencyError
        Numbers that make no body, pair or separation: it names argument, row, field, value and rule.

    Notes
    -----
    The lock of the interpreter is not held meanwhile. The sign of the gap is that of the exact relation: > 0 apart,
    0 touching, < 0 where the interiors meet.

    Examples
    --------
    >>> import tangency
    >>> found = tangency.contacts([[0, 0, 0, 1, 1, 1, 1, 0, 0, 0]], [[3, 0, 0, 1, 2, 1, 1, 0, 0, 0]])
    >>> found.gap
    array([1.])
    """
    columns = names_of(columns)
    fast = _contacts_of_rows(a, b, accuracy_pointer(accuracy, up_to), columns, threads, out) if (
        pairs is None and separations is None and previous_normals is None and b is not None
        and not isinstance(a, Bodies)) else None
    if fast is not None:
        return fast
    asked = Asked(a, b, pairs, separations)
    answers = columns_for(Contacts, asked.count, columns, out)
    previous = None if previous_normals is None else float_rows(previous_normals, 3, asked.count, "previous_normals")
    address, _kept = accuracy_pointer(accuracy, up_to)
    return ask("contacts", *asked.arguments(), data_of(previous), address, answers=answers, threads=threads)


def _contacts_of_rows(a: Any, b: Any, accuracy: tuple[int | None, Any], columns: tuple[str, ...] | None,
                      threads: int, out: Contacts | None) -> Contacts | None:
    """Of rows of float64, read where they are; None where they are not such."""
    if ON_DEMAND.intersection(columns or ()) or type(out) is Contacts and ON_DEMAND.intersection(vars(out)):
        return None
    rows_a, rows_b = rows_of(a, NAMES[Form.axes], "a"), rows_of(b, NAMES[Form.axes], "b")
    if rows_a.dtype != np.float64 or rows_b.dtype != np.float64:
        return None
    count = max(len(rows_a), len(rows_b)) if len(rows_a) and len(rows_b) else 0
    if len(rows_a) not in (1, count) or len(rows_b) not in (1, count):
        raise TangencyError(f"b: {len(rows_b)} rows: must be {len(rows_a)}, as many as of a")
    answers = columns_for(Contacts, count, columns, out)
    address, _kept = accuracy
    return ask("contacts_of_rows", rows_a.ctypes.data, rows_a.strides[0] if len(rows_a) > 1 else 0,
               rows_b.ctypes.data, rows_b.strides[0] if len(rows_b) > 1 else 0, count, address,
               answers=answers, threads=threads)


def _pair_question(kind: type[Answer], name: str, asked: Asked, columns: Iterable[str] | None, threads: int,
                   *more: object) -> Answer:
    answers = columns_for(kind, asked.count, columns)
    return ask(name, *asked.arguments(), *more, answers=answers, threads=threads)


def bounded_gaps(a: Any, b: Any = None, pairs: ArrayLike | None = None, *, separations: ArrayLike | None = None,
                 accuracy: str | float = "standard", up_to: float | None = None,
                 columns: Iterable[str] | None = None, threads: int = 1) -> BoundedGaps:
    """Gaps at a bounded cost, without a search: the true gap is in [gap - gap_error, gap + above].

    Parameters are those of `contacts`.
    """
    address, _kept = accuracy_pointer(accuracy, up_to)
    return _pair_question(BoundedGaps, "bounded_gaps", Asked(a, b, pairs, separations), columns, threads, address)


def overlaps(a: Any, b: Any = None, pairs: ArrayLike | None = None, *, separations: ArrayLike | None = None,
             threads: int = 1) -> NDArray[np.bool_]:
    """Do the interiors meet? Exact. Parameters are those of `contacts`.

    Returns
    -------
    ndarray of bool, shape (P,)
    """
    asked = Asked(a, b, pairs, separations)
    answers = np.empty(asked.count, np.bool_)
    call("overlaps", *asked.arguments(), answers.ctypes.data, integer(threads, "threads"))
    return answers


def overlaps_by_filter(a: Any, b: Any = None, pairs: ArrayLike | None = None, *,
                       separations: ArrayLike | None = None, threads: int = 1) -> NDArray[np.uint8]:
    """The same in bounded time: 1 yes, 0 no, 2 where only integers would know."""
    asked = Asked(a, b, pairs, separations)
    answers = np.empty(asked.count, np.uint8)
    call("overlaps_by_filter", *asked.arguments(), answers.ctypes.data, integer(threads, "threads"))
    return answers


def relations(a: Any, b: Any = None, pairs: ArrayLike | None = None, *, separations: ArrayLike | None = None,
              columns: Iterable[str] | None = None, threads: int = 1) -> Relations:
    """How pairs lie, as point sets: exact. Parameters are those of `contacts`."""
    return _pair_question(Relations, "relations", Asked(a, b, pairs, separations), columns, threads)


def other_gaps(definition: Definition, a: Any, b: Any = None, pairs: ArrayLike | None = None, *,
               separations: ArrayLike | None = None, columns: Iterable[str] | None = None,
               threads: int = 1) -> OtherGaps:
    """Gaps by another definition, to tell a difference of definition from an error.

    Parameters behind `definition` are those of `contacts`.
    """
    return _pair_question(OtherGaps, "other_gaps", Asked(a, b, pairs, separations), columns, threads,
                          int(member(Definition, definition, "definition")))


def perram_wertheim_factors(a: Any, b: Any = None, pairs: ArrayLike | None = None, *,
                            separations: ArrayLike | None = None, columns: Iterable[str] | None = None,
                            threads: int = 1) -> Factors:
    """The Perram-Wertheim contact function. Parameters are those of `contacts`."""
    return _pair_question(Factors, "perram_wertheim_factors", Asked(a, b, pairs, separations), columns, threads)


def gap_derivatives(found: Contacts, a: Any, b: Any = None, pairs: ArrayLike | None = None, *,
                    separations: ArrayLike | None = None, columns: Iterable[str] | None = None,
                    threads: int = 1) -> Derivatives:
    """First and second derivatives of the gap.

    Parameters
    ----------
    found : Contacts
        With normal and status, of the same pairs.

    The others are those of `contacts`. The 18 parameters: centre, rotation vector in space (rad) and
    semi-axes of A, then of B.
    """
    asked = Asked(a, b, pairs, separations)
    normals = _normals(found, asked.count)
    statuses = np.ascontiguousarray(plain(found.status, "found.status", "iu", "integers"), np.int32)
    if statuses.shape != (asked.count,):
        raise TangencyError(f"found.status: shape {statuses.shape}: must be ({asked.count},)")
    return _pair_question(Derivatives, "gap_derivatives", asked, columns, threads, normals.ctypes.data,
                          statuses.ctypes.data)


def contact_curvatures(found: Contacts, a: Any, b: Any = None, pairs: ArrayLike | None = None, *,
                       columns: Iterable[str] | None = None, threads: int = 1) -> Curvatures:
    """Curvatures where two bodies touch, as a Hertz law needs them.

    Parameters
    ----------
    found : Contacts
        With normal, of the same pairs.

    The others are those of `contacts`.
    """
    asked = Asked(a, b, pairs)
    normals = _normals(found, asked.count)
    own = asked.pairs
    if own is None:
        own = np.stack([np.arange(asked.count), asked.count + np.arange(asked.count)], 1).astype(np.uint32)
    answers = columns_for(Curvatures, asked.count, columns)
    return ask("contact_curvatures", asked.bodies.pointer, own.ctypes.data, asked.count, normals.ctypes.data,
               answers=answers, threads=threads)


def _normals(found: Contacts, count: int) -> NDArray[np.float64]:
    return float_rows(found.normal, 3, count, "found.normal")


def common_volumes(a: Any, b: Any = None, pairs: ArrayLike | None = None, *, separations: ArrayLike | None = None,
                   tolerance: float = 1e-12, columns: Iterable[str] | None = None,
                   threads: int = 1) -> CommonVolumes:
    """The volume that two bodies have in common, and its gradient.

    Parameters
    ----------
    tolerance : float
        Of the error, over the smaller body's volume; > 0.

    The others are those of `contacts`.
    """
    return _pair_question(CommonVolumes, "common_volumes", Asked(a, b, pairs, separations), columns, threads,
                          real(tolerance, "tolerance"))


def containments(a: Any, b: Any = None, pairs: ArrayLike | None = None, *, separations: ArrayLike | None = None,
                 columns: Iterable[str] | None = None, threads: int = 1) -> Containments:
    """How far A lies inside B: a length and a factor. Parameters are those of `contacts`."""
    return _pair_question(Containments, "containments", Asked(a, b, pairs, separations), columns, threads)


def times_of_contact(bodies: Any, motions: ArrayLike, pairs: ArrayLike, horizon: float, tolerance: float, *,
                     separations: ArrayLike | None = None, columns: Iterable[str] | None = None,
                     threads: int = 1) -> Times:
    """First contact of moving bodies in 0 <= t <= horizon.

    Parameters
    ----------
    bodies : array_like, shape (N, 10), or Bodies
        At t = 0.
    motions : array_like, shape (N, 9)
        Velocity of the pivot (length/time), angular velocity in space (rad/time), centre less pivot (length).
    pairs : array_like of int, shape (P, 2)
    horizon : float
        Time, finite and >= 0.
    tolerance : float
        Time, > 0.
    """
    asked = Asked(bodies, None, pairs, separations)
    rows = float_rows(motions, 9, len(asked.bodies), "motions")
    return _pair_question(Times, "times_of_contact", asked, columns, threads, rows.ctypes.data,
                          real(horizon, "horizon"), real(tolerance, "tolerance"))


def _meeting(kind: type[Answer], name: str, bodies: Any, others: NDArray[np.float64], pairs: ArrayLike | None,
             columns: Iterable[str] | None, threads: int, *more: object) -> Answer:
    known = bodies if isinstance(bodies, Bodies) else Bodies(bodies, argument="bodies")
    list_ = _meeting_pairs(name, len(known), len(others)) if pairs is None else pair_rows(pairs)
    answers = columns_for(kind, len(list_), columns)
    return ask(name, known.pointer, others.ctypes.data, len(others), *more, data_of(list_), len(list_),
               answers=answers, threads=threads)


def _meeting_pairs(name: str, bodies: int, others: int) -> NDArray[np.uint32]:
    """Body k and other k of each pair, or all with the single one."""
    if bodies != others and 1 not in (bodies, others):
        raise TangencyError(f"{name}: {others} rows: must be {bodies}, as many as of bodies, or one, "
                            "where no pairs are given")
    count = max(bodies, others) if bodies and others else 0
    pairs = np.zeros((count, 2), np.uint32)
    for column, rows in enumerate((bodies, others)):
        if rows > 1:
            pairs[:, column] = np.arange(count)
    return pairs


def walls(bodies: Any, walls: ArrayLike, pairs: ArrayLike | None = None, *, sheets: bool = False,
          columns: Iterable[str] | None = None, threads: int = 1) -> Walls:
    """Bodies against walls.

    Parameters
    ----------
    bodies : array_like, shape (N, 10), or Bodies
    walls : array_like, shape (M, 4)
        Rows ``nx ny nz offset``: the solid half-space normal . x <= offset.
    pairs : array_like of int, shape (P, 2), optional
        A body and a wall of each pair; by default body k and wall k, or all with the single one.
    sheets : bool
        Walls without thickness, free on both sides.
    """
    return _meeting(Walls, "walls", bodies, float_rows(walls, 4, None, "walls"), pairs, columns, threads, int(sheets))


def points(bodies: Any, points: ArrayLike, pairs: ArrayLike | None = None, *,
           columns: Iterable[str] | None = None, threads: int = 1) -> Points:
    """Closest points of surfaces to points (M, 3), and signed distances. Pairs as of `walls`."""
    return _meeting(Points, "points", bodies, float_rows(points, 3, None, "points"), pairs, columns, threads)


def balls(bodies: Any, balls: ArrayLike, pairs: ArrayLike | None = None, *,
          columns: Iterable[str] | None = None, threads: int = 1) -> Contacts:
    """Contacts of bodies (A) and spheres (B), rows ``x y z r``. Pairs as of `walls`."""
    return _meeting(Contacts, "balls", bodies, float_rows(balls, 4, None, "balls"), pairs, columns, threads)


def rays(bodies: Any, rays: ArrayLike, pairs: ArrayLike | None = None, *,
         columns: Iterable[str] | None = None, threads: int = 1) -> Rays:
    """Where rays, segments and lines meet surfaces: whether they do is exact.

    Parameters
    ----------
    rays : array_like, shape (M, 6) or (M, 8)
        Origin, direction of any length but 0, and the ends of the interval of t, by default 0 and infinity.

    The others are those of `walls`.
    """
    given = np.atleast_2d(plain(rays, "rays").astype(np.float64))
    if given.ndim == 2 and given.shape[1] == 6:
        given = np.hstack([given, np.broadcast_to([0.0, np.inf], (len(given), 2))])
    return _meeting(Rays, "rays", bodies, float_rows(given, 8, None, "rays"), pairs, columns, threads)


#: The least answers of which a column is; those that are not named are of contacts.
_NEIGHBOURS_FROM = {
    "pairs": NeighbourAnswers.pairs, "images": NeighbourAnswers.pairs, "overlaps": NeighbourAnswers.overlaps,
    "gap": NeighbourAnswers.gaps, "gap_error": NeighbourAnswers.gaps, "status": NeighbourAnswers.gaps,
}


def neighbours(bodies: Any, reach: float = 0.0, *, edges: ArrayLike | None = None,
               periodic: ArrayLike | None = None, answers: NeighbourAnswers = NeighbourAnswers.contacts,
               accuracy: str | float = "standard", threads: int = 1) -> Neighbours:
    """All pairs of images whose gap is at most `reach`, in ascending order.

    Parameters
    ----------
    bodies : array_like, shape (N, 10), or Bodies
    reach : float
        Length, finite and >= 0; with 0 exactly the pairs that share a point.
    edges : array_like, shape (3, 3), optional
        Three edge vectors, one a row, that repeat the bodies (length).
    periodic : array_like of bool, shape (3,), optional
        Along which of them; by default along all.
    answers : NeighbourAnswers
        What is wanted of each pair.

    Returns
    -------
    Neighbours
        ``pairs``, ``images`` (b is moved by so many of each edge) and the answers that were asked for.
    """
    known = bodies if isinstance(bodies, Bodies) else Bodies(bodies, argument="bodies")
    cell = None if edges is None else float_rows(edges, 3, 3, "edges")
    along = (None if periodic is None
             else np.ascontiguousarray(plain(periodic, "periodic", "biu", "yes or no"), np.int32))
    if along is not None and along.shape != (3,):
        raise TangencyError(f"periodic: shape {along.shape}: must be (3,)")
    answers = member(NeighbourAnswers, answers, "answers")
    question = NeighbourQuestionStruct(ctypes.sizeof(NeighbourQuestionStruct), real(reach, "reach"), data_of(cell),
                                       data_of(along), int(answers))
    address, _kept = accuracy_pointer(accuracy)
    list_ = ctypes.c_void_p()
    call("neighbours_create", ctypes.addressof(list_), known.pointer, ctypes.addressof(question), address,
         integer(threads, "threads"))
    try:
        return _copied(list_, answers)
    finally:
        functions["neighbours_destroy"](list_)


def _copied(list_: ctypes.c_void_p, answers: NeighbourAnswers) -> Neighbours:
    """Columns of a list as arrays of their own: those that were asked for, of no pairs too."""
    count = int(functions["neighbours_count"](list_))
    columns = NeighbourColumnsStruct(ctypes.sizeof(NeighbourColumnsStruct))
    call("neighbours_columns", list_, ctypes.addressof(columns))
    found: Neighbours = Neighbours.allocated(
        count, tuple(column.name for column in Neighbours.fields
                     if answers >= _NEIGHBOURS_FROM.get(column.name, NeighbourAnswers.contacts)))
    for name, array in found:
        if count:
            ctypes.memmove(array.ctypes.data, getattr(columns, name), array.nbytes)
    return found


def classify(coefficients: ArrayLike, *, columns: Iterable[str] | None = None, threads: int = 1) -> Quadrics:
    """The type of quadrics, exact.

    Parameters
    ----------
    coefficients : array_like, shape (N, 10)
        Rows ``A B C D E F G H J K`` of A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y + 2J z + K = 0.
    """
    rows = rows_of(coefficients, NAMES[Form.quadric], "coefficients").astype(np.float64, copy=False)
    answers = columns_for(Quadrics, len(rows), columns)
    return ask("classify", rows.ctypes.data, len(rows), rows.strides[0], answers=answers, threads=threads)
