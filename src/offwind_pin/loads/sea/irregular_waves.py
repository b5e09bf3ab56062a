"""Irregular seas drawn from a spectrum, with a crest at a chosen moment if one is asked for."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.loads.sea.sea import LinearSea, require_angle
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import (
    JonswapSpectrum,
    PeakShape,
    WaveSpectrum,
    require_positive,
)
from offwind_pin.loads.sea.waves.spreading import Spreading
from offwind_pin.loads.sea.waves.statistics import moments
from offwind_pin.loads.sea.waves.warnings import crest_cautions, irregular_wave_cautions
from offwind_pin.loads.sea.waves.wave_field import WaveField

_STREAM = 1
"""Keeps the random numbers of waves and wind apart when a case gives both one seed."""

FEWEST_COMPONENTS = 10
HIGHEST_CREST = 2.0
"""Times the significant height; one crest in 8e13 is higher (Rayleigh: exp(-8 c^2 / Hs^2))."""

Amplitudes = Literal["deterministic", "random"]


@dataclass(frozen=True)
class Crest:
    """A crest of a height in m above the mean water level, at a time in s at the axis."""

    height: float
    time: float

    def __post_init__(self) -> None:
        require_positive("waves, field crest.height", self.height)
        if not (np.isfinite(self.time) and self.time >= 0):
            raise InputError("waves, field crest.time", self.time, "0 s or later", "Correct it.")


@dataclass(frozen=True)
class IrregularWaves(LinearSea):
    """Linear waves of a spectrum, drawn by a seed.

    Give significant_height in m, peak_period in s and, if not 1, peak_shape for a JONSWAP spectrum
    (with a peak shape of 1 that of Pierson and Moskowitz); or any other ``spectrum``.

    seed : draws phases first, then amplitudes, then directions, each for all components from the
        lowest frequency up; an option that is left out changes none of the other draws
    repeat_period : in s, after which the waves repeat; at least the case's length
    direction_deg : in which they travel, or their mean direction, from +x towards +y
    amplitudes : ``"deterministic"``, each component having the variance of the spectrum, or
        ``"random"``, each having it in the mean and following Rayleigh's distribution, so that the
        surface is Gaussian and the variance of a realisation varies
    spreading : of directions, one drawn for each component, so that no two of one frequency
        interfere and the sea is ergodic; None for long crests
    crest : asked for at a moment, or None, see :func:`with_crest`
    """

    significant_height: float | None = None
    peak_period: float | None = None
    seed: int = field(kw_only=True)
    repeat_period: float = field(kw_only=True)
    peak_shape: PeakShape = 1.0
    direction_deg: float = 0.0
    spectrum: WaveSpectrum | None = None
    amplitudes: Amplitudes = "deterministic"
    spreading: Spreading | None = None
    crest: Crest | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        state = self.significant_height is not None and self.peak_period is not None
        neither = self.significant_height is None and self.peak_period is None
        if state == (self.spectrum is not None) or not (state or neither):
            given = [
                name
                for name in ("significant_height", "peak_period", "spectrum")
                if getattr(self, name) is not None
            ]
            raise InputError(
                "waves",
                " and ".join(given) or "no spectrum",
                "significant_height and peak_period, or a spectrum",
                "Give one of the two.",
            )
        if self.spectrum is not None and self.peak_shape != 1.0:
            allowed = "nothing beside a spectrum, which has its own"
            raise InputError("waves, field peak_shape", self.peak_shape, allowed, "Leave it out.")
        require_positive("waves, field repeat_period", self.repeat_period)
        target = self.target
        if target.peak_period is not None and self.repeat_period < 5 * target.peak_period:
            allowed = f"at least five peak periods ({5 * target.peak_period} s)"
            raise InputError("waves, field repeat_period", self.repeat_period, allowed, "Raise it.")
        if len(self._harmonics()) < FEWEST_COMPONENTS:
            low, high = target.band
            received = f"{len(self._harmonics())} components from {low:.3g} to {high:.3g} Hz"
            allowed = f"{FEWEST_COMPONENTS} or more"
            remedy = "Raise it: components lie 1 / repeat_period apart."
            raise InputError("waves, field repeat_period", received, allowed, remedy)
        if not (isinstance(self.seed, int) and self.seed >= 0):
            raise InputError("waves, field seed", self.seed, "a whole number from 0", "Correct it.")
        if self.amplitudes not in get_args(Amplitudes):
            allowed = ", ".join(get_args(Amplitudes))
            raise InputError("waves, field amplitudes", self.amplitudes, allowed, "Choose one.")
        if self.crest is not None and self.crest.time > self.repeat_period:
            allowed = f"within the repeat period ({self.repeat_period:g} s)"
            raise InputError("waves, field crest.time", self.crest.time, allowed, "Correct it.")
        require_angle(self.direction_deg)

    @property
    def target(self) -> WaveSpectrum:
        """The spectrum the waves are drawn from."""
        if self.spectrum is not None:
            return self.spectrum
        if self.significant_height is None or self.peak_period is None:
            raise RuntimeError("checked when the sea was made")
        return JonswapSpectrum(self.significant_height, self.peak_period, self.peak_shape)

    @property
    def wave_seed(self) -> int:
        return self.seed

    @property
    def main_period(self) -> float | None:
        return self.target.peak_period

    @property
    def longest_time(self) -> float:
        return self.repeat_period

    def _harmonics(self) -> Array:
        """(m,) of the repeat period, in the spectrum's band."""
        step = 1 / self.repeat_period
        low, high = self.target.band
        return np.arange(np.ceil(low / step), np.floor(high / step) + 1)

    def linear(self, depth: float, gravity: float) -> LinearWaves:
        """Components 1 / repeat_period apart, over the band of the spectrum.

        Raises
        ------
        InputError : a current that blocks them, or a crest that cannot be had
        """
        step = 1 / self.repeat_period
        harmonic = self._harmonics()
        count = len(harmonic)
        density = self.target.density(harmonic * step, depth, gravity)
        draw = np.random.default_rng((self.seed, _STREAM))
        phase = draw.uniform(0, 2 * np.pi, count)
        squares, shares = draw.standard_exponential(count), draw.uniform(0, 1, count)
        amplitude = np.sqrt(2 * density * step) * np.exp(-1j * phase)
        if self.amplitudes == "random":
            amplitude = amplitude * np.sqrt(squares)
        direction: Array | float = float(np.radians(self.direction_deg))
        if self.spreading is not None:
            direction = direction + self.spreading.angles(shares)
        waves = self.free_waves(self.repeat_period, harmonic, amplitude, depth, gravity, direction)
        if self.crest is None:
            return waves
        kept = self.target.density(waves.harmonic * step, depth, gravity) * step
        return with_crest(waves, kept, self.crest)

    def cautions(self, waves: WaveField) -> list[str]:
        told = super().cautions(waves)
        period = self.target.peak_period or moments(waves).peak_period
        told += irregular_wave_cautions(
            self.target.significant_height,
            period,
            waves.depth,
            waves.gravity,
            wind_sea=isinstance(self.target, JonswapSpectrum),
            order=self.order,
        )
        if self.crest is not None:
            told += crest_cautions(self.crest.height, period, waves.depth, waves.gravity)
        return told

    @property
    def in_words(self) -> str:
        told = [self.target.in_words + self.theory_in_words]
        if self.amplitudes == "random":
            told.append("random amplitudes")
        if self.spreading is not None:
            told.append(self.spreading.in_words)
        if self.crest is not None:
            told.append(f"a crest of {self.crest.height:g} m at {self.crest.time:g} s")
        return ", ".join(told)


