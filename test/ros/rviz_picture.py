#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""rviz_picture.py DEVEL_SPACE: the real rviz, off-screen, shows every line of the map, and lines only where
walls are."""
import os
import subprocess
import sys
import tempfile
import unittest

import numpy
from PIL import Image

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

LINE_COLOUR = (13, 64, 191)  # of lineMarkers(), in 8 bits


def segments(csv):
    return numpy.loadtxt(csv, delimiter=",", skiprows=1, usecols=(0, 1, 2, 3))


class RvizPicture(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="cca_rviz_")
        self.addCleanup(self.folder.cleanup)

    def test_the_map_is_drawn_whole_and_nowhere_but_on_walls(self):
        out, saved = (os.path.join(self.folder.name, name) for name in ("rviz.png", "map"))
        done = subprocess.run([os.path.join(SOURCE, "launch_scripts", "inspect.sh"), "two_rooms", out,
                               "_out:=" + saved], capture_output=True, text=True, timeout=270)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        width, height, scale, x, y = map(float, done.stdout.split(":")[-1].split())
        picture = numpy.asarray(Image.open(out).convert("RGB")).astype(int)
        self.assertEqual(picture.shape[:2], (height, width))
        is_line = (numpy.abs(picture - LINE_COLOUR) < 30).all(axis=2)

        def pixels(lines):
            points = numpy.vstack([s[:2] + t * (s[2:] - s[:2]) for s in lines
                                   for t in numpy.linspace(0.03, 0.97, 60)])
            return zip((height / 2 - (points[:, 1] - y) * scale).astype(int),
                       (width / 2 + (points[:, 0] - x) * scale).astype(int))

        mapped = segments(os.path.join(saved, "lines.csv"))
        self.assertGreater(numpy.hypot(*(mapped[:, 2:] - mapped[:, :2]).T).sum(), 25.0)  # of 39.6 m
        near = [is_line[r - 4:r + 5, c - 4:c + 5].any() for r, c in pixels(mapped)]
        self.assertGreater(numpy.mean(near), 0.97)

        allowed = numpy.zeros_like(is_line)
        for r, c in pixels(segments(os.path.join(SOURCE, "maps", "two_rooms.truth.csv"))):
            allowed[max(0, r - 20):r + 21, max(0, c - 20):c + 21] = True  # samples lie closer than this
        self.assertLess((is_line & ~allowed).sum(), 20)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
