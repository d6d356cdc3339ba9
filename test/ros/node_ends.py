#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""node_ends.py DEVEL_SPACE: how nodes begin and end, and what a restarted master does to them.

Plain unittest with a master of its own per test, since rostest cannot restart a master or look at
the exit status of a node.
"""
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

DEVEL = os.path.abspath(sys.argv[1])
NODES = os.path.join(DEVEL, "lib", "cca_mrpt")


def free_port():
    with socket.socket() as s:
        s.bind(("", 0))
        return s.getsockname()[1]


def until(condition, seconds=20.0):
    end = time.time() + seconds
    while time.time() < end:
        if condition():
            return True
        time.sleep(0.2)
    return False


class NodeEnds(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory(prefix="cca_node_ends_")
        self.out = os.path.join(self.home.name, "map")
        self.port = free_port()
        os.environ.update(ROS_HOME=self.home.name, ROS_HOSTNAME="localhost",
                          ROS_MASTER_URI="http://localhost:%d" % self.port)
        self.running = []
        self.master = self.start_master()

    def tearDown(self):
        for process in reversed(self.running):
            if process.poll() is None:
                process.kill()
                process.wait()
        self.home.cleanup()

    def start(self, *command):
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True)
        self.running.append(process)
        return process

    def start_master(self):
        # The bare master: roscore's own children would hide it from a signal.
        master = subprocess.Popen(["rosmaster", "--core", "-p", str(self.port)],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.running.append(master)
        self.assertTrue(until(lambda: self.ask("rosparam", "list") is not None))
        return master

    def ask(self, *command, seconds=10):
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
        except subprocess.TimeoutExpired:
            return None
        return done.stdout if done.returncode == 0 else None

    def node(self, name, *arguments):
        return self.start(os.path.join(NODES, name), *arguments)

    def says(self, topic, word):
        return until(lambda: word in (self.ask("rostopic", "echo", "-n1", topic, seconds=5) or ""))

    def exploring(self):
        node = self.node("explore", "_world:=two_rooms", "_out:=" + self.out)
        self.assertTrue(self.says("/status", "exploring"))
        time.sleep(1.0)
        return node

    def expect_saved(self):
        for name in ("summary.json", "lines.csv", "map.yaml"):
            self.assertTrue(os.path.exists(os.path.join(self.out, name)), name)

    def test_ctrl_c_saves_the_map(self):
        for sign in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(sign):
                node = self.exploring()
                node.send_signal(sign)
                self.assertEqual(node.wait(timeout=20), 0)
                self.expect_saved()
                self.ask("rm", "-r", self.out)

    def test_rosnode_kill_saves_the_map(self):
        node = self.exploring()
        self.ask("rosnode", "kill", "/explore")
        self.assertEqual(node.wait(timeout=20), 0)
        self.expect_saved()

    def test_ctrl_c_stops_the_robot(self):
        self.node("simulator", "_world:=two_rooms")
        node = self.node("explore", "_world:=", "_out:=" + self.out)
        self.assertTrue(self.says("/status", "exploring"))
        heard = self.start("rostopic", "echo", "-p", "/cmd_vel")
        time.sleep(2.0)
        node.send_signal(signal.SIGINT)
        self.assertEqual(node.wait(timeout=20), 0)
        time.sleep(0.5)
        heard.send_signal(signal.SIGINT)
        rows = [row.split(",") for row in heard.communicate(timeout=10)[0].splitlines()[1:] if row]
        velocities = [(float(row[1]), float(row[6])) for row in rows if len(row) == 7]
        self.assertTrue(any(v != (0.0, 0.0) for v in velocities), "it drove")
        self.assertEqual(velocities[-1], (0.0, 0.0))
        self.expect_saved()

    def expect_refusal(self, node, arguments, words):
        process = self.node(node, *arguments)
        output, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 2, output)
        for word in words:
            self.assertIn(word, output)

    def test_wrong_parameters_are_named_with_what_is_allowed(self):
        for node, argument, words in [
                ("explore", "_stratgy:=greedy", ["/explore/stratgy", "unknown", "strategy"]),
                ("explore", "_strategy:=best", ["/explore/strategy", "best", "greedy"]),
                ("explore", "_laser/range:=-3", ["/explore/laser/range", "-3", "[0.1, 200] m"]),
                ("explore", "_beams:=many", ["/explore/beams", "many", "whole number"]),
                ("explore", "_world:=nowhere", ["world", "nowhere", "maps/"]),
                ("explore", "_speed:=3", ["speed", "use_sim_time"]),
                ("explore", "_autostart:=maybe", ["/explore/autostart", "maybe", "true or false"]),
                ("explore", "_start_pose:=here", ["start_pose", "here", "X,Y,DEG"]),
                ("explore", "_config:=/no/such.ini", ["/no/such.ini"]),
                ("simulator", "_scan_rate:=0", ["/simulator/scan_rate", "[1, 100] Hz"]),
                ("line_mapper", "_similarity_cut:=7", ["/line_mapper/similarity_cut", "[0.01, 1]"])]:
            with self.subTest(argument):
                self.ask("rosparam", "delete", "/" + node)
                self.expect_refusal(node, [argument], words)
        self.ask("rosparam", "delete", "/simulator")
        self.expect_refusal("simulator", ["_start_pose:=-50,-50,0", "_world:=two_rooms"], ["-50"])

    def test_a_restarted_master_finds_the_node_again(self):
        node = self.exploring()
        self.master.kill()
        self.master.wait()
        time.sleep(2.0)
        self.assertIsNone(node.poll(), "alive without a master")
        self.master = self.start_master()
        self.assertTrue(self.says("/status", ":"), "the topics are known to the new master")
        self.assertTrue(until(lambda: "success: True" in
                              (self.ask("rosservice", "call", "/explore/stop") or "")))
        self.assertIsNone(node.poll())
        node.send_signal(signal.SIGINT)
        self.assertEqual(node.wait(timeout=20), 0)


if __name__ == "__main__":
    if not os.environ.get("CMAKE_PREFIX_PATH", "").startswith(DEVEL):
        os.environ["PATH"] = "/usr/bin:/bin:" + os.environ["PATH"]
        os.execvp("sh", ["sh", "-c", '. "$0/setup.sh" && exec /usr/bin/python3 "$@"', DEVEL] + sys.argv)
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
