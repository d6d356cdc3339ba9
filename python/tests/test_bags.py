# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of every kind, written by `rosbags`, hold the same scans and places."""
import gzip
import math
from pathlib import Path

import numpy as np
import pytest

import cca_mrpt
from cca_mrpt.transforms import Transform, Transforms, planar
from room_log import ROOM, ranges_in

rosbags = pytest.importorskip("rosbags")
from rosbags.typesys import Stores, get_types_from_msg, get_typestore  # noqa: E402

MOUNT = (0.2, 0.1, 0.3)
POSES = [(0.1 * k, 0.02 * k, 0.05 * k) for k in range(12)]
BEAMS = dict(angle_min=-1.5, angle_increment=0.02, beams=151)
PERIOD = 0.1  # s


def product(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return (a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2])


class Drive:
    """Messages of a robot with a laser, as (topic, type, stamp, message)."""

    def __init__(self, store, **change):
        self.types, self.store = store.types, store
        self.change = {"base": "base_link", "odom": "odom", "laser": "laser", "static": True, "tf": True, "odometry": False,
                       "upside_down": False, "echoes": False, "rings": (), "lost": (), "topic": "/scan", **change}

    def make(self, name, *values):
        return self.types[name](*values)

    def header(self, stamp, frame):
        time = self.make("builtin_interfaces/msg/Time", int(stamp), round((stamp - int(stamp)) * 1e9))
        if "seq" in self.types["std_msgs/msg/Header"].__dataclass_fields__:
            return self.make("std_msgs/msg/Header", 0, time, frame)
        return self.make("std_msgs/msg/Header", time, frame)

    def quaternion(self, theta, upside_down=False):
        s, c = math.sin(theta / 2), math.cos(theta / 2)
        # Upside down: half a turn about the laser's own x axis first.
        return self.make("geometry_msgs/msg/Quaternion", *((c, s, 0.0, 0.0) if upside_down else (0.0, 0.0, s, c)))

    def transform(self, stamp, parent, child, pose, upside_down=False):
        shift = self.make("geometry_msgs/msg/Vector3", pose[0], pose[1], 0.4)
        return self.make("tf2_msgs/msg/TFMessage", [self.make(
            "geometry_msgs/msg/TransformStamped", self.header(stamp, parent), child,
            self.make("geometry_msgs/msg/Transform", shift, self.quaternion(pose[2], upside_down)))])

    def scan(self, stamp, pose):
        sensor = product(pose, MOUNT)
        ranges = ranges_in(ROOM, sensor, **BEAMS)
        if self.change["upside_down"]:  # the same walls, the other way round
            ranges = ranges_in(ROOM, sensor, -BEAMS["angle_min"], -BEAMS["angle_increment"], BEAMS["beams"])
        first, step = BEAMS["angle_min"], BEAMS["angle_increment"]
        if self.change["rings"]:
            return "sensor_msgs/msg/PointCloud2", self.cloud(stamp, ranges)
        common = (self.header(stamp, self.change["laser"]), first, first + 150 * step, step, 0.0, PERIOD, 0.05, 30.0)
        if self.change["echoes"]:
            echo = [self.make("sensor_msgs/msg/LaserEcho", np.array([r, r + 1], np.float32)) for r in ranges]
            return "sensor_msgs/msg/MultiEchoLaserScan", self.make("sensor_msgs/msg/MultiEchoLaserScan", *common, echo, [])
        return "sensor_msgs/msg/LaserScan", self.make("sensor_msgs/msg/LaserScan", *common, ranges.astype(np.float32),
                                                      np.zeros(0, np.float32))

    def cloud(self, stamp, ranges):
        bearings = BEAMS["angle_min"] + BEAMS["angle_increment"] * np.arange(len(ranges))
        seen = np.delete(np.arange(len(ranges)), self.change["lost"])
        points = [np.stack([np.full(len(seen), 7), (ranges * np.cos(bearings))[seen], (ranges * np.sin(bearings))[seen],
                            ranges[seen] * math.tan(elevation)], axis=-1) for elevation in self.change["rings"]]
        data = np.concatenate(points).astype(np.float32)
        fields = [self.make("sensor_msgs/msg/PointField", name, 4 * k, 7, 1) for k, name in enumerate(("intensity", *"xyz"))]
        return self.make("sensor_msgs/msg/PointCloud2", self.header(stamp, self.change["laser"]), 1, len(data), fields, False,
                         16, 16 * len(data), np.frombuffer(data.tobytes(), np.uint8), True)

    def odometry(self, stamp, pose):
        point = self.make("geometry_msgs/msg/Point", pose[0], pose[1], 0.0)
        zero = self.make("geometry_msgs/msg/Vector3", 0.0, 0.0, 0.0)
        return self.make("nav_msgs/msg/Odometry", self.header(stamp, self.change["odom"]), self.change["base"],
                         self.make("geometry_msgs/msg/PoseWithCovariance",
                                   self.make("geometry_msgs/msg/Pose", point, self.quaternion(pose[2])), np.zeros(36)),
                         self.make("geometry_msgs/msg/TwistWithCovariance",
                                   self.make("geometry_msgs/msg/Twist", zero, zero), np.zeros(36)))

    def __iter__(self):
        c = self.change
        if c["static"]:
            yield "/tf_static", "tf2_msgs/msg/TFMessage", 0.9, self.transform(0.9, c["base"], c["laser"], MOUNT,
                                                                              c["upside_down"])
        for k, pose in enumerate(POSES):
            stamp = 1.0 + PERIOD * k
            if c["tf"]:
                yield "/tf", "tf2_msgs/msg/TFMessage", stamp, self.transform(stamp, c["odom"], c["base"], pose)
            if c["odometry"]:
                yield "/odom", "nav_msgs/msg/Odometry", stamp, self.odometry(stamp, pose)
            yield (c["topic"], *self.with_stamp(stamp, pose))

    def with_stamp(self, stamp, pose):
        kind, message = self.scan(stamp, pose)
        return kind, stamp, message


