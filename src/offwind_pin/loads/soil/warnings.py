"""Where a pile leaves the field tests and calculations that its soil curves come from."""

from __future__ import annotations

import numpy as np

from offwind_pin.definitions.soil.layers import (
    ApiSand,
    Layer,
    LayeredGround,
    MatlockClay,
    Pisa,
)
from offwind_pin.definitions.soil.springs import ApiShaft, ApiTorsion, DistributedSprings
from offwind_pin.loads.soil.soil_profile import Ground, layer_index

API_DIAMETER = 2.0
"""Largest pile diameter in m of the tests behind the curves of API and of Reese and Welch."""

API_FRICTION_ANGLE = (25.0, 40.0)
"""Friction angles in degrees for which API RP 2GEO gives an initial modulus."""

SOFT_STRENGTH = 100e3
"""Undrained shear strength in Pa above which API RP 2GEO calls clay stiff (96 kPa, rounded)."""

NODE_SPACING = 0.3
"""Distance of soil nodes over the diameter; on the shipped piles the first frequency is then
within 0.1 % of that of many nodes."""

PISA_SLENDERNESS = (2.0, 6.0)
"""L/D of the calculations that PISA was calibrated on."""

PISA_RELATIVE_DENSITY = (0.45, 0.9)
"""Relative densities of the calculations behind the General Dunkirk Sand Model."""


def cautions(springs: DistributedSprings, ground: Ground) -> list[str]:
    """Sentences about curves that are used outside their field base, none if there are none."""
    told = [*_node_cautions(springs, ground), *_shaft_cautions(springs, ground)]
    if isinstance(springs.curve, LayeredGround):
        layers = springs.curve.layers
        told += [
            f"{layer.model} layer from {layer.top:g} m: the pile ends above it"
            for layer in layers
            if layer.top >= ground.length + ground.scour
        ]
        index = layer_index(layers, ground)
        for i in np.unique(index):
            told += _layer_cautions(layers[i], ground.at(index == i))
    return told


def _node_cautions(springs: DistributedSprings, ground: Ground) -> list[str]:
    spacing = ground.length / (springs.nodes - 1)
    if spacing <= NODE_SPACING * float(ground.diameter.min()):
        return []
    return [
        f"soil nodes are {spacing:.3g} m apart; more than {NODE_SPACING:g} diameters misses how "
        "the resistance varies along the pile"
    ]


def _shaft_cautions(springs: DistributedSprings, ground: Ground) -> list[str]:
    largest = float(ground.diameter.max())
    used = isinstance(springs.vertical, ApiShaft) or isinstance(springs.torsional, ApiTorsion)
    if not used or largest <= API_DIAMETER:
        return []
    return [
        f"API's t-z curves come from piles of at most {API_DIAMETER:g} m in diameter; this pile "
        f"has {largest:g} m"
    ]


def _layer_cautions(layer: Layer, ground: Ground) -> list[str]:
    name = f"{layer.model} layer from {layer.top:g} m"
    largest, smallest = float(ground.diameter.max()), float(ground.diameter.min())
    if not isinstance(layer, Pisa):
        told = []
        if largest > API_DIAMETER:
            told.append(
                f"{name}: the curves come from piles of at most {API_DIAMETER:g} m in diameter; "
                f"this pile has {largest:g} m"
            )
        low, high = API_FRICTION_ANGLE
        if isinstance(layer, ApiSand) and not low <= layer.friction_angle <= high:
            told.append(
                f"{name}: a friction angle of {layer.friction_angle:g} deg is outside {low:g} to "
                f"{high:g} deg, for which API gives an initial modulus"
            )
        if isinstance(layer, MatlockClay) and _is_stiff(layer, ground):
            told.append(
                f"{name}: Matlock's curves are for soft clay, su up to {SOFT_STRENGTH / 1e3:g} kPa"
            )
        return told
    told = []
    low, high = PISA_SLENDERNESS
    slenderness = (ground.length / largest, ground.length / smallest)
    if not (low <= slenderness[0] and slenderness[1] <= high):
        told.append(
            f"{name}: PISA was calibrated for L/D from {low:g} to {high:g}; this pile has "
            f"{slenderness[0]:.3g}"
        )
    low, high = PISA_RELATIVE_DENSITY
    if layer.relative_density is not None and not low <= layer.relative_density <= high:
        told.append(
            f"{name}: a relative density of {layer.relative_density:g} is outside {low:g} to "
            f"{high:g}, for which the sand model was calibrated"
        )
    return told


def _is_stiff(layer: MatlockClay, ground: Ground) -> bool:
    strength = layer.undrained_shear_strength.at(ground.original_depth)
    return bool(np.any(strength > SOFT_STRENGTH))
