"""An undeformed structure that gravity seizes, on its way to the static state."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from offwind_pin.analysis.settling import Settling
from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    MUTED,
    POWERS_OF_TEN,
    VERMILLION,
    styled,
)

_FIRST = 100.0
"""s that the left panel shows: some ten periods of the first mode that matter."""


@styled
def settling_plot(settling: Settling) -> Figure:
    """The yaw bearing at first, and how far the whole structure is off its static state."""
    figure = Figure(figsize=(FULL_WIDTH, 2.8))
    first, whole = figure.subplots(1, 2)
    early = settling.time <= _FIRST
    first.plot(settling.time[early], settling.tower_top[early, 0], color=BLUE, lw=1.0)
    first.axhline(settling.static[0], color=VERMILLION, lw=1.0, ls="--", label="static state")
    first.set_xlabel("time, s")
    first.set_ylabel("yaw bearing, x in m")
    first.legend(loc="upper right")
    shown = settling.difference > 0
    whole.semilogy(settling.time[shown], settling.difference[shown], color=BLUE, lw=1.0)
    whole.axhline(1e-6, color=MUTED, lw=0.8, ls=":")
    whole.annotate(
        "1 µm", (settling.time[-1], 1e-6), (0, 3), textcoords="offset points", ha="right"
    )
    whole.yaxis.set_major_formatter(POWERS_OF_TEN)
    whole.set_ylim(bottom=max(float(np.min(settling.difference[shown])), 1e-15))
    whole.set_xlabel("time, s")
    whole.set_ylabel("largest distance, m")
    return figure
