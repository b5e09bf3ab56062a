"""Soil springs at the nodes of an embedded pile, elastic, with or without dashpots."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import ClassVar, NamedTuple

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import ExchangeableKernel, inner
from offwind_pin.base.records import clear, part
from offwind_pin.loads.point_load import (
    BY_POSITION,
    BY_VELOCITY,
    DISPLACEMENT,
    MOMENT_BY_SPIN,
    MOMENT_BY_TURN,
    SPIN,
    TURN,
    VELOCITY,
    GroupedLoad,
    KernelLoad,
    energy_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.soil.curves.soil_curve import (
    Indices,
    SoilCurve,
    SoilCurves,
    law_functions,
)
from offwind_pin.loads.soil.springs.dashpot import Dashpot, ratio_at


@dataclass(frozen=True)
class SpringComponent:
    """The motion that a spring resists, as columns of motion and force and indices of tangents.

    Attributes
    ----------
    deflection, rate, force : int
        First columns.
    size : int
        Number of components; the law applies to the length of the vector.
    stiffness, damping : int
        Indices of the tangents.
    first : int
        First row and column in them.
    """

    deflection: int
    rate: int
    force: int
    size: int
    stiffness: int
    damping: int
    first: int

    @property
    def columns(self) -> Array:
        """(7,) for the constants of a load, in the order of ``DEFLECTION`` and the others."""
        whole = (
            self.deflection,
            self.rate,
            self.force,
            self.size,
            self.stiffness,
            self.damping,
            self.first,
        )
        return np.array(whole, dtype=float)

    @property
    def turns(self) -> bool:
        """Whether it resists rotation, so that its forces are moments."""
        return self.stiffness == MOMENT_BY_TURN


LATERAL = SpringComponent(DISPLACEMENT.start, VELOCITY.start, 0, 2, BY_POSITION, BY_VELOCITY, 0)
VERTICAL = SpringComponent(
    DISPLACEMENT.start + 2, VELOCITY.start + 2, 2, 1, BY_POSITION, BY_VELOCITY, 2
)
ROCKING = SpringComponent(TURN.start, SPIN.start, 3, 2, MOMENT_BY_TURN, MOMENT_BY_SPIN, 0)
TORSIONAL = SpringComponent(TURN.start + 2, SPIN.start + 2, 5, 1, MOMENT_BY_TURN, MOMENT_BY_SPIN, 2)
"""Horizontal displacement, settlement, rotation about horizontal axes, twist about the axis."""

DEFLECTION, RATE, FORCE, SIZE, STIFFNESS, DAMPING, FIRST = range(7)
"""Columns of a node's constants that describe the component of its spring."""
_LENGTH, CONSTANT_DASHPOT, _DASHPOT = range(7, 10)
"""Further columns: tributary length, coefficient of a constant dashpot, and from the last on the
table of the variable dashpot, which begins with the number of its points. The parameters of the
curve follow."""


@inner
def deflection_size(values: Array, first: int, components: int) -> float:
    """Size of the deflection in a row of motion."""
    if components == 1:
        return abs(values[first])
    return np.sqrt(values[first] ** 2 + values[first + 1] ** 2)


class _SpringKernels(NamedTuple):
    force: ExchangeableKernel
    tangent: ExchangeableKernel
    energy: ExchangeableKernel


