"""Clouds and files."""

import numpy

from . import _core
from ._json import path_of, refusal
from ._types import Array, ArrayLike, Path

__all__ = ["read_cloud", "write_cloud", "xyz"]


def read_cloud(path: Path) -> Array:
    """Reads the cloud in a file: .pcd, .ply, or .bin in the format of KITTI.

    Returns a structured array with the fields x, y and z (float32, metres, in the sensor's frame) and a field per
    channel of the file: intensity, ring, time and others, each with its own type. Points that are not finite are dropped.
    Raises InputError if the file cannot be read or is damaged, or if the name of a field is not UTF-8.
    """
    return _core.read_cloud(path_of(path, "path"))


def write_cloud(path: Path, cloud: ArrayLike, encoding: str = "binary") -> None:
    """Writes a cloud, N×3 or structured, as .pcd or .ply.

    `encoding` is binary, ascii or, for PCD, binary_compressed. `read_cloud` then returns exactly the same cloud. Raises
    InputError for another suffix, for a field whose name `read_cloud` would change ("t", "timestamp" and "time_stamp" are
    read as "time", "i" as "intensity", "_" is padding), and if the file cannot be written.
    """
    path = path_of(path, "path")
    known = {".pcd": ("binary", "ascii", "binary_compressed"), ".ply": ("binary", "ascii")}
    suffix = path[path.rfind("."):].lower() if "." in path else ""
    if suffix not in known:
        raise refusal("path", f"expected a file that ends in .pcd or .ply, found {path!r}")
    if encoding not in known[suffix]:
        raise refusal("encoding", f"expected one of {', '.join(known[suffix])}, found {encoding!r:.60}")
    _core.write_cloud(path, cloud, suffix, encoding)


def xyz(cloud: Array) -> Array:
    """Returns the points of a structured array, such as one from `read_cloud`, as an N×3 array of float32; a copy."""
    points = numpy.empty((len(cloud), 3), numpy.float32)
    for axis, name in enumerate("xyz"):
        points[:, axis] = cloud[name]
    return points
