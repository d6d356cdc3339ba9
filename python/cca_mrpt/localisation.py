# SPDX-License-Identifier: BSD-3-Clause
"""Where a robot was in a finished map or a drawn plan, which stays as it is: `cca-mrpt localize`."""
from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Dict, Iterable, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from ._core import LogRecord, localize_records, write_files_into
from .folders import folder_of, kept_for_one_run, require_writable
from .grids import read_map_yaml
from .logs import Log, repeatable


FILES = ("poses.csv", "poses.tum", "summary.json")


def require_no_map(folder: Path, force: bool) -> None:
    """See that poses may be written into a folder, before the work is done.

    Raises:
        FileExistsError: there is a map, whose poses and summary would be lost; or poses, and `force` is not given.
        OSError: it is no folder, or cannot be written to.
    """
    if (folder / "lines.csv").exists():
        raise FileExistsError(f"{folder}: holds a map; its poses.csv and summary.json would be lost")
    require_writable(folder, FILES, force)


class Localisation:
    """The poses of a log in a plan. It is a value: nothing changes it.

    Attributes:
        poses: (N, 3) of (x, y, theta) in the plan's frame; m, m, rad: of the scans that were localised.
        times: (N,) s; numbers of the scans where the log tells no times.
        summary: numbers of the run, as in summary.json.
        warnings: what could not be read; empty where all was well.
        shortcoming: why the robot was localised nowhere; empty where it was.
    """

    def __init__(self, table: NDArray[np.float64], summary: Dict[str, Any], files: Dict[str, bytes], warnings: str,
                 shortcoming: str) -> None:
        self.times: NDArray[np.float64] = table[:, 0].copy()
        self.poses: NDArray[np.float64] = table[:, 1:].copy()
        self.summary, self.warnings, self.shortcoming, self._files = summary, warnings, shortcoming, files

    def save(self, folder: Union[str, "os.PathLike[str]"], force: bool = False) -> List[str]:
        """Write poses.csv, poses.tum and, last, summary.json into a folder, which is made where it is missing.

        Returns:
            The files' names.

        Raises:
            FileExistsError: there is a map; or one of them is there already, and `force` is not given.
            OSError, RuntimeError: it cannot be written, or another run is writing there; names the file and the reason.
        """
        where = folder_of(folder)
        require_no_map(where, force)
        with kept_for_one_run(where, FILES, force):
            (where / "summary.json").unlink(missing_ok=True)  # it says that all is there
            write_files_into(os.fspath(where), self._files)
            write_files_into(os.fspath(where), {"summary.json": (json.dumps(self.summary, indent=2) + "\n").encode()})
        return list(FILES)

    def __len__(self) -> int:
        return len(self.poses)

    def __repr__(self) -> str:
        return f"Localisation({len(self)} of {self.summary['scans']} scans)"


def localize(log: "Union[str, os.PathLike[str], Iterable[LogRecord]]", plan: "Union[str, os.PathLike[str]]",
             start: Optional[Tuple[float, float, float]] = None, scale: float = 0.0, until_interrupted: bool = False) -> Localisation:
    """Find where a log was taken in a finished map or a drawn plan: the same poses as `cca-mrpt localize`.

    Args:
        log: a log or a bag, see `read_log`; or any iterable of `LogRecord`.
        plan: the folder of a map, its lines.csv or map.slam, a .geojson, .dxf or .svg, or the .yaml of a map_server grid
            (its image a binary PGM).
        start: (x, y, theta) where the log begins, to half a metre and 15 degrees; m, m, rad. None: anywhere.
        scale: metres of a unit of the drawing or the .csv; 0: as it tells. Refused of what tells its own metres: a
            map.slam, a grid, GeoJSON in degrees.
        until_interrupted: Ctrl-C ends the reading, and the poses so far are given (`summary["finished"]` is False),
            instead of KeyboardInterrupt.

    Raises:
        FileNotFoundError, ImportError, ValueError: as `read_log`; also where the plan holds no line, or is damaged.
    """
    if not (isinstance(scale, (int, float)) and (scale == 0.0 or 1e-6 <= scale <= 1e6)):
        raise ValueError(f"scale: {scale!r} m a unit: must be 0, or in [1e-6, 1e6]")
    path, name = Path(plan), os.fspath(plan)
    if not path.exists():
        raise FileNotFoundError(f"{name}: no such file")
    grid: Optional[Tuple[NDArray[np.uint8], float, Tuple[float, float]]] = None
    if path.suffix.lower() in (".yaml", ".yml"):
        grid = read_map_yaml(path)
    records = repeatable(log)
    table, summary, files, warnings, shortcoming = localize_records(records, name, grid, start, scale, until_interrupted)
    told: Dict[str, Any] = json.loads(summary)
    if not told["scans"]:
        raise ValueError("records: no scan is among them")
    if isinstance(records, Log):
        told = {"log": records.path, **told}
        warnings = "; ".join(filter(None, [records.warnings, warnings]))
    return Localisation(table, told, files, warnings, shortcoming)
