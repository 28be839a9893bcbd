# SPDX-License-Identifier: MIT
"""What the study's runs left, as curves for its page.

OUT/runs/STEM-sSEED is a run; the runs of one stem differ by their seed, and a curve is their mean
and band. Pressures are in MPa here, strains are fractions, other units are those of the tables.
What a figure asks for and is not there is kept in `lacking`, which the figure takes and tells.
"""

import glob
import json
import math
import os
import re

import charts
import series

# Of Table 5.2, MPa; the released samples from the lowest to the dense one.
PRESSURES = (10, 30, 50, 70, 100)


def shear_of(pressure, family="spheroid"):
    """The stem of the shear test at a pressure in MPa."""
    return f"{family}-p{pressure:03d}-shear"


class Results:
    """Reads each table once. Not for several threads."""

    def __init__(self, out):
        self.out = out
        self.lacking = []
        self.kept = {}

    def folders(self, stem):
        """Directories of the stem's complete runs by ascending seed; the others are lacking."""
        pattern = os.path.join(self.out, "runs", glob.escape(stem) + "-s*")
        found = [folder for folder in glob.glob(pattern)
                 if re.fullmatch(re.escape(stem) + r"-s\d+", os.path.basename(folder))]
        found.sort(key=lambda folder: int(folder.rpartition("-s")[2]))
        complete = [folder for folder in found
                    if os.path.exists(os.path.join(folder, "summary.json"))]
        if not complete:
            self.lack(stem)
        for folder in found:
            if folder not in complete:
                self.lack(os.path.basename(folder))
        return complete

    def lack(self, name):
        if name not in self.lacking:
            self.lacking.append(name)

    def take_lacking(self):
        lacking, self.lacking = self.lacking, []
        return lacking

    def table(self, folder, kind="history", stage=None):
        """history.csv or micro.csv of a run; an empty table where there is none."""
        place = (folder, kind, stage)
        if place not in self.kept:
            file = os.path.join(folder, kind + ".csv")
            if os.path.exists(file):
                self.kept[place] = series.Columns.of(file, stage)
                if kind == "micro":
                    self.add_shape(folder, stage)
            else:
                self.lack(f"{os.path.basename(folder)}/{kind}.csv")
                self.kept[place] = series.Columns()
        return self.kept[place]

    def add_shape(self, folder, stage):
        """To micro.csv what only histories tell of growth, by its cycles."""
        micro, history = self.kept[folder, "micro", stage], self.table(folder)
        for name in ("elongation", "eccentricity"):
            if micro.count and name not in micro.table.names:
                cycles, values = series.ascending(history.column("cycle"), history.column(name))
                micro.add(name, [series.at(cycles, values,
                                           cycle) for cycle in micro.column("cycle")])

    def summary(self, folder, name):
        """A number of a run's summary.json; nan where it has none."""
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            value = json.load(file).get(name)
        return math.nan if value is None else value

    def averages(self, folder, name):
        """tables/NAME.json of a run, empty where there is none."""
        try:
            with open(os.path.join(folder, "tables", name + ".json"), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            return {}

    def seeds(self, stems):
        """Folders of each seed, one run resuming the other, as far as the seed has them: [[folder
        ...]]."""
        chains = {}
        for at, stem in enumerate(stems):
            for folder in self.folders(stem):
                chain = chains.setdefault(folder.rpartition("-s")[2], [])
                if len(chain) == at:
                    chain.append(folder)
        return [chain for chain in chains.values() if chain]

    def lines(self, stems, x, y, kind="history", stage=None):
        """(x, y) of each seed, rows of several stems behind one another."""
        stems = (stems,) if isinstance(stems, str) else stems
        found = []
        for chain in self.seeds(stems):
            all_x, all_y = [], []
            for folder in chain:
                table = self.table(folder, kind, stage)
                all_x += table.column(x)
                all_y += table.column(y)
            found.append((all_x, all_y))
        return found

    def curve(self, name, stems, y, *, x="axial_strain", kind="history", stage=None, colour=None,
              style="line", map_y=None, band=True):
        """Mean and band over the seeds. map_y makes of the columns (x, y) of one seed another y."""
        lines = self.lines(stems, x, y, kind, stage)
        if map_y:
            lines = [(a, map_y(a, b)) for a, b in (series.ascending(*line) for line in lines)]
        grid, mean, low, high = series.mean_and_band(lines)
        if not band:
            low = high = None
        return charts.Curve(name, grid, mean, low, high, colour or charts.COLOURS[0], style)

    def per_seed(self, stem, measure):
        """measure(folder) of each seed."""
        return [measure(folder) for folder in self.folders(stem)]

    def points(self, name, stems, measure, *, colour=None, style="points"):
        """Over {abscissa: stem} the mean of measure(folder) over seeds, with its ends."""
        x, y, low, high = [], [], [], []
        for at, stem in stems.items():
            mean, least, most = series.mean_and_ends(self.per_seed(stem, measure))
            x.append(at)
            y.append(mean)
            low.append(least)
            high.append(most)
        return charts.Curve(name, x, y, low, high, colour or charts.COLOURS[0], style)

    def first(self, folder, column, kind="history", stage="shear"):
        """The first finite value of a column; nan without."""
        values = self.table(folder, kind, stage).column(column)
        return next((value for value in values if math.isfinite(value)), math.nan)

    def last(self, folder, column, kind="history", stage="shear"):
        values = self.table(folder, kind, stage).column(column)
        return next((value for value in reversed(values) if math.isfinite(value)), math.nan)

    def value_at(self, folder, column, strain, kind="history", stage="shear"):
        """A column at an axial strain, nan where the run does not reach it."""
        table = self.table(folder, kind, stage)
        x, y = series.ascending(table.column("axial_strain"), table.column(column))
        if x and x[-1] < strain:
            self.lack(f"{os.path.basename(folder)} beyond a strain of {x[-1]:.3g}")
        return series.at(x, y, strain)

    def largest(self, folder, column, kind="micro", stage="shear"):
        """(value, axial strain) of the largest value of a column."""
        table = self.table(folder, kind, stage)
        pairs = [(y, x) for x, y in zip(table.column("axial_strain"), table.column(column))
                 if math.isfinite(y)]
        return max(pairs, default=(math.nan, math.nan))
