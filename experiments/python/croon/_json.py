"""Arguments given as JSON (dicts, text and files), and checks of arguments."""

import json
import operator
import os

import numpy

from ._errors import InputError


def _plain(value):
    """Converts values that json cannot write: NumPy numbers and arrays, and paths."""
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{type(value).__name__} is not a JSON type")


def text_of(value, name):
    """The JSON text of `value`; errors call it `name`."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise refusal(name, f"expected JSON values, but {error}") from None


def text_and_name(value, name):
    """Returns (text, name) for a dict, a list or JSON text; (None, path) for a path."""
    if isinstance(value, (dict, list, tuple)):
        return text_of(value, name), name
    if isinstance(value, str) and value.lstrip()[:1] in ("{", "["):
        return word(value, name), name
    if isinstance(value, (str, os.PathLike)):
        return None, path_of(value, name)
    raise refusal(name, f"expected a dict, JSON text or a path, found {with_article(value)}")


def path_of(value, name):
    """Returns the path `value` as text, or raises InputError."""
    try:
        path = os.fspath(value)
    except TypeError:
        path = None
    if not isinstance(path, str) or not path or "\0" in path or not _is_utf8(path):
        raise refusal(name, f"expected a path, found {value!r:.60}")
    return path


def whole(value, name, low, high):
    """Returns the whole number `value`; raises InputError unless it is from `low` to `high`."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or isinstance(value, bool) or not low <= number <= high:
        raise refusal(name, f"expected a whole number from {low} to {high}, found {value!r:.60}")
    return number


def word(value, name):
    """Returns the text `value`, or raises InputError."""
    if not isinstance(value, str):
        raise refusal(name, f"expected a string, found {with_article(value)}")
    if not _is_utf8(value):
        raise refusal(name, f"expected text that UTF-8 can encode, found {value!r:.60}")
    return value


def refusal(where, message):
    """An InputError with one fault."""
    return InputError(f"{where}: {message}", [("", where, message)])


def _is_utf8(text):
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def with_article(value):
    """The type of `value` for messages: "a list", "an int"."""
    name = type(value).__name__
    return ("an " if name[:1].lower() in "aeiou" else "a ") + name
