# SPDX-License-Identifier: BSD-3-Clause
"""A log in, a map out: the pipeline of the program `cca-mrpt map`, and the map that it makes."""
from __future__ import annotations

import csv
import io
import itertools
import json
import math
import os
import sys
from collections import abc
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, NamedTuple, NoReturn, Optional, Sequence, Tuple, Union, cast

import numpy as np
from numpy.typing import NDArray

from ._core import (FARTHEST_PLAN, Estimate, LogRecord, MappingSession, PolyLine, map_logs, merge_maps, pictures_of_map, read_chains,
                    read_lines_csv, write_files_into)
from .folders import folder_of, kept_for_one_run, text_of
from .grids import Grid, read_grid
from .logs import Log, read_log
from .plotting import plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

    from .floor_plans import FloorPlan
    from .parameters import MapParameters

Source = Union[str, "os.PathLike[str]", Iterable[LogRecord]]  # of scans
POSES = ("auto", "log", "odometry", "slam")
# What a map's folder holds that Python keeps as it is; the program writes more.
FILES = ("lines.csv", "arcs.csv", "lines.geojson", "lines.svg", "lines.dxf", "map.pgm", "map.yaml", "map.png", "poses.csv",
         "poses.tum", "graph.g2o", "map.slam", "replay.html", "plan.geojson", "plan.svg", "plan.dxf", "plan.pdf", "rooms.csv",
         "rooms.png")


class MapArc(NamedTuple):
    """A round pillar or a curved wall, which its lines are the chords of."""

    centre: Tuple[float, float]  # m, map frame
    radius: float  # m
    start_angle: float  # rad, where it begins about its centre
    sweep: float  # rad, how far it goes counter-clockwise; 2 pi: a circle
    line_ids: List[int]