def write(writer, drive, serialize):
    with writer:
        connections = {}
        for topic, kind, stamp, message in drive:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=drive.store)
            writer.write(connections[topic], round(stamp * 1e9), serialize(message, kind))


def ros1(path, compression=None, **change):
    from rosbags.rosbag1 import Writer

    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
    writer = Writer(path)
    if compression:
        writer.set_compression(Writer.CompressionFormat[compression])
    write(writer, Drive(store, **change), store.serialize_ros1)
    return path


def ros2(path, storage, compression=None, **change):
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    store = get_typestore(Stores.ROS2_HUMBLE)
    writer = Writer(path, version=8, storage_plugin=StoragePlugin[storage])
    if compression:
        writer.set_compression(CompressionMode[compression], CompressionFormat.ZSTD)
    write(writer, Drive(store, **change), store.serialize_cdr)
    return path


def gzipped(path):
    bag = ros1(path.with_suffix(".bag"))
    with gzip.open(path, "wb") as file:
        file.write(bag.read_bytes())
    return path


def single(path, storage, suffix):
    (file,) = ros2(path, storage).glob("*" + suffix)
    return file


KINDS = {
    "ros1": lambda p: ros1(p / "a.bag"),
    "ros1_bz2": lambda p: ros1(p / "a.bag", "BZ2"),
    "ros1_lz4": lambda p: ros1(p / "a.bag", "LZ4"),
    "ros1_gzipped": lambda p: gzipped(p / "a.bag.gz"),
    "ros1_other_name": lambda p: ros1(p / "a.bag").rename(p / "drive"),
    "ros2_folder_sqlite": lambda p: ros2(p / "a", "SQLITE3"),
    "ros2_folder_mcap": lambda p: ros2(p / "a", "MCAP"),
    "ros2_zstd_messages": lambda p: ros2(p / "a", "SQLITE3", "MESSAGE"),
    "ros2_zstd_file": lambda p: ros2(p / "a", "SQLITE3", "FILE"),
    "db3": lambda p: single(p / "a", "SQLITE3", ".db3"),
    "mcap": lambda p: single(p / "a", "MCAP", ".mcap"),
}


def check_drive(scans):
    assert len(scans) == len(POSES)
    for scan, pose in zip(scans, POSES):
        assert scan.odometry == pytest.approx(pose, abs=1e-9) and scan.robot_pose is None
        assert scan.sensor_pose == pytest.approx(MOUNT, abs=1e-9)
        assert scan.pose == pytest.approx(product(pose, MOUNT), abs=1e-9)
        assert np.allclose(scan.ranges, ranges_in(ROOM, product(pose, MOUNT), **BEAMS), atol=1e-5)
        assert (scan.angle_min, scan.angle_increment) == pytest.approx((-1.5, 0.02))


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_holds_the_same(kind, tmp_path):
    log = cca_mrpt.read_log(KINDS[kind](tmp_path))
    scans = list(log)
    check_drive(scans)
    assert log.warnings == "" and log.progress == 1.0
    assert scans[1].time == pytest.approx(1.1)
    check_drive(list(log))  # a log may be looped over again


@pytest.mark.parametrize("change", [
    dict(base="robot1/base_link", odom="robot1/odom", laser="robot1/laser"),
    dict(base="/base_link", odom="/odom", laser="/laser"),
    dict(base="chassis", odom="world"),  # what moves carries the laser
    dict(tf=False, odometry=True),
    dict(tf=False, odometry=True, base="trunk"),  # the odometry's child frame
    dict(echoes=True),
    dict(topic="/robot/front/scan"),
    dict(rings=(0.0,)),  # a point cloud
])
def test_frames_are_found_however_they_are_named(change, tmp_path):
    check_drive(list(cca_mrpt.read_log(ros1(tmp_path / "a.bag", **change))))


