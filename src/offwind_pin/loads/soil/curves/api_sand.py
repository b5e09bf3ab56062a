"""p-y curves of sand, API RP 2GEO (2011), section 8.5."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.layers import ApiSand, Loading
from offwind_pin.loads.soil.curves.family import SoilFamily, diameter_cautions, layer_label
from offwind_pin.loads.soil.curves.laws import TanhCurves
from offwind_pin.loads.soil.soil_profile import PileNodes

_EARTH_PRESSURE_AT_REST = 0.4
_LEAST_MODULUS = 5.4e6

API_FRICTION_ANGLE = (25.0, 40.0)
"""Friction angles in degrees for which API RP 2GEO gives an initial modulus."""


class ApiSandFamily(SoilFamily[ApiSand]):
    """p = A p_u tanh(k z y / (A p_u)), with z below the actual mudline.

    A = 0.9 for cyclic loading and max(0.9, 3 - 0.8 z / D) for static;
    p_u = min((C1 z + C2 D) s', C3 D s') with the vertical effective stress s'.
    """

    layer = ApiSand

    def lateral(
        self, layer: ApiSand, nodes: PileNodes, stress: Array, loading: Loading
    ) -> TanhCurves:
        depth, diameter = nodes.depth, nodes.diameter
        c1, c2, c3 = resistance_factors(layer.friction_angle)
        shallow = (c1 * depth + c2 * diameter) * stress
        deep = c3 * diameter * stress
        factor = np.full_like(depth, 0.9)
        if loading == "static":
            factor = np.maximum(factor, 3.0 - 0.8 * depth / diameter)
        modulus = layer.initial_modulus or initial_modulus(layer.friction_angle)
        return TanhCurves(modulus * depth, factor * np.minimum(shallow, deep))

    def cautions(self, layer: ApiSand, nodes: PileNodes) -> list[str]:
        low, high = API_FRICTION_ANGLE
        found = diameter_cautions(layer, nodes)
        if not low <= layer.friction_angle <= high:
            found.append(
                f"{layer_label(layer)}: a friction angle of {layer.friction_angle:g} deg is "
                f"outside {low:g} to {high:g} deg, the range for which API gives an initial modulus"
            )
        return found


def resistance_factors(friction_angle: float) -> tuple[float, float, float]:
    """C1, C2 and C3 of the ultimate resistance; friction angle in degrees."""
    phi = np.radians(friction_angle)
    alpha, beta = phi / 2, np.pi / 4 + phi / 2
    at_rest = _EARTH_PRESSURE_AT_REST
    active = np.tan(np.pi / 4 - phi / 2) ** 2
    passive = np.tan(beta)
    wedge = np.tan(beta - phi)
    c1 = (
        at_rest * np.tan(phi) * np.sin(beta) / (wedge * np.cos(alpha))
        + passive**2 * np.tan(alpha) / wedge
        + at_rest * passive * (np.tan(phi) * np.sin(beta) - np.tan(alpha))
    )
    c2 = passive / wedge - active
    c3 = at_rest * np.tan(phi) * passive**4 + active * (passive**8 - 1)
    return float(c1), float(c2), float(c3)


def initial_modulus(friction_angle: float) -> float:
    """Rate k of increase of the initial modulus with depth in N/m3, below water; angle in degrees.

    A parabola fitted to API's values for sand below water, at least 5.4 MN/m3, the value at 25
    degrees.
    """
    phi = friction_angle
    return max(_LEAST_MODULUS, 1e6 * (0.1978 * phi**2 - 10.232 * phi + 136.82))
