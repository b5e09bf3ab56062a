"""Axial and torsional curves: t-z along the shaft, torque over twist, Q-z at the toe."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.springs import (
    ApiBearing,
    ApiShaft,
    ApiTorsion,
    DistributedSprings,
    LinearBearing,
    LinearModulus,
    LinearTorsion,
    ShaftTable,
    TanhBearing,
    TanhCurve,
    TanhTorsion,
    TorsionTable,
)
from offwind_pin.loads.soil.curves.laws import LinearCurves, PolygonCurves, TanhCurves
from offwind_pin.loads.soil.curves.soil_curve import SoilCurve
from offwind_pin.loads.soil.curves.tabulated import tabulated_curve, tabulated_curves
from offwind_pin.loads.soil.soil_profile import PileNodes

_SAND_PEAK = 2.5e-3
"""Displacement in m at which the skin friction of sand is mobilised, API RP 2GEO (2011), 8.4."""

_CLAY_SHAFT = np.array(
    [[0, 0.0016, 0.0031, 0.0057, 0.008, 0.01, 0.02], [0, 0.3, 0.5, 0.75, 0.9, 1, 1]]
)
"""z / D over t / t_max of clay, API RP 2GEO (2011), 8.4; the residual ratio is added at the end."""

_BEARING = np.array([[0, 0.002, 0.013, 0.042, 0.073, 0.1], [0, 0.25, 0.5, 0.75, 0.9, 1]])
"""z / D over Q / Q_p, API RP 2GEO (2011), 8.4."""


def vertical_curves(springs: DistributedSprings, nodes: PileNodes) -> SoilCurve | None:
    """t in N/m over abs(z) in m along the shaft, or None; depth below the actual mudline.

    Raises
    ------
    InputError
        An invalid table.
    """
    curve, depth = springs.vertical, nodes.depth
    if curve is None:
        return None
    if isinstance(curve, LinearModulus):
        return LinearCurves(curve.modulus.at(depth))
    if isinstance(curve, TanhCurve):
        return TanhCurves(curve.initial_modulus.at(depth), curve.ultimate_resistance.at(depth))
    if isinstance(curve, ShaftTable):
        return tabulated_curves(curve.file, depth, columns=("depth_m", "z_m", "t_n_per_m"))
    z, friction = _shaft_friction(curve, nodes)
    return PolygonCurves(z, np.pi * nodes.diameter[:, None] * friction)


def torsional_curves(springs: DistributedSprings, nodes: PileNodes) -> SoilCurve | None:
    """Torque per length in N m/m over abs(twist) in rad; as ``vertical_curves``.

    Skin friction f gives the torque pi D^2 / 2 f(theta D / 2).
    """
    curve, depth = springs.torsional, nodes.depth
    if curve is None:
        return None
    if isinstance(curve, LinearTorsion):
        return LinearCurves(curve.stiffness.at(depth))
    if isinstance(curve, TanhTorsion):
        return TanhCurves(curve.initial_stiffness.at(depth), curve.ultimate_torque.at(depth))
    if isinstance(curve, TorsionTable):
        columns = ("depth_m", "twist_rad", "torque_nm_per_m")
        return tabulated_curves(curve.file, depth, columns=columns)
    z, friction = _shaft_friction(curve, nodes)
    radius = nodes.diameter[:, None] / 2
    return PolygonCurves(z / radius, 2 * np.pi * radius**2 * friction)


def toe_bearing_curve(springs: DistributedSprings, nodes: PileNodes) -> SoilCurve | None:
    """Q in N over the downward z in m at the toe, one row, or None; as ``vertical_curves``."""
    curve = springs.toe_bearing
    if curve is None:
        return None
    if isinstance(curve, LinearBearing):
        return LinearCurves(np.array([curve.stiffness]))
    if isinstance(curve, TanhBearing):
        return TanhCurves(
            np.array([curve.initial_stiffness]), np.array([curve.ultimate_resistance])
        )
    if not isinstance(curve, ApiBearing):
        return tabulated_curve(curve.file, ("z_m", "q_n"))
    diameter = float(nodes.toe.diameter[0])
    area = np.pi * diameter**2 / 4 if curve.area is None else curve.area
    z, q = diameter * _BEARING[0], curve.end_bearing * area * _BEARING[1]
    return PolygonCurves(z[None], q[None])


def _shaft_friction(curve: ApiShaft | ApiTorsion, nodes: PileNodes) -> tuple[Array, Array]:
    """Points of the wall's displacement in m and the unit skin friction in Pa, both (n, m)."""
    peak = curve.skin_friction.at(nodes.depth)[:, None]
    if curve.residual_ratio is None:
        z = np.tile([0.0, _SAND_PEAK], (len(peak), 1))
        return z, peak * np.array([0.0, 1.0])
    ratio = _CLAY_SHAFT[1].copy()
    ratio[-1] = curve.residual_ratio
    return nodes.diameter[:, None] * _CLAY_SHAFT[0], peak * ratio
