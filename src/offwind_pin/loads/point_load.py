"""The contract of loads: motion of points on the axis in, forces and tangents out.

A load also states what it moves with, its mean, which channels it adds to results, where
its numbers come from, and a hash of everything that determines its forces. Code that uses loads
relies on this contract alone and never on the kind of a load.

Everything is in the inertial frame: x downwind, y left looking downwind, z up.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numba import types
from numpy.typing import NDArray

from offwind_pin.base.channels import Channel
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.fingerprint import content_hash
from offwind_pin.base.kernels import ExchangeableKernel, exchangeable

POSITION, DISPLACEMENT, VELOCITY, AXIS, ACCELERATION, TURN, SPIN = (
    slice(3 * i, 3 * i + 3) for i in range(7)
)
"""Columns of the motion of points, (n, 21)."""

BY_POSITION, BY_VELOCITY, BY_ACCELERATION, BY_AXIS = range(4)
MOMENT_BY_POSITION, MOMENT_BY_TURN, MOMENT_BY_SPIN = range(4, 7)
"""Indices of the derivatives of force and moment in the tangents of a point, (7, 3, 3)."""

_MATRIX = types.float64[:, ::1]
_ROW = types.float64[::1]

force_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW, _ROW, _MATRIX))
"""Decorator for ``kernel(motion, constants, time_inputs, memory, force) -> dissipated_power``.

motion (n, 21) of the points; constants (n, c) of the load; time_inputs (w,) everything that depends
on time; memory (m,) the load's memory as of the last step; force (n, 6) is set to force and moment
in N and N m. It returns the power in W that the load dissipates, zero for a load that dissipates
nothing, or does so at the end of steps.
"""

tangent_kernel = exchangeable(types.void(_MATRIX, _MATRIX, _ROW, _ROW, types.float64[:, :, :, ::1]))
"""Decorator for ``kernel(motion, constants, time_inputs, memory, blocks)``.

blocks (n, 7, 3, 3), zero at the start, is set to the derivatives of the force by position,
velocity, acceleration and axis, and of the moment by position, turn and spin.
"""

energy_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW))
"""Decorator for ``kernel(motion, constants, memory) -> energy``, the stored energy in J."""

commit_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW, _ROW))
"""Decorator for ``kernel(motion, constants, time_inputs, memory) -> dissipated_energy``.

