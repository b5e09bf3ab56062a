"""Style of all figures, and figures as SVG for HTML pages."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Sequence
from io import StringIO
from pathlib import Path
from typing import Any, Literal, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from offwind_pin.display.wording import water_level_name

Array = NDArray[np.float64]
P = ParamSpec("P")
R = TypeVar("R")

BLUE, VERMILLION, GREEN = "#0072B2", "#D55E00", "#009E73"
ORANGE, PURPLE, SKY, INK = "#E69F00", "#CC79A7", "#56B4E9", "#1f2430"
PALETTE = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
"""Okabe and Ito's colours, distinguishable with any kind of colour vision."""

MUTED, SOIL, WATER, STEEL = "#5d6573", "#efe6d6", "#e3f0f9", "#c9cfd6"
FULL_WIDTH = 9.6
"""Width in inches of a figure that fills the text column of the report."""

_STYLE: Any = {
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.labelsize": 9.5,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "figure.facecolor": "white",
    "figure.constrained_layout.use": True,
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.5,
    "grid.color": "#e3e6ea",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 9.5,
    "lines.linewidth": 1.5,
    "lines.solid_capstyle": "round",
    "text.color": INK,
    # A dollar sign in a name does not start a formula.
    "text.parse_math": False,
    "xtick.color": MUTED,
    "xtick.labelcolor": INK,
    "xtick.labelsize": 9,
    "ytick.color": MUTED,
    "ytick.labelcolor": INK,
    "ytick.labelsize": 9,
}


def styled(draw: Callable[P, R]) -> Callable[P, R]:
    """Draw in the project's style without changing matplotlib's settings."""

    @functools.wraps(draw)
    def wrapper(*args: P.args, **kwargs: P.kwargs) -> R:
        with mpl.rc_context(_STYLE):
            return draw(*args, **kwargs)

    return wrapper


@styled
def to_svg(figure: Figure, name: str) -> str:
    """An ``<svg>`` element for an HTML page, identical for identical figures.

    Text stays text, so that it is small, searchable, and in the page's typeface. It is laid out in
    DejaVu Sans, which is wider than usual browser fonts, so that nothing overlaps.

    name : prefix of referenced ids, different for each figure of a page; other ids are removed
    """
    buffer = StringIO()
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": name}):
        # Figure.savefig would draw twice, the first time to lay out, which drawing does by itself
        canvas, dpi = figure.canvas, figure.dpi
        svg: Any = FigureCanvasSVG(figure)  # matplotlib's own drawing is untyped
        svg.print_svg(buffer, metadata={"Date": None})
        figure.set_canvas(canvas)
        figure.set_dpi(dpi)
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"\s*<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\s+xmlns(:\w+)?="[^"]*"', "", text, count=2)
    targets = set(re.findall(r'(?:href="#|url\(#)([^")]+)', text))
    text = re.sub(
        r'\s+id="([^"]*)"',
        lambda found: f' id="{name}-{found[1]}"' if found[1] in targets else "",
        text,
    )
    text = re.sub(r'(?:xlink:)?href="#', f'href="#{name}-', text)
    return text.replace("url(#", f"url(#{name}-").strip()


@styled
def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure in the format of the path's suffix, identical for identical figures."""
    dates = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    with mpl.rc_context({"svg.hashsalt": path.suffix}):
        figure.savefig(path, dpi=200, metadata=dates.get(path.suffix.lower()))


def spread(wanted: Sequence[float], width: float) -> Array:
    """(n,) positions as close as possible to the wanted ones, in order, at least a width apart.

    Least squares by pooling neighbours that would overlap.
    """
    order = np.argsort(wanted, kind="stable")
    groups: list[tuple[float, int]] = []
    for rank, target in enumerate(np.asarray(wanted, dtype=float)[order]):
        mean, size = float(target) - rank * width, 1
        while groups and groups[-1][0] > mean:
            before, count = groups.pop()
            mean, size = (before * count + mean * size) / (count + size), size + count
        groups.append((mean, size))
    shifted = np.repeat([mean for mean, _ in groups], [size for _, size in groups])
    places = np.empty(len(order))
    places[order] = shifted + width * np.arange(len(order))
    return places


def thin(time: Array, values: Array, columns: int) -> tuple[Array, Array]:
    """At most two samples per column of a figure: the smallest and the largest.

    This keeps all extremes, and the figure of a long history small.
    """
    size = -(-len(values) // columns)
    if size <= 2:
        return time, values
    starts = range(0, len(values), size)
    kept = sorted(
        {
            start + int(pick(values[start : start + size]))
            for start in starts
            for pick in (np.argmin, np.argmax)
        }
    )
    return time[kept], values[kept]


def powers_of_ten(value: float, _: int | None = None) -> str:
    """Power of ten with a superscript exponent."""
    exponent = round(np.log10(value))
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


POWERS_OF_TEN = FuncFormatter(powers_of_ten)


def mark_levels(
    axes: Axes,
    mudline: float,
    *,
    water: float | None,
    named: Literal["left", "right"] | None = None,
) -> None:
    """Ground, mudline and water level behind curves over height, optionally with names.

    water : height in m of the mean water surface, or None for a dry structure
    """
    low = axes.get_ylim()[0]
    if low < mudline:
        axes.axhspan(low, mudline, color=SOIL, lw=0, zorder=0)
        axes.set_ylim(bottom=low)
    levels = [(mudline, "mudline", "#8a6d3b")]
    levels += [] if water is None else [(water, water_level_name(water), BLUE)]
    for height, name, color in levels:
        axes.axhline(height, color=color, lw=0.8, ls=(0, (5, 3)), zorder=1)
        if named is not None:
            axes.annotate(
                name,
                (float(named == "right"), height),
                xycoords=("axes fraction", "data"),
                xytext=(-2 if named == "right" else 2, 2),
                textcoords="offset points",
                ha=named,
                fontsize=8.5,
                color=color,
                bbox={"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.7},
                zorder=5,
            )
