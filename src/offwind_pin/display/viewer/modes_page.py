"""Natural modes as a page of its own: choose them, and see up to four side by side."""

from __future__ import annotations

import base64
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from markupsafe import Markup

from offwind_pin.base.mode_labels import mode_family, mode_name
from offwind_pin.display.report.templates import environment
from offwind_pin.display.rotor_nacelle import rotor_nacelle
from offwind_pin.display.viewer.history_page import PLAIN, colour_ramp
from offwind_pin.display.viewer.meshcat_recorder import Recorder, viewer_licence, viewer_script
from offwind_pin.display.viewer.mode_frames import Shapes, shapes
from offwind_pin.display.viewer.mode_motion import PEAK_SHARE
from offwind_pin.display.viewer.scene import (
    AXIS_COLOUR,
    MUDLINE_COLOUR,
    RNA_COLOUR,
    WATER_COLOUR,
    light,
    set_mesh,
)
from offwind_pin.display.wording import foundation_name, water_level_name
from offwind_pin.structure.meshes import FACETS, circle, disc, loft
from offwind_pin.structure.rotor import rna_meshes

PLACES = 4
"""Modes side by side at most."""
VIEW_DEG = (-130.0, 8.0)
"""Azimuth of the camera from the x axis, and its elevation: both planes are seen obliquely."""
SPACING = 0.78
"""Distance of structures side by side over their height."""
_FIELD_OF_VIEW_DEG = 24.0
_DISC = 0.3
"""Radius of mudline and water drawn, over the height of the structure."""
_SPEEDS = (0.05, 0.1, 0.25, 0.5, 1, 2)
_FIRST_SPEED = 0.5


def render_modes(results: xr.Dataset, labels: list[str] | None = None) -> str:
    """HTML page of natural modes in motion; it needs no server and no network.

    Parameters
    ----------
    results : Dataset
        A dataset of natural modes, in memory or from ``results.nc``.
    labels : list of str, optional
        Modes side by side at first, up to four; by default the first that bend.

    Raises
    ------
    InputError
        As :func:`~offwind_pin.display.viewer.mode_frames.shapes`, or an unknown label.
    """
    shown = shapes(results)
    first = shown.chosen(labels, PLACES)
    recorder = Recorder()
    draw_places(recorder.visualizer(), results, shown)
    wet = results.attrs.get("sea") != "dry"
    told = str(results.attrs.get("surrogates", "none"))
    ramp = colour_ramp()
    return (
        environment()
        .get_template("modes.html")
        .render(
            turbine=str(results.attrs["turbine"]),
            foundation=foundation_name(str(results.attrs["foundation"])),
            case=str(results.attrs.get("case", "")),
            water=water_level_name(float(results.attrs.get("water_level_m", 0.0))) if wet else "",
            surrogates=[text for text in told.split(" | ") if text not in ("", "none")],
            gradient=", ".join(mpl.colors.to_hex(colour) for colour in ramp[::4]),
            water_colour=f"#{WATER_COLOUR:06x}",
            mudline_colour=f"#{MUDLINE_COLOUR:06x}",
            axis_colour=f"#{AXIS_COLOUR:06x}",
            speeds=_SPEEDS,
            speed=_FIRST_SPEED,
            most=PLACES,
            labels=shown.label,
            modes=_modes(shown) | {"ramp": ramp.tolist(), "plain": PLAIN.tolist(), "first": first},
            look=modes_look(results, shown),
            commands=[base64.b64encode(command).decode() for command in recorder.commands],
            licence=Markup(viewer_licence().replace("*/", "* /")),  # noqa: S704 (from the package)
            viewer_script=Markup(viewer_script()),  # noqa: S704 (from the package)
        )
    )


def draw_places(view: Any, results: xr.Dataset, shown: Shapes) -> None:
    """The structure at rest in each of four places, one upon the other until the page moves them.

    ``places/0/wall``, ``places/0/rna`` about the yaw bearing, ``places/0/site``; a ring of the
    wall is so many vertices that follow one another.
    """
    light(view)
    height, radius = shown.height, shown.radius
    size = float(height[-1] - height[0])
    rings = np.array([circle(r, z) for r, z in zip(radius, height, strict=True)])
    wall = loft(rings, capped=False)
    assemblies = rna_meshes(rotor_nacelle(results), 2 * float(radius[-1]))
    mudline = disc(_DISC * size, float(results.attrs["mudline_m"]))
    water = disc(_DISC * size, float(results.attrs.get("water_level_m", 0.0)))
    thin = 0.0014 * size
    axis = loft(np.array([circle(thin, height[0]), circle(thin, height[-1])]))
    for place in range(PLACES):
        part = view["places"][str(place)]
        set_mesh(part["wall"], wall, np.tile(PLAIN, (len(wall.vertices), 1)))
        for name, mesh in assemblies.items():
            set_mesh(part["rna"][name], mesh, RNA_COLOUR)
        set_mesh(part["site"]["mudline"], mudline, MUDLINE_COLOUR, opacity=0.42)
        set_mesh(part["site"]["axis_at_rest"], axis, AXIS_COLOUR)
        if results.attrs.get("sea") != "dry":
            set_mesh(part["site"]["water"], water, WATER_COLOUR, opacity=0.26)


def _modes(shown: Shapes) -> dict[str, Any]:
    """What the page's script must know of the modes."""
    torsion = [mode_family(label) == "T" for label in shown.label]
    peaks = [
        f"{np.degrees(peak):.0f}°" if turns else f"{peak:.1f} m"
        for peak, turns in zip(shown.peak, torsion, strict=True)
    ]
    return {
        "label": shown.label,
        "name": [mode_name(label) for label in shown.label],
        "frequency": shown.frequency_hz.tolist(),
        "damping": shown.damping_ratio.tolist(),
        "torsion": torsion,
        "peak": peaks,
        "facets": FACETS,
        "height": shown.height.tolist(),
        "motion": np.round(shown.motion, 5).tolist(),
        "share": np.round(shown.share, 4).tolist(),
    }


def modes_look(results: xr.Dataset, shown: Shapes) -> dict[str, Any]:
    """Where the camera stands, for the page's script: directions as numbers, lengths in m."""
    meshes = rna_meshes(rotor_nacelle(results), 2 * float(shown.radius[-1]))
    points = np.concatenate([mesh.vertices for mesh in meshes.values()])
    size = float(shown.height[-1] - shown.height[0])
    low = min(float(shown.height[0]) - 0.05 * size, float(results.attrs["mudline_m"]) - 0.08 * size)
    high = float(shown.height[-1] + points[:, 2].max())
    azimuth, elevation = np.radians(VIEW_DEG)
    right = np.array([-np.sin(azimuth), np.cos(azimuth)])
    breadth = float(np.abs(points[:, :2] @ right).max()) + PEAK_SHARE * size
    level = np.cos(elevation)
    return {
        "field_of_view_deg": _FIELD_OF_VIEW_DEG,
        "from": [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)],
        "centre": (low + high) / 2,
        "half_height": (high - low) / 2,
        "half_breadth": max(breadth, _DISC * size),
        "depth": breadth,
        "right": right.tolist(),
        "spacing": SPACING * size,
        "low": low,
    }
