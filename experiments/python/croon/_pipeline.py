"""Pipelines on two clouds."""

import dataclasses
import json
from typing import Any, Dict, List, Optional

from . import _core
from ._json import text_and_name, whole, word
from ._types import Array, ArrayLike, Json

__all__ = ["Pipeline", "Result"]


@dataclasses.dataclass(frozen=True, eq=False)
class Result:
    """The result of a pipeline."""

    pose: Array
    """The pose `T_target_source`, 4×4, float64: it maps a point of the source to the target's frame."""
    information: Optional[Array]
    """The information matrix of the pose, 6×6: roll, pitch, yaw (rad), x, y, z (m) in the target's frame, for residuals
    of unit variance; None if no step computed it."""
    covariance: Optional[Array]
    """The covariance of the error of the pose, 6×6: roll, pitch, yaw (rad), x, y, z (m) in the target's frame; None if no
    step estimated it."""
    observability: Optional[Dict[str, str]]
    """How well the data constrain "roll", "pitch", "yaw", "x", "y" and "z": "determined", "weak" or "unobservable"; None
    without a covariance."""
    diagnostics: Dict[str, Dict[str, float]]
    """The diagnostics of each step, by the step's name."""
    rejection: Optional[str]
    """Why the pose was rejected; None if it was not."""
    seconds: Dict[str, float]
    """The wall time of each step, without computations done once per cloud."""


class Pipeline:
    """The steps of a method.

    `pipeline` is a list of steps, or a dict with such a list as "pipeline" (an experiment), as Python values, as JSON
    text, or as the path of a JSON file. Raises InputError with all faults. Running does not change a pipeline:
    threads may share it. Stages in Python must be registered first.
    """

    def __init__(self, pipeline: Json) -> None:
        text, name = text_and_name(pipeline, "pipeline")
        self._pipeline = _core.load_pipeline(name) if text is None else _core.parse_pipeline(text, name)

    @property
    def steps(self) -> List[Dict[str, Any]]:
        """The steps with all their parameters, as a list of dicts from which the same pipeline can be constructed."""
        return json.loads(self._pipeline.resolved())

    def run(self, target: ArrayLike, source: ArrayLike, initial: Optional[ArrayLike] = None, *, seed: int = 1,
            scene: str = "scene", reference: str = "reference", sensor: str = "sensor", trial: int = 0) -> Result:
        """Calibrates the sensor of the cloud `source` to that of the cloud `target`.

        A cloud is an N×3 array of float32 or float64, or a structured array with x, y, z and channels; all points must
        be finite. An array of float32 is copied once. `initial` is a 4×4 pose `T_target_source`; None is the identity.
        With the seed of an experiment, and the names of its scene, sensors and trial, the result has the same bits as
        that of `croon run`. Other Python threads can run meanwhile.

        Returns a `Result`. Raises InputError for wrong arguments, and StageError if a step cannot continue; its
        ``__cause__`` is the exception of the stage, if it is a Python stage.
        """
        names = [word(value, name) for name, value in
                 (("scene", scene), ("reference", reference), ("sensor", sensor))]
        seed = whole(seed, "seed", 0, 2**64 - 1)
        trial = whole(trial, "trial", 0, 2**31 - 1)
        return Result(*self._pipeline.run(target, source, initial, seed, *names, trial))

    def __reduce__(self):
        return Pipeline, (self.steps,)

    def __repr__(self):
        return f"<croon.Pipeline {', '.join(self._pipeline.names())}>"
