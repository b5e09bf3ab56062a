"""What the lateral springs of a pile have been through, in a run or under a load."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from offwind_pin.analysis.static import StaticResult
from offwind_pin.display.plots import soil_displacement_reached
from offwind_pin.dynamics.system import System
from offwind_pin.errors import InputError
from offwind_pin.loads.soil import SoilSprings
from offwind_pin.loads.soil_curves import SoilCurves
from offwind_pin.structure.urdf import definition_hash
from offwind_pin.turbines.base import Array
from offwind_pin.turbines.definition import Turbine

_SAME_HEIGHT = 1e-6
"""Difference in m."""


@dataclass(frozen=True, eq=False)
class SoilState:
    """What the lateral springs have been through.

    Attributes
    ----------
    origin : where it comes from, in words
    displacement : (n,) largest lateral displacement of each node in m
    resistance : (n,) p there in N/m
    secant : (n,) p / y there in N/m2
    utilisation : (n,) p over the ultimate resistance; not a number where there is none
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
    InputError : no ``results.nc`` there, one that is not of a transient of this turbine on
        distributed springs, or one that ended in its ramp
    """
    path = directory / "results.nc"
    where = str(path)
    if not path.is_file():
        raise InputError(where, "no such file", "results.nc of a run", "Give the --out of a run.")
    try:
        histories = xr.open_dataset(path, engine="netcdf4")
    except OSError as error:
        raise InputError(where, str(error), "a NetCDF file", "Run the case again.") from None
    with histories:
        if not {"displacement", "time", "height"} <= set(histories.variables):
            allowed = "displacement over time and height, as a transient has them"
            raise InputError(
                where, list(histories.data_vars), allowed, "Give a transient's result."
            )
        name, made_of = histories.attrs.get("turbine"), histories.attrs.get("definition_sha256")
        if name != turbine.name:
            raise InputError(
                where, f"a result of turbine {name}", turbine.name, "Give a result of this turbine."
            )
        if made_of != definition_hash(turbine):
            allowed = "one of the definition as it is now"
            raise InputError(where, f"a result of another {name}", allowed, "Run the case again.")
        if float(histories.height.min()) > float(soil.height.min()) + _SAME_HEIGHT:
            raise InputError(
                where,
                f"a result on {histories.attrs.get('foundation')}, down to "
                f"{float(histories.height.min()):g} m",
                "one on distributed_springs, down to the toe",
                "Run the case on distributed_springs.",
            )
        if float(histories.time[-1]) < float(histories.attrs.get("ramp_s", 0.0)):
            raise InputError(where, "a run that ended in its ramp", "a longer one", "Run it on.")
        return soil_displacement_reached(histories, soil)


def reached_statically(system: System, soil: SoilSprings, state: StaticResult) -> Array:
    """(n,) lateral displacement of each node in a static state, of the chain's own axis, in m."""
    rest = np.zeros(system.nv)
    motion = system.equations([], ramp_time=np.inf).chain_motion(state.q, rest)
    return np.asarray(np.hypot(*motion.points_at(soil.height).displacement[:, :2].T))


def told_of_run(directory: Path) -> str:
    """Where the state of a run comes from, in words."""
    return (
        f"largest displacements after the ramp of the run in {directory}, linear between the "
        "heights that it recorded"
    )


def told_of_load(load: Array) -> str:
    """The same of a state under a load (6,) at the yaw bearing."""
    parts = zip(("Fx", "Fy", "Fz", "Mx", "My", "Mz"), load, strict=True)
    told = ", ".join(
        f"{name} = {value / 1e6:g} {'MN' if name[0] == 'F' else 'MN m'}"
        for name, value in parts
        if value
    )
    return f"static state under gravity and {told or 'no load'} at the yaw bearing"
