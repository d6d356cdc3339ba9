#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""run_rostest.py DEVEL_SPACE FILE.test: runs rostest on a master of its own, and believes only results.

rostest's exit status and its --text output pass over test nodes that die before they have run a
test; so the result files are read: there must be some, each with tests, none with a failure.
"""
import glob
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree


def main():
    devel, test = sys.argv[1:3]
    home = tempfile.mkdtemp(prefix="cca_rostest_")
    environment = dict(os.environ, ROS_HOME=home, ROS_HOSTNAME="localhost",
                       PATH="/usr/bin:/bin:" + os.environ["PATH"])
    command = '. "$0/setup.sh" && exec rostest --results-base-dir "$1" "$2"'
    rostest = subprocess.Popen(["sh", "-c", command, devel, home, test], env=environment,
                               start_new_session=True)
    try:
        status = rostest.wait(timeout=450)
    except subprocess.TimeoutExpired:
        status = "a timeout"
    try:
        os.killpg(rostest.pid, signal.SIGKILL)  # what a failed launch has left running
    except ProcessLookupError:
        pass
    tests = failures = 0
    for path in glob.glob(os.path.join(home, "cca_mrpt", "*.xml")):
        for suite in ElementTree.parse(path).getroot().iter("testsuite"):
            count = int(suite.get("tests"))
            bad = int(suite.get("failures")) + int(suite.get("errors"))
            tests, failures = tests + count, failures + bad + (count == 0)
    print("%s: %d tests, %d failed, rostest ended with %s" % (test, tests, failures, status))
    shutil.rmtree(home, ignore_errors=True)
    return 0 if tests and not failures and status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
