"""What holds the six joints of a root: springs and dashpots, or something of the user's own."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any, Protocol
from weakref import WeakValueDictionary

import numpy as np
from numba import objmode, types

from offwind_pin.compiled import ExchangeableKernel, exchangeable
from offwind_pin.turbines.definition import Array

_ROW, _MATRIX = types.float64[::1], types.float64[:, ::1]

_TWO_NUMBERS: Any = types.UniTuple(types.float64, 2)  # type: ignore[no-untyped-call]

restraint_kernel = exchangeable(_TWO_NUMBERS(_ROW, _ROW, _ROW, _ROW, _MATRIX, _MATRIX))
"""Decorator for ``kernel(displacement, velocity, numbers, reaction, stiffness, damping)``.

It sets reaction (6,) and its derivatives (6, 6), and returns the power that it turns into heat in W
and the energy that it stores in J. numbers holds what is constant.
"""


class RootRestraint(Protocol):
    """What resists the six joints of the root: x, y, z in m, rotations about x, y, z in rad."""

    def reaction(self, displacement: Array, velocity: Array) -> Array:
        """(6,) generalised force that the restraint takes up, in N and N m."""

    def tangents(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        """(6, 6) derivatives of the reaction by displacement and by velocity."""

    def describe(self) -> dict[str, object]:
        """Plain data for the sidecar."""


@restraint_kernel
def _linear(
    displacement: Array,
    velocity: Array,
    numbers: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> tuple[float, float]:
    matrices = numbers.reshape(2, 6, 6)
    lost = stored = 0.0
    for i in range(6):
        elastic = viscous = 0.0
        for j in range(6):
            stiffness[i, j], damping[i, j] = matrices[0, i, j], matrices[1, i, j]
            elastic += stiffness[i, j] * displacement[j]
            viscous += damping[i, j] * velocity[j]
        reaction[i] = elastic + viscous
        stored += elastic * displacement[i] / 2
        lost += viscous * velocity[i]
    return lost, stored


@dataclass(frozen=True, eq=False)
class LinearRestraint:
    """Springs and dashpots: stiffness and damping (6, 6) in N, m, rad and s."""

    stiffness: Array
    damping: Array

    def reaction(self, displacement: Array, velocity: Array) -> Array:
        return self.stiffness @ displacement + self.damping @ velocity

    def tangents(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        return self.stiffness, self.damping

    def describe(self) -> dict[str, object]:
        return {"stiffness": self.stiffness.tolist(), "damping": self.damping.tolist()}


_register: WeakValueDictionary[int, RootRestraint] = WeakValueDictionary()
_numbers = itertools.count()


def _call(
    number: float,
    displacement: Array,
    velocity: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> None:
    restraint = _register[int(number)]
    reaction[:] = restraint.reaction(displacement.copy(), velocity.copy())
    stiffness[:], damping[:] = restraint.tangents(displacement.copy(), velocity.copy())


@restraint_kernel
def _in_python(
    displacement: Array,
    velocity: Array,
    numbers: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> tuple[float, float]:
    with objmode():
        _call(numbers[0], displacement, velocity, reaction, stiffness, damping)
    return 0.0, 0.0


def root_kernel(root: RootRestraint | None) -> tuple[ExchangeableKernel, Array]:
    """Kernel of a restraint and its numbers; of no restraint, one that does nothing."""
    if root is None:
        return _linear, np.zeros(72)
    if isinstance(root, LinearRestraint):
        return _linear, np.concatenate([root.stiffness.ravel(), root.damping.ravel()])
    number = next(_numbers)
    _register[number] = root
    return _in_python, np.array([float(number)])
