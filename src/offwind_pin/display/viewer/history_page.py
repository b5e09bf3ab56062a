"""A time history as a page of its own: the structure moves in its sea, from results alone."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from markupsafe import Markup
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.whole_files import write_text
from offwind_pin.display.report.templates import environment
from offwind_pin.display.rotor_nacelle import rotor_nacelle
from offwind_pin.display.viewer.history_frames import Frames, frames, outline
from offwind_pin.display.viewer.meshcat_recorder import Recorder, viewer_licence, viewer_script
from offwind_pin.display.viewer.scene import (
    COLOUR_MAP,
    MUDLINE_COLOUR,
    RNA_COLOUR,
    WATER_COLOUR,
    light,
    set_mesh,
)
from offwind_pin.display.wording import MINUS, fixed, foundation_name, number
from offwind_pin.structure.meshes import Mesh, circle, loft
from offwind_pin.structure.rotor import rna_meshes

DURATION = 60.0
"""s of a page, unless told otherwise."""

_FIELD_OF_VIEW_DEG = 24.0
_VIEW_DEG = (-122.0, 11.0)
"""Azimuth of the camera from the x axis, and its elevation."""
_RING = 2.5
"""Largest distance in m of the rings of the wall."""
_FACTORS = (1, 2, 5, 10, 20, 50, 100)
"""By which displacements may be drawn larger than they are."""
SEA_COLOURS = np.array([[20, 72, 128], [61, 143, 209], [214, 238, 250]]) / 255
"""Red, green and blue of the sea at its lowest, its mean and its highest point drawn."""
_SHOWN_SHARE = 0.04
"""Of the height of the structure, which the largest displacement is not drawn beyond."""
ARROW_SHARE = 0.24
"""Of the height of the structure: length of the arrow of the largest force of each kind."""
_ARROW_FACETS = 10
TOP_COLOUR, SOIL_COLOUR = 0xD55E00, 0x8C1D40
TOP_WIDTH, SOIL_WIDTH = 0.006, 0.0012
PLAIN = np.array([0xE9, 0xEC, 0xEF]) / 255
"""Of the wall where no moment colours it."""
_SPEEDS = (0.25, 0.5, 1, 2, 5, 10)
_LEVEL = 1e-3
"""Half the range of a curve, over its largest value, below which it counts as constant."""
_CHART = (276, 34)
"""Breadth and height of a curve in the card."""


def time_history_page(
    results: xr.Dataset, html: Path, start: float = 0.0, duration: float = DURATION
) -> None:
    """Write :func:`render_time_history` into a file, whole or not at all."""
    write_text(html, render_time_history(results, start, duration))


def render_time_history(results: xr.Dataset, start: float = 0.0, duration: float = DURATION) -> str:
    """HTML page of a part of a time history in motion; it needs no server and no network.

    The sea is drawn to scale, at the level that it has. Displacements are enlarged by a factor that
    the page names and lets its reader choose. Colours of the wall are the bending moment; arrows
    are the load applied at the yaw bearing and the forces of the soil at its nodes, each kind with
    a scale of its own. Neither the turning of the rotor nor torsion is in results, so that neither
    is drawn.

    Parameters
    ----------
    results : Dataset
        Of :func:`offwind_pin.simulate`, in memory or from ``results.nc``.
    start, duration : float, s
        Of the part.

    Raises
    ------
    InputError
        See :func:`offwind_pin.display.viewer.history_frames.frames`.
    """
    shown = frames(results, start, duration)
    recorder = Recorder()
    scene = draw_scene(recorder.visualizer(), results, shown)
    wet = results.attrs.get("sea") != "dry"
    level = float(results.attrs.get("water_level_m", 0.0))
    told = str(results.attrs.get("surrogates", "none"))
    return (
        environment()
        .get_template("history.html")
        .render(
            turbine=str(results.attrs["turbine"]),
            foundation=foundation_name(str(results.attrs["foundation"])),
            case=str(results.attrs.get("case", "time history")),
            waves=str(results.attrs.get("waves", "")) if wet else "",
            water=f"sea, mean level {fixed(level, 2, sign=level != 0)} m" if wet else "",
            sea_gradient=", ".join(mpl.colors.to_hex(colour) for colour in SEA_COLOURS),
            left_out=shown.sea is None and bool(np.any(shown.elevation)),
            surrogates=[text for text in told.split(" | ") if text not in ("", "none")],
            speeds=_SPEEDS,
            loads=_loads_in_words(results, shown),
            factors=_FACTORS,
            factor=displacement_factor(shown),
            charts=_charts(shown),
            mudline_colour=f"#{MUDLINE_COLOUR:06x}",
            breadth=_CHART[0],
            height=_CHART[1],
            motion=_motion(shown, level) | scene,
            look=history_look(results, shown),
            commands=[base64.b64encode(command).decode() for command in recorder.commands],
            licence=Markup(viewer_licence().replace("*/", "* /")),  # noqa: S704 (from the package)
            viewer_script=Markup(viewer_script()),  # noqa: S704 (from the package)
        )
    )


def draw_scene(view: Any, results: xr.Dataset, shown: Frames) -> dict[str, Any]:
    """Draw what will move, at rest.

    The wall is ``structure/wall``, the rotor-nacelle assembly ``structure/rna`` about the yaw
    bearing; the sea is ``sea/surface``, whose vertices go through y for each x, and ``sea/sides``,
    whose first vertices are its rim and the others lie below them at the mudline.

    Returns
    -------
    dict of str to object
        What the page's script must know of these meshes: ``rim``, numbers of the vertices of the
        surface that are the rim; ``soil_radius``, where the soil's arrows begin, in m.
    """
    light(view)
    height, radius = outline(results, _RING)
    rings = np.array([circle(r, z) for z, r in zip(height, radius, strict=True)])
    wall = loft(rings, capped=False)
    set_mesh(view["structure"]["wall"], wall, np.tile(PLAIN, (len(wall.vertices), 1)))
    for name, mesh in rna_meshes(rotor_nacelle(results), 2 * float(radius[-1])).items():
        set_mesh(view["structure"]["rna"][name], mesh, RNA_COLOUR)
    draw_arrows(view, shown)
    mudline = float(results.attrs["mudline_m"])
    ground = surface_mesh(shown.x[[0, -1]], shown.y[[0, -1]], mudline)
    set_mesh(view["site"]["mudline"], ground, MUDLINE_COLOUR, opacity=0.5)
    inside = height <= mudline + 1e-9
    known = {"rim": [], "soil_radius": float(radius[inside].max(initial=0.0))}
    if results.attrs.get("sea") == "dry":
        return known
    level = float(results.attrs.get("water_level_m", 0.0))
    surface = surface_mesh(shown.x, shown.y, level)
    middle = np.tile(SEA_COLOURS[1], (len(surface.vertices), 1))
    set_mesh(view["sea"]["surface"], surface, middle, opacity=0.78, gloss=70)
    rim = rim_of(len(shown.x), len(shown.y))
    set_mesh(view["sea"]["sides"], sides_mesh(surface, rim, mudline), WATER_COLOUR, opacity=0.16)
    return known | {"rim": rim.tolist()}


def draw_arrows(view: Any, shown: Frames) -> None:
    """Arrows of the load at the yaw bearing and of the soil's forces: upwards, of length 1."""
    size = float(shown.height[-1] - shown.height[0])
    if np.any(shown.top_force):
        set_mesh(view["arrows"]["top"], arrow(TOP_WIDTH * size), TOP_COLOUR)
    for k in range(len(shown.soil_height)):
        set_mesh(view["arrows"]["soil"][str(k)], arrow(SOIL_WIDTH * size), SOIL_COLOUR)


