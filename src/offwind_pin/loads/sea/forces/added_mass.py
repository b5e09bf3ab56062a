"""Water that moves with the structure: added mass around it, or water inside it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import inner
from offwind_pin.base.records import part
from offwind_pin.loads.point_load import (
    ACCELERATION,
    AXIS,
    BY_ACCELERATION,
    BY_AXIS,
    VELOCITY,
    KernelLoad,
    energy_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.sea.forces.strips import Strips, Water, wet_share

_MASS, _BOTTOM, _LENGTH = range(3)
"""Columns of a strip's constants: mass in kg; with a moving surface also its ends in m."""
_SURFACE = 0
"""Height of the surface among the time inputs."""
_V, _E, _A = VELOCITY.start, AXIS.start, ACCELERATION.start


@inner
def along(a: Array, b: Array) -> float:
    """Scalar product of two 3-vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inner
def _resist(motion: Array, mass: float, force: Array) -> None:
    """Set the force of a mass that an acceleration across the axis moves, at one point."""
    axis, acceleration = part(motion, _E, _E + 3), part(motion, _A, _A + 3)
    slide = along(axis, acceleration)
    for j in range(3):
        force[j] = -mass * (acceleration[j] - slide * axis[j])
        force[3 + j] = 0.0


@inner
def _resist_tangents(motion: Array, mass: float, blocks: Array) -> None:
    """Set its derivatives by acceleration and axis."""
    axis, acceleration = part(motion, _E, _E + 3), part(motion, _A, _A + 3)
    slide = along(axis, acceleration)
    for j in range(3):
        for k in range(3):
            blocks[BY_ACCELERATION, j, k] = mass * axis[j] * axis[k]
            blocks[BY_AXIS, j, k] = mass * axis[j] * acceleration[k]
        blocks[BY_ACCELERATION, j, j] -= mass
        blocks[BY_AXIS, j, j] += mass * slide


@force_kernel
def _added_mass_forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    for i in range(len(motion)):
        _resist(motion[i], constants[i, _MASS], force[i])
    return 0.0


@tangent_kernel
def _added_mass_tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    for i in range(len(motion)):
        _resist_tangents(motion[i], constants[i, _MASS], blocks[i])


@energy_kernel
def _added_mass_energy(motion: Array, constants: Array, memory: Array) -> float:
    energy = 0.0
    for i in range(len(motion)):
        axis, velocity = part(motion[i], _E, _E + 3), part(motion[i], _V, _V + 3)
        square = along(velocity, velocity) - along(velocity, axis) ** 2
        energy += constants[i, _MASS] * square / 2
    return energy


@dataclass(frozen=True, eq=False)
class AddedMass(KernelLoad):
    """Added mass per strip, rho Ca pi D^2/4 l, in kg.

    It acts normal to the axis and is part of the mass matrix; the energy it stores is kinetic.
    """

    height: Array
    mass: Array
    name: str = "added_mass"

    inertial = True
    force_kernel = _added_mass_forces
    tangent_kernel = _added_mass_tangents
    energy_kernel = _added_mass_energy

    @staticmethod
    def of(
        strips: Strips, density: float, coefficient: float | Array, name: str = "added_mass"
    ) -> AddedMass:
        """Added mass of strips that are always wet; one coefficient, or one per strip."""
        return AddedMass(strips.height, density * coefficient * strips.volume, name)

    @cached_property
    def constants(self) -> Array:
        return self.mass[:, None].copy()


@force_kernel
def _splash_forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    for i in range(len(motion)):
        share = wet_share(time_inputs[_SURFACE], constants[i, _BOTTOM], constants[i, _LENGTH])
        _resist(motion[i], share * constants[i, _MASS], force[i])
    return 0.0


@tangent_kernel
def _splash_tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    for i in range(len(motion)):
        share = wet_share(time_inputs[_SURFACE], constants[i, _BOTTOM], constants[i, _LENGTH])
        _resist_tangents(motion[i], share * constants[i, _MASS], blocks[i])


@dataclass(frozen=True, eq=False)
class SplashAddedMass(KernelLoad):
    """Added mass of strips in the splash zone: mass (n,) in kg times the wet share.

    The force is the current mass times the acceleration normal to the axis. The rate of change of
    the mass times the velocity (slamming) is omitted. Since the mass changes, its energy is not a
    function of the state, and its power counts as work.
    """

    strips: Strips
    mass: Array
    water: Water
    name: str = "splash_added_mass"

    inertial = True
    force_kernel = _splash_forces
    tangent_kernel = _splash_tangents

    @property
    def height(self) -> Array:
        return self.strips.height

    @cached_property
    def constants(self) -> Array:
        return np.column_stack([self.mass, self.strips.ends])

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 1) height of the surface in m."""
        return self.water.surface(time, ramp_factor)[:, None]
