"""Soil curves from tables, and from definitions without layers."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import Lines, read_numbers
from offwind_pin.definitions.soil.springs import CurveTable, LinearModulus, TanhCurve
from offwind_pin.loads.soil.curves.laws import LinearCurves, PolygonCurves, TanhCurves
from offwind_pin.loads.soil.curves.soil_curve import ON_BOUNDARY, SoilCurve

_LARGEST_DISPLACEMENT = 10.0
_COLUMNS = ("depth_m", "y_m", "p_n_per_m")


def tabulated_curves(
    path: Path,
    depth: Array,
    boundaries: tuple[float, ...] = (),
    columns: tuple[str, str, str] = _COLUMNS,
) -> SoilCurve:
    """Curves from a table of depth, displacement and resistance, interpolated to the depths.

    Between two tabulated depths p is interpolated linearly at equal y, but not across a layer
    boundary: there, and above the first and below the last depth, the nearest curve of the layer is
    used. A depth exactly on a boundary belongs to the layer below. A curve that does not start at
    y = 0 is extended to the origin by a straight line; beyond its last point p is constant.

    boundaries : increasing depths in m
    columns : names of the three columns

    Raises
    ------
    InputError
        An invalid table, or one without a curve in a layer.
    """
    table = read_numbers(path, columns)
    curves = _by_depth(path, columns, table.lines, table.values)
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
                "one curve or more in each layer of boundaries_m",
                "Add a curve, or leave the boundary out.",
            )
        for j, column in enumerate(loads[rows].T):
            at_nodes[nodes, j] = np.interp(depth[nodes], depths[rows], column)
    return PolygonCurves(np.tile(grid, (len(depth), 1)), at_nodes)


def soil_curves(curve: LinearModulus | TanhCurve | CurveTable, depth: Array) -> SoilCurve:
    """Curves at depths below the mudline in m.

    Raises
    ------
    InputError
        An invalid table.
    """
    if isinstance(curve, LinearModulus):
        return LinearCurves(curve.modulus.at(depth))
    if isinstance(curve, TanhCurve):
        return TanhCurves(curve.initial_modulus.at(depth), curve.ultimate_resistance.at(depth))
    return tabulated_curves(curve.file, depth, curve.boundaries)


def tabulated_curve(path: Path, columns: tuple[str, str]) -> SoilCurve:
    """One curve from a table of displacement and resistance.

    Raises
    ------
    InputError
        An invalid table.
    """
    table = read_numbers(path, columns)
    values = np.insert(table.values, 0, 0.0, axis=1)
    y, p = _by_depth(path, ("depth_m", *columns), table.lines, values)[0.0]
    return PolygonCurves(y[None], p[None])


def _by_depth(
    path: Path, columns: tuple[str, str, str], lines: Lines, values: Array
) -> dict[float, tuple[Array, Array]]:
    """(y, p) by depth, starting at the origin; faults are reported with their line."""
    by_depth: dict[float, list[tuple[float, float]]] = {}
    for line, (depth, y, p) in zip(lines, values.tolist(), strict=True):
        where = f"{path}, line {line}"
        if min(depth, y, p) < 0:
            raise InputError(
                where,
                (depth, y, p),
                "depth, y and p of zero or more",
                "Give the positive side of the curve.",
            )
        if y > _LARGEST_DISPLACEMENT:
            allowed = f"{columns[1]} up to {_LARGEST_DISPLACEMENT}"
            raise InputError(where, y, allowed, f"Is {columns[1]} in the unit in its name?")
        points = by_depth.setdefault(depth, [])
        if points and y <= points[-1][0]:
            raise InputError(
                where,
                y,
                f"y increasing strictly within a depth (previous value {points[-1][0]})",
                f"Sort the rows of each depth by {columns[1]}.",
            )
        if y == 0 and p != 0:
            raise InputError(where, p, "p = 0 at y = 0", "Start the curve at the origin.")
        points.append((y, p))
    curves = {}
    for depth, points in by_depth.items():
        if points[0][0] > 0:
            points.insert(0, (0.0, 0.0))
        if len(points) < 2:
            raise InputError(
                f"{path}, depth {depth}", points, "two points or more", "Complete the curve."
            )
        curve = np.array(points)
        curves[depth] = (curve[:, 0], curve[:, 1])
    return curves
