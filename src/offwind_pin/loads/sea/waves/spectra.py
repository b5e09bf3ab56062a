"""One-sided variance spectra of the surface elevation in m2/Hz."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import Array, Definition, File, Number, Numbers, Positive, key
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import read_numbers
from offwind_pin.loads.sea.waves.dispersion import wave_number

SignificantHeight = Annotated[Positive, Field(le=30)]
WavePeriod = Annotated[Positive, Field(ge=1, le=30)]
WaveFrequency = Annotated[Positive, Field(le=5)]
PeakShape = Annotated[Number, Field(ge=1, le=7)] | Literal["iec"]

LOWEST_SHARE, HIGHEST_SHARE = 0.4, 5.0
"""Range of components in multiples of the peak frequency: it contains 99.8 % of the variance, and
shorter waves have little effect on a cylinder many times their length."""

_GAP = 5.0
"""Ratio of neighbouring steps of a table above which the larger one is a gap."""
_EDGE = 1e-12
"""Relative tolerance that keeps a component at the end of a band in spite of rounding error."""


class WaveSpectrum(Definition):
    """Distribution of the variance of the surface over frequency.

    Attributes
    ----------
    significant_height : float, m
        Four times the root of its area.
    peak_period : float, s
        None if there is no peak.
    """

    if TYPE_CHECKING:  # fields of some spectra, properties of others

        @property
        def significant_height(self) -> float: ...

        @property
        def peak_period(self) -> float | None: ...

    @property
    @abstractmethod
    def band(self) -> tuple[float, float]:
        """Lowest and highest frequency in Hz of the components."""

    @abstractmethod
    def density(self, frequency: Array, depth: float, gravity: float) -> Array:
        """Variance density at frequencies inside the band.

        Parameters
        ----------
        frequency : (m,) array, Hz
        depth : float, m
            Water depth, on which some spectra depend.
        gravity : float, m/s2

        Returns
        -------
        (m,) array, m2/Hz
        """

    @property
    @abstractmethod
    def in_words(self) -> str:
        """Short description for reports."""


class JonswapSpectrum(WaveSpectrum, kw_only=False):
    """JONSWAP spectrum; a Pierson-Moskowitz spectrum for a peak shape of 1. See :func:`jonswap`.

    Attributes
    ----------
    significant_height : float, m
    peak_period : float, s
    peak_shape : float or "iec"
        From 1 to 7, or ``"iec"`` for IEC's rule.
    """

    kind: Literal["jonswap"] = Field(default="jonswap", kw_only=True)
    significant_height: SignificantHeight = key("significant_height_m")
    peak_period: WavePeriod = key("peak_period_s")
    peak_shape: PeakShape = 1.0

    @property
    def shape(self) -> float:
        """The peak-shape factor as a number."""
        if self.peak_shape == "iec":
            return iec_peak_shape(self.significant_height, self.peak_period)
        return self.peak_shape

    @property
    def band(self) -> tuple[float, float]:
        peak = 1 / self.peak_period
        return LOWEST_SHARE * peak, HIGHEST_SHARE * peak

    def density(self, frequency: Array, depth: float, gravity: float) -> Array:
        return jonswap(frequency, self.significant_height, self.peak_period, self.shape)

    @property
    def in_words(self) -> str:
        kind = "Pierson-Moskowitz" if self.shape == 1 else f"JONSWAP (gamma {self.shape:.3g})"
        return f"{kind} waves, Hs {self.significant_height:g} m, Tp {self.peak_period:g} s"


class TmaSpectrum(JonswapSpectrum):
    """TMA spectrum: JONSWAP times Kitaigorodskii's depth factor, scaled to the given height.

    The factor removes variance. The spectrum is scaled so that the significant height is the given
    one, as measured at the site. The peak period is that of the JONSWAP spectrum; since the factor
    increases with frequency, the peak is slightly above 1 / Tp.
    """

    kind: Literal["tma"] = Field(default="tma", kw_only=True)  # type: ignore[assignment]

    def density(self, frequency: Array, depth: float, gravity: float) -> Array:
        node, weight = _panels(1 / self.peak_period)
        whole = super().density(node, depth, gravity)
        left = np.sum(weight * whole * depth_factor(node, depth, gravity))
        raised = np.sum(weight * whole) / left
        parent = super().density(frequency, depth, gravity)
        return np.asarray(raised * depth_factor(frequency, depth, gravity) * parent)

    @property
    def in_words(self) -> str:
        height, period = self.significant_height, self.peak_period
        return f"TMA waves (gamma {self.shape:.3g}), Hs {height:g} m, Tp {period:g} s"


class WhiteNoise(WaveSpectrum, kw_only=False):
    """Constant density between two frequencies, zero elsewhere.

    Attributes
    ----------
    significant_height : float, m
    lowest, highest : float, Hz
        Ends of the band.
    """

    kind: Literal["white_noise"] = Field(default="white_noise", kw_only=True)
    significant_height: SignificantHeight = key("significant_height_m")
    lowest: WaveFrequency = key("lowest_hz")
    highest: WaveFrequency = key("highest_hz")

    @model_validator(mode="after")
    def _has_width(self) -> WhiteNoise:
        if not self.lowest < self.highest:
            raise ValueError(
                f"the band runs from {self.lowest:g} to {self.highest:g} Hz; swap its ends"
            )
        return self

    @property
    def peak_period(self) -> None:
        """None: there is no peak."""
        return

    @property
    def band(self) -> tuple[float, float]:
        return self.lowest * (1 - _EDGE), self.highest * (1 + _EDGE)

    def density(self, frequency: Array, depth: float, gravity: float) -> Array:
        level = self.significant_height**2 / 16 / (self.highest - self.lowest)
        low, high = self.band
        return np.where((frequency >= low) & (frequency <= high), level, 0.0)

    @property
    def in_words(self) -> str:
        height, low, high = self.significant_height, self.lowest, self.highest
        return f"white noise from {low:g} to {high:g} Hz, Hs {height:g} m"


class TableSpectrum(WaveSpectrum, kw_only=False):
    """Densities in m2/Hz at frequencies in Hz, linear in between and zero outside.

    The area is the variance. Give both columns, or a CSV file with the header
    ``frequency_hz,density_m2_per_hz``.

    Attributes
    ----------
    frequency : tuple of float, Hz
        Rising frequencies.
    ordinate : tuple of float, m2/Hz
        Density at each frequency.
    file : Path or None
        CSV file in place of both.
    """

    kind: Literal["table"] = Field(default="table", kw_only=True)
    frequency: Numbers = key("frequency_hz", default=())
    ordinate: Numbers = key("density_m2_per_hz", default=())
    file: File | None = Field(default=None, kw_only=True)

    @model_validator(mode="after")
    def _here_or_there(self) -> TableSpectrum:
        if (self.file is None) == (not self.frequency and not self.ordinate):
            raise ValueError(
                "file and the columns are both given, or neither is; give file, or frequency_hz "
                "and density_m2_per_hz"
            )
        if self.file is None:
            fault = _fault_of_table(self.frequency, self.ordinate)
            if fault is not None:
                raise ValueError("; ".join(fault))
        return self

    @cached_property
    def columns(self) -> tuple[Array, Array]:
        """Frequencies (n,) in Hz and densities (n,) in m2/Hz.

        Raises
        ------
        InputError
            An invalid file or table.
        """
        if self.file is None:
            return np.array(self.frequency), np.array(self.ordinate)
        table = read_numbers(self.file, ("frequency_hz", "density_m2_per_hz"))
        frequency, ordinate = table.values.T
        fault = _fault_of_table(tuple(frequency), tuple(ordinate))
        if fault is not None:
            remedy = f"{fault[1][:1].upper()}{fault[1][1:]}."
            raise InputError(str(self.file), fault[0], "", remedy)
        return frequency, ordinate

    @property
    def significant_height(self) -> float:
        """Four times the root of the area, in m."""
        frequency, ordinate = self.columns
        return 4 * float(np.sqrt(np.trapezoid(ordinate, frequency)))

    @property
    def band(self) -> tuple[float, float]:
        frequency = self.columns[0]
        return float(frequency[0]) * (1 - _EDGE), float(frequency[-1]) * (1 + _EDGE)

    @property
    def peak_period(self) -> float:
        """Period in s of the largest density."""
        frequency, ordinate = self.columns
        return 1 / float(frequency[int(np.argmax(ordinate))])

    def density(self, frequency: Array, depth: float, gravity: float) -> Array:
        low, high = self.band
        inside = (frequency >= low) & (frequency <= high)
        return np.where(inside, np.interp(frequency, *self.columns), 0.0)

    @property
    def in_words(self) -> str:
        height, period = self.significant_height, self.peak_period
        return f"waves of a given spectrum, Hs {height:.3g} m, Tp {period:.3g} s"


SpectrumChoice = Annotated[
    JonswapSpectrum | TmaSpectrum | WhiteNoise | TableSpectrum, Field(discriminator="kind")
]


def _fault_of_table(
    frequency: tuple[float, ...], ordinate: tuple[float, ...]
) -> tuple[str, str] | None:
    """Fault of a spectrum's table and its remedy, or None."""
    if len(frequency) < 3 or len(frequency) != len(ordinate):
        return (
            f"{len(frequency)} frequencies and {len(ordinate)} densities",
            "give three frequencies or more, and one density per frequency",
        )
    f, s = np.array(frequency), np.array(ordinate)
    step = np.diff(f)
    if f[0] <= 0 or np.any(step <= 0):
        at = f[0] if f[0] <= 0 else f[1:][step <= 0][0]
        return f"the frequency {at:g} Hz is not above zero and its predecessor", "sort the table"
    if np.any(s < 0):
        i = int(np.argmax(s < 0))
        return f"the density at {f[i]:g} Hz is {s[i]} m2/Hz", "give 0 or more"
    if not np.any(s > 0):
        return "all densities are zero", "give positive densities, or use still water"
    gap = (step[1:] > _GAP * step[:-1]) | (step[:-1] > _GAP * step[1:])
    if np.any(gap):
        i = int(np.argmax(gap))
        return (
            f"the frequency steps on both sides of {f[i + 1]:g} Hz, {step[i]:g} and "
            f"{step[i + 1]:g} Hz, differ by more than a factor of {_GAP:g}",
            "add the missing rows, with zeros where there are no waves",
        )
    return None


