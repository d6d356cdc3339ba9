# SPDX-License-Identifier: BSD-3-Clause
"""Line segments as rows of an n x 4 array: x1, y1, x2, y2 in metres."""
import csv
import math

import numpy


def read_segments(path):
    """Of a lines.csv, or of the true walls of a world."""
    with open(path) as file:
        return numpy.array([[float(row[k]) for k in ("x1", "y1", "x2", "y2")]
                            for row in csv.DictReader(file)])


def samples(segments):
    """Points 1 cm apart on each."""
    points = []
    for a, b in zip(segments[:, :2], segments[:, 2:]):
        n = max(2, int(math.ceil(numpy.linalg.norm(b - a) / 0.01)))
        points.append(a + (numpy.arange(n) + 0.5)[:, None] / n * (b - a))
    return numpy.vstack(points)


def cast(segments, x, y, bearings):
    """Ranges from a place to the nearest segment along each bearing (map frame); inf for a miss."""
    a = segments[:, :2] - (x, y)
    d = segments[:, 2:] - segments[:, :2]
    ranges = []
    for bearing in bearings:
        c, s = math.cos(bearing), math.sin(bearing)
        across = c * d[:, 1] - s * d[:, 0]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            along = (a[:, 0] * d[:, 1] - a[:, 1] * d[:, 0]) / across
            where = (a[:, 0] * s - a[:, 1] * c) / across
        hit = (along > 0) & (where >= 0) & (where <= 1)
        ranges.append(along[hit].min() if hit.any() else math.inf)
    return numpy.array(ranges)


def distance_to(segments, points):
    """m, from each of n points to the nearest segment."""
    best = numpy.full(len(points), math.inf)
    for x1, y1, x2, y2 in segments:
        start, d = numpy.array([x1, y1]), numpy.array([x2 - x1, y2 - y1])
        t = numpy.clip(((points - start) @ d) / (d @ d), 0.0, 1.0)
        best = numpy.minimum(best, numpy.linalg.norm(points - start - t[:, None] * d, axis=1))
    return best
