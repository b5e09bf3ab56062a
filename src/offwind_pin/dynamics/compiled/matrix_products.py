"""Products with the matrices of small motions about a state, in O(N).

The matrix da_dq M + dv_dq D + K is never assembled: see :mod:`newton_matrix` for its factors. Modes
need some hundred products, so that NumPy does; nothing is compiled for them.
"""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.model import NO_JOINT, Data, Model


class MatrixProducts:
    """Products with da_dq M + dv_dq D + K of a state.

    Parameters
    ----------
    model : Model
    data : Data
        Of the state; as it is when products are asked for.
    matrices : array
        (N + 1, 6, 6) of the bodies, as :func:`assemble` sets them for the same state and factors.
    dv_dq, da_dq : float, 1/s and 1/s2
        Factors of the damping and of the mass.
    """

    def __init__(
        self, model: Model, data: Data, matrices: Array, dv_dq: float, da_dq: float
    ) -> None:
        roots, node_joints, bodies = model.roots, model.node_joints, len(model.body)
        self._ends = roots + node_joints * np.arange(bodies)
        self._joints = int(self._ends[-1])
        self._body = np.repeat(np.arange(bodies), np.diff(self._ends, prepend=0))
        self._matrices = matrices
        self._diagonal = model.stiffness + dv_dq * model.damping
        self._root = data.root_stiffness[:roots, :roots] + dv_dq * data.root_damping[:roots, :roots]
        self._axes = data.joint[: self._joints]
        self._turns = _turns(self._axes, data.wrench[self._body])
        self._dampers = [_Damper(model, data, d, da_dq) for d in range(len(model.tmd.body))]

    def times(self, x: Array, *, transposed: bool = False) -> Array:
        """Product (nv,) of the matrix, or of its transpose, with a vector (nv,)."""
        own, roots = x[: self._joints, None], len(self._root)
        product = self._diagonal * x
        twists = np.vstack([np.zeros(6), np.cumsum(self._axes * own, axis=0)])
        matrices = self._matrices.transpose(0, 2, 1) if transposed else self._matrices
        twist = twists[self._ends]
        wrench = np.matmul(matrices, twist[:, :, None])[:, :, 0]
        for damper in self._dampers:
            wrench[damper.body] += damper.add(x, twist[damper.body], product, transposed=transposed)
        above = _sums_from_the_end(wrench)[self._body]
        if transposed:
            turned = self._turns * own
            above = above - (_sums_from_the_end(turned) - turned)
        product[: self._joints] += np.einsum("ij,ij->i", self._axes, above)
        if not transposed:
            product[: self._joints] -= np.einsum("ij,ij->i", self._turns, twists[:-1])
        product[:roots] += (self._root.T if transposed else self._root) @ x[:roots]
        return product


class _Damper:
    """A tuned mass damper's part in the products."""

    def __init__(self, model: Model, data: Data, d: int, da_dq: float) -> None:
        mass, position = model.tmd.mass[d], _skew(data.tmd_position[d])
        need = mass * (data.tmd_acceleration[d] + [0.0, 0.0, model.gravity])
        self.body = int(model.tmd.body[d])
        self._joints = [int(joint) for joint in model.tmd.joint[d] if joint != NO_JOINT]
        self._axes = data.joint[self._joints]
        self._turned = np.cross(need, self._axes[:, :3])
        inertia = np.block([[np.eye(3), -position], [position, -position @ position]])
        self._matrix = da_dq * mass * inertia
        # The moment that the held force gains as its point moves.
        self._matrix[3:] += _skew(-need) @ np.hstack([np.eye(3), -position])

    def add(self, x: Array, carrier: Array, product: Array, *, transposed: bool) -> Array:
        """Set the product of the damper's joints; the wrench (6,) on the carrier.

        carrier : (6,) twist of the carrier
        """
        own = x[self._joints]
        twist = carrier + own @ self._axes
        wrench = (self._matrix.T if transposed else self._matrix) @ twist
        product[self._joints] += self._axes[:, :3] @ wrench[:3]
        if transposed:
            wrench[3:] -= own @ self._turned
        else:
            product[self._joints] -= self._turned @ carrier[3:]
        return wrench


def _turns(axes: Array, wrench: Array) -> Array:
    """(n, 6) work of held wrenches on joints' columns, as the twists below turn the columns."""
    linear, angular = axes[:, :3], axes[:, 3:]
    force, moment = wrench[:, :3], wrench[:, 3:]
    turned = np.cross(linear, force) + np.cross(angular, moment)
    return np.hstack([np.cross(angular, force), turned])


def _skew(a: Array) -> Array:
    """(3, 3) matrix of the cross product with a."""
    return np.cross(np.eye(3), a)


def _sums_from_the_end(values: Array) -> Array:
    return np.cumsum(values[::-1], axis=0)[::-1]
