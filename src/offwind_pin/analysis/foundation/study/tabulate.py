"""Soil springs as points, units and plain data."""

from __future__ import annotations

from typing import Any

import numpy as np

from offwind_pin.loads.soil.curves.soil_curve import SoilCurves
from offwind_pin.loads.soil.springs.elastic import SoilSprings
from offwind_pin.loads.soil.springs.frictional_moment import FrictionalMoment

OtherSprings = SoilSprings | FrictionalMoment
"""Soil loads besides the lateral springs."""

_SAMPLED = np.concatenate([[0.0], np.geomspace(1e-6, 0.25, 100)])
"""Deflections of exported curves, over the diameter, or in rad."""
_AT_TOE = ("soil_base_shear", "soil_base_moment", "soil_bearing")


def sampled(curves: SoilCurves, scale: float) -> list[list[tuple[float, float]]]:
    """Points of each curve: the corners of a polygon, otherwise close enough for chords."""
    corners = [law.corners for _, law in curves.groups]
    bent = [points.ravel() for points in corners if points is not None]
    straight = len(bent) == len(corners)
    grid = np.unique(np.concatenate([*bent, [] if straight else scale * _SAMPLED]))
    resistance = np.array([curves.resistance(np.full(len(curves), y)) for y in grid])
    return [list(zip(grid.tolist(), column.tolist(), strict=True)) for column in resistance.T]


def units_of(load: OtherSprings) -> tuple[bool, tuple[str, str]]:
    """Whether it resists rotation, and the units of deflection and resistance."""
    if isinstance(load, FrictionalMoment):
        return True, ("rad", "m")
    turns = load.component.turns
    at_toe = load.name in _AT_TOE
    units = {
        (False, False): ("m", "N/m"),
        (False, True): ("m", "N"),
        (True, False): ("rad", "N m/m"),
        (True, True): ("rad", "N m"),
    }
    return turns, units[turns, at_toe]


def describe_springs(load: OtherSprings, mudline: float) -> dict[str, Any]:
    """Nodes of a soil load other than the lateral springs."""
    _, units = units_of(load)
    curves = load.lever if isinstance(load, FrictionalMoment) else load.curves
    return {
        "name": load.name,
        "deflection_unit": units[0],
        "resistance_unit": units[1],
        "depth_m": (mudline - load.height).tolist(),
        "initial_stiffness": curves.secant(np.zeros(len(load.height))).tolist(),
        "ultimate": [finite(value) for value in curves.ultimate],
    }


def finite(value: float) -> float | None:
    """A number for JSON: None for infinity and NaN."""
    return float(value) if np.isfinite(value) else None
