#!/usr/bin/env python3
"""Computes numbers of docs/notebook and docs/store.md that are in no table of croon from stores of results.

store_figures.py QUESTION DIR...: prints a Markdown table of each folder of results. The questions:
  moved VARIANT  for the trials that succeed with VARIANT, and for the others: how many end at another pose in each
                 variant, how many of these farther from ground truth, and by how many millimetres (median, maximum)
  far_off DEG    successes by kind of scene and variant, and in brackets the accepted trials with a rotation error
                 above DEG degrees
  information    the median of e' H e / s^2, the squared error e normalised with the information matrix H of the last
                 registration and by the variance s^2 of its residuals, over the trials that succeed; 5.35 if the scaled inverse
                 of H were the covariance of e (the median of a chi-square with six degrees of freedom)
"""
import json
import os
import sqlite3
import statistics
import struct
import sys

ERRORS = ("roll_error_rad", "pitch_error_rad", "yaw_error_rad", "x_error_m", "y_error_m", "z_error_m")
POSE = ("r00", "r01", "r02", "r10", "r11", "r12", "r20", "r21", "r22", "tx_m", "ty_m", "tz_m")
SAME = 1e-9  # Metres, and sines of angles.


def rows_of(folder, query):
    """Returns the rows of `query` in the store of a folder of results."""
    store = sqlite3.connect(f"file:{os.path.join(folder, 'store.sqlite')}?mode=ro", uri=True)
    store.row_factory = sqlite3.Row
    try:
        return store.execute(query).fetchall()
    finally:
        store.close()


def names_in_order(folder):
    """The variants, in the order of the experiment."""
    return [row["name"] for row in rows_of(folder, "SELECT name FROM variants WHERE place IS NOT NULL ORDER BY place")]


def table(head, rows):
    """Prints a Markdown table."""
    print("| " + " | ".join(head) + " |")
    print("|---" * len(head) + "|")
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")


def moved_cell(pairs):
    """A cell of the table of `moved`, for pairs of trials (base, variant)."""
    elsewhere = [(before, after) for before, after in pairs
                 if any(abs(before[name] - after[name]) > SAME for name in POSE)]
    farther = sorted(1000 * (after["translation_error_m"] - before["translation_error_m"]) for before, after in elsewhere
                     if after["translation_error_m"] > before["translation_error_m"])
    by = f" by {statistics.median(farther):.1f}, at most {farther[-1]:.1f} mm" if farther else ""
    return f"{len(elsewhere)} of {len(pairs)}, {len(farther)} farther{by}"


def moved(folder, base):
    """See above."""
    trials = {}
    for row in rows_of(folder, "SELECT * FROM named_trials WHERE tx_m IS NOT NULL"):
        trials.setdefault(row["variant"], {})[row["scene"], row["sensor"], row["trial"]] = row
    if base not in trials:
        sys.exit(f"{folder}: expected the variant {base}, found {', '.join(names_in_order(folder))}")
    rows = []
    for variant in names_in_order(folder):
        pairs = [(row, trials[variant][key]) for key, row in trials[base].items() if key in trials.get(variant, {})]
        groups = [[pair for pair in pairs if (pair[0]["status"] == "success") == succeeds] for succeeds in (True, False)]
        rows.append([f"`{variant}`", *map(moved_cell, groups)])
    table(["variant", f"`{base}` succeeds", "does not"], rows)


def far_off(folder, degrees):
    """See above."""
    variants = names_in_order(folder)
    counts = rows_of(folder, f"""
        SELECT scenes.kind AS kind, variants.name AS variant, count(*) AS trials, sum(status = 'success') AS successes,
               sum(status = 'inaccurate' AND rotation_error_rad * 57.29577951308232 > {float(degrees)}) AS far
        FROM trials JOIN scenes ON scenes.id = scene JOIN variants ON variants.id = variant
        GROUP BY kind, variants.id""")
    cells = {(row["kind"], row["variant"]): row for row in counts}
    kinds = sorted({row["kind"] for row in counts})

    def cell(kinds, variant):
        found = [cells[kind, variant] for kind in kinds if (kind, variant) in cells]
        far = sum(row["far"] for row in found)
        return str(sum(row["successes"] for row in found)) + (f" ({far})" if far else "")

    def line(name, kinds):
        trials = sum(cells[kind, variants[0]]["trials"] for kind in kinds if (kind, variants[0]) in cells)
        return [name, trials, *(cell(kinds, variant) for variant in variants)]

    table(["kind", "trials", *(f"`{variant}`" for variant in variants)],
          [line(f"`{kind}`", [kind]) for kind in kinds] + [line("all", kinds)])


def normalised_squared_error(row):
    """e' H e / s^2 of one trial; s is the root mean square of the residuals."""
    error = [row[name] for name in ERRORS]
    matrix = struct.unpack("<36d", row["information"])
    squared = sum(error[i] * matrix[6 * i + j] * error[j] for i in range(6) for j in range(6))
    return squared / json.loads(row["figures"])["rmse_m"] ** 2


def information(folder):
    """See above."""
    rows = rows_of(folder, f"""
        SELECT t.variant AS variant, {', '.join('t.' + name for name in ERRORS)}, s.information, s.figures
        FROM named_trials t JOIN named_steps s USING (variant, scene, sensor, trial)
        WHERE s.information IS NOT NULL AND t.status = 'success'
        AND s.place = (SELECT max(l.place) FROM named_steps l WHERE l.variant = t.variant AND l.scene = t.scene
                       AND l.sensor = t.sensor AND l.trial = t.trial AND l.information IS NOT NULL)""")
    found = []
    for variant in names_in_order(folder):
        errors = [normalised_squared_error(row) for row in rows if row["variant"] == variant]
        found.append([f"`{variant}`", len(errors), f"{statistics.median(errors):.1f}" if errors else "-"])
    table(["variant", "trials", "median"], found)


QUESTIONS = {"moved": (moved, 1), "far_off": (far_off, 1), "information": (information, 0)}


def main(question="", *rest):
    """Answers the question for each folder."""
    if not rest:
        sys.exit(__doc__)
    if question not in QUESTIONS:
        sys.exit(f"expected one of {', '.join(QUESTIONS)}, found {question}")
    answer, options = QUESTIONS[question]
    if len(rest) <= options:
        sys.exit(__doc__)
    for folder in rest[options:]:
        print(f"\n{folder}\n")
        answer(folder, *rest[:options])


if __name__ == "__main__":
    main(*sys.argv[1:])
