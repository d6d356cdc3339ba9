#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a Google Benchmark report: time of each function against its size, both logarithmic.

usage: plot_complexity.py REPORT.json PICTURE.svg
"""
import collections
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "cca_mrpt"
import matplotlib.pyplot as plt  # noqa: E402

report, picture = sys.argv[1:]
series = collections.defaultdict(list)
with open(report) as file:
    for run in json.load(file)["benchmarks"]:
        if run.get("run_type") != "iteration" or "/" not in run["name"]:
            continue
        name, size = run["name"].split("/")[:2]
        micro = {"ns": 1e-3, "us": 1.0, "ms": 1e3, "s": 1e6}[run["time_unit"]]
        # Where a run goes through many scans, that of one [s].
        time = 1e6 * run["scan"] if "scan" in run else run["cpu_time"] * micro
        series[name].append((int(size), time))

figure, axes = plt.subplots(figsize=(9, 6))
for k, (name, points) in enumerate(series.items()):
    sizes, times = zip(*sorted(points))
    axes.loglog(sizes, times, marker="osv^D*"[k % 6], ms=4, lw=1.2, label=name)
sizes = sorted({s for points in series.values() for s, _ in points})
axes.loglog(sizes, [0.02 * s for s in sizes], "k:", lw=1, label="linear")
axes.set_xlabel("size: beams, walls, segments, rooms or laps")
axes.set_ylabel("CPU time [microseconds]")
axes.grid(True, which="both", alpha=0.25)
axes.legend(fontsize=8, loc="best")
figure.tight_layout()
os.makedirs(os.path.dirname(os.path.abspath(picture)), exist_ok=True)
figure.savefig(picture + ".part", format="svg", metadata={"Date": None})
os.replace(picture + ".part", picture)
