"""Distributed soil springs: p-y springs and dashpots at the nodes of an embedded pile."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.loads.points import (
    KernelLoad,
    energy_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.soil_curves import SoilCurves, curve_at, curve_energy, soil_curves
from offwind_pin.turbines.definition import Array, DistributedSprings, SoilDashpot

_LENGTH, _SECANT_TIME, _DASHPOT, _CURVE = range(4)
"""Columns of a node's constants: tributary length, ratio of a dashpot coefficient to the secant
stiffness, a further coefficient that is constant, and where the curve's numbers begin."""


@force_kernel
def _forces(motion: Array, constants: Array, row: Array, force: Array) -> float:
    lost = 0.0
    for i in range(len(motion)):
        ux, uy, vx, vy = motion[i, 3], motion[i, 4], motion[i, 6], motion[i, 7]
        secant, _ = curve_at(constants[i, _CURVE:], np.sqrt(ux**2 + uy**2))
        spring = secant * constants[i, _LENGTH]
        dashpot = spring * constants[i, _SECANT_TIME] + constants[i, _DASHPOT]
        force[i, 0] = -spring * ux - dashpot * vx
        force[i, 1] = -spring * uy - dashpot * vy
        force[i, 2:] = 0.0
        lost += dashpot * (vx**2 + vy**2)
    return lost


@tangent_kernel
def _tangents(motion: Array, constants: Array, row: Array, blocks: Array) -> None:
    for i in range(len(motion)):
        u, v = motion[i, 3:5], motion[i, 6:8]
        y = np.sqrt(u[0] ** 2 + u[1] ** 2)
        secant, tangent = curve_at(constants[i, _CURVE:], y)
        length, time = constants[i, _LENGTH], constants[i, _SECANT_TIME]
        slope = (tangent - secant) * length / y**2 if y > 0 else 0.0
        for j in range(2):
            for k in range(2):
                blocks[i, 0, j, k] = -(u[j] + time * v[j]) * slope * u[k]
            blocks[i, 0, j, j] -= secant * length
            blocks[i, 1, j, j] = -secant * length * time - constants[i, _DASHPOT]


@energy_kernel
def _energy(motion: Array, constants: Array) -> float:
    energy = 0.0
    for i in range(len(motion)):
        y = np.sqrt(motion[i, 3] ** 2 + motion[i, 4] ** 2)
        energy += constants[i, _LENGTH] * curve_energy(constants[i, _CURVE:], y)
    return energy


@dataclass(frozen=True, eq=False)
class SoilSprings(KernelLoad):
    """Lateral springs and dashpots; the force opposes the horizontal displacement vector.

    F = -K_s(y) u - C_s v with y = |u| and K_s = p(y) l_s / y (Rahman et al., MECC 2025, Eq. 6).
    The dashpot is C_s = K_s(y) beta_s / (pi f_load) (Eq. 7) or, with ``initial_dashpot``, constant
    with the initial stiffness K_s(0) in its place.

    Attributes
    ----------
    height : (n,) heights of the nodes in m
    tributary_length : (n,) length of pile that each spring stands for, l_s, in m
    curves : p-y curves of the nodes
    dashpot_time : beta_s / (pi f_load) in s
    initial_dashpot : whether the dashpots keep the coefficient that they have at y = 0
    """

    height: Array
    tributary_length: Array
    curves: SoilCurves
    dashpot_time: float
    initial_dashpot: bool = False
    name: str = "soil"

    force_kernel = _forces
    tangent_kernel = _tangents
    energy_kernel = _energy

    @staticmethod
    def along_pile(springs: DistributedSprings, mudline: float, toe: float) -> SoilSprings:
        """Nodes at equal distances from mudline to toe; the end nodes have half a length."""
        height = np.linspace(mudline, toe, springs.nodes)
        length = np.full(springs.nodes, (mudline - toe) / (springs.nodes - 1))
        length[[0, -1]] /= 2
        curves = soil_curves(springs.curve, mudline - height)
        constant = springs.dashpot is not None and springs.dashpot.stiffness == "initial"
        return SoilSprings(height, length, curves, dashpot_time(springs.dashpot), constant)

    @cached_property
    def constants(self) -> Array:
        n = len(self.height)
        initial = self.curves.secant(np.zeros(n)) * self.tributary_length
        secant = np.full(n, 0.0 if self.initial_dashpot else self.dashpot_time)
        constant = initial * self.dashpot_time if self.initial_dashpot else np.zeros(n)
        return np.column_stack([self.tributary_length, secant, constant, self.curves.numbers])


def dashpot_time(dashpot: SoilDashpot | None) -> float:
    """Ratio of dashpot coefficient to stiffness, beta_s / (pi f_load), in s."""
    return 0.0 if dashpot is None else dashpot.damping_factor / (np.pi * dashpot.load_frequency)
