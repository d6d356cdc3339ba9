# SPDX-License-Identifier: BSD-3-Clause
"""Rooms, doors and walls of a map: what the program `cca-mrpt plan` makes."""
from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from ._core import floor_plan_files, floor_plan_geojson, title_of_folder, write_plan_files
from .folders import folder_of, text_of
from .grids import Grid
from .maps import Map, load

Point = Tuple[float, float]  # m, map frame


class Room(NamedTuple):
    """Floor between the faces of walls, and the openings to other rooms."""

    id: int
    outline: List[Point]  # counter-clockwise, the first point once
    holes: List[List[Point]]  # clockwise
    area: float  # m^2, without the holes
    perimeter: float  # m
    unseen_area: float  # m^2 of the area that no beam has crossed: under furniture
    open_border: float  # m of the border that is neither wall nor opening: where the map ends
    label: Point  # well inside
    name: str = ""  # as a label has named it


class Opening(NamedTuple):
    """Where one room opens into another."""

    id: int
    kind: str  # "door" up to 1.4 m, "passage" up to 2.5 m, "wide"
    jambs: Tuple[Point, Point]
    width: float  # m
    rooms: Tuple[int, int]


class Wall(NamedTuple):
    """A straight wall: its centre line; of one that was seen from one side only, that face."""

    id: int
    start: Point
    end: Point
    thickness: Optional[float]  # m; None: one face only
    line_ids: Tuple[List[int], List[int]]  # of the map's lines, on its left and on its right
    is_presumed: bool  # behind furniture


class Furniture(NamedTuple):
    """An obstacle that is no part of the building."""

    id: int
    outline: List[Point]
    is_leaning: bool  # on a wall
    room: Optional[int]


def _ring(points: List[List[float]]) -> List[Point]:
    return [(x, y) for x, y in points[:-1]]


class FloorPlan:
    """The floor plan of a map. `geopandas.GeoDataFrame.from_features(plan)` takes it as it is.

    Attributes:
        rooms, openings, walls, furniture: lists; ids count from 1 within each.
        labels_outside: ((x, y), name) of the labels that lie in no room.
    """

    def __init__(self, source: "_Source", labels: Optional[Tuple[str, str]]) -> None:
        self._source, self._labels = source, labels
        lines_csv, (cells, resolution, origin), grid_name, _ = source
        geojson, outside = floor_plan_geojson(lines_csv, cells, resolution, origin, grid_name, labels[0] if labels else None,
                                              labels[1] if labels else "")
        self._geojson = geojson
        self.labels_outside: List[Tuple[Point, str]] = [((x, y), name.decode(errors="replace")) for x, y, name in outside]
        self.rooms: List[Room] = []
        self.openings: List[Opening] = []
        self.walls: List[Wall] = []
        self.furniture: List[Furniture] = []
        for feature in json.loads(geojson)["features"]:
            self._add(feature["properties"], feature["geometry"]["coordinates"])

    def _add(self, of: Dict[str, Any], at: List[Any]) -> None:
        if of["kind"] == "room":
            self.rooms.append(Room(of["id"], _ring(at[0]), [_ring(hole) for hole in at[1:]], of["area_m2"], of["perimeter_m"],
                                   of["unseen_area_m2"], of["open_border_m"], (of["label_point"][0], of["label_point"][1]), of["name"]))
        elif of["kind"] in ("door", "opening"):
            self.openings.append(Opening(of["id"], of.get("type", "door"), ((at[0][0], at[0][1]), (at[1][0], at[1][1])),
                                         of["width_m"], (of["rooms"][0], of["rooms"][1])))
        elif of["kind"] == "wall":
            self.walls.append(Wall(of["id"], (at[0][0], at[0][1]), (at[1][0], at[1][1]), of["thickness_m"],
                                   (of["left_line_ids"], of["right_line_ids"]), of["presumed"]))
        else:
            self.furniture.append(Furniture(of["id"], _ring(at[0]), of["leaning"], of["room"]))

    def room_at(self, x: float, y: float) -> Optional[Room]:
        """The room that a point of the map frame lies in; None: in none."""
        for room in self.rooms:
            if _is_inside(room.outline, x, y) and not any(_is_inside(hole, x, y) for hole in room.holes):
                return room
        return None

    def to_geojson(self) -> str:
        """The text of plan.geojson: that which the program writes."""
        return self._geojson

    def save(self, folder: "Union[str, os.PathLike[str]]", force: bool = False, origin: Optional[Sequence[float]] = None) -> List[str]:
        """Write the plan's files into a folder, which is made where it is missing; each whole or not at all.

        Args:
            force: overwrite files that are there and differ.
            origin: (latitude, longitude, turn), degrees, as of `map`: plan.geojson is in degrees then.

        Returns:
            Their names: plan.geojson, plan.svg, plan.dxf, rooms.csv; plan.pdf and rooms.png where the package was built
            beside Cairo.

        Raises:
            ValueError: the folder has no name.
            RuntimeError: one of them is there already, or cannot be written; names the file and the reason.
        """
        lines_csv, (cells, resolution, corner), _, title = self._source
        files = floor_plan_files(lines_csv, cells, resolution, corner, self._labels[0] if self._labels else None, title, origin)
        write_plan_files(os.fspath(folder_of(folder)), files, force)
        return list(files)

    @property
    def __geo_interface__(self) -> Dict[str, Any]:
        collection: Dict[str, Any] = json.loads(self._geojson)
        return collection

    def __repr__(self) -> str:
        area = sum(room.area for room in self.rooms)
        return f"FloorPlan({len(self.rooms)} rooms, {area:.1f} m^2, {len(self.openings)} openings, {len(self.walls)} walls)"


def _is_inside(ring: List[Point], x: float, y: float) -> bool:
    inside = False
    for (x1, y1), (x2, y2) in zip(ring, ring[1:] + ring[:1]):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1):
            inside = not inside
    return inside


class _Source(NamedTuple):
    """What a plan is made of."""

    lines_csv: str
    grid: Grid
    grid_name: str  # of its file, for messages
    title: str  # for people


def _source_of(source: Union[Map, str, "os.PathLike[str]"]) -> _Source:
    made = source if isinstance(source, Map) else load(source)
    if made.grid is None:
        raise ValueError(f"{'map' if made is source else source}: has no grid (map.yaml, map.pgm), which tells where rooms are")
    cells, resolution, origin = made.grid
    grid = Grid(np.ascontiguousarray(cells), resolution, origin)
    if isinstance(source, Map):
        return _Source(made.lines_csv(), grid, "grid", str(made.summary.get("title", "")))
    return _Source(made.lines_csv(), grid, str(Path(source) / "map.yaml"), title_of_folder(os.fspath(source)))


def floor_plan(source: Union[Map, str, "os.PathLike[str]"], labels: "Optional[Union[str, os.PathLike[str]]]" = None) -> FloorPlan:
    """Rooms, openings, walls and furniture of a finished map: what `cca-mrpt plan` makes, byte for byte.

    Args:
        source: a `Map`, or the folder of one, with its grid: map.yaml and map.pgm.
        labels: a CSV file with columns x, y (m, map frame) and name, which names the rooms.

    Raises:
        FileNotFoundError: that folder holds no map, or there are no such labels.
        ValueError: a file is damaged; or the map has no grid, without which there are no rooms.
    """
    text = None if labels is None else (text_of(Path(labels)), os.fspath(labels))
    return FloorPlan(_source_of(source), text)
