#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""benchmarks/scripts/tuning_report.py, on tables whose analysis is known, and after `cca-mrpt-bench tune` as tune.sh runs it.

tuning_report_test.py BENCH_PROGRAM MAPS_FOLDER
"""
import itertools
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import pandas

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(HERE, "..", "scripts")
sys.path.insert(0, SCRIPTS)
import tuning_report  # noqa: E402

PROGRAM, MAPS = sys.argv[1:3]


def batteries():
    """Hours by material and temperature, four each [Montgomery, Design and Analysis of Experiments, Table 5.1]."""
    hours = [[[130, 155, 74, 180], [34, 40, 80, 75], [20, 70, 82, 58]],
             [[150, 188, 159, 126], [136, 122, 106, 115], [25, 70, 58, 45]],
             [[138, 110, 168, 160], [174, 120, 150, 139], [96, 104, 82, 60]]]
    return pandas.DataFrame([(material, temperature, life) for material in range(3) for temperature in range(3)
                             for life in hours[material][temperature]], columns=["material", "temperature", "hours"])


def known_runs():
    """Eight scenes, each at its own level; 0.5 is the best cut and 16 the better price, the straightness is nothing.
    The ripple is too small to matter."""
    combinations = itertools.product(range(8), (0.25, 0.5, 0.75), (8.0, 16.0), (0.01, 0.04))
    runs = pandas.DataFrame(combinations, columns=["scene"] + tuning_report.PARAMETERS)
    runs["both"] = (0.8 - (runs.similarity_cut - 0.5) ** 2 + 0.02 * (runs.vertex_price == 16.0) + 0.01 * runs.scene +
                    1e-3 * np.sin(12.9898 * np.arange(len(runs))))
    return runs


class AnalysisOfVariance(unittest.TestCase):
    EFFECTS = [("material",), ("temperature",), ("material", "temperature")]

    def test_reproduces_the_textbook(self):
        """Montgomery's Table 5.5."""
        table = tuning_report.analyse_variance(batteries(), "hours", self.EFFECTS)
        self.assertEqual(list(table.index), ["material", "temperature", "material x temperature", "residual"])
        self.assertEqual(list(table.df), [2, 2, 4, 27])
        np.testing.assert_allclose(table.sum_sq, [10683.72, 39118.72, 9613.78, 18230.75], atol=0.01)
        np.testing.assert_allclose(table.F[:3], [7.91, 28.97, 3.56], atol=0.005)
        np.testing.assert_allclose(table.p[:3], [0.0020, 0.0000, 0.0186], atol=5e-5)
        np.testing.assert_allclose(table.eta_sq[:3], [10683.72 / 28914.47, 39118.72 / 57349.47, 9613.78 / 27844.53],
                                   atol=1e-5)

    def test_sums_of_a_balanced_design_add_up(self):
        runs = batteries()
        table = tuning_report.analyse_variance(runs, "hours", self.EFFECTS)
        self.assertAlmostEqual(table.sum_sq.sum(), ((runs.hours - runs.hours.mean()) ** 2).sum(), places=6)

    def test_finds_the_effects_that_are_there_and_no_others(self):
        table = tuning_report.analyse_variance(known_runs(), "both", tuning_report.EFFECTS)
        self.assertEqual(table.df["scene"], 7)
        there = ["similarity_cut", "vertex_price", "scene"]
        self.assertLess(table.p[there].max(), 1e-6)
        self.assertGreater(table.p.drop(there).min(), 0.01)


