"""Checks the arguments of the public functions."""

from __future__ import annotations

import functools
import inspect
import operator
import os
import reprlib
import typing
from typing import Any, Callable, Sequence, TypeVar, Union

import numpy as np

Path = Union[str, bytes, os.PathLike]
_Function = TypeVar("_Function", bound=Callable)


def instance_of(*types):
    def checked(value):
        if not isinstance(value, types):
            raise TypeError
        return value
    return checked


def _number(value) -> float:
    if isinstance(value, (str, bytes, bytearray, bool)):  # float() would read the text of a number
        raise TypeError
    return float(value)


def _whole(value) -> float:
    if isinstance(value, bool):
        raise TypeError
    return float(operator.index(value))


def _paths(files) -> list[bytes]:
    return [os.fsencode(path)
            for path in ([files] if isinstance(files, (str, bytes, os.PathLike)) else files)]


#: Of the arguments with these annotations: their name in messages, and what makes the values for
#: C++ of them.
KINDS: dict[Any, tuple[str, Callable[[Any], Any]]] = {
    float: ("a number", _number),
    int: ("a whole number", _whole),
    bool: ("True or False", instance_of(bool, np.bool_)),
    str: ("a string", instance_of(str)),
    Path: ("a path", os.fsencode),
    Sequence[float]: ("numbers", lambda values: [_number(value) for value in values]),
    Union[Path, Sequence[Path]]: ("a path or several", _paths),
}


@functools.lru_cache(maxsize=None)
def _kinds_of(function: Callable) -> dict[str, tuple[bool, str, Callable[[Any], Any]]]:
    """Of each argument: whether it may be None, and its kind. Not before the first call, because
    the annotations may name classes that the module defines later."""
    found = {}
    for name, hint in typing.get_type_hints(function).items():
        choices = typing.get_args(hint)
        optional = type(None) in choices
        if optional:
            hint = Union[tuple(choice for choice in choices if choice is not type(None))]
        if name != "return":
            found[name] = (optional, *KINDS[hint])
    return found


def checked(function: _Function) -> _Function:
    """Converts the arguments of a public function by their annotations. A wrong one is a TypeError
    with its name, not one about the class in C++ that it would go to."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def call(*arguments, **keywords):
        try:
            bound = signature.bind(*arguments, **keywords)
        except TypeError as wrong:
            raise TypeError(f"{function.__name__}(): {wrong}") from None
        bound.apply_defaults()
        for name, (optional, words, convert) in _kinds_of(function).items():
            value = bound.arguments[name]
            if optional and value is None:
                continue
            try:
                bound.arguments[name] = convert(value)
            except (TypeError, ValueError, OverflowError):
                raise TypeError(f"{name}: expected {words}, found {reprlib.repr(value)}") from None
        return function(*bound.args, **bound.kwargs)

    return typing.cast(_Function, call)
