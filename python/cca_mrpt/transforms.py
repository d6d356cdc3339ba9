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


def _product(a: Quaternion, b: Quaternion) -> Quaternion:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx, aw * bw - ax * bx - ay * by - az * bz)


def _rotated(q: Quaternion, v: Vector) -> Vector:
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


def compose(a: Transform, b: Transform) -> Transform:
    """a * b."""
    moved = _rotated(a.rotation, b.translation)
    return Transform((a.translation[0] + moved[0], a.translation[1] + moved[1], a.translation[2] + moved[2]),
                     _product(a.rotation, b.rotation))


def inverse(a: Transform) -> Transform:
    x, y, z, w = a.rotation
    back = _rotated((-x, -y, -z, w), a.translation)
    return Transform((-back[0], -back[1], -back[2]), (-x, -y, -z, w))


def _between(a: Transform, b: Transform, share: float) -> Transform:
    """On the straight line, and by the shorter turn."""
    translation = tuple(p + share * (q - p) for p, q in zip(a.translation, b.translation))
    cosine = sum(p * q for p, q in zip(a.rotation, b.rotation))
    sign = -1.0 if cosine < 0 else 1.0
    angle = math.acos(min(1.0, abs(cosine)))
    if angle < 1e-9:
        return Transform(translation, a.rotation)  # type: ignore[arg-type]
    s = math.sin(angle)
    of_a, of_b = math.sin((1 - share) * angle) / s, sign * math.sin(share * angle) / s
    rotation = tuple(of_a * p + of_b * q for p, q in zip(a.rotation, b.rotation))
    return Transform(translation, rotation)  # type: ignore[arg-type]


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
        k = bisect.bisect_left(self.stamps, stamp)
        if k < len(self.stamps) and self.stamps[k] == stamp:
            return self.transforms[k]
        if k == 0 or k == len(self.stamps):
            return None
        before, after = self.stamps[k - 1], self.stamps[k]
        return _between(self.transforms[k - 1], self.transforms[k], (stamp - before) / (after - before))


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
        return to_shared if shared == target else compose(inverse(from_target), to_shared)

    def _climb(self, frames: List[str], stamp: Optional[int]) -> Optional[Transform]:
        whole = IDENTITY
        for frame in frames:
            step = self.joints[frame].at(stamp)
            if step is None:
                return None
            whole = compose(step, whole)
        return whole
