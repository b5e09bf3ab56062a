"""Hydrostatic pressure on the walls of a member in water, or filled with water."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.records import part
from offwind_pin.loads.point_load import AXIS, BY_AXIS, KernelLoad, force_kernel, tangent_kernel
from offwind_pin.loads.sea.forces.strips import Strips, Water, wet_share

_LIFT, _BOTTOM, _LENGTH, _STILL, _CAP = range(5)
"""Columns of a point's constants: rho g V in N, the strip's ends in m and its wet share in still
water; for the end of the wetted part p A in N."""
_SURFACE = 0
"""Height of the surface among the time inputs."""
_E = AXIS.start


@force_kernel
def _pressure_forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    for i in range(len(motion)):
        axis, still = part(motion[i], _E, _E + 3), constants[i, _STILL]
        share = wet_share(time_inputs[_SURFACE], constants[i, _BOTTOM], constants[i, _LENGTH])
        across = constants[i, _LIFT] * (share - still)
        for j in range(3):
            force[i, j] = -(across * axis[2] + constants[i, _CAP]) * axis[j]
            force[i, 3 + j] = 0.0
        force[i, 2] += constants[i, _LIFT] * still + across
    return 0.0


@tangent_kernel
def _pressure_tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    for i in range(len(motion)):
        axis = part(motion[i], _E, _E + 3)
        share = wet_share(time_inputs[_SURFACE], constants[i, _BOTTOM], constants[i, _LENGTH])
        across = constants[i, _LIFT] * (share - constants[i, _STILL])
        for j in range(3):
            blocks[i, BY_AXIS, j, 2] -= across * axis[j]
            blocks[i, BY_AXIS, j, j] -= across * axis[2] + constants[i, _CAP]


@dataclass(frozen=True, eq=False)
class Buoyancy(KernelLoad):
    """Hydrostatic pressure on the wetted sides of a member, from its lower end to the surface.

    With the area A, the axis e and the pressure p = rho g (level - z), the force on the sides of a
    bent and tapered member per length is rho g A z_hat + d(p A e)/ds: Archimedes' force less that
    on the two dry ends of a piece. The sum is rho g V z_hat on every strip and -p A e at the lower
    end. The term d(p A e)/ds, which contains the pressure difference across a bend and the pressure
    on annuli where the diameter jumps, does no work in the motion of a chain of constant length and
    is therefore applied at the ends. This changes the meaning of a section's axial force: it is
    that of the wall plus p A (the effective one).

    A strip that a wave wets above still water has the part of the force normal to its axis,
    rho g V (z_hat - (z_hat.e) e) times its wet share; a strip below that falls dry loses that part.
    Strips and pressures are all taken at undeformed heights, so that settlement does not change the
    pressure at the lower end alone. A top under water is closed and takes the pressure. Omitted are
    the moment of inclined sections (rho g pi D^4/64 times the tilt at the lower end, and times its
    change above) and, along the axis, the wave pressure on tapers and annuli.

    It is not exactly conservative, since the force on the ends follows the axis; its power counts
    as work.

    Attributes
    ----------
    strips : Strips
        Strips of the wetted part; the last point is its lower end.
    weight : float, N/m3
        Specific weight rho g; negative for water inside.
    end_area : float, m2
        Area of the lower end.
    level : float, m
        Height of still water.
    water : Water or None
        Water with a moving surface; None if all strips stay wet.
    """

    strips: Strips
    weight: float
    end_area: float
    level: float
    water: Water | None = None
    name: str = "buoyancy"

    force_kernel = _pressure_forces
    tangent_kernel = _pressure_tangents

    @cached_property
    def height(self) -> Array:
        """(n + 1,) centres of the strips, and the lower end of the lowest."""
        end = self.strips.height[0] - self.strips.length[0] / 2
        return np.append(self.strips.height, end)

    @cached_property
    def constants(self) -> Array:
        result = np.zeros((len(self.height), 5))
        result[:-1, _LIFT] = self.weight * self.strips.volume
        result[:-1, [_BOTTOM, _LENGTH]] = self.strips.ends
        result[:-1, _STILL] = [wet_share(self.level, *end) for end in self.strips.ends]
        result[-1, [_BOTTOM, _LENGTH]] = -np.inf, 1.0
        result[-1, _CAP] = self.weight * self.end_area * (self.level - self.height[-1])
        return result

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 1) height of the surface in m."""
        if self.water is None:
            return np.full((len(time), 1), self.level)
        return self.water.surface(time, ramp_factor)[:, None]
