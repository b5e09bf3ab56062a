"""Water surface and particle motion over time, in waves and a current."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple, get_args

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import kernel
from offwind_pin.loads.sea.waves.nufft import HarmonicSeries
from offwind_pin.loads.sea.waves.wave_field import WaveField

Stretching = Literal["none", "vertical", "extrapolation", "wheeler"]

_LEVELS = 96
"""Heights at which stretched profiles are tabulated, densest at the surface."""
_SLOPE_LEVELS = 16
"""Number of these nearest to the surface from which slopes are taken."""
_ROUNDING = 1e-12
"""Fraction of the largest profile below which profiles are omitted."""
_BLOCK = 64
"""Number of times for which stretched profiles are in memory at once."""

_VERTICAL, _EXTRAPOLATION, _WHEELER, _EXACT = range(4)
_RULES = {"vertical": _VERTICAL, "extrapolation": _EXTRAPOLATION, "wheeler": _WHEELER}


class WaterSurface:
    """The surface of water at the axis: at a level, or in waves.

    Without stretching, waves act up to the mean water level, and the surface of the strips stays
    there. With stretching, the kinematics extend to the moving surface: constant above the mean
    water level (vertical), continued with the slope of the first order at the level (extrapolation;
    the second order is constant), or taken from the height (z - eta) h / (h + eta) (Wheeler, J.
    Petroleum Tech. 22, 1970, 359). Fields with an exact surface are not stretched.

    Attributes
    ----------
    waves : WaveField or None
        The waves; None for still water.
    level : float, m
        Mean height of the surface.
    rule : int or None
        Stretching rule; None if the surface does not move.
    highest_elevation, lowest_elevation : float, m
        Extremes over a whole period of the waves, above the level.
    highest, lowest : float, m
        Extremes of the surface of the strips.
    """

    def __init__(self, waves: WaveField | None, level: float, stretching: Stretching) -> None:
        if stretching not in get_args(Stretching):
            allowed = ", ".join(get_args(Stretching))
            raise InputError("sea, field stretching", stretching, allowed, "Choose one.")
        self.waves = waves
        self.level = level
        self.rule = _RULES.get(stretching)
        self.highest_elevation = self.lowest_elevation = 0.0
        self._elevation = None
        if waves is None:
            self.rule = None
        else:
            if waves.exact_surface:
                self.rule = _EXACT
            self._elevation = HarmonicSeries(waves.period, waves.harmonic, waves.elevation[None])
            low, high = self._elevation.extremes
            self.lowest_elevation, self.highest_elevation = float(low[0]), float(high[0])
        moves = self.rule is not None
        self.highest = level + (self.highest_elevation if moves else 0.0)
        self.lowest = level + (self.lowest_elevation if moves else 0.0)

    def elevation(self, time: Array) -> Array:
        """(t,) surface of the waves without ramp above the mean water level in m."""
        return np.zeros(len(time)) if self._elevation is None else self._elevation.at(time)[:, 0]

    def at(self, time: Array, ramp_factor: Array) -> Array:
        """(t,) height in m up to which strips are wet."""
        if self.rule is None:
            return np.full(len(time), self.level)
        return self.level + ramp_factor * self.elevation(time)


class WaterSeries:
    """Velocity and acceleration of water at n strips, and the surface up to which they are wet.

    Attributes
    ----------
    highest_surface, lowest_surface : float, m
        Extremes over a whole period of the waves; equal if the surface does not move.
    """

    def __init__(
        self,
        height: Array,
        surface: WaterSurface,
        *,
        current: Array | None = None,
        inertia_factor: Callable[[Array], ComplexArray] | None = None,
    ) -> None:
        """Heights (n,) of the strips in m, current (n, 3) at them in m/s.

        inertia_factor : function from heights (k,) in m to the factors (k, m) of the acceleration
            amplitudes, for diffraction
        """
        above_level = np.array(height, dtype=float) - surface.level
        self._surface = surface
        self._current = np.zeros((len(height), 3)) if current is None else current
        self._motion = None
        if surface.waves is not None:
            self._motion = _Motion(surface.waves, surface, above_level, inertia_factor)
        self.highest_surface, self.lowest_surface = surface.highest, surface.lowest

    def elevation(self, time: Array, ramp_factor: Array) -> Array:
        """(t,) surface of the waves above the mean water level in m."""
        return ramp_factor * self._surface.elevation(time)

    def surface(self, time: Array, ramp_factor: Array) -> Array:
        """(t,) height in m up to which strips are wet."""
        return self._surface.at(time, ramp_factor)

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 1 + 6 n) surface in m, velocity (n, 3) in m/s, acceleration (n, 3) in m/s2.

        ramp_factor (t,) multiplies the waves; the current acts fully.
        """
        n = len(self._current)
        rows = np.zeros((len(time), 1 + 6 * n))
        rows[:, 0] = self.surface(time, ramp_factor)
        if self._motion is not None:
            self._motion.write(time, ramp_factor, rows[:, 0] - self._surface.level, rows[:, 1:])
        rows[:, 1 : 1 + 3 * n] += self._current.ravel()
        return rows