def arrow(radius: float) -> Mesh:
    """An arrow along z from 0 to 1, which the page stretches to its length; radius in m."""
    rings = [(radius, 0.0), (radius, 0.8), (2.6 * radius, 0.8), (1e-3 * radius, 1.0)]
    return loft(np.array([circle(r, z, _ARROW_FACETS) for r, z in rings]))


def surface_mesh(x: Array, y: Array, z: float) -> Mesh:
    """A level rectangle of points x (p,) by y (q,), seen from above."""
    p, q = len(x), len(y)
    points = np.column_stack([np.repeat(x, q), np.tile(y, p), np.full(p * q, z)])
    corner = np.arange(p * q).reshape(p, q)
    a, b, c, d = (
        part.ravel()
        for part in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:])
    )
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return Mesh(points, faces)


def rim_of(p: int, q: int) -> NDArray[np.intp]:
    """Numbers of the points on the rim of a rectangle of p by q, once around, the first again."""
    corner = np.arange(p * q).reshape(p, q)
    around = [corner[:-1, 0], corner[-1, :-1], corner[:0:-1, -1], corner[0, :0:-1], corner[:1, 0]]
    return np.concatenate(around)


def sides_mesh(surface: Mesh, rim: NDArray[np.intp], bottom: float) -> Mesh:
    """Walls from the rim of a surface down to a height in m."""
    top = surface.vertices[rim]
    below = top.copy()
    below[:, 2] = bottom
    count = len(rim)
    here = np.arange(count - 1)
    faces = [
        np.column_stack([here + count, here + count + 1, here + 1]),
        np.column_stack([here + count, here + 1, here]),
    ]
    return Mesh(np.concatenate([top, below]), np.concatenate(faces))


