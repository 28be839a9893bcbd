# SPDX-License-Identifier: MIT
"""What rows ask of complete runs: values of histories at a strain, slopes, the points A to D.

Units are those of history.csv: Pa, N, m, strains logarithmic, compression positive in stress and
axial strain, dilation in volumetric strain. Strains that a row names are those of a test to 0.4;
in a study whose tests end elsewhere they are in proportion (`Test.stretch`).
"""
import csv
import functools
import json
import math
import statistics

# Published strain of the steady state (5.4), and of the end (at least).
STEADY = 0.205
# Axial strain over which a value at a strain is averaged, and a peak taken (dem/tool/shear_peaks.hpp).
WINDOW = 0.01
# Rules for the points: no rule is published. B: slope of a_s over its window at most this share of
# its largest. D: |d volumetric / d axial| below this over its window.
B_WINDOW, B_SHARE = 0.002, 0.2
D_WINDOW, D_SLOPE = 0.05, 0.02


class NotRun(Exception):
    """A run that a row needs is not complete."""


class Unmeasurable(Exception):
    """The runs are there and do not have what the row asks for."""


def number(text):
    """An empty cell is None: not defined for such an assembly."""
    return float(text) if text else None


class Table:
    """Columns of a CSV by name. `stage` is text, all else numbers or None."""

    def __init__(self, names, rows):
        self.names = list(names)
        self.columns = {name: [] for name in names}
        for row in rows:
            for name, cell in zip(names, row):
                self.columns[name].append(cell if name == "stage" else number(cell))

    @staticmethod
    def read(path):
        with open(path, encoding="utf-8", newline="") as file:
            rows = csv.reader(file)
            return Table(next(rows), rows)

    def __len__(self):
        return len(next(iter(self.columns.values())))

    def __getitem__(self, name):
        return self.columns[name]

    def where(self, keep):
        """The rows whose index is kept."""
        at = [k for k in range(len(self)) if keep(k)]
        part = Table(self.names, [])
        part.columns = {name: [column[k] for k in at] for name, column in self.columns.items()}
        return part

    def joined(self, other):
        """The rows of both; columns that one lacks are None there."""
        both = Table([*self.names, *(n for n in other.names if n not in self.columns)], [])
        both.columns = {name: self.columns.get(name, [None] * len(self))
                        + other.columns.get(name, [None] * len(other)) for name in both.names}
        return both


def shear_stress_ratio(table):
    """a_s = sqrt(3/2) |deviator| / mean stress, of each row (6.23)."""
    ratios = []
    for xx, yy, zz, xy, yz, zx in zip(*(table[f"s_{k}"]
                                        for k in ("xx", "yy", "zz", "xy", "yz", "zx"))):
        mean = (xx + yy + zz) / 3.0
        square = sum((s - mean)**2 for s in (xx, yy, zz)) + 2 * (xy * xy + yz * yz + zx * zx)
        ratios.append(math.sqrt(1.5 * square) / mean if mean > 0.0 else 0.0)
    return ratios


def least_squares_slope(x, y):
    """Of y over x; needs two different x."""
    mx, my = statistics.fmean(x), statistics.fmean(y)
    below = sum((a - mx)**2 for a in x)
    if below == 0.0:
        raise Unmeasurable("all at one place: no slope")
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / below


def correlation(x, y):
    """Pearson's."""
    mx, my = statistics.fmean(x), statistics.fmean(y)
    xx, yy = sum((a - mx)**2 for a in x), sum((b - my)**2 for b in y)
    if xx == 0.0 or yy == 0.0:
        raise Unmeasurable("all equal: no correlation")
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / math.sqrt(xx * yy)


def sloping_windows(x, y, width):
    """(middle, slope) of the rows within each window of this width that is fully there; x rises."""
    sums = [(0.0, 0.0, 0.0, 0.0)]  # of x, y, x x, x y up to each row
    for a, b in zip(x, y):
        sx, sy, sxx, sxy = sums[-1]
        sums.append((sx + a, sy + b, sxx + a * a, sxy + a * b))
    found, first = [], 0
    for last in range(len(x)):
        while x[last] - x[first] > width * (1 + 1e-9):
            first += 1
        count = last + 1 - first
        sx, sy, sxx, sxy = (t - f for t, f in zip(sums[last + 1], sums[first]))
        below = sxx - sx * sx / count
        if count >= 3 and x[last] - x[first] >= 0.9 * width and below > 0.0:
            found.append((sx / count, (sxy - sx * sy / count) / below))
    return found


