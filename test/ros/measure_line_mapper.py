#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""measure_line_mapper.py DEVEL_SPACE: latency and load of line_mapper beside the simulator.

The time from a scan's arrival at this program to the arrival of the line_markers made from it (its
stamp tells which), at 40 Hz and 1081 beams; and the processor time of line_mapper at 10 Hz and 361
beams, while the robot turns and drives through the office. Messages are not taken apart here, but for
their stamps: Python would need longer for the markers' points than the node for the scan.
"""
import os
import statistics
import struct
import threading
import time

import rospy
from geometry_msgs.msg import Twist

from own_master import OwnMaster, main

SECONDS = 20.0


def processor_seconds(pid):
    with open("/proc/%d/stat" % pid) as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def stamp(message, offset):
    """Of a serialised header that begins at this offset: (seconds, nanoseconds)."""
    return struct.unpack_from("<II", message._buff, offset + 4)


class LineMapper(OwnMaster):
    def run_nodes(self, rate, beams):
        self.ask("rosparam", "delete", "/simulator")
        self.node("simulator", "_world:=office", "_scan_rate:=%d" % rate, "_beams:=%d" % beams)
        return self.node("line_mapper")

    def test_measure(self):
        rospy.init_node("measure", disable_signals=True)
        came, latencies = {}, []

        def on_scan(message):
            came[stamp(message, 0)] = time.perf_counter()

        def on_markers(message):
            begin = came.pop(stamp(message, 4), None)  # behind the number of markers
            if begin is not None:
                latencies.append(1e3 * (time.perf_counter() - begin))

        rospy.Subscriber("scan", rospy.AnyMsg, on_scan, tcp_nodelay=True)
        rospy.Subscriber("line_markers", rospy.AnyMsg, on_markers, tcp_nodelay=True)
        drive = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        command = Twist()
        command.linear.x, command.angular.z = 0.3, 0.4

        def keep_driving():
            while not rospy.is_shutdown():
                drive.publish(command)
                time.sleep(0.1)

        threading.Thread(target=keep_driving, daemon=True).start()
        for rate, beams in ((40, 1081), (10, 361)):
            mapper = self.run_nodes(rate, beams)
            time.sleep(5.0)
            latencies.clear()
            before = processor_seconds(mapper.pid)
            time.sleep(SECONDS)
            load = (processor_seconds(mapper.pid) - before) / SECONDS
            ordered = sorted(latencies)
            print("%d Hz, %d beams: latency median %.2f ms, 95 %% %.2f ms (%d scans); "
                  "load %.1f %% of a core" % (rate, beams, statistics.median(ordered),
                                              ordered[int(0.95 * len(ordered))], len(ordered),
                                              100 * load))
            for process in self.running[1:]:
                process.kill()
            time.sleep(1.0)


if __name__ == "__main__":
    main()
