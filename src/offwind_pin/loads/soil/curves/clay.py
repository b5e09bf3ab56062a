"""p-y curves of clay: Matlock (1970) for soft clay, Reese and Welch (1975) for stiff clay."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.layers import MatlockClay, StiffClay
from offwind_pin.loads.soil.curves.laws import SoilCurves, point_curves, power_curves
from offwind_pin.loads.soil.soil_profile import Ground

_STATIC = np.array([[0.0, 0.1, 0.3, 1.0, 3.0, 8.0], [0.0, 0.23, 0.33, 0.5, 0.72, 1.0]])
_CYCLIC = np.array([[0.0, 0.1, 0.3, 1.0, 3.0, 15.0], [0.0, 0.23, 0.33, 0.5, 0.72, 0.72]])
"""y / y50 over p / p_u, API RP 2GEO (2011), tables of section 8.5."""

_STIFF_J = 0.5
_LINE_END = 1 / 160
"""Where the straight line from the origin of stiff clay meets the curve, over y_u. The published
curve rises there without bound; 0.1 y50, as the first point of Matlock's table, is y_u / 160."""


def matlock_curves(
    layer: MatlockClay, ground: Ground, stress: Array, loading: Literal["static", "cyclic"]
) -> SoilCurves:
    """Polygons of API RP 2GEO for Matlock's curves.

    Above the depth z_R cyclic curves fall from 0.72 p_u at 3 y50 to 0.72 p_u z / z_R at 15 y50.

    stress : (n,) vertical effective stress in Pa
    """
    strength = layer.undrained_shear_strength.at(ground.original_depth)
    ultimate = ultimate_resistance(strength, layer.j, ground, stress)
    shape = _STATIC if loading == "static" else _CYCLIC
    y = half_displacement(layer.strain_50, ground.diameter)[:, None] * shape[0]
    p = ultimate[:, None] * shape[1]
    if loading == "cyclic":
        reduced = ground.depth / transition_depth(layer, ground, strength)
        p[:, -1] *= np.minimum(reduced, 1.0)
    return point_curves(y, p)


def stiff_clay_curves(layer: StiffClay, ground: Ground, stress: Array) -> SoilCurves:
    """p = p_u / 2 (y / y50)^(1/4) up to p_u at 16 y50, and p_u beyond.

    Under N cycles y grows by y50 C log10 N with C = 9.6 (p / p_u)^4, which leaves the same law with
    p_u at (16 + 9.6 log10 N) y50.

    stress : (n,) vertical effective stress in Pa
    """
    strength = layer.undrained_shear_strength.at(ground.original_depth)
    ultimate = ultimate_resistance(strength, _STIFF_J, ground, stress)
    cycles = 1.0 if layer.cycles is None else layer.cycles
    end = half_displacement(layer.strain_50, ground.diameter) * (16 + 9.6 * math.log10(cycles))
    return power_curves(ultimate, end, 0.25, _LINE_END * end)


def half_displacement(strain_50: float, diameter: Array) -> Array:
    """y50 = 2.5 strain_50 D in m, (n,): displacement at half the ultimate resistance."""
    return 2.5 * strain_50 * diameter


def ultimate_resistance(strength: Array, j: float, ground: Ground, stress: Array) -> Array:
    """Matlock's p_u = min(9 su D, (3 su + s') D + J su z) in N/m, (n,)."""
    diameter = ground.diameter
    wedge = (3 * strength + stress) * diameter + j * strength * ground.depth
    return np.minimum(9 * strength * diameter, wedge)


def transition_depth(layer: MatlockClay, ground: Ground, strength: Array) -> Array:
    """z_R = max(2.5 D, 6 D / (g' D / su + J)) in m, (n,), with the node's own strength."""
    diameter = ground.diameter
    weight = layer.submerged_unit_weight * diameter
    wedge = 6 * diameter * strength / (weight + layer.j * strength)
    return np.maximum(2.5 * diameter, wedge)