class Map:
    """A line map, and the drive that it was made on. It is a value: nothing changes it.

    Attributes:
        lines: structured array of dtype `MAP_LINE`, by rising id; see `LineMap.lines`.
        poly_lines: the same lines, chained where their ends meet.
        arcs: round pillars and curved walls.
        trajectory: (N, 3) poses (x, y, theta) of the robot at each scan; m, m, rad, map frame.
        times: (N,) s; numbers where the log tells no times.
        is_placed: (N,) bool: whether the place of that scan is known; others are in no map.
        summary: numbers of the run, as in summary.json.
        grid: which places are free (a `Grid`); None: nothing was seen, or the folder that it is from has no map.yaml.
        warnings: what could not be read, or was guessed; empty where all was well.
        shortcoming: why it is not the map that was asked for (the scans contradict it); empty where it is.
    """

    def __init__(self, held: Dict[str, Any], files: Dict[str, bytes], warnings: str = "") -> None:
        self.lines: NDArray[np.void] = held["lines"]
        self.poly_lines: List[PolyLine] = list(held["poly_lines"])
        self.arcs = [MapArc(*arc) for arc in held["arcs"]]
        self.trajectory: NDArray[np.float64] = held["trajectory"]
        self.times: NDArray[np.float64] = np.asarray(held["times"], dtype=float)
        self.is_placed: NDArray[np.bool_] = np.asarray(held["is_placed"], dtype=bool)
        told_numbers = held["summary"]
        self.summary: Dict[str, Any] = dict(json.loads(told_numbers) if isinstance(told_numbers, str) else told_numbers)
        self.grid: Optional[Grid] = Grid(*held["grid"]) if held.get("grid") else None
        self.warnings = warnings = "; ".join(filter(None, [warnings, held.get("warnings", "")]))
        if not self.is_placed.all():
            self.summary["unplaced_scans"] = np.flatnonzero(~self.is_placed).tolist()
        told = "; ".join(filter(None, [warnings, held.get("shortcoming", "")]))
        if told:
            self.summary["warnings"] = told
        self._files = files
        self.shortcoming: str = held.get("shortcoming", "")
        self._place: Optional[Sequence[float]] = held.get("place")  # on the Earth
        # A page of the run, packed, and where its frame lies; of a map that was loaded the files hold it.
        self._replay: Optional[Tuple[str, Tuple[float, float]]] = (held["replay"], held["frame_origin"]) if "replay" in held else None

    def save(self, folder: Union[str, "os.PathLike[str]"], force: bool = False) -> List[str]:
        """Write the map into a folder, which is made where it is missing; each file whole or not at all.

        Args:
            force: overwrite a map that is there. Only where `map` was to go on with a map, and found no place of it, the
                map.slam that is there, which may be that map's, is kept as earlier.slam.

        Returns:
            The files' names: lines.csv, arcs.csv, lines.geojson, .svg, .dxf, map.pgm and .yaml, map.png (where the
            package was built beside Cairo), poses.csv, poses.tum, of SLAM graph.g2o and map.slam, of `map`
            replay.html and the floor plan's (see `FloorPlan.save`); summary.json comes last.

        Raises:
            FileExistsError: one of them is there already, or another file of a map, which would go.
            ValueError: the folder has no name.
            OSError, RuntimeError: it cannot be written, or another run is writing there; names the file and the reason.
        """
        where, contents = folder_of(folder), dict(self._files)
        if self._replay:
            contents.update(self._pictures(self.summary.get("title") or where.resolve().name))
        names = [*contents, "summary.json"]
        with kept_for_one_run(where, [*names, *FILES], force):
            (where / "summary.json").unlink(missing_ok=True)  # it says that all is there
            if self.summary.get("found_in_memory") is False and (where / "map.slam").exists():
                kept = (where / ("earlier.slam" if k == 1 else f"earlier-{k}.slam") for k in itertools.count(1))
                (where / "map.slam").rename(next(path for path in kept if not path.exists()))
            write_files_into(os.fspath(where), contents)
            for name in set(FILES) - set(contents):  # what an earlier run left would be taken for this one's
                (where / name).unlink(missing_ok=True)
            write_files_into(os.fspath(where), {"summary.json": (json.dumps(self.summary, indent=1) + "\n").encode()})
        return names

    def _pictures(self, title: str) -> Dict[str, bytes]:
        assert self._replay is not None
        packed, frame_origin = self._replay
        cells, resolution, origin = self.grid or Grid(np.zeros((0, 0), np.uint8), 1.0, (0.0, 0.0))
        return pictures_of_map(title, self.lines_csv(), np.ascontiguousarray(self.lines["ends"]), self.poly_lines, self.trajectory,
                               np.ascontiguousarray(cells), resolution, origin, frame_origin, packed, self._place)

    def plot(self, ax: Optional[Axes] = None) -> Axes:
        """Draw lines and trajectory to scale by matplotlib: the axes."""
        return plot(self, self.trajectory if len(self.trajectory) else None, ax)

    def floor_plan(self) -> FloorPlan:
        """Rooms, openings, walls and furniture; see `cca_mrpt.floor_plan`."""
        from .floor_plans import floor_plan  # it makes maps, too

        return floor_plan(self)

    def lines_csv(self) -> str:
        """The text of lines.csv."""
        return self._files["lines.csv"].decode()

    def _repr_svg_(self) -> Optional[str]:
        svg = self._files.get("lines.svg")  # None: the folder that it is from has none
        return svg.decode() if svg else None

    def __len__(self) -> int:
        return len(self.lines)

    def __repr__(self) -> str:
        length = float(np.linalg.norm(self.lines["ends"][:, 1] - self.lines["ends"][:, 0], axis=1).sum())
        return f"Map({len(self.lines)} lines, {length:.1f} m, {len(self.trajectory)} scans)"


def _log_of(source: Source, reading: Dict[str, Any]) -> Iterable[LogRecord]:
    if isinstance(source, (str, os.PathLike)):
        return read_log(source, **{name: value for name, value in reading.items() if value is not None})
    if any(value is not None for value in reading.values()):
        raise ValueError("topic, base_frame, odom_frame, mount, upside_down: are for files")
    return source


def _sources_of(path: "Union[Source, Sequence[Source]]") -> "Sequence[Source]":
    """The logs: a list of records is one of them."""
    if isinstance(path, (list, tuple)) and path and all(isinstance(part, (str, os.PathLike, abc.Iterable)) for part in path):
        return path
    return [cast("Source", path)]


def _tell_address(url: str) -> None:
    print(f"cca_mrpt: the run can be seen at {url}", file=sys.stderr, flush=True)


