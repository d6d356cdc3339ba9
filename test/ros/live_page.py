#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""live_page.py DEVEL_SPACE: the live page of `explore` and `line_mapper`: what it shows, what its commands do, and that
nobody else's do anything."""
import json
import math
import os
import re
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.msg import TFMessage

from own_master import OwnMaster, free_port, main, until
from own_robot import transform
from ros_watch import Watch

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from live_viewer import Viewer  # noqa: E402

SPEED = 4  # of the wall's time


class LivePage(OwnMaster):
    def setUp(self):
        super().setUp()
        os.environ["ROSCONSOLE_STDOUT_LINE_BUFFERED"] = "1"

    def serve(self, name, *arguments):
        """A node, and who looks at its page."""
        node = self.node(name, "_out:=" + self.out, "_serve:=true", "_serve_port:=%d" % free_port(), *arguments)
        said = ""
        while True:
            line = node.stdout.readline()
            said += line
            found = re.search(r"seen at http://([0-9.]+):(\d+)/(\S*?)(\x1b\S*)?$", line)
            if found:
                return node, Viewer(found[1], int(found[2]), found[3])
            if "cpp-httplib" in said:
                self.skipTest("the nodes were built without cpp-httplib")
            self.assertTrue(line, "nothing is served: " + said)

    def tell(self, viewer, wanted, seconds=60):
        """The first thing that a viewer is told for which this holds."""
        end = time.time() + seconds
        for event in viewer.events():
            if event and wanted(event):
                return event
            self.assertLess(time.time(), end, "in vain; last: %s" % str(event)[:300])
        return self.fail("the run has ended")

    def stands(self, viewer, seconds=2.0):
        before = viewer.where()[:2]
        time.sleep(seconds)
        return math.dist(before, viewer.where()[:2]) < 0.005

    def test_a_robot_obeys_the_page_of_its_explorer_and_nobody_else(self):
        self.ask("rosparam", "set", "/use_sim_time", "true")
        self.node("simulator", "_world:=two_rooms", "_speed:=%d" % SPEED)
        node, viewer = self.serve("explore", "_world:=none", "_pose:=tf", "_save_at_end:=false")
        rospy.init_node("live_page")
        status, commands = Watch("status", String), Watch("cmd_vel", Twist)
        told = self.tell(viewer, lambda e: "whole" in e)
        self.assertTrue(told["has_robot"])
        self.assertIn('class="live"', viewer.ask("GET", "/")[1])
        self.tell(viewer, lambda e: e.get("more", {}).get("lines", {}).get("id"))
        self.tell(viewer, lambda e: e["robot"]["distance"] > 0.3 and e["robot"]["reason"])

        with self.subTest("paused, as by ~pause"):
            self.assertEqual(viewer.command(do="pause"), 204)
            self.tell(viewer, lambda e: e["paused"])
            self.assertIsNotNone(status.wait(lambda m: m.data.startswith("paused")))
            time.sleep(1.0)
            self.assertTrue(self.stands(viewer))
            self.assertIn("paused", self.tell(viewer, lambda e: "robot" in e)["robot"]["reason"])
        with self.subTest("who is no page of this one moves nothing"):
            commands.clear()
            for body in {"do": "start"}, {"do": "home"}, {"do": "go", "x": 1.0, "y": 1.0}:
                for headers in {}, {"Origin": "http://evil.example"}, {"Origin": viewer.origin, "Host": "evil.example"}:
                    self.assertEqual(viewer.ask("POST", "/command", json.dumps(body), **headers)[0], 403)
            self.assertTrue(self.stands(viewer))
            self.assertTrue(status.messages[-1].data.startswith("paused"))
            self.assertFalse(any(m.linear.x or m.angular.z for m in commands.messages))
        with self.subTest("sent to a place, where it stays"):
            x, y, _ = viewer.where()
            self.assertEqual(viewer.command(do="go", x=x - 0.4, y=y), 204)
            self.assertIsNotNone(status.wait(lambda m: m.data.startswith("driving")))
            self.assertIsNotNone(status.wait(lambda m: m.data.startswith("paused: the goal is"), 60))
            self.assertIn("reached", status.messages[-1].data)
            self.assertLess(math.dist(viewer.where()[:2], (x - 0.4, y)), 0.3)
            self.assertTrue(self.tell(viewer, lambda e: "robot" in e)["paused"])
        with self.subTest("started and stopped"):
            self.assertEqual(viewer.command(do="start"), 204)
            self.assertIsNotNone(status.wait(lambda m: m.data.startswith("exploring")))
            self.tell(viewer, lambda e: not e["paused"])
            self.assertEqual(viewer.command(do="stop"), 204)
            self.assertIsNotNone(status.wait(lambda m: m.data.startswith("stopped")))
            self.tell(viewer, lambda e: e["paused"] and "stopped" in e["robot"]["reason"])
        with self.subTest("what the services do is seen, too"):
            self.assertTrue(rospy.ServiceProxy("explore/start", Trigger)().success)
            self.tell(viewer, lambda e: not e["paused"])
            self.assertTrue(rospy.ServiceProxy("explore/pause", SetBool)(True).success)
            self.tell(viewer, lambda e: e["paused"])
        with self.subTest("sent home, where it ends"):
            self.assertEqual(viewer.command(do="home"), 204)
            self.assertIsNotNone(status.wait(lambda m: m.data.startswith("finished"), 120))
            self.tell(viewer, lambda e: "finished" in e["robot"]["reason"])
        with self.subTest("the end of the node is told"):
            events = viewer.events()
            next(events)
            node.terminate()
            self.assertTrue(any(event.get("end") for event in events))
            self.assertEqual(node.wait(timeout=60), 0)
        with self.subTest("a mapper is looked at, but drives nothing"):
            self.look_at_a_mapper()

    def look_at_a_mapper(self):
        _, viewer = self.serve("line_mapper", "scan:=wall_scan", "_map_frame:=wall_map")
        scans = rospy.Publisher("wall_scan", LaserScan, queue_size=5)
        tf = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        tf.publish([transform("wall_map", "wall_laser", (0.0, 0.0, 0.0), rospy.Time.now())])
        self.assertTrue(until(lambda: scans.get_num_connections() > 0))
        bearings = [-0.8 + 0.01 * k for k in range(161)]

        def see(event):  # a wall 2 m ahead
            scans.publish(LaserScan(header=rospy.Header(frame_id="wall_laser", stamp=rospy.Time.now()), angle_min=-0.8,
                                    angle_max=0.8, angle_increment=0.01, range_min=0.1, range_max=10.0,
                                    ranges=[2.0 / math.cos(b) for b in bearings]))
        timer = rospy.Timer(rospy.Duration(0.1), see)
        told = self.tell(viewer, lambda e: "whole" in e)
        self.assertFalse(told["has_robot"])
        self.assertEqual(told["robot"]["x"], 0.0)
        for body in {"do": "home"}, {"do": "go", "x": 1, "y": 1}:
            self.assertEqual(viewer.command(**body), 409)
        self.assertEqual(viewer.command(do="pause"), 204)
        self.tell(viewer, lambda e: e["paused"])
        self.assertTrue(rospy.ServiceProxy("line_mapper/reset", Trigger)().success)
        self.tell(viewer, lambda e: e.get("empty"))
        time.sleep(1.0)
        self.assertTrue(next(viewer.events()).get("empty"), "no scan is mapped while it is paused")
        self.assertEqual(viewer.command(do="start"), 204)
        self.tell(viewer, lambda e: "whole" in e and not e["paused"])
        timer.shutdown()

    def test_at_another_address_nobody_starts_it_without_the_token(self):
        _, viewer = self.serve("explore", "_serve_address:=127.0.0.2", "_autostart:=false", "_save_at_end:=false")
        self.assertRegex(viewer.query, r"^\?token=[0-9a-f]{32}$")
        self.assertTrue(self.says("/status", "stopped"))
        for query in "", "?token=", "?token=" + 32 * "0", viewer.query[:-1]:
            for method, path in ("GET", "/"), ("GET", "/events"), ("POST", "/command"):
                body = '{"do": "start"}' if method == "POST" else None
                self.assertEqual(viewer.ask(method, path + query, body, Origin=viewer.origin)[0], 403)
        time.sleep(2.0)
        self.assertTrue(self.says("/status", "stopped"), "it has begun")
        self.assertEqual(viewer.command(do="start"), 204)
        self.assertTrue(self.says("/status", "exploring"))
        self.tell(viewer, lambda e: e.get("robot", {}).get("distance", 0.0) > 0.3)

    def test_a_port_in_use_ends_the_node_with_a_word(self):
        first, viewer = self.serve("line_mapper")
        second = self.node("line_mapper", "__name:=second", "_serve:=true", "_serve_port:=%d" % viewer.port)
        said, _ = second.communicate(timeout=60)
        self.assertIn("127.0.0.1:%d" % viewer.port, said)
        self.assertEqual(second.returncode, 2)
        self.assertIsNone(first.poll())


if __name__ == "__main__":
    main()
