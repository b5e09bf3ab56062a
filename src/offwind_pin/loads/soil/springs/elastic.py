"""Soil springs at the nodes of an embedded pile, elastic, with or without dashpots."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.loads.point_load import (
    BY_POSITION,
    BY_VELOCITY,
    DISPLACEMENT,
    MOMENT_BY_SPIN,
    MOMENT_BY_TURN,
    SPIN,
    TURN,
    VELOCITY,
    KernelLoad,
    energy_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.soil.curves.laws import SoilCurves, curve_at, curve_energy, secant_at
from offwind_pin.loads.soil.springs.dashpot import Dashpot, ratio_at


@dataclass(frozen=True)
class Direction:
    """What a spring resists, as columns of motion and force, and places among the tangents.

    deflection, rate, force : first columns; components : how many follow one another, of which the
    law sees the vector's size; stiffness, damping : places of the tangents, at ``component``
    """

    deflection: int
    rate: int
    force: int
    components: int
    stiffness: int
    damping: int
    component: int

    @property
    def numbers(self) -> Array:
        """(7,) for the constants of a load."""
        return np.array(
            [
                self.deflection,
                self.rate,
                self.force,
                self.components,
                self.stiffness,
                self.damping,
                self.component,
            ],
            dtype=float,
        )


LATERAL = Direction(DISPLACEMENT.start, VELOCITY.start, 0, 2, BY_POSITION, BY_VELOCITY, 0)
VERTICAL = Direction(DISPLACEMENT.start + 2, VELOCITY.start + 2, 2, 1, BY_POSITION, BY_VELOCITY, 2)
ROCKING = Direction(TURN.start, SPIN.start, 3, 2, MOMENT_BY_TURN, MOMENT_BY_SPIN, 0)
TORSIONAL = Direction(TURN.start + 2, SPIN.start + 2, 5, 1, MOMENT_BY_TURN, MOMENT_BY_SPIN, 2)
"""Horizontal displacement, settlement, rotation about horizontal axes, twist about the axis."""

_LENGTH, _CONSTANT, _DASHPOT, _CURVE = range(7, 11)
"""Columns of a node's constants after its direction: tributary length, dashpot coefficient that is
constant, and where the numbers of the dashpot and of the curve begin."""


@kernel
def deflection_size(values: Array, first: int, components: int) -> float:
    """Size of the deflection in a row of motion."""
    if components == 1:
        return abs(values[first])
    return np.sqrt(values[first] ** 2 + values[first + 1] ** 2)


@force_kernel
def _forces(motion: Array, constants: Array, row: Array, memory: Array, force: Array) -> float:
    lost = 0.0
    for i in range(len(motion)):
        c = constants[i]
        u, v, f, components = int(c[0]), int(c[1]), int(c[2]), int(c[3])
        y = deflection_size(motion[i], u, components)
        spring = secant_at(c[int(c[_CURVE]) :], y) * c[_LENGTH]
        time, _ = ratio_at(c[int(c[_DASHPOT]) :], y)
        dashpot = spring * time + c[_CONSTANT]
        force[i] = 0.0
        for j in range(components):
            force[i, f + j] = -spring * motion[i, u + j] - dashpot * motion[i, v + j]
            lost += dashpot * motion[i, v + j] ** 2
    return lost


@tangent_kernel
def _tangents(motion: Array, constants: Array, row: Array, memory: Array, blocks: Array) -> None:
    for i in range(len(motion)):
        c = constants[i]
        u, v, components = int(c[0]), int(c[1]), int(c[3])
        stiffness, damping, place = int(c[4]), int(c[5]), int(c[6])
        y = deflection_size(motion[i], u, components)
        secant, tangent = curve_at(c[int(c[_CURVE]) :], y)
        time, slope = ratio_at(c[int(c[_DASHPOT]) :], y)
        spring = secant * c[_LENGTH]
        by_size = (tangent * c[_LENGTH] - spring) / y if y > 0 else 0.0
        dashpot_by_size = by_size * time + spring * slope
        for j in range(components):
            for k in range(components):
                along = motion[i, u + k] / y if y > 0 else 0.0
                blocks[i, stiffness, place + j, place + k] = (
                    -(motion[i, u + j] * by_size + motion[i, v + j] * dashpot_by_size) * along
                )
            blocks[i, stiffness, place + j, place + j] -= spring
            blocks[i, damping, place + j, place + j] = -spring * time - c[_CONSTANT]


@energy_kernel
def _energy(motion: Array, constants: Array, memory: Array) -> float:
    energy = 0.0
    for i in range(len(motion)):
        c = constants[i]
        y = deflection_size(motion[i], int(c[0]), int(c[3]))
        energy += c[_LENGTH] * curve_energy(c[int(c[_CURVE]) :], y)
    return energy


@dataclass(frozen=True, eq=False)
class SoilSprings(KernelLoad):
    """Springs and dashpots; the force opposes the vector of the deflection.

    F = -K_s(y) u - C_s v with y = |u| and K_s = p(y) l_s / y (Rahman et al., MECC 2025, Eq. 6);
    C_s = K_s(y) beta_s(y) / (pi f_load) (Eq. 7), or constant with the initial stiffness K_s(0).

    Attributes
    ----------
    name : short, unique in a system
    direction : what is resisted; for rotations read moment for force
    height : (n,) heights of the nodes in m
    tributary_length : (n,) length of pile that each spring stands for, l_s, in m; 1 at the toe
    curves : resistance per length over deflection
    dashpot : beside each spring
    """

    name: str
    direction: Direction
    height: Array
    tributary_length: Array
    curves: SoilCurves
    dashpot: Dashpot

    force_kernel = _forces
    tangent_kernel = _tangents
    energy_kernel = _energy

    @cached_property
    def constants(self) -> Array:
        return spring_constants(self.direction, self.tributary_length, self.curves, self.dashpot)


def spring_constants(
    direction: Direction, length: Array, curves: SoilCurves, dashpot: Dashpot
) -> Array:
    """(n, c) constants of springs at n nodes; see ``_LENGTH`` and the others."""
    n = len(length)
    initial = curves.secant(np.zeros(n)) * length * dashpot.initial_time
    begin = len(direction.numbers) + 4
    places = [begin, begin + len(dashpot.numbers)]
    head = np.concatenate([direction.numbers, np.zeros(2), places])
    rows = np.tile(np.concatenate([head, dashpot.numbers]), (n, 1))
    rows[:, _LENGTH], rows[:, _CONSTANT] = length, initial
    return np.hstack([rows, curves.numbers])
