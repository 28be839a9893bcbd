# SPDX-License-Identifier: MIT
"""Charts of the study's page: curves with bands and points, drawn by gnuplot as SVG.

A chart's texts are gnuplot's enhanced ones: a_{s} has a subscript, e^{2} a superscript. Each chart
leaves KEY.csv, what it shows, and KEY.svg. Errors: gnuplot that is missing or fails is a
StudyError.
"""

import csv
import dataclasses
import math
import os
import re
import subprocess

from running import StudyError

# Told apart by the colour-blind too [Wong2011], and three more.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#e69f00", "#555555",
           "#7b3fa0")

# Of what has an order, as pressures: dark to light, so that it also speaks to who sees no hues;
# five colours of the map viridis, the last one darker, since the ground is white.
SCALE = ("#440154", "#3b528b", "#21918c", "#5ec962", "#c9a800")

# Chosen: pixels of a chart, its legend apart.
WIDTH, HEIGHT = 440, 325

# Of the legend, in pixels: a line of it, what gnuplot takes for a letter and for a sample of a
# curve, and the width that it fills. Measured on what gnuplot 5.4 draws with letters of 13.
LEGEND_LINE, LEGEND_LETTER, LEGEND_SAMPLE, LEGEND_WIDTH = 20, 8, 46, 315

# Chosen: points of a curve; more cannot be told apart at WIDTH.
MOST_POINTS = 220

# Chosen: of the axis y, as a share of the largest value; less needs long numbers.
LEAST_SPAN = 0.04

STYLES = ("line", "dashes", "dots", "points", "marks", "steps", "bars")


@dataclasses.dataclass
class Curve:
    """What one line of the legend is for; without a name it is not in the legend.

    low and high, of the length of x, are a band about the curve; with points they are error bars.
    What is not finite parts the curve. Styles: line, dashes (long), dots (short dashes), points
    (filled), marks (open), steps, bars (columns as wide as the least distance of x).
    """

    name: str
    x: list
    y: list
    low: list = None
    high: list = None
    colour: str = COLOURS[0]
    style: str = "line"

    def shows(self):
        """Whether any point of it can be drawn."""
        return any(math.isfinite(a) and math.isfinite(b) for a, b in zip(self.x, self.y))


@dataclasses.dataclass
class Chart:
    """Ranges are (low, high), where None leaves an end to the data; zero draws a line at y = 0."""

    key: str
    title: str
    x_label: str
    y_label: str
    curves: list
    x_range: tuple = (None, None)
    y_range: tuple = (None, None)
    zero: bool = False
    logarithmic: bool = False  # the axis x
    labels: dict = dataclasses.field(default_factory=dict)  # in place of numbers at x: {x: text}

    def shows(self):
        return any(curve.shows() for curve in self.curves)


def ordered_colours(count):
    """count colours of SCALE from dark to light, its ends first."""
    if count <= 1:
        return [SCALE[1]]
    if count > len(SCALE):
        return [COLOURS[k % len(COLOURS)] for k in range(count)]
    return [SCALE[round(k * (len(SCALE) - 1) / (count - 1))] for k in range(count)]


def thinned(curve):
    """The curve with at most about MOST_POINTS points; of each piece its lowest and highest one."""
    count = len(curve.x)
    if count <= MOST_POINTS or curve.style not in ("line", "dashes", "dots"):
        return curve
    piece = math.ceil(2 * count / MOST_POINTS)
    kept = set()
    for first in range(0, count, piece):
        indices = range(first, min(first + piece, count))
        finite = [k for k in indices if math.isfinite(curve.y[k])] or indices[:1]
        kept.add(min(finite, key=lambda k: curve.y[k]))
        kept.add(max(finite, key=lambda k: curve.y[k]))
    kept = sorted(kept | {0, count - 1})

    def some(column):
        return None if column is None else [column[k] for k in kept]

    return dataclasses.replace(curve, x=some(curve.x), y=some(curve.y), low=some(curve.low),
                               high=some(curve.high))


def number(value):
    """Text of a table and of gnuplot; what is not finite is empty."""
    return repr(float(value)) if math.isfinite(value) else ""


def write_table(file, chart):
    """What the chart shows: a row a point; low and high are the ends of the band or of the bar."""
    with open(file, "w", encoding="utf-8", newline="") as table:
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(("curve", "x", "y", "low", "high"))
        for curve in chart.curves:
            none = [math.nan] * len(curve.x)
            for row in zip(curve.x, curve.y, curve.low or none, curve.high or none):
                writer.writerow((curve.name, *map(number, row)))


def draw(charts, folder):
    """Writes KEY.csv and KEY.svg of each chart that shows anything; the others are left out."""
    charts = [chart for chart in charts if chart.shows()]
    if not charts:
        return
    for chart in charts:
        write_table(os.path.join(folder, chart.key + ".csv"), chart)
    script = HEAD + "".join(script_of(chart) for chart in charts)
    try:
        run = subprocess.run(["gnuplot"], input=script, capture_output=True, text=True, cwd=folder,
                             check=False, env=dict(os.environ, LC_ALL="C.UTF-8"))
    except FileNotFoundError:
        raise StudyError("gnuplot is not installed: ./demo installs it") from None
    drawn = [os.path.join(folder, chart.key + ".svg") for chart in charts]
    undrawn = [file for file in drawn if not os.path.exists(file) or not os.path.getsize(file)]
    if run.returncode != 0 or undrawn:
        raise StudyError(f"gnuplot failed: {run.stderr.strip() or undrawn[0] + ' is empty'}")
    for file in drawn:
        make_small(file)


