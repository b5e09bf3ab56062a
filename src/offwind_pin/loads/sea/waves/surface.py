"""The surface of waves wherever one looks, not at the structure's axis alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.stream_function import StreamFunctionWaves
from offwind_pin.loads.sea.waves.wave_field import WaveField

MOST_COMPONENTS = 4000
"""Components that are all kept; of more, the fewest that hold :data:`KEPT_SHARE`."""
KEPT_SHARE = 0.999
"""Of the variance of the surface."""
_AT_ONCE = 16
"""Instants of a patch of sea that are summed at once, to bound the memory."""


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
        """Of a field whose spread over the plane is known: free components, or a steady wave.

        Of waves of second order it is the linear part; what is bound to pairs of one frequency is
        of many lengths.
        """
        waves = waves.first_order
        if isinstance(waves, LinearWaves):
            along: Array = waves.wave_number
            angle = waves.direction
        elif isinstance(waves, StreamFunctionWaves):
            # its harmonics are bound to the first, and travel with it
            along = waves.harmonic * float(waves.wave.wave_number)
            angle = np.full(len(along), waves.direction)
        else:
            return None
        frequency = waves.omega / (2 * np.pi)
        x, y = along * np.cos(angle), along * np.sin(angle)
        every = SurfaceWaves(frequency, waves.elevation, x, y)
        return every.part(waves.elevation != 0)

    def part(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> SurfaceWaves:
        """Some of the components, by a mask or by their places."""
        return SurfaceWaves(
            self.frequency[chosen],
            self.elevation[chosen],
            self.number_x[chosen],
            self.number_y[chosen],
        )

    def largest(self, most: int = MOST_COMPONENTS, share: float = KEPT_SHARE) -> SurfaceWaves:
        """All components, or of more than ``most`` the fewest with a share of the variance."""
        if len(self.frequency) <= most:
            return self
        power = np.abs(self.elevation) ** 2
        falling = np.argsort(-power, kind="stable")
        count = int(np.searchsorted(np.cumsum(power[falling]), share * power.sum())) + 1
        return self.part(np.sort(falling[:count]))

    def longer_than(self, length: float) -> SurfaceWaves:
        """Components whose waves are at least so long in m."""
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
