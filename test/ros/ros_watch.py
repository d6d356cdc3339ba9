# SPDX-License-Identifier: BSD-3-Clause
"""What the rostest suites share: waiting for messages."""
import math
import threading
import time

import rospy


class Watch:
    """Keeps what comes in on a topic, with the name of the node that sent it."""

    def __init__(self, topic, kind):
        self.messages, self.senders = [], set()
        self._news = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, kind, self._take, tcp_nodelay=True)

    def _take(self, message):
        with self._news:
            self.messages.append(message)
            self.senders.add(message._connection_header["callerid"])
            self._news.notify_all()

    def wait(self, condition=lambda message: True, seconds=10.0):
        """The next message (or the last one that is there) for which the condition holds; or None."""
        end = time.time() + seconds
        with self._news:
            seen = max(0, len(self.messages) - 1)
            while True:
                for message in self.messages[seen:]:
                    if condition(message):
                        return message
                seen = len(self.messages)
                left = end - time.time()
                if left <= 0:
                    return None
                self._news.wait(left)

    def clear(self):
        with self._news:
            self.messages = []

    def close(self):
        self._subscriber.unregister()


def places(path):
    """m, n x 2: where a nav_msgs/Path has been, every fourth of its poses."""
    return [(pose.pose.position.x, pose.pose.position.y) for pose in path.poses[::4]]


def yaw(rotation):
    return 2.0 * math.atan2(rotation.z, rotation.w)
