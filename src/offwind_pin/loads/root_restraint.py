"""What holds the six joints of a root: springs and dashpots, or something of the user's own."""

from __future__ import annotations

import itertools
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol
from weakref import WeakValueDictionary

import numpy as np
from numba import objmode, types

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import ExchangeableKernel, exchangeable

_ROW, _MATRIX = types.float64[::1], types.float64[:, ::1]

_TWO_NUMBERS: Any = types.UniTuple(types.float64, 2)  # type: ignore[no-untyped-call]

restraint_kernel = exchangeable(_TWO_NUMBERS(_ROW, _ROW, _ROW, _ROW, _ROW, _MATRIX, _MATRIX))
"""Decorator for ``kernel(displacement, velocity, numbers, memory, reaction, stiffness, damping)``.

It sets reaction (6,) and its derivatives (6, 6), and returns the power that it turns into heat in W
and the energy that it stores in J. numbers holds what is constant, memory (m,) what the restraint
keeps of its past, as of the last step.
"""

restraint_commit = exchangeable(types.float64(_ROW, _ROW, _ROW))
"""Decorator for ``kernel(displacement, numbers, memory) -> heat``.

It ends a step: the memory becomes that of the displacement, and what that turned into heat is
returned in J.
"""


class RootRestraint(Protocol):
    """What resists the six joints of the root: x, y, z in m, rotations about x, y, z in rad."""

    def reaction(self, displacement: Array, velocity: Array) -> Array:
        """(6,) generalised force that the restraint takes up, in N and N m."""

    def tangents(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        """(6, 6) derivatives of the reaction by displacement and by velocity."""

    def describe(self) -> dict[str, object]:
        """Plain data for the sidecar."""


@restraint_commit
def nothing_kept_by_root(displacement: Array, numbers: Array, memory: Array) -> float:
    """Of a restraint without memory."""
    return 0.0


class KernelRestraint(ABC):
    """A restraint whose physics is in compiled kernels."""

    reaction_kernel: ClassVar[ExchangeableKernel]
    commit_kernel: ClassVar[ExchangeableKernel] = nothing_kept_by_root

    @property
    @abstractmethod
    def numbers(self) -> Array:
        """(c,) what is constant."""

    @property
    def memory_size(self) -> int:
        """How many numbers the restraint keeps of its past; they are zero at first."""
        return 0

    @abstractmethod
    def describe(self) -> dict[str, object]:
        """Plain data for the sidecar."""

    def reaction(self, displacement: Array, velocity: Array, memory: Array | None = None) -> Array:
        return self._evaluate(displacement, velocity, memory)[0]

    def tangents(
        self, displacement: Array, velocity: Array, memory: Array | None = None
    ) -> tuple[Array, Array]:
        return self._evaluate(displacement, velocity, memory)[1:]

    def commit(self, displacement: Array, memory: Array) -> float:
        """End a step: change the memory (m,) to that of a displacement; heat made in J."""
        return float(self.commit_kernel(displacement, self.numbers, memory))

    def _evaluate(
        self, displacement: Array, velocity: Array, memory: Array | None
    ) -> tuple[Array, Array, Array]:
        past = np.zeros(self.memory_size) if memory is None else memory
        reaction, stiffness, damping = np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6))
        u, v = np.ascontiguousarray(displacement), np.ascontiguousarray(velocity)
        self.reaction_kernel(u, v, self.numbers, past, reaction, stiffness, damping)
        return reaction, stiffness, damping


@restraint_kernel
def _linear(
    displacement: Array,
    velocity: Array,
    numbers: Array,
    memory: Array,
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
class LinearRestraint(KernelRestraint):
    """Springs and dashpots: stiffness and damping (6, 6) in N, m, rad and s."""

    stiffness: Array
    damping: Array

    reaction_kernel = _linear

    @property
    def numbers(self) -> Array:
        return np.concatenate([self.stiffness.ravel(), self.damping.ravel()])

    def describe(self) -> dict[str, object]:
        return {"stiffness": self.stiffness.tolist(), "damping": self.damping.tolist()}


_register: WeakValueDictionary[int, PythonRestraint] = WeakValueDictionary()
_numbers = itertools.count()


def _call(
    number: float,
    displacement: Array,
    velocity: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> None:
    restraint = _register[int(number)].restraint
    reaction[:] = restraint.reaction(displacement.copy(), velocity.copy())
    stiffness[:], damping[:] = restraint.tangents(displacement.copy(), velocity.copy())


@restraint_kernel
def _in_python(
    displacement: Array,
    velocity: Array,
    numbers: Array,
    memory: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> tuple[float, float]:
    with objmode():
        _call(numbers[0], displacement, velocity, reaction, stiffness, damping)
    return 0.0, 0.0


class PythonRestraint(KernelRestraint):
    """A restraint of the user's own, wrapped; it reports no energies."""

    reaction_kernel = _in_python

    def __init__(self, restraint: RootRestraint) -> None:
        self.restraint = restraint
        self._number = next(_numbers)
        _register[self._number] = self

    @property
    def numbers(self) -> Array:
        return np.array([float(self._number)])

    def describe(self) -> dict[str, object]:
        return self.restraint.describe()


_FREE = LinearRestraint(np.zeros((6, 6)), np.zeros((6, 6)))


def as_kernel_restraint(root: RootRestraint | None) -> KernelRestraint:
    """The restraint itself if its physics is compiled, else wrapped; of none, a void one."""
    if root is None:
        return _FREE
    return root if isinstance(root, KernelRestraint) else PythonRestraint(root)
