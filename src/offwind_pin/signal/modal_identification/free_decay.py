"""Frequency and damping of decaying oscillations, by the logarithmic decrement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError

Array = NDArray[np.float64]

FEWEST = 3
"""Half cycles needed for the standard error of a straight line through their logarithms."""
_NO_DECAY = 1e-9
"""Logarithmic decrement of a half cycle that is rounding error."""
_SAMPLES_PER_CYCLE = 8
"""Below, a parabola through three samples misses an extreme by more than half a per cent."""


@dataclass(frozen=True, eq=False)
class Decrement:
    """A straight line through the logarithms of amplitudes.

    Attributes
    ----------
    frequency_hz : float
        Undamped natural frequency.
    damping_ratio : float
        Of critical.
    damping_error : float
        Standard error of the ratio, from the scatter about the line.
    used : int
        Number of half cycles in the line.
    reached : bool
        Whether the amplitudes fell to the lower end of the range.
    """

    frequency_hz: float
    damping_ratio: float
    damping_error: float
    used: int
    reached: bool


@dataclass(frozen=True, eq=False)
class FreeDecay:
    """Frequency and damping found from a free decay.

    Attributes
    ----------
    frequency_hz : float
        Undamped natural frequency of the amplitudes in the range.
    damping_ratio : float
        Of critical, over the whole range of amplitudes.
    damping_error : float
        Standard error of that ratio, from the scatter about the straight line.
    time : (k,) array, s
        Middle of each half cycle, from the largest on.
    amplitude : (k,) array
        Half the difference of the two extremes, in the signal's unit.
    local_amplitude : (k - 2,) array
        Geometric mean of amplitudes one cycle apart.
    local_damping : (k - 2,) array
        Damping ratio of that cycle alone; with nonlinear damping it changes with the
        amplitude.
    """

    frequency_hz: float
    damping_ratio: float
    damping_error: float
    time: Array
    amplitude: Array
    local_amplitude: Array
    local_damping: Array

    __repr__ = one_line


def free_decay(
    values: Array,
    dt: float,
    frequency_band: tuple[float, float] | None = None,
    amplitude_range: tuple[float, float] = (1.0, 0.05),
) -> FreeDecay:
    """Frequency and damping of one free oscillation, and the damping at each amplitude.

    The decrement is taken between half differences of neighbouring extremes, so that an offset of
    the signal does not matter. Of a linear oscillation they fall exactly as exp(-zeta omega t).

    Parameters
    ----------
    values : (n,) array
        Samples at equal intervals; what comes before the largest half cycle is left out.
    dt : float, s
        Interval.
    frequency_band : (float, float), Hz, optional
        Lowest and highest frequency; a Butterworth filter of second order, forwards and backwards,
        leaves what lies between. The first and the last cycle of a filtered signal are left out.
    amplitude_range : (float, float)
        Of the amplitudes in the line, over the largest.

    Returns
    -------
    FreeDecay

    Raises
    ------
    InputError
        Not a vector of finite numbers, a constant signal, an invalid band or range, too few
        samples per cycle, too few half cycles, amplitudes that do not decrease.
    """
    samples = _checked(values, dt)
    upper, lower = checked_range(amplitude_range)
    if frequency_band is not None:
        samples = _filtered(samples, dt, frequency_band)
    guess = _strongest(samples, dt)
    if guess * dt * _SAMPLES_PER_CYCLE > 1:
        raise InputError(
            "dt",
            f"{1 / (guess * dt):.3g} samples per cycle of {guess:.4g} Hz",
            f"{_SAMPLES_PER_CYCLE} or more",
            "Use a higher sampling rate, or give the frequency_band of a slower mode.",
        )
    time, value = extremes(samples, dt, guess)
    if frequency_band is not None:
        inside = (time > 1 / guess) & (time < len(samples) * dt - 1 / guess)
        time, value = time[inside], value[inside]
    middle, amplitude = half_cycles(time, value)
    if len(amplitude) < FEWEST:
        raise InputError(
            "values", f"{len(amplitude)} half cycles", f"{FEWEST} or more", "Give a longer decay."
        )
    first = int(np.argmax(amplitude))
    time, middle, amplitude = time[first:], middle[first:], amplitude[first:]
    line = decrement(time, amplitude, amplitude[0] * upper, amplitude[0] * lower, "values")
    ratio = np.log(amplitude[:-2] / amplitude[2:])
    return FreeDecay(
        frequency_hz=line.frequency_hz,
        damping_ratio=line.damping_ratio,
        damping_error=line.damping_error,
        time=middle,
        amplitude=amplitude,
        local_amplitude=np.sqrt(amplitude[:-2] * amplitude[2:]),
        local_damping=ratio / np.hypot(2 * np.pi, ratio),
    )


def extremes(values: Array, dt: float, frequency: float) -> tuple[Array, Array]:
    """Times in s and values of maxima and minima in turn, each at the parabola of three samples.

    frequency : in Hz, near that of the oscillation; of what moves faster, only the largest counts
    """
    from scipy import signal

    apart = max(1, int(0.6 / (frequency * dt)))
    highs = signal.find_peaks(values, distance=apart)[0]
    lows = signal.find_peaks(-values, distance=apart)[0]
    at = np.concatenate([highs, lows])
    sign = np.concatenate([np.ones(len(highs)), -np.ones(len(lows))])
    order = np.argsort(at)
    at, sign = at[order], sign[order]
    # Of neighbours of one kind the larger one is the extreme.
    kept: list[int] = []
    for i in range(len(at)):
        if kept and sign[kept[-1]] == sign[i]:
            if sign[i] * values[at[i]] > sign[i] * values[at[kept[-1]]]:
                kept[-1] = i
        else:
            kept.append(i)
    at = at[kept]
    left, middle, right = values[at - 1], values[at], values[at + 1]
    curvature = left - 2 * middle + right
    flat = curvature == 0
    shift = np.where(flat, 0.0, 0.5 * (left - right) / np.where(flat, 1.0, curvature))
    return (at + shift) * dt, middle - 0.25 * (left - right) * shift


def half_cycles(time: Array, value: Array) -> tuple[Array, Array]:
    """Middle in s and half the difference of neighbouring extremes."""
    return (time[1:] + time[:-1]) / 2, np.abs(np.diff(value)) / 2


def decrement(time: Array, amplitude: Array, upper: float, lower: float, where: str) -> Decrement:
    """Frequency and damping of amplitudes in a range, by least squares on their logarithms.

    The line goes over the number of the half cycle: an amplitude falls by
    pi zeta / sqrt(1 - zeta^2) each, whatever the frequency.

    Parameters
    ----------
    time : (k + 1,) array, s
        Of the extremes.
    amplitude : (k,) array
        Of the half cycles between them.
    upper, lower : float
        The line starts at the first amplitude not above the one, and ends before the first below
        the other.
    where : str
        Where the error occurred, for its message.

    Raises
    ------
    InputError
        Fewer than three amplitudes in the range, or amplitudes that do not fall by more than twice
        the standard error.
    """
    below = np.flatnonzero(amplitude <= upper * (1 + 1e-12))
    first = int(below[0]) if len(below) else len(amplitude)
    past = np.flatnonzero(amplitude[first:] < lower)
    last = first + int(past[0]) if len(past) else len(amplitude)
    used = last - first
    if used < FEWEST:
        raise InputError(
            where,
            f"{used} half cycles with amplitudes from {upper:.3g} to {lower:.3g}",
            f"{FEWEST} or more",
            "Widen the range of amplitudes, or give a longer signal.",
        )
    number = np.arange(used, dtype=np.float64)
    slope, error = _line(number, np.log(amplitude[first:last]))
    if slope > -max(2 * error, _NO_DECAY):
        raise InputError(
            where,
            "amplitudes that do not decrease by more than their scatter",
            "a decaying oscillation",
            "Cut the signal to its decay, or give a narrower frequency band.",
        )
    half_period, _ = _line(np.arange(used + 1.0), time[first : last + 1])
    ratio = -slope / np.hypot(np.pi, slope)
    return Decrement(
        frequency_hz=float(0.5 / half_period / np.sqrt(1 - ratio**2)),
        damping_ratio=float(ratio),
        damping_error=float(error * np.pi**2 / np.hypot(np.pi, slope) ** 3),
        used=used,
        reached=bool(len(past)),
    )


def checked_range(amplitude_range: tuple[float, float]) -> tuple[float, float]:
    """Upper and lower end of a range of amplitudes, over the largest."""
    upper, lower = amplitude_range
    if not 0 < lower < upper <= 1:
        raise InputError(
            "amplitude_range",
            f"{upper:g} to {lower:g}",
            "0 < lower < upper <= 1, the upper one first",
            "Correct it.",
        )
    return upper, lower


def _line(x: Array, y: Array) -> tuple[float, float]:
    """Slope of the straight line through points by least squares, and its standard error."""
    across = x - x.mean()
    slope = across @ y / (across @ across)
    left = y - y.mean() - slope * across
    return float(slope), float(np.sqrt(left @ left / (len(x) - 2) / (across @ across)))


def _strongest(values: Array, dt: float) -> float:
    """Frequency in Hz of the strongest line, the mean and the zeros about it left out."""
    padded = 4 * len(values)
    lines = np.abs(np.fft.rfft(values - values.mean(), padded))
    # A slow drift is in the lowest lines: fewer than two cycles are not an oscillation.
    lines[:8] = 0.0
    return float(np.argmax(lines) / (padded * dt))


def _filtered(values: Array, dt: float, band: tuple[float, float]) -> Array:
    from scipy import signal

    low, high = band
    if not 0 < low < high < 0.5 / dt:
        allowed = f"0 < low < high < {0.5 / dt:g} Hz, half the sampling frequency"
        raise InputError("frequency_band", f"{low:g} to {high:g} Hz", allowed, "Choose another.")
    sections = signal.butter(2, [low, high], "bandpass", fs=1 / dt, output="sos")
    return np.asarray(signal.sosfiltfilt(sections, values - values.mean()), dtype=np.float64)


def _checked(values: Array, dt: float) -> Array:
    samples = np.asarray(values, dtype=np.float64)
    if samples.ndim != 1 or len(samples) < 32:
        allowed = "a vector of 32 samples or more"
        raise InputError(
            "values", f"an array of shape {samples.shape}", allowed, "Give one channel."
        )
    if not (np.isfinite(dt) and dt > 0):
        raise InputError("dt", dt, "a positive number in s", "Give the sampling interval.")
    if not np.all(np.isfinite(samples)):
        row = int(np.flatnonzero(~np.isfinite(samples))[0])
        raise InputError(f"values, row {row}", float(samples[row]), "finite numbers", "Cut it out.")
    if np.ptp(samples) == 0:
        raise InputError(
            "values", "the same number at all times", "a signal that varies", "Check the channel."
        )
    return samples
