"""Mass-proportional damping of the bodies of a structure."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.loads.point_load import (
    ANGULAR_VELOCITY,
    BY_VELOCITY,
    MOMENT_BY_ANGULAR_VELOCITY,
    VELOCITY,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.structural.inertial_damping import InertialDamping

_VELOCITY, _ANGULAR_VELOCITY = VELOCITY.start, ANGULAR_VELOCITY.start


@force_kernel
def _forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    power = 0.0
    for p in range(len(motion)):
        for j in range(3):
            velocity, angular_velocity = motion[p, _VELOCITY + j], motion[p, _ANGULAR_VELOCITY + j]
            force[p, j] = -constants[p, j] * velocity
            force[p, 3 + j] = -constants[p, 3 + j] * angular_velocity
            power += constants[p, j] * velocity**2 + constants[p, 3 + j] * angular_velocity**2
    return power


@tangent_kernel
def _tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    for p in range(len(motion)):
        for j in range(3):
            blocks[p, BY_VELOCITY, j, j] = -constants[p, j]
            blocks[p, MOMENT_BY_ANGULAR_VELOCITY, j, j] = -constants[p, 3 + j]


@dataclass(frozen=True, eq=False)
class MassDamping(InertialDamping):
    """Dampers between points and the inertial frame, along and about its axes.

    Attributes
    ----------
    name : str
        Of the load.
    height : (n,) array, m
        Undeformed heights of the points.
    dampers : (n, 6) array, N s/m and N m s
        Along x, y, z and about them.
    """

    name: str
    height: Array
    dampers: Array

    force_kernel = _forces
    tangent_kernel = _tangents

    __repr__ = one_line

    @cached_property
    def constants(self) -> Array:
        return np.ascontiguousarray(self.dampers)

    def describe(self) -> dict[str, Any]:
        return {
            "name": self.name,
            "z_m": self.height.tolist(),
            "dampers": self.dampers.tolist(),
        }
