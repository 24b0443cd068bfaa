#!/usr/bin/env python3
"""How does `croon calibrate` do on rigs that others recorded?

other_rigs.py CROON OUT [RIG...]: calibrates the rigs below the folder CROON_DATA (else "data"), all or those named, in
folders of OUT, each scene alone and all scenes together, and prints two Markdown tables. A folder that has a result
is not computed again. Rigs whose folder is missing are left out.

The first table has a row for each sensor: the verdict; the difference from the published pose, and the same in
standard deviations (root mean square of the six degrees of freedom), with those that are stated and with their
statistical part, without the error budget; the stated ones; and the fit check. The second one has the differences
between scenes, in standard deviations of a difference.
"""
import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import sys

RIGS = [  # Folder, reference, published poses, what they are worth, whether to start there, layout.
    ("rigs/av2", "up", "truth.json", "0.1°, 1 cm", False),
    ("rigs/edgar", "sensor_1", "nominal.json", "y off by 6 cm", False),
    ("rigs/edgar_twin", "sensor_1", "truth.json", "exact", False),
    ("rigs/mid100", "L1", "nominal.json", "roll of L2 off by 0.5°", True),
    ("rigs/office", "pandar40p", None, "", False),
    ("rigs/p64_qt", "p64", None, "", False),
    ("opencalib/carla", "top", "truth.json", "exact", False),
    ("opencalib/real", "top", "nominal.json", "0.3°, 3 cm", False),
]
DOFS = ("roll", "pitch", "yaw", "x", "y", "z")


def clouds_of(folder):
    """By sensor and scene, the files of a rig: folders of sensors, or of scenes if their names are numbers."""
    clouds = {}
    for path in sorted(folder.glob("*/*.pcd")):
        outer, inner = path.parent.name, path.stem
        sensor, scene = (inner, outer) if outer.isdigit() else (outer, inner)
        clouds.setdefault(sensor, {})[scene] = path
    return clouds


def calibrate(program, out, clouds, scenes, reference, nominal):
    """Calibrates some scenes, from links in a folder per sensor, unless that was done before. Returns the result."""
    if not (out / "result" / "extrinsics.json").exists():
        for sensor, files in clouds.items():
            for scene in scenes:
                if scene not in files:
                    continue
                link = out / "clouds" / sensor / f"{scene}.pcd"
                link.parent.mkdir(parents=True, exist_ok=True)
                if not link.exists():
                    link.symlink_to(files[scene].resolve())
        command = [program, "calibrate", str(out / "clouds"), "--reference", reference, "--out", str(out / "result")]
        command += ["--quiet"] + (["--nominal", str(nominal)] if nominal else [])
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode not in (0, 3):
            sys.exit(f"{' '.join(command)}\n{done.stderr}")
    result = json.loads((out / "result" / "extrinsics.json").read_text())
    report = out / "result" / "report.html"
    return {one["sensor"]: one for one in result["sensors"]}, report.read_text() if report.exists() else ""


def rotation(rpy_deg):
    """R = Rz(yaw) Ry(pitch) Rx(roll)."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(math.radians(a)), math.cos(math.radians(a))) for a in rpy_deg)
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]]


def published_poses(path):
    """By sensor, the rows of T_reference_sensor."""
    return {name: [row + [t] for row, t in zip(rotation(pose["rotation_rpy_deg"]), pose["translation_m"])]
            for name, pose in json.loads(path.read_text()).items()}


def difference(a, b):
    """Roll, pitch and yaw of a b^-1 in radians, and the difference of the translations in metres."""
    turn = [[sum(a[i][k] * b[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
    return [math.atan2(turn[2][1], turn[2][2]), -math.asin(max(-1.0, min(1.0, turn[2][0]))),
            math.atan2(turn[1][0], turn[0][0])] + [a[i][3] - b[i][3] for i in range(3)]


def variances(one, statistical):
    """Those of the six degrees of freedom, optionally without the error budget."""
    budget = one.get("error_budget") if statistical else None
    return [one["covariance"][i][i] - (budget["covariance"][i][i] if budget else 0.0) for i in range(6)]


def rms(values):
    """The root of the mean square."""
    return math.sqrt(sum(value * value for value in values) / len(values))


def in_deviations(change, variance):
    """Each degree of freedom in standard deviations."""
    return [d / math.sqrt(max(v, 1e-18)) for d, v in zip(change, variance)]


def size(change):
    """"0.05°, 1.2 cm"."""
    angle, distance = (math.sqrt(sum(d * d for d in part)) for part in (change[:3], change[3:]))
    return f"{math.degrees(angle):.2f}°, {100 * distance:.1f} cm"


def stds(variance):
    """Standard deviations of an angle and of a position, each a root mean square of three."""
    return f"{math.degrees(rms([math.sqrt(v) for v in variance[:3]])):.3f}°, " \
           f"{1000 * rms([math.sqrt(v) for v in variance[3:]]):.0f} mm"


def fit_check(report, sensor):
    """The millimetres in the sensor's card of a report; "" without any."""
    card = re.search(rf"<h3>{re.escape(sensor)}  \(in the frame.*?</article>", report, re.S)
    found = card and re.search(r"moves (?:the surfaces|them) by ([\d.]+) mm", card.group(0))
    return f"{found.group(1)} mm" if found else ""


