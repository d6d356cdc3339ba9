#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_robot.py DEVEL_SPACE: `check_robot` listens to a robot that shares no code with the project."""
import math
import os
import re
import subprocess

import yaml

from own_master import OwnMaster, main, until

HERE = os.path.dirname(os.path.abspath(__file__))
PROJECT = os.path.join(HERE, "..", "..")
WORLD = os.path.join(PROJECT, "maps", "two_rooms.yaml")


class CheckRobot(OwnMaster):
    def robot(self, *options):
        self.ask("rosparam", "set", "/use_sim_time", "true")
        self.start("python3", os.path.join(HERE, "own_robot.py"), WORLD, "2,3,0", os.path.join(self.home.name, "report"),
                   "--speed", "5", *options)
        self.assertTrue(until(lambda: "/scan" in (self.ask("rostopic", "list") or "")))
        commands = os.path.join(self.home.name, "commands")
        with open(commands, "w") as file:
            file.write("---\n".join(["linear: {x: 0.2}\nangular: {z: %g}\n" % rate
                                     for rate in (0.9, 0.1, 0.6, -0.1) for _ in range(8)]))
        self.start("rostopic", "pub", "-r", "10", "-f", commands, "/cmd_vel", "geometry_msgs/Twist")

    def check(self, *arguments):
        """@return status, and the lines that it prints."""
        node = self.node("check_robot", *arguments)
        output, _ = node.communicate(timeout=120)
        print(output)
        return node.returncode, output

    def test_a_sound_robot_has_no_fault(self):
        self.robot("--turning-laser", "--bend", "0", "--stretch", "1.0")
        status, output = self.check("_seconds:=10")
        self.assertEqual(status, 0, output)
        self.assertIn("0 fault(s)", output)
        self.assertIn("scan: 5.7 a second, 360 beams", output)
        self.assertIn("one sweep takes 0.175 s, the first beam first", output)
        self.assertIn("its stamps are the odometry's", output)
        self.assertIn("the laser is at 0.12, 0.05 m, 5 deg", output)
        self.assertIn("the laser moves as its place there has it", output)
        self.assertIn("nobody tells map -> odom (pose: slam)", output)

    def test_a_laser_that_is_not_where_tf_has_it(self):
        self.robot("--turning-laser", "--bend", "0", "--stretch", "1.0", "--told-mount=-0.08,0.05,-25")  # it is at 0.12, 0.05, 5 degrees
        status, output = self.check("_seconds:=20")
        self.assertEqual(status, 1, output)
        told = re.search(r"static_transform_publisher (\S+) (\S+) Z (\S+) PITCH ROLL base_link laser", output)
        self.assertTrue(told, output)
        x, y, yaw = (float(word) for word in told.groups())
        self.assertLess(math.hypot(x - 0.12, y - 0.05), 0.05, output)
        self.assertAlmostEqual(yaw, math.radians(5.0), delta=0.05)

    def test_stamps_that_are_behind_wheels_that_count_too_much_and_a_slow_laser(self):
        self.robot("--turning-laser", "--bend", "0", "--stretch", "1.1", "--late", "0.1")
        status, output = self.check("_seconds:=26")  # it has to drive a metre, on a busy machine too
        self.assertEqual(status, 1, output)
        late = re.search(r"move the driver's stamps by (\S+) s", output)
        self.assertTrue(late, output)
        self.assertAlmostEqual(float(late.group(1)), 0.1, delta=0.031)
        ways = re.search(r"ways of the scans are (\S+) of its own", output)
        self.assertTrue(ways, output)
        self.assertAlmostEqual(float(ways.group(1)), 1.0 / 1.1, delta=0.02)
        self.assertIn("calibrate the wheels' radius", output)
        self.assertIn("the robot is stopped 0.", output)

    def test_each_fault_comes_with_what_mends_it(self):
        self.robot()
        status, output = self.check("scan:=scan_front", "cmd_vel:=other", "_base_frame:=base_footprint", "_seconds:=4")
        self.assertEqual(status, 1, output)
        for words in ("nothing came by /scan_front", "-> scan:= one of /scan", "nobody listens to /other",
                      "-> base_frame: base_link"):
            self.assertIn(words, output)

    def test_a_robot_that_is_not_there_is_said(self):
        status, output = self.check("_seconds:=1")
        self.assertEqual(status, 1)
        self.assertIn("start what publishes sensor_msgs/LaserScan", output)
        self.assertIn("start what publishes nav_msgs/Odometry", output)

    def test_known_robots_give_their_limits_to_explore(self):
        folder = os.path.join(PROJECT, "config")
        for file in sorted(os.listdir(folder)):
            with open(os.path.join(folder, file)) as text:
                told = yaml.safe_load(text)
            done = subprocess.run(["roslaunch", "--dump-params", os.path.join(PROJECT, "launch_scripts", "explore_robot.launch"),
                                   "rviz:=false", "robot:=" + file[:-len(".yaml")], "max_linear_velocity:=0.1"],
                                  capture_output=True, text=True, timeout=60)
            given = yaml.safe_load(done.stdout)
            self.assertEqual(given["/explore/base_frame"], told["base_frame"])
            self.assertEqual(given["/explore/robot/max_linear_velocity"], 0.1)  # what is told outright counts
            for name in ("radius", "max_angular_velocity", "max_linear_acceleration", "max_angular_acceleration"):
                self.assertTrue(math.isclose(given["/explore/robot/" + name], told["robot"][name]), file)


if __name__ == "__main__":
    main()
