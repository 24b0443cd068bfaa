#!/usr/bin/env python3
"""Which scenes help: the errors of a rig from one scene and from five of one kind.

which_scenes.py CROON OUT [OPTIONS OF CROON RUN]: runs number_of_scenes.json (its variant base) with scenes of each kind and
of all ordinary kinds alike, in folders of OUT, and prints a Markdown table per number of scenes: the 95th percentile of
the absolute error of the poses of all sensors by degree of freedom, in degrees and mm, and in brackets the median of the
standard deviation that their covariances state. No verdict judges: all poses count but those of trials that failed.
Results that are in OUT already are not computed again. Needs the Python package.
"""
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

import croon  # noqa: E402
from sweep import head, row, run, study  # noqa: E402

ORDINARY = ("urban", "suburban", "crossing", "car_park", "highway")
KINDS = {**{kind: {kind: 1} for kind in (*ORDINARY, "blocked", "narrow", "corridor", "empty")},
         "all ordinary": {kind: 1 for kind in ORDINARY}}
NUMBERS = {1: 16, 5: 40}  # Scenes per trial; in all.
DATASET = {"type": "simulated", "rig": "croon_five", "noise": "real_still", "seed": 631}
DOFS = ("roll", "pitch", "yaw", "x", "y", "z")
KEY = ["variant", "scene", "sensor", "trial"]


def cell(poses, covariances, i):
    """The 95th percentile of the errors, and in brackets the median of the standard deviations."""
    unit, scale, scale_std, digits = ("deg", 1, np.degrees(1), 4) if i < 3 else ("m", 1000, 1000, 1)
    error = scale * np.percentile(np.abs(poses[f"{DOFS[i]}_error_{unit}"]), 95)
    return f"{error:.{digits}f} ({scale_std * np.median(np.sqrt(covariances[f'c{i}{i}'])):.{digits}f})"


def main(program, out, *options):
    """Runs what is missing and prints the tables."""
    for number, scenes in NUMBERS.items():
        print(f"Scenes: {number}\n")
        head("kind", "poses", *(f"{dof} {'°' if dof in DOFS[:3] else 'mm'}" for dof in DOFS))
        for kind, mix in KINDS.items():
            results = croon.load(run(
                program, out, [study("number_of_scenes.json")],
                {"scenes_per_trial": number, "dataset": {**DATASET, "scenes": scenes, "mix": mix}},
                ["--only", "base", *options], f"{number}_{kind.replace(' ', '_')}"))
            poses = results.trials[np.isin(results.trials["status"], ("success", "inaccurate"))]
            covariances = results.covariances[np.isin(results.covariances[KEY], poses[KEY])]
            cells = [cell(poses, covariances, i) if len(poses) > 1 else "-" for i in range(6)]
            row(f"`{kind}`", f"{len(poses)}/{len(results.trials)}", *cells)
        print()


if __name__ == "__main__":
    main(*sys.argv[1:])
