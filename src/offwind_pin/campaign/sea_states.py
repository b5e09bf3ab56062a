"""The sea as a case file gives it: waves of many kinds, a current, a water level."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.dynamics.sea import IrregularWaves, RegularWaves, Sea, StillWater, StreamWaves
from offwind_pin.loads.current import (
    FASTEST,
    SURFACE_LAYER,
    Current,
    CurrentSum,
    CurrentTable,
    PowerLawCurrent,
    SurfaceCurrent,
    UniformCurrent,
)
from offwind_pin.loads.water_series import Stretching
from offwind_pin.turbines.base import Definition, NonNegative, Number, Positive

SHORTEST_REPEAT = 600.0
"""s; waves of shorter cases repeat no sooner."""

Direction = Annotated[Number, Field(ge=-360, le=360)]
WavePeriod = Annotated[Positive, Field(ge=1, le=30)]


class CurrentProfile(Definition):
    """What every current has: its speed at the mean water level, and where it goes."""

    speed: Annotated[NonNegative, Field(le=FASTEST)] = Field(alias="speed_m_per_s")
    direction_deg: Direction = 0.0

    @abstractmethod
    def current(self) -> Current:
        """For :class:`Sea`."""


class UniformProfile(CurrentProfile):
    """The same at all depths."""

    kind: Literal["uniform"]

    def current(self) -> Current:
        return UniformCurrent(self.speed, self.direction_deg)


class PowerLawProfile(CurrentProfile):
    """See :class:`PowerLawCurrent`."""

    kind: Literal["power_law"]
    exponent: Annotated[Positive, Field(le=1)] = 1 / 7

    def current(self) -> Current:
        return PowerLawCurrent(self.speed, self.direction_deg, self.exponent)


class SurfaceProfile(CurrentProfile):
    """See :class:`SurfaceCurrent`."""

    kind: Literal["surface"]
    reach: Positive = Field(alias="reach_m", default=SURFACE_LAYER)

    def current(self) -> Current:
        return SurfaceCurrent(self.speed, self.direction_deg, self.reach)


class TableProfile(CurrentProfile):
    """Factors of the speed at depths below the mean water level."""

    kind: Literal["table"]
    depth: Annotated[tuple[NonNegative, ...], Field(min_length=2)] = Field(alias="depth_m")
    factor: Annotated[tuple[Number, ...], Field(min_length=2)]

    @model_validator(mode="after")
    def _table_is_complete(self) -> TableProfile:
        if len(self.depth) != len(self.factor):
            raise ValueError(
                f"depth_m has {len(self.depth)} entries and factor {len(self.factor)}; give one "
                "factor for each"
            )
        if np.any(np.diff(self.depth) <= 0):
            raise ValueError("depth_m must rise strictly; sort the table from the surface down")
        return self

    def current(self) -> Current:
        return CurrentTable(self.speed, self.direction_deg, self.depth, self.factor)


Profile = Annotated[
    UniformProfile | PowerLawProfile | SurfaceProfile | TableProfile, Field(discriminator="kind")
]


class DrySea(Definition):
    """No water."""

    kind: Literal["dry"]

    @property
    def has_waves(self) -> bool:
        return False

    @property
    def marked_frequency(self) -> None:
        """No waves, no frequency."""
        return

    def sea(self, seed: int, duration: float, folder: Path) -> None:
        """None: the structure is dry."""
        return


class Water(Definition):
    """What all water has.

    current : one, or several that are added up; water_level : of tide and surge
    """

    current: Profile | Annotated[tuple[Profile, ...], Field(min_length=1)] | None = None
    water_level: Annotated[Number, Field(ge=-20, le=20)] = Field(alias="water_level_m", default=0.0)

    @property
    def has_waves(self) -> bool:
        return True

    @property
    def marked_frequency(self) -> float | None:
        """In Hz, where a reader looks for the waves in a spectrum."""
        return None

    @abstractmethod
    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        """For :func:`build`: duration of the case in s, folder where relative paths start."""

    def settings(self) -> dict[str, Any]:
        """Of every :class:`Sea`."""
        current: Current | CurrentSum | None = None
        if isinstance(self.current, tuple):
            current = CurrentSum(tuple(part.current() for part in self.current))
        elif self.current is not None:
            current = self.current.current()
        return {"current": current, "water_level": self.water_level}


class StillSea(Water):
    """Water without waves."""

    kind: Literal["still_water"]

    @property
    def has_waves(self) -> bool:
        return False

    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        return StillWater(**self.settings())


class Waves(Water):
    """What all linear waves have."""

    direction_deg: Direction = 0.0
    stretching: Stretching = "none"

    def settings(self) -> dict[str, Any]:
        return super().settings() | {"stretching": self.stretching}


class RegularSea(Waves):
    """A linear wave of one height and period."""

    kind: Literal["regular_waves"]
    height: Annotated[Positive, Field(le=40)] = Field(alias="height_m")
    period: WavePeriod = Field(alias="period_s")

    @property
    def marked_frequency(self) -> float | None:
        return 1 / self.period

    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        return RegularWaves(self.height, self.period, self.direction_deg, **self.settings())


class StreamSea(Water):
    """A steep regular wave by stream function theory."""

    kind: Literal["stream_function_waves"]
    height: Annotated[Positive, Field(le=40)] = Field(alias="height_m")
    period: WavePeriod = Field(alias="period_s")
    direction_deg: Direction = 0.0
    crest_time: Number = Field(alias="crest_time_s", default=0.0)
    order: Annotated[int, Field(ge=2, le=128)] | None = None

    @property
    def marked_frequency(self) -> float | None:
        return 1 / self.period

    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        return StreamWaves(
            self.height,
            self.period,
            self.direction_deg,
            self.crest_time,
            self.order,
            **self.settings(),
        )


class IrregularSea(Waves):
    """Waves of a spectrum; the case's seed draws their phases."""

    kind: Literal["irregular_waves"]
    significant_height: Annotated[Positive, Field(le=30)] = Field(alias="significant_height_m")
    peak_period: WavePeriod = Field(alias="peak_period_s")
    peak_shape: Annotated[Number, Field(ge=1, le=7)] | Literal["iec"] = 1.0

    @property
    def marked_frequency(self) -> float | None:
        return 1 / self.peak_period

    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        return IrregularWaves(
            self.significant_height,
            self.peak_period,
            seed=seed,
            repeat_period=max(duration, SHORTEST_REPEAT),
            peak_shape=self.peak_shape,
            direction_deg=self.direction_deg,
            **self.settings(),
        )


SeaChoice = Annotated[
    DrySea | StillSea | RegularSea | StreamSea | IrregularSea, Field(discriminator="kind")
]
