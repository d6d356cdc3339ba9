# SPDX-License-Identifier: BSD-3-Clause
"""The one pipeline, from Python: the same map as the program's, whoever brings the scans."""
import copy
import json
import os
import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import cca_mrpt
from cca_mrpt.program import installed_program
from conftest import FULL_TURN

SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"


def in_first_frame(poses):
    """As seen from the first pose."""
    x, y, theta = (poses - poses[0]).T
    c, s = np.cos(poses[0, 2]), np.sin(poses[0, 2])
    return np.stack([c * x + s * y, c * y - s * x, theta], axis=1)


def test_corrected_poses_are_believed(log):
    made = cca_mrpt.map(log)
    assert made.summary["pose"] == "log" and len(made) == 4 and made.trajectory.shape == (20, 3)
    assert repr(made) == "Map(4 lines, 17.0 m, 20 scans)" and made.is_placed.all()
    (outline,) = made.poly_lines
    assert len(outline) == 5 and made.arcs == []


def test_wheels_alone_are_not_believed(drive):
    records, truth = drive
    slam, raw = cca_mrpt.map(records), cca_mrpt.map(records, pose="odometry")
    assert slam.summary["pose"] == "slam"
    error = lambda made: np.abs(in_first_frame(made.trajectory) - truth)[:, :2].max()  # noqa: E731
    assert error(slam) < 0.02 < 0.1 < error(raw)
    assert len(slam) <= 7 < len(raw)


def with_lost_beams(records, reach):
    """The same by a laser that sees so far, m, and loses 3 % of its beams, which its driver tells as +inf."""
    random, lossy = np.random.default_rng(5), []
    for record in records:
        ranges = np.where(random.random(len(record.ranges)) < 0.03, np.inf, record.ranges)
        lossy.append(cca_mrpt.LogRecord(ranges, **FULL_TURN, time=record.time, odometry=record.odometry,
                                        free_range_without_return=reach))
    return lossy


@pytest.mark.parametrize("made_by", [lambda records: cca_mrpt.map(records), lambda records: stepped(records).finish()])
def test_lost_beams_of_somebodys_own_scans_free_nothing_behind_walls(made_by, drive):
    records, _ = drive
    lossy = with_lost_beams(records, 30.0)
    walls = np.isfinite(np.stack([record.ranges for record in records]))
    assert walls.all() and all(np.isinf(record.ranges).any() for record in lossy)
    free = [int((made.grid.cells == 1).sum()) for made in (made_by(records), made_by(lossy))]
    assert abs(free[1] - free[0]) < 0.02 * free[0]


def stepped(records):
    mapper = cca_mrpt.Mapper()
    for record in records:
        mapper.step(record)
    return mapper


def test_scan_by_scan_is_the_same_as_the_log_as_a_whole(drive):
    records, _ = drive
    mapper = cca_mrpt.Mapper()
    for record in records:
        estimate = mapper.step(record)
        assert estimate.is_placed and estimate.agreement > 0.9
    assert len(mapper) == 60 and len(mapper.lines) > 4 and repr(mapper).startswith("Mapper(60 scans")
    assert len(mapper.map().lines) == len(mapper.lines)
    assert mapper.finish()._files["lines.csv"] == cca_mrpt.map(records)._files["lines.csv"]
    with pytest.raises(ValueError, match="finished"):
        mapper.step(records[0])


