#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag_round_trip.py DEVEL_SPACE: a bag played back gives the map that it gives offline, to the byte."""
import json
import math
import os
import signal

import numpy
import rosbag
import rospy
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from own_master import NODES, OwnMaster, main, until
from own_robot import LASER, compose, transform
from segments import cast, distance_to, read_segments, samples

WORLD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "maps", "two_rooms.truth.csv")
SPEEDS = 5, 40
BEGIN, SECONDS = 1000.0, 20.0


class AwkwardBag:
    """A drive around a room of two_rooms, as robots record it: tf at other times than the scans and later
    than them, from two nodes; scans before tf begins and after it ends, with lost beams, without any
    return, stamped tomorrow; and a localisation that leaps, to come back and for good."""

    def __init__(self, path):
        self.walls, self.random = read_segments(WORLD), numpy.random.RandomState(1)
        self.messages = []  # (recorded at, topic, message)
        self.add(0.0, "/tf_static", TFMessage([transform("base_link", "laser", LASER, self.at(0.0))]))
        for t in numpy.arange(0.5, SECONDS - 0.5, 0.033):
            self.add(t + 0.02, "/tf", TFMessage([transform("odom", "base_link", self.pose(t), self.at(t))]))
        for t in numpy.arange(0.7, SECONDS - 0.9, 0.21):
            leap = 0.8 if 8.0 < t < 8.6 else 0.6 if t > 14.0 else 0.0
            self.add(t + 0.3, "/tf", TFMessage([transform("map", "odom", (leap, 0.0, 0.02 * t), self.at(t))]))
        for k, t in enumerate(numpy.arange(0.0, SECONDS, 0.1)):
            self.add(t + 0.05, "/scan", self.scan(t, blind=k in (50, 51), off=86400.0 if k == 60 else 0.0))
        with rosbag.Bag(path, "w") as bag:
            for recorded, topic, message in sorted(self.messages, key=lambda m: m[0]):
                bag.write(topic, message, self.at(recorded))

    def add(self, recorded, topic, message):
        self.messages.append((recorded, topic, message))

    @staticmethod
    def at(t):
        return rospy.Time.from_sec(BEGIN + t)

    @staticmethod
    def pose(t):
        a = 0.4 * t
        return 2.5 + 0.9 * math.sin(a), 3.0 - 0.9 * math.cos(a), a

    def scan(self, t, blind, off):
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = self.at(t + off), "/laser"
        scan.angle_min, scan.angle_max, scan.angle_increment = -2.35, 2.35, 4.7 / 360.0
        scan.time_increment, scan.range_min, scan.range_max = 0.0, 0.02, 80.0
        bearings = scan.angle_min + scan.angle_increment * numpy.arange(361)
        x, y, theta = compose(self.pose(t), LASER)
        ranges = cast(self.walls, x, y, theta + bearings) + self.random.normal(0.0, 0.01, 361)
        ranges[self.random.uniform(size=361) < (1.0 if blind else 0.1)] = numpy.inf
        scan.ranges = ranges.tolist()
        return scan


class WheelsOnlyBag(AwkwardBag):
    """The same drive of a robot that nobody localises: its wheels turn a little too far, and count from where
    it has stood for a while."""

    def __init__(self, path):
        self.walls, self.random = read_segments(WORLD), numpy.random.RandomState(2)
        self.messages = []
        self.add(0.0, "/tf_static", TFMessage([transform("base_link", "laser", LASER, self.at(0.0))]))
        for t in numpy.arange(0.0, SECONDS, 0.033):
            self.add(t + 0.02, "/tf", TFMessage([transform("odom", "base_link", self.by_wheels(t), self.at(t))]))
        for t in numpy.arange(0.3, SECONDS - 0.5, 0.1):
            self.add(t + 0.05, "/scan", self.scan(max(t - 1.0, 0.0), blind=False, off=min(t, 1.0)))
        with rosbag.Bag(path, "w") as bag:
            for recorded, topic, message in sorted(self.messages, key=lambda m: m[0]):
                bag.write(topic, message, self.at(recorded))

    def by_wheels(self, t):
        a = 0.4 * max(t - 1.0, 0.0)
        return 0.9 * math.sin(1.02 * a), 0.9 * (1.0 - math.cos(1.02 * a)), 1.02 * a


class SweepingBag(WheelsOnlyBag):
    """The same by a laser whose last beam is .09 s later than its first one, with or without a driver that says so."""

    SWEEP = 0.09

    def __init__(self, path, says_so):
        self.says_so = says_so
        super().__init__(path)

    def scan(self, t, blind, off):
        scan = super().scan(t, blind, off)
        ranges = numpy.array(scan.ranges)
        begin = t if self.says_so else t - self.SWEEP / 2
        late = self.SWEEP * numpy.arange(361) / 360
        x, y, theta = numpy.transpose([compose(self.pose(begin + s if off >= 1.0 else t), LASER) for s in late])
        beams = theta + scan.angle_min + scan.angle_increment * numpy.arange(361)
        swept = cast(self.walls, x, y, beams) + self.random.normal(0.0, 0.01, 361)
        ranges[numpy.isfinite(ranges)] = swept[numpy.isfinite(ranges)]
        scan.ranges = ranges.tolist()
        scan.time_increment = self.SWEEP / 360 if self.says_so else 0.0
        return scan