class Test:
    """A shear test: the rows of its stage, with the state that it started from as first row."""

    def __init__(self, table, summary, stretch=1.0):
        self.table, self.summary, self.stretch = table, summary, stretch
        self.strain = table["axial_strain"]

    def __getitem__(self, name):
        """A column; a_s of history.csv, which does not have it, from the stresses."""
        if name == "a_s" and name not in self.table.columns:
            self.table.columns[name] = shear_stress_ratio(self.table)
        return self.table[name]

    @property
    def end(self):
        return self.strain[-1]

    def mean_at(self, name, strain, window=WINDOW):
        """The mean of rows within half a window of a strain of the study; the nearest row where
        there is none."""
        return self._mean_near(self[name], self.strain, min(strain * self.stretch, self.end),
                               window)

    @staticmethod
    def _mean_near(values, strains, at, window):
        near = [v for v, x in zip(values, strains)
                if abs(x - at) <= window / 2 * (1 + 1e-9) and v is not None]
        if not near:
            known = [(abs(x - at), v) for v, x in zip(values, strains) if v is not None]
            if not known:
                raise Unmeasurable("a column without values")
            near = [min(known)[1]]
        return statistics.fmean(near)

    def start(self, name):
        return self[name][0]

    def last(self, name, window=WINDOW):
        return self._mean_near(self[name], self.strain, self.end - window / 2, window)

    def slope_at(self, name, strain, width):
        """d name / d axial strain by least squares over a window about a strain."""
        at = strain * self.stretch
        rows = [(x, y) for x, y in zip(self.strain, self[name])
                if abs(x - at) <= width / 2 * (1 + 1e-9) and y is not None]
        if len(rows) < 3:
            rows = sorted(((x, y) for x, y in zip(self.strain, self[name]) if y is not None),
                          key=lambda row: abs(row[0] - at))[:3]
        return least_squares_slope(*zip(*rows))

    def slopes(self, name, width):
        return sloping_windows(self.strain, self[name], width)

    def after(self, name, strain):
        """Values from a strain of the study on."""
        return [v for v, x in zip(self[name], self.strain)
                if x >= strain * self.stretch and v is not None]

    @functools.cached_property
    def peak_friction(self):
        """(degrees, axial strain)"""
        return (self.summary["peak_friction_angle_deg"], self.summary["strain_at_peak_friction"])

    @functools.lru_cache(maxsize=None)
    def peak_dilation(self, window=WINDOW):
        """(largest slope of volumetric over axial strain, axial strain), positive in dilation."""
        slopes = self.slopes("volumetric_strain", window)
        if not slopes:
            raise Unmeasurable(f"no rows over {window} of axial strain")
        return max((slope, at) for at, slope in slopes)

    @functools.cached_property
    def points(self):
        """Axial strains of the published states A, B, C, D, by the rules above; D_is_last where no
        row after C has a constant volume."""
        rises = self.slopes("a_s", B_WINDOW)
        steepest = max((slope for _, slope in rises), default=0.0)
        top = next((k for k, (_, slope) in enumerate(rises) if slope == steepest), 0)
        b = next((at for at, slope in rises[top:] if slope <= B_SHARE * steepest), self.end)
        c = self.peak_friction[1]
        d = next((at for at, slope in self.slopes("volumetric_strain", D_WINDOW)
                  if at > c and abs(slope) < D_SLOPE), None)
        return {"A": 0.0, "B": b, "C": c, "D": self.end if d is None else d,
                "D_is_last": d is None}


class Study:
    """Complete runs of a result directory.

    @param jobs  {name: Job} of running.py"""

    def __init__(self, programme, jobs):
        self.programme, self.jobs = programme, jobs
        self.scale = programme.scale
        self.seeds = programme.scale.seeds
        self.small_seeds = programme.small_seeds()

    @property
    def stretch(self):
        return self.scale.strain / 0.4

    def _complete(self, name):
        if name not in self.jobs or self.jobs[name].status != "complete":
            raise NotRun(name)
        return self.jobs[name]

    @functools.lru_cache(maxsize=None)
    def summary(self, name):
        with open(self._complete(name).path("summary.json"), encoding="utf-8") as file:
            return json.load(file)

    @functools.lru_cache(maxsize=None)
    def history(self, name):
        return Table.read(self._complete(name).path("history.csv"))

    @functools.lru_cache(maxsize=None)
    def micro(self, name):
        return Table.read(self._complete(name).path("micro.csv"))

    @functools.lru_cache(maxsize=None)
    def averages(self, name, state="final"):
        """JSON of `tangency-dem micro` of a state that the programme lists in `tables`."""
        with open(self._complete(name).path("tables", state + ".json"), encoding="utf-8") as file:
            return json.load(file)

    def lineage(self, name, kind="history"):
        """The rows of a run and of those that it goes on from, of these the stages that grow."""
        tables = [getattr(self, kind)(run.name) for run in self.programme.ancestors(name)]
        return functools.reduce(Table.joined, tables)

    def _stage_rows(self, table, name):
        """Those of the run's last stage, which shears."""
        stage = self.programme.runs[name].stages[-1].get("name", "shear")
        rows = table.where(lambda k: table["stage"][k] == stage)
        if rows["axial_strain"] and rows["stage_cycle"][0] == 0.0:
            rows = rows.where(lambda k: k > 0)
        return rows

    @staticmethod
    def _unstrained(rows, before):
        """A first row of the state before, {column: value}, whose strains are 0."""
        first = Table(rows.names, [])
        for column in rows.names:
            begins = column in ("axial_strain", "volumetric_strain", "stage_cycle")
            first.columns[column] = [0.0 if begins else before.get(column)]
        return first

    @functools.lru_cache(maxsize=None)
    def test(self, name):
        """A shear test; its first row is the state that it resumed."""
        rows = self._stage_rows(self.history(name), name)
        before = self.summary(self.programme.runs[name].after)
        return Test(self._unstrained(rows, before).joined(rows), self.summary(name), self.stretch)

    @functools.lru_cache(maxsize=None)
    def micro_test(self, name):
        """The same test's rows of micro.csv: its averages over the axial strain."""
        rows = self._stage_rows(self.micro(name), name)
        before = self.micro(self.programme.runs[name].after)
        first = {column: before.columns[column][-1] for column in before.names}
        return Test(self._unstrained(rows, first).joined(rows), self.summary(name), self.stretch)
