#!/usr/bin/env python3
"""driving.json over the speed of the car and the offset of the sensors' clocks.

speed_and_offset.py CROON OUT [OPTIONS OF CROON RUN]: runs driving.json on three scenes at each speed and offset, in folders
of OUT, and prints a Markdown table: the median error of the accepted poses in mm, and how many of all poses are
accepted and right, accepted and wrong (0.5 degrees, 0.1 m). Results that are in OUT already are not computed again.
Needs the Python package.
"""
import sys

if len(sys.argv) < 3:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

import croon  # noqa: E402
from sweep import head, row, run, study  # noqa: E402

SPEEDS_MPS = (0, 5, 10, 15, 20, 30)
OFFSETS_MS = (0, 10, 25, 50)
DATASET = {"type": "simulated", "rig": "croon_five", "scenes": 3, "seed": 621,
           "mix": {"urban": 5, "suburban": 4, "crossing": 3}}


def cell(trials):
    """The table's cell of one run."""
    right = np.sum(trials["status"] == "success")
    accepted = trials[np.isin(trials["status"], ("success", "inaccurate"))]
    median = f"{1000 * np.median(accepted['translation_error_m']):.1f}" if len(accepted) else "-"
    return f"{median}; {right}, {len(accepted) - right} of {len(trials)}"


def main(program, out, *options):
    """Runs what is missing and prints the table."""
    head("m/s", *(f"{offset} ms" for offset in OFFSETS_MS))
    for speed in SPEEDS_MPS:
        cells = []
        for offset in OFFSETS_MS:
            noise = {"like": "real", "clock_offset_s": offset / 1000}
            results = run(program, out, [study("../driving.json")],
                          {"dataset": {**DATASET, "speed_mps": speed, "noise": noise}}, options, f"{speed}_mps_{offset}_ms")
            cells.append(cell(croon.load(results).trials))
        row(speed, *cells)


if __name__ == "__main__":
    main(*sys.argv[1:])
