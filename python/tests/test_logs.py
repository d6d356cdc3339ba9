# SPDX-License-Identifier: BSD-3-Clause
import subprocess
import sys

import numpy as np
import pytest

import cca_mrpt


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
    with pytest.raises(ValueError, match="text.log: holds no whole laser scan"):
        cca_mrpt.read_log(tmp_path / "text.log")
    with pytest.raises(ValueError, match=str(tmp_path)):
        cca_mrpt.read_log(tmp_path)


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
