#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the explorer does where the robot fails it: it stands within half a second, says why, and goes
on when all is well again. In order, each test ends with the robot driving."""
import math
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Log
from std_msgs.msg import String
from std_srvs.srv import Trigger

from fake_robot import PERIOD, FakeRobot
from ros_watch import Watch
from segments import read_segments


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("faults")
        cls.status = Watch("status", String)
        cls.diagnostics = Watch("/diagnostics", DiagnosticArray)
        cls.log = Watch("/rosout", Log)
        cls.robot = FakeRobot(read_segments(rospy.get_param("~truth")), 12.0, 9.5)
        cls.robot.sends_transforms = False

    def tearDown(self):
        self.robot.sends_scans = self.robot.sends_transforms = True
        self.robot.delay, self.robot.period = 0.0, PERIOD
        self.robot.spoil = lambda scan: None

    def expect_status(self, word, seconds=5):
        self.assertIsNotNone(self.status.wait(lambda m: word in m.data, seconds), "no '%s'; last: %s"
                             % (word, [m.data for m in self.status.messages[-3:]]))

    def expect_stop_and_recovery(self, fault, mend, why, seconds=2.0):
        self.assertTrue(self.robot.wait_until_moves(), "the robot should drive before the fault")
        fault()
        self.assertLess(self.robot.seconds_until_told_to_stop(), 0.5)
        self.expect_status(why)
        begin = time.time()
        while time.time() < begin + seconds:
            self.assertFalse(self.robot.moves(), "drives blind")
            time.sleep(0.02)
        mend()
        self.assertTrue(self.robot.wait_until_moves(), "the robot should go on")
        self.expect_status("exploring")

    def dropped(self, reason):
        rospy.sleep(1.2)
        values = {v.key: v.value for m in self.diagnostics.messages[-3:] for s in m.status
                  for v in s.values if s.name == "explore: scans"}
        return int(values.get("dropped: " + reason, 0))

    def test_01_without_transforms_it_never_moves(self):
        rospy.sleep(4.0)
        self.assertFalse(any((v, w) != (0.0, 0.0) for _, v, w in self.robot.commands))
        self.expect_status("waiting: no usable scan: tf has no frame 'map'")

    def test_02_with_transforms_it_drives(self):
        self.assertTrue(self.robot.wait_until_moves())
        self.expect_status("exploring")

    def test_03_scan_stops_for_five_seconds(self):
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "sends_scans", False),
                                      lambda: setattr(self.robot, "sends_scans", True),
                                      "no usable scan", seconds=5.0)

    def test_04_transforms_stop(self):
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "sends_transforms", False),
                                      lambda: setattr(self.robot, "sends_transforms", True),
                                      "no usable scan")

    def test_05_scans_of_nan(self):
        def blind(scan):
            scan.ranges = [math.nan] * len(scan.ranges)
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", blind),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "blind")
        self.assertGreater(self.dropped("blind"), 5)

    def test_06_empty_scans(self):
        def empty(scan):
            scan.ranges = []
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", empty),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "blind")

    def test_07_scans_that_no_laser_can_have_meant(self):
        def broken(scan):
            scan.angle_increment = math.nan
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", broken),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "malformed")
        self.assertGreater(self.dropped("malformed"), 5)

    def test_07f_scans_of_no_frame_and_of_no_time(self):
        def nowhere(scan):
            scan.header.frame_id = ""

        def never(scan):
            scan.header.stamp = rospy.Time(0)
        for spoil, why in ((nowhere, "header.frame_id is empty"), (never, "header.stamp is 0")):
            self.expect_stop_and_recovery(lambda spoil=spoil: setattr(self.robot, "spoil", spoil),
                                          lambda: setattr(self.robot, "spoil", lambda scan: None),
                                          "malformed")
            self.assertTrue(any(why in m.msg for m in self.log.messages), why)

    def test_07a_a_covered_laser(self):
        def covered(scan):
            scan.ranges = [math.inf] * len(scan.ranges)
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", covered),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "blind")

    def test_07b_ranges_in_millimetres(self):
        def millimetres(scan):
            scan.ranges = [math.inf if k % 10 == 0 else 1e3 * r for k, r in enumerate(scan.ranges)]
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", millimetres),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "malformed")
        self.assertTrue(any("they look like millimetres" in m.msg for m in self.log.messages))

    def test_07c_beams_that_do_not_fill_their_field_of_view(self):
        def backwards(scan):
            scan.angle_increment *= -1.0

        def one_beam(scan):
            scan.ranges = scan.ranges[:1]

        def half(scan):
            scan.ranges = scan.ranges[:len(scan.ranges) // 2]
        for spoil in (backwards, one_beam, half):
            self.expect_stop_and_recovery(lambda spoil=spoil: setattr(self.robot, "spoil", spoil),
                                          lambda: setattr(self.robot, "spoil", lambda scan: None),
                                          "malformed")

    def test_07e_a_laser_that_looks_backwards(self):
        """270 degrees, all but those ahead: it says what it needs, and does not turn about for nothing."""
        def backwards(scan):
            beams = len(scan.ranges) - 1
            scan.ranges = [scan.ranges[k % beams] for k in range(beams * 5 // 8, beams * 11 // 8 + 1)]
            scan.angle_min += beams * 5 // 8 * scan.angle_increment
            scan.angle_max = scan.angle_min + (len(scan.ranges) - 1) * scan.angle_increment
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", backwards),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "does not look ahead of 'base_link'")

    def test_07d_a_frame_with_a_slash_is_the_frame_without(self):
        def slash(scan):
            scan.header.frame_id = "/laser"
        self.robot.spoil = slash
        rospy.sleep(1.0)
        begin = time.time()
        rospy.sleep(1.0)
        self.assertTrue(any(t > begin and (v, w) != (0.0, 0.0) for t, v, w in self.robot.commands))

    def test_08_scans_from_the_past(self):
        def late(scan):
            scan.header.stamp -= rospy.Duration(3.0)
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", late),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "not newer")

    def test_09_scans_from_the_future(self):
        def early(scan):
            scan.header.stamp += rospy.Duration(60.0)
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "spoil", early),
                                      lambda: setattr(self.robot, "spoil", lambda scan: None),
                                      "future")

    def test_10_the_pose_leaps_and_comes_back(self):
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "leap", 30.0),
                                      lambda: setattr(self.robot, "leap", 0.0),
                                      "leapt", seconds=0.3)

    def test_11_nobody_listens_to_cmd_vel(self):
        self.assertTrue(self.robot.wait_until_moves())
        self.robot.go_deaf()
        self.expect_status("nobody listens")
        rospy.sleep(1.0)
        self.robot.listen()
        self.assertTrue(self.robot.wait_until_moves())
        self.expect_status("exploring")

    def test_11a_motors_that_are_off_are_told(self):
        self.assertTrue(self.robot.wait_until_moves())
        self.robot.is_held = True
        told = self.log.wait(lambda m: "told to move" in m.msg, 30)
        self.robot.is_held = False
        self.assertIsNotNone(told)
        self.assertTrue(self.robot.wait_until_moves(), "goes on by itself")

    def test_12_the_stopped_robot_is_left_to_others(self):
        self.assertTrue(rospy.ServiceProxy("explore/stop", Trigger)().success)
        self.assertLess(self.robot.seconds_until_told_to_stop(), 0.5)
        silent = lambda: time.time() - self.robot.commands[-1][0] > 1.5
        end = time.time() + 15.0
        while time.time() < end and not silent():
            time.sleep(0.1)
        self.assertTrue(silent(), "zero is said for a second only")

    def test_13_a_new_place_is_believed_after_a_second(self):
        self.assertTrue(rospy.ServiceProxy("explore/start", Trigger)().success)
        self.assertTrue(self.robot.wait_until_moves())
        self.robot.leap = 60.0
        self.assertLess(self.robot.seconds_until_told_to_stop(), 0.5)
        self.assertTrue(self.robot.wait_until_moves(5.0), "should go on at the new place")

    def test_14_a_clock_ahead_of_ours_does_not_make_it_stutter(self):
        self.robot.delay = -0.2
        rospy.sleep(0.5)
        self.assertTrue(self.robot.wait_until_moves())
        begin, first = time.time(), len(self.robot.scans)
        while len(self.robot.scans) < first + 30:
            time.sleep(0.1)
        commands = [(t, v, w) for t, v, w in self.robot.commands if t > begin]
        self.assertGreater(len(commands), 20)
        # As long after a scan as its stamp is ahead; later the machine may have been late with the next.
        soon = [t for t, v, w in commands if (v, w) == (0.0, 0.0) and any(0.0 < t - s < 0.2 for s in self.robot.scans)]
        self.assertLess(len(soon), 5, "the watchdog stops it after each scan")

    def drive_with_a_laser_of(self, rate):
        """Stamped with its first beam: a period old when it comes."""
        self.robot.period = self.robot.delay = 1.0 / rate
        rospy.sleep(10.0 / rate)
        self.assertTrue(self.robot.wait_until_moves())
        first, begin, told = len(self.robot.scans), time.time(), len(self.status.messages)
        while len(self.robot.scans) < first + 40:
            time.sleep(0.05)
        commands = [(t, (v, w) == (0.0, 0.0)) for t, v, w in self.robot.commands if t > begin]
        self.assertGreater(len(commands), 40)
        stops = [t for (_, stood), (t, stands) in zip(commands, commands[1:]) if stands and not stood]
        # A scan may ask for a stop, as it does where the robot turns about; the watchdog alone does later.
        unasked = [t for t in stops if t - max(s for s in self.robot.scans if s < t) > 0.08]
        self.assertLess(len(unasked), 4)
        self.assertFalse([m.data for m in self.status.messages[told:] if "waiting" in m.data])
        self.expect_stop_and_recovery(lambda: setattr(self.robot, "sends_scans", False),
                                      lambda: setattr(self.robot, "sends_scans", True), "no usable scan")

    def test_15_a_laser_of_5_Hz_is_driven_by_without_stops_and_told_of_once(self):
        self.drive_with_a_laser_of(5.5)
        rates = [m.msg for m in self.log.messages if "times a second" in m.msg]
        self.assertEqual(len(rates), 1, rates)
        self.assertIn("5.5 times a second", rates[0])

    def test_16_scans_of_a_laser_of_7_Hz_that_come_late_are_driven_by(self):
        self.robot.spoil = lambda scan: time.sleep(0.1)
        self.drive_with_a_laser_of(7.0)


if __name__ == "__main__":
    rostest.rosrun("cca_mrpt", "faults", Faults)
