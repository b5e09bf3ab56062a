"""Every load of the soil on an embedded pile: springs, dashpots or sliders at its nodes."""

from __future__ import annotations

import numpy as np

from offwind_pin.loads.dashpots import Dashpot
from offwind_pin.loads.points import KernelLoad
from offwind_pin.loads.soil import LATERAL, SoilSprings
from offwind_pin.loads.soil_curves import soil_curves
from offwind_pin.turbines.definition import DistributedSprings
from offwind_pin.turbines.definition import Array


def pile_nodes(count: int, mudline: float, toe: float) -> tuple[Array, Array]:
    """Heights of nodes at equal distances from mudline to toe, and tributary lengths, in m.

    The end nodes have half a length.
    """
    length = np.full(count, (mudline - toe) / (count - 1))
    length[[0, -1]] /= 2
    return np.linspace(mudline, toe, count), length


def pile_soil(springs: DistributedSprings, mudline: float, toe: float) -> tuple[KernelLoad, ...]:
    height, length = pile_nodes(springs.nodes, mudline, toe)
    curves = soil_curves(springs.curve, mudline - height)
    dashpot = Dashpot.of(springs.dashpot)
    return (SoilSprings("soil", LATERAL, height, length, curves, dashpot),)
