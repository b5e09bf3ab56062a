"""Figures of modes identified from accelerations: singular values, and mode shapes."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from offwind_pin.display.figures.style import BLUE, FULL_WIDTH, MUTED, VERMILLION, styled
from offwind_pin.signal.modal_identification.identify import OperationalModes

_BAND = (0.05, 3.0)
"""End of the frequency axis in Hz."""


@styled
def identified_plot(data: xr.Dataset) -> Figure:
    """Singular values over frequency, and normalised shapes over height.

    Parameters
    ----------
    data : Dataset
        Group ``identified_modes`` of a case's results.
    """
    figure = Figure(figsize=(FULL_WIDTH, 0.5 * FULL_WIDTH), layout="constrained")
    values, shapes = figure.subplots(1, 2, width_ratios=[1.5, 1])
    lines, height = data["line"].to_numpy(), data["height"].to_numpy()
    inside = (lines > _BAND[0]) & (lines < _BAND[1])
    for number, color in ((1, MUTED), (0, BLUE)):
        level = 10 * np.log10(data["singular_value"].to_numpy()[inside, number])
        values.plot(
            lines[inside],
            level,
            color=color,
            linewidth=0.8,
            label=("first", "second")[number],
        )
    top = values.get_ylim()[1]
    for label, color in zip(data["mode"].to_numpy(), (BLUE, VERMILLION), strict=True):
        mode = data.sel(mode=label)
        at = float(mode["frequency"])
        values.axvline(at, color=color, linewidth=0.8, linestyle=":")
        values.annotate(
            f"{label} {at:.3f} Hz", (at, top), (3, -3), textcoords="offset points", va="top"
        )
        shapes.plot(mode["computed_shape"], height, color=color, linewidth=1.0, label=label)
        shapes.plot(mode["shape"], height, "o", color=color, markersize=3.5)
    values.set_xlim(0, _BAND[1])
    values.set_xlabel("frequency, Hz")
    values.set_ylabel("singular values, dB of (m/s²)²/Hz")
    values.legend(loc="lower right")
    shapes.axvline(0.0, color=MUTED, linewidth=0.5)
    shapes.set_xlabel("fore-aft shape, unit peak")
    shapes.set_ylabel("height z, m")
    shapes.set_title("identified (dots), eigenanalysis (lines)", fontsize="small")
    shapes.legend(loc="lower right")
    return figure


@styled
def singular_value_plot(modes: OperationalModes, highest: float | None = None) -> Figure:
    """All singular values over frequency, with the identified modes marked.

    highest : end of the frequency axis in Hz, by default three times the highest mode found
    """
    figure = Figure(figsize=(FULL_WIDTH, 4.6))
    axes = figure.subplots()
    end = 3 * float(np.max(modes.frequency_hz)) if highest is None else highest
    inside = (modes.frequencies > 0) & (modes.frequencies <= end)
    count = modes.singular_values.shape[1]
    for number in range(count - 1, -1, -1):
        level = 10 * np.log10(np.maximum(modes.singular_values[inside, number], _NOTHING))
        shade = BLUE if number == 0 else MUTED
        faint = 1.0 if number < 2 else max(0.25, 0.8 - 0.6 * number / count)
        axes.plot(
            modes.frequencies[inside],
            level,
            color=shade,
            alpha=faint,
            lw=1.2 if number == 0 else 0.7,
        )
    top = axes.get_ylim()[1]
    axes.set_ylim(top=top + 6)
    for at in modes.frequency_hz:
        axes.axvline(float(at), color=VERMILLION, lw=0.9, ls=":")
        axes.annotate(
            f"{at:.3f} Hz", (float(at), top + 6), (3, -3), textcoords="offset points", va="top"
        )
    axes.set_xlim(0, end)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel(f"{count} singular values, dB of (m/s²)²/Hz")
    return figure


_NOTHING = 1e-30
"""(m/s2)^2/Hz; a channel at rest has singular values of zero, which have no logarithm."""