def test_a_map_comes_back_from_its_folder(drive, tmp_path):
    made = cca_mrpt.map(drive[0])
    names = made.save(tmp_path / "map")
    assert sorted(p.name for p in (tmp_path / "map").iterdir()) == sorted(names)
    back = cca_mrpt.load(tmp_path / "map")
    assert np.allclose(back.lines["ends"], made.lines["ends"], atol=6e-5)
    assert np.array_equal(back.lines["id"], made.lines["id"])
    assert [chain.line_ids for chain in back.poly_lines] == [chain.line_ids for chain in made.poly_lines]
    assert np.allclose(back.trajectory, made.trajectory, atol=1e-5) and np.allclose(back.times, made.times)
    assert back.summary == json.loads(json.dumps(made.summary))
    back.save(tmp_path / "again")
    for name in names:
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "map" / name).read_bytes(), name


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda held: pickle.loads(pickle.dumps(held))])
@pytest.mark.parametrize("is_loaded", [False, True])
def test_a_copied_or_pickled_map_is_the_same_map(again, is_loaded, drive, tmp_path):
    made = cca_mrpt.map(drive[0])
    names = made.save(tmp_path / "map")
    made = cca_mrpt.load(tmp_path / "map") if is_loaded else made
    same = again(made)
    assert np.array_equal(same.lines, made.lines) and np.array_equal(same.trajectory, made.trajectory)
    assert repr(same) == repr(made) and same.summary == made.summary
    assert np.array_equal(same.grid.cells, made.grid.cells) and same.grid[1:] == made.grid[1:]
    assert str(same.floor_plan()) == str(made.floor_plan()) and same.floor_plan().to_geojson() == made.floor_plan().to_geojson()
    same.save(tmp_path / "same" / "map")
    for name in names:
        assert (tmp_path / "same" / "map" / name).read_bytes() == (tmp_path / "map" / name).read_bytes(), name


def test_maps_are_not_overwritten_unasked(log, tmp_path):
    made = cca_mrpt.map(log)
    made.save(tmp_path / "map")
    with pytest.raises(FileExistsError, match="lines.csv: is there already"):
        made.save(tmp_path / "map")
    (tmp_path / "other").mkdir()
    for folder in "map", "other":
        (tmp_path / folder / "graph.g2o").write_text("of another run")
    with pytest.raises(FileExistsError, match="graph.g2o: is there already"):
        made.save(tmp_path / "other")
    assert (tmp_path / "other" / "graph.g2o").read_text() == "of another run"
    (tmp_path / "linked").mkdir()
    (tmp_path / "linked" / "lines.csv").symlink_to(tmp_path / "away.csv")
    with pytest.raises(FileExistsError, match="lines.csv: is there already"):
        made.save(tmp_path / "linked")
    for use in made.save, made.floor_plan().save, cca_mrpt.load:
        with pytest.raises(ValueError, match="folder: a name is needed"):
            use("")
    made.save(tmp_path / "map", force=True)
    assert not (tmp_path / "map" / "graph.g2o").exists()


@pytest.mark.parametrize("name", ["lines.svg", "map.slam", "summary.json"])
def test_a_folder_that_has_the_name_of_a_file_stops_all(log, tmp_path, name):
    """Found when half of the files are written, it would leave two maps mixed."""
    (tmp_path / "map" / name).mkdir(parents=True)
    made = cca_mrpt.map(log)
    with pytest.raises(IsADirectoryError, match=f"{name}: is a folder"):
        made.save(tmp_path / "map", force=True)
    assert os.listdir(tmp_path / "map") == [name]


def test_what_is_no_map_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="lines.csv: no such file"):
        cca_mrpt.load(tmp_path)
    (tmp_path / "lines.csv").write_text("x1,y1\n1,2\n")
    with pytest.raises(ValueError, match="lines.csv: not a line map"):
        cca_mrpt.load(tmp_path)


