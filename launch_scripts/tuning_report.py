#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plots of `cca-mrpt tune`, and its tables put into a document.

usage: tuning_report.py DIR OUTPUT.txt DOCUMENT.md IMAGES

Reads DIR/surface.csv, draws IMAGES/tuning_*.png; OUTPUT.txt is what the program printed.
"""
import csv
import os
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

NAMES = ("similarity_cut", "vertex_price", "straightness")
TITLES = {"scan": "F1 of single scans", "map": "F1 of the map's length", "both": "mean of the two"}


def read(path):
    """{objective: {(cut, price, straightness): (value, low, high)}}"""
    surface = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            setting = tuple(float(row[n]) for n in NAMES)
            surface.setdefault(row["objective"], {})[setting] = tuple(
                float(row[k]) for k in ("value", "low", "high"))
    return surface


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def levels(table, k):
    return sorted({setting[k] for setting in table})


def surfaces(surface, path):
    """Mean response over vertex_price x straightness, an image an objective."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8))
    for axis, objective in zip(axes, ("scan", "map", "both")):
        table = surface[objective]
        prices, straight = levels(table, 1), levels(table, 2)
        grid = [[mean(v[0] for s, v in table.items() if s[1:] == (p, w)) for w in straight]
                for p in prices]
        image = axis.imshow(grid, origin="lower", aspect="auto", cmap="viridis")
        for i, row in enumerate(grid):
            for j, value in enumerate(row):
                axis.text(j, i, "%.3f" % value, ha="center", va="center", color="w", fontsize=7)
        axis.set_xticks(range(len(straight)), ["%g" % w for w in straight])
        axis.set_yticks(range(len(prices)), ["%g" % p for p in prices])
        axis.set_xlabel("straightness, m")
        axis.set_ylabel("vertex_price, nats")
        axis.set_title(TITLES[objective], fontsize=10)
        figure.colorbar(image, ax=axis)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def main_effects(surface, path):
    """Mean response by level of each parameter. Scenes differ far more than settings: the plot shows
    means alone, the analysis of variance says which differences are more than chance."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.4))
    for k, axis in enumerate(axes):
        for objective, colour in (("scan", "C0"), ("map", "C1")):
            table = surface[objective]
            overall = mean(v[0] for v in table.values())
            axis.plot(levels(table, k),
                      [mean(v[0] for s, v in table.items() if s[k] == level) - overall
                       for level in levels(table, k)], marker="o", color=colour,
                      label="%s, about its mean of %.3f" % (TITLES[objective], overall))
        axis.set_xlabel(NAMES[k])
        axis.set_xscale("log" if k > 0 else "linear")
        axis.set_xticks(levels(table, k), ["%g" % level for level in levels(table, k)])
        axis.minorticks_off()
        axis.set_ylabel("main effect on F1")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def main():
    if len(sys.argv) != 5:
        raise SystemExit(__doc__)
    folder, output, document, images = sys.argv[1:]
    surface = read(os.path.join(folder, "surface.csv"))
    os.makedirs(images, exist_ok=True)
    surfaces(surface, os.path.join(images, "tuning_surfaces.png"))
    main_effects(surface, os.path.join(images, "tuning_main_effects.png"))
    with open(output, encoding="utf-8") as file:
        lines = file.read().strip()
    with open(document, encoding="utf-8") as file:
        text = file.read()
    pattern = re.compile("<!-- begin tables -->.*?<!-- end tables -->", re.S)
    if not pattern.search(text):
        raise SystemExit("%s: has no '<!-- begin tables -->'" % document)
    text = pattern.sub(lambda _: "<!-- begin tables -->\n" + lines + "\n<!-- end tables -->", text)
    with open(document + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(document + ".part", document)


main()
