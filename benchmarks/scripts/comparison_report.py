#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and plots of `cca-mrpt-bench compare-extractors`.

usage: comparison_report.py DIR DOCUMENT.md IMAGES

Reads DIR/comparison.csv, writes the tables of all figures to DIR/comparison_tables.md, draws
IMAGES/comparison_*.png, and puts verdicts and losses between the lines `<!-- begin NAME -->` and
`<!-- end NAME -->` of the document.
"""
import collections
import csv
import os
import re
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# name in the CSV: heading, factor, decimals, +1 where more is better, -1 where less, 0 neither
FIGURES = {
    "f1": ("F1", 1, 3, 1), "f1_minus_cca": ("F1 minus CCA's", 1, 3, 0), "precision": ("precision", 1, 3, 1), "recall": ("recall", 1, 3, 1),
    "covered": ("covered %", 100, 1, 1), "lateral": ("lateral mm", 1e3, 1, -1),
    "lateral_minus_cca": ("lateral minus CCA's, common edges, mm", 1e3, 2, 0),
    "angular": ("angle deg", 57.29578, 2, -1), "range_rmse": ("range rmse mm", 1e3, 0, -1),
    "explained": ("explained %", 100, 1, 1),
    "explained_per_segment": ("explained beams / segment", 1, 1, 1),
    "blocked": ("blocked %", 100, 2, -1), "segments": ("segments", 1, 1, 0),
    "microseconds": ("µs / scan", 1, 0, -1),
}
OURS = ("cca", "shipped")


def read(path):
    """{(group, noise): {(extractor, parameters): {figure: (value, low, high)}}}, number of scans."""
    results, scans = collections.OrderedDict(), {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            group = (row["group"], float(row["range_noise"]))
            who = (row["extractor"], row["parameters"])
            figures = results.setdefault(group, collections.OrderedDict()).setdefault(who, {})
            figures[row["figure"]] = tuple(float(row[k]) for k in ("value", "low", "high"))
            scans[group] = int(row["scans"])
    return results, scans


def title(group, scans):
    name, noise = group
    if name == "real":
        return "Real logs, %d scans" % scans
    return "Simulated, range noise %g mm, %d scans" % (1e3 * noise, scans)


def ranked(table, figure):
    return sorted((w for w in table if figure in table[w]), key=lambda w: -table[w][figure][0])


def cell(figures, figure):
    if figure not in figures:
        return "-"
    _, scale, decimals, _ = FIGURES[figure]
    value, low, high = (scale * v for v in figures[figure])
    return "%.*f ± %.*f" % (decimals, value, decimals, 0.5 * (high - low))


def markdown(table):
    order = ranked(table, "f1") or ranked(table, "explained_per_segment")
    shown = [f for f in FIGURES if any(f in table[w] for w in table)]
    lines = ["| extractor | parameters | " + " | ".join(FIGURES[f][0] for f in shown) + " |",
             "|---|---|" + "---|" * len(shown)]
    for who in order:
        name = "**%s**" % who[0] if who == OURS else who[0]
        lines.append("| %s | %s | %s |" % (name, who[1], " | ".join(cell(table[who], f)
                                                                   for f in shown)))
    return lines


def verdict(table, figure, better):
    """Who is better, level or worse than ours, by the interval of the paired difference."""
    heads, level, behind = [], [], []
    for who in table:
        if figure not in table[who]:
            continue
        _, low, high = table[who][figure]
        if better < 0:
            low, high = -high, -low
        (heads if low > 0 else behind if high < 0 else level).append(
            "%s (%s)" % who if table[who][figure][0] else who[0])
    return heads, level, behind


def item(text):
    """A list's item, in lines of the pages' width."""
    return textwrap.wrap("- " + text, 116, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)


def verdicts(group, table, scans):
    parts = []
    for figure, better, name in (("f1_minus_cca", 1, "F1"), ("lateral_minus_cca", -1, "lateral error")):
        heads, level, behind = verdict(table, figure, better)
        if heads or level or behind:
            parts.append("%s: better %s; level %s; worse %d" % (
                name, ", ".join(heads) or "nobody", ", ".join(level) or "nobody", len(behind)))
    return [line for part in parts for line in item("**%s**, %s." % (title(group, scans), part))]


def losses(group, table, scans):
    """Where another is better than ours; in bold where the intervals part."""
    parts = []
    for figure, (heading, _, _, sign) in FIGURES.items():
        if not sign or figure not in table.get(OURS, {}):
            continue
        best = max((w for w in table if figure in table[w]), key=lambda w: sign * table[w][figure][0])
        if best == OURS:
            continue
        ours, other = table[OURS][figure], table[best][figure]
        apart = other[1] > ours[2] if sign > 0 else other[2] < ours[1]
        mark = "**" if apart else ""
        parts.append("%s%s%s %s against %s (%s, %s)" % (
            mark, heading, mark, cell(table[OURS], figure), cell(table[best], figure), best[0], best[1]))
    return item("%s: %s." % (title(group, scans), "; ".join(parts))) if parts else []


def forest(results, scans, path):
    """Value and interval of the headline figure, extractor by extractor."""
    groups = [g for g in results if g[0] == "real" or g[1] in (0.01, 0.03)]
    figure, axes = plt.subplots(1, len(groups), figsize=(5.2 * len(groups), 6.4))
    for axis, group in zip([axes] if len(groups) == 1 else axes, groups):
        name = "explained_per_segment" if group[0] == "real" else "f1"
        table = results[group]
        order = ranked(table, name)[::-1]
        for y, who in enumerate(order):
            value, low, high = table[who][name]
            colour = "C3" if who == OURS else "C0" if who[1] == "tuned" else "0.55"
            axis.errorbar(value, y, xerr=[[max(0, value - low)], [max(0, high - value)]], fmt="o",
                          color=colour, capsize=2)
        axis.set_yticks(range(len(order)))
        axis.set_yticklabels(["%s, %s" % who for who in order], fontsize=7)
        axis.set_xlabel(FIGURES[name][0])
        axis.set_title(title(group, scans[group]), fontsize=9)
        axis.grid(axis="x", alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def sweep(results, path):
    """F1 and lateral error against the range noise."""
    noises = [g[1] for g in results if g[0] == "simulated"]
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    names = [w for w in results[("simulated", noises[0])] if w == OURS or w[1] == "tuned"]
    for axis, key in zip(axes, ("f1", "lateral")):
        for k, who in enumerate(names):
            scale = FIGURES[key][1]
            points = [(n, results[("simulated", n)][who].get(key)) for n in noises]
            points = [(n, v) for n, v in points if v]
            x = [1e3 * n for n, _ in points]
            style = dict(color="C3", lw=2.5, zorder=5) if who == OURS else dict(
                color=plt.cm.tab20(k % 20), lw=1)
            axis.plot(x, [scale * v[0] for _, v in points], marker="o", ms=3, label=who[0], **style)
            axis.fill_between(x, [scale * v[1] for _, v in points],
                              [scale * v[2] for _, v in points], color=style["color"], alpha=0.12)
        axis.set_xlabel("range noise, standard deviation [mm]")
        axis.set_ylabel(FIGURES[key][0])
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def write(path, text):
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def replace(document, name, lines):
    with open(document, encoding="utf-8") as file:
        text = file.read()
    begin, end = "<!-- begin %s -->" % name, "<!-- end %s -->" % name
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.S)
    if not pattern.search(text):
        raise SystemExit("%s: has no '%s'" % (document, begin))
    block = begin + "\n" + "\n".join(lines) + "\n" + end
    text = pattern.sub(lambda _: block, text)
    write(document, text)


def main():
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    folder, document, images = sys.argv[1:]
    results, scans = read(os.path.join(folder, "comparison.csv"))
    os.makedirs(images, exist_ok=True)
    forest(results, scans, os.path.join(images, "comparison_ranks.png"))
    if sum(g[0] == "simulated" for g in results) > 1:
        sweep(results, os.path.join(images, "comparison_noise.png"))
    tables = ["# Classical line extractors and CCA: all figures"]
    for group, table in results.items():
        tables += ["", "## " + title(group, scans[group]), ""] + markdown(table)
    write(os.path.join(folder, "comparison_tables.md"), "\n".join(tables) + "\n")
    paired = [line for g, table in results.items() for line in verdicts(g, table, scans[g])]
    replace(document, "verdicts", [""] + paired + [""])
    lost = [line for group, table in results.items() for line in losses(group, table, scans[group])]
    replace(document, "losses", [""] + lost + [""])


main()
