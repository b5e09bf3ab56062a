"""A time history as a page of its own: the structure moves in its sea, from results alone."""

from __future__ import annotations

import base64
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.display.rotor_nacelle import assembly
from offwind_pin.display.viewer.history_frames import Frames, frames, outline
from offwind_pin.display.viewer.meshcat_recorder import Recorder
from offwind_pin.display.viewer.scene import (
    FIELD_OF_VIEW_DEG,
    MUDLINE_COLOUR,
    PLAIN,
    RING,
    RNA_COLOUR,
    WATER_COLOUR,
    colour_ramp,
    css,
    light,
    ramp_gradient,
    set_mesh,
    view_direction,
)
from offwind_pin.display.wording import fixed, foundation_name, number, surrogate_notes
from offwind_pin.structure.meshes import Mesh, circle, loft

DURATION = 60.0
"""Default duration of a page in s."""

_VIEW_DEG = (-122.0, 11.0)
"""Azimuth of the camera from the x axis, and its elevation."""
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
_SPEEDS = (0.25, 0.5, 1, 2, 5, 10)
_LEVEL = 1e-3
"""Half the range of a curve, over its largest value, below which it counts as constant."""
_CHART = (276, 34)
"""Breadth and height of a curve in the card."""


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
    return recorder.page(
        "history.html",
        turbine=str(results.attrs["turbine"]),
        foundation=foundation_name(str(results.attrs["foundation"])),
        case=str(results.attrs.get("case", "time history")),
        waves=str(results.attrs.get("waves", "")) if wet else "",
        water=f"sea, mean level {fixed(level, 2, sign=level != 0)} m" if wet else "",
        sea_gradient=", ".join(mpl.colors.to_hex(colour) for colour in SEA_COLOURS),
        left_out=shown.sea is None and bool(np.any(shown.elevation)),
        surrogates=surrogate_notes(results.attrs),
        speeds=_SPEEDS,
        gradient=ramp_gradient(),
        loads=_loads_in_words(results, shown),
        factors=_FACTORS,
        factor=displacement_factor(shown),
        charts=_charts(results, shown),
        mudline_colour=css(MUDLINE_COLOUR),
        breadth=_CHART[0],
        height=_CHART[1],
        motion=_motion(shown, level) | scene,
        look=history_look(results, shown),
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
    height, radius = outline(results, RING)
    rings = np.array([circle(r, z) for z, r in zip(height, radius, strict=True)])
    wall = loft(rings, capped=False)
    set_mesh(view["structure"]["wall"], wall, np.tile(PLAIN, (len(wall.vertices), 1)))
    for name, mesh in assembly(results, 2 * float(radius[-1])).items():
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


def _loads_in_words(results: xr.Dataset, shown: Frames) -> dict[str, str]:
    """What colours and arrows mean, and how large their largest is."""
    bending, top, soil = (
        largest(part) for part in (shown.bending, shown.top_force, shown.soil_force)
    )
    return {
        "bending": f"{number(bending / 1e6, 3)} MN m",
        "top": f"applied tower-top load, at most {number(top / 1e6, 3)} MN" if top else "",
        "top_colour": css(TOP_COLOUR),
        "top_note": str(results.attrs.get("tower_top_load_holds", "")),
        "soil": f"soil on the pile, at most {number(soil / 1e6, 3)} MN per node" if soil else "",
        "soil_colour": css(SOIL_COLOUR),
    }


def _packed(values: Array, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def curves(results: xr.Dataset, shown: Frames) -> tuple[Array, list[tuple[str, Array]]]:
    """Curves beside the scene: times (t,) of all outputs in the part shown, names and values (t,).

    There are fewer frames than outputs, so that frames alone would cut off peaks.
    """
    part = results.sel(time=slice(shown.time[0], shown.time[-1]))
    elevation = np.asarray(part.wave_elevation.values, dtype=float)
    top = np.asarray(part.displacement.values[:, -1, 0], dtype=float)
    force = np.asarray(part.tower_top_load.values[:, :3], dtype=float) / 1e6
    moment = np.asarray(part.mudline_moment.sel(direction="y").values, dtype=float) / 1e6
    channels = [("surface at the axis, m", elevation)] if np.any(elevation) else []
    channels.append(("tower top along x, m", top))
    if np.any(force):
        component = int(np.argmax(np.abs(force).max(axis=0)))
        channels.append((f"tower-top load along {'xyz'[component]}, MN", force[:, component]))
    channels.append(("mudline moment My, MN m", moment))
    return np.asarray(part.time.values, dtype=float), channels


def range_in_words(values: Array) -> str:
    """Smallest and largest value."""
    return f"{number(float(values.min()), 3)} to {number(float(values.max()), 3)}"


def _charts(results: xr.Dataset, shown: Frames) -> list[dict[str, str]]:
    """Curves of the card: name, range and the points of a polyline, upright in its frame."""
    result = []
    time, channels = curves(results, shown)
    across = _CHART[0] * (time - time[0]) / (time[-1] - time[0])
    for name, values in channels:
        low, high = float(values.min()), float(values.max())
        # what hardly changes is drawn as a level line, not as its rounding
        half = max((high - low) / 2, _LEVEL * max(abs(low), abs(high)), 1e-12)
        up = (_CHART[1] / 2 - 2) * (1 - (values - (low + high) / 2) / half) + 2
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(across, up, strict=True))
        result.append({"name": name, "range": range_in_words(values), "points": points})
    return result


def history_look(results: xr.Dataset, shown: Frames) -> dict[str, Any]:
    """Where the camera stands, for the page's script: directions as numbers, lengths in m."""
    meshes = assembly(results, 6.0)
    points = np.concatenate([mesh.vertices for mesh in meshes.values()])
    azimuth, elevation = np.radians(_VIEW_DEG)
    # The corner of the mudline nearest to the camera appears below its middle, and enlarged.
    corner = float(shown.x[-1]) * (abs(np.cos(azimuth)) + abs(np.sin(azimuth)))
    ground = float(results.attrs["mudline_m"]) - 1.5 * corner * np.sin(elevation)
    low, high = min(float(shown.height[0]), ground), float(shown.height[-1] + points[:, 2].max())
    return {
        "field_of_view_deg": FIELD_OF_VIEW_DEG,
        "from": view_direction(*_VIEW_DEG).tolist(),
        "centre": (low + high) / 2,
        "half_height": 1.05 * (high - low) / 2,
        "half_breadth": max(float(np.abs(points[:, :2]).max()), 0.65 * float(np.ptp(shown.x))),
    }
