"""Irregular seas generated from a spectrum, optionally with a prescribed crest."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import (
    Array,
    Definition,
    Direction,
    NonNegative,
    Positive,
    Seed,
    key,
)
from offwind_pin.base.errors import InputError
from offwind_pin.base.seeds import random_stream
from offwind_pin.loads.sea.sea import LinearSea, WaveHeight
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import (
    JonswapSpectrum,
    PeakShape,
    SignificantHeight,
    SpectrumChoice,
    TableSpectrum,
    WavePeriod,
    WaveSpectrum,
)
from offwind_pin.loads.sea.waves.spreading import Spreading
from offwind_pin.loads.sea.waves.statistics import moments
from offwind_pin.loads.sea.waves.warnings import crest_cautions, irregular_wave_cautions
from offwind_pin.loads.sea.waves.wave_field import WaveField

FEWEST_COMPONENTS = 10
HIGHEST_CREST = 2.0
"""Multiple of the significant height; one crest in 8e13 is higher (Rayleigh: exp(-8 c^2 /
Hs^2))."""
SHORTEST_REPEAT = 600.0
"""Shortest repeat period in s of the waves of a load case."""


class Crest(Definition, kw_only=False):
    """A prescribed crest at the axis.

    Attributes
    ----------
    height : float, m
        Above the mean water level.
    time : float, s
        When the crest is at the axis.
    """

    height: WaveHeight = key("height_m")
    time: NonNegative = key("time_s")


class IrregularWaves(LinearSea, kw_only=False):
    """Linear waves generated from a spectrum by a seed.

    Give ``significant_height``, ``peak_period`` and, if not 1, ``peak_shape`` for a JONSWAP
    spectrum; or any other ``spectrum``.

    Attributes
    ----------
    significant_height : float or None, m
        Of a JONSWAP spectrum.
    peak_period : float or None, s
        Of a JONSWAP spectrum.
    seed : int or None
        Seed of phases, amplitudes and directions, drawn in this order, each for all components from
        the lowest frequency up; an omitted option changes none of the other draws. By default that
        of the load case, or 1.
    repeat_period : float or None, s
        Period after which the waves repeat; at least the simulated time. By default the length of
        the load case, and at least 600 s.
    peak_shape : float or "iec"
        Of a JONSWAP spectrum; 1 gives a Pierson-Moskowitz spectrum.
    direction_deg : float
        Direction of travel, or its mean, in degrees from +x towards +y.
    spectrum : WaveSpectrum or None
        Any other spectrum, in place of these.
    amplitudes : {"deterministic", "random"}
        ``"deterministic"``: each component has the variance of the spectrum. ``"random"``: it has
        it in the mean and follows a Rayleigh distribution, so that the surface is Gaussian and the
        variance of a realisation varies.
    spreading : Spreading or None
        Spreading of directions, one drawn per component, so that no two components of one frequency
        interfere and the sea is ergodic; None for long crests.
    crest : Crest or None
        Prescribed crest, see :func:`with_crest`.
    """

    kind: Literal["irregular_waves"] = Field(default="irregular_waves", kw_only=True)
    significant_height: SignificantHeight | None = key("significant_height_m", default=None)
    peak_period: WavePeriod | None = key("peak_period_s", default=None)
    seed: Seed | None = Field(default=None, kw_only=True)
    repeat_period: Annotated[Positive, Field(le=1e6)] | None = key(
        "repeat_period_s", default=None, kw_only=True
    )
    peak_shape: PeakShape = 1.0
    direction_deg: Direction = 0.0
    spectrum: SpectrumChoice | None = None
    amplitudes: Literal["deterministic", "random"] = "deterministic"
    spreading: Spreading | None = None
    crest: Crest | None = None

    @model_validator(mode="after")
    def _one_spectrum(self) -> Self:
        state = {
            "significant_height": self.significant_height is not None,
            "peak_period": self.peak_period is not None,
            "peak_shape": self.peak_shape != 1.0,
        }
        given = [name for name, is_given in state.items() if is_given]
        if self.spectrum is not None and given:
            raise ValueError(
                f"{', '.join(given)} cannot be combined with spectrum; set them inside spectrum, "
                "or leave spectrum out"
            )
        if self.spectrum is None and not (state["significant_height"] and state["peak_period"]):
            raise ValueError(
                "the waves have no spectrum; give both significant_height_m and peak_period_s, "
                "or a spectrum"
            )
        return self

    @model_validator(mode="after")
    def _period_is_long_enough(self) -> Self:
        of_file = isinstance(self.spectrum, TableSpectrum) and self.spectrum.file is not None
        if self.repeat_period is not None:
            fault = None if of_file else self._fault_of_period(self.repeat_period)
            if fault is not None:
                raise ValueError("; ".join(fault))
            if self.crest is not None and self.crest.time > self.repeat_period:
                raise ValueError(
                    f"the crest's time of {self.crest.time:g} s is after the repeat period of "
                    f"{self.repeat_period:g} s; choose an earlier time"
                )
        return self

    def completed(self, seed: int, duration: float) -> Self:
        repeat = self.repeat_period
        return self.replace(
            seed=seed if self.seed is None else self.seed,
            repeat_period=max(duration, SHORTEST_REPEAT) if repeat is None else repeat,
        )

    @property
    def target(self) -> WaveSpectrum:
        """The spectrum from which the waves are generated."""
        if self.spectrum is not None:
            return self.spectrum
        if self.significant_height is None or self.peak_period is None:
            raise RuntimeError("a sea without a spectrum was not rejected")
        return JonswapSpectrum(self.significant_height, self.peak_period, self.peak_shape)

    @property
    def wave_seed(self) -> int:
        return 1 if self.seed is None else self.seed

    @property
    def main_period(self) -> float | None:
        return self.target.peak_period

    @property
    def longest_time(self) -> float:
        """Time in s after which the waves repeat.

        Raises
        ------
        InputError
            The repeat period is missing or too short.
        """
        if self.repeat_period is None:
            raise InputError(
                "IrregularWaves, field repeat_period",
                "required key missing",
                "",
                "Give at least the simulated time, in s.",
            )
        fault = self._fault_of_period(self.repeat_period)
        if fault is not None:
            where = "IrregularWaves, field repeat_period"
            raise InputError(where, fault[0], "", f"{fault[1][:1].upper()}{fault[1][1:]}.")
        return self.repeat_period

    def _fault_of_period(self, period: float) -> tuple[str, str] | None:
        """Fault of a repeat period in s and its remedy, or None."""
        peak = self.target.peak_period
        if peak is not None and period < 5 * peak:
            return (
                f"the repeat period of {period:g} s is below five peak periods ({5 * peak:g} s)",
                "lengthen it",
            )
        count = len(self._harmonics(period))
        if count < FEWEST_COMPONENTS:
            low, high = self.target.band
            return (
                f"a repeat period of {period:g} s gives {count} components from {low:.3g} to "
                f"{high:.3g} Hz, and at least {FEWEST_COMPONENTS} are required",
                "lengthen it: components are 1 / repeat_period apart",
            )
        return None

    def _harmonics(self, period: float) -> Array:
        """(m,) harmonics of a repeat period in s, inside the spectrum's band."""
        step = 1 / period
        low, high = self.target.band
        return np.arange(np.ceil(low / step), np.floor(high / step) + 1)

    def linear(self, depth: float, gravity: float) -> LinearWaves:
        """Free components 1 / repeat_period apart, over the band of the spectrum.

        Parameters
        ----------
        depth : float, m
            From the mudline to the mean water level.
        gravity : float, m/s2

        Returns
        -------
        LinearWaves

        Raises
        ------
        InputError
            A current that blocks the waves, or an impossible crest.
        """
        period = self.longest_time
        step = 1 / period
        harmonic = self._harmonics(period)
        count = len(harmonic)
        density = self.target.density(harmonic * step, depth, gravity)
        draw = random_stream(self.wave_seed, "waves")
        phase = draw.uniform(0, 2 * np.pi, count)
        squares, shares = draw.standard_exponential(count), draw.uniform(0, 1, count)
        amplitude = np.sqrt(2 * density * step) * np.exp(-1j * phase)
        if self.amplitudes == "random":
            amplitude = amplitude * np.sqrt(squares)
        direction: Array | float = float(np.radians(self.direction_deg))
        if self.spreading is not None:
            direction = direction + self.spreading.angles(shares)
        waves = self.free_waves(period, harmonic, amplitude, depth, gravity, direction)
        if self.crest is None:
            return waves
        kept = self.target.density(waves.harmonic * step, depth, gravity) * step
        return with_crest(waves, kept, self.crest)

    def cautions(self, waves: WaveField) -> list[str]:
        found = super().cautions(waves)
        period = self.target.peak_period or moments(waves).peak_period
        found += irregular_wave_cautions(
            self.target.significant_height,
            period,
            waves.depth,
            waves.gravity,
            wind_sea=isinstance(self.target, JonswapSpectrum),
            order=self.order,
        )
        if self.crest is not None:
            found += crest_cautions(self.crest.height, period, waves.depth, waves.gravity)
        return found

    @property
    def in_words(self) -> str:
        parts = [self.target.in_words + self.theory_in_words]
        if self.amplitudes == "random":
            parts.append("random amplitudes")
        if self.spreading is not None:
            parts.append(self.spreading.in_words)
        if self.crest is not None:
            parts.append(f"a crest of {self.crest.height:g} m at {self.crest.time:g} s")
        return ", ".join(parts)


