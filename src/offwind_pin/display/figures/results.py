"""Figures of results: mode shapes, statics, time histories, spectra, section loads, soil curves.

Every function returns a ``matplotlib.figure.Figure`` and does not change matplotlib's settings.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.base.definition import Array
from offwind_pin.base.mode_labels import FAMILIES, is_mode, mode_family
from offwind_pin.display.figures.structure import structure
from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    GREEN,
    INK,
    MUTED,
    PALETTE,
    POWERS_OF_TEN,
    SKY,
    VERMILLION,
    mark_levels,
    spread,
    styled,
    thin,
)
from offwind_pin.display.wording import DASH, fixed, foundation_name
from offwind_pin.results.reading import analysed

__all__ = [
    "mode_shapes",
    "moment_psd",
    "p_y_curves",
    "section_load_envelope",
    "statics",
    "structure",
    "time_histories",
]

MEGA = 1e6
_SHOWN_COMPONENT = {"FA": 0, "SS": 1, "V": 2, "T": 5}
_MODES_PER_FAMILY = 3
_COLUMNS = 900
"""Number of columns of a time history's figure, about one per pixel."""

_ZOOM = 60.0
_BAND = "#f6ead0"
_HEIGHT_LABEL = "height z, m"


@styled
def mode_shapes(modes: ModalResult, mudline: float, *, water: float | None = 0.0) -> Figure:
    """Unit-peak shapes over height, one panel per family of modes.

    Each panel shows up to three modes of the structure and up to three of tuned mass dampers. Dots
    mark the peaks.

    mudline, water : heights in m of the mudline and of the mean water surface, None if dry
    """
    direction = [modes.direction(label) for label in modes.label]
    families = [name for name in FAMILIES if name in direction]
    figure = Figure(figsize=(max(5.0, FULL_WIDTH * len(families) / 3), 5.2))
    panels = figure.subplots(1, len(families), sharey=True, squeeze=False)[0]
    for axes, family in zip(panels, families, strict=True):
        members = [i for i, name in enumerate(direction) if name == family]
        own = [i for i in members if mode_family(modes.label[i]) != "TMD"]
        dampers = [i for i in members if mode_family(modes.label[i]) == "TMD"]
        shown = sorted(own[:_MODES_PER_FAMILY] + dampers[: len(PALETTE) - _MODES_PER_FAMILY])
        _shapes_of_family(axes, modes, shown, _SHOWN_COMPONENT[family])
        axes.set_title(FAMILIES[family].capitalize(), pad=8)
        what = "rotation about z" if family == "T" else "displacement"
        axes.set_xlabel(f"{what} / its peak")
        axes.set_xlim(-1.12, 1.12)
        axes.set_ylim(modes.height[0], modes.height[-1] * 1.03)
    for axes in panels:
        mark_levels(axes, mudline, water=water, named="right" if axes is panels[0] else None)
    panels[0].set_ylabel(_HEIGHT_LABEL)
    return figure


def _shapes_of_family(axes: Axes, modes: ModalResult, members: list[int], component: int) -> None:
    axes.axvline(0, color=MUTED, lw=0.7, zorder=1)
    low, high = modes.height[[0, -1]]
    for color, i in zip(PALETTE, members, strict=False):
        shape = modes.shape[i, :, component]
        name = f"{modes.label[i]}  {modes.frequency_hz[i]:.3f} Hz"
        axes.plot(shape, modes.height, color=color, label=name, zorder=3)
        peak = int(np.argmax(np.abs(shape)))
        axes.plot(shape[peak], modes.height[peak], "o", ms=5, color=color, zorder=4)
    axes.set_ylim(low, high)
    axes.legend(loc="upper left", bbox_to_anchor=(-0.02, -0.14), handlelength=1.3, borderaxespad=0)


