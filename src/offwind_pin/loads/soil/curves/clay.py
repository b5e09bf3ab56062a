"""p-y curves of clay: Matlock (1970) for soft clay, Reese and Welch (1975) for stiff clay."""

from __future__ import annotations

import math

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.layers import Loading, MatlockClay, StiffClay
from offwind_pin.loads.soil.curves.family import SoilFamily, diameter_cautions, layer_label
from offwind_pin.loads.soil.curves.laws import PolygonCurves, PowerCurves
from offwind_pin.loads.soil.soil_profile import PileNodes

_STATIC = np.array([[0.0, 0.1, 0.3, 1.0, 3.0, 8.0], [0.0, 0.23, 0.33, 0.5, 0.72, 1.0]])
_CYCLIC = np.array([[0.0, 0.1, 0.3, 1.0, 3.0, 15.0], [0.0, 0.23, 0.33, 0.5, 0.72, 0.72]])
"""y / y50 over p / p_u, API RP 2GEO (2011), tables of section 8.5."""

SOFT_STRENGTH = 100e3
"""Undrained shear strength in Pa above which API RP 2GEO calls clay stiff (96 kPa, rounded)."""

_STIFF_J = 0.5
_LINE_END = 1 / 160
"""End of the initial straight line of stiff clay, over y_u. The published curve has infinite slope
at the origin; 0.1 y50, as the first point of Matlock's table, is y_u / 160."""


class MatlockClayFamily(SoilFamily[MatlockClay]):
    """Matlock's curves as polygons of API RP 2GEO.

    Above the depth z_R cyclic curves fall from 0.72 p_u at 3 y50 to 0.72 p_u z / z_R at 15 y50.
    """

    layer = MatlockClay

    def lateral(
        self, layer: MatlockClay, nodes: PileNodes, stress: Array, loading: Loading
    ) -> PolygonCurves:
        strength = layer.undrained_shear_strength.at(nodes.original_depth)
        ultimate = ultimate_resistance(strength, layer.j, nodes, stress)
        shape = _STATIC if loading == "static" else _CYCLIC
        y = half_displacement(layer.strain_50, nodes.diameter)[:, None] * shape[0]
        p = ultimate[:, None] * shape[1]
        if loading == "cyclic":
            reduced = nodes.depth / transition_depth(layer, nodes, strength)
            p[:, -1] *= np.minimum(reduced, 1.0)
        return PolygonCurves(y, p)

    def cautions(self, layer: MatlockClay, nodes: PileNodes) -> list[str]:
        found = diameter_cautions(layer, nodes)
        strength = layer.undrained_shear_strength.at(nodes.original_depth)
        if np.any(strength > SOFT_STRENGTH):
            found.append(
                f"{layer_label(layer)}: Matlock's curves apply to soft clay, su up to "
                f"{SOFT_STRENGTH / 1e3:g} kPa"
            )
        return found


class StiffClayFamily(SoilFamily[StiffClay]):
    """p = p_u / 2 (y / y50)^(1/4) up to p_u at 16 y50, and p_u beyond.

    Under N cycles y increases by y50 C log10 N with C = 9.6 (p / p_u)^4, which gives the same law
    with p_u at (16 + 9.6 log10 N) y50.
    """

    layer = StiffClay

    def lateral(
        self, layer: StiffClay, nodes: PileNodes, stress: Array, loading: Loading
    ) -> PowerCurves:
        strength = layer.undrained_shear_strength.at(nodes.original_depth)
        ultimate = ultimate_resistance(strength, _STIFF_J, nodes, stress)
        cycles = 1.0 if layer.cycles is None else layer.cycles
        growth = 16 + 9.6 * math.log10(cycles)
        end = half_displacement(layer.strain_50, nodes.diameter) * growth
        return PowerCurves(ultimate, end, np.full_like(end, 0.25), _LINE_END * end)

    def cautions(self, layer: StiffClay, nodes: PileNodes) -> list[str]:
        return diameter_cautions(layer, nodes)


def half_displacement(strain_50: float, diameter: Array) -> Array:
    """y50 = 2.5 strain_50 D in m, (n,): displacement at half the ultimate resistance."""
    return 2.5 * strain_50 * diameter


def ultimate_resistance(strength: Array, j: float, nodes: PileNodes, stress: Array) -> Array:
    """Matlock's p_u = min(9 su D, (3 su + s') D + J su z) in N/m, (n,)."""
    diameter = nodes.diameter
    wedge = (3 * strength + stress) * diameter + j * strength * nodes.depth
    return np.minimum(9 * strength * diameter, wedge)


def transition_depth(layer: MatlockClay, nodes: PileNodes, strength: Array) -> Array:
    """z_R = max(2.5 D, 6 D / (g' D / su + J)) in m, (n,), with the node's own strength."""
    diameter = nodes.diameter
    weight = layer.submerged_unit_weight * diameter
    wedge = 6 * diameter * strength / (weight + layer.j * strength)
    return np.maximum(2.5 * diameter, wedge)
