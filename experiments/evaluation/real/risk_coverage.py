#!/usr/bin/env python3
"""Of the poses that a measure accepts, how many are wrong?

risk_coverage.py CROON OUT [OPTIONS OF CROON RUN]: calibrates scenes with best.json in folders of OUT (standing; driving,
without the times of the points; rows of equal elements), and writes them as clouds. For each pose, accepted or rejected,
it computes the measures that other programs offer instead of a verdict, between the sensor's cloud and the reference's,
both thinned to 10 cm: fitness and inlier RMSE as Open3D's evaluate_registration defines them, and the number of inliers.
croon's own measure is the least margin of a pose to the bounds of best.json, as a share of the bound.

A measure accepts the best poses first. The coverage is the share that it accepts, the risk is the share of wrong poses
among them. Prints a Markdown table, writes OUT/risk_coverage.csv, a row per pose, and draws OUT/risk_coverage.svg. Results
that are in OUT already are not computed again. Needs NumPy.
"""
import csv
import math
import pathlib
import shutil
import subprocess
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "ablations"))
from fit_measures import Neighbours, fit, moved, read_pcd, thinned  # noqa: E402
from sweep import head, row, run, study  # noqa: E402

SETS = {  # The dataset and other changes of best.json. No seed is used elsewhere.
    "standing": ({"mix": "paper", "noise": "real_still", "seed": 9311}, {}),
    "driving, without times": ({"mix": "paper", "noise": "real", "seed": 9312},
                               {"pipeline.time_check.ignore_times": True}),
    "periodic": ({"mix": {"periodic": 1}, "noise": "real_still", "seed": 9313}, {}),
}
SCENES = 20
BOUNDS = {  # By step and measure: its bound in best.json, and whether that is a minimum.
    ("verdict", "overlap_ratio"): (0.15, True), ("verdict", "violation_ratio"): (0.05, False),
    ("verdict", "lead"): (6.0, True), ("verdict", "strength"): (0.01, True),
    ("verdict", "halves_rotation_deg"): (0.5, False), ("verdict", "halves_translation_m"): (0.06, False),
    ("motion_check", "travel_m"): (0.15, False), ("motion_check", "turn_deg"): (1.0, False),
    ("motion_check", "shift_m"): (0.05, False),
}
MIN_SPEED_LEAD, CERTAIN_SHIFT_M, PERIOD_S = 1.5, 0.0025, 0.1  # Of joint_registration and motion_check in best.json.
MEASURES = {  # By column of the CSV file: its name, and whether more is better.
    "margin": ("croon's least margin", True),
    "fitness_30cm": ("fitness, 0.3 m", True),
    "fitness_10cm": ("fitness, 0.1 m", True),
    "rmse_m": ("inlier RMSE, 0.3 m", False),
    "inliers": ("number of inliers, 0.3 m", True),
}
COLOURS = ("#0072b2", "#d55e00", "#e69f00", "#cc79a7", "#808080")


def margins_of(values):
    """The margins of one pose, from its values by step and measure."""
    for key, (bound, is_minimum) in BOUNDS.items():
        if key in values:
            value = values[key]
            if key[1] == "travel_m":  # The bound is for the travel less three standard deviations.
                value -= 3 * PERIOD_S * values["motion_check", "speed_std_mps"]
            yield (value - bound) / bound * (1 if is_minimum else -1)
    for step, shift in (("joint_registration", "speed_shift_std_m"), ("motion_check", "shift_std_m")):
        if (step, "speed_lead") in values:
            is_certain = values.get((step, shift), math.inf) <= CERTAIN_SHIFT_M
            yield (values[step, "speed_lead"] - (0.0 if is_certain else MIN_SPEED_LEAD)) / MIN_SPEED_LEAD


