# SPDX-License-Identifier: BSD-3-Clause
"""Point clouds of one ring (sensor_msgs/PointCloud2), as the scans that they were."""
from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

CLOUD = "sensor_msgs/msg/PointCloud2"
FLOATS = {7: "f4", 8: "f8"}  # sensor_msgs/PointField: FLOAT32, FLOAT64
FEWEST = 3  # points that tell how far apart beams are
ONE_RING = math.radians(0.5)  # of elevation: rings of lasers lie a third of a degree apart and more, and there are many
OFF_BEAM, SHARE_OFF = 0.25, 0.05  # of a beam's width; of points that may lie further off: motion compensation moves some


class NoRing(ValueError):
    """A cloud that no 2-D laser has taken: the rule that it breaks, and the values."""

    def __init__(self, rule: str, values: str) -> None:
        super().__init__(f"{rule} ({values})")
        self.rule = rule


class RingScan(NamedTuple):
    """What of a LaserScan a cloud tells. Beams without a point say nothing."""

    header: Any
    ranges: NDArray[np.float32]  # m, in the plane
    angle_min: float = 0.0  # rad
    angle_max: float = 0.0
    angle_increment: float = 0.0
    time_increment: float = 0.0  # s
    range_min: float = 0.0  # m
    range_max: float = math.inf


def _points(cloud: Any) -> NDArray[np.float64]:
    """(N, 3) m: those that are there."""
    fields = {field.name: field for field in cloud.fields}
    kinds = [FLOATS.get(fields[name].datatype) if name in fields else None for name in "xyz"]
    if None in kinds:
        raise NoRing("a cloud must have fields x, y and z of floating point", f"it has {', '.join(fields)}")
    if cloud.height > 1:
        raise NoRing("a cloud must be of one ring", f"it has {cloud.height} rows")
    order = ">" if cloud.is_bigendian else "<"
    row = np.dtype({"names": list("xyz"), "formats": [f"{order}{kind}" for kind in kinds],
                    "offsets": [fields[name].offset for name in "xyz"], "itemsize": cloud.point_step})
    if len(cloud.data) < cloud.width * cloud.point_step:
        raise NoRing("a cloud must hold as many bytes as it tells of", f"{cloud.width} points, {len(cloud.data)} bytes")
    table = np.frombuffer(bytes(cloud.data), row, count=cloud.width)
    points: NDArray[np.float64] = np.stack([table[name].astype(np.float64) for name in "xyz"], axis=-1)
    is_there = np.isfinite(points).all(axis=1) & (np.hypot(points[:, 0], points[:, 1]) > 0)
    there: NDArray[np.float64] = points[is_there]
    return there


def scan_of(cloud: Any) -> RingScan:
    """The scan whose beams have the directions of a cloud's points, in their order. Raises NoRing."""
    points = _points(cloud)
    if len(points) < FEWEST:
        return RingScan(cloud.header, np.zeros(0, np.float32))
    ranges = np.hypot(points[:, 0], points[:, 1])
    elevations = np.arctan2(points[:, 2], ranges)
    if np.ptp(elevations) > ONE_RING:
        raise NoRing("a cloud must be of one ring", f"elevations of {np.degrees(elevations.min()):.1f} to "
                     f"{np.degrees(elevations.max()):.1f} degrees")
    bearings = np.arctan2(points[:, 1], points[:, 0])
    steps = np.angle(np.exp(1j * np.diff(bearings)))
    step = float(np.median(steps))
    if step == 0:
        raise NoRing("a cloud's points must go round", "most have one direction")
    turned = np.mod((bearings - bearings[0]) * math.copysign(1, step), 2 * math.pi)
    beams = np.rint(turned / abs(step))
    width = float(turned @ beams / (beams @ beams))  # float32 points round a single step
    beams = np.rint(turned / width).astype(int)
    off = np.abs(turned - beams * width) > OFF_BEAM * width
    if np.mean(off) > SHARE_OFF:
        raise NoRing("a cloud's points must be evenly spaced in direction", f"{np.count_nonzero(off)} of {len(off)} are not, "
                     f"{np.degrees(width):.2f} degrees apart")
    scan = np.full(int(beams.max()) + 1, np.nan, np.float32)
    for beam, distance in sorted(zip(beams, ranges), key=lambda hit: -hit[1]):  # of several the nearest
        scan[beam] = distance
    increment = math.copysign(width, step)
    return RingScan(cloud.header, scan, float(bearings[0]), float(bearings[0]) + increment * (len(scan) - 1), increment)
