#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The playground in headless Chromium: its answers are those of the command, and a hand finds its way.

Usage: playground_check.py PAGE TANGENCY PICTURES
Every pair of the corpora that is given by axes is asked in the page and of the program `tangency contact`, by each
of the four definitions. Relation, inner body and status have to be equal. Gaps may differ by the sum of both
proven errors, the other numbers as far as each says below; how many are equal to the bit is printed. Then the page is
used: dragged, turned, squashed, linked, typed into, and looked at with 1200 and 400 pixels. Ends with 1 at
the first difference, or where the console has an error. Packages: .ci/setup browser
"""
import csv
import math
import os
import pathlib
import subprocess
import sys

from browser import Browser

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import require  # noqa: E402

CORPORA = ("classes", "deep", "extreme", "float32", "near", "nested", "profiles", "symmetric", "touching")
DEFINITIONS = ("common-normal", "perram-wertheim", "midpoint-potential", "trace")
COLUMNS = [f"{body}.{name}" for body in "ab" for name in ("x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz")]
FURTHER = ("curvature_min", "curvature_max", "F", "F_error", "mu")
# The bound of trace_contact.hpp on its rounding, over u L, doubled: both sides round.
TRACE_ROUNDING = 2e6 * 2.0**-53
# That of curvature.hpp, 512 u beta and its term for a small one, for the aspect ratios here; F is known to F_error.
ROOT = pathlib.Path(__file__).resolve().parents[2]


def number(text):
    if text == "":
        return None
    return float.fromhex(text) if "x" in text.lower() else float(text)


def rows_of(lines):
    return list(csv.DictReader(line for line in lines if not line.startswith("#") and line.strip()))


def pairs_of(name):
    """Rows of 20 numbers; the orientation that a table leaves out is that of no turn."""
    turn = {"qw": 1.0, "qx": 0.0, "qy": 0.0, "qz": 0.0}
    with open(ROOT / "verify" / "corpora" / f"{name}.csv", encoding="utf-8") as file:
        rows = rows_of(file)
    return [[number(row[column].strip()) if column in row else turn[column[2:]] for column in COLUMNS] for row in rows]


def native(tangency, pairs, definition):
    table = "\n".join([",".join(COLUMNS)] + [",".join(repr(x) for x in pair) for pair in pairs]) + "\n"
    command = [tangency, "contact", "--method", definition, "--columns", ",".join(FURTHER), "-"]
    done = subprocess.run(command, input=table, capture_output=True, text=True, check=False)
    require(done.returncode in (0, 1), f"{' '.join(command)}: {done.stderr}")
    return rows_of(done.stdout.splitlines())


def size_of(pair):
    """L: what rounding is relative to."""
    return math.dist(pair[:3], pair[10:13]) + max(pair[3:6]) + max(pair[13:16])


class Comparison:
    """Counts, and ends at a difference that is not allowed."""

    def __init__(self):
        self.rows = self.gaps = self.equal = 0
        self.worst = 0.0

    def texts(self, where, page, command):
        require(page == command, f"{where}: the page says {page}, the command {command}")

    def gap(self, where, page, command, pair):
        """Both are within their own error of one truth."""
        if page["gap"] is None or command["gap"] == "":
            require(page["gap"] is None and command["gap"] == "", f"{where}: a gap in one place alone")
            return
        mine, other = page["gap"], float(command["gap"])
        errors = [page["gap_error"], number(command["gap_error"])]
        require((errors[0] is None) == (errors[1] is None), f"{where}: a gap_error in one place alone")
        allowed = TRACE_ROUNDING * size_of(pair) if errors[0] is None else errors[0] + errors[1]
        require(abs(mine - other) <= allowed, f"{where}: gap {mine!r} in the page, {other!r} by the command")
        self.gaps += 1
        self.equal += mine == other
        if allowed > 0:
            self.worst = max(self.worst, abs(mine - other) / allowed)

    def row(self, where, page, command, definition, pair):
        require("refused" not in page, f"{where}: refused: {page.get('refused')}")
        self.rows += 1
        self.texts(f"{where}: relation", page["relation"], command["relation"])
        self.texts(f"{where}: inner", page["inner"], command["inner"])
        gap = page["gaps"][definition]
        self.texts(f"{where}: status", gap["status"], command["status"])
        self.gap(where, gap, command, pair)
        if page["F"] is not None and command["F"] != "":
            allowed = page["F_error"] + float(command["F_error"])
            require(abs(page["F"] - float(command["F"])) <= allowed, f"{where}: F {page['F']!r}, not {command['F']}")


def compare(browser, tangency):
    comparisons = {definition: Comparison() for definition in DEFINITIONS}
    for name in CORPORA:
        pairs = pairs_of(name)
        answers = browser.run("await tangency.ready; return given[0].map((pair) => tangency.kernel.answer(pair))", pairs)
        for definition, comparison in comparisons.items():
            found = native(tangency, pairs, definition)
            require(len(found) == len(answers) == len(pairs), f"{name}: {len(answers)} answers, not {len(pairs)}")
            for k, (page, command) in enumerate(zip(answers, found)):
                comparison.row(f"{name}, row {k}, {definition}", page, command, definition, pairs[k])
    for definition, seen in comparisons.items():
        print(f"{definition}: {seen.rows} pairs, relation, inner and status equal; {seen.gaps} gaps, {seen.equal} of them equal "
              f"to the bit, the others apart by {seen.worst:.2f} of what is allowed at most")
    require(comparisons["common-normal"].rows >= 2690, "fewer pairs than the corpora have")


def pair_now(browser):
    return browser.run("await new Promise(requestAnimationFrame); await new Promise(requestAnimationFrame); return tangency.state")


def hands(browser, page):
    """Each hand's work changes what it should, and nothing else."""
    browser.open(page)
    browser.run("await tangency.ready")
    before = pair_now(browser)
    require(before["answer"]["relation"] in ("overlap", "separate"), "the page opens without an answer")
    at = browser.run("const b = tangency.state.pair.b; return drawing.projection.place([b.x, b.y, b.z]).slice(0, 2)")
    browser.drag("canvas", at, (40, 15))
    moved = pair_now(browser)
    require(moved["pair"]["a"] == before["pair"]["a"], "a drag of B changed A")
    require(moved["pair"]["b"]["x"] != before["pair"]["b"]["x"] and moved["pair"]["b"]["r1"] == before["pair"]["b"]["r1"],
            "a drag does not move B, and it alone")
    require(moved["answer"]["gaps"]["common-normal"]["gap"] != before["answer"]["gaps"]["common-normal"]["gap"],
            "the gap stays while B moves")
    browser.click("[data-mode=turn]")
    browser.drag("canvas", (at[0] + 40, at[1] + 15), (30, 20))
    turned = pair_now(browser)
    require(turned["pair"]["b"]["qw"] != moved["pair"]["b"]["qw"] and turned["pair"]["b"]["x"] == moved["pair"]["b"]["x"],
            "Turn does not turn B about its centre")
    tip = browser.run("return drawing.tips(tangency.state.pair.b).sort((p, q) => Math.hypot(...q.way) - Math.hypot(...p.way))[0]")
    browser.drag("canvas", tip["place"][:2], [0.3 * x for x in tip["way"]])
    squashed = pair_now(browser)
    name = ("r1", "r2", "r3")[tip["axis"]]
    ratio = squashed["pair"]["b"][name] / turned["pair"]["b"][name]
    require(1.2 < ratio < 1.4, f"a square that is drawn out by 0.3 makes the axis {ratio} of itself")
    browser.drag("canvas", (6, 6), (60, 40))
    require(pair_now(browser)["pair"] == squashed["pair"], "a drag beside the bodies changes the pair")
    return squashed


