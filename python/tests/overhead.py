# SPDX-License-Identifier: BSD-3-Clause
"""What a call of extract_lines from Python costs beyond the C++ that it runs, on 361 beams.

Beams without return leave next to nothing for C++ to do, so their whole time is that of the call; the
records of the lines come on top, as many as a scan of a room has.
"""
import time

import numpy as np

import cca_mrpt

BEAMS, CALLS, ROUNDS = 361, 2000, 30


def microseconds(ranges):
    """CPU time [us] of a call; the best round, as others may use the machine."""
    best = np.inf
    for _ in range(ROUNDS):
        begin = time.process_time()
        for _ in range(CALLS):
            cca_mrpt.extract_lines(ranges, -np.pi / 2, np.pi / 360)
        best = min(best, time.process_time() - begin)
    return 1e6 * best / CALLS


bearing = np.linspace(-np.pi / 2, np.pi / 2, BEAMS)
with np.errstate(divide="ignore"):
    room = np.minimum(3 / np.cos(bearing), 2 / np.abs(np.sin(bearing)))
room += np.random.default_rng(1).normal(0, 0.01, BEAMS)
print(f"call alone, no returns: {microseconds(np.full(BEAMS, np.inf)):.2f} us")
print(f"a room of three walls:  {microseconds(room):.2f} us")
