"""Power spectral densities, band areas and peaks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.errors import InputError

Array = NDArray[np.float64]


def power_spectral_density(values: Array, dt: float, segment: float = 200.0) -> tuple[Array, Array]:
    """One-sided PSD by Welch's method: Hann windows, half overlapped, the mean removed.

    Parameters
    ----------
    values : (t,) array
        Samples at equal intervals.
    dt : float, s
        Interval.
    segment : float, s
        Length of a window.

    Returns
    -------
    frequency : (f,) array, Hz
    density : (f,) array, unit^2/Hz
        Its integral is the variance.

    Raises
    ------
    InputError
        A segment shorter than two samples or longer than the signal.
    """
    from scipy import signal

    length = round(segment / dt)
    if not 2 <= length <= len(values):
        raise InputError(
            "segment", f"{segment} s", f"{2 * dt:g} to {len(values) * dt:g} s", "Choose another."
        )
    frequency, density = signal.welch(
        values - np.mean(values), fs=1 / dt, window="hann", nperseg=length, detrend=False
    )
    return frequency, density


def band_sum(frequency: Array, density: Array, low: float, high: float) -> float:
    """Area under a PSD between two frequencies in Hz, by trapezoids with interpolated ends.

    Raises
    ------
    InputError
        A band beyond the highest frequency of the spectrum.
    """
    if high > frequency[-1]:
        allowed = f"at most {frequency[-1]:g} Hz, half the sampling frequency"
        raise InputError("band", f"{high} Hz", allowed, "Use a higher sampling rate.")
    inside = frequency[(frequency > low) & (frequency < high)]
    nodes = np.concatenate([[low], inside, [high]])
    return float(np.trapezoid(np.interp(nodes, frequency, density), nodes))


def peaks(
    frequency: Array, density: Array, low: float, high: float, prominence_db: float = 3.0
) -> list[float]:
    """Frequencies in Hz of the prominent local maxima, in increasing order.

    The prominence is measured on the logarithmic density; each frequency is refined by the parabola
    through the maximum and its neighbours.
    """
    from scipy import signal

    level = 10 * np.log10(np.maximum(density, np.finfo(float).tiny))
    found, _ = signal.find_peaks(level, prominence=prominence_db)
    places = []
    for i in found:
        if low <= frequency[i] <= high:
            left, middle, right = level[i - 1 : i + 2]
            curvature = left - 2 * middle + right
            shift = 0.5 * (left - right) / curvature if curvature < 0 else 0.0
            places.append(float(frequency[i] + shift * (frequency[1] - frequency[0])))
    return places
