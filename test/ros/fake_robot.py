# SPDX-License-Identifier: BSD-3-Clause
"""A robot that does as it is told, also when that is wrong: scan, odom and tf with faults on demand."""
import math
import threading
import time

import numpy
import rospy
from geometry_msgs.msg import TransformStamped, Twist
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from segments import cast

PERIOD, BEAMS, RANGE, NOISE = 0.1, 181, 8.0, 0.005
NAP = 0.005  # s


class FakeRobot:
    """Drives by cmd_vel among the given walls. Faults: sends_scans, sends_transforms, is_held, leap (m that the
    localisation is off in x), delay (s by which stamps lie in the past), period (s), spoil (changes a scan)."""

    def __init__(self, walls, x, y):
        self.walls, self.x, self.y, self.theta = walls, x, y, 0.0
        self.sends_scans = self.sends_transforms = True
        self.is_held = False
        self.leap = self.delay = 0.0
        self.period = PERIOD
        self.spoil = lambda scan: None
        self.commands = []  # (time of arrival [s], linear [m/s], angular [rad/s])
        self.scans = []  # times at which they were sent [s]
        self._scan = rospy.Publisher("scan", LaserScan, queue_size=10)
        self._tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self._tf_static = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self._tf_static.publish([self._transform("base_link", "laser", 0, 0, 0, rospy.Time.now())])
        self.listen()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def listen(self):
        self._cmd_vel = rospy.Subscriber("cmd_vel", Twist, self._take, tcp_nodelay=True)

    def go_deaf(self):
        self._cmd_vel.unregister()

    def moves(self):
        """Whether the last command, not older than half a second, is to move."""
        if not self.commands or time.time() - self.commands[-1][0] > 0.5:
            return False
        return self.commands[-1][1:] != (0.0, 0.0)

    def wait_until_moves(self, seconds=10.0):
        end = time.time() + seconds
        while time.time() < end and not self.moves():
            time.sleep(0.02)
        return self.moves()

    def seconds_until_told_to_stop(self, longest=10.0):
        """From now to the first command of zero (longest where none comes), less what the machine was
        late meanwhile: the time by which short sleeps here were overslept. Idle machines are not."""
        begin, late = time.time(), 0.0
        while time.time() < begin + longest:
            if any(t > begin and (v, w) == (0.0, 0.0) for t, v, w in self.commands):
                return time.time() - begin - late
            nap = time.time()
            time.sleep(NAP)
            late += max(0.0, time.time() - nap - 2 * NAP)
        return longest

    def _take(self, twist):
        self.commands.append((time.time(), twist.linear.x, twist.angular.z))

    def _transform(self, parent, child, x, y, theta, stamp):
        transform = TransformStamped()
        transform.header.stamp, transform.header.frame_id = stamp, parent
        transform.child_frame_id = child
        transform.transform.translation.x, transform.transform.translation.y = x, y
        transform.transform.rotation.z = math.sin(theta / 2)
        transform.transform.rotation.w = math.cos(theta / 2)
        return transform

    def _run(self):
        while not rospy.is_shutdown():
            begin = time.time()
            self._drive()
            self._tell()
            time.sleep(max(0.0, begin + self.period - time.time()))

    def _drive(self):
        if self.is_held or not self.moves():
            return
        _, v, w = self.commands[-1]
        self.x += v * self.period * math.cos(self.theta)
        self.y += v * self.period * math.sin(self.theta)
        self.theta += w * self.period

    def _tell(self):
        stamp = rospy.Time.now() - rospy.Duration(self.delay)
        if self.sends_transforms:
            self._tf.publish([
                self._transform("map", "odom", self.leap, 0, 0, stamp),
                self._transform("odom", "base_link", self.x, self.y, self.theta, stamp)])
        if not self.sends_scans:
            return
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = stamp, "laser"
        scan.angle_min, scan.angle_max = -math.pi, math.pi
        scan.angle_increment = 2 * math.pi / (BEAMS - 1)
        scan.scan_time, scan.range_max = self.period, RANGE
        bearings = self.theta + scan.angle_min + scan.angle_increment * numpy.arange(BEAMS)
        ranges = cast(self.walls, self.x, self.y, bearings)
        ranges += numpy.random.normal(0.0, NOISE, len(ranges))  # no laser gives one scan twice
        ranges[ranges > RANGE] = math.inf
        scan.ranges = ranges.tolist()
        self.spoil(scan)
        self.scans.append(time.time())
        self._scan.publish(scan)
