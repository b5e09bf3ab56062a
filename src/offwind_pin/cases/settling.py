"""A static state reached in time: the undeformed structure settles under gravity."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import StaticResult
from offwind_pin.dynamics.system import System
from offwind_pin.results.save_at import SaveAt
from offwind_pin.results.states import DIRECTIONS

Progress = Callable[[float, float], None]

STEP = 0.05
"""s; the state at rest does not depend on it."""
_OUTPUT = 0.5
_AT_REST = 1e-6
"""m from the static state, below which a structure counts as settled."""

_log = logging.getLogger(__name__)


def settle(
    system: System, state: StaticResult, duration: float, progress: Progress | None = None
) -> xr.Dataset:
    """Apply gravity suddenly to the undeformed structure, and simulate it for a duration in s.

    Returns
    -------
    Dataset
        Displacement of the yaw bearing over time, and largest distance from the static state.
    """
    data = simulate(
        system,
        duration,
        STEP,
        start="undeformed",
        engine=state.engine,
        save_at=SaveAt(_OUTPUT, heights=tuple(state.height.tolist())),
        progress=None if progress is None else lambda now: progress(now, duration),
    )
    moved = data["displacement"].sel(height=state.height, method="nearest").to_numpy()
    off = np.linalg.norm(moved - state.displacement, axis=2).max(axis=1)
    if off[-1] > _AT_REST:
        _log.warning(
            "after %g s the structure is still %.2g m from its static state; add damping, or "
            "increase settle_s",
            duration,
            off[-1],
        )
    return xr.Dataset(
        {
            "tower_top_displacement": (
                ("time", "direction"),
                data["tower_top_displacement"].to_numpy(),
                {"long_name": "displacement of the yaw bearing", "units": "m"},
            ),
            "difference": (
                "time",
                off,
                {
                    "long_name": "largest distance of any recorded height from its static position",
                    "units": "m",
                },
            ),
            "static_tower_top_displacement": (
                "direction",
                state.tower_top_displacement,
                {"long_name": "displacement of the yaw bearing in the static state", "units": "m"},
            ),
        },
        {
            "time": ("time", data["time"].to_numpy(), data["time"].attrs),
            "direction": DIRECTIONS,
        },
    )


def summarise_settling(settling: xr.Dataset) -> dict[str, Any]:
    """Keys for the summary of the case."""
    last = settling.isel(time=-1)
    return {
        "settled_tower_top_x_m": float(last["tower_top_displacement"].sel(direction="x")),
        "settled_difference_m": float(last["difference"]),
    }
