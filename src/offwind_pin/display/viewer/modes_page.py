"""Natural modes as a page of its own: choose them, and see up to four side by side."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.base.mode_labels import mode_name
from offwind_pin.display.rotor_nacelle import assembly
from offwind_pin.display.viewer.meshcat_recorder import Recorder
from offwind_pin.display.viewer.mode_frames import PEAK_SHARE, Shapes, shapes
from offwind_pin.display.viewer.scene import (
    AXIS_COLOUR,
    CLAMP_COLOUR,
    DAMPER_COLOUR,
    FIELD_OF_VIEW_DEG,
    MUDLINE_COLOUR,
    PLAIN,
    RNA_COLOUR,
    SPRING_COLOUR,
    WATER_COLOUR,
    colour_ramp,
    css,
    light,
    ramp_gradient,
    set_mesh,
    view_direction,
)
from offwind_pin.display.viewer.springs import damper_mesh, node_step, spring_symbol
from offwind_pin.display.wording import foundation_name, surrogate_notes, water_level_name
from offwind_pin.structure.meshes import FACETS, Mesh, box, circle, loft

PLACES = 4
"""Largest number of modes side by side."""
VIEW_DEG = (-130.0, 8.0)
"""Azimuth of the camera from the x axis, and its elevation: both planes are seen obliquely."""
SPACING = 0.78
"""Distance of structures side by side over their height."""
DISC = 0.3
"""Radius of mudline and water drawn, over the height of the structure."""
_SPEEDS = (0.05, 0.1, 0.25, 0.5, 1, 2)
_FIRST_SPEED = 0.5


def render_modes(results: xr.Dataset, labels: list[str] | None = None) -> str:
    """HTML page of natural modes in motion; it needs no server and no network.

    Parameters
    ----------
    results : Dataset
        Natural modes, in memory or from ``results.nc``.
    labels : list of str, optional
        Modes side by side at first, up to four; by default the first bending modes.

    Raises
    ------
    InputError
        As :func:`~offwind_pin.display.viewer.mode_frames.shapes`, or an unknown label.
    """
    shown = shapes(results)
    first = shown.chosen(labels, PLACES)
    recorder = Recorder()
    draw_places(recorder.visualizer(), results, shown)
    return recorder.page(
        "modes.html",
        turbine=str(results.attrs["turbine"]),
        foundation=foundation_name(str(results.attrs["foundation"])),
        case=str(results.attrs.get("case", "")),
        water=water_in_words(results),
        surrogates=surrogate_notes(results.attrs),
        gradient=ramp_gradient(),
        key=_key(results, shown),
        speeds=_SPEEDS,
        speed=_FIRST_SPEED,
        most=PLACES,
        labels=shown.label,
        modes=_modes(shown) | {"ramp": colour_ramp().tolist(), "first": first},
        look=modes_look(results, shown),
    )


def water_in_words(results: xr.Dataset) -> str:
    """Level of the water; empty for a dry structure."""
    if results.attrs.get("sea") == "dry":
        return ""
    return water_level_name(float(results.attrs.get("water_level_m", 0.0)))


def _key(results: xr.Dataset, shown: Shapes) -> list[tuple[str, float, str]]:
    """Colour, opacity and meaning of what the scene contains besides the structure."""
    water, springs = water_in_words(results), springs_in_words(results, shown.size)
    rows = [(WATER_COLOUR, 0.6, water), (MUDLINE_COLOUR, 0.7, "mudline")]
    rows += [(AXIS_COLOUR, 1.0, "axis at rest"), (SPRING_COLOUR, 1.0, springs)]
    if len(shown.damper_height):
        rows.append((DAMPER_COLOUR, 1.0, "tuned mass damper"))
    return [(css(colour), opacity, words) for colour, opacity, words in rows if words]


def springs_in_words(results: xr.Dataset, size: float) -> str:
    """What the spring symbols of a structure ``size`` m high represent; empty without any."""
    if "spring_height" in results:
        step = node_step(results.spring_height.values, size)
        return "soil springs" if step == 1 else f"soil springs (one in {step} drawn)"
    flexible = results.attrs["root"] == "flexible"
    return foundation_name(str(results.attrs["foundation"])) if flexible else ""


def draw_places(view: Any, results: xr.Dataset, shown: Shapes) -> None:
    """The structure at rest in each of four places, which the page moves apart.

    Each place has ``wall``, whose rings are consecutive vertices, ``rna`` about the yaw bearing,
    ``spring``, which the page copies for each spring, ``damper/0`` and following, and ``site``.
    """
    light(view)
    rings = np.array([circle(r, z) for r, z in zip(shown.radius, shown.height, strict=True)])
    wall = loft(rings, capped=False)
    parts = assembly(results, 2 * float(shown.radius[-1]))
    symbol = spring_symbol(results, shown.size)
    dampers = damper_meshes(shown)
    site = site_meshes(results, shown)
    for place in range(PLACES):
        part = view["places"][str(place)]
        set_mesh(part["wall"], wall, np.tile(PLAIN, (len(wall.vertices), 1)))
        for name, mesh in parts.items():
            set_mesh(part["rna"][name], mesh, RNA_COLOUR)
        if len(shown.springs[0].height):
            set_mesh(part["spring"], symbol, SPRING_COLOUR)
        for d, mesh in enumerate(dampers):
            set_mesh(part["damper"][str(d)], mesh, DAMPER_COLOUR)
        for name, (mesh, colour, opacity) in site.items():
            set_mesh(part["site"][name], mesh, colour, opacity=opacity)


def damper_meshes(shown: Shapes) -> list[Mesh]:
    """A disc about the origin for each tuned mass damper."""
    radius = np.interp(shown.damper_height, shown.height, shown.radius)
    return [damper_mesh(2 * float(r)) for r in radius]


def site_meshes(results: xr.Dataset, shown: Shapes) -> dict[str, tuple[Mesh, int, float]]:
    """Mesh, colour and opacity of mudline, water, axis at rest, and the clamp of a fixed root."""
    size, base = shown.size, float(shown.height[0])
    heights = np.linspace(base, base + size, 30)
    axis = loft(np.array([circle(0.0014 * size, z, facets=6) for z in heights]))
    site = {
        "mudline": (_disc(DISC * size, float(results.attrs["mudline_m"])), MUDLINE_COLOUR, 0.42),
        "axis_at_rest": (axis, AXIS_COLOUR, 1.0),
    }
    if results.attrs.get("sea") != "dry":
        level = float(results.attrs.get("water_level_m", 0.0))
        site["water"] = _disc(DISC * size, level), WATER_COLOUR, 0.26
    if results.attrs["root"] == "fixed":
        half, deep = 0.045 * size, 0.035 * size
        block = box([-half, -half, base - deep], [half, half, base])
        site["clamp"] = block, CLAMP_COLOUR, 1.0
    return site


def _disc(radius: float, z: float) -> Mesh:
    """A level disc, cut into pieces so that a painter can sort it among what it intersects."""
    rings = np.linspace(radius, 1e-3 * radius, 9)
    return loft(np.array([circle(r, z, facets=64) for r in rings]), capped=False)


def _modes(shown: Shapes) -> dict[str, Any]:
    """What the page's script needs of the modes."""
    springs = shown.springs
    return {
        "label": shown.label,
        "name": [mode_name(label) for label in shown.label],
        "frequency": shown.frequency_hz.tolist(),
        "damping": shown.damping_ratio.tolist(),
        "torsion": [family == "T" for family in shown.family],
        "peak": [shown.peak_in_words(mode) for mode in range(len(shown.label))],
        "facets": FACETS,
        "height": shown.height.tolist(),
        "motion": _rounded(shown.motion),
        "share": _rounded(shown.share),
        "spring_height": _rounded(springs[0].height),
        "spring_offset": _rounded([found.offset for found in springs]),
        "spring_anchor": _rounded([found.anchor for found in springs]),
        "spring_motion": _rounded(shown.motion_at(springs[0].height)),
        "damper_height": _rounded(shown.damper_height),
        "damper_stroke": _rounded(shown.stroke),
        "damper_motion": _rounded(shown.motion_at(shown.damper_height)),
    }