def links(browser, page, state):
    """The link gives the same pair to the bit, and so does the CSV."""
    fragment = browser.run("while (location.hash !== tangency.linkOf(tangency.state.pair)) await new Promise(requestAnimationFrame);"
                           "return location.hash")
    text = browser.run("return document.getElementById('csv').textContent")
    browser.open(page, fragment)
    browser.run("await tangency.ready")
    again = pair_now(browser)
    require(again["pair"] == state["pair"] and again["answer"] == state["answer"], "the link leads to another pair")
    row = [number(cell) for cell in text.splitlines()[1].split(",")]
    numbers = [state["pair"][body][name] for body in "ab" for name in ("x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz")]
    require(text.splitlines()[0].split(",") == COLUMNS and row == numbers, "the CSV is of another pair")


def fields(browser):
    """What cannot be is said as the command says it, and what is typed counts at once."""
    for name, typed, answer in (("r2", "-1", "a.r2 = -1: a semi-axis must be finite and > 0"), ("x", "", "a.x = nan: a centre must be finite"),
                                ("r1", "many", "a.r1 = nan: a semi-axis must be finite and > 0")):
        browser.run("const f = document.querySelector(`[data-body=a][data-name=${given[0]}]`); f.focus(); const before = f.value; f.value = given[1];"
                    "f.dispatchEvent(new Event('input')); window.before = before", name, typed)
        pair_now(browser)
        said = browser.run("return document.getElementById('says').textContent")
        require(said == answer, f"{typed!r} in a.{name} is answered by: {said}")
        browser.run("const f = document.querySelector(`[data-body=a][data-name=${given[0]}]`); f.value = window.before;"
                    "f.dispatchEvent(new Event('input'))", name)
        require("relation" in pair_now(browser)["answer"], f"a.{name} is not taken back")
    browser.run("tangency.state.pair.b.x = 1e308; tangency.state.pair.b.y = 1e308; changed()")
    require("relation" in pair_now(browser)["answer"], "a body that is far away has no answer")
    browser.run("const s = document.getElementById('start'); s.value = 'An exact touch'; s.dispatchEvent(new Event('change'))")
    require(pair_now(browser)["answer"]["relation"] == "external_touch", "An exact touch is none")
    browser.run("const s = document.getElementById('start'); s.value = 'The next double after a touch'; s.dispatchEvent(new Event('change'))")
    answer = pair_now(browser)["answer"]
    require(answer["relation"] == "separate" and answer["gaps"]["common-normal"]["gap"] > 0, "the next double is not apart")


