#!/usr/bin/env python3
"""driving.json over the speed of the car and the offset of the sensors' clocks.

speed_and_offset.py CROON OUT [OPTIONS OF CROON RUN]: runs speed_and_offset.json beside this file at each speed and
offset, in a folder of OUT for each, and prints a Markdown table: the median error of the accepted poses in mm,
and how many of all poses are accepted and right, accepted and wrong (0.5 degrees, 0.1 m). What is in OUT already
is not run again.
"""
import statistics

from runs import accepted, head, row, rows_of, run_changed, start

SPEEDS_MPS = (0, 5, 10, 15, 20, 30)
OFFSETS_MS = (0, 10, 25, 50)


def cell(trials):
    """What the table has of one run."""
    poses = accepted(trials)
    right = sum(one["status"] == "success" for one in poses)
    errors_mm = [1000 * float(one["translation_error_m"]) for one in poses]
    median = f"{statistics.median(errors_mm):.1f}" if errors_mm else "-"
    return f"{median}; {right}, {len(poses) - right} of {len(trials)}"


def main(croon, out, *options):
    """Runs what is missing and prints the table."""
    head("m/s", *(f"{offset} ms" for offset in OFFSETS_MS))
    for speed in SPEEDS_MPS:
        cells = []
        for offset in OFFSETS_MS:
            at = {"speed_mps": speed, "noise": {"like": "real", "clock_offset_s": offset / 1000}}
            results = run_changed(croon, out, options, "speed_and_offset", {}, at)
            cells.append(cell(rows_of(results, "trials.csv")))
        row(speed, *cells)


if __name__ == "__main__":
    start(main, __doc__)