def with_crest(waves: LinearWaves, variance: Array, crest: Crest) -> LinearWaves:
    """Waves changed so that a crest comes at a time: NewWave in a random sea.

    To each component is added, as an amplitude at the crest's time, v_j (e / m0 - i omega_j e' /
    m2), where v_j is the variance that the spectrum gives to it, m0 and m2 = sum omega_j^2 v_j
    their sums, and e and e' what elevation and slope lack of the crest's (Taylor, Jonathan and
    Harland, J. Offshore Mech. Arct. Eng. 119, 1997). A Gaussian surface then is one of those that
    have the crest, as probable among them as it should be.

    variance : (m,) of each component in the spectrum, in m2

    Raises
    ------
    InputError : a crest too high for the sea, or too low to be one there
    """
    where = "waves, field crest"
    omega, m0 = waves.omega, np.sum(variance)
    largest = HIGHEST_CREST * 4 * float(np.sqrt(m0))
    if crest.height > largest:
        allowed = f"up to twice the significant height ({largest:.3g} m)"
        raise InputError(f"{where}.height", crest.height, allowed, "Is it the crest's, in m?")
    m2 = np.sum(omega**2 * variance)
    turn = np.exp(1j * omega * crest.time)
    now = waves.elevation * turn
    lacks = crest.height - np.sum(now.real)
    slope_lacks = -np.sum((1j * omega * now).real)
    now = now + variance * (lacks / m0 - 1j * omega * slope_lacks / m2)
    if np.sum(omega**2 * now.real) <= 0:
        raise InputError(
            f"{where}.height",
            crest.height,
            "a height that is a crest in this sea at that time",
            "The surface there would be a trough between two crests: ask for a higher crest, "
            "another time or another seed.",
        )
    return replace(waves, elevation=now * np.conj(turn))