def margins(folder):
    """By scene and sensor, the least margin of a pose to the bounds on it; those on pairs of sensors are left out."""
    values = {}
    with open(folder / "diagnostics.csv", encoding="utf-8") as file:
        for one in csv.DictReader(file):
            values.setdefault((one["scene"], one["sensor"]), {})[one["step"], one["name"]] = float(one["value"])
    return {key: min(margins_of(some), default=-math.inf) for key, some in values.items()}


def fits(clouds, trials):
    """For each trial its measures of fit; `clouds` has a folder per scene."""
    scene, reference = None, None
    for one in trials:
        if one["scene"] != scene:
            scene = one["scene"]
            reference = Neighbours(thinned(read_pcd(clouds / scene / "top.pcd")), 0.3)
        points = thinned(read_pcd(clouds / scene / f"{one['sensor']}.pcd"), min_range_m=1.0)
        pose = [float(one[name]) for name in ("qx", "qy", "qz", "qw", "tx_m", "ty_m", "tz_m")]
        distances = reference.distances_m(moved(points, pose[:4], pose[4:]))
        near, rmse, inliers = fit(distances, 0.3)
        yield {"fitness_30cm": near, "fitness_10cm": fit(distances, 0.1)[0], "rmse_m": rmse, "inliers": inliers}


def poses_of(program, out, name, options):
    """Calibrates the scenes of a set and returns a row per pose."""
    dataset, changes = SETS[name]
    dataset = {"type": "simulated", "rig": "croon_five", "scenes": SCENES, **dataset}
    short = name.split(",")[0].replace(" ", "_")
    folder = pathlib.Path(run(program, out, [study("../best.json")], {"dataset": dataset, **changes}, options, short))
    with open(folder / "trials.csv", encoding="utf-8") as file:
        trials = [one for one in csv.DictReader(file) if one["tx_m"]]
    clouds = pathlib.Path(out) / f"{short}_clouds"
    if not (clouds / "experiment.json").exists():
        shutil.rmtree(clouds, ignore_errors=True)
        subprocess.run([program, "simulate", f"{out}/{short}.json", "--out", str(clouds), "--quiet"], check=True)
    least = margins(folder)
    for one, measured in zip(trials, fits(next(clouds.glob("**/000000")).parent, trials)):
        error_deg, error_m = float(one["rotation_error_deg"]), float(one["translation_error_m"])
        yield {"set": name, "scene": one["scene"], "sensor": one["sensor"],
               "accepted": int(one["status"] in ("success", "inaccurate")),
               "wrong": int(error_deg > 0.5 or error_m > 0.1), "rotation_error_deg": error_deg,
               "translation_error_m": error_m, "margin": least[one["scene"], one["sensor"]], **measured}


def curve(poses, measure):
    """(poses accepted, of these wrong) for each bound of a measure, from the strictest one; equal values go together."""
    sign = -1 if MEASURES[measure][1] else 1
    ordered, points, wrong = sorted(poses, key=lambda one: sign * one[measure]), [], 0
    for i, one in enumerate(ordered):
        wrong += one["wrong"]
        if i + 1 == len(ordered) or ordered[i + 1][measure] != one[measure]:
            points.append((i + 1, wrong))
    return points


def coverage_at(poses, measure, risk):
    """The largest share of the poses that a bound accepts with at most this risk, %."""
    return 100 * max((n for n, wrong in curve(poses, measure) if wrong <= risk * n), default=0) / len(poses)


def with_bounds_per_sensor(poses, measure):
    """The largest share without a wrong pose if each sensor has a bound of its own, %."""
    sensors = [[one for one in poses if one["sensor"] == name] for name in sorted({one["sensor"] for one in poses})]
    return sum(coverage_at(some, measure, 0.0) * len(some) for some in sensors) / len(poses)


