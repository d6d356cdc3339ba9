#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How well robots are localised in finished maps and plans: the tables of docs/localisation.md.

usage: localisation_table.py PROGRAM BENCH particles|own|halves [--work FOLDER] [--worlds NAME...] [--logs FOLDER]

particles  beside MRPT's particle filter, in the true lines of worlds (maps/NAME.truth.csv)
own        the same in the map of an earlier drive: another seed, poses by line SLAM
halves     real logs (--logs, NAME-corrected.log.gz) in the map of their other half, made by the log's corrected
           poses, which are also what is taken for right. Twice: scans of even number map and the odd ones are
           localised; the first half by time maps and the second is localised, where it comes to mapped places.
           Nobody tells where the robot is. Wheels as the log has them; a log without odometry is left out

Worlds are explored by the laser rplidar_a1 (5.5 Hz, swept, 3 % of beams lost, noise of 1 % of the range) on wheels
that err. The drives are kept in --work, and found again there. Ends with status 77 where the logs are missing.
"""
import argparse
import gzip
import json
import math
import os
import subprocess
import sys
import tempfile

MAPS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "maps")
WORLDS = ["apartment", "office", "gallery", "random"]
LASER = "rplidar_a1"
SAME = 1e-9  # m, rad: a line that repeats the corrected pose


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit("%s\n%s" % (" ".join(command), done.stderr))
    return done.stdout


def explored(options, world, seed):
    """The folder of an exploration."""
    folder = os.path.join(options.work, "%s-%d" % (world, seed))
    if not os.path.exists(os.path.join(folder, "summary.json")):
        run(options.program, "explore", os.path.join(MAPS, world + ".yaml"), "--laser", LASER, "--seed", str(seed),
            "--out", folder, "--quiet", "--force")
    return folder


def particles(options):
    for world in options.worlds:
        print(run(options.bench, "compare-localisation", os.path.join(explored(options, world, 2), "run.rawlog"),
                  "--in", os.path.join(MAPS, world + ".truth.csv")), flush=True)


def own(options):
    for world in options.worlds:
        print(run(options.bench, "compare-localisation", os.path.join(explored(options, world, 2), "run.rawlog"),
                  "--in", explored(options, world, 1)), flush=True)


def compose(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], math.remainder(a[2] + b[2], 2 * math.pi)


def inverse(a):
    c, s = math.cos(a[2]), math.sin(a[2])
    return -c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]


def scans_of(path):
    """Of a CARMEN log whose FLASER poses were corrected: words of each scan, with the wheels' pose as the robot's.

    The ODOM lines lead on from each corrected pose; chained without these jumps they are the wheels' again."""
    wheels, last, corrected, steps, scans = (0.0, 0.0, 0.0), None, None, 0, []
    with gzip.open(path, "rt") as log:
        for words in (line.split() for line in log):
            if words[:1] == ["ODOM"]:
                pose = tuple(float(word) for word in words[1:4])
                jumps = corrected and max(abs(a - b) for a, b in zip(pose, corrected)) < SAME
                if last and not jumps:
                    wheels = compose(wheels, compose(inverse(last), pose))
                    steps += 1
                last, corrected = pose, None
            elif words[:1] == ["FLASER"]:
                at = 2 + int(words[1])
                corrected = tuple(float(word) for word in words[at:at + 3])
                words[at + 3:at + 6] = ["%.6f" % value for value in wheels]
                scans.append(words)
    return scans if steps >= len(scans) else None


def write(path, scans):
    with gzip.open(path, "wt", compresslevel=1) as out:
        out.writelines(" ".join(words) + "\n" for words in scans)
    return path


def halves(options):
    if not os.path.isdir(options.logs):
        print("skipped: there are no logs in " + options.logs)
        sys.exit(77)
    print("| log | halves | scans | localised | lost | first | rms m | worst m | rms deg | NEES |\n" + "|---" * 10 + "|")
    for name in sorted(os.listdir(options.logs)):
        scans = scans_of(os.path.join(options.logs, name)) if name.endswith("-corrected.log.gz") else None
        if not scans:
            print("| %s | has no odometry |" % name)
            continue
        stem = os.path.join(options.work, name.split("-corrected")[0])
        middle = len(scans) // 2
        for kind, mapped, driven in (("even, odd", scans[::2], scans[1::2]),
                                     ("first, second", scans[:middle], scans[middle:])):
            stem_of = stem + "-" + kind.replace(", ", "-")
            run(options.program, "map", write(stem_of + "-mapped.log.gz", mapped), "--pose", "log", "--out", stem_of + "-map",
                "--quiet", "--force")
            run(options.program, "localize", write(stem_of + "-driven.log.gz", driven), "--in", stem_of + "-map",
                "--out", stem_of + "-poses", "--quiet", "--force")
            with open(stem_of + "-poses/summary.json") as file:
                found = json.load(file)
            error = found.get("pose_error") or dict.fromkeys(("rms_m", "max_m", "rms_deg", "nees"), math.nan)
            print("| %s | %s | %d | %.1f %% | %d | %s | %.3f | %.3f | %.2f | %.1f |" % (
                os.path.basename(stem), kind, found["scans"], 100 * found["localised_share"], found["lost_times"],
                found.get("first_localised_scan", "-"), error["rms_m"], error["max_m"], error["rms_deg"], error["nees"]),
                flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("bench", help="cca-mrpt-bench")
    tables = {"particles": particles, "own": own, "halves": halves}
    parser.add_argument("table", choices=tables)
    parser.add_argument("--work")
    parser.add_argument("--worlds", nargs="+", default=WORLDS)
    parser.add_argument("--logs", default=os.path.join(MAPS, "..", "..", "shared", "data", "logs"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        options.work = options.work or scratch
        os.makedirs(options.work, exist_ok=True)
        tables[options.table](options)


if __name__ == "__main__":
    main()
