#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""own_robot.py WORLD.yaml X,Y,DEG REPORT.json [--latency S] [--localised] [--wrong-until S [--path]] [--speed N]
             [--seed N] [--bend DEG] [--stretch F] [--late S] [--told-mount X,Y,DEG] [--two-lasers | --turning-laser]
             [--upside-down] [--bar X1,Y1,X2,Y2 --bar-seen-by points|range]

A robot that shares no code with the project: a disc on two wheels, whose base answers late and has limits,
whose odometry is 2 % too long and turns a degree a metre (or --bend), and whose laser sees 270 degrees, hangs off the
centre, and errs by 1 cm. Gives /clock, scan, odom and tf, takes cmd_vel; --localised: also map -> odom, the
truth, which it is WRONG by for the first --wrong-until seconds; --path: then it tells where the robot has been,
as corrected_path. --two-lasers: one looks ahead, one back, 150 degrees each, as scan_front and scan_rear.
--turning-laser: a cheap one that looks all around in SLOW_SWEEP, beam by beam, clockwise, and loses LOST of them (+inf).
--upside-down: lasers that see all at once hang so, and tf says it. --late: stamps of scans are
so much behind. --told-mount: where tf has the laser, whatever is so. --bar: lies
below their plane; hazard_points or hazard_range tell what is within SHORT_SIGHT ahead. Time stands until a
scan has been answered: how fast the machine is decides nothing. REPORT: contacts, share of the cells that it
can see at all and has seen, metres, seconds, the last true pose, where it was, every APART metres and at the end."""
import argparse
import collections
import json
import math
import os
import threading
import time

import numpy
import rospy
import yaml
from geometry_msgs.msg import Pose, PoseStamped, Quaternion, TransformStamped, Twist
from nav_msgs.msg import Odometry, Path
from PIL import Image
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan, PointCloud2, PointField, Range
from tf2_msgs.msg import TFMessage

TICK, TICKS_A_WORD, TICKS_A_SCAN = 0.025, 2, 4  # s; clock, tf and odom at 20 Hz: most of what a drive costs is to send them
RADIUS, MAX_V, MAX_W, ACCELERATION, TURN_ACCELERATION = 0.25, 0.7, 1.5, 1.0, 4.0
DEADMAN = 0.5  # s without a command until the base stops
# s of the wall: time that nobody answers in goes on, once somebody has and before; what comes of the clock
# alone, a watchdog's repetition, is no answer to the scan that follows.
PATIENCE, FIRST_PATIENCE, SETTLING = 2.0, 0.2, 0.003
LASER = (0.12, 0.05, math.radians(5.0))  # in the robot
BEAMS, FIELD, RANGE, NOISE = 541, math.radians(270.0), 8.0, 0.01
WRONG = (1.0, 0.4, 0.1)
FRONT, REAR = (0.15, 0.0, 0.0), (-0.15, 0.0, math.pi)
HALF_BEAMS, HALF_FIELD = 301, math.radians(150.0)
SHORT_SIGHT, SHORT_FIELD = 0.8, math.radians(20.0)
SHORT_BEARINGS = [math.radians(degrees) for degrees in (-80, -60, -40, -20, 0, 20, 40, 60, 80)]
SLOW_TICKS, SLOW_BEAMS, LOST = 7, 360, 0.03
SLOW_SWEEP = SLOW_TICKS * TICK * (SLOW_BEAMS - 1) / SLOW_BEAMS  # s
STRETCH = 1.02  # of the odometry
SPACING = 0.2  # m, between the places that what can be seen at all is looked for from
APART = 0.2  # m


class World:
    """Occupied cells as map_server reads them; row 0 is the lowest."""

    def __init__(self, path):
        with open(path) as file:
            told = yaml.safe_load(file)
        grey = numpy.asarray(Image.open(os.path.join(os.path.dirname(path), told["image"])).convert("L"))
        self.resolution, self.origin = told["resolution"], numpy.array(told["origin"][:2])
        self.occupied = numpy.ascontiguousarray(((255.0 - grey) / 255.0 > told["occupied_thresh"])[::-1])
        self.seen = numpy.zeros_like(self.occupied)

    def cells(self, x, y):
        """Rows and columns; what lies outside counts as the edge."""
        rows, columns = self.occupied.shape
        row = numpy.floor((y - self.origin[1]) / self.resolution).astype(int)
        column = numpy.floor((x - self.origin[0]) / self.resolution).astype(int)
        return numpy.clip(row, 0, rows - 1), numpy.clip(column, 0, columns - 1)

    def cast(self, x, y, bearings):
        """Ranges to the first occupied cell, inf beyond RANGE; what the beams pass is seen. x, y: one for all beams,
        or one each."""
        steps = numpy.arange(0.5, RANGE / self.resolution * 2.0, dtype=numpy.float32) * 0.5
        c, s = numpy.cos(bearings), numpy.sin(bearings)
        rows, columns = self.occupied.shape
        # In cells, in single precision: this is what the robot's time goes to.
        from_x = numpy.float32((x - self.origin[0]) / self.resolution).reshape(-1, 1)
        from_y = numpy.float32((y - self.origin[1]) / self.resolution).reshape(-1, 1)
        along_x = from_x + c.astype(numpy.float32)[:, None] * steps
        along_y = from_y + s.astype(numpy.float32)[:, None] * steps
        column = numpy.clip(along_x.astype(numpy.int32), 0, columns - 1)
        row = numpy.clip(along_y.astype(numpy.int32), 0, rows - 1)
        cell = row * columns + column
        hits = self.occupied.ravel()[cell]
        first = numpy.where(hits.any(axis=1), hits.argmax(axis=1), len(steps))
        passed = numpy.arange(len(steps)) < first[:, None]
        self.seen.ravel()[cell[passed]] = True
        last = numpy.minimum(first, len(steps) - 1)
        beams = numpy.arange(len(bearings))
        left = self.origin[0] + column[beams, last] * self.resolution - x
        low = self.origin[1] + row[beams, last] * self.resolution - y
        with numpy.errstate(divide="ignore", invalid="ignore"):
            across = numpy.minimum(left / c, (left + self.resolution) / c)
            along = numpy.minimum(low / s, (low + self.resolution) / s)
        ranges = numpy.fmax(across, along)
        ranges[(first == len(steps)) | (ranges > RANGE)] = numpy.inf
        return ranges

    def clearance(self, x, y):
        """m, to the nearest occupied cell; inf beyond half a metre."""
        reach = int(0.5 / self.resolution) + 1
        row, column = self.cells(numpy.array(x), numpy.array(y))
        rows, columns = numpy.nonzero(self.occupied[max(0, row - reach):row + reach + 1,
                                                    max(0, column - reach):column + reach + 1])
        if len(rows) == 0:
            return math.inf
        low = self.origin[1] + (rows + max(0, row - reach)) * self.resolution
        left = self.origin[0] + (columns + max(0, column - reach)) * self.resolution
        dx = numpy.maximum(numpy.maximum(left - x, x - left - self.resolution), 0.0)
        dy = numpy.maximum(numpy.maximum(low - y, y - low - self.resolution), 0.0)
        return numpy.hypot(dx, dy).min()

    def share_seen(self, cells):
        return float((self.seen & cells).sum() / cells.sum())

    def keeping(self, distance, of_cell):
        """Cells that keep a distance (m) from what is occupied: at their centre (of_cell 0.5), anywhere in them (1)."""
        reach = int(distance / self.resolution) + 1
        around = numpy.pad(self.occupied, reach)
        rows, columns = self.occupied.shape
        free = numpy.ones_like(self.occupied)
        for i in range(-reach, reach + 1):
            for j in range(-reach, reach + 1):
                if math.hypot(max(abs(i) - of_cell, 0.0), max(abs(j) - of_cell, 0.0)) * self.resolution < distance:
                    free &= ~around[reach + i:reach + i + rows, reach + j:reach + j + columns]
        return free

    def standable(self, x, y):
        """Cells that the robot gets to from here without touching anything."""
        free = self.keeping(RADIUS, 0.5)
        row, column = self.cells(numpy.array(x), numpy.array(y))
        reached = numpy.zeros_like(free)
        reached[row, column] = True
        size = 0
        while reached.sum() > size:
            size = reached.sum()
            for _ in range(20):
                grown = reached.copy()
                grown[1:] |= reached[:-1]
                grown[:-1] |= reached[1:]
                grown[:, 1:] |= reached[:, :-1]
                grown[:, :-1] |= reached[:, 1:]
                reached = grown & free
        return reached

    def visible(self, x, y):
        """Cells that a beam passes from anywhere the robot gets to from here: a lattice of SPACING, 361 beams."""
        step = max(1, round(SPACING / self.resolution))
        places = numpy.argwhere(self.standable(x, y)[::step, ::step]) * step + 0.5
        bearings = numpy.linspace(-math.pi, math.pi, 361)
        seen, self.seen = self.seen, numpy.zeros_like(self.occupied)
        for k, (row, column) in enumerate(places):
            turn = k * 0.618 % 1.0 * (bearings[1] - bearings[0])  # not all along the same directions
            self.cast(self.origin[0] + column * self.resolution, self.origin[1] + row * self.resolution,
                      bearings + turn)
        seen, self.seen = self.seen, seen
        return seen


def compose(pose, step):
    x, y, theta = pose
    return (x + step[0] * math.cos(theta) - step[1] * math.sin(theta),
            y + step[0] * math.sin(theta) + step[1] * math.cos(theta), theta + step[2])


def inverse(pose):
    x, y, theta = pose
    return (-x * math.cos(theta) - y * math.sin(theta), x * math.sin(theta) - y * math.cos(theta), -theta)


def towards(value, wanted, most):
    return value + max(-most, min(most, wanted - value))


def pose_message(pose):
    message = Pose()
    message.position.x, message.position.y = pose[:2]
    message.orientation.z, message.orientation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
    return message


def transform(parent, child, pose, stamp):
    message = TransformStamped()
    message.header.stamp, message.header.frame_id, message.child_frame_id = stamp, parent, child
    message.transform.translation.x, message.transform.translation.y = pose[:2]
    message.transform.rotation = pose_message(pose).orientation
    return message


def odometry_message(pose, v, w, stamp):
    odometry = Odometry()
    odometry.header.stamp, odometry.header.frame_id, odometry.child_frame_id = stamp, "odom", "base_link"
    odometry.pose.pose = pose_message(pose)
    odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = v, w
    return odometry


def write_report(path, figures):
    """Whole or not at all: others read it at any time."""
    with open(path + ".new", "w") as file:
        json.dump(figures, file)
    os.replace(path + ".new", path)


class OwnRobot:
    def __init__(self, options):
        self.options, self.world = options, World(options.world)
        x, y, degrees = (float(word) for word in options.start.split(","))
        self.pose, self.odometry = (x, y, math.radians(degrees)), (3.0, -2.0, 0.5)
        self.to_see = self.world.visible(x, y)
        self.random = numpy.random.RandomState(options.seed)
        self.v = self.w = self.time = self.way = 0.0
        self.contacts, self.touches, self.status = 0, False, ""
        self.has_heard, self.answer = False, threading.Event()
        self.told, self.command = collections.deque(), (-math.inf, 0.0, 0.0)
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.tf_static = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self.odom = rospy.Publisher("odom", Odometry, queue_size=50)
        lasers = [("scan", "laser", LASER, FIELD, BEAMS)]
        self.ticks_a_scan = SLOW_TICKS if options.turning_laser else TICKS_A_SCAN
        self.way_lately = collections.deque([(0.0, *self.pose)], maxlen=SLOW_TICKS + 1)
        if options.two_lasers:
            lasers = [("scan_rear", "laser_rear", REAR, HALF_FIELD, HALF_BEAMS),
                      ("scan_front", "laser_front", FRONT, HALF_FIELD, HALF_BEAMS)]
        self.lasers = [(rospy.Publisher(laser[0], LaserScan, queue_size=10), *laser[1:]) for laser in lasers]
        told = [laser[2] for laser in lasers]
        if options.told_mount:
            mx, my, degrees = map(float, options.told_mount.split(","))
            told = [(mx, my, math.radians(degrees))]
        frames = [transform("base_link", laser[1], mount, self.now()) for laser, mount in zip(lasers, told)]
        if options.upside_down:
            for frame in frames:  # half a turn about the beam ahead, then the mount's own turn
                z, w = frame.transform.rotation.z, frame.transform.rotation.w
                frame.transform.rotation = Quaternion(w, z, 0.0, 0.0)
        frames += [transform("base_link", "ranger_%d" % k, (0, 0, bearing), self.now())
                   for k, bearing in enumerate(SHORT_BEARINGS)]
        self.tf_static.publish(frames)
        self.bar = numpy.zeros((0, 2))
        if options.bar:
            x1, y1, x2, y2 = map(float, options.bar.split(","))
            self.bar = numpy.linspace((x1, y1), (x2, y2), 1 + int(100 * math.hypot(x2 - x1, y2 - y1)))
        self.points = rospy.Publisher("hazard_points", PointCloud2, queue_size=10)
        self.range = rospy.Publisher("hazard_range", Range, queue_size=100)
        self.past, self.has_told_path = [], False  # stamps and true poses at the scans
        self.places = [self.pose[:2]]
        self.path = rospy.Publisher("corrected_path", Path, queue_size=1)
        rospy.Subscriber("cmd_vel", Twist, self.take, tcp_nodelay=True)

    def now(self):
        return rospy.Time.from_sec(1.0 + self.time)

    def take(self, twist):
        self.has_heard = True
        self.answer.set()
        self.told.append((self.time + self.options.latency, twist.linear.x, twist.angular.z))

    def drive(self):
        while self.told and self.told[0][0] <= self.time:
            self.command = self.told.popleft()
        at, v, w = self.command
        if self.time - at > DEADMAN:
            v = w = 0.0
        self.v = towards(self.v, max(-MAX_V, min(MAX_V, v)), ACCELERATION * TICK)
        self.w = towards(self.w, max(-MAX_W, min(MAX_W, w)), TURN_ACCELERATION * TICK)
        half = 0.5 * self.w * TICK
        step = (self.v * TICK * math.cos(half), self.v * TICK * math.sin(half), 2.0 * half)
        there = compose(self.pose, step)
        to_bar = numpy.hypot(*(self.bar - there[:2]).T).min(initial=math.inf)
        touches = bool(min(self.world.clearance(*there[:2]), to_bar) < RADIUS)
        self.contacts += touches and not self.touches
        self.touches = touches
        if touches:
            self.v, step = 0.0, (0.0, 0.0, step[2])
        self.pose = compose(self.pose, step)
        self.way += abs(self.v) * TICK
        stretch = self.options.stretch
        self.odometry = compose(self.odometry, (stretch * step[0], stretch * step[1],
                                                step[2] + math.radians(self.options.bend) * abs(self.v) * TICK))
        self.time += TICK
        self.way_lately.append((self.time, *self.pose))

    def tell_path(self):
        path = Path()
        path.header.frame_id = "map"
        for stamp, pose in self.past:
            stamped = PoseStamped(pose=pose_message(pose))
            stamped.header.stamp, stamped.header.frame_id = stamp, "map"
            path.poses.append(stamped)
        self.path.publish(path)
        self.has_told_path = True
        time.sleep(0.2)  # of the wall: it is there before the next scan

    def tell(self):
        stamp = self.now()
        if self.options.path and not self.has_told_path and self.time >= self.options.wrong_until:
            self.tell_path()
        self.clock.publish(stamp)
        transforms = [transform("odom", "base_link", self.odometry, stamp)]
        if self.options.localised:
            map_odom = compose(self.pose, inverse(self.odometry))
            if self.time < self.options.wrong_until:
                map_odom = compose(WRONG, map_odom)
            transforms.append(transform("map", "odom", map_odom, stamp))
        self.tf.publish(transforms)
        self.odom.publish(odometry_message(self.odometry, self.v, self.w, stamp))

    def look(self):
        self.feel()
        self.past.append((self.now(), self.pose))
        if math.dist(self.pose[:2], self.places[-1]) >= APART:
            self.places.append(self.pose[:2])
        time.sleep(SETTLING)
        self.answer.clear()
        if self.options.turning_laser:
            scan = self.turn_round()
            scan.header.stamp -= rospy.Duration(self.options.late)
            self.lasers[0][0].publish(scan)
            self.answer.wait(PATIENCE if self.has_heard else FIRST_PATIENCE)
            return
        for publisher, frame, T_robot_laser, field, beams in self.lasers:
            scan = LaserScan()
            scan.header.stamp, scan.header.frame_id = self.now() - rospy.Duration(self.options.late), frame
            scan.angle_min, scan.angle_max = -0.5 * field, 0.5 * field
            scan.angle_increment = field / (beams - 1)
            scan.scan_time, scan.range_min, scan.range_max = self.ticks_a_scan * TICK, 0.02, RANGE
            x, y, theta = compose(self.pose, T_robot_laser)
            bearings = numpy.linspace(-0.5 * field, 0.5 * field, beams)
            ranges = self.world.cast(x, y, theta + (-bearings if self.options.upside_down else bearings))
            scan.ranges = (ranges + self.random.normal(0.0, NOISE, beams)).tolist()
            publisher.publish(scan)
        self.answer.wait(PATIENCE if self.has_heard else FIRST_PATIENCE)

    def turn_round(self):
        """A scan, each beam of which was taken when the laser had come round to it, the last one now."""
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = self.now() - rospy.Duration(SLOW_SWEEP), "laser"
        scan.angle_increment = -2.0 * math.pi / SLOW_BEAMS
        scan.angle_min, scan.angle_max = math.pi, math.pi + (SLOW_BEAMS - 1) * scan.angle_increment
        scan.time_increment, scan.scan_time = SLOW_SWEEP / (SLOW_BEAMS - 1), SLOW_TICKS * TICK
        scan.range_min, scan.range_max = 0.02, RANGE
        times = self.time + scan.time_increment * numpy.arange(1 - SLOW_BEAMS, 1)
        known, x, y, theta = numpy.array(self.way_lately).T
        x, y, theta = (numpy.interp(times, known, values) for values in (x, y, theta))
        lx, ly, turned = LASER
        x, y = x + lx * numpy.cos(theta) - ly * numpy.sin(theta), y + lx * numpy.sin(theta) + ly * numpy.cos(theta)
        bearings = theta + turned + scan.angle_min + scan.angle_increment * numpy.arange(SLOW_BEAMS)
        ranges = self.world.cast(x, y, bearings) + self.random.normal(0.0, NOISE, SLOW_BEAMS)
        ranges[self.random.uniform(size=SLOW_BEAMS) < LOST] = numpy.inf
        scan.ranges = ranges.tolist()
        return scan

    def feel(self):
        """What the sensors near the ground tell of the bar."""
        x, y, theta = self.pose
        c, s = math.cos(theta), math.sin(theta)
        near = (self.bar - (x, y)) @ numpy.array([[c, -s], [s, c]])
        near = near[numpy.hypot(*near.T) < SHORT_SIGHT]
        bearings = numpy.arctan2(near[:, 1], near[:, 0])
        if self.options.bar_seen_by == "points":
            ahead = near[abs(bearings) < SHORT_BEARINGS[-1]]
            cloud = PointCloud2(height=1, width=len(ahead), point_step=12, row_step=12 * len(ahead))
            cloud.header.stamp, cloud.header.frame_id = self.now(), "base_link"
            cloud.fields = [PointField(name, 4 * k, PointField.FLOAT32, 1) for k, name in enumerate("xyz")]
            cloud.data = numpy.hstack([ahead, numpy.zeros((len(ahead), 1))]).astype(numpy.float32).tobytes()
            self.points.publish(cloud)
        if self.options.bar_seen_by == "range":
            for k, bearing in enumerate(SHORT_BEARINGS):
                message = Range(field_of_view=SHORT_FIELD, min_range=0.02, max_range=SHORT_SIGHT)
                message.header.stamp, message.header.frame_id = self.now(), "ranger_%d" % k
                seen = near[abs(bearings - bearing) < 0.5 * SHORT_FIELD]
                message.range = numpy.hypot(*seen.T).min(initial=math.inf)
                self.range.publish(message)

    def report(self):
        write_report(self.options.report,
                     {"contacts": self.contacts, "seen": self.world.share_seen(self.to_see), "way_m": self.way,
                      "time_s": self.time, "pose": self.pose, "places": [*self.places, self.pose[:2]]})

    def run(self):
        tick = 0
        while not rospy.is_shutdown():
            begin = time.time()
            self.drive()
            if tick % TICKS_A_WORD == 0:
                self.tell()
            if tick % self.ticks_a_scan == 0:
                self.look()
            if tick % 50 == 0:
                self.report()
            tick += 1
            time.sleep(max(0.0, begin + TICK / self.options.speed - time.time()))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("world", "start", "report"):
        parser.add_argument(name)
    parser.add_argument("--latency", type=float, default=0.0)
    parser.add_argument("--speed", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--bend", type=float, default=1.0)
    parser.add_argument("--stretch", type=float, default=STRETCH)
    parser.add_argument("--late", type=float, default=0.0)
    parser.add_argument("--told-mount")
    parser.add_argument("--turning-laser", action="store_true")
    parser.add_argument("--upside-down", action="store_true")
    parser.add_argument("--localised", action="store_true")
    parser.add_argument("--wrong-until", type=float, default=0.0)
    parser.add_argument("--path", action="store_true")
    parser.add_argument("--two-lasers", action="store_true")
    parser.add_argument("--bar")
    parser.add_argument("--bar-seen-by", choices=["points", "range"])
    rospy.init_node("own_robot", disable_rostime=True)
    OwnRobot(parser.parse_args(rospy.myargv()[1:])).run()


if __name__ == "__main__":
    main()
