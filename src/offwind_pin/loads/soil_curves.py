"""p-y curves at the nodes of a pile: lateral soil resistance per length over displacement."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from offwind_pin.errors import InputError
from offwind_pin.turbines.definition import Array, CurveTable, LinearModulus, TanhCurve

_LARGEST_DISPLACEMENT = 10.0
_COLUMNS = ("depth_m", "y_m", "p_n_per_m")


class SoilCurves(Protocol):
    """One curve for each of n nodes; y >= 0 is the size of the lateral displacement in m."""

    def resistance(self, y: Array) -> Array:
        """p(y) in N/m, (n,)."""

    def tangent(self, y: Array) -> Array:
        """dp/dy in N/m2, (n,)."""

    def secant(self, y: Array) -> Array:
        """p(y) / y in N/m2, (n,), with its limit at y = 0."""


def soil_curves(curve: LinearModulus | TanhCurve | CurveTable, depth: Array) -> SoilCurves:
    """Curves at depths below the mudline in m.

    Raises
    ------
    InputError : a table that cannot be read
    """
    if isinstance(curve, LinearModulus):
        return LinearCurves(curve.modulus.at(depth))
    if isinstance(curve, TanhCurve):
        return TanhCurves(curve.initial_modulus.at(depth), curve.ultimate_resistance.at(depth))
    return TabulatedCurves.from_csv(curve.file, depth)


@dataclass(frozen=True, eq=False)
class LinearCurves:
    """p = k y; modulus (n,) in N/m2."""

    modulus: Array

    def resistance(self, y: Array) -> Array:
        return self.modulus * y

    def tangent(self, y: Array) -> Array:
        return self.modulus

    def secant(self, y: Array) -> Array:
        return self.modulus


@dataclass(frozen=True, eq=False)
class TanhCurves:
    """p = p_u tanh(k y / p_u), and nothing where p_u is zero.

    initial_modulus (n,) in N/m2; ultimate_resistance (n,) in N/m.
    """

    initial_modulus: Array
    ultimate_resistance: Array

    def resistance(self, y: Array) -> Array:
        return self.ultimate_resistance * np.tanh(self._argument(y))

    def tangent(self, y: Array) -> Array:
        return self._stiffness / np.cosh(np.minimum(self._argument(y), 300.0)) ** 2

    def secant(self, y: Array) -> Array:
        x = self._argument(y)
        ratio = np.divide(np.tanh(x), x, out=1 - x**2 / 3, where=x > 1e-6)
        return self._stiffness * ratio

    @property
    def _stiffness(self) -> Array:
        return np.where(self.ultimate_resistance > 0, self.initial_modulus, 0.0)

    def _argument(self, y: Array) -> Array:
        strong = self.ultimate_resistance > 0
        return np.divide(
            self.initial_modulus * y, self.ultimate_resistance, out=np.zeros_like(y), where=strong
        )


@dataclass(frozen=True, eq=False)
class TabulatedCurves:
    """Piecewise linear curves on one grid of displacements; past its end p stays constant.

    displacement (m,) in m, from 0; load (n, m) in N/m, with p = 0 at y = 0.
    """

    displacement: Array
    load: Array

    @staticmethod
    def from_csv(path: Path, depth: Array) -> TabulatedCurves:
        """Curves from a table with columns depth_m, y_m, p_n_per_m, interpolated to the depths.

        Between two tabulated depths p is interpolated linearly at equal y; above the first and
        below the last depth the nearest curve holds. A curve that does not start at y = 0 is led
        to the origin by a straight line.
        """
        curves = _read_table(path)
        grid = np.unique(np.concatenate([[0.0], *(y for y, _ in curves.values())]))
        depths = np.array(sorted(curves))
        loads = np.array([np.interp(grid, *curves[d]) for d in depths])
        at_nodes = np.array([np.interp(depth, depths, column) for column in loads.T]).T
        return TabulatedCurves(grid, at_nodes)

    def resistance(self, y: Array) -> Array:
        segment, slope = self._segment(y)
        rows = np.arange(len(y))
        return self.load[rows, segment] + slope * np.maximum(y - self.displacement[segment], 0.0)

    def tangent(self, y: Array) -> Array:
        return self._segment(y)[1]

    def secant(self, y: Array) -> Array:
        return np.divide(self.resistance(y), y, out=self.tangent(np.zeros_like(y)), where=y > 0)

    def _segment(self, y: Array) -> tuple[np.ndarray[tuple[int], np.dtype[np.intp]], Array]:
        """Index of the segment's lower end and its slope; the slope past the end is zero."""
        segment = np.searchsorted(self.displacement, y, side="right") - 1
        rows = np.arange(len(y))
        last = len(self.displacement) - 1
        upper = np.minimum(segment + 1, last)
        rise = self.load[rows, upper] - self.load[rows, segment]
        run = np.where(upper > segment, self.displacement[upper] - self.displacement[segment], 1.0)
        return segment, rise / run


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
