#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""line_mapper_topics.py DEVEL_SPACE: scans of several echoes; what roslaunch tells of the launch files."""
import glob
import math
import os

import rospy
from sensor_msgs.msg import LaserEcho, MultiEchoLaserScan
from tf2_msgs.msg import TFMessage

from own_master import OwnMaster, main, until
from own_robot import transform

LAUNCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "launch_scripts", "*.launch")


class LineMapperTopics(OwnMaster):
    def test_the_first_of_several_echoes_is_mapped(self):
        """A wall 2 m ahead; the second echoes are another one, a metre behind."""
        from cca_mrpt.msg import LineMap  # once the environment of the space is there
        self.node("line_mapper", "_out:=" + self.out)
        rospy.init_node("echoes")
        scans = rospy.Publisher("scan", MultiEchoLaserScan, queue_size=5)
        tf = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        tf.publish([transform("map", "laser", (0.0, 0.0, 0.0), rospy.Time.now())])
        self.assertTrue(until(lambda: scans.get_num_connections() > 0))
        bearings = [-0.8 + 0.01 * k for k in range(161)]
        scan = MultiEchoLaserScan(angle_min=-0.8, angle_max=0.8, angle_increment=0.01, range_min=0.1, range_max=10.0)
        scan.ranges = [LaserEcho(echoes=[2.0 / math.cos(b), 3.0 / math.cos(b)]) for b in bearings]
        lines = []
        rospy.Subscriber("lines", LineMap, lambda m: lines.append(m.lines))

        def mapped():
            scan.header.frame_id, scan.header.stamp = "laser", rospy.Time.now()
            scans.publish(scan)
            return lines and lines[-1]
        self.assertTrue(until(mapped))
        self.assertEqual(len(lines[-1]), 1)
        self.assertAlmostEqual(lines[-1][0].start.x, 2.0, 2)

    def test_no_argument_of_a_launch_file_is_required(self):
        files = glob.glob(LAUNCH)
        self.assertEqual(len(files), 4)
        for file in files:
            told = self.ask("roslaunch", "--ros-args", file)
            self.assertIn("Optional Arguments", told)
            self.assertNotIn("Required", told, file)


if __name__ == "__main__":
    main()
