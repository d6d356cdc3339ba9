#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""goals.py DEVEL_SPACE: `explore` is sent to places as a move_base is, beside a robot of its own process, and asked for
its map."""
import math
import os
import subprocess
import time

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Point, PoseStamped, Twist
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid, Path
from nav_msgs.srv import GetMap
from std_msgs.msg import String
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from own_master import NODES, OwnMaster, main, until
from own_robot import compose
from ros_watch import Watch, yaw

SPEED = 4  # of the wall's time
IN_A_WALL = (3.0, -0.5)  # outside of two_rooms
OTHER_ROOM = (7.0, 2.0)  # where the robot does not start


def stamped(x, y, theta, frame="map"):
    pose = PoseStamped()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.z, pose.pose.orientation.w = math.sin(theta / 2), math.cos(theta / 2)
    return pose


class Robot:
    """Where the simulator says that it is."""

    def __init__(self):
        self.joints = {}
        self._watch = [rospy.Subscriber(topic, TFMessage, self._take) for topic in ("/tf", "/tf_static")]

    def _take(self, message):
        for t in message.transforms:
            self.joints[t.header.frame_id.lstrip("/"), t.child_frame_id.lstrip("/")] = (
                t.transform.translation.x, t.transform.translation.y, yaw(t.transform.rotation))

    def pose(self):
        return compose(self.joints["map", "odom"], self.joints["odom", "base_link"])

    def off(self, x, y):
        return math.dist(self.pose()[:2], (x, y))


class Goals(OwnMaster):
    def test_it_drives_where_it_is_sent_and_says_how_that_ended(self):
        self.ask("rosparam", "set", "/use_sim_time", "true")
        self.node("simulator", "_world:=two_rooms", "_speed:=%d" % SPEED)
        recorded = os.path.join(self.home.name, "run.bag")
        labels = os.path.join(self.home.name, "labels.csv")
        with open(labels, "w") as file:
            file.write("x,y,name\n%f,%f,the other one\n" % OTHER_ROOM)
        explore = self.node("explore", "_labels:=" + labels, "_world:=none", "_pose:=tf", "_out:=" + self.out, "_save_at_end:=false",
                            "_record:=" + recorded)
        rospy.init_node("goals")
        self.status, self.commands = Watch("status", String), Watch("cmd_vel", Twist)
        self.robot, markers = Robot(), Watch("robot_markers", MarkerArray)
        self.assertIsNotNone(self.status.wait(lambda m: m.data.startswith("exploring"), 60))
        self.assertTrue(until(lambda: len(self.commands.messages) > 20))
        start = self.robot.pose()

        with self.subTest("a goal of rviz, while it explores"):
            simple = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
            self.assertTrue(until(lambda: simple.get_num_connections() > 0))
            simple.publish(stamped(start[0] + 0.5, start[1], 2.0))
            self.expect("driving")
            self.expect("paused: the goal is reached")
            self.assertLess(self.robot.off(start[0] + 0.5, start[1]), 0.25)
            self.assertLess(abs(math.remainder(self.robot.pose()[2] - 2.0, 2 * math.pi)), 0.2)
        self.assertTrue(any("exploring" in m.text for a in markers.messages for m in a.markers))

        client = actionlib.SimpleActionClient("explore/goal", MoveBaseAction)
        self.assertTrue(until(client.wait_for_server))
        with self.subTest("the action, in the frame of the robot"):
            begin = self.robot.pose()
            self.send(client, stamped(0.0, 0.0, math.pi, "base_link"))
            self.assertEqual(self.outcome(client), GoalStatus.SUCCEEDED)
            self.assertGreater(abs(math.remainder(self.robot.pose()[2] - begin[2], 2 * math.pi)), 2.8)
        with self.subTest("a place that no way leads to"):
            begin = rospy.get_time()
            self.send(client, stamped(*IN_A_WALL, 0.0))
            self.assertEqual(self.outcome(client), GoalStatus.ABORTED)
            self.assertIn("unreachable", client.get_goal_status_text())
            self.assertLess(rospy.get_time() - begin, 30.0)
        with self.subTest("no such frame, and no pose at all"):
            for goal, why in ((stamped(1.0, 1.0, 0.0, "nowhere"), "nowhere"),
                              (stamped(math.nan, 1.0, 0.0), "rigid")):
                self.send(client, goal)
                self.assertEqual(self.outcome(client), GoalStatus.ABORTED)
                self.assertIn(why, client.get_goal_status_text())
        with self.subTest("cancelled"):
            self.send(client, stamped(*start))
            time.sleep(0.3)
            client.cancel_goal()
            self.assertEqual(self.outcome(client), GoalStatus.PREEMPTED)
            self.expect("paused: cancelled")
        with self.subTest("it explores on, and is sent back once it has finished"):
            self.assertTrue(rospy.ServiceProxy("explore/pause", SetBool)(False).success)
            self.expect("finished", 200)
            self.send(client, stamped(*start))
            self.assertEqual(self.outcome(client, 120), GoalStatus.SUCCEEDED)
            self.assertLess(self.robot.off(*start[:2]), 0.25)
            self.expect("finished: the goal is reached")
        with self.subTest("to a room, by its name and by its id"):
            from cca_mrpt.srv import DriveToRoom, RoomAt  # once the environment of the space is there

            to_room = rospy.ServiceProxy("explore/drive_to_room", DriveToRoom)
            room_at = rospy.ServiceProxy("explore/room_at", RoomAt)
            home = room_at(Point(start[0], start[1], 0.0))
            answer = to_room("the other one")
            self.assertTrue(answer.success, answer.message)
            self.assertNotEqual(answer.id, home.id)
            place = answer.goal.pose.position
            self.assertEqual(room_at(place).id, answer.id)
            self.assertTrue(until(lambda: self.robot.off(place.x, place.y) < 0.25, 60), answer)
            answer = to_room(str(home.id))
            self.assertTrue(answer.success, answer.message)
            place = answer.goal.pose.position
            self.assertTrue(until(lambda: self.robot.off(place.x, place.y) < 0.25, 60), answer)
            answer = to_room("cellar")
            self.assertFalse(answer.success)
            self.assertIn("'the other one'", answer.message)
            self.assertFalse(to_room("").success)
        with self.subTest("a patrol, with a place in between that no way leads to"):
            patrol = rospy.Publisher("patrol", Path, queue_size=1)
            self.assertTrue(until(lambda: patrol.get_num_connections() > 0))
            places = [(start[0] + 1.0, start[1]), start[:2]]
            path = Path(poses=[stamped(*places[0], 0.0), stamped(*IN_A_WALL, 0.0), stamped(*places[1], 0.0)])
            patrol.publish(path)
            for place in (*places, places[0]):  # and round again
                self.assertTrue(until(lambda place=place: self.robot.off(*place) < 0.25, 60), place)
            patrol.publish(Path())
            time.sleep(2.0)
            self.assertTrue(self.status.messages[-1].data.startswith("finished"), self.status.messages[-1])
        with self.subTest("the map, for those who ask"):
            shown = rospy.wait_for_message("map", OccupancyGrid, 20)
            for name in ("static_map", "dynamic_map"):
                told = rospy.ServiceProxy(name, GetMap)().map
                self.assertEqual((told.info.width, told.info.height), (shown.info.width, shown.info.height))
                self.assertEqual(told.header.frame_id, "map")
                self.assertGreater(sum(cell == 0 for cell in told.data), 1000)
        with self.subTest("what it was told is recorded, to be gone through again"):
            explore.terminate()
            explore.communicate(timeout=60)
            told = self.ask("rosbag", "info", recorded) or ""
            for topic in ("/scan", "/tf", "/tf_static", "/odom", "/cmd_vel"):
                self.assertIn(topic + " ", told)
            mapped = subprocess.run([os.path.join(NODES, "cca-mrpt"), "map", recorded, "--out", self.out],
                                    capture_output=True, text=True)
            self.assertEqual(mapped.returncode, 0, mapped.stderr)
            again = self.node("explore", "_world:=none", "_record:=" + recorded)
            self.assertIn("is there already", again.communicate(timeout=60)[0])

    def expect(self, word, seconds=60):
        self.assertIsNotNone(self.status.wait(lambda m: m.data.startswith(word), seconds), "no '%s'; last: %s"
                             % (word, [m.data for m in self.status.messages[-3:]]))

    def send(self, client, pose):
        client.send_goal(MoveBaseGoal(target_pose=pose))

    def outcome(self, client, seconds=60):
        self.assertTrue(until(lambda: client.get_state() > GoalStatus.ACTIVE, seconds), "no end")
        return client.get_state()


if __name__ == "__main__":
    main()
