"""Linear (Airy) waves at finite depth: a sum of free components that travel on their own."""

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
    """Free waves of small steepness, each in a direction of its own.

    Attributes
    ----------
    period, depth, gravity : float
        See :class:`WaveField`.
    harmonic : (m,) array
        See :class:`WaveField`; none is 0.
    elevation : (m,) complex array, m
        See :class:`WaveField`.
    direction : (m,) array, rad
        Towards which each component travels, from +x towards +y.
    wave_number : (m,) array, rad/m
    carried : (m,) array or float, m/s
        Current along each component that carries it; 0 unless given.
    blocked : float
        Share of the variance that an opposing current stopped and that was left out.
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
        """Components (m,) on water at rest."""
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
        """Components (m,) as a fixed observer sees them, on water that flows.

        current (3,) in m/s, the same at all depths. Their frequencies and amplitudes at the axis
        are those given; their lengths, and the particles' motion, are those in the moving water.
        Components that the current blocks are left out.
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
        """(m,) angular frequencies in rad/s in the water that carries the waves."""
        return self.omega - self.wave_number * self.carried

    def velocity(self, height: Array) -> ComplexArray:
        horizontal, vertical = self._profiles(np.minimum(height, 0.0))
        speed = self.intrinsic_omega * self.elevation
        along = speed * horizontal
        return np.stack(
            [along * np.cos(self.direction), along * np.sin(self.direction), 1j * speed * vertical]
        )

    def acceleration(self, height: Array) -> ComplexArray:
        """(3, n, m) of the particles that the current carries: i (omega - k U) times velocity."""
        return 1j * self.intrinsic_omega * self.velocity(height)

    def _profiles(self, height: Array) -> tuple[Array, Array]:
        """(n, m) cosh k(z + h) / sinh kh and sinh k(z + h) / sinh kh, without overflow."""
        k = self.wave_number
        grow = np.exp(np.maximum(np.multiply.outer(height, k), -_LARGEST_EXPONENT))
        decay = np.exp(-2 * np.multiply.outer(height + self.depth, k))
        full = 1 - np.exp(-2 * k * self.depth)
        return grow * (1 + decay) / full, grow * (1 - decay) / full
