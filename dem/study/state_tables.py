# SPDX-License-Identifier: MIT
"""Tables of the states A to D of one test, made by tangency-dem, each once.

They lie in OUT/pictures: state-X.json and state-X.csv (micro), rings-X.json, contacts-X.csv and
particles-X.csv.
"""

import json
import os
import subprocess

import series
from results import shear_of

# The test: 4d, MPa.
PRESSURE = 30
POINTS = {"A": "before shear", "B": "start of yielding", "C": "peak friction",
          "D": "constant volume"}


class Failed(Exception):
    """A table that tangency-dem did not make."""


class States:
    """Tables of the states, each made once."""

    def __init__(self, results, tool, folder, quick):
        self.results, self.tool, self.folder = results, tool, folder
        self.points = [p for p in POINTS if not quick or p in "AC"]
        self.kept = {}

    def state(self, point):
        folders = self.results.folders(shear_of(PRESSURE))
        file = folders and os.path.join(folders[0], "states", f"shear-{point}.state")
        if not file or not os.path.exists(file):
            raise Failed(f"state {point} of {shear_of(PRESSURE)}")
        return file

    def call(self, *words):
        try:
            run = subprocess.run([self.tool, *words], capture_output=True, text=True, check=False)
        except OSError as error:
            raise Failed(f"{self.tool}: {error.strerror}") from None
        if run.returncode != 0:
            said = run.stderr.strip().splitlines()
            raise Failed(f"tangency-dem {words[0]}: {said[-1] if said else 'no message'}")

    def once(self, name, make):
        """What make() returned; where it failed, the same failure again."""
        if name not in self.kept:
            try:
                self.kept[name] = make()
            except Failed as failure:
                self.kept[name] = failure
        if isinstance(self.kept[name], Failed):
            raise self.kept[name]
        return self.kept[name]

    def file(self, name):
        return os.path.join(self.folder, name)

    def averages(self, point):
        """(JSON, columns of the histogram)"""
        def make():
            averages, classes = self.file(f"state-{point}.json"), self.file(f"state-{point}.csv")
            self.call("micro", self.state(point), "--json", averages, "--histogram", classes)
            with open(averages, encoding="utf-8") as text:
                return json.load(text), series.Columns.of(classes)

        return self.once("averages" + point, make)

    def rings(self, point):
        """Rows of f_r over the angle to the load; none where they cannot be made."""
        def make():
            file = self.file(f"rings-{point}.json")
            self.call("micro", self.state(point), "--partition", "polar", "--json", file)
            with open(file, encoding="utf-8") as text:
                return json.load(text).get("radial_rings") or []

        try:
            return self.once("rings" + point, make)
        except Failed as failure:
            self.results.lack(str(failure))
            return []

    def table(self, command, point):
        """Columns of `tangency-dem contacts` or `particles`."""
        def make():
            file = self.file(f"{command}-{point}.csv")
            self.call(command, self.state(point), "--out", file)
            return series.Columns.of(file)

        return self.once(command + point, make)