@pytest.mark.parametrize("name, damage, message", [
    ("lines.csv", b"", "not a line map"),
    ("poses.csv", b"", "no column stamp"),
    ("poses.csv", b"stamp,x,y,heading\n1,2,3,4\n", "no column theta"),
    ("lines.csv", b"id,x1\n1,\x80\n", "no text"),
    ("lines.csv", b"x1,y1,x2,y2\n1,2,3,4\n5\n", "row 3, column y1: missing"),
    ("lines.csv", b"x1,y1,x2,y2\n1,2,3,1e300\n", r"row 2, column y2: '1e300' must be a number in \[-1e8, 1e8\] m"),
    ("poses.csv", b"stamp,x,y,theta\n1,2\n", "line 2: is damaged: 4 values are needed"),
    ("poses.csv", b"stamp,x,y,theta\n1,1e300,3,4\n", "line 2: is damaged: finite numbers are needed"),
    ("lines.geojson", b'{"type": "FeatureCollection", "features": [{"geometry": null}]}', "not a line map's GeoJSON"),
    ("arcs.csv", b"", "no column line_ids"),
    ("arcs.csv", b"x,y,radius,start_deg,sweep_deg,line_ids\n1,2,3,4,5,6 7\n1,2,3,4,5,six\n", "line 3: is damaged: .*six"),
    ("map.yaml", b"\x80\x00\xff", "no text"),
    ("map.yaml", b"image: map.pgm\nresolution: 0.0\norigin: [0, 0, 0]\n", "resolution: 0.0 m: must be above 0"),
    ("map.yaml", b"image: map.pgm\nresolution: 1.2.3\norigin: [0, 0, 0]\n", "no map of map_server"),
    ("poses.csv", b"stamp,x,y,theta\n1,2,nan,4\n", "line 2: is damaged: finite numbers are needed"),
    ("poses.csv", b"stamp,x,y,theta\n1,2,a,4\n", "line 2: is damaged: could not convert"),
    ("summary.json", b"{", "no JSON"),
    ("summary.json", b"[]", "is no summary of a map"),
    ("summary.json", b'{"unplaced_scans": 5}', "is no summary of a map"),
])
def test_what_is_damaged_is_named(log, tmp_path, name, damage, message):
    cca_mrpt.map(log).save(tmp_path / "map")
    (tmp_path / "map" / name).write_bytes(damage)
    with pytest.raises(ValueError, match=f"{name}.*{message}"):
        cca_mrpt.load(tmp_path / "map")


def test_half_a_map_is_told(log, tmp_path):
    cca_mrpt.map(log).save(tmp_path / "map")
    assert cca_mrpt.load(tmp_path / "map").warnings == ""
    (tmp_path / "map" / "summary.json").unlink()
    (tmp_path / "map" / "lines.svg").unlink()
    half = cca_mrpt.load(tmp_path / "map")
    assert "half of a map" in half.warnings and half._repr_svg_() is None


@pytest.mark.parametrize("source, pose, named", [
    ([1, 2], "auto", "records: an iterable of LogRecord"),
    ([], "auto", "no scan is among them"),
    ([], "gps", "pose: 'gps' is none of auto log odometry slam"),
    ([cca_mrpt.LogRecord(np.ones(360), **FULL_TURN)], "odometry", "holds no odometry"),
])
def test_wrong_arguments_are_named(source, pose, named):
    with pytest.raises(ValueError, match=named):
        cca_mrpt.map(source, pose)


@pytest.mark.parametrize("arguments, named", [
    (dict(resume=""), "folder: a name is needed"), (dict(serve=True), "serve: a port is needed"),
    (dict(serve=0, serve_address=""), "address: is empty"),
])
def test_wrong_keywords_are_named(log, arguments, named):
    with pytest.raises(ValueError, match=named):
        cca_mrpt.map(log, **arguments)


def test_an_error_of_the_caller_comes_through():
    def records():
        yield cca_mrpt.LogRecord(np.ones(360), **FULL_TURN)
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        cca_mrpt.map(records())


def test_a_map_is_drawn(drive):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    made = cca_mrpt.map(drive[0])
    axes = made.plot(pyplot.figure().gca())
    assert len(axes.collections[0].get_segments()) == len(made)
    assert made._repr_svg_().startswith("<?xml")
    pyplot.close("all")


