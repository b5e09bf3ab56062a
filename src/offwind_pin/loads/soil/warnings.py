"""Checks for piles outside the tests and calculations on which soil curves are based."""

from __future__ import annotations

import numpy as np

from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.springs import ApiShaft, ApiTorsion, DistributedSprings
from offwind_pin.loads.soil.curves.family import API_DIAMETER, family_of
from offwind_pin.loads.soil.soil_profile import PileNodes, layer_index

NODE_SPACING = 0.3
"""Largest spacing of soil nodes over the diameter; on the shipped piles the first frequency is then
within 0.1 % of the converged one."""


def cautions(springs: DistributedSprings, nodes: PileNodes) -> list[str]:
    """Cautions about curves used outside their range of validity."""
    found = [*_node_cautions(springs, nodes), *_shaft_cautions(springs, nodes)]
    if isinstance(springs.curve, LayeredGround):
        layers = springs.curve.layers
        found += [
            f"{layer.model} layer from {layer.top:g} m: the pile ends above it"
            for layer in layers
            if layer.top >= nodes.length + nodes.scour
        ]
        index = layer_index(layers, nodes)
        for i in np.unique(index):
            found += family_of(layers[i]).cautions(layers[i], nodes.at(index == i))
    return found


def _node_cautions(springs: DistributedSprings, nodes: PileNodes) -> list[str]:
    spacing = nodes.length / (springs.nodes - 1)
    if spacing <= NODE_SPACING * float(nodes.diameter.min()):
        return []
    return [
        f"soil nodes are {spacing:.3g} m apart; with more than {NODE_SPACING:g} diameters the "
        "variation of the resistance along the pile is not resolved"
    ]


def _shaft_cautions(springs: DistributedSprings, nodes: PileNodes) -> list[str]:
    largest = float(nodes.diameter.max())
    used = isinstance(springs.vertical, ApiShaft) or isinstance(springs.torsional, ApiTorsion)
    if not used or largest <= API_DIAMETER:
        return []
    return [
        f"API's t-z curves are based on piles of at most {API_DIAMETER:g} m in diameter; this pile "
        f"has {largest:g} m"
    ]