def map(path: "Union[Source, Sequence[Source]]", pose: str = "auto", *,
        resume: "Optional[Union[str, os.PathLike[str]]]" = None, topic: Optional[str] = None,
        base_frame: Optional[str] = None, odom_frame: Optional[str] = None, mount: Optional[Sequence[float]] = None,
        upside_down: bool = False, origin: Optional[Sequence[float]] = None, serve: Optional[int] = None, serve_address: str = "127.0.0.1",
        until_interrupted: bool = False, **parameters: Unpack[MapParameters]) -> Map:
    """The line map of a whole log, or of several: the same as the program `cca-mrpt map` makes, byte for byte.

    Args:
        path: a log or a bag, see `read_log`; or any iterable of `LogRecord`. Or a list of those, of one place: the second
            and later ones may begin anywhere in the place of the first, whose frame stays.
        pose: where the poses come from: "log": as somebody has corrected them, else the odometry's; "odometry": the
            wheels alone; "slam": line SLAM; "auto": the log's where it has corrected ones, else SLAM. Several logs, and
            logs with `resume`, are joined by SLAM.
        resume: folder of an earlier map with a map.slam: go on with it, from anywhere in it, in its frame. Where its place
            is not found, this is the map of the log alone; `summary["found_in_memory"]` and a warning say so.
        topic, base_frame, odom_frame, mount, upside_down: of bags, see `read_log`.
        origin: (latitude, longitude, turn), degrees: where (0, 0) of the map lies, and how far its x axis is turned from
            east to the left; lines.geojson and plan.geojson are in degrees then, and the plan's sheet shows north.
        serve: a port: the map is shown in browsers as it grows, at the address that is printed on stderr. See
            `Mapper.serve`; while a viewer pauses, no scan is read.
        until_interrupted: Ctrl-C ends the reading, and the map so far is given (`summary["finished"]` is False), instead
            of KeyboardInterrupt.
        parameters: of `LineMap`.

    Raises:
        FileNotFoundError, ImportError, ValueError: as `read_log`; also where the log lacks what `pose` needs, or the
            map.slam of `resume` is missing or damaged.
    """
    if pose not in POSES:
        raise ValueError(f"pose: {pose!r} is none of {' '.join(POSES)}")
    reading = {"topic": topic, "base_frame": base_frame, "odom_frame": odom_frame, "mount": mount,
               "upside_down": upside_down or None}
    logs = [_log_of(source, reading) for source in _sources_of(path)]
    paths = [log.path if isinstance(log, Log) else "" for log in logs]
    if isinstance(serve, bool):
        raise ValueError(f"serve: a port is needed, such as 8048, not {serve}")
    page = None if serve is None else (serve_address, serve)
    if resume is not None:
        folder_of(resume)
    earlier = None if resume is None else os.fspath(resume)
    held, files = map_logs(list(zip(paths, logs)), pose, earlier, Path(paths[0] if paths and paths[0] else "scans").name, origin,
                           page, _tell_address, until_interrupted, **parameters)
    result = Map(held, files, "; ".join(log.warnings for log in logs if isinstance(log, Log) and log.warnings))
    if not len(result.trajectory):
        raise ValueError("records: no scan is among them, of which a map could be made")
    if len(paths) > 1 and all(paths):
        result.summary = {"logs": paths, **result.summary}
    elif paths[0]:
        result.summary = {"log": paths[0], **result.summary}
    return result


def merge(maps: "Sequence[Union[str, os.PathLike[str]]]", **parameters: Unpack[MapParameters]) -> Map:
    """One map of several of one place, by one robot or several: the same as `cca-mrpt merge` makes, byte for byte.

    Args:
        maps: folders that `Map.save`, or the program, has left, with SLAM's map.slam. The first one's frame stays.
        parameters: of `LineMap`.

    Raises:
        ValueError: fewer than two; a map.slam is missing or damaged; no place of one was found in the first.
    """
    folders = [os.fspath(folder) for folder in maps]
    made = Map(*merge_maps(folders, **parameters))
    made.summary = {"maps": folders, **made.summary}
    return made


class Mapper:
    """A map that grows scan by scan, with poses of its own. Where the past is corrected, the map is made anew.

    Args:
        pose: "slam", "odometry" or "log" (each record's own pose), as in `map`.
        parameters: of `LineMap`.

    May be used by several threads: their calls wait for each other.
    """

    def __init__(self, pose: str = "slam", **parameters: Unpack[MapParameters]) -> None:
        self._session = MappingSession(pose, **parameters)

    def step(self, scan: LogRecord) -> Estimate:
        """Take the next scan, and say where it was taken. Raises ValueError where it lacks what `pose` needs."""
        return self._session.step(scan)

    @property
    def lines(self) -> NDArray[np.void]:
        """The lines as they stand; see `LineMap.lines`."""
        return self._session.lines()

    def serve(self, port: int = 8048, address: str = "127.0.0.1", title: str = "Mapper") -> str:
        """Show the map in browsers as it grows: the live page of `cca-mrpt map --serve`, until the mapper goes.

        Args:
            port: of this machine; 0: any that is free.
            address: one of this machine's; at another than 127.0.0.1 who asks must know the token of the answer.
            title: for people.

        Returns:
            The page's address, to be opened in a browser. Where a viewer pauses, `step` waits until one starts it.

        Raises:
            ValueError: there is no such port.
            RuntimeError: the port is in use, the address is none of this machine's, the mapper is served already, or
                the package was built without cpp-httplib.
        """
        return self._session.serve(address, port, title)

    def map(self) -> Map:
        """The map as it stands, without a last pass."""
        return Map(*self._session.result(False))

    def finish(self) -> Map:
        """The last pass over the whole drive, and the map of what it says. No scan can follow."""
        return Map(*self._session.result(True))

    def __getstate__(self) -> NoReturn:  # copies, too: two would drive one session
        self._session.__getstate__()

    def __len__(self) -> int:
        return self._session.scans()

    def __repr__(self) -> str:
        return f"Mapper({len(self)} scans, {len(self.lines)} lines)"


