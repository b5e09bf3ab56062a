"""A static state reached in time: gravity seizes the undeformed structure, which comes to rest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.static import StaticResult
from offwind_pin.analysis.transient import simulate
from offwind_pin.dynamics.system import System
from offwind_pin.turbines.base import Array

Progress = Callable[[float, float], None]

STEP = 0.05
"""s; the state at rest does not depend on it."""


@dataclass(frozen=True)
class Settling:
    """How a structure came to rest, beside its static state.

    Attributes
    ----------
    time : (t,) in s
    tower_top : (t, 3) displacement of the yaw bearing in m
    difference : (t,) largest distance of any recorded height from its static place in m
    """

    time: Array
    tower_top: Array
    difference: Array

    def summary(self) -> dict[str, Any]:
        """Keys of the case's summary."""
        return {
            "simulated_s": float(self.time[-1]),
            "settled_tower_top_x_m": float(self.tower_top[-1, 0]),
            "settled_difference_m": float(self.difference[-1]),
        }

    def variables(self) -> dict[str, xr.DataArray]:
        """For the dataset of the static state."""
        time = ("settling_time", self.time, {"units": "s"})
        return {
            "settling_tower_top_displacement": xr.DataArray(
                self.tower_top,
                dims=("settling_time", "direction"),
                coords={"settling_time": time},
                attrs={"long_name": "displacement of the yaw bearing", "units": "m"},
            ),
            "settling_difference": xr.DataArray(
                self.difference,
                dims="settling_time",
                coords={"settling_time": time},
                attrs={"long_name": "largest distance from the static state", "units": "m"},
            ),
        }


def settle(
    system: System, state: StaticResult, duration: float, progress: Progress | None = None
) -> Settling:
    """Let gravity seize the undeformed structure, and follow it for a duration in s."""
    data = simulate(
        system,
        duration,
        STEP,
        start="undeformed",
        output_dt=10 * STEP,
        heights=state.height.tolist(),
        progress=None if progress is None else lambda now: progress(now, duration),
    )
    moved = data["displacement"].sel(height=state.height, method="nearest").to_numpy()
    off = np.linalg.norm(moved - state.displacement, axis=2).max(axis=1)
    return Settling(data["time"].to_numpy(), data["tower_top_displacement"].to_numpy(), off)
