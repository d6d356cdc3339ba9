# SPDX-License-Identifier: BSD-3-Clause
"""The command line: python -m cca_mrpt map LOG, merge MAP MAP, evaluate MAP, localize LOG, plan FOLDER, render FOLDER, info LOG, and batch."""
from __future__ import annotations

import argparse
import math
import os
import re
import sys
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from ._core import origin_of, version, write_files_into
from .evaluation import evaluation_json
from .floor_plans import floor_plan
from .folders import require_writable
from .localisation import localize, require_no_map
from .logs import read_log
from .maps import FILES, POSES, Map, merge
from .maps import map as map_log
from .replays import replay_page

FELL_SHORT = 3
STATUSES = """exit status: 0 done; 1 failed, or interrupted; 2 no such command or option, or a value that is not allowed; 3 done,
but the result falls short, as the last message says (scans that contradict the map, a robot that was localised nowhere)"""


class Shortcoming(Exception):
    """What was asked for is done and saved, but is not what it should be."""


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


def require_sound(result: Any, out: Path, what: str) -> None:
    """Say how the saved result falls short. `what` is a sentence with a place for "so far"."""
    if not result.summary.get("finished", True):
        raise RuntimeError(f"interrupted after {result.summary['scans']} scans; {what.format(' so far')} in {out}")
    if result.shortcoming:
        raise Shortcoming(f"{result.shortcoming}; {what.format('')} in {out}")


def save_map(made: Map, out: Path, options: argparse.Namespace, told: str) -> str:
    made.save(out, force=options.force)
    if not options.quiet:
        print(f"{told}; {out} holds the map")
    require_sound(made, out, "the map{} is")
    return ""


def run_map(options: argparse.Namespace) -> str:
    """Write the line map of a log into a folder; what was done, in a sentence."""
    first = options.logs[0]
    out = options.out or Path("out") / Path(first).name.split(".")[0]
    require_writable(out, [*FILES, "summary.json"], options.force)
    made = map_log(options.logs, options.pose, resume=options.resume, origin=options.origin, serve=options.serve,
                   serve_address=options.serve_address, until_interrupted=True, **reading_of(options))
    if made.warnings:
        print(f"{first}: {made.warnings}", file=sys.stderr)
    return save_map(made, out, options, f"{len(made)} lines from {len(made.trajectory)} scans over "
                                        f"{made.summary['distance_m']:.1f} m, poses by {made.summary['pose']}")


def run_merge(options: argparse.Namespace) -> str:
    """Write one map of several; what was done, in a sentence."""
    if len(options.maps) < 2:
        raise Usage("MAP: two or more are needed")
    require_writable(options.out, [*FILES, "summary.json"], options.force)
    made = merge(options.maps)
    return save_map(made, options.out, options, f"{len(made)} lines from {len(options.maps)} maps, "
                                                f"{made.summary['loops']} loops between and within them")


def run_localize(options: argparse.Namespace) -> str:
    """Write where a log was taken in a plan; what was done, in a sentence."""
    require_no_map(options.out, options.force)
    found = localize(read_log(options.log, **reading_of(options)), options.plan, options.start, options.scale,
                     until_interrupted=True)
    if found.warnings:
        print(f"{options.log}: {found.warnings}", file=sys.stderr)
    found.save(options.out, force=options.force)
    if not options.quiet:
        print(f"{len(found)} of {found.summary['scans']} scans localised, lost {found.summary['lost_times']} time(s); "
              f"{options.out} holds the poses")
    require_sound(found, options.out, "the poses{} are")
    return ""


def run_render(options: argparse.Namespace) -> str:
    """Write the page that replays a run."""
    run = Path(options.run)
    out: Optional[Path] = options.out
    if out is None and run.is_dir() and options.beside is None:
        out = run / "replay.html"
    if out is None or out.suffix != ".html":
        raise Usage("--out: a page that ends in .html is needed")
    is_made_anew = options.out is None
    require_writable(out.parent, [out.name], options.force or is_made_anew)
    write_files_into(str(out.parent), {out.name: replay_page(run, options.beside).encode()})
    return f"{out} replays the run"


def run_plan(options: argparse.Namespace) -> str:
    """Write the floor plan of a map; what was done, in a sentence."""
    out = options.out or Path(options.map)
    plan = floor_plan(options.map, options.labels)
    names = plan.save(out, force=options.force, origin=options.origin)
    for (x, y), name in plan.labels_outside:
        print(f"cca_mrpt: {options.labels}: ({x:.6g}, {y:.6g}), {name}, lies in no room", file=sys.stderr)
    if not options.quiet:
        area = sum(room.area for room in plan.rooms)
        doors = sum(opening.kind == "door" for opening in plan.openings)
        print(f"{len(plan.rooms)} rooms, {area:.1f} m^2 of floor, {doors} doors, {len(plan.openings) - doors} other openings, "
              f"{len(plan.walls)} walls; {out} holds {', '.join(names)}")
    if not plan.rooms:
        raise Shortcoming(f"{options.map}: no room was found in this map")
    if plan.labels_outside:
        raise Shortcoming(f"{len(plan.labels_outside)} labels lie in no room")
    return ""


