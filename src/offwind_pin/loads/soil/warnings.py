"""Where a pile leaves the field tests and calculations that its soil curves come from."""

from __future__ import annotations

import numpy as np

from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.springs import ApiShaft, ApiTorsion, DistributedSprings
from offwind_pin.loads.soil.curves.family import API_DIAMETER, family_of
from offwind_pin.loads.soil.soil_profile import PileNodes, layer_index

NODE_SPACING = 0.3
"""Distance of soil nodes over the diameter; on the shipped piles the first frequency is then
within 0.1 % of that of many nodes."""


def cautions(springs: DistributedSprings, nodes: PileNodes) -> list[str]:
    """Sentences about curves that are used outside their field base, none if there are none."""
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
        f"soil nodes are {spacing:.3g} m apart; more than {NODE_SPACING:g} diameters misses how "
        "the resistance varies along the pile"
    ]


def _shaft_cautions(springs: DistributedSprings, nodes: PileNodes) -> list[str]:
    largest = float(nodes.diameter.max())
    used = isinstance(springs.vertical, ApiShaft) or isinstance(springs.torsional, ApiTorsion)
    if not used or largest <= API_DIAMETER:
        return []
    return [
        f"API's t-z curves come from piles of at most {API_DIAMETER:g} m in diameter; this pile "
        f"has {largest:g} m"
    ]
