# SPDX-License-Identifier: BSD-3-Clause
"""What is no scan is refused with its values; what is one behaves as Python's values do."""
import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import cca_mrpt
from conftest import FULL_TURN

POSES = [(x, 0.2 * x, 0.3 * x) for x in np.linspace(-1, 1, 9)]


@pytest.fixture
def ranges(room, scan_of):
    return scan_of(room, (0, 0, 0), beams=360, **FULL_TURN)


@pytest.fixture
def line_map(room, scan_of):
    grown = cca_mrpt.LineMap()
    for pose in POSES:
        grown.insert(scan_of(room, pose, beams=360, **FULL_TURN), pose=pose, **FULL_TURN)
    return grown


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int64])
def test_masked_beams_are_invalid(ranges, dtype):
    whole = np.round(ranges).astype(dtype)
    mask = np.arange(360) % 3 == 0
    with_nan = np.where(mask, np.nan, whole.astype(float))
    masked = np.ma.MaskedArray(np.where(mask, 1, whole).astype(dtype), mask)
    expected = cca_mrpt.extract_lines(with_nan, **FULL_TURN)
    assert np.array_equal(cca_mrpt.extract_lines(masked, **FULL_TURN), expected)
    assert expected["returns"].sum() <= 240


def test_a_masked_pose_is_none(line_map, ranges):
    with pytest.raises(ValueError, match="pose: a finite number"):
        line_map.insert(ranges, pose=np.ma.MaskedArray([0, 0, 0], [False, True, False]), **FULL_TURN)


@pytest.mark.parametrize("change, told", [
    (dict(angle_min=-90.0), "angle_min: -90 rad is more than two turns; are these degrees?"),
    (dict(angle_min=0.0, angle_increment=1.0), r"angle_increment: 1 rad make 360 beams cover 359 rad.*degrees"),
    (dict(angle_increment=-0.5), "angle_increment: -0.5 rad make 360 beams"),
])
def test_degrees_are_told_from_radians(ranges, change, told):
    with pytest.raises(ValueError, match=told):
        cca_mrpt.extract_lines(ranges, **{**FULL_TURN, **change})


def test_a_laser_turned_by_degrees_is_refused(ranges):
    with pytest.raises(ValueError, match="sensor_pose: 90 rad is more than two turns; are these degrees?"):
        cca_mrpt.LogRecord(ranges, **FULL_TURN, sensor_pose=(0.1, 0, 90))
    cca_mrpt.LogRecord(ranges, **FULL_TURN, odometry=(0, 0, 90))  # a robot may count its turns


def test_mrpt_is_loaded_only_for_the_simulator():
    loaded = "import sys, cca_mrpt; print('cca_mrpt._simulation' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True).stdout == "False\n"


def test_millimetres_are_told_from_metres(ranges):
    with pytest.raises(ValueError, match=r"ranges: 360 of 360 returns lie beyond 200 m, the nearest at 2000 m; are"):
        cca_mrpt.extract_lines(1000 * ranges, **FULL_TURN)


@pytest.mark.parametrize("angle_min, angle_increment, beams", [
    (-np.pi, 2 * np.pi / 360, 361),  # the first beam again
    (-np.pi, 2 * np.pi / 359.4, 361),  # a laser that is a little slow
    (3 * np.pi, -np.radians(0.25), 1081),
    (0.0, np.radians(30), 12),
])
def test_angles_that_lasers_have_are_taken(angle_min, angle_increment, beams):
    cca_mrpt.extract_lines(np.ones(beams), angle_min, angle_increment)


def test_far_returns_among_near_ones_are_taken(ranges):
    ranges[:100] = 5000.0
    assert len(cca_mrpt.extract_lines(ranges, **FULL_TURN)) > 0


def test_a_map_tells_its_size_and_shows_itself(line_map):
    assert len(line_map) == 4 and repr(line_map) == "LineMap(4 lines)"
    assert line_map._repr_svg_().startswith("<?xml") and "polyline" in line_map._repr_svg_()


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_a_copy_of_a_map_grows_by_itself(line_map, copied, two_rooms, scan_of):
    before, other = line_map.to_csv(), copied(line_map)
    assert other.to_csv() == before
    other.insert(scan_of(two_rooms, (5, 0, 0), beams=360, **FULL_TURN), pose=(50, 0, 0), **FULL_TURN)
    assert len(other) > 4 and line_map.to_csv() == before


