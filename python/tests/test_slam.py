# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

import cca_mrpt
from conftest import FULL_TURN


def drive(walls, scan_of, turn_error):
    """Along the long axis of a room and back, with wheels that turn a little at each step."""
    slam = cca_mrpt.Slam(start=(-2.0, 0.0, 0.0))
    truth, wheels, poses = [], np.array([5.0, 7.0, 1.0]), []
    for k in range(60):
        step = 0.1 if k < 30 else -0.1
        pose = (truth[-1][0] + step if truth else -2.0, 0.0, 0.0)
        if truth:
            wheels += (step * np.cos(wheels[2]), step * np.sin(wheels[2]), turn_error)
        truth.append(pose)
        poses.append(slam.step(scan_of(walls, pose, beams=360, **FULL_TURN), odometry=wheels, **FULL_TURN))
    return slam, np.array(truth), poses


def test_the_laser_corrects_the_wheels(two_rooms, scan_of):
    slam, truth, poses = drive(two_rooms, scan_of, turn_error=0.004)
    assert np.abs(np.array([p.pose for p in poses]) - truth).max() < 0.02
    slam.finish()
    assert slam.trajectory().shape == (60, 3)
    assert np.abs(slam.trajectory() - truth).max() < 0.02
    assert slam.loops == 0 and slam.version >= 0
    assert slam.is_placed == [True] * 60 and not any(pose.is_lost for pose in poses)


def test_a_pose_tells_how_sure_it_is(room, scan_of):
    _, _, poses = drive(room, scan_of, turn_error=0.0)
    last = poses[-1]
    assert last.covariance.shape == (3, 3) and (np.linalg.eigvalsh(last.covariance) >= 0).all()
    assert 0.9 < last.agreement <= 1.0


@pytest.mark.parametrize("change, named", [
    (dict(odometry=(0, 0)), "odometry: "),
    (dict(sensor_pose=None), "sensor_pose: "),
    (dict(ranges="far"), "ranges: "),
])
def test_wrong_arguments_are_named(change, named):
    right = dict(ranges=np.ones(360), **FULL_TURN)
    with pytest.raises(ValueError, match=named):
        cca_mrpt.Slam().step(**{**right, **change})


def test_a_wrong_start_is_named():
    with pytest.raises(ValueError, match="start: "):
        cca_mrpt.Slam(start=(0, np.nan, 0))
