# SPDX-License-Identifier: BSD-3-Clause
"""The grid of a map's folder: map.yaml and map.pgm, as map_server has them."""
from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from .folders import text_of


class Grid(NamedTuple):
    """Which places are free, and which are not."""

    cells: NDArray[np.uint8]  # 0 unknown, 1 free, 2 occupied; rows from the lowest y on
    resolution: float  # m, side of a cell
    origin: Tuple[float, float]  # m, map frame: lower left corner


def _read_pgm(path: Path, occupied_from: float, free_below: float, is_negated: bool) -> NDArray[np.uint8]:
    """Unknown, free and occupied cells of a PGM, rows from the lowest y on."""
    found = re.match(rb"P5\s+(?:#[^\n]*\s+)*(\d+)\s+(\d+)\s+255\s", (data := path.read_bytes())[:1000])
    if not found:
        raise ValueError(f"{path}: is damaged, or no binary PGM of a map")
    columns, rows = int(found[1]), int(found[2])
    if len(data) - found.end() < columns * rows:
        raise ValueError(f"{path}: is damaged: of {columns} x {rows} cells {len(data) - found.end()} are there")
    grey = np.frombuffer(data, np.uint8, columns * rows, found.end()).reshape(rows, columns)[::-1]
    occupied = grey / 255 if is_negated else 1 - grey / 255
    return np.where(occupied > occupied_from, 2, np.where(occupied < free_below, 1, 0)).astype(np.uint8)


def read_map_yaml(yaml: Path) -> Grid:
    """A grid of map_server. Raises ValueError naming the file that is damaged, and FileNotFoundError."""
    if not yaml.exists():
        raise FileNotFoundError(f"{yaml}: no such file")
    text = text_of(yaml)
    number = r"[ \t]*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)[ \t\r]*"
    image = re.search(r"^image:\s*(\S+)\s*$", text, re.MULTILINE)
    resolution = re.search(rf"^resolution:{number}$", text, re.MULTILINE)
    origin = re.search(rf"^origin:\s*\[{number},{number}(?:,{number})?\]", text, re.MULTILINE)
    if not (resolution and origin and image):
        raise ValueError(f"{yaml}: is damaged, or no map of map_server, which has image, resolution and origin")
    if not 0 < float(resolution[1]) < math.inf:
        raise ValueError(f"{yaml}: resolution: {resolution[1]} m: must be above 0")
    if float(origin[3] or 0) != 0:
        raise ValueError(f"{yaml}: origin: a turned map (yaw {origin[3]}) is not read")

    def told(key: str, otherwise: float) -> float:
        found = re.search(rf"^{key}:{number}$", text, re.MULTILINE)
        return float(found[1]) if found else otherwise

    cells = _read_pgm(yaml.parent / image[1], told("occupied_thresh", 0.65), told("free_thresh", 0.196), told("negate", 0) != 0)
    return Grid(cells, float(resolution[1]), (float(origin[1]), float(origin[2])))


def read_grid(folder: Path) -> Optional[Grid]:
    """The grid of a map's folder; None: it has none. Raises ValueError naming the file that is damaged."""
    yaml = folder / "map.yaml"
    return read_map_yaml(yaml) if yaml.exists() else None
