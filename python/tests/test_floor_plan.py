# SPDX-License-Identifier: BSD-3-Clause
"""Rooms of maps that Python has made or read; the program's plan is the same."""
import json
import pickle
import subprocess

import numpy as np
import pytest

import cca_mrpt
from cca_mrpt.program import installed_program
from conftest import FULL_TURN


@pytest.fixture
def house(two_rooms, scan_of):
    """The map of a drive through two rooms of 20 m^2, with a door of 1.2 m between them."""
    poses = [(x, 0.1 * np.sin(x), 0.0) for x in np.linspace(-2, 6, 60)]
    return cca_mrpt.map([cca_mrpt.LogRecord(scan_of(two_rooms, pose, beams=360, **FULL_TURN), **FULL_TURN, pose=pose, time=k / 5)
                         for k, pose in enumerate(poses)], pose="log")


def test_two_rooms_have_their_areas_and_a_door(house):
    plan = house.floor_plan()
    assert sorted(room.area for room in plan.rooms) == pytest.approx([20.0, 20.0], rel=0.02)
    (door,) = plan.openings
    assert door.kind == "door" and door.width == pytest.approx(1.2, abs=0.1) and sorted(door.rooms) == [1, 2]
    assert np.mean(door.jambs, axis=0) == pytest.approx((2.0, 0.0), abs=0.1)
    known = set(house.lines["id"].tolist())
    assert plan.walls and all(known.issuperset(left + right) for left, right in (wall.line_ids for wall in plan.walls))


def test_points_are_in_the_room_around_them(house):
    plan = house.floor_plan()
    left, right = plan.room_at(-1, 0), plan.room_at(5, 1)
    assert left is not None and right is not None and left.id != right.id
    assert plan.room_at(0, 5) is None and plan.room_at(100, 0) is None
    assert all(plan.room_at(*room.label) == room for room in plan.rooms)


def test_it_is_geojson_for_others(house):
    plan = cca_mrpt.floor_plan(house)
    features = plan.__geo_interface__["features"]
    assert features == json.loads(plan.to_geojson())["features"]
    assert {feature["properties"]["kind"] for feature in features} >= {"room", "door", "wall"}
    again = pickle.loads(pickle.dumps(plan))
    assert again.rooms == plan.rooms and repr(again) == repr(plan)


def test_a_map_without_a_grid_has_no_plan_and_says_so(house, tmp_path):
    house.save(tmp_path / "map")  # Python writes no map.pgm
    with pytest.raises(ValueError, match="map.pgm"):
        cca_mrpt.floor_plan(tmp_path / "map")
    with pytest.raises(FileNotFoundError, match="lines.csv"):
        cca_mrpt.floor_plan(tmp_path / "none")


@pytest.mark.parametrize("damage, message", [("origin: [0, 0, 0]\n", "map.yaml"), ("image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n", "map.pgm")])
def test_a_damaged_grid_is_named(house, tmp_path, damage, message):
    house.save(tmp_path)
    (tmp_path / "map.yaml").write_text(damage)
    (tmp_path / "map.pgm").write_bytes(b"P5\n40 40\n255\n123")
    with pytest.raises(ValueError, match=message):
        cca_mrpt.load(tmp_path)


def test_wrong_numbers_are_refused():
    cells = np.zeros((3, 4), np.uint8)
    for resolution, origin in (0.0, (0, 0)), (np.nan, (0, 0)), (0.05, (np.inf, 0)):
        with pytest.raises(ValueError):
            cca_mrpt._core.floor_plan_geojson("x1,y1,x2,y2\n", cells, resolution, origin)


@pytest.mark.skipif(not installed_program(), reason="needs the program cca-mrpt")
def test_the_program_makes_the_same_plan(log, tmp_path):
    done = subprocess.run([installed_program(), "map", str(log), "--out", str(tmp_path / "map")], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    of_program = (tmp_path / "map" / "plan.geojson").read_text()
    assert "room" in of_program
    assert cca_mrpt.floor_plan(tmp_path / "map").to_geojson() == of_program
    assert cca_mrpt.map(log).floor_plan().to_geojson() == of_program
