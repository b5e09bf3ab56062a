"""Every load of the soil on an embedded pile: springs, dashpots and sliders at its nodes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.springs import DistributedSprings
from offwind_pin.loads.point_load import KernelLoad
from offwind_pin.loads.soil.curves.laws import SoilCurves
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
from offwind_pin.loads.soil.soil_profile import Ground
from offwind_pin.loads.soil.springs.dashpot import Dashpot
from offwind_pin.loads.soil.springs.elastic import (
    LATERAL,
    ROCKING,
    TORSIONAL,
    VERTICAL,
    Direction,
    SoilSprings,
)
from offwind_pin.loads.soil.springs.frictional_moment import FrictionalMoment
from offwind_pin.loads.soil.springs.hysteretic import HystereticSprings


def pile_nodes(count: int, mudline: float, toe: float) -> tuple[Array, Array]:
    """Heights of nodes at equal distances from mudline to toe, and tributary lengths, in m.

    The end nodes have half a length.
    """
    length = np.full(count, (mudline - toe) / (count - 1))
    length[[0, -1]] /= 2
    return np.linspace(mudline, toe, count), length


def pile_soil(
    springs: DistributedSprings, ground: Ground, height: Array, length: Array
) -> tuple[KernelLoad, ...]:
    """Loads at the nodes of a pile and at its toe, the lateral springs first.

    Parameters
    ----------
    ground : of the nodes
    height, length : (n,) heights and tributary lengths of the nodes in m, from the mudline down

    Raises
    ------
    InputError : a table that cannot be read, a curve that sliders cannot follow, or a pile outside
        what PISA's parameters can describe
    """
    loads: list[KernelLoad] = []
    toe, whole = height[-1:], np.ones(1)
    lateral = lateral_curves(springs.curve, ground)
    loads.append(_springs(springs, ground, "soil", LATERAL, height, length, lateral))
    rocking = rocking_curves(springs.curve, ground)
    if rocking is not None:
        own = ~rocking.by_lateral
        if np.any(own & (rocking.curves.ultimate > 0)):
            curves = SoilCurves(rocking.curves.numbers[own])
            parts = height[own], length[own], curves
            loads.append(_springs(springs, ground, "soil_rocking", ROCKING, *parts))
        if np.any(rocking.by_lateral):
            at = rocking.by_lateral
            pressure = SoilCurves(lateral.numbers[at])
            lever = SoilCurves(rocking.curves.numbers[at])
            loads.append(FrictionalMoment(height[at], length[at], pressure, lever))
    for name, direction, curve in _toe_curves(springs, ground):
        loads.append(_springs(springs, ground, name, direction, toe, whole, curve))
    for name, direction, shaft in (
        ("soil_shaft", VERTICAL, vertical_curves(springs, ground)),
        ("soil_torsion", TORSIONAL, torsional_curves(springs, ground)),
    ):
        if shaft is not None:
            loads.append(_springs(springs, ground, name, direction, height, length, shaft))
    return tuple(loads)


def _toe_curves(
    springs: DistributedSprings, ground: Ground
) -> Iterator[tuple[str, Direction, SoilCurves]]:
    for name, direction, curve in (
        ("soil_base_shear", LATERAL, base_shear_curve(springs.curve, ground)),
        ("soil_base_moment", ROCKING, base_moment_curve(springs.curve, ground)),
        ("soil_bearing", VERTICAL, toe_bearing_curve(springs, ground)),
    ):
        if curve is not None:
            yield name, direction, curve


def _springs(
    springs: DistributedSprings,
    ground: Ground,
    name: str,
    direction: Direction,
    height: Array,
    length: Array,
    curves: SoilCurves,
) -> SoilSprings:
    dashpot = Dashpot.of(springs.dashpot)
    if direction in (ROCKING, TORSIONAL):
        dashpot = dashpot.of_rotations(float(ground.diameter[0]) / 2)
    parts = (name, direction, height, length, curves, dashpot)
    if springs.hysteretic is None:
        return SoilSprings(*parts)
    return HystereticSprings(*parts, springs.hysteretic.sliders)
