"""Soil curves at the nodes of a pile, and the base class of their laws.

A lateral curve gives p in N/m over y in m; the same laws are used for t over z and torque over
twist. A law is one class, :class:`SoilCurve`, with functions of a single curve. Code is compiled
for each law separately, so that laws from outside the package are as fast.
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
"""Some of the nodes, by index or by a mask."""

ON_BOUNDARY = 1e-9
"""Depths in m that differ by less are equal: heights of nodes have rounding errors."""


class SoilCurves(ABC):
    """Curves at n nodes, of one law or of several; y >= 0 is the size of the deflection in m."""

    if TYPE_CHECKING:  # fields or properties of the curves themselves

        @property
        def ultimate(self) -> Array:
            """(n,) largest resistance in N/m; infinite where a curve has no limit."""

    @property
    @abstractmethod
    def groups(self) -> tuple[tuple[Indices, SoilCurve], ...]:
        """Nodes of each law in increasing order, with their curves; together they are 0 to n -
        1."""

    @abstractmethod
    def at(self, nodes: Places) -> SoilCurves:
        """Curves of some of the nodes, in the order given.

        Parameters
        ----------
        nodes : int array or bool array
            Indices or a mask.

        Returns
        -------
        SoilCurves
        """

    def __len__(self) -> int:
        return sum(len(nodes) for nodes, _ in self.groups)

    def secant(self, y: Array) -> Array:
        """Secant stiffness p(y) / y, with its limit at y = 0.

        Parameters
        ----------
        y : (n,) array, m
            Size of the deflection.

        Returns
        -------
        (n,) array, N/m2
        """
        return self._of_nodes("secant", y)

    def tangent(self, y: Array) -> Array:
        """Tangent stiffness dp/dy.

        Parameters
        ----------
        y : (n,) array, m
            Size of the deflection.

        Returns
        -------
        (n,) array, N/m2
        """
        return self._of_nodes("tangent", y)

    def energy(self, y: Array) -> Array:
        """Integral of p from 0 to y.

        Parameters
        ----------
        y : (n,) array, m
            Size of the deflection.

        Returns
        -------
        (n,) array, J/m
        """
        return self._of_nodes("energy", y)

    def resistance(self, y: Array) -> Array:
        """Resistance p(y).

        Parameters
        ----------
        y : (n,) array, m
            Size of the deflection.

        Returns
        -------
        (n,) array, N/m
        """
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
    """A law of soil curves: base class of the package's laws and of your own.

    A law is a frozen dataclass whose fields are its parameters, one entry for each of n curves:
    arrays (n,), or (n, m). :attr:`parameters` contains them side by side, in the order of the
    fields, and the three static functions receive one row of it. They are compiled by Numba: they
    may call NumPy, the standard library's mathematics, and :func:`numba.njit` functions. A field or
    property ``ultimate`` gives the largest resistance.

    The curve must start at the origin, and neither stiffness may be negative.
    """

    @staticmethod
    @abstractmethod
    def secant_at(parameters: Array, y: float) -> float:
        """Secant stiffness p(y) / y of one curve; at y = 0 the initial stiffness.

        Parameters
        ----------
        parameters : (c,) array
            Parameters of the curve.
        y : float, m
            Size of the deflection.

        Returns
        -------
        float, N/m2
        """

    @staticmethod
    @abstractmethod
    def tangent_at(parameters: Array, y: float) -> float:
        """Tangent stiffness dp/dy of one curve.

        Parameters
        ----------
        parameters : (c,) array
            Parameters of the curve.
        y : float, m
            Size of the deflection.

        Returns
        -------
        float, N/m2
        """

    @staticmethod
    @abstractmethod
    def energy_at(parameters: Array, y: float) -> float:
        """Integral of p from 0 to y of one curve.

        Parameters
        ----------
        parameters : (c,) array
            Parameters of the curve.
        y : float, m
            Size of the deflection.

        Returns
        -------
        float, J/m
        """

    @property
    def parameters(self) -> Array:
        """(n, c) parameters of each curve."""
        return np.ascontiguousarray(np.column_stack(self._fields()), dtype=float)

    @property
    def corners(self) -> Array | None:
        """(n, m) deflections between which the curves are straight; None for other curves."""
        return None

    @property
    def groups(self) -> tuple[tuple[Indices, SoilCurve], ...]:
        return ((np.arange(len(self)), self),)

    def at(self, nodes: Places) -> Self:
        """Curves of some of the nodes, in the order given.

        Parameters
        ----------
        nodes : int array or bool array
            Indices or a mask.

        Returns
        -------
        SoilCurve
        """
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
    """Curves of different laws combined.

    parts : for each law the indices (m,) of its m curves in the result, and the curves; all indices
        together are 0 to n - 1
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
    """Functions of one law, for the kernels built from them."""

    secant: Callable[[Array, float], float]
    tangent: Callable[[Array, float], float]
    energy: Callable[[Array, float], float]
    source: str  # digest of the law's file, for Numba's cache


@cache
def law_functions(law: type[SoilCurve]) -> LawFunctions:
    """Functions of a law, callable from compiled code.

    Kernels are functions inside a function that takes these as arguments. Numba's cache identifies
    a law's functions by their names: the digest distinguishes a changed law from the previous one.
    Laws of the package need none, since their cache has its own folder for each state of the
    package.
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
    except (OSError, TypeError):  # typed at a prompt: Numba hashes the functions themselves
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
