#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Worlds whose lower left corners lie at (X, Y), in metres: a .yaml for each in DIR, and its name on the output.

    move_worlds.py DIR X Y WORLD.yaml...

The start moves along, as `start` or a `worlds.json` beside the world tells it."""
import json
import pathlib
import sys

import yaml


def move(world: pathlib.Path, x: float, y: float) -> dict:
    moved = yaml.safe_load(world.read_text())
    was_x, was_y, yaw = moved["origin"]
    if yaw:
        raise SystemExit(f"{world}: origin: is turned; only worlds that are not can be moved")
    moved["image"] = str((world.parent / moved["image"]).resolve())
    moved["origin"] = [x, y, 0.0]
    starts = world.parent / "worlds.json"
    if "start" not in moved and starts.exists():
        told = json.loads(starts.read_text()).get(world.stem, {}).get("start")
        if told:
            moved["start"] = (list(told) + [0.0])[:3]
    if "start" in moved:
        start_x, start_y, heading = moved["start"]
        moved["start"] = [start_x - was_x + x, start_y - was_y + y, heading]
    return moved


def main(folder: str, x: str, y: str, *worlds: str) -> None:
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    for world in map(pathlib.Path, worlds):
        path = pathlib.Path(folder) / f"{world.stem}_moved.yaml"
        path.write_text(yaml.safe_dump(move(world, float(x), float(y))))
        print(path)


if __name__ == "__main__":
    if len(sys.argv) < 5:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
