#!/usr/bin/env python3
"""Do scenes of a recording agree better without what the azimuths of its sensors are off by?

azimuth_errors.py CROON OUT [OPTIONS OF CROON RUN]: runs azimuth_errors.json and left_out_scene.json beside this file, in
folders of OUT, and prints two Markdown tables. The first: the errors that azimuth_calibration finds, in each scene alone
and in all of them together, with their standard deviations. The second: for each scene, with the errors of all other
scenes, by how much the loops over each two sensors are open in it, with the two others from a rig of all other scenes
together, and from this scene (see left_out_scene.py). What is in OUT already is not run again.
"""
import sys

from left_out_scene import opening, poses_of
from runs import head, row, rows_of, run_changed, start

CALIBRATED = "azimuths calibrated"
KNOWN = "azimuths known"
PARTS = ("offset_deg", "sine_deg", "cosine_deg", "slope")


def azimuths(results):
    """By sensor, what azimuth_calibration reports."""
    reported = {}
    for one in rows_of(results, "diagnostics.csv"):
        if one["step"] == "azimuth_calibration":
            name = one["name"].replace("azimuth_", "")
            reported.setdefault(one["sensor"], {})[name] = float(one["value"])
    return reported


def print_errors(croon, out, options, groups):
    """The first table: a row for each sensor in each of the groups of scenes."""
    head("scenes", "sensor", "sine °", "cosine °", "slope", "standard deviations from zero", "corrected")
    for group in groups:
        for sensor, found in azimuths(calibrated(croon, out, options, group)).items():
            row(", ".join(group), sensor, *(f"{found[part]:.3f} ± {found[std]:.3f}" for part, std in (
                ("sine_deg", "sine_std_deg"), ("cosine_deg", "cosine_std_deg"), ("slope", "slope_std"))),
                f"{found['significance']:.1f}", "yes" if found["corrected"] else "no")


def calibrated(croon, out, options, scenes):
    """The results of azimuth_errors.json on these scenes, together."""
    return run_changed(croon, out, options, "azimuth_errors", {"scenes_per_trial": len(scenes)}, {"scenes": scenes})


def known_errors(found):
    """The parameter `known` for the sensors whose errors were found and corrected."""
    return {sensor: {part: one[part] for part in PARTS} for sensor, one in found.items() if one["corrected"]}


def print_loops(croon, out, options, scenes):
    """The second table."""
    head("scene left out", "pair", "loop with the others °, mm", "with this scene °, mm")
    for scene in scenes:
        others = [one for one in scenes if one != scene]
        results = calibrated(croon, out, options, others)
        step = {"step": "azimuth_calibration", "known": known_errors(azimuths(results)), "estimate": False}
        if not step["known"]:
            sys.exit(f"{results}: expected a sensor with an error, found none")
        variant = {"name": KNOWN, "insert": [{"after": "preprocessing", "step": step}]}
        alone = run_changed(croon, out, options, "left_out_scene", {"loops": True, "variants": [variant]},
                            {"scenes": [scene]}, f"{scene}_with_errors_of_others")
        rig = {sensor: pose for (_, sensor), pose in poses_of(results, CALIBRATED).items()}
        here = {sensor: pose for (_, sensor), pose in poses_of(alone, KNOWN).items()}
        pairs = [one["sensor"] for one in rows_of(alone, "trials.csv") if ">" in one["sensor"]]
        for pair in dict.fromkeys(pairs):
            source, target = pair.split(">")
            row(scene, pair, *(opening(poses, here.get(pair), target, source) for poses in (rig, here)))


def main(croon, out, *options):
    """Runs what is missing and prints the tables."""
    results = run_changed(croon, out, options, "left_out_scene", {"loops": True}, {})
    scenes = list(dict.fromkeys(one["scene"] for one in rows_of(results, "trials.csv")))
    if len(scenes) < 2:
        sys.exit(f"{results}: expected at least two scenes")
    print_errors(croon, out, options, [[scene] for scene in scenes] + [scenes])
    print()
    print_loops(croon, out, options, scenes)


if __name__ == "__main__":
    start(main, __doc__)