def _table(text: str, path: Path, needed: Sequence[str]) -> Iterator[Dict[str, Any]]:
    """The rows of a table: finite numbers; `line_ids` a list of them."""
    reader = csv.DictReader(io.StringIO(text))
    missing = set(needed) - set(reader.fieldnames or ())
    if missing:
        raise ValueError(f"{path}: is no file of a map: no column {min(missing)}")
    for row in reader:
        try:
            if None in row or None in row.values():
                raise ValueError(f"{len(reader.fieldnames or ())} values are needed")
            numbers: Dict[str, Any] = {name: float(row[name]) for name in needed if name != "line_ids"}
            if not all(abs(number) <= (FARTHEST_PLAN if name in "xy" else sys.float_info.max) for name, number in numbers.items()):
                raise ValueError("finite numbers are needed, and places within 1e8 m")
            if "line_ids" in needed:
                numbers["line_ids"] = [int(name) for name in row["line_ids"].split()]
        except ValueError as error:
            raise ValueError(f"{path}, line {reader.line_num}: is damaged: {error}") from None
        yield numbers


def _summary_of(path: Path) -> Dict[str, Any]:
    try:
        summary = json.loads(text_of(path))
    except json.JSONDecodeError as error:
        raise ValueError(f"{path}: is damaged: no JSON ({error})") from None
    unplaced = summary.get("unplaced_scans", []) if isinstance(summary, dict) else None
    if not isinstance(unplaced, list) or not all(isinstance(number, int) for number in unplaced):
        raise ValueError(f"{path}: is no summary of a map")
    return cast("Dict[str, Any]", summary)


def load(folder: Union[str, "os.PathLike[str]"]) -> Map:
    """Read the folder of a map back, whoever has written it: `Map.save`, or the program.

    Numbers are those of the files: ends to .1 mm; covariances without their mixed term.

    Raises:
        FileNotFoundError, NotADirectoryError: there is no map.
        ValueError: a file of it is damaged; names it and the reason.
    """
    where = folder_of(folder)
    if where.exists() and not where.is_dir():
        raise NotADirectoryError(f"{where}: is no folder of a map")
    if not (where / "lines.csv").exists():
        raise FileNotFoundError(f"{where / 'lines.csv'}: no such file")
    files = {name: (where / name).read_bytes() for name in FILES if (where / name).exists()}
    text = {name: text_of(where / name) for name in files if name.endswith((".csv", ".geojson", ".svg"))}
    held: Dict[str, Any] = {"lines": read_lines_csv(text["lines.csv"], str(where / "lines.csv")), "poly_lines": [], "arcs": [],
                            "summary": {}}
    if "lines.geojson" in text:
        held["poly_lines"] = read_chains(text["lines.geojson"], str(where / "lines.geojson"))
    if "arcs.csv" in text:
        columns = "x", "y", "radius", "start_deg", "sweep_deg", "line_ids"
        held["arcs"] = [MapArc((row["x"], row["y"]), row["radius"], math.radians(row["start_deg"]), math.radians(row["sweep_deg"]),
                               row["line_ids"]) for row in _table(text["arcs.csv"], where / "arcs.csv", columns)]
    if (where / "summary.json").exists():
        held["summary"] = _summary_of(where / "summary.json")
    else:
        held["warnings"] = "summary.json is missing: the folder may hold half of a map"
    poses = list(_table(text["poses.csv"], where / "poses.csv", ("stamp", "x", "y", "theta"))) if "poses.csv" in text else []
    held["trajectory"] = np.array([[row["x"], row["y"], row["theta"]] for row in poses]).reshape(-1, 3)
    held["times"] = [row["stamp"] for row in poses]
    held["grid"] = read_grid(where)
    unplaced = set(held["summary"].get("unplaced_scans", ()))
    held["is_placed"] = [k not in unplaced for k in range(len(poses))]
    return Map(held, files)
