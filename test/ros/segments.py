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
    """Ranges to the nearest segment along each bearing (map frame), inf for a miss. x, y: one place for all beams, or
    one each."""
    c, s = numpy.cos(bearings)[:, None], numpy.sin(bearings)[:, None]
    ax = segments[:, 0] - numpy.reshape(x, (-1, 1))
    ay = segments[:, 1] - numpy.reshape(y, (-1, 1))
    dx, dy = (segments[:, 2:] - segments[:, :2]).T
    across = c * dy - s * dx
    with numpy.errstate(divide="ignore", invalid="ignore"):
        along = (ax * dy - ay * dx) / across
        where = (ax * s - ay * c) / across
    return numpy.where((along > 0) & (where >= 0) & (where <= 1), along, math.inf).min(axis=1)


def distance_to(segments, points):
    """m, from each of n points to the nearest segment."""
    best = numpy.full(len(points), math.inf)
    for x1, y1, x2, y2 in segments:
        start, d = numpy.array([x1, y1]), numpy.array([x2 - x1, y2 - y1])
        t = numpy.clip(((points - start) @ d) / (d @ d), 0.0, 1.0)
        best = numpy.minimum(best, numpy.linalg.norm(points - start - t[:, None] * d, axis=1))
    return best


def in_view(walls, places):
    """Of points on the walls longer than a metre, those that were in view within 6 m, and not at a grazing angle, from
    one of the places (m, n x 2): there a map has lines."""
    seen = []
    for x1, y1, x2, y2 in walls[numpy.hypot(*(walls[:, 2:] - walls[:, :2]).T) > 1.0]:
        start, d = numpy.array([x1, y1]), numpy.array([x2 - x1, y2 - y1])
        along = d / numpy.linalg.norm(d)
        points = start + numpy.linspace(0.02, 0.98, 25)[:, None] * d
        is_seen = numpy.zeros(len(points), bool)
        for x, y in places:
            offset = points - (x, y)
            distance = numpy.linalg.norm(offset, axis=1)
            ranges = cast(walls, x, y, numpy.arctan2(offset[:, 1], offset[:, 0]))
            steepness = numpy.abs(along[0] * offset[:, 1] - along[1] * offset[:, 0]) / distance
            is_seen |= (numpy.abs(ranges - distance) < 0.01) & (distance < 6.0) & (steepness > 0.3)
        seen.append(points[is_seen])
    return numpy.vstack(seen)