class _Motion:
    """Particle motion as a few profiles over height times sums of harmonics.

    The amplitudes of all harmonics at many heights have few independent profiles over height. Sums
    are evaluated per profile, and each height combines the profiles.
    """

    def __init__(
        self,
        waves: WaveField,
        surface: WaterSurface,
        height: Array,
        inertia_factor: Callable[[Array], ComplexArray] | None,
    ) -> None:
        rule = surface.rule
        self._height, self._rule, self._depth = height, rule, waves.depth
        level = height
        if rule is not None:
            level = _levels(waves.depth, surface.highest_elevation if rule == _EXACT else 0.0)
        velocity = waves.velocity(level)
        acceleration = waves.acceleration(level)
        if inertia_factor is not None:
            acceleration = acceleration * inertia_factor(level + surface.level)
        self._parts, self._profiles, weights = _few_profiles(velocity, acceleration)
        self._sums = HarmonicSeries(waves.period, waves.harmonic, weights)
        self._level = level
        if rule is not None:
            self._splines = [_cubics(level, profiles) for profiles in self._profiles]
        self._slopes = None
        if rule == _EXTRAPOLATION:
            self._slopes = _slopes(waves.first_order, level, surface.level, inertia_factor)

    def write(self, time: Array, ramp_factor: Array, elevation: Array, result: Array) -> None:
        """Add to (t, 6 n) velocities, then accelerations, both (n, 3), under surfaces (t,)."""
        sums = ramp_factor[:, None] * self._sums.at(time)
        if self._rule is not None:
            slopes = np.zeros((len(time), 6))
            if self._slopes is not None:
                slopes = ramp_factor[:, None] * self._slopes.at(time)
            for first in range(0, len(time), _BLOCK):
                block = slice(first, first + _BLOCK)
                self._stretch(
                    self._rule, sums[block], slopes[block], elevation[block], result[block]
                )
            return
        whole = result.reshape(len(time), 2, len(self._height), 3)
        for part, profiles in zip(self._parts, self._profiles, strict=True):
            whole[:, part.quantity, :, part.axis] += sums[:, part.sums] @ profiles

    def _stretch(
        self, rule: int, sums: Array, slopes: Array, elevation: Array, result: Array
    ) -> None:
        """The same for a few times, at heights stretched to the surface."""
        for part, spline in zip(self._parts, self._splines, strict=True):
            cubics = (sums[:, part.sums] @ spline).reshape(len(sums), -1, 4)
            first = 3 * len(self._height) * part.quantity + part.axis
            slope = np.ascontiguousarray(slopes[:, 3 * part.quantity + part.axis])
            _stretched(
                rule,
                self._depth,
                self._height,
                elevation,
                self._level,
                cubics,
                slope,
                first,
                result,
            )


class _Part(NamedTuple):
    """Sums of the profiles of one quantity (0 velocity, 1 acceleration) and axis."""

    quantity: int
    axis: int
    sums: slice


