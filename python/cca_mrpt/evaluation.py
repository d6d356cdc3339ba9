# SPDX-License-Identifier: BSD-3-Clause
"""How good a map is, by the scans it was made from or by the true world: `cca-mrpt evaluate`."""
from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Dict, Iterable, Optional, Union

from ._core import LogRecord, judge_map
from .logs import repeatable
from .maps import Map

Score = Dict[str, Dict[str, Optional[float]]]


def evaluate(line_map: "Union[Map, str, os.PathLike[str]]",
             log: "Optional[Union[str, os.PathLike[str], Iterable[LogRecord]]]" = None, *,
             world: "Optional[Union[str, os.PathLike[str]]]" = None) -> Score:
    """Judge a line map: the same figures as `cca-mrpt evaluate` tells.

    Args:
        line_map: a map, its folder, or its lines.csv; also another CSV with columns x1, y1, x2, y2 (m).
        log: what it was made from, see `read_log`, or any iterable of `LogRecord`; its poses are taken as true.
        world: or the .yaml of a world; NAME.truth.csv stands beside it.

    Returns:
        Figures by group and name, as docs/evaluation.md explains them; None where one does not exist.

    Raises:
        FileNotFoundError, ImportError, ValueError: as `read_log`; also where the map or the truth is damaged, or both or
            none of `log` and `world` are told.
        RuntimeError: the package was built without nanoflann.
    """
    return dict(json.loads(evaluation_json(line_map, log, world)))


def evaluation_json(line_map: "Union[Map, str, os.PathLike[str]]",
                    log: "Optional[Union[str, os.PathLike[str], Iterable[LogRecord]]]",
                    world: "Optional[Union[str, os.PathLike[str]]]") -> str:
    """The text that the program prints."""
    if (log is None) == (world is None):
        raise ValueError("log, world: one of them is needed")
    if isinstance(line_map, Map):
        text, name = line_map.lines_csv(), "the map"
    else:
        path = Path(line_map)
        path = path / "lines.csv" if path.is_dir() else path
        text, name = path.read_bytes().decode(errors="replace"), os.fspath(path)
    return judge_map(text, name, repeatable(log) if log is not None else (), None if world is None else os.fspath(world))
