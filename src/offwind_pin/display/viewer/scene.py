"""A system drawn with meshcat: structure, rotor, springs, sea and ground, and a mode at work."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from scipy.spatial.transform import Rotation

from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.base.definition import Array
from offwind_pin.display.viewer.meshcat_recorder import meshcat_animation, meshcat_geometry
from offwind_pin.display.viewer.mode_motion import FRAMES, ModeMotion
from offwind_pin.display.viewer.springs import Spring, foundation_springs, zigzag
from offwind_pin.dynamics.system import System
from offwind_pin.structure.meshes import (
    Mesh,
    body_meshes,
    box,
    circle,
    damper_disc,
    disc,
    loft,
)
from offwind_pin.structure.rotor import rna_meshes
from offwind_pin.structure.section import frusta, outer_diameter

COLOUR_MAP = "viridis"
CYCLE = 4.0
"""Seconds that one cycle takes on the screen."""

MUDLINE_COLOUR, WATER_COLOUR, SPRING_COLOUR = 0xA07C4B, 0x3D8FD1, 0x46505A
AXIS_COLOUR = 0x9AA5B1
RNA_COLOUR, _BLOCK_COLOUR, _STRIPE_COLOUR = 0xE9ECEF, 0x5A5F66, 0x20242A
_DAMPER_COLOUR = 0xBF3A2B
_MOTION_PLANE = {"SS": np.array([0.0, 1.0, 0.0])}
_ALONG_X = np.array([1.0, 0.0, 0.0])


def draw_mode(view: Any, system: System, motion: ModeMotion) -> None:
    """Draw a system and set a mode going, endlessly.

    Parameters
    ----------
    view : object
        A ``meshcat.Visualizer``.
    """
    springs = foundation_springs(system, _MOTION_PLANE.get(motion.family, _ALONG_X))
    light(view)
    draw_bodies(view, system, motion)
    draw_site(view, system)
    draw_springs(view, system, springs)
    draw_dampers(view, system, motion)
    clips = _body_clips(view, system, motion) | _spring_clips(view, springs, motion)
    clips |= _damper_clips(view, system, motion)
    view.set_animation(meshcat_animation.Animation(clips), repetitions=np.inf)


def draw_bodies(view: Any, system: System, motion: ModeMotion) -> None:
    """One object for each rigid body, coloured by its amplitude, and the rotor-nacelle assembly.

    The latter hangs below the last body in the tree of objects, and so moves with it. Torsion does
    not move the outline of a round tower: there the bodies carry stripes.
    """
    chain = system.chain
    for k, (name, mesh) in enumerate(body_meshes(system.turbine, chain).items()):
        part = view["turbine"][name]
        colour = as_hex(mpl.colormaps[COLOUR_MAP](float(motion.share[k])))
        set_mesh(part["wall"], mesh, colour)
        if motion.family == "T":
            set_mesh(part["stripes"], _stripes(system, k), _STRIPE_COLOUR)
        part.set_transform(motion.poses[0, k])
    seat = np.eye(4)
    seat[2, 3] = chain.top - chain.origin[-1]
    rna = view["turbine"][chain.body_name[-1]]["rna"]
    rna.set_transform(seat)
    diameter = float(outer_diameter(system.turbine, np.array([chain.top]))[0])
    for name, mesh in rna_meshes(system.turbine.rna, diameter).items():
        set_mesh(rna[name], mesh, RNA_COLOUR)


def draw_dampers(view: Any, system: System, motion: ModeMotion) -> None:
    """A disc for each tuned mass damper, wider than the structure."""
    for d, mass in enumerate(system.chain.tuned_masses):
        radius, thickness = damper_disc(system.turbine, mass)
        ends = [circle(radius, -thickness / 2), circle(radius, thickness / 2)]
        part = view["dampers"][mass.name]
        set_mesh(part, loft(np.array(ends)), _DAMPER_COLOUR)
        part.set_transform(motion.sliding[0, d])


def draw_site(view: Any, system: System) -> None:
    """Mudline and water level as translucent discs, the axis at rest, a block if it is clamped."""
    chain, mudline = system.chain, system.turbine.site.mudline
    height = chain.top - chain.base
    radius = 0.3 * height
    set_mesh(view["site"]["mudline"], disc(radius, mudline), MUDLINE_COLOUR, opacity=0.42)
    level = 0.0 if system.sea is None else system.sea.water_level
    set_mesh(view["site"]["still_water"], disc(radius, level), WATER_COLOUR, opacity=0.26)
    thin = 0.0014 * height
    axis = loft(np.array([circle(thin, chain.base), circle(thin, chain.top)]))
    set_mesh(view["site"]["axis_at_rest"], axis, AXIS_COLOUR)
    if system.foundation.root is None:
        half, deep = 0.045 * height, 0.035 * height
        block = box([-half, -half, chain.base - deep], [half, half, chain.base])
        set_mesh(view["site"]["clamp"], block, _BLOCK_COLOUR)


def draw_springs(view: Any, system: System, springs: list[Spring]) -> None:
    """Springs as bent rods, each in axes with x from its anchor to its body."""
    height = system.chain.top - system.chain.base
    width = (0.011 if soil_springs(system) else 0.022) * height
    for spring in springs:
        symbol = zigzag(spring.rest_length, width, radius=0.0014 * height)
        set_mesh(view["springs"][spring.name], symbol, SPRING_COLOUR)


def view_extent(system: System) -> tuple[float, float, float]:
    """Lowest and highest height in m that a view must show, and half its breadth in m."""
    chain, rna = system.chain, system.turbine.rna
    diameter = float(outer_diameter(system.turbine, np.array([chain.top]))[0])
    points = np.concatenate([mesh.vertices for mesh in rna_meshes(rna, diameter).values()])
    height = chain.top - chain.base
    breadth = max(float(np.abs(points[:, :2]).max()), 0.3 * height)
    low = min(chain.base, system.turbine.site.mudline) - 0.05 * height
    return low, chain.top + max(float(points[:, 2].max()), 0.05 * height), breadth


def _body_clips(view: Any, system: System, motion: ModeMotion) -> dict[Any, Any]:
    """Animation of each body, by its path."""
    clips = {}
    for k, name in enumerate(system.chain.body_name):
        pose = motion.poses[:, k]
        clips[view["turbine"][name].path] = _clip(
            position=pose[:, :3, 3], quaternion=_quaternion(pose[:, :3, :3])
        )
    return clips


def _damper_clips(view: Any, system: System, motion: ModeMotion) -> dict[Any, Any]:
    """Animation of each tuned mass damper, by its path."""
    clips = {}
    for d, mass in enumerate(system.chain.tuned_masses):
        pose = motion.sliding[:, d]
        clips[view["dampers"][mass.name].path] = _clip(
            position=pose[:, :3, 3], quaternion=_quaternion(pose[:, :3, :3])
        )
    return clips


def _spring_clips(view: Any, springs: list[Spring], motion: ModeMotion) -> dict[Any, Any]:
    """Animation of each spring, by its path: it turns about its anchor and changes its length."""
    clips = {}
    for spring in springs:
        part = view["springs"][spring.name]
        part.set_property("position", spring.anchor.tolist())
        rotation, length = spring.stretch(motion.poses)
        stretch = length / spring.rest_length
        scale = np.column_stack([stretch, np.ones((len(stretch), 2))])
        clips[part.path] = _clip(quaternion=_quaternion(rotation), scale=scale)
    return clips


def _clip(**tracks: Array) -> Any:
    """Animation of properties, each with one row for each frame."""
    kinds = {"position": "vector3", "scale": "vector3", "quaternion": "quaternion"}
    frames = list(range(FRAMES + 1))
    return meshcat_animation.AnimationClip(
        {
            name: meshcat_animation.AnimationTrack(name, kinds[name], frames, values.tolist())
            for name, values in tracks.items()
        },
        fps=FRAMES / CYCLE,
    )


def _quaternion(rotation: Array) -> Array:
    """(f, 4) quaternions x, y, z, w of rotations (f, 3, 3)."""
    return np.asarray(Rotation.from_matrix(rotation).as_quat())


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

    colour : one such as 0x3D8FD1, or red, green and blue (n, 3) from 0 to 1 of its vertices
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


def _stripes(system: System, k: int) -> Mesh:
    """Four strips along the wall of a body, dark to stand out where it turns."""
    low, high = system.chain.cut[k : k + 2]
    strips = []
    for base, shell in frusta(system.turbine, low, high):
        z = base - system.chain.origin[k]
        for turn in np.arange(4) * np.pi / 2 + np.pi / 4:
            angle = turn + np.array([-0.12, 0.12])
            rims = []
            for radius, level in ((shell.outer_bottom, z), (shell.outer_top, z + shell.height)):
                points = 1.02 * radius * np.column_stack([np.cos(angle), np.sin(angle)])
                rims.append(np.column_stack([points, np.full(2, level)]))
            strips.append(loft(np.array(rims), capped=False))
    return Mesh.combine(strips)


def as_hex(rgba: tuple[float, ...]) -> int:
    red, green, blue = (round(255 * part) for part in rgba[:3])
    return (red << 16) + (green << 8) + blue
