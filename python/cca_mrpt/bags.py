# SPDX-License-Identifier: BSD-3-Clause
"""The scans of ROS 1 and ROS 2 recordings, without ROS: .bag, .db3, .mcap and folders, compressed or not.

Needs `rosbags` (`pip install 'cca-mrpt[ros]'`). One message after the other is read; only tf and odometry are kept.
"""
from __future__ import annotations

import bisect
import gzip
import math
import shutil
import tempfile
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ._core import LogRecord, MissingReturns
from .clouds import CLOUD, NoRing, scan_of
from .robot_frames import OdometryFrames, RobotFrames, find_frames
from .transforms import PlanarPose, Pose, Transform, Transforms, Unplanar, frame_name, planar, seconds, wrap_angle

SCAN, ECHOES = "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/MultiEchoLaserScan"
ODOMETRY = "nav_msgs/msg/Odometry"
TF = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
TF_OF_ALL = ("/tf", "/tf_static", "tf", "tf_static")

FULL_TURN = 2 * math.pi + 0.05  # drivers round 2 pi / n up and repeat the first beam at the end
BEAMS_OFF, SHARE_OFF = 2.5, 0.1  # drivers miscount beams, round their increment, and turn not quite evenly
FARTHEST_MEDIAN = 250.0  # m: no 2-D laser has half of its returns from farther off
SLOWEST_LASER = 1.0  # s, a sweep; drivers are wrong by orders of magnitude
LEAST_SWEEP, USUAL_SWEEP = 0.01, 0.1  # s; below the first, a driver does not mean it

Reading = Tuple[float, Pose]  # s, of the laser then


class Topic(NamedTuple):
    name: str
    type: str
    messages: int


def listed(topics: Sequence[Topic]) -> str:
    return ", ".join(f"'{t.name}' ({t.type}, {t.messages} messages)" for t in topics) or "none"


class Recording:
    """Topics and messages of a bag, whatever its kind."""

    def __init__(self, reader: Any) -> None:
        self._reader = reader
        counts: Dict[Tuple[str, str], int] = {}
        for connection in reader.connections:
            key = (connection.topic, connection.msgtype)
            counts[key] = counts.get(key, 0) + (connection.msgcount or 0)
        self.topics = [Topic(name, kind, count) for (name, kind), count in sorted(counts.items())]

    def of_type(self, *types: str) -> List[Topic]:
        return [topic for topic in self.topics if topic.type in types]

    def messages(self, topics: Sequence[str]) -> Iterator[Tuple[str, Any]]:
        """(topic, message) of these topics, in the order of recording."""
        wanted = [c for c in self._reader.connections if c.topic in topics]
        if not wanted:
            return
        for connection, _, raw in self._reader.messages(connections=wanted):
            yield connection.topic, self._reader.deserialize(raw, connection.msgtype)


def looks_like_bag(path: Path) -> bool:
    """Whether the content is that of a recording: ROS 1, ROS 2 (SQLite or MCAP) or a folder of the latter."""
    if path.is_dir():
        return (path / "metadata.yaml").exists()
    with path.open("rb") as file:
        head = file.read(16)
    if head.startswith(b"\x1f\x8b"):
        try:
            with gzip.open(path) as unzipped:
                head = unzipped.read(16)
        except (OSError, EOFError):
            return False
    return head.startswith((b"#ROSBAG", b"#ROSRECORD", b"SQLite format 3", b"\x89MCAP0\r\n"))


@contextmanager
def open_recording(path: Path) -> Iterator[Recording]:
    """Raises ImportError without rosbags, ValueError where the file cannot be read; names it and the reason."""
    try:
        from rosbags.highlevel import AnyReader, AnyReaderError
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise ImportError(f"{path}: reading bags needs rosbags: pip install 'cca-mrpt[ros]'") from error
    with ExitStack() as stack:
        file = stack.enter_context(_as_file(path))
        if file.is_file():
            head = file.open("rb").read(16)
            if head.startswith((b"#ROSBAG V1", b"#ROSRECORD")):
                raise ValueError(f"{path}: is a ROS bag of version 1; 'rosbag fix' of an old ROS makes it one of "
                                 "version 2")
        try:
            # ROS 2 recordings from before 2023 hold no definitions of their messages; ROS 1's all do.
            known = None if file.suffix == ".bag" else get_typestore(Stores.ROS2_HUMBLE)
            reader = stack.enter_context(AnyReader([file], default_typestore=known))
        except (AnyReaderError, OSError, ValueError) as error:
            if file.suffix == ".mcap":
                from .broken_mcap import BrokenMcap

                yield Recording(BrokenMcap(file))
                return
            raise ValueError(f"{path}: cannot be read as a bag ({error})") from error
        yield Recording(reader)


