#!/usr/bin/env python3
"""How soon croon check --watch notices drift, and how often it is wrong, from its log of drives without drift.

drift.py LOG [--scans-per-drive N] [--hours H] [--series N]: LOG is the log of croon check --watch, for instance of

  croon simulate experiments/evaluation/held_out/drives.json --out results/drives
  croon check results/drives/truth.json results/drives --reference top --watch --log results/drives.csv

The differences of the log, with an offset added from some scan on, are those of a sensor that is knocked at that scan: to first order,
the registered pose moves with the sensor. The test of framework/calibration/drift_test.cpp is repeated here on many series at once; the
statistics in the log show whether it is the same. Long series are made of whole drives, drawn at random.
"""
import argparse
import csv
import math
import sys

if len(sys.argv) < 2:
    sys.exit(__doc__)

import numpy as np  # noqa: E402

DOFS = ["roll", "pitch", "yaw", "x", "y", "z"]
UNITS = ["deg"] * 3 + ["m"] * 3
KNOCK = np.array([0.2] * 3 + [0.02] * 3)
TOLERANCE = np.array([0.05] * 3 + [0.005] * 3)
WINDOWS = [4, 8, 16, 32, 64, 128]
COMMON = 0.2
BLOCK = 16


def threshold(mean_scans, tests):
    h = 3.0
    for _ in range(60):
        h = math.sqrt(max(1.0, 2.0 * math.log(mean_scans * tests * 0.25 * h / math.sqrt(2.0 * math.pi))))
    return h


class Test:
    """The statistics of many series at once; `shape` is that of one scan of all series."""

    def __init__(self, shape, length):
        self.values = np.zeros((length + 1,) + shape)
        self.weights = np.zeros((length + 1,) + shape)
        self.scans = 0
        self.sums, self.count = np.full(shape, 1.5 * 10.0), 10.0
        self.inflation = np.full(shape, 1.5)
        self.last = None

    def add(self, difference, std):
        limit = TOLERANCE + 3.0 * np.sqrt(self.inflation) * std
        weight = 1.0 / std**2
        k = self.scans = self.scans + 1
        self.values[k] = self.values[k - 1] + weight * np.clip(difference, -limit, limit)
        self.weights[k] = self.weights[k - 1] + weight
        if k % BLOCK == 0:
            self._add_block(k)
        best = np.zeros(difference.shape)
        for n in (n for n in WINDOWS if n <= k):
            w = self.weights[k] - self.weights[k - n]
            beyond = np.abs(self.values[k] - self.values[k - n]) / w - TOLERANCE
            best = np.maximum(best, beyond * np.sqrt(w / (self.inflation + COMMON**2 * n)))
        return best

    def _add_block(self, k):
        w = self.weights[k] - self.weights[k - BLOCK]
        mean = (self.values[k] - self.values[k - BLOCK]) / w
        if self.last is not None:
            square = (mean - self.last[0]) ** 2 / (1.0 / w + 1.0 / self.last[1])
            self.sums = self.sums + np.minimum(square, 9.0 * self.inflation)
            self.count += 1.0
            if self.count > 200.0:
                self.sums, self.count = self.sums * 200.0 / self.count, 200.0
            self.inflation = np.maximum(1.0, self.sums / self.count)
        self.last = (mean, w)


def read_log(file):
    """By sensor: the numbers of its usable scans, differences, standard deviations and statistics."""
    rows = {}
    with open(file, encoding="utf-8") as lines:
        for row in csv.DictReader(lines):
            if row["why_not"]:
                continue
            names = ([f"{dof}_{unit}" for dof, unit in zip(DOFS, UNITS)]
                     + [f"{dof}_std_{unit}" for dof, unit in zip(DOFS, UNITS)]
                     + [f"{dof}_statistic" for dof in DOFS])
            rows.setdefault(row["sensor"], []).append([float(row["scan"])] + [float(row[name]) for name in names])
    return {sensor: np.array(values) for sensor, values in rows.items()}


def check_repetition(log):
    """The largest difference between the statistics of the log and those computed here."""
    worst = 0.0
    for values in log.values():
        test = Test((6,), len(values))
        for row in values:
            worst = max(worst, np.abs(test.add(row[1:7], row[7:13]) - row[13:]).max())
    return worst


