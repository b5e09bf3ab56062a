"""Triangle meshes: surfaces lofted through closed loops of points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.structure.chain import Chain, NDArrayInt
from offwind_pin.structure.frustum import Frustum
from offwind_pin.structure.section import frusta

FACETS = 32
"""Number of sides of round parts; few suffice, since normals are smoothed around them."""

_DISC = (0.6, 0.2)
"""Radius and thickness of the disc drawn for a tuned mass damper, over the structure's diameter
there; it is visible outside the wall."""


@dataclass(frozen=True)
class Mesh:
    """Triangles, anticlockwise seen from outside.

    vertices : (n, 3) in m; faces : (m, 3) indices of vertices. A vertex has one normal, the mean of
    its faces': an edge is sharp where its vertices are doubled.
    """

    vertices: Array
    faces: NDArrayInt

    @property
    def volume(self) -> float:
        """Enclosed volume in m3; positive if the triangles face outwards."""
        a, b, c = (self.vertices[self.faces[:, i]] for i in range(3))
        return float(np.sum(a * np.cross(b, c)) / 6)

    def moved(self, transform: Array) -> Mesh:
        """The mesh after a homogeneous transform (4, 4)."""
        return Mesh(self.vertices @ transform[:3, :3].T + transform[:3, 3], self.faces)

    @staticmethod
    def combine(parts: Sequence[Mesh]) -> Mesh:
        """Combine meshes."""
        starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
        return Mesh(
            np.concatenate([part.vertices for part in parts]),
            np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=True)]),
        )

    def to_stl(self) -> bytes:
        """The mesh as a binary STL file."""
        corner = self.vertices[self.faces]
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        record = np.zeros(
            len(corner), dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("unused", "<u2")]
        )
        record["normal"] = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
        record["corner"] = corner
        count = np.array(len(corner), dtype="<u4").tobytes()
        return b"offwind-pin body".ljust(80, b" ") + count + record.tobytes()


def body_meshes(turbine: Turbine, chain: Chain) -> dict[str, Mesh]:
    """Hollow frusta of each rigid body of a chain, in its frame, by name from the base upwards."""
    result = {}
    for k, name in enumerate(chain.body_name):
        shells = frusta(turbine, chain.cut[k], chain.cut[k + 1])
        result[name] = Mesh.combine(
            [hollow_frustum(base - chain.origin[k], shell) for base, shell in shells]
        )
    return result


def damper_disc(diameter: float) -> tuple[float, float]:
    """Radius and thickness in m of the disc that represents a tuned mass damper in pictures.

    Parameters
    ----------
    diameter : float, m
        Of the structure at the damper's height.
    """
    return _DISC[0] * diameter, _DISC[1] * diameter


def loft(sections: Array, *, capped: bool = True) -> Mesh:
    """Surface through closed loops, smooth along and around; sharp at its two flat caps.

    Parameters
    ----------
    sections : (s, n, 3) array
        Points of each loop, anticlockwise seen from the last loop.
    capped : bool
        Whether to close the first and the last loop with a fan of triangles.
    """
    count, around = sections.shape[:2]
    low = np.arange((count - 1) * around).reshape(count - 1, around)
    quads = low, np.roll(low, -1, axis=1), np.roll(low + around, -1, axis=1), low + around
    a, b, c, d = (corner.ravel() for corner in quads)
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    side = Mesh(sections.reshape(-1, 3), faces)
    if not capped:
        return side
    return Mesh.combine([_fan(sections[0, ::-1]), side, _fan(sections[-1])])


def hollow_frustum(base: float, shell: Frustum) -> Mesh:
    """Closed hollow frustum on the z axis, its lower rim at height ``base`` in m."""
    top = base + shell.height
    rims = [
        circle(shell.outer_bottom, base),
        circle(shell.outer_top, top),
        circle(shell.inner_top, top),
        circle(shell.inner_bottom, base),
    ]
    pairs = zip(rims, [*rims[1:], rims[0]], strict=True)
    return Mesh.combine([loft(np.array(pair), capped=False) for pair in pairs])


def circle(radius: float, z: float, facets: int = FACETS) -> Array:
    """(facets, 3) points of a horizontal circle about the z axis."""
    angle = np.linspace(0, 2 * np.pi, facets, endpoint=False)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), np.full(facets, z)])


def tube(path: Array, radius: float, sides: int = 5) -> Mesh:
    """Tube of constant radius along a path (s, 3) in the x-z plane that always advances in x."""
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.array([0.0, 1.0, 0.0])
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None]
    sections = [
        point + radius * (np.cos(angle) * across + np.sin(angle) * np.cross(tangent, across))
        for point, tangent in zip(path, along, strict=True)
    ]
    return loft(np.array(sections))


def box(low: Sequence[float], high: Sequence[float]) -> Mesh:
    """Cuboid between two opposite corners, with sharp edges."""
    corners = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return Mesh.combine([_fan(corners[side]) for side in sides])


def _fan(loop: Array) -> Mesh:
    """Triangles from the first point of a convex loop (n, 3)."""
    later = np.arange(1, len(loop) - 1)
    return Mesh(loop, np.column_stack([np.zeros_like(later), later, later + 1]))
