"""croon: target-less calibration of the LiDARs of a car, and experiments on it.

Clouds are NumPy arrays: N×3 of float32 or float64, or structured arrays with x, y, z and channels. Poses are 4×4
arrays; ``T_target_source`` maps a point of the source to the target's frame. Lengths are metres, angles radians unless a
name says otherwise.
"""

from . import _calibrate, _clouds, _datasets, _errors, _pipeline, _results, _stages
from ._calibrate import *
from ._clouds import *
from ._core import Cloud, Estimate, RigEstimate, Rng
from ._core import version as __version__
from ._datasets import *
from ._errors import *
from ._pipeline import *
from ._results import *
from ._stages import *

__all__ = ["Cloud", "Estimate", "RigEstimate", "Rng"]
__all__ += _calibrate.__all__
__all__ += _clouds.__all__
__all__ += _datasets.__all__
__all__ += _errors.__all__
__all__ += _pipeline.__all__
__all__ += _results.__all__
__all__ += _stages.__all__
