#!/usr/bin/env python3
"""Without truth: does the rig from some scenes of a recording close loops in a scene that was left out?

left_out_scene.py CROON OUT [OPTIONS OF CROON RUN]: runs left_out_scene.json beside this file, in folders of OUT, and
prints a Markdown table. In each scene every two sensors are calibrated to each other. A row is such a pair in a scene:
by how much the loop T_reference_target T_target_source = T_reference_source is open with the pose of the pair from this
scene, and the two others from a rig of all other scenes together; the same with the two others from this scene; and
what the covariance says of the pair, the root of the sum of its variances. What is in OUT already is not run again.
"""
import math
import sys

from runs import head, row, rows_of, run_changed, start

NAME = "left_out_scene"
FINISHED = "finished"


def rotated(q, v):
    """The vector v, turned by the unit quaternion q = (x, y, z, w)."""
    u, w = q[:3], q[3]
    t = [2 * c for c in cross(u, v)]
    return [v[i] + w * t[i] + c for i, c in enumerate(cross(u, t))]


def cross(a, b):
    """a x b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def product(p, q):
    """The quaternion of first q, then p."""
    vector = [p[3] * b + q[3] * a + c for a, b, c in zip(p[:3], q[:3], cross(p[:3], q[:3]))]
    return [*vector, p[3] * q[3] - sum(a * b for a, b in zip(p[:3], q[:3]))]


def composed(first, second):
    """The pose `first` times `second`; a pose is a translation and a quaternion."""
    return ([a + b for a, b in zip(first[0], rotated(first[1], second[0]))], product(first[1], second[1]))


def distance(a, b):
    """Between two poses, in degrees and mm."""
    turn = product(a[1], [-b[1][0], -b[1][1], -b[1][2], b[1][3]])
    return (math.degrees(2 * math.atan2(math.hypot(*turn[:3]), abs(turn[3]))),
            1000 * math.dist(a[0], b[0]))


def poses_of(results, variant="base"):
    """By scene and sensor, those of a variant that finished and were not rejected."""
    return {(one["scene"], one["sensor"]): ([float(one[f"t{axis}_m"]) for axis in "xyz"],
                                           [float(one[f"q{axis}"]) for axis in "xyzw"])
            for one in rows_of(results, "trials.csv") if one["status"] == FINISHED and one["variant"] == variant}


def uncertainties(results):
    """By scene and sensor: the standard deviation of the rotation in degrees, and of the translation in mm."""
    return {(one["scene"], one["sensor"]):
            (math.degrees(math.sqrt(sum(float(one[f"c{i}{i}"]) for i in range(3)))),
             1000 * math.sqrt(sum(float(one[f"c{i}{i}"]) for i in range(3, 6))))
            for one in rows_of(results, "covariance.csv")}


def opening(rig, pair, target, source):
    """By how much the loop is open, as a cell; `rig` has poses by sensor."""
    if target not in rig or source not in rig or pair is None:
        return "rejected"
    rotation, translation = distance(composed(rig[target], pair), rig[source])
    return f"{rotation:.3f}, {translation:.1f}"


def main(croon, out, *options):
    """Runs what is missing and prints the table."""
    results = run_changed(croon, out, options, NAME, {"loops": True}, {})
    alone, says = poses_of(results), uncertainties(results)
    trials = rows_of(results, "trials.csv")
    scenes = list(dict.fromkeys(one["scene"] for one in trials))
    pairs = list(dict.fromkeys(one["sensor"] for one in trials if ">" in one["sensor"]))
    if len(scenes) < 2 or not pairs:
        sys.exit(f"{results}: expected at least two scenes and two sensors beside the reference")
    head("scene left out", "pair", "loop with the others °, mm", "with this scene °, mm", "pair, says °, mm")
    for scene in scenes:
        others = [one for one in scenes if one != scene]
        rig = poses_of(run_changed(croon, out, options, NAME, {"scenes_per_trial": len(others)}, {"scenes": others}))
        rig = {sensor: pose for (_, sensor), pose in rig.items()}
        here = {sensor: pose for (name, sensor), pose in alone.items() if name == scene}
        for pair in pairs:
            source, target = pair.split(">")
            said = says.get((scene, pair))
            row(scene, pair, opening(rig, here.get(pair), target, source), opening(here, here.get(pair), target, source),
                "{:.3f}, {:.1f}".format(*said) if said else "-")


if __name__ == "__main__":
    start(main, __doc__)
