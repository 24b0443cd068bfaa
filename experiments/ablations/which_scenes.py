#!/usr/bin/env python3
"""Which scenes help: the errors of a rig from one scene and from five of one kind.

which_scenes.py CROON OUT [OPTIONS OF CROON RUN]: runs which_scenes.json beside this file with scenes of each kind and
of all ordinary kinds alike, in a folder of OUT for each, and prints a Markdown table per number of scenes: the 95th
percentile of the absolute error of the poses of all sensors by degree of freedom, in degrees and mm, and in brackets
the median of the standard deviation that their covariances say. No verdict judges: all poses count but those of trials
that failed. What is in OUT already is not run again.
"""
import math
import statistics

from runs import accepted, head, percentile_95, row, rows_of, run_changed, start

ORDINARY = ("urban", "suburban", "crossing", "car_park", "highway")
KINDS = {**{kind: {kind: 1} for kind in (*ORDINARY, "blocked", "narrow", "corridor", "empty")},
         "all ordinary": {kind: 1 for kind in ORDINARY}}
NUMBERS = {1: 16, 5: 40}  # Scenes per trial; in all.
DOFS = ("roll", "pitch", "yaw", "x", "y", "z")


def error(trial, dof):
    """The absolute error of a trial, in degrees or mm."""
    if dof in DOFS[:3]:
        return abs(float(trial[f"{dof}_error_deg"]))
    return abs(1000 * float(trial[f"{dof}_error_m"]))


def key_of(one):
    """What names a trial."""
    return one["variant"], one["scene"], one["sensor"], one["trial"]


def standard_deviations(results, poses):
    """Those of `poses`, in degrees and mm, by degree of freedom."""
    keys = {key_of(one) for one in poses}
    rows = [one for one in rows_of(results, "covariance.csv") if key_of(one) in keys]
    return {dof: [math.sqrt(float(one[f"c{i}{i}"])) * (math.degrees(1) if i < 3 else 1000) for one in rows]
            for i, dof in enumerate(DOFS)}


def cell(values, deviations, digits):
    """The 95th percentile of the errors, and in brackets the median of the standard deviations."""
    if len(values) < 2:
        return "-"
    return f"{percentile_95(values):.{digits}f} ({statistics.median(deviations):.{digits}f})"


def main(croon, out, *options):
    """Runs what is missing and prints the tables."""
    for number, scenes in NUMBERS.items():
        print(f"Scenes: {number}\n")
        head("kind", "poses", *(f"{dof} {'°' if dof in DOFS[:3] else 'mm'}" for dof in DOFS))
        for kind, mix in KINDS.items():
            results = run_changed(croon, out, options, "which_scenes", {"scenes_per_trial": number},
                                  {"scenes": scenes, "mix": mix})
            trials = rows_of(results, "trials.csv")
            poses = accepted(trials)
            deviations = standard_deviations(results, poses)
            cells = [cell([error(one, dof) for one in poses], deviations[dof], 4 if dof in DOFS[:3] else 1)
                     for dof in DOFS]
            row(f"`{kind}`", f"{len(poses)}/{len(trials)}", *cells)
        print()


if __name__ == "__main__":
    start(main, __doc__)
