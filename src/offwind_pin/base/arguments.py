"""Arguments of public functions, checked against their annotations before anything is solved."""

from __future__ import annotations

import functools
import inspect
import os
import types
import typing
from collections.abc import Callable, Iterable, Mapping
from numbers import Integral, Real
from typing import Any, Literal, ParamSpec, TypeVar, Union, cast, get_args, get_origin

import numpy as np
from numpy.typing import ArrayLike

from offwind_pin.base.errors import InputError

P = ParamSpec("P")
R = TypeVar("R")

_MOST = 1000
"""Items of a sequence that are looked at."""


def checked(function: Callable[P, R]) -> Callable[P, R]:
    """Refuse arguments of another type than their annotation with an InputError.

    Annotations that are only there for type checkers, and protocols, are not looked at.
    """
    parameters = inspect.signature(function)
    name = function.__qualname__.removesuffix(".__init__")

    @functools.wraps(function)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> R:
        given = parameters.bind(*args, **kwargs).arguments
        for key, hint in _hints(function).items():
            if key in given and not _fits(given[key], hint):
                where = f"{name}(), argument {key}"
                raise InputError(where, given[key], _described(hint), "Correct the call.")
        return function(*args, **kwargs)

    return wrapper


def checked_class(kind: type[R]) -> type[R]:
    """The same for the arguments of a dataclass."""
    made = cast(Any, kind)
    made.__init__ = checked(made.__init__)
    return kind


@functools.cache
def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    """Annotations by argument, those that can be evaluated when the program runs."""
    found = {}
    for name, parameter in inspect.signature(function).parameters.items():
        hint = parameter.annotation
        if isinstance(hint, str):
            try:
                hint = eval(hint, function.__globals__)  # noqa: S307 (our own text)
            except NameError:
                continue
        if hint is not inspect.Parameter.empty and parameter.kind not in (
            inspect.Parameter.VAR_POSITIONAL,
            inspect.Parameter.VAR_KEYWORD,
        ):
            found[name] = hint
    return found


def _fits(value: object, hint: Any) -> bool:
    origin, arguments = get_origin(hint), get_args(hint)
    if origin in (Union, types.UnionType) and hint is not ArrayLike:
        return any(_fits(value, one) for one in arguments)
    if origin is Literal:  # the function itself says which there are
        return isinstance(value, tuple({type(one) for one in arguments}))
    if origin is typing.Annotated:
        return _fits(value, arguments[0])
    if hint in (Any, object):
        return True
    if hint is ArrayLike or np.ndarray in (hint, origin):
        return _is_array(value)
    if hint is None:
        return value is None
    if hint in (bool, int, float):
        return _is_number(value, hint)
    plain = origin or hint
    if not isinstance(plain, type) or getattr(plain, "_is_protocol", False):
        return True
    if issubclass(plain, Mapping):
        return isinstance(value, plain)
    if issubclass(plain, Iterable) and plain is not str:
        return _is_sequence(value, plain, arguments)
    return isinstance(value, plain)


def _described(hint: Any) -> str:
    if hint is ArrayLike:
        return _NAMES["ndarray"]
    origin, arguments = get_origin(hint), get_args(hint)
    if origin in (Union, types.UnionType):
        return " or ".join(_described(one) for one in arguments)
    if origin is Literal:
        return " or ".join(map(repr, arguments))
    if origin is typing.Annotated:
        return _described(arguments[0])
    plain = origin or hint
    name = getattr(plain, "__name__", str(plain))
    if origin is not None and arguments and name in _HOLDERS:
        return f"{_HOLDERS[name]} of {_described(arguments[0])}"
    return _NAMES.get(name, name)


_HOLDERS = {"Sequence": "a sequence", "list": "a list", "tuple": "a tuple"}


_NAMES = {
    "float": "a number",
    "int": "a whole number",
    "bool": "True or False",
    "str": "text",
    "ndarray": "an array of numbers",
    "Sequence": "a sequence",
    "Mapping": "a mapping",
    "NoneType": "None",
}


def _is_number(value: object, hint: type) -> bool:
    if hint is bool:
        return isinstance(value, bool | np.bool_)
    if isinstance(value, np.ndarray) and value.shape == ():
        value = value.item()
    kind = Integral if hint is int else Real
    return isinstance(value, kind) and not isinstance(value, bool | np.bool_)


def _is_array(value: object) -> bool:
    """Whether it is an array of numbers, or lists that NumPy makes one of."""
    if isinstance(value, str | bytes | dict | set) or value is None:
        return False
    try:
        return np.asarray(value).dtype.kind in "biufc"
    except ValueError:  # rows of different lengths
        return False


def _is_sequence(value: object, plain: type, arguments: tuple[Any, ...]) -> bool:
    if isinstance(value, str | bytes | os.PathLike):
        return False
    if isinstance(value, np.ndarray):
        return value.ndim > 0 and plain not in (list, tuple)
    if not isinstance(value, plain):
        return plain is tuple and isinstance(value, list)
    if not isinstance(value, list | tuple) or not arguments:
        return True
    if plain is tuple and arguments[-1] is not Ellipsis:
        return len(value) == len(arguments) and all(map(_fits, value, arguments))
    return all(_fits(item, arguments[0]) for item in value[:_MOST])
