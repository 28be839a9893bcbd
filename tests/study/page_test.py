#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study's page, of made-up results: all is there, stands alone, and says what is missing.

Usage: page_test.py DEM_STUDY TANGENCY_DEM
Needs gnuplot and POV-Ray. tangency-dem is not called: made_up.py stands in for it.
"""
import base64
import csv
import html.parser
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.dont_write_bytecode = True
STUDY = os.path.abspath(sys.argv[1])
sys.path[:0] = [STUDY, os.path.dirname(os.path.abspath(__file__))]

import made_up  # noqa: E402
import page  # noqa: E402
import programme  # noqa: E402
import uses  # noqa: E402
import verdicts  # noqa: E402

SVG = "{http://www.w3.org/2000/svg}"
VOID = {"meta", "img", "br", "hr", "link", "input"}

# Elements that may load something, and the attributes by which they would.
LOADING = {"src", "href", "srcset", "data", "poster", "action"}


class Reader(html.parser.HTMLParser):
    """What the page has, and whether each element is closed in its turn."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.faults, self.images, self.references = [], [], [], []
        self.ids, self.figures, self.text = [], [], ""
        self.feed(text)
        self.close()
        self.faults += [f"<{tag}> stays open" for tag in self.open]

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag not in VOID:
            self.open.append(tag)
        if "id" in attrs:
            self.ids.append(attrs["id"])
        self.references += [value for name, value in attrs.items() if name in LOADING]
        if tag == "img":
            self.images.append(attrs)
        if tag == "figure":
            self.figures.append({"images": 0, "text": ""})
        if tag == "img" and self.figures and "figure" in self.open:
            self.figures[-1]["images"] += 1

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")

    def handle_data(self, data):
        self.text += data
        if self.figures and "figcaption" in self.open:
            self.figures[-1]["text"] += data


def read(out):
    with open(os.path.join(out, "index.html"), encoding="utf-8") as file:
        return file.read()


def data_of(image):
    """(kind, bytes) of a picture that is in the page."""
    kind, data = re.fullmatch(r"data:image/(svg\+xml|png);base64,(.*)", image["src"]).groups()
    return kind, base64.b64decode(data)