def pierson_moskowitz(frequency: Array, significant_height: float, peak_period: float) -> Array:
    """One-sided variance spectrum of the surface elevation in m2/Hz (IEC 61400-3-1, Annex D).

    frequency in Hz (positive), significant height in m, peak period in s; its area is Hs^2 / 16.
    """
    ratio = 1 / (frequency * peak_period)
    return 5 / 16 * significant_height**2 / frequency * ratio**4 * np.exp(-1.25 * ratio**4)


def jonswap(
    frequency: Array, significant_height: float, peak_period: float, peak_shape: float
) -> Array:
    """The same with a peak enhanced by a factor gamma of 1 or more (IEC 61400-3-1, Annex D).

    S = (1 - 0.287 ln gamma) S_PM gamma^exp(-((f Tp - 1) / sigma)^2 / 2), with sigma 0.07 below and
    0.09 above the peak. The factor in front keeps the area Hs^2 / 16 within 1 % for gamma up to 5,
    and within 3 % up to 7.
    """
    ratio = frequency * peak_period
    width = np.where(ratio <= 1, 0.07, 0.09)
    raised = peak_shape ** np.exp(-(((ratio - 1) / width) ** 2) / 2)
    level = 1 - 0.287 * np.log(peak_shape)
    return np.asarray(
        level * raised * pierson_moskowitz(frequency, significant_height, peak_period)
    )


