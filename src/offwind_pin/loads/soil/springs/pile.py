"""All soil loads on an embedded pile: springs, dashpots and sliders at its nodes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.springs import DistributedSprings
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.soil.curves.layered import (
    base_moment_curve,
    base_shear_curve,
    lateral_curves,
    rocking_curves,
)
from offwind_pin.loads.soil.curves.shaft_and_tip import (
    toe_bearing_curve,
    torsional_curves,
    vertical_curves,
)
from offwind_pin.loads.soil.curves.soil_curve import SoilCurves
from offwind_pin.loads.soil.soil_profile import PileNodes
from offwind_pin.loads.soil.springs.dashpot import Dashpot
from offwind_pin.loads.soil.springs.elastic import (
    LATERAL,
    ROCKING,
    TORSIONAL,
    VERTICAL,
    SoilSprings,
    SpringComponent,
)
from offwind_pin.loads.soil.springs.frictional_moment import FrictionalMoment
from offwind_pin.loads.soil.springs.hysteretic import HystereticSprings


def pile_nodes(count: int, mudline: float, toe: float) -> tuple[Array, Array]:
    """Heights of evenly spaced nodes from mudline to toe, and tributary lengths, in m.

    The end nodes have half a length.
    """
    length = np.full(count, (mudline - toe) / (count - 1))
    length[[0, -1]] /= 2
    return np.linspace(mudline, toe, count), length


def pile_soil(
    springs: DistributedSprings, nodes: PileNodes, height: Array, length: Array
) -> tuple[PointLoad, ...]:
    """Loads at the nodes of a pile and at its toe, the lateral springs first.

    Parameters
    ----------
    nodes : PileNodes
        Depths and diameters.
    height, length : (n,) array, m
        Heights and tributary lengths of the nodes, from the mudline down.

    Raises
    ------
    InputError
        An invalid table, a curve that sliders cannot follow, or a pile outside the range of a
        family.
    """
    loads: list[PointLoad] = []
    toe, whole = height[-1:], np.ones(1)
    lateral = lateral_curves(springs.curve, nodes)
    loads.append(_springs(springs, nodes, "soil", LATERAL, height, length, lateral))
    rocking = rocking_curves(springs.curve, nodes)
    if rocking is not None:
        places, moments = rocking
        own, shared = ~moments.by_lateral, moments.by_lateral
        if np.any(own & (moments.curves.ultimate > 0)):
            parts = height[places[own]], length[places[own]], moments.curves.at(own)
            loads.append(_springs(springs, nodes, "soil_rocking", ROCKING, *parts))
        if np.any(shared):
            at = places[shared]
            pressure, lever = lateral.at(at), moments.curves.at(shared)
            loads.append(FrictionalMoment(height[at], length[at], pressure, lever))
    for name, component, curve in _toe_curves(springs, nodes):
        loads.append(_springs(springs, nodes, name, component, toe, whole, curve))
    for name, component, shaft in (
        ("soil_shaft", VERTICAL, vertical_curves(springs, nodes)),
        ("soil_torsion", TORSIONAL, torsional_curves(springs, nodes)),
    ):
        if shaft is not None:
            loads.append(_springs(springs, nodes, name, component, height, length, shaft))
    return tuple(loads)


def _toe_curves(
    springs: DistributedSprings, nodes: PileNodes
) -> Iterator[tuple[str, SpringComponent, SoilCurves]]:
    for name, component, curve in (
        ("soil_base_shear", LATERAL, base_shear_curve(springs.curve, nodes)),
        ("soil_base_moment", ROCKING, base_moment_curve(springs.curve, nodes)),
        ("soil_bearing", VERTICAL, toe_bearing_curve(springs, nodes)),
    ):
        if curve is not None:
            yield name, component, curve


def _springs(
    springs: DistributedSprings,
    nodes: PileNodes,
    name: str,
    component: SpringComponent,
    height: Array,
    length: Array,
    curves: SoilCurves,
) -> SoilSprings:
    dashpot = Dashpot.of(springs.dashpot)
    if component.turns:
        dashpot = dashpot.of_rotations(float(nodes.diameter[0]) / 2)
    parts = (name, component, height, length, curves, dashpot)
    if springs.hysteretic is None:
        return SoilSprings(*parts)
    return HystereticSprings(*parts, springs.hysteretic.sliders)
