"""Figures of a foundation in soil: curves, state along the pile, pushover, equivalent damping."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from offwind_pin.analysis.foundation.pushover import Pushover
from offwind_pin.base.definition import Array
from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    INK,
    MUTED,
    PALETTE,
    SOIL,
    STEEL,
    VERMILLION,
    styled,
)
from offwind_pin.display.wording import TIMES
from offwind_pin.loads.soil.springs.elastic import SoilSprings

MEGA = 1e6
DAMPING_NAMES = {
    "secant_dashpot": "Dashpot of the secant stiffness",
    "initial_dashpot": "Constant dashpot",
    "sliders": "Sliders",
}
_CURVES = 10
_DEPTHS = "viridis_r"
"""Light at the mudline, dark at the toe."""
_PALEST = -0.15
"""Start of the colour map, since its first colours are too pale for lines."""
_FURTHEST = 0.03
"""End of the plotted curves over the diameter if no state is known."""


@styled
def curves_by_depth(
    soil: SoilSprings, mudline: float, diameter: float, reached: Array | None = None
) -> Figure:
    """p-y curves at about ten depths, coloured by depth; dots are the displacements reached.

    One panel extends to 3 % of the diameter; with a state, a second one shows the range that it
    uses.

    Parameters
    ----------
    mudline : float, m
        Height of the mudline.
    diameter : float, m
        Pile diameter.
    reached : (n,) array, m, optional
        Lateral displacement of each node.
    """
    depth = mudline - soil.height
    nodes = _shown_nodes(soil, depth)
    toe = float(depth[-1])
    color = ScalarMappable(Normalize(_PALEST * toe, toe), mpl.colormaps[_DEPTHS])
    figure = Figure(figsize=(FULL_WIDTH, 4.1))
    panels = figure.subplots(1, 1 if reached is None else 2, squeeze=False)[0]
    _curves(panels[0], soil, nodes, depth, color, _FURTHEST * diameter)
    panels[0].set_title("Up to 3 % of the diameter")
    if reached is not None:
        end = max(1.08 * float(np.max(reached[nodes])), 1e-6)
        used = _curves(panels[1], soil, nodes, depth, color, end, reached)
        panels[1].set_title("Up to the largest displacement")
        panels[1].set_ylim(0, 1.25 * used if used > 0 else None)
    panels[0].set_ylabel("soil resistance p, MN/m")
    bar = figure.colorbar(color, ax=list(panels), pad=0.02, aspect=32)
    bar.ax.set_ylim(toe, 0)
    bar.set_label("depth below the mudline, m")
    bar.outline.set_visible(False)
    return figure


def _shown_nodes(soil: SoilSprings, depth: Array) -> list[int]:
    """Roughly evenly spaced nodes with soil resistance, denser near the mudline."""
    wanted = depth[-1] * np.linspace(0, 1, _CURVES) ** 1.6
    resists = np.flatnonzero(soil.curves.secant(np.zeros(len(depth))) > 0)
    return sorted({int(resists[np.argmin(np.abs(depth[resists] - d))]) for d in wanted})


def _curves(
    axes: Axes,
    soil: SoilSprings,
    nodes: list[int],
    depth: Array,
    color: ScalarMappable,
    end: float,
    reached: Array | None = None,
) -> float:
    """Draw curves up to a displacement in m; returns the largest resistance reached in MN/m."""
    y = np.linspace(0, end, 161)
    resistance = np.array([soil.curves.resistance(np.full(len(depth), value)) for value in y])
    used = 0.0
    for node in nodes:
        shade, p = color.to_rgba(depth[node]), resistance[:, node] / MEGA
        axes.plot(1e3 * y, p, color=shade, lw=1.6, zorder=3)
        if reached is not None:
            at = float(np.interp(reached[node], y, p))
            used = max(used, at)
            axes.plot(
                1e3 * reached[node], at, "o", ms=6, mfc=shade, mec=INK, mew=0.7, zorder=4,
                clip_on=False, gid="reached",
            )  # fmt: skip
    axes.set_xlim(0, 1e3 * end)
    axes.set_ylim(0, None)
    axes.set_xlabel("lateral displacement y, mm")
    axes.grid()
    return used


@styled
def state_over_depth(
    depth: Array, displacement: Array, secant: Array, initial: Array, utilisation: Array
) -> Figure:
    """Largest displacement, secant and initial stiffness, and utilisation along the pile.

    Parameters
    ----------
    depth : (n,) array, m
        Depth below the mudline.
    displacement : (n,) array, m
    secant, initial : (n,) array, N/m2
    utilisation : (n,) array
        Fraction of the ultimate resistance; NaN where there is none.
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.4))
    panels = figure.subplots(1, 3, sharey=True)
    panels[0].plot(1e3 * displacement, depth, color=BLUE, zorder=3)
    panels[0].set_xlabel("largest displacement y, mm")
    panels[0].set_title("Displacement")
    panels[1].plot(initial / MEGA, depth, color=STEEL, lw=4, label="initial")
    panels[1].plot(secant / MEGA, depth, color=BLUE, label="secant at y", zorder=3)
    panels[1].set_xlabel("stiffness p / y, MN/m²")
    panels[1].set_title("Stiffness")
    panels[1].legend(loc="upper right")
    panels[2].set_title("Utilisation")
    panels[2].set_xlabel("p over ultimate resistance, %")
    if np.any(np.isfinite(utilisation)):
        panels[2].plot(1e2 * utilisation, depth, color=VERMILLION, zorder=3)
        at = int(np.nanargmax(utilisation))
        panels[2].plot(1e2 * utilisation[at], depth[at], "o", color=VERMILLION, ms=6, zorder=4)
        panels[2].annotate(
            f"{1e2 * utilisation[at]:.3g} % at {depth[at]:.3g} m",
            (0.97, 0.6),
            xycoords="axes fraction",
            ha="right",
            color=VERMILLION,
        )
    else:
        text = "no ultimate resistance"
        panels[2].annotate(text, (0.5, 0.5), xycoords="axes fraction", ha="center")
    panels[0].set_ylabel("depth below the mudline, m")
    panels[0].set_ylim(float(depth[-1]), 0)
    for axes in panels:
        axes.set_xlim(0, None)
        axes.set_facecolor(SOIL + "60")
        axes.grid(axis="x", color="white", lw=1)
    return figure


