#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Statistics of `cca-mrpt-bench tune`: analysis of variance, the best combination, and how sure that is.

usage: tuning_report.py DIR [DOCUMENT.md IMAGES]

Prints the tables of DIR/runs.csv. With a document they are put between its lines `<!-- begin tables -->` and
`<!-- end tables -->` too, and IMAGES/tuning_*.png are drawn. Needs matplotlib, pandas and statsmodels.
"""
import os
import re
import sys
import typing

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import pandas  # noqa: E402
from statsmodels.formula.api import ols  # noqa: E402
from statsmodels.stats.anova import anova_lm  # noqa: E402

PARAMETERS = ["similarity_cut", "vertex_price", "straightness"]
TITLES = {"scan": "F1 of single scans", "map": "F1 of the map's length", "both": "Mean of the two"}
EFFECTS = [("similarity_cut",), ("vertex_price",), ("straightness",), ("similarity_cut", "vertex_price"),
           ("similarity_cut", "straightness"), ("vertex_price", "straightness"), ("scene",)]
RESAMPLES = 10000  # bounds of the intervals move by less than .0005 from seed to seed
CONFIDENCE = [0.025, 0.975]


class Experiment(typing.NamedTuple):
    """What `cca-mrpt-bench tune` has run.

    heading: how much of the design that is.
    shipped: the three parameters' defaults.
    runs: a row a run of the whole scenes: scene, the three parameters, and the responses scan, map, both in [0, 1].
    """
    heading: str
    shipped: typing.Tuple[float, ...]
    runs: pandas.DataFrame


class Recommendation(typing.NamedTuple):
    """The best combination, by the mean over scenes. Intervals are of 95 %, by a percentile bootstrap over scenes
    [Efron & Tibshirani 1993]. What is said of the shipped one is None where the design does not hold it."""
    best: typing.Tuple[float, ...]
    intervals: typing.List[typing.Tuple[float, float]]  # of each parameter, were other scenes drawn
    value: float
    shipped: typing.Optional[float]
    shortfall: typing.Optional[typing.Tuple[float, float, float]]  # best minus shipped, and its interval


def read(path):
    """The Experiment in a runs.csv. Scenes that lack a combination are left out; ends the program where there is no
    such file, or fewer than two scenes are whole."""
    if not os.path.exists(path):
        raise SystemExit("%s: is not there; `cca-mrpt-bench tune` writes it, with --merge where there were shards" % path)
    with open(path, encoding="utf-8") as file:
        file.readline()
        design = dict(re.findall(r"(\w+)=(\S+)", file.readline()))
    runs = pandas.read_csv(path, skiprows=2).rename(columns={"scan_f1": "scan", "map_f1": "map"})
    combinations, scenes = int(design["combinations"]), int(design["scenes"])
    heading = "%d of %d runs, %d scenes." % (len(runs), combinations * scenes, scenes)
    runs["scene"] = runs.job // combinations
    runs["both"] = 0.5 * (runs["scan"] + runs["map"])
    runs = runs[runs.groupby("scene").job.transform("size") == combinations]
    if runs.scene.nunique() < 2:
        raise SystemExit("%s: fewer than two scenes are complete: run the rest of the design" % path)
    return Experiment(heading, tuple(float(design[name]) for name in PARAMETERS), runs)


def analyse_variance(runs, response, effects):
    """Fixed-effects analysis of variance with sums of squares of type III, over sum-to-zero contrasts
    [Montgomery 2012, ch. 5].

    effects: tuples of factors: one for a main effect, two for an interaction.
    Returns a row an effect and "residual": df, sum_sq, mean_sq, F, p, and eta_sq, the partial eta^2
    SS / (SS + SS of the residual).
    """
    formula = " + ".join(":".join("C(%s, Sum)" % factor for factor in effect) for effect in effects)
    table = anova_lm(ols("%s ~ %s" % (response, formula), runs).fit(), typ=3).drop("Intercept")
    table.index = [" x ".join(re.findall(r"C\((\w+), Sum\)", name)) or "residual" for name in table.index]
    table = table.rename(columns={"PR(>F)": "p"})
    table["mean_sq"] = table.sum_sq / table.df
    table["eta_sq"] = table.sum_sq / (table.sum_sq + table.sum_sq["residual"])
    return table.loc[[" x ".join(effect) for effect in effects] + ["residual"]]


def recommend(runs, response, shipped):
    """The Recommendation for a response of whole scenes."""
    values = runs.pivot(index="scene", columns=PARAMETERS, values=response)
    scenes, combinations = len(values), list(values.columns)
    # How often each scene is drawn, of as many draws with replacement as there are scenes.
    draws = np.random.default_rng(1).multinomial(scenes, np.full(scenes, 1 / scenes), RESAMPLES)
    means, resampled = values.to_numpy().mean(axis=0), draws @ values.to_numpy() / scenes
    best = means.argmax()
    intervals = np.quantile([combinations[k] for k in resampled.argmax(axis=1)], CONFIDENCE, axis=0).T
    if shipped not in combinations:
        return Recommendation(combinations[best], intervals, means[best], None, None)
    now = combinations.index(shipped)
    shortfall = (means[best] - means[now], *np.quantile(resampled[:, best] - resampled[:, now], CONFIDENCE))
    return Recommendation(combinations[best], intervals, means[best], means[now], shortfall)


def variance_lines(table):
    lines = ["| effect | df | sum of squares | mean square | F | p | partial eta^2 |", "|---|---|---|---|---|---|---|"]
    for name, effect in table.iterrows():
        tested = " | | | |" if name == "residual" else " | %.1f | %.2g | %.3f |" % (effect.F, effect.p, effect.eta_sq)
        lines.append("| %s | %d | %.4f | %.5f%s" % (name, effect.df, effect.sum_sq, effect.mean_sq, tested))
    return lines


def recommendation_lines(found):
    best = ", ".join("%s %g [%g, %g]" % (name, level, *interval)
                     for name, level, interval in zip(PARAMETERS, found.best, found.intervals))
    lines = ["Best: %s: %.4f." % (best, found.value)]
    if found.shipped is None:
        return lines + ["The shipped combination is not one of the design's."]
    verdict = "the two cannot be told apart" if found.shortfall[1] <= 0 else "worse"
    return lines + ["Shipped: %.4f; short of the best by %.4f [%.4f, %.4f]: %s." % (
        found.shipped, *found.shortfall, verdict)]


def report(experiment):
    """The tables, as lines of Markdown."""
    lines = [experiment.heading]
    for response, title in TITLES.items():
        lines += ["", "### " + title, ""]
        lines += variance_lines(analyse_variance(experiment.runs, response, EFFECTS))
        lines += [""] + recommendation_lines(recommend(experiment.runs, response, experiment.shipped))
    return lines


def surfaces(runs, path):
    """Mean response over vertex_price x straightness, an image a response."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8))
    for axis, (response, title) in zip(axes, TITLES.items()):
        grid = runs.pivot_table(index="vertex_price", columns="straightness", values=response)
        image = axis.imshow(grid, origin="lower", aspect="auto", cmap="viridis")
        for (i, j), value in np.ndenumerate(grid):
            axis.text(j, i, "%.3f" % value, ha="center", va="center", color="w", fontsize=7)
        axis.set_xticks(range(len(grid.columns)), ["%g" % level for level in grid.columns])
        axis.set_yticks(range(len(grid.index)), ["%g" % level for level in grid.index])
        axis.set_xlabel("straightness, m")
        axis.set_ylabel("vertex_price, nats")
        axis.set_title(title, fontsize=10)
        figure.colorbar(image, ax=axis)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def main_effects(runs, path):
    """Mean response by level of each parameter. Scenes differ far more than settings: the plot shows
    means alone, the analysis of variance says which differences are more than chance."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.4))
    for name, axis in zip(PARAMETERS, axes):
        for response, colour in (("scan", "C0"), ("map", "C1")):
            overall, by_level = runs[response].mean(), runs.groupby(name)[response].mean()
            axis.plot(by_level.index, by_level - overall, marker="o", color=colour,
                      label="%s, about its mean of %.3f" % (TITLES[response], overall))
        axis.set_xlabel(name)
        axis.set_xscale("linear" if name == "similarity_cut" else "log")
        axis.set_xticks(by_level.index, ["%g" % level for level in by_level.index])
        axis.minorticks_off()
        axis.set_ylabel("main effect on F1")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def replace_tables(document, lines):
    with open(document, encoding="utf-8") as file:
        text = file.read()
    pattern = re.compile("<!-- begin tables -->.*?<!-- end tables -->", re.S)
    if not pattern.search(text):
        raise SystemExit("%s: has no '<!-- begin tables -->'" % document)
    block = "\n".join(["<!-- begin tables -->", *lines, "<!-- end tables -->"])
    with open(document + ".part", "w", encoding="utf-8") as file:
        file.write(pattern.sub(lambda _: block, text))
    os.replace(document + ".part", document)


def main():
    if len(sys.argv) not in (2, 4):
        raise SystemExit(__doc__)
    experiment = read(os.path.join(sys.argv[1], "runs.csv"))
    lines = report(experiment)
    print("\n".join(lines))
    if len(sys.argv) == 4:
        document, images = sys.argv[2:]
        replace_tables(document, lines)
        os.makedirs(images, exist_ok=True)
        surfaces(experiment.runs, os.path.join(images, "tuning_surfaces.png"))
        main_effects(experiment.runs, os.path.join(images, "tuning_main_effects.png"))


if __name__ == "__main__":
    main()
