#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""localizer_topics.py DEVEL_SPACE: a robot in a plan that is drawn as DXF: found without being told, then told."""
import math
import os

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from own_master import OwnMaster, main, until
from own_robot import transform

HERE = os.path.dirname(os.path.abspath(__file__))
# A room with a niche and a slanted wall: like none of its turns.
CORNERS = [(0, 0), (8, 0), (8, 4), (6, 6), (3, 6), (3, 5), (0, 5)]
TRUTH = (2.5, 2.0, 0.7)


def room_dxf():
    groups = ["0", "SECTION", "2", "ENTITIES", "0", "LWPOLYLINE", "8", "A-WALL", "90", str(len(CORNERS)), "70", "1"]
    for x, y in CORNERS:
        groups += ["10", str(x), "20", str(y)]
    return "\n".join(groups + ["0", "TEXT", "8", "A-WALL", "1", "a room", "0", "ENDSEC", "0", "EOF"]) + "\n"


def cast(x, y, angle):
    best = math.inf
    dx, dy = math.cos(angle), math.sin(angle)
    for (ax, ay), (bx, by) in zip(CORNERS, CORNERS[1:] + CORNERS[:1]):
        ex, ey = bx - ax, by - ay
        across = dx * ey - dy * ex
        if abs(across) < 1e-9:
            continue
        r = ((ax - x) * ey - (ay - y) * ex) / across
        s = ((ax - x) * dy - (ay - y) * dx) / across
        if r > 0 and 0 <= s <= 1:
            best = min(best, r)
    return best


class LocalizerTopics(OwnMaster):
    def setUp(self):
        super().setUp()
        self.plan = os.path.join(self.home.name, "room.dxf")
        with open(self.plan, "w") as file:
            file.write(room_dxf())

    def test_a_robot_is_found_in_a_dxf_and_heeds_initialpose(self):
        from cca_mrpt.msg import LineMap  # once the environment of the space is there
        self.node("localizer", "_plan:=" + self.plan)
        rospy.init_node("robot_in_a_room")
        scans = rospy.Publisher("scan", LaserScan, queue_size=5)
        tf = rospy.Publisher("/tf", TFMessage, queue_size=5)
        fixed = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        told = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
        fixed.publish([transform("base_link", "laser", (0.1, 0.0, 0.0), rospy.Time.now())])
        poses, lines, joined = [], [], []
        rospy.Subscriber("amcl_pose", PoseWithCovarianceStamped, poses.append)
        rospy.Subscriber("lines", LineMap, lines.append)
        rospy.Subscriber("/tf", TFMessage, lambda m: joined.extend(
            t for t in m.transforms if t.child_frame_id == "odom"))
        self.assertTrue(until(lambda: lines and scans.get_num_connections() > 0 and told.get_num_connections() > 0))
        self.assertEqual(len(lines[-1].lines), len(CORNERS))
        scan = LaserScan(angle_min=-math.pi, angle_increment=math.radians(1.0), range_min=0.05, range_max=12.0)
        scan.angle_max = scan.angle_min + 359 * scan.angle_increment
        x = TRUTH[0] + 0.1 * math.cos(TRUTH[2])
        y = TRUTH[1] + 0.1 * math.sin(TRUTH[2])
        scan.ranges = [cast(x, y, TRUTH[2] + scan.angle_min + k * scan.angle_increment) for k in range(360)]

        def seen():
            now = rospy.Time.now()
            tf.publish([transform("odom", "base_link", (1.0, 0.0, 0.0), now)])
            scan.header.frame_id, scan.header.stamp = "laser", now
            scans.publish(scan)
            return poses
        self.assertTrue(until(seen))
        pose = poses[-1].pose.pose
        self.assertAlmostEqual(pose.position.x, TRUTH[0], 1)
        self.assertAlmostEqual(pose.position.y, TRUTH[1], 1)
        self.assertAlmostEqual(2.0 * math.atan2(pose.orientation.z, pose.orientation.w), TRUTH[2], 1)
        self.assertGreater(poses[-1].pose.covariance[0], 0.0)
        self.assertLess(poses[-1].pose.covariance[0], 0.05 ** 2)
        self.assertTrue(until(lambda: joined))
        # p_map = T_map_odom p_odom, for the robot at (1, 0) of odom.
        last = joined[-1].transform
        turn = 2.0 * math.atan2(last.rotation.z, last.rotation.w)
        self.assertAlmostEqual(last.translation.x + math.cos(turn), TRUTH[0], 1)
        self.assertAlmostEqual(last.translation.y + math.sin(turn), TRUTH[1], 1)

        # Told to be where no laser sees the plan from: that is not heeded.
        astray = PoseWithCovarianceStamped()
        astray.header.frame_id = "map"
        astray.pose.pose.position.x, astray.pose.pose.orientation.w = 1e200, 1.0
        told.publish(astray)
        self.assertFalse(until(lambda: seen() and abs(poses[-1].pose.pose.position.x - TRUTH[0]) > 1.0, 3.0))

        # Told to be where it is not: its beams go through walls, it is lost, and found again.
        wrong = PoseWithCovarianceStamped()
        wrong.header.frame_id = "map"
        wrong.pose.pose.position.x, wrong.pose.pose.position.y = 6.0, 4.0
        wrong.pose.pose.orientation.w = 1.0
        wrong.pose.covariance[0] = wrong.pose.covariance[7] = wrong.pose.covariance[35] = 0.01
        told.publish(wrong)
        self.assertTrue(until(lambda: seen() and abs(poses[-1].pose.pose.position.x - TRUTH[0]) > 1.0))
        self.assertTrue(until(lambda: seen() and abs(poses[-1].pose.pose.position.x - TRUTH[0]) < 0.1))

    def test_a_robot_in_another_building_is_told_to_be_nowhere(self):
        node = self.node("localizer", "_plan:=" + self.plan)
        self.start("python3", os.path.join(HERE, "own_robot.py"),
                   os.path.join(HERE, "..", "..", "maps", "two_rooms.yaml"), "2,3,0", os.path.join(self.home.name, "report"))
        self.assertTrue(self.prints(node, "not localised: looking for the robot in the whole of " + self.plan))
        node.terminate()
        node.wait(timeout=60)

    def test_a_plan_that_cannot_be_read_ends_the_node_with_its_name(self):
        node = self.node("localizer", "_plan:=/nowhere/plan.dxf")
        out, _ = node.communicate(timeout=60)
        self.assertEqual(node.returncode, 2)
        self.assertIn("/nowhere/plan.dxf: cannot be read", out)

    def test_without_a_plan_it_says_which_parameter_is_missing(self):
        node = self.node("localizer")
        out, _ = node.communicate(timeout=60)
        self.assertEqual(node.returncode, 2)
        self.assertIn("~plan", out)


if __name__ == "__main__":
    main()
