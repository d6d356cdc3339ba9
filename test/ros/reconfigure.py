#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""reconfigure.py DEVEL_SPACE: what dynamic_reconfigure changes of `explore` while it drives a robot."""

import dynamic_reconfigure.client
import rospy
from geometry_msgs.msg import Twist

from own_master import OwnMaster, main, until
from ros_watch import Watch


class ReconfigureExplore(OwnMaster):
    def test_a_running_robot_drives_slower(self):
        self.node("simulator", "_world:=apartment")
        self.node("explore", "_world:=none", "_pose:=tf", "_out:=" + self.out)
        rospy.init_node("reconfigure")
        commands = Watch("cmd_vel", Twist)
        self.assertIsNotNone(commands.wait(lambda m: m.linear.x > 0.4, 60.0), "it should drive fast")
        client = dynamic_reconfigure.client.Client("explore", timeout=30)
        described = {p["name"]: p for p in client.get_parameter_descriptions(timeout=30)}
        self.assertEqual(described["max_linear_velocity"]["default"], 0.7)
        self.assertEqual(described["latency"]["max"], 0.5)
        self.assertNotIn("radius", described)
        told = client.update_configuration({"max_linear_velocity": 0.2, "scan_timeout": 9.0})
        self.assertEqual((told["max_linear_velocity"], told["scan_timeout"]), (0.2, 5.0))
        self.assertEqual(rospy.get_param("/explore/robot/max_linear_velocity"), 0.2)
        self.assertEqual(client.get_configuration(timeout=30)["latency"], 0.15)
        slow = lambda speeds: max(speeds) <= 0.2 + 1e-9 and sum(v > 0.1 for v in speeds) > 50
        self.assertTrue(until(lambda: slow([m.linear.x for m in commands.messages[-100:]])))


if __name__ == "__main__":
    main()
