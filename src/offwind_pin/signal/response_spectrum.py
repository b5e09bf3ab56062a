"""Response spectra and intensity measures of accelerograms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import kernel

Array = NDArray[np.float64]

_PER_PERIOD = 100
"""Instants per period at which the response is evaluated; between them the peak of a harmonic is
missed by 1 - cos(pi / 100) = 0.05 % at most."""


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Largest responses of damped oscillators to a motion of their base, (p,) or (p, c) each.

    Attributes
    ----------
    period : (p,) array, s
        Undamped natural periods.
    damping_ratio : float
        Of all oscillators.
    displacement : array, m
        Largest displacement relative to the base.
    absolute_acceleration : array, m/s2
        Largest acceleration of the mass.
    """

    period: Array
    damping_ratio: float
    displacement: Array
    absolute_acceleration: Array

    @property
    def pseudo_velocity(self) -> Array:
        """Displacement times the angular frequency, in m/s."""
        return (self.displacement.T * (2 * np.pi / self.period)).T

    @property
    def pseudo_acceleration(self) -> Array:
        """Displacement times the square of the angular frequency, in m/s2."""
        return (self.displacement.T * (2 * np.pi / self.period) ** 2).T


def response_spectrum(
    acceleration: Array, dt: float, period: Array, damping_ratio: float = 0.05
) -> ResponseSpectrum:
    """Response spectrum of an acceleration that is linear between its samples.

    The oscillator u'' + 2 z w u' + w^2 u = -a, initially at rest, is advanced from instant to
    instant by the exact solution (Nigam and Jennings, Bulletin of the Seismological Society of
    America 59, 1969, pages 909 to 922). Steps are divided so that the largest value is not missed
    between instants, and the free vibration after the end is followed for one period.

    Parameters
    ----------
    acceleration : (t,) or (t, c) array, m/s2
        Of the base.
    dt : float, s
        Interval of the samples.
    period : (p,) array, s
    damping_ratio : float
        Share of critical damping.

    Raises
    ------
    InputError
        Fewer than two samples, or numbers that are out of range.
    """
    record = np.asarray(acceleration, dtype=float)
    periods = np.atleast_1d(np.asarray(period, dtype=float))
    if record.ndim not in (1, 2) or len(record) < 2 or not np.all(np.isfinite(record)):
        raise InputError(
            "acceleration",
            f"an array {record.shape}",
            "two finite samples or more, (t,) or (t, c)",
            "Is the record complete?",
        )
    for name, value, allowed, good in (
        ("dt", dt, "a positive number of seconds", np.isfinite(dt) and dt > 0),
        (
            "period",
            periods.tolist(),
            "positive numbers of seconds",
            periods.ndim == 1 and len(periods) > 0 and np.all(np.isfinite(periods) & (periods > 0)),
        ),
        ("damping_ratio", damping_ratio, "0 to less than 1", 0 <= damping_ratio < 1),
    ):
        if not good:
            raise InputError(name, value, allowed, "Correct it.")
    columns = np.ascontiguousarray(record.reshape(len(record), -1).T)
    shape = (len(periods), *record.shape[1:])
    largest = np.zeros((2, len(periods), len(columns)))
    for i, value in enumerate(periods):
        frequency = 2 * np.pi / value
        parts = max(1, int(np.ceil(_PER_PERIOD * dt / value)))
        step, decay = dt / parts, 2 * damping_ratio * frequency
        state, low, rise = _exact_step(frequency, damping_ratio, step)
        after = int(np.ceil(value / step))
        for j, column in enumerate(columns):
            largest[:, i, j] = _largest(column, parts, after, state, low, rise, frequency**2, decay)
    return ResponseSpectrum(
        periods, damping_ratio, largest[0].reshape(shape), largest[1].reshape(shape)
    )


def _exact_step(frequency: float, ratio: float, step: float) -> tuple[Array, Array, Array]:
    """How (u, u') at the end of a step depends on that at its start (2, 2), and on the
    accelerations at its start and at its end (2,) each.

    The exponential of the oscillator together with an acceleration and its slope, which is the
    matrix of Nigam and Jennings without their cases.
    """
    rate = np.zeros((4, 4))
    rate[0, 1] = 1.0
    rate[1, :3] = -(frequency**2), -2 * ratio * frequency, -1.0
    rate[2, 3] = 1.0
    whole = expm(step * rate)
    by_slope = whole[:2, 3] / step
    return np.ascontiguousarray(whole[:2, :2]), whole[:2, 2] - by_slope, by_slope


@kernel
def _largest(
    record: Array,
    parts: int,
    after: int,
    state: Array,
    low: Array,
    high: Array,
    stiffness: float,
    decay: float,
) -> tuple[float, float]:
    """Largest displacement and absolute acceleration, up to so many steps after the record."""
    u = v = displacement = acceleration = 0.0
    count = (len(record) - 1) * parts
    for n in range(count + after):
        if n < count:
            i, k = n // parts, n % parts
            slope = (record[i + 1] - record[i]) / parts
            first = record[i] + k * slope
            last = first + slope
        else:
            first = last = 0.0
        moved = state[0, 0] * u + state[0, 1] * v + low[0] * first + high[0] * last
        v = state[1, 0] * u + state[1, 1] * v + low[1] * first + high[1] * last
        u = moved
        displacement = max(displacement, abs(u))
        acceleration = max(acceleration, abs(stiffness * u + decay * v))
    return displacement, acceleration


def arias_intensity(acceleration: Array, dt: float, gravity: float) -> Array:
    """Arias intensity pi / (2 g) times the integral of a^2, in m/s, of (t,) or (t, c) samples.

    After Arias (Seismic Design for Nuclear Power Plants, 1970); exact between samples.
    """
    return np.pi / (2 * gravity) * _squares(acceleration, dt)[-1]


def significant_duration(
    acceleration: Array, dt: float, low: float = 0.05, high: float = 0.95
) -> float:
    """Time in s in which the Arias intensity of samples (t,) grows from a share to another.

    After Trifunac and Brady (Bulletin of the Seismological Society of America 65, 1975, pages 581
    to 626). Zero for a record of zeros.
    """
    whole = _squares(acceleration, dt)
    if whole[-1] == 0:
        return 0.0
    rising = np.concatenate([[True], np.diff(whole) > 0])
    begin, end = np.interp(
        [low * whole[-1], high * whole[-1]], whole[rising], dt * np.flatnonzero(rising)
    )
    return float(end - begin)


def _squares(acceleration: Array, dt: float) -> Array:
    """(t, ...) running integral of the square of an acceleration that is linear between samples."""
    a, b = acceleration[:-1], acceleration[1:]
    return np.concatenate([0 * a[:1], np.cumsum(dt / 3 * (a**2 + a * b + b**2), axis=0)])
