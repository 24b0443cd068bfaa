"""Stages in Python: the kinds to derive from, their parameters, and the decorator that registers them."""

import abc
import dataclasses
import math
from typing import Any, Callable, List, NamedTuple, Optional, Sequence, Tuple, Type, TypeVar, Union

from . import _core
from ._json import refusal, text_of, whole, word
from ._types import Array, ArrayLike

__all__ = [
    "Extra", "GroundExtractor", "GroundSplit", "Icp", "Parameter", "PoseSearch", "Preprocessor", "Registration", "RigStep",
    "Step", "Trial", "VolumeScorer", "YawSearch", "boolean", "choice", "extra", "help_on", "integer", "number", "numbers",
    "stage", "text",
]

_Class = TypeVar("_Class", bound=type)
_Range = Tuple[Optional[float], Optional[float]]


class _Stage(abc.ABC):
    """The base class of all kinds, which are the classes that derive from it here."""

    kind = ""


class Step(_Stage):
    """An element of a pipeline: improves an estimate."""

    kind = "step"

    @abc.abstractmethod
    def advance(self, estimate: _core.Estimate, rng: _core.Rng) -> Union[_core.Estimate, ArrayLike]:
        """Returns the estimate with a better pose, or the pose alone, 4×4. Draws only from `rng`."""


class RigStep(_Stage):
    """A step that sees all scenes and sensors of a trial at once (scenes_per_trial). It is registered as a "step"."""

    kind = "step"

    @abc.abstractmethod
    def adjust(self, rig: List[_core.RigEstimate], rng: _core.Rng) -> None:
        """Improves the estimates of a trial in place: a list of `RigEstimate`, by scene, then sensor. Draws only from
        `rng`."""


class YawSearch(_Stage):
    """Minimises a function of yaw. It never sees clouds."""

    kind = "yaw_search"

    @abc.abstractmethod
    def minimise(self, cost: Callable[[float], float]) -> float:
        """Returns the yaw of minimum cost near zero, rad. `cost(yaw_rad)` may be called until this returns."""


class PoseSearch(_Stage):
    """Minimises a function of pose near an initial pose. It never sees clouds."""

    kind = "pose_search"

    @abc.abstractmethod
    def minimise(self, cost: Callable[[ArrayLike], float], start: Array) -> ArrayLike:
        """Returns the pose of minimum cost near `start`, both 4×4. `cost(pose)` may be called until this returns. If the
        cost of the result exceeds that of `start`, `start` is used."""


class Preprocessor(_Stage):
    """Filters a cloud, for example crops or downsamples it."""

    kind = "preprocessor"

    @abc.abstractmethod
    def apply(self, cloud: Array) -> Array:
        """Returns the filtered cloud of a structured array: another array, or a mask that is true for each point to
        keep."""


class GroundExtractor(_Stage):
    """Finds the ground plane of a cloud and the points that lie on it."""

    kind = "ground_extractor"

    @abc.abstractmethod
    def extract(self, cloud: Array, rng: _core.Rng) -> Tuple[ArrayLike, float, ArrayLike]:
        """Returns (normal, offset_m, is_ground) of the cloud, a structured array: the plane `normal . p + offset_m = 0`,
        and a mask that is true for ground points. The sign of the normal is irrelevant. Draws only from `rng`."""


class Icp(_Stage):
    """Registers a source cloud to a target cloud from an initial pose."""

    kind = "icp"

    @abc.abstractmethod
    def align(self, target: _core.Cloud, source: _core.Cloud, start: Array) -> Union["Registration", ArrayLike]:
        """Returns the pose of the source near `start`, 4×4, or a `Registration`. `target` and `source` are `Cloud`."""


class VolumeScorer(_Stage):
    """Measures the volume occupied by two clouds together, as a function of pose."""

    kind = "volume_scorer"

    @abc.abstractmethod
    def bind(self, target: _core.Cloud, source: _core.Cloud) -> Tuple[Callable[[Array], int], float]:
        """Returns (leaves, leaf_size_m) for two clouds of type `Cloud`: a function from a pose, 4×4, to the number of
        occupied leaves, and the edge length of a leaf."""


@dataclasses.dataclass(frozen=True, eq=False)
class Registration:
    """The result of an `Icp`."""

    pose: ArrayLike
    """The pose `T_target_source`, 4×4."""
    rmse_m: float = 0.0
    """Root mean square of the residuals."""
    inlier_ratio: float = 0.0
    """Number of correspondences divided by the number of source points used."""
    correspondences: int = 0
    """The number of correspondences."""
    iterations: int = 0
    """The number of iterations."""
    converged: bool = False
    """Whether the iteration converged."""
    information: Optional[ArrayLike] = None
    """The information matrix, 6×6: roll, pitch, yaw (rad), x, y, z (m)."""


