#!/usr/bin/env python3
"""Checks reports in headless Chromium, see check_report.py.

  reports_test.py fixture THREE_MIN_JS     a page with hostile names
  reports_test.py calibration CROON        of the simulated car of experiments/demo_car.json
  reports_test.py experiment CROON         of experiments/demo.json

Exit code 0: all passed; 1: a check failed; 2: a wrong request; 77: Chromium is not installed.
"""

import pathlib
import subprocess
import sys
import tempfile

import check_report
import fixture
from chromium import find_chromium

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "experiments"
SENSORS = ("top", "front", "back", "left", "right")


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
    croon("simulate", EXPERIMENTS / "demo_car.json", "--out", folder / "car", "--quiet")
    croon("calibrate", *(folder / f"car/000000/{sensor}.pcd" for sensor in SENSORS), "--nominal",
          folder / "car/truth.json", "--from-scratch", "--out", folder / "calibration")
    return folder / "calibration/report.html"


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("fixture", "calibration", "experiment"):
        print(__doc__, file=sys.stderr)
        return 2
    if not find_chromium():
        print("skipped: no chromium found; install it or set CHROMIUM (a snap cannot read /tmp)")
        return 77
    with tempfile.TemporaryDirectory(prefix="croon_reports_") as folder:
        report = write_report(sys.argv[1], sys.argv[2], pathlib.Path(folder))
        return 1 if check_report.check_report(report, None) else 0


if __name__ == "__main__":
    sys.exit(main())
