"""What every kind of waves is reduced to: harmonics of one period, seen at the structure's axis."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray


class WaveField(ABC):
    """Waves at x = y = 0 as a sum of harmonics of 1 / period; every quantity is

        Re sum_j amplitude_j exp(i 2 pi harmonic_j t / period)

    Attributes
    ----------
    period : float, s
        After which the waves repeat.
    harmonic : (m,) array
        Whole numbers from 0 (a mean, such as a return current) upwards.
    elevation : (m,) complex array, m
        Complex amplitudes of the surface above the mean water level.
    wave_number : (m,) array, rad/m
        Of free waves of these frequencies, for diffraction.
    depth : float, m
        From the mudline to the mean water level.
    gravity : float, m/s2
    exact_surface : bool
        Whether the kinematics hold up to the moving surface, and are not to be stretched to it.
    """

    period: float
    harmonic: Array
    elevation: ComplexArray
    wave_number: Array
    depth: float
    gravity: float
    exact_surface: bool = False

    @property
    def omega(self) -> Array:
        """(m,) angular frequencies in rad/s."""
        return 2 * np.pi * self.harmonic / self.period

    @property
    def first_order(self) -> WaveField:
        """The free waves alone, where the field tells them from what they bind; else all of it."""
        return self

    @abstractmethod
    def velocity(self, height: Array) -> ComplexArray:
        """(3, n, m) complex amplitudes of the particle velocity in m/s.

        height : (n,) in m above the mean water level, from -depth up; linear
        fields give the values at 0 above it, exact ones their own formula
        """

    def acceleration(self, height: Array) -> ComplexArray:
        """(3, n, m) of the particle acceleration in m/s2, the local one unless overridden."""
        return 1j * self.omega * self.velocity(height)
