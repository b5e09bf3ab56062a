"""The sea as a case file gives it: waves of many kinds, a current, a water level."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, NonNegative, Number, Positive
from offwind_pin.loads.sea.current import (
    FASTEST,
    SURFACE_LAYER,
    Current,
    CurrentSum,
    CurrentTable,
    PowerLawCurrent,
    SurfaceCurrent,
    UniformCurrent,
)
from offwind_pin.loads.sea.irregular_waves import Amplitudes, Crest, IrregularWaves
from offwind_pin.loads.sea.kinematics import Stretching
from offwind_pin.loads.sea.measured_waves import MeasuredWaves
from offwind_pin.loads.sea.sea import RegularWaves, Sea, StillWater, StreamWaves
from offwind_pin.loads.sea.waves.spectra import (
    JonswapSpectrum,
    TableSpectrum,
    TmaSpectrum,
    WaveSpectrum,
    WhiteNoise,
)
from offwind_pin.loads.sea.waves.spreading import LARGEST_EXPONENT, Spreading, SpreadingKind

SHORTEST_REPEAT = 600.0
"""s; waves of shorter cases repeat no sooner."""

Direction = Annotated[Number, Field(ge=-360, le=360)]
WavePeriod = Annotated[Positive, Field(ge=1, le=30)]
SignificantHeight = Annotated[Positive, Field(le=30)]
Frequency = Annotated[Positive, Field(le=5)]
PeakShapeInput = Annotated[Number, Field(ge=1, le=7)] | Literal["iec"]


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
    order: Literal[1, 2] = 1
    doppler: bool = False

    @model_validator(mode="after")
    def _doppler_has_a_current(self) -> Waves:
        if self.doppler and self.order == 2:
            raise ValueError("doppler: true goes with order: 1 only; leave one of them out")
        if self.doppler and self.current is None:
            raise ValueError("doppler: true needs a current; give it, or leave doppler out")
        return self

    def settings(self) -> dict[str, Any]:
        return super().settings() | {
            "stretching": self.stretching,
            "order": self.order,
            "doppler": self.doppler,
        }


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


class SpectrumInput(Definition):
    """What every spectrum of a case file has."""

    @property
    def marked_frequency(self) -> float | None:
        """Of its peak in Hz, where that is known before a file is read."""
        return None

    @abstractmethod
    def spectrum(self, folder: Path) -> WaveSpectrum:
        """For :class:`IrregularWaves`."""


class JonswapInput(SpectrumInput):
    """See :class:`JonswapSpectrum`."""

    kind: Literal["jonswap"]
    significant_height: SignificantHeight = Field(alias="significant_height_m")
    peak_period: WavePeriod = Field(alias="peak_period_s")
    peak_shape: PeakShapeInput = 1.0

    @property
    def marked_frequency(self) -> float | None:
        return 1 / self.peak_period

    def spectrum(self, folder: Path) -> WaveSpectrum:
        return JonswapSpectrum(self.significant_height, self.peak_period, self.peak_shape)


class TmaInput(JonswapInput):
    """See :class:`TmaSpectrum`."""

    kind: Literal["tma"]  # type: ignore[assignment]

    def spectrum(self, folder: Path) -> WaveSpectrum:
        return TmaSpectrum(self.significant_height, self.peak_period, self.peak_shape)


class WhiteNoiseInput(SpectrumInput):
    """See :class:`WhiteNoise`."""

    kind: Literal["white_noise"]
    significant_height: SignificantHeight = Field(alias="significant_height_m")
    lowest: Frequency = Field(alias="lowest_hz")
    highest: Frequency = Field(alias="highest_hz")

    def spectrum(self, folder: Path) -> WaveSpectrum:
        return WhiteNoise(self.significant_height, self.lowest, self.highest)


class TableInput(SpectrumInput):
    """Densities at frequencies, here or in a CSV file; see :class:`TableSpectrum`."""

    kind: Literal["table"]
    file: Path | None = None
    frequency: tuple[Number, ...] = Field(alias="frequency_hz", default=())
    density: tuple[Number, ...] = Field(alias="density_m2_per_hz", default=())

    @model_validator(mode="after")
    def _here_or_there(self) -> TableInput:
        if (self.file is None) == (not self.frequency and not self.density):
            raise ValueError("give either file, or frequency_hz and density_m2_per_hz")
        return self

    @property
    def marked_frequency(self) -> float | None:
        if self.file is not None or len(self.frequency) != len(self.density):
            return None
        return self.frequency[int(np.argmax(self.density))]

    def spectrum(self, folder: Path) -> WaveSpectrum:
        if self.file is not None:
            return TableSpectrum.read(folder / self.file)
        return TableSpectrum(self.frequency, self.density, "field sea.spectrum")


SpectrumChoice = Annotated[
    JonswapInput | TmaInput | WhiteNoiseInput | TableInput, Field(discriminator="kind")
]


class SpreadingInput(Definition):
    """See :class:`Spreading`."""

    kind: SpreadingKind
    exponent: Annotated[Positive, Field(le=LARGEST_EXPONENT)]


class CrestInput(Definition):
    """See :class:`Crest`."""

    height: Annotated[Positive, Field(le=40)] = Field(alias="height_m")
    time: NonNegative = Field(alias="time_s")


class IrregularSea(Waves):
    """Waves of a spectrum; the case's seed draws them.

    Height, period and peak shape are short for a JONSWAP spectrum.
    """

    kind: Literal["irregular_waves"]
    significant_height: SignificantHeight | None = Field(alias="significant_height_m", default=None)
    peak_period: WavePeriod | None = Field(alias="peak_period_s", default=None)
    peak_shape: PeakShapeInput = 1.0
    spectrum: SpectrumChoice | None = None
    amplitudes: Amplitudes = "deterministic"
    spreading: SpreadingInput | None = None
    crest: CrestInput | None = None
    repeat_period: Annotated[Positive, Field(le=1e6)] | None = Field(
        alias="repeat_period_s", default=None
    )

    @model_validator(mode="after")
    def _one_spectrum(self) -> IrregularSea:
        given = self.model_fields_set & {"significant_height", "peak_period", "peak_shape"}
        if self.spectrum is not None and given:
            raise ValueError(
                "a spectrum has a height, a period and a shape of its own; put "
                f"{', '.join(sorted(given))} into it, or leave spectrum out"
            )
        if self.spectrum is None and (self.significant_height is None or self.peak_period is None):
            raise ValueError(
                "give significant_height_m and peak_period_s (both required), or a spectrum"
            )
        return self

    @property
    def marked_frequency(self) -> float | None:
        if self.spectrum is not None:
            return self.spectrum.marked_frequency
        return None if self.peak_period is None else 1 / self.peak_period

    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        crest, spreading = self.crest, self.spreading
        repeat = self.repeat_period
        return IrregularWaves(
            self.significant_height,
            self.peak_period,
            seed=seed,
            repeat_period=max(duration, SHORTEST_REPEAT) if repeat is None else repeat,
            peak_shape=self.peak_shape,
            direction_deg=self.direction_deg,
            spectrum=None if self.spectrum is None else self.spectrum.spectrum(folder),
            amplitudes=self.amplitudes,
            spreading=None if spreading is None else Spreading(spreading.kind, spreading.exponent),
            crest=None if crest is None else Crest(crest.height, crest.time),
            **self.settings(),
        )


class MeasuredSea(Waves):
    """A measured surface; see :class:`MeasuredWaves`."""

    kind: Literal["measured_waves"]
    file: Path
    low_cut: Frequency = Field(alias="low_cut_hz")
    high_cut: Frequency = Field(alias="high_cut_hz")
    taper: NonNegative | None = Field(alias="taper_s", default=None)

    def sea(self, seed: int, duration: float, folder: Path) -> Sea:
        return MeasuredWaves.read(
            folder / self.file,
            self.low_cut,
            self.high_cut,
            direction_deg=self.direction_deg,
            taper=self.taper,
            **self.settings(),
        )


SeaChoice = Annotated[
    DrySea | StillSea | RegularSea | StreamSea | IrregularSea | MeasuredSea,
    Field(discriminator="kind"),
]
