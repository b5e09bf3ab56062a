"""Soil curves at the nodes of a pile, and the base class of their laws.

A lateral curve gives p in N/m over y in m; the same laws serve t over z and torque over twist. A
law is one class, :class:`SoilCurve`, with its functions of one curve. Compiled code is made for
each law by itself, so that laws from outside the package run at the same speed.
"""

from __future__ import annotations

import hashlib
import inspect
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np
from numba import types
from numba.extending import register_jitable
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import ExchangeableKernel, exchangeable

Indices = NDArray[np.intp]
Places = NDArray[np.intp] | NDArray[np.bool_]
"""Some of the nodes, by number or by a mask."""

ON_BOUNDARY = 1e-9
"""Depths in m that differ by less are the same: heights of nodes carry rounding errors."""


class SoilCurves(ABC):
    """Curves at n nodes, of one law or of several; y >= 0 is the size of the deflection in m."""

    if TYPE_CHECKING:  # fields or properties of the curves themselves

        @property
        def ultimate(self) -> Array:
            """(n,) largest resistance in N/m; infinite where a curve has no end."""

    @property
    @abstractmethod
    def groups(self) -> tuple[tuple[Indices, SoilCurve], ...]:
        """The nodes of each law, rising, with their curves; together they are 0 to n - 1."""

    @abstractmethod
    def at(self, nodes: Places) -> SoilCurves:
        """The curves of some of the nodes, in the order given."""

    def __len__(self) -> int:
        return sum(len(nodes) for nodes, _ in self.groups)

    def secant(self, y: Array) -> Array:
        """(n,) p(y) / y in N/m2, with its limit at y = 0."""
        return self._of_nodes("secant", y)

    def tangent(self, y: Array) -> Array:
        """(n,) dp/dy in N/m2."""
        return self._of_nodes("tangent", y)

    def energy(self, y: Array) -> Array:
        """(n,) integral of p from 0 to y in J/m."""
        return self._of_nodes("energy", y)

    def resistance(self, y: Array) -> Array:
        """(n,) p(y) in N/m."""
        return self.secant(y) * y

    def _of_nodes(self, quantity: str, y: Array) -> Array:
        result = np.empty(len(y))
        for nodes, curves in self.groups:
            values = np.empty(len(nodes))
            kernel = getattr(_evaluators(type(curves)), quantity)
            kernel(curves.parameters, np.ascontiguousarray(y[nodes], dtype=float), values)
            result[nodes] = values
        return result


class SoilCurve(SoilCurves):
    """A law of soil curves: base class of those of the package and of a user's own.

    A law is a frozen dataclass whose fields are its parameters, one entry for each of n curves:
    arrays (n,), or (n, m). :attr:`parameters` has them side by side, in the order of the fields,
    and the three static functions get a row of it. They are compiled by Numba: what they call must
    be NumPy's or the standard library's mathematics, or :func:`numba.njit` functions. A field or
    property ``ultimate`` gives the largest resistance.

    The curve must start at the origin, and neither stiffness may be negative.
    """

    @staticmethod
    @abstractmethod
    def secant_at(parameters: Array, y: float) -> float:
        """p(y) / y of one curve in N/m2 at y >= 0, at y = 0 the initial stiffness."""

    @staticmethod
    @abstractmethod
    def tangent_at(parameters: Array, y: float) -> float:
        """dp/dy of one curve in N/m2 at y >= 0."""

    @staticmethod
    @abstractmethod
    def energy_at(parameters: Array, y: float) -> float:
        """Integral of p from 0 to y >= 0 of one curve in J/m."""

    @property
    def parameters(self) -> Array:
        """(n, c) parameters of each curve."""
        return np.ascontiguousarray(np.column_stack(self._fields()), dtype=float)

    @property
    def corners(self) -> Array | None:
        """(n, m) deflections between which the curves are straight; None unless they are that."""
        return None

    @property
    def groups(self) -> tuple[tuple[Indices, SoilCurve], ...]:
        return ((np.arange(len(self)), self),)

    def at(self, nodes: Places) -> Self:
        return self._made_of([values[nodes] for values in self._fields()])

    def __len__(self) -> int:
        return len(self._fields()[0])

    def _fields(self) -> list[Array]:
        return [getattr(self, field.name) for field in fields(self)]  # type: ignore[arg-type]

    def _made_of(self, values: Iterable[Array]) -> Self:
        names = [field.name for field in fields(self)]  # type: ignore[arg-type]
        return replace(self, **dict(zip(names, values, strict=True)))  # type: ignore[type-var]

    def _joined(self, others: Sequence[SoilCurve]) -> Self:
        """These curves followed by others of the same law."""
        parts = [self._fields(), *(other._fields() for other in others)]
        return self._made_of([np.concatenate(values) for values in zip(*parts, strict=True)])


