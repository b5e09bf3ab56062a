"""The structure drawn to scale: section, elements, foundation, water and rotor-nacelle assembly."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.base.definition import Array
from offwind_pin.definitions.rotor_nacelle import rotor_apex, rotor_radius
from offwind_pin.definitions.turbine import Member, RotorNacelleRNA
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
from offwind_pin.display.wording import TIMES, base_name, fixed
from offwind_pin.dynamics.system import System
from offwind_pin.loads.soil.springs.elastic import SoilSprings
from offwind_pin.structure.section import outer_diameter

_SIDES = (-44.0, 60.0)
"""m shown on the windward side, and on the lee side where the labels stand."""

_SHOWN_BLADE = 20.0
"""m of blade that are drawn; whole blades would double the height of the picture."""

_GROUND_LINE = "#8a6d3b"


@styled
def structure(system: System) -> Figure:
    """The structure in the plane of wind and waves, to scale.

    Section outline, element boundaries (lines across), foundation, mudline, mean water level,
    rotor-nacelle assembly with its centre of mass, and the main heights. Distributed springs are
    shown again in a panel with the embedded pile enlarged, one for each node.
    """
    soil = soil_springs(system)
    figure = Figure(figsize=(7.6 if soil else 4.4, 7.8))
    if soil is None:
        whole, enlarged = figure.subplots(), None
    else:
        whole, enlarged = figure.subplots(1, 2, width_ratios=(1, 1.1))
    low = system.chain.base - 8
    high = system.chain.top + _SHOWN_BLADE + 16
    _frame(whole, _SIDES, (low, high))
    _surroundings(whole, system)
    _tower_and_pile(whole, system)
    _rotor_nacelle(whole, system)
    _foundation(whole, system, soil, reach=9.0)
    _label_heights(whole, system)
    whole.set_ylabel("height z, m")
    if enlarged is not None and soil is not None:
        _frame(enlarged, (-15, 15), (system.chain.base - 5, system.turbine.site.mudline + 6))
        _surroundings(enlarged, system)
        _tower_and_pile(enlarged, system)
        _foundation(enlarged, system, soil, reach=8.0)
        enlarged.set_title(f"The embedded pile, {len(soil.height)} springs", fontsize=9.5)
    return figure


def _frame(axes: Axes, x: tuple[float, float], z: tuple[float, float]) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*z)
    axes.set_xlabel("x (downwind), m")


def _surroundings(axes: Axes, system: System) -> None:
    """Ground and water, as far as the picture goes."""
    (left, right), (low, _) = axes.get_xlim(), axes.get_ylim()
    mudline = system.turbine.site.mudline
    axes.axhspan(low, mudline, color=SOIL, lw=0, zorder=0)
    axes.axhline(mudline, color=_GROUND_LINE, lw=1.2, zorder=1)
    x = np.linspace(left, right, 200)
    level = _water_level(system)
    surface = np.full_like(x, level)
    if system.waters is not None and system.waters.surface.waves is not None:
        surface += 0.7 * np.cos(2 * np.pi * x / 20)
    if system.sea is not None:
        axes.fill_between(x, mudline, surface, color=WATER, lw=0, zorder=0)
        axes.plot(x, surface, color=BLUE, lw=1, zorder=1)
    axes.axhline(level, color=BLUE, lw=0.8, ls=(0, (5, 3)), zorder=1)


def _water_level(system: System) -> float:
    return 0.0 if system.sea is None else system.sea.water_level


def _tower_and_pile(axes: Axes, system: System) -> None:
    chain = system.chain
    for member in system.turbine.members:
        stations = [s for s in member.stations if s.z >= chain.base]
        if not stations:
            continue
        heights = np.array([s.z for s in stations])
        radii = np.array([s.diameter for s in stations]) / 2
        if heights[0] > chain.base > member.bottom:
            heights = np.concatenate([[chain.base], heights])
            radii = np.concatenate([outer_diameter(system.turbine, heights[:1]) / 2, radii])
        outline = np.column_stack(
            [np.concatenate([-radii, radii[::-1]]), np.concatenate([heights, heights[::-1]])]
        )
        axes.add_patch(Polygon(outline, facecolor=STEEL, edgecolor=INK, lw=1, zorder=3))
    radius = outer_diameter(system.turbine, chain.boundary) / 2
    lines = axes.hlines(chain.boundary, -radius, radius, color=INK, lw=0.5, zorder=4)
    lines.set_gid("element-boundaries")


def _rotor_nacelle(axes: Axes, system: System) -> None:
    top, rna = system.chain.top, system.turbine.rna
    center = system.chain.rna.center_of_mass
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
        f"rotor-nacelle assembly\n{system.chain.rna.mass / 1e3:,.0f} t, centre of mass\n"
        f"at x = {_signed(center[0])}, z = {_signed(top + center[2])} m",
        (center[0], top + center[2]),
        xytext=(7, top + 13),
        fontsize=8.5,
        va="bottom",
        arrowprops={"arrowstyle": "-", "color": MUTED, "lw": 0.7},
        zorder=7,
    )


def _blades(axes: Axes, rna: RotorNacelleRNA, top: float, apex: Array, shaft: Array) -> None:
    """Hub, and the roots of the upright blade and of those that point down; the rest is cut."""
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


def _foundation(axes: Axes, system: System, soil: SoilSprings | None, reach: float) -> None:
    mudline, base = system.turbine.site.mudline, system.chain.base
    radius = float(outer_diameter(system.turbine, np.array([base]))[0]) / 2
    if soil is not None:
        _springs(axes, soil.height, radius, reach)
        _toe_spring(axes, base)
    elif system.foundation.root is None:
        _clamp(axes, base, radius)
    elif system.foundation.name == "macro_element":
        _mudline_springs(axes, mudline, radius, "macro-element at the mudline")
    else:
        _mudline_springs(axes, mudline, radius, f"6{TIMES}6 stiffness at the mudline")


def _springs(axes: Axes, height: Array, radius: float, reach: float) -> None:
    """A spring at every node, on both sides of the pile, to a wall at the end."""
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
    """A spring as a line: places along it, and offsets across it."""
    teeth = 6
    length = end - start
    along = start + length * np.concatenate(
        [[0, 0.2], np.linspace(0.25, 0.75, 2 * teeth), [0.8, 1]]
    )
    across = np.zeros_like(along)
    across[2:-2] = amplitude * np.tile([1.0, -1.0], teeth)
    return along, across


def _label_heights(axes: Axes, system: System) -> None:
    """Main heights with their diameters, standing on their levels at the right, kept apart."""
    turbine, chain = system.turbine, system.chain
    top = _diameter(system, chain.top)
    labels = [(chain.top, f"yaw bearing\nD {top:.2f} m")]
    labels += [
        (member.bottom, f"foot of {member.name.replace('_', ' ')}\nD {_foot(member):.2f} m")
        for member in turbine.members
        if member.bottom > chain.base and member.bottom != turbine.site.mudline
    ]
    level = _water_level(system)
    named = "still water level" if level == 0 else "water level"
    labels.append((level, named if system.sea else "water level (dry case)"))
    labels.append((turbine.site.mudline, "mudline"))
    if chain.base < turbine.site.mudline:
        end = base_name(system.foundation.name)
        labels.append((chain.base, f"{end}\nD {_diameter(system, chain.base):.2f} m"))
    labels.sort()
    places = spread([height for height, _ in labels], 9.0)
    for (height, text), place in zip(labels, places, strict=True):
        edge = _diameter(system, height) / 2 + 1
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


def _foot(member: Member) -> float:
    return member.stations[0].diameter


def _diameter(system: System, height: float) -> float:
    return float(outer_diameter(system.turbine, np.array([height]))[0])


def _signed(value: float) -> str:
    return fixed(value, 2, sign=True)