def run_evaluate(options: argparse.Namespace) -> str:
    """Print, or write, how good a map is."""
    if options.out is not None:
        require_writable(options.out.parent, [options.out.name], options.force)
    figures = evaluation_json(options.map, options.log, options.world)
    if options.out is None:
        return figures.rstrip("\n")
    write_files_into(str(options.out.parent), {options.out.name: figures})
    return ""


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
    command.add_argument("--out", type=parse_folder, required=True, help="folder to write to, one folder a job in it")
    command.add_argument("--workers", type=int, help="processes on this machine (default: one a core)")
    command.add_argument("--scheduler", help="address of a cluster's scheduler, e.g. tcp://HOST:8786")
    command.add_argument("--seeds", type=int, nargs="+", default=[1], help="explore: FIRST [LAST]")
    command.add_argument("--strategies", nargs="+", default=["view_tour"], help="explore: how goals are chosen")
    command.add_argument("--program", default="cca-mrpt", help="explore: the program, on the workers")


class Usage(Exception):
    """A value that is not allowed."""


def in_words(error: Exception) -> str:
    """An error as the program tells it: the file first."""
    if isinstance(error, OSError) and error.filename and error.strerror:
        return f"{error.filename}: {error.strerror}"
    return str(error).replace("(force=True overwrites it)", "(--force overwrites it)")


