"""Wind on the tower as a case file gives it."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from offwind_pin.base.definition import Definition, NonNegative, Number, Positive
from offwind_pin.loads.wind.profiles import GUST_PERIOD, ExtremeOperatingGust, LogLaw, PowerLaw
from offwind_pin.loads.wind.tower_drag import TowerWind


class PowerLawWind(Definition):
    """See :class:`PowerLaw`."""

    kind: Literal["power_law"]
    exponent: Annotated[NonNegative, Field(le=1)] = 0.14

    def law(self) -> PowerLaw:
        return PowerLaw(self.exponent)


class LogLawWind(Definition):
    """See :class:`LogLaw`."""

    kind: Literal["log_law"]
    roughness: Annotated[Positive, Field(lt=0.5)] = Field(alias="roughness_m")

    def law(self) -> LogLaw:
        return LogLaw(self.roughness)


class Gust(Definition):
    """See :class:`ExtremeOperatingGust`."""

    size: Annotated[Positive, Field(le=60)] = Field(alias="size_m_per_s")
    start: NonNegative = Field(alias="start_s")
    period: Positive = Field(alias="period_s", default=GUST_PERIOD)


class TowerWindChoice(Definition):
    """See :class:`TowerWind`; IEC 61400-3-1's exponent unless a profile is given."""

    speed: Annotated[NonNegative, Field(le=90)] = Field(alias="speed_m_per_s")
    reference_height: Annotated[Positive, Field(le=500)] = Field(alias="reference_height_m")
    profile: Annotated[PowerLawWind | LogLawWind, Field(discriminator="kind")] = PowerLawWind(
        kind="power_law"
    )
    drag_coefficient: Annotated[NonNegative, Field(le=3)]
    direction_deg: Annotated[Number, Field(ge=-360, le=360)] = 0.0
    gust: Gust | None = None
    air_density: Annotated[Positive, Field(ge=0.5, le=2)] = Field(
        alias="air_density_kg_per_m3", default=1.225
    )

    def wind(self) -> TowerWind:
        gust = None
        if self.gust is not None:
            gust = ExtremeOperatingGust(self.gust.size, self.gust.start, self.gust.period)
        return TowerWind(
            self.speed,
            self.reference_height,
            self.profile.law(),
            self.drag_coefficient,
            float(np.radians(self.direction_deg)),
            gust,
            self.air_density,
        )
