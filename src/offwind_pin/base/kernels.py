"""Numerical kernels: small functions on arrays and numbers, compiled by Numba on first use.

The machine code is kept between runs in the user's cache, in a folder named by a hash of every
kernel's source: Numba looks at one file's date only, and would go on using an old kernel that a new
one calls. Divisions follow NumPy: by zero they give infinity or NaN.

A kernel that calls another one compiles it again as a part of itself. Large ones are therefore
called by address (:class:`ExchangeableKernel`), so that each is compiled once, and only where it is
needed; parts of one large kernel are :func:`inlined` in it.
"""

from __future__ import annotations

import hashlib
import logging
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, cached_property
from pathlib import Path
from typing import Any, TypeVar, cast

from numba import config, njit, types
from numba.core import cgutils, dispatcher
from numba.extending import intrinsic

from offwind_pin.base.kernel_cache import KernelCache

_log = logging.getLogger(__name__)

Function = TypeVar("Function", bound=Callable[..., Any])

_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}
_INNER: dict[str, Any] = _OPTIONS | {"no_cpython_wrapper": True}


def kernel(function: Function) -> Function:
    """The function, compiled for the types it is called with."""
    with _own_cache():
        return cast("Function", njit(nogil=True, **_OPTIONS)(function))


def inner(function: Function) -> Function:
    """The same for a function that only other kernels call."""
    with _own_cache():
        return cast("Function", njit(**_INNER)(function))


def inlined(function: Function) -> Function:
    """The same for a part of one large kernel: it is compiled as if its text was there."""
    with _own_cache():
        return cast("Function", njit(inline="always", **_OPTIONS)(function))


class ExchangeableKernel:
    """A function compiled for one signature, so that others of that signature can stand in for it.

    It is compiled when first called from Python, or when its address is asked for. Compiled code
    calls it by that address (:attr:`KernelKind.call`).
    """

    def __init__(self, function: Callable[..., Any], signature: Any, *, nogil: bool) -> None:
        self._function = function
        self._signature = signature
        self._nogil = nogil
        self.__doc__ = function.__doc__

    @cached_property
    def compiled(self) -> Any:
        with _own_cache():
            return njit(self._signature, nogil=self._nogil, **_OPTIONS)(self._function)

    @cached_property
    def address(self) -> int:
        """Where the machine code is in this process."""
        result = self.compiled.get_compile_result(self._signature)
        return int(result.library.get_pointer_to_function(result.fndesc.llvm_func_name))

    def __call__(self, *arguments: Any) -> Any:
        return self.compiled(*arguments)


class KernelKind:
    """Decorator that makes an :class:`ExchangeableKernel` of a function, for one signature.

    Attributes
    ----------
    signature : of Numba
    nogil : whether a call from Python lets other threads run; not for functions that need Python
    call : for kernels: ``call(address, arguments)`` calls by address with a tuple of arguments
    """

    def __init__(self, signature: Any, *, nogil: bool = False) -> None:
        self.signature = signature
        self.nogil = nogil
        self.call = _caller(signature)

    def __call__(self, function: Callable[..., Any]) -> ExchangeableKernel:
        return ExchangeableKernel(function, self.signature, nogil=self.nogil)


exchangeable = KernelKind


def _caller(signature: Any) -> Any:
    result = signature.return_type

    @intrinsic
    def call(typing: Any, address: Any, arguments: Any) -> Any:
        def lower(context: Any, builder: Any, used: Any, values: Any) -> Any:
            unpacked = cgutils.unpack_tuple(builder, values[1])  # type: ignore[no-untyped-call]
            given = zip(unpacked, arguments, strict=True)
            cast = [
                context.cast(builder, value, kind, expected)
                for (value, kind), expected in zip(given, signature.args, strict=True)
            ]
            convention = context.call_conv
            kind = convention.get_function_type(result, signature.args)
            function = builder.inttoptr(values[0], kind.as_pointer())
            status, value = convention.call_function(
                builder, function, result, signature.args, cast
            )
            with cgutils.if_unlikely(builder, status.is_error):  # type: ignore[no-untyped-call]
                convention.return_status_propagate(builder, status)
            return value

        return result(types.intp, arguments), lower

    return call


def announce() -> None:
    """Tell in the log that compiling takes a while, where nothing compiled is kept yet."""
    if not any(_cache_directory().rglob("*.nbi")):
        _log.info("compiling for this machine; it takes some seconds, and is kept for later runs")


@contextmanager
def _own_cache() -> Iterator[None]:
    """Numba's cache and its directory, ours for the kernels made in the block."""
    settings, dispatchers = cast("Any", config), cast("Any", dispatcher)
    before = settings.CACHE_DIR, dispatchers.FunctionCache
    settings.CACHE_DIR, dispatchers.FunctionCache = str(_cache_directory()), KernelCache
    try:
        yield
    finally:
        settings.CACHE_DIR, dispatchers.FunctionCache = before


@cache
def _cache_directory() -> Path:
    root = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    package = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        text = path.read_bytes()
        if b"offwind_pin.base.kernels" in text or b"offwind_pin.base.records" in text:
            digest.update(path.relative_to(package).as_posix().encode() + b"\0" + text)
    return root / "offwind-pin" / digest.hexdigest()[:16]