def with_crest(waves: LinearWaves, variance: Array, crest: Crest) -> LinearWaves:
    """Waves with a crest at a given time: NewWave in a random sea.

    Each component is changed, at the time of the crest, by v_j (e / m0 - i omega_j e' / m2), where
    v_j is its variance in the spectrum, m0 = sum v_j and m2 = sum omega_j^2 v_j, and e and e' the
    differences of elevation and slope from those of the crest
    (Taylor, Jonathan and Harland, J. Offshore Mech. Arct. Eng. 119, 1997). A Gaussian surface thus
    becomes a random member of the surfaces that have this crest.

    variance : (m,) of each component in the spectrum, in m2

    Raises
    ------
    InputError
        A crest that is too high for the sea, or too low to be a crest at that time.
    """
    where = "sea, field crest"
    omega, m0 = waves.omega, np.sum(variance)
    largest = HIGHEST_CREST * 4 * float(np.sqrt(m0))
    if crest.height > largest:
        allowed = f"up to twice the significant height ({largest:.3g} m)"
        raise InputError(
            f"{where}.height", crest.height, allowed, "Is it the height of the crest in m?"
        )
    m2 = np.sum(omega**2 * variance)
    phase = np.exp(1j * omega * crest.time)
    now = waves.elevation * phase
    missing = crest.height - np.sum(now.real)
    missing_slope = -np.sum((1j * omega * now).real)
    now = now + variance * (missing / m0 - 1j * omega * missing_slope / m2)
    if np.sum(omega**2 * now.real) <= 0:
        raise InputError(
            f"{where}.height",
            crest.height,
            "a height that is a crest in this sea at that time",
            "The surface would be a trough between two crests: choose a higher crest, another time "
            "or another seed.",
        )
    return replace(waves, elevation=now * np.conj(phase))
