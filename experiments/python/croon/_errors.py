"""The exceptions of croon."""

from typing import List, NamedTuple, Sequence, Tuple

__all__ = ["Fault", "InputError", "StageError"]


class Fault(NamedTuple):
    """One error in an argument or a file."""

    file: str
    """The file, or the name of the argument; empty if neither applies."""
    where: str
    """The position in it: a JSON pointer, a line, a byte."""
    message: str
    """What was expected, and what was found."""


class InputError(ValueError):
    """Invalid arguments or files. The message has a line for each fault."""

    def __init__(self, message: str, faults: Sequence[Tuple[str, str, str]] = ()) -> None:
        super().__init__(message)
        self.faults: List[Fault] = [Fault(*fault) for fault in faults]


class StageError(RuntimeError):
    """A stage cannot process the data: there is no ground, or there are too few correspondences.

    Stages raise it if they cannot continue. In an experiment, the trial is then recorded as failed with this message.
    """
