"""Distributed soil springs: p-y springs and dashpots at the nodes of an embedded pile."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.loads.points import PointForces, PointMotion, PointTangents
from offwind_pin.loads.soil_curves import SoilCurves, soil_curves
from offwind_pin.turbines.definition import Array, DistributedSprings, SoilDashpot


@dataclass(frozen=True, eq=False)
class SoilSprings:
    """Lateral springs and dashpots; the force opposes the horizontal displacement vector.

    F = -K_s(y) u - C_s(y) v with y = |u|, K_s = p(y) l_s / y (Rahman et al., MECC 2025, Eq. 6) and
    C_s = K_s beta_s / (pi f_load) (Eq. 7).

    Attributes
    ----------
    height : (n,) heights of the nodes in m
    tributary_length : (n,) length of pile that each spring stands for, l_s, in m
    curves : p-y curves of the nodes
    dashpot_time : beta_s / (pi f_load) in s
    """

    height: Array
    tributary_length: Array
    curves: SoilCurves
    dashpot_time: float
    name: str = "soil"

    @staticmethod
    def along_pile(springs: DistributedSprings, mudline: float, toe: float) -> SoilSprings:
        """Nodes at equal distances from mudline to toe; the end nodes have half a length."""
        height = np.linspace(mudline, toe, springs.nodes)
        length = np.full(springs.nodes, (mudline - toe) / (springs.nodes - 1))
        length[[0, -1]] /= 2
        curves = soil_curves(springs.curve, mudline - height)
        return SoilSprings(height, length, curves, dashpot_time(springs.dashpot))

    def forces(self, time: float, motion: PointMotion, rise: float) -> PointForces:
        y = np.hypot(motion.displacement[:, 0], motion.displacement[:, 1])
        stiffness = self.curves.secant(y) * self.tributary_length
        force = -stiffness[:, None] * (motion.displacement + self.dashpot_time * motion.velocity)
        force[:, 2] = 0.0
        return PointForces(force, np.zeros_like(force))

    def tangents(self, time: float, motion: PointMotion, rise: float) -> PointTangents:
        u, v = motion.displacement[:, :2], motion.velocity[:, :2]
        y = np.hypot(u[:, 0], u[:, 1])
        secant = self.curves.secant(y) * self.tributary_length
        tangent = self.curves.tangent(y) * self.tributary_length
        direction = np.divide(u, y[:, None], out=np.zeros_like(u), where=y[:, None] > 0)
        slope = np.divide(tangent - secant, y, out=np.zeros_like(y), where=y > 0)
        pull = (u + self.dashpot_time * v) * slope[:, None]
        stiffness, damping = np.zeros((2, len(y), 3, 3))
        stiffness[:, :2, :2] = -np.einsum("ni,nj->nij", pull, direction)
        horizontal = np.arange(2)
        stiffness[:, horizontal, horizontal] -= secant[:, None]
        damping[:, horizontal, horizontal] = -(secant * self.dashpot_time)[:, None]
        return PointTangents(stiffness, damping)


def dashpot_time(dashpot: SoilDashpot | None) -> float:
    """Ratio of dashpot coefficient to secant stiffness, beta_s / (pi f_load), in s."""
    return 0.0 if dashpot is None else dashpot.damping_factor / (np.pi * dashpot.load_frequency)