@contextmanager
def _as_file(path: Path) -> Iterator[Path]:
    """The recording itself, unzipped, by a name that tells its kind."""
    if path.is_dir():
        yield path
        return
    suffixes = {b"#ROS": ".bag", b"SQLi": ".db3", b"\x89MCA": ".mcap"}
    with path.open("rb") as file:
        head = file.read(4)
    is_zipped = head.startswith(b"\x1f\x8b")
    if not is_zipped and path.suffix == suffixes.get(head):
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="cca_mrpt-") as folder:
        if is_zipped:
            unzipped = Path(folder) / "unzipped"
            try:
                with gzip.open(path) as source, unzipped.open("wb") as sink:
                    shutil.copyfileobj(source, sink)
            except (OSError, EOFError) as error:
                raise ValueError(f"{path}: cannot be unzipped ({error})") from error
            with unzipped.open("rb") as file:
                head = file.read(4)
            named = unzipped.with_suffix(suffixes.get(head, ""))
            unzipped.rename(named)
        else:
            named = Path(folder) / ("recording" + suffixes.get(head, ""))
            named.symlink_to(path.resolve())
        yield named


class Malformed(ValueError):
    """A message that no laser can have meant: the rule that it breaks, and the values."""

    def __init__(self, rule: str, values: str) -> None:
        super().__init__(f"{rule} ({values})")
        self.rule = rule


def ranges_of(message: Any) -> "np.ndarray[Any, np.dtype[np.float32]]":
    """(N,) m; of several echoes the first. A beam without any echo says nothing."""
    if hasattr(message.ranges, "dtype"):
        return np.asarray(message.ranges, dtype=np.float32)
    return np.array([beam.echoes[0] if len(beam.echoes) else math.nan for beam in message.ranges], dtype=np.float32)