def write_rows(out, rows):
    with open(os.path.join(out, "rows.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, verdicts.COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def write_uses(out, rows):
    with open(os.path.join(out, "runs.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, uses.COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


class Made(unittest.TestCase):
    """A directory for results, and the program that stands in for tangency-dem."""

    @classmethod
    def setUpClass(cls):
        cls.out = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.out)
        cls.tool = os.path.join(cls.out, "tool")
        made_up.write_tool(cls.tool, STUDY)


class WholePage(Made):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, run in programme.Programme(programme.REDUCED).runs.items():
            pressure = re.search(r"-p(\d+)", name)
            shear = run.stages[-1]["kind"] == "shear"
            made_up.write_run(cls.out, name.rpartition("-s")[0], run.seed,
                              stage="shear" if shear else "grow",
                              pressure=int(pressure[1]) if pressure else 50,
                              states="ABCD" if shear else "")
        made_up.write_run(cls.out, "spheroid-p050-shear", 2)  # a second seed: a band
        write_rows(cls.out, [
            {"id": "3.3-a", "section": "5.4.1", "statement": "angles < 44 & more",
             "published": "39",
             "bar": "a bar", "ours": "1.3e+10, -2", "scatter": "0.1", "seeds": "3",
             "verdict": verdicts.REPRODUCED, "note": "a note"},
            {"id": "3.3-b", "section": "5.4.2", "statement": "volume", "seeds": "0",
             "verdict": verdicts.NOT_RUN, "note": "needs the run x"}])
        write_uses(cls.out, [{"run": "spheroid-p050-shear-s1", "seed": "1", "status": "complete"}])
        page.write_page(cls.out, cls.tool, jobs=2, quick=True)
        cls.text = read(cls.out)
        cls.page = Reader(cls.text)

    def test_every_element_is_closed_in_its_turn(self):
        self.assertEqual(self.page.faults, [])

    def test_every_chapter_is_there(self):
        for key in ("samples", "rows", "growth", "release", "shear", "compared", "contacts",
                    "states",
                    "anisotropies", "strength", "local"):
            self.assertIn(key, self.page.ids)
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))

    def test_links_lead_to_what_is_there(self):
        links = [reference for reference in self.page.references if reference.startswith("#")]
        self.assertGreaterEqual(len(links), 9)
        for link in links:
            self.assertIn(link[1:], self.page.ids)

    def test_nothing_is_loaded_from_elsewhere(self):
        for reference in self.page.references:
            self.assertRegex(reference, r"^(#|data:image/)")
        bare = re.sub(r'src="data:[^"]*"', "", self.text)
        self.assertNotRegex(bare, r"https?://|//[a-z]|url\(|@import|<script|<link|<iframe")
        for image in self.page.images:
            kind, data = data_of(image)
            if kind == "svg+xml":
                found = set(re.findall(r"https?://[^\s\"'<>]*", data.decode()))
                self.assertLessEqual(found, {"http://www.w3.org/2000/svg",
                                             "http://www.w3.org/1999/xlink"})
                self.assertNotRegex(data.decode(), r"url\((?!#)|<image|<script")

    def test_every_figure_is_drawn_and_has_a_caption(self):
        self.assertGreater(len(self.page.figures), 60)
        for figure in self.page.figures:
            self.assertGreater(figure["images"], 0, figure["text"])
            self.assertGreater(len(figure["text"].strip()), 30)
        self.assertNotIn("Not drawn", self.page.text)
        self.assertNotIn("Missing:", self.page.text)

    def test_every_picture_says_in_words_what_it_shows(self):
        for image in self.page.images:
            self.assertGreater(len(image["alt"]), 40)
            self.assertNotRegex(image["alt"], r"nan|[_^{}]")

    def test_every_chart_has_title_axes_and_curves(self):
        charts = [data for kind, data in map(data_of, self.page.images) if kind == "svg+xml"]
        self.assertGreater(len(charts), 60)
        for data in charts:
            root = xml.etree.ElementTree.fromstring(data)
            words = ["".join(text.itertext()).strip() for text in root.iter(SVG + "text")]
            self.assertGreaterEqual(sum(not re.fullmatch(r"[−\d.]*", word) for word in words), 3,
                                    words)
            # gnuplot gives each curve a group of its own.
            self.assertIsNotNone(root.find(f".//{SVG}g[@id='gnuplot_plot_1']"))

    def test_every_rendered_picture_shows_something(self):
        pictures = [data for kind, data in map(data_of, self.page.images) if kind == "png"]
        self.assertGreaterEqual(len(pictures), 30)
        for data in pictures:
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertGreater(len(data), 2500)  # white alone has some hundred bytes

    def test_data_of_every_chart_lie_beside_it(self):
        folder = os.path.join(self.out, "pictures")
        charts = [name for name in os.listdir(folder) if name.endswith(".svg")]
        for name in charts:
            with open(os.path.join(folder, name[:-3] + "csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertGreater(len(rows), 0)
            self.assertEqual(list(rows[0]), ["curve", "x", "y", "low", "high"])

    def test_bands_are_over_the_seeds(self):
        with open(os.path.join(self.out, "pictures", "shear-angle.csv"), encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if float(row["x"]) > 0.1]
        two = [row for row in rows if row["curve"] == "50 MPa"]
        self.assertGreater(len(two), 20)
        for row in two:
            # Seeds are made 0.01 apart in the ratio, of which the angle is 25 times.
            self.assertAlmostEqual(float(row["high"]) - float(row["low"]), 0.25, places=9)
            self.assertAlmostEqual(float(row["y"]), 0.5 * (float(row["low"]) + float(row["high"])),
                                   9)
        self.assertTrue(all(row["low"] == "" for row in rows if row["curve"] == "10 MPa"))

    def test_rows_show_their_verdicts_by_colour_and_word(self):
        self.assertIn('<span class="yes">reproduced</span>', self.text)
        self.assertIn('<span class="missing">not run</span>', self.text)
        self.assertIn('<li class="yes"><b>1</b> reproduced</li>', self.text)
        self.assertIn("angles &lt; 44 &amp; more", self.text)
        self.assertIn("1.3&nbsp;×&nbsp;10<sup>10</sup>, −2", self.text)
        self.assertIn("(3 seeds)", self.text)

    def test_the_page_is_small_enough_to_send(self):
        self.assertLess(len(self.text), 15e6)

    def test_what_was_only_for_drawing_is_gone(self):
        left = [name for name in os.listdir(os.path.join(self.out, "pictures"))
                if not name.endswith((".svg", ".png", ".csv", ".json"))]
        self.assertEqual(left, [])
        self.assertFalse(os.path.exists(os.path.join(self.out, "index.html.part")))


class WhatIsMissing(Made):
    def test_runs_that_are_not_there_are_named_where_they_would_be_shown(self):
        made_up.write_run(self.out, "spheroid-p010-shear", pressure=10)
        half = made_up.write_run(self.out, "spheroid-p050-shear")
        os.remove(os.path.join(half, "summary.json"))  # it was ended
        write_uses(self.out, [{"run": "spheroid-p070-shear-s1", "seed": "1", "status": "failed"},
                              {"run": "spheroid-p010-shear-s1", "seed": "1", "status": "complete"}])
        page.write_page(self.out, self.tool, quick=True)
        read_page = Reader(read(self.out))
        self.assertEqual(read_page.faults, [])
        self.assertIn("Runs that are not complete: spheroid-p070-shear-s1 "
                      "(failed).", read_page.text)
        ratio = next(f for f in read_page.figures if "one curve for all pressures" in f["text"])
        self.assertEqual(ratio["images"], 1)
        for name in ("spheroid-p030-shear", "spheroid-p070-shear", "spheroid-p050-shear-s1"):
            self.assertIn(name, ratio["text"])
        self.assertNotIn("spheroid-p010", ratio["text"])
        lines = next(f for f in read_page.figures if "joins the centres" in f["text"])
        self.assertEqual(lines["images"], 0)
        self.assertIn("Not drawn; missing: state A of spheroid-p030-shear", lines["text"])

    def test_nothing_at_all_makes_a_page(self):
        out = os.path.join(self.out, "empty")
        os.mkdir(out)
        page.write_page(out, self.tool)
        self.assertEqual(Reader(read(out)).faults, [])

    def test_a_state_that_cannot_be_read_is_named_with_the_reason(self):
        out = os.path.join(self.out, "refused")
        made_up.write_run(out, "spheroid-p030-shear", states="AC")
        with open(os.path.join(out, "tool"), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho 'tangency-dem: no state' >&2\nexit 2\n")
        os.chmod(file.name, 0o755)
        page.write_page(out, file.name, quick=True)
        figures = [figure for figure in Reader(read(out)).figures
                   if "Not drawn; missing: tangency-dem micro: tangency-dem: no state"
                   in figure["text"]]
        self.assertGreaterEqual(len(figures), 4)


class Commands(Made):
    def run_page(self, *words, path=None):
        environment = dict(os.environ, PATH=path) if path else None
        return subprocess.run([sys.executable, os.path.join(STUDY, "page.py"), *words],
                              capture_output=True, text=True, env=environment, check=False)

    def test_a_missing_program_is_one_line_and_leaves_the_last_page(self):
        made_up.write_run(self.out, "spheroid-p010-shear", pressure=10)
        with open(os.path.join(self.out, "index.html"), "w", encoding="utf-8") as file:
            file.write("the last one")
        run = self.run_page(self.out, self.tool, path=self.out)
        self.assertEqual(run.returncode, 2)
        self.assertEqual(run.stderr, "page.py: gnuplot is not installed: ./demo installs it\n")
        self.assertEqual(read(self.out), "the last one")

    def test_other_words_are_refused(self):
        self.assertEqual(self.run_page().returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
