"""Restraints of the six root joints: springs and dashpots, or a user's own."""

from __future__ import annotations

import itertools
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from weakref import WeakValueDictionary

import numpy as np
from numba import objmode, types

from offwind_pin.base.definition import Array
from offwind_pin.base.fingerprint import content_hash
from offwind_pin.base.kernels import ExchangeableKernel, exchangeable

_ROW, _MATRIX = types.float64[::1], types.float64[:, ::1]

_TWO_NUMBERS: Any = types.UniTuple(types.float64, 2)  # type: ignore[no-untyped-call]

restraint_kernel = exchangeable(_TWO_NUMBERS(_ROW, _ROW, _ROW, _ROW, _ROW, _MATRIX, _MATRIX))
"""Decorator for ``kernel(displacement, velocity, constants, memory, reaction, stiffness, damping)``

It sets reaction (6,) and its derivatives (6, 6), and returns the power in W that it dissipates and
the energy in J that it stores. memory (m,) is the restraint's memory as of the last step.
"""

restraint_commit = exchangeable(types.float64(_ROW, _ROW, _ROW))
"""Decorator for ``kernel(displacement, constants, memory) -> dissipated_energy``.

It ends a step: the memory is updated to the displacement, and the energy in J that the step
dissipated is returned.
"""


@restraint_commit
def nothing_kept_by_root(displacement: Array, constants: Array, memory: Array) -> float:
    """Commit of a restraint without memory."""
    return 0.0


class RootRestraint(ABC):
    """Restrains the six root joints: x, y, z in m, rotations about x, y, z in rad.

    Base class of the package's restraints and of your own.
    """

    @abstractmethod
    def reaction(self, displacement: Array, velocity: Array) -> Array:
        """Generalised force that the restraint resists with.

        Parameters
        ----------
        displacement : (6,) array, m and rad
            Of the root joints.
        velocity : (6,) array, m/s and rad/s

        Returns
        -------
        (6,) array, N and N m
        """

    @abstractmethod
    def tangents(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        """Derivatives of the reaction.

        Parameters
        ----------
        displacement : (6,) array, m and rad
            Of the root joints.
        velocity : (6,) array, m/s and rad/s

        Returns
        -------
        stiffness : (6, 6) array
            By displacement.
        damping : (6, 6) array
            By velocity.
        """

    @abstractmethod
    def describe(self) -> dict[str, object]:
        """Plain data for the sidecar file.

        Returns
        -------
        dict of str to object
        """

    def compiled(self) -> KernelRestraint:
        """The restraint for compiled code.

        Returns
        -------
        KernelRestraint
        """
        return PythonRestraint(self)

    def fingerprint(self) -> str:
        """Hash of everything that determines the reaction, see :meth:`PointLoad.fingerprint`.

        Returns
        -------
        str

        Raises
        ------
        NoFingerprintError
            An attribute that cannot be hashed; the class must then define its own fingerprint.
        """
        return content_hash(self)


class KernelRestraint(RootRestraint):
    """A restraint with compiled kernels."""

    if TYPE_CHECKING:

        @property
        def reaction_kernel(self) -> ExchangeableKernel: ...

        @property
        def commit_kernel(self) -> ExchangeableKernel: ...

    else:
        commit_kernel = nothing_kept_by_root

    @property
    @abstractmethod
    def constants(self) -> Array:
        """(c,) constants."""

    def compiled(self) -> KernelRestraint:
        return self

    @property
    def memory_size(self) -> int:
        """Size of the restraint's memory, which is zero at first."""
        return 0

    def reaction(self, displacement: Array, velocity: Array, memory: Array | None = None) -> Array:
        return self._evaluate(displacement, velocity, memory)[0]

    def tangents(
        self, displacement: Array, velocity: Array, memory: Array | None = None
    ) -> tuple[Array, Array]:
        return self._evaluate(displacement, velocity, memory)[1:]

    def commit(self, displacement: Array, memory: Array) -> float:
        """End a step: update the memory (m,) to a displacement; returns the dissipated energy in
        J."""
        return float(self.commit_kernel(displacement, self.constants, memory))

    def _evaluate(
        self, displacement: Array, velocity: Array, memory: Array | None
    ) -> tuple[Array, Array, Array]:
        past = np.zeros(self.memory_size) if memory is None else memory
        reaction, stiffness, damping = np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6))
        u, v = np.ascontiguousarray(displacement), np.ascontiguousarray(velocity)
        self.reaction_kernel(u, v, self.constants, past, reaction, stiffness, damping)
        return reaction, stiffness, damping


@restraint_kernel
def _linear(
    displacement: Array,
    velocity: Array,
    constants: Array,
    memory: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> tuple[float, float]:
    power = stored = 0.0
    for i in range(6):
        elastic = viscous = 0.0
        for j in range(6):
            stiffness[i, j] = constants[6 * i + j]
            damping[i, j] = constants[36 + 6 * i + j]
            elastic += stiffness[i, j] * displacement[j]
            viscous += damping[i, j] * velocity[j]
        reaction[i] = elastic + viscous
        stored += elastic * displacement[i] / 2
        power += viscous * velocity[i]
    return power, stored


@dataclass(frozen=True, eq=False)
class LinearRestraint(KernelRestraint):
    """Springs and dashpots: stiffness and damping (6, 6) in N, m, rad and s."""

    stiffness: Array
    damping: Array

    reaction_kernel = _linear

    @property
    def constants(self) -> Array:
        return np.concatenate([self.stiffness.ravel(), self.damping.ravel()])

    def describe(self) -> dict[str, object]:
        return {"stiffness": self.stiffness.tolist(), "damping": self.damping.tolist()}


_register: WeakValueDictionary[int, PythonRestraint] = WeakValueDictionary()
_places = itertools.count()
_PLACE = 0
"""Index of the constant that holds the index in the register."""


def _call(
    place: float,
    displacement: Array,
    velocity: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> None:
    restraint = _register[int(place)].restraint
    reaction[:] = restraint.reaction(displacement.copy(), velocity.copy())
    stiffness[:], damping[:] = restraint.tangents(displacement.copy(), velocity.copy())


@restraint_kernel.allocating
def _in_python(
    displacement: Array,
    velocity: Array,
    constants: Array,
    memory: Array,
    reaction: Array,
    stiffness: Array,
    damping: Array,
) -> tuple[float, float]:
    with objmode():
        _call(constants[_PLACE], displacement, velocity, reaction, stiffness, damping)
    return 0.0, 0.0


class PythonRestraint(KernelRestraint):
    """A restraint written in Python, wrapped for compiled code; it reports no energies."""

    reaction_kernel = _in_python

    def __init__(self, restraint: RootRestraint) -> None:
        self.restraint = restraint
        self._place = next(_places)
        _register[self._place] = self

    @property
    def constants(self) -> Array:
        return np.array([float(self._place)])

    def describe(self) -> dict[str, object]:
        return self.restraint.describe()

    def fingerprint(self) -> str:
        return self.restraint.fingerprint()


FREE = LinearRestraint(np.zeros((6, 6)), np.zeros((6, 6)))
"""No resistance; used where a chain has no root joints."""
