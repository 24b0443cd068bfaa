"""Calibration of a rig from clouds in memory."""

import collections.abc
import dataclasses
import os
import pathlib
from typing import Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy

from . import _core
from ._clouds import read_cloud
from ._json import path_of, refusal, text_and_name, whole, with_article, word
from ._types import Array, ArrayLike, Json, Path

__all__ = [
    "CalibratedSensor", "Calibration", "GroundPose", "SceneEstimate", "SceneMotion", "calibrate", "pipelines",
]

_Cloud = Union[Array, _core.Cloud, Mapping[str, ArrayLike], Path]
_Clouds = Union[Mapping[str, _Cloud], Mapping[str, Sequence[Optional[_Cloud]]], Sequence[Mapping[str, _Cloud]]]

_DEFAULT_COLUMNS = {3: ("x", "y", "z"), 4: ("x", "y", "z", "intensity")}


@dataclasses.dataclass(frozen=True, eq=False)
class SceneEstimate:
    """The estimate of one sensor's pose in one scene."""

    scene: str
    """The scene's name: its position in the list of scenes."""
    pose: Optional[Array]
    """The pose `T_reference_sensor`, 4×4; None if a step failed."""
    covariance: Optional[Array]
    """The covariance of the pose, 6×6, as in `CalibratedSensor`; None if it was not estimated."""
    observability: Optional[Dict[str, str]]
    """As in `CalibratedSensor`."""
    reason: str
    """Why the pose was rejected or the step failed; empty if accepted."""


@dataclasses.dataclass(frozen=True, eq=False)
class CalibratedSensor:
    """The result for one sensor: one pose from all scenes."""

    sensor: str
    """The sensor's name."""
    accepted: bool
    """The verdict. The pose of a rejected sensor must not be used."""
    pose: Optional[Array]
    """The pose `T_reference_sensor`, 4×4, float64; for a rejected sensor the best guess, or None."""
    covariance: Optional[Array]
    """The covariance of the pose's error, 6×6: roll, pitch, yaw (rad), x, y, z (m) in the reference's frame; or None."""
    observability: Optional[Dict[str, str]]
    """Whether "roll", "pitch", "yaw", "x", "y" and "z" are "determined", "weak" or "unobservable"; None without a
    covariance."""
    reasons: List[str]
    """Why the sensor was rejected; empty if accepted."""
    advice: List[str]
    """What could help; empty if accepted."""
    nominal: Optional[Array]
    """The given nominal pose `T_reference_sensor`, 4×4; or None."""
    contradicted: bool
    """Whether the clouds contradict the pose: the fit check, independent of the verdict, moves the surfaces by more than
    15 mm. Do not use the pose unchecked."""
    scenes: List[SceneEstimate]
    """The estimates in each scene, in the order of the scenes."""

    def __repr__(self):
        return f"<croon.CalibratedSensor {self.sensor}: {'accepted' if self.accepted else 'rejected'}>"


class GroundPose(NamedTuple):
    """The reference's pose above the road, from its own ground plane, with standard deviations."""

    roll_rad: float
    pitch_rad: float
    height_m: float
    roll_std_rad: float
    pitch_std_rad: float
    height_std_m: float


class SceneMotion(NamedTuple):
    """The velocity of the reference in one scene, in its own frame."""

    scene: str
    velocity: Array
    """About x, y, z in rad/s, along x, y, z in m/s; zero if the rig stood still."""
    covariance: Array
    """The covariance of the velocity, 6×6."""


