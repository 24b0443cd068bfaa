"""What the scripts of this folder share: runs of experiments."""
import os
import subprocess
import sys


def run_unless_there(croon, experiment, results, table, options):
    """Runs `experiment` into the folder `results`, unless that has `table`, which comes last."""
    if os.path.exists(os.path.join(results, table)):
        return
    ended = subprocess.run([croon, "run", experiment, "--out", results, "--quiet", *options], check=False,
                           stdout=subprocess.DEVNULL)
    if ended.returncode not in (0, 3):  # 3: a trial failed, which is a result.
        sys.exit(f"croon run {experiment} ended with {ended.returncode}")
