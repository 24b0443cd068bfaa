"""croon: target-less calibration of the LiDARs of a car, and experiments on it.

Clouds are NumPy arrays: N×3 of float32 or float64, or structured arrays with x, y, z and channels. Poses are 4×4
arrays; ``T_target_source`` maps a point of the source to the target's frame. Lengths are metres, angles radians unless a
name says otherwise.
"""

from ._calibrate import CalibratedSensor, Calibration, GroundPose, SceneEstimate, SceneMotion, calibrate, pipelines
from ._clouds import read_cloud, write_cloud, xyz
from ._core import Cloud, Estimate, RigEstimate, Rng
from ._core import version as __version__
from ._datasets import Scene, scenes, simulate
from ._errors import Fault, InputError, StageError
from ._pipeline import Pipeline, Result
from ._results import Results, load, run, starts
from ._stages import (Extra, GroundExtractor, GroundSplit, Icp, Parameter, PoseSearch, Preprocessor, Registration, RigStep,
                      Step, Trial, VolumeScorer, YawSearch, boolean, choice, extra, help_on, integer, number, numbers,
                      stage, text)

__all__ = [
    "CalibratedSensor", "Calibration", "Cloud", "Estimate", "Extra", "Fault", "GroundExtractor", "GroundPose",
    "GroundSplit", "Icp", "InputError", "Parameter", "Pipeline", "PoseSearch", "Preprocessor", "Registration",
    "Result", "Results", "RigEstimate", "RigStep", "Rng", "Scene", "SceneEstimate", "SceneMotion", "StageError",
    "Step", "Trial", "VolumeScorer", "YawSearch", "boolean", "calibrate", "choice", "extra", "help_on", "integer",
    "load", "number", "numbers", "pipelines", "read_cloud", "run", "scenes", "simulate", "stage", "starts", "text",
    "write_cloud", "xyz",
]
