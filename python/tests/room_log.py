# SPDX-License-Identifier: BSD-3-Clause
"""A CARMEN log of a SICK laser that drives through a room of 6 m x 4 m: room_log.py FILE.log.gz"""
import gzip
import sys

import numpy as np


def chain(*vertices):
    """The walls (n, 2, 2) between points."""
    points = np.array(vertices, dtype=float)
    return np.stack([points[:-1], points[1:]], axis=1)


def ranges_in(walls, pose, angle_min, angle_increment, beams, longest=np.inf):
    """Distances [m] to the nearest of walls (n, 2, 2) along each beam of a sensor at pose."""
    bearing = pose[2] + angle_min + angle_increment * np.arange(beams)
    ray = np.stack([np.cos(bearing), np.sin(bearing)], axis=1)[:, None, :]
    start, along = walls[None, :, 0] - np.asarray(pose[:2]), (walls[:, 1] - walls[:, 0])[None]
    across = lambda a, b: a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]  # noqa: E731
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = across(start, along) / across(ray, along)
        share = across(start, ray) / across(ray, along)
    meets = (distance > 0) & (share >= 0) & (share <= 1)
    nearest = np.where(meets, distance, np.inf).min(axis=1)
    return np.where(nearest <= longest, nearest, np.inf)


ROOM = chain((-3, -2), (3, -2), (3, 2), (-3, 2), (-3, -2))


def write(path):
    """20 scans with corrected poses, a second apart."""
    with gzip.open(path, "wt") as file:
        for time, x in enumerate(np.linspace(-1, 1, 20)):
            pose = (x, 0.3 * x, 0.1 * time)
            ranges = ranges_in(ROOM, pose, np.radians(-90), np.radians(1), 181)
            numbers = " ".join(f"{r:.3f}" for r in ranges)
            place = f"{pose[0]} {pose[1]} {pose[2]}"
            wheels = f"{pose[0] + 0.01 * time} {pose[1]} {pose[2] - 0.004 * time}"  # that drift
            file.write(f"FLASER 181 {numbers} {place} {wheels} {time} host {time}\n")


if __name__ == "__main__":
    write(sys.argv[1])
