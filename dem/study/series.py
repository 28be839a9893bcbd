# SPDX-License-Identifier: MIT
"""Columns of tables that runs leave, and their mean and band over runs that differ by their seed.

What is missing in a table is nan here. Only files are read, and nothing is kept: any number of
threads may call.
"""

import bisect
import math

import measures

NAN = math.nan

# Chosen: values of a mean over runs between its first and its last abscissa.
GRID = 160

# Chosen: a curve that goes this share as far as another one goes about as far.
ABOUT = 0.97


class Columns:
    """A table's columns as numbers, nan for a cell or a column that is not there, so that runs of
    older tables and undefined quantities leave gaps in curves."""

    def __init__(self, table=None):
        self.table = table
        self.count = len(table) if table else 0

    @classmethod
    def of(cls, file, stage=None):
        """The rows of one stage, or all. A stage that does not begin the table has first the row
        before it, with strains of 0: what the stage starts from."""
        table = measures.Table.read(file)
        if stage is None:
            return cls(table)
        stages = table["stage"]
        first = next((k for k, name in enumerate(stages) if name == stage), 0)
        kept = cls(table.where(lambda k: stages[k] == stage or k == first - 1))
        if first > 0:
            for name in ("axial_strain", "volumetric_strain"):
                if name in table.names:
                    kept.table[name][0] = 0.0
        return kept

    def add(self, name, values):
        """A column more, in the table itself."""
        self.table.names.append(name)
        self.table.columns[name] = values

    def column(self, wanted):
        """By its name, or by a function of a row, which is numbers by name."""
        if not callable(wanted):
            if not self.table or wanted not in self.table.names:
                return [NAN] * self.count
            return [NAN if value is None else value for value in self.table[wanted]]
        return [value_of(wanted, Row(self, k)) for k in range(self.count)]


class Row:
    """Numbers of one row by name."""

    def __init__(self, columns, k):
        self.columns, self.k = columns, k

    def __getitem__(self, name):
        if name not in self.columns.table.names:
            return NAN
        value = self.columns.table[name][self.k]
        return NAN if value is None else value


def value_of(function, row):
    try:
        return function(row)
    except (ArithmeticError, ValueError):
        return NAN


def at(x, y, wanted):
    """y between the points (x, y), x ascending; nan outside of x and where y is not a number."""
    if not x or not x[0] <= wanted <= x[-1]:
        return NAN
    k = min(bisect.bisect_right(x, wanted), len(x) - 1)
    if k == 0:
        return y[0]
    span = x[k] - x[k - 1]
    if not span > 0.0:
        return y[k]
    share = (wanted - x[k - 1]) / span
    if share == 0.0 or share == 1.0:
        return y[k - 1 + round(share)]
    return y[k - 1] + share * (y[k] - y[k - 1])


def ascending(x, y):
    """Points without what is not a number in x or goes back in it."""
    kept_x, kept_y = [], []
    for a, b in zip(x, y):
        if math.isfinite(a) and (not kept_x or a >= kept_x[-1]):
            kept_x.append(a)
            kept_y.append(b)
    return kept_x, kept_y


def mean_and_band(curves):
    """(x, mean, lowest, highest) of curves (x, y) on a common grid, over those that reach so far.

    The grid ends with the first of the curves that go about as far as the second longest, so that a
    mean is not of one run alone where there are more. One curve alone is given back as it is,
    without a band.
    """
    curves = [ascending(*curve) for curve in curves]
    curves = [curve for curve in curves if any(map(math.isfinite, curve[1]))]
    if not curves:
        return [], [], None, None
    if len(curves) == 1:
        return *curves[0], None, None
    first = min(x[0] for x, _ in curves)
    ends = sorted(x[-1] for x, _ in curves)
    last = min(end for end in ends if end >= ABOUT * ends[-2])
    grid = [first + (last - first) * k / GRID for k in range(GRID)] + [last]
    mean, low, high = [], [], []
    for wanted in grid:
        values = [value for x, y in curves if math.isfinite(value := at(x, y, wanted))]
        mean.append(sum(values) / len(values) if values else NAN)
        low.append(min(values, default=NAN))
        high.append(max(values, default=NAN))
    return grid, mean, low, high


def slope(x, y, window):
    """dy/dx by least squares over what lies within window/2 of each x; nan of fewer than three."""
    slopes = []
    first = last = 0
    for middle in x:
        while first < len(x) and x[first] < middle - 0.5 * window:
            first += 1
        last = max(last, first)
        while last < len(x) and x[last] <= middle + 0.5 * window:
            last += 1
        points = [(a - middle, b) for a, b in zip(x[first:last], y[first:last]) if math.isfinite(b)]
        slopes.append(fitted_slope(points))
    return slopes


def running_mean(x, y, window):
    """The mean of the finite y within window/2 of each x, x ascending; nan where there are none."""
    means, first, last = [], 0, 0
    total = count = 0
    for middle in x:
        while last < len(x) and x[last] <= middle + 0.5 * window:
            if math.isfinite(y[last]):
                total, count = total + y[last], count + 1
            last += 1
        while first < last and x[first] < middle - 0.5 * window:
            if math.isfinite(y[first]):
                total, count = total - y[first], count - 1
            first += 1
        means.append(total / count if count else NAN)
    return means


def fitted_slope(points):
    if len(points) < 3:
        return NAN
    mean_x = sum(a for a, _ in points) / len(points)
    mean_y = sum(b for _, b in points) / len(points)
    spread = sum((a - mean_x) ** 2 for a, _ in points)
    return sum((a - mean_x) * (b - mean_y) for a, b in points) / spread if spread > 0.0 else NAN


def mean_and_ends(values):
    """(mean, lowest, highest) of the finite ones."""
    values = [value for value in values if math.isfinite(value)]
    if not values:
        return NAN, NAN, NAN
    return sum(values) / len(values), min(values), max(values)
