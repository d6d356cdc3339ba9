# SPDX-License-Identifier: BSD-3-Clause
"""Rooms of maps that Python has made or read; the program's plan is the same."""
import json
import pickle
import subprocess
import sys

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
    house.save(tmp_path / "map")
    (tmp_path / "map" / "map.yaml").unlink()
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
            cca_mrpt._core.floor_plan_geojson("x1,y1,x2,y2\n", cells, resolution, origin, "map.yaml", None, "")


@pytest.mark.skipif(not installed_program(), reason="needs the program cca-mrpt")
def test_the_program_makes_the_same_plan(log, tmp_path):
    done = subprocess.run([installed_program(), "map", str(log), "--out", str(tmp_path / "map")], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    of_program = (tmp_path / "map" / "plan.geojson").read_text()
    assert "room" in of_program
    assert cca_mrpt.floor_plan(tmp_path / "map").to_geojson() == of_program
    assert cca_mrpt.map(log).floor_plan().to_geojson() == of_program


OF_A_PLAN = ["plan.geojson", "plan.svg", "plan.dxf", "rooms.csv"]
DRAWN = ["plan.pdf", "rooms.png"]  # beside Cairo


def run(what, *words):
    """Exit status and error output."""
    command = [installed_program()] if what == "program" else [sys.executable, "-m", "cca_mrpt"]
    done = subprocess.run([*command, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stderr


def test_rooms_take_the_names_of_labels(house, tmp_path):
    (tmp_path / "labels.csv").write_text('x,y,name\n-1,0,Kitchen\n5,1,"Hall, large"\n50,50,Nowhere\n')
    plan = cca_mrpt.floor_plan(house, tmp_path / "labels.csv")
    assert plan.room_at(-1, 0).name == "Kitchen" and plan.room_at(5, 1).name == "Hall, large"
    assert plan.labels_outside == [((50.0, 50.0), "Nowhere")]
    names = plan.save(tmp_path / "plan")
    assert set(OF_A_PLAN) <= set(names) and "Kitchen" in (tmp_path / "plan" / "rooms.csv").read_text()
    plan.save(tmp_path / "plan")  # the same again
    (tmp_path / "plan" / "plan.svg").write_text("mine")
    with pytest.raises(RuntimeError, match="plan.svg: is there already"):
        plan.save(tmp_path / "plan")
    plan.save(tmp_path / "plan", force=True)
    (tmp_path / "labels.csv").write_text("x,y\n1,2\n")
    with pytest.raises(ValueError, match="labels.csv"):
        cca_mrpt.floor_plan(house, tmp_path / "labels.csv")


@pytest.mark.skipif(not installed_program(), reason="needs the program cca-mrpt")
@pytest.mark.parametrize("with_labels", [False, True])
def test_the_program_writes_the_same_plan(house, with_labels, tmp_path):
    house.save(tmp_path / "map")
    (tmp_path / "labels.csv").write_text("x,y,name\n-1,0,Kitchen\n50,50,Nowhere\n")
    labels = ["--labels", tmp_path / "labels.csv", "--origin", "-33.93,18.42,30"] if with_labels else []
    for what in "program", "python":
        status, said = run(what, "plan", tmp_path / "map", *labels, "--out", tmp_path / what)
        assert status == (3 if with_labels else 0), said
        assert ("(50, 50), Nowhere, lies in no room" in said) == with_labels
        (tmp_path / what / "rooms.csv").rename(tmp_path / what / "kept.csv")
        (tmp_path / what / "rooms.csv").write_text("mine")
        assert run(what, "plan", tmp_path / "map", "--out", tmp_path / what)[0] == 1
        (tmp_path / what / "kept.csv").rename(tmp_path / what / "rooms.csv")
    drawn = [name for name in DRAWN if (tmp_path / "python" / name).exists()]
    for name in OF_A_PLAN + drawn:
        assert (tmp_path / "program" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name


@pytest.mark.parametrize("what", ["python", pytest.param("program", marks=pytest.mark.skipif(not installed_program(), reason="needs it"))])
def test_maps_without_rooms_end_with_status_3(drive, tmp_path, what):
    cca_mrpt.map(drive[0][:1], pose="odometry").save(tmp_path / "map")
    (tmp_path / "map" / "map.pgm").write_bytes(b"P5\n2 2\n255\n" + bytes([205] * 4))
    (tmp_path / "map" / "lines.csv").write_text("x1,y1,x2,y2\n")
    status, said = run(what, "plan", tmp_path / "map", "--out", tmp_path / "out")
    assert status == 3 and "no room was found" in said
    assert run(what, "plan", tmp_path / "none")[0] == 1
