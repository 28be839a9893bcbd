#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The page of a study: OUT/index.html, one file that needs no network, from what its runs left.

Reads OUT/rows.csv, OUT/runs.csv and OUT/runs; writes OUT/pictures (each chart's data as CSV beside
it) and OUT/index.html. What a run that is not there would have shown is named in its place.

Usage: page.py OUT [TANGENCY_DEM]
"""

import base64
import csv
import datetime
import html
import os
import re
import sys

if __name__ == "__main__":
    sys.dont_write_bytecode = True

import pictures
import stages
import verdicts
from running import StudyError

# How verdicts are shown: a class of page.css, in the order of the count.
VERDICTS = {verdicts.REPRODUCED: "yes", verdicts.NOT_REPRODUCED: "no",
            verdicts.DOUBTFUL: "doubtful",
            verdicts.REPORTED: "reported", verdicts.NOT_RUN: "missing", verdicts.FAULT: "missing"}

HERE = os.path.dirname(os.path.abspath(__file__))


def table_of(file):
    """Rows of a table, each {column: text}; none where the file is not there."""
    try:
        with open(file, encoding="utf-8", newline="") as table:
            return list(csv.DictReader(table))
    except FileNotFoundError:
        return []


def image_of(folder, picture):
    """The picture itself in the page."""
    kind = "svg+xml" if picture.file.endswith(".svg") else "png"
    with open(os.path.join(folder, picture.file), "rb") as file:
        data = base64.b64encode(file.read()).decode("ascii")
    return f'<img alt="{html.escape(picture.alt)}" src="data:image/{kind};base64,{data}">'


def figure_of(folder, figure):
    lacking = ", ".join(figure.lacking)
    if not figure.pictures:
        lacking = f"Not drawn; missing: {lacking}" if lacking else "Not drawn: no values"
    elif lacking:
        lacking = f"Missing: {lacking}"
    lacking = f'<p class="lacking">{html.escape(lacking)}.</p>' if lacking else ""
    images = []
    for picture in figure.pictures:
        label = f"<span>{html.escape(picture.label)}</span>" if picture.label else ""
        images.append(f"<div>{image_of(folder, picture)}{label}</div>")
    kind = "figure wide" if figure.columns > 1 else "figure"
    tiles = "\n".join(images)
    if figure.columns > 1:
        tiles = f'<div class="tiles" style="--columns:{figure.columns}">{tiles}</div>'
    # A chart has its title in itself.
    title = "" if len(figure.pictures) == 1 else f"<h3>{html.escape(figure.title)}</h3>\n"
    return (f'<figure class="{kind}">\n{title}{tiles}\n'
            f"<figcaption>{figure.caption}{lacking}</figcaption>\n</figure>\n")


def chapter_of(folder, chapter):
    figures = "".join(figure_of(folder, figure) for figure in chapter.figures)
    return (f'<section id="{chapter.key}">\n<h2>{html.escape(chapter.title)}</h2>\n{chapter.text}\n'
            f'<div class="figures">\n{figures}</div>\n</section>\n')


def count_of(rows):
    """How many rows have which verdict."""
    count = {}
    for row in rows:
        count[row["verdict"]] = count.get(row["verdict"], 0) + 1
    items = "".join(f'<li class="{kind}"><b>{count[verdict]}</b> {verdict}</li>'
                    for verdict, kind in VERDICTS.items() if verdict in count)
    return f'<ul class="count">{items}</ul>\n'


def value_of(text):
    """A value of a table as HTML: 1.3e+10 with a power of ten, a minus as wide as a plus."""
    text = html.escape(text or "")
    text = re.sub(r"\b(\d+(?:\.\d+)?)e\+?(-?)0*(\d+)\b", r"\1&nbsp;×&nbsp;10<sup>\2\3</sup>", text)
    return re.sub(r"(?<![\w)])-(?=[\d.])", "−", text)


def rows_of(rows):
    """The table of statements; on a narrow page each row is a block."""
    names = (("statement", "statement"), ("published", "published"), ("bar", "bar"),
             ("ours", "here"),
             ("scatter", "scatter"), ("verdict", "verdict"), ("note", "note"))
    head = "".join(f'<th scope="col">{name}</th>' for name in ("section", *(n for _, n in names)))
    body = []
    for row in rows:
        cells = [f'<th scope="row" title="{html.escape(row["id"])}">'
                 f'{html.escape(row["section"])}</th>']
        for column, name in names:
            text = value_of(row[column])
            if column == "verdict":
                text = f'<span class="{VERDICTS.get(row[column], "missing")}">{text}</span>'
            if column == "ours" and row["seeds"] not in ("", "0"):
                text += f' <small>({row["seeds"]} seed{"s" if row["seeds"] != "1" else ""})</small>'
            empty = "" if text else ' class="empty"'
            cells.append(f'<td data-name="{name}"{empty}>{text}</td>')
        body.append("<tr>" + "".join(cells) + "</tr>")
    return (f"<table><thead><tr>{head}</tr></thead>\n<tbody>\n" + "\n".join(body)
            + "\n</tbody></table>\n")


def missing_of(runs):
    """Runs that are not complete, each once."""
    named = {row["run"]: row["status"] for row in runs if row["status"] != "complete"}
    if not named:
        return ""
    items = ", ".join(f"{html.escape(run)} "
                      f"({html.escape(status)})" for run, status in named.items())
    return f'<p class="lacking">Runs that are not complete: {items}.</p>\n'


def preparation():
    """How samples are made, with the programme's own numbers."""
    friction, balance = stages.RELEASE_FRICTION, stages.RELEASE_BALANCE
    how = "without friction" if friction == 0.0 else f"with a friction coefficient of {friction:g}"
    return (f"""<p>Spheres of radius {stages.RADIUS:g} m start at random in a periodic cell and are
compacted, without friction, under {1e-6 * stages.DENSE:g} MPa. Their eccentricity then grows in
small steps at constant volume, without friction, while the mean stress is held. The dense sample is
released to the lower pressures {how}, each time until no unbalanced force is above
{100 * balance:g} % of the mean contact force. In shear the friction coefficient is
{stages.FRICTION:g}, contacts are linear with a stiffness of {value_of(f"{stages.STIFFNESS:.3g}")}
N/m in both directions, as published.</p> """)