class Calibration:
    """A rig's calibration, as `calibrate` returns it. ``print`` shows the verdicts first."""

    def __init__(self, rig):
        self._rig = rig
        self._sensors = {
            fields[0]: CalibratedSensor(*fields[:-1], [SceneEstimate(*scene) for scene in fields[-1]])
            for fields in rig.sensors()}

    @property
    def reference(self) -> str:
        """The name of the sensor that the others were calibrated to."""
        return self._rig.reference

    @property
    def sensors(self) -> Dict[str, CalibratedSensor]:
        """A `CalibratedSensor` for each of the other sensors, by name."""
        return self._sensors

    @property
    def accepted(self) -> bool:
        """Whether every sensor was accepted."""
        return all(sensor.accepted for sensor in self.sensors.values())

    @property
    def composition(self) -> str:
        """The pipeline that was used: a name of `pipelines`, or the file's."""
        return self._rig.composition

    @property
    def composition_reason(self) -> str:
        """Why this pipeline was chosen; empty if it was requested."""
        return self._rig.composition_reason

    @property
    def warnings(self) -> List[str]:
        """Suspicious properties of the clouds or the result, one sentence each."""
        return self._rig.warnings()

    @property
    def unused(self) -> List[str]:
        """The scenes and clouds that were not used, each with the reason."""
        return self._rig.unused()

    @property
    def motion(self) -> List[SceneMotion]:
        """A `SceneMotion` for each scene in which a velocity was estimated."""
        return [SceneMotion(*scene) for scene in self._rig.motion()]

    @property
    def ground(self) -> Optional[GroundPose]:
        """The reference's pose above the road, a `GroundPose`; None if no ground was found."""
        ground = self._rig.ground()
        return None if ground is None else GroundPose(*ground)

    def to_format(self, format: str, *, with_rejected: bool = False, base: Optional[ArrayLike] = None,
                  base_name: str = "base_link") -> Dict[str, str]:
        """The extrinsics as files of a format, a dict of texts by file name.

        `format` is a format of ``croon calibrate --format``: "ros2", "urdf", "autoware", "kalibr", "csv" and others.
        Rejected sensors are left out unless `with_rejected` is true, and then marked if the format supports it; "csv"
        always includes them, with their verdict. `base` is the reference's pose in the vehicle frame `base_name`, 4×4:
        poses are then in that frame, and the reference is one of the sensors. Raises InputError.
        """
        return self._rig.files(word(format, "format"), bool(with_rejected), word(base_name, "base_name"), base)

    def save(self, folder: Path, formats: Union[str, Sequence[str]] = ("csv",), *, with_rejected: bool = False,
             base: Optional[ArrayLike] = None, base_name: str = "base_link") -> List[pathlib.Path]:
        """Writes the files of `formats` and ``report.txt``, the ``str()`` of this object, to `folder`.

        The folder is created if it does not exist. The arguments are those of `to_format`. Returns the paths of the
        files. Raises InputError before anything is written for a wrong argument, and OSError if a file cannot be written.
        """
        folder = pathlib.Path(path_of(folder, "folder"))
        texts = {"report.txt": f"{self}\n"}
        for format in [formats] if isinstance(formats, str) else formats:
            texts.update(self.to_format(format, with_rejected=with_rejected, base=base, base_name=base_name))
        for name, text in texts.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, encoding="utf-8")
        return [folder / name for name in texts]

    def __str__(self):
        return self._rig.text().rstrip()

    def __repr__(self):
        verdicts = ", ".join(f"{name} {'accepted' if sensor.accepted else 'rejected'}"
                             for name, sensor in self.sensors.items())
        return f"<croon.Calibration to {self.reference}: {verdicts}>"


