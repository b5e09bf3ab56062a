"""Drag of the wind on the tower, by the drag part of Morison's force."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.loads.point_load import KernelLoad
from offwind_pin.loads.sea.forces.morison import morison_forces, morison_tangents
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.wind.profiles import Gust, Profile, check_positive

STRIP_LENGTH = 1.0
"""Longest strip of the tower in m: with the power law's 0.14 its drag is met within 1e-4."""


@dataclass(frozen=True)
class TowerWind:
    """Wind that blows past the tower.

    Attributes
    ----------
    speed : mean at the reference height, in m/s
    reference_height : in m above the still water level
    profile : :class:`PowerLaw` or :class:`LogLaw`
    drag_coefficient : of the tower; 0.6 to 0.7 for a smooth one at the Reynolds numbers of a storm
    direction : towards which it blows in rad, from x (downwind) to y
    gust : :class:`ExtremeOperatingGust`, :class:`WindSeries`, or None for a steady wind. It rises
        as a simulation starts; statics and modes see the mean
    air_density : in kg/m3; IEC 61400-1 takes 1.225
    """

    speed: float
    reference_height: float
    profile: Profile
    drag_coefficient: float
    direction: float = 0.0
    gust: Gust | None = None
    air_density: float = 1.225

    def __post_init__(self) -> None:
        check_positive("tower wind, speed", self.speed, zero=True)
        check_positive("tower wind, reference_height", self.reference_height)
        check_positive("tower wind, drag_coefficient", self.drag_coefficient, zero=True)
        check_positive("tower wind, air_density", self.air_density)
        if not np.isfinite(self.direction):
            raise InputError("tower wind, direction", self.direction, "an angle in rad", "Give it.")


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
        towards = np.array([np.cos(wind.direction), np.sin(wind.direction), 0.0])
        rows = np.zeros((len(time), 1 + 6 * len(self.height)))
        rows[:, 1 : 1 + 3 * len(self.height)] = (speed[:, :, None] * towards).reshape(len(time), -1)
        return rows
