"""The exceptions of croon."""

from typing import List, NamedTuple, Sequence, Tuple


class Fault(NamedTuple):
    """One mistake in what croon was given."""

    file: str
    """The file, or the name of the argument; empty if there is none."""
    where: str
    """The position in it: a JSON pointer, a line, a byte."""
    message: str
    """What was expected, and what was found."""


class InputError(ValueError):
    """What croon was given is wrong. The message has a line for each fault."""

    def __init__(self, message: str, faults: Sequence[Tuple[str, str, str]] = ()):
        super().__init__(message)
        self.faults: List[Fault] = [Fault(*fault) for fault in faults]


class StageError(RuntimeError):
    """The data defeat a stage: there is no ground, there are too few correspondences.

    A stage raises it if it cannot go on. In an experiment, the trial is then recorded as failed with this message.
    """
