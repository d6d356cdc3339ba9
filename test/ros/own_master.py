# SPDX-License-Identifier: BSD-3-Clause
"""Tests that start nodes themselves, each with a master of its own: rostest cannot restart a master,
nor look at the exit status of a node."""
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

DEVEL = os.path.abspath(sys.argv[1])
NODES = os.path.join(DEVEL, "lib", "cca_mrpt")


def free_port():
    with socket.socket() as s:
        s.bind(("", 0))
        return s.getsockname()[1]


def until(condition, seconds=60.0):
    end = time.time() + seconds
    while time.time() < end:
        if condition():
            return True
        time.sleep(0.2)
    return False


class OwnMaster(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory(prefix="cca_node_ends_")
        self.out = os.path.join(self.home.name, "map")
        self.port = free_port()
        os.environ.update(ROS_HOME=self.home.name, ROS_HOSTNAME="localhost",
                          ROS_MASTER_URI="http://localhost:%d" % self.port,
                          ROSCONSOLE_STDOUT_LINE_BUFFERED="1")  # what a node prints is there to be read at once
        self.running = []
        self.master = self.start_master()

    def tearDown(self):
        for process in reversed(self.running):
            try:
                os.killpg(process.pid, signal.SIGKILL)  # also what a roslaunch has left behind
            except ProcessLookupError:
                pass
            process.communicate()
        self.home.cleanup()

    def start(self, *command):
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, start_new_session=True)
        self.running.append(process)
        return process

    def start_master(self):
        # The bare master: roscore's own children would hide it from a signal.
        master = subprocess.Popen(["rosmaster", "--core", "-p", str(self.port)],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  start_new_session=True)
        self.running.append(master)
        self.assertTrue(until(lambda: self.ask("rosparam", "list") is not None))
        return master

    def ask(self, *command, seconds=40):
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
        except subprocess.TimeoutExpired:
            return None
        return done.stdout if done.returncode == 0 else None

    def node(self, name, *arguments):
        return self.start(os.path.join(NODES, name), *arguments)

    def says(self, topic, word, seconds=60.0):
        """Whether a topic does so within that time. One listener hears it all: to start one takes a second."""
        end = time.time() + seconds

        def heard():
            listener = self.start("env", "PYTHONUNBUFFERED=1", "rostopic", "echo", topic)
            alarm = threading.Timer(max(0.0, end - time.time()), listener.kill)
            alarm.start()
            said = ""
            for line in listener.stdout:
                said = said[-len(word):] + line
                if word in said:
                    break
            alarm.cancel()
            listener.kill()
            listener.wait()
            return word in said

        return until(heard, seconds)

    def prints(self, process, words, seconds=60.0):
        """Whether a process prints these words within that time; what it has printed until then is gone."""
        alarm = threading.Timer(seconds, process.kill)
        alarm.start()
        said = any(words in line for line in process.stdout)
        alarm.cancel()
        return said


def main():
    """DEVEL_SPACE [names of tests]: runs them in the environment of that space."""
    if not os.environ.get("CMAKE_PREFIX_PATH", "").startswith(DEVEL):
        os.environ["PATH"] = "/usr/bin:/bin:" + os.environ["PATH"]
        again = '. "$0/setup.bash" && exec /usr/bin/python3 "$@"'
        os.execvp("bash", ["bash", "-c", again, DEVEL] + sys.argv)
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
