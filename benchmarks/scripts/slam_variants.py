#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How line SLAM bears what logs may lack: maps variations of logs, and tells how far visits of one place err.

    benchmarks/scripts/slam_variants.py PREPARED OUT --app cca-mrpt --scorer score_poses.py [--kinds third_of_beams ...]

PREPARED/raw/NAME.clf: CARMEN FLASER lines with raw odometry in both pose fields; PREPARED/ref/NAME.csv:
stamp,x,y,theta of each. The scorer writes JSON with loop.m (or local.m where nothing is visited twice). OUT gets
KIND/NAME.json, and is gone on with where it exists. Needs numpy.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

NO_RETURN = 80.0  # m, and beyond
LOST = 0.5        # m


def wrap(angle):
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


def between(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    x, y = b[0] - a[0], b[1] - a[1]
    return np.array([c * x + s * y, c * y - s * x, wrap(b[2] - a[2])])


def compose(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], wrap(a[2] + b[2])])


def left_out(share, seed):
    def kept(stamps, ranges, wheels, poses):
        keep = np.random.default_rng(seed).random(len(stamps)) >= share
        keep[0] = True
        return stamps[keep], ranges[keep], wheels[keep], poses[keep]
    return kept


def backwards(stamps, ranges, wheels, poses):
    return stamps[-1] - stamps[::-1], ranges[::-1], wheels[::-1], poses[::-1]


