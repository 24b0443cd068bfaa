#!/usr/bin/env python3
"""Checks reports in headless Chromium, see check_report.py.

  reports_test.py fixture THREE_MIN_JS     a page with hostile names
  reports_test.py calibration CROON        of the simulated car of experiments/demo_car.json
  reports_test.py experiment CROON         of experiments/demo.json
  reports_test.py large CROON              of 20,000 trials, at most 15 MB

Exit code 0: all passed; 1: a check failed; 2: a wrong request; 77: Chromium is not installed.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import check_report
import fixture
from chromium import find_chromium

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
SENSORS = ("top", "front", "back", "left", "right")
MAX_LARGE_BYTES = 15_000_000

# 2 variants x 10 scenes x 2 sensors x 500 starts. The ground is found once per cloud, so trials are
# fast; it changes poses, which the viewer must show, and leaves yaw as it was.
LARGE = {
    "name": "large",
    "dataset": {"type": "simulated", "scenes": 10, "rig": {"reference": "top", "sensors": {
        "top": {"model": "spinner_16"},
        "left": {"model": "spinner_16", "translation_m": [0, 0.8, -0.3]},
        "right": {"model": "spinner_16", "translation_m": [0, -0.8, -0.3]}}}},
    "starts": {"around": "truth", "rotation_deg": 2, "translation_m": 0.2, "trials": 500},
    "success": {"rotation_deg": 1, "translation_m": 0.1},
    "pipeline": [{"step": "preprocessing", "sensor": [{"type": "range_crop", "min_m": 1}]},
                 {"step": "ground_alignment"}],
    "variants": [{"name": "whole", "replace": {"preprocessing.sensor": []}}],
}
KINDS = ("fixture", "calibration", "experiment", "large")


def write_report(kind, source, folder):
    """Writes a report into a folder and returns its path."""
    def croon(*arguments):
        subprocess.run([source, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)

    if kind == "fixture":
        fixture.write(source, folder / "report.html")
        return folder / "report.html"
    if kind == "experiment":
        croon("run", EXPERIMENTS / "demo.json", "--out", folder / "demo", "--quiet")
        croon("report", folder / "demo")
        return folder / "demo/report.html"
    if kind == "large":
        (folder / "large.json").write_text(json.dumps(LARGE), encoding="utf-8")
        croon("run", folder / "large.json", "--out", folder / "large", "--quiet")
        croon("report", folder / "large")
        return folder / "large/report.html"
    croon("simulate", EXPERIMENTS / "demo_car.json", "--out", folder / "car", "--quiet")
    croon("calibrate", *(folder / f"car/000000/{sensor}.pcd" for sensor in SENSORS), "--nominal",
          folder / "car/truth.json", "--from-scratch", "--out", folder / "calibration")
    return folder / "calibration/report.html"


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in KINDS:
        print(__doc__, file=sys.stderr)
        return 2
    if not find_chromium():
        print("skipped: no chromium found; install it or set CHROMIUM (a snap cannot read /tmp)")
        return 77
    with tempfile.TemporaryDirectory(prefix="croon_reports_") as folder:
        report = write_report(sys.argv[1], sys.argv[2], pathlib.Path(folder))
        failed = check_report.check_report(report, None)
        if sys.argv[1] == "large":
            size = report.stat().st_size
            is_small = size <= MAX_LARGE_BYTES
            print(f"{'ok  ' if is_small else 'FAIL'} size of the report: {size} bytes")
            failed += not is_small
        return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
