#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""node_ends.py DEVEL_SPACE: how nodes begin and end, and what a restarted master does to them."""
import os
import signal
import subprocess
import time

from own_master import NODES, OwnMaster, main, until


def velocities(file):
    """(linear, angular) of each command that `rostopic echo -p` wrote."""
    with open(file) as rows:
        cells = [row.split(",") for row in rows.read().splitlines()[1:]]
    return [(float(row[1]), float(row[6])) for row in cells if len(row) == 7]


class NodeEnds(OwnMaster):
    def exploring(self):
        node = self.node("explore", "_world:=office", "_out:=" + self.out)
        self.assertTrue(self.says("/status", "exploring"))
        time.sleep(1.0)
        return node

    def expect_saved(self):
        for name in ("summary.json", "lines.csv", "map.yaml"):
            self.assertTrue(os.path.exists(os.path.join(self.out, name)), name)

    def test_ctrl_c_saves_the_map(self):
        for sign in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(sign):
                node = self.exploring()
                node.send_signal(sign)
                self.assertEqual(node.wait(timeout=90), 0)
                self.expect_saved()
                self.ask("rm", "-r", self.out)

    def test_ctrl_c_ends_a_node_that_waits_for_its_master(self):
        self.master.kill()
        self.master.wait()
        for name in ("explore", "line_mapper", "simulator"):
            for sign in (signal.SIGINT, signal.SIGTERM):
                with self.subTest((name, sign)):
                    node = self.node(name)
                    time.sleep(1.5)
                    self.assertIsNone(node.poll(), "it waits")
                    node.send_signal(sign)
                    self.assertEqual(node.wait(timeout=10), -sign)

    def test_a_folder_that_cannot_be_written_is_told_before_the_work(self):
        with open(self.out, "w"):
            pass
        node = self.node("explore", "_world:=none", "_out:=" + self.out)
        self.assertTrue(self.says("/status", "waiting"))
        node.send_signal(signal.SIGINT)
        output, _ = node.communicate(timeout=90)
        self.assertIn("no map can be saved: %s: cannot be made a folder" % self.out, output)

    def test_rosnode_kill_saves_the_map(self):
        node = self.exploring()
        self.ask("rosnode", "kill", "/explore")
        self.assertEqual(node.wait(timeout=90), 0)
        self.expect_saved()

    def drives(self):
        velocity = self.ask("rostopic", "echo", "-p", "-n1", "/cmd_vel") or ""
        return any(float(v) != 0.0 for row in velocity.splitlines()[1:] for v in row.split(",")[1:])

    def test_ctrl_c_stops_the_robot(self):
        self.node("simulator", "_world:=office")
        node = self.node("explore", "_world:=none", "_out:=" + self.out)
        self.assertTrue(self.says("/status", "exploring"))
        heard = os.path.join(self.home.name, "heard")
        echo = self.start("sh", "-c", "exec rostopic echo -p /cmd_vel >" + heard)
        self.assertTrue(until(lambda: "/rostopic" in (self.ask("rostopic", "info", "/cmd_vel") or "")))
        self.assertTrue(until(self.drives), "it drives")
        node.send_signal(signal.SIGINT)
        self.assertEqual(node.wait(timeout=90), 0)
        until(lambda: velocities(heard)[-1:] == [(0.0, 0.0)], 20.0)
        echo.send_signal(signal.SIGINT)
        echo.wait(timeout=30)
        self.assertTrue(any(v != (0.0, 0.0) for v in velocities(heard)), "it drove")
        self.assertEqual(velocities(heard)[-1], (0.0, 0.0))
        self.expect_saved()

    def expect_refusal(self, node, arguments, words):
        process = self.node(node, *arguments)
        output, _ = process.communicate(timeout=90)
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
                ("explore", "_seed:=1.5", ["/explore/seed", "1.5", "whole number in [0, 1000000000]"]),
                ("explore", "office", ["'office' is not expected", "_name:=value"]),
                ("explore", "_config:=/no/such.ini", ["/no/such.ini"]),
                ("explore", "_base_frame:=", ["/explore/base_frame", "a frame of tf"]),
                ("explore", "_out:=", ["/explore/out", "a folder"]),
                ("explore", "record:=run.bag", ["run.bag", "_name:=value"]),
                ("simulator", "_laser_model:=sick", ["/simulator/laser_model", "sick", "ld19"]),
                ("simulator", "_map_frame:=/odom", ["/simulator/map_frame", "another frame"]),
                ("simulator", "_scan_rate:=0", ["/simulator/scan_rate", "[1, 100] Hz"]),
                ("line_mapper", "_similarity_cut:=7", ["/line_mapper/similarity_cut", "[0.01, 1]"])]:
            with self.subTest(argument):
                self.ask("rosparam", "delete", "/" + node)
                self.expect_refusal(node, [argument], words)
        self.ask("rosparam", "delete", "/simulator")
        self.expect_refusal("simulator", ["_start_pose:=-50,-50,0", "_world:=two_rooms"], ["-50"])

    def test_wrong_parameters_of_a_robot_are_told_at_once(self):
        for arguments, words in [
                (["_pose:=slam", "_map_frame:=odom"], ["/explore/map_frame", "another frame"]),
                (["_pose:=slam", "_plan:=room.dxf"], ["~plan", "_pose:=tf"]),
                (["_plan:=/no/such.dxf", "_pose:=auto"], ["/no/such.dxf"]),
                (["_resume:=/no/such", "_pose:=auto"], ["/no/such"]),
                (["_hazard_points:=a b"], ["/explore/hazard_points", "a b"]),
                (["_scans:=[front rear]"], ["/explore/scans", "front rear"]),
                (["pose:=slam", "_typo:=1"], ["the parameter is given as _pose:=slam"])]:
            with self.subTest(arguments):
                self.ask("rosparam", "delete", "/explore")
                self.expect_refusal("explore", ["_world:=none"] + arguments, words)

    def test_what_a_node_waits_for_is_told(self):
        explore = self.node("explore", "_world:=none", "_pose:=tf", "_save_at_end:=false")
        self.assertTrue(self.says("/status", "nobody listens to cmd_vel"))
        self.start("rostopic", "echo", "/cmd_vel")
        self.assertTrue(self.says("/status", "nobody publishes /scan"))
        explore.send_signal(signal.SIGINT)
        explore.wait(timeout=30)
        for is_simulated, words in (("false", "nobody publishes /scan"), ("true", "nothing gives /clock")):
            self.ask("rosparam", "set", "/use_sim_time", is_simulated)
            mapper = self.node("line_mapper")
            self.assertTrue(self.prints(mapper, words), words)
            mapper.send_signal(signal.SIGINT)
            mapper.wait(timeout=30)
        check = self.node("check_robot", "_seconds:=1")
        self.assertIn("nothing gives /clock", check.communicate(timeout=30)[0])
        self.assertEqual(check.returncode, 1)

    def test_a_goal_that_comes_too_early_is_answered(self):
        node = self.node("explore", "_world:=none", "_pose:=auto", "_save_at_end:=false")
        self.assertTrue(self.says("/status", "waiting"))
        self.ask("rostopic", "pub", "-1", "/move_base_simple/goal", "geometry_msgs/PoseStamped",
                 "{header: {frame_id: map}, pose: {orientation: {w: 1}}}")
        node.send_signal(signal.SIGINT)
        self.assertIn("it is not known yet where the robot is", node.communicate(timeout=30)[0])

    def test_parameters_without_effect_are_told(self):
        for node, arguments, idle in [
                ("explore", ["_run/seed:=3", "_longest_time:=9"], ["run/seed", "longest_time"]),
                ("explore", ["_icp/iterations:=3", "_pose:=tf"], ["icp/iterations", "pose"]),
                ("explore", ["_world:=none", "_speed:=2", "_laser/range:=9"], ["speed", "laser/range"]),
                ("simulator", ["_world:=two_rooms", "_strategy:=greedy"], ["strategy"]),
                ("line_mapper", ["_robot/radius:=0.3"], ["robot/radius"])]:
            with self.subTest(arguments):
                self.ask("rosparam", "delete", "/" + node)
                told = ["/%s/%s has no effect in this node" % (node, name) for name in idle]
                self.expect_refusal(node, arguments + ["_typo:=1"], told + ["typo is unknown"])

    def test_help_tells_the_parameters(self):
        for name, word in [("explore", "world"), ("simulator", "scan_rate"), ("line_mapper", "map_frame")]:
            done = subprocess.run([os.path.join(NODES, name), "--help"], capture_output=True, text=True,
                                  timeout=30)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(word, done.stdout)
            self.assertIn("similarity_cut" if name != "simulator" else "radius", done.stdout)

    def services(self):
        names = (self.ask("rosservice", "list") or "").split()
        return {name for name in names if name.startswith(("/explore/", "/static_map", "/dynamic_map"))}

    def test_a_restarted_master_finds_the_node_again(self):
        self.node("simulator", "_world:=office")
        node = self.node("explore", "_world:=none", "_pose:=tf", "_out:=" + self.out)
        self.assertTrue(self.says("/status", "exploring"))
        services = self.services()
        self.assertIn("/explore/set_parameters", services)
        self.master.kill()
        self.master.wait()
        time.sleep(2.0)
        self.assertIsNone(node.poll(), "alive without a master")
        self.master = self.start_master()
        self.assertTrue(self.says("/status", ":"), "the topics are known to the new master")
        self.assertTrue(until(lambda: self.services() == services), services - self.services())
        self.assertTrue(until(lambda: "success: True" in
                              (self.ask("rosservice", "call", "/explore/stop") or "")))
        self.assertIsNone(node.poll())
        node.send_signal(signal.SIGINT)
        self.assertEqual(node.wait(timeout=90), 0)


if __name__ == "__main__":
    main()
