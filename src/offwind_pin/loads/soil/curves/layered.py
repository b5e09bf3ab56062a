"""Curves of a pile's nodes from the definition of the ground."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.layers import (
    ApiSand,
    Layer,
    LayeredGround,
    MatlockClay,
    Pisa,
    StiffClay,
)
from offwind_pin.definitions.soil.springs import LateralCurve
from offwind_pin.loads.soil.curves.api_sand import api_sand_curves
from offwind_pin.loads.soil.curves.clay import matlock_curves, stiff_clay_curves
from offwind_pin.loads.soil.curves.laws import SoilCurves, linear_curves, soil_curves, stack_curves
from offwind_pin.loads.soil.curves.pisa import (
    RockingCurves,
    pisa_base_moment,
    pisa_base_shear,
    pisa_lateral,
    pisa_rocking,
)
from offwind_pin.loads.soil.soil_profile import Ground, effective_stress, layer_index


def lateral_curves(curve: LateralCurve, ground: Ground) -> SoilCurves:
    """p in N/m over y in m at every node.

    In layered ground a node takes the curve of the layer it lies in, exactly on a boundary of the
    layer below. Properties of the layers stay where they are; depth and overburden count from the
    actual mudline. Other curves are taken by depth below the actual mudline.

    Raises
    ------
    InputError : a table that cannot be read, or a pile outside what PISA's parameters can describe
    """
    if not isinstance(curve, LayeredGround):
        return soil_curves(curve, ground.depth)
    stress, index = effective_stress(curve.layers, ground), layer_index(curve.layers, ground)
    parts = []
    for i in np.unique(index):
        places = np.flatnonzero(index == i)
        layer = curve.layers[i]
        parts.append(
            (places, _layer_curves(layer, ground.at(places), stress[places], curve.loading))
        )
    return stack_curves(parts)


def rocking_curves(curve: LateralCurve, ground: Ground) -> RockingCurves | None:
    """Distributed moment of the nodes in PISA layers, nothing elsewhere; None without such nodes.

    Raises
    ------
    InputError : a pile outside what PISA's parameters can describe
    """
    if not isinstance(curve, LayeredGround):
        return None
    stress, index = effective_stress(curve.layers, ground), layer_index(curve.layers, ground)
    parts = []
    by_lateral = np.zeros(len(index), dtype=bool)
    for i in np.unique(index):
        places, layer = np.flatnonzero(index == i), curve.layers[i]
        if isinstance(layer, Pisa):
            parts.append((places, pisa_rocking(layer, ground.at(places), stress[places])))
            by_lateral[places] = layer.reactions.soil == "sand"
    if not parts:
        return None
    rest = np.setdiff1d(np.arange(len(index)), np.concatenate([places for places, _ in parts]))
    return RockingCurves(
        stack_curves([*parts, (rest, linear_curves(np.zeros(len(rest))))]), by_lateral
    )


def base_shear_curve(curve: LateralCurve, ground: Ground) -> SoilCurves | None:
    """H in N over v in m at the toe, one row; None unless PISA describes the layer there."""
    return _base_curve(curve, ground, pisa_base_shear)


def base_moment_curve(curve: LateralCurve, ground: Ground) -> SoilCurves | None:
    """M in N m over psi in rad at the toe, one row; None unless PISA describes the layer there."""
    return _base_curve(curve, ground, pisa_base_moment)


def _base_curve(
    curve: LateralCurve, ground: Ground, reaction: Callable[[Pisa, Ground, Array], SoilCurves]
) -> SoilCurves | None:
    if not isinstance(curve, LayeredGround):
        return None
    toe = ground.toe
    layer = curve.layers[layer_index(curve.layers, toe)[0]]
    if not isinstance(layer, Pisa):
        return None
    return reaction(layer, toe, effective_stress(curve.layers, toe))


def _layer_curves(
    layer: Layer, ground: Ground, stress: Array, loading: Literal["static", "cyclic"]
) -> SoilCurves:
    if isinstance(layer, ApiSand):
        return api_sand_curves(layer, ground, stress, loading)
    if isinstance(layer, MatlockClay):
        return matlock_curves(layer, ground, stress, loading)
    if isinstance(layer, StiffClay):
        return stiff_clay_curves(layer, ground, stress)
    return pisa_lateral(layer, ground, stress)
