# SPDX-License-Identifier: BSD-3-Clause
"""Rooms to look into, and what a laser sees of them."""
import numpy as np
import pytest

FULL_TURN = dict(angle_min=-np.pi, angle_increment=2 * np.pi / 360)


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


def chain(*vertices):
    points = np.array(vertices, dtype=float)
    return np.stack([points[:-1], points[1:]], axis=1)


@pytest.fixture
def room():
    """6 m x 4 m around the origin."""
    return chain((-3, -2), (3, -2), (3, 2), (-3, 2), (-3, -2))


@pytest.fixture
def two_rooms():
    """10 m x 4 m with a wall across it that has a door of 1.2 m."""
    outside = chain((-3, -2), (7, -2), (7, 2), (-3, 2), (-3, -2))
    inside = np.array([[[2, -2], [2, -0.6]], [[2, 0.6], [2, 2]]], dtype=float)
    return np.concatenate([outside, inside])


@pytest.fixture
def scan_of():
    return ranges_in