def _levels(depth: float, top: float) -> Array:
    """Heights in m from the bed up to a top, closest where waves decay fastest."""
    share = np.linspace(1.0, 0.0, _LEVELS)
    below = -depth * share**2
    below[0] = -depth
    if top <= 0:
        return below
    return np.concatenate([below, np.linspace(0, top, max(2, _LEVELS // 2))[1:]])


def _cubics(level: Array, profiles: Array) -> Array:
    """(r, 4 (l - 1)) coefficients of the cubics between levels of profiles (r, l)."""
    from scipy.interpolate import CubicSpline

    coefficients = CubicSpline(level, profiles, axis=1).c  # (4, l - 1, r)
    return np.ascontiguousarray(coefficients.transpose(2, 1, 0)).reshape(len(profiles), -1)


def _slopes(
    waves: WaveField,
    level: Array,
    mean: float,
    inertia_factor: Callable[[Array], ComplexArray] | None,
) -> HarmonicSeries:
    """Sums of the derivatives by height, at the mean water level, of velocity and acceleration.

    level (l,) rising to 0, mean height of the surface in m; six sums, by quantity and axis
    """
    from scipy.interpolate import CubicSpline

    top = level[-_SLOPE_LEVELS:]
    factor = 1.0 if inertia_factor is None else inertia_factor(np.array([mean]))[0]
    by_height = [
        CubicSpline(top, field, axis=1)(0.0, 1)
        for field in (waves.velocity(top), waves.acceleration(top) * factor)
    ]
    return HarmonicSeries(waves.period, waves.harmonic, np.concatenate(by_height))


def _few_profiles(
    velocity: ComplexArray, acceleration: ComplexArray
) -> tuple[list[_Part], list[Array], ComplexArray]:
    """Parts, profiles (r, l) of each over height, and weights (c, m) of all their sums.

    Directions without motion have no part; both horizontal ones have the same profiles.
    """
    parts: list[_Part] = []
    profiles: list[Array] = []
    weights = [np.zeros((0, velocity.shape[2]), dtype=complex)]
    column = 0
    for quantity, field in enumerate((velocity, acceleration)):
        for axes in ((0, 1), (2,)):
            moving = [axis for axis in axes if np.any(field[axis])]
            if not moving:
                continue
            found = _profiles(np.hstack([field[axis] for axis in moving]))
            for axis in moving:
                weights.append(found @ field[axis])
                profiles.append(found)
                parts.append(_Part(quantity, axis, slice(column, column + len(found))))
                column += len(found)
    return parts, profiles, np.vstack(weights)


def _profiles(amplitude: ComplexArray) -> Array:
    """(r, l) orthonormal profiles that span all columns of (l, m), to rounding error."""
    columns = np.hstack([amplitude.real, amplitude.imag])
    if columns.shape[1] > columns.shape[0]:
        columns = np.asarray(np.linalg.qr(columns.T, mode="r")).T
    shape, size, _ = np.linalg.svd(columns, full_matrices=False)
    return np.ascontiguousarray(shape[:, size > _ROUNDING * size[0]].T)


@kernel
def _stretched(
    rule: int,
    depth: float,
    height: Array,
    elevation: Array,
    level: Array,
    cubics: Array,
    slope: Array,
    first: int,
    result: Array,
) -> None:
    """Add motions under moving surfaces (t,), from cubics (t, l - 1, 4) between the levels (l,).

    slope : (t,) of the extrapolation above the mean level
    first : index of the first strip's value in (t, 6 n); those of the next strips follow at steps
    of 3
    """
    last = len(level) - 2
    for t in range(len(elevation)):
        interval = 0
        for i in range(len(height)):
            z, beyond = height[i], 0.0
            if rule == _WHEELER:
                z = (z - elevation[t]) * depth / (depth + elevation[t])
            elif rule == _EXTRAPOLATION:
                beyond = max(min(z, elevation[t]), 0.0)
            if rule != _EXACT:
                z = min(z, 0.0)
            z = min(max(z, level[0]), level[last + 1])
            while interval < last and level[interval + 1] < z:
                interval += 1
            x = z - level[interval]
            c = cubics[t, interval]
            value = ((c[0] * x + c[1]) * x + c[2]) * x + c[3]
            if beyond > 0:
                value += beyond * slope[t]
            result[t, first + 3 * i] += value
