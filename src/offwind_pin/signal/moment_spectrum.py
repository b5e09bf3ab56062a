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

_FREQUENCY = {"long_name": "frequency", "units": "Hz"}


@dataclass(frozen=True)
class Band:
    """Area under a PSD between two frequencies: low and high in Hz, area in (N m)^2."""

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
    frequency : (f,) array, Hz
    density : (f,) array, (N m)^2/Hz
        One-sided.
    peaks : tuple of float, Hz
        Frequencies of the peaks found.
    bands : tuple of Band
        Areas of the bands of the first and the second fore-aft mode.
    marked : mapping of str to float, Hz
        Frequencies by name: "wave peak", "3P", "FA1", ...
    segment : float, s
        Length of Welch's windows.
    """

    frequency: Array
    density: Array
    peaks: tuple[float, ...]
    bands: tuple[Band, ...]
    marked: Mapping[str, float]
    segment: float

    def to_dataset(self) -> xr.Dataset:
        """The spectrum, its bands, peaks and marked frequencies as a labelled dataset."""
        import xarray as xr

        about = {
            "density": (
                "frequency",
                self.density,
                "one-sided PSD of the fore-aft moment at the mudline",
                "(N m)2/Hz",
            ),
            "peak": ("peak_number", np.array(self.peaks), "frequency of a peak", "Hz"),
            "band_low": ("band", [b.low for b in self.bands], "lower end of the band", "Hz"),
            "band_high": ("band", [b.high for b in self.bands], "upper end of the band", "Hz"),
            "band_area": ("band", [b.area for b in self.bands], "PSD sum of the band", "(N m)2"),
            "marked_frequency": (
                "mark",
                np.array(list(self.marked.values())),
                "frequency of interest",
                "Hz",
            ),
        }
        return xr.Dataset(
            {
                name: (dims, values, {"long_name": text, "units": units})
                for name, (dims, values, text, units) in about.items()
            },
            {
                "frequency": ("frequency", self.frequency, _FREQUENCY),
                "mark": ("mark", list(self.marked), {"long_name": "name of the frequency"}),
            },
            {"segment_s": self.segment},
        )

    @staticmethod
    def from_dataset(data: xr.Dataset) -> MomentSpectrum:
        """A spectrum read back from :meth:`to_dataset`."""
        bands = (data[f"band_{name}"].to_numpy().tolist() for name in ("low", "high", "area"))
        marked = zip(
            data["mark"].to_numpy(), data["marked_frequency"].to_numpy().tolist(), strict=True
        )
        return MomentSpectrum(
            data["frequency"].to_numpy(),
            data["density"].to_numpy(),
            tuple(data["peak"].to_numpy().tolist()),
            tuple(Band(*band) for band in zip(*bands, strict=True)),
            {str(name): frequency for name, frequency in marked},
            float(data.attrs["segment_s"]),
        )

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
