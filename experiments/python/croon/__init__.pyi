import pathlib
from os import PathLike
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Type, TypeVar, Union

import numpy
import numpy.typing
import pandas

__version__: str

_Array = numpy.ndarray
_ArrayLike = numpy.typing.ArrayLike
_Path = Union[str, "PathLike[str]"]
_Json = Union[Mapping[str, Any], Sequence[Any], str, "PathLike[str]"]
_T = TypeVar("_T")
_StageClass = TypeVar("_StageClass", bound=type)

class Fault(NamedTuple):
    file: str
    where: str
    message: str

class InputError(ValueError):
    faults: List[Fault]
    def __init__(self, message: str, faults: Sequence[Tuple[str, str, str]] = ()) -> None: ...

class StageError(RuntimeError): ...

def read_cloud(path: _Path) -> _Array: ...
def write_cloud(path: _Path, cloud: _ArrayLike, encoding: str = "binary") -> None: ...
def xyz(cloud: _Array) -> _Array: ...

_Cloud = Union[_Array, "Cloud", Mapping[str, _ArrayLike], _Path]
_Clouds = Union[Mapping[str, _Cloud], Mapping[str, Sequence[Optional[_Cloud]]], Sequence[Mapping[str, _Cloud]]]

class SceneEstimate:
    scene: str
    pose: Optional[_Array]
    covariance: Optional[_Array]
    observability: Optional[Dict[str, str]]
    reason: str

class CalibratedSensor:
    sensor: str
    accepted: bool
    pose: Optional[_Array]
    covariance: Optional[_Array]
    observability: Optional[Dict[str, str]]
    reasons: List[str]
    advice: List[str]
    nominal: Optional[_Array]
    scenes: List[SceneEstimate]

class GroundPose(NamedTuple):
    roll_rad: float
    pitch_rad: float
    height_m: float
    roll_std_rad: float
    pitch_std_rad: float
    height_std_m: float

class SceneMotion(NamedTuple):
    scene: str
    velocity: _Array
    covariance: _Array

class Calibration:
    @property
    def reference(self) -> str: ...
    @property
    def sensors(self) -> Dict[str, CalibratedSensor]: ...
    @property
    def accepted(self) -> bool: ...
    @property
    def composition(self) -> str: ...
    @property
    def composition_reason(self) -> str: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def unused(self) -> List[str]: ...
    @property
    def motion(self) -> List[SceneMotion]: ...
    @property
    def ground(self) -> Optional[GroundPose]: ...
    def to_format(
        self,
        format: str,
        *,
        with_rejected: bool = False,
        base: Optional[_ArrayLike] = None,
        base_name: str = "base_link",
    ) -> Dict[str, str]: ...
    def save(
        self,
        folder: _Path,
        formats: Union[str, Sequence[str]] = ("csv",),
        *,
        with_rejected: bool = False,
        base: Optional[_ArrayLike] = None,
        base_name: str = "base_link",
    ) -> List[pathlib.Path]: ...

def calibrate(
    clouds: _Clouds,
    *,
    reference: str = "",
    nominal: Optional[Mapping[str, _ArrayLike]] = None,
    pipeline: _Json = "best",
    from_scratch: bool = False,
    columns: Union[None, Sequence[str], Mapping[str, Sequence[str]]] = None,
    seed: int = 1,
    jobs: int = 0,
) -> Calibration: ...
def pipelines() -> List[str]: ...

class Scene:
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def reference(self) -> str: ...
    @property
    def sensors(self) -> List[str]: ...
    @property
    def truth(self) -> Dict[str, _Array]: ...
    @property
    def nominal(self) -> Dict[str, _Array]: ...
    @property
    def initial(self) -> Dict[str, _Array]: ...
    @property
    def clouds(self) -> Dict[str, _Array]: ...
    def cloud(self, sensor: str) -> _Array: ...

def scenes(dataset: Mapping[str, Any], data: Union[_Path, str] = "") -> List[Scene]: ...
def simulate(scenes: int = 1, **parameters: Any) -> List[Scene]: ...

class Result:
    pose: _Array
    information: Optional[_Array]
    covariance: Optional[_Array]
    observability: Optional[Dict[str, str]]
    diagnostics: Dict[str, Dict[str, float]]
    rejection: Optional[str]
    seconds: Dict[str, float]

class Pipeline:
    def __init__(self, pipeline: _Json) -> None: ...
    @property
    def steps(self) -> List[Dict[str, Any]]: ...
    def run(
        self,
        target: _ArrayLike,
        source: _ArrayLike,
        initial: Optional[_ArrayLike] = None,
        *,
        seed: int = 1,
        scene: str = "scene",
        reference: str = "reference",
        sensor: str = "sensor",
        trial: int = 0,
    ) -> Result: ...

class Results:
    folder: str
    complaints: List[str]
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def seed(self) -> int: ...
    @property
    def planned(self) -> int: ...
    @property
    def manifest(self) -> Dict[str, Any]: ...
    @property
    def extrinsics(self) -> Dict[str, Any]: ...
    @property
    def trials(self) -> _Array: ...
    @property
    def poses(self) -> _Array: ...
    @property
    def summary(self) -> _Array: ...
    @property
    def comparisons(self) -> _Array: ...
    @property
    def diagnostics(self) -> _Array: ...
    @property
    def covariances(self) -> _Array: ...
    def trials_frame(self) -> pandas.DataFrame: ...
    def summary_frame(self) -> pandas.DataFrame: ...
    def comparisons_frame(self) -> pandas.DataFrame: ...
    def diagnostics_frame(self) -> pandas.DataFrame: ...
    def covariances_frame(self) -> pandas.DataFrame: ...

