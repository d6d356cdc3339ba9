#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Judges floor plans: rooms and doors against plans that people drew, and measures against exact truth.

usage: floor_plan_table.py PROGRAM --plans FOLDER --bench FOLDER [--maps FOLDER] [--only NAME...] [--require KEY=VALUE...]
                           [--elsewhere SEED]
       floor_plan_table.py PROGRAM --logs FOLDER --bench FOLDER [--pose log|slam] [--maps FOLDER] [--only NAME...] [--require KEY=VALUE...]
       floor_plan_table.py PROGRAM --worlds FOLDER [--maps FOLDER] [--only NAME...] [--require KEY=VALUE...]

--plans    plans with world.yaml, gt.png and plain.png; each is explored once and planned
--logs     real logs, NAME-corrected.log.gz: those of test/floor_plan/truth, whose rooms and doors were drawn by hand;
           each is mapped by its own poses (`map LOG --pose log`), whose frame the drawings are in; by --pose slam in
           a frame that is off by as much as SLAM and who corrected the log disagree
--bench    the scorer of rooms (score_rooms.py, rooms_lib.py)
--worlds   worlds with NAME.yaml and NAME.truth.csv, the faces of their walls: door widths, sides, thickness; beside the
           errors what the lines tell of theirs, sigma times .674, which is the median of the errors of such a sigma
--elsewhere  explores from another start each, with this seed, walls shifted off the grid's lines: a second set
--maps     where the explored maps are kept, and found again
--require  ends with status 1 where a mean falls short (pq, f50, iou75, door_recall, door_precision) or is
           exceeded (count_off; door_cm, side_cm, thickness_cm, area_percent)
Ends with status 77 where the folders are missing.
"""
import argparse
import csv
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time

SHIFT = (0.023, 0.031)  # m, of --elsewhere
MEDIAN_OF_SIGMA = 0.6745  # of the magnitude of a normal variable
TRUTH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "test", "floor_plan", "truth")
COLUMNS = ("pq", "f50", "iou75", "iou", "door_recall", "door_precision", "count_off", "seconds")
# A start from which the robot gets out: that of the plan stands in a ring of chairs.
STARTS = {"office_h": "12.375,39.075,0"}
LOWER_IS_BETTER = {"count_off", "door_cm", "side_cm", "thickness_cm", "area_percent"}


def shifted(plan, name, seed, work):
    """The world of a plan off the grid's lines, and a start with 0.6 m around it: options of explore."""
    import numpy as np
    from PIL import Image
    from scipy import ndimage

    free = np.asarray(Image.open(os.path.join(plan, "furnished.png")).convert("L")) >= 250
    inside = np.asarray(Image.open(os.path.join(plan, "gt.png"))).astype(int) > 0
    clearance = ndimage.distance_transform_edt(free)  # cells of 5 cm
    parts, _ = ndimage.label(clearance > 6.5)
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    places = np.argwhere((parts == sizes.argmax()) & (clearance > 12) & inside)
    random = np.random.RandomState(seed + len(name))
    row, column = places[random.randint(len(places))]
    x, y = (column + 0.5) * 0.05 + SHIFT[0], (free.shape[0] - row - 0.5) * 0.05 + SHIFT[1]
    world = os.path.join(work, name + ".yaml")
    with open(world, "w") as file:
        file.write(f"image: {os.path.abspath(os.path.join(plan, 'furnished.png'))}\nresolution: 0.05\n"
                   f"origin: [{SHIFT[0]}, {SHIFT[1]}, 0.0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n")
    return world, ["--start", f"{x:.3f},{y:.3f},{random.randint(360)}", "--seed", str(seed)]


def explored(program, world, name, maps, options=None):
    folder = os.path.join(maps, name)
    if not os.path.exists(os.path.join(folder, "summary.json")):
        start = options or (["--start", STARTS[name]] if name in STARTS else [])
        done = subprocess.run([program, "explore", world, "--out", folder, "--quiet", "--force", *start],
                              capture_output=True, text=True)
        if done.returncode not in (0, 3):
            sys.exit(f"{name}: {done.stderr}")
    return folder


def planned(program, folder, out):
    begin = time.monotonic()
    subprocess.run([program, "plan", folder, "--out", out, "--quiet", "--force"], check=True)
    seconds = time.monotonic() - begin
    with open(os.path.join(out, "plan.geojson")) as file:
        return json.load(file)["features"], seconds


def head(title):
    print(f"| {title} | rooms | found | " + " | ".join(COLUMNS) + " |\n" + "|---" * (3 + len(COLUMNS)) + "|")


def show(name, row, seconds):
    row["count_off"] = abs(row["rooms"] - row["gt_rooms"]) / row["gt_rooms"]
    row["seconds"] = seconds
    print(f"| {name} | {row['gt_rooms']} | {row['rooms']} | " + " | ".join(f"{row[c]:.3f}" for c in COLUMNS) + " |")
    return row


