#!/usr/bin/env python3
"""What the measures of the verdict are for right and for wrong poses.

separation.py RESULTS...: folders of runs with truth whose pipeline ends with `verdict`. Prints Markdown: the
counts of right and wrong against accepted and rejected, and quantiles of each measure. Right means within
the bounds of success of the run. A pose without a rival has no lead.
"""
import csv
import json
import os
import sys

MEASURES = ("overlap_ratio", "violation_ratio", "lead", "strength", "halves_rotation_deg",
            "halves_translation_m")


def read(folder, name):
    """The lines of a CSV file of results."""
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def key_of(row):
    """What names a trial."""
    return row["variant"], row["scene"], row["sensor"], row["trial"]


def bounds_of(folder):
    """The largest errors of a right pose."""
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        return json.load(file)["experiment"]["success"]


def is_right(row, bounds):
    """Whether the pose of a trial is within the bounds. The status does not say it of a rejected pose."""
    return (float(row["rotation_error_deg"]) <= bounds["rotation_deg"]
            and float(row["translation_error_m"]) <= bounds["translation_m"])


def quantiles(values, shares):
    """The values at shares of the sorted list, in words."""
    values = sorted(values)
    picked = [values[min(len(values) - 1, int(share * len(values)))] for share in shares]
    return ", ".join(f"{value:.3f}" for value in picked)


def main(*folders):
    """Prints the tables."""
    counts = {}
    measured = {True: {name: [] for name in MEASURES}, False: {name: [] for name in MEASURES}}
    for folder in folders:
        bounds = bounds_of(folder)
        values = {}
        for row in read(folder, "diagnostics.csv"):
            if row["name"] in MEASURES:
                values.setdefault(key_of(row), {})[row["name"]] = float(row["value"])
        for row in read(folder, "trials.csv"):
            measures = values.get(key_of(row))
            if row["variant"] != "base" or measures is None or not row["rotation_error_deg"]:
                continue
            right = is_right(row, bounds)
            state = "rejected" if row["status"] == "rejected" else "accepted"
            counts[right, state] = counts.get((right, state), 0) + 1
            for name, value in measures.items():
                measured[right][name].append(value)
    print("| | accepted | rejected |\n|---|---|---|")
    for right, word in ((True, "right"), (False, "wrong")):
        print(f"| {word} | {counts.get((right, 'accepted'), 0)} | {counts.get((right, 'rejected'), 0)} |")
    print("\n| measure | right: 0, 1, 50, 99, 100 % | wrong: 0, 5, 50, 95, 100 % |\n|---|---|---|")
    for name in MEASURES:
        right, wrong = measured[True][name], measured[False][name]
        print(f"| `{name}` | {quantiles(right, (0, 0.01, 0.5, 0.99, 1)) if right else '-'} | "
              f"{quantiles(wrong, (0, 0.05, 0.5, 0.95, 1)) if wrong else '-'} |")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