def told(work: Callable[[], str]) -> int:
    """Do it and say what was done, or what is wrong; the exit status."""
    try:
        done = work()
        if done:
            print(done)
    except Usage as error:
        print(f"cca_mrpt: {error}", file=sys.stderr)
        return 2
    except Shortcoming as error:
        print(f"cca_mrpt: {error}", file=sys.stderr)
        return FELL_SHORT
    except (OSError, ValueError, RuntimeError, ImportError) as error:
        print(f"cca_mrpt: {in_words(error)}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("cca_mrpt: interrupted; each file that was written is whole", file=sys.stderr)
        return 1
    return 0


def with_output(status: int) -> int:
    """What was printed may not have arrived: a full disk behind `> FILE` is told at the end only."""
    try:
        sys.stdout.flush()
    except OSError as error:
        print(f"cca_mrpt: standard output: {error.strerror}", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # it is flushed once more when Python ends
        return status or 1
    return status


def parse_start(text: str) -> Tuple[float, float, float]:
    """X,Y,DEG."""
    try:
        x, y, degrees = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: X,Y,DEG is needed") from None
    return x, y, math.radians(degrees)


def parse_origin(text: str) -> Tuple[float, float, float]:
    """LAT,LON or LAT,LON,DEG."""
    try:
        return origin_of(text)
    except RuntimeError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def parse_scale(text: str) -> float:
    try:
        scale = float(text)
    except ValueError:
        scale = math.nan
    if not 1e-6 <= scale <= 1e6:
        raise argparse.ArgumentTypeError(f"{text!r}: metres in [1e-6, 1e6] are needed")
    return scale


def parse_folder(text: str) -> Path:
    """An empty one would be the folder that one is in: a shell variable that was never set."""
    if not text:
        raise argparse.ArgumentTypeError("is empty")
    return Path(text)


def parse_port(text: str) -> int:
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r}: a port in [0, 65535] is needed")
    return int(text)


def add_log(command: argparse.ArgumentParser, many: bool = False) -> None:
    what = "CARMEN .log, CSV, CoreSLAM .dat, csm .json, ROS .bag, .db3, .mcap or a folder of ROS 2"
    if many:
        command.add_argument("logs", metavar="LOG", nargs="+",
                             help=what + "; of several, each may begin anywhere in the same place")
    else:
        command.add_argument("log", metavar="LOG", help=what)
    command.add_argument("--topic", help="bags: of the scans (default: the one with most of them)")
    command.add_argument("--base-frame", help="bags: the robot's frame")
    command.add_argument("--odom-frame", help="bags: the frame of the robot's odometry")
    command.add_argument("--mount", type=parse_mount, metavar="X,Y,YAW_DEG[,upside-down]",
                         help="bags: how the laser stands on the robot, where tf does not tell it")


def add_output(command: argparse.ArgumentParser, required: bool, what: str) -> None:
    command.add_argument("--out", type=parse_folder, required=required, help=f"folder to write {what} to"
                         + ("" if required else " (default: out/NAME_OF_LOG)"))
    command.add_argument("--force", action="store_true", help="overwrite what is there")
    command.add_argument("--quiet", action="store_true", help="print nothing but errors")


def add_origin(command: argparse.ArgumentParser, what: str) -> None:
    command.add_argument("--origin", type=parse_origin, metavar="LAT,LON[,DEG]",
                         help="where (0, 0) of the map lies, and how far its x axis is turned from east to the left, "
                         f"degrees: {what} in longitude and latitude then")


def add_commands(commands: Any) -> None:
    add_log(commands.add_parser("info", help="what is in a log"))
    command = commands.add_parser("localize", help="poses of a log in a finished map or a drawn plan")
    add_log(command)
    command.add_argument("--in", dest="plan", metavar="PLAN", required=True,
                         help="a map's folder, its lines.csv or map.slam; .geojson, .dxf, .svg; .yaml of map_server")
    command.add_argument("--start", type=parse_start, metavar="X,Y,DEG",
                         help="where the log begins, to half a metre and 15 degrees (default: anywhere)")
    command.add_argument("--scale", type=parse_scale, metavar="METRES", default=0.0, help="metres of a unit of the drawing or .csv (default: as it tells)")
    add_output(command, True, "the poses")
    command = commands.add_parser("map", help="line map of a whole log, or of several")
    add_log(command, many=True)
    command.add_argument("--pose", default="auto", choices=POSES,
                         help="where the poses come from (auto: the log's own where it has corrected ones, else SLAM)")
    command.add_argument("--resume", metavar="DIR", help="an earlier map: go on with it, from anywhere in it")
    add_origin(command, "lines.geojson and plan.geojson are")
    add_output(command, False, "the map")
    command.add_argument("--serve", type=parse_port, nargs="?", const=8048, metavar="PORT",
                         help="show the map in browsers as it grows, at this port [8048]; 0: any free")
    command.add_argument("--serve-address", default="127.0.0.1", metavar="ADDR",
                         help="serve at another address of this machine: who asks must know a random token then")
    command = commands.add_parser("merge", help="maps of one place, by one robot or several, become one")
    command.add_argument("maps", metavar="MAP", nargs="+", help="folders with a map.slam; the first one's frame stays")
    add_output(command, True, "the map")
    command = commands.add_parser("evaluate", help="quality of a line map against its scans, or the true world")
    command.add_argument("map", metavar="MAP", help="line map, CSV x1,y1,x2,y2,..., or its folder")
    against = command.add_mutually_exclusive_group(required=True)
    against.add_argument("--log", help="the laser log that the map was made from")
    against.add_argument("--world", help="the world; NAME.truth.csv stands beside it")
    command.add_argument("--out", type=parse_folder, help="JSON file to write; default: standard output")
    command.add_argument("--force", action="store_true", help="overwrite that file")
    command = commands.add_parser("plan", help="floor plan of a finished map: rooms with areas, walls, doors, furniture")
    command.add_argument("map", metavar="DIR", help="folder that map, explore or merge left")
    command.add_argument("--out", type=parse_folder, help="folder to write the plan to (default: DIR)")
    command.add_argument("--labels", metavar="FILE", help="CSV with columns x, y (m, map frame) and name: names the rooms")
    add_origin(command, "plan.geojson is")
    command.add_argument("--force", action="store_true", help="overwrite a plan that is there")
    command.add_argument("--quiet", action="store_true", help="print nothing but errors")
    command = commands.add_parser("render", help="a page to replay a run in, from its folder's replay.html")
    command.add_argument("run", metavar="DIR", help="folder of a run, or its page")
    command.add_argument("--html", action="store_true", help="as the program calls it; there is nothing else here")
    command.add_argument("--beside", metavar="DIR", help="folder of a second run, to be seen beside it")
    command.add_argument("--out", type=parse_folder, help="page to write (default: the folder's replay.html)")
    command.add_argument("--force", action="store_true", help="overwrite what --out names")
    add_batch(commands)


def _with_places_told(words: Sequence[str]) -> List[str]:
    """`--start -1,0,90` as `--start=-1,0,90`: argparse takes what begins so for an option."""
    told: List[str] = []
    for word in words:
        if told and told[-1] in ("--start", "--mount", "--origin") and re.match(r"-[\d.]", word):
            told[-1] += "=" + word
        else:
            told.append(word)
    return told


def main(arguments: Optional[Sequence[str]] = None) -> int:
    parser = argparse.ArgumentParser(prog="cca-mrpt", description="line maps of laser logs", epilog=STATUSES)
    parser.add_argument("--version", action="version", version=f"cca-mrpt {version}")
    add_commands(parser.add_subparsers(dest="command", required=True))
    options = parser.parse_args(_with_places_told(sys.argv[1:] if arguments is None else arguments))
    run = {"batch": run_batch, "map": run_map, "evaluate": run_evaluate, "info": run_info, "localize": run_localize, "merge": run_merge,
           "plan": run_plan, "render": run_render}[options.command]
    return with_output(told(lambda: run(options)))


if __name__ == "__main__":
    sys.exit(main())
