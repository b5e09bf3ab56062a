"""Laws of soil curves at the nodes of a pile: resistance over displacement.

A lateral curve gives p in N/m over y in m; the same laws serve t over z and torque over twist.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import kernel
from offwind_pin.base.number_tables import read_numbers
from offwind_pin.definitions.soil.springs import CurveTable, LinearModulus, TanhCurve

_LARGEST_DISPLACEMENT = 10.0
_COLUMNS = ("depth_m", "y_m", "p_n_per_m")
_STRAIGHT = 1e-9
ON_BOUNDARY = 1e-9
"""Depths in m that differ by less are the same: heights of nodes carry rounding errors."""


LINEAR, TANH, TABLE, POWER, CONIC = 0.0, 1.0, 2.0, 3.0, 4.0
"""First number of a curve: which law the others belong to. Rows may be padded with zeros.

LINEAR : modulus
TANH : initial modulus, ultimate resistance
TABLE : number of points, displacements, resistances
POWER : ultimate resistance, where it is reached, exponent, where the line from the origin ends
CONIC : ultimate resistance, where it is reached, ratio of initial slope to chord, curvature
"""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@kernel
def _tanh_curve(numbers: Array, y: float) -> tuple[float, float]:
    modulus, ultimate = numbers[1], numbers[2]
    if ultimate <= 0:
        return 0.0, 0.0
    x = modulus * y / ultimate
    t = np.tanh(x)
    ratio = t / x if x > 1e-6 else 1 - x**2 / 3
    return modulus * ratio, modulus * (1 - t**2)


@kernel
def _tabulated_curve(numbers: Array, y: float) -> tuple[float, float]:
    count = int(numbers[1])
    grid, load = numbers[2 : 2 + count], numbers[2 + count : 2 + 2 * count]
    upper = np.searchsorted(grid, y, side="right")
    if upper == count:
        return load[-1] / y, 0.0
    slope = (load[upper] - load[upper - 1]) / (grid[upper] - grid[upper - 1])
    p = load[upper - 1] + slope * (y - grid[upper - 1])
    return (p / y if y > 0 else slope), slope


@kernel
def _power_curve(numbers: Array, y: float) -> tuple[float, float]:
    ultimate, end, exponent, line = numbers[1], numbers[2], numbers[3], numbers[4]
    if y >= end:
        return ultimate / y, 0.0
    at = max(y, line)
    secant = ultimate * (at / end) ** exponent / at
    return secant, (secant if y <= line else exponent * secant)


@kernel
def _conic_secant(numbers: Array, y: float) -> tuple[float, float]:
    """Secant stiffness, and the root of the discriminant, zero where the curve is straight."""
    # -n (Y - X)^2 + (1 - n) (Y - K X) (Y - 1) = 0 in X = y / y_u and Y = p / p_u, solved for Y; the
    # discriminant is a sum of terms that are not negative, so that no digits are lost
    ultimate, end, stiffness, n = numbers[1], numbers[2], numbers[3], numbers[4]
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


@kernel
def _conic_curve(numbers: Array, y: float) -> tuple[float, float]:
    secant, root = _conic_secant(numbers, y)
    ultimate, end, stiffness, n = numbers[1], numbers[2], numbers[3], numbers[4]
    x = y / end
    line = stiffness * x
    if root == 0:
        return secant, (secant if x < 1 and line < 1 else 0.0)
    chord, m = ultimate / end, 1 - n
    # 1 - Y: near the plateau the difference would lose its digits
    gap = 1 - secant * y / ultimate
    if line >= 1:
        gap = 2 * n * (1 - x) ** 2 / (root + m * (line - 1) + 2 * n * (1 - x))
    tangent = (2 * n * x * (secant / chord - 1) + m * stiffness * gap) / root
    return secant, tangent * chord


@kernel
def curve_at(numbers: Array, y: float) -> tuple[float, float]:
    """Secant stiffness p / y and tangent dp/dy in N/m2 at a displacement y >= 0 in m.

    numbers : one row of :attr:`SoilCurves.numbers`
    """
    law = numbers[0]
    if law == LINEAR:
        return numbers[1], numbers[1]
    if law == TANH:
        return _tanh_curve(numbers, y)
    if law == TABLE:
        return _tabulated_curve(numbers, y)
    if law == POWER:
        return _power_curve(numbers, y)
    return _conic_curve(numbers, y)


@kernel
def secant_at(numbers: Array, y: float) -> float:
    """The first of :func:`curve_at`, in less time where the tangent costs something."""
    if numbers[0] == CONIC:
        return _conic_secant(numbers, y)[0]
    return curve_at(numbers, y)[0]


@kernel
def _tanh_energy(numbers: Array, y: float) -> float:
    modulus, ultimate = numbers[1], numbers[2]
    if ultimate <= 0 or modulus <= 0:
        return 0.0
    x = modulus * y / ultimate
    # ln cosh x, without overflow and without loss of digits where x is small
    log_cosh = x + np.log1p(np.expm1(-2 * x) / 2) if x > 1e-3 else x**2 / 2 - x**4 / 12
    return ultimate**2 / modulus * log_cosh


@kernel
def _tabulated_energy(numbers: Array, y: float) -> float:
    count = int(numbers[1])
    grid, load = numbers[2 : 2 + count], numbers[2 + count : 2 + 2 * count]
    energy = 0.0
    for i in range(1, count):
        top = min(y, grid[i])
        if top <= grid[i - 1]:
            break
        share = (top - grid[i - 1]) / (grid[i] - grid[i - 1])
        end = load[i - 1] + share * (load[i] - load[i - 1])
        energy += (load[i - 1] + end) / 2 * (top - grid[i - 1])
    return energy + load[-1] * max(y - grid[-1], 0.0)


@kernel
def _power_energy(numbers: Array, y: float) -> float:
    ultimate, end, exponent, line = numbers[1], numbers[2], numbers[3], numbers[4]
    if y <= line:
        return _power_curve(numbers, y)[0] * y**2 / 2
    whole = ultimate * end / (exponent + 1)
    energy = ultimate * (line / end) ** exponent * line / 2
    energy += whole * ((min(y, end) / end) ** (exponent + 1) - (line / end) ** (exponent + 1))
    return energy + ultimate * max(y - end, 0.0)


@kernel
def _conic_panel(low: float, high: float, stiffness: float, n: float) -> float:
    """Integral of X^2 over the secant t, with X = m (K - t) / (n (t - 1)^2 + m t (K - t))."""
    m = 1 - n
    total = 0.0
    for i in range(len(_POINTS)):
        t = 1 + low + (high - low) * (1 + _POINTS[i]) / 2
        below = stiffness - t
        total += _WEIGHTS[i] * (m * below / (n * (t - 1) ** 2 + m * t * below)) ** 2
    return total * (high - low) / 2


@kernel
def _conic_energy(numbers: Array, y: float) -> float:
    # A conic has a rational parameter, here the secant t = Y / X, which runs from K at rest to 1:
    # integral of Y dX = t X^2 / 2 + integral of X^2 / 2 over t, both positive. Panels halve towards
    # both ends, down to the distance of the nearest pole of the integrand.
    ultimate, end, stiffness, n = numbers[1], numbers[2], numbers[3], numbers[4]
    if ultimate <= 0:
        return 0.0
    if n == 0:
        bend = end / stiffness
        inner = min(y, bend)
        return ultimate * (inner**2 / bend / 2 + max(y - bend, 0.0))
    m, whole = 1 - n, stiffness - 1
    x = min(y / end, 1.0)
    t = _conic_curve(numbers, y)[0] * end / ultimate if x < 1 else 1.0
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


@kernel
def curve_energy(numbers: Array, y: float) -> float:
    """Integral of p from 0 to y in J per m of pile."""
    law = numbers[0]
    if law == LINEAR:
        return numbers[1] * y**2 / 2
    if law == TANH:
        return _tanh_energy(numbers, y)
    if law == TABLE:
        return _tabulated_energy(numbers, y)
    if law == POWER:
        return _power_energy(numbers, y)
    return _conic_energy(numbers, y)


@kernel
def _curves_at(numbers: Array, y: Array) -> Array:
    result = np.empty((2, len(y)))
    for i in range(len(y)):
        result[0, i], result[1, i] = curve_at(numbers[i], y[i])
    return result


Places = NDArray[np.intp] | NDArray[np.bool_]
"""Some of the nodes, by number or by a mask."""


@dataclass(frozen=True, eq=False)
class SoilCurves:
    """One curve for each of n nodes; y >= 0 is the size of the lateral displacement in m.

    numbers : (n, c) law of each node's curve and its parameters, padded with zeros
    """

    numbers: Array

    def resistance(self, y: Array) -> Array:
        """p(y) in N/m, (n,)."""
        return self.secant(y) * y

    def secant(self, y: Array) -> Array:
        """p(y) / y in N/m2, (n,), with its limit at y = 0."""
        return _curves_at(self.numbers, y)[0]

    def tangent(self, y: Array) -> Array:
        """dp/dy in N/m2, (n,)."""
        return _curves_at(self.numbers, y)[1]

    @property
    def ultimate(self) -> Array:
        """Largest resistance in N/m, (n,); infinite where a curve has no end."""
        return np.array([_ultimate(row) for row in self.numbers])


def _ultimate(row: Array) -> float:
    if row[0] == LINEAR:
        return float("inf") if row[1] > 0 else 0.0
    if row[0] == TABLE:
        count = int(row[1])
        return float(row[2 + count : 2 + 2 * count].max())
    return float(row[2] if row[0] == TANH else row[1])


def stack_curves(parts: Sequence[tuple[NDArray[np.intp], SoilCurves]]) -> SoilCurves:
    """Curves of different laws as one.

    parts : for each the places (m,) of its m curves in the result, and the curves; the places of
        all of them together are 0 to n - 1
    """
    width = max(curves.numbers.shape[1] for _, curves in parts)
    numbers = np.zeros((sum(len(places) for places, _ in parts), width))
    for places, curves in parts:
        numbers[places, : curves.numbers.shape[1]] = curves.numbers
    return SoilCurves(numbers)


def linear_curves(modulus: Array) -> SoilCurves:
    """p = k y; modulus (n,) in N/m2."""
    return SoilCurves(np.column_stack([np.full_like(modulus, LINEAR), modulus]))


def tanh_curves(initial_modulus: Array, ultimate_resistance: Array) -> SoilCurves:
    """p = p_u tanh(k y / p_u), and nothing where p_u is zero; k (n,) in N/m2, p_u (n,) in N/m."""
    law = np.full_like(initial_modulus, TANH)
    return SoilCurves(np.column_stack([law, initial_modulus, ultimate_resistance]))


def point_curves(displacement: Array, resistance: Array) -> SoilCurves:
    """Polygons through points (n, m), the first at the origin; constant past the last."""
    n, count = displacement.shape
    head = np.tile([TABLE, float(count)], (n, 1))
    return SoilCurves(np.hstack([head, displacement, resistance]))


def power_curves(ultimate: Array, end: Array, exponent: float, line: Array) -> SoilCurves:
    """p = p_u (y / y_u)^exponent up to y_u, and p_u beyond; a straight line up to y_0.

    ultimate (p_u), end (y_u), line (y_0 <= y_u) : (n,); y_0 is positive
    """
    law = np.full_like(ultimate, POWER)
    return SoilCurves(np.column_stack([law, ultimate, end, np.full_like(ultimate, exponent), line]))


def conic_curves(end: Array, ultimate: Array, slope_ratio: Array, curvature: Array) -> SoilCurves:
    """Conics of PISA: ultimate resistance p_u from y_u on, initial slope K p_u / y_u, curvature n.

    end (y_u), ultimate (p_u), slope_ratio (K >= 1), curvature (0 <= n < 1) : (n,); a curvature of
        zero gives two straight lines, a p_u of zero nothing at all
    """
    law = np.full_like(ultimate, CONIC)
    # at K = 1 the conic degenerates into the chord, whatever its curvature
    straight = slope_ratio <= 1 + _STRAIGHT
    return SoilCurves(
        np.column_stack(
            [law, ultimate, end, np.maximum(slope_ratio, 1.0), np.where(straight, 0.0, curvature)]
        )
    )


def tabulated_curves(
    path: Path,
    depth: Array,
    boundaries: tuple[float, ...] = (),
    columns: tuple[str, str, str] = _COLUMNS,
) -> SoilCurves:
    """Curves from a table of depth, displacement and resistance, interpolated to the depths.

    Between two tabulated depths p is interpolated linearly at equal y, but not across a boundary of
    layers: there, as above the first and below the last depth, the nearest curve of the layer
    holds. A depth exactly on a boundary belongs to the layer below. A curve that does not start at
    y = 0 is led to the origin by a straight line; past its last point p stays constant.

    boundaries : depths in m, rising
    columns : names of the three columns

    Raises
    ------
    InputError : a table that cannot be read, or that has no curve in a layer
    """
    curves = _read_table(path, columns, read_numbers(path, columns))
    grid = np.unique(np.concatenate([[0.0], *(y for y, _ in curves.values())]))
    depths = np.array(sorted(curves))
    loads = np.array([np.interp(grid, *curves[d]) for d in depths])
    tabulated_layer = np.searchsorted(boundaries, depths + ON_BOUNDARY, side="right")
    layer = np.searchsorted(boundaries, depth + ON_BOUNDARY, side="right")
    at_nodes = np.empty((len(depth), len(grid)))
    for i in range(len(boundaries) + 1):
        rows, nodes = tabulated_layer == i, layer == i
        if not rows.any():
            edges = [0.0, *boundaries, np.inf]
            raise InputError(
                str(path),
                f"no curve from {edges[i]} m to {edges[i + 1]} m",
                "one curve or more in each layer that boundaries_m make",
                "Add one, or leave the boundary out.",
            )
        for j, column in enumerate(loads[rows].T):
            at_nodes[nodes, j] = np.interp(depth[nodes], depths[rows], column)
    return point_curves(np.tile(grid, (len(depth), 1)), at_nodes)


def soil_curves(curve: LinearModulus | TanhCurve | CurveTable, depth: Array) -> SoilCurves:
    """Curves at depths below the mudline in m.

    Raises
    ------
    InputError : a table that cannot be read
    """
    if isinstance(curve, LinearModulus):
        return linear_curves(curve.modulus.at(depth))
    if isinstance(curve, TanhCurve):
        return tanh_curves(curve.initial_modulus.at(depth), curve.ultimate_resistance.at(depth))
    return tabulated_curves(curve.file, depth, curve.boundaries)


def tabulated_curve(path: Path, columns: tuple[str, str]) -> SoilCurves:
    """One curve from a table of displacement and resistance.

    Raises
    ------
    InputError : a table that cannot be read
    """
    rows = [(line, (0.0, *pair)) for line, pair in read_numbers(path, columns)]
    y, p = _read_table(path, ("depth_m", *columns), rows)[0.0]
    return point_curves(y[None], p[None])


def _read_table(
    path: Path, columns: tuple[str, str, str], rows: list[tuple[int, tuple[float, ...]]]
) -> dict[float, tuple[Array, Array]]:
    """(y, p) by depth, both from the origin; every fault of the file told with its line."""
    by_depth: dict[float, list[tuple[float, float]]] = {}
    for line, (depth, y, p) in rows:
        where = f"{path}, line {line}"
        if min(depth, y, p) < 0:
            raise InputError(
                where,
                (depth, y, p),
                "depth, y and p of zero or more",
                "Give one side of the curve.",
            )
        if y > _LARGEST_DISPLACEMENT:
            allowed = f"{columns[1]} up to {_LARGEST_DISPLACEMENT}"
            raise InputError(where, y, allowed, f"Is {columns[1]} in the unit it names?")
        points = by_depth.setdefault(depth, [])
        if points and y <= points[-1][0]:
            raise InputError(
                where,
                y,
                f"y rising strictly within a depth (the last was {points[-1][0]})",
                f"Sort the rows of each depth by {columns[1]}.",
            )
        if y == 0 and p != 0:
            raise InputError(where, p, "p = 0 at y = 0", "Curves start at the origin.")
        points.append((y, p))
    curves = {}
    for depth, points in by_depth.items():
        if points[0][0] > 0:
            points.insert(0, (0.0, 0.0))
        if len(points) < 2:
            raise InputError(
                f"{path}, depth {depth}", points, "two points or more", "Complete the curve."
            )
        values = np.array(points)
        curves[depth] = (values[:, 0], values[:, 1])
    return curves
