#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag_round_trip.py DEVEL_SPACE: a recorded run gives the same lines played back as read offline."""
import csv
import os
import signal

from own_master import NODES, OwnMaster, main, until


def lines(folder):
    with open(os.path.join(folder, "lines.csv")) as file:
        return [[float(row[k]) for k in ("x1", "y1", "x2", "y2")] for row in csv.DictReader(file)]


class BagRoundTrip(OwnMaster):
    def test_playback_gives_the_lines_of_the_offline_program(self):
        bag = os.path.join(self.home.name, "run.bag")
        self.ask("rosparam", "set", "/use_sim_time", "true")
        explore = self.node("explore", "_world:=two_rooms", "_speed:=10", "_record:=" + bag,
                            "_exit_at_end:=true", "_out:=" + self.out)
        output, _ = explore.communicate(timeout=60)
        self.assertEqual(explore.returncode, 0, output)
        self.assertTrue(os.path.exists(bag), output)
        self.assertFalse(os.path.exists(bag + ".active"))
        explored = lines(self.out)

        offline = os.path.join(self.home.name, "offline")
        done = self.start(os.path.join(NODES, "cca-mrpt"), "map", bag, "--out", offline)
        output, _ = done.communicate(timeout=60)
        self.assertEqual(done.returncode, 0, output)

        played = os.path.join(self.home.name, "played")
        mapper = self.node("line_mapper", "_out:=" + played, "_save_at_end:=true")
        self.assertTrue(until(lambda: "/scan" in (self.ask("rosnode", "info", "/line_mapper") or "")))
        play = self.start("rosbag", "play", "--clock", "--quiet", "-d", "1", "-r", "4", bag)
        output, _ = play.communicate(timeout=90)
        self.assertEqual(play.returncode, 0, output)
        mapper.send_signal(signal.SIGINT)
        output, _ = mapper.communicate(timeout=20)
        self.assertEqual(mapper.returncode, 0, output)

        self.assertGreater(len(explored), 8)
        self.compare(lines(played), lines(offline), 1e-4)   # the same messages; poses composed
        self.compare(lines(offline), explored, 1e-3)        # ranges of 32 bits against 64

    def compare(self, ours, theirs, tolerance):
        self.assertEqual(len(ours), len(theirs))
        for a, b in zip(sorted(ours), sorted(theirs)):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, delta=tolerance)


if __name__ == "__main__":
    main()