It ends a step: the memory is updated to the motion and the time inputs at the end of the step, and
the energy in J that the step dissipated is returned.
"""


@energy_kernel
def nothing_stored(motion: Array, constants: Array, memory: Array) -> float:
    """Energy of a load that stores none."""
    return 0.0


@commit_kernel
def nothing_kept(motion: Array, constants: Array, time_inputs: Array, memory: Array) -> float:
    """Commit of a load without memory."""
    return 0.0


@tangent_kernel
def no_tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    """Tangents of a load that depends on time alone."""


@dataclass(frozen=True, eq=False)
class PointMotion:
    """Motion of n points on the axis of the structure.

    Attributes
    ----------
    position : (n, 3) array, m
    displacement : (n, 3) array, m
        From the undeformed position.
    velocity : (n, 3) array, m/s
    axis : (n, 3) array
        Unit vectors along the deflected axis, upwards.
    acceleration : (n, 3) array or None, m/s2
        At rest unless given.
    turn : (n, 3) array or None, rad
        Rotation of the section, the axial vector of its orientation's skew part (its size is the
        sine of the angle); none unless given.
    spin : (n, 3) array or None, rad/s
        Angular velocity of the section, none unless given.
    """

    position: Array
    displacement: Array
    velocity: Array
    axis: Array
    acceleration: Array | None = None
    turn: Array | None = None
    spin: Array | None = None

    __repr__ = one_line

    def __getitem__(self, part: slice | NDArray[np.intp]) -> PointMotion:
        given = {item.name: getattr(self, item.name) for item in fields(self)}
        return PointMotion(**{k: value[part] for k, value in given.items() if value is not None})

    def columns(self) -> Array:
        """All of the motion side by side, as kernels receive it.

        Returns
        -------
        (n, 21) array
        """
        parts = (getattr(self, item.name) for item in fields(self))
        return np.hstack([np.zeros_like(self.axis) if part is None else part for part in parts])


@dataclass(frozen=True, eq=False)
class PointForces:
    """Forces and moments on the structure at n points.

    Attributes
    ----------
    force : (n, 3) array, N
    moment : (n, 3) array, N m
    dissipation : float, W
        Power that the load dissipates.
    """

    force: Array
    moment: Array
    dissipation: float = 0.0

    __repr__ = one_line


@dataclass(frozen=True, eq=False)
class PointTangents:
    """Derivatives of the forces and moments at n points, (n, 3, 3) each.

    Attributes
    ----------
    stiffness : (n, 3, 3) array, N/m
        Of the force by position.
    damping : (n, 3, 3) array, N s/m
        Of the force by velocity.
    inertia : (n, 3, 3) array, kg
        Of the force by acceleration.
    turning : (n, 3, 3) array, N
        Of the force by the axis.
    moment_coupling : (n, 3, 3) array or None, N
        Of the moment by position; zero if None.
    moment_stiffness : (n, 3, 3) array or None, N m
        Of the moment by the rotation vector; zero if None.
    moment_damping : (n, 3, 3) array or None, N m s
        Of the moment by the angular velocity; zero if None.
    """

    stiffness: Array
    damping: Array
    inertia: Array
    turning: Array
    moment_coupling: Array | None = None
    moment_stiffness: Array | None = None
    moment_damping: Array | None = None

    __repr__ = one_line

    @staticmethod
    def zeros(n: int) -> PointTangents:
        """Tangents of a load that depends on time alone.

        Parameters
        ----------
        n : int
            Number of points.

        Returns
        -------
        PointTangents
        """
        return PointTangents(*np.zeros((4, n, 3, 3)))

    def blocks(self) -> Array:
        """All derivatives in one array, as kernels write them.

        Returns
        -------
        (n, 7, 3, 3) array
        """
        parts = (getattr(self, item.name) for item in fields(self))
        whole = [np.zeros_like(self.stiffness) if part is None else part for part in parts]
        return np.stack(whole, axis=1)


class PointLoad(ABC):
    """A load on points of the axis; it knows nothing of joints.

    Base class of the package's loads and of your own, which must have a ``name``, ``height``,
    :meth:`forces` and :meth:`tangents`. The ``ramp_factor`` rises from 0 to 1 at the start of a
    simulation; at 0 only the mean of a load acts, as in statics and modes.
    """

    moves_with_ground: ClassVar[bool] = False
    """Whether displacements and velocities are relative to the ground in an earthquake, as those of
    the soil are."""
    records_soil_force: ClassVar[bool] = True
    """Whether the forces of a load that moves with the ground are recorded as ``soil_force``."""
    if TYPE_CHECKING:  # fields or properties of the loads themselves

        @property
        def name(self) -> str:
            """Short name, unique in a system."""

        @property
        def height(self) -> Array:
            """(n,) undeformed heights of the points in m."""

    @abstractmethod
    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        """Forces and moments on the structure.

        Parameters
        ----------
        time : float, s
        motion : PointMotion
            Motion of the points.
        ramp_factor : float
            From 0, only the mean acts, to 1.

        Returns
        -------
        PointForces
        """

    @abstractmethod
    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        """Exact derivatives of the forces.

        Parameters
        ----------
        time : float, s
        motion : PointMotion
            Motion of the points.
        ramp_factor : float
            From 0, only the mean acts, to 1.

        Returns
        -------
        PointTangents
        """

    def compiled(self) -> tuple[KernelLoad, ...]:
        """The load for compiled code, in one or more parts that share its points.

        Returns
        -------
        tuple of KernelLoad
        """
        from offwind_pin.loads.python_load import PythonLoad

        return (PythonLoad(self),)

    @property
    def surrogate(self) -> str | None:
        """Why its numbers replace others, or None."""
        return None

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Channels returned by :meth:`outputs`."""
        return ()

    def outputs(self, time: Array, ramp_factor: Array) -> dict[str, Array]:
        """Values of the channels.

        Parameters
        ----------
        time : (t,) array, s
        ramp_factor : (t,) array

        Returns
        -------
        dict of str to array
            (t, ...) values by name.
        """
        return {}

    def attributes(self) -> dict[str, str]:
        """Attributes of the results that state where the load comes from.

        Returns
        -------
        dict of str to str
        """
        return {}

    def fingerprint(self) -> str:
        """Hash of everything that determines the forces.

        A stopped simulation continues only with loads of the same fingerprint. By default it covers
        the source of the class and the values of its attributes.

        Returns
        -------
        str

        Raises
        ------
        NoFingerprintError
            An attribute that cannot be hashed; the class must then define its own fingerprint.
        """
        return content_hash(self)


