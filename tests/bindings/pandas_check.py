# SPDX-License-Identifier: GPL-3.0-or-later
"""Data frames of pandas in and out: tests/bindings/long.sh."""

import numpy as np
import pandas

import tangency

NAMES = ["x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"]
generator = np.random.default_rng(41)
rows = generator.uniform(0.5, 3, (50, 20))
table = pandas.DataFrame(rows, columns=["a." + n for n in NAMES] + ["b." + n for n in NAMES])[::-1]
found = tangency.contacts(table, table)
expected = tangency.contacts(rows[::-1, :10], rows[::-1, 10:])
for name, column in found:
    np.testing.assert_array_equal(column, getattr(expected, name))
frame = pandas.DataFrame(found.flat())
assert list(frame["normal_z"]) == list(expected.normal[:, 2]) and len(frame) == 50
# A row alone has its names, in whatever order.
turned = table[list(table.columns)[::-1]]
assert tangency.contact(turned.iloc[0], turned.iloc[0]).gap == found.gap[0]
assert list(tangency.contacts(turned.iloc[0], table).gap)[0] == found.gap[0]
# Beside a column of text a row holds objects, and the names that have no meaning here are left alone.
named = turned.assign(name="grain")
assert named.iloc[0].dtype == object
assert tangency.contact(named.iloc[0], named.iloc[0]).gap == found.gap[0]
assert list(tangency.contacts(named.iloc[0], table).gap) == list(tangency.contacts(turned.iloc[0], table).gap)
# What is no row of a frame: numbers in their order, and no rows.
for numbers in (pandas.Series(rows[0, :10]), pandas.Index(rows[0, :10])):
    assert tangency.contact(numbers, rows[0, 10:]).gap == expected.gap[-1]
assert len(tangency.contacts(pandas.Series([], dtype=float), [])) == 0


def refusal(*words, **more):
    try:
        tangency.contacts(*words, **more)
    except tangency.TangencyError as error:
        return str(error)
    raise AssertionError(f"{words} is taken")


twice = pandas.DataFrame(rows[:, :11], columns=NAMES + ["y"])
for given in (twice, twice.iloc[0]):
    assert refusal(given, table) == "a: column y: named twice: must be there once"
holed = named.copy()
holed.loc[0, "a.r1"] = None
assert refusal(holed.iloc[-1], table) == "a: row 0: r1 = nan: a semi-axis must be finite and > 0"
short = pandas.DataFrame(rows[:, :6], columns=NAMES[:6])
assert len(tangency.Bodies(short)) == 50
# Types of pandas that know of missing numbers, and columns that hold no numbers.
whole = pandas.DataFrame(rows[:, :6], columns=NAMES[:6]).convert_dtypes()
assert str(whole.dtypes["x"]) == "Float64" and len(tangency.Bodies(whole)) == 50
for value in (pandas.NA, "1.5"):
    broken = whole.astype({"y": object})
    broken.loc[3, "y"] = value
    broken = broken.convert_dtypes() if value is pandas.NA else broken
    try:
        tangency.Bodies(broken)
    except tangency.TangencyError as error:
        assert "y" in str(error), error
    else:
        raise AssertionError(f"{value!r} is taken for a number")
assert list(pandas.DataFrame(tangency.contacts(rows[:0, :10], rows[:0, 10:]).flat())) == list(frame)
print(f"{len(frame.columns)} columns of {len(frame)} pairs")
