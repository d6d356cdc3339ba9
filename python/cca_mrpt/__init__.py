# SPDX-License-Identifier: BSD-3-Clause
"""Line maps and exploration with 2-D lasers.

Metres, radians and seconds; bearings are counter-clockwise, x points forwards, and a beam without return
is +inf. Poses are (x, y, theta). Wrong values raise ValueError, which names the argument.
"""
import copyreg
from typing import TYPE_CHECKING, Dict

from ._core import (
    LINE,
    MAP_LINE,
    Action,
    Baseline,
    CellState,
    Estimate,
    ExplorationGrid,
    Explorer,
    LineMap,
    LogRecord,
    MissingReturns,
    PolyLine,
    Slam,
    SlamPose,
    all_baselines,
    extract_lines,
    version,
)
from .evaluation import evaluate
from .floor_plans import FloorPlan, Furniture, Opening, Room, Wall, floor_plan
from .grids import Grid
from .localisation import Localisation, localize
from .logs import Log, read_log
from .maps import Map, MapArc, Mapper, load, map, merge
from .plotting import plot
from .replays import replay_page

if TYPE_CHECKING:
    # Where MRPT is not there is no such module.
    from ._simulation import Simulation as Simulation  # type: ignore[import-not-found, unused-ignore]

baselines: Dict[str, Baseline] = {baseline.name: baseline for baseline in all_baselines()}
"""The classical line extractors, by their names."""


def _baseline(name: str) -> Baseline:
    return baselines[name]


copyreg.pickle(Baseline, lambda baseline: (_baseline, (baseline.name,)))

__version__ = version
__all__ = [
    "LINE",
    "MAP_LINE",
    "Action",
    "Baseline",
    "CellState",
    "Estimate",
    "ExplorationGrid",
    "Explorer",
    "FloorPlan",
    "Furniture",
    "Grid",
    "LineMap",
    "Localisation",
    "Log",
    "LogRecord",
    "Map",
    "MapArc",
    "Mapper",
    "MissingReturns",
    "Opening",
    "PolyLine",
    "Room",
    "Slam",
    "SlamPose",
    "Wall",
    "baselines",
    "evaluate",
    "extract_lines",
    "floor_plan",
    "load",
    "localize",
    "map",
    "merge",
    "plot",
    "read_log",
    "replay_page",
]


def __getattr__(name: str) -> object:
    if name == "Simulation":  # loads MRPT, which takes longer than all else here: only for those who ask
        try:
            from ._simulation import Simulation
        except ImportError as error:  # built, or installed, where MRPT is not
            raise AttributeError(f"cca_mrpt.Simulation needs MRPT, here and where it was built ({error})") from None
        return Simulation
    raise AttributeError(f"module 'cca_mrpt' has no attribute {name!r}")
