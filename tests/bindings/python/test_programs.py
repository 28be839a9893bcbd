# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that are read and started, and functions that are graded."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import tangency
from tangency import dem, grade

SCENE = """schema = 1
[cell]
[particles.candy]
count = 20
mean_radius = 1.0
flatness = 1.9
density = 1.0
[contact]
normal_stiffness = 1e5
[[stage]]
kind = "place"
arrangement = "random"
seed = 7
bounding_fraction = 0.1
[[stage]]
kind = "compress"
mean_stress = 50.0
max_strain_rate = 5.0
max_cycles = 60000
[output]
history_interval = 500
frame_interval = 2000
"""


class Runs(unittest.TestCase):
    def test_a_run_is_started_and_its_files_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "scene.toml"
            scene.write_text(SCENE)
            run = dem.run(scene, Path(folder) / "out")
            self.assertEqual(set(run.history["stage"]), {"place", "compress"})
            self.assertEqual(run.history["cycle"][-1], run.summary["cycle"])
            contacts, particles = dem.contacts(run.final_state), dem.particles(run.final_state)
            self.assertEqual(len(contacts), run.summary["contacts"])
            frames = list(run.frames())
            self.assertGreater(len(frames), 1)
            self.assertEqual(frames[-1].columns["pos"].shape, (20, 3))
            self.assertEqual(float(frames[0].properties["Time"]), 0)

            # The simulator's contacts are those that the kernel finds among its particles.
            found = tangency.neighbours(particles, edges=frames[-1].cell)
            np.testing.assert_array_equal(found.pairs[found.gap < 0],
                                          np.stack([contacts["a"], contacts["b"]], 1).astype(int))
            np.testing.assert_allclose(found.gap[found.gap < 0], contacts["gap"], atol=1e-12)

            scene.write_text(SCENE.replace("flatness", "flatnes"))
            with self.assertRaisesRegex(dem.ProgramError, r"scene.toml:6.*flatnes"):
                dem.run(scene, Path(folder) / "other")

    def test_a_table_is_refused_by_its_row(self):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "table.csv"
            table.write_text("# remark\na, name\n1,x\n2\n")
            with self.assertRaisesRegex(ValueError, r"table.csv: row 1: 1 cells: must be 2"):
                dem.read_table(table)
            table.write_text('a,name\n1,x\n,"y, z"\n')
            read = dem.read_table(table)
            self.assertEqual(list(read["name"]), ["x", "y, z"])
            self.assertTrue(np.isnan(read["a"][1]))


class Grades(unittest.TestCase):
    def test_a_right_function_passes_and_a_wrong_one_fails(self):
        def right(a, b):
            found = tangency.contacts(a, b)
            return {"relation": tangency.relations(a, b).relation, "gap": found.gap, "gap_error": found.gap_error,
                    "normal": found.normal, "status": found.status}

        def wrong(a, b):
            return {"relation": np.full(len(a), tangency.Relation.separate)}

        for each in grade.grade(right, ["touching", "nested"], max_gap_error=1e-15):
            self.assertTrue(each.passed, each.table)
            self.assertGreater(len(each.values), 10)
        (failed,) = grade.grade(wrong, ["touching"])
        self.assertFalse(failed.passed)
        self.assertRegex(failed.verdict, "FAILED")

    def test_columns_of_another_length_and_unknown_corpora_are_refused(self):
        with self.assertRaisesRegex(ValueError, "gap: 1 rows: must be"):
            grade.grade(lambda a, b: {"gap": [1.0]}, ["touching"])
        with self.assertRaisesRegex(grade.ProgramError, "nope"):
            grade.grade(lambda a, b: {}, ["nope"])
        with self.assertRaisesRegex(ValueError, "quadrics"):
            grade.grade(lambda a, b: {}, ["quadrics"])


if __name__ == "__main__":
    unittest.main()
