"""One soil spring with each damping model."""

from __future__ import annotations

from typing import Literal

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.springs import DistributedSprings, Hysteresis, SoilDashpot
from offwind_pin.loads.soil.springs.dashpot import NO_DASHPOT, Dashpot
from offwind_pin.loads.soil.springs.elastic import SoilSprings
from offwind_pin.loads.soil.springs.hysteretic import HystereticSprings

_SLIDERS = Hysteresis(sliders=60)
"""Where the turbine has none."""


def damping_model(springs: DistributedSprings) -> str | None:
    """Name of the damping model of a turbine's springs, or None."""
    if springs.hysteretic is not None:
        return "sliders"
    return None if springs.dashpot is None else f"{springs.dashpot.stiffness}_dashpot"


def damping_models(
    springs: DistributedSprings, soil: SoilSprings, node: int
) -> dict[str, SoilSprings]:
    """One lateral spring by damping model: the turbine's own, and others with its parameters."""
    at = np.array([node])
    curves = soil.curves.at(at)
    parts = (soil.name, soil.component, soil.height[at], soil.tributary_length[at], curves)
    models: dict[str, SoilSprings] = {}
    dashpot = springs.dashpot
    if dashpot is not None:
        models["secant_dashpot"] = SoilSprings(*parts, Dashpot.of(_of_stiffness(dashpot, "secant")))
        if isinstance(dashpot.damping_factor, float):
            constant = Dashpot.of(_of_stiffness(dashpot, "initial"))
            models["initial_dashpot"] = SoilSprings(*parts, constant)
    beside = soil.dashpot if springs.hysteretic is not None else NO_DASHPOT
    sliders = (springs.hysteretic or _SLIDERS).sliders
    models["sliders"] = HystereticSprings(*parts, beside, sliders)
    return models


def damping_node(soil: SoilSprings, depth: Array, diameter: float) -> int:
    """The node with soil resistance nearest to a depth of one diameter."""
    resists = np.flatnonzero(soil.curves.secant(np.zeros(len(depth))) > 0)
    return int(resists[np.argmin(np.abs(depth[resists] - diameter))])


def _of_stiffness(dashpot: SoilDashpot, stiffness: Literal["secant", "initial"]) -> SoilDashpot:
    return dashpot.model_copy(update={"stiffness": stiffness})
