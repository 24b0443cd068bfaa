#!/usr/bin/env python3
"""The largest distances of trials from the authors' published result, by scene and sensor.

published_distances.py TRIALS_CSV REAL_SCENES, as in docs/notebook/2026-11-22-the-paper-on-the-samples.md: trials.csv of real_consistency.json
and the folder of the authors' real scenes, each with its published_result.json.
"""
import csv
import json
import math
import os
import sys


def rotation_of(row):
    """The rotation matrix of a trial's quaternion."""
    x, y, z, w = (float(row["q" + axis]) for axis in "xyzw")
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def angle_deg(a, b):
    """The angle between two rotations, from the norm of their difference, 2 sqrt(2) sin(angle / 2)."""
    norm = math.sqrt(sum((a[i][j] - b[i][j]) ** 2 for i in range(3) for j in range(3)))
    return math.degrees(2 * math.asin(min(1.0, norm / math.sqrt(8))))


def main(trials, scenes):
    largest = {}
    with open(trials, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["variant"] != "base" or not row["tx_m"]:
                continue
            with open(os.path.join(scenes, row["scene"], "published_result.json"),
                      encoding="utf-8") as published:
                pose = json.load(published)["T_top_sensor"][row["sensor"]]
            rotation = angle_deg(rotation_of(row), [line[:3] for line in pose[:3]])
            translation = math.dist([float(row[f"t{axis}_m"]) for axis in "xyz"],
                                    [line[3] for line in pose[:3]])
            before = largest.get((row["scene"], row["sensor"]), (0.0, 0.0, 0))
            largest[row["scene"], row["sensor"]] = (max(before[0], rotation),
                                                    max(before[1], translation), before[2] + 1)
    for (scene, sensor), (rotation, translation, count) in sorted(largest.items()):
        print(f"{scene} {sensor}: {rotation:.3f} deg, {1000 * translation:.1f} mm, {count} trials")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
