#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo's pictures are made of the frames that tangency-dem writes.

Usage: frame_text_test.py DEMO TANGENCY_DEM SCENE, DEMO being bench/demo.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

DEMO, TOOL, SCENE = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]


class FrameText(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)
        subprocess.run([TOOL, "run", SCENE, "--out", self.out / "run", "--quiet"], check=True)
        self.frame = self.out / "run" / re.findall(r'file="([^"]*)"', (self.out / "run/frames.pvd").read_text())[-1]
        self.text = subprocess.run([DEMO / "frame_text.py", self.frame], check=True, text=True,
                                   stdout=subprocess.PIPE).stdout

    def array(self, name):
        found = re.search(rf'<DataArray Name="{name}">\n(.*?)</DataArray>', self.text, re.S)
        return [[float(word) for word in line.split()] for line in found[1].splitlines()]

    def test_has_the_places_and_semi_axes_of_the_frame_beside_it(self):
        lines = (self.out / "run/frames.xyz").read_text().splitlines()
        bodies = int(lines[0])
        rows = [line.split() for line in lines[-bodies:]]
        columns = re.search(r"Properties=(\S+)", lines[-bodies - 1])[1].split(":")
        start, at = {}, 0
        for name, width in zip(columns[::3], columns[2::3]):
            start[name] = at
            at += int(width)
        for name, array in (("pos", "points"), ("aspherical_shape", "semi_axes")):
            expected = [[float(word) for word in row[start[name]:start[name] + 3]] for row in rows]
            self.assertEqual(self.array(array), expected)
        self.assertEqual(len(self.array("cell")[0]), 9)

    def test_makes_a_scene_of_as_many_bodies(self):
        file = self.out / "frame.txt"
        file.write_text(self.text)
        subprocess.run(["awk", "-v", "names=1", "-f", DEMO / "particles.awk", file], check=True, cwd=self.out,
                       stdout=subprocess.DEVNULL)
        scene = (self.out / "particles-1.inc").read_text()
        self.assertEqual(scene.count("sphere {"), len(self.array("points")))
        number = r"-?[0-9.]+(?:e[+-]?[0-9]+)?"
        for matrix in re.findall(r"matrix <([^>]*)>", scene):
            self.assertEqual(len(re.findall(rf"^{number}$", matrix.replace(",", "\n"), re.M)), 12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
