#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the experiments of docs/experiments.md and puts their tables and pictures there.

usage: experiments.py [NAME...] [--worlds WORLD,...]

NAME: static, dynamic, noise, complexity; default all. Worlds are named as in maps/; default all.
Installs and builds what is needed first. Runs are deterministic but for the times of "complexity".
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCUMENT = os.path.join(ROOT, "docs", "experiments.md")
IMAGES = os.path.join(ROOT, "docs", "images")
WORLDS = sorted(f[:-5] for f in os.listdir(os.path.join(ROOT, "maps"))
                if f.endswith(".yaml") and not f.endswith(".movers.yaml"))
LONGEST_RUN = 600  # s


def run(*command):
    """What the program prints; its exit status tells of a run that ended without finishing."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=LONGEST_RUN)
    return done.returncode, done.stdout, done.stderr


def built_program(*options):
    """The path of cca-mrpt, or with --bench of cca-mrpt-bench."""
    script = os.path.join(ROOT, "launch_scripts", "build_program.sh")
    return subprocess.run([script, *options], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def explore(program, world, folder, *options):
    """One exploration and what its map is worth; None where no map came of it."""
    path = os.path.join("maps", world + ".yaml")
    status, _, error = run(program, "explore", path, "--pose", "truth", "--out", folder, "--quiet",
                           *options)
    summary = os.path.join(folder, "summary.json")
    if not os.path.exists(summary):
        print("%s %s: %s" % (world, " ".join(options), error.strip()), file=sys.stderr)
        return None
    with open(summary) as file:
        result = json.load(file)
    _, text, _ = run(program, "evaluate", os.path.join(folder, "lines.csv"), "--world", path)
    result.update(json.loads(text)["world"])
    result["status"] = status
    return result


def number(value, decimals=3):
    return "-" if value is None else "%.*f" % (decimals, value)


HEAD = ["| run | finished | seen % | driven m | collisions | lines | map F1 | precision | recall | "
        "lateral mm |", "|" + "---|" * 10]


def row(name, r):
    if r is None:
        return "| %s | no map |%s" % (name, " |" * 8)
    lateral = r.get("lateral_rms_m")
    cells = [name, "yes" if r["finished"] else "**no**", number(100 * (r["coverage"] or 0), 1),
             number(r["distance_m"], 0), str(r["collisions"]), str(r["map_lines"]),
             number(r.get("f1")), number(r.get("precision")), number(r.get("recall")),
             number(None if lateral is None else 1e3 * lateral, 1)]
    return "| " + " | ".join(cells) + " |"


def keep_picture(folder, name):
    picture = os.path.join(folder, "map.png")
    if not os.path.exists(picture):
        return
    os.makedirs(IMAGES, exist_ok=True)
    target = os.path.join(IMAGES, name)
    if shutil.which("convert"):
        subprocess.run(["convert", picture, "-resize", "900x>", "-colors", "64", target], check=True)
    else:
        shutil.copy(picture, target)


def static(program, tmp, worlds):
    lines = list(HEAD)
    for world in worlds:
        folder = os.path.join(tmp, "static-" + world)
        lines.append(row(world, explore(program, world, folder, "--seed", "1")))
        if world == "apartment":
            keep_picture(folder, "experiment_static.png")
    return lines


def dynamic(program, tmp, worlds):
    lines = list(HEAD)
    for world in worlds:
        movers = os.path.join("maps", world + ".movers.yaml")
        if not os.path.exists(os.path.join(ROOT, movers)):
            continue
        folder = os.path.join(tmp, "dynamic-" + world)
        lines.append(row(world, explore(program, world, folder, "--seed", "1", "--movers", movers)))
        if world == "corridor_loop":
            keep_picture(folder, "experiment_dynamic.png")
    return lines


def noise(program, tmp, worlds):
    lines = list(HEAD)
    for world in [w for w in ("two_rooms", "apartment") if w in worlds]:
        for sigma in ("0", "0.01", "0.03", "0.1"):
            folder = os.path.join(tmp, "noise-%s-%s" % (world, sigma))
            result = explore(program, world, folder, "--seed", "1", "--range-noise", sigma)
            lines.append(row("%s, %g mm" % (world, 1e3 * float(sigma)), result))
            if world == "two_rooms" and sigma == "0.1":
                keep_picture(folder, "experiment_noise.png")
    return lines


def complexity(_program, _tmp, _worlds):
    """Median time of a scan against the number of beams."""
    lines = ["| beams | CCA µs / scan | split-and-merge | seeded region growing | Hough |",
             "|---|---|---|---|---|"]
    bench = built_program("--bench")
    names = ("cca", "split-and-merge", "seeded-region-growing", "hough")
    for beams in (91, 181, 361, 721, 1441, 2881):
        _, text, _ = run(bench, "compare-extractors", "maps/office.yaml", "maps/apartment.yaml",
                         "--scans", "30", "--laser.beams", str(beams), "--extractors",
                         ",".join(names))
        times = {}
        for line in text.splitlines():
            cells = [c.strip() for c in line.split("|")]
            if len(cells) > 4 and cells[1] in names:
                times.setdefault(cells[1], cells[-2])
        lines.append("| %d | %s |" % (beams, " | ".join(times.get(n, "-") for n in names)))
    return lines


def replace(name, lines):
    with open(DOCUMENT, encoding="utf-8") as file:
        text = file.read()
    begin, end = "<!-- begin %s -->" % name, "<!-- end %s -->" % name
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.S)
    if not pattern.search(text):
        raise SystemExit("%s: has no '%s'" % (DOCUMENT, begin))
    text = pattern.sub(lambda _: "\n".join([begin, ""] + lines + [end]), text)
    with open(DOCUMENT + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(DOCUMENT + ".part", DOCUMENT)


EXPERIMENTS = {"static": static, "dynamic": dynamic, "noise": noise, "complexity": complexity}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(EXPERIMENTS))
    parser.add_argument("--worlds", default=",".join(WORLDS), help="default: %(default)s")
    given = parser.parse_args()
    worlds = given.worlds.split(",")
    unknown = [n for n in given.names if n not in EXPERIMENTS] + [w for w in worlds if w not in WORLDS]
    if unknown:
        parser.error("unknown: " + ", ".join(unknown))
    program = built_program()
    with tempfile.TemporaryDirectory() as tmp:
        for name in given.names or EXPERIMENTS:
            replace(name, EXPERIMENTS[name](program, tmp, worlds))


main()
