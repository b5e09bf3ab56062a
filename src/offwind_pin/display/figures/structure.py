"""Drawing of the structure to scale: section, elements, foundation, water, rotor and nacelle."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from offwind_pin.base.definition import Array
from offwind_pin.definitions.rotor_nacelle import rotor_apex, rotor_radius
from offwind_pin.definitions.turbine import RotorNacelleRNA
from offwind_pin.display.figures.style import (
    BLUE,
    GREEN,
    INK,
    MUTED,
    SOIL,
    STEEL,
    WATER,
    spread,
    styled,
)
from offwind_pin.display.rotor_nacelle import rotor_nacelle
from offwind_pin.display.wording import base_name, fixed, foundation_name

_SIDES = (-44.0, 60.0)
"""m shown on the windward side, and on the leeward side, where the labels are."""

_SHOWN_BLADE = 20.0
"""Length of blade in m that is drawn; whole blades would double the height of the drawing."""

_GROUND_LINE = "#8a6d3b"


@styled
def structure(data: xr.Dataset) -> Figure:
    """The structure in the plane of wind and waves, to scale.

    Section outline, element boundaries (lines across), foundation, mudline, mean water level,
    rotor-nacelle assembly with its centre of mass, and the main heights. A second panel enlarges
    the embedded pile with distributed springs, one per node.

    Parameters
    ----------
    data : Dataset
        Result of :func:`offwind_pin.analysis.drawing_data.structure_dataset`.
    """
    springs = data["spring_height"].to_numpy() if "spring_height" in data else None
    base, top, mudline = _levels(data)
    figure = Figure(figsize=(4.4 if springs is None else 7.6, 7.8))
    if springs is None:
        whole, enlarged = figure.subplots(), None
    else:
        whole, enlarged = figure.subplots(1, 2, width_ratios=(1, 1.1))
    _frame(whole, _SIDES, (base - 8, top + _SHOWN_BLADE + 16))
    _surroundings(whole, data)
    _tower_and_pile(whole, data)
    _rotor_nacelle(whole, data)
    _foundation(whole, data, springs, reach=9.0)
    _label_heights(whole, data)
    whole.set_ylabel("height z, m")
    if enlarged is not None and springs is not None:
        _frame(enlarged, (-15, 15), (base - 5, mudline + 6))
        _surroundings(enlarged, data)
        _tower_and_pile(enlarged, data)
        _foundation(enlarged, data, springs, reach=8.0)
        enlarged.set_title(f"The embedded pile, {len(springs)} springs", fontsize=9.5)
    return figure


def _levels(data: xr.Dataset) -> tuple[float, float, float]:
    """Heights of base, yaw bearing and mudline in m."""
    base, top, mudline = (float(data.attrs[f"{n}_m"]) for n in ("base", "yaw_bearing", "mudline"))
    return base, top, mudline


def _wet(data: xr.Dataset) -> bool:
    return data.attrs["sea"] != "dry"


def _members(data: xr.Dataset) -> dict[str, tuple[Array, Array]]:
    """Heights and outer diameters of the stations of each member, in m."""
    name = data["station_member"].to_numpy()
    height, diameter = data["station_height"].to_numpy(), data["station_diameter"].to_numpy()
    return {
        str(member): (height[name == member], diameter[name == member])
        for member in dict.fromkeys(name.tolist())
    }


def _frame(axes: Axes, x: tuple[float, float], z: tuple[float, float]) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*z)
    axes.set_xlabel("x (downwind), m")


def _surroundings(axes: Axes, data: xr.Dataset) -> None:
    """Ground and water over the width of the drawing."""
    (left, right), (low, _) = axes.get_xlim(), axes.get_ylim()
    _, _, mudline = _levels(data)
    axes.axhspan(low, mudline, color=SOIL, lw=0, zorder=0)
    axes.axhline(mudline, color=_GROUND_LINE, lw=1.2, zorder=1)
    x = np.linspace(left, right, 200)
    level = _water_level(data)
    surface = np.full_like(x, level)
    if data.attrs["surface"] == "waves":
        surface += 0.7 * np.cos(2 * np.pi * x / 20)
    if _wet(data):
        axes.fill_between(x, mudline, surface, color=WATER, lw=0, zorder=0)
        axes.plot(x, surface, color=BLUE, lw=1, zorder=1)
    axes.axhline(level, color=BLUE, lw=0.8, ls=(0, (5, 3)), zorder=1)


def _water_level(data: xr.Dataset) -> float:
    return float(data.attrs.get("water_level_m", 0.0))


def _tower_and_pile(axes: Axes, data: xr.Dataset) -> None:
    for heights, diameters in _members(data).values():
        radii = diameters / 2
        outline = np.column_stack(
            [np.concatenate([-radii, radii[::-1]]), np.concatenate([heights, heights[::-1]])]
        )
        axes.add_patch(Polygon(outline, facecolor=STEEL, edgecolor=INK, lw=1, zorder=3))
    boundary = data["boundary_height"].to_numpy()
    radius = data["boundary_diameter"].to_numpy() / 2
    lines = axes.hlines(boundary, -radius, radius, color=INK, lw=0.5, zorder=4)
    lines.set_gid("element-boundaries")


def _rotor_nacelle(axes: Axes, data: xr.Dataset) -> None:
    _, top, _ = _levels(data)
    rna = rotor_nacelle(data)
    center = data["rotor_nacelle_center_of_mass"].to_numpy()
    mass = float(data["rotor_nacelle_mass"])
    if isinstance(rna, RotorNacelleRNA):
        apex, shaft = rotor_apex(rna)
        _blades(axes, rna, top, apex, shaft)
        front, back = apex[0] + 2, 2.2 * rna.nacelle_center_of_mass[0] - apex[0]
        back = max(back, 4.0)
        nacelle = [(front, 0.6), (back, 0.6), (back, 5.6), (front, 5.6)]
    else:
        reach = max(4.0, abs(center[0]) + 3)
        nacelle = [(-reach, 0.6), (reach, 0.6), (reach, 6.0), (-reach, 6.0)]
    outline = [(x, top + z) for x, z in nacelle]
    axes.add_patch(Polygon(outline, facecolor="white", edgecolor=INK, lw=1, zorder=3))
    _center_of_mass(axes, float(center[0]), top + float(center[2]))
    axes.annotate(
        f"rotor-nacelle assembly\n{mass / 1e3:,.0f} t, centre of mass\n"
        f"at x = {_signed(center[0])}, z = {_signed(top + center[2])} m",
        (center[0], top + center[2]),
        xytext=(7, top + 13),
        fontsize=8.5,
        va="bottom",
        arrowprops={"arrowstyle": "-", "color": MUTED, "lw": 0.7},
        zorder=7,
    )


def _blades(axes: Axes, rna: RotorNacelleRNA, top: float, apex: Array, shaft: Array) -> None:
    """Hub and blade roots; the blades are cut."""
    cone = np.radians(rna.precone)
    upright = np.array([-shaft[2], 0.0, shaft[0]])
    hub = np.array([apex[0], top + apex[2]])
    for share in (1.0, float(np.cos(2 * np.pi / rna.blades))):
        along = np.cos(cone) * share * upright + np.sin(cone) * shaft
        length = _SHOWN_BLADE
        axis = np.array([along[0], along[2]])
        across = np.array([axis[1], -axis[0]]) / max(float(np.hypot(*axis)), 1e-9)
        root, tip = hub, hub + length * axis
        outline = [root - 1.1 * across, tip - 0.9 * across, tip + 0.9 * across, root + 1.1 * across]
        axes.add_patch(Polygon(outline, facecolor="white", edgecolor=INK, lw=0.8, zorder=2))
        cut = np.array([tip - 1.8 * across - 0.6 * axis, tip + 1.8 * across + 0.6 * axis])
        axes.plot(*cut.T, color=INK, lw=0.8, zorder=4)
    axes.add_patch(Circle((hub[0], hub[1]), 2.4, facecolor="white", edgecolor=INK, lw=1, zorder=4))
    axes.annotate(
        f"rotor {2 * rotor_radius(rna):.0f} m,\nblades cut",
        (hub[0] - 3.5, top + apex[2] + 0.55 * _SHOWN_BLADE),
        ha="right",
        va="bottom",
        fontsize=8.5,
        color=MUTED,
    )


def _center_of_mass(axes: Axes, x: float, z: float) -> None:
    """A cross in a circle."""
    axes.plot(x, z, marker="o", ms=7, mfc="white", mec=INK, mew=0.8, zorder=5)
    axes.plot(x, z, marker="+", ms=7, mec=INK, mew=0.8, zorder=6)


def _foundation(axes: Axes, data: xr.Dataset, springs: Array | None, reach: float) -> None:
    base, _, mudline = _levels(data)
    radius = float(data["boundary_diameter"][0]) / 2
    if springs is not None:
        _springs(axes, springs, radius, reach)
        _toe_spring(axes, base)
    elif data.attrs["root"] == "fixed":
        _clamp(axes, base, radius)
    else:
        _mudline_springs(axes, mudline, radius, foundation_name(data.attrs["foundation"]))


def _springs(axes: Axes, height: Array, radius: float, reach: float) -> None:
    """A spring at every node on both sides of the pile, with a wall at its end."""
    spacing = abs(height[1] - height[0])
    along, across = _zigzag(radius, radius + reach, amplitude=0.3 * spacing)
    springs = [np.column_stack([s * along, z + across]) for z in height for s in (-1, 1)]
    lines = LineCollection(springs, colors=GREEN, linewidths=0.7, zorder=2)
    lines.set_gid("soil-springs")
    axes.add_collection(lines)
    for wall in (-radius - reach, radius + reach):
        axes.plot([wall, wall], [height.min(), height.max()], color=_GROUND_LINE, lw=1.5, zorder=2)


def _toe_spring(axes: Axes, base: float) -> None:
    along, across = _zigzag(0, 3.4, amplitude=0.9)
    axes.plot(across, base - along, color=GREEN, lw=1, zorder=2)
    axes.plot([-3, 3], [base - 3.4, base - 3.4], color=_GROUND_LINE, lw=1.5, zorder=2)


def _clamp(axes: Axes, base: float, radius: float) -> None:
    """Hatched ground under a section that cannot move."""
    block = [(-2.2 * radius, base - 4), (2.2 * radius, base - 4)]
    block += [(2.2 * radius, base), (-2.2 * radius, base)]
    axes.add_patch(
        Polygon(block, facecolor="white", edgecolor=_GROUND_LINE, hatch="////", lw=0, zorder=2)
    )
    axes.plot([-2.2 * radius, 2.2 * radius], [base, base], color=INK, lw=2, zorder=4)
    axes.annotate("clamped", (2.4 * radius, base - 2.6), va="center", fontsize=9)


def _mudline_springs(axes: Axes, mudline: float, radius: float, name: str) -> None:
    """One lateral spring, one vertical, and a spiral for rotation."""
    along, across = _zigzag(radius, radius + 9, amplitude=1.0)
    axes.plot(along, mudline + across, color=GREEN, lw=1.3, zorder=5, gid="coupled-spring")
    wall = radius + 9
    axes.plot([wall, wall], [mudline - 2, mudline + 2], color=_GROUND_LINE, lw=1.8, zorder=5)
    angle = np.linspace(0, 5 * np.pi, 160)
    size = 0.6 + 2.6 * angle / angle[-1]
    axes.plot(
        size * np.cos(angle), mudline - 4.2 + size * np.sin(angle), color=GREEN, lw=1.3, zorder=5
    )
    axes.annotate(
        name,
        (radius, mudline - 5.2),
        va="center",
        fontsize=9,
        zorder=6,
    )


def _zigzag(start: float, end: float, amplitude: float) -> tuple[Array, Array]:
    """A spring as a line: positions along it, and offsets across it."""
    teeth = 6
    length = end - start
    along = start + length * np.concatenate(
        [[0, 0.2], np.linspace(0.25, 0.75, 2 * teeth), [0.8, 1]]
    )
    across = np.zeros_like(along)
    across[2:-2] = amplitude * np.tile([1.0, -1.0], teeth)
    return along, across


def _label_heights(axes: Axes, data: xr.Dataset) -> None:
    """Labels of main heights with diameters on the right, without overlaps."""
    base, top, mudline = _levels(data)
    labels = [(top, f"yaw bearing\nD {_diameter(data, top):.2f} m")]
    labels += [
        (heights[0], f"foot of {name.replace('_', ' ')}\nD {diameters[0]:.2f} m")
        for name, (heights, diameters) in _members(data).items()
        if heights[0] > base and heights[0] != mudline
    ]
    level = _water_level(data)
    named = "still water level" if level == 0 else "water level"
    labels.append((level, named if _wet(data) else "water level (dry case)"))
    labels.append((mudline, "mudline"))
    if base < mudline:
        end = base_name(data.attrs["foundation"])
        labels.append((base, f"{end}\nD {_diameter(data, base):.2f} m"))
    labels.sort()
    places = spread([height for height, _ in labels], 9.0)
    for (height, text), place in zip(labels, places, strict=True):
        edge = _diameter(data, height) / 2 + 1
        axes.plot([edge, 15, 17], [height, height, place], color=MUTED, lw=0.7, zorder=6)
        number = "0 m" if height == 0 else f"{_signed(height)} m"
        axes.annotate(
            f"{number}  {text}",
            (18, place + 0.8),
            va="bottom",
            fontsize=8.5,
            linespacing=1.1,
            zorder=6,
        )


def _diameter(data: xr.Dataset, height: float) -> float:
    """Outer diameter in m at a height; at a jump, that of the part above."""
    found = 0.0
    for heights, diameters in _members(data).values():
        if heights[0] <= height <= heights[-1]:
            found = float(np.interp(height, heights, diameters))
    return found


def _signed(value: float) -> str:
    return fixed(value, 2, sign=True)
