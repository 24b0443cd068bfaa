#!/usr/bin/env python3
"""The verdicts on simulated driving cars whose times are broken.

broken_times.py SCENES [SEED]: the number of scenes. Needs the Python package on PYTHONPATH. Prints Markdown: a row for
each way in which times break, with the number of sensors that are accepted and right (within 0.5 deg and 0.1 m of
the truth), accepted and wrong, and rejected. Nothing was chosen on the default seed, 5401.
"""
import sys

if len(sys.argv) not in (2, 3):
    sys.exit(__doc__)

import croon  # noqa: E402
import numpy as np  # noqa: E402

MAX_ERROR_DEG, MAX_ERROR_M = 0.5, 0.1
LATE_S = 0.1


def with_times(cloud, change):
    """The cloud with its times changed by `change`."""
    changed = cloud.copy()
    changed["time"] = change(cloud["time"])
    return changed


def reversed_times(times):
    return times.min() + times.max() - times


def permuted_times(times):
    return np.random.default_rng(1).permutation(times)


def everywhere(change):
    return lambda clouds: {name: with_times(cloud, change) for name, cloud in clouds.items()}


def of_one(change, sensor="left"):
    return lambda clouds: {**clouds, sensor: with_times(clouds[sensor], change)}


CONDITIONS = {
    "as recorded": dict,
    "removed": lambda clouds: {name: croon.xyz(cloud) for name, cloud in clouds.items()},
    "all zero": everywhere(np.zeros_like),
    "all reversed": everywhere(reversed_times),
    "one reversed": of_one(reversed_times),
    "all permuted": everywhere(permuted_times),
    "one permuted": of_one(permuted_times),
    "one clock 100 ms late": of_one(lambda times: times + LATE_S),
}


def is_right(pose, truth):
    turn = pose[:3, :3] @ truth[:3, :3].T
    angle_deg = np.degrees(np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1)))
    return angle_deg <= MAX_ERROR_DEG and np.linalg.norm(pose[:3, 3] - truth[:3, 3]) <= MAX_ERROR_M


def main(count, seed):
    scenes = croon.simulate(count, rig="croon_five", mix="paper", noise="real", seed=seed)
    print("| times | accepted, right | accepted, wrong | rejected |\n|---|---|---|---|")
    for name, changed in CONDITIONS.items():
        counts = [0, 0, 0]
        for scene in scenes:
            rig = croon.calibrate(changed(scene.clouds), reference="top")
            for sensor, result in rig.sensors.items():
                if not result.accepted:
                    counts[2] += 1
                else:
                    counts[0 if is_right(result.pose, scene.truth[sensor]) else 1] += 1
        print(f"| {name} | {counts[0]} | {counts[1]} | {counts[2]} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) == 3 else 5401)
