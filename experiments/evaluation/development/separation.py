#!/usr/bin/env python3
"""What the measures of the verdict are for right and for wrong poses.

separation.py RESULTS...: folders of runs with truth whose pipeline ends with `verdict`. Prints Markdown: the
counts of right and wrong against accepted and rejected, and quantiles of each measure. Right means within
the bounds of success of the run. A pose without a rival has no lead. Needs the Python package.
"""
import sys

if len(sys.argv) < 2:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

import croon  # noqa: E402

MEASURES = ("overlap_ratio", "violation_ratio", "lead", "strength", "halves_rotation_deg", "halves_translation_m")
KEY = ("variant", "scene", "sensor", "trial")


def quantiles(values, shares):
    """The values at shares of the sorted list, in words."""
    values = sorted(values)
    return ", ".join(f"{values[min(len(values) - 1, int(share * len(values)))]:.3f}" for share in shares) or "-"


def judged(folder):
    """Of each trial of the variant base with measures: whether its pose is right, its status, and its measures."""
    results = croon.load(folder)
    bounds = results.manifest["experiment"]["success"]
    measures = {}
    for row in results.diagnostics[np.isin(results.diagnostics["name"], MEASURES)]:
        measures.setdefault(row[list(KEY)].item(), {})[row["name"]] = row["value"]
    for trial in results.trials:
        values = measures.get(trial[list(KEY)].item())
        if trial["variant"] == "base" and values and not np.isnan(trial["rotation_error_deg"]):
            yield (trial["rotation_error_deg"] <= bounds["rotation_deg"]
                   and trial["translation_error_m"] <= bounds["translation_m"]), trial["status"], values


def main(*folders):
    """Prints the tables."""
    trials = [trial for folder in folders for trial in judged(folder)]
    print("| | accepted | rejected |\n|---|---|---|")
    for name, is_right in (("right", True), ("wrong", False)):
        statuses = [status == "rejected" for right, status, _ in trials if right == is_right]
        print(f"| {name} | {len(statuses) - sum(statuses)} | {sum(statuses)} |")
    print("\n| measure | right: 0, 1, 50, 99, 100 % | wrong: 0, 5, 50, 95, 100 % |\n|---|---|---|")
    for name in MEASURES:
        right, wrong = ([values[name] for is_right, _, values in trials if is_right == which and name in values]
                        for which in (True, False))
        print(f"| `{name}` | {quantiles(right, (0, 0.01, 0.5, 0.99, 1) if right else ())} | "
              f"{quantiles(wrong, (0, 0.05, 0.5, 0.95, 1) if wrong else ())} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
