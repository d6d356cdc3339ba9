# SPDX-License-Identifier: BSD-3-Clause
"""Many logs to map, many explorations to run, on the cores of one machine or on a cluster, through Dask.

Each job writes a folder of its own, which appears whole: it is written beside it and renamed. A job whose
folder is there already is not done again. So a worker that is killed loses nothing: Dask gives its job to
another one, and a batch that was stopped goes on where it was. Results stand in the order of the jobs and
do not depend on how many workers there are.

Needs `dask.distributed` (`pip install 'cca-mrpt[batch]'`). On a cluster, workers and caller see the same files.
"""
from __future__ import annotations

import glob
import json
import os
import shutil
import subprocess
import uuid
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Union

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .parameters import MapParameters

PathLike = Union[str, "os.PathLike[str]"]
Result = Dict[str, Any]

SUMMARY = "summary.json"


def _make_whole(folder: str, fill: Callable[[Path], None]) -> None:
    """Let fill(path) make a folder, where it is not there yet."""
    done = Path(folder)
    if done.exists():
        return
    part = done.with_name(f"{done.name}.part-{uuid.uuid4().hex}")
    try:
        fill(part)
        os.rename(part, done)
    except OSError:  # another worker was first: Dask may give a job to two of them
        if not done.exists():
            raise
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _summary(folder: str) -> Result:
    summary: Result = json.loads((Path(folder) / SUMMARY).read_text())
    return summary


def _map_job(job: Tuple[str, str, MapParameters]) -> Result:
    log, folder, parameters = job
    from .maps import map as map_log

    def fill(part: Path) -> None:
        made = map_log(log, **parameters)
        made.summary["parameters"] = parameters
        made.save(part)

    try:
        _make_whole(folder, fill)
        return {**_summary(folder), "folder": folder}
    except (OSError, ValueError, RuntimeError) as error:
        return {"log": log, "folder": folder, "error": str(error)}


def _call(arguments: Sequence[str]) -> None:
    """Run a program; what it complains about is raised."""
    run = subprocess.run(arguments, capture_output=True, text=True)
    if run.returncode not in (0, 3):  # 3: done, and short of something that summary.json tells
        raise RuntimeError(run.stderr.strip() or f"{arguments[0]}: exit status {run.returncode}")


def _program_job(job: Tuple[List[str], str]) -> Optional[str]:
    """Let the program write a folder; what went wrong."""
    arguments, folder = job
    try:
        _make_whole(folder, lambda part: _call([*arguments, "--out", str(part)]))
    except (OSError, RuntimeError) as error:
        return str(error)
    return None


def _run_all(jobs: Sequence[Tuple[List[str], str]], workers: Optional[int], scheduler: Optional[str]) -> None:
    """Program jobs that are of no use one by one. @raises RuntimeError: naming the first that failed."""
    for (_, folder), error in zip(jobs, _run(_program_job, jobs, workers, scheduler)):
        if error:
            raise RuntimeError(f"{folder}: {error}")


def _clear_parts(folders: Iterable[str]) -> None:
    """What killed workers left of folders that have all been made, or have failed, by now."""
    for folder in folders:
        for part in glob.glob(glob.escape(folder) + ".part-*"):
            shutil.rmtree(part, ignore_errors=True)


def _run(work: Callable[[Any], Any], jobs: Sequence[Tuple[Any, ...]], workers: Optional[int],
         scheduler: Optional[str]) -> List[Any]:
    """[work(job) for job in jobs], by Dask; a job's second item is its folder."""
    from dask import config
    from distributed import Client, LocalCluster

    # A worker that dies takes nothing with it, however often that happens to the same job.
    with config.set({"distributed.scheduler.allowed-failures": 100}):
        cluster: Any = scheduler or LocalCluster(  # type: ignore[no-untyped-call]
            n_workers=workers or os.cpu_count(), threads_per_worker=1, dashboard_address=None)
        try:
            with Client(cluster) as client:  # type: ignore[no-untyped-call]
                results: List[Any] = client.gather(client.map(work, jobs, pure=False, retries=100, batch_size=len(jobs) or None))
        finally:
            if not scheduler:
                cluster.close()
    _clear_parts(job[1] for job in jobs)
    return results


def _place(world: PathLike) -> str:
    """A path that holds wherever a worker runs; names of the program's own worlds stay."""
    return str(Path(world).resolve()) if Path(world).exists() else str(world)


def _folders(out: PathLike, names: Sequence[str]) -> List[str]:
    if len(set(names)) != len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"jobs: two of them would write to {twice}")
    Path(out).mkdir(parents=True, exist_ok=True)
    return [str(Path(out).resolve() / name) for name in names]


