"""State of the lateral soil springs of a pile, in a run or under a load."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.soil.curves.soil_curve import SoilCurves
from offwind_pin.loads.soil.springs.elastic import LATERAL, SoilSprings
from offwind_pin.results.reading import analysed, open_checked

_SAME_HEIGHT = 1e-6
"""Difference in m."""


@dataclass(frozen=True, eq=False)
class SoilState:
    """State of the lateral springs.

    Attributes
    ----------
    origin : str
        Origin of the state, in words.
    displacement : (n,) array, m
        Largest lateral displacement of each node.
    resistance : (n,) array, N/m
        p at this displacement.
    secant : (n,) array, N/m2
        p / y at this displacement.
    utilisation : (n,) array
        p over the ultimate resistance; NaN where there is none.
    """

    origin: str
    displacement: Array
    resistance: Array
    secant: Array
    utilisation: Array

    @staticmethod
    def of(curves: SoilCurves, displacement: Array, origin: str) -> SoilState:
        resistance, ultimate = curves.resistance(displacement), curves.ultimate
        used = np.full_like(resistance, np.nan)
        np.divide(resistance, ultimate, out=used, where=(ultimate > 0) & np.isfinite(ultimate))
        return SoilState(origin, displacement, resistance, curves.secant(displacement), used)


def reached_in_run(turbine: Turbine, soil: SoilSprings, directory: Path) -> Array:
    """(n,) largest lateral displacement of each node after the ramp of a run, in m.

    Raises
    ------
    InputError
        No ``results.nc`` there, or results that are not of a transient of this turbine on
        distributed springs beyond its ramp.
    """
    path = directory / "results.nc"
    where = str(path)
    with open_checked(path) as tree:
        histories = tree.to_dataset(inherit=False)
        if not {"displacement", "time", "height"} <= set(histories.variables):
            allowed = "displacement over time and height, as in a transient"
            raise InputError(
                where, list(histories.data_vars), allowed, "Give the result of a transient."
            )
        name, made_of = histories.attrs.get("turbine"), histories.attrs.get("definition_sha256")
        if name != turbine.name:
            raise InputError(
                where, f"a result of turbine {name}", turbine.name, "Give a result of this turbine."
            )
        if made_of != turbine.content_hash:
            allowed = "a result of the present definition"
            raise InputError(where, f"a result of a changed {name}", allowed, "Run the case again.")
        if float(histories.height.min()) > float(soil.height.min()) + _SAME_HEIGHT:
            raise InputError(
                where,
                f"a result on {histories.attrs.get('foundation')}, down to "
                f"{float(histories.height.min()):g} m",
                "one on distributed_springs, down to the toe",
                "Run the case on distributed_springs.",
            )
        if float(histories.time[-1]) < float(histories.attrs.get("ramp_s", 0.0)):
            raise InputError(
                where, "a run that ended in its ramp", "a longer run", "Continue the run."
            )
        return soil_displacement_reached(histories, soil)


def reached_statically(system: System, soil: SoilSprings, state: StaticResult) -> Array:
    """(n,) lateral displacement of each node in a static state, on the chain's axis, in m."""
    rest = np.zeros(system.nv)
    motion = system.equations([], ramp_time=None).chain_motion(state.q, rest)
    return np.asarray(np.hypot(*motion.points_at(soil.height).displacement[:, :2].T))


def run_origin(directory: Path) -> str:
    """Origin of the state of a run, in words."""
    return (
        f"largest displacements after the ramp of the run in {directory}, linear between recorded "
        "heights"
    )


def load_origin(load: Array) -> str:
    """Origin of a state under a load (6,) at the yaw bearing, in words."""
    parts = zip(("Fx", "Fy", "Fz", "Mx", "My", "Mz"), load, strict=True)
    components = ", ".join(
        f"{name} = {value / 1e6:g} {'MN' if name[0] == 'F' else 'MN m'}"
        for name, value in parts
        if value
    )
    return f"static state under gravity and {components or 'no load'} at the yaw bearing"


def soil_springs(system: System) -> SoilSprings | None:
    """The lateral springs along the pile, or None for a foundation without them.

    Springs in other directions and at the toe are not included.
    """
    return next(
        (
            load
            for load in system.foundation.soil
            if isinstance(load, SoilSprings) and load.component == LATERAL and len(load.height) > 1
        ),
        None,
    )


def soil_displacement_reached(histories: xr.Dataset, soil: SoilSprings) -> Array:
    """(n,) largest lateral displacement of each spring's node after the ramp, in m.

    In an earthquake it is that relative to the ground at its depth.
    """
    part = analysed(histories)
    lateral = part.displacement.sel(direction=["x", "y"]).values
    if "ground_displacement" in part:
        lateral = lateral - _ground_at(part, part.height.values)[..., :2]
    size = np.asarray(np.hypot(*np.moveaxis(lateral, -1, 0)).max(axis=0))
    return np.interp(soil.height, histories.height.values, size)


def _ground_at(histories: xr.Dataset, height: Array) -> Array:
    """(t, m, 3) displacement of the ground at heights (m,) in m, constant beyond the ends."""
    ground, level = histories.ground_displacement.values, histories.level.values
    place = np.interp(height, level, np.arange(len(level)))
    below = np.floor(place).astype(int)
    above, share = np.minimum(below + 1, len(level) - 1), (place - below)[:, None]
    return np.asarray((1 - share) * ground[:, below] + share * ground[:, above])
