"""Joints: the freedom S that each allows, and its transform X_J from parent to child.

R. Featherstone, Rigid Body Dynamics Algorithms (2008), section 4.4. Configurations and velocities
are laid out as Pinocchio lays them out. S is constant in the child's frame for every joint here, so
the joint's own velocity product c_J vanishes.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from spatial import Array, plucker_transform, skew


class Joint(Protocol):
    """Any joint of a tree: S is (6, degrees of freedom), angular part first."""

    subspace: Array

    def transform(self, q: Array) -> Array:
        """X_J (6, 6) at the joint's own configuration."""
        ...


class Revolute:
    """One angle in rad about a fixed axis."""

    def __init__(self, axis: Array) -> None:
        self.subspace = np.concatenate([axis, np.zeros(3)])[:, None]
        self._cross = skew(axis)
        self._cross_twice = self._cross @ self._cross

    def transform(self, q: Array) -> Array:
        return self._turned(np.cos(q[0]), np.sin(q[0]))

    def _turned(self, cosine: float, sine: float) -> Array:
        """Rodrigues' formula for -q: coordinates turn against the body."""
        rotation = np.eye(3) - sine * self._cross + (1 - cosine) * self._cross_twice
        return plucker_transform(rotation, np.zeros(3))


class UnboundedRevolute(Revolute):
    """The same without limits; the configuration is (cos, sin) of the angle."""

    def transform(self, q: Array) -> Array:
        return self._turned(q[0], q[1])


class Prismatic:
    """One displacement in m along a fixed axis."""

    def __init__(self, axis: Array) -> None:
        self.subspace = np.concatenate([np.zeros(3), axis])[:, None]
        self._axis = axis

    def transform(self, q: Array) -> Array:
        return plucker_transform(np.eye(3), q[0] * self._axis)


class Spherical:
    """Any turn about a point: a unit quaternion (x, y, z, w), and a body-fixed angular velocity."""

    subspace = np.vstack([np.eye(3), np.zeros((3, 3))])

    def transform(self, q: Array) -> Array:
        return plucker_transform(from_quaternion(q).T, np.zeros(3))


class FreeFlyer:
    """Position and unit quaternion (x, y, z, w); body-fixed velocity, the linear part first."""

    subspace = np.roll(np.eye(6), 3, axis=0)

    def transform(self, q: Array) -> Array:
        return plucker_transform(from_quaternion(q[3:]).T, q[:3])


def from_quaternion(quaternion: Array) -> Array:
    """(3, 3) rotation from the turned frame to the fixed one: 1 + 2 w u x + 2 u x u x."""
    u = skew(quaternion[:3])
    return np.eye(3) + 2 * quaternion[3] * u + 2 * u @ u