def last_two_thirds(*log):
    return tuple(column[len(column) // 3:] for column in log)


def every_beam_in(count):
    return lambda stamps, ranges, wheels, poses: (stamps, ranges[:, ::count], wheels, poses)


def noisier(sigma, seed):
    def noisy(stamps, ranges, wheels, poses):
        noise = np.random.default_rng(seed).normal(0.0, sigma, ranges.shape)
        return stamps, np.where(ranges < NO_RETURN, np.maximum(ranges + noise, 0.02), ranges), wheels, poses
    return noisy


def worse_wheels(stamps, ranges, wheels, poses):
    """10 % of each step, .05 rad a metre, and a bend of .03 rad a metre."""
    random = np.random.default_rng(1)
    driven = [wheels[0]]
    for before, after in zip(wheels[:-1], wheels[1:]):
        step = between(before, after)
        way = np.hypot(step[0], step[1])
        step = step * (1.0 + random.normal(0.0, 0.1, 3))
        step[2] += (random.normal(0.0, 0.05) + 0.03) * way
        driven.append(compose(driven[-1], step))
    return stamps, ranges, np.array(driven), poses


def wheels_off_by(share):
    """Wheels whose radius is not what the robot takes it for."""
    def off(stamps, ranges, wheels, poses):
        driven = [wheels[0]]
        for before, after in zip(wheels[:-1], wheels[1:]):
            driven.append(compose(driven[-1], between(before, after) * (1.0 + share, 1.0 + share, 1.0)))
        return stamps, ranges, np.array(driven), poses
    return off


def among_people(seed):
    """Three at a time, round, half a metre wide, within 5 m of the laser (180 degrees ahead), who walk along for a while."""
    def peopled(stamps, ranges, wheels, poses):
        random = np.random.default_rng(seed)
        ranges = ranges.copy()
        bearings = np.linspace(-np.pi / 2, np.pi / 2, ranges.shape[1])
        people = []
        for scan in ranges:
            people = [person for person in people if person[2] > 0]
            while len(people) < 3:
                people.append([random.uniform(0.7, 4.0), random.uniform(-1.5, 1.5), random.integers(5, 40),
                               random.normal(0.0, 0.1), random.normal(0.0, 0.08)])
            for person in people:
                person[0] = np.clip(person[0] + person[3], 0.6, 5.0)
                person[1] += person[4]
                person[2] -= 1
                off = wrap(bearings - person[1])
                hit = np.abs(off) < np.arcsin(0.25 / person[0])
                depth = np.sqrt(np.maximum(0.0, 0.25**2 - (person[0] * np.sin(off[hit])) ** 2))
                scan[hit] = np.minimum(scan[hit], person[0] * np.cos(off[hit]) - depth)
        return stamps, ranges, wheels, poses
    return peopled


KINDS = {"as_it_is": lambda *log: log, "backwards": backwards, "last_two_thirds": last_two_thirds,
         "tenth_left_out_1": left_out(0.1, 1), "tenth_left_out_2": left_out(0.1, 2),
         "tenth_left_out_3": left_out(0.1, 3), "third_left_out": left_out(0.33, 4),
         "half_of_beams": every_beam_in(2), "third_of_beams": every_beam_in(3),
         "noise_3_cm": noisier(0.03, 5), "noise_5_cm": noisier(0.05, 6), "worse_wheels": worse_wheels,
         "wheels_4_percent_long": wheels_off_by(0.04), "wheels_4_percent_short": wheels_off_by(-0.04),
         "among_people_1": among_people(1), "among_people_2": among_people(2)}


def read(folder, name):
    with open(folder / "raw" / (name + ".clf")) as log:
        rows = [line.split() for line in log]
    beams = int(rows[0][1])
    number = lambda first, last: np.array([[float(word) for word in row[first:last]] for row in rows])  # noqa: E731
    stamps = np.array([float(row[-1]) for row in rows])
    poses = np.genfromtxt(folder / "ref" / (name + ".csv"), delimiter=",", skip_header=1)[:, 1:]
    return stamps, number(2, 2 + beams), number(2 + beams, 5 + beams), poses


def write(stem, stamps, ranges, wheels, poses):
    with open(stem + ".clf", "w") as log, open(stem + ".csv", "w") as reference:
        reference.write("stamp,x,y,theta\n")
        for stamp, scan, wheel, pose in zip(stamps, ranges, wheels, poses):
            at = "%.6f %.6f %.6f" % tuple(between(wheels[0], wheel))
            log.write("FLASER %d %s %s %s %.6f x %.6f\n"
                      % (len(scan), " ".join("%.4f" % r for r in scan), at, at, stamp, stamp))
            reference.write("%.6f,%.6f,%.6f,%.6f\n" % (stamp, *pose))


def score(options, kind, name):
    """Metres between visits of one place, and how many scans have no place."""
    kept = options.out / kind / (name + ".json")
    if not kept.exists():
        with tempfile.TemporaryDirectory() as folder:
            stem = os.path.join(folder, name)
            write(stem, *KINDS[kind](*read(options.prepared, name)))
            made = subprocess.run([options.app, "map", stem + ".clf", "--pose", "slam", "--out", folder + "/map",
                                   "--quiet"], stderr=subprocess.DEVNULL)  # warnings: the table tells
            if made.returncode not in (0, 3):  # 3: scans contradict the map
                raise SystemExit(f"map {stem}.clf: status {made.returncode}")
            told = subprocess.run([sys.executable, options.scorer, folder + "/map/poses.csv", stem + ".csv", "--json"],
                                  check=True, capture_output=True, text=True).stdout
            with open(folder + "/map/summary.json") as summary:
                unplaced = json.load(summary).get("scans_without_place", 0)
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps({"poses": json.loads(told), "scans_without_place": unplaced}))
    found = json.loads(kept.read_text())
    return (found["poses"]["loop"] or found["poses"]["local"])["m"], found["scans_without_place"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("prepared", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--app", default="cca-mrpt")
    parser.add_argument("--scorer", required=True)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    options = parser.parse_args()
    names = sorted(path.stem for path in (options.prepared / "raw").glob("*.clf"))
    if not names:
        sys.exit("%s: no raw/*.clf" % options.prepared)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        table = {kind: [pool.submit(score, options, kind, name) for name in names] for kind in options.kinds}
        print("| m between visits (scans without a place) | %s |\n|%s" % (" | ".join(names), "---|" * (len(names) + 1)))
        errors = []
        for kind, jobs in table.items():
            found = [job.result() for job in jobs]
            errors += [error for error, _ in found]
            cells = ["%.3f" % error + (" (%d)" % unplaced if unplaced else "") for error, unplaced in found]
            print("| %s | %s |" % (kind.replace("_", " "), " | ".join(cells)), flush=True)
    print("\nOf %d, %d err by more than %g m; geometric mean %.4f m." %
          (len(errors), sum(error > LOST for error in errors), LOST, np.exp(np.mean(np.log(errors)))))


if __name__ == "__main__":
    main()
