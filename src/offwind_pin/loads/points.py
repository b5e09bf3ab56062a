"""What a load sees and what it gives: motion of points on the axis in, forces and tangents out.

Everything is in the inertial frame: x downwind, y left looking downwind, z up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from offwind_pin.turbines.definition import Array


@dataclass(frozen=True, eq=False)
class PointMotion:
    """Motion of n points on the axis of the structure.

    Attributes
    ----------
    position : (n, 3) in m
    displacement : (n, 3) from the undeformed place, in m
    velocity : (n, 3) in m/s
    axis : (n, 3) unit vectors along the deflected axis, upwards
    """

    position: Array
    displacement: Array
    velocity: Array
    axis: Array

    def __getitem__(self, part: slice) -> PointMotion:
        return PointMotion(
            self.position[part], self.displacement[part], self.velocity[part], self.axis[part]
        )


@dataclass(frozen=True, eq=False)
class PointForces:
    """Forces (n, 3) in N on the structure at the points, and moments (n, 3) in N m."""

    force: Array
    moment: Array


@dataclass(frozen=True, eq=False)
class PointTangents:
    """Derivatives of the forces: by position (n, 3, 3) in N/m, by velocity (n, 3, 3) in N s/m.

    Moments of a point load depend on time alone.
    """

    stiffness: Array
    damping: Array


class PointLoad(Protocol):
    """A load on points of the axis; it knows nothing of joints.

    ``rise`` runs from 0 to 1 while a simulation starts: at 0 only the mean of a load acts.
    """

    @property
    def name(self) -> str:
        """Short name, unique in a system."""

    @property
    def height(self) -> Array:
        """(n,) undeformed heights of the points in m."""

    def forces(self, time: float, motion: PointMotion, rise: float) -> PointForces:
        """Forces and moments on the structure."""

    def tangents(self, time: float, motion: PointMotion, rise: float) -> PointTangents:
        """Exact derivatives of the forces, the axis held."""


def zeros_like_points(n: int) -> tuple[Array, Array]:
    """Zero stiffness and damping tangents for n points."""
    return np.zeros((n, 3, 3)), np.zeros((n, 3, 3))
