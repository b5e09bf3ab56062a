"""Airy wave kinematics at finite depth, and irregular seas as a sum of regular components."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from offwind_pin.turbines.base import Array

_LARGEST_EXPONENT = 700.0
_BLOCK = 128
"""Times for which all components are held in memory at once."""
_DECIMALS = 10
"""Of times in s within a block: steps that differ by rounding only share their cosines, and the
phase of the shortest wave is met within 1e-9."""
_ROUNDING = 1e-14
"""Singular values below this part of the largest are rounding."""
_STREAM = 1
"""Keeps the random numbers of waves and wind apart when a case gives both one seed."""


def wave_number(angular_frequency: Array, depth: float, gravity: float) -> Array:
    """Wave numbers in rad/m from omega^2 = g k tanh(k h), by Newton to 1e-14 relative.

    angular_frequency in rad/s (positive), depth in m, gravity in m/s2.
    """
    deep = angular_frequency**2 * depth / gravity
    kh = np.where(deep > 1, deep, np.sqrt(deep))
    for _ in range(50):
        tanh = np.tanh(kh)
        step = (kh * tanh - deep) / (tanh + kh * (1 - tanh**2))
        kh = kh - step
        if np.all(np.abs(step) <= 1e-14 * kh):
            break
    else:
        raise RuntimeError("the dispersion relation did not converge")
    return kh / depth


def pierson_moskowitz(frequency: Array, significant_height: float, peak_period: float) -> Array:
    """One-sided variance spectrum of the surface elevation in m2/Hz (IEC 61400-3-1, Annex D).

    frequency in Hz (positive), significant height in m, peak period in s; its area is Hs^2 / 16.
    """
    ratio = 1 / (frequency * peak_period)
    return 5 / 16 * significant_height**2 / frequency * ratio**4 * np.exp(-1.25 * ratio**4)


@dataclass(frozen=True, eq=False)
class IrregularSea:
    """Long-crested waves travelling along +x: a sum of regular components.

    Attributes
    ----------
    amplitude, frequency, phase : (m,) in m, Hz and rad
    depth, gravity : in m and m/s2
    """

    amplitude: Array
    frequency: Array
    phase: Array
    depth: float
    gravity: float

    @staticmethod
    def pierson_moskowitz(
        significant_height: float,
        peak_period: float,
        *,
        depth: float,
        gravity: float,
        repeat_period: float,
        seed: int,
    ) -> IrregularSea:
        """Deterministic amplitudes, random phases, harmonics of 1 / repeat_period.

        Components run from 0.4 to 5 times the peak frequency; they hold 99.8 % of the variance,
        and shorter waves are lost on a cylinder many times their length.
        """
        step = 1 / repeat_period
        peak = 1 / peak_period
        harmonic = np.arange(np.ceil(0.4 * peak / step), np.floor(5 * peak / step) + 1)
        frequency = harmonic * step
        spectrum = pierson_moskowitz(frequency, significant_height, peak_period)
        phase = np.random.default_rng((seed, _STREAM)).uniform(0, 2 * np.pi, len(frequency))
        return IrregularSea(np.sqrt(2 * spectrum * step), frequency, phase, depth, gravity)

    @property
    def significant_height(self) -> float:
        """Realised significant wave height in m, four times the standard deviation."""
        return float(4 * np.sqrt(np.sum(self.amplitude**2) / 2))

    @property
    def peak_period(self) -> float:
        """Realised peak period in s: that of the largest component."""
        return float(1 / self.frequency[np.argmax(self.amplitude)])

    def elevation(self, time: Array) -> Array:
        """Surface elevation at x = 0 in m, (t,)."""
        blocks = [
            np.cos(2 * np.pi * np.outer(block, self.frequency) - self.phase) @ self.amplitude
            for block in np.array_split(time, len(time) // _BLOCK + 1)
        ]
        return np.concatenate(blocks)

    def kinematics_at(self, height: Array) -> WaveKinematics:
        """Kinematics at fixed heights z <= 0 on the axis x = 0."""
        omega = 2 * np.pi * self.frequency
        k = wave_number(omega, self.depth, self.gravity)
        above_bed = height[:, None] + self.depth
        grow = np.exp(np.maximum(k * height[:, None], -_LARGEST_EXPONENT))
        decay = np.exp(-2 * k * above_bed)
        full = 1 - np.exp(-2 * k * self.depth)
        horizontal = grow * (1 + decay) / full
        vertical = grow * (1 - decay) / full
        return WaveKinematics(
            omega,
            self.phase,
            self.amplitude * omega * horizontal,
            self.amplitude * omega * vertical,
        )


@dataclass(frozen=True, eq=False)
class WaveKinematics:
    """Particle velocity and acceleration at n fixed points, by component.

    omega, phase (m,) in rad/s and rad; horizontal, vertical (n, m) velocity amplitudes in m/s.
    """

    omega: Array
    phase: Array
    horizontal: Array
    vertical: Array
    _kept: tuple[Array, Array, Array] | None = field(default=None, init=False, repr=False)

    def at(self, time: float) -> tuple[Array, Array]:
        """Velocity (n, 3) in m/s and acceleration (n, 3) in m/s2."""
        velocity, acceleration = self.at_times(np.array([time]))[0]
        return velocity, acceleration

    def at_times(self, time: Array) -> Array:
        """(t, 2, n, 3) velocity in m/s and acceleration in m/s2 at times in s.

        Times that lie apart like those of the call before are cheap: only the phases at the first
        of them are new.
        """
        result = np.zeros((len(time), 2, len(self.horizontal), 3))
        if len(self.omega) == 0:
            return result
        for first in range(0, len(time), _BLOCK):
            part = slice(first, min(first + _BLOCK, len(time)))
            cos, sin = self._turned(time[part] - time[first])
            angle = self.omega * time[first] - self.phase
            c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
            # cos(a + b) and sin(a + b) of the start's phase a and the time's own b
            by_cos = c * self._basis.by_cos + s * self._basis.by_sin
            by_sin = c * self._basis.by_sin - s * self._basis.by_cos
            blends = cos @ by_cos + sin @ by_sin
            for profile in self._basis.profiles:
                blend = blends[:, profile.columns]
                result[part, profile.order, :, profile.axis] = blend @ profile.over_height
        return result

    def _turned(self, offset: Array) -> tuple[Array, Array]:
        """(t, m) cosines and sines of the components at times from a start.

        The times are rounded first, so that what comes out depends on them alone, and not on
        whether it was kept.
        """
        offset = np.round(offset, _DECIMALS)
        kept = self._kept
        if kept is None or not np.array_equal(kept[0], offset):
            angle = np.outer(offset, self.omega)
            kept = (offset, np.cos(angle), np.sin(angle))
            object.__setattr__(self, "_kept", kept)
        return kept[1], kept[2]

    @cached_property
    def _basis(self) -> _Basis:
        """The amplitudes of all components as blends of a few profiles over height."""
        by_cos, by_sin, profiles = [], [], []
        column = 0
        for axis, amplitude in ((0, self.horizontal), (2, self.vertical)):
            left, size, right = np.linalg.svd(amplitude, full_matrices=False)
            rank = int(np.sum(size > _ROUNDING * size[0]))
            over_height, weight = (left[:, :rank] * size[:rank]).T.copy(), right[:rank].T
            nothing, rate = np.zeros_like(weight), weight * self.omega[:, None]
            # horizontal: cos, rate -omega sin; vertical: -sin, rate -omega cos
            by_cos += [weight, nothing] if axis == 0 else [nothing, -rate]
            by_sin += [nothing, -rate] if axis == 0 else [-weight, nothing]
            for order in range(2):
                columns = slice(column, column + rank)
                profiles.append(_Profile(axis, order, columns, over_height))
                column += rank
        return _Basis(np.hstack(by_cos), np.hstack(by_sin), profiles)


@dataclass(frozen=True, eq=False)
class _Profile:
    """Profiles over height (r, n) of one direction, and the columns of a basis they go with.

    order : 0 velocity, 1 acceleration
    """

    axis: int
    order: int
    columns: slice
    over_height: Array


@dataclass(frozen=True, eq=False)
class _Basis:
    """Weights (m, c) of the components' cosines and sines in each blend of profiles."""

    by_cos: Array
    by_sin: Array
    profiles: list[_Profile]
