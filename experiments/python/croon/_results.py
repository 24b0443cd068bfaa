"""Experiments: running them, and their results."""

import functools
import json
from typing import TYPE_CHECKING, Any, Dict, Sequence, Union

import numpy

from . import _core
from ._json import path_of, text_and_name, whole, word
from ._types import Array, Json, Path

if TYPE_CHECKING:
    import pandas

__all__ = ["Results", "load", "run", "starts"]


class Results:
    """A folder of results, read only from its store.

    Tables are structured arrays with the columns of the files of the same name; missing numbers are NaN. The
    methods that end in `_frame` return them as pandas.DataFrame.
    """

    def __init__(self, results, folder, complaints=()):
        self._results = results
        self.folder = folder
        self.complaints = list(complaints)

    @property
    def name(self) -> str:
        """The experiment's name."""
        return self._results.name

    @property
    def description(self) -> str:
        """The question that the experiment answers."""
        return self._results.description

    @property
    def seed(self) -> int:
        """The experiment's seed."""
        return self._results.seed

    @property
    def planned(self) -> int:
        """The number of trials of the complete experiment; some may be missing."""
        return self._results.planned

    @functools.cached_property
    def manifest(self) -> Dict[str, Any]:
        """The description of the run, a dict: the experiment with all defaults, versions, digests of the inputs."""
        return json.loads(self._results.manifest)

    @functools.cached_property
    def extrinsics(self) -> Dict[str, Any]:
        """The content of extrinsics.json, a dict: the poses that trials agree on."""
        return json.loads(self._results.extrinsics())

    @functools.cached_property
    def trials(self) -> Array:
        """The trials, as in trials.csv, with the reasons of failures and rejections."""
        return self._results.trials()

    @functools.cached_property
    def poses(self) -> Array:
        """The pose `T_reference_sensor` of each of `trials`, N×4×4, float64; NaN without a pose."""
        return self._results.poses()

    @functools.cached_property
    def summary(self) -> Array:
        """The statistics of each variant and sensor, as in summary.csv."""
        return self._results.summary()

    @functools.cached_property
    def comparisons(self) -> Array:
        """Every variant compared with the first one, as in comparison.csv."""
        return self._results.comparisons()

    @functools.cached_property
    def diagnostics(self) -> Array:
        """The diagnostics reported by steps, as in diagnostics.csv."""
        return self._results.diagnostics()

    @functools.cached_property
    def covariances(self) -> Array:
        """The covariance of each result that has one, as in covariance.csv."""
        return self._results.covariances()

    def trials_frame(self) -> "pandas.DataFrame":
        """`trials` as a pandas.DataFrame. Raises ImportError without pandas."""
        return _frame(self.trials)

    def summary_frame(self) -> "pandas.DataFrame":
        """`summary` as a pandas.DataFrame."""
        return _frame(self.summary)

    def comparisons_frame(self) -> "pandas.DataFrame":
        """`comparisons` as a pandas.DataFrame."""
        return _frame(self.comparisons)

    def diagnostics_frame(self) -> "pandas.DataFrame":
        """`diagnostics` as a pandas.DataFrame."""
        return _frame(self.diagnostics)

    def covariances_frame(self) -> "pandas.DataFrame":
        """`covariances` as a pandas.DataFrame."""
        return _frame(self.covariances)

    def __str__(self):
        return self._results.text()

    def __repr__(self):
        return f"<croon.Results {self.name}: {len(self.trials)} trials in {self.folder}>"


def _frame(array):
    import pandas  # Only required for frames.

    return pandas.DataFrame({name: array[name] for name in array.dtype.names})


def _request(experiment, out="", data="", jobs=0, trials=0, only=(), shard=""):
    text, name = text_and_name(experiment, "experiment")
    if isinstance(only, str):
        only = [only]
    return {
        "experiment": name,
        "text": text,
        "out": path_of(out, "out") if out else "",
        "data": path_of(data, "data") if data else "",
        "jobs": whole(jobs, "jobs", 0, _core.MAX_JOBS),
        "trials": whole(trials, "trials", 0, _core.MAX_TRIALS),
        "only": [word(variant, "only") for variant in only],
        "shard": word(shard, "shard"),
    }


def run(experiment: Json, out: Path = "", data: Path = "", jobs: int = 0, trials: int = 0, only: Union[str, Sequence[str]] = (),
        shard: str = "", fresh: bool = False, same_build: bool = False, progress: bool = False) -> Results:
    """Runs the trials of an experiment that are missing in its folder, as the command `croon run` does.

    `experiment` is a dict, JSON text, or the path of a file; paths in a dict are relative to the working directory. The
    other arguments are the options of the command: `out` is the folder (default results/<name>), `data` the data root
    (default CROON_DATA, else data), `jobs` the number of threads (0: all cores), `trials` the number of starts (0: as in
    the experiment), `only` names of variants, `shard` a part "K/N". The files in the folder are identical to those of
    the command, for any number of jobs.

    Returns the `Results` of the folder. `complaints` has a line for each cloud that could not be read. Raises
    InputError. After KeyboardInterrupt, finished trials are in the store, and the same call continues with the rest.
    """
    request = _request(experiment, out, data, jobs, trials, only, shard)
    request.update(fresh=bool(fresh), same_build=bool(same_build), progress=bool(progress))
    folder, complaints = _core.run(request)
    return Results(_core.load(folder), folder, complaints)


def load(folder: Path) -> Results:
    """Reads the results in a folder written by `run`, `croon run` or `croon merge`. Raises InputError."""
    folder = path_of(folder, "folder")
    return Results(_core.load(folder), folder)


def starts(experiment: Json, data: Path = "", trials: int = 0) -> Array:
    """Returns the starts of an experiment, a structured array: scene, sensor, trial, and the pose, 4×4.

    From such a start, with the seed and the names of its trial, `Pipeline.run` computes the same bits as `run`.
    """
    rows = _core.starts(_request(experiment, data=data, trials=trials))
    width = [max((len(row[k]) for row in rows), default=1) for k in (0, 1)]
    fields = [("scene", f"U{width[0]}"), ("sensor", f"U{width[1]}"), ("trial", "i8"), ("pose", "f8", (4, 4))]
    return numpy.array(rows, fields)
