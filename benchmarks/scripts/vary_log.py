#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes variations of a CARMEN log, to see what a result is worth: five logs say little about others.

    benchmarks/scripts/vary_log.py LOG.log.gz OUT_FOLDER [--kinds as_is backwards ...] [--seeds 1 2 ...]

Each variation OUT_FOLDER/KIND-SEED.log.gz holds the FLASER scans of LOG, in the order and choice of its kind, every pose
shaken by its own 0.2 mm and 0.001 degrees: walls are founded in another order, and the runs are independent.
"""
import argparse
import gzip
import math
import pathlib
import random
import sys

KINDS = {
    "as_is": lambda scans: scans,
    "backwards": lambda scans: scans[::-1],
    "even": lambda scans: scans[::2],
    "odd": lambda scans: scans[1::2],
    "first_half": lambda scans: scans[:len(scans) // 2],
    "second_half": lambda scans: scans[len(scans) // 2:],
}
SHAKE_M, SHAKE_RAD = 2e-4, math.radians(0.001)
SECONDS_APART = 0.2


def read(path):
    """The lines before the first scan that describe the log, and the scans, as lists of words."""
    with gzip.open(path, "rt") if path.suffix == ".gz" else open(path) as log:
        words = [line.split() for line in log]
    head = [w for w in words if w and (w[0] == "PARAM" or w[0].startswith("#"))]
    return head, [w for w in words if w and w[0] == "FLASER"]


def shaken(scan, time, rng):
    """The scan with its laser and robot pose shaken alike, at another time."""
    scan = list(scan)
    pose = 2 + int(scan[1])
    x, y, theta = (float(word) for word in scan[pose:pose + 3])
    moved = ["%.6f" % (x + rng.gauss(0, SHAKE_M)), "%.6f" % (y + rng.gauss(0, SHAKE_M)),
             "%.7f" % (theta + rng.gauss(0, SHAKE_RAD))]
    scan[pose:pose + 3] = scan[pose + 3:pose + 6] = moved
    scan[pose + 6] = scan[pose + 8] = "%.6f" % time
    return scan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("log", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    options = parser.parse_args()
    head, scans = read(options.log)
    if not scans:
        sys.exit("%s: no FLASER scan" % options.log)
    options.out.mkdir(parents=True, exist_ok=True)
    for kind in options.kinds:
        for seed in options.seeds:
            rng = random.Random("%s %d" % (kind, seed))
            path = options.out / ("%s-%d.log.gz" % (kind, seed))
            if path.exists():
                sys.exit("%s is there already" % path)
            with gzip.open(path, "wt", compresslevel=1) as out:
                for words in head:
                    out.write(" ".join(words) + "\n")
                for i, scan in enumerate(KINDS[kind](scans)):
                    out.write(" ".join(shaken(scan, i * SECONDS_APART, rng)) + "\n")


if __name__ == "__main__":
    main()
