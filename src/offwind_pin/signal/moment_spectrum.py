"""Spectrum of the fore-aft moment at the mudline, its bands and peaks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.mode_labels import is_mode
from offwind_pin.signal.spectra import band_sum, peaks, power_spectral_density

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Band:
    """Area under a PSD between two frequencies: low, high in Hz, area in (N m)^2."""

    low: float
    high: float
    area: float

    @property
    def name(self) -> str:
        return f"{self.low:g}\N{EN DASH}{self.high:g} Hz"


@dataclass(frozen=True)
class MomentSpectrum:
    """PSD of the fore-aft moment at the mudline after the ramp.

    Attributes
    ----------
    frequency : (f,) in Hz
    density : (f,) one-sided, in (N m)^2/Hz
    peaks : frequencies of the peaks found, in Hz
    bands : areas of the bands of the first and the second fore-aft mode
    marked : frequencies in Hz by name: "wave peak", "3P", "FA1", ...
    segment : length of Welch's windows in s
    """

    frequency: Array
    density: Array
    peaks: tuple[float, ...]
    bands: tuple[Band, ...]
    marked: Mapping[str, float]
    segment: float

    @property
    def ratio(self) -> float | None:
        """Area of the first band over that of the second, or None without two bands."""
        if len(self.bands) < 2 or self.bands[1].area == 0:
            return None
        return self.bands[0].area / self.bands[1].area

    def strongest_peak(self, low: float, high: float) -> float | None:
        """Of the peaks found between two frequencies in Hz, the one with the largest density."""
        inside = [peak for peak in self.peaks if low <= peak <= high]
        return max(
            inside, key=lambda f: float(np.interp(f, self.frequency, self.density)), default=None
        )

    def nearest_peak(self, frequency: float, nearness: float = 0.02) -> float | None:
        """The peak found within a share of a frequency in Hz that is nearest to it, or None."""
        near = min(self.peaks, key=lambda peak: abs(peak - frequency), default=None)
        if near is None or abs(near - frequency) > nearness * frequency:
            return None
        return near

    def peak_in(self, band: Band) -> tuple[str | None, float | None]:
        """Label of a marked mode in a band and the peak next to it; else None and the strongest."""
        for name, frequency in self.marked.items():
            peak = self.nearest_peak(frequency)
            if is_mode(name) and peak is not None and band.low <= peak <= band.high:
                return name, peak
        return None, self.strongest_peak(band.low, band.high)


BANDS_HZ = {"psd_sum_0p2_0p3": (0.2, 0.3), "psd_sum_1p0_1p5": (1.0, 1.5)}
"""Bands of the paper's PSD sums, about the first and the second bending mode."""


PEAK_PROMINENCE_DB = 1.0


def moment_spectrum(data: xr.Dataset, segment: float, marked: dict[str, float]) -> MomentSpectrum:
    """PSD of the fore-aft moment at the mudline after the ramp.

    segment : Welch window in s; marked : frequencies of interest in Hz by name
    """
    time = data["time"].to_numpy()
    moment = data["mudline_moment"].sel(direction="y").to_numpy()
    analysed = time > data.attrs["ramp_s"]
    frequency, density = power_spectral_density(moment[analysed], time[1] - time[0], segment)
    found = peaks(frequency, density, 0.05, 1.6, PEAK_PROMINENCE_DB)
    bands = tuple(Band(*band, band_sum(frequency, density, *band)) for band in BANDS_HZ.values())
    return MomentSpectrum(frequency, density, tuple(found), bands, marked, segment)