def calibrate(clouds: _Clouds, *, reference: str = "", nominal: Optional[Mapping[str, ArrayLike]] = None, pipeline: Json = "best",
              from_scratch: bool = False, columns: Union[None, Sequence[str], Mapping[str, Sequence[str]]] = None, seed: int = 1,
              jobs: int = 0, at_rest: bool = False) -> Calibration:
    """Calibrates the LiDARs of a vehicle to each other, as the command `croon calibrate` does.

    `clouds` is one scene, a dict of clouds by the sensor's name; or several scenes of the same rig, a list of such dicts
    or a dict of lists with a cloud per scene, None for a missing one. Several scenes give one pose per sensor.

    A cloud is an N×3 or N×4 array (x, y, z and intensity) of float32 or float64; an N×k array with the column names
    `columns` ("_" to ignore a column); a structured array or a dict of arrays with x, y, z and channels (intensity, ring,
    time); a `Cloud`; or the path of a file. Points that are not finite, or exactly zero, are dropped. Times are seconds,
    or nanoseconds if they are integers. An array of shape H×W×k is read as N×k. `columns` may be a dict by sensor.

    `reference` names the sensor that the others are calibrated to, the first one by default. No initial guess is needed.
    `nominal` is a dict of known poses `T_reference_sensor` by sensor, 4×4, for comparison, and as initial guesses for
    sensors rejected without one; with `from_scratch` only for comparison. If it includes the reference, all its poses are
    in another frame, such as the vehicle's.
    With `at_rest` the vehicle is known to stand: times are not used, and no motion is looked for.
    `pipeline` is a name of `pipelines`, the path of a file, or a pipeline as `Pipeline` accepts it. `jobs` is the number
    of threads, 0 for all cores; the result has the same bits for any number. Other Python threads can run meanwhile.

    Returns a `Calibration`. Raises InputError for wrong arguments and if no scene has two usable clouds.

        calibration = croon.calibrate({"top": top, "left": left})
        print(calibration)
        if calibration.sensors["left"].accepted:
            points_in_top = left @ calibration.sensors["left"].pose[:3, :3].T + calibration.sensors["left"].pose[:3, 3]
    """
    scenes = _scenes(clouds)
    sensors = list(dict.fromkeys(name for scene in scenes for name in scene))
    reference = word(reference, "reference") or (sensors[0] if sensors else "")
    if reference not in sensors or len(sensors) < 2:
        raise refusal("reference" if len(sensors) > 1 else "clouds",
                      f"expected one of {', '.join(sensors)}, found {reference!r:.60}" if len(sensors) > 1 else
                      f"expected clouds of at least two sensors, found {len(sensors)}")
    usable, unused = _usable(scenes, reference, columns)
    text, name = (None, pipeline) if isinstance(pipeline, str) and pipeline in pipelines() else text_and_name(
        pipeline, "pipeline")
    rig = _core.calibrate_rig(usable, _nominal(nominal, sensors), {
        "reference": reference, "unused": unused,
        "pipeline": name, "text": text, "from_scratch": bool(from_scratch), "at_rest": bool(at_rest), "seed": whole(seed, "seed", 0, 2**64 - 1),
        "jobs": whole(jobs, "jobs", 0, _core.MAX_JOBS)})
    return Calibration(rig)


def pipelines() -> List[str]:
    """The names of the recommended pipelines, which `calibrate` accepts."""
    return _core.pipelines()


def _scenes(clouds):
    """Converts all supported forms of `clouds` to a list of dicts."""
    if isinstance(clouds, collections.abc.Mapping):
        lists = [isinstance(cloud, (list, tuple)) for cloud in clouds.values()]
        if not any(lists):
            scenes = [clouds]
        else:
            lengths = {name: len(cloud) if is_list else None for (name, cloud), is_list in zip(clouds.items(), lists)}
            if len(set(lengths.values())) > 1:
                found = ", ".join(f"{name}: {'one cloud' if count is None else count}" for name, count in lengths.items())
                raise refusal("clouds", f"expected a list of the same length for each sensor, found {found}")
            scenes = [dict(zip(clouds, scene)) for scene in zip(*clouds.values())]
    elif isinstance(clouds, (list, tuple)):
        scenes = list(clouds)
    else:
        raise refusal("clouds", f"expected a dict of clouds by sensor or a list of such dicts, found {with_article(clouds)}")
    for index, scene in enumerate(scenes):
        if not isinstance(scene, collections.abc.Mapping):
            raise refusal(f"clouds[{index}]", f"expected a dict of clouds by sensor, found {with_article(scene)}")
        for name in scene:
            if not word(name, f"clouds[{index}]"):
                raise refusal(f"clouds[{index}]", "expected the name of a sensor, found an empty string")
    return [{name: cloud for name, cloud in scene.items() if cloud is not None} for scene in scenes]