def iec_peak_shape(significant_height: float, peak_period: float) -> float:
    """Peak-shape factor by steepness, 1 to 5 (IEC 61400-3-1, Annex D).

    5 for Tp / sqrt(Hs) up to 3.6, 1 from 5 on, exp(5.75 - 1.15 Tp / sqrt(Hs)) in between.
    """
    ratio = peak_period / np.sqrt(significant_height)
    if ratio <= 3.6:
        return 5.0
    return 1.0 if ratio >= 5 else float(np.exp(5.75 - 1.15 * ratio))


def depth_factor(frequency: Array, depth: float, gravity: float) -> Array:
    """Kitaigorodskii's factor by which a depth in m limits a spectrum, 0 to 1.

    (k^-3 dk/domega) over its value in deep water (Bouws, Guenther, Rosenthal and Vincent, J.
    Geophys. Res. 90, 1985, 975), which is tanh^2(kh) / (1 + 2 kh / sinh(2 kh)). frequency (m,) in
    Hz, gravity in m/s2.
    """
    kh = wave_number(2 * np.pi * frequency, depth, gravity) * depth
    decay = np.exp(-2 * kh)
    ratio = 4 * kh * decay / (1 - decay**2)
    return np.asarray(np.tanh(kh) ** 2 / (1 + ratio))


def _panels(peak: float) -> tuple[Array, Array]:
    """Gauss nodes in Hz and weights over a whole spectrum with a peak at a frequency in Hz."""
    edges = peak * np.array(
        [0.3, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.35, 1.6, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0]
    )
    node, weight = np.polynomial.legendre.leggauss(16)
    half, middle = np.diff(edges)[:, None] / 2, (edges[1:] + edges[:-1])[:, None] / 2
    return (middle + half * node).ravel(), (half * weight).ravel()
