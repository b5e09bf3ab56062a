"""Hashes of content: equal for equal objects in any process, different if any number differs."""

from __future__ import annotations

import dataclasses
import hashlib
import inspect
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

_PACKAGE = __name__.partition(".")[0]


class NoFingerprintError(TypeError):
    """Something whose content cannot be hashed, such as a function or an open file."""


def content_hash(*values: object) -> str:
    """SHA-256 of the content of values, at any depth.

    The hash covers numbers, strings, arrays and containers of them, files by their content, and
    objects by their class and attributes, or by their method ``fingerprint`` if they have one. For
    a class from outside the package it also covers the source.

    Raises
    ------
    NoFingerprintError
        A value of another kind.
    """
    digest = hashlib.sha256()
    for value in values:
        _feed(digest, value, [])
    return digest.hexdigest()


@cache
def package_digest() -> str:
    """SHA-256 of the sources of this package."""
    package = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        digest.update(path.relative_to(package).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def _feed(digest: Any, value: Any, inside: list[object]) -> None:
    """Add a value to a digest; inside : the objects that it is part of."""
    if value is None or isinstance(value, bool | int | float | complex | str | bytes):
        digest.update(f"{type(value).__name__}:{value!r};".encode())
    elif isinstance(value, np.ndarray | np.generic):
        array = np.asarray(value)
        if array.dtype.hasobject:
            raise NoFingerprintError("an array of objects")
        digest.update(f"array:{array.dtype.str}{array.shape};".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    elif isinstance(value, Path):
        content = value.read_bytes() if value.is_file() else b""
        digest.update(b"file:" + hashlib.sha256(content).digest())
    elif isinstance(value, slice):
        _feed(digest, ("slice", value.start, value.stop, value.step), inside)
    elif isinstance(value, list | tuple):
        digest.update(f"{len(value)} items:".encode())
        for item in value:
            _feed(digest, item, inside)
    elif isinstance(value, dict):
        digest.update(f"{len(value)} keys:".encode())
        for key, item in value.items():
            _feed(digest, (key, item), inside)
    else:
        _feed_object(digest, value, inside)


def _feed_object(digest: Any, value: Any, inside: list[object]) -> None:
    if any(value is outer for outer in inside):
        raise NoFingerprintError(f"a {type(value).__name__} that contains itself")
    if inside and callable(getattr(value, "fingerprint", None)):
        digest.update(str(value.fingerprint()).encode())
        return
    kind = type(value)
    digest.update(f"{kind.__module__}.{kind.__qualname__}:{_source(kind)};".encode())
    for name, item in _attributes(value).items():
        digest.update(f"{name}=".encode())
        _feed(digest, item, [*inside, value])


def _source(kind: type) -> str:
    """Source of a class from outside the package."""
    if kind.__module__.partition(".")[0] == _PACKAGE:
        return ""
    try:
        return inspect.getsource(kind)
    except (OSError, TypeError):
        raise NoFingerprintError(f"a {kind.__qualname__}, whose source is not known") from None


def _attributes(value: Any) -> dict[str, object]:
    """Fields of an object, or its attributes without cached results."""
    kind = type(value)
    if isinstance(value, BaseModel):
        return {name: getattr(value, name) for name in kind.model_fields}
    if dataclasses.is_dataclass(value):
        return {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
    if callable(value) or not hasattr(value, "__dict__"):
        raise NoFingerprintError(f"a {kind.__qualname__}")
    return {
        name: item
        for name, item in vars(value).items()
        if not isinstance(getattr(kind, name, None), cached_property)
    }
