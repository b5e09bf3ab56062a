"""Curves at a pile's nodes from the definition of the ground."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.layers import LayeredGround, SoilLayer
from offwind_pin.definitions.soil.springs import LateralCurve
from offwind_pin.loads.soil.curves.api_sand import ApiSandFamily
from offwind_pin.loads.soil.curves.clay import MatlockClayFamily, StiffClayFamily
from offwind_pin.loads.soil.curves.family import RockingCurves, family_of, register_family
from offwind_pin.loads.soil.curves.pisa import PisaFamily
from offwind_pin.loads.soil.curves.soil_curve import Indices, SoilCurve, SoilCurves, stack_curves
from offwind_pin.loads.soil.curves.tabulated import soil_curves
from offwind_pin.loads.soil.soil_profile import PileNodes, effective_stress, layer_index

for _family in (ApiSandFamily(), MatlockClayFamily(), StiffClayFamily(), PisaFamily()):
    register_family(_family)


def lateral_curves(curve: LateralCurve, nodes: PileNodes) -> SoilCurves:
    """p in N/m over y in m at every node.

    In layered ground a node has the curve of the layer that contains it; exactly on a boundary, of
    the layer below. Layers stay where they are; depth and overburden are measured from the actual
    mudline. Other curves are evaluated at the depth below the actual mudline.

    Raises
    ------
    InputError
        An invalid table, or a pile outside the range of a family.
    """
    if not isinstance(curve, LayeredGround):
        return soil_curves(curve, nodes.depth)
    return stack_curves(
        [
            (at, family_of(layer).lateral(layer, nodes.at(at), stress, curve.loading))
            for at, layer, stress in _by_layer(curve, nodes)
        ]
    )


def rocking_curves(curve: LateralCurve, nodes: PileNodes) -> tuple[Indices, RockingCurves] | None:
    """Distributed moments, and the nodes that have them; None without any.

    Raises
    ------
    InputError
        A pile outside the range of a family.
    """
    if not isinstance(curve, LayeredGround):
        return None
    found = []
    for at, layer, stress in _by_layer(curve, nodes):
        rocking = family_of(layer).rocking(layer, nodes.at(at), stress)
        if rocking is not None:
            found.append((at, rocking))
    if not found:
        return None
    chosen = np.concatenate([at for at, _ in found])
    ends = np.cumsum([len(at) for at, _ in found])
    parts = [
        (np.arange(end - len(at), end), rocking.curves)
        for end, (at, rocking) in zip(ends, found, strict=True)
    ]
    by_lateral = np.concatenate([rocking.by_lateral for _, rocking in found])
    return chosen, RockingCurves(stack_curves(parts), by_lateral)


def base_shear_curve(curve: LateralCurve, nodes: PileNodes) -> SoilCurve | None:
    """H in N over v in m at the toe, one curve; None unless the layer there has one."""
    at_toe = _at_toe(curve, nodes)
    return None if at_toe is None else family_of(at_toe[0]).base_shear(*at_toe)


def base_moment_curve(curve: LateralCurve, nodes: PileNodes) -> SoilCurve | None:
    """M in N m over psi in rad at the toe, one curve; None unless the layer there has one."""
    at_toe = _at_toe(curve, nodes)
    return None if at_toe is None else family_of(at_toe[0]).base_moment(*at_toe)


def _at_toe(curve: LateralCurve, nodes: PileNodes) -> tuple[SoilLayer, PileNodes, Array] | None:
    if not isinstance(curve, LayeredGround):
        return None
    toe = nodes.toe
    return (
        curve.layers[layer_index(curve.layers, toe)[0]],
        toe,
        effective_stress(curve.layers, toe),
    )


def _by_layer(curve: LayeredGround, nodes: PileNodes) -> list[tuple[Indices, SoilLayer, Array]]:
    """Nodes of each layer that contains nodes, the layer, and the stresses at the nodes."""
    stress, index = effective_stress(curve.layers, nodes), layer_index(curve.layers, nodes)
    places = [np.flatnonzero(index == i) for i in np.unique(index)]
    return [(at, curve.layers[index[at[0]]], stress[at]) for at in places]