def map_logs(logs: Iterable[PathLike], out: PathLike, *, workers: Optional[int] = None,
             scheduler: Optional[str] = None, **parameters: Unpack[MapParameters]) -> List[Result]:
    """Map CARMEN logs, each into a folder of `out` that bears its name.

    Args:
        logs: paths.
        out: folder to write to.
        workers: number of processes on this machine (default: one a core); no matter where there is a scheduler.
        scheduler: address of a cluster's scheduler, "tcp://HOST:8786"; None: this machine.
        parameters: of `LineMap`.

    Returns:
        A dict a log, in their order: its summary ("log", "scans", "map_lines" and others) and "folder"; or "error".
    """
    paths = [str(Path(log).resolve()) for log in logs]
    folders = _folders(out, [Path(path).name.split(".")[0] for path in paths])
    return _run(_map_job, [(path, folder, parameters) for path, folder in zip(paths, folders)], workers, scheduler)


def explore(worlds: Sequence[PathLike], out: PathLike, *, seeds: Iterable[int] = (1,),
            strategies: Sequence[str] = ("view_tour",), options: Sequence[str] = (), program: str = "cca-mrpt",
            workers: Optional[int] = None, scheduler: Optional[str] = None) -> List[Result]:
    """Explore worlds in simulation: each world by each strategy with each seed, by the program `cca-mrpt`.

    Args:
        worlds: map_server YAML files, or names of the worlds that come with the program.
        out: folder to write to; a run stands in WORLD-STRATEGY-SEED.
        options: further options of `cca-mrpt explore`, e.g. ("--pose", "slam").
        program: where the program is, on the workers.
        workers, scheduler: as in `map_logs`.

    Returns:
        A dict a run, in order of worlds, strategies and seeds: its summary.json and "folder"; or "error".
    """
    runs = [(os.fspath(world), strategy, seed) for world in worlds for strategy in strategies for seed in seeds]
    folders = _folders(out, [f"{Path(world).stem}-{strategy}-{seed}" for world, strategy, seed in runs])
    jobs = [([program, "explore", _place(world), "--quiet", "--strategy", strategy, "--seed", str(seed), *options], folder)
            for (world, strategy, seed), folder in zip(runs, folders)]
    errors = _run(_program_job, jobs, workers, scheduler)
    return [{"world": world, "folder": folder, "error": error} if error else {**_summary(folder), "folder": folder}
            for (world, _, _), folder, error in zip(runs, folders, errors)]


def compare_strategies(worlds: Sequence[PathLike], out: PathLike, *,
                       strategies: Sequence[str] = ("view_tour", "greedy", "nearest_frontier", "gain_distance",
                                                    "information"), starts: int = 3, program: str = "cca-mrpt-bench",
                       workers: Optional[int] = None, scheduler: Optional[str] = None) -> str:
    """`cca-mrpt-bench compare-strategies`, a job for each world and strategy.

    Args:
        worlds: map_server YAML files.
        out: folder for runs.csv and curves.csv, byte for byte those of the program alone.
        starts: number of them in each world.
        program: where `cca-mrpt-bench` is, on the workers.
        workers, scheduler: as in `map_logs`.

    Returns:
        The path of runs.csv.

    Raises:
        RuntimeError: a job failed.
    """
    pairs = [(world, strategy) for world in worlds for strategy in strategies]
    folders = _folders(out, [f"{Path(world).stem}-{strategy}" for world, strategy in pairs])
    _run_all([([program, "compare-strategies", _place(world), "--strategies", strategy, "--starts", str(starts)], folder)
              for (world, strategy), folder in zip(pairs, folders)], workers, scheduler)
    for name in "runs.csv", "curves.csv":
        texts = [(Path(folder) / name).read_text().split("\n", 1) for folder in folders]
        (Path(out) / name).write_text(texts[0][0] + "\n" + "".join(rows for _, rows in texts))
    return str(Path(out) / "runs.csv")


def tune(worlds: Sequence[PathLike], out: PathLike, *, shards: int = 16, options: Sequence[str] = (),
         program: str = "cca-mrpt-bench", workers: Optional[int] = None, scheduler: Optional[str] = None) -> str:
    """`cca-mrpt-bench tune`, the factorial experiment over the three input parameters, in shards.

    Args:
        worlds: map_server YAML files with their true segments beside them.
        out: folder for the rows of all shards and runs.csv, byte for byte that of the program alone.
        shards: number of jobs.
        options: further options of `cca-mrpt-bench tune`, e.g. ("--seeds", "4").
        program: where `cca-mrpt-bench` is, on the workers.
        workers, scheduler: as in `map_logs`.

    Returns:
        The path of runs.csv, which benchmarks/scripts/tuning_report.py analyses.

    Raises:
        RuntimeError: a job failed.
    """
    common = [program, "tune", *map(_place, worlds), *options]
    folders = _folders(out, [f"shard-{k}-of-{shards}" for k in range(1, shards + 1)])
    _run_all([([*common, "--threads", "1", "--shard", f"{k}/{shards}"], folder)
              for k, folder in enumerate(folders, 1)], workers, scheduler)
    for folder in folders:
        for rows in Path(folder).glob("rows-*.csv"):
            shutil.copy(rows, out)
    _call([*common, "--merge", "--out", str(out)])
    return str(Path(out) / "runs.csv")
