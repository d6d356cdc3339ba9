# SPDX-License-Identifier: BSD-3-Clause
"""Logs of laser scans, told apart by their content."""
from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Iterable, Iterator, Optional, Sequence, Tuple, Union

from ._core import TextLog, LogRecord

if TYPE_CHECKING:
    from .bags import BagScans


class Log:
    """The scans of a log, in their order; each loop over it begins anew.

    `warnings` says what could not be read up to now, `progress` how much has been read in [0, 1], both of the last
    loop that has begun.
    """

    def __init__(self, path: str, topic: Optional[str] = None, base_frame: Optional[str] = None,
                 odom_frame: Optional[str] = None, mount: Optional[Tuple[float, float, float]] = None,
                 upside_down: bool = False) -> None:
        self.path, self.topic, self.base_frame, self.odom_frame, self.mount = path, topic, base_frame, odom_frame, mount
        self.upside_down = upside_down
        self._latest = self._open()  # says now what is wrong with it
        self._is_new = True

    def _open(self) -> "Union[TextLog, BagScans]":
        from .bags import BagScans, looks_like_bag

        path = Path(self.path)
        if looks_like_bag(path):
            return BagScans(path, self.topic, self.base_frame, self.odom_frame, self.mount, self.upside_down)
        told = [name for name in ("topic", "base_frame", "odom_frame", "mount") if getattr(self, name) is not None]
        if told:
            raise ValueError(f"{self.path}: {told[0]} is for ROS bags; this is none")
        return TextLog(self.path)

    def __iter__(self) -> Iterator[LogRecord]:
        if not self._is_new:
            self._latest = self._open()
        self._is_new = False
        return iter(self._latest)

    @property
    def warnings(self) -> str:
        """What could not be read; empty where all was well."""
        return self._latest.warnings

    @property
    def progress(self) -> float:
        """How much of the log has been read, in [0, 1]."""
        return self._latest.progress

    def __repr__(self) -> str:
        return f"Log({self.path!r})"

    def __reduce__(self) -> "tuple[type[Log], tuple[object, ...]]":
        return Log, (self.path, self.topic, self.base_frame, self.odom_frame, self.mount, self.upside_down)


def read_log(path: "str | os.PathLike[str]", *, topic: Optional[str] = None, base_frame: Optional[str] = None,
             odom_frame: Optional[str] = None, mount: Optional[Sequence[float]] = None,
             upside_down: bool = False) -> Log:
    """Open a log: CARMEN, CSV of ranges, CoreSLAM's .dat or csm's JSON (also .gz), or a ROS 1 or 2 bag (.bag, .db3,
    .mcap, a folder). What each holds is told by the program's page of file formats.

    Args:
        path: of the file or folder; what it is is told by its content.
        topic: bags: of the scans; None: the one with most of them.
        base_frame: bags: the robot's frame; None: found above the laser in tf, or by the odometry.
        odom_frame: bags: the frame that the robot's odometry is in; None: found above the base.
        mount: bags: (x, y, theta) of the laser on the robot, where tf does not tell it, or tells it wrongly; m, m, rad.
        upside_down: bags: whether the laser hangs so; goes with `mount`.

    Returns:
        The scans, to be looped over as often as one likes.

    Raises:
        FileNotFoundError: there is no such file.
        ImportError: a bag needs `rosbags` (`pip install 'cca-mrpt[ros]'`).
        ValueError: it holds no whole laser scan, or cannot be read; names the file and the reason.
    """
    name = os.fspath(path)
    if not os.path.exists(name):
        raise FileNotFoundError(f"{name}: no such file")
    place = None
    if mount is not None:
        x, y, theta = (float(number) for number in mount)
        if not all(map(math.isfinite, (x, y, theta))):
            raise ValueError(f"mount: finite numbers are needed, not {tuple(mount)}")
        place = (x, y, theta)
    elif upside_down:
        raise ValueError("upside_down: needs a mount")
    return Log(name, topic, base_frame, odom_frame, place, upside_down)


def repeatable(log: "Union[str, os.PathLike[str], Iterable[LogRecord]]") -> Iterable[LogRecord]:
    """A file's `Log`, or records that can be gone through more than once."""
    if isinstance(log, (str, os.PathLike)):
        return read_log(log)
    return log if isinstance(log, Log) else list(log)
