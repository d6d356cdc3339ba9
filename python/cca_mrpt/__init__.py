# SPDX-License-Identifier: BSD-3-Clause
"""Line maps and exploration with 2-D lasers.

Metres, radians and seconds; bearings are counter-clockwise, x points forwards, and a beam without return
is +inf. Poses are (x, y, theta). Wrong values raise ValueError, which names the argument.
"""
import os
from importlib.metadata import version

from ._core import (
    LINE,
    MAP_LINE,
    Action,
    Baseline,
    CellState,
    ExplorationGrid,
    Explorer,
    LineMap,
    Log,
    LogRecord,
    PolyLine,
    Slam,
    SlamPose,
    baselines,
    extract_lines,
)
from .plotting import plot

try:
    from ._simulation import Simulation
except ImportError as error:  # built, or installed, where MRPT is not
    _no_simulation = str(error)

__version__ = version("cca-mrpt")
__all__ = [
    "LINE",
    "MAP_LINE",
    "Action",
    "Baseline",
    "CellState",
    "ExplorationGrid",
    "Explorer",
    "LineMap",
    "Log",
    "LogRecord",
    "PolyLine",
    "Simulation",
    "Slam",
    "SlamPose",
    "baselines",
    "extract_lines",
    "plot",
    "read_log",
]


if "Simulation" not in globals():
    __all__.remove("Simulation")


def __getattr__(name: str) -> object:
    if name == "Simulation":
        raise AttributeError(f"cca_mrpt.Simulation needs MRPT, here and where it was built ({_no_simulation})")
    raise AttributeError(f"module 'cca_mrpt' has no attribute {name!r}")


def read_log(path: "str | os.PathLike[str]") -> Log:
    """Open a CARMEN log (FLASER, RLASER, ROBOTLASER1; also .gz): an iterator over its scans.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: it holds no whole laser scan, or cannot be read; names the file and the reason.
    """
    name = os.fspath(path)
    if not os.path.exists(name):
        raise FileNotFoundError(f"{name}: no such file")
    return Log(name)
