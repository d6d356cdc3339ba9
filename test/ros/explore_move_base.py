#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""explore_move_base.py DEVEL_SPACE: explore_robot.launch with driver:=move_base, and a move_base that is not the
project's, see move_base_robot.py."""
import json
import os
import signal

from own_master import OwnMaster, main, until

HERE = os.path.dirname(os.path.abspath(__file__))
MAPS = os.path.join(HERE, "..", "..", "maps")
TWO_ROOMS, CORRIDOR_LOOP = ("two_rooms.yaml", "2,3,0"), ("corridor_loop.yaml", "1.2,1.2,0")
SPEED = 5  # of the wall's time, where the machine can


class ExploreMoveBase(OwnMaster):
    def begin(self, place, speed, *robot):
        self.report_file = os.path.join(self.home.name, "report.json")
        self.ask("rosparam", "set", "/use_sim_time", "true")
        self.robot = self.start("python3", os.path.join(HERE, "move_base_robot.py"),
                                os.path.join(MAPS, place[0]), place[1], self.report_file, "--speed", str(speed), *robot)
        self.roslaunch = self.start("roslaunch", "cca_mrpt", "explore_robot.launch", "rviz:=false", "pose:=tf",
                                    "driver:=move_base", "out:=" + self.out)

    def tearDown(self):
        self.roslaunch.terminate()  # its nodes are not of its process group
        self.roslaunch.communicate(timeout=60)
        super().tearDown()

    def report(self):
        if not os.path.exists(self.report_file):
            return None
        with open(self.report_file) as file:
            return json.load(file)

    def has_goal(self, wanted):
        return until(lambda: (self.report() or {}).get("has_goal") == wanted)

    def explore(self, place, *robot):
        """@return what the robot reports at the end."""
        self.begin(place, SPEED, *robot)
        path = os.path.join(self.out, "summary.json")
        until(lambda: os.path.exists(path) or self.robot.poll() or self.roslaunch.poll(), 500)
        self.assertIsNone(self.robot.poll(), self.robot.poll() and self.robot.communicate()[0])
        self.assertTrue(self.has_goal(False), "the last goal should have been reached or cancelled")
        listeners = self.ask("rostopic", "info", "cmd_vel")
        self.roslaunch.terminate()
        self.roslaunch.wait(timeout=60)
        self.assertTrue(os.path.exists(path), self.report())
        with open(path) as file:
            summary = json.load(file)
        report = self.report()
        print("\n%s, %s" % (report, summary["reason"]), flush=True)
        self.assertTrue(summary["finished"], summary["reason"])
        self.assertEqual(report["contacts"], 0)
        self.assertGreaterEqual(report["seen"], 0.99)
        self.assertIsNone(listeners, "cmd_vel is move_base's alone")
        self.assertGreater(report["goals"]["accepted"], 1)
        return report

    def test_two_rooms(self):
        self.assertEqual(self.explore(TWO_ROOMS)["goals"]["aborted"], 0)

    def test_two_rooms_where_the_first_goals_are_aborted(self):
        self.assertEqual(self.explore(TWO_ROOMS, "--abort", "2")["goals"]["aborted"], 2)

    def test_two_rooms_where_the_first_goals_are_rejected(self):
        self.assertEqual(self.explore(TWO_ROOMS, "--reject", "2")["goals"]["rejected"], 2)

    def test_two_rooms_where_the_first_goals_are_lost(self):
        goals = self.explore(TWO_ROOMS, "--lose", "2")["goals"]
        self.assertEqual((goals["lost"], goals["aborted"]), (2, 0))

    def test_a_move_base_that_takes_no_goal_ends_the_exploration_and_is_said(self):
        self.begin(TWO_ROOMS, SPEED, "--reject", "1000")
        self.assertTrue(self.says("/status", "move_base"), "nobody is told why the robot stands")
        self.assertEqual(self.report()["goals"]["accepted"], 0)

    def test_the_goal_is_cancelled_where_the_robot_is_to_stand(self):
        self.begin(CORRIDOR_LOOP, 1)  # minutes: it has not explored all before the last word here
        self.assertTrue(self.has_goal(True))
        for stop, resume in ((("pause", "true"), ("pause", "false")), (("stop",), ("start",))):
            self.ask("rosservice", "call", "/explore/" + stop[0], *stop[1:])
            self.assertTrue(self.has_goal(False), stop)
            self.ask("rosservice", "call", "/explore/" + resume[0], *resume[1:])
            self.assertTrue(self.has_goal(True), resume)
        self.ask("rostopic", "pub", "-1", "/move_base/goal", "move_base_msgs/MoveBaseActionGoal",
                 "{goal: {target_pose: {header: {frame_id: map}, pose: {position: {x: 2, y: 3}, orientation: {w: 1}}}}}")
        self.assertTrue(self.says("/status", "paused"), "somebody else drives")
        self.assertTrue(self.has_goal(False), "that goal, too, should have been reached")
        self.ask("rosservice", "call", "/explore/pause", "false")
        self.assertTrue(self.has_goal(True))
        self.robot.send_signal(signal.SIGUSR1)  # no more scans
        self.assertTrue(self.has_goal(False))
        self.robot.send_signal(signal.SIGUSR1)
        self.assertTrue(self.has_goal(True))
        self.roslaunch.terminate()
        self.assertTrue(self.has_goal(False))


if __name__ == "__main__":
    main()
