"""Drag of the wind on the tower, by the drag part of Morison's force."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import KernelLoad
from offwind_pin.loads.sea.forces.morison import morison_forces, morison_tangents
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.wind.tower_wind import TowerWind

STRIP_LENGTH = 1.0
"""Longest strip of the tower in m: with the power law's 0.14 its drag is met within 1e-4."""


@dataclass(frozen=True, eq=False)
class TowerDrag(KernelLoad):
    """Drag rho/2 Cd D l |w| w per strip, w the wind relative to it and normal to its axis.

    It is Morison's force without inertia. The air that moves with the tower is left out: it is
    some 1e-3 of the tower's mass.
    """

    strips: Strips
    wind: TowerWind
    name: str = "tower_wind"

    force_kernel = morison_forces
    tangent_kernel = morison_tangents

    @property
    def height(self) -> Array:
        return self.strips.height

    @cached_property
    def constants(self) -> Array:
        area = self.strips.diameter * self.strips.length
        drag = 0.5 * self.wind.air_density * self.wind.drag_coefficient * area
        return np.column_stack([np.zeros(len(area)), drag, self.strips.ends])

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 1 + 6 n) a surface that is not reached, velocity of the air, no acceleration."""
        wind = self.wind
        ratio = wind.profile.ratio(self.height, wind.reference_height)
        speed = np.tile(wind.speed * ratio, (len(time), 1))
        if wind.gust is not None:
            speed += (ramp_factor * wind.gust.at(time))[:, None]
        angle = np.radians(wind.direction_deg)
        towards = np.array([np.cos(angle), np.sin(angle), 0.0])
        rows = np.zeros((len(time), 1 + 6 * len(self.height)))
        rows[:, 1 : 1 + 3 * len(self.height)] = (speed[:, :, None] * towards).reshape(len(time), -1)
        return rows
