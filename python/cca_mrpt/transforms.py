# SPDX-License-Identifier: BSD-3-Clause
"""What the tf of a recording knows: the transform between two frames at a time, as tf2 gives it."""
from __future__ import annotations

import bisect
import math
from typing import Dict, List, NamedTuple, Optional, Tuple

Vector = Tuple[float, float, float]
Quaternion = Tuple[float, float, float, float]  # x, y, z, w
Pose = Tuple[float, float, float]

LARGEST_TILT = math.radians(15)  # beyond it beams meet floor and ceiling


class Unplanar(ValueError):
    """No rigid motion in the plane."""


class Transform(NamedTuple):
    """T_parent_child in space: m, unit quaternion."""

    translation: Vector
    rotation: Quaternion


class PlanarPose(NamedTuple):
    """(x, y, theta) in the plane; m, m, rad."""

    pose: Pose
    upside_down: bool


IDENTITY = Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


def frame_name(frame: str) -> str:
    """As tf2 has it: drivers from the days of tf1 begin it with a slash."""
    return frame[1:] if frame.startswith("/") else frame


def seconds(nanoseconds: int) -> float:
    """As ros::Time and ros::Duration tell it."""
    whole, rest = divmod(nanoseconds, 1_000_000_000)
    return whole + 1e-9 * rest


def wrap_angle(angle: float) -> float:
    """In (-pi, pi]."""
    wrapped = math.remainder(angle, 2 * math.pi)
    return math.pi if wrapped <= -math.pi else wrapped


# In the order in which tf2 adds and multiplies: so that the same bytes come out of the map.
def _product(a: Quaternion, b: Quaternion) -> Quaternion:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx, aw * bw - ax * bx - ay * by - az * bz)


def _inverse(q: Quaternion) -> Quaternion:
    return (-q[0], -q[1], -q[2], q[3])


def _rotated(q: Quaternion, v: Vector) -> Vector:
    x, y, z, w = q
    moved = (w * v[0] + y * v[2] - z * v[1], w * v[1] + z * v[0] - x * v[2], w * v[2] + x * v[1] - y * v[0],
             -x * v[0] - y * v[1] - z * v[2])
    return _product(moved, _inverse(q))[:3]


def _sum(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def compose(a: Transform, b: Transform) -> Transform:
    """a * b."""
    return Transform(_sum(_rotated(a.rotation, b.translation), a.translation), _product(a.rotation, b.rotation))


def inverse(a: Transform) -> Transform:
    x, y, z = a.translation
    back = _inverse(a.rotation)
    return Transform(_rotated(back, (-x, -y, -z)), back)


def _dot(a: Quaternion, b: Quaternion) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]


def _between(a: Transform, b: Transform, share: float) -> Transform:
    """On the straight line, and by the shorter turn."""
    (ax, ay, az), p = a
    (bx, by, bz), q = b
    rest = 1.0 - share
    place = (rest * ax + share * bx, rest * ay + share * by, rest * az + share * bz)
    cosine = _dot(p, q)
    if cosine < 0:
        q = (-q[0], -q[1], -q[2], -q[3])
    theta = 2.0 * math.acos(max(-1.0, min(1.0, _dot(p, q) / math.sqrt(_dot(p, p) * _dot(q, q))))) / 2.0
    if theta == 0.0:
        return Transform(place, p)
    d, of_p, of_q = 1.0 / math.sin(theta), math.sin(rest * theta), math.sin(share * theta)
    return Transform(place, ((p[0] * of_p + q[0] * of_q) * d, (p[1] * of_p + q[1] * of_q) * d,
                             (p[2] * of_p + q[2] * of_q) * d, (p[3] * of_p + q[3] * of_q) * d))