class GroundSplit(NamedTuple):
    """The ground plane of a cloud, and the points off the ground."""

    normal: Array
    """The unit normal, pointing up."""
    offset_m: float
    """The plane is `normal . p + offset_m = 0`."""
    non_ground: _core.Cloud
    """The points off the ground."""


class Trial(NamedTuple):
    """Identifies a trial of an experiment. The results of a step must not depend on it."""

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
    range: _Range
    """Minimum and maximum; None for no bound."""
    choices: Tuple[str, ...]
    """The options of a choice."""
    help: str
    """A description; one sentence."""


class Extra(NamedTuple):
    """A named value that one step stores in the estimate and a later one reads; see `extra`."""

    name: str
    """The name."""
    meaning: str
    """The meaning, in words."""
    type: Type[Any]
    """float, or object for anything else."""


def words(several, what):
    """Returns the words of a list; rejects a str, which would be a list of its letters."""
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
        raise refusal(what, f"expected a range (min, max), found {range!r:.60}") from None
    choices = words(choices, what)
    return Parameter(word(key, "key"), kind, text_of(default, what), ends, choices, help)


def number(key: str, default: float, range: _Range = (None, None), *, help: str) -> Parameter:
    """A number; `range` is (min, max), None for no bound."""
    return _parameter(key, "number", default, help, range)


def integer(key: str, default: int, range: _Range = (-2**31 + 1, 2**31 - 1), *, help: str) -> Parameter:
    """A whole number."""
    return _parameter(key, "integer", default, help, range)


def boolean(key: str, default: bool, *, help: str) -> Parameter:
    """True or False."""
    return _parameter(key, "boolean", default, help)


def text(key: str, default: str, *, help: str) -> Parameter:
    """A non-empty string, such as a path or a name."""
    return _parameter(key, "text", default, help)


def choice(key: str, default: str, choices: Sequence[str], *, help: str) -> Parameter:
    """One of several words."""
    return _parameter(key, "choice", default, help, choices=choices)


def numbers(key: str, default: Sequence[float], range: _Range = (None, None), *, help: str) -> Parameter:
    """A list of at least one number; a tuple in the stage."""
    return _parameter(key, "numbers", default, help, range)


def extra(name: str, meaning: str, type: Type[Any] = object) -> Extra:
    """Declares a value that one step passes to a later one, with `Estimate.put` and `Estimate.get`.

    An extra of type float can be shared with C++ stages; others are for Python stages only.
    """
    return Extra(word(name, "name"), word(meaning, "meaning"), float if type is float else object)


_KINDS = {kind.kind: kind for kind in _Stage.__subclasses__() if kind is not RigStep}


def stage(kind: str, name: str, *, summary: str, source: str = "", parameters: Sequence[Parameter] = (), version: int = 1,
          channels: Sequence[str] = (), takes: Sequence[Extra] = (), gives: Sequence[Extra] = ()) -> Callable[[_Class], _Class]:
    """Registers a class as a stage: ``@croon.stage("step", "my_step", summary="Does this.")``.

    The class derives from the class of its kind and implements the method of the kind. For each stage of a pipeline one
    object is constructed without arguments: its parameters are already attributes when ``__init__`` begins. The object is
    shared by all trials and threads, so its method must not change it.

    `summary` is one sentence, `source` the origin of the method. `parameters` are made with `number`, `integer`,
    `boolean`, `text`, `choice` and `numbers`; an invalid value in an experiment is reported as for a C++ stage. Increase
    `version` with every change that affects results: trials of different versions cannot share a store. `channels` are
    the names of the channels that the stage needs in its clouds; `takes` and `gives` are the extras that it reads and
    stores, made with `extra`.

    Any exception of the method except KeyboardInterrupt, SystemExit and MemoryError becomes a `StageError` with its
    message and ends the trial. The same class may be registered again, as in a notebook cell that runs twice.
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
            # Parameters become attributes, which must not hide methods.
            if not parameter.key.isidentifier() or hasattr(base, parameter.key):
                raise refusal(f"{kind}/{name}", f"expected another key than {parameter.key!r}, which cannot be an attribute")
        _core.register_stage({
            "kind": kind, "name": word(name, "name"), "summary": word(summary, "summary"),
            "source": word(source, "source") or cls.__module__, "version": whole(version, "version", 1, 2**31 - 1), "type": cls,
            "parameters": parameters, "is_rig_step": base is RigStep, "channels": list(words(channels, "channels")),
            "takes": list(takes), "gives": list(gives),
        })
        return cls

    return register


def help_on(which: str = "", format: str = "text") -> str:
    """The output of `croon stages`: all stages, those of a kind ("icp"), or one with its parameters ("icp/icpn").

    `format` is text, json or markdown. Includes Python stages.
    """
    return _core.stages_help(word(which, "which"), word(format, "format"))
