"""Wind drag on the tower, by the drag term of Morison's equation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated

import numpy as np
from pydantic import Field

from offwind_pin.base.definition import (
    Array,
    Direction,
    NonNegative,
    Positive,
    key,
)
from offwind_pin.base.errors import InputError
from offwind_pin.loads.load_definition import LoadDefinition, Structure
from offwind_pin.loads.point_load import KernelLoad
from offwind_pin.loads.sea.forces.morison import morison_forces, morison_tangents
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.wind.profiles import Gust, PowerLaw, Profile
from offwind_pin.structure.section import outer_diameter

STRIP_LENGTH = 1.0
"""Longest strip of the tower in m: with the power law's 0.14 its drag is accurate to 1e-4."""


class TowerWind(LoadDefinition, kw_only=False):
    """Wind that blows past the tower.

    Attributes
    ----------
    speed : float, m/s
        Mean at the reference height.
    reference_height : float, m
        Above the still water level.
    profile : PowerLaw or LogLaw
        :class:`PowerLaw` (by default that of IEC 61400-3-1) or :class:`LogLaw`.
    drag_coefficient : float
        Of the tower; 0.6 to 0.7 for a smooth one at the Reynolds numbers of a storm.
    direction_deg : float
        Direction towards which it blows, in degrees from +x (downwind) towards +y.
    gust : ExtremeOperatingGust, WindSeries or None
        :class:`ExtremeOperatingGust`, :class:`WindSeries`, or None for a steady wind. It is ramped
        at the start of a simulation; statics and modes use the mean.
    air_density : float, kg/m3
        1.225 in IEC 61400-1.
    """

    speed: Annotated[NonNegative, Field(le=90)] = key("speed_m_per_s")
    reference_height: Annotated[Positive, Field(le=500)] = key("reference_height_m")
    # Optional in a file; in Python the coefficient after it would then need a default as well.
    profile: Annotated[Profile, Field(default_factory=PowerLaw)]
    drag_coefficient: Annotated[NonNegative, Field(le=3)]
    direction_deg: Direction = Field(default=0.0, kw_only=True)
    gust: Gust | None = Field(default=None, kw_only=True)
    air_density: Annotated[Positive, Field(ge=0.5, le=2)] = key(
        "air_density_kg_per_m3", default=1.225, kw_only=True
    )

    def on(self, structure: Structure) -> TowerDrag:
        """Create the drag on a structure, see :func:`tower_drag`.

        Parameters
        ----------
        structure : Structure
            Turbine, chain and hydrodynamic model, such as a :class:`System`.

        Returns
        -------
        TowerDrag
        """
        return tower_drag(structure, self)


@dataclass(frozen=True, eq=False)
class TowerDrag(KernelLoad):
    """Drag rho/2 Cd D l |w| w per strip, w the wind relative to it and normal to its axis.

    It is Morison's force without inertia. The added mass of the air, about 1e-3 of the tower's
    mass, is omitted.
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
        """(t, 1 + 6 n) a surface above all strips, velocity of the air, zero acceleration."""
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


def tower_drag(system: Structure, wind: TowerWind) -> TowerDrag:
    """Drag of a wind on a system's structure, for ``simulate(loads=[...])`` and ``static``.

    It acts from the highest water level, or from still water level of a dry structure, up to the
    yaw bearing.

    Parameters
    ----------
    system : Structure
        Turbine, chain and hydrodynamic model, such as a :class:`System`.
    wind : TowerWind
        Mean wind and gust.

    Returns
    -------
    TowerDrag

    Raises
    ------
    InputError
        Nothing of the structure is above water.
    """
    low, top = max(_water_line(system), system.chain.base), system.chain.top
    if low >= top:
        raise InputError(
            "tower wind",
            f"a structure up to z = {top:g} m",
            f"one that reaches above the water (z = {low:g} m)",
            "Leave the wind out.",
        )
    count = int(np.ceil((top - low) / STRIP_LENGTH))
    edges = np.linspace(low, top, count + 1)
    height = (edges[:-1] + edges[1:]) / 2
    strips = Strips(height, np.diff(edges), outer_diameter(system.turbine, height))
    return TowerDrag(strips, wind)


def _water_line(system: Structure) -> float:
    """Height in m that the water does not exceed; still water level of a dry structure."""
    if system.hydrodynamics is None:
        return 0.0
    return system.hydrodynamics.surface.highest
