"""Frequency and damping of one mode from its bell in the singular values of a spectral matrix.

Enhanced frequency domain decomposition (Brincker, Ventura and Andersen, 2001): the lines about a
peak with similar singular vectors are the spectrum of one mode; transformed to time it is the
mode's correlation function, which decays like a free vibration.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.cross_spectra import CrossSpectra
from offwind_pin.signal.modal_identification.free_decay import (
    Decrement,
    decrement,
    extremes,
    half_cycles,
)

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

FEWEST_LINES = 5
"""The main lobe of a pure tone under a Hann window holds four lines at most."""
LONGEST_LAG = 1 / 3
"""Of a segment: beyond it little of the window is left, and what wraps around from the segment's
end grows; with a Hann window it is at most 6 % there for an undamped oscillation."""
_CLOSE = 2
"""Singular values in which a line's part of the bell is looked for: where two modes cross, the one
looked at moves from the first to the second."""
_SAMPLES_PER_CYCLE = 32


@dataclass(frozen=True, eq=False)
class Bell:
    """The lines of one mode.

    Attributes
    ----------
    first, last : int
        Indices of the first and the last line.
    density : array, unit^2/Hz
        (last - first + 1,) one-sided spectrum of the mode.
    """

    first: int
    last: int
    density: Array


def single_mode_bell(
    values: Array,
    vectors: ComplexArray,
    peak: int,
    shape: ComplexArray,
    mac_limit: float,
    limits: tuple[int, int],
) -> Bell:
    """Lines about a peak whose singular vector has a modal assurance above a limit.

    Parameters
    ----------
    values : (f, c) array
        Singular values, falling.
    vectors : (f, c, c) complex array
        Singular vectors in columns.
    peak : int
        Line of the peak.
    shape : (c,) complex array
        Singular vector at the peak.
    limits : (int, int)
        First and last line that may belong to the bell.

    Raises
    ------
    InputError
        Fewer than five lines.
    """
    close = vectors[:, :, :_CLOSE]
    alike = np.abs(np.einsum("c,fck->fk", shape.conj(), close)) ** 2 / np.sum(np.abs(shape) ** 2)
    which = np.argmax(alike, axis=1)
    lines = np.arange(len(values))
    inside = alike[lines, which] >= mac_limit
    inside[: limits[0]] = False
    inside[limits[1] + 1 :] = False
    outside_below = np.flatnonzero(~inside[:peak])
    outside_above = np.flatnonzero(~inside[peak:])
    first = int(outside_below[-1]) + 1 if len(outside_below) else 0
    last = peak + int(outside_above[0]) - 1 if len(outside_above) else len(values) - 1
    if last - first + 1 < FEWEST_LINES:
        raise InputError(
            f"bell of the peak at line {peak}",
            f"{max(last - first + 1, 0)} lines with a modal assurance above {mac_limit:g}",
            f"{FEWEST_LINES} or more",
            "Is it a harmonic rather than a mode? If not, use longer segments, or lower mac_limit.",
        )
    return Bell(first, last, values[lines, which][first : last + 1])


def correlation(bell: Bell, spectra: CrossSpectra) -> tuple[Array, float]:
    """Correlation function of a bell, 1 at lag 0, at 32 samples a cycle or more; and its step in s.

    In expectation, Welch's estimate is the spectrum of the true correlation times that of the
    window with itself. Dividing by the latter takes out the damping that the window would add. It
    reaches a third of a segment.
    """
    length = len(spectra.window)
    highest = spectra.frequency[bell.last]
    finer = max(1, int(np.ceil(_SAMPLES_PER_CYCLE * highest / spectra.sample_rate)))
    lines = np.zeros(length * finer // 2 + 1)
    lines[bell.first : bell.last + 1] = bell.density
    whole = np.fft.irfft(lines, length * finer)
    step = 1 / (spectra.sample_rate * finer)
    count = int(LONGEST_LAG * length * finer)
    lag = np.arange(count) / finer
    result = whole[:count] / _window_correlation(spectra.window)(lag)
    return result / result[0], step


def mode_of_bell(
    bell: Bell, spectra: CrossSpectra, peak_hz: float, amplitude_range: tuple[float, float]
) -> Decrement:
    """Frequency and damping from the correlation function between two amplitudes.

    peak_hz : frequency of the peak
    amplitude_range : upper and lower end, over the value at lag 0

    Raises
    ------
    InputError
        Too few half cycles in the range, or a correlation that does not decay.
    """
    function, step = correlation(bell, spectra)
    time, value = extremes(function, step, peak_hz)
    _, amplitude = half_cycles(time, value)
    where = f"correlation function of the mode at {peak_hz:.4g} Hz"
    upper, lower = amplitude_range
    fit = decrement(time, amplitude, upper, lower, where)
    return Decrement(
        _crossing_frequency(function, step, fit),
        fit.damping_ratio,
        fit.damping_error,
        fit.used,
        fit.reached,
    )


def _crossing_frequency(function: Array, step: float, fit: Decrement) -> float:
    """Undamped natural frequency in Hz from the zero crossings of the half cycles used."""
    before = np.flatnonzero(np.diff(np.signbit(function)))[: fit.used + 1]
    share = function[before] / (function[before] - function[before + 1])
    half_period = np.polyfit(np.arange(len(before)), (before + share) * step, 1)[0]
    return float(0.5 / half_period / np.sqrt(1 - fit.damping_ratio**2))


def _window_correlation(window: Array) -> CubicSpline:
    """Correlation of a window with itself over the lag in samples, 1 at lag 0."""
    from scipy.interpolate import CubicSpline

    length = len(window)
    lines = np.abs(np.fft.rfft(window, 2 * length)) ** 2
    shared = np.fft.irfft(lines, 2 * length)[:length]
    return CubicSpline(np.arange(length), shared / shared[0])