def displacement_factor(shown: Frames) -> int:
    """The largest enlargement that keeps the displacements within their share of the height."""
    largest = float(np.linalg.norm(shown.displacement, axis=2).max())
    room = _SHOWN_SHARE * float(shown.height[-1] - shown.height[0])
    fitting = [factor for factor in _FACTORS if factor * largest <= room]
    return max(fitting, default=1)


def _motion(shown: Frames, level: float) -> dict[str, Any]:
    """Frames for the page's script: small numbers as text, the sea in steps of a unit."""
    sea = shown.sea
    unit = 1.0 if sea is None else max(float(np.abs(sea).max()), 1e-3) / 32767
    return {
        "time": np.round(shown.time, 4).tolist(),
        "height": shown.height.tolist(),
        "displacement": _packed(shown.displacement, "<f4"),
        "elevation": np.round(shown.elevation, 3).tolist(),
        "moment": np.round(shown.moment / 1e6, 2).tolist(),
        "level": level,
        "sea": None if sea is None else _packed(np.round(sea / unit), "<i2"),
        "unit": unit,
        "colours": SEA_COLOURS.tolist(),
        **_loads(shown),
    }


def _loads(shown: Frames) -> dict[str, Any]:
    """Bending moment as shares of its largest, and forces as arrows in m."""
    length = ARROW_SHARE * float(shown.height[-1] - shown.height[0])
    bending, top, soil = (
        largest(part) for part in (shown.bending, shown.top_force, shown.soil_force)
    )
    shares = shown.bending / (bending or 1.0)
    return {
        "bending": _packed(np.round(65535 * shares), "<u2"),
        "ramp": colour_ramp().tolist(),
        "plain": PLAIN.tolist(),
        "top_force": np.round(shown.top_force / 1e6, 4).tolist() if top else None,
        "top_length": length / (top / 1e6 or 1.0),
        "soil_height": shown.soil_height.tolist(),
        "soil_force": _packed(shown.soil_force * (length / (soil or 1.0)), "<f4"),
    }


