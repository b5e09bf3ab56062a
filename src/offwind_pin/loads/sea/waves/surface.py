"""The water surface around the structure, not only at its axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.stream_function import StreamFunctionWaves
from offwind_pin.loads.sea.waves.wave_field import WaveField

MOST_COMPONENTS = 4000
"""Number of components up to which all are kept; of more, the fewest with :data:`KEPT_SHARE`."""
KEPT_SHARE = 0.999
"""Fraction of the variance of the surface."""
_AT_ONCE = 16
"""Number of instants of a patch of sea that are summed at once, to limit memory."""


@dataclass(frozen=True, eq=False)
class SurfaceWaves:
    """A surface above its mean level, in m, as a sum over components:

        Re sum_j elevation_j exp(i (2 pi frequency_j t - number_xj x - number_yj y))

    Attributes
    ----------
    frequency : (m,) array, Hz
    elevation : (m,) complex array, m
        Complex amplitudes.
    number_x, number_y : (m,) array, rad/m
        Of the wave number vectors.
    """

    frequency: Array
    elevation: ComplexArray
    number_x: Array
    number_y: Array

    @staticmethod
    def of(waves: WaveField) -> SurfaceWaves | None:
        """Surface of a field that is known over the plane: free components, or a steady wave.

        For second-order waves it is the linear part, since the bound components of one frequency
        have many wave lengths.
        """
        waves = waves.first_order
        if isinstance(waves, LinearWaves):
            along: Array = waves.wave_number
            angle = waves.direction
        elif isinstance(waves, StreamFunctionWaves):
            # its harmonics are bound to the first and travel with it
            along = waves.harmonic * float(waves.wave.wave_number)
            angle = np.full(len(along), waves.direction)
        else:
            return None
        frequency = waves.omega / (2 * np.pi)
        x, y = along * np.cos(angle), along * np.sin(angle)
        every = SurfaceWaves(frequency, waves.elevation, x, y)
        return every.part(waves.elevation != 0)

    def part(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> SurfaceWaves:
        """Some of the components, by a mask or by indices."""
        return SurfaceWaves(
            self.frequency[chosen],
            self.elevation[chosen],
            self.number_x[chosen],
            self.number_y[chosen],
        )

    def largest(self, most: int = MOST_COMPONENTS, share: float = KEPT_SHARE) -> SurfaceWaves:
        """All components or, of more than ``most``, the fewest with a fraction of the variance."""
        if len(self.frequency) <= most:
            return self
        power = np.abs(self.elevation) ** 2
        falling = np.argsort(-power, kind="stable")
        count = int(np.searchsorted(np.cumsum(power[falling]), share * power.sum())) + 1
        return self.part(np.sort(falling[:count]))

    def longer_than(self, length: float) -> SurfaceWaves:
        """Components with wave lengths of at least a length in m."""
        return self.part(np.hypot(self.number_x, self.number_y) * length <= 2 * np.pi)

    def at(self, time: Array, x: Array, y: Array) -> Array:
        """(t, p, q) elevations in m on a grid of x (p,) and y (q,) in m, at times (t,) in s."""
        over_x = np.exp(-1j * np.multiply.outer(x, self.number_x))
        over_y = np.exp(-1j * np.multiply.outer(self.number_y, y))
        result = np.empty((len(time), len(x), len(y)))
        for first in range(0, len(time), _AT_ONCE):
            some = time[first : first + _AT_ONCE]
            turned = self.elevation * np.exp(2j * np.pi * np.multiply.outer(some, self.frequency))
            sums = (turned[:, None, :] * over_x).reshape(-1, len(self.frequency)) @ over_y
            result[first : first + len(some)] = sums.real.reshape(len(some), len(x), len(y))
        return result