def looks(browser, page, pictures):
    for width, height in ((1200, 900), (400, 800)):
        browser.size(width, height, touch=width < 600)
        browser.open(page)
        browser.run("await tangency.ready; document.getElementById('with-spheres').click()")
        pair_now(browser)
        wide = browser.run("return document.documentElement.scrollWidth")
        require(wide <= width, f"at {width} pixels the page is {wide} wide")
        require(browser.cut_by(".wide") == 0, f"at {width} pixels the table of gaps is cut")
        browser.picture(pictures / f"playground-{width}.png")
    browser.drag("canvas", browser.run("const b = tangency.state.pair.a; return drawing.projection.place([b.x, b.y, b.z]).slice(0, 2)"),
                 (-30, 20), kind="touch")
    require(browser.run("return tangency.state.pair.a.x") != 0, "a finger does not move A")


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: playground_check.py PAGE TANGENCY PICTURES")
    page, tangency, pictures = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    with Browser() as browser:
        browser.open(page)
        compare(browser, tangency)
        state = hands(browser, page)
        links(browser, page, state)
        fields(browser)
        looks(browser, page, pictures)
        complaints = browser.complaints()
        require(not complaints, "the console says: " + "; ".join(complaints))
    print(f"hands, links, fields, 1200 and 400 pixels: as they should be; pictures in {pictures}")


main()
