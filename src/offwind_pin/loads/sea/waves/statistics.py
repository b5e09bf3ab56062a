"""Statistics of a realised sea: variance, height and periods."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.waves.wave_field import WaveField

_PEAK_WIDTH = 0.005
"""Hz over which components are averaged to find the peak, since single ones may be random."""


@dataclass(frozen=True)
class WaveMoments:
    """Moments of the components of a sea at the axis, exact over one of its periods.

    Attributes
    ----------
    m0 : float, m2
        Variance of the surface.
    m2 : float, m2 Hz2
        Sum of f^2 times the variance of each component.
    peak_period : float, s
        Period at which the variance, averaged over 0.005 Hz, is largest.
    """

    m0: float
    m2: float
    peak_period: float

    @property
    def significant_height(self) -> float:
        """4 sqrt(m0) in m."""
        return 4 * float(np.sqrt(self.m0))

    @property
    def zero_crossing_period(self) -> float:
        """sqrt(m0 / m2) in s: the mean between upward crossings of a Gaussian surface (Rice)."""
        return float(np.sqrt(self.m0 / self.m2))


def moments(waves: WaveField) -> WaveMoments:
    """Moments of the realised components, without the mean."""
    moving = waves.harmonic > 0
    harmonic = waves.harmonic[moving]
    variance = np.abs(waves.elevation[moving]) ** 2 / 2
    frequency = harmonic / waves.period
    return WaveMoments(
        float(np.sum(variance)),
        float(np.sum(frequency**2 * variance)),
        1 / peak_frequency(frequency, variance, waves.period),
    )


def peak_frequency(frequency: Array, variance: Array, period: float) -> float:
    """Frequency in Hz at the largest running mean over 0.005 Hz of components (m,).

    frequency (m,) in Hz, in steps of one over a period in s; variance (m,) in m2
    """
    half = int(_PEAK_WIDTH * period / 2)
    if half == 0 or len(variance) <= 2 * half:
        return float(frequency[np.argmax(variance)])
    window = np.ones(2 * half + 1)
    running = np.convolve(variance, window, mode="same") / np.convolve(
        np.ones(len(variance)), window, mode="same"
    )
    return float(frequency[np.argmax(running)])
