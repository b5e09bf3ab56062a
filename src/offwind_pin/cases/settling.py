"""A static state reached in time: gravity seizes the undeformed structure, which comes to rest."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.settling import Settling
from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import StaticResult
from offwind_pin.dynamics.system import System

Progress = Callable[[float, float], None]

STEP = 0.05
"""s; the state at rest does not depend on it."""
_OUTPUT = 0.5
_AT_REST = 1e-6
"""m from the static state, from where on a structure counts as settled."""

_log = logging.getLogger(__name__)


def settle(
    system: System, state: StaticResult, duration: float, progress: Progress | None = None
) -> Settling:
    """Let gravity seize the undeformed structure, and follow it for a duration in s."""
    data = simulate(
        system,
        duration,
        STEP,
        start="undeformed",
        engine=state.engine,
        output_dt=_OUTPUT,
        heights=state.height.tolist(),
        progress=None if progress is None else lambda now: progress(now, duration),
    )
    moved = data["displacement"].sel(height=state.height, method="nearest").to_numpy()
    off = np.linalg.norm(moved - state.displacement, axis=2).max(axis=1)
    if off[-1] > _AT_REST:
        _log.warning(
            "after %g s the structure is still %.2g m off its static state; give it damping, or a "
            "longer settle_s",
            duration,
            off[-1],
        )
    top = data["tower_top_displacement"].to_numpy()
    return Settling(data["time"].to_numpy(), top, off, state.tower_top_displacement)


def summarise_settling(settling: Settling) -> dict[str, Any]:
    """Keys of the case's summary."""
    return {
        "simulated_s": float(settling.time[-1]),
        "settled_tower_top_x_m": float(settling.tower_top[-1, 0]),
        "settled_difference_m": float(settling.difference[-1]),
    }


def settling_variables(settling: Settling) -> dict[str, xr.DataArray]:
    """For the dataset of the static state."""
    time = {"settling_time": ("settling_time", settling.time, {"units": "s"})}
    return {
        "settling_tower_top_displacement": xr.DataArray(
            settling.tower_top,
            dims=("settling_time", "direction"),
            coords=time,
            attrs={"long_name": "displacement of the yaw bearing", "units": "m"},
        ),
        "settling_difference": xr.DataArray(
            settling.difference,
            dims="settling_time",
            coords=time,
            attrs={"long_name": "largest distance from the static state", "units": "m"},
        ),
    }
