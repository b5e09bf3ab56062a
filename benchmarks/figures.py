"""Figures of the benchmark page, out of what the benchmarks wrote."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from offwind_pin.display.figures.style import (
    BLUE,
    FULL_WIDTH,
    GREEN,
    INK,
    MUTED,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
    powers_of_ten,
    styled,
)
from offwind_pin.display.wording import count

Report = dict[str, Any]

_HEIGHT = 3.5
_MICRO = 1e6
_MARKERS = "osD^vP*X"
OWN = {
    "generalised-alpha, radius 1": (BLUE, "o", "-"),
    "generalised-alpha, radius 0.9": (SKY, "s", "-"),
    "generalised-alpha, radius 0.5": (GREEN, "D", "-"),
    "adaptive steps": (PURPLE, "^", "-"),
    "SciPy Radau": (VERMILLION, "v", "--"),
    "SciPy BDF": (ORANGE, "P", "--"),
    "SciPy LSODA": (INK, "X", "--"),
}
"""Colour, marker and line of each integrator."""
PEERS = {
    "offwind_chain": ("offwind-pin", BLUE, "*"),
    "opensees_pdelta": ("OpenSees, PDelta", VERMILLION, "o"),
    "opensees_pdelta_linear": ("OpenSees, PDelta, linear solution", ORANGE, "s"),
    "opensees_planar": ("OpenSees, planar", PURPLE, "D"),
    "opensees_corotational": ("OpenSees, corotational", INK, "^"),
    "exudyn_chain": ("Exudyn", GREEN, "v"),
    "mujoco_chain": ("MuJoCo", SKY, "P"),
}
"""Name, colour and marker of each code."""
PARTS = {
    "forward motion": BLUE,
    "loads": SKY,
    "balance of forces": GREEN,
    "solution for a correction": ORANGE,
    "factorisation": VERMILLION,
    "recording and energies": PURPLE,
    "integrator's arithmetic": "#F0E442",
    "compiled, not in the above": "#999999",
    "waves and load history": "#8a6d3b",
    "static state and start": "#c9cfd6",
    "records into a dataset": "#e8ebee",
}
"""Parts of a step in the order of the bars, and their colours."""


@styled
def step_cost(report: Report) -> Figure:
    """A step and the pair of calls over the number of elements; and the shares of the parts."""
    figure = Figure(figsize=(FULL_WIDTH, 1.15 * _HEIGHT))
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.25))
    rows = report["rows"]
    whole, compiled_part, calls = "a step, whole", "of it compiled", "rnea + joint Jacobians"
    n = [row["elements"] for row in rows]
    step = np.array([row["step_s"] for row in rows]) * _MICRO
    low = step - np.array([row["step_smallest_s"] for row in rows]) * _MICRO
    high = np.array([row["step_largest_s"] for row in rows]) * _MICRO - step
    left.errorbar(n, step, [low, high], color=BLUE, marker="o", capsize=3, label=whole)
    compiled = [row["compiled_step_s"] * _MICRO for row in rows]
    left.plot(n, compiled, color=SKY, marker="s", label=compiled_part)
    pair = [row["pair_s"] * _MICRO for row in rows]
    left.plot(n, pair, color=VERMILLION, marker="D", ls="--", label=calls)
    _log(left, "elements", "µs")
    left.set_xticks(n, [str(value) for value in n])
    left.minorticks_off()
    left.set_title("Cost of a step")
    left.set_ylim(top=4 * max(step + high))
    handles, labels = left.get_legend_handles_labels()
    order = [labels.index(name) for name in (whole, compiled_part, calls)]
    left.legend([handles[i] for i in order], [labels[i] for i in order], loc="upper left")
    place, base = np.arange(len(rows)), np.zeros(len(rows))
    for name, color in PARTS.items():
        share = np.array([max(row["parts_s"][name], 0.0) for row in rows])
        share /= [sum(max(part, 0.0) for part in row["parts_s"].values()) for row in rows]
        right.bar(place, 100 * share, 0.72, bottom=base, color=color, label=name)
        base += 100 * share
    right.set_xticks(place, [str(value) for value in n])
    right.set_xlabel("elements")
    right.set_ylabel("% of a step")
    right.set_title("Where the time of a step goes")
    right.set_ylim(0, 100)
    handles, labels = right.get_legend_handles_labels()
    right.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


@styled
def work_precision(part: Report) -> Figure:
    """Error of each integrator over wall time, and over the step where there is one."""
    figure = Figure(figsize=(FULL_WIDTH, 1.2 * _HEIGHT))
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=(1.35, 1))
    for family, (color, marker, line) in OWN.items():
        rows = [row for row in part["runs"] if row["family"] == family]
        kept = [row for row in rows if row["error_over_peak"] > 0]
        if not kept:
            continue
        error = [row["error_over_peak"] for row in kept]
        look: Any = {"color": color, "marker": marker, "ls": line, "ms": 5}
        left.plot([row["wall_s"] for row in kept], error, label=family, **look)
        if all(row["dt_s"] for row in kept):
            right.plot([row["dt_s"] for row in kept], error, **look)
    left.margins(x=0.12)
    _log(left, "wall time in s", "largest difference over peak")
    left.set_title("Error over wall time")
    figure.legend(loc="outside lower center", ncols=4, fontsize=8.5)
    _log(right, "step in s", "")
    right.set_title("Error over the step")
    _slope(right, 2)
    return figure


@styled
def peers(rows: dict[str, Report]) -> Figure:
    """Error over wall time, and over the step, of other codes and our own on problem P."""
    figure = Figure(figsize=(FULL_WIDTH, 1.2 * _HEIGHT))
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=(1.35, 1))
    for name, row in rows.items():
        label, color, marker = PEERS.get(name, (name, MUTED, "x"))
        steps = [step for step in row.get("steps", []) if step.get("peak", 0.0) > 0]
        if not steps:
            continue
        error = [step["peak"] for step in steps]
        look: Any = {"color": color, "marker": marker, "ms": 5, "ls": "--"}
        if name == "offwind_chain":
            look |= {"ms": 9, "ls": "-", "lw": 2.2}
        left.plot([step["wall_s"] for step in steps], error, label=label, **look)
        right.plot([step["dt_s"] for step in steps], error, **look)
    for axes in (left, right):
        axes.axhline(0.02, color=MUTED, lw=0.8, ls=":")
        axes.axhline(0.002, color=MUTED, lw=0.8, ls=":")
    _log(left, "wall time in s", "largest difference over peak")
    left.set_title("Error over wall time")
    figure.legend(loc="outside lower center", ncols=4, fontsize=8.5)
    _log(right, "step in s", "")
    right.set_title("Error over the step")
    return figure


@styled
def pure_python(report: Report) -> Figure:
    """Speed-up of Pinocchio over the pure-Python core by algorithm."""
    figure = Figure(figsize=(FULL_WIDTH * 0.62, _HEIGHT))
    axes = figure.subplots()
    rows = report["rows"]
    looks = zip((BLUE, VERMILLION, ORANGE, GREEN, PURPLE), _MARKERS, strict=False)
    for name, (color, marker) in zip(rows[0]["algorithms"], looks, strict=False):
        axes.plot(
            [row["degrees_of_freedom"] for row in rows],
            [row["algorithms"][name]["speed_up"] for row in rows],
            color=color,
            marker=marker,
            label=name.replace("_", ", "),
        )
    _log(axes, "degrees of freedom", "times faster than pure Python")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


@styled
def cases_per_hour(report: Report) -> Figure:
    """Cases an hour over the number of processes, beside what perfect scaling would give."""
    figure = Figure(figsize=(FULL_WIDTH * 0.5, 0.85 * _HEIGHT))
    axes = figure.subplots()
    rows = report["rows"]
    n = np.array([row["processes"] for row in rows], dtype=float)
    rate = np.array([row["cases_per_hour"] for row in rows])
    bars = axes.bar(n, rate, 0.6, color=BLUE, label="measured")
    axes.bar_label(
        bars, [count(round(value)) for value in rate], label_type="center", color="white"
    )
    axes.plot(n, rate[0] / n[0] * n, color=VERMILLION, marker="D", ls="--", label="in proportion")
    axes.set_xticks(n, [f"{value:g}" for value in n])
    axes.set_xlabel("processes")
    axes.set_ylabel("cases an hour")
    axes.margins(y=0.15)
    axes.legend(loc="upper left")
    return figure


@styled
def memory(report: Report) -> Figure:
    """Peak memory of each duration, what there was before the time history apart."""
    figure = Figure(figsize=(FULL_WIDTH * 0.62, 0.6 * _HEIGHT))
    axes = figure.subplots()
    rows = report["rows"]
    place = np.arange(len(rows))[::-1]
    before = np.array([row["peak_before_bytes"] for row in rows]) / 1e6
    whole = np.array([row["peak_bytes"] for row in rows]) / 1e6
    axes.barh(place, before, 0.55, color=SKY, label="up to the built system")
    axes.barh(place, whole - before, 0.55, left=before, color=BLUE, label="time history")
    files = np.array([row["results_bytes"] for row in rows]) / 1e6
    axes.scatter(files, place, color=VERMILLION, marker="D", zorder=3, label="results on disk")
    axes.set_yticks(place, [f"{row['simulated_s'] / 60:g} min" for row in rows])
    axes.set_xlabel("MB")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _log(axes: Axes, x: str, y: str) -> None:
    """Logarithmic axes; where they span little, ticks at 2 and 5 as well."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        subs = (1.0,) if high > 50 * low else (1.0, 2.0, 5.0)
        axis.set_major_locator(LogLocator(subs=subs))
        axis.set_major_formatter(FuncFormatter(_plain))
        axis.set_minor_formatter(NullFormatter())
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(visible=True)


def _plain(value: float, place: int | None = None) -> str:
    return f"{value:g}" if 1e-3 <= value < 1e5 else powers_of_ten(value, place)


def _slope(axes: Axes, order: int) -> None:
    """A line of the expected order above the curves."""
    (low, high), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    x = np.array([low * (high / low) ** 0.35, low * (high / low) ** 0.8])
    y = (x / x[1]) ** order * top / 2
    axes.plot(x, y, color=MUTED, lw=1, ls=":")
    axes.annotate(f"order {order}", (x[1], y[1]), ha="right", va="bottom", fontsize=8.5)
    axes.set_ylim(bottom, top)
