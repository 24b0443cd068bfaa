#!/usr/bin/env python3
"""driving.json over the speed of the car and the offset of the sensors' clocks.

speed_and_offset.py CROON OUT [OPTIONS OF CROON RUN]: runs speed_and_offset.json beside this file at each speed and
offset, in a folder of OUT for each, and prints a Markdown table: the median error of the accepted poses in mm,
and how many of all poses are accepted and right, accepted and wrong (0.5 degrees, 0.1 m). What is in OUT already
is not run again.
"""
import csv
import json
import os
import statistics
import sys

from runs import run_unless_there

SPEEDS_MPS = (0, 5, 10, 15, 20, 30)
OFFSETS_MS = (0, 10, 25, 50)


def experiment_at(folder, speed_mps, offset_ms):
    """The experiment at one speed and offset, as JSON; it stands in `folder` in the place of the file."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "speed_and_offset.json")
    with open(path, encoding="utf-8") as file:
        experiment = json.load(file)
    dataset = {**experiment["dataset"], "speed_mps": speed_mps}
    dataset["noise"] = {**dataset["noise"], "clock_offset_s": offset_ms / 1000}
    return json.dumps({"extends": os.path.relpath(path, folder), "dataset": dataset,
                       "name": f"{experiment['name']}_{speed_mps}_{offset_ms}"})


def run(croon, out, options, speed_mps, offset_ms):
    """The folder of the results at one speed and offset."""
    folder = os.path.join(out, f"{speed_mps}_mps_{offset_ms}_ms")
    results = os.path.join(folder, "results")
    os.makedirs(folder, exist_ok=True)
    experiment = os.path.join(folder, "experiment.json")
    with open(experiment, "w", encoding="utf-8") as file:
        file.write(experiment_at(folder, speed_mps, offset_ms))
    run_unless_there(croon, experiment, results, "verdicts.csv", options)
    return results


def cell(results):
    """What the table has of one run."""
    with open(os.path.join(results, "trials.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    accepted = [row for row in rows if row["status"] in ("success", "inaccurate")]
    right = sum(row["status"] == "success" for row in accepted)
    errors_mm = [1000 * float(row["translation_error_m"]) for row in accepted]
    median = f"{statistics.median(errors_mm):.1f}" if errors_mm else "-"
    return f"{median}; {right}, {len(accepted) - right} of {len(rows)}"


def main(croon, out, *options):
    """Runs what is missing and prints the table."""
    print("| m/s | " + " | ".join(f"{offset} ms" for offset in OFFSETS_MS) + " |")
    print("|---" * (1 + len(OFFSETS_MS)) + "|")
    for speed in SPEEDS_MPS:
        cells = [cell(run(croon, out, options, speed, offset)) for offset in OFFSETS_MS]
        print(f"| {speed} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
