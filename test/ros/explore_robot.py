#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Simulator and explorer as separate processes, joined by scan, tf, odom and cmd_vel only."""
import os
import time
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Path
from rosgraph_msgs.msg import Log
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from cca_mrpt.msg import LineMap
from ros_watch import Watch, places
from segments import distance_to, in_view, read_segments


class ExploreRobot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("explore_robot")
        cls.status = Watch("status", String)
        cls.commands = Watch("cmd_vel", Twist)
        cls.tf = Watch("/tf", TFMessage)
        cls.tf_static = Watch("/tf_static", TFMessage)
        cls.log = Watch("/rosout", Log)

    def test_1_explores_to_the_end(self):
        self.assertIsNotNone(self.status.wait(lambda m: m.data.startswith("finished"), 200),
                             self.status.messages[-1:])

    def test_2_commands_stay_within_the_limits_and_end_with_zero(self):
        self.assertGreater(len(self.commands.messages), 50)
        self.assertEqual(self.commands.senders, {"/explore"})
        for twist in self.commands.messages:
            self.assertLessEqual(abs(twist.linear.x), 0.7 + 1e-9)
            self.assertLessEqual(abs(twist.angular.z), 1.5 + 1e-9)
        self.assertIsNotNone(self.commands.wait(lambda m: (m.linear.x, m.angular.z) == (0.0, 0.0)))

    def test_3_nothing_was_touched(self):
        self.assertFalse([m.msg for m in self.log.messages if "collision" in m.msg])

    def test_4_only_the_robot_sends_transforms(self):
        self.assertEqual(self.tf.senders | self.tf_static.senders, {"/simulator"})

    def test_5_lines_are_the_true_walls(self):
        truth = read_segments(rospy.get_param("~truth"))
        lines = rospy.wait_for_message("lines", LineMap, 20).lines  # the last: status may overtake it
        mapped = numpy.array([[line.start.x, line.start.y, line.end.x, line.end.y] for line in lines])
        middles = 0.5 * (mapped[:, :2] + mapped[:, 2:])
        self.assertLess(distance_to(truth, middles).max(), 0.1)
        seen = in_view(truth, places(rospy.wait_for_message("trajectory", Path, 20)))
        self.assertGreater(len(seen), 100)
        self.assertGreater((distance_to(mapped, seen) < 0.05).mean(), 0.95)

    def test_6_the_map_was_saved_at_the_end(self):
        summary = os.path.join(rospy.get_param("~out"), "summary.json")
        end = time.time() + 60.0
        while time.time() < end and not os.path.exists(summary):
            time.sleep(0.2)
        self.assertTrue(os.path.exists(summary))


if __name__ == "__main__":
    rostest.rosrun("cca_mrpt", "explore_robot", ExploreRobot)
