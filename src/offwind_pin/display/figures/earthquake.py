"""Figures of an earthquake: accelerogram, and response spectrum with modes marked."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    GREEN,
    MUTED,
    VERMILLION,
    spread,
    styled,
    thin,
)
from offwind_pin.display.wording import quantity

_AXES = {"x": BLUE, "y": VERMILLION, "z": GREEN}
_COLUMNS = 900
_TICKS = (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10)


@styled
def response_spectrum_plot(earthquake: xr.Dataset) -> Figure:
    """Components of the accelerogram over time, and their pseudo-accelerations over period.

    Components that are zero throughout are omitted. Dashed lines are the structure's periods.

    Parameters
    ----------
    earthquake : Dataset
        Group ``earthquake`` of a case's results.
    """
    time, acceleration = (earthquake[name].to_numpy() for name in ("time", "acceleration"))
    shown = [i for i in range(3) if np.any(acceleration[:, i])]
    figure = Figure(figsize=(FULL_WIDTH, 3.4 + 1.1 * max(1, len(shown))))
    panels = figure.subplots(
        len(shown) + 1, 1, squeeze=False, height_ratios=[*(1.0 for _ in shown), 3.4]
    )[:, 0]
    names = tuple(_AXES)
    largest = float(np.max(np.abs(acceleration), initial=1e-12))
    for axes, i in zip(panels[:-1], shown, strict=True):
        axes.plot(*thin(time, acceleration[:, i], _COLUMNS), color=_AXES[names[i]], lw=0.8)
        axes.set_xlim(time[0], time[-1])
        axes.set_ylim(-1.08 * largest, 1.08 * largest)
        axes.set_ylabel(f"{names[i]}, m/s²")
        axes.grid(axis="y")
        if axes is not panels[len(shown) - 1]:
            axes.tick_params(labelbottom=False)
    if shown:
        panels[0].set_title("Acceleration of the ground")
        panels[len(shown) - 1].set_xlabel("time, s")
    _draw_spectrum(panels[-1], earthquake, shown)
    return figure


def _draw_spectrum(axes: Axes, earthquake: xr.Dataset, shown: list[int]) -> None:
    period, names = earthquake["period"].to_numpy(), tuple(_AXES)
    for i in shown:
        values = earthquake["pseudo_acceleration"].to_numpy()[:, i]
        axes.semilogx(period, values, color=_AXES[names[i]], label=names[i], zorder=3)
    low, high = period[[0, -1]]
    axes.set_xlim(low, high)
    axes.set_ylim(bottom=0)
    axes.xaxis.set_major_locator(FixedLocator(_TICKS))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid()
    axes.set_xlabel("period, s")
    axes.set_ylabel("pseudo-acceleration, m/s²")
    damped = quantity(100 * float(earthquake.attrs["damping_ratio"]), "%", 2)
    axes.set_title(f"Response spectrum, {damped} damped", pad=34)
    if shown:
        axes.legend(
            title="component", loc="upper left", bbox_to_anchor=(1.01, 1.0), alignment="left"
        )
    of_modes = zip(earthquake["mode"].to_numpy(), earthquake["mode_period"].to_numpy(), strict=True)
    _mark_periods(axes, {str(name): float(t) for name, t in of_modes if low <= t <= high})


def _mark_periods(axes: Axes, periods: Mapping[str, float]) -> None:
    """A dashed line at each period, with its name above the frame, without overlaps."""
    low, high = np.log(axes.get_xlim())
    wanted = [(np.log(period) - low) / (high - low) for period in periods.values()]
    places = spread(wanted, 0.062) if wanted else np.zeros(0)
    for (name, period), at, place in zip(periods.items(), wanted, places, strict=True):
        axes.axvline(period, color=MUTED, lw=0.9, ls=(0, (4, 2)), zorder=2, gid=f"mark {name}")
        axes.plot(
            [at, place], [1, 1.04], transform=axes.transAxes, color=MUTED, lw=0.8, clip_on=False
        )
        axes.annotate(
            f"{name}\n{period:.2f} s",
            (place, 1.045),
            xycoords="axes fraction",
            ha="center",
            va="bottom",
            fontsize=8.5,
            color=MUTED,
            annotation_clip=False,
        )
