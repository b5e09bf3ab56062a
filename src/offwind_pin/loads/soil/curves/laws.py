"""The five laws of soil curves of the package: linear, tanh, polygon, power, and PISA's conic."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import inner
from offwind_pin.loads.soil.curves.soil_curve import SoilCurve

_STRAIGHT = 1e-9
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, eq=False)
class LinearCurves(SoilCurve):
    """p = k y.

    modulus : (n,) k in N/m2
    """

    modulus: Array

    @property
    def ultimate(self) -> Array:
        return np.where(self.modulus > 0, np.inf, 0.0)

    @staticmethod
    def secant_at(parameters: Array, y: float) -> float:  # noqa: ARG004
        return parameters[0]

    @staticmethod
    def tangent_at(parameters: Array, y: float) -> float:  # noqa: ARG004
        return parameters[0]

    @staticmethod
    def energy_at(parameters: Array, y: float) -> float:
        return parameters[0] * y**2 / 2


@dataclass(frozen=True, eq=False)
class TanhCurves(SoilCurve):
    """p = p_u tanh(k y / p_u), and zero where p_u is zero.

    initial_modulus : (n,) k in N/m2
    ultimate : (n,) p_u in N/m
    """

    initial_modulus: Array
    ultimate: Array

    @staticmethod
    def secant_at(parameters: Array, y: float) -> float:
        modulus, ultimate = parameters[0], parameters[1]
        if ultimate <= 0:
            return 0.0
        x = modulus * y / ultimate
        return modulus * (np.tanh(x) / x if x > 1e-6 else 1 - x**2 / 3)

    @staticmethod
    def tangent_at(parameters: Array, y: float) -> float:
        modulus, ultimate = parameters[0], parameters[1]
        if ultimate <= 0:
            return 0.0
        return modulus * (1 - np.tanh(modulus * y / ultimate) ** 2)

    @staticmethod
    def energy_at(parameters: Array, y: float) -> float:
        modulus, ultimate = parameters[0], parameters[1]
        if ultimate <= 0 or modulus <= 0:
            return 0.0
        x = modulus * y / ultimate
        # ln cosh x, without overflow, and without cancellation for small x
        log_cosh = x + np.log1p(np.expm1(-2 * x) / 2) if x > 1e-3 else x**2 / 2 - x**4 / 12
        return ultimate**2 / modulus * log_cosh


@dataclass(frozen=True, eq=False)
class PolygonCurves(SoilCurve):
    """Polygons through points, the first at the origin; constant beyond the last.

    deflection : (n, m) of the points in m, increasing
    reaction : (n, m) resistance there in N/m
    """

    deflection: Array
    reaction: Array

    @property
    def ultimate(self) -> Array:
        return np.asarray(self.reaction.max(axis=1))

    @property
    def corners(self) -> Array:
        return self.deflection

    @staticmethod
    def secant_at(parameters: Array, y: float) -> float:
        count = len(parameters) // 2
        grid, load = parameters[:count], parameters[count:]
        upper = np.searchsorted(grid, y, side="right")
        if upper == count:
            return load[-1] / y
        slope = (load[upper] - load[upper - 1]) / (grid[upper] - grid[upper - 1])
        return (load[upper - 1] + slope * (y - grid[upper - 1])) / y if y > 0 else slope

    @staticmethod
    def tangent_at(parameters: Array, y: float) -> float:
        count = len(parameters) // 2
        grid, load = parameters[:count], parameters[count:]
        upper = np.searchsorted(grid, y, side="right")
        if upper == count:
            return 0.0
        return (load[upper] - load[upper - 1]) / (grid[upper] - grid[upper - 1])

    @staticmethod
    def energy_at(parameters: Array, y: float) -> float:
        count = len(parameters) // 2
        grid, load = parameters[:count], parameters[count:]
        energy = 0.0
        for i in range(1, count):
            top = min(y, grid[i])
            if top <= grid[i - 1]:
                break
            share = (top - grid[i - 1]) / (grid[i] - grid[i - 1])
            end = load[i - 1] + share * (load[i] - load[i - 1])
            energy += (load[i - 1] + end) / 2 * (top - grid[i - 1])
        return energy + load[-1] * max(y - grid[-1], 0.0)


@dataclass(frozen=True, eq=False)
class PowerCurves(SoilCurve):
    """p = p_u (y / y_u)^exponent up to y_u, and p_u beyond; a straight line up to y_0.

    ultimate : (n,) p_u in N/m
    end : (n,) y_u in m
    exponent : (n,)
    line : (n,) y_0 in m, positive and not above y_u
    """

    ultimate: Array
    end: Array
    exponent: Array
    line: Array

    @staticmethod
    def secant_at(parameters: Array, y: float) -> float:
        ultimate, end, exponent, line = parameters[0], parameters[1], parameters[2], parameters[3]
        if y >= end:
            return ultimate / y
        at = max(y, line)
        return ultimate * (at / end) ** exponent / at

    @staticmethod
    def tangent_at(parameters: Array, y: float) -> float:
        ultimate, end, exponent, line = parameters[0], parameters[1], parameters[2], parameters[3]
        if y >= end:
            return 0.0
        at = max(y, line)
        secant = ultimate * (at / end) ** exponent / at
        return secant if y <= line else exponent * secant

    @staticmethod
    def energy_at(parameters: Array, y: float) -> float:
        ultimate, end, exponent, line = parameters[0], parameters[1], parameters[2], parameters[3]
        if y <= line:
            return ultimate * (line / end) ** exponent / line * y**2 / 2
        whole = ultimate * end / (exponent + 1)
        energy = ultimate * (line / end) ** exponent * line / 2
        energy += whole * ((min(y, end) / end) ** (exponent + 1) - (line / end) ** (exponent + 1))
        return energy + ultimate * max(y - end, 0.0)


@dataclass(frozen=True, eq=False)
class ConicCurves(SoilCurve):
    """Conics of PISA; with zero curvature two straight lines.

    end : (n,) y_u in m
    ultimate : (n,) p_u in N/m beyond y_u; zero gives no resistance
    slope_ratio : (n,) K >= 1, so that the initial slope is K p_u / y_u; 1 gives the chord
    curvature : (n,) n, 0 <= n < 1
    """

    end: Array
    ultimate: Array
    slope_ratio: Array
    curvature: Array

    def __post_init__(self) -> None:
        # at K = 1 the conic degenerates to the chord for any curvature
        straight = self.slope_ratio <= 1 + _STRAIGHT
        object.__setattr__(self, "curvature", np.where(straight, 0.0, self.curvature))
        object.__setattr__(self, "slope_ratio", np.maximum(self.slope_ratio, 1.0))

    @staticmethod
    def secant_at(parameters: Array, y: float) -> float:
        return _conic_secant(parameters, y)[0]

    @staticmethod
    def tangent_at(parameters: Array, y: float) -> float:
        return _conic_tangent(parameters, y)

    @staticmethod
    def energy_at(parameters: Array, y: float) -> float:
        return _conic_energy(parameters, y)


@inner
def _conic_secant(parameters: Array, y: float) -> tuple[float, float]:
    """Secant stiffness, and the root of the discriminant, zero where the curve is straight."""
    # -n (Y - X)^2 + (1 - n) (Y - K X) (Y - 1) = 0 in X = y / y_u and Y = p / p_u, solved for Y; the
    # discriminant is a sum of non-negative terms, without cancellation
    end, ultimate, stiffness, n = parameters[0], parameters[1], parameters[2], parameters[3]
    if ultimate <= 0:
        return 0.0, 0.0
    x = y / end
    line = stiffness * x
    if x >= 1 or (n == 0 and line >= 1):
        return ultimate / y, 0.0
    chord, m = ultimate / end, 1 - n
    if n == 0:
        return stiffness * chord, 0.0
    root = np.sqrt((m * (1 - line)) ** 2 + 4 * m * n * (line - x) * (1 - x))
    half = m * (1 + line) - 2 * n * x
    if half >= 0:
        secant = 2 * (m * stiffness - n * x) / (half + root)
    else:
        secant = (root - half) / (2 * (n - m) * x)
    return secant * chord, root


@inner
def _conic_tangent(parameters: Array, y: float) -> float:
    secant, root = _conic_secant(parameters, y)
    end, ultimate, stiffness, n = parameters[0], parameters[1], parameters[2], parameters[3]
    x = y / end
    line = stiffness * x
    if root == 0:
        return secant if x < 1 and line < 1 else 0.0
    chord, m = ultimate / end, 1 - n
    # 1 - Y: near the plateau the difference would cancel
    gap = 1 - secant * y / ultimate
    if line >= 1:
        gap = 2 * n * (1 - x) ** 2 / (root + m * (line - 1) + 2 * n * (1 - x))
    tangent = (2 * n * x * (secant / chord - 1) + m * stiffness * gap) / root
    return tangent * chord


@inner
def _conic_panel(low: float, high: float, stiffness: float, n: float) -> float:
    """Integral of X^2 over the secant t, with X = m (K - t) / (n (t - 1)^2 + m t (K - t))."""
    m = 1 - n
    total = 0.0
    for i in range(len(_POINTS)):
        t = 1 + low + (high - low) * (1 + _POINTS[i]) / 2
        below = stiffness - t
        total += _WEIGHTS[i] * (m * below / (n * (t - 1) ** 2 + m * t * below)) ** 2
    return total * (high - low) / 2


@inner
def _conic_energy(parameters: Array, y: float) -> float:
    # A conic has a rational parameter, here the secant t = Y / X, which runs from K at rest to 1:
    # integral of Y dX = t X^2 / 2 + integral of X^2 / 2 over t, both positive. Panels halve towards
    # both ends, down to the distance of the nearest pole of the integrand.
    end, ultimate, stiffness, n = parameters[0], parameters[1], parameters[2], parameters[3]
    if ultimate <= 0:
        return 0.0
    if n == 0:
        bend = end / stiffness
        inner = min(y, bend)
        return ultimate * (inner**2 / bend / 2 + max(y - bend, 0.0))
    m, whole = 1 - n, stiffness - 1
    x = min(y / end, 1.0)
    t = _conic_secant(parameters, y)[0] * end / ultimate if x < 1 else 1.0
    energy = t * x**2 / 2
    start = t - 1
    finest = min(1.0, np.sqrt(m * whole / n)) / 2
    low, high = 0.0, whole / 2
    while high > finest:
        high /= 2
    while high <= whole / 2:
        if high > start:
            energy += _conic_panel(max(low, start), high, stiffness, n) / 2
        low, high = high, 2 * high
    finest = n * whole**2 / (m * stiffness + 2 * n * whole) / 2
    high = whole
    while high - low > 0:
        middle = high if high - low < finest else (low + high) / 2
        if middle > start:
            energy += _conic_panel(max(low, start), middle, stiffness, n) / 2
        low = middle
    return ultimate * end * energy + ultimate * max(y - end, 0.0)