class Recommendation(unittest.TestCase):
    def test_is_the_known_best_and_tells_how_far_the_shipped_is(self):
        found = tuning_report.recommend(known_runs(), "both", (0.75, 8.0, 0.01))
        self.assertEqual(found.best[:2], (0.5, 16.0))
        np.testing.assert_array_equal(found.intervals[:2], [(0.5, 0.5), (16.0, 16.0)])
        self.assertAlmostEqual(found.shortfall[0], 0.0625 + 0.02, delta=2e-3)
        self.assertAlmostEqual(found.value - found.shipped, found.shortfall[0])
        self.assertGreater(found.shortfall[1], 0.0)
        self.assertIn(": worse.", tuning_report.recommendation_lines(found)[1])

    def test_says_where_the_shipped_one_was_not_run(self):
        lines = tuning_report.recommendation_lines(tuning_report.recommend(known_runs(), "both", (0.5, 12.0, 0.035)))
        self.assertEqual(lines[1], "The shipped combination is not one of the design's.")

    def test_best_and_shipped_are_alike_where_they_are_one(self):
        runs = known_runs()
        best = tuning_report.recommend(runs, "both", (0.5, 12.0, 0.035)).best
        self.assertEqual(tuning_report.recommend(runs, "both", best).shortfall, (0.0, 0.0, 0.0))


class Report(unittest.TestCase):
    """Of eight combinations in two scenes, run by the program."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        worlds = [os.path.join(MAPS, world) for world in ("two_rooms.yaml", "maze.yaml")]
        subprocess.run([PROGRAM, "tune", *worlds, "--out", cls.folder.name, "--similarity-cut", "0.35,0.5",
                        "--vertex-price", "12,20", "--straightness", "0.02,0.035", "--noise", "0.01", "--seeds", "1",
                        "--scans", "2", "--poses", "8"], check=True, capture_output=True)
        with open(os.path.join(cls.folder.name, "runs.csv")) as file:
            cls.lines = file.readlines()

    def run_report(self, *arguments):
        return subprocess.run([sys.executable, os.path.join(SCRIPTS, "tuning_report.py"), *arguments],
                              capture_output=True, text=True)

    def test_stands_in_the_document_and_on_the_terminal_the_same_twice(self):
        page, images = os.path.join(self.folder.name, "page.md"), os.path.join(self.folder.name, "images")
        with open(page, "w") as file:
            file.write("before\n<!-- begin tables -->\nold\n<!-- end tables -->\nafter\n")
        said = self.run_report(self.folder.name, page, images)
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        with open(page) as file:
            self.assertEqual(file.read(),
                             "before\n<!-- begin tables -->\n%s<!-- end tables -->\nafter\n" % said.stdout)
        self.assertTrue(said.stdout.startswith("16 of 16 runs, 2 scenes.\n\n### F1 of single scans\n"))
        self.assertEqual(said.stdout.count("| residual | 8 |"), 3)
        self.assertEqual(said.stdout.count("\nShipped: "), 3)
        for name in "surfaces", "main_effects":
            with open(os.path.join(images, "tuning_%s.png" % name), "rb") as file:
                self.assertEqual(file.read(4), b"\x89PNG")
        self.assertEqual(self.run_report(self.folder.name).stdout, said.stdout)

    def test_weighs_the_programs_runs(self):
        experiment = tuning_report.read(os.path.join(self.folder.name, "runs.csv"))
        self.assertEqual(experiment.shipped, (0.5, 12.0, 0.035))
        self.assertEqual(experiment.runs.groupby("scene").size().tolist(), [8, 8])
        fields = self.lines[3].split(",")
        first = experiment.runs.iloc[0]
        self.assertEqual((first["scan"], first["map"]), (float(fields[7]), float(fields[8])))
        self.assertEqual(first.both, (first["scan"] + first["map"]) / 2)

    def test_leaves_out_scenes_that_are_not_complete(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "runs.csv"), "w") as file:
                file.writelines(self.lines[:-1])
            said = self.run_report(folder)
        self.assertEqual((said.returncode, said.stdout), (1, ""))
        self.assertIn("fewer than two scenes are complete", said.stderr)

    def test_says_what_writes_the_table_where_there_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            said = self.run_report(folder)
        self.assertEqual((said.returncode, said.stdout), (1, ""))
        self.assertIn("--merge", said.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