def sensor_rows(rig, scenes, results, published, worth):
    """The rows of a rig in the first table."""
    sensors, report = results
    for name, one in sensors.items():
        verdict = one["verdict"]
        if one["T_reference_sensor"] is None or one["covariance"] is None:
            yield [rig, str(scenes), name, verdict, "", worth, "", "", "", "", ""]
            continue
        stated, statistical = variances(one, False), variances(one, True)
        cells = ["", "", "", ""]
        if name in published:
            change = difference(one["T_reference_sensor"]["matrix"], published[name])
            ratios = in_deviations(change, stated)
            most = max(range(6), key=lambda i: abs(ratios[i]))
            cells = [size(change), worth, f"{rms(ratios):.1f} ({DOFS[most]} {abs(ratios[most]):.1f})",
                     f"{rms(in_deviations(change, statistical)):.1f}"]
        yield [rig, str(scenes), name, verdict, *cells, stds(stated), stds(statistical), fit_check(report, name)]


def scene_rows(rig, alone):
    """The rows of a rig in the second table; `alone` has the results by scene."""
    for a, b in itertools.combinations(alone, 2):
        for name in alone[a]:
            pair = [alone[scene].get(name) for scene in (a, b)]
            if any(one is None or one["T_reference_sensor"] is None or one["covariance"] is None for one in pair):
                continue
            change = difference(*(one["T_reference_sensor"]["matrix"] for one in pair))
            ratios = [in_deviations(change, [sum(both) for both in zip(*(variances(one, part) for one in pair))])
                      for part in (False, True)]
            yield [rig, f"{a}, {b}", name, ", ".join(one["verdict"] for one in pair), size(change),
                   f"{abs(math.degrees(change[2])):.3f}°"] + \
                  [f"{rms(part):.1f} (yaw {abs(part[2]):.1f})" for part in ratios]


def print_table(head, rows):
    """Prints a Markdown table."""
    for line in [head, ["---"] * len(head), *rows]:
        print("| " + " | ".join(line) + " |", flush=True)
    print()


def main(program, out, *names):
    """Calibrates what is missing and prints the tables."""
    data = pathlib.Path(os.environ.get("CROON_DATA", "data"))
    sensors, scenes = [], []
    for path, reference, file, worth, is_start in RIGS:
        folder, rig = data / path, path.replace("rigs/", "")
        if not folder.is_dir() or (names and rig not in names):
            continue
        clouds = clouds_of(folder)
        found = sorted(set().union(*clouds.values()))
        nominal = folder / file if is_start else None
        base = pathlib.Path(out) / rig.replace("/", "_")
        together = calibrate(program, base, clouds, found, reference, nominal)
        published = published_poses(folder / file) if file else {}
        sensors += sensor_rows(rig, len(found), together, published, worth)
        if len(found) > 1:
            scenes += scene_rows(rig, {scene: calibrate(program, base / scene, clouds, [scene], reference, nominal)[0]
                                       for scene in found})
    print_table(["rig", "scenes", "sensor", "verdict", "from published", "which is good to", "in stated std",
                 "in statistical std", "stated std", "statistical std", "fit check"], sensors)
    print_table(["rig", "scenes", "sensor", "verdicts", "apart", "yaw", "in stated std", "in statistical std"], scenes)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
