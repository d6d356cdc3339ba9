# SPDX-License-Identifier: BSD-3-Clause
import gzip
import json
import subprocess
import sys

import numpy as np
import pytest

import cca_mrpt
from cca_mrpt.program import installed_program


def test_scans_of_a_log_come_with_their_poses(log):
    scans = list(cca_mrpt.read_log(log))
    assert len(scans) == 20
    assert scans[3].ranges.shape == (181,) and scans[3].time == 3
    assert scans[3].angle_min == pytest.approx(-np.pi / 2)
    assert scans[3].pose == pytest.approx((-1 + 6 / 19, 0.3 * (-1 + 6 / 19), 0.3))


def test_ranges_outlive_their_record(log):
    kept = [scan.ranges for scan in cca_mrpt.read_log(log)]
    again = [scan.ranges.copy() for scan in cca_mrpt.read_log(log)]
    assert np.array_equal(kept, again)


def test_files_that_are_no_log_are_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="none.log"):
        cca_mrpt.read_log(tmp_path / "none.log")
    (tmp_path / "text.log").write_text("hello\n")
    with pytest.raises(ValueError, match="text.log: not a log of a known kind"):
        cca_mrpt.read_log(tmp_path / "text.log")
    with pytest.raises(ValueError, match=str(tmp_path)):
        cca_mrpt.read_log(tmp_path)


SCANS = [(0.1 * k, 0.005 * k) for k in range(8)]  # x and heading of a drive through a room


def csv_log(room, scan_of):
    header = ",".join(f"{angle}_deg" for angle in range(-90, 91))
    rows = [f"{k / 5},{x},0,{turn}," + ",".join(f"{r:.3f}" for r in scan_of(room, (x, 0, turn), np.radians(-90), np.radians(1), 181))
            for k, (x, turn) in enumerate(SCANS)]
    return "\n".join(["stamp,x,y,theta," + header, *rows, ""])


def csm_log(room, scan_of):
    rows = [{"nrays": 181, "min_theta": -np.pi / 2, "max_theta": np.pi / 2, "odometry": [x, 0, turn], "estimate": [None] * 3,
             "readings": [round(r, 3) for r in scan_of(room, (x, 0, turn), np.radians(-90), np.radians(1), 181)],
             "timestamp": [k // 5, 200000 * (k % 5)]} for k, (x, turn) in enumerate(SCANS)]
    return "".join(json.dumps(row) + "\n" for row in rows)


def core_slam_log(room, scan_of):
    step, rows = 2 * np.pi / 1024, []
    for k, (x, turn) in enumerate(SCANS):
        laser = (x + 0.145 * np.cos(turn), 0.145 * np.sin(turn), turn)
        ranges = 1000 * scan_of(room, laser, -340 * step, step, 682)
        per_turn = 2 * np.pi * 0.077
        ticks = [round(2000 * (x + side * 0.165 * turn) / per_turn) for side in (-1, 1)]
        rows.append(" ".join(str(number) for number in (200000 * k, 0, *ticks, *[0] * 21)) + "  "
                    + " ".join(f"{r:.0f}" for r in ranges) + " \n")
    return "".join(rows)


def raw_carmen_log(room, scan_of):
    text = ""
    for k, (x, turn) in enumerate(SCANS):
        ranges = scan_of(room, (x, 0, turn), np.radians(-90), np.radians(1), 181)
        text += f"ODOM {x} 0 {turn} 0 0 0 {k / 5} host {k / 5}\n"
        text += (f"RAWLASER1 0 {-np.pi / 2} {np.pi} {np.radians(1)} 80 0.01 0 181 " + " ".join(f"{r:.3f}" for r in ranges)
                 + f" 0 {k / 5} host {k / 5}\n")
    return text


@pytest.mark.parametrize("make", [csv_log, csm_log, core_slam_log, raw_carmen_log])
@pytest.mark.parametrize("is_zipped", [False, True])
def test_other_peoples_logs_are_mapped(make, is_zipped, room, scan_of, tmp_path):
    path = tmp_path / "log.txt"
    text = make(room, scan_of).encode()
    path.write_bytes(gzip.compress(text) if is_zipped else text)
    scans = list(cca_mrpt.read_log(path))
    assert [scan.time for scan in scans] == pytest.approx([k / 5 for k in range(8)])
    first = np.array(scans[0].odometry)
    assert np.array([scan.odometry for scan in scans])[:, 0] - first[0] == pytest.approx([x for x, _ in SCANS], abs=2e-3)
    made = cca_mrpt.map(path)
    assert made.summary["pose"] == "slam" and 3 <= len(made) <= 4 and made.shortcoming == ""
    assert np.abs(made.trajectory[:, :2] - [(x, 0) for x, _ in SCANS]).max() < 0.02
    if installed_program():
        done = subprocess.run([installed_program(), "map", str(path), "--out", str(tmp_path / "map")], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert (tmp_path / "map" / "lines.csv").read_text() == made.lines_csv()


@pytest.mark.parametrize("text, named", [
    ("stamp,ranges0,ranges1\n1,2,3\n", "log.txt:1: header: angle_min"), ("-90,0,90\n1,2\n", "log.txt:2: a row of 3 fields"),
    ('{"nrays": 3, "min_theta": 0}\n', "log.txt:1: max_theta: a finite number"), ("1 2 3 4 " * 30 + "\n", "log.txt:1: 24 or 25"),
])
def test_what_is_wrong_with_them_is_named_by_line_and_rule(text, named, tmp_path):
    (tmp_path / "log.txt").write_text(text)
    with pytest.raises(ValueError, match=named):
        cca_mrpt.read_log(tmp_path / "log.txt")


def test_lines_left_out_are_warned_of(tmp_path):
    (tmp_path / "log.csv").write_text("-90,0,90\n1,2,3\n1,2\n1,2,4\n")
    log = cca_mrpt.read_log(tmp_path / "log.csv")
    assert len(list(log)) == 2 and "1 line(s) left out, the first is line 3" in log.warnings


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "cca_mrpt", *map(str, arguments)], capture_output=True, text=True)


def test_the_command_maps_a_log(log, tmp_path):
    out = tmp_path / "map"
    done = run("map", log, "--out", out)
    assert done.returncode == 0, done.stderr
    assert "4 lines from 20 scans" in done.stdout
    assert {"lines.csv", "lines.geojson", "lines.svg", "summary.json"} <= {p.name for p in out.iterdir()}
    again = run("map", log, "--out", out)
    assert again.returncode == 1 and "lines.csv: is there already" in again.stderr
    assert (out / "lines.csv").read_text().count("\n") == 5


def test_the_command_says_what_was_wrong(tmp_path):
    missing = run("map", tmp_path / "none.log")
    assert missing.returncode == 1 and "none.log: no such file" in missing.stderr
    assert run("draw").returncode == 2
