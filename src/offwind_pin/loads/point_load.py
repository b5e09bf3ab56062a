"""What a load sees and what it gives: motion of points on the axis in, forces and tangents out.

Everything is in the inertial frame: x downwind, y left looking downwind, z up.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np
from numba import types

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.kernels import ExchangeableKernel, exchangeable

POSITION, DISPLACEMENT, VELOCITY, AXIS, ACCELERATION, TURN, SPIN = (
    slice(3 * i, 3 * i + 3) for i in range(7)
)
"""Columns of the motion of points, (n, 21)."""

BY_POSITION, BY_VELOCITY, BY_ACCELERATION, BY_AXIS = range(4)
MOMENT_BY_POSITION, MOMENT_BY_TURN, MOMENT_BY_SPIN = range(4, 7)
"""Places of the derivatives of force and moment in the tangents of a point, (7, 3, 3)."""

_MATRIX = types.float64[:, ::1]
_ROW = types.float64[::1]

force_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW, _ROW, _MATRIX))
"""Decorator for ``kernel(motion, constants, row, memory, force) -> power``.

motion (n, 21) of the points; constants (n, c) of the load; row (w,) whatever depends on time;
memory (m,) what the load keeps of its past, as of the last step; force (n, 6) is set to force and
moment in N and N m. Returned is the power in W that the load turns into heat as it moves, zero for
a load that does not dissipate, or does so from step to step.
"""

tangent_kernel = exchangeable(types.void(_MATRIX, _MATRIX, _ROW, _ROW, types.float64[:, :, :, ::1]))
"""Decorator for ``kernel(motion, constants, row, memory, blocks)``.

blocks (n, 7, 3, 3), zero at the start, is set to the derivatives of the force by position,
velocity, acceleration and axis, and of the moment by position, turn and spin.
"""

energy_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW))
"""Decorator for ``kernel(motion, constants, memory) -> energy``, that the load stores, in J."""

commit_kernel = exchangeable(types.float64(_MATRIX, _MATRIX, _ROW, _ROW))
"""Decorator for ``kernel(motion, constants, row, memory) -> heat``.

It ends a step: the memory becomes that of the motion and of the row at the step's end, and what
that turned into heat is returned in J.
"""


@energy_kernel
def nothing_stored(motion: Array, constants: Array, memory: Array) -> float:
    """Of a load that stores no energy."""
    return 0.0


@commit_kernel
def nothing_kept(motion: Array, constants: Array, row: Array, memory: Array) -> float:
    """Of a load without memory."""
    return 0.0


@tangent_kernel
def no_tangents(motion: Array, constants: Array, row: Array, memory: Array, blocks: Array) -> None:
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
    turn : (n, 3) rotation of the section, the axial vector of its orientation's skew part (its size
        is the sine of the angle) in rad; none unless given
    spin : (n, 3) angular velocity of the section in rad/s, none unless given
    """

    position: Array
    displacement: Array
    velocity: Array
    axis: Array
    acceleration: Array | None = None
    turn: Array | None = None
    spin: Array | None = None

    __repr__ = one_line

    def __getitem__(self, part: slice) -> PointMotion:
        given = {item.name: getattr(self, item.name) for item in fields(self)}
        return PointMotion(**{k: value[part] for k, value in given.items() if value is not None})

    def columns(self) -> Array:
        """(n, 21) all of it side by side, as kernels see it."""
        parts = (getattr(self, item.name) for item in fields(self))
        return np.hstack([np.zeros_like(self.axis) if part is None else part for part in parts])


@dataclass(frozen=True, eq=False)
class PointForces:
    """Forces (n, 3) in N on the structure at the points, and moments (n, 3) in N m.

    dissipation : power in W that the load turns into heat
    """

    force: Array
    moment: Array
    dissipation: float = 0.0

    __repr__ = one_line


@dataclass(frozen=True, eq=False)
class PointTangents:
    """Derivatives (n, 3, 3) of forces and moments, in the order of ``BY_POSITION`` and the others.

    stiffness : of the force by position in N/m; damping : by velocity in N s/m; inertia : by
        acceleration in kg; turning : by the axis in N
    moment_coupling : of the moment by position in N; moment_stiffness : by the turn in N m;
        moment_damping : by the spin in N m s; none unless given
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
        """Of a load that depends on time alone."""
        return PointTangents(*np.zeros((4, n, 3, 3)))

    def blocks(self) -> Array:
        """(n, 7, 3, 3), as kernels see them."""
        parts = (getattr(self, item.name) for item in fields(self))
        whole = [np.zeros_like(self.stiffness) if part is None else part for part in parts]
        return np.stack(whole, axis=1)


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
    energy_kernel: ClassVar[ExchangeableKernel] = nothing_stored
    commit_kernel: ClassVar[ExchangeableKernel] = nothing_kept
    inertial: ClassVar[bool] = False
    """Whether the force depends on the acceleration, and the load belongs to the mass matrix."""

    if TYPE_CHECKING:  # fields or properties of the loads themselves

        @property
        def name(self) -> str: ...

        @property
        def height(self) -> Array: ...

    @property
    @abstractmethod
    def constants(self) -> Array:
        """(n, c) numbers of each point that do not change."""

    @property
    def memory_size(self) -> int:
        """How many numbers the load keeps of its past; they are zero at first."""
        return 0

    def rows(self, time: Array, rise: Array) -> Array:
        """(t, w) numbers that depend on time alone, at times (t,) and rises (t,)."""
        return np.zeros((len(time), 0))

    def forces(
        self, time: float, motion: PointMotion, rise: float, memory: Array | None = None
    ) -> PointForces:
        columns = motion.columns()
        force = np.zeros((len(columns), 6))
        row, past = self._row(time, rise), self._past(memory)
        lost = self.force_kernel(columns, self.constants, row, past, force)
        return PointForces(force[:, :3], force[:, 3:], lost)

    def tangents(
        self, time: float, motion: PointMotion, rise: float, memory: Array | None = None
    ) -> PointTangents:
        columns = motion.columns()
        blocks = np.zeros((len(columns), 7, 3, 3))
        row, past = self._row(time, rise), self._past(memory)
        self.tangent_kernel(columns, self.constants, row, past, blocks)
        return PointTangents(*np.ascontiguousarray(blocks.transpose(1, 0, 2, 3)))

    def energy(self, motion: PointMotion, memory: Array | None = None) -> float:
        """Energy stored in J."""
        return float(self.energy_kernel(motion.columns(), self.constants, self._past(memory)))

    def commit(
        self, motion: PointMotion, memory: Array, time: float = 0.0, rise: float = 1.0
    ) -> float:
        """End a step: change the memory (m,) to that of a motion at a time; heat made in J."""
        row = self._row(time, rise)
        return float(self.commit_kernel(motion.columns(), self.constants, row, memory))

    def _row(self, time: float, rise: float) -> Array:
        return np.ascontiguousarray(self.rows(np.array([time]), np.array([rise]))[0])

    def _past(self, memory: Array | None) -> Array:
        return np.zeros(self.memory_size) if memory is None else memory


def as_argument(load: PointLoad, memory: Array) -> dict[str, Array]:
    """A load's memory for its methods; loads of the user's own take none."""
    return {"memory": memory} if isinstance(load, KernelLoad) else {}
