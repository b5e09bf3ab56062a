"""Figures of a sea and its loads: elevation, profiles over height, spectrum, force over height.

Every function returns a ``matplotlib.figure.Figure`` and does not change matplotlib's settings. The
data are those of :mod:`offwind_pin.analysis.sea_data`.
"""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from offwind_pin.analysis.sea_data import (
    INSTANTS,
    ForcePerLength,
    Profile,
    Spectrum,
    frequency_range,
)
from offwind_pin.base.definition import Array
from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    GREEN,
    INK,
    MUTED,
    SKY,
    VERMILLION,
    mark_levels,
    styled,
    thin,
)
from offwind_pin.display.wording import fixed

KILO = 1e3
_COLUMNS = 900
ZOOM = 60.0
"""Length in s of the enlarged part around the highest crest."""
_STYLES: tuple[tuple[str, Any], ...] = (
    (BLUE, "-"),
    (VERMILLION, (0, (6, 2))),
    (GREEN, (0, (2, 1.5))),
)
_NAMES = 0.3
"""Fraction of a panel's width for the names of the levels."""
_TOTAL = "#8b93a1"
_HEIGHT_LABEL = "height z, m"
_WIDE_TITLE, _NARROW_TITLE = 85, 55
"""Characters per line above a panel of full width, and above one of half width."""


@styled
def surface_elevation(
    time: Array, elevation: Array, *, title: str = "", ramp: float = 0.0
) -> Figure:
    """Surface elevation over time, with the highest crest after the ramp, and the minute around it.

    Parameters
    ----------
    time : (t,) array, s
    elevation : (t,) array, m
        Above the mean water level.
    ramp : float, s
        Shaded part, in which no crest is marked.
    """
    crest = highest_crest(time, elevation, ramp)
    zoomed = time[-1] - time[0] > 2 * ZOOM
    figure = Figure(figsize=(FULL_WIDTH, 2.9))
    panels = figure.subplots(
        1, 2 if zoomed else 1, sharey=True, squeeze=False, width_ratios=(1.9, 1) if zoomed else None
    )[0]
    panels[0].plot(*thin(time, elevation, _COLUMNS), color=SKY, lw=0.8, zorder=2)
    panels[0].set_xlim(time[0], time[-1])
    panels[0].set_ylabel("surface above its mean, m")
    panels[0].set_title(fill(title, _NARROW_TITLE if zoomed else _WIDE_TITLE))
    if ramp > 0:
        panels[0].axvspan(time[0], ramp, color="#eceef1", lw=0, zorder=0).set_gid("ramp")
    if zoomed:
        start = float(np.clip(time[crest] - ZOOM / 2, time[0], time[-1] - ZOOM))
        near = (time >= start) & (time <= start + ZOOM)
        panels[0].axvspan(start, start + ZOOM, color="#f6ead0", lw=0, zorder=0).set_gid("zoom")
        panels[1].plot(time[near], elevation[near], color=BLUE, lw=1.2, zorder=2)
        panels[1].set_xlim(start, start + ZOOM)
        panels[1].set_title("About the highest crest")
    for axes in panels:
        axes.plot(
            time[crest],
            elevation[crest],
            "o",
            ms=5,
            color=VERMILLION,
            zorder=4,
            gid="highest crest",
        )
        axes.axhline(0, color=MUTED, lw=0.7, zorder=1)
        axes.grid(axis="y")
        axes.set_xlabel("time, s")
    low, high = elevation.min(), elevation.max()
    panels[0].set_ylim(low - 0.08 * (high - low), high + 0.2 * (high - low))
    _name_crest(panels[-1], float(time[crest]), float(elevation[crest]))
    return figure


def highest_crest(time: Array, elevation: Array, ramp: float = 0.0) -> int:
    """Index of the largest elevation after the ramp."""
    return int(np.argmax(np.where(time >= ramp, elevation, -np.inf)))


def _name_crest(axes: Axes, time: float, height: float) -> None:
    start, end = axes.get_xlim()
    late = time > start + 0.6 * (end - start)
    axes.annotate(
        f"{fixed(height, 2, sign=True)} m at {fixed(time, 1)} s",
        (time, height),
        xytext=(-6 if late else 6, 4),
        textcoords="offset points",
        ha="right" if late else "left",
        va="bottom",
        fontsize=8.5,
        color=VERMILLION,
    )