class KernelLoad(PointLoad):
    """A point load with compiled kernels; everything that depends on time is in the time inputs.

    One set of kernels serves the time integration, which calls them from compiled code, and
    :meth:`forces` and :meth:`tangents`.
    """

    inertial: ClassVar[bool] = False
    """Whether the force depends on the acceleration, and the load belongs to the mass matrix."""

    if TYPE_CHECKING:

        @property
        def force_kernel(self) -> ExchangeableKernel: ...

        @property
        def tangent_kernel(self) -> ExchangeableKernel: ...

        @property
        def energy_kernel(self) -> ExchangeableKernel: ...

        @property
        def commit_kernel(self) -> ExchangeableKernel: ...

    else:
        energy_kernel = nothing_stored
        commit_kernel = nothing_kept

    @property
    @abstractmethod
    def constants(self) -> Array:
        """(n, c) constant numbers of each point."""

    @property
    def coupling(self) -> tuple[Array, Array] | None:
        """Damping between its points, of which the tangents know nothing, or None.

        (k, n, 6) wrenches and (k,) rates of dampers, see
        :class:`offwind_pin.loads.structural.coupled_damping.CoupledDamping`.
        """
        return None

    @property
    def memory_size(self) -> int:
        """Size of the load's memory, which is zero at first."""
        return 0

    @property
    def stores_energy(self) -> bool:
        """Whether it stores energy, and therefore does not count as external work."""
        return self.energy_kernel is not nothing_stored

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """Numbers that depend on time alone.

        Parameters
        ----------
        time : (t,) array, s
        ramp_factor : (t,) array

        Returns
        -------
        (t, w) array
        """
        return np.zeros((len(time), 0))

    def mean_inputs(self) -> Array:
        """Time inputs of the mean, for statics and modes.

        Returns
        -------
        (w,) array
        """
        return np.ascontiguousarray(self.time_inputs(np.zeros(1), np.zeros(1))[0])

    def compiled(self) -> tuple[KernelLoad, ...]:
        """The load itself.

        Returns
        -------
        tuple of KernelLoad
        """
        return (self,)

    def raise_failure(self) -> None:
        """Raise the exception of a call from compiled code, if there was one."""

    def forces(
        self, time: float, motion: PointMotion, ramp_factor: float, memory: Array | None = None
    ) -> PointForces:
        """Forces and moments on the structure.

        Parameters
        ----------
        time : float, s
        motion : PointMotion
            Motion of the points.
        ramp_factor : float
            From 0, only the mean acts, to 1.
        memory : (m,) array, optional
            Memory of the last step; zero by default.

        Returns
        -------
        PointForces
        """
        columns = motion.columns()
        force = np.zeros((len(columns), 6))
        inputs, past = self._inputs(time, ramp_factor), self._past(memory)
        power = self.force_kernel(columns, self.constants, inputs, past, force)
        return PointForces(force[:, :3], force[:, 3:], power)

    def tangents(
        self, time: float, motion: PointMotion, ramp_factor: float, memory: Array | None = None
    ) -> PointTangents:
        """Exact derivatives of the forces.

        Parameters
        ----------
        time : float, s
        motion : PointMotion
            Motion of the points.
        ramp_factor : float
            From 0, only the mean acts, to 1.
        memory : (m,) array, optional
            Memory of the last step; zero by default.

        Returns
        -------
        PointTangents
        """
        columns = motion.columns()
        blocks = np.zeros((len(columns), 7, 3, 3))
        inputs, past = self._inputs(time, ramp_factor), self._past(memory)
        self.tangent_kernel(columns, self.constants, inputs, past, blocks)
        return PointTangents(*np.ascontiguousarray(blocks.transpose(1, 0, 2, 3)))

    def energy(self, motion: PointMotion, memory: Array | None = None) -> float:
        """Stored energy.

        Parameters
        ----------
        motion : PointMotion
            Motion of the points.
        memory : (m,) array, optional
            Memory of the last step; zero by default.

        Returns
        -------
        float, J
        """
        return float(self.energy_kernel(motion.columns(), self.constants, self._past(memory)))

    def commit(
        self, motion: PointMotion, memory: Array, time: float = 0.0, ramp_factor: float = 1.0
    ) -> float:
        """End a step: update the memory to a motion.

        Parameters
        ----------
        motion : PointMotion
            Motion at the end of the step.
        memory : (m,) array
            Changed in place.
        time : float, s
        ramp_factor : float

        Returns
        -------
        float, J
            Energy dissipated in the step.
        """
        inputs = self._inputs(time, ramp_factor)
        return float(self.commit_kernel(motion.columns(), self.constants, inputs, memory))

    def _inputs(self, time: float, ramp_factor: float) -> Array:
        inputs = self.time_inputs(np.array([time]), np.array([ramp_factor]))
        return np.ascontiguousarray(inputs[0])

    def _past(self, memory: Array | None) -> Array:
        return np.zeros(self.memory_size) if memory is None else memory


