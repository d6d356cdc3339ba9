# SPDX-License-Identifier: BSD-3-Clause
"""What the rostest suites share: waiting for messages, and the true walls of a world."""
import csv
import math
import threading
import time

import numpy
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


def yaw(rotation):
    return 2.0 * math.atan2(rotation.z, rotation.w)


def walls(truth_csv):
    """n x 4: x1, y1, x2, y2 of the true walls."""
    with open(truth_csv) as file:
        rows = csv.DictReader(file)
        return numpy.array([[float(row[k]) for k in ("x1", "y1", "x2", "y2")] for row in rows])


def cast(segments, x, y, bearings):
    """Ranges from a place to the nearest segment along each bearing (map frame); inf for a miss."""
    a = segments[:, :2] - (x, y)
    d = segments[:, 2:] - segments[:, :2]
    ranges = []
    for bearing in bearings:
        c, s = math.cos(bearing), math.sin(bearing)
        across = c * d[:, 1] - s * d[:, 0]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            along = (a[:, 0] * d[:, 1] - a[:, 1] * d[:, 0]) / across
            where = (a[:, 0] * s - a[:, 1] * c) / across
        hit = (along > 0) & (where >= 0) & (where <= 1)
        ranges.append(along[hit].min() if hit.any() else math.inf)
    return numpy.array(ranges)


def distance_to_walls(segments, points):
    """m, from each of n points to the nearest wall."""
    best = numpy.full(len(points), math.inf)
    for x1, y1, x2, y2 in segments:
        start, d = numpy.array([x1, y1]), numpy.array([x2 - x1, y2 - y1])
        t = numpy.clip(((points - start) @ d) / (d @ d), 0.0, 1.0)
        best = numpy.minimum(best, numpy.linalg.norm(points - start - t[:, None] * d, axis=1))
    return best