def means_of(rows):
    means = {c: statistics.mean(row[c] for row in rows) for c in COLUMNS}
    print("| mean | | | " + " | ".join(f"{means[c]:.3f}" for c in COLUMNS) + " |")
    return means


def origin_of(folder):
    with open(os.path.join(folder, "map.yaml")) as file:
        return [float(v) for v in file.read().split("origin: [")[1].split("]")[0].split(",")[:2]]


def seen_cells(folder, shape, score_rooms, shift):
    """The free cells of a map, seen in the ground truth's picture."""
    import numpy as np
    from PIL import Image

    cells = np.asarray(Image.open(os.path.join(folder, "map.pgm"))) == 254
    return score_rooms.place(cells.astype(np.int64), 0.05, origin_of(folder), shape, 0.05, shift) > 0


def score_logs(options, work):
    """Rooms and doors of real logs. A drawn room counts where the map is free; floor outside of all drawn rooms is wrong."""
    sys.path.insert(0, options.bench)
    import numpy as np
    import score_rooms
    from PIL import Image

    rows = []
    head("log")
    for name in sorted(options.only or [f[: -len(".geojson")] for f in os.listdir(TRUTH)]):
        folder = os.path.join(options.maps, name)
        subprocess.run([options.program, "map", os.path.join(options.logs, name + "-corrected.log.gz"), "--pose", options.pose,
                        "--out", folder, "--quiet", "--force"], check=True)
        out = os.path.join(work, name)
        _, seconds = planned(options.program, folder, out)
        seen = np.asarray(Image.open(os.path.join(folder, "map.pgm"))) == 254
        origin = origin_of(folder)
        drawn, points = score_rooms.rasterise(os.path.join(TRUTH, name + ".geojson"), seen.shape, 0.05, origin)
        doors = [{"x": p["x"], "y": p["y"], "width": 0.0} for p in points]  # a drawn door has no width
        rows.append(show(name, score_rooms.evaluate(os.path.join(out, "plan.geojson"), np.where(seen, drawn, 0),
                                                    plain=(drawn > 0) & ~seen, gt_origin=origin, gt_doors=doors), seconds))
    return means_of(rows)


def score_plans(options, work):
    sys.path.insert(0, options.bench)
    import rooms_lib
    import score_rooms

    head("plan")
    rows = []
    for name in sorted(options.only or os.listdir(options.plans)):
        plan = os.path.join(options.plans, name)
        if not os.path.isdir(plan):
            continue
        if options.elsewhere is None:
            world, start, shift = os.path.join(plan, "world.yaml"), None, (0, 0)
        else:
            (world, start), shift = shifted(plan, name, options.elsewhere, work), SHIFT
        folder = explored(options.program, world, name, options.maps, start)
        out = os.path.join(work, name)
        _, seconds = planned(options.program, folder, out)
        truth = score_rooms.load_labels(os.path.join(plan, "gt.png"))
        plain = rooms_lib.read_grey(os.path.join(plan, "plain.png")) >= 250
        rows.append(show(name, score_rooms.evaluate(
            os.path.join(out, "plan.geojson"), truth, plain=plain,
            seen=seen_cells(folder, truth.shape, score_rooms, shift), gt_origin=shift), seconds))
    return means_of(rows)


