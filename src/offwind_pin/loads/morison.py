"""Relative Morison forces on strips of a cylinder, normal to its deflected axis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.compiled import kernel
from offwind_pin.loads.points import (
    KernelLoad,
    energy_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.waves import WaveKinematics
from offwind_pin.turbines.base import Array

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


@kernel
def _along(a: Array, b: Array) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@force_kernel
def _added_mass_forces(
    motion: Array, constants: Array, row: Array, memory: Array, force: Array
) -> float:
    for i in range(len(motion)):
        axis, acceleration = motion[i, 9:12], motion[i, 12:15]
        along = _along(axis, acceleration)
        for j in range(3):
            force[i, j] = -constants[i, 0] * (acceleration[j] - along * axis[j])
            force[i, 3 + j] = 0.0
    return 0.0


@tangent_kernel
def _added_mass_tangents(
    motion: Array, constants: Array, row: Array, memory: Array, blocks: Array
) -> None:
    for i in range(len(motion)):
        axis, acceleration, mass = motion[i, 9:12], motion[i, 12:15], constants[i, 0]
        along = _along(axis, acceleration)
        for j in range(3):
            for k in range(3):
                blocks[i, 2, j, k] = mass * axis[j] * axis[k]
                blocks[i, 3, j, k] = mass * axis[j] * acceleration[k]
            blocks[i, 2, j, j] -= mass
            blocks[i, 3, j, j] += mass * along


@energy_kernel
def _added_mass_energy(motion: Array, constants: Array, memory: Array) -> float:
    energy = 0.0
    for i in range(len(motion)):
        axis, velocity = motion[i, 9:12], motion[i, 6:9]
        square = _along(velocity, velocity) - _along(velocity, axis) ** 2
        energy += constants[i, 0] * square / 2
    return energy


@dataclass(frozen=True, eq=False)
class AddedMass(KernelLoad):
    """Mass per strip of the water that moves with the structure, rho Ca pi D^2/4 l, in kg.

    It acts normal to the axis and belongs to the mass matrix: its force is in the equations with
    the accelerations, and what it stores is kinetic energy.
    """

    height: Array
    mass: Array
    name: str = "added_mass"

    inertial = True
    force_kernel = _added_mass_forces
    tangent_kernel = _added_mass_tangents
    energy_kernel = _added_mass_energy

    @staticmethod
    def of(strips: Strips, density: float, coefficient: float) -> AddedMass:
        return AddedMass(strips.height, density * coefficient * displaced_volume(strips))

    @cached_property
    def constants(self) -> Array:
        return self.mass[:, None].copy()


_INERTIA, _DRAG = 0, 1
"""Columns of a strip's constants: rho (1 + Ca) V in kg, and rho/2 Cd D l in kg/m."""


@force_kernel
def _morison_forces(
    motion: Array, constants: Array, row: Array, memory: Array, force: Array
) -> float:
    n = len(motion)
    water = row.reshape(2, n, 3)
    relative, accelerated = np.empty(3), np.empty(3)
    lost = 0.0
    for i in range(n):
        axis = motion[i, 9:12]
        for j in range(3):
            relative[j] = water[0, i, j] - motion[i, 6 + j]
            accelerated[j] = water[1, i, j]
        slip, slide = _along(relative, axis), _along(accelerated, axis)
        for j in range(3):
            relative[j] -= slip * axis[j]
            accelerated[j] -= slide * axis[j]
        speed = np.sqrt(_along(relative, relative))
        for j in range(3):
            drag = constants[i, _DRAG] * speed * relative[j]
            force[i, j] = constants[i, _INERTIA] * accelerated[j] + drag
            force[i, 3 + j] = 0.0
        lost += constants[i, _DRAG] * speed**3
    return lost


@tangent_kernel
def _morison_tangents(
    motion: Array, constants: Array, row: Array, memory: Array, blocks: Array
) -> None:
    """d(|w| w)/dw = |w| I + w w' / |w|, and w = P (u_w - v) with P = I - e e' of the axis e."""
    n = len(motion)
    water = row.reshape(2, n, 3)
    slip, w = np.empty(3), np.empty(3)
    by_w, projector = np.empty((3, 3)), np.empty((3, 3))
    for i in range(n):
        axis = motion[i, 9:12]
        for j in range(3):
            slip[j] = water[0, i, j] - motion[i, 6 + j]
        along = _along(slip, axis)
        pushed = _along(water[1, i], axis)
        for j in range(3):
            w[j] = slip[j] - along * axis[j]
            for k in range(3):
                projector[j, k] = (1.0 if j == k else 0.0) - axis[j] * axis[k]
        speed = np.sqrt(_along(w, w))
        for j in range(3):
            for k in range(3):
                outer = w[j] * w[k] / speed if speed > 0 else 0.0
                by_w[j, k] = constants[i, _DRAG] * (outer + (speed if j == k else 0.0))
        for j in range(3):
            for k in range(3):
                for m in range(3):
                    turned = axis[m] * slip[k] + (along if m == k else 0.0)
                    blocks[i, 1, j, k] -= by_w[j, m] * projector[m, k]
                    blocks[i, 3, j, k] -= by_w[j, m] * turned
                turned = axis[j] * water[1, i, k] + (pushed if j == k else 0.0)
                blocks[i, 3, j, k] -= constants[i, _INERTIA] * turned


@dataclass(frozen=True, eq=False)
class MorisonForce(KernelLoad):
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

    force_kernel = _morison_forces
    tangent_kernel = _morison_tangents

    @property
    def height(self) -> Array:
        return self.strips.height

    @cached_property
    def constants(self) -> Array:
        inertia = self.density * (1 + self.added_mass_coefficient) * displaced_volume(self.strips)
        area = self.strips.diameter * self.strips.length
        return np.column_stack([inertia, 0.5 * self.density * self.drag_coefficient * area])

    def rows(self, time: Array, rise: Array) -> Array:
        """(t, 6 n) velocity and acceleration of the water at the strips."""
        if len(self.kinematics.omega) == 0:
            return np.zeros((len(time), 6 * len(self.height)))
        return rise[:, None] * self.kinematics.at_times(time).reshape(len(time), -1)


def displaced_volume(strips: Strips) -> Array:
    """(n,) volume of each strip in m3."""
    return np.pi / 4 * strips.diameter**2 * strips.length