@dataclass(frozen=True, eq=False)
class MixedCurves(SoilCurves):
    """Curves of several laws at n nodes; made by :func:`stack_curves`."""

    parts: tuple[tuple[Indices, SoilCurve], ...]

    @property
    def groups(self) -> tuple[tuple[Indices, SoilCurve], ...]:
        return self.parts

    @property
    def ultimate(self) -> Array:
        result = np.empty(len(self))
        for nodes, curves in self.groups:
            result[nodes] = curves.ultimate
        return result

    def at(self, nodes: Places) -> SoilCurves:
        chosen = np.arange(len(self))[nodes]
        parts = []
        for members, curves in self.groups:
            places = np.flatnonzero(np.isin(chosen, members))
            if len(places):
                parts.append((places, curves.at(np.searchsorted(members, chosen[places]))))
        return stack_curves(parts)


def stack_curves(parts: Sequence[tuple[Indices, SoilCurves]]) -> SoilCurves:
    """Curves of different laws as one.

    parts : for each the places (m,) of its m curves in the result, and the curves; the places of
        all of them together are 0 to n - 1
    """
    alike: dict[tuple[type[SoilCurve], int], list[tuple[Indices, SoilCurve]]] = {}
    for places, curves in parts:
        for nodes, law in curves.groups:
            key = type(law), law.parameters.shape[1]
            alike.setdefault(key, []).append((places[nodes], law))
    groups = []
    for members in alike.values():
        nodes = np.concatenate([places for places, _ in members])
        order = np.argsort(nodes)
        first, *others = (law for _, law in members)
        groups.append((nodes[order], first._joined(others).at(order)))
    return groups[0][1] if len(groups) == 1 else MixedCurves(tuple(groups))


class LawFunctions(NamedTuple):
    """Functions of one law, for the kernels that are made of them."""

    secant: Callable[[Array, float], float]
    tangent: Callable[[Array, float], float]
    energy: Callable[[Array, float], float]
    source: str  # digest of the law's file, for Numba's cache


@cache
def law_functions(law: type[SoilCurve]) -> LawFunctions:
    """The functions of a law, ready to be called from compiled code.

    Kernels are functions inside a function that takes these as arguments. Numba keeps their machine
    code by what they refer to, a law's functions by their names: the digest tells a law that
    was changed from what it was. Laws of the package need none, as their cache has a folder of
    its own for each state of the package.
    """
    ready: Any = register_jitable(error_model="numpy", _nrt=True)
    return LawFunctions(
        ready(law.secant_at), ready(law.tangent_at), ready(law.energy_at), _source(law)
    )


def _source(law: type[SoilCurve]) -> str:
    if law.__module__.partition(".")[0] == __name__.partition(".")[0]:
        return ""
    try:
        path = inspect.getsourcefile(law)
        text = b"" if path is None else Path(path).read_bytes()
    except (OSError, TypeError):  # typed at a prompt: Numba looks at the functions themselves
        return ""
    return hashlib.sha256(text).hexdigest()


class _Evaluators(NamedTuple):
    secant: ExchangeableKernel
    tangent: ExchangeableKernel
    energy: ExchangeableKernel


@cache
def _evaluators(law: type[SoilCurve]) -> _Evaluators:
    functions = law_functions(law)
    made = (_over_nodes(function, functions.source) for function in functions[:3])
    return _Evaluators(*made)


_evaluator = exchangeable(
    types.void(types.float64[:, ::1], types.float64[::1], types.float64[::1]), nogil=True
)


def _over_nodes(function: Callable[[Array, float], float], source: str) -> ExchangeableKernel:
    @_evaluator
    def over_nodes(parameters: Array, y: Array, result: Array) -> None:
        _source = source
        for i in range(len(y)):
            result[i] = function(parameters[i], y[i])

    return over_nodes
