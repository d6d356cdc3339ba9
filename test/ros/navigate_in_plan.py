#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""navigate_in_plan.py DEVEL_SPACE: a robot that shares no code with the project is localised by `localizer` in the plan
of a place that nobody has mapped, and driven by `explore _plan:=` to where rviz's goals are."""
import json
import math
import os

import rospy
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from std_msgs.msg import String

from own_master import OwnMaster, main, until

HERE = os.path.dirname(os.path.abspath(__file__))
MAPS = os.path.join(HERE, "..", "..", "maps")
WORLD, PLAN = os.path.join(MAPS, "two_rooms.yaml"), os.path.join(MAPS, "two_rooms.truth.csv")
START, TOLD = (2.0, 3.0, 0.0), (2.3, 2.8, 0.1)
OTHER_ROOM, OUTSIDE = (9.0, 4.0, math.pi / 2), (6.0, 30.0, 0.0)
SPEED = 5


def stamped(x, y, theta):
    pose = PoseStamped()
    pose.header.frame_id = "map"
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.z, pose.pose.orientation.w = math.sin(theta / 2), math.cos(theta / 2)
    return pose


class NavigateInPlan(OwnMaster):
    def report(self):
        try:
            with open(self.report_file) as file:
                return json.load(file)
        except (OSError, ValueError):
            return None

    def off(self, place):
        report = self.report()
        return math.inf if report is None else math.hypot(report["pose"][0] - place[0], report["pose"][1] - place[1])

    def says_status(self, word, seconds=120):
        self.assertTrue(until(lambda: any(word in text for text in self.status), seconds), self.status[-5:])

    def test_a_robot_drives_to_a_place_of_a_plan_that_it_has_not_seen(self):
        self.report_file = os.path.join(self.home.name, "report.json")
        self.ask("rosparam", "set", "/use_sim_time", "true")
        self.start("python3", os.path.join(HERE, "own_robot.py"), WORLD, "%g,%g,%g" % START, self.report_file,
                   "--speed", str(SPEED), "--latency", "0.15")
        localizer = self.node("localizer", "_plan:=" + PLAN)
        explore = self.node("explore", "_world:=none", "_pose:=tf", "_plan:=" + PLAN, "_autostart:=false", "_out:=" + self.out)
        rospy.init_node("somebody", disable_signals=True)
        self.status = []
        rospy.Subscriber("status", String, lambda message: self.status.append(message.data))
        told = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
        goal = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
        poses = []
        rospy.Subscriber("amcl_pose", PoseWithCovarianceStamped, poses.append)
        self.assertTrue(until(lambda: told.get_num_connections() > 0 and goal.get_num_connections() > 0))
        about = PoseWithCovarianceStamped()  # two rooms that are alike: somebody has to tell
        about.header.frame_id, about.pose.pose = "map", stamped(*TOLD).pose
        told.publish(about)
        self.assertTrue(until(lambda: poses), "localizer does not find the robot where it is told to be")
        self.assertLess(math.hypot(poses[-1].pose.pose.position.x - START[0],
                                   poses[-1].pose.pose.position.y - START[1]), 0.1)
        with self.subTest("into a room that it has never seen"):
            goal.publish(stamped(*OTHER_ROOM))
            self.says_status("driving")
            self.says_status("the goal is reached", 300)
            self.assertTrue(until(lambda: self.off(OTHER_ROOM) < 0.25, 5), self.report())
        with self.subTest("a place that the plan has no way to"):
            self.status.clear()
            goal.publish(stamped(*OUTSIDE))
            self.says_status("unreachable")
        self.assertEqual(self.report()["contacts"], 0)
        for node in (explore, localizer):
            self.assertIsNone(node.poll(), node.poll() is not None and node.communicate()[0])


if __name__ == "__main__":
    main()
