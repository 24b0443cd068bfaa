"""What the scripts of this folder share: runs of experiments, their tables, and tables in Markdown."""
import csv
import json
import os
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def run_experiment(croon, experiment, results, options):
    """Runs `experiment`, or what of it is missing, into the folder `results`. Ends the script if that has trials of
    something else, which croon refuses."""
    command = [croon, "run", experiment, "--out", results, "--quiet", *options]
    ended = subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    if ended.returncode == 3:  # A trial failed, which is a result, or could not be read: that alone is run again.
        ended = subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    if ended.returncode not in (0, 3):
        sys.exit(f"croon run {experiment} ended with {ended.returncode}")


def run_changed(croon, out, options, name, keys, dataset, what=None):
    """Runs the experiment `name`.json beside this file with other `keys` and with a dataset of which the keys `dataset`
    are others. The folder of the results, a folder of `out` that is named `what`, or else after the changes."""
    base = os.path.join(HERE, f"{name}.json")
    with open(base, encoding="utf-8") as file:
        experiment = {**json.load(file), **keys}
    what = what or "_".join(short(value) for value in {**keys, **dataset}.values())
    folder = os.path.join(out, f"{name}_{what}")
    os.makedirs(folder, exist_ok=True)
    changed = os.path.join(folder, "experiment.json")
    with open(changed, "w", encoding="utf-8") as file:
        json.dump({"extends": os.path.relpath(base, folder), "name": f"{name}_{what}", **keys,
                   "dataset": {**experiment["dataset"], **dataset}}, file)
    results = os.path.join(folder, "results")
    run_experiment(croon, changed, results, options)
    return results


def short(value):
    """A value as part of a name: the numbers and words in it."""
    if isinstance(value, dict):
        return "_".join(short(part) for item in value.items() for part in item)
    if isinstance(value, list):
        return "_".join(short(part) for part in value)
    return str(value)


def rows_of(results, table):
    """The rows of a table."""
    with open(os.path.join(results, table), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def accepted(trials):
    """Those whose pose is right or wrong, but not rejected."""
    return [row for row in trials if row["status"] in ("success", "inaccurate")]


def percentile_95(values):
    """By linear interpolation."""
    return statistics.quantiles(values, n=20, method="inclusive")[-1]


def head(*names):
    """Prints the first two lines of a Markdown table."""
    row(*names)
    print("|---" * len(names) + "|")


def row(*values):
    """Prints a line of one."""
    print("| " + " | ".join(str(value) for value in values) + " |", flush=True)


def start(main, usage):
    """Calls `main` with the arguments of the script, CROON OUT and options, or ends it with its usage without them."""
    if len(sys.argv) < 3:
        sys.exit(usage)
    main(*sys.argv[1:])
