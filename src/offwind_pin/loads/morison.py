"""Relative Morison forces on strips of a cylinder, normal to its deflected axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.loads.points import PointForces, PointMotion, PointTangents, zeros_like_points
from offwind_pin.loads.waves import WaveKinematics
from offwind_pin.turbines.definition import Array

STRIP_LENGTH = 0.5
"""Longest strip in m: the force of a wave 6.5 m long is met within 1 %, of longer ones better."""


@dataclass(frozen=True, eq=False)
class Strips:
    """Wetted strips from the mudline to the mean water line.

    height (n,) of the strip centres in m, length (n,) in m, diameter (n,) in m.
    """

    height: Array
    length: Array
    diameter: Array

    @staticmethod
    def between(mudline: float, water_line: float) -> tuple[Array, Array]:
        """Heights of the centres and lengths of equal strips."""
        count = int(np.ceil((water_line - mudline) / STRIP_LENGTH))
        edges = np.linspace(mudline, water_line, count + 1)
        return (edges[:-1] + edges[1:]) / 2, np.diff(edges)


@dataclass(frozen=True, eq=False)
class AddedMass:
    """Mass per strip of the water that moves with the structure, rho Ca pi D^2/4 l, in kg.

    It acts normal to the axis and belongs to the mass matrix, never to the loads.
    """

    height: Array
    mass: Array

    @staticmethod
    def of(strips: Strips, density: float, coefficient: float) -> AddedMass:
        return AddedMass(strips.height, density * coefficient * displaced_volume(strips))


@dataclass(frozen=True, eq=False)
class MorisonForce:
    """Fluid inertia and drag of a wave on strips; the added mass stands in the mass matrix.

    F = rho (1 + Ca) V a_w + rho/2 Cd D l |w| w per strip, with w the relative velocity and a_w the
    water's acceleration, both taken normal to the axis (Rahman et al., MECC 2025, Eq. 8).
    """

    strips: Strips
    kinematics: WaveKinematics
    density: float
    added_mass_coefficient: float
    drag_coefficient: float
    name: str = "waves"

    @property
    def height(self) -> Array:
        return self.strips.height

    def forces(self, time: float, motion: PointMotion, rise: float) -> PointForces:
        velocity, acceleration = self._water(time, rise)
        inertia = self.density * (1 + self.added_mass_coefficient) * displaced_volume(self.strips)
        relative = normal_part(velocity - motion.velocity, motion.axis)
        speed = np.linalg.norm(relative, axis=1)
        force = inertia[:, None] * normal_part(acceleration, motion.axis)
        force += (self._drag() * speed)[:, None] * relative
        return PointForces(force, np.zeros_like(force))

    def tangents(self, time: float, motion: PointMotion, rise: float) -> PointTangents:
        """d(|w| w)/dw = |w| I + w w' / |w|, and w = P (u_w - v) with P normal to the axis."""
        relative = normal_part(self._water(time, rise)[0] - motion.velocity, motion.axis)
        speed = np.linalg.norm(relative, axis=1)
        direction = np.divide(
            relative, speed[:, None], out=np.zeros_like(relative), where=speed[:, None] > 0
        )
        stiffness, _ = zeros_like_points(len(speed))
        outer = np.einsum("ni,nj->nij", direction, direction)
        projector = np.eye(3) - np.einsum("ni,nj->nij", motion.axis, motion.axis)
        damping = -(self._drag() * speed)[:, None, None] * (projector + outer)
        return PointTangents(stiffness, damping)

    def _drag(self) -> Array:
        area = self.strips.diameter * self.strips.length
        return 0.5 * self.density * self.drag_coefficient * area

    def _water(self, time: float, rise: float) -> tuple[Array, Array]:
        velocity, acceleration = self.kinematics.at(time)
        return rise * velocity, rise * acceleration


def displaced_volume(strips: Strips) -> Array:
    """(n,) volume of each strip in m3."""
    return np.pi / 4 * strips.diameter**2 * strips.length


def normal_part(vector: Array, axis: Array) -> Array:
    """Part of vectors (n, 3) normal to unit vectors (n, 3)."""
    return vector - np.einsum("ni,ni->n", vector, axis)[:, None] * axis
