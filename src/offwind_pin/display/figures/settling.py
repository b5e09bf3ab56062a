"""Figure of an undeformed structure that settles under gravity to its static state."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    MUTED,
    POWERS_OF_TEN,
    VERMILLION,
    styled,
)

_FIRST = 100.0
"""End of the left panel in s, about ten periods of the first mode."""


@styled
def settling_plot(settling: xr.Dataset) -> Figure:
    """Initial motion of the yaw bearing, and distance of the structure from its static state."""
    time = settling["time"].to_numpy()
    top = settling["tower_top_displacement"].sel(direction="x").to_numpy()
    difference = settling["difference"].to_numpy()
    static = float(settling["static_tower_top_displacement"].sel(direction="x"))
    figure = Figure(figsize=(FULL_WIDTH, 2.8))
    first, whole = figure.subplots(1, 2)
    early = time <= _FIRST
    first.plot(time[early], top[early], color=BLUE, lw=1.0)
    first.axhline(static, color=VERMILLION, lw=1.0, ls="--", label="static state")
    first.set_xlabel("time, s")
    first.set_ylabel("yaw bearing, x in m")
    first.legend(loc="upper right")
    shown = difference > 0
    whole.semilogy(time[shown], difference[shown], color=BLUE, lw=1.0)
    whole.axhline(1e-6, color=MUTED, lw=0.8, ls=":")
    whole.annotate("1 µm", (time[-1], 1e-6), (0, 3), textcoords="offset points", ha="right")
    whole.yaxis.set_major_formatter(POWERS_OF_TEN)
    whole.set_ylim(bottom=max(float(np.min(difference[shown])), 1e-15))
    whole.set_xlabel("time, s")
    whole.set_ylabel("largest distance, m")
    return figure