@cache
def _spring_kernels(law: type[SoilCurve]) -> _SpringKernels:
    """Kernels of springs of one law."""
    secant_at, tangent_at, energy_at, source = law_functions(law)

    @force_kernel
    def spring_forces(
        motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
    ) -> float:
        _source = source
        power = 0.0
        clear(force)
        for i in range(len(motion)):
            c = constants[i]
            u, v, f, components = int(c[DEFLECTION]), int(c[RATE]), int(c[FORCE]), int(c[SIZE])
            y = deflection_size(motion[i], u, components)
            curve = part(c, _DASHPOT + 1 + 2 * int(c[_DASHPOT]), len(c))
            spring = secant_at(curve, y) * c[_LENGTH]
            time, _ = ratio_at(part(c, _DASHPOT, len(c)), y)
            dashpot = spring * time + c[CONSTANT_DASHPOT]
            for j in range(components):
                force[i, f + j] = -spring * motion[i, u + j] - dashpot * motion[i, v + j]
                power += dashpot * motion[i, v + j] ** 2
        return power

    @tangent_kernel
    def spring_tangents(
        motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
    ) -> None:
        _source = source
        for i in range(len(motion)):
            c = constants[i]
            u, v, components = int(c[DEFLECTION]), int(c[RATE]), int(c[SIZE])
            stiffness, damping, first = int(c[STIFFNESS]), int(c[DAMPING]), int(c[FIRST])
            y = deflection_size(motion[i], u, components)
            curve = part(c, _DASHPOT + 1 + 2 * int(c[_DASHPOT]), len(c))
            spring = secant_at(curve, y) * c[_LENGTH]
            time, slope = ratio_at(part(c, _DASHPOT, len(c)), y)
            by_size = (tangent_at(curve, y) * c[_LENGTH] - spring) / y if y > 0 else 0.0
            dashpot_by_size = by_size * time + spring * slope
            for j in range(components):
                for k in range(components):
                    along = motion[i, u + k] / y if y > 0 else 0.0
                    blocks[i, stiffness, first + j, first + k] = (
                        -(motion[i, u + j] * by_size + motion[i, v + j] * dashpot_by_size) * along
                    )
                blocks[i, stiffness, first + j, first + j] -= spring
                blocks[i, damping, first + j, first + j] = -spring * time - c[CONSTANT_DASHPOT]

    @energy_kernel
    def spring_energy(motion: Array, constants: Array, memory: Array) -> float:
        _source = source
        energy = 0.0
        for i in range(len(motion)):
            c = constants[i]
            y = deflection_size(motion[i], int(c[DEFLECTION]), int(c[SIZE]))
            curve = part(c, _DASHPOT + 1 + 2 * int(c[_DASHPOT]), len(c))
            energy += c[_LENGTH] * energy_at(curve, y)
        return energy

    return _SpringKernels(spring_forces, spring_tangents, spring_energy)


@dataclass(frozen=True, eq=False)
class SoilSprings(GroupedLoad):
    """Springs and dashpots; the force opposes the vector of the deflection.

    F = -K_s(y) u - C_s v with y = |u| and K_s = p(y) l_s / y (Rahman et al., MECC 2025, Eq. 6);
    C_s = K_s(y) beta_s(y) / (pi f_load) (Eq. 7), or constant with the initial stiffness K_s(0).

    Attributes
    ----------
    name : str
        Short name, unique in a system.
    component : SpringComponent
        The resisted motion; for rotations forces are moments.
    height : (n,) array, m
        Heights of the nodes.
    tributary_length : (n,) array, m
        Length of pile of each spring, l_s; 1 at the toe.
    curves : SoilCurves
        Resistance per length over deflection.
    dashpot : Dashpot
        Dashpot parallel to each spring.
    """

    name: str
    component: SpringComponent
    height: Array
    tributary_length: Array
    curves: SoilCurves
    dashpot: Dashpot

    moves_with_ground: ClassVar[bool] = True

    @cached_property
    def groups(self) -> tuple[tuple[Indices, KernelLoad], ...]:
        """Nodes of each law, with their springs."""
        return tuple((nodes, self._of_law(nodes, curves)) for nodes, curves in self.curves.groups)

    def _of_law(self, nodes: Indices, curves: SoilCurve) -> KernelLoad:
        parts = self.height[nodes], self.tributary_length[nodes]
        return SpringsOfLaw(self.name, self.component, *parts, curves, self.dashpot)


@dataclass(frozen=True, eq=False)
class SpringsOfLaw(KernelLoad):
    """Springs of :class:`SoilSprings` of one law."""

    name: str
    component: SpringComponent
    height: Array
    tributary_length: Array
    curves: SoilCurve
    dashpot: Dashpot

    moves_with_ground: ClassVar[bool] = True

    @property
    def force_kernel(self) -> ExchangeableKernel:
        return _spring_kernels(type(self.curves)).force

    @property
    def tangent_kernel(self) -> ExchangeableKernel:
        return _spring_kernels(type(self.curves)).tangent

    @property
    def energy_kernel(self) -> ExchangeableKernel:
        return _spring_kernels(type(self.curves)).energy

    @cached_property
    def constants(self) -> Array:
        n, length = len(self.height), self.tributary_length
        initial = np.zeros(n)
        if self.dashpot.initial_time:  # without it the secant need not be compiled
            initial = self.curves.secant(np.zeros(n)) * length * self.dashpot.initial_time
        return np.column_stack(
            [
                np.tile(self.component.columns, (n, 1)),
                length,
                initial,
                np.tile(self.dashpot.table, (n, 1)),
                self.curves.parameters,
            ]
        )
