# SPDX-License-Identifier: BSD-3-Clause
import json
import threading

import numpy as np
import pytest

import cca_mrpt
from conftest import FULL_TURN

POSES = [(x, 0.2 * x, 0.3 * x) for x in np.linspace(-1, 1, 9)]


@pytest.fixture
def line_map(room, scan_of):
    grown = cca_mrpt.LineMap()
    for pose in POSES:
        grown.insert(scan_of(room, pose, beams=360, **FULL_TURN), pose=pose, **FULL_TURN)
    return grown


def test_a_room_seen_from_nine_places_is_four_lines_and_one_closed_chain(line_map):
    lines = line_map.lines()
    assert lines.dtype == cca_mrpt.MAP_LINE and len(lines) == 4
    assert (np.diff(lines["id"].astype(int)) > 0).all()
    ends = np.abs(lines["ends"].reshape(-1, 2))
    assert np.allclose(ends, (3, 2), atol=0.02)
    (outline,) = line_map.poly_lines()
    assert outline.vertices.shape == (5, 2)
    assert np.array_equal(outline.vertices[0], outline.vertices[-1])
    assert sorted(outline.line_ids) == lines["id"].tolist()


def test_files_hold_the_same_lines(line_map):
    features = json.loads(line_map.to_geojson(POSES))["features"]
    of_kind = lambda kind: [f for f in features if f["properties"]["kind"] == kind]  # noqa: E731
    ends = np.array([f["geometry"]["coordinates"] for f in of_kind("line")])
    assert np.allclose(ends, line_map.lines()["ends"], atol=6e-5)  # written to a tenth of a millimetre
    assert len(of_kind("poly_line")) == 1 and len(of_kind("trajectory")) == 1
    assert line_map.to_csv().count("\n") == 5
    assert line_map.to_svg().startswith("<") and "POLYLINE" in line_map.to_dxf()


def test_what_a_caller_changes_does_not_reach_the_map(line_map):
    before = line_map.to_csv()
    line_map.lines()["ends"][:] = 0
    line_map.poly_lines()[0].vertices[:] = 0
    assert line_map.to_csv() == before


@pytest.mark.parametrize("pose, free, named", [
    ((0, 0), 0.0, r"pose: \(x, y, theta\) is needed, not shape \(2,\)"),
    ((0, np.nan, 0), 0.0, "pose: a finite number"),
    ((1e9, 0, 0), 0.0, "pose: further than"),
    ("here", 0.0, "pose: "),
    ((0, 0, 0), -1.0, "free_range_without_return: "),
])
def test_wrong_places_are_named_and_leave_the_map_as_it_is(line_map, pose, free, named):
    before = line_map.to_csv()
    with pytest.raises(ValueError, match=named):
        line_map.insert(np.ones(360), pose=pose, free_range_without_return=free, **FULL_TURN)
    assert line_map.to_csv() == before


def test_threads_may_look_while_another_inserts(line_map, room, scan_of):
    ranges = scan_of(room, (0, 0, 0), beams=360, **FULL_TURN)
    counts = []

    def look():
        counts.extend(len(line_map.lines()) for _ in range(100))

    threads = [threading.Thread(target=look) for _ in range(2)]
    for thread in threads:
        thread.start()
    for _ in range(100):
        line_map.insert(ranges, pose=(0, 0, 0), **FULL_TURN)
    for thread in threads:
        thread.join()
    assert len(counts) == 200 and set(counts) == {4}


def test_a_map_is_drawn_line_by_line(line_map):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    axes = cca_mrpt.plot(line_map, trajectory=POSES, ax=pyplot.figure().gca())
    drawn = np.array(axes.collections[0].get_segments())
    assert np.array_equal(drawn, line_map.lines()["ends"])
    assert np.array_equal(axes.lines[0].get_xydata(), np.array(POSES)[:, :2])
    pyplot.close("all")
