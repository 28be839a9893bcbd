#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `tangency contact --view`, in headless Chromium: it draws, turns under a mouse and a finger, and fits a telephone.

Usage: pair_check.py TANGENCY FOLDER
Makes the pages of four pairs in FOLDER, and pictures of 1200 and 400 pixels. Ends with 1 at the first fault, or where the
console has an error. Packages: .ci/setup browser
"""
import os
import pathlib
import subprocess
import sys

from browser import Browser

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import require  # noqa: E402

# Apart; a little in each other; one in the other; and a pair for which two methods have no answer.
TABLE = """a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz
0,0,0,2,0.5,0.5,0.9,0.1,0.3,0.2,1.9,1.4,0.9,1.2,1.2,0.3,0.8,0.4,-0.3,0.1
0,0,0,1.3,1.1,1,1,0,0,0,2,0.1,0.1,1.2,1,0.9,0.9,0.2,0.1,0.1
0.1,0,0,0.3,0.2,0.2,1,0,0,0,0,0,0,2,1,1.5,1,0,0,0
0,0,0,3,2,1,1,0,0,0,0,0,0,3,2,1.5,1,0,0,0
"""
ROWS = 4
# What is on the canvas, and what an empty one of its size has.
SEEN = """const c = document.getElementById("scene"), empty = Object.assign(document.createElement("canvas"), {width: c.width, height: c.height});
return [c.toDataURL(), empty.toDataURL()];"""


def seen(browser):
    browser.run("await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));")
    return browser.run(SEEN)


def hands(browser):
    first, empty = seen(browser)
    require(first != empty, "nothing is drawn")
    middle = browser.run('const c = document.getElementById("scene"); return [c.clientWidth / 2, c.clientHeight / 2]')
    turned = first
    for kind in ("mouse", "touch"):
        browser.drag("#scene", middle, (60, 25), kind=kind)
        before, (turned, _) = turned, seen(browser)
        require(turned != before, f"a drag by {kind} turns nothing")
    browser.run('document.getElementById("scene").dispatchEvent(new WheelEvent("wheel", {deltaY: -200, cancelable: true}))')
    nearer, _ = seen(browser)
    require(nearer != turned, "the wheel comes no nearer")
    browser.click("#with-spheres")
    require(seen(browser)[0] != nearer, "spheres are not drawn")


def methods(browser):
    """Another method draws other points; one without an answer cannot be chosen."""
    options = browser.run('return [...document.querySelectorAll("#method option")].map(({value, disabled}) => [value, disabled])')
    statuses = browser.run('return Object.entries(data.gaps).map(([name, gap]) => [name, gap.gap === null])')
    require(options == statuses, f"methods to choose {options}, answered {statuses}")
    open_ones = [name for name, closed in options if not closed]
    pictures = []
    for name in open_ones:
        browser.run('const m = document.getElementById("method"); m.value = given[0]; m.dispatchEvent(new Event("change"))', name)
        pictures.append(seen(browser)[0])
    return len(set(pictures)), len(open_ones)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: pair_check.py TANGENCY FOLDER")
    tool, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "pairs.csv").write_text(TABLE, encoding="utf-8")
    answered = 0
    with Browser() as browser:
        for row in range(ROWS):
            page = folder / f"pair-{row}.html"
            subprocess.run([tool, "contact", "--view", str(row), "--out", page, "pairs.csv"], cwd=folder, check=True)
            for width, height in ((1200, 900), (400, 800)):
                browser.size(width, height, touch=width == 400)
                browser.open(page)
                seen(browser)
                browser.picture(folder / f"pair-{row}-{width}.png")
                wide = browser.run("return document.documentElement.scrollWidth")
                require(wide <= width, f"the page of row {row} is {wide} pixels wide at {width}")
                require(browser.cut_by(".wide") == 0, f"the table of gaps of row {row} is cut at {width} pixels")
            hands(browser)
            drawn, answers = methods(browser)
            answered += answers
            # Of a pair without symmetry no two definitions have the same points.
            require(row != 1 or drawn == answers == 4, f"of four definitions {answers} answer, and {drawn} are drawn")
        complaints = browser.complaints()
        require(not complaints, "the console says: " + "; ".join(complaints))
    print(f"{ROWS} pages, {answered} answers of methods: drawn, turned by mouse and finger, of 400 pixels without a wide part; pictures in {folder}")


main()
