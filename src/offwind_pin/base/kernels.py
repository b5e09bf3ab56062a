"""Numerical kernels: small functions on arrays and numbers, compiled by Numba on first use.

The machine code is kept between runs in the user's cache, in a folder named by a hash of every
kernel's source: Numba looks at one file's date only, and would go on using an old kernel that a new
one calls. Divisions follow NumPy: by zero they give infinity or NaN.
"""

from __future__ import annotations

import hashlib
import logging
import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache, cached_property
from pathlib import Path
from typing import Any, TypeVar, cast

from numba import config, njit
from numba.core.errors import NumbaExperimentalFeatureWarning
from numba.typed import List

_log = logging.getLogger(__name__)

Function = TypeVar("Function", bound=Callable[..., Any])


def kernel(function: Function) -> Function:
    """The function, compiled for the types it is called with."""
    with _own_cache():
        return cast("Function", njit(cache=True, error_model="numpy")(function))


class ExchangeableKernel:
    """A function compiled for one signature, so that others of that signature can stand in for it.

    It is compiled when first called from Python or handed to compiled code (``compiled``).
    """

    def __init__(self, function: Callable[..., Any], signature: Any) -> None:
        self._function = function
        self._signature = signature
        self.__doc__ = function.__doc__

    @cached_property
    def compiled(self) -> Any:
        with _own_cache():
            return njit(self._signature, cache=True, error_model="numpy")(self._function)

    def __call__(self, *arguments: Any) -> Any:
        return self.compiled(*arguments)


def exchangeable(signature: Any) -> Callable[[Callable[..., Any]], ExchangeableKernel]:
    """Decorator that makes an :class:`ExchangeableKernel` of a function."""
    return lambda function: ExchangeableKernel(function, signature)


def compiled_list(items: Sequence[Any]) -> Any:
    """Exchangeable kernels of one signature, or arrays of one type, as a list for compiled code.

    Numba looks at every item of a tuple whenever it is passed on, and compiles for each length; it
    does neither for its own lists. There must be one item at least.
    """
    ready = [item.compiled if isinstance(item, ExchangeableKernel) else item for item in items]
    with exchanging_kernels():
        result = _begin_list((ready[0], ready[0]))
        for item in ready[1:]:
            _append(result, (item, item))
    return result


def announce() -> None:
    """Tell in the log that compiling takes a while, where nothing compiled is kept yet."""
    if not any(_cache_directory().rglob("*.nbi")):
        _log.info("compiling for this machine; it takes half a minute, and is kept for later runs")


@contextmanager
def exchanging_kernels() -> Iterator[None]:
    """Calls with exchangeable kernels among their arguments; Numba calls that experimental."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NumbaExperimentalFeatureWarning)
        yield


@contextmanager
def _own_cache() -> Iterator[None]:
    """Numba's cache directory, ours for the kernels made in the block."""
    before = config.CACHE_DIR  # type: ignore[attr-defined]
    config.CACHE_DIR = str(_cache_directory())  # type: ignore[attr-defined]
    try:
        yield
    finally:
        config.CACHE_DIR = before  # type: ignore[attr-defined]


@cache
def _cache_directory() -> Path:
    root = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    package = Path(__file__).parent
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        text = path.read_bytes()
        if b"offwind_pin.base.kernels" in text:
            digest.update(path.relative_to(package).as_posix().encode() + b"\0" + text)
    return root / "offwind-pin" / digest.hexdigest()[:16]


# A lone kernel would have a type of its own; a pair of them has that of their signature.


@kernel
def _begin_list(pair: tuple[Any, Any]) -> Any:
    items = List()
    items.append(pair[0])
    return items


@kernel
def _append(items: Any, pair: tuple[Any, Any]) -> None:
    items.append(pair[0])
