"""Numerical kernels: small functions on arrays and numbers, compiled by Numba on first use.

The machine code is kept between runs in the user's cache, in a folder named by a hash of every
kernel's source: Numba looks at one file's date only, and would go on using an old kernel that a new
one calls. Divisions follow NumPy: by zero they give infinity or NaN.

A kernel that calls another one compiles it again as a part of itself. Large ones are therefore
called by address (:class:`ExchangeableKernel`), so that each is compiled once, and only where it is
needed. Numba takes more than linearly longer for a longer function: several short kernels called
one after another compile faster than one.
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
from numba.core import cgutils, dispatcher, typed_passes, untyped_passes
from numba.core.compiler import CompilerBase, DefaultPassBuilder, Flags
from numba.extending import intrinsic

from offwind_pin.base.kernel_cache import KernelCache

_log = logging.getLogger(__name__)

Function = TypeVar("Function", bound=Callable[..., Any])

_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}

_UNUSED = {
    untyped_passes.InlineClosureLikes,
    untyped_passes.RewriteSemanticConstants,
    untyped_passes.DeadBranchPrune,
    untyped_passes.MakeFunctionToJitFunction,
    untyped_passes.InlineInlinables,
    untyped_passes.FindLiterallyCalls,
    untyped_passes.LiteralUnroll,
    untyped_passes.LiteralPropagationSubPipelinePass,
    typed_passes.NopythonRewrites,
    typed_passes.DumpParforDiagnostics,
}
"""Steps of Numba's compiler for closures, literals, and expressions of whole arrays."""


class _KnownFlags(Flags):
    """Compiler flags whose values are listed once: Numba compares them thousands of times."""

    @cached_property
    def _known(self) -> dict[str, Any]:
        return dict(super().values())  # type: ignore[no-untyped-call]

    def values(self) -> dict[str, Any]:
        return self._known


class _LeanCompiler(CompilerBase):
    """Numba's compiler without the steps that the kernels of this package do not need."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)  # type: ignore[no-untyped-call]
        self.state.flags = _KnownFlags(self.state.flags)  # type: ignore[no-untyped-call]

    def define_pipelines(self) -> list[Any]:
        manager: Any = DefaultPassBuilder.define_nopython_pipeline(self.state)  # type: ignore[no-untyped-call]
        manager.passes = [step for step in manager.passes if step[0] not in _UNUSED]
        manager.finalize()
        return [manager]


_LEAN: dict[str, Any] = _OPTIONS | {"pipeline_class": _LeanCompiler, "_nrt": False}
"""For functions that make no arrays, so that none need be counted."""


def kernel(function: Function) -> Function:
    """The function, compiled for the types it is called with."""
    with _own_cache():
        return cast("Function", njit(nogil=True, **_OPTIONS)(function))


def inner(function: Function) -> Function:
    """The same for a function that only other kernels call; it makes no arrays."""
    with _own_cache():
        return cast("Function", njit(**(_LEAN | {"no_cpython_wrapper": True}))(function))


class ExchangeableKernel:
    """A function compiled for one signature, so that others of that signature can stand in for it.

    It is compiled when first called from Python, or when its address is asked for. Compiled code
    calls it by that address (:attr:`KernelKind.call`).
    """

    def __init__(
        self, function: Callable[..., Any], signature: Any, options: dict[str, Any]
    ) -> None:
        self._function = function
        self._signature = signature
        self._options = options
        self.__doc__ = function.__doc__

    @cached_property
    def compiled(self) -> Any:
        with _own_cache():
            return njit(self._signature, **self._options)(self._function)

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
    options : for Numba
    call : for kernels: ``call(address, arguments)`` calls by address with a tuple of arguments
    """

    def __init__(self, signature: Any, *, nogil: bool = False, python: bool = True) -> None:
        """A kind of kernels.

        Parameters
        ----------
        signature : Numba signature
        nogil : bool
            Whether a call from Python lets other threads run; not for functions that need Python.
        python : bool
            Whether Python calls them, not only other kernels.
        """
        self.signature = signature
        self.options: dict[str, Any] = {"nogil": nogil, "no_cpython_wrapper": not python}
        self.call = _caller(signature)

    def __call__(self, function: Callable[..., Any]) -> ExchangeableKernel:
        lean = function.__module__.partition(".")[0] == __name__.partition(".")[0]
        return self._made(function, _LEAN if lean else _OPTIONS)

    def allocating(self, function: Callable[..., Any]) -> ExchangeableKernel:
        """The same for a function of this package that makes arrays or calls Python."""
        return self._made(function, _OPTIONS)

    def _made(self, function: Callable[..., Any], options: dict[str, Any]) -> ExchangeableKernel:
        return ExchangeableKernel(function, self.signature, options | self.options)


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