def check_header(m: Any, ranges: "np.ndarray[Any, np.dtype[np.float32]]") -> None:
    """Raises Malformed."""
    def refuse_unless(sound: bool, rule: str, values: str) -> None:
        if not sound:
            raise Malformed(rule, values)

    beams, step = len(ranges), float(m.angle_increment)
    for name in ("angle_min", "angle_increment", "time_increment"):
        refuse_unless(math.isfinite(getattr(m, name)), f"{name} must be finite", f"it is {getattr(m, name):g}")
    refuse_unless(m.range_max > 0 and m.range_max > m.range_min, "range_max must be positive and above range_min",
                  f"range_max {m.range_max:g}, range_min {m.range_min:g}")
    if beams < 2:
        return
    refuse_unless(step != 0, "angle_increment must not be 0", f"{beams} beams")
    refuse_unless(abs(step) * (beams - 1) <= FULL_TURN, "the beams must not cover more than one turn",
                  f"{beams} beams, angle_increment {step:g}")
    declared, covered = m.angle_max - m.angle_min, step * (beams - 1)
    allowed = max(BEAMS_OFF * abs(step), SHARE_OFF * max(abs(declared), abs(covered)))
    refuse_unless(m.angle_max == 0 or abs(declared - covered) <= allowed,
                  "ranges and angle_increment must lead from angle_min to angle_max",
                  f"{beams} beams of angle_increment {step:g} lead from angle_min {m.angle_min:g} to "
                  f"{m.angle_min + covered:g}, not to angle_max {m.angle_max:g}")
    returns = ranges[np.isfinite(ranges) & (ranges > 0)]
    returns = returns[returns < 0.999 * returns.max()] if len(returns) else returns
    if len(returns):
        middle = float(np.sort(returns)[len(returns) // 2])
        refuse_unless(middle <= FARTHEST_MEDIAN, "ranges must be metres: they look like millimetres",
                      f"half of the returns are beyond {middle:g}, range_max {m.range_max:g}")


def nanoseconds(stamp: Any) -> int:
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)


def _duration(length: float) -> int:
    """s to ns, as ros::Duration takes it."""
    whole = math.floor(length)
    return whole * 1_000_000_000 + math.floor((length - whole) * 1e9 + 0.5)


def _transform(translation: Any, rotation: Any) -> Transform:
    return Transform((translation.x, translation.y, translation.z), (rotation.x, rotation.y, rotation.z, rotation.w))


class OdometryTrack:
    """T_odom_robot by odometry messages, between two of them the pose between theirs."""

    def __init__(self) -> None:
        self.stamps: List[int] = []
        self.poses: List[Pose] = []

    def add(self, stamp: int, pose: Pose) -> None:
        at = bisect.bisect_right(self.stamps, stamp)
        self.stamps.insert(at, stamp)
        self.poses.insert(at, pose)

    def at(self, stamp: int) -> Optional[Pose]:
        """Where the stamps do not reach: the last one before; None: there is none."""
        k = bisect.bisect_left(self.stamps, stamp)
        if k < len(self.stamps) and self.stamps[k] == stamp:
            return self.poses[k]
        if k == 0:
            return None
        if k == len(self.stamps):
            return self.poses[-1]
        t = seconds(stamp - self.stamps[k - 1]) / seconds(self.stamps[k] - self.stamps[k - 1])
        p, q = self.poses[k - 1], self.poses[k]
        return (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), wrap_angle(p[2] + t * wrap_angle(q[2] - p[2])))


class Laser(NamedTuple):
    """What one laser's scans are placed by."""

    frames: RobotFrames
    fixed: str  # empty where tf tells no pose of the robot
    is_map: bool
    mount: Optional[PlanarPose]  # where somebody has told it, or nobody has
    missing_returns: MissingReturns


def product(a: Pose, b: Pose) -> Pose:
    c, s = math.cos(a[2]), math.sin(a[2])
    return (a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], wrap_angle(a[2] + b[2]))


