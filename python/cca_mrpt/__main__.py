# SPDX-License-Identifier: BSD-3-Clause
"""The command line: python -m cca_mrpt map LOG [--out FOLDER], info LOG, and batch for many logs or worlds."""
from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from .logs import read_log
from .maps import POSES
from .maps import map as map_log


def parse_mount(text: str) -> Tuple[Tuple[float, float, float], bool]:
    """X,Y,YAW_DEG or X,Y,YAW_DEG,upside-down."""
    parts = text.split(",")
    upside_down = parts[3:] == ["upside-down"]
    try:
        if len(parts) != 3 and not upside_down:
            raise ValueError
        x, y, degrees = (float(part) for part in parts[:3])
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: X,Y,YAW_DEG is needed, or X,Y,YAW_DEG,upside-down") from None
    return (x, y, math.radians(degrees)), upside_down


def reading_of(options: argparse.Namespace) -> Dict[str, Any]:
    mount, upside_down = options.mount or (None, False)
    return dict(topic=options.topic, base_frame=options.base_frame, odom_frame=options.odom_frame, mount=mount,
                upside_down=upside_down)


def run_map(options: argparse.Namespace) -> str:
    """Write the line map of a log into a folder; what was done, in a sentence."""
    out = options.out or Path("out") / Path(options.log).name.split(".")[0]
    if (out / "lines.csv").exists() and not options.force:
        raise FileExistsError(f"{out / 'lines.csv'}: is there already (--force overwrites it)")
    made = map_log(options.log, options.pose, **reading_of(options))
    if made.warnings:
        print(f"{options.log}: {made.warnings}", file=sys.stderr)
    made.save(out, force=options.force)
    return (f"{len(made)} lines from {len(made.trajectory)} scans over {made.summary['distance_m']:.1f} m, "
            f"poses by {made.summary['pose']}; {out} holds the map")


def run_info(options: argparse.Namespace) -> str:
    """What is in a log, in sentences."""
    log = read_log(options.log, **reading_of(options))
    scans = beams = wheels = corrected = 0
    times: List[float] = []
    for scan in log:
        scans, beams = scans + 1, beams + len(scan)
        wheels, corrected = wheels + (scan.odometry is not None), corrected + (scan.robot_pose is not None)
        times.append(scan.time)
    told = [f"{options.log}: {scans} scans, {beams / scans:.0f} beams each, over {max(times) - min(times):.1f} s",
            f"odometry for {wheels} scans, corrected poses for {corrected}"]
    return "\n".join(told + ([log.warnings] if log.warnings else []))


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
    map_command = commands.add_parser("map", help="line map of a whole log")
    map_command.add_argument("--out", type=Path, help="folder to write to (default: out/NAME_OF_LOG)")
    map_command.add_argument("--pose", default="auto", choices=POSES,
                             help="where the poses come from (auto: the log's own where it has corrected ones, else SLAM)")
    map_command.add_argument("--force", action="store_true", help="overwrite a map that is there")
    for command in map_command, commands.add_parser("info", help="what is in a log"):
        command.add_argument("log", metavar="LOG", help="CARMEN .log, ROS .bag, .db3, .mcap or a folder of ROS 2")
        command.add_argument("--topic", help="bags: of the scans (default: the one with most of them)")
        command.add_argument("--base-frame", help="bags: the robot's frame")
        command.add_argument("--odom-frame", help="bags: the frame of the robot's odometry")
        command.add_argument("--mount", type=parse_mount, metavar="X,Y,YAW_DEG[,upside-down]",
                             help="bags: how the laser stands on the robot, where tf does not tell it")
    add_batch(commands)
    options = parser.parse_args(arguments)
    run = {"batch": run_batch, "map": run_map, "info": run_info}[options.command]
    return told(lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
