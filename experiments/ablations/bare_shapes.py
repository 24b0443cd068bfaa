#!/usr/bin/env python3
"""What the program says where nothing but a bare shape is seen: a plane, a wall, a corridor, a corner, a room.

bare_shapes.py CROON OUT [OPTIONS OF CROON RUN]: casts the rays of four LiDARs (32 rings, 2 cm of range noise) into
each shape, SCENES times, writes the clouds to OUT/data, runs best.json on them and, from starts within 1 degree and
5 cm, its steps without the search and the verdict, and prints a Markdown table: how many poses were accepted and right
(within 0.5 degrees and 0.1 m), accepted and wrong, and rejected, and per degree of freedom how many were called
determined, weak and unobservable. Once more a plane, whose points have 7 mm of noise across it instead. What is in OUT
already is not made or run again. Needs the Python package.
"""
import json
import math
import os
import random
import sys
from collections import Counter

if len(sys.argv) < 3:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

import croon  # noqa: E402
from sweep import head, merged, row, run, study  # noqa: E402

SCENES = 10
NOISE_M = 0.02
NOISE_ACROSS_M = 0.007
RINGS_DEG = [-30 + 42 * ring / 31 for ring in range(32)]
AZIMUTHS_DEG = [azimuth / 2 for azimuth in range(720)]
NEAREST_M, FARTHEST_M = 0.5, 100.0
POSES = {"top": ([0, 0, 0], [0, 0, 0]), "front": ([0, 10, 3], [2.0, 0.1, -1.0]),
         "left": ([0, 20, 90], [0.2, 0.8, -0.4]), "right": ([2, 20, -90], [0.2, -0.8, -0.4])}
# Planes n x = d, in the frame of top, two metres above the ground; all of them are seen from inside.
GROUND = ((0, 0, -1), 2.0)
LEFT, RIGHT, AHEAD, BEHIND = ((0, 1, 0), 4.0), ((0, -1, 0), 5.0), ((1, 0, 0), 9.0), ((-1, 0, 0), 7.0)
ROUGH_PLANE = "plane, noise across"
SHAPES = {"plane": [GROUND], ROUGH_PLANE: [GROUND], "wall": [GROUND, LEFT], "corridor": [GROUND, LEFT, RIGHT],
          "corner": [GROUND, LEFT, AHEAD], "room": [GROUND, LEFT, RIGHT, AHEAD, BEHIND]}
DOFS = ("roll", "pitch", "yaw", "x", "y", "z")
WORDS = ("determined", "weak", "unobservable")


def rotation(rpy_deg):
    """R = Rz(yaw) Ry(pitch) Rx(roll), by rows."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(math.radians(a)), math.cos(math.radians(a))) for a in rpy_deg)
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]]


def scan(name, rpy_deg, origin, draws):
    """The points that a sensor at this pose sees of a shape, in its own frame."""
    turn = rotation(rpy_deg)
    planes = []  # Of each plane: its normal in the sensor's frame, and how far off it is.
    for normal, distance in SHAPES[name]:
        planes.append(([sum(normal[i] * turn[i][k] for i in range(3)) for k in range(3)],
                       distance - sum(n * o for n, o in zip(normal, origin))))
    points = []
    for ring in RINGS_DEG:
        up, flat = math.sin(math.radians(ring)), math.cos(math.radians(ring))
        for azimuth in AZIMUTHS_DEG:
            x, y = flat * math.cos(math.radians(azimuth)), flat * math.sin(math.radians(azimuth))
            slopes = ((n[0] * x + n[1] * y + n[2] * up, d) for n, d in planes)
            metres = min((d / slope for slope, d in slopes if slope > 1e-9), default=math.inf)
            if not NEAREST_M < metres < FARTHEST_M:
                continue
            if name == ROUGH_PLANE:
                across = draws.gauss(0, NOISE_ACROSS_M)
                points.append([metres * p + across * n for p, n in zip((x, y, up), planes[0][0])])
            else:
                metres += draws.gauss(0, NOISE_M)
                points.append([metres * x, metres * y, metres * up])
    return points


def write_recording(folder, name):
    """Writes the clouds of all scenes and sensors, and the truth last."""
    draws = random.Random(1)
    for scene in range(SCENES):
        for sensor, pose in POSES.items():
            os.makedirs(os.path.join(folder, sensor), exist_ok=True)
            croon.write_cloud(os.path.join(folder, sensor, f"{scene:06}.pcd"), np.float32(scan(name, *pose, draws)))
    with open(os.path.join(folder, "truth.json"), "w", encoding="utf-8") as file:
        json.dump({sensor: {"rotation_rpy_deg": rpy_deg, "translation_m": origin}
                   for sensor, (rpy_deg, origin) in POSES.items()}, file)


def main(program, out, *options):
    """Makes and runs what is missing and prints the table."""
    head("shape", "pipeline", "accepted and right", "accepted and wrong", "rejected", *DOFS)
    best, data = study("../best.json"), os.path.join(out, "data")
    steps = [step for step in merged(best)["pipeline"] if step["step"] not in ("global_alignment", "verdict")]
    near = {"starts": {"around": "truth", "rotation_deg": 1, "translation_m": 0.05, "trials": 1}, "pipeline": steps}
    for name in SHAPES:
        if not os.path.exists(os.path.join(data, name, "truth.json")):
            write_recording(os.path.join(data, name), name)
        dataset = {"type": "sensor_folders", "path": name, "reference": "top"}
        for what, keys in (("best.json", {}), ("near, no verdict", near)):
            results = croon.load(run(program, out, [best], {"dataset": dataset, **keys}, ["--data", data, *options],
                                     f"{name.replace(', ', '_').replace(' ', '_')}_{'near' if keys else 'best'}"))
            statuses = Counter(map(str, results.trials["status"]))
            row(name, what, statuses["success"], statuses["inaccurate"], statuses["rejected"] + statuses["failed"],
                *(", ".join(str(np.sum(results.covariances[dof] == word)) for word in WORDS) for dof in DOFS))


if __name__ == "__main__":
    main(*sys.argv[1:])
