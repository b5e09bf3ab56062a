"""Base class of waves: harmonics of one period at the structure's axis."""

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
        Period after which the waves repeat.
    harmonic : (m,) array
        Whole numbers from 0 (a mean, such as a return current) upwards.
    elevation : (m,) complex array, m
        Complex amplitudes of the surface above the mean water level.
    wave_number : (m,) array, rad/m
        Wave numbers of free waves of these frequencies, for diffraction.
    depth : float, m
        From the mudline to the mean water level.
    gravity : float, m/s2
    exact_surface : bool
        Whether the kinematics are valid up to the moving surface and must not be stretched.
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
        """The free waves alone, if the field distinguishes them from bound ones; otherwise
        itself."""
        return self

    @abstractmethod
    def velocity(self, height: Array) -> ComplexArray:
        """Complex amplitudes of the particle velocity.

        Parameters
        ----------
        height : (n,) array, m
            Above the mean water level, from -depth upwards. Above the level linear fields return
            their values at it, exact ones evaluate their own formula.

        Returns
        -------
        (3, n, m) complex array, m/s
        """

    def acceleration(self, height: Array) -> ComplexArray:
        """Complex amplitudes of the particle acceleration, the local one unless overridden.

        Parameters
        ----------
        height : (n,) array, m
            As for :meth:`velocity`.

        Returns
        -------
        (3, n, m) complex array, m/s2
        """
        return 1j * self.omega * self.velocity(height)
