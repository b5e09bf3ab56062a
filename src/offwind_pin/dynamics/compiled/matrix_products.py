"""Products with the matrices of small motions about a state, in O(N).

Mass M, damping D and stiffness K of a chain are never assembled: like the iteration matrix of
:mod:`newton_matrix` each is

    diag(joints) + S' B S - (turning joint axes),

with one 6x6 matrix B for each body. Modes need some hundred products: NumPy makes them, and nothing
is compiled.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.model import NO_JOINT, Data, Model


class ChainGeometry:
    """Joints of a chain about a state, its tuned mass dampers among them.

    Attributes
    ----------
    axes : array
        (n, 6) columns of the axis's joints.
    body : array
        (n,) that each of them moves.
    ends : array
        (N + 1,) joints below each body and above.
    turns : array
        (n, 6) work of the held wrenches on the columns, as the twists below turn these.
    dampers : list of DamperGeometry
    """

    def __init__(self, model: Model, data: Data) -> None:
        bodies = len(model.body)
        self.ends = model.roots + model.node_joints * np.arange(bodies)
        self.body = np.repeat(np.arange(bodies), np.diff(self.ends, prepend=0))
        self.axes = data.joint[: len(self.body)].copy()
        linear, angular = self.axes[:, :3], self.axes[:, 3:]
        force, moment = np.split(data.wrench[self.body], 2, axis=1)
        turned = np.cross(linear, force) + np.cross(angular, moment)
        self.turns = np.hstack([np.cross(angular, force), turned])
        self.dampers = [DamperGeometry(model, data, d) for d in range(len(model.tmd.body))]


class DamperGeometry:
    """Joints of a tuned mass damper about a state.

    Attributes
    ----------
    body : int
        Carrier.
    joints : list of int
    axes : array
        (j, 6) their columns.
    turns : array, N
        (j, 3) turn of the held force's work on them, per rotation of the carrier.
    mass, stiffness : array
        (6, 6) matrices of the sliding mass.
    """

    def __init__(self, model: Model, data: Data, d: int) -> None:
        mass, arm = model.tmd.mass[d], _skew(data.tmd_position[d])
        need = mass * (data.tmd_acceleration[d] + [0.0, 0.0, model.gravity])
        self.body = int(model.tmd.body[d])
        self.joints = [int(joint) for joint in model.tmd.joint[d] if joint != NO_JOINT]
        self.axes = data.joint[self.joints]
        self.turns = np.cross(need, self.axes[:, :3])
        self.mass = mass * np.block([[np.eye(3), -arm], [arm, -arm @ arm]])
        # The moment that the held force gains as its point moves.
        self.stiffness = np.zeros((6, 6))
        self.stiffness[3:] = _skew(-need) @ np.hstack([np.eye(3), -arm])


@dataclass(frozen=True, eq=False)
class MatrixProducts:
    """Products with a matrix of small motions.

    Attributes
    ----------
    geometry : ChainGeometry
    bodies : array
        (N + 1, 6, 6) matrix B of each body.
    dampers : array
        (D, 6, 6) of each sliding mass.
    diagonal : array
        (nv,) of the joints.
    root : array
        (r, r) of the root's restraint.
    turning, turning_transposed : float
        Shares of the turning axes' term and of its transpose.
    """

    geometry: ChainGeometry
    bodies: Array
    dampers: Array
    diagonal: Array
    root: Array
    turning: float = 0.0
    turning_transposed: float = 0.0

    def symmetric(self) -> MatrixProducts:
        """Those with the symmetric part."""
        share = (self.turning + self.turning_transposed) / 2
        return replace(
            self,
            bodies=(self.bodies + self.bodies.transpose(0, 2, 1)) / 2,
            dampers=(self.dampers + self.dampers.transpose(0, 2, 1)) / 2,
            root=(self.root + self.root.T) / 2,
            turning=share,
            turning_transposed=share,
        )

    def times(self, vectors: Array) -> Array:
        """(nv,) or (nv, m) product with vectors of that shape."""
        if vectors.ndim == 2:
            return np.column_stack([self.times(vector) for vector in vectors.T])
        geometry, product = self.geometry, self.diagonal * vectors
        roots, joints = len(self.root), len(geometry.body)
        own = vectors[:joints, None]
        twists = np.zeros((joints + 1, 6))
        np.cumsum(geometry.axes * own, axis=0, out=twists[1:])
        twist = twists[geometry.ends]
        wrench = np.matmul(self.bodies, twist[:, :, None])[:, :, 0]
        for damper, matrix in zip(geometry.dampers, self.dampers, strict=True):
            carrier, sliding = twist[damper.body], vectors[damper.joints]
            force = matrix @ (carrier + sliding @ damper.axes)
            product[damper.joints] += damper.axes @ force
            product[damper.joints] -= self.turning * (damper.turns @ carrier[3:])
            force[3:] -= self.turning_transposed * (sliding @ damper.turns)
            wrench[damper.body] += force
        above = _sums_from_the_end(wrench)[geometry.body]
        if self.turning_transposed:
            turned = self.turning_transposed * geometry.turns * own
            above -= _sums_from_the_end(turned) - turned
        product[:joints] += (geometry.axes * above).sum(axis=1)
        if self.turning:
            product[:joints] -= self.turning * (geometry.turns * twists[:-1]).sum(axis=1)
        product[:roots] += self.root @ vectors[:roots]
        return product


def _skew(a: Array) -> Array:
    """(3, 3) matrix of the cross product with a."""
    return np.cross(np.eye(3), a)


def _sums_from_the_end(values: Array) -> Array:
    return np.cumsum(values[::-1], axis=0)[::-1]
