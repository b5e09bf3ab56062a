"""What a load sees and what it gives: motion of points on the axis in, forces and tangents out.

Everything is in the inertial frame: x downwind, y left looking downwind, z up.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np
from numba import types

from offwind_pin.compiled import ExchangeableKernel, exchangeable
from offwind_pin.turbines.definition import Array

POSITION, DISPLACEMENT, VELOCITY, AXIS, ACCELERATION = (slice(3 * i, 3 * i + 3) for i in range(5))
"""Columns of the motion of points, (n, 15)."""

_MATRIX = types.float64[:, ::1]
_ROW = types.float64[::1]

force_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW, _MATRIX))
"""Decorator for ``kernel(motion, constants, row, force) -> power``.

motion (n, 15) of the points; constants (n, c) of the load; row (w,) whatever depends on time;
force (n, 6) is set to force and moment in N and N m. Returned is the power in W that the load
turns into heat, zero for a load that does not dissipate.
"""

tangent_kernel = exchangeable(types.void(_MATRIX, _MATRIX, _ROW, types.float64[:, :, :, ::1]))
"""Decorator for ``kernel(motion, constants, row, blocks)``.

blocks (n, 4, 3, 3), zero at the start, is set to the derivatives of the force by position,
velocity, acceleration and axis.
"""

energy_kernel = exchangeable(types.float64(_MATRIX, _MATRIX))
"""Decorator for ``kernel(motion, constants) -> energy``, the energy in J that the load stores."""


@energy_kernel
def nothing_stored(motion: Array, constants: Array) -> float:
    """Of a load that stores no energy."""
    return 0.0


@tangent_kernel
def no_tangents(motion: Array, constants: Array, row: Array, blocks: Array) -> None:
    """Of a load that depends on time alone."""


@dataclass(frozen=True, eq=False)
class PointMotion:
    """Motion of n points on the axis of the structure.

    Attributes
    ----------
    position : (n, 3) in m
    displacement : (n, 3) from the undeformed place, in m
    velocity : (n, 3) in m/s
    axis : (n, 3) unit vectors along the deflected axis, upwards
    acceleration : (n, 3) in m/s2, at rest unless given
    """

    position: Array
    displacement: Array
    velocity: Array
    axis: Array
    acceleration: Array | None = None

    def __getitem__(self, part: slice) -> PointMotion:
        rate = self.acceleration
        return PointMotion(
            self.position[part],
            self.displacement[part],
            self.velocity[part],
            self.axis[part],
            None if rate is None else rate[part],
        )

    def columns(self) -> Array:
        """(n, 15) position, displacement, velocity, axis, acceleration, as kernels see them."""
        rate = np.zeros_like(self.position) if self.acceleration is None else self.acceleration
        return np.hstack([self.position, self.displacement, self.velocity, self.axis, rate])


@dataclass(frozen=True, eq=False)
class PointForces:
    """Forces (n, 3) in N on the structure at the points, and moments (n, 3) in N m.

    dissipation : power in W that the load turns into heat
    """

    force: Array
    moment: Array
    dissipation: float = 0.0


@dataclass(frozen=True, eq=False)
class PointTangents:
    """Derivatives (n, 3, 3) of the forces.

    stiffness : by position in N/m; damping : by velocity in N s/m; inertia : by acceleration in kg;
    turning : by the axis in N. Moments of a point load depend on time alone.
    """

    stiffness: Array
    damping: Array
    inertia: Array
    turning: Array

    @staticmethod
    def zeros(n: int) -> PointTangents:
        """Of a load that depends on time alone."""
        return PointTangents(*np.zeros((4, n, 3, 3)))


class PointLoad(Protocol):
    """A load on points of the axis; it knows nothing of joints.

    ``rise`` runs from 0 to 1 while a simulation starts: at 0 only the mean of a load acts.
    """

    @property
    def name(self) -> str:
        """Short name, unique in a system."""

    @property
    def height(self) -> Array:
        """(n,) undeformed heights of the points in m."""

    def forces(self, time: float, motion: PointMotion, rise: float) -> PointForces:
        """Forces and moments on the structure."""

    def tangents(self, time: float, motion: PointMotion, rise: float) -> PointTangents:
        """Exact derivatives of the forces."""


class KernelLoad(ABC):
    """A point load whose physics is in compiled kernels; what depends on time is in rows.

    One set of kernels serves the time integration, which calls them from compiled code, and
    :meth:`forces` and :meth:`tangents`.
    """

    force_kernel: ClassVar[ExchangeableKernel]
    tangent_kernel: ClassVar[ExchangeableKernel]
    energy_kernel: ClassVar[ExchangeableKernel]

    if TYPE_CHECKING:  # fields or properties of the loads themselves

        @property
        def name(self) -> str: ...

        @property
        def height(self) -> Array: ...

    @property
    @abstractmethod
    def constants(self) -> Array:
        """(n, c) numbers of each point that do not change."""

    def rows(self, time: Array, rise: Array) -> Array:
        """(t, w) numbers that depend on time alone, at times (t,) and rises (t,)."""
        return np.zeros((len(time), 0))

    def forces(self, time: float, motion: PointMotion, rise: float) -> PointForces:
        columns = motion.columns()
        force = np.zeros((len(columns), 6))
        lost = self.force_kernel(columns, self.constants, self._row(time, rise), force)
        return PointForces(force[:, :3], force[:, 3:], lost)

    def tangents(self, time: float, motion: PointMotion, rise: float) -> PointTangents:
        columns = motion.columns()
        blocks = np.zeros((len(columns), 4, 3, 3))
        self.tangent_kernel(columns, self.constants, self._row(time, rise), blocks)
        return PointTangents(*np.ascontiguousarray(blocks.transpose(1, 0, 2, 3)))

    def energy(self, motion: PointMotion) -> float:
        """Energy stored in J."""
        return float(self.energy_kernel(motion.columns(), self.constants))

    def _row(self, time: float, rise: float) -> Array:
        return np.ascontiguousarray(self.rows(np.array([time]), np.array([rise]))[0])
