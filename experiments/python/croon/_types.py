"""Types of arguments and results."""

from os import PathLike
from typing import Any, Mapping, Sequence, Union

import numpy
from numpy.typing import ArrayLike

Array = numpy.ndarray
Path = Union[str, "PathLike[str]"]
Json = Union[Mapping[str, Any], Sequence[Any], str, "PathLike[str]"]

__all__ = ["Array", "ArrayLike", "Json", "Path"]
