"""Water of known motion, for loads on strips."""

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion


@dataclass(frozen=True, eq=False)
class RegularWater:
    """An Airy wave along +x at heights (n,) over a depth in m, written out once more.

    The crest passes at time 0. The surface moves if ``stretched``; it then wets strips, whose
    velocities are those of the formula at their own heights. The amplitudes of the accelerations
    are multiplied by a factor.
    """

    height: Array
    depth: float
    amplitude: float
    omega: float
    wave_number: float
    stretched: bool = False
    inertia_factor: complex = 1.0

    @property
    def highest_surface(self) -> float:
        return self.amplitude if self.stretched else 0.0

    @property
    def lowest_surface(self) -> float:
        return -self.highest_surface

    def elevation(self, time: Array, ramp_factor: Array) -> Array:
        return ramp_factor * self.amplitude * np.cos(self.omega * time)

    def surface(self, time: Array, ramp_factor: Array) -> Array:
        return ramp_factor * self.highest_surface * np.cos(self.omega * time)

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        k, above_bed = self.wave_number, self.height + self.depth
        size = self.amplitude * self.omega / np.sinh(k * self.depth)
        phase = (ramp_factor * np.exp(1j * self.omega * time))[:, None]
        velocity = np.zeros((len(time), len(self.height), 3), dtype=complex)
        velocity[..., 0] = phase * size * np.cosh(k * above_bed)
        velocity[..., 2] = phase * 1j * size * np.sinh(k * above_bed)
        surface = self.surface(time, ramp_factor)[:, None]
        moving = [velocity, 1j * self.omega * self.inertia_factor * velocity]
        parts = [surface, *(part.reshape(len(time), -1) for part in moving)]
        return np.ascontiguousarray(np.hstack(parts).real)


@dataclass(frozen=True, eq=False)
class SteadyWater:
    """A current (3,) in m/s at n strips, and a surface that stands still."""

    count: int
    current: tuple[float, float, float] = (0.0, 0.0, 0.0)
    level: float = 0.0

    @property
    def highest_surface(self) -> float:
        return self.level

    @property
    def lowest_surface(self) -> float:
        return self.level

    def elevation(self, time: Array, ramp_factor: Array) -> Array:
        return np.zeros(len(time))

    def surface(self, time: Array, ramp_factor: Array) -> Array:
        return np.full(len(time), self.highest_surface)

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        velocity = np.tile(self.current, self.count)
        row = np.concatenate([[self.level], velocity, np.zeros(3 * self.count)])
        return np.tile(row, (len(time), 1))


def upright(height: Array, velocity: float = 0.0) -> PointMotion:
    """Points at heights of a vertical axis at rest, or moving along x in m/s."""
    n = len(height)
    place = np.column_stack([np.zeros((n, 2)), height])
    moving = np.tile([velocity, 0.0, 0.0], (n, 1))
    return PointMotion(place, np.zeros((n, 3)), moving, np.tile([0.0, 0.0, 1.0], (n, 1)))