def text_of(out, chapters):
    with open(os.path.join(HERE, "page.css"), encoding="utf-8") as file:
        style = file.read()
    rows, runs = table_of(os.path.join(out, "rows.csv")), table_of(os.path.join(out, "runs.csv"))
    seeds = sorted({row["seed"] for row in runs}, key=lambda text: (len(text), text))
    links = "".join(f'<li><a href="#{key}">{html.escape(title)}</a></li>'
                    for key, title in [("rows", "All statements"),
                                       *((chapter.key, chapter.title) for chapter in chapters)])
    made = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    folder = os.path.join(out, "pictures")
    parts = [f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Tangency: a published study, run again</title>
<style>
{style}</style>
</head>
<body>
""", INTRODUCTION, count_of(rows), missing_of(runs), f"<nav><ul>{links}</ul></nav>\n",
             f'<section id="samples">\n<h2>How samples are made</h2>\n{preparation()}</section>\n',
             '<section id="rows">\n<h2>All statements</h2>\n', ROWS, rows_of(rows), "</section>\n",
             *(chapter_of(folder, chapter) for chapter in chapters),
             f"<footer>Made {made}, {len({row['run'] for row in runs})} runs, seeds "
             f"{html.escape(', '.join(seeds)) or 'none'}. Tables of the runs are in "
             "<code>runs</code>, each chart's data in "
             "<code>pictures</code>.</footer>\n</body>\n</html>\n"]
    return "".join(parts)


INTRODUCTION = """<h1>A published study, run again</h1>
<p>H. Ouadfel simulated assemblies of equal ellipsoids in triaxial compression and explained their
strength by the anisotropies of contacts and forces (<cite>Numerical simulations of granular
assemblies with three-dimensional ellipsoid-shaped particles</cite>, thesis, University of Waterloo,
1998). Here its tests were run again, with another program for contacts and motion, and every
statement that has a number or an order is compared. In what follows <em>the text</em> is that
thesis. Its figures are not available, so only what it says in words and tables is compared.</p>
"""

ROWS = """<p>Each row is a statement of the text, with the bar that it is held to. Values are means
over the seeds, scatter is the standard deviation of one seed. <em>Doubtful in the text</em> are
rows where the text contradicts itself or cannot be read. Marks: [C] it contradicts itself, [?] it
does not say or is unreadable, [E] a number of the list of errata in
<code>docs/derivations/micromechanics.md</code>.</p>
"""


def write_page(out, tool, jobs=2, quick=False):
    """Makes OUT/pictures and OUT/index.html, the latter written beside and renamed.

    @param tool   tangency-dem, for averages of states
    @param jobs   processes that draw at once
    @param quick  fewer pictures of states
    """
    chapters = pictures.draw(out, tool, jobs, quick)
    file = os.path.join(out, "index.html")
    with open(file + ".part", "w", encoding="utf-8") as page:
        page.write(text_of(out, chapters))
    os.replace(file + ".part", file)


def main():
    if len(sys.argv) not in (2, 3):
        print("usage: page.py OUT [TANGENCY_DEM]", file=sys.stderr)
        return 2
    tool = sys.argv[2] if len(sys.argv) == 3 else os.path.join(
        HERE, "..", "..", "build", "release", "dem", "tool", "tangency-dem")
    try:
        write_page(os.path.abspath(sys.argv[1]), os.path.abspath(tool), os.cpu_count() or 1)
    except (StudyError, OSError) as error:
        print(f"page.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
