"""Point loads and a restraint of a user's own: smooth, violent, broken and raising ones."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.loads.point_load import PointForces, PointLoad, PointMotion, PointTangents
from offwind_pin.loads.root_restraint import RootRestraint

Array = NDArray[np.float64]


@dataclass(frozen=True)
class AtTop(PointLoad):
    """What the loads here have in common: one point, at the yaw bearing, and no tangents."""

    yaw_bearing: float
    name: str = "own"

    @property
    def height(self) -> Array:
        return np.array([self.yaw_bearing])

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        return PointTangents.zeros(1)


@dataclass(frozen=True)
class FromHistory(AtTop):
    """What ``TowerTopLoad`` does, written in Python: a history whose departure from a mean rises."""

    history: ow.LoadHistory = None  # type: ignore[assignment]
    mean: Array = None  # type: ignore[assignment]

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        load = self.mean + ramp_factor * (self.history.at(time) - self.mean)
        return PointForces(load[None, :3], load[None, 3:])


@dataclass(frozen=True)
class Fender(AtTop):
    """Something hard in the way of the top at a displacement along x.

    The force is F0 exp((x - gap) / depth). Newton's iteration comes back by one depth at a time, so
    that it fails where a step runs into the fender by some tens of depths, at any stiffness.
    """

    gap: float = 0.2
    depth: float = 1e-3
    force: float = 1e4

    def _push(self, motion: PointMotion) -> float:
        into = (motion.displacement[0, 0] - self.gap) / self.depth
        return self.force * math.exp(min(into, 300.0))

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        force = np.zeros((1, 3))
        force[0, 0] = -self._push(motion)
        return PointForces(force, np.zeros((1, 3)))

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        result = PointTangents.zeros(1)
        result.stiffness[0, 0, 0] = -self._push(motion) / self.depth
        return result


@dataclass(frozen=True)
class NotANumber(AtTop):
    """Nothing at first; after a time its force is not a number."""

    after: float = 1.0

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        return PointForces(np.full((1, 3), np.nan if time > self.after else 0.0), np.zeros((1, 3)))


class MyMistakeError(Exception):
    """What a user's own code may raise."""


@dataclass(frozen=True)
class Raises(AtTop):
    """A push that goes wrong after a time, in its forces or in its tangents."""

    after: float = 1.0
    in_tangents: bool = False

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        if time > self.after and not self.in_tangents:
            raise MyMistakeError(f"at {time:g} s")
        return PointForces(np.full((1, 3), 1e5), np.zeros((1, 3)))

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        if time > self.after and self.in_tangents:
            raise MyMistakeError(f"at {time:g} s")
        return PointTangents.zeros(1)


@dataclass(frozen=True)
class HardeningRestraint(RootRestraint):
    """Six uncoupled springs that stiffen, and dashpots: R = k (x + x^3 / x0^2) + c v."""

    stiffness: Array
    damping: Array
    scale: float = 0.01

    def reaction(self, displacement: Array, velocity: Array) -> Array:
        grown = displacement + displacement**3 / self.scale**2
        return self.stiffness * grown + self.damping * velocity

    def tangents(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        slope = 1 + 3 * displacement**2 / self.scale**2
        return np.diag(self.stiffness * slope), np.diag(self.damping)

    def describe(self) -> dict[str, object]:
        return {"kind": "hardening"}