def drives_of(values, scans_per_drive):
    drives = [values[values[:, 0] // scans_per_drive == k] for k in np.unique(values[:, 0] // scans_per_drive)]
    return [drive for drive in drives if len(drive) > scans_per_drive // 2]


def long_series(drives, scans, series, rng):
    """Differences and standard deviations, scans x series x 6."""
    columns = []
    for _ in range(series):
        parts, length = [], 0
        while length < scans:
            drive = drives[rng.integers(len(drives))]
            parts.append(drive if columns or parts else drive[rng.integers(len(drive)):])
            length += len(parts[-1])
        columns.append(np.concatenate(parts)[:scans])
    both = np.stack(columns, axis=1)
    return both[:, :, 1:7], both[:, :, 7:13]


def first_alarms(differences, stds, limit):
    """By series and degree of freedom, the first scan with an alarm; the number of scans if there is none."""
    test = Test(differences.shape[1:], len(differences))
    first = np.full(differences.shape[1:], len(differences))
    for k, (difference, std) in enumerate(zip(differences, stds)):
        first = np.where((test.add(difference, std) > limit) & (first == len(differences)), k, first)
    return first


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("log")
    parser.add_argument("--scans-per-drive", type=int, default=40)
    parser.add_argument("--hours", type=float, default=100.0, help="of resampled driving without drift")
    parser.add_argument("--series", type=int, default=400, help="knocks of each sensor and degree of freedom")
    options = parser.parse_args()
    log = read_log(options.log)
    rng = np.random.default_rng(1)
    limit = threshold(360000.0, 6 * len(log))
    print(f"threshold {limit:.3f}; the statistics differ from the log's by at most {check_repetition(log):.1e}")
    warm, after = 600, 400
    total, noticed = 0, 0
    for sensor, values in log.items():
        drives = drives_of(values, options.scans_per_drive)
        print(f"\n{sensor}: {len(values)} usable scans of {len(drives)} drives; in the log the largest statistic is "
              f"{values[:, 13:].max():.2f}")
        differences, stds = long_series(drives, warm + after, options.series, rng)
        print("  dof    std of a scan  noticed within 20  median delay  95 %  early alarms")
        for i, (dof, unit) in enumerate(zip(DOFS, UNITS)):
            delays, early = [], 0
            for sign in (-1.0, 1.0):
                knocked = differences.copy()
                knocked[warm:, :, i] += sign * KNOCK[i]
                first = first_alarms(knocked, stds, limit)[:, i]
                early += (first < warm).sum()
                delays.append(first[first >= warm] - warm + 1)
            delays = np.concatenate(delays)
            total, noticed = total + len(delays), noticed + (delays <= 20).sum()
            print(f"  {dof:5}  {np.median(values[:, 7 + i]):9.4f} {unit:3}  {100.0 * (delays <= 20).mean():15.1f} %"
                  f"  {np.median(delays):12.0f}  {np.percentile(delays, 95):4.0f}  {early:12}")
        creep, length = 600, 900
        differences, stds = long_series(drives, warm + length, options.series // 4, rng)
        ramp = np.concatenate([np.zeros(warm), np.minimum(np.arange(length) / creep, 1.0)])
        first = first_alarms(differences + ramp[:, None, None] * KNOCK, stds, limit)
        at = np.median(np.minimum((first - warm) / creep, 1.5), axis=0)
        print("  creep of 0.2 degrees or 2 cm in 60 s, noticed after, s: "
              + ", ".join(f"{dof} {60.0 * t:.0f}" for dof, t in zip(DOFS, at)))
    print(f"\nall knocks: {100.0 * noticed / total:.1f} % within 20 scans")
    alarms, scans, series = 0, 18000, max(1, round(options.hours / 0.5))
    for values in log.values():
        differences, stds = long_series(drives_of(values, options.scans_per_drive), scans, series, rng)
        # An alarm of one degree of freedom ends its series, so that it counts once.
        alarms += (first_alarms(differences, stds, limit) < scans).sum()
    hours = series * scans / 36000.0
    print(f"without drift: {alarms} alarms of all sensors in {hours:.0f} h of resampled drives, "
          f"{10.0 * alarms / hours:.2f} per 10 h")


if __name__ == "__main__":
    main()