def rows_of(name, poses):
    """Prints the rows of a set."""
    accepted = sum(one["accepted"] for one in poses)
    wrong = sum(one["accepted"] * one["wrong"] for one in poses)
    everything = f"{len(poses)}, {sum(one['wrong'] for one in poses)} wrong"
    row(name, everything, "croon's verdict", f"{100 * accepted / len(poses):.0f} %, {wrong} wrong", "", "", "")
    for measure, (title, _) in MEASURES.items():
        there = next((pair for pair in curve(poses, measure) if pair[0] >= max(accepted, 1)), (1, 0))
        row(name, "", title, f"{100 * there[0] / len(poses):.0f} %, {there[1]} wrong",
            *(f"{coverage_at(poses, measure, risk):.0f} %" for risk in (0.0, 0.01)),
            f"{with_bounds_per_sensor(poses, measure):.0f} %")


def panel(left, name, poses):
    """The SVG elements of one set: risk over coverage in a square of 230."""
    def at(accepted, wrong):
        return f"{left + 230 * accepted / len(poses):.1f},{270 - 230 * wrong / accepted:.1f}"
    yield f'<text class="title" x="{left}" y="28">{name} ({len(poses)} poses)</text>'
    for i in range(5):
        y = 270 - 57.5 * i
        yield f'<path class="grid" d="M{left},{y}h230"/>'
        yield f'<text class="small" text-anchor="end" x="{left - 5}" y="{y + 4}">{25 * i}</text>'
        yield f'<text class="small" text-anchor="middle" x="{left + 57.5 * i}" y="286">{25 * i}</text>'
    yield f'<text class="small" text-anchor="middle" x="{left + 115}" y="303">accepted, %</text>'
    for colour, measure in reversed(list(zip(COLOURS, MEASURES))):
        line = " ".join(at(*pair) for pair in curve(poses, measure))
        yield f'<polyline fill="none" stroke="{colour}" stroke-width="1.8" points="{line}"/>'
    accepted = sum(one["accepted"] for one in poses)
    if accepted:
        x, y = at(accepted, sum(one["accepted"] * one["wrong"] for one in poses)).split(",")
        yield f'<circle cx="{x}" cy="{y}" r="5" fill="#ffffff" stroke="#000000" stroke-width="2"/>'


def draw(sets, path):
    """Draws the risk over the coverage, a panel per set."""
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="890" height="345" viewBox="0 0 890 345">',
             "<desc>Share of wrong poses among those accepted over the share accepted, %.</desc>",
             "<style>.title{font:bold 13px sans-serif;fill:#222}.small{font:11px sans-serif;fill:#555}"
             ".name{font:12px sans-serif;fill:#222}.grid{stroke:#e2e2e2}</style>",
             '<rect width="890" height="345" fill="#ffffff"/>',
             '<text class="small" transform="rotate(-90)" text-anchor="middle" x="-155" y="14">wrong among them, %</text>']
    for i, (name, poses) in enumerate(sets.items()):
        lines += panel(50 + 285 * i, name, poses)
    x = 50
    for colour, (title, _) in zip(COLOURS, MEASURES.values()):
        lines.append(f'<path d="M{x},329h18" stroke="{colour}" stroke-width="3"/>'
                     f'<text class="name" x="{x + 23}" y="333">{title}</text>')
        x += 36 + 5.9 * len(title)
    lines.append(f'<circle cx="{x + 6}" cy="329" r="5" fill="#ffffff" stroke="#000000" stroke-width="2"/>'
                 f'<text class="name" x="{x + 16}" y="333">croon\'s verdict</text></svg>')
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main(program, out, *options):
    """Calibrates what is missing, prints the table, and draws the curves."""
    sets = {name: list(poses_of(program, out, name, options)) for name in SETS}
    everything = [one for poses in sets.values() for one in poses]
    with open(pathlib.Path(out) / "risk_coverage.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, everything[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(everything)
    head("scenes", "poses", "accepted by", "as many as croon accepts", "at risk 0", "at risk 1 %", "at risk 0, a bound per sensor")
    for name, poses in {**sets, "all": everything}.items():
        rows_of(name, poses)
    draw(sets, pathlib.Path(out) / "risk_coverage.svg")


if __name__ == "__main__":
    main(*sys.argv[1:])
