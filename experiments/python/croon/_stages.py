"""Stages in Python: the kinds to derive from, their parameters, and the decorator that registers them."""

import dataclasses
import math
from typing import Any, NamedTuple, Optional, Tuple

import numpy

from . import _core
from ._json import refusal, text_of, whole, word


class _Stage:
    """What all kinds have in common."""

    kind = ""


class Step(_Stage):
    """An element of a pipeline: takes an estimate and returns a better one."""

    kind = "step"

    def advance(self, estimate, rng):
        """Returns the estimate with a better pose, or the pose alone, 4×4. Draws only from `rng`."""
        raise NotImplementedError(f"{type(self).__name__} has no method advance")


class RigStep(_Stage):
    """A step that sees all scenes and sensors of a trial at once (scenes_per_trial). It is registered as a "step"."""

    kind = "step"

    def adjust(self, rig, rng):
        """Improves the estimates of a trial in place: a list of `RigEstimate`, by scene and then by sensor. Draws only
        from `rng`."""
        raise NotImplementedError(f"{type(self).__name__} has no method adjust")


class YawSearch(_Stage):
    """Minimises a function of yaw. It never sees clouds."""

    kind = "yaw_search"

    def minimise(self, cost):
        """Returns the yaw of least cost near zero, rad. `cost(yaw_rad)` may be called until this returns."""
        raise NotImplementedError(f"{type(self).__name__} has no method minimise")


class PoseSearch(_Stage):
    """Minimises a function of pose near a start. It never sees clouds."""

    kind = "pose_search"

    def minimise(self, cost, start):
        """Returns the pose of least cost near `start`, both 4×4. `cost(pose)` may be called until this returns. If the
        result costs more than the start, the start is kept."""
        raise NotImplementedError(f"{type(self).__name__} has no method minimise")


class Preprocessor(_Stage):
    """Filters a cloud: crops it or thins it."""

    kind = "preprocessor"

    def apply(self, cloud):
        """Returns the cloud, a structured array, without some of its points: another array, or true for each point
        that stays."""
        raise NotImplementedError(f"{type(self).__name__} has no method apply")


class GroundExtractor(_Stage):
    """Finds the ground plane of a cloud and the points that lie on it."""

    kind = "ground_extractor"

    def extract(self, cloud, rng):
        """Returns (normal, offset_m, is_ground) of the cloud, a structured array: the plane `normal . p + offset_m = 0`,
        and true for each point that is ground. The sign of the normal does not matter. Draws only from `rng`."""
        raise NotImplementedError(f"{type(self).__name__} has no method extract")


class Icp(_Stage):
    """Registers a source cloud to a target cloud from a start."""

    kind = "icp"

    def align(self, target, source, start):
        """Returns the pose of the source near `start`, 4×4, or a `Registration`. `target` and `source` are `Cloud`."""
        raise NotImplementedError(f"{type(self).__name__} has no method align")


class VolumeScorer(_Stage):
    """Measures the volume that two clouds occupy together, as a function of pose."""

    kind = "volume_scorer"

    def bind(self, target, source):
        """Returns (leaves, leaf_size_m) for two clouds of type `Cloud`: a function from a pose, 4×4, to the number of
        leaves that hold a point, and the edge of a leaf."""
        raise NotImplementedError(f"{type(self).__name__} has no method bind")


@dataclasses.dataclass(frozen=True, eq=False)
class Registration:
    """What an `Icp` found."""

    pose: numpy.ndarray
    """The pose `T_target_source`, 4×4."""
    rmse_m: float = 0.0
    """Root mean square of the residuals."""
    inlier_ratio: float = 0.0
    """Correspondences over the source points that took part."""
    correspondences: int = 0
    """The number of correspondences."""
    iterations: int = 0
    """The number of iterations."""
    converged: bool = False
    """Whether it ended by itself."""
    information: Optional[numpy.ndarray] = None
    """The information matrix, 6×6: roll, pitch, yaw (rad), x, y, z (m)."""


class GroundSplit(NamedTuple):
    """The ground plane of a cloud, and the points off the ground."""

    normal: numpy.ndarray
    """The unit normal, up."""
    offset_m: float
    """The plane is `normal . p + offset_m = 0`."""
    non_ground: Any
    """The points off the ground, a `Cloud`."""


class Trial(NamedTuple):
    """Which trial of an experiment is calibrated. What a step computes must not depend on it."""

    scene: str
    """The scene's name."""
    sensor: str
    """The sensor's name."""
    number: int
    """The number of the start."""


class Parameter(NamedTuple):
    """A parameter of a stage; see `number`, `integer`, `boolean`, `text`, `choice` and `numbers`."""

    key: str
    """The key in JSON, and the attribute of the stage."""
    type: str
    """The name of the function that made it."""
    json: str
    """The default as JSON text."""
    range: Tuple[Optional[float], Optional[float]]
    """The least and the largest value; None if there is none."""
    choices: Tuple[str, ...]
    """The words of a choice."""
    help: str
    """What it does; one sentence."""


