# SPDX-License-Identifier: MIT
"""Rows of numbers as the library reads them, and the bodies made of them."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tangency._checks import TangencyError, integer, member, plain, real
from tangency._library import call, functions
from tangency._table import Form, Number, PlaneForm

#: The columns of a body in every table of the project.
CENTRE = ("x", "y", "z")
NAMES: dict[Form, tuple[str, ...]] = {
    Form.axes: (*CENTRE, "r1", "r2", "r3", "qw", "qx", "qy", "qz"),
    Form.shape: (*CENTRE, "m.xx", "m.yy", "m.zz", "m.xy", "m.yz", "m.zx"),
    Form.precision: (*CENTRE, "p.xx", "p.yy", "p.zz", "p.xy", "p.yz", "p.zx"),
    Form.vectors: (*CENTRE, *(f"u{k}.{axis}" for k in (1, 2, 3) for axis in CENTRE)),
    Form.quadric: tuple("ABCDEFGHJK"),
}
PLANE_NAMES: dict[PlaneForm, tuple[str, ...]] = {
    PlaneForm.direction: ("x", "y", "r1", "r2", "ux", "uy"),
    PlaneForm.angle: ("x", "y", "r1", "r2", "angle"),
    PlaneForm.shape: ("x", "y", "m.xx", "m.yy", "m.xy"),
    PlaneForm.precision: ("x", "y", "p.xx", "p.yy", "p.xy"),
    PlaneForm.conic: tuple("ABCDEF"),
}
_IDENTITY = {"qw": 1.0, "qx": 0.0, "qy": 0.0, "qz": 0.0}


def rows_of(given: Any, names: tuple[str, ...], argument: str) -> NDArray[Any]:
    """Rows of float64 or float32 whose numbers lie side by side.

    Arrays of (N, width) and structured arrays whose columns are neighbours are not copied, whatever
    their stride; data frames and other structured arrays are.
    """
    given = table_of_row(given)
    columns = _column_names(given)
    if columns is not None:
        return _rows_of_columns(given, columns, names, argument)
    if isinstance(given, _Rows):
        raise TangencyError(f"{argument}: {type(given).__name__}: must be rows; append() joins two arrays")
    array = plain(given, argument)
    if array.dtype not in (np.float64, np.float32):
        array = array.astype(np.float64)
    array = _as_rows(array, len(names))
    if array.ndim != 2 or array.shape[1] != len(names):
        raise TangencyError(f"{argument}: shape {array.shape}: must be (N, {len(names)}), the columns "
                            + " ".join(names))
    if array.shape[0] and array.strides[1] != array.itemsize or not array.flags.aligned:
        array = np.ascontiguousarray(array)
    return array


def _as_rows(array: NDArray[Any], width: int) -> NDArray[Any]:
    """One row as an array of rows, and an empty list as one of none."""
    if array.ndim == 1 and array.size in (0, width):
        return array.reshape(-1, width)
    return array


def table_of_row(given: Any) -> Any:
    """A row of a structured array or of a data frame as a table of one row: its columns may stand in any order."""
    if isinstance(given, np.void) and given.dtype.names is not None:
        return np.asarray(given).reshape(1)
    to_frame, index = getattr(given, "to_frame", None), getattr(given, "index", None)
    if callable(to_frame) and isinstance(index, Iterable):  # of pandas: its indices have no index themselves
        names = list(index)
        if names and all(isinstance(name, str) for name in names):
            # Beside a column of text the row holds objects, numbers among them.
            return to_frame().T.infer_objects()
    return given


def _column_names(given: Any) -> list[str] | None:
    """Those of a structured array or a data frame."""
    if isinstance(given, np.ndarray):
        return None if given.dtype.names is None else list(given.dtype.names)
    columns = getattr(given, "columns", None)
    return None if columns is None or not hasattr(given, "to_numpy") else [str(name) for name in columns]


def _rows_of_columns(given: Any, columns: list[str], names: tuple[str, ...], argument: str) -> NDArray[Any]:
    prefix = "" if names[0] in columns else f"{argument}."
    wanted = [prefix + name for name in names]
    turned = [name for name in wanted if name.split(".")[-1] in _IDENTITY and name in columns]
    missing = [name for name in wanted if name not in columns
               and not (name[len(prefix):] in _IDENTITY and not turned)]
    if missing:
        either = f"{names[0]} or " if missing[0] == f"{argument}.{names[0]}" else ""
        raise TangencyError(f"{argument}: there is no column {either}{missing[0]}")
    twice = [name for name in wanted if columns.count(name) > 1]
    if twice:
        raise TangencyError(f"{argument}: column {twice[0]}: named twice: must be there once")
    if isinstance(given, np.ndarray) and not isinstance(given, np.ma.MaskedArray) and given.ndim == 1:
        view = _view_of_neighbours(given, wanted)
        if view is not None:
            return view
    rows = np.empty((len(given), len(names)))
    for k, name in enumerate(wanted):
        rows[:, k] = _column(given, name, argument) if name in columns else _IDENTITY[names[k]]
    return rows


def _column(table: Any, name: str, argument: str) -> NDArray[Any]:
    column, place = table[name], f"{argument}: column {name}"
    if isinstance(column, np.ndarray) or getattr(getattr(column, "dtype", None), "kind", None) not in list("fiub"):
        return plain(column, place)
    try:  # pandas: its types that know of missing numbers are no types of NumPy
        return np.asarray(column, np.float64)
    except (TypeError, ValueError) as error:
        raise TangencyError(f"{place}: {error}") from error


def _view_of_neighbours(given: NDArray[Any], wanted: list[str]) -> NDArray[Any] | None:
    """Columns of a structured array that stand side by side as rows, without a copy."""
    fields = given.dtype.fields
    assert fields is not None
    if any(name not in fields for name in wanted):
        return None
    first = fields[wanted[0]]
    for k, name in enumerate(wanted):
        if fields[name][0] != np.float64 or fields[name][1] != first[1] + 8 * k:
            return None
    if not given.flags.c_contiguous:
        return None
    return np.ndarray((len(given), len(wanted)), np.float64, given, first[1], (given.strides[0], 8))


def number_of(rows: NDArray[Any]) -> int:
    return int(Number.double if rows.dtype == np.float64 else Number.float)


class _Rows:
    """What Bodies and Ellipses have in common: an opaque pointer, and rows behind it."""

    _kind: str
    _names: dict[Any, tuple[str, ...]]

    def __init__(self, rows: Any, form: Any, level: float, argument: str) -> None:
        self._pointer = ctypes.c_void_p()
        self._call("create", ctypes.addressof(self._pointer), rows, form, level, argument)

    def append(self, rows: Any, form: Any = 0, level: float = 1.0, *, argument: str = "rows") -> None:
        """Adds bodies behind those there are. No other thread may ask about them meanwhile."""
        self._call("append", self._pointer, rows, form, level, argument)

    def _call(self, name: str, to: Any, rows: Any, form: Any, level: float, argument: str) -> None:
        known, level = member(type(next(iter(self._names))), form, "form"), real(level, "level")
        array = rows_of(rows, self._names[known], argument)
        try:
            call(f"{self._kind}_{name}", to, int(known), array.ctypes.data, number_of(array), len(array),
                 array.strides[0], level)
        except TangencyError as error:  # the library calls them rows
            if error.row is None:
                raise
            raise TangencyError(argument + str(error).removeprefix("rows"), error.row) from None

    def __reduce__(self) -> Any:
        # Of copy and pickle: two objects with one pointer would both free it.
        raise TypeError(f"{type(self).__name__} cannot be copied or pickled: make others of the rows")

    def __len__(self) -> int:
        return int(functions[f"{self._kind}_count"](self._pointer))

    @property
    def pointer(self) -> ctypes.c_void_p:
        """That of the C interface, for as long as this object lives."""
        return self._pointer

    def __del__(self) -> None:
        pointer = getattr(self, "_pointer", None)
        if pointer:
            functions[f"{self._kind}_destroy"](pointer)


class Bodies(_Rows):
    """Ellipsoids that many questions are asked about, made once.

    Parameters
    ----------
    rows : array_like, shape (N, 10)
        Centre ``x y z``, semi-axes ``r1 r2 r3`` > 0 in any order (length), and a quaternion
        ``qw qx qy qz`` of any length but 0 that turns body axes into space axes; or a structured array or
        data frame with columns of these names. Of another form: its columns, `Form`.
    form : Form
        How a row gives a body. By forms other than axes relations are exact for the numbers as given.
    level : float
        Of shape and precision matrices M: the body (p-c)' M^-1 (p-c) <= level.

    Raises
    ------
    TangencyError
        A row that makes no body: it names row, field, value and rule.

    Notes
    -----
    The numbers are copied, and Bodies themselves cannot be. Any number of threads may ask about the same bodies
    while none changes them.
    """

    _kind = "bodies"
    _names = NAMES

    def __init__(self, rows: Any, form: Form = Form.axes, level: float = 1.0, *, argument: str = "rows") -> None:
        super().__init__(rows, form, level, argument)

    def set(self, rows: Any, first: int = 0) -> None:
        """Other numbers for the bodies from `first` on: of bodies that move. By axes alone."""
        array = rows_of(rows, NAMES[Form.axes], "rows")
        first = integer(first, "first", 0, sys.maxsize)
        call("bodies_set", self._pointer, first, array.ctypes.data, number_of(array), len(array), array.strides[0])


class Ellipses(_Rows):
    """Ellipses in the plane, made once.

    Parameters
    ----------
    rows : array_like, shape (N, 6)
        Centre ``x y``, semi-axes ``r1 r2`` > 0 (length), and the direction ``ux uy`` of the first, of any
        length but 0; or columns of these names. Of another form: its columns, `PlaneForm`.
    form : PlaneForm
    level : float
        Of shape and precision matrices.

    Raises
    ------
    TangencyError
        A row that makes no ellipse.
    """

    _kind = "ellipses"
    _names = PLANE_NAMES

    def __init__(self, rows: Any, form: PlaneForm = PlaneForm.direction, level: float = 1.0, *,
                 argument: str = "rows") -> None:
        super().__init__(rows, form, level, argument)


def float_rows(given: ArrayLike, width: int, count: int | None, argument: str) -> NDArray[np.float64]:
    """Rows of float64 side by side, `count` of them."""
    array = np.ascontiguousarray(plain(given, argument), np.float64)
    array = _as_rows(array, width)
    if array.ndim != 2 or array.shape[1] != width or (count is not None and len(array) != count):
        rows = "N" if count is None else str(count)
        raise TangencyError(f"{argument}: shape {array.shape}: must be ({rows}, {width})")
    return array


def pair_rows(given: ArrayLike) -> NDArray[np.uint32]:
    """Pairs of indices. Those that fit into no index are refused here, with their row."""
    array = plain(given, "pairs", "iu", "integers")
    if array.dtype == np.uint32:
        array = np.ascontiguousarray(array)
    else:
        wrong = np.argwhere((array < 0) | (array > 0xFFFFFFFF))
        if len(wrong):
            row = int(wrong[0][0])
            raise TangencyError(f"pairs: row {row}: {array[tuple(wrong[0])]}: must be an index from 0", row)
        array = np.ascontiguousarray(array, np.uint32)
    if array.size == 0:
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise TangencyError(f"pairs: shape {array.shape}: must be (N, 2)")
    return array