@styled
def statics(results: Mapping[str, StaticResult], *, water: float | None = 0.0) -> Figure:
    """Deflected shape and fore-aft section moment over height, by foundation.

    results : by name of the foundation; water : height in m of the mean water surface, None if dry
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.9))
    shape, moment = figure.subplots(1, 2, sharey=True)
    low = min(result.height[0] for result in results.values())
    mudline = next(iter(results.values())).mudline
    for color, (name, result) in zip(PALETTE, results.items(), strict=False):
        label = foundation_name(name)
        shape.plot(result.displacement[:, 0], result.height, color=color, label=label, zorder=3)
        moment.plot(result.section_load[:, 4] / MEGA, result.height, color=color, zorder=3)
        shape.plot(result.tower_top_displacement[0], result.height[-1], "o", ms=5, color=color)
    top = next(iter(results.values())).height[-1]
    for axes in (shape, moment):
        axes.axvline(0, color=MUTED, lw=0.7, zorder=1)
        axes.set_ylim(low, top + 18)
        axes.grid(axis="x")
    downwind = all(result.tower_top_displacement[0] > 0 for result in results.values())
    mark_levels(shape, mudline, water=water, named="right" if downwind else "left")
    mark_levels(moment, mudline, water=water)
    shape.set_xlabel("displacement along x, m")
    shape.set_ylabel(_HEIGHT_LABEL)
    shape.set_title("Deflected shape")
    moment.set_xlabel("fore-aft section moment (about y), MN m")
    moment.set_title("Section moment")
    if len(results) > 1:
        shape.legend(loc="upper left" if downwind else "lower left")
    _tower_top_labels(shape, results)
    return figure


def _tower_top_labels(axes: Axes, results: Mapping[str, StaticResult]) -> None:
    """Labels of the displacement at the yaw bearing, without overlaps."""
    ends = [float(result.tower_top_displacement[0]) for result in results.values()]
    left, right = axes.get_xlim()
    span = right - left
    places = spread(ends, 0.24 * span)
    axes.set_xlim(min(left, places.min() - 0.12 * span), max(right, places.max() + 0.12 * span))
    top = next(iter(results.values())).height[-1]
    for color, end, place in zip(PALETTE, ends, places, strict=False):
        axes.annotate(
            f"{fixed(end, 3, sign=True)} m",
            (end, top),
            xytext=(place, top + 9),
            ha="center",
            va="bottom",
            color=color,
            arrowprops={"arrowstyle": "-", "color": color, "lw": 0.7},
        )


@styled
def time_histories(histories: xr.Dataset) -> Figure:
    """Thrust, wave elevation, tower-top displacement and mudline moment over time.

    The ramp is shaded, since it is not analysed. Cases longer than two minutes also show their last
    minute enlarged. Channels that are zero throughout are omitted.
    """
    time = np.asarray(histories.time.values, dtype=float)
    ramp = float(histories.attrs.get("ramp_s", 0.0))
    channels = _channels(histories)
    zoomed = time[-1] - time[0] > 2 * _ZOOM
    figure = Figure(figsize=(FULL_WIDTH, 1.55 * len(channels) + 0.6))
    panels = figure.subplots(
        len(channels),
        2 if zoomed else 1,
        sharex="col",
        sharey="row",
        squeeze=False,
        width_ratios=(2.4, 1) if zoomed else None,
    )
    for axes, channel in zip(panels[:, 0], channels, strict=True):
        axes.plot(*thin(time, channel.values, _COLUMNS), color=channel.color, lw=0.9)
        axes.set_title(channel.name, fontsize=9.5, pad=4)
        axes.set_ylabel(channel.unit)
        axes.set_xlim(time[0], time[-1])
        _shade_ramp(axes, ramp)
    if zoomed:
        late = time >= time[-1] - _ZOOM
        for axes, channel in zip(panels[:, 1], channels, strict=True):
            axes.plot(time[late], channel.values[late], color=channel.color, lw=1.1)
            axes.set_xlim(time[-1] - _ZOOM, time[-1])
        panels[0, 1].set_title(f"The last {_ZOOM:g} s", fontsize=9.5, pad=4)
    _name_ramp(panels[0, 0], ramp)
    for axes in panels.flat:
        axes.grid(axis="y")
    for axes in panels[-1]:
        axes.set_xlabel("time, s")
    return figure


@dataclass(frozen=True)
class _Channel:
    name: str
    unit: str
    values: Array
    color: str


def _channels(histories: xr.Dataset) -> list[_Channel]:
    """Applied loads, and the response to them."""
    thrust = histories.tower_top_load.sel(component="Fx").values / MEGA
    deflection = histories.tower_top_displacement.sel(direction="x").values
    moment = histories.mudline_moment.sel(direction="y").values / MEGA
    loads = [
        _Channel("Applied thrust Fx at the yaw bearing", "MN", thrust, GREEN),
        _Channel("Wave elevation", "m", histories.wave_elevation.values, SKY),
    ]
    return [
        *(load for load in loads if np.any(load.values)),
        _Channel("Tower-top displacement along x", "m", deflection, BLUE),
        _Channel("Fore-aft moment at the mudline (about y)", "MN m", moment, VERMILLION),
    ]


def _shade_ramp(axes: Axes, ramp: float) -> None:
    if ramp > 0:
        axes.axvspan(0, ramp, color="#eceef1", lw=0, zorder=0).set_gid("ramp")


def _name_ramp(axes: Axes, ramp: float) -> None:
    if ramp <= 0:
        return
    start, end = axes.get_xlim()
    axes.annotate(
        "ramp, not analysed" if ramp > 0.25 * (end - start) else "ramp,\nnot\nanalysed",
        (ramp / 2, 1),
        xycoords=("data", "axes fraction"),
        xytext=(0, -2),
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=8,
        color=MUTED,
    )


@styled
def moment_psd(
    frequency: Array,
    density: Array,
    marked: Mapping[str, float],
    *,
    bands: tuple[tuple[float, float], ...] = ((0.2, 0.3), (1.0, 1.5)),
    peaks: tuple[float, ...] = (),
    highest: float = 1.6,
) -> Figure:
    """PSD of the mudline fore-aft moment on a logarithmic scale, with frequencies marked.

    Parameters
    ----------
    frequency : (f,) array, Hz
    density : (f,) array, (N m)^2/Hz
        One-sided.
    marked : mapping of str to float, Hz
        Frequencies by name; modes (FA1, SS2, ...) and excitations have different colours.
    bands : tuple of (float, float), Hz
        Ends of the shaded bands.
    peaks : tuple of float, Hz
        Frequencies of peaks, drawn as dots on the curve.
    highest : float, Hz
        End of the frequency axis.
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.6))
    axes = figure.subplots()
    shown = (frequency > 0) & (frequency <= highest)
    scaled = density / MEGA**2
    axes.semilogy(frequency[shown], scaled[shown], color=INK, lw=1.2, zorder=4)
    low, high = scaled[shown].min(), scaled[shown].max()
    axes.set_ylim(low / 2, high * 2)
    axes.set_xlim(0, highest)
    axes.yaxis.set_major_formatter(POWERS_OF_TEN)
    axes.minorticks_off()
    axes.grid(axis="y")
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("PSD of the moment, (MN m)²/Hz")
    for start, end in bands:
        axes.axvspan(start, end, color=_BAND, lw=0, zorder=0).set_gid("band")
        axes.annotate(
            f"{start:g}{DASH}{end:g} Hz",
            ((start + end) / 2, 0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 4),
            textcoords="offset points",
            ha="center",
            fontsize=8.5,
            color="#7a5a12",
            bbox={"boxstyle": "square,pad=0.15", "fc": _BAND, "ec": "none"},
            zorder=6,
        )
    at_peaks = np.exp(np.interp(peaks, frequency[shown], np.log(scaled[shown])))
    axes.plot(peaks, at_peaks, "o", ms=5, mfc="white", mec=INK, mew=1.2, zorder=5, gid="peaks")
    _mark_frequencies(axes, {k: f for k, f in marked.items() if f <= highest}, highest)
    return figure


