"""Linear (Airy) waves at finite depth: a sum of independent free components."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.base.descriptions import one_line
from offwind_pin.loads.sea.waves.dispersion import wave_number, wave_number_in_current
from offwind_pin.loads.sea.waves.wave_field import WaveField

_LARGEST_EXPONENT = 700.0


@dataclass(frozen=True, eq=False)
class LinearWaves(WaveField):
    """Free waves of small steepness, each with its own direction.

    Attributes
    ----------
    period, depth, gravity : float
        See :class:`WaveField`.
    harmonic : (m,) array
        See :class:`WaveField`; none is 0.
    elevation : (m,) complex array, m
        See :class:`WaveField`.
    direction : (m,) array, rad
        Direction of travel of each component, from +x towards +y.
    wave_number : (m,) array, rad/m
    carried : (m,) array or float, m/s
        Current along each component that carries it.
    blocked : float
        Fraction of the variance that an opposing current blocks and that is omitted.
    """

    period: float
    harmonic: Array
    elevation: ComplexArray
    direction: Array
    depth: float
    gravity: float
    wave_number: Array
    carried: Array | float = 0.0
    blocked: float = 0.0

    __repr__ = one_line

    @staticmethod
    def free(
        period: float,
        harmonic: Array,
        elevation: ComplexArray,
        depth: float,
        gravity: float,
        direction: Array | float = 0.0,
    ) -> LinearWaves:
        """Components on water at rest.

        Parameters
        ----------
        period : float, s
            After which the waves repeat.
        harmonic : (m,) array
            Harmonics of 1 / period, from 1.
        elevation : (m,) complex array, m
            Complex amplitudes of the surface.
        depth : float, m
        gravity : float, m/s2
        direction : (m,) array or float, rad
            Towards which they travel.

        Returns
        -------
        LinearWaves
        """
        k = wave_number(2 * np.pi * harmonic / period, depth, gravity)
        directions = np.broadcast_to(np.asarray(direction, dtype=float), harmonic.shape)
        return LinearWaves(period, harmonic, elevation, directions, depth, gravity, k)

    @staticmethod
    def in_current(
        period: float,
        harmonic: Array,
        elevation: ComplexArray,
        depth: float,
        gravity: float,
        direction: Array | float,
        current: Array,
    ) -> LinearWaves:
        """Components as seen by a fixed observer, on flowing water.

        Frequencies and amplitudes at the axis are those given; wave lengths and particle motion are
        those in the moving water. Components that the current blocks are omitted.

        Parameters
        ----------
        period : float, s
            After which the waves repeat.
        harmonic : (m,) array
            Harmonics of 1 / period, from 1.
        elevation : (m,) complex array, m
            Complex amplitudes of the surface.
        depth : float, m
        gravity : float, m/s2
        direction : (m,) array or float, rad
            Towards which they travel.
        current : (3,) array, m/s
            The same at all depths.

        Returns
        -------
        LinearWaves
        """
        directions = np.broadcast_to(np.asarray(direction, dtype=float), harmonic.shape)
        along = current[0] * np.cos(directions) + current[1] * np.sin(directions)
        omega = 2 * np.pi * harmonic / period
        k = wave_number_in_current(omega, depth, gravity, along)
        moving = np.isfinite(k)
        square = np.abs(elevation) ** 2
        return LinearWaves(
            period,
            harmonic[moving],
            elevation[moving],
            directions[moving],
            depth,
            gravity,
            k[moving],
            along[moving],
            float(np.sum(square[~moving]) / np.sum(square)),
        )

    @property
    def intrinsic_omega(self) -> Array:
        """(m,) angular frequencies in rad/s in the moving water."""
        return self.omega - self.wave_number * self.carried

    def velocity(self, height: Array) -> ComplexArray:
        horizontal, vertical = self._profiles(np.minimum(height, 0.0))
        speed = self.intrinsic_omega * self.elevation
        along = speed * horizontal
        return np.stack(
            [along * np.cos(self.direction), along * np.sin(self.direction), 1j * speed * vertical]
        )

    def acceleration(self, height: Array) -> ComplexArray:
        """Acceleration of the particles in the moving water, i (omega - k U) times the velocity.

        Parameters
        ----------
        height : (n,) array, m
            As for :meth:`velocity`.

        Returns
        -------
        (3, n, m) complex array, m/s2
        """
        return 1j * self.intrinsic_omega * self.velocity(height)

    def _profiles(self, height: Array) -> tuple[Array, Array]:
        """(n, m) cosh k(z + h) / sinh kh and sinh k(z + h) / sinh kh, without overflow."""
        k = self.wave_number
        grow = np.exp(np.maximum(np.multiply.outer(height, k), -_LARGEST_EXPONENT))
        decay = np.exp(-2 * np.multiply.outer(height + self.depth, k))
        full = 1 - np.exp(-2 * k * self.depth)
        return grow * (1 + decay) / full, grow * (1 - decay) / full
