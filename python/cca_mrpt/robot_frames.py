# SPDX-License-Identifier: BSD-3-Clause
"""Which frames of a recorded tf are the robot's, however they are named."""
from __future__ import annotations

from typing import List, NamedTuple, Optional

from .transforms import Transforms


class OdometryFrames(NamedTuple):
    """What odometry messages call their frames; empty where they say nothing."""

    odom: str = ""
    base: str = ""


class RobotFrames(NamedTuple):
    """Empty: there is no such frame."""

    map: str
    odom: str
    base: str
    mount_is_known: bool  # whether tf joins the laser with the base


def _last_word(frame: str) -> str:
    return frame.rsplit("/", 1)[-1]


def _is_odom(frame: str) -> bool:
    return "odom" in _last_word(frame)


def _called(frames: List[str], name: str) -> str:
    return next((frame for frame in frames if _last_word(frame) == name), "")


def _carried(tf: Transforms, chain: List[str]) -> str:
    """Of those frames, the one that hangs on odom, or on a joint that moves."""
    hanging = list(zip(chain, chain[1:]))
    on_odom = next((child for child, parent in hanging if _is_odom(parent)), "")
    return on_odom or next((child for child, _ in hanging if tf.joints[child].moves), "")


def _base_in_chain(tf: Transforms, chain: List[str], odometry: OdometryFrames) -> str:
    link = _called(chain, "base_link")
    if link:
        return link
    if odometry.base in chain:
        return odometry.base
    return _called(chain, "base_footprint") or _carried(tf, chain)


def _base_elsewhere(tf: Transforms, odometry: OdometryFrames) -> str:
    """A base that the laser does not hang on; empty where it is not clear which."""
    if odometry.base:
        return odometry.base
    for name in ("base_link", "base_footprint"):
        bases = [frame for frame in tf.frames() if _last_word(frame) == name]
        if len(bases) == 1:
            return bases[0]
    return ""


def find_frames(tf: Transforms, laser: str, odometry: OdometryFrames, base: Optional[str] = None,
                odom: Optional[str] = None) -> RobotFrames:
    """Find the frames of the robot that carries a laser.

    The base is one of those that the laser hangs on: the one that is called base_link, whatever its prefix; else that
    of the odometry messages; else base_footprint; else what hangs on a frame called odom, or on the nearest joint
    that moves; else, where the laser hangs on nothing that tells of a robot, the base of the odometry messages, or the
    one frame that is called base_link or base_footprint. `odom` is above the base: what is called so, else the frame
    that the base moves in; `map` is what is called so above that.

    Args:
        base, odom: frames that somebody has named; None: to be found.
    """
    chain = tf.chain(laser)
    base = base or _base_in_chain(tf, chain, odometry) or _base_elsewhere(tf, odometry) or chain[-1]
    above = tf.chain(base)
    upwards = above[1:]
    map_frame = _called(upwards, "map")
    found = odom or next((frame for frame in upwards if _is_odom(frame)), "")
    if not found and odometry.odom in upwards and odometry.odom != map_frame:
        found = odometry.odom
    if not found and upwards and tf.joints[base].moves and upwards[0] != map_frame:
        found = upwards[0]
    return RobotFrames(map_frame, found, base, chain[-1] == above[-1])