def test_values_survive_pickling(line_map, ranges):
    (chain,) = line_map.poly_lines()
    again = pickle.loads(pickle.dumps(chain))
    assert np.array_equal(again.vertices, chain.vertices) and again.line_ids == chain.line_ids
    assert len(chain) == 5 and repr(chain) == "PolyLine(5 vertices, 20.00 m)"
    pose = cca_mrpt.Slam(start=(1, 2, 0.5)).step(ranges, odometry=(0, 0, 0), **FULL_TURN)
    same = pickle.loads(pickle.dumps(pose))
    assert same.pose == pose.pose and np.array_equal(same.covariance, pose.covariance)
    assert (same.agreement, same.version, same.is_lost) == (pose.agreement, pose.version, pose.is_lost)
    mapper = cca_mrpt.Mapper(pose="odometry")
    estimate = mapper.step(cca_mrpt.LogRecord(ranges, **FULL_TURN, odometry=(1, 2, 0.5)))
    for same in pickle.loads(pickle.dumps(estimate)), copy.copy(estimate), copy.deepcopy(estimate):
        assert same.pose == estimate.pose and np.array_equal(same.covariance, estimate.covariance)
        assert (same.agreement, same.is_placed, same.was_corrected) == (estimate.agreement, estimate.is_placed, estimate.was_corrected)
    action = cca_mrpt.Explorer().step(ranges, pose=(0, 0, 0), time=0.0, **FULL_TURN)
    for same in pickle.loads(pickle.dumps(action)), copy.copy(action):
        assert (same.velocity, same.goal, same.status, same.reason) == (action.velocity, action.goal, action.status, action.reason)
    ransac = cca_mrpt.baselines["ransac"]
    assert pickle.loads(pickle.dumps(ransac)).paper == ransac.paper
    lines = line_map.lines()
    assert np.array_equal(pickle.loads(pickle.dumps(lines)), lines)


def test_a_record_is_made_copied_and_pickled(ranges):
    record = cca_mrpt.LogRecord(ranges, **FULL_TURN, time=3.5, odometry=(1, 2, 0.5), sensor_pose=(0.1, 0, 0),
                                free_range_without_return=8.0)
    assert record.pose == pytest.approx((1 + 0.1 * np.cos(0.5), 2 + 0.1 * np.sin(0.5), 0.5))
    assert record.robot_pose is None and len(record) == 360
    assert repr(record) == "LogRecord(360 beams, 360 returns, time=3.500)"
    for other in copy.copy(record), copy.deepcopy(record), pickle.loads(pickle.dumps(record)):
        assert np.array_equal(other.ranges, record.ranges) and other.ranges is not record.ranges
        assert (other.time, other.pose, other.odometry) == (record.time, record.pose, record.odometry)
        assert other.sensor_pose == (0.1, 0, 0)


def test_a_grid_is_copied():
    grid = cca_mrpt.ExplorationGrid(0.1)
    grid.insert(np.full(360, 2.0), pose=(0, 0, 0), **FULL_TURN)
    other = copy.deepcopy(grid)
    assert np.array_equal(other.states(), grid.states()) and repr(grid).startswith("ExplorationGrid(")


def test_the_stubs_name_and_type_each_parameter():
    """What passes parameters on knows the same ones as the core."""
    import inspect
    import pathlib
    import re

    from cca_mrpt.parameters import MapParameters, SimulationParameters

    folder = pathlib.Path(inspect.getfile(cca_mrpt)).parent
    stubs = (folder / "_core.pyi").read_text()
    named = re.search(r"class LineMap:.*?def __init__\(self, \*, (.*?)\) -> None", stubs, re.DOTALL)[1]
    assert re.findall(r"(\w+): float", named) == list(MapParameters.__annotations__)
    assert "**" not in stubs and not re.search(r"\barg\d*\b", stubs)
    simulation = folder / "_simulation.pyi"
    if simulation.exists():
        named = re.search(r"def __init__\(self, world.*?\) -> None", simulation.read_text(), re.DOTALL)[0]
        assert re.findall(r"(\w+): ", named)[2:] == [n for n in ["seed", *SimulationParameters.__annotations__]]


def test_types_are_strict(tmp_path):
    api = pytest.importorskip("mypy.api")
    script = tmp_path / "user.py"
    script.write_text("import cca_mrpt\n"
                      "grown = cca_mrpt.LineMap(similarity_cut=0.4)\n"
                      "for scan in cca_mrpt.read_log('a.log'):\n"
                      "    grown.insert(scan.ranges, scan.angle_min, scan.angle_increment, scan.pose)\n"
                      "length: float = sum(len(chain) for chain in grown.poly_lines())\n")
    for checked in ([str(script)], ["-p", "cca_mrpt"]):
        output, errors, status = api.run(["--strict", "--cache-dir", str(tmp_path / "cache"), *checked])
        assert status == 0, output + errors
    script.write_text("import cca_mrpt\ncca_mrpt.LineMap(similarity_cut='low')\ncca_mrpt.LineMap(similarity=1.0)\n")
    output, _, status = api.run(["--strict", "--cache-dir", str(tmp_path / "cache"), str(script)])
    assert status == 1 and output.count("error:") == 2, output


@pytest.mark.parametrize("make, told", [
    (cca_mrpt.LineMap, "a LineMap cannot be pickled.*copy it, or pickle its lines"), (cca_mrpt.Slam, "a Slam cannot.*resume"),
    (cca_mrpt.Explorer, "an Explorer cannot"), (cca_mrpt.ExplorationGrid, "an ExplorationGrid cannot.*states"),
    (cca_mrpt.Mapper, "a Mapper cannot.*resume"),
])
def test_what_cannot_be_pickled_says_why_and_what_can(make, told):
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        with pytest.raises(TypeError, match=told):
            pickle.dumps(make(), protocol)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
@pytest.mark.parametrize("make", [cca_mrpt.Slam, cca_mrpt.Explorer, cca_mrpt.Mapper])
def test_a_drive_has_no_copies(make, copied):
    with pytest.raises(TypeError, match="in the middle of a drive"):
        copied(make())