def run(
    experiment: _Json,
    out: Union[_Path, str] = "",
    data: Union[_Path, str] = "",
    jobs: int = 0,
    trials: int = 0,
    only: Union[str, Sequence[str]] = (),
    shard: str = "",
    fresh: bool = False,
    same_build: bool = False,
    progress: bool = False,
) -> Results: ...
def load(folder: _Path) -> Results: ...
def starts(experiment: _Json, data: Union[_Path, str] = "", trials: int = 0) -> _Array: ...

class Cloud:
    def __len__(self) -> int: ...
    @property
    def points(self) -> _Array: ...
    @property
    def channels(self) -> Dict[str, _Array]: ...
    def to_array(self) -> _Array: ...
    def nearest(self, points: _ArrayLike, max_distance_m: float = ...) -> Tuple[_Array, _Array]: ...
    def normals(self, neighbours: int) -> _Array: ...
    def once(self, name: str, make: Callable[[], _T]) -> _T: ...

class GroundSplit(NamedTuple):
    normal: _Array
    offset_m: float
    non_ground: Cloud

class Trial(NamedTuple):
    scene: str
    sensor: str
    number: int

class Estimate:
    pose: _Array
    information: Optional[_Array]
    covariance: Optional[_Array]
    observability: Optional[Dict[str, str]]
    rejection: Optional[str]
    diagnostics: Dict[str, float]
    @property
    def target(self) -> Cloud: ...
    @property
    def source(self) -> Cloud: ...
    @property
    def target_ground(self) -> Optional[GroundSplit]: ...
    @property
    def source_ground(self) -> Optional[GroundSplit]: ...
    @property
    def up(self) -> _Array: ...
    @property
    def trial(self) -> Optional[Trial]: ...
    def put(self, name: str, value: Any) -> None: ...
    def get(self, name: str) -> Any: ...

class Rng:
    def bits(self) -> int: ...
    def uniform(self, low: float = 0.0, high: float = 1.0) -> float: ...
    def below(self, count: int) -> int: ...
    def normal(self) -> float: ...
    def numpy(self) -> numpy.random.Generator: ...

class Registration:
    pose: _Array
    rmse_m: float
    inlier_ratio: float
    correspondences: int
    iterations: int
    converged: bool
    information: Optional[_Array]
    def __init__(
        self,
        pose: _ArrayLike,
        rmse_m: float = 0.0,
        inlier_ratio: float = 0.0,
        correspondences: int = 0,
        iterations: int = 0,
        converged: bool = False,
        information: Optional[_ArrayLike] = None,
    ) -> None: ...

class Step:
    kind: str
    def advance(self, estimate: Estimate, rng: Rng) -> Union[Estimate, _ArrayLike]: ...

class RigEstimate:
    failure: str
    @property
    def scenes(self) -> int: ...
    @property
    def estimate(self) -> Estimate: ...
    @property
    def scene(self) -> str: ...
    @property
    def target(self) -> str: ...
    @property
    def source(self) -> str: ...

class RigStep:
    kind: str
    def adjust(self, rig: List[RigEstimate], rng: Rng) -> None: ...

class YawSearch:
    kind: str
    def minimise(self, cost: Callable[[float], float]) -> float: ...

class PoseSearch:
    kind: str
    def minimise(self, cost: Callable[[_ArrayLike], float], start: _Array) -> _ArrayLike: ...

class Preprocessor:
    kind: str
    def apply(self, cloud: _Array) -> _Array: ...

class GroundExtractor:
    kind: str
    def extract(self, cloud: _Array, rng: Rng) -> Tuple[_ArrayLike, float, _ArrayLike]: ...

class Icp:
    kind: str
    def align(self, target: Cloud, source: Cloud, start: _Array) -> Union[Registration, _ArrayLike]: ...

class VolumeScorer:
    kind: str
    def bind(self, target: Cloud, source: Cloud) -> Tuple[Callable[[_Array], int], float]: ...

_Range = Tuple[Optional[float], Optional[float]]

class Parameter(NamedTuple):
    key: str
    type: str
    json: str
    range: _Range
    choices: Tuple[str, ...]
    help: str

class Extra(NamedTuple):
    name: str
    meaning: str
    type: Type[Any]

def number(key: str, default: float, range: _Range = (None, None), *, help: str) -> Parameter: ...
def integer(key: str, default: int, range: _Range = ..., *, help: str) -> Parameter: ...
def boolean(key: str, default: bool, *, help: str) -> Parameter: ...
def text(key: str, default: str, *, help: str) -> Parameter: ...
def choice(key: str, default: str, choices: Sequence[str], *, help: str) -> Parameter: ...
def numbers(key: str, default: Sequence[float], range: _Range = (None, None), *, help: str) -> Parameter: ...
def extra(name: str, meaning: str, type: Type[Any] = object) -> Extra: ...
def stage(
    kind: str,
    name: str,
    *,
    summary: str,
    source: str = "",
    parameters: Sequence[Parameter] = (),
    version: int = 1,
    channels: Sequence[str] = (),
    takes: Sequence[Extra] = (),
    gives: Sequence[Extra] = (),
) -> Callable[[_StageClass], _StageClass]: ...
def help_on(which: str = "", format: str = "text") -> str: ...
