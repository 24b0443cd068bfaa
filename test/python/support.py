"""What the tests of the Python package share."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import croon

SOURCE = pathlib.Path(__file__).resolve().parents[2]

# Coarse sensors: what is computed is that of others, and only that it is the same matters.
RIG = {"sensors": {
    "top": {"model": {"like": "carla_pandar64", "azimuth_step_deg": 1}},
    "left": {"model": {"like": "carla_pandar_qt", "azimuth_step_deg": 1.5}, "rotation_rpy_deg": [0, 48, -90],
             "translation_m": [0.25, -0.85, -0.595]},
    "right": {"model": {"like": "carla_pandar_qt", "azimuth_step_deg": 1.5}, "rotation_rpy_deg": [0, 48, 90],
              "translation_m": [0.25, 0.85, -0.595]}}}

GROUND = {"step": "ground_alignment"}
METHOD = [GROUND, {"step": "yaw_alignment"}, {"step": "registration"}]


def experiment(**changes):
    """Two simulated scenes with three trials per sensor."""
    return {
        "name": "small", "seed": 7,
        "dataset": {"type": "simulated", "scenes": 2, "rig": RIG, "mix": {"urban": 1}, "noise": "real"},
        "starts": {"rotation_deg": 10, "translation_m": 0.1, "trials": 3},
        "pipeline": METHOD, **changes,
    }


def program(*arguments):
    """Runs the program croon."""
    return subprocess.run([os.environ["CROON_PROGRAM"], *map(str, arguments)], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


class TestCase(unittest.TestCase):
    """Has a folder of its own, which is the working directory."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def line_of(self, error, call, *arguments, **named):
        """The message of the exception of the type `error` that the call raises; it has one line."""
        with self.assertRaises(error) as raised:
            call(*arguments, **named)
        self.assertNotIn("\n", str(raised.exception))
        return str(raised.exception)


def two_clouds():
    """The clouds of the reference and of a sensor, and the true pose."""
    scene = croon.simulate(rig=RIG, mix={"urban": 1}, seed=3)[0]
    return scene.cloud("top"), scene.cloud("left"), scene.truth["left"]
