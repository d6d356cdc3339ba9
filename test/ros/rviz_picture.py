#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""rviz_picture.py DEVEL_SPACE: the real rviz, off-screen, shows the lines where the walls are."""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy
from PIL import Image

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

LINE_COLOUR = (13, 64, 191)  # of lineMarkers(), in 8 bits


def walls(truth_csv):
    return numpy.loadtxt(truth_csv, delimiter=",", skiprows=1, usecols=(0, 1, 2, 3))


class RvizPicture(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="cca_rviz_")
        self.addCleanup(self.folder.cleanup)

    def test_lines_are_drawn_where_the_walls_are_and_nowhere_else(self):
        out = os.path.join(self.folder.name, "rviz.png")
        done = subprocess.run([os.path.join(SOURCE, "launch_scripts", "inspect.sh"), "two_rooms", out],
                              capture_output=True, text=True, timeout=270)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        width, height, scale, x, y = map(float, done.stdout.split(":")[-1].split())
        picture = numpy.asarray(Image.open(out).convert("RGB")).astype(int)
        self.assertEqual(picture.shape[:2], (height, width))
        is_line = (numpy.abs(picture - LINE_COLOUR) < 30).all(axis=2)

        segments = walls(os.path.join(SOURCE, "maps", "two_rooms.truth.csv"))
        segments = segments[numpy.hypot(*(segments[:, 2:] - segments[:, :2]).T) > 1.0]
        points = numpy.vstack([s[:2] + t * (s[2:] - s[:2]) for s in segments
                               for t in numpy.linspace(0.03, 0.97, 60)])
        columns = (width / 2 + (points[:, 0] - x) * scale).astype(int)
        rows = (height / 2 - (points[:, 1] - y) * scale).astype(int)
        near = [is_line[r - 4:r + 5, c - 4:c + 5].any() for r, c in zip(rows, columns)]
        self.assertGreater(numpy.mean(near), 0.8)  # what was seen of the walls

        allowed = numpy.zeros_like(is_line)
        for r, c in zip(rows, columns):  # the samples lie closer together than this
            allowed[max(0, r - 20):r + 21, max(0, c - 20):c + 21] = True
        self.assertLess((is_line & ~allowed).sum(), 20)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