def distance(p, face):
    (a, b) = face
    way = (b[0] - a[0], b[1] - a[1])
    along = ((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / (way[0] ** 2 + way[1] ** 2)
    along = min(1.0, max(0.0, along))
    return math.dist(p, (a[0] + along * way[0], a[1] + along * way[1]))


def true_width(a, b, faces):
    """m between the faces that a door's jambs stand on: those across it."""
    way = [(b[k] - a[k]) / math.dist(a, b) for k in (0, 1)]
    stands = []
    for jamb in (a, b):
        across = [f for f in faces if distance(jamb, f) < 0.15 and
                  abs((f[1][0] - f[0][0]) * way[0] + (f[1][1] - f[0][1]) * way[1]) < 0.1 * math.dist(*f)]
        if not across:
            return None
        face = min(across, key=lambda f: distance(jamb, f))
        stands.append((face[0][0] - a[0]) * way[0] + (face[0][1] - a[1]) * way[1])
    return stands[1] - stands[0]


class Lines:
    """What the map tells of its lines, by id: ends and deviation of the offset."""

    def __init__(self, path):
        with open(path) as file:
            rows = list(csv.DictReader(file))
        self.ends = {int(r["id"]): ((float(r["x1"]), float(r["y1"])), (float(r["x2"]), float(r["y2"]))) for r in rows}
        self.sigma = {int(r["id"]): float(r["sigma_offset"]) for r in rows}

    def of_side(self, a, b):
        """The sigma of the line that a side of a room was drawn along; None where it was none."""
        if a == b:
            return None
        middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        way = [(b[k] - a[k]) / math.dist(a, b) for k in (0, 1)]
        near = [(distance(middle, line), number) for number, line in self.ends.items()
                if abs((line[1][0] - line[0][0]) * way[1] - (line[1][1] - line[0][1]) * way[0]) < 0.1 * math.dist(*line)]
        off, number = min(near, default=(math.inf, None))
        return self.sigma[number] if off < 0.03 else None


def told(*sigmas):
    """cm, the median error of what lies between two lines of these sigmas."""
    return [] if None in sigmas else [100 * MEDIAN_OF_SIGMA * math.hypot(*sigmas)]


def area_of(ring):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2


def measure_worlds(options, work):
    """Errors of doors, sides, walls and areas where the true faces are known to the last digit."""
    errors = {"door_cm": [], "side_cm": [], "side_told_cm": [], "thickness_cm": [], "thickness_told_cm": [],
              "area_percent": []}
    print("| world | doors | door, cm | sides | side, cm | of lines | told, cm | walls | thickness, cm | of lines | told, cm "
          "| rooms | area, % |\n" + "|---" * 13 + "|")
    for name in sorted(options.only or [f[: -len(".truth.csv")] for f in os.listdir(options.worlds)
                                        if f.endswith(".truth.csv")]):
        with open(os.path.join(options.worlds, name + ".truth.csv")) as file:
            faces = [((float(r["x1"]), float(r["y1"])), (float(r["x2"]), float(r["y2"]))) for r in csv.DictReader(file)]
        faces = [f for f in faces if math.dist(*f) > 0]
        corners = [p for f in faces for p in f]
        folder = explored(options.program, os.path.join(options.worlds, name + ".yaml"), name, options.maps)
        features, _ = planned(options.program, folder, os.path.join(work, name))
        row, lines = {key: [] for key in errors}, Lines(os.path.join(folder, "lines.csv"))
        openings = [f["geometry"]["coordinates"] for f in features if f["properties"]["kind"] in ("door", "opening")]
        for feature in features:
            p, shape = feature["properties"], feature["geometry"]["coordinates"]
            if p["kind"] == "door":
                width = true_width(*shape, faces)
                if width:
                    row["door_cm"].append(100 * abs(width - p["width_m"]))
            elif p["kind"] == "wall" and p["faces"] == 2:
                # The generator's walls are 10 or 20 cm thick.
                row["thickness_cm"].append(100 * min(abs(p["thickness_m"] - t) for t in (0.1, 0.2)))
                row["thickness_told_cm"] += told(*(lines.sigma[p[face][0]] for face in ("left_line_ids", "right_line_ids")))
            elif p["kind"] == "room":
                ring = [tuple(c) for c in shape[0][:-1]]
                true = [min(corners, key=lambda c: math.dist(c, v)) for v in ring]
                # Corners on an opening lie in the middle of the wall, where there is no face.
                true = [c if math.dist(c, v) < 0.15 and not any(distance(v, o) < 0.12 for o in openings) else None
                        for c, v in zip(true, ring)]
                for k, vertex in enumerate(ring):
                    after = (k + 1) % len(ring)
                    if true[k] and true[after] and math.dist(true[k], true[after]) > 0.5:
                        row["side_cm"].append(100 * abs(math.dist(vertex, ring[after]) - math.dist(true[k], true[after])))
                        row["side_told_cm"] += told(lines.of_side(ring[k - 1], vertex),
                                                    lines.of_side(ring[after], ring[(after + 1) % len(ring)]))
                where = [c or v for c, v in zip(true, ring)]
                if len(shape) == 1 and sum(c is None for c in true) <= 0.25 * len(true):
                    row["area_percent"].append(100 * abs(area_of(ring) / area_of(where) - 1))
        print(f"| {name} | " + " | ".join(f"{len(v)} | {statistics.median(v):.2f}" if v else "0 | -" for v in row.values()) + " |")
        for key, values in row.items():
            errors[key] += values
    medians = {key: statistics.median(v) for key, v in errors.items() if v}
    print("| median | " + " | ".join(f"{len(errors[k])} | {medians[k]:.2f}" if k in medians else "0 | -" for k in errors) + " |")
    return medians


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    for option in ("--plans", "--bench", "--worlds", "--logs", "--maps"):
        parser.add_argument(option)
    parser.add_argument("--elsewhere", type=int, metavar="SEED")
    parser.add_argument("--pose", default="log", choices=["log", "slam"])
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--require", nargs="*", default=[])
    options = parser.parse_args()
    for folder in (options.plans, options.bench, options.worlds, options.logs):
        if folder and not os.path.isdir(folder):
            print(f"{folder} is not there; nothing was judged")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as work:
        options.maps = options.maps or os.path.join(work, "maps")
        os.makedirs(options.maps, exist_ok=True)
        judge = score_plans if options.plans else score_logs if options.logs else measure_worlds
        found = judge(options, work)
    failed = False
    for requirement in options.require:
        key, value = requirement.split("=")
        short = found[key] > float(value) if key in LOWER_IS_BETTER else found[key] < float(value)
        if short:
            print(f"{key} is {found[key]:.3f}, required: {value}")
            failed = True
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