def make_small(file):
    """Takes away the empty groups that gnuplot leaves, a sixth of a picture."""
    with open(file, encoding="utf-8") as picture:
        text = picture.read()
    with open(file, "w", encoding="utf-8") as picture:
        picture.write(re.sub(r"<g [^>]*>\s*</g>\n", "", text))


HEAD = """
set encoding utf8
set minussign
set border 3 linewidth 1 linecolor '#555555'
set tics nomirror out scale 0.5 textcolor '#222222'
set grid linewidth 0.5 linetype 1 linecolor '#dddddd'
set boxwidth 0.8 relative
set autoscale fix
set format '%.5g'
"""


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def legend_of(chart):
    """Columns and lines of the legend."""
    names = [curve.name for curve in chart.curves if curve.name and curve.shows()]
    if len(names) < 2:
        return 0, 0
    letters = max(len(re.sub(r"[_^{}]", "", name)) for name in names)
    columns = max(1,
                  min(len(names), int(LEGEND_WIDTH // (letters * LEGEND_LETTER + LEGEND_SAMPLE))))
    return columns, math.ceil(len(names) / columns)


def range_of(ends):
    return "[" + ":".join("*" if end is None else repr(float(end)) for end in ends) + "]"


def heights_of(chart):
    """The range of y; of values that hardly differ it is made wide, else their numbers are long."""
    values = [y for curve in chart.curves for y in curve.y if math.isfinite(y)]
    low, high = min(values), max(values)
    size = max(abs(low), abs(high))
    if chart.y_range != (None, None) or high - low > LEAST_SPAN * size:
        return chart.y_range
    return (low - LEAST_SPAN * size, high + LEAST_SPAN * size) if size > 0.0 else (-1.0, 1.0)


def script_of(chart):
    """gnuplot's commands for one chart."""
    columns, lines = legend_of(chart)
    height = HEIGHT + LEGEND_LINE * lines
    floor = (66 + LEGEND_LINE * lines) / height
    if chart.labels:
        places = (f"{quoted(text)} {float(x)!r}" for x, text in chart.labels.items())
        ticks = "(" + ", ".join(places) + ")"
    else:
        ticks = "autofreq"
    key = (f"set key at screen 0.52,{6 / height:.4f} center bottom horizontal maxcols {columns} "
           "samplen 1.6 width -1 font ',13' textcolor '#222222'" if columns else "unset key")
    lines_of = [
        f"set terminal svg size {WIDTH},{height} fixed enhanced font 'Helvetica,14' background "
        "'#ffffff'",
        f"set output {quoted(chart.key + '.svg')}",
        f"set title {quoted(chart.title)} font ',15' textcolor '#222222' offset 0,-0.4",
        f"set xlabel {quoted(chart.x_label)} offset 0,0.3",
        # gnuplot leaves an axis's own name out where long numbers leave it no room.
        f"set label 1 {quoted(chart.y_label)} at screen 0.035, graph 0.5 center rotate by 90",
        f"set tmargin at screen {1 - 34 / height:.4f}",
        f"set bmargin at screen {floor:.4f}",
        "set lmargin at screen 0.195",
        "set rmargin at screen 0.97",
        f"set xrange {range_of(chart.x_range)}",
        f"set yrange {range_of(heights_of(chart))}",
        "set offsets 0, 0, "
        + ("graph 0.05, graph 0.03" if None in heights_of(chart) else "0, 0"),
        "set logscale x" if chart.logarithmic else "unset logscale x",
        f"set xtics {ticks}",
        key,
    ]
    data, plots = [], []
    if chart.zero:
        plots.append("0 with lines linewidth 1 linecolor rgb '#888888' notitle")
    for at, curve in enumerate(chart.curves):
        if curve.shows():
            block = f"$curve{at}"
            data.append(block_of(block, thinned(curve)))
            plots.extend(plots_of(block, curve))
    return ("\n".join(lines_of) + "\n" + "".join(data) + "plot " + ", \\\n  ".join(plots)
            + "\nunset output\n")


def block_of(name, curve):
    banded = curve.low is not None and curve.high is not None
    rows = []
    for k, (x, y) in enumerate(zip(curve.x, curve.y)):
        values = (x, y, curve.low[k], curve.high[k]) if banded else (x, y)
        # An empty line parts what gnuplot joins.
        rows.append(" ".join(f"{v:.7g}" for v in values) if all(map(math.isfinite, values)) else "")
    return f"{name} << END\n" + "\n".join(rows) + "\nEND\n"


def plots_of(block, curve):
    title = f"title {quoted(curve.name)}" if curve.name else "notitle"
    colour = f"linecolor rgb '{curve.colour}'"
    banded = curve.low is not None and curve.high is not None
    if curve.style in ("points", "marks"):
        kind = 7 if curve.style == "points" else 6
        point = f"pointtype {kind} pointsize 0.7 linewidth 1.4 {colour}"
        bars = [f"{block} using 1:2:3:4 with yerrorbars pointtype 0 linewidth 1.2 {colour} notitle"]
        return (bars if banded else []) + [f"{block} using 1:2 with points {point} {title}"]
    if curve.style == "bars":
        return [f"{block} using 1:2 with boxes fillstyle solid 0.45 noborder {colour} {title}"]
    if curve.style == "steps":
        return [f"{block} using 1:2 with steps linewidth 2 {colour} {title}"]
    dash = {"line": "", "dashes": "dashtype (9,5)", "dots": "dashtype (2,4)"}[curve.style]
    band = [f"{block} using 1:3:4 with filledcurves fillstyle transparent solid 0.16 noborder "
            f"{colour} notitle"] if banded else []
    return band + [f"{block} using 1:2 with lines linewidth 2 {dash} {colour} {title}"]
