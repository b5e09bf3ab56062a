"""Springs of a foundation as things to draw: each between a fixed anchor and a body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.base.definition import Array
from offwind_pin.dynamics.system import System
from offwind_pin.loads.soil.springs.elastic import SoilSprings
from offwind_pin.structure.meshes import Mesh, tube
from offwind_pin.structure.section import outer_diameter

_X, _Y, _Z = np.eye(3)
_CLOSEST = 0.022
"""Least distance between drawn soil springs over the structure's height."""


@dataclass(frozen=True)
class Spring:
    """A spring from ``anchor`` (3,) to the point ``tip`` (3,) in the frame of ``body``, in m.

    rest_length : distance between the two in the undeformed structure, in m
    """

    name: str
    anchor: Array
    body: int
    tip: Array
    rest_length: float

    def stretch(self, poses: Array) -> tuple[Array, Array]:
        """How the spring lies at poses (f, N + 1, 4, 4) of the bodies.

        Returns
        -------
        rotation : (f, 3, 3) array
            That turns x along the spring.
        length : (f,) array, m
        """
        pose = poses[:, self.body]
        span = pose[:, :3, :3] @ self.tip + pose[:, :3, 3] - self.anchor
        length = np.linalg.norm(span, axis=1)
        along = span / length[:, None]
        # The windings lie in the vertical plane of the spring; a vertical one has no such plane.
        side = np.cross(_Z if abs(along[0, 2]) < 0.7 else _X, along)
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        return np.stack([along, side, np.cross(along, side)], axis=2), length


def foundation_springs(system: System, lateral: Array) -> list[Spring]:
    """Springs that hold a structure, in the directions that matter for a mode.

    Along the pile a pair at each soil node, thinned by :func:`node_step`; at the foot of a chain
    whose root moves, one vertical spring, and two pairs where no soil acts along the pile.

    Parameters
    ----------
    lateral : (3,) array
        Horizontal unit vector in the plane of the motion.
    """
    chain = system.chain
    reach = 0.045 * (chain.top - chain.base)
    result: list[Spring] = []
    soil = soil_springs(system)
    if soil is not None:
        for height in soil.height[:: node_step(soil, chain.top - chain.base)]:
            result.extend(_pair(system, float(height), lateral, reach))
    if system.foundation.root is not None:
        if not result:
            for direction in (lateral, np.cross(_Z, lateral)):
                result.extend(_pair(system, chain.base, direction, 1.3 * reach))
        anchor = np.array([0.0, 0.0, chain.base - reach])
        result.append(Spring("vertical", anchor, 0, np.zeros(3), reach))
    return result


def node_step(soil: SoilSprings, structure_height: float) -> int:
    """How many soil nodes lie from one drawn spring to the next, so that they can be distinguished.

    It divides the pile evenly: the first and the last node are always drawn.
    """
    closest = _CLOSEST * structure_height
    gaps = len(soil.height) - 1
    steps = (step for step in range(1, gaps + 1) if gaps % step == 0)
    spacing = abs(soil.height[-1] - soil.height[0]) / gaps
    return next((step for step in steps if step * spacing >= closest), gaps)


def zigzag(length: float, width: float, radius: float, windings: int = 4) -> Mesh:
    """Symbol of a spring: a bent rod along x from the origin, in m.

    length : from end to end; width : of the bends; radius : of the rod
    """
    bends = length * np.linspace(0.2, 0.8, 2 * windings + 1)
    side = np.zeros(2 * windings + 1)
    side[1:-1:2], side[2:-1:2] = width / 2, -width / 2
    x = np.concatenate([[0.0], bends, [length]])
    z = np.concatenate([[0.0], side, [0.0]])
    return tube(np.column_stack([x, np.zeros_like(x), z]), radius)


def _pair(system: System, height: float, direction: Array, reach: float) -> Iterator[Spring]:
    """Two springs on opposite sides of the structure at one height."""
    chain = system.chain
    body = int(chain.body_at(np.array([height]))[0])
    radius = float(outer_diameter(system.turbine, np.array([height]))[0]) / 2
    rise = (height - chain.origin[body]) * _Z
    axis = "x" if abs(direction[0]) > abs(direction[1]) else "y"
    for sign, side in ((1, "plus"), (-1, "minus")):
        outwards = sign * direction
        anchor = (radius + reach) * outwards + height * _Z
        name = f"{axis}_{side}_{height:.3f}".replace(".", "_")
        yield Spring(name, anchor, body, radius * outwards + rise, reach)
