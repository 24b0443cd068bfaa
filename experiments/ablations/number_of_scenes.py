#!/usr/bin/env python3
"""The errors of a rig over the number of scenes, for each noise, and by what combines the scenes.

number_of_scenes.py CROON OUT [OPTIONS OF CROON RUN]: runs number_of_scenes.json (standing, noise none and real_still) and
driving_choices.json (noise real) with each number of scenes, in folders of OUT; prints three Markdown tables, and draws
OUT/number_of_scenes.svg. Results that are in OUT already are not computed again. A cell has the median and the 95th
percentile of the accepted poses of all sensors. Needs the Python package and Matplotlib. The tables:
  1. bundle_adjustment over the number, for each noise, with how many poses are accepted and right, and accepted and
     wrong; below, the exponent of n in the median, by least squares.
  2. with real_still, each way to combine the scenes.
  3. joint against pairs (comparison_by_dof.csv), for each noise: by how many times the median error of each other way
     is that of bundle_adjustment, the minimum and the maximum over the 24 degrees of freedom of all sensors; in how many
     of the 24 the median of the paired differences is above zero, so the other way is worse, and in how many below; and
     the minimum p of the latter, over groups of scenes and without correction.
"""
import csv
import os
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import matplotlib  # noqa: E402

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import croon  # noqa: E402
from sweep import head, merged, row, run, study  # noqa: E402

TOTALS = {1: 20, 2: 40, 5: 40, 10: 40, 20: 80, 50: 100}  # By number of scenes, the scenes of all groups.
STANDING, DRIVING = study("number_of_scenes.json"), study("driving_choices.json")
NOISES = {"none": STANDING, "real_still": STANDING, "real": DRIVING}
ONLY = {STANDING: [], DRIVING: ["--only", "base", "consensus", "weighted consensus"]}
ERRORS = (("rotation_error_deg", 1, 4, "rotation °"), ("translation_error_m", 1000, 1, "translation mm"))


def accepted(trials, variant):
    """The accepted trials of a variant."""
    return trials[(trials["variant"] == variant) & np.isin(trials["status"], ("success", "inaccurate"))]


def cells(poses):
    """Median and 95th percentile of the rotation in degrees, and of the translation in mm."""
    if len(poses) < 2:
        return ["-", "-"]
    return ["{:.{d}f}, {:.{d}f}".format(*np.percentile(scale * poses[name], (50, 95)), d=digits)
            for name, scale, digits, _ in ERRORS]


def medians(found, noise, name, scale):
    """The median errors over the numbers of scenes."""
    return [scale * np.median(accepted(found[noise, number].trials, "base")[name]) for number in TOTALS]


def over_noises(found):
    """Table 1."""
    head("noise", "scenes", "poses", "right, wrong", *(what for *_, what in ERRORS))
    for noise in NOISES:
        for number in TOTALS:
            trials = found[noise, number].trials
            poses = accepted(trials, "base")
            right = np.sum(poses["status"] == "success")
            row(f"`{noise}`", number, np.sum(trials["variant"] == "base"), f"{right}, {len(poses) - right}", *cells(poses))
    for noise in NOISES:
        row(f"`{noise}`", "exponent", "", "", *(
            f"{np.polyfit(np.log(list(TOTALS)), np.log(medians(found, noise, name, scale)), 1)[0]:.2f}"
            for name, scale, *_ in ERRORS))


def over_ways(found):
    """Table 2."""
    ways = list(dict.fromkeys(map(str, found["real_still", 1].trials["variant"])))
    head("scenes", *(f"{way}: {what}" for way in ways for what in ("°", "mm")))
    for number in TOTALS:
        row(number, *(cell for way in ways for cell in cells(accepted(found["real_still", number].trials, way))))


def paired(found):
    """Table 3."""
    head("noise", "scenes", "pairs by", "times the error", "worse", "better", "minimum p of the better")
    for (noise, number), results in found.items():
        with open(os.path.join(results.folder, "comparison_by_dof.csv"), encoding="utf-8") as file:
            rows = [one for one in csv.DictReader(file) if one["sensor"] != "all" and one["paired_difference"]]
        for way in dict.fromkeys(one["variant"] for one in rows):
            of = [one for one in rows if one["variant"] == way]
            ratios = [float(one["variant_median"]) / float(one["base_median"]) for one in of]
            better = [float(one["wilcoxon_p_by_scene"]) for one in of if float(one["paired_difference"]) < 0]
            worse = sum(float(one["paired_difference"]) > 0 for one in of)
            row(f"`{noise}`", number, way, f"{min(ratios):.1f} to {max(ratios):.0f}", worse, len(better),
                f"{min(better):.2f}" if better else "-")


def draw(found, path):
    """Draws the medians of the rotation and of the translation over the number of scenes."""
    figure, panels = plt.subplots(1, 2, figsize=(9.4, 3.9))
    for panel, (name, scale, _, what) in zip(panels, ERRORS):
        for noise, line in zip(NOISES, ("-", "--", ":")):
            panel.loglog(list(TOTALS), medians(found, noise, name, scale), line, marker="o", label=noise)
        panel.set(title=f"median error, {what}", xlabel="number of scenes")
        panel.set_xticks(list(TOTALS), list(map(str, TOTALS)))
        panel.minorticks_off()
        panel.grid(alpha=0.3)
    panels[0].legend()
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})


def main(program, out, *options):
    """Runs what is missing, prints the tables and draws the figure."""
    scenes, found = merged(STANDING)["dataset"], {}
    for noise, experiment in NOISES.items():
        for number, total in TOTALS.items():
            changes = {"scenes_per_trial": number, "dataset": {**scenes, "scenes": total, "noise": noise}}
            found[noise, number] = croon.load(
                run(program, out, [experiment], changes, [*ONLY[experiment], *options], f"{noise}_{number}"))
    over_noises(found)
    print()
    over_ways(found)
    print()
    paired(found)
    draw(found, os.path.join(out, "number_of_scenes.svg"))


if __name__ == "__main__":
    main(*sys.argv[1:])
