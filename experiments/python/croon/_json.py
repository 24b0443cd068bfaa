"""What users give as JSON: dicts, text and files; and whole numbers."""

import json
import operator
import os

import numpy

from ._errors import InputError


def _plain(value):
    """What json does not write by itself: numbers and arrays of NumPy, and paths."""
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a {type(value).__name__} is nothing that JSON has")


def text_of(value, name):
    """The JSON text of `value`; `name` is what errors call it."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        fault = ("", name, f"expected what JSON has, but {error}")
        raise InputError(f"{name}: {fault[2]}", [fault]) from None


def text_and_name(value, name):
    """(text, name) of a dict, a list or JSON text; (None, path) of a path."""
    if isinstance(value, (dict, list, tuple)):
        return text_of(value, name), name
    if isinstance(value, str) and value.lstrip()[:1] in ("{", "["):
        return value, name
    if isinstance(value, (str, os.PathLike)):
        return None, path_of(value, name)
    message = f"expected a dict, JSON text or a path, found {_with_article(value)}"
    raise InputError(f"{name}: {message}", [("", name, message)])


def path_of(value, name):
    """The path `value` as text."""
    try:
        path = os.fspath(value)
    except TypeError:
        path = None
    if not isinstance(path, str) or not path or "\0" in path:
        message = f"expected a path, found {value!r:.60}"
        raise InputError(f"{name}: {message}", [("", name, message)])
    return path


def whole(value, name, low, high):
    """The whole number `value`, from `low` to `high`."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or isinstance(value, bool) or not low <= number <= high:
        message = f"expected a whole number from {low} to {high}, found {value!r:.60}"
        raise InputError(f"{name}: {message}", [("", name, message)])
    return number


def word(value, name):
    """The text `value`."""
    if not isinstance(value, str):
        message = f"expected a string, found {_with_article(value)}"
        raise InputError(f"{name}: {message}", [("", name, message)])
    return value


def _with_article(value):
    name = type(value).__name__
    return ("an " if name[:1].lower() in "aeiou" else "a ") + name
