#!/usr/bin/env python3
"""Without truth: does the rig from some scenes of a recording close loops in a scene that was left out?

left_out_scene.py CROON OUT [OPTIONS OF CROON RUN]: runs best.json on the authors' real scenes, in folders of OUT, and prints
a Markdown table. In each scene every two sensors are calibrated to each other. A row is such a pair in a scene: by how
much the loop T_reference_target T_target_source = T_reference_source is open with the pose of the pair from this scene,
and the two others from a rig of all other scenes together; the same with the two others from this scene; and the
uncertainty of the pair according to its covariance, the root of the sum of its variances. Results that are in OUT
already are not computed again. Needs the Python package.
"""
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

import croon  # noqa: E402
from sweep import head, row, run, study  # noqa: E402

BEST = [study("../best.json"), study("../workloads/real_any.json")]


def poses_of(results, variant="base"):
    """By scene and sensor, the poses of a variant that finished and were not rejected."""
    return {(str(trial["scene"]), str(trial["sensor"])): pose for trial, pose in zip(results.trials, results.poses)
            if trial["status"] == "finished" and trial["variant"] == variant}


def by_sensor(poses, scene=None):
    """The poses of a scene, or of the only one."""
    return {sensor: pose for (name, sensor), pose in poses.items() if scene in (None, name)}


def opening(rig, pair, target, source):
    """By how much the loop is open, as a cell; `rig` has poses by sensor."""
    if target not in rig or source not in rig or pair is None:
        return "rejected"
    T, other = rig[target] @ pair, rig[source]
    angle = 2 * np.arcsin(min(1.0, np.linalg.norm(T[:3, :3] - other[:3, :3]) / np.sqrt(8)))
    return f"{np.degrees(angle):.3f}, {1000 * np.linalg.norm(T[:3, 3] - other[:3, 3]):.1f}"


def uncertainties(results):
    """By scene and sensor, the standard deviations of rotation in degrees and of translation in mm, as a cell."""
    def root(one, first):
        return np.sqrt(sum(one[f"c{i}{i}"] for i in range(first, first + 3)))
    return {(str(one["scene"]), str(one["sensor"])): f"{np.degrees(root(one, 0)):.3f}, {1000 * root(one, 3):.1f}"
            for one in results.covariances}


def scenes_and_pairs(program, out, options):
    """The results of each scene alone with its pairs of sensors, the names of the scenes, and of the pairs."""
    alone = croon.load(run(program, out, BEST, {"loops": True}, options, "alone"))
    scenes = list(dict.fromkeys(map(str, alone.trials["scene"])))
    pairs = [sensor for sensor in dict.fromkeys(map(str, alone.trials["sensor"])) if ">" in sensor]
    if len(scenes) < 2 or not pairs:
        sys.exit(f"{alone.folder}: expected at least two scenes and two sensors beside the reference")
    return alone, scenes, pairs


def main(program, out, *options):
    """Runs what is missing and prints the table."""
    alone, scenes, pairs = scenes_and_pairs(program, out, options)
    stated = uncertainties(alone)
    head("scene left out", "pair", "loop with the others °, mm", "with this scene °, mm", "pair, says °, mm")
    for scene in scenes:
        others = [one for one in scenes if one != scene]
        changes = {"scenes_per_trial": len(others), "dataset.scenes": others}
        rig = by_sensor(poses_of(croon.load(run(program, out, BEST, changes, options, f"without_{scene}"))))
        here = by_sensor(poses_of(alone), scene)
        for pair in pairs:
            source, target = pair.split(">")
            row(scene, pair, *(opening(poses, here.get(pair), target, source) for poses in (rig, here)),
                stated.get((scene, pair), "-"))


if __name__ == "__main__":
    main(*sys.argv[1:])
