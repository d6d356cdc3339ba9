#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""map_own_robot.py DEVEL_SPACE: line_mapper beside a robot of somebody else's, see own_robot.py, that drives in a
circle and looks through a door."""
import json
import math
import os
import signal

import numpy

from explore_own_robot import MAPS, faces, placed, share_near
from own_master import OwnMaster, main, until
from own_robot import World
from segments import read_segments, samples

WORLD = os.path.join(MAPS, "two_rooms.yaml")
OTHER_WORLD = os.path.join(MAPS, "corridor_loop.yaml")
CIRCLE = "{linear: {x: 0.3}, angular: {z: 0.6}}"


class MapOwnRobot(OwnMaster):
    def drive(self, start, seconds, *arguments, world=WORLD):
        """Robot and mapper for so long. @return summary.json and the mapped lines."""
        report = os.path.join(self.home.name, "report.json")
        if os.path.exists(report):
            os.remove(report)
        self.ask("rosparam", "set", "/use_sim_time", "true")
        here = os.path.dirname(os.path.abspath(__file__))
        robot = self.start("python3", os.path.join(here, "own_robot.py"), world, start, report,
                           "--speed", "10", "--two-lasers")
        mapper = self.node("line_mapper", "_out:=" + self.out, "_save_at_end:=true", "_scans:=[scan_front, scan_rear]",
                           *arguments)
        # Its map begins where the robot stands: at its first scan, before the robot drives off.
        self.assertTrue(self.says("scan_lines", "stamp"))
        driver = self.start("rostopic", "pub", "-r", "50", "cmd_vel", "geometry_msgs/Twist", CIRCLE)

        def told():
            with open(report) as file:
                return json.load(file)

        self.assertTrue(until(lambda: os.path.exists(report) and told()["time_s"] > seconds, 200))
        self.assertEqual(told()["contacts"], 0)
        for process in (driver, robot, mapper):
            process.send_signal(signal.SIGINT)
            self.words = process.communicate(timeout=60)[0]
        self.assertEqual(mapper.returncode, 0, self.words)
        with open(os.path.join(self.out, "summary.json")) as file:
            return json.load(file), read_segments(os.path.join(self.out, "lines.csv"))

    def check(self, lines, start):
        """start: X,Y,DEG of the robot where the map began."""
        x, y, degrees = map(float, start.split(","))
        lines = placed(lines.reshape(-1, 2), (x, y, math.radians(degrees))).reshape(-1, 4)
        near = samples(lines)
        precision = share_near(near, faces(World(WORLD)))
        length = numpy.linalg.norm(lines[:, 2:] - lines[:, :2], axis=1).sum()
        print("\n%.1f m of lines, precision %.3f" % (length, precision), flush=True)
        self.assertGreaterEqual(precision, 0.97)
        return length

    def test_two_lasers_by_slam_and_again_from_elsewhere(self):
        """The second map is that of both drives, in the frame of the first."""
        first, start = self.out, "2,2,0"
        _, lines = self.drive(start, 40, "_pose:=slam")
        length = self.check(lines, start)
        self.assertGreater(length, 15.0, "one room at least")
        self.assertTrue(os.path.exists(os.path.join(first, "map.slam")))
        self.out = first + "_2"
        summary, lines = self.drive("3,2.5,90", 40, "_pose:=slam", "_resume:=" + first)
        self.assertTrue(summary["found_in_memory"], self.words)
        self.assertGreaterEqual(self.check(lines, start), length - 0.5, "nothing is lost")

        # Somewhere else, and into the folder of the map that it does not find itself in.
        self.out = first
        with open(os.path.join(first, "map.slam"), "rb") as file:
            memory = file.read()
        summary, _ = self.drive("1.2,1.2,0", 5, "_pose:=slam", "_resume:=" + first, world=OTHER_WORLD)
        self.assertFalse(summary["found_in_memory"])
        with open(os.path.join(first, "earlier.slam"), "rb") as file:
            self.assertEqual(file.read(), memory, "the earlier map is kept")


if __name__ == "__main__":
    main()
