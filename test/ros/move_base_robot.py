#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""move_base_robot.py WORLD.yaml X,Y,DEG REPORT.json [--speed N] [--abort N] [--reject N] [--lose N]

A robot that is driven by a move_base of its own: the action takes goals in the map, knows the world as it is,
and leads the robot there on its cells. It shares no code with the project, and does not listen to cmd_vel.
Gives /clock, scan, odom and tf with true poses. --abort: that many goals, the first ones, are aborted a second
after they came; --reject: refused as they come; --lose: forgotten a second after they came, as by a move_base that
was started anew. SIGUSR1 silences its laser, and gives it back.

Its time stands for up to PATIENCE where the explorer's lines are older than BEHIND: how fast the machine is
decides nothing. REPORT: contacts, share of the cells that it can see and has seen, metres, seconds, goals by what became
of them, whether there is one now."""
import argparse
import heapq
import math
import signal
import time

import actionlib
import numpy
import rospy
from move_base_msgs.msg import MoveBaseAction
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from cca_mrpt.msg import LineMap
from own_robot import RANGE, World, compose, odometry_message, towards, transform, write_report

TICK, TICKS_A_SCAN = 0.05, 2  # s
RADIUS, KEPT = 0.25, 0.3  # m, its own; between its centre and what is occupied, where there is a way
MAX_V, MAX_W, ACCELERATION = 0.6, 1.5, 1.0
BEAMS, NOISE = 361, 0.01  # all around
AT_GOAL, AT_HEADING, AHEAD = 0.1, 0.1, 0.15  # m, rad; m to the point of its way that it steers for
NEAR_GOAL = 0.5  # m, from the goal to the cell that it stops at instead
BEHIND, PATIENCE = 0.45, 1.0  # s of the robot, of the wall
REPORT_PERIOD = 0.3  # s of the wall
LASER = (0.1, 0.0, 0.0)


class Ways:
    """Shortest ways on the cells that the robot may stand on."""

    def __init__(self, world):
        self.world = world
        self.free = world.keeping(KEPT, 1.0)

    def cell(self, x, y):
        row, column = self.world.cells(numpy.array(x), numpy.array(y))
        return int(row), int(column)

    def place(self, cell):
        return (self.world.origin[0] + (cell[1] + 0.5) * self.world.resolution,
                self.world.origin[1] + (cell[0] + 0.5) * self.world.resolution)

    def nearest_free(self, x, y):
        """Within NEAR_GOAL of a place, or None."""
        row, column = self.cell(x, y)
        reach = int(NEAR_GOAL / self.world.resolution)
        around = [(math.hypot(r - row, c - column), (r, c))
                  for r in range(max(0, row - reach), min(self.free.shape[0], row + reach + 1))
                  for c in range(max(0, column - reach), min(self.free.shape[1], column + reach + 1))
                  if self.free[r, c]]
        return min(around)[1] if around else None

    def between(self, start, goal):
        """Places from one to the other; empty where there is no way."""
        first, last = self.nearest_free(*start), self.nearest_free(*goal)
        if first is None or last is None:
            return []
        reached, queue = {first: (0.0, None)}, [(0.0, first)]
        while queue:
            cost, cell = heapq.heappop(queue)
            if cell == last:
                break
            if cost > reached[cell][0]:
                continue
            for row, column in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)):
                there = cell[0] + row, cell[1] + column
                on = cost + math.hypot(row, column)
                inside = 0 <= there[0] < self.free.shape[0] and 0 <= there[1] < self.free.shape[1]
                if inside and self.free[there] and on < reached.get(there, (math.inf,))[0]:
                    reached[there] = on, cell
                    heapq.heappush(queue, (on, there))
        way, cell = [], last if last in reached else None
        while cell is not None:
            way.append(self.place(cell))
            cell = reached[cell][1]
        return way[::-1]


def wrap(angle):
    return math.remainder(angle, 2.0 * math.pi)


class PickyServer(actionlib.SimpleActionServer):
    """Refuses goals, and forgets that it had one."""

    def __init__(self, reject, goals):
        self.to_reject, self.goals = reject, goals
        super().__init__("move_base", MoveBaseAction, auto_start=False)

    def internal_goal_callback(self, goal):
        if self.goals["rejected"] < self.to_reject:
            self.goals["rejected"] += 1
            return goal.set_rejected(text="it does not please me")
        return super().internal_goal_callback(goal)

    def forget(self):
        with self.lock:
            wanted = self.current_goal.get_goal_id().id
            kept = [tracker for tracker in self.action_server.status_list if tracker.status.goal_id.id != wanted]
            self.action_server.status_list[:] = kept
            self.current_goal, self.preempt_request = actionlib.ServerGoalHandle(), False
        self.action_server.publish_status()


class MoveBaseRobot:
    def __init__(self, options):
        self.options, self.world = options, World(options.world)
        self.ways = Ways(self.world)
        x, y, degrees = (float(word) for word in options.start.split(","))
        self.pose = (x, y, math.radians(degrees))
        self.to_see = self.world.visible(x, y)
        self.random = numpy.random.RandomState(1)
        self.v = self.w = self.time = self.metres = 0.0
        self.contacts, self.touches, self.sees, self.mapped_at = 0, False, True, None
        self.goal, self.way, self.accepted_at = None, [], 0.0
        self.goals = {"accepted": 0, "reached": 0, "aborted": 0, "preempted": 0, "rejected": 0, "lost": 0}
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.tf_static = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self.odom = rospy.Publisher("odom", Odometry, queue_size=50)
        self.scan = rospy.Publisher("scan", LaserScan, queue_size=10)
        self.tf_static.publish([transform("base_link", "laser", LASER, self.now())])
        rospy.Subscriber("lines", LineMap, self.take_lines, tcp_nodelay=True)
        self.server = PickyServer(options.reject, self.goals)
        self.server.start()
        signal.signal(signal.SIGUSR1, lambda *_: setattr(self, "sees", not self.sees))

    def now(self):
        return rospy.Time.from_sec(1.0 + self.time)

    def take_lines(self, lines):
        self.mapped_at = lines.header.stamp.to_sec() - 1.0

    def heed_goals(self):
        if self.server.is_new_goal_available():
            if self.goal is not None:
                self.goals["preempted"] += 1
            target = self.server.accept_new_goal().target_pose
            assert target.header.frame_id == "map", target.header.frame_id
            self.goals["accepted"] += 1
            self.goal = (target.pose.position.x, target.pose.position.y,
                         2.0 * math.atan2(target.pose.orientation.z, target.pose.orientation.w))
            self.way, self.accepted_at = self.ways.between(self.pose[:2], self.goal[:2]), self.time
        elif self.goal is not None and self.server.is_preempt_requested():
            self.end("preempted", self.server.set_preempted)

    def end(self, word, say):
        self.goals[word] += 1
        self.goal = None
        say()

    def steer(self):
        """Speeds towards the goal; zero where there is none."""
        if self.goal is None:
            return 0.0, 0.0
        if self.goals["lost"] < self.options.lose:
            if self.time - self.accepted_at > 1.0:
                self.end("lost", self.server.forget)
            return 0.0, 0.0
        if not self.way or self.goals["aborted"] < self.options.abort:
            if not self.way or self.time - self.accepted_at > 1.0:
                self.end("aborted", self.server.set_aborted)
            return 0.0, 0.0
        x, y, theta = self.pose
        while len(self.way) > 1 and math.hypot(self.way[0][0] - x, self.way[0][1] - y) < AHEAD:
            self.way.pop(0)
        ahead = (self.way[0][0] - x, self.way[0][1] - y)
        if len(self.way) == 1 and math.hypot(*ahead) < AT_GOAL:
            off = wrap(self.goal[2] - theta)
            if abs(off) < AT_HEADING:
                self.end("reached", self.server.set_succeeded)
                return 0.0, 0.0
            return 0.0, 2.0 * off
        off = wrap(math.atan2(ahead[1], ahead[0]) - theta)
        slow = math.hypot(*ahead) if len(self.way) == 1 else MAX_V
        return (min(slow, MAX_V) if abs(off) < 0.3 else 0.0), 2.0 * off

    def drive(self):
        v, w = self.steer()
        self.v = towards(self.v, v, ACCELERATION * TICK)
        self.w = max(-MAX_W, min(MAX_W, w))
        half = 0.5 * self.w * TICK
        there = compose(self.pose, (self.v * TICK * math.cos(half), self.v * TICK * math.sin(half), 2.0 * half))
        touches = bool(self.world.clearance(*there[:2]) < RADIUS)
        self.contacts += touches and not self.touches
        self.touches = touches
        self.pose = (*self.pose[:2], there[2]) if touches else there
        self.metres += 0.0 if touches else abs(self.v) * TICK
        self.time += TICK

    def tell(self):
        stamp = self.now()
        self.clock.publish(stamp)
        self.tf.publish([transform("map", "odom", (0.0, 0.0, 0.0), stamp),
                         transform("odom", "base_link", self.pose, stamp)])
        self.odom.publish(odometry_message(self.pose, self.v, self.w, stamp))

    def look(self):
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = self.now(), "laser"
        scan.angle_min, scan.angle_max = -math.pi, math.pi
        scan.angle_increment = 2.0 * math.pi / (BEAMS - 1)
        scan.scan_time, scan.range_min, scan.range_max = TICKS_A_SCAN * TICK, 0.02, RANGE
        x, y, theta = compose(self.pose, LASER)
        ranges = self.world.cast(x, y, theta + numpy.linspace(-math.pi, math.pi, BEAMS))
        scan.ranges = (ranges + self.random.normal(0.0, NOISE, BEAMS)).tolist()
        self.scan.publish(scan)
        end = time.time() + PATIENCE
        while self.mapped_at is not None and self.time - self.mapped_at > BEHIND and time.time() < end:
            time.sleep(0.0005)
        if time.time() >= end:
            self.mapped_at = None  # it has been told to stop

    def report(self):
        write_report(self.options.report,
                     {"contacts": self.contacts, "seen": self.world.share_seen(self.to_see), "way_m": self.metres,
                      "time_s": self.time, "goals": self.goals, "has_goal": self.goal is not None})

    def run(self):
        tick, reported = 0, 0.0
        while not rospy.is_shutdown():
            begin = time.time()
            self.heed_goals()
            self.drive()
            self.tell()
            if tick % TICKS_A_SCAN == 0 and self.sees:
                self.look()
            if begin - reported > REPORT_PERIOD:
                self.report()
                reported = begin
            tick += 1
            time.sleep(max(0.0, begin + TICK / self.options.speed - time.time()))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("world", "start", "report"):
        parser.add_argument(name)
    parser.add_argument("--speed", type=float, default=1.0)
    for name in ("--abort", "--reject", "--lose"):
        parser.add_argument(name, type=int, default=0)
    rospy.init_node("move_base_robot")
    MoveBaseRobot(parser.parse_args(rospy.myargv()[1:])).run()


if __name__ == "__main__":
    main()
