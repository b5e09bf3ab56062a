"""Relative Morison forces on strips of a cylinder, normal to its deflected axis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.channels import Channel
from offwind_pin.base.definition import Array
from offwind_pin.base.records import part, stack_matrix, stack_row
from offwind_pin.loads.point_load import (
    AXIS,
    BY_AXIS,
    BY_VELOCITY,
    VELOCITY,
    KernelLoad,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.sea.forces.added_mass import along
from offwind_pin.loads.sea.forces.strips import Strips, Water, wet_share

_INERTIA, _DRAG, _BOTTOM, _LENGTH = range(4)
"""Columns of a strip's constants: rho (1 + Ca) V in kg, rho/2 Cd D l in kg/m, its ends in m."""
_SURFACE, _FLUID = range(2)
"""Indices in the time inputs: surface height, and start of the velocities (n, 3), which the
accelerations (n, 3) follow."""
_V, _E = VELOCITY.start, AXIS.start

WAVE_ELEVATION = Channel(
    "wave_elevation",
    (),
    "m",
    "surface elevation of the undisturbed wave at x = 0, relative to the mean water level",
    openfast_alias="Wave1Elev",
)


@force_kernel
def morison_forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    """Forces on strips in a fluid: water, or wind with drag alone.

    time_inputs (1 + 6 n) : surface in m, velocity (n, 3) in m/s, acceleration (n, 3) in m/s2
    """
    n = len(motion)
    relative, accelerated = stack_row(3), stack_row(3)
    power = 0.0
    for i in range(n):
        axis = part(motion[i], _E, _E + 3)
        for j in range(3):
            relative[j] = time_inputs[_FLUID + 3 * i + j] - motion[i, _V + j]
            accelerated[j] = time_inputs[_FLUID + 3 * n + 3 * i + j]
        slip, slide = along(relative, axis), along(accelerated, axis)
        for j in range(3):
            relative[j] -= slip * axis[j]
            accelerated[j] -= slide * axis[j]
        speed = np.sqrt(along(relative, relative))
        share = wet_share(time_inputs[_SURFACE], constants[i, _BOTTOM], constants[i, _LENGTH])
        inertia, drag_factor = share * constants[i, _INERTIA], share * constants[i, _DRAG]
        for j in range(3):
            drag = drag_factor * speed * relative[j]
            force[i, j] = inertia * accelerated[j] + drag
            force[i, 3 + j] = 0.0
        power += drag_factor * speed**3
    return power


@tangent_kernel
def morison_tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    """d(|w| w)/dw = |w| I + w w' / |w|, and w = P (u_w - v) with P = I - e e' of the axis e."""
    n = len(motion)
    slip, w, accelerated = stack_row(3), stack_row(3), stack_row(3)
    by_w, projector = stack_matrix(3, 3), stack_matrix(3, 3)
    for i in range(n):
        axis = part(motion[i], _E, _E + 3)
        share = wet_share(time_inputs[_SURFACE], constants[i, _BOTTOM], constants[i, _LENGTH])
        inertia, drag_factor = share * constants[i, _INERTIA], share * constants[i, _DRAG]
        for j in range(3):
            slip[j] = time_inputs[_FLUID + 3 * i + j] - motion[i, _V + j]
            accelerated[j] = time_inputs[_FLUID + 3 * n + 3 * i + j]
        slide = along(slip, axis)
        pushed = along(accelerated, axis)
        for j in range(3):
            w[j] = slip[j] - slide * axis[j]
            for k in range(3):
                projector[j, k] = (1.0 if j == k else 0.0) - axis[j] * axis[k]
        speed = np.sqrt(along(w, w))
        for j in range(3):
            for k in range(3):
                outer = w[j] * w[k] / speed if speed > 0 else 0.0
                by_w[j, k] = drag_factor * (outer + (speed if j == k else 0.0))
        for j in range(3):
            for k in range(3):
                for m in range(3):
                    turned = axis[m] * slip[k] + (slide if m == k else 0.0)
                    blocks[i, BY_VELOCITY, j, k] -= by_w[j, m] * projector[m, k]
                    blocks[i, BY_AXIS, j, k] -= by_w[j, m] * turned
                turned = axis[j] * accelerated[k] + (pushed if j == k else 0.0)
                blocks[i, BY_AXIS, j, k] -= inertia * turned


@dataclass(frozen=True, eq=False)
class MorisonForce(KernelLoad):
    """Fluid inertia and drag of a wave on strips; the added mass is in the mass matrix.

    F = rho (1 + Ca) V a_w + rho/2 Cd D l |w| w per strip, with w the relative velocity and a_w the
    water's acceleration, both normal to the axis (Rahman et al., MECC 2025, Eq. 8). Both terms act
    on the wet share of a strip. A coefficient is one number, or one per strip.
    """

    strips: Strips
    water: Water
    density: float
    added_mass_coefficient: float | Array
    drag_coefficient: float | Array
    name: str = "waves"

    force_kernel = morison_forces
    tangent_kernel = morison_tangents

    @property
    def height(self) -> Array:
        return self.strips.height

    @cached_property
    def constants(self) -> Array:
        inertia = self.density * (1 + self.added_mass_coefficient) * self.strips.volume
        area = self.strips.diameter * self.strips.length
        drag = 0.5 * self.density * self.drag_coefficient * area
        return np.column_stack([inertia, drag, self.strips.ends])

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 1 + 6 n) surface, then velocity and acceleration of the water at the strips."""
        return self.water.time_inputs(time, ramp_factor)

    @property
    def channels(self) -> tuple[Channel, ...]:
        return (WAVE_ELEVATION,)

    def outputs(self, time: Array, ramp_factor: Array) -> dict[str, Array]:
        return {WAVE_ELEVATION.name: self.water.elevation(time, ramp_factor)}
