# SPDX-License-Identifier: BSD-3-Clause
"""The command line: python -m cca_mrpt map LOG [--out FOLDER], and batch for many logs or worlds."""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any, Callable, List, Optional, Sequence, Tuple

from . import LineMap, read_log
from ._core import write_files_into


def write_map(out: Path, line_map: LineMap, trajectory: List[Tuple[float, float, float]]) -> None:
    """Write the files of a line map into a folder."""
    write_files_into(
        str(out),
        {
            "lines.csv": line_map.to_csv(),
            "lines.geojson": line_map.to_geojson(trajectory),
            "lines.svg": line_map.to_svg(trajectory),
        },
    )


def map_log(log: str, out: Path) -> str:
    """Write the line map of a log into a folder; what was done, in a sentence."""
    line_map = LineMap()
    trajectory = []
    scans = read_log(log)
    for scan in scans:
        line_map.insert(scan.ranges, scan.angle_min, scan.angle_increment, scan.pose)
        trajectory.append(scan.pose)
    if scans.warnings:
        print(f"{log}: {scans.warnings}", file=sys.stderr)
    write_map(out, line_map, trajectory)
    return f"{len(line_map.lines())} lines from {len(trajectory)} scans; lines.csv, .geojson and .svg are in {out}"


def run_batch(options: argparse.Namespace) -> str:
    """Map or explore all that the command line names; what was done, in a sentence."""
    from . import batch

    where: Any = dict(workers=options.workers, scheduler=options.scheduler)
    if options.what == "map":
        results = batch.map_logs(options.jobs, options.out, **where)
    else:
        seeds = range(options.seeds[0], options.seeds[-1] + 1)
        results = batch.explore(options.jobs, options.out, seeds=seeds, strategies=options.strategies,
                                program=options.program, **where)
    failed = [result for result in results if "error" in result]
    for result in failed:
        print(f"{result['folder']}: {result['error']}", file=sys.stderr)
    if failed:
        raise RuntimeError(f"{len(failed)} of {len(results)} failed; the others are in {options.out}")
    return f"{len(results)} done, in {options.out}"


def add_batch(commands: Any) -> None:
    command = commands.add_parser("batch", help="many logs or worlds, on all cores or a Dask cluster")
    command.add_argument("what", choices=["map", "explore"])
    command.add_argument("jobs", metavar="LOG|WORLD", nargs="+")
    command.add_argument("--out", required=True, help="folder to write to, one folder a job in it")
    command.add_argument("--workers", type=int, help="processes on this machine (default: one a core)")
    command.add_argument("--scheduler", help="address of a cluster's scheduler, e.g. tcp://HOST:8786")
    command.add_argument("--seeds", type=int, nargs="+", default=[1], help="explore: FIRST [LAST]")
    command.add_argument("--strategies", nargs="+", default=["view_tour"], help="explore: how goals are chosen")
    command.add_argument("--program", default="cca-mrpt", help="explore: the program, on the workers")


def told(work: Callable[[], str]) -> int:
    """Do it and say what was done, or what is wrong; the exit status."""
    try:
        print(work())
    except (OSError, ValueError, RuntimeError, ImportError) as error:
        print(f"cca_mrpt: {error}", file=sys.stderr)
        return 1
    return 0


def main(arguments: Optional[Sequence[str]] = None) -> int:
    parser = argparse.ArgumentParser(prog="cca-mrpt", description="line maps of laser logs")
    commands = parser.add_subparsers(dest="command", required=True)
    map_command = commands.add_parser("map", help="line map of a whole CARMEN log")
    map_command.add_argument("log", metavar="LOG", help="CARMEN .log or .log.gz with corrected poses")
    map_command.add_argument("--out", type=Path, help="folder to write to (default: out/NAME_OF_LOG)")
    add_batch(commands)
    options = parser.parse_args(arguments)
    if options.command == "batch":
        return told(lambda: run_batch(options))
    out = options.out or Path("out") / Path(options.log).name.split(".")[0]
    return told(lambda: map_log(options.log, out))


if __name__ == "__main__":
    sys.exit(main())
