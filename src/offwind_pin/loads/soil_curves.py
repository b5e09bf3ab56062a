"""p-y curves at the nodes of a pile: lateral soil resistance per length over displacement."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from offwind_pin.compiled import kernel
from offwind_pin.errors import InputError
from offwind_pin.turbines.definition import Array, CurveTable, LinearModulus, TanhCurve

_LARGEST_DISPLACEMENT = 10.0
_COLUMNS = ("depth_m", "y_m", "p_n_per_m")


LINEAR, TANH, TABLE = 0.0, 1.0, 2.0
"""First number of a curve: which law the others belong to."""


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
    count = (len(numbers) - 1) // 2
    grid, load = numbers[1 : 1 + count], numbers[1 + count :]
    upper = np.searchsorted(grid, y, side="right")
    if upper == count:
        return load[-1] / y, 0.0
    slope = (load[upper] - load[upper - 1]) / (grid[upper] - grid[upper - 1])
    p = load[upper - 1] + slope * (y - grid[upper - 1])
    return (p / y if y > 0 else slope), slope


@kernel
def curve_at(numbers: Array, y: float) -> tuple[float, float]:
    """Secant stiffness p / y and tangent dp/dy in N/m2 at a displacement y >= 0 in m.

    numbers : one row of :attr:`SoilCurves.numbers`
    """
    if numbers[0] == LINEAR:
        return numbers[1], numbers[1]
    if numbers[0] == TANH:
        return _tanh_curve(numbers, y)
    return _tabulated_curve(numbers, y)


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
    count = (len(numbers) - 1) // 2
    grid, load = numbers[1 : 1 + count], numbers[1 + count :]
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
def curve_energy(numbers: Array, y: float) -> float:
    """Integral of p from 0 to y in J per m of pile."""
    if numbers[0] == LINEAR:
        return numbers[1] * y**2 / 2
    if numbers[0] == TANH:
        return _tanh_energy(numbers, y)
    return _tabulated_energy(numbers, y)


@kernel
def _curves_at(numbers: Array, y: Array) -> Array:
    result = np.empty((2, len(y)))
    for i in range(len(y)):
        result[0, i], result[1, i] = curve_at(numbers[i], y[i])
    return result


@dataclass(frozen=True, eq=False)
class SoilCurves:
    """One curve for each of n nodes; y >= 0 is the size of the lateral displacement in m.

    numbers : (n, c) law of each node's curve and its parameters
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


def linear_curves(modulus: Array) -> SoilCurves:
    """p = k y; modulus (n,) in N/m2."""
    return SoilCurves(np.column_stack([np.full_like(modulus, LINEAR), modulus]))


def tanh_curves(initial_modulus: Array, ultimate_resistance: Array) -> SoilCurves:
    """p = p_u tanh(k y / p_u), and nothing where p_u is zero; k (n,) in N/m2, p_u (n,) in N/m."""
    law = np.full_like(initial_modulus, TANH)
    return SoilCurves(np.column_stack([law, initial_modulus, ultimate_resistance]))


def tabulated_curves(path: Path, depth: Array) -> SoilCurves:
    """Curves from a table with columns depth_m, y_m, p_n_per_m, interpolated to the depths.

    Between two tabulated depths p is interpolated linearly at equal y; above the first and below
    the last depth the nearest curve holds. A curve that does not start at y = 0 is led to the
    origin by a straight line; past its last point p stays constant.

    Raises
    ------
    InputError : a table that cannot be read
    """
    curves = _read_table(path)
    grid = np.unique(np.concatenate([[0.0], *(y for y, _ in curves.values())]))
    depths = np.array(sorted(curves))
    loads = np.array([np.interp(grid, *curves[d]) for d in depths])
    at_nodes = np.array([np.interp(depth, depths, column) for column in loads.T]).T
    law = np.full((len(depth), 1), TABLE)
    return SoilCurves(np.hstack([law, np.tile(grid, (len(depth), 1)), at_nodes]))


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
    return tabulated_curves(curve.file, depth)


def _read_table(path: Path) -> dict[float, tuple[Array, Array]]:
    """(y, p) by depth, both from the origin; every fault of the file told with its line."""
    by_depth: dict[float, list[tuple[float, float]]] = {}
    for line, (depth, y, p) in read_numbers(path, _COLUMNS):
        where = f"{path}, line {line}"
        if min(depth, y, p) < 0:
            raise InputError(
                where,
                (depth, y, p),
                "depth, y and p of zero or more",
                "Give one side of the curve.",
            )
        if y > _LARGEST_DISPLACEMENT:
            allowed = f"y up to {_LARGEST_DISPLACEMENT} m"
            raise InputError(where, y, allowed, "Is y in m?")
        points = by_depth.setdefault(depth, [])
        if points and y <= points[-1][0]:
            raise InputError(
                where,
                y,
                f"y rising strictly within a depth (the last was {points[-1][0]})",
                "Sort the rows of each depth by y_m.",
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


def read_numbers(path: Path, columns: tuple[str, ...]) -> list[tuple[int, tuple[float, ...]]]:
    """Rows of numbers of a CSV file with a header, each with its line number.

    Lines that start with ``#`` are comments.

    Raises
    ------
    InputError : missing or empty file, wrong header, a cell that is no finite number
    """
    header_seen = False
    rows = []
    for line, text in _text_lines(path):
        if not text or text.startswith("#"):
            continue
        cells = [cell.strip() for cell in next(csv.reader([text]))]
        if not header_seen:
            if tuple(cells) != columns:
                raise InputError(
                    f"{path}, line {line}",
                    ",".join(cells),
                    f"the header {','.join(columns)}",
                    "Name the columns so.",
                )
            header_seen = True
            continue
        rows.append((line, to_numbers(path, line, cells, len(columns))))
    if not rows:
        raise InputError(
            str(path), "no rows of numbers", "a header and one row or more", "Is the file complete?"
        )
    return rows


def _text_lines(path: Path) -> list[tuple[int, str]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError(str(path), "no such file", "an existing file", "Check the path.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(str(path), str(error), "a readable UTF-8 text file", "Check it.") from None
    return [(i, line.strip()) for i, line in enumerate(text.splitlines(), 1)]


def to_numbers(path: Path, line: int, cells: list[str], count: int) -> tuple[float, ...]:
    """Finite numbers out of the cells of one line.

    Raises
    ------
    InputError : a wrong number of cells, or a cell that is no finite number
    """
    where = f"{path}, line {line}"
    if len(cells) != count:
        raise InputError(where, f"{len(cells)} cells", f"{count} cells", "Is the line complete?")
    values = []
    for column, cell in enumerate(cells, 1):
        try:
            value = float(cell)
        except ValueError:
            value = float("nan")
        if not np.isfinite(value):
            raise InputError(
                f"{where}, column {column}", cell, "a finite number", "Correct the cell."
            )
        values.append(value)
    return tuple(values)
