"""Point loads written in Python, as a user would write them."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from offwind_pin.loads.point_load import PointForces, PointLoad, PointMotion, PointTangents

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TurningLoad(PointLoad):
    """A force and moment at the yaw bearing that grow smoothly and turn around."""

    yaw_bearing: float
    name: str = "turning"

    @property
    def height(self) -> Array:
        return np.array([self.yaw_bearing])

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        grown = 1 - np.cos(2 * time)
        force = grown * np.array([2e6 * np.cos(3 * time), 2e6 * np.sin(3 * time), 0.0])
        moment = grown * np.array([1e7, 2e7 * np.cos(time), 1e7 * np.sin(2 * time)])
        return PointForces(force[None], moment[None])

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        return PointTangents.zeros(1)


@dataclass(frozen=True)
class Probe(PointLoad):
    """No force at all; it keeps the last motion that it was shown."""

    height: Array
    name: str = "probe"
    seen: list[PointMotion] = field(default_factory=list)

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        self.seen[:] = [motion]
        return PointForces(*np.zeros((2, len(self.height), 3)))

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        return PointTangents.zeros(len(self.height))


@dataclass(frozen=True)
class EveryKind(PointLoad):
    """Depends on everything a load is shown: F = -k |u|^2 u - c |v|^2 v - m (e.a) e + time, ramp factor.

    stiffness k in N/m3, damping c in N s3/m3, mass m in kg
    """

    height: Array
    stiffness: float = 3e6
    damping: float = 2e6
    mass: float = 4e4
    name: str = "every kind"

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        assert motion.acceleration is not None
        u, v, e, a = motion.displacement, motion.velocity, motion.axis, motion.acceleration
        force = -self.stiffness * _square(u) * u - self.damping * _square(v) * v
        force -= self.mass * np.sum(e * a, axis=1, keepdims=True) * e
        moment = np.tile([1e5 * time, 0.0, 1e5 * ramp_factor], (len(self.height), 1))
        return PointForces(force, moment, float(np.sum(self.damping * _square(v) ** 2)))

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        assert motion.acceleration is not None
        e, a = motion.axis, motion.acceleration
        along = np.sum(e * a, axis=1)[:, None, None] * np.eye(3)
        return PointTangents(
            stiffness=-self.stiffness * _cubic(motion.displacement),
            damping=-self.damping * _cubic(motion.velocity),
            inertia=-self.mass * np.einsum("ni,nj->nij", e, e),
            turning=-self.mass * (along + np.einsum("ni,nj->nij", e, a)),
        )


def _square(vector: Array) -> Array:
    """(n, 1) squared lengths."""
    return np.sum(vector**2, axis=1, keepdims=True)


def _cubic(vector: Array) -> Array:
    """(n, 3, 3) derivative of |u|^2 u."""
    return _square(vector)[..., None] * np.eye(3) + 2 * np.einsum("ni,nj->nij", vector, vector)