def _mark_frequencies(axes: Axes, marked: Mapping[str, float], highest: float) -> None:
    """A dashed line at each frequency, with its name above the frame, without overlaps."""
    names = sorted(marked, key=lambda name: marked[name])
    places = spread([marked[name] for name in names], 0.068 * highest)
    for name, place in zip(names, places, strict=True):
        value = marked[name]
        color = VERMILLION if is_mode(name) else BLUE
        axes.axvline(value, color=color, lw=1, ls=(0, (4, 2)), zorder=3, gid=f"mark {name}")
        axes.plot(
            [value, place],
            [1, 1.06],
            transform=axes.get_xaxis_transform(),
            color=color,
            lw=0.8,
            clip_on=False,
        )
        axes.annotate(
            f"{name}\n{value:.3f}",
            (place, 1.07),
            xycoords=("data", "axes fraction"),
            ha="center",
            va="bottom",
            fontsize=9,
            color=color,
            annotation_clip=False,
        )


@styled
def section_load_envelope(histories: xr.Dataset) -> Figure:
    """Mean, smallest and largest fore-aft moment and shear over height after the ramp."""
    mudline = float(histories.attrs["mudline_m"])
    height = np.asarray(histories.height.values, dtype=float)
    figure = Figure(figsize=(FULL_WIDTH, 4.9))
    panels = figure.subplots(1, 2, sharey=True)
    quantities = [
        ("section_moment", "y", "Fore-aft moment", "moment about y, MN m", VERMILLION),
        ("section_force", "x", "Shear", "force along x, MN", BLUE),
    ]
    for axes, (variable, direction, title, label, color) in zip(panels, quantities, strict=True):
        values = analysed(histories)[variable].sel(direction=direction) / MEGA
        low, mean, high = (
            np.asarray(part.values, dtype=float)
            for part in (values.min("time"), values.mean("time"), values.max("time"))
        )
        axes.fill_betweenx(height, low, high, color=color, alpha=0.18, lw=0, zorder=2)
        axes.plot(low, height, color=color, lw=0.9, ls=(0, (4, 2)), label="smallest", zorder=3)
        axes.plot(mean, height, color=color, lw=1.8, label="mean", zorder=3)
        axes.plot(high, height, color=color, lw=0.9, label="largest", zorder=3)
        axes.axvline(0, color=MUTED, lw=0.7, zorder=1)
        axes.set_ylim(height[0], height[-1] * 1.03)
        axes.set_title(title)
        axes.set_xlabel(label)
        axes.grid(axis="x")
    panels[0].legend(loc="best")
    dry = histories.attrs.get("sea") == "dry"
    water = None if dry else float(histories.attrs.get("water_level_m", 0.0))
    mark_levels(panels[0], mudline, water=water)
    mark_levels(panels[1], mudline, water=water, named="left")
    panels[0].set_ylabel(_HEIGHT_LABEL)
    return figure