class BagRoundTrip(OwnMaster):
    def record(self):
        bag = os.path.join(self.home.name, "run.bag")
        explore = self.node("explore", "_world:=two_rooms", "_speed:=10", "_record:=" + bag,
                            "_exit_at_end:=true", "_out:=" + self.out)
        output, _ = explore.communicate(timeout=100)
        self.assertEqual(explore.returncode, 0, output)
        self.assertTrue(os.path.exists(bag), output)
        self.assertFalse(os.path.exists(bag + ".active"))
        return bag

    def map_offline(self, bag, pose):
        """@return the folder of the map, and the scans in it."""
        folder = os.path.join(self.home.name, "offline")
        done = self.start(os.path.join(NODES, "cca-mrpt"), "map", bag, "--out", folder, "--pose", pose, "--force")
        output, _ = done.communicate(timeout=60)
        self.assertIn(done.returncode, (0, 3), output)  # 3: a localisation that leaps contradicts the map
        with open(os.path.join(folder, "summary.json")) as file:
            return folder, json.load(file)["scans"]

    def map_played(self, bag, speed, scans, pose):
        folder = os.path.join(self.home.name, "played_%d" % speed)
        mapper = self.node("line_mapper", "_out:=" + folder, "_save_at_end:=true", "_pose:=" + pose)
        self.assertTrue(until(lambda: "/scan" in (self.ask("rosnode", "info", "/line_mapper") or "")))
        # --wait-for-subscribers waits for every topic played, and nobody listens to odom here.
        play = self.start("rosbag", "play", "--clock", "--quiet", "--wait-for-subscribers", "--keep-alive",
                          "--queue", "5000", "-r", str(speed), bag,
                          "--topics", "/scan", "/tf", "/tf_static")
        self.says("/diagnostics", 'key: "scans used"\n        value: "%d"' % scans, 60.0 + 100.0 / speed)
        mapper.send_signal(signal.SIGINT)
        output, _ = mapper.communicate(timeout=40)
        self.assertEqual(mapper.returncode, 0, output)
        play.terminate()
        play.communicate(timeout=40)
        self.assertTrue(os.path.exists(os.path.join(folder, "lines.csv")), output)
        return folder, output

    def check(self, bag, offline_pose="log", pose="tf", speeds=SPEEDS):
        self.ask("rosparam", "set", "/use_sim_time", "true")
        offline, scans = self.map_offline(bag, offline_pose)
        expected = read_segments(os.path.join(offline, "lines.csv"))
        self.assertGreater(len(expected), 5)
        for speed in speeds:
            with self.subTest(speed=speed):
                played, output = self.map_played(bag, speed, scans, pose)
                with open(os.path.join(offline, "lines.csv")) as a, open(os.path.join(played, "lines.csv")) as b:
                    self.assertEqual(a.read(), b.read(), output)
        return expected

    def test_an_exploration_played_back_gives_the_bytes_of_the_offline_program(self):
        self.ask("rosparam", "set", "/use_sim_time", "true")
        bag = self.record()
        told = self.ask("rosbag", "info", bag)
        for word in ("/scan", "sensor_msgs/LaserScan", "/tf_static", "/odom"):
            self.assertIn(word, told)
        with rosbag.Bag(bag) as recorded:  # from the first sweep on, which began before the run did
            self.assertEqual(self.map_offline(bag, "log")[1], recorded.get_message_count("/scan"))
        explored, offline = read_segments(os.path.join(self.out, "lines.csv")), self.check(bag)
        # The explorer had ranges of 64 bits, the bag has 32, and tf each 20 ms.
        for distances in (distance_to(explored, samples(offline)), distance_to(offline, samples(explored))):
            self.assertLess(distances.max(), 0.01)

    def test_so_does_a_bag_whose_scans_and_poses_do_not_fit_each_other(self):
        bag = os.path.join(self.home.name, "awkward.bag")
        AwkwardBag(bag)
        self.check(bag)

    def test_so_does_line_slam_where_nobody_tells_the_pose(self):
        bag = os.path.join(self.home.name, "wheels.bag")
        WheelsOnlyBag(bag)
        lines = self.check(bag, offline_pose="slam", pose="slam")
        self.assertLess(len(lines), 25)  # of walls that are drawn once

    def test_so_does_a_laser_that_sweeps(self):
        for says_so in (True, False):
            with self.subTest(says_so=says_so):
                bag = os.path.join(self.home.name, "sweep_%d.bag" % says_so)
                SweepingBag(bag, says_so)
                lines = self.check(bag, offline_pose="slam", pose="slam", speeds=SPEEDS[1:])
                self.assertLess(len(lines), 25)


if __name__ == "__main__":
    main()