def largest(values: Array) -> float:
    """Largest size of vectors (f, ..., 3) or of plain values (f, m); zero of none."""
    sizes = np.linalg.norm(values, axis=-1) if values.shape[-1] == 3 else np.abs(values)
    return float(sizes.max(initial=0.0))


def colour_ramp() -> Array:
    """(64, 3) red, green and blue of shares from 0 to 1."""
    return np.round(mpl.colormaps[COLOUR_MAP](np.linspace(0, 1, 64))[:, :3], 4)


def _loads_in_words(results: xr.Dataset, shown: Frames) -> dict[str, str]:
    """What colours and arrows mean, and how large their largest is."""
    bending, top, soil = (
        largest(part) for part in (shown.bending, shown.top_force, shown.soil_force)
    )
    steps = ", ".join(mpl.colors.to_hex(colour) for colour in colour_ramp()[::4])
    return {
        "gradient": steps,
        "bending": f"{number(bending / 1e6, 3)} MN m",
        "top": f"applied tower-top load, at most {number(top / 1e6, 3)} MN" if top else "",
        "top_colour": f"#{TOP_COLOUR:06x}",
        "top_note": str(results.attrs.get("tower_top_load_holds", "")),
        "soil": f"soil on the pile, at most {number(soil / 1e6, 3)} MN a node" if soil else "",
        "soil_colour": f"#{SOIL_COLOUR:06x}",
    }


def _packed(values: Array, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def _charts(shown: Frames) -> list[dict[str, str]]:
    """Curves of the card: name, range and the points of a polyline, upright in its frame."""
    channels = [("tower top along x, m", shown.displacement[:, -1, 0])]
    if np.any(shown.elevation):
        channels.insert(0, ("surface at the axis, m", shown.elevation))
    if np.any(shown.top_force):
        channels.append(top_curve(shown))
    channels.append(("fore-aft moment, MN m", shown.moment[:, 1] / 1e6))
    result = []
    for name, values in channels:
        low, high = float(values.min()), float(values.max())
        # what hardly changes is drawn as a level line, not as its rounding
        half = max((high - low) / 2, _LEVEL * max(abs(low), abs(high)), 1e-12)
        across = np.linspace(0, _CHART[0], len(values))
        up = (_CHART[1] / 2 - 2) * (1 - (values - (low + high) / 2) / half) + 2
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(across, up, strict=True))
        span = f"{low:.3g} to {high:.3g}".replace("-", MINUS)
        result.append({"name": name, "range": span, "points": points})
    return result


def top_curve(shown: Frames) -> tuple[str, Array]:
    """Name and values (f,) in MN of the component of the tower-top load that grows largest."""
    component = int(np.argmax(np.abs(shown.top_force).max(axis=0)))
    return f"tower-top load along {'xyz'[component]}, MN", shown.top_force[:, component] / 1e6


def history_look(results: xr.Dataset, shown: Frames) -> dict[str, Any]:
    """Where the camera stands, for the page's script: directions as numbers, lengths in m."""
    meshes = rna_meshes(rotor_nacelle(results), 6.0)
    points = np.concatenate([mesh.vertices for mesh in meshes.values()])
    azimuth, elevation = np.radians(_VIEW_DEG)
    level = np.cos(elevation)
    # The corner of the mudline nearest to the camera appears below its middle, and enlarged.
    corner = float(shown.x[-1]) * (abs(np.cos(azimuth)) + abs(np.sin(azimuth)))
    ground = float(results.attrs["mudline_m"]) - 1.5 * corner * np.sin(elevation)
    low, high = min(float(shown.height[0]), ground), float(shown.height[-1] + points[:, 2].max())
    return {
        "field_of_view_deg": _FIELD_OF_VIEW_DEG,
        "from": [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)],
        "centre": (low + high) / 2,
        "half_height": 1.05 * (high - low) / 2,
        "half_breadth": max(float(np.abs(points[:, :2]).max()), 0.65 * float(np.ptp(shown.x))),
    }
