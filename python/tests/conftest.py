# SPDX-License-Identifier: BSD-3-Clause
"""Rooms to look into, and what a laser sees of them."""
import numpy as np
import pytest

import cca_mrpt
import room_log
from room_log import ROOM, chain, ranges_in

FULL_TURN = dict(angle_min=-np.pi, angle_increment=2 * np.pi / 360)


@pytest.fixture
def room():
    """6 m x 4 m around the origin."""
    return ROOM


@pytest.fixture
def two_rooms():
    """10 m x 4 m with a wall across it that has a door of 1.2 m."""
    outside = chain((-3, -2), (7, -2), (7, 2), (-3, 2), (-3, -2))
    inside = np.array([[[2, -2], [2, -0.6]], [[2, 0.6], [2, 2]]], dtype=float)
    return np.concatenate([outside, inside])


@pytest.fixture
def scan_of():
    return ranges_in


@pytest.fixture
def log(tmp_path):
    """A CARMEN log of a SICK laser that drives through a room."""
    path = tmp_path / "room.log.gz"
    room_log.write(path)
    return path


@pytest.fixture
def drive(two_rooms, scan_of):
    """Records of a robot whose wheels turn a little at each step, and its true poses."""
    records, truth, wheels = [], [], np.array([5.0, 7.0, 1.0])
    for k in range(60):
        step = 0.1 if k < 30 else -0.1
        pose = (truth[-1][0] + step, 0.0, 0.0) if truth else (0.0, 0.0, 0.0)
        if truth:
            wheels += (step * np.cos(wheels[2]), step * np.sin(wheels[2]), 0.004)
        truth.append(pose)
        records.append(cca_mrpt.LogRecord(scan_of(two_rooms, pose, beams=360, **FULL_TURN), **FULL_TURN, time=k / 5,
                                          odometry=tuple(wheels)))
    return records, np.array(truth)
