"""Dampers that couple points of the structure with one another."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.loads.point_load import (
    ANGULAR_VELOCITY,
    VELOCITY,
    force_kernel,
    no_tangents,
)
from offwind_pin.loads.structural.inertial_damping import InertialDamping

_VELOCITY, _ANGULAR_VELOCITY = VELOCITY.start, ANGULAR_VELOCITY.start


@force_kernel
def _forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    count = constants.shape[1] // 7
    for p in range(len(motion)):
        for j in range(6):
            force[p, j] = 0.0
    power = 0.0
    for i in range(count):
        speed = 0.0
        for p in range(len(motion)):
            for j in range(3):
                speed += constants[p, 6 * i + j] * motion[p, _VELOCITY + j]
                speed += constants[p, 6 * i + 3 + j] * motion[p, _ANGULAR_VELOCITY + j]
        amplitude = constants[0, 6 * count + i] * speed
        power += amplitude * speed
        for p in range(len(motion)):
            for j in range(6):
                force[p, j] -= amplitude * constants[p, 6 * i + j]
    return power


@dataclass(frozen=True, eq=False)
class CoupledDamping(InertialDamping):
    """k dampers, each on a weighted sum of the velocities of all points.

    With the wrenches w_ip of damper i at the points p, its force at each point is
    -rate_i w_ip s_i with s_i = sum_p w_ip . (velocity, angular_velocity)_p: symmetric, and
    dissipative where
    the rate is positive. Wrenches keep their directions in the inertial frame.

    Attributes
    ----------
    name : str
        Of the load.
    height : (n,) array, m
        Undeformed heights of the points.
    wrench : (k, n, 6) array
        Force and moment of each damper at each point, per unit of its own force.
    rate : (k,) array
        Own force per unit of s_i.
    """

    name: str
    height: Array
    wrench: Array
    rate: Array

    force_kernel = _forces
    tangent_kernel = no_tangents

    __repr__ = one_line

    @cached_property
    def constants(self) -> Array:
        points = len(self.height)
        wrench = self.wrench.transpose(1, 0, 2).reshape(points, -1)
        return np.ascontiguousarray(np.hstack([wrench, np.tile(self.rate, (points, 1))]))

    @property
    def coupling(self) -> tuple[Array, Array]:
        return self.wrench, self.rate

    def describe(self) -> dict[str, Any]:
        return {
            "name": self.name,
            "z_m": self.height.tolist(),
            "wrench": self.wrench.tolist(),
            "rate": self.rate.tolist(),
        }
