# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

import cca_mrpt
from cca_mrpt import CellState
from conftest import FULL_TURN


def explore(walls, scan_of, steps=3000, period=0.1, **parameters):
    """Drives a point without inertia as the explorer says, until it says that all is seen."""
    explorer = cca_mrpt.Explorer(**parameters)
    pose, velocity = np.zeros(3), (0.0, 0.0)
    for step in range(steps):
        ranges = scan_of(walls, pose, beams=360, longest=4.0, **FULL_TURN)
        action = explorer.step(ranges, pose=pose, time=step * period, velocity=velocity,
                               free_range_without_return=4.0, **FULL_TURN)
        if action.status == "finished":
            return explorer, action
        velocity = action.velocity
        heading = pose[2] + 0.5 * period * velocity[1]
        pose += period * np.array([velocity[0] * np.cos(heading), velocity[0] * np.sin(heading), velocity[1]])
    raise AssertionError(f"not finished after {steps} steps: {action.reason}")


def test_both_rooms_are_explored_and_mapped(two_rooms, scan_of):
    explorer, action = explore(two_rooms, scan_of)
    assert action.velocity == (0.0, 0.0) and action.goal is None and action.reason
    ends = explorer.line_map().lines()["ends"].reshape(-1, 2)
    assert np.allclose(ends.min(axis=0), (-3, -2), atol=0.1)
    assert np.allclose(ends.max(axis=0), (7, 2), atol=0.1)
    grid = explorer.grid()
    free_area = np.isin(grid.states(), (CellState.FREE, CellState.PRESUMED_FREE)).sum() * grid.resolution**2
    assert free_area == pytest.approx(40.0, rel=0.05)


def test_a_grid_is_an_array_from_its_origin_on(room, scan_of):
    grid = cca_mrpt.ExplorationGrid(resolution=0.1)
    assert grid.states().shape == (0, 0)
    pose = (0.5, 0.0, 0.0)
    grid.insert(scan_of(room, pose, beams=360, **FULL_TURN), pose=pose, **FULL_TURN)
    states = grid.states()
    assert states.dtype == np.uint8
    at = lambda x, y: states[int((y - grid.origin[1]) / 0.1), int((x - grid.origin[0]) / 0.1)]  # noqa: E731
    assert at(0.5, 0.0) == CellState.FREE
    assert at(3.05, 0.0) == CellState.OCCUPIED
    assert grid.revealed > 2000


@pytest.mark.parametrize("change, named", [
    (dict(pose=(0, 0, np.inf)), "pose: "),
    (dict(time=np.nan), "time: "),
    (dict(time=-1.0), "time: before"),
    (dict(velocity=(0.0,)), "velocity: "),
    (dict(sensor_pose=None), "sensor_pose: "),
])
def test_wrong_observations_are_named(change, named):
    explorer = cca_mrpt.Explorer()
    right = dict(ranges=np.ones(360), pose=(0, 0, 0), time=0.0, **FULL_TURN)
    explorer.step(**right)
    with pytest.raises(ValueError, match=named):
        explorer.step(**{**right, **change})


@pytest.mark.parametrize("parameters, named", [
    (dict(strategy="best"), "strategy: 'best' is none of"),
    (dict(radius=-1.0), r"radius: -1.0 is not in"),
    (dict(return_to_start="yes"), "return_to_start: a bool"),
    (dict(speed=1.0), "speed: no such parameter"),
])
def test_wrong_parameters_are_named(parameters, named):
    with pytest.raises(ValueError, match=named):
        cca_mrpt.Explorer(**parameters)


def test_a_grid_refuses_cells_and_poses_beyond_its_reach():
    with pytest.raises(ValueError, match="resolution: "):
        cca_mrpt.ExplorationGrid(resolution=0.0)
    with pytest.raises(ValueError, match="pose: further"):
        cca_mrpt.ExplorationGrid().insert(np.ones(360), pose=(1e7, 0, 0), **FULL_TURN)
