"""Meshes as a flat picture: seen through a camera, lit, and painted from the back to the front."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from offwind_pin.base.definition import Array
from offwind_pin.structure.meshes import Mesh

_LIGHTS = ((0.36, (-0.35, -0.85, 0.55)), (0.12, (0.9, -0.2, 0.3)))
"""Strength and direction of what lights a surface besides light from everywhere."""
_AMBIENT = 0.62


@dataclass(frozen=True, eq=False)
class Camera:
    """Where a picture is seen from.

    Attributes
    ----------
    centre : (3,) array, m
        The middle of the picture.
    towards : (3,) array
        Unit vector from there to the camera.
    distance : float, m
        Between them.
    """

    centre: Array
    towards: Array
    distance: float

    @property
    def axes(self) -> Array:
        """(3, 3) rows right, up and towards the camera."""
        right = np.cross([0.0, 0.0, 1.0], self.towards)
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(self.towards, right), self.towards])

    def project(self, points: Array) -> Array:
        """(..., 3) right and up as tangents of angles to the line of sight, and distance in m."""
        seen = (np.asarray(points, dtype=float) - self.centre) @ self.axes.T
        away = self.distance - seen[..., 2]
        return np.stack([seen[..., 0] / away, seen[..., 1] / away, away], axis=-1)


@dataclass(frozen=True, eq=False)
class Surface:
    """A mesh with colours, red, green and blue from 0 to 1.

    colour : (3,), or (n, 3) of its vertices
    opacity : a solid, with 1, is seen from outside only; what is translucent from both sides
    """

    mesh: Mesh
    colour: Array
    opacity: float = 1.0


def paint(camera: Camera, surfaces: Sequence[Surface]) -> tuple[Array, Array]:
    """Triangles of surfaces in the order in which they are painted.

    Returns
    -------
    corners : (t, 3, 2) array
        As :meth:`Camera.project` has them.
    colours : (t, 4) array
        Red, green, blue and opacity.
    """
    corners, colours, depths = [], [], []
    for surface in surfaces:
        triangle = surface.mesh.vertices[surface.mesh.faces]
        seen = camera.project(triangle)
        edge = seen[:, 1:, :2] - seen[:, :1, :2]
        turn = edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0]
        shown = turn > 0 if surface.opacity == 1 else turn != 0
        normal = np.cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0])
        normal = np.where(turn < 0, -1.0, 1.0)[:, None] * normal
        bright = _brightness(normal[shown])
        plain = np.broadcast_to(surface.colour, surface.mesh.vertices.shape)
        face = plain[surface.mesh.faces[shown]].mean(axis=1) * bright[:, None]
        corners.append(seen[shown, :, :2])
        alpha = np.full((len(face), 1), surface.opacity)
        colours.append(np.hstack([np.clip(face, 0.0, 1.0), alpha]))
        depths.append(seen[shown, :, 2].mean(axis=1))
    order = np.argsort(-np.concatenate(depths), kind="stable")
    return np.concatenate(corners)[order], np.concatenate(colours)[order]


def smallest_turn(start: Array, direction: Array) -> Array:
    """(3, 3) the smallest rotation of an axis (3,) into a direction (3,) of any length."""
    along = direction / np.linalg.norm(direction)
    axis = np.cross(start, along)
    sine = np.linalg.norm(axis)
    if sine < 1e-12:  # either is the same, or the opposite, by half a turn about any normal
        axis = np.cross(start, np.roll(start, 1))
        sine = np.linalg.norm(axis)
    angle = np.arccos(np.clip(start @ along, -1.0, 1.0))
    return np.asarray(Rotation.from_rotvec(angle * axis / sine).as_matrix())


def _brightness(normal: Array) -> Array:
    """(t,) of faces by their normals, of any length."""
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    unit = np.divide(normal, size, out=np.zeros_like(normal), where=size > 0)
    bright = np.full(len(unit), _AMBIENT)
    for strength, direction in _LIGHTS:
        along = np.asarray(direction) / np.linalg.norm(direction)
        bright += strength * np.maximum(unit @ along, 0.0)
    return bright