class BagScans:
    """The scans of one laser of a recording, with what is known of their places. An iterator.

    Args:
        path: of a file or folder.
        topic: None: the one with most scans.
        base_frame, odom_frame: None: found, see `find_frames`.
        mount: (x, y, theta) of the laser on the robot, m, m, rad; None: tf tells.
        upside_down: whether the laser hangs so, where its mount is told.
    """

    def __init__(self, path: Path, topic: Optional[str] = None, base_frame: Optional[str] = None,
                 odom_frame: Optional[str] = None, mount: Optional[Pose] = None,
                 upside_down: bool = False) -> None:
        self.path = path
        self._asked = (base_frame and frame_name(base_frame), odom_frame and frame_name(odom_frame))
        self._mount = PlanarPose(mount, upside_down) if mount else None
        self._stack = ExitStack()
        self._lasers: Dict[str, Laser] = {}
        self._left_out: Dict[str, Tuple[int, str]] = {}
        self._unplaced: Dict[str, int] = {}
        self._warnings: List[str] = []
        self._read, self._fault = 0, ""
        self._recording = self._stack.enter_context(open_recording(path))
        try:
            self.topic = self._choose(topic)
            self._tf = self._read_tf()
            for name in self._asked:
                if name and name not in self._tf.frames():
                    raise ValueError(f"{path}: frame '{name}': tf has no such frame; it has "
                                     f"{', '.join(self._tf.frames()) or 'none'}")
            self._odometry_frames, self._track = self._read_odometry()
            self._messages = self._recording.messages([self.topic.name])
            self._first: Optional[LogRecord] = self._next()
            if self._first is None:
                raise ValueError(f"{path}: holds no scan of a 2-D laser ({self.warnings})")
        except BaseException:
            self._stack.close()
            raise

    @property
    def warnings(self) -> str:
        """What could not be read, and what was guessed."""
        unknown = [f"'{frame}' has no place on the robot in tf ('{laser.frames.base}'): taken for its middle, ahead and "
                   "upright; --mount tells it" for frame, laser in self._lasers.items()
                   if not laser.frames.mount_is_known and self._mount is None]
        left_out = [f"{count} impossible scan(s) left out: {first}" for count, first in self._left_out.values()]
        unplaced = [f"{count} scan(s) that tf has no pose in '{frame}' for left out"
                    for frame, count in self._unplaced.items()]
        return "; ".join(filter(None, [self._fault, *self._warnings, *unknown, *left_out, *unplaced]))

    @property
    def progress(self) -> float:
        return min(1.0, self._read / max(1, self.topic.messages))

    def __iter__(self) -> BagScans:
        return self

    def __next__(self) -> LogRecord:
        record = self._first if self._first is not None else self._next()  # one of no beams counts as false
        self._first = None
        if record is None:
            raise StopIteration
        return record

    def _next(self) -> Optional[LogRecord]:
        while True:
            try:
                _, message = next(self._messages)
            except StopIteration:
                self._stack.close()
                return None
            except Exception as error:  # rosbags', of many kinds, from a damaged part of the file
                self._fault = f"unreadable from there on: {error}"
                self._stack.close()
                return None
            self._read += 1
            try:
                record = self._record(message)
            except (Malformed, NoRing, Unplanar) as fault:
                rule = getattr(fault, "rule", str(fault))
                count, first = self._left_out.get(rule, (0, str(fault)))
                self._left_out[rule] = (count + 1, first)
                continue
            if record is not None:
                return record

    def _choose(self, asked: Optional[str]) -> Topic:
        # Clouds may be a camera's: they are read where nothing else is, or where asked for.
        clouds = self._recording.of_type(CLOUD)
        topics = self._recording.of_type(SCAN, ECHOES) or clouds
        if not topics:
            raise ValueError(f"{self.path}: holds no scan of a 2-D laser (topics: {listed(self._recording.topics)})")
        if asked is not None:
            for topic in [*topics, *clouds]:
                if frame_name(topic.name) == frame_name(asked):
                    return topic
            raise ValueError(f"{self.path}: topic '{asked}' holds no laser scans; these do: {listed(topics)}")
        chosen = max(topics, key=lambda topic: topic.messages)  # the first of these
        if len(topics) > 1:
            self._warnings.append(f"scans are those of '{chosen.name}'; --topic chooses, of {listed(topics)}")
        return chosen

    def _read_tf(self) -> Transforms:
        # Of several robots, each may have its own; where there is one for all, that is it.
        names = [topic.name for topic in self._recording.of_type(*TF)]
        of_all = [name for name in names if name in TF_OF_ALL]
        tf = Transforms()
        for topic, message in self._recording.messages(of_all or names):
            for t in message.transforms:
                tf.add(t.header.frame_id, t.child_frame_id, nanoseconds(t.header.stamp),
                       _transform(t.transform.translation, t.transform.rotation), "static" in topic)
        return tf

    def _read_odometry(self) -> Tuple[OdometryFrames, OdometryTrack]:
        frames, track = OdometryFrames(), OdometryTrack()
        topics = self._recording.of_type(ODOMETRY)
        if not topics:
            return frames, track
        for _, message in self._recording.messages([max(topics, key=lambda topic: topic.messages).name]):
            if frames == OdometryFrames():
                frames = OdometryFrames(frame_name(message.header.frame_id), frame_name(message.child_frame_id))
            try:
                track.add(nanoseconds(message.header.stamp),
                          planar(_transform(message.pose.pose.position, message.pose.pose.orientation)).pose)
            except Unplanar:
                continue
        return frames, track

    def _laser(self, frame: str) -> Laser:
        laser = self._lasers.get(frame)
        if laser is None:
            frames = find_frames(self._tf, frame, self._odometry_frames, *self._asked)
            knows = [name for name in (frames.map, frames.odom) if name and self._tf.lookup(name, frames.base, None)]
            mount = self._mount
            if mount is None and not frames.mount_is_known:
                mount = PlanarPose((0.0, 0.0, 0.0), False)
            laser = Laser(frames, knows[0] if knows else "", bool(knows) and knows[0] == frames.map, mount,
                          MissingReturns())
            self._lasers[frame] = laser
        return laser

    def _record(self, message: Any) -> Optional[LogRecord]:
        if self.topic.type == CLOUD:
            message = scan_of(message)
        ranges = ranges_of(message)
        check_header(message, ranges)
        beams = len(ranges)
        # The message is stamped with its first beam; one pose for a whole sweep errs least at its middle.
        sweep = (beams - 1.0) * message.time_increment
        sweep = sweep if beams > 1 and abs(sweep) <= SLOWEST_LASER else 0.0
        middle = nanoseconds(message.header.stamp) + _duration(0.5 * sweep)
        frame = frame_name(message.header.frame_id)
        laser = self._laser(frame)
        place = self._place(laser, frame, middle)
        if place is None:
            self._unplaced[laser.fixed] = self._unplaced.get(laser.fixed, 0) + 1
            return None
        with np.errstate(invalid="ignore"):
            meant = (ranges > 0) & (ranges >= message.range_min)
            # Drivers write the end of their scale for what has not come back.
            read = np.where(meant, np.where(ranges > message.range_max, np.inf, ranges), np.nan)
        side = -1 if place.pop("upside_down") else 1
        record = LogRecord(read, side * message.angle_min,
                           side * message.angle_increment, time=seconds(middle),
                           free_range_without_return=message.range_max if math.isfinite(message.range_max) else 0.0,
                           sweep_duration=sweep, motion=self._motion(laser, frame, middle, sweep), **place)
        laser.missing_returns.judge(record)
        return record

    def _motion(self, laser: Laser, frame: str, middle: int, sweep: float) -> Optional[List[Optional[Reading]]]:
        """Where the laser was half a sweep before the middle, then, and half a sweep after, as tf tells it."""
        if not laser.fixed:
            return None
        source = frame if laser.mount is None else laser.frames.base
        is_smooth = bool(laser.frames.odom) and self._tf.lookup(laser.frames.odom, source, middle) is not None
        target = laser.frames.odom if is_smooth else laser.fixed
        half = _duration(0.5 * (abs(sweep) if abs(sweep) > LEAST_SWEEP else USUAL_SWEEP))

        def at(stamp: int) -> Optional[Reading]:
            try:
                found = self._tf.lookup(target, source, stamp) if stamp > 0 else None
                pose = planar(found).pose if found else None
            except Unplanar:
                return None
            if pose is None:
                return None
            return seconds(stamp), pose if laser.mount is None else product(pose, laser.mount.pose)

        return [at(middle - half), at(middle), at(middle + half)]

    def _place(self, laser: Laser, frame: str, stamp: int) -> Optional[Dict[str, Any]]:
        """What tf, or else the odometry, tells of the scan's place; None: nothing, at that time."""
        base, wheels = laser.frames.base, self._track.at(stamp)
        mount = laser.mount
        if mount is None:
            joined = self._tf.lookup(base, frame, stamp)
            if joined is None:
                return None
            mount = planar(joined)
        if not laser.fixed:
            return {"sensor_pose": mount.pose, "odometry": wheels, "upside_down": mount.upside_down}
        found = self._tf.lookup(laser.fixed, base, stamp)
        if found is None:
            return None
        robot = planar(found)
        sensor = PlanarPose(product(robot.pose, mount.pose), robot.upside_down != mount.upside_down)
        if laser.mount is None:
            whole = self._tf.lookup(laser.fixed, frame, stamp)
            if whole is None:
                return None
            sensor = planar(whole)
        place = {"sensor_pose": mount.pose, "pose": sensor.pose, "upside_down": sensor.upside_down}
        if not laser.is_map:
            return {**place, "odometry": robot.pose}
        by_tf = self._tf.lookup(laser.frames.odom, base, stamp) if laser.frames.odom else None
        return {**place, "robot_pose": robot.pose, "odometry": planar(by_tf).pose if by_tf else wheels}
