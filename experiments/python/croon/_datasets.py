"""The scenes of datasets."""

from typing import Any, Dict, List, Mapping

from . import _core
from ._json import path_of, text_of, word
from ._types import Array, Path

__all__ = ["Scene", "scenes", "simulate"]


class Scene:
    """One recording of a rig: a cloud per sensor, and the known poses of the sensors.

    A pose is `T_reference_sensor`, which maps a point of the sensor to the reference's frame.
    """

    def __init__(self, scene):
        self._scene = scene

    @property
    def name(self) -> str:
        """The scene's name, "000012"."""
        return self._scene.name

    @property
    def kind(self) -> str:
        """The kind of scene, "urban"; empty if unknown."""
        return self._scene.kind

    @property
    def reference(self) -> str:
        """The name of the sensor that the others are calibrated to."""
        return self._scene.reference

    @property
    def sensors(self) -> List[str]:
        """The names of the other sensors."""
        return self._scene.sensors

    @property
    def truth(self) -> Dict[str, Array]:
        """The ground truth poses by sensor; sensors without a known pose are omitted."""
        return self._scene.truth

    @property
    def nominal(self) -> Dict[str, Array]:
        """The nominal poses of the rig's design by sensor."""
        return self._scene.nominal

    @property
    def initial(self) -> Dict[str, Array]:
        """The initial poses of the recording by sensor."""
        return self._scene.initial

    def cloud(self, sensor: str) -> Array:
        """The cloud of a sensor, or of the reference, in the form of `read_cloud`. It is read or simulated at each call."""
        return self._scene.cloud(word(sensor, "sensor"))

    @property
    def clouds(self) -> Dict[str, Array]:
        """The clouds of all sensors and of the reference by name."""
        return {name: self._scene.cloud(name) for name in [self.reference, *self.sensors]}

    def __repr__(self):
        return f"<croon.Scene {self.name} {self.kind}: {', '.join([self.reference, *self.sensors])}>"


def scenes(dataset: Mapping[str, Any], data: Path = "") -> List[Scene]:
    """Returns the scenes of a dataset, described as in an experiment: {"type": "opencalib", "path": "opencalib/real"}.

    `data` is the data root; by default the folder CROON_DATA, else data. Raises InputError.
    """
    data = path_of(data, "data") if data else ""
    return [Scene(scene) for scene in _core.scenes(text_of(dataset, "dataset"), "dataset", data)]


def simulate(scenes: int = 1, **parameters: Any) -> List[Scene]:
    """Simulates road scenes, with the same points, to the last bit, as the dataset "simulated" of an experiment.

    The parameters are those of the dataset: rig, mix, noise, seed, first_scene; ``print(croon.help_on("dataset/simulated"))``
    lists them. A scene is built when its first cloud is requested. Returns a list of `Scene`. Raises InputError.

        scene, = croon.simulate(rig="croon_five", mix={"urban": 1}, noise="real", seed=3)
        top, left = scene.cloud("top"), scene.cloud("left")
        scene.truth["left"]
    """
    text = text_of({"type": "simulated", "scenes": scenes, **parameters}, "simulate")
    return [Scene(scene) for scene in _core.scenes(text, "simulate", "")]