def planar(transform: Transform) -> PlanarPose:
    """The motion in the plane. Raises Unplanar: not rigid, or tilted by more than 15 degrees."""
    (tx, ty, _), (x, y, z, w) = transform
    norm = x * x + y * y + z * z + w * w
    if not (math.isfinite(tx) and math.isfinite(ty) and abs(norm - 1) < 1e-2):
        raise Unplanar("transform: not a rigid motion")
    up = norm - 2 * (x * x + y * y)
    if abs(up) < math.cos(LARGEST_TILT) * norm:
        raise Unplanar("transform: tilted more than 15 degrees from the plane")
    return PlanarPose((tx, ty, math.atan2(2 * (x * y + z * w), norm - 2 * (y * y + z * z))), up < 0)


class Joint:
    """How a frame hangs on its parent, over the time."""

    def __init__(self, parent: str, is_static: bool) -> None:
        self.parent = parent
        self.is_static = is_static
        self.stamps: List[int] = []
        self.transforms: List[Transform] = []

    def add(self, stamp: int, transform: Transform) -> None:
        if self.is_static:
            self.stamps, self.transforms = [stamp], [transform]
            return
        at = len(self.stamps)
        if self.stamps and stamp <= self.stamps[-1]:
            at = bisect.bisect_left(self.stamps, stamp)
            if self.stamps[at] == stamp:  # said twice: the last word counts
                self.transforms[at] = transform
                return
        self.stamps.insert(at, stamp)
        self.transforms.insert(at, transform)

    @property
    def moves(self) -> bool:
        return any(transform != self.transforms[0] for transform in self.transforms)

    def at(self, stamp: Optional[int]) -> Optional[Transform]:
        """None: the stamp lies before the first or after the last one. Without a stamp: the latest."""
        if self.is_static or stamp is None:
            return self.transforms[-1]
        for end in (-1, 0):
            if stamp == self.stamps[end]:
                return self.transforms[end]
        k = bisect.bisect_right(self.stamps, stamp)
        if k == 0 or k == len(self.stamps):
            return None
        # Where a stamp is met exactly, tf2 takes a share of 0 of the next one, which rounds.
        before, after = self.stamps[k - 1], self.stamps[k]
        share = seconds(stamp - before) / seconds(after - before)
        return _between(self.transforms[k - 1], self.transforms[k], share)


class Transforms:
    """All of a recording's tf. Stamps are ns; frames may be named with or without a slash."""

    def __init__(self) -> None:
        self.joints: Dict[str, Joint] = {}

    def add(self, parent: str, child: str, stamp: int, transform: Transform, is_static: bool) -> None:
        """What is not finite is passed over, and so is a frame that would hang on itself."""
        parent, child = frame_name(parent), frame_name(child)
        if parent == child or not all(map(math.isfinite, (*transform.translation, *transform.rotation))):
            return
        joint = self.joints.get(child)
        if joint is None or joint.parent != parent or joint.is_static != is_static:
            joint = self.joints[child] = Joint(parent, is_static)
        joint.add(stamp, transform)

    def frames(self) -> List[str]:
        """All that are named, in the order of the alphabet."""
        return sorted(set(self.joints) | {joint.parent for joint in self.joints.values()})

    def chain(self, frame: str) -> List[str]:
        """The frame itself and those that it hangs on, up to the root."""
        chain = [frame]
        while chain[-1] in self.joints and self.joints[chain[-1]].parent not in chain:
            chain.append(self.joints[chain[-1]].parent)
        return chain

    def lookup(self, target: str, source: str, stamp: Optional[int]) -> Optional[Transform]:
        """T_target_source; None: tf does not join the two, or not at that time."""
        up, down = self.chain(source), self.chain(target)
        shared = next((frame for frame in up if frame in down), None)
        if shared is None or (target != source and not {target, source} <= set(self.frames())):
            return None
        to_shared = self._climb(up[:up.index(shared)], stamp)
        from_target = self._climb(down[:down.index(shared)], stamp)
        if to_shared is None or from_target is None:
            return None
        if shared == target:
            return to_shared
        back = inverse(from_target)
        return back if shared == source else compose(back, to_shared)

    def _climb(self, frames: List[str], stamp: Optional[int]) -> Optional[Transform]:
        whole = IDENTITY
        for frame in frames:
            step = self.joints[frame].at(stamp)
            if step is None:
                return None
            whole = compose(step, whole)
        return whole
