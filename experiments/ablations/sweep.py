#!/usr/bin/env python3
"""Runs an experiment once for each combination of values of its keys.

sweep.py CROON OUT FILE... KEY=VALUE[,VALUE]... [OPTIONS OF CROON RUN]: the first FILE is an experiment, the others are
workloads. KEY is a key of the experiment or leads into one: scenes_per_trial, dataset.noise, starts.rotation_deg,
pipeline.registration. VALUE is JSON or a word. The results are in OUT/NAME, where NAME has the names of the files and
the values; OUT/NAME.json is the experiment. Results that are in OUT already are not computed again. Example:

  sweep.py croon results experiments/best.json experiments/evaluation/held_out/unlike.json dataset.noise=real_still,none
"""
import copy
import itertools
import json
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def merged(path):
    """The keys of an experiment file and of those that it extends."""
    with open(path, encoding="utf-8") as file:
        own = json.load(file)
    extended = own.get("extends", [])
    keys = {}
    for other in [extended] if isinstance(extended, str) else extended:
        keys.update(merged(os.path.join(os.path.dirname(path), other)))
    return {**keys, **own}


def put(tree, path, value):
    """Puts `value` at `path` into a tree of objects and of lists of steps."""
    *parents, last = path.split(".")
    for part in parents:
        tree = tree[place(tree, part)]
    tree[place(tree, last)] = value


def place(tree, part):
    """The key or, of the step called `part`, the index."""
    if isinstance(tree, dict):
        return part
    return next(i for i, step in enumerate(tree) if part in (step.get("name"), step["step"]))


def run(croon, out, files, changes, options=(), name=None):
    """Runs the experiment of `files` with `changes` (values by path), or what of it is missing. The folder of the results."""
    keys = {}
    for file in files:
        keys.update(merged(file))
    names = [merged(file)["name"] for file in files] + [re.sub(r"\W+", "_", word(value)) for value in changes.values()]
    name = name or "_".join(names).strip("_")
    changed = {path.split(".")[0]: copy.deepcopy(keys.get(path.split(".")[0])) for path in changes}
    for path, value in changes.items():
        put(changed, path, value)
    os.makedirs(out, exist_ok=True)
    experiment, results = os.path.join(out, f"{name}.json"), os.path.join(out, name)
    with open(experiment, "w", encoding="utf-8") as file:
        json.dump({"extends": [os.path.relpath(path, out) for path in files], "name": name, **changed}, file)
    command = [croon, "run", experiment, "--out", results, "--quiet", *options]
    for _ in range(2):  # 3: a trial failed, which is a result, or could not be read: that alone is run again.
        ended = subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
        if ended.returncode != 3:
            break
    if ended.returncode not in (0, 3):
        sys.exit(f"croon run {experiment} ended with {ended.returncode}")
    return results


def word(value):
    """A value as it is written."""
    return value if isinstance(value, str) else json.dumps(value)


def values_of(text):
    """The values of VALUE[,VALUE]..."""
    try:
        return json.loads(f"[{text}]")
    except json.JSONDecodeError:
        return text.split(",")


def head(*names):
    """Prints the first two lines of a Markdown table."""
    row(*names)
    print("|---" * len(names) + "|")


def row(*values):
    """Prints a line of one."""
    print("| " + " | ".join(map(str, values)) + " |", flush=True)


def study(name):
    """The path of an experiment beside this file."""
    return os.path.join(HERE, name)


def main(croon, out, *rest):
    """Runs all combinations and prints the folders of the results."""
    last = next((i for i, argument in enumerate(rest) if argument.startswith("-")), len(rest))
    files = [argument for argument in rest[:last] if "=" not in argument]
    changes = dict(argument.split("=", 1) for argument in rest[:last] if "=" in argument)
    if not files or not changes:
        sys.exit(__doc__)
    for values in itertools.product(*map(values_of, changes.values())):
        print(run(croon, out, files, dict(zip(changes, values)), rest[last:]), flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
