# SPDX-License-Identifier: MIT
"""What the page's chapters are made of: pictures with their captions, and the curves many share."""

import dataclasses
import math

import charts
from results import PRESSURES, shear_of


@dataclasses.dataclass
class Picture:
    """A file of the folder of pictures, and what is said to who cannot see it."""

    file: str
    alt: str
    label: str = ""  # below it, where several share a caption


@dataclasses.dataclass
class Figure:
    """Pictures with one caption, in HTML. Without pictures the page says what is lacking."""

    title: str
    pictures: list
    caption: str
    lacking: list = dataclasses.field(default_factory=list)
    columns: int = 1  # of pictures side by side on a wide page; more than one: a row of its own


@dataclasses.dataclass
class Chapter:
    key: str
    title: str
    text: str  # HTML
    figures: list


def plain(text):
    """A chart's text without gnuplot's marks."""
    for mark in "_^{}":
        text = text.replace(mark, "")
    return text


def shown(value):
    return f"{value:.3g}".replace("-", "−")


def alt_of(chart):
    """A chart in words: what it draws, and of each curve where it starts, is largest and ends."""
    words = []
    for curve in chart.curves:
        points = [(x, y) for x, y in zip(curve.x, curve.y) if math.isfinite(x) and math.isfinite(y)]
        if not points or len(set(points)) < len(points) == 2:  # nothing, or what in_legend() makes
            continue
        name = plain(curve.name) or "curve"
        top = max(points, key=lambda point: point[1])
        if len(points) == 1:
            words.append(f"{name}: {shown(points[0][1])} at {shown(points[0][0])}")
        else:
            words.append(f"{name}: {shown(points[0][1])} at first, at most {shown(top[1])} at "
                         f"{shown(top[0])}, {shown(points[-1][1])} at last")
    return (f"Chart of {plain(chart.y_label)} against {plain(chart.x_label)}. "
            + "; ".join(words[:9]) + ".")


def in_legend(name, curves, style="dashes"):
    """A line of the legend for all curves of a style, grey; shown where one curve is."""
    points = [(x, y) for curve in curves for x, y in zip(curve.x, curve.y)
              if math.isfinite(x) and math.isfinite(y)][:1]
    return charts.Curve(name, [x for x, _ in points] * 2, [y for _, y in points] * 2,
                        colour="#555555",
                        style=style)


class Maker:
    """Collects charts, to be drawn together, and gives their figures."""

    def __init__(self, results, states):
        self.results, self.states = results, states
        self.charts = []

    def chart(self, key, title, x_label, y_label, curves, caption, **options):
        """A figure of one chart; a figure without a picture where no curve has a point."""
        lacking = self.results.take_lacking()
        chart = charts.Chart(key, title, x_label, y_label, [c for c in curves if c], **options)
        if not chart.shows():
            return Figure(plain(title), [], caption, lacking)
        self.charts.append(chart)
        return Figure(plain(title), [Picture(key + ".svg", alt_of(chart))], caption, lacking)

    def pressures(self, key, title, y_label, y, caption, *, kind="history", dashed=None,
                  dashed_name="", family="spheroid", pressures=PRESSURES, **options):
        """A quantity against axial strain, a curve a pressure; dashed: another one, in dashes."""
        map_y, dashed_y = options.pop("map_y", None), dashed
        curves = []
        for pressure, colour in zip(pressures, charts.ordered_colours(len(pressures))):
            stem = shear_of(pressure, family)
            curves.append(self.results.curve(f"{pressure} MPa", stem, y, kind=kind, stage="shear",
                                             colour=colour, map_y=map_y))
            if dashed_y:
                curves.append(self.results.curve("", stem, dashed_y, kind=kind, stage="shear",
                                                 colour=colour, style="dashes", band=False))
        if dashed_y and dashed_name:
            curves.append(in_legend(dashed_name, curves))
        return self.chart(key, title, "axial strain", y_label, curves, caption, **options)

    def against_pressure(self, key, title, y_label, measures, caption, *, families=None, **options):
        """Points over the pressures: {name: measure(folder)} of the shear tests."""
        curves = []
        for k, (name, measure) in enumerate(measures.items()):
            family = (families or {}).get(name, "spheroid")
            stems = {pressure: shear_of(pressure, family) for pressure in PRESSURES}
            curves.append(self.results.points(name, stems, measure, colour=charts.COLOURS[k]))
        options.setdefault("x_range", (0, 105))
        return self.chart(key, title, "mean stress, MPa", y_label, curves, caption, **options)
