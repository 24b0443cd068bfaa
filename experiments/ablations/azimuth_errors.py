#!/usr/bin/env python3
"""Do scenes of a recording agree better without the errors of the azimuths of its sensors?

azimuth_errors.py CROON OUT [OPTIONS OF CROON RUN]: runs azimuths.json and best.json on the authors' real scenes, in folders
of OUT, and prints two Markdown tables. The first: the errors that azimuth_calibration finds, in each scene alone and in
all of them together, with their standard deviations. The second: for each scene, with the errors of all other scenes, by
how much the loops over each two sensors are open in it, with the two others from a rig of all other scenes together, and
from this scene (see left_out_scene.py). Results that are in OUT already are not computed again. Needs the Python package.
"""
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import croon  # noqa: E402
from left_out_scene import BEST, by_sensor, opening, poses_of, scenes_and_pairs  # noqa: E402
from sweep import head, row, run, study  # noqa: E402

CALIBRATED = "azimuths calibrated"
PARTS = ("offset_deg", "sine_deg", "cosine_deg", "slope")


def calibrated(program, out, options, scenes):
    """The results of azimuths.json on these scenes, together."""
    return croon.load(run(program, out, [study("azimuths.json")],
                          {"scenes_per_trial": len(scenes), "dataset.scenes": scenes},
                          ["--only", "base", CALIBRATED, *options], "azimuths_" + "_".join(scenes)))


def azimuths(results):
    """By sensor, what azimuth_calibration reports."""
    reported = {}
    for one in results.diagnostics[results.diagnostics["step"] == "azimuth_calibration"]:
        reported.setdefault(str(one["sensor"]), {})[one["name"].replace("azimuth_", "")] = float(one["value"])
    return reported


def print_errors(program, out, options, groups):
    """The first table: a row for each sensor in each of the groups of scenes."""
    head("scenes", "sensor", "sine °", "cosine °", "slope", "standard deviations from zero", "corrected")
    for group in groups:
        for sensor, found in azimuths(calibrated(program, out, options, group)).items():
            row(", ".join(group), sensor, *(f"{found[part]:.3f} ± {found[std]:.3f}" for part, std in (
                ("sine_deg", "sine_std_deg"), ("cosine_deg", "cosine_std_deg"), ("slope", "slope_std"))),
                f"{found['significance']:.1f}", "yes" if found["corrected"] else "no")


def print_loops(program, out, options, scenes, pairs):
    """The second table."""
    head("scene left out", "pair", "loop with the others °, mm", "with this scene °, mm")
    for scene in scenes:
        results = calibrated(program, out, options, [one for one in scenes if one != scene])
        known = {sensor: {part: one[part] for part in PARTS}
                 for sensor, one in azimuths(results).items() if one["corrected"]}
        if not known:
            sys.exit(f"{results.folder}: expected a sensor with an error, found none")
        step = {"step": "azimuth_calibration", "known": known, "estimate": False}
        variant = {"name": "azimuths known", "insert": [{"after": "preprocessing", "step": step}]}
        alone = croon.load(run(program, out, BEST, {"loops": True, "variants": [variant], "dataset.scenes": [scene]},
                               options, f"{scene}_with_errors_of_others"))
        rig, here = by_sensor(poses_of(results, CALIBRATED)), by_sensor(poses_of(alone, "azimuths known"))
        for pair in pairs:
            source, target = pair.split(">")
            row(scene, pair, *(opening(poses, here.get(pair), target, source) for poses in (rig, here)))


def main(program, out, *options):
    """Runs what is missing and prints the tables."""
    _, scenes, pairs = scenes_and_pairs(program, out, options)
    print_errors(program, out, options, [[scene] for scene in scenes] + [scenes])
    print()
    print_loops(program, out, options, scenes, pairs)


if __name__ == "__main__":
    main(*sys.argv[1:])