def test_a_cloud_is_a_scan_where_it_is_of_one_ring(tmp_path):
    lost = [0, 40, 41, 150]
    for scan in cca_mrpt.read_log(ros2(tmp_path / "a", "MCAP", rings=(0.02,), lost=lost)):
        assert scan.angle_min == pytest.approx(BEAMS["angle_min"] + 0.02, abs=1e-6) and len(scan) == 149
        assert list(np.flatnonzero(np.isnan(scan.ranges))) == [39, 40]  # of lost beams nothing is known
    with pytest.raises(ValueError, match="12 impossible scan.* must be of one ring .elevations of 0.0 to 1.7 degrees"):
        cca_mrpt.read_log(ros2(tmp_path / "b", "MCAP", rings=(0.0, 0.03)))


def test_a_laser_upside_down_sweeps_the_other_way(tmp_path):
    scans = list(cca_mrpt.read_log(ros1(tmp_path / "a.bag", upside_down=True)))
    assert (scans[0].angle_min, scans[0].angle_increment) == pytest.approx((1.5, -0.02))
    walls = cca_mrpt.LineMap()
    for scan in scans:
        walls.insert(scan.ranges, scan.angle_min, scan.angle_increment, scan.pose)
    assert np.allclose(np.abs(walls.lines()["ends"]).max(axis=(0, 1)), (3, 2), atol=0.05)


def test_an_unknown_mount_is_named_and_may_be_told(tmp_path):
    bag = ros1(tmp_path / "a.bag", static=False)
    log = cca_mrpt.read_log(bag)
    assert list(log)[0].sensor_pose == (0, 0, 0) and "'laser' has no place on the robot" in log.warnings
    check_drive(list(cca_mrpt.read_log(bag, mount=MOUNT)))


def test_a_sweep_is_placed_by_its_middle():
    tf = Transforms()
    turn = lambda theta: Transform((theta, 0.0, 0.0), (0.0, 0.0, math.sin(theta / 2), math.cos(theta / 2)))  # noqa: E731
    tf.add("odom", "base", 0, turn(0.0), False)
    tf.add("odom", "base", 100, turn(0.8), False)
    assert planar(tf.lookup("odom", "base", 25)).pose == pytest.approx((0.2, 0, 0.2))
    assert planar(tf.lookup("base", "odom", 100)).pose == pytest.approx((-0.8 * math.cos(0.8), 0.8 * math.sin(0.8), -0.8))
    assert tf.lookup("odom", "base", 101) is None and tf.lookup("odom", "laser", 0) is None


def test_what_is_asked_for_and_not_there_is_said(tmp_path):
    bag = ros1(tmp_path / "a.bag")
    with pytest.raises(ValueError, match=r"topic '/lidar' holds no laser scans; these do: '/scan'"):
        cca_mrpt.read_log(bag, topic="/lidar")
    with pytest.raises(ValueError, match=r"frame 'trunk': tf has no such frame; it has base_link, laser, odom"):
        cca_mrpt.read_log(bag, base_frame="trunk")
    (tmp_path / "carmen.log").write_text("FLASER 3 1 1 1 0 0 0 0 0 0 1 host 1\n")
    with pytest.raises(ValueError, match="topic is for ROS bags"):
        cca_mrpt.read_log(tmp_path / "carmen.log", topic="/scan")


@pytest.mark.parametrize("keep", [0.2, 0.5, 0.9])
@pytest.mark.parametrize("kind", ["ros1", "db3", "mcap", "ros1_gzipped"])
def test_a_broken_recording_ends_in_words(kind, keep, tmp_path):
    whole = KINDS[kind](tmp_path)
    broken = tmp_path / ("broken" + "".join(whole.suffixes[-2:]))
    broken.write_bytes(whole.read_bytes()[:int(keep * whole.stat().st_size)])
    try:
        log = cca_mrpt.read_log(broken)
        scans = list(log)
        assert 0 < len(scans) <= len(POSES)
    except ValueError as error:
        assert str(broken) in str(error)


def test_a_recorder_that_was_killed_leaves_what_it_had_written(tmp_path):
    whole = KINDS["mcap"](tmp_path)
    data = whole.read_bytes()
    broken = tmp_path / "broken.mcap"
    broken.write_bytes(data[:-200])  # summary and footer
    check_drive(list(cca_mrpt.read_log(broken)))


SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"


@pytest.mark.skipif(not SHARED.exists(), reason="needs the project's shared data")
def test_three_recordings_of_one_drive_hold_the_same():
    logs = [list(cca_mrpt.read_log(SHARED / "bags" / name)) for name in ("intel.bag", "intel_sqlite3", "intel_mcap")]
    assert [len(scans) for scans in logs] == [300, 300, 300]
    for scans in zip(*logs):
        assert len({(scan.pose, scan.time, scan.ranges.tobytes()) for scan in scans}) == 1
