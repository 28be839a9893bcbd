# SPDX-License-Identifier: MIT
"""One pair at a time, on the shortest way into the library."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tangency._bodies import NAMES, rows_of, table_of_row
from tangency._checks import TangencyError, plain
from tangency._library import failed, functions
from tangency._table import FUNCTIONS, ContactColumnsStruct, Form, GapTier, Status


@dataclass
class Contact:
    """Answer of `contact`.

    Attributes
    ----------
    gap : float
        > 0: the distance; < 0: minus the penetration depth (length).
    gap_error : float
        Proven: \\|gap - true gap\\| is at most this where the status is ok.
    normal : ndarray, shape (3,)
        Unit, from A to B.
    arm_a, arm_b : ndarray, shape (3,)
        Witness points less their bodies' centres (length).
    point : ndarray, shape (3,)
        The contact point less A's centre (length).
    status : Status
    tier : GapTier
        Which method gave the answer.
    """

    gap: float
    gap_error: float
    normal: NDArray[np.float64]
    arm_a: NDArray[np.float64]
    arm_b: NDArray[np.float64]
    point: NDArray[np.float64]
    status: Status
    tier: GapTier


class _Desk:
    """Memory for one pair, which the library reads and writes: made once for many calls."""

    def __init__(self) -> None:
        self.rows = np.empty((2, 10))
        self.numbers = np.empty(14)
        self.codes = np.empty(2, np.int32)
        self.a, self.b = self.rows[0], self.rows[1]
        base, codes, step = self.numbers.ctypes.data, self.codes.ctypes.data, self.numbers.itemsize
        self.columns = ContactColumnsStruct(
            size=ctypes.sizeof(ContactColumnsStruct), gap=base, gap_error=base + step, normal=base + 2 * step,
            arm_a=base + 5 * step, arm_b=base + 8 * step, point=base + 11 * step, status=codes, tier=codes + 4)
        given = (self.a.ctypes.data, 80, self.b.ctypes.data, 80, 1, None, ctypes.addressof(self.columns), 1)
        # As values of C, which ctypes hands on without looking at them again.
        self.arguments = tuple(kind(value) for kind, value in zip(FUNCTIONS["contacts_of_rows"][1], given))


#: Those that no call uses. A call takes one out, so that whoever asks in the middle of it has another: a
#: thread, a signal handler, or the conversion of an argument.
_free: list[_Desk] = []
_ask = functions["contacts_of_rows"]
_STATUSES, _TIERS = tuple(Status), tuple(GapTier)
_QUICK = {float, int, np.float64}


def contact(a: ArrayLike, b: ArrayLike) -> Contact:
    """Gap, normal and witness points of one pair.

    Parameters
    ----------
    a, b : array_like, shape (10,)
        ``x y z r1 r2 r3 qw qx qy qz`` as of `contacts`, whose answer this is to the bit; or a row of a structured
        array or of a data frame with these columns.

    Raises
    ------
    TangencyError
        Numbers that make no body.
    """
    try:
        desk = _free.pop()
    except IndexError:
        desk = _Desk()
    try:
        _take(desk.a, a, "a")
        _take(desk.b, b, "b")
        code = _ask(*desk.arguments)
        if code:
            raise failed(code)
        numbers = desk.numbers.copy()
        status, tier = desk.codes.tolist()
    finally:
        _free.append(desk)
    return Contact(numbers.item(0), numbers.item(1), numbers[2:5], numbers[5:8], numbers[8:11], numbers[11:],
                   _STATUSES[status], _TIERS[tier])


def _take(row: NDArray[np.float64], given: Any, argument: str) -> None:
    if type(given) is list and len(given) == 10 and _QUICK.issuperset(map(type, given)):
        try:
            row[:] = given
            return
        except OverflowError:  # an int, which plain() refuses
            pass
    table = given if type(given) is np.ndarray else table_of_row(given)
    if table is not given:
        row[:] = rows_of(table, NAMES[Form.axes], argument)[0]
        return
    array = plain(given, argument)
    if array.shape != (10,):  # a single number would be taken for all ten
        raise TangencyError(f"{argument}: shape {array.shape}: must be (10,), the numbers x y z r1 r2 r3 qw qx qy qz")
    row[:] = array
