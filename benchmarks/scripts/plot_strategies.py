#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Coverage over distance, as compare-strategies wrote it: plot_strategies.py FOLDER -> FOLDER/coverage.png.

Distances of each world are divided by the mean distance that the nearest frontier (or else the first
strategy) drove there, so that worlds of all sizes make one picture. Bands: 95 % of the mean over
worlds and starts.
"""
import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def read_curves(path):
    curves = defaultdict(list)
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            key = row["world"], row["strategy"], row["start"]
            curves[key].append((float(row["distance_m"]), float(row["coverage"])))
    return {key: np.array(points) for key, points in curves.items()}


def main():
    folder = sys.argv[1]
    curves = read_curves(folder + "/curves.csv")
    strategies = list(dict.fromkeys(strategy for _, strategy, _ in curves))
    reference = "nearest_frontier" if "nearest_frontier" in strategies else strategies[0]
    lengths = defaultdict(list)
    for (world, strategy, _), points in curves.items():
        if strategy == reference:
            lengths[world].append(max(points[-1, 0], 0.1))
    share = np.linspace(0.0, 1.5, 301)
    plt.figure(figsize=(8, 5))
    for strategy in strategies:
        runs = np.array([
            np.interp(share, points[:, 0] / np.mean(lengths[world]), points[:, 1])
            for (world, s, _), points in curves.items() if s == strategy
        ])
        mean = 100 * runs.mean(axis=0)
        spread = runs.std(axis=0, ddof=1) if len(runs) > 1 else np.zeros_like(mean)
        band = 100 * 1.96 * spread / np.sqrt(len(runs))
        line, = plt.plot(share, mean, label=strategy)
        plt.fill_between(share, mean - band, np.minimum(mean + band, 100), alpha=0.15, color=line.get_color())
    plt.xlabel("distance / distance that %s drives in the end" % reference)
    plt.ylabel("seen of what can be seen (%)")
    plt.ylim(0, 101)
    plt.grid(alpha=0.3)
    plt.legend()
    plt.tight_layout()
    plt.savefig(folder + "/coverage.png", dpi=120)
    print(folder + "/coverage.png")


if __name__ == "__main__":
    main()
