"""Springs of a foundation and tuned mass dampers as things to draw, from results alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from offwind_pin.base.definition import Array
from offwind_pin.structure.meshes import Mesh, circle, damper_disc, loft, tube

_REACH = 0.045
"""Length of a spring at rest over the height of the structure."""
_CLOSEST = 0.022
"""Smallest distance between drawn soil springs over the height of the structure."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Springs:
    """Springs between fixed anchors and points that move with the axis.

    Attributes
    ----------
    height : (s,) array, m
        At which the axis carries the moving ends.
    offset : (s, 3) array, m
        Of the moving ends at rest from the axis.
    anchor : (s, 3) array, m
    """

    height: Array
    offset: Array
    anchor: Array

    def symbols(self, ends: Array) -> tuple[Array, Array]:
        """Middle and direction of each spring, as long as the spring.

        The directions have a positive sum of components, so that a symbol never turns over.

        Parameters
        ----------
        ends : (s, 3) array, m
            The moving ends.

        Returns
        -------
        middle, direction : (s, 3) array, m
        """
        along = ends - self.anchor
        return (ends + self.anchor) / 2, along * np.sign(along.sum(axis=1, keepdims=True))


def foundation_springs(results: xr.Dataset, height: Array, radius: Array, plane: Array) -> Springs:
    """Springs that restrain a structure, in the directions that matter for a mode.

    Along the pile a pair at each soil node, thinned by :func:`node_step`; at the foot of a chain
    with a flexible root one vertical spring, and two pairs where no soil acts along the pile.

    Parameters
    ----------
    results : Dataset
        Natural modes.
    height, radius : (r,) array, m
        Of the rings of the wall.
    plane : (3,) array
        Horizontal unit vector in the plane of the motion.
    """
    size = float(height[-1] - height[0])
    reach = _REACH * size
    levels, directions = np.zeros(0), [plane]
    flexible = results.attrs["root"] == "flexible"
    if "spring_height" in results:
        nodes = np.asarray(results.spring_height.values, dtype=float)
        levels = nodes[:: node_step(nodes, size)]
    elif flexible:
        levels, directions = height[:1], [plane, np.cross(_UP, plane)]
    ends = [
        (level, inner * sign * direction, (inner + reach) * sign * direction + level * _UP)
        for level, inner in zip(levels, np.interp(levels, height, radius), strict=True)
        for direction in directions
        for sign in (1, -1)
    ]
    if flexible:
        ends.append((height[0], np.zeros(3), (height[0] - reach) * _UP))
    at, offset, anchor = zip(*ends, strict=True) if ends else ((), (), ())
    return Springs(np.array(at), np.array(offset).reshape(-1, 3), np.array(anchor).reshape(-1, 3))


def node_step(nodes: Array, structure_height: float) -> int:
    """Number of soil nodes from one drawn spring to the next, so that they can be distinguished.

    It divides the pile evenly: the first and the last node are always drawn.
    """
    closest = _CLOSEST * structure_height
    gaps = len(nodes) - 1
    steps = (step for step in range(1, gaps + 1) if gaps % step == 0)
    spacing = abs(nodes[-1] - nodes[0]) / max(gaps, 1)
    return next((step for step in steps if step * spacing >= closest), max(gaps, 1))


def spring_symbol(results: xr.Dataset, size: float) -> Mesh:
    """Symbol of a spring of length 1 along x about the origin, for a structure ``size`` m high."""
    width = 0.011 if "spring_height" in results else 0.022
    return zigzag(width * size, 0.0014 * size)


def zigzag(width: float, radius: float, windings: int = 4) -> Mesh:
    """A rod bent in the x-z plane, of length 1 along x about the origin.

    Parameters
    ----------
    width, radius : float, m
        Of the bends and of the rod.
    """
    bends = np.linspace(-0.3, 0.3, 2 * windings + 1)
    side = np.zeros(2 * windings + 1)
    side[1:-1:2], side[2:-1:2] = width / 2, -width / 2
    x = np.concatenate([[-0.5], bends, [0.5]])
    z = np.concatenate([[0.0], side, [0.0]])
    return tube(np.column_stack([x, np.zeros_like(x), z]), radius)


def damper_mesh(diameter: float) -> Mesh:
    """Disc of a tuned mass damper about the origin, wider than the structure around it."""
    radius, thickness = damper_disc(diameter)
    return loft(np.array([circle(radius, -thickness / 2), circle(radius, thickness / 2)]))