@styled
def pushover_curves(push: Pushover, stiffness: Array, macro_element: Array | None = None) -> Figure:
    """Load over displacement and moment over rotation at the mudline; load for a zero arm.

    Parameters
    ----------
    stiffness : (6, 6) array
        Stiffness for small motions, drawn as a tangent line.
    macro_element : (t, 2) array, optional
        Load in N and rotation in rad at the same displacements.
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.1))
    force, moment = figure.subplots(1, 2)
    linear = np.linalg.solve(stiffness, np.array([1.0, 0, 0, 0, push.arm, 0]))
    turning = push.arm > 0
    quantities = (
        (force, push.displacement, linear[0], 1.0, "displacement, m", "load H, MN"),
        (
            moment,
            np.degrees(push.rotation),
            np.degrees(linear[4]),
            push.arm if turning else 1.0,
            "rotation, °",
            "moment M, MN m" if turning else "load H, MN",
        ),
    )
    for i, (axes, x, flexibility, lever, across, up) in enumerate(quantities):
        y = push.load * lever
        top = 1.08 * float(y.max()) / MEGA
        axes.plot(
            [0, flexibility * top * MEGA / lever], [0, top], color=MUTED, lw=1.1,
            ls=(0, (4, 2)), label=f"6{TIMES}6 for small motions", zorder=2,
        )  # fmt: skip
        axes.plot(x, y / MEGA, "o-", ms=3.5, color=BLUE, label="distributed springs", zorder=3)
        if macro_element is not None:
            moved = x if i == 0 else np.degrees(macro_element[:, 1])
            resisted = macro_element[:, 0] * lever / MEGA
            axes.plot(
                moved, resisted, color=VERMILLION, lw=1.4, ls=(0, (5, 2)), label="macro-element",
                zorder=4,
            )  # fmt: skip
        axes.set_xlim(0, 1.03 * float(x.max()))
        axes.set_ylim(0, top)
        axes.set_xlabel(f"mudline {across}")
        axes.set_ylabel(up)
        axes.grid()
    force.set_title("Load over displacement")
    moment.set_title("Moment over rotation" if turning else "Load over rotation")
    force.legend(loc="lower right")
    return figure


def by_amplitude_only(damping: xr.Dataset) -> bool:
    """Whether a damping ratio is the same at every frequency."""
    ratio = damping.damping_ratio
    return bool((ratio.max("frequency") - ratio.min("frequency")).max() < 1e-9)


@styled
def damping_over_amplitude(
    damping: Mapping[str, xr.Dataset], chosen: str | None = None, reached: float | None = None
) -> Figure:
    """Equivalent damping ratio over amplitude, one panel per model, one line per frequency.

    Parameters
    ----------
    damping : mapping of str to Dataset
        Results of :func:`equivalent_damping` by name of the model.
    chosen : str, optional
        The turbine's model.
    reached : float, m, optional
        Displacement reached in a state, marked by a line.
    """
    width = max(4.6, FULL_WIDTH * len(damping) / 3)
    figure = Figure(figsize=(width, 3.9))
    panels = figure.subplots(1, len(damping), sharey=True, squeeze=False)[0]
    highest = max(float(data.damping_ratio.max()) for data in damping.values())
    for axes, (name, data) in zip(panels, damping.items(), strict=True):
        y = 1e3 * data.amplitude.values
        ratio = 1e2 * data.damping_ratio.values
        for j, (color, f) in enumerate(zip(PALETTE, data.frequency.values, strict=False)):
            axes.plot(y, ratio[:, j], color=color, label=f"{f:g} Hz", zorder=3)
            if by_amplitude_only(data):
                axes.lines[-1].set_label("any frequency")
                break
        if reached is not None and y[0] < 1e3 * reached < y[-1]:
            axes.axvline(1e3 * reached, color=INK, lw=0.9, ls=(0, (4, 2)), zorder=2, gid="reached")
        axes.set_xscale("log")
        axes.set_xlim(y[0], y[-1])
        axes.set_ylim(0, 1.15e2 * highest if highest > 0 else 1)
        axes.set_xlabel("amplitude Y, mm")
        axes.set_title(DAMPING_NAMES[name] + (" (used)" if name == chosen else ""), fontsize=9.5)
        axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes.minorticks_off()
        axes.legend(loc="upper left", frameon=True, facecolor="white", edgecolor="none")
        axes.grid()
    panels[0].set_ylabel("equivalent damping, % of critical")
    return figure
