"""Time histories as a labelled dataset with units, frames and provenance."""

from __future__ import annotations

from importlib import metadata
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Array = NDArray[np.float64]

FRAME = "inertial: x downwind, y left looking downwind, z up from still water level"
SECTION = "what the part above the section exerts on the part below"


def make_dataset(
    time: Array,
    height: Array,
    *,
    displacement: Array,
    acceleration: Array,
    section_load: Array,
    tower_top_load: Array,
    wave_elevation: Array,
    iterations: NDArray[np.int32],
    residual: Array,
    mudline: float,
    attributes: dict[str, Any],
) -> xr.Dataset:
    """Channels over time (t,) in s and height (m,) in m.

    displacement, acceleration (t, m, 3) in m and m/s2; section_load (t, m, 6) in N and N m;
    tower_top_load (t, 6); wave_elevation (t,) in m; iterations, residual (t,) of the solver.
    """
    directions = ["x", "y", "z"]
    at_mudline = int(np.argmin(np.abs(height - mudline)))
    along = ("time", "height", "direction")
    top = ("time", "direction")
    data = xr.Dataset(
        {
            "displacement": (along, displacement, _about("displacement of the axis", "m")),
            "acceleration": (along, acceleration, _about("acceleration of the axis", "m/s2")),
            "section_force": (
                along,
                section_load[..., :3],
                _about(f"section force: {SECTION}", "N"),
            ),
            "section_moment": (
                along,
                section_load[..., 3:],
                _about(f"section moment: {SECTION}; y is fore-aft", "N m"),
            ),
            "tower_top_displacement": (
                top,
                displacement[:, -1],
                _about("displacement of the yaw bearing", "m", "YawBrTDxp YawBrTDyp YawBrTDzp"),
            ),
            "mudline_moment": (
                top,
                section_load[:, at_mudline, 3:],
                _about(
                    f"moment at the mudline: {SECTION}", "N m", "-ReactMXss -ReactMYss -ReactMZss"
                ),
            ),
            "mudline_force": (
                top,
                section_load[:, at_mudline, :3],
                _about(f"force at the mudline: {SECTION}", "N", "-ReactFXss -ReactFYss -ReactFZss"),
            ),
            "tower_top_load": (
                ("time", "component"),
                tower_top_load,
                _about("load applied at the yaw bearing", "N for F, N m for M"),
            ),
            "wave_elevation": (
                ("time",),
                wave_elevation,
                _about("surface elevation of the undisturbed wave at x = 0", "m", "Wave1Elev"),
            ),
            "solver_iterations": (("time",), iterations, {"long_name": "Newton iterations"}),
            "solver_residual": (
                ("time",),
                residual,
                {"long_name": "largest residual over the load scale", "units": "1"},
            ),
        },
        coords={
            "time": ("time", time, {"long_name": "simulated time", "units": "s"}),
            "height": ("height", height, {"long_name": "undeformed height", "units": "m"}),
            "direction": directions,
            "component": ["Fx", "Fy", "Fz", "Mx", "My", "Mz"],
        },
    )
    data.attrs = {
        "title": "offwind-pin time histories",
        **versions(),
        "frame": FRAME,
        "mudline_m": mudline,
        **attributes,
    }
    return data


def versions() -> dict[str, str]:
    """Versions of the programs that made a result."""
    return {
        "offwind_pin_version": metadata.version("offwind-pin"),
        "pinocchio_version": metadata.version("pin"),
    }


def _about(name: str, units: str, alias: str | None = None) -> dict[str, str]:
    attributes = {"long_name": name, "units": units, "frame": FRAME}
    return attributes | ({"openfast_alias": alias} if alias else {})
