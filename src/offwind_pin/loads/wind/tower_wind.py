"""The wind that blows past the tower."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from offwind_pin.base.definition import Definition, Direction, NonNegative, Positive, key
from offwind_pin.loads.wind.profiles import Gust, PowerLaw, Profile


class TowerWind(Definition, kw_only=False):
    """Wind that blows past the tower.

    Attributes
    ----------
    speed : float, m/s, mean at the reference height
    reference_height : float, m, above the still water level
    profile : :class:`PowerLaw` (by default that of IEC 61400-3-1) or :class:`LogLaw`
    drag_coefficient : float, of the tower; 0.6 to 0.7 for a smooth one at the Reynolds numbers of a
        storm
    direction_deg : float, degrees from +x (downwind) towards +y, towards which it blows
    gust : :class:`ExtremeOperatingGust`, :class:`WindSeries`, or None for a steady wind. It rises
        as a simulation starts; statics and modes see the mean
    air_density : float, kg/m3; IEC 61400-1 takes 1.225
    """

    speed: Annotated[NonNegative, Field(le=90)] = key("speed_m_per_s")
    reference_height: Annotated[Positive, Field(le=500)] = key("reference_height_m")
    # Optional in a file; in Python the coefficient after it would need a default too.
    profile: Annotated[Profile, Field(default_factory=PowerLaw)]
    drag_coefficient: Annotated[NonNegative, Field(le=3)]
    direction_deg: Direction = Field(default=0.0, kw_only=True)
    gust: Gust | None = Field(default=None, kw_only=True)
    air_density: Annotated[Positive, Field(ge=0.5, le=2)] = key(
        "air_density_kg_per_m3", default=1.225, kw_only=True
    )
