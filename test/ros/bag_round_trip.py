#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag_round_trip.py DEVEL_SPACE: a recorded run gives the same lines played back as read offline."""
import csv
import os
import signal

import numpy

from own_master import NODES, OwnMaster, main, until
from ros_watch import distance_to_walls


def lines(folder):
    with open(os.path.join(folder, "lines.csv")) as file:
        return numpy.array(sorted([float(row[k]) for k in ("x1", "y1", "x2", "y2")]
                                  for row in csv.DictReader(file)))


def samples(segments):
    return numpy.vstack([s[:2] + t * (s[2:] - s[:2]) for s in segments
                         for t in numpy.linspace(0.0, 1.0, 50)])


class BagRoundTrip(OwnMaster):
    def record(self):
        bag = os.path.join(self.home.name, "run.bag")
        self.ask("rosparam", "set", "/use_sim_time", "true")
        explore = self.node("explore", "_world:=two_rooms", "_speed:=10", "_record:=" + bag,
                            "_exit_at_end:=true", "_out:=" + self.out)
        output, _ = explore.communicate(timeout=100)
        self.assertEqual(explore.returncode, 0, output)
        self.assertTrue(os.path.exists(bag), output)
        self.assertFalse(os.path.exists(bag + ".active"))
        return bag

    def map_offline(self, bag):
        folder = os.path.join(self.home.name, "offline")
        done = self.start(os.path.join(NODES, "cca-mrpt"), "map", bag, "--out", folder)
        output, _ = done.communicate(timeout=60)
        self.assertEqual(done.returncode, 0, output)
        return lines(folder)

    def map_played(self, bag):
        folder = os.path.join(self.home.name, "played")
        mapper = self.node("line_mapper", "_out:=" + folder, "_save_at_end:=true")
        self.assertTrue(until(lambda: "/scan" in (self.ask("rosnode", "info", "/line_mapper") or "")))
        # --wait-for-subscribers waits for every topic played, and nobody listens to odom here.
        play = self.start("rosbag", "play", "--clock", "--quiet", "--wait-for-subscribers",
                          "--queue", "5000", "-r", "3", bag,
                          "--topics", "/scan", "/tf", "/tf_static")
        output, _ = play.communicate(timeout=120)
        self.assertEqual(play.returncode, 0, output)
        mapper.send_signal(signal.SIGINT)
        output, _ = mapper.communicate(timeout=40)
        self.assertEqual(mapper.returncode, 0, output)
        self.assertNotIn("dropped", output)
        return lines(folder)

    def test_playback_gives_the_lines_of_the_offline_program(self):
        bag = self.record()
        told = self.ask("rosbag", "info", bag)
        for word in ("/scan", "sensor_msgs/LaserScan", "/tf_static", "/odom"):
            self.assertIn(word, told)
        explored, offline, played = lines(self.out), self.map_offline(bag), self.map_played(bag)
        self.assertGreater(len(offline), 5)
        # The same messages, and poses composed by the same code.
        self.assertEqual(played.shape, offline.shape)
        numpy.testing.assert_allclose(played, offline, atol=2e-4)
        # The explorer had ranges of 64 bits, the bag has 32.
        self.assertLess(distance_to_walls(explored, samples(offline)).max(), 0.01)
        self.assertLess(distance_to_walls(offline, samples(explored)).max(), 0.01)


if __name__ == "__main__":
    main()
