#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""installed_package.py SPACE: rosrun and roslaunch find all that they need in a devel or install space."""
import csv
import os
import signal

from own_master import OwnMaster, main, until


class InstalledPackage(OwnMaster):
    def setUp(self):
        super().setUp()
        self.ask("rosparam", "set", "/use_sim_time", "true")

    def launch(self, name, *arguments):
        return self.start("roslaunch", "cca_mrpt", name, *arguments)

    def end(self, launch):
        launch.send_signal(signal.SIGINT)
        output, _ = launch.communicate(timeout=60)
        self.assertEqual(launch.returncode, 0, output)

    def expect_map(self, folder):
        with open(os.path.join(folder, "lines.csv")) as file:
            self.assertGreater(len(list(csv.DictReader(file))), 2)

    def test_rosrun_explores(self):
        explore = self.start("rosrun", "cca_mrpt", "explore", "_world:=two_rooms", "_speed:=20",
                             "_exit_at_end:=true", "_out:=" + self.out)
        output, _ = explore.communicate(timeout=200)
        self.assertEqual(explore.returncode, 0, output)
        self.expect_map(self.out)

    def test_explore_launch(self):
        launch = self.launch("explore.launch", "rviz:=false", "speed:=20", "out:=" + self.out)
        self.assertTrue(until(lambda: self.says("/status", "finished"), 200))
        self.end(launch)
        self.expect_map(self.out)

    def test_robot_and_mapper_launch(self):
        robot = self.launch("simulator.launch", "world:=corridor_loop", "speed:=2")
        # One after the other: launches at once quarrel about the master's run_id.
        self.assertTrue(self.says("/odom", "pose"))
        explore = self.launch("explore_robot.launch", "rviz:=false", "out:=" + self.out)
        self.assertTrue(self.says("/status", ":"))
        mapper = self.launch("line_mapper.launch", "rviz:=false")
        self.assertTrue(until(lambda: self.says("/status", "exploring"), 100))
        self.assertTrue(self.says("/line_markers", "points"))
        self.assertIn("success: True", self.ask("rosservice", "call", "/line_mapper/save", seconds=60))
        for launch in (mapper, explore, robot):
            self.end(launch)
        self.expect_map(self.out)

    def test_rviz_is_given_a_view_that_is_there(self):
        for name in ("explore", "explore_robot", "line_mapper"):
            command = self.ask("roslaunch", "--args", "rviz", "cca_mrpt", name + ".launch")
            view = command.split()[0]
            self.assertTrue(view.endswith("/view.sh") and os.access(view, os.X_OK), command)
            self.assertTrue(os.path.isfile(os.path.join(os.path.dirname(view), "cca.rviz")), command)


if __name__ == "__main__":
    main()
