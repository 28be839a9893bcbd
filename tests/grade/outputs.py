#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: outputs.py TANGENCY_VERIFY TANGENCY SPHERE_TOOL

Grades tools that pass, fail, die and say what no format can hold, and holds every output to its schema, to the exit
status and to the others.
"""
import html.parser
import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import jsonschema

SCHEMAS = Path(__file__).parent / "schemas"
VERIFY, TANGENCY, SPHERES = sys.argv[1:4]
FORMS = {"json": "json", "json-summary": "summary.json", "junit": "xml", "sarif": "sarif", "summary-md": "md",
         "html": "html"}
TOOLS = {
    "right": (f"{TANGENCY} contact", [], 0),
    "wrong": (f"{SPHERES} 1.01", [], 1),
    "allowed": (f"{SPHERES} 1.01", ["--max-wrong", "810"], 0),
    "large errors": (f"{SPHERES}", ["--max-gap-error", "1e-9", "--max-normal-error", "1e-3"], 1),
    "silent": ("printf '\\001<&\"]]>\\377 %s\\n' '|`*_' >&2; exit 3", [], 1),
    "torn": (f"{TANGENCY} contact | head -n 30", [], 1),
    "no numbers": ("printf 'row,gap\\n0,1e308\\n1,nan\\n'", [], 1),
}
#: Elements of HTML without an end.
VOID = {"meta", "br", "hr", "img", "input", "link"}


class Page(html.parser.HTMLParser):
    """Elements are closed in the order that they were opened in; nothing is loaded from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.open, self.faults = [], []

    def handle_starttag(self, tag: str, attributes: list) -> None:
        if tag not in VOID:
            self.open.append(tag)
        self.faults += [f"{tag} {name}" for name, _ in attributes if name in ("src", "href", "onload")]

    def handle_startendtag(self, tag: str, attributes: list) -> None:
        pass

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}>")


class Outputs(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def graded(self, name: str) -> dict[str, str]:
        command, options, status = TOOLS[name]
        paths = {form: self.folder / f"grade.{suffix}" for form, suffix in FORMS.items()}
        arguments = [VERIFY, "grade", "--tool", command, "--corpus", "classes", "near", *options]
        for form, path in paths.items():
            arguments += [f"--{form}", str(path)]
        done = subprocess.run(arguments, capture_output=True, text=True, errors="replace", check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        texts = {form: path.read_text("utf-8") for form, path in paths.items()}
        texts["verdict"] = done.stdout.splitlines()[-1]
        return texts

    def test_junit_is_valid_and_fails_with_the_grade(self) -> None:
        for name, (_, _, status) in TOOLS.items():
            with self.subTest(name):
                text = self.graded(name)["junit"]
                done = subprocess.run(["xmllint", "--noout", "--nonet", "--schema", str(SCHEMAS / "junit.xsd"), "-"],
                                      input=text, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                suites = xml.fromstring(text).findall("testsuite")
                self.assertEqual([suite.get("name") for suite in suites], ["grade", "classes", "near"])
                self.assertEqual([int(suite.get("tests")) for suite in suites], [1, 3, 15])
                for suite in suites:
                    self.assertEqual(len(suite.findall("testcase")), int(suite.get("tests")))
                    self.assertEqual(len(suite.findall("testcase/failure")), int(suite.get("failures")))
                self.assertEqual(any(int(suite.get("failures")) for suite in suites), status == 1)

    def test_sarif_is_valid_and_points_to_the_lines_of_the_corpus(self) -> None:
        schema = json.loads((SCHEMAS / "sarif.json").read_text())
        for name, (_, _, status) in TOOLS.items():
            with self.subTest(name):
                log = json.loads(self.graded(name)["sarif"])
                jsonschema.validate(log, schema)
                run = log["runs"][0]
                rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
                levels = set()
                for result in run["results"]:
                    self.assertEqual(rules[result["ruleIndex"]], result["ruleId"])
                    levels.add(result["level"])
                    for location in result.get("locations", []):
                        corpus, row = re.match(r"(\w+) row (\d+) ", result["message"]["text"]).groups()
                        place = location["physicalLocation"]
                        self.assertEqual(place["artifactLocation"]["uri"], f"{corpus}.csv")
                        self.assertEqual(place["region"]["startLine"], int(row) + 5)
                self.assertEqual("error" in levels, status == 1)
                self.assertEqual(run["invocations"][0]["exitCode"], status)

    def test_both_json_are_arrays_of_finite_values(self) -> None:
        for name in TOOLS:
            with self.subTest(name):
                texts = self.graded(name)
                for form in ("json", "json-summary"):
                    values = json.loads(texts[form], parse_constant=self.fail)
                    names = [value["name"] for value in values]
                    self.assertEqual(len(set(names)), len(names))
                    for value in values:
                        self.assertEqual(list(value), ["name", "unit", "value"])
                        self.assertTrue(math.isfinite(value["value"]) and value["value"] >= 0, value)
                    self.assertLessEqual(len(values), 40 if form == "json-summary" else 1000)

    def test_the_page_is_closed_and_loads_nothing(self) -> None:
        for name in TOOLS:
            with self.subTest(name):
                texts = self.graded(name)
                page = Page()
                page.feed(texts["html"])
                self.assertEqual((page.open, page.faults), ([], []))
                self.assertIn(texts["verdict"], texts["html"])
                for word in ("largest gap error allowed", "tangency-verify", "date", "width=device-width"):
                    self.assertIn(word, texts["html"])

    def test_rows_of_markdown_have_the_cells_of_their_head(self) -> None:
        for name in TOOLS:
            with self.subTest(name):
                cells = 0
                for line in self.graded(name)["summary-md"].splitlines():
                    if not line.startswith("|"):
                        cells = 0
                        continue
                    count = len(re.findall(r"(?<!\\)\|", line))
                    self.assertEqual(count, cells or count, line)
                    cells = count


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
