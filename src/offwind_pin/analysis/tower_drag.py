"""The wind's drag on the tower of a system."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.errors import InputError
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.forces.strips import Strips
from offwind_pin.loads.wind.tower_drag import STRIP_LENGTH, TowerDrag, TowerWind
from offwind_pin.structure.section import outer_diameter


def tower_drag(system: System, wind: TowerWind) -> TowerDrag:
    """Drag of a wind on a system's structure, for ``simulate(loads=[...])`` and ``static``.

    It acts from the highest water level, or from still water level of a dry structure, up to the
    yaw bearing.

    Raises
    ------
    InputError
        Nothing of the structure is above water.
    """
    low, top = max(_water_line(system), system.chain.base), system.chain.top
    if low >= top:
        raise InputError(
            "tower wind",
            f"a structure up to z = {top:g} m",
            f"one that reaches above the water (z = {low:g} m)",
            "Leave the wind out.",
        )
    count = int(np.ceil((top - low) / STRIP_LENGTH))
    edges = np.linspace(low, top, count + 1)
    height = (edges[:-1] + edges[1:]) / 2
    strips = Strips(height, np.diff(edges), outer_diameter(system.turbine, height))
    return TowerDrag(strips, wind)


def _water_line(system: System) -> float:
    """Height in m that the water does not exceed; still water level of a dry structure."""
    if system.hydrodynamics is None:
        return 0.0
    return system.hydrodynamics.surface.highest
