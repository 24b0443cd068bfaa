#!/usr/bin/env python3
"""Do fitness and inlier RMSE tell a pose of a real rig from one that is off, and does `croon check`?

moved_poses.py CROON OUT [--no-check]: OUT is the folder of other_rigs.py. Each published pose of a sensor is moved by 0.3, 1 and
3 m along the direction in which its calibration is the least certain, and turned by 1, 5 and 180 degrees about the z axis
of the reference. Prints a Markdown table with the fit of the clouds of the first scene at each pose, thinned to 10 cm, and
what `croon check` says of it from all scenes (it is not asked again if OUT has its answer, nor with --no-check). Needs
NumPy.
"""
import json
import math
import os
import pathlib
import re
import subprocess
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

from fit_measures import Neighbours, fit, read_pcd, thinned  # noqa: E402
from other_rigs import RIGS, published_poses  # noqa: E402

MOVES = {"published": (0.0, 0.0), "0.3 m": (0.3, 0.0), "180°": (0.0, 180.0), "1 m": (1.0, 0.0), "3 m": (3.0, 0.0),
         "1°": (0.0, 1.0), "5°": (0.0, 5.0)}  # Metres along the weakest direction, degrees of yaw.


def weakest_direction(sensor):
    """The unit vector along which a calibrated position is the least certain, without the error budget."""
    covariance = np.array(sensor["covariance"])
    if sensor.get("error_budget"):
        covariance = covariance - np.array(sensor["error_budget"]["covariance"])
    return np.linalg.eigh(covariance[3:, 3:])[1][:, -1]


def moved_pose(pose, direction, metres, degrees):
    """A 3×4 pose, shifted in the reference frame and turned about the sensor's origin."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turned = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ pose[:, :3]
    return np.hstack([turned, pose[:, 3:] + metres * direction[:, None]])


def as_json(pose):
    """In the format of nominal.json."""
    R = pose[:, :3]
    roll, pitch, yaw = math.atan2(R[2, 1], R[2, 2]), math.asin(np.clip(-R[2, 0], -1, 1)), math.atan2(R[1, 0], R[0, 0])
    return {"rotation_rpy_deg": list(map(math.degrees, (roll, pitch, yaw))), "translation_m": pose[:, 3].tolist()}


def check(program, folder, name, poses, reference, may_run):
    """By sensor, what croon says of the poses."""
    answer = folder / f"check_{name.replace(' ', '_').replace('°', 'deg')}.txt"
    if not answer.exists() and may_run:
        given = folder / "given.json"
        given.write_text(json.dumps({sensor: as_json(pose) for sensor, pose in poses.items()}))
        command = [program, "check", str(given), str(folder / "clouds"), "--reference", reference, "--quiet", "--jobs", "1"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if not re.search("RIGHT|WRONG|UNDECIDABLE", done.stdout):
            sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        answer.write_text(done.stdout)
    found = re.findall(r"^(RIGHT|WRONG|UNDECIDABLE)\s+(\S+):", answer.read_text(), re.M) if answer.exists() else []
    return {sensor: word.lower() for word, sensor in found}


def main(program, out, *options):
    """Prints the table."""
    data = pathlib.Path(os.environ.get("CROON_DATA", "data"))
    print("| rig | sensor | pose | fitness, 0.3 m | fitness, 0.1 m | inlier RMSE m | inliers | `croon check` |")
    print("|---|---|---|---|---|---|---|---|")
    for path, reference, file, _, is_start in RIGS:
        rig = path.replace("rigs/", "")
        folder = pathlib.Path(out) / rig.replace("/", "_")
        result = folder / "result" / "extrinsics.json"
        if not file or is_start or not result.exists():
            continue
        sensors = {one["sensor"]: one for one in json.loads(result.read_text())["sensors"] if one["covariance"]}
        published = {name: np.array(pose) for name, pose in published_poses(data / path / file).items() if name in sensors}
        clouds = {name: sorted((folder / "clouds" / name).glob("*.pcd"))[0] for name in [reference, *published]}
        near = Neighbours(thinned(read_pcd(clouds[reference])), 0.3)
        points = {name: thinned(read_pcd(clouds[name]), min_range_m=1.0) for name in published}
        for move, by in MOVES.items():
            poses = {name: moved_pose(pose, weakest_direction(sensors[name]), *by) for name, pose in published.items()}
            said = check(program, folder, move, poses, reference, "--no-check" not in options)
            for name, pose in poses.items():
                distances = near.distances_m(points[name] @ pose[:, :3].T + pose[:, 3])
                share, rmse, inliers = fit(distances, 0.3)
                print(f"| {rig} | {name} | {move} | {share:.3f} | {fit(distances, 0.1)[0]:.3f} | {rmse:.3f} | {inliers} "
                      f"| {said.get(name, '')} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
