"""What the sea is: water at rest or in waves, on a current, at a level."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal

import numpy as np

from offwind_pin.errors import InputError
from offwind_pin.loads.current import Current, CurrentSum, mean_velocity
from offwind_pin.loads.linear_waves import LinearWaves
from offwind_pin.loads.steady_wave import SteadyWave
from offwind_pin.loads.stream_function import StreamFunctionWaves
from offwind_pin.loads.water_series import Stretching
from offwind_pin.loads.wave_field import WaveField
from offwind_pin.loads.wave_spectra import iec_peak_shape, jonswap
from offwind_pin.turbines.base import Array

_STREAM = 1
"""Keeps the random numbers of waves and wind apart when a case gives both one seed."""


@dataclass(frozen=True, kw_only=True)
class Sea(ABC):
    """What all seas have.

    Attributes
    ----------
    current : over height, or None for none
    water_level : mean height of the surface in m (tide, surge)
    stretching : how linear waves act above the mean water level, see :class:`WaterSeries`
    """

    current: Current | CurrentSum | None = None
    water_level: float = 0.0
    stretching: Stretching = "none"

    @abstractmethod
    def waves(self, depth: float, gravity: float) -> WaveField | None:
        """The waves over a depth in m under a gravity in m/s2, or None for none."""

    @property
    @abstractmethod
    def in_words(self) -> str:
        """The waves as a reader is told of them."""


@dataclass(frozen=True)
class StillWater(Sea):
    """Water without waves: added mass, and drag on a structure that moves."""

    def waves(self, depth: float, gravity: float) -> None:
        return None

    @property
    def in_words(self) -> str:
        return "still water"


@dataclass(frozen=True)
class RegularWaves(Sea):
    """A linear wave of one height and period, its crest at the axis at time 0.

    height in m from trough to crest, period in s, direction_deg in which it travels, from +x
    towards +y.
    """

    height: float
    period: float
    direction_deg: float = 0.0

    def __post_init__(self) -> None:
        for name in ("height", "period"):
            require_positive(f"waves, field {name}", getattr(self, name))
        require_angle(self.direction_deg)

    def waves(self, depth: float, gravity: float) -> LinearWaves:
        return LinearWaves.free(
            self.period,
            np.ones(1),
            np.array([self.height / 2 + 0j]),
            depth,
            gravity,
            float(np.radians(self.direction_deg)),
        )

    @property
    def in_words(self) -> str:
        return f"regular waves, {self.height:g} m high, {self.period:g} s"


@dataclass(frozen=True)
class StreamWaves(Sea):
    """A steep regular wave by stream function theory, exact up to its surface.

    The wave is carried by the mean over the depth of the current along it; the current's own
    profile acts on the structure.

    height in m from trough to crest, period in s as a fixed observer sees it, direction_deg in
    which it travels from +x towards +y, crest_time in s at which its crest is at the axis, order of
    the series or None for one that is large enough
    """

    height: float
    period: float
    direction_deg: float = 0.0
    crest_time: float = 0.0
    order: int | None = None

    def __post_init__(self) -> None:
        require_angle(self.direction_deg)
        if not np.isfinite(self.crest_time):
            where = "waves, field crest_time"
            raise InputError(where, self.crest_time, "a time in s", "Correct it.")

    def waves(self, depth: float, gravity: float) -> StreamFunctionWaves:
        angle = float(np.radians(self.direction_deg))
        along = 0.0
        if self.current is not None:
            mean = mean_velocity(self.current, depth)
            along = float(mean @ [np.cos(angle), np.sin(angle), 0.0])
        wave = SteadyWave.solve(
            self.height,
            period=self.period,
            depth=depth,
            gravity=gravity,
            eulerian_current=along,
            order=self.order,
        )
        return StreamFunctionWaves(wave, direction=angle, crest_time=self.crest_time)

    @property
    def in_words(self) -> str:
        return f"stream function wave, {self.height:g} m high, {self.period:g} s"


@dataclass(frozen=True)
class IrregularWaves(Sea):
    """Waves of a JONSWAP spectrum, with a peak shape of 1 of Pierson and Moskowitz's.

    significant_height in m, peak_period in s; repeat_period in s should exceed the case's length;
    peak_shape from 1 to 7, or ``"iec"`` for IEC's rule; direction_deg in which they travel, from +x
    towards +y
    """

    significant_height: float
    peak_period: float
    seed: int
    repeat_period: float
    peak_shape: float | Literal["iec"] = 1.0
    direction_deg: float = 0.0

    def __post_init__(self) -> None:
        for name in ("significant_height", "peak_period", "repeat_period"):
            require_positive(f"waves, field {name}", getattr(self, name))
        if self.repeat_period < 5 * self.peak_period:
            allowed = f"at least five peak periods ({5 * self.peak_period} s)"
            raise InputError("waves, field repeat_period", self.repeat_period, allowed, "Raise it.")
        if not (isinstance(self.seed, int) and self.seed >= 0):
            raise InputError("waves, field seed", self.seed, "a whole number from 0", "Correct it.")
        if self.peak_shape != "iec" and not (
            isinstance(self.peak_shape, int | float) and 1 <= self.peak_shape <= 7
        ):
            allowed = "1 to 7, or iec"
            raise InputError("waves, field peak_shape", self.peak_shape, allowed, "Correct it.")
        require_angle(self.direction_deg)

    @property
    def shape(self) -> float:
        """The peak-shape factor as a number."""
        if self.peak_shape == "iec":
            return iec_peak_shape(self.significant_height, self.peak_period)
        return float(self.peak_shape)

    def waves(self, depth: float, gravity: float) -> LinearWaves:
        """Components from 0.4 to 5 times the peak frequency.

        They hold 99.8 % of the variance, and shorter waves are lost on a cylinder many times their
        length.
        """
        step, peak = 1 / self.repeat_period, 1 / self.peak_period
        harmonic: Array = np.arange(np.ceil(0.4 * peak / step), np.floor(5 * peak / step) + 1)
        density = jonswap(harmonic * step, self.significant_height, self.peak_period, self.shape)
        phase = np.random.default_rng((self.seed, _STREAM)).uniform(0, 2 * np.pi, len(harmonic))
        amplitude = np.sqrt(2 * density * step) * np.exp(-1j * phase)
        angle = float(np.radians(self.direction_deg))
        return LinearWaves.free(self.repeat_period, harmonic, amplitude, depth, gravity, angle)

    @property
    def in_words(self) -> str:
        height, period = self.significant_height, self.peak_period
        kind = "Pierson-Moskowitz" if self.shape == 1 else f"JONSWAP (gamma {self.shape:.3g})"
        return f"{kind} waves, Hs {height:g} m, Tp {period:g} s"


def require_angle(direction_deg: float) -> None:
    """Refuse what is no direction of waves."""
    if not np.isfinite(direction_deg):
        where = "waves, field direction_deg"
        raise InputError(where, direction_deg, "an angle in degrees", "Correct it.")


def require_positive(where: str, value: float) -> None:
    """Refuse what is no positive number."""
    if not (np.isfinite(value) and value > 0):
        raise InputError(where, value, "a positive number", "Correct it.")