def _rounded(values: Any) -> Any:
    """Nested lists of numbers in m, rad or 1."""
    return np.round(values, 5).tolist()


def modes_look(results: xr.Dataset, shown: Shapes) -> dict[str, Any]:
    """Where the camera is, for the page's script: directions as numbers, lengths in m."""
    meshes = assembly(results, 2 * float(shown.radius[-1]))
    points = np.concatenate([mesh.vertices for mesh in meshes.values()])
    size, base = shown.size, float(shown.height[0])
    low = min(base - 0.05 * size, float(results.attrs["mudline_m"]) - 0.08 * size)
    high = float(shown.height[-1] + points[:, 2].max())
    azimuth = np.radians(VIEW_DEG[0])
    right = np.array([-np.sin(azimuth), np.cos(azimuth)])
    breadth = float(np.abs(points[:, :2] @ right).max()) + PEAK_SHARE * size
    return {
        "field_of_view_deg": FIELD_OF_VIEW_DEG,
        "from": view_direction(*VIEW_DEG).tolist(),
        "centre": (low + high) / 2,
        "half_height": (high - low) / 2,
        "half_breadth": max(breadth, DISC * size),
        "depth": breadth,
        "right": right.tolist(),
        "spacing": SPACING * size,
        "low": low,
    }