@styled
def p_y_curves(data: xr.Dataset) -> Figure:
    """p-y curves at five depths, denser near the mudline where the pile moves most.

    If displacements are known, the figure shows the range of the curves that was used, with dots at
    the largest displacements.

    Parameters
    ----------
    data : Dataset
        Result of :func:`offwind_pin.analysis.drawing_data.soil_dataset`.
    """
    y, end = data["y"].to_numpy(), float(data.attrs["shown_end_m"])
    depth = data["depth"].to_numpy()
    drawn = y <= end
    reached = data["reached"].to_numpy() if "reached" in data else None
    figure = Figure(figsize=(0.78 * FULL_WIDTH, 3.9))
    axes = figure.subplots()
    used = 0.0
    for color, node in zip(PALETTE, np.atleast_1d(data.attrs["shown_nodes"]), strict=False):
        p = data["resistance"][node].to_numpy()[drawn] / MEGA
        axes.plot(1e3 * y[drawn], p, color=color, label=f"{depth[node]:.4g} m", zorder=3)
        if reached is not None:
            at = float(np.interp(reached[node], y[drawn], p))
            used = max(used, at)
            axes.plot(1e3 * reached[node], at, "o", ms=6, color=color, zorder=4, clip_on=False)
    axes.set_xlim(0, 1e3 * end)
    axes.set_ylim(0, 1.5 * used if used > 0 else None)
    axes.set_xlabel("lateral displacement y, mm")
    axes.set_ylabel("soil resistance p, MN/m")
    axes.grid()
    axes.legend(
        title="depth below mudline", loc="upper left", bbox_to_anchor=(1.01, 1.0), alignment="left"
    )
    return figure