def both(program, log, pose, tmp_path, *words):
    """lines.csv and others of the program and of Python's command, as bytes."""
    for name, command in ("program", [program]), ("python", [sys.executable, "-m", "cca_mrpt"]):
        done = subprocess.run([*command, "map", str(log), "--pose", pose, *words, "--out", str(tmp_path / name)],
                              capture_output=True, text=True)
        if "built without ROS" in done.stderr:
            pytest.skip("the program was built without ROS")
        assert done.returncode in (0, 3), done.stderr  # 3: the program says that these poses contradict the map
    names = ["lines.csv", "arcs.csv", "lines.geojson", "lines.svg", "lines.dxf", "map.pgm", "map.yaml", "poses.csv", "replay.html",
             "plan.geojson", "plan.svg", "plan.dxf", "rooms.csv"]
    names += ["map.png", "plan.pdf", "rooms.png"] if (tmp_path / "python" / "map.png").exists() else []
    names += ["graph.g2o", "map.slam"] if pose == "slam" else []
    for name in names:
        yield name, (tmp_path / "program" / name).read_bytes(), (tmp_path / "python" / name).read_bytes()


@pytest.mark.skipif(not installed_program(), reason="needs the program cca-mrpt")
@pytest.mark.parametrize("pose, words", [("log", []), ("slam", []), ("slam", ["--origin", "-33.93,18.42,30"])])
def test_the_program_makes_the_same_bytes(log, pose, words, tmp_path):
    for name, of_program, of_python in both(installed_program(), log, pose, tmp_path, *words):
        assert of_program == of_python, name


def test_a_map_may_lie_on_the_earth(log, tmp_path):
    made = cca_mrpt.map(log, origin=(52.5, 13.4, 0.0))
    made.save(tmp_path / "map")
    for name in "lines.geojson", "plan.geojson":
        corner = json.loads((tmp_path / "map" / name).read_text())["features"][0]["geometry"]["coordinates"]
        while isinstance(corner[0], list):
            corner = corner[0]
        assert corner == pytest.approx([13.4, 52.5], abs=1e-3), name
    assert len(cca_mrpt.load(tmp_path / "map").poly_lines) == len(made.poly_lines)
    made.floor_plan().save(tmp_path / "plan", origin=(52.5, 13.4, 0.0))
    assert (tmp_path / "plan" / "plan.geojson").read_bytes() == (tmp_path / "map" / "plan.geojson").read_bytes()
    for wrong in (95.0, 0.0, 0.0), (0.0, 0.0), (0.0, float("nan"), 0.0):
        with pytest.raises(ValueError, match="origin"):
            cca_mrpt.map(log, origin=wrong)


@pytest.mark.skipif(not (installed_program() and SHARED.exists()), reason="needs the program and the shared data")
@pytest.mark.parametrize("pose", ["log", "slam"])
@pytest.mark.parametrize("name", ["logs/fhw-corrected.log.gz", "logs/orebro-corrected.log.gz", "bags/intel.bag",
                                  "field/03_turning_lidar_7Hz.bag", "field/03_turning_lidar_7Hz.log.gz", "field/03_same_without_skew.log.gz",
                                  "field/05_laser_freezes.bag", "field/09_namespaced_frames.bag"])
def test_the_program_makes_the_same_bytes_of_real_logs(name, pose, tmp_path):
    for file, of_program, of_python in both(installed_program(), SHARED / name, pose, tmp_path):
        assert of_program == of_python, file


def test_the_command_of_the_package_gives_way_to_the_program(tmp_path):
    ours = shutil.which("cca-mrpt", path=str(Path(sys.executable).parent))
    if ours is None:
        pytest.skip("installed without its commands")
    environment = {"PATH": str(Path(sys.executable).parent)}
    alone = subprocess.run([ours, "map", "--help"], capture_output=True, text=True, env=environment)
    assert alone.returncode == 0 and "--odom-frame" in alone.stdout  # Python's
    shutil.copy("/bin/echo", tmp_path / "cca-mrpt")
    environment["PATH"] += f":{tmp_path}"
    beside = subprocess.run([ours, "map", "LOG"], capture_output=True, text=True, env=environment)
    assert beside.stdout == "map LOG\n"
