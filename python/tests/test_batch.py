# SPDX-License-Identifier: BSD-3-Clause
"""Batches on a real scheduler with four workers, one of which is killed."""
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from cca_mrpt import batch
from cca_mrpt.__main__ import main

pytest.importorskip("distributed", reason="needs dask.distributed")

LOGS, PATIENCE = 12, 120  # s


@pytest.fixture
def logs(tmp_path, room, scan_of):
    """Logs that take some tenths of a second each: there and back in a room, 50 times."""
    paths = []
    for number in range(LOGS):
        lines = []
        for k in range(20):
            pose = (-1 + 0.1 * min(k, 20 - k), 0.02 * number, 0.0)
            numbers = " ".join(f"{r:.3f}" for r in scan_of(room, pose, np.radians(-90), np.radians(0.5), 361))
            lines.append(f"FLASER 361 {numbers} {pose[0]} {pose[1]} {pose[2]} {pose[0]} {pose[1]} {pose[2]}")
        path = tmp_path / f"room_{number}.log"
        path.write_text("".join(f"{lines[k % 20]} {0.1 * k} host {0.1 * k}\n" for k in range(1000)))
        paths.append(path)
    return paths


@pytest.fixture
def cluster(tmp_path):
    """(address of a scheduler, its four worker processes)."""
    told = tmp_path / "scheduler.json"
    start = lambda *arguments: subprocess.Popen([sys.executable, "-m", *arguments, "--dashboard-address", ":0"],  # noqa: E731
                                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    processes = [start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0",
                       "--scheduler-file", str(told))]
    wait_for(told.exists)
    workers = [start("distributed.cli.dask_worker", "--scheduler-file", str(told), "--nthreads", "1", "--no-nanny",
                     "--local-directory", str(tmp_path)) for _ in range(4)]
    address = json.loads(told.read_text())["address"]
    from distributed import Client
    with Client(address) as client:
        client.wait_for_workers(4, timeout=PATIENCE)
    yield address, workers
    for process in workers + processes:
        process.kill()
        process.wait()


def wait_for(holds):
    begin = time.time()
    while not holds():
        assert time.time() - begin < PATIENCE
        time.sleep(0.01)


def bytes_in(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_killed_worker_loses_nothing_and_results_do_not_depend_on_the_number(logs, cluster, tmp_path):
    address, workers = cluster
    alone = batch.map_logs(logs, tmp_path / "alone", workers=1)
    command = subprocess.Popen([sys.executable, "-m", "cca_mrpt", "batch", "map", *map(str, logs), "--out",
                                str(tmp_path / "four"), "--scheduler", address],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    wait_for(lambda: len(list((tmp_path / "four").glob("room_*/summary.json"))) >= 3)
    workers[0].kill()
    assert len(list((tmp_path / "four").glob("room_*/summary.json"))) < LOGS, "killed too late to tell"
    said, errors = command.communicate(timeout=PATIENCE)
    assert command.returncode == 0, errors
    assert f"{LOGS} done" in said
    assert [result["log"] for result in alone] == [str(log) for log in logs]
    assert bytes_in(tmp_path / "four") == bytes_in(tmp_path / "alone")


def test_a_batch_goes_on_where_it_was_and_names_what_failed(logs, tmp_path):
    broken = tmp_path / "broken.log"
    broken.write_text("hello\n")
    left = tmp_path / "out" / "room_0.part-1"  # by a worker that was killed
    left.mkdir(parents=True)
    some = [*logs[:2], broken]
    first = batch.map_logs(some, tmp_path / "out", workers=2)
    kept = tmp_path / "out" / "room_0" / "summary.json"
    before = kept.stat().st_mtime_ns
    shutil.rmtree(tmp_path / "out" / "room_1")
    assert batch.map_logs(some, tmp_path / "out", workers=2) == first
    assert kept.stat().st_mtime_ns == before
    assert "not a log of a known kind" in first[2]["error"]
    assert sorted(os.listdir(tmp_path / "out")) == ["room_0", "room_1"]


def test_jobs_that_would_write_to_one_folder_are_refused(logs, tmp_path):
    with pytest.raises(ValueError, match="room_0"):
        batch.map_logs([logs[0], logs[0]], tmp_path / "out")


needs_program = pytest.mark.skipif(not shutil.which("cca-mrpt"), reason="needs the program cca-mrpt in PATH")


@pytest.mark.skipif(not shutil.which("cca-mrpt-bench"), reason="needs the program cca-mrpt-bench in PATH")
def test_strategies_and_tuning_give_the_bytes_of_the_program_alone(tmp_path):
    world = Path(__file__).parents[2] / "maps" / "two_rooms.yaml"
    strategies = ["greedy", "nearest_frontier"]
    batch.compare_strategies([world], tmp_path / "two", strategies=strategies, starts=1, workers=2)
    subprocess.run(["cca-mrpt-bench", "compare-strategies", world, "--strategies", ",".join(strategies), "--starts", "1",
                    "--out", tmp_path / "one"], check=True, capture_output=True)
    for name in "runs.csv", "curves.csv":
        assert (tmp_path / "two" / name).read_bytes() == (tmp_path / "one" / name).read_bytes()
    few = ["--similarity-cut", "0.4,0.5", "--vertex-price", "8,12", "--straightness", "0.02,0.035", "--seeds", "1",
           "--scans", "2", "--poses", "5"]
    runs = batch.tune([world], tmp_path / "shards", shards=2, options=few, workers=2)
    subprocess.run(["cca-mrpt-bench", "tune", world, "--out", tmp_path / "whole", *few], check=True, capture_output=True)
    assert Path(runs).read_bytes() == (tmp_path / "whole" / "runs.csv").read_bytes()


@needs_program
def test_explorations_are_those_of_the_program(tmp_path):
    runs = batch.explore(["two_rooms"], tmp_path / "out", seeds=[1, 2], strategies=["greedy"], workers=2)
    assert [run["parameters"]["run"]["seed"] for run in runs] == [1, 2]
    assert all(run["finished"] for run in runs)
    assert main(["batch", "explore", "nowhere", "--out", str(tmp_path / "none"), "--workers", "1"]) == 1