def _usable(scenes, reference, columns):
    """The scenes for _core.calibrate_rig, and a sentence for each that cannot be used."""
    usable, unused = [], []
    for index, scene in enumerate(scenes):
        entries = []
        for name in [reference, *(name for name in scene if name != reference)]:
            if name in scene:
                where = name if len(scenes) == 1 else f"clouds[{index}][{name!r}]"
                of_sensor = columns.get(name) if isinstance(columns, collections.abc.Mapping) else columns
                entries.append((name, where, _array(scene[name], of_sensor, where)))
        if reference not in scene:
            unused.append(f"Scene {index}: no cloud of the reference {reference}.")
        elif len(entries) < 2:
            unused.append(f"Scene {index}: no cloud besides that of {reference}.")
        else:
            usable.append((str(index), entries))
    if not usable:
        raise refusal("clouds", f"expected a scene with clouds of the reference {reference} and of another sensor, found none")
    return usable, unused


def _array(cloud, columns, where):
    """Converts a cloud to a form that _core accepts: an N×3 or a structured array."""
    if isinstance(cloud, (str, os.PathLike)):
        return read_cloud(cloud)
    if isinstance(cloud, _core.Cloud):
        return cloud.to_array()
    if isinstance(cloud, collections.abc.Mapping):
        return _joined({name: numpy.asarray(values) for name, values in cloud.items()}, where)
    if not isinstance(cloud, numpy.ndarray):
        raise refusal(where, f"expected a NumPy array, a dict of arrays, a Cloud or a path, found {with_article(cloud)}")
    if cloud.dtype.names:
        return cloud.reshape(-1)
    if isinstance(cloud, numpy.ma.MaskedArray) or cloud.dtype.kind != "f" or cloud.ndim not in (2, 3):
        return cloud  # _core reports the error.
    rows = cloud.reshape(-1, cloud.shape[-1]) if cloud.ndim == 3 else cloud
    if columns is not None and not isinstance(columns, (list, tuple)):
        raise refusal("columns", f"expected a list of names, found {with_article(columns)}")
    names = _DEFAULT_COLUMNS.get(rows.shape[1]) if columns is None else [word(name, "columns") for name in columns]
    if names is None:
        raise refusal(where, f"expected columns=(\"x\", \"y\", \"z\", …) with the names of the {rows.shape[1]} columns, found none")
    kept = [name for name in names if name != "_"]
    if len(names) != rows.shape[1] or len(set(kept)) != len(kept) or not {"x", "y", "z"} <= set(kept):
        raise refusal(where, f"expected {rows.shape[1]} different columns with x, y and z, found {', '.join(names)}")
    if list(names) == ["x", "y", "z"]:
        return rows
    return _joined({name: rows[:, i] for i, name in enumerate(names) if name != "_"}, where)


def _joined(columns, where):
    """A structured array made from named arrays of the same length."""
    lengths = {len(values) if values.ndim == 1 else -1 for values in columns.values()}
    if not {"x", "y", "z"} <= set(columns) or len(lengths) != 1 or -1 in lengths:
        raise refusal(where, "expected arrays of the same length with x, y and z, found "
                      + (", ".join(f"{name} {values.shape}" for name, values in columns.items()) or "none"))
    joined = numpy.empty(lengths.pop(), [(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        joined[name] = values
    return joined


def _nominal(nominal, sensors):
    """The poses T_reference_sensor by sensor."""
    if nominal is None:
        return {}
    if not isinstance(nominal, collections.abc.Mapping):
        raise refusal("nominal", f"expected a dict of 4×4 poses by sensor, found {with_article(nominal)}")
    known = {name: pose for name, pose in nominal.items() if name in sensors}
    if nominal and not known:
        raise refusal("nominal", f"expected poses of {', '.join(sensors)}, found only of {', '.join(map(str, nominal)):.60}")
    return known