class Extra(NamedTuple):
    """A named value that one step puts into the estimate and a later one reads; see `extra`."""

    name: str
    """Its name."""
    meaning: str
    """What it is."""
    type: type
    """float, or object for anything else."""


def words(several, what):
    """The words of a list; a str is one word, not a list of its letters."""
    if isinstance(several, str):
        raise refusal(what, f"expected a list of words, found {several!r:.60}")
    return tuple(word(one, what) for one in several)


def _parameter(key, kind, default, help, range=(None, None), choices=()):
    what = f"the parameter {key!r}"
    if not word(help, what):
        raise refusal(what, "expected a sentence of help")
    try:
        low, high = range
        ends = tuple(None if end is None or math.isinf(end) else float(end) for end in (low, high))
    except (TypeError, ValueError):
        raise refusal(what, f"expected a range (least, largest), found {range!r:.60}") from None
    choices = words(choices, what)
    return Parameter(word(key, "key"), kind, text_of(default, what), ends, choices, help)


def number(key, default, range=(None, None), *, help):
    """A number; `range` is (least, largest), None for no bound."""
    return _parameter(key, "number", default, help, range)


def integer(key, default, range=(-2**31 + 1, 2**31 - 1), *, help):
    """A whole number."""
    return _parameter(key, "integer", default, help, range)


def boolean(key, default, *, help):
    """True or False."""
    return _parameter(key, "boolean", default, help)


def text(key, default, *, help):
    """A string that is not empty: a path, a name."""
    return _parameter(key, "text", default, help)


def choice(key, default, choices, *, help):
    """One of a few words."""
    return _parameter(key, "choice", default, help, choices=choices)


def numbers(key, default, range=(None, None), *, help):
    """A list of at least one number; the stage has it as a tuple."""
    return _parameter(key, "numbers", default, help, range)


def extra(name, meaning, type=object):
    """Names a value that one step gives to a later one, with `Estimate.put` and `Estimate.get`.

    An extra of the type float is one of C++ stages too; any other is for stages in Python.
    """
    return Extra(word(name, "name"), word(meaning, "meaning"), float if type is float else object)


_KINDS = {kind.kind: kind for kind in
          (Step, YawSearch, PoseSearch, Preprocessor, GroundExtractor, Icp, VolumeScorer)}


def stage(kind, name, *, summary, source="", parameters=(), version=1, channels=(), takes=(), gives=()):
    """Registers a class as a stage: ``@croon.stage("step", "my_step", summary="Does this.")``.

    The class derives from that of its kind and has the kind's one method. For each stage of a pipeline one object is
    made, without arguments: its parameters are attributes already when ``__init__`` begins. The object is shared by all
    trials and threads, so its method must not change it.

    `summary` is one sentence, `source` says where the method comes from. `parameters` are made by `number`, `integer`,
    `boolean`, `text`, `choice` and `numbers`: a wrong value in an experiment is then the same error as for a stage in
    C++. `version` is raised with a change by which the stage gives other results: trials of two versions do not go into
    one store. `channels` names the channels that the stage needs of its clouds; `takes` and `gives` are the extras that
    it reads and puts, made by `extra`.

    Any exception of the method but KeyboardInterrupt, SystemExit and MemoryError is a `StageError` with its message: it
    ends the trial. The same class may be registered again, as in a cell of a notebook that runs twice.
    """
    if kind not in _KINDS:
        raise refusal("kind", f"expected one of {', '.join(_KINDS)}, found {kind!r:.60}")

    parameters = list(parameters)

    def register(cls):
        base = _KINDS[kind]
        if base is Step and isinstance(cls, type) and issubclass(cls, RigStep):
            base = RigStep
        if not (isinstance(cls, type) and issubclass(cls, base)):
            raise refusal(f"{kind}/{name}", f"expected a class that derives from croon.{base.__name__}, found {cls!r:.60}")
        for parameter in parameters:
            # It becomes an attribute, which must not hide a method.
            if not parameter.key.isidentifier() or hasattr(base, parameter.key):
                raise refusal(f"{kind}/{name}", f"expected another key than {parameter.key!r}: it is no attribute's name")
        _core.register_stage({
            "kind": kind, "name": word(name, "name"), "summary": word(summary, "summary"),
            "source": word(source, "source") or cls.__module__, "version": whole(version, "version", 1, 2**31 - 1), "type": cls,
            "parameters": parameters, "is_rig_step": base is RigStep, "channels": list(words(channels, "channels")),
            "takes": list(takes), "gives": list(gives),
        })
        return cls

    return register




def help_on(which="", format="text"):
    """What `croon stages` prints: all stages, those of a kind ("icp"), or one with its parameters ("icp/icpn").

    `format` is text, json or markdown. Stages in Python are among them.
    """
    return _core.stages_help(word(which, "which"), word(format, "format"))