@styled
def kinematics(
    shown: Sequence[Profile], along: Array, mudline: float, level: float, *, title: str = ""
) -> Figure:
    """Horizontal velocity and acceleration over height at a crest, a crossing and a trough.

    Parameters
    ----------
    shown : sequence of Profile
        Up to three profiles in this order.
    along : (2,) array
        Horizontal unit vector of the plotted components.
    mudline, level : float, m
        Heights of the mudline and of the mean water surface.
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.4))
    speed, push = figure.subplots(1, 2, sharey=True)
    top = max(level, *(profile.height[-1] for profile in shown))
    for axes in (speed, push):
        axes.axvline(0, color=MUTED, lw=0.7, zorder=1)
        axes.set_ylim(mudline - 0.02 * (top - mudline), top + 0.06 * (top - mudline))
        axes.grid(axis="x")
    current = shown[0].current @ along
    if np.any(shown[0].current):
        speed.plot(current, shown[0].height, color=MUTED, lw=1.2, label="current alone", zorder=2)
    for name, (color, dashes), profile in zip(INSTANTS, _STYLES, shown, strict=False):
        style: dict[str, Any] = {"color": color, "ls": dashes, "zorder": 3}
        label = f"{name}, {fixed(round(profile.elevation, 2) + 0.0, 2, sign=True)} m"
        for axes, values in ((speed, profile.velocity), (push, profile.acceleration)):
            axes.plot(values @ along, profile.height, label=label, **style)
            axes.plot(values[-1] @ along, profile.height[-1], "o", ms=4.5, color=color, zorder=4)
    left, right = speed.get_xlim()
    speed.set_xlim(left - _NAMES * (right - left), right)
    mark_levels(speed, mudline, water=level, named="left")
    mark_levels(push, mudline, water=level)
    speed.set_xlabel("velocity along the waves, m/s")
    push.set_xlabel("acceleration along the waves, m/s²")
    speed.set_ylabel(_HEIGHT_LABEL)
    speed.set_title(title or "Velocity of the water")
    push.set_title("Acceleration of the water")
    figure.legend(*speed.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


@styled
def elevation_spectrum(
    run: Spectrum | None,
    components: Spectrum | None,
    target: Spectrum | None,
    *,
    title: str = "",
) -> Figure:
    """Spectrum of the surface: of the run, of all components, and the target.

    Parameters
    ----------
    run : Spectrum or None
        Frequencies (f,) in Hz and densities (f,) in m2/Hz of the elevation in the run.
    components : Spectrum or None
        The same for the generated waves, in bands.
    target : Spectrum or None
        The same for the target spectrum.
    """
    figure = Figure(figsize=(FULL_WIDTH, 3.6))
    axes = figure.subplots()
    _, end = frequency_range(run, components)
    if run is not None:
        frequency, density = run
        shown = (frequency > 0) & (frequency <= 1.05 * end)
        axes.fill_between(frequency[shown], density[shown], color=SKY, alpha=0.25, lw=0, zorder=2)
        axes.plot(frequency[shown], density[shown], color=SKY, lw=1.3, label="this run", zorder=3)
    if components is not None:
        frequency, density = components
        shown = frequency <= 1.05 * end
        style: dict[str, Any] = {
            "color": INK,
            "ms": 2.6,
            "zorder": 4,
            "label": "all components, in bands",
        }
        axes.plot(frequency[shown], density[shown], "o", **style)
    if target is not None:
        dashed: dict[str, Any] = {"ls": (0, (6, 2)), "zorder": 5, "label": "target"}
        axes.plot(*target, color=VERMILLION, **dashed)
    axes.set_xlim(0, 1.05 * end)
    axes.set_ylim(0, None)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("spectrum of the surface, m²/Hz")
    axes.set_title(title)
    axes.grid(axis="y")
    axes.legend(loc="upper right")
    return figure


@styled
def force_over_height(
    worst: ForcePerLength,
    envelope: tuple[Array, Array],
    mudline: float,
    level: float,
    *,
    title: str = "",
) -> Figure:
    """Force per length at one instant, by component, and its envelope over time.

    Parameters
    ----------
    worst : ForcePerLength
        Forces at one instant.
    envelope : (array, array), N/m
        Smallest and largest force (n,).
    mudline, level : float, m
        Heights of the mudline and of the mean water surface.
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.4))
    instant, whole = figure.subplots(1, 2, sharey=True)
    ends = np.append(worst.height - worst.length / 2, worst.height[-1] + worst.length[-1] / 2)
    top = max(level, ends[-1])
    parts = (
        ("inertia at the instant", worst.inertia[0], BLUE, (0, (6, 2))),
        ("drag at the instant", worst.drag[0], VERMILLION, (0, (2, 1.5))),
    )
    x, z = _stairs(worst.total[0] / KILO, ends)
    for axes in (instant, whole):
        axes.plot(x, z, color=_TOTAL, lw=3.4, label="total at the instant", zorder=3)
    for name, values, color, dashes in parts:
        part, _ = _stairs(values / KILO, ends)
        instant.plot(part, z, color=color, ls=dashes, lw=1.4, label=name, zorder=4)
    low, high = (_stairs(values / KILO, ends)[0] for values in envelope)
    whole.fill_betweenx(
        z, low, high, color=SKY, alpha=0.3, lw=0, zorder=2, label="smallest to largest"
    )
    whole.plot(low, z, color=SKY, lw=0.9, zorder=3)
    whole.plot(high, z, color=SKY, lw=0.9, zorder=3)
    for axes in (instant, whole):
        axes.axvline(0, color=MUTED, lw=0.7, zorder=1)
        axes.set_ylim(mudline - 0.02 * (top - mudline), top + 0.06 * (top - mudline))
        axes.set_xlabel("force of the water along the waves, kN/m")
        axes.grid(axis="x")
    # the names of the levels are on the side opposite to the force
    left, right = instant.get_xlim()
    pushes = bool(x[np.abs(x).argmax()] > 0)
    room = _NAMES * (right - left)
    instant.set_xlim(left - room * pushes, right + room * (not pushes))
    mark_levels(instant, mudline, water=level, named="left" if pushes else "right")
    mark_levels(whole, mudline, water=level)
    handles = [*instant.get_legend_handles_labels()[0], whole.collections[0]]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    instant.set_ylabel(_HEIGHT_LABEL)
    instant.set_title(title or "At one instant")
    whole.set_title("Smallest and largest after the ramp")
    return figure


def _stairs(values: Array, ends: Array) -> tuple[Array, Array]:
    """A line that is constant over each strip."""
    return np.repeat(values, 2), np.repeat(ends, 2)[1:-1]
