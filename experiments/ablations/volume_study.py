#!/usr/bin/env python3
"""When does volume help: two tables and one figure.

volume_study.py CROON OUT [OPTIONS OF CROON RUN]: runs volume_study.json after the paper's rough steps alone, after one
iteration of its registration and after the full one, each with three noises, and volume_study_options.json, in folders of
OUT; prints two Markdown tables, and draws OUT/volume_study.svg. Results that are in OUT already are not computed again.
Each number compares trials with a search for the minimum volume with the same trials without it (comparison.csv, all
sensors): the median of the differences of the translation errors in mm, below zero if the search helps, and how many
trials only the search, and only the trials without it, bring within 0.5 degrees and 0.1 m. ** marks a difference that is
significant over scenes after Holm's correction. Needs the Python package and Matplotlib.
"""
import os
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import matplotlib  # noqa: E402

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import croon  # noqa: E402
from sweep import head, row, run, study  # noqa: E402

ONE_ITERATION = {"type": "icpn", "normal_neighbours": 40, "max_distances_m": [1.0], "max_iterations": 1}
BEFORE = {"rough steps": {"step": "identity", "name": "registration"},
          "one iteration": {"step": "registration", "icp": ONE_ITERATION},
          "full registration": {"step": "registration", "icp": {"type": "icpn", "normal_neighbours": 40}}}
NOISES = {"none": "none", "real_still": "real_still",
          "twice real_still": {"like": "real_still", "range_std_m": 0.04, "angle_std_deg": 0.04}}
SEARCHES = {"coordinate_scan(dofs=x+y ": "scan of x, y", "coordinate_scan(dofs=roll+": "scan of six",
            "golden_section": "golden section of six", "bobyqa": "BOBYQA"}  # By the start of the name in the grid.
LEAVES_M = (0.05, 0.1, 0.2)


def compared(results):
    """The comparisons over all sensors, by the name of the variant."""
    return {str(one["variant"]): one for one in results.comparisons if one["sensor"] == "all"}


def by_choice(results):
    """The comparisons of a grid by (lattices, leaf size, label of the search)."""
    chosen = {}
    for name, one in compared(results).items():
        _, lattices, leaf, search = name.split("/", 3)
        label = next(label for start, label in SEARCHES.items() if search.startswith(start))
        chosen[int(lattices.split("=")[1]), float(leaf.split("=")[1]), label] = one
    return chosen


def in_words(one):
    """A cell: the median difference and its mark, and the trials that are won and lost."""
    marks = [r"\*\*" if one[f"{what}_significant"] == 1 == one[f"{what}_by_scene"] else ""
             for what in ("translation", "success")]
    return (f"{1000 * one['translation_paired_difference_m']:+.1f}{marks[0]}; "
            f"{one['only_variant']:.0f}, {one['only_base']:.0f}{marks[1]}")


def without(results):
    """A cell: the success and the median error of the trials without a search for the minimum volume."""
    trials = results.trials[results.trials["variant"] == "base"]
    right = trials[trials["status"] == "success"]
    return f"{100 * len(right) / len(trials):.1f} %, {1000 * np.median(right['translation_error_m']):.1f} mm"


def draw(studies, path):
    """Draws a row of panels per noise, a column per what comes before."""
    figure, panels = plt.subplots(len(NOISES), len(BEFORE), figsize=(10.2, 8.4), constrained_layout=True)
    for panel, ((noise, before), chosen) in zip(panels.flat, studies.items()):
        for j, label in enumerate(SEARCHES.values()):
            for k, lattices in enumerate((1, 8)):
                of = [chosen[lattices, leaf, label] for leaf in LEAVES_M]
                middle, low, high = (np.array([1000 * one[f"translation_paired_{what}_m"] for one in of])
                                     for what in ("difference", "low", "high"))
                panel.errorbar(np.arange(len(LEAVES_M)) + 0.1 * (2 * j + k - 3.5), middle, (middle - low, high - middle),
                               fmt="o", color=f"C{j}", mfc="white" if lattices == 1 else None, markersize=4,
                               label=label if lattices > 1 else None)
        panel.axhline(0, color="black", linewidth=0.8)
        panel.set_xticks(range(len(LEAVES_M)), [f"{leaf:g}" for leaf in LEAVES_M])
        panel.set_title(f"{noise}, after {before}", fontsize=10)
    figure.supxlabel("leaf size in m; open: 1 lattice, filled: 8")
    figure.supylabel("median difference of the translation errors to those without, mm")
    panels.flat[0].legend(fontsize=8)
    figure.savefig(path, metadata={"Date": None})


def main(program, out, *options):
    """Runs what is missing, prints the tables and draws the figure."""
    found = {}
    for noise, simulated in NOISES.items():
        for before, step in BEFORE.items():
            changes = {"pipeline.registration": step, "dataset.noise": simulated}
            name = f"{noise}_after_{before}".replace(" ", "_")
            found[noise, before] = croon.load(run(program, out, [study("volume_study.json")], changes, options, name))
    studies = {key: by_choice(results) for key, results in found.items()}
    head("noise", "after", "without", *SEARCHES.values())
    for (noise, before), chosen in studies.items():
        row(f"`{noise}`", before, without(found[noise, before]),
            *(in_words(chosen[8, 0.1, label]) for label in SEARCHES.values()))
    print()
    head("option", "difference; won, lost")
    for name, one in compared(croon.load(run(program, out, [study("volume_study_options.json")], {}, options))).items():
        row(name, in_words(one))
    draw(studies, os.path.join(out, "volume_study.svg"))


if __name__ == "__main__":
    main(*sys.argv[1:])