class GroupedLoad(PointLoad):
    """A load whose points form groups, each with its own kernels."""

    @property
    @abstractmethod
    def groups(self) -> tuple[tuple[NDArray[np.intp], KernelLoad], ...]:
        """Points and load of each group; every point is in one group."""

    def compiled(self) -> tuple[KernelLoad, ...]:
        return tuple(load for _, load in self.groups)

    @property
    def memory_size(self) -> int:
        """Size of the memory, one group after the other."""
        return sum(load.memory_size for load in self.compiled())

    @property
    def stores_energy(self) -> bool:
        """Whether it stores energy, and therefore does not count as external work."""
        return all(load.stores_energy for load in self.compiled())

    def forces(
        self, time: float, motion: PointMotion, ramp_factor: float, memory: Array | None = None
    ) -> PointForces:
        force, moment = np.zeros((2, len(self.height), 3))
        power = 0.0
        for points, load, past in self._parts(memory):
            found = load.forces(time, motion[points], ramp_factor, past)
            force[points], moment[points] = found.force, found.moment
            power += found.dissipation
        return PointForces(force, moment, power)

    def tangents(
        self, time: float, motion: PointMotion, ramp_factor: float, memory: Array | None = None
    ) -> PointTangents:
        blocks = np.zeros((len(self.height), 7, 3, 3))
        for points, load, past in self._parts(memory):
            blocks[points] = load.tangents(time, motion[points], ramp_factor, past).blocks()
        return PointTangents(*np.ascontiguousarray(blocks.transpose(1, 0, 2, 3)))

    def energy(self, motion: PointMotion, memory: Array | None = None) -> float:
        """Stored energy in J."""
        return sum(load.energy(motion[points], past) for points, load, past in self._parts(memory))

    def commit(self, motion: PointMotion, memory: Array) -> float:
        """End a step: update the memory (m,) to a motion; returns the dissipated energy in J."""
        return sum(load.commit(motion[points], past) for points, load, past in self._parts(memory))

    def _parts(self, memory: Array | None) -> list[tuple[NDArray[np.intp], KernelLoad, Array]]:
        whole = np.zeros(self.memory_size) if memory is None else memory
        ends = np.cumsum([load.memory_size for load in self.compiled()])[:-1]
        return [
            (points, load, past)
            for (points, load), past in zip(self.groups, np.split(whole, ends), strict=True)
        ]


def dissipated_power(load: KernelLoad, blocks: Array, rate: Array) -> float:
    """Power that a load dissipates by linear damping, in W.

    Parameters
    ----------
    load : KernelLoad
        The load.
    blocks : (n, 7, 3, 3) array
        Derivatives of forces and moments at its points.
    rate : (n, 6) array, m/s and rad/s
        Velocity and spin of its points.
    """
    velocity, spin = rate[:, :3], rate[:, 3:]
    power = -np.einsum("ni,nij,nj", velocity, blocks[:, BY_VELOCITY], velocity)
    power -= np.einsum("ni,nij,nj", spin, blocks[:, MOMENT_BY_SPIN], spin)
    if load.coupling is not None:
        wrench, damper = load.coupling
        power += np.sum(damper * np.einsum("knj,nj->k", wrench, rate) ** 2)
    return float(power)


def joined_attributes(loads: Sequence[PointLoad]) -> dict[str, str]:
    """Attributes of all loads; those of the same name are joined."""
    found: dict[str, list[str]] = {}
    for load in loads:
        for name, value in load.attributes().items():
            found.setdefault(name, []).append(value)
    return {name: "; ".join(values) for name, values in found.items()}
