"""Colours, light and meshes of the scenes that Meshcat shows."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.display.viewer.meshcat_recorder import meshcat_geometry
from offwind_pin.structure.meshes import Mesh

MUDLINE_COLOUR, WATER_COLOUR, AXIS_COLOUR, RNA_COLOUR = 0xA07C4B, 0x3D8FD1, 0x9AA5B1, 0xE9ECEF
SPRING_COLOUR, CLAMP_COLOUR, DAMPER_COLOUR = 0x46505A, 0x5A5F66, 0xBF3A2B
PLAIN = np.array([0xE9, 0xEC, 0xEF]) / 255
"""Colour of the wall where no quantity colours it."""
FIELD_OF_VIEW_DEG = 24.0
RING = 2.5
"""Largest distance in m between the rings of the wall."""


def colour_ramp() -> Array:
    """(64, 3) red, green and blue of shares from 0 to 1."""
    return np.round(mpl.colormaps["viridis"](np.linspace(0, 1, 64))[:, :3], 4)


def ramp_gradient() -> str:
    """Steps of :func:`colour_ramp` for a gradient in CSS."""
    return ", ".join(mpl.colors.to_hex(colour) for colour in colour_ramp()[::4])


def css(colour: int) -> str:
    """``#a07c4b`` for 0xA07C4B."""
    return f"#{colour:06x}"


def rgb(colour: int) -> Array:
    """(3,) red, green and blue from 0 to 1 of a colour such as 0xA07C4B."""
    return np.array([colour >> 16 & 255, colour >> 8 & 255, colour & 255]) / 255


def view_direction(azimuth_deg: float, elevation_deg: float) -> Array:
    """(3,) unit vector from the scene towards the camera; azimuth from the x axis."""
    azimuth, elevation = np.radians((azimuth_deg, elevation_deg))
    level = np.cos(elevation)
    return np.array([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)])


def light(view: Any) -> None:
    """Light and sky for something 300 m tall; meshcat's own suit a robot of 2 m."""
    view["/Background"].set_property("top_color", [0.80, 0.88, 0.95])
    view["/Background"].set_property("bottom_color", [0.97, 0.98, 0.99])
    for helper in ("/Grid", "/Axes"):
        view[helper].set_property("visible", value=False)
    lights = {
        "AmbientLight": (0.58, None),
        "FillLight": (0.5, [-400.0, -1000.0, 700.0]),
        "PointLightPositiveX": (0.22, [1500.0, -600.0, 300.0]),
        "PointLightNegativeX": (0.12, [-1500.0, 300.0, -200.0]),
    }
    for name, (intensity, position) in lights.items():
        light = view[f"/Lights/{name}/<object>"]
        light.set_property("intensity", intensity)
        if position is not None:
            light.set_property("position", position)
        if name.startswith("Point"):
            light.set_property("distance", 0)


def set_mesh(
    part: Any, mesh: Mesh, colour: int | Array, opacity: float = 1.0, *, gloss: int = 12
) -> None:
    """Show a mesh at a place in the viewer's tree.

    Parameters
    ----------
    colour : int or (n, 3) array
        Such as 0x3D8FD1, or red, green and blue from 0 to 1 of its vertices.
    """
    # A translucent surface is seen from both sides, and what lies behind it must still be drawn, so
    # it leaves no mark in depth.
    solid = opacity == 1.0
    material = meshcat_geometry.MeshPhongMaterial(
        color=colour if isinstance(colour, int) else 0xFFFFFF,
        vertexColors=not isinstance(colour, int),
        opacity=opacity,
        side=0 if solid else 2,
        depthWrite=solid,
        shininess=gloss,
        specular=0x222222,
    )
    colours = None if isinstance(colour, int) else colour
    geometry = meshcat_geometry.TriangularMeshGeometry(mesh.vertices, mesh.faces, color=colours)
    part.set_object(geometry, material)
