"""Sums of many harmonics at arbitrary times, from a table on a uniform grid and a short kernel.

A nonuniform fast Fourier transform (type 2) in the form of Barnett, Magland and af Klinteberg
(SIAM J. Sci. Comput. 41, 2019, C479): the amplitudes are divided by the transform of a kernel, one
inverse FFT puts the sums on a grid of more than twice the needed points, and at any time the kernel
blends the nearest of them.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.base.kernels import kernel

TAPS = 14
_SHAPE = 2.30 * TAPS
"""Barnett and others' choice, Eq. 1.8, for at least twice the needed points."""


class HarmonicSeries:
    """Sums Re sum_j amplitude_cj exp(i 2 pi harmonic_j t / period), c of them.

    Values depend on the time alone, bitwise, whatever other times are evaluated with it. They are
    accurate to 1e-11 of the largest value of a sum. Memory: 4 to 5 numbers for each sum and each
    harmonic up to the highest.

    Parameters
    ----------
    period : float, s
    harmonic : (m,) array
        Distinct whole numbers from 0.
    amplitude : (c, m) complex array
    """

    def __init__(self, period: float, harmonic: Array, amplitude: ComplexArray) -> None:
        from scipy.fft import irfft, next_fast_len

        self.period = period
        highest = int(np.max(harmonic, initial=0))
        self._points = next_fast_len(max(2 * (2 * highest + 1), 4 * TAPS), real=True)
        order = harmonic.astype(np.intp)
        weight = amplitude / _transform(order, self._points)
        lines = np.zeros((len(amplitude), self._points // 2 + 1), dtype=complex)
        lines[:, order] = weight * np.where(order == 0, self._points, self._points / 2)
        self._table = np.ascontiguousarray(irfft(lines, n=self._points, axis=1).T)

    def at(self, time: Array) -> Array:
        """(t, c) the sums at times (t,) in s."""
        result = np.zeros((len(time), self._table.shape[1]))
        _blend(self._table, np.asarray(time, dtype=float) / self.period, result)
        return result

    @cached_property
    def extremes(self) -> tuple[Array, Array]:
        """(c,) minimum and maximum of the sums over a period, to 1e-4 of their range.

        Evaluated at four times the grid's points, 16 in the shortest wave, and refined by a
        parabola.
        """
        count = 4 * self._points
        time = np.linspace(0.0, self.period, count, endpoint=False)
        low, high = np.full((2, self._table.shape[1]), np.inf)
        high = -high
        for first in range(0, len(time), 4096):
            part = self.at(time[first : first + 4097])
            low = np.minimum(low, -_peaks(-part))
            high = np.maximum(high, _peaks(part))
        return low, high


def _peaks(values: Array) -> Array:
    """(c,) largest of columns, refined by the parabola through it and its neighbours."""
    at = np.clip(np.argmax(values, axis=0), 1, len(values) - 2)
    column = np.arange(values.shape[1])
    before, here, after = values[at - 1, column], values[at, column], values[at + 1, column]
    bend = before - 2 * here + after
    slope = (after - before) / 2
    refined = here - np.where(bend < 0, slope**2 / (2 * np.minimum(bend, -1e-300)), 0.0)
    top = np.max(values, axis=0)
    inside = (bend < 0) & (np.abs(slope) <= np.abs(bend))
    return np.where(inside, np.maximum(refined, top), top)


def _transform(order: np.ndarray[tuple[int], np.dtype[np.intp]], points: int) -> Array:
    """(m,) transform of the kernel at harmonics, by Gauss's quadrature."""
    node, weight = np.polynomial.legendre.leggauss(60)
    bell = weight * np.exp(_SHAPE * (np.sqrt(1 - node**2) - 1))
    # an even function of the harmonic over the grid size, smooth enough to be interpolated
    place = np.polynomial.chebyshev.chebpts1(41)
    exact = bell @ np.cos(np.pi * TAPS / 8 * np.multiply.outer(node, place + 1))
    share = np.polynomial.chebyshev.chebfit(place, exact, 40)
    value = np.polynomial.chebyshev.chebval(8 * order / points - 1, share)
    return np.asarray(TAPS / 2 * value)


@kernel
def _blend(table: Array, turns: Array, result: Array) -> None:
    """Set (t, c) values at times in periods from a table (n, c)."""
    points, columns = table.shape
    for i in range(len(turns)):
        place = (turns[i] - np.floor(turns[i])) * points
        first = int(np.ceil(place - TAPS / 2))
        for j in range(first, first + TAPS):
            x = (place - j) * 2 / TAPS
            inside = 1 - x * x
            if inside <= 0:
                continue
            weight = np.exp(_SHAPE * (np.sqrt(inside) - 1))
            row = table[j % points]
            for c in range(columns):
                result[i, c] += weight * row[c]
