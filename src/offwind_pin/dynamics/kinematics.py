"""Motion of points on the chain's axis, and point forces as generalised forces, in O(N).

The world-frame Jacobian S that Pinocchio fills in one call holds, in column j, the spatial velocity
of the world's origin per unit velocity of joint j. The chain is serial, so the spatial velocity of
a body is a cumulative sum over the columns below it, and the generalised force of joint j is the
product of column j with the sum of all wrenches above it. Nothing loops over points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.loads.points import PointMotion
from offwind_pin.structure.chain import Chain, NDArrayInt
from offwind_pin.turbines.definition import Array


@dataclass(frozen=True, eq=False)
class AxisPoints:
    """Material points on the axis of a chain.

    height (n,) in m; body (n,) index of the carrying body; offset (n,) along it in m.
    """

    height: Array
    body: NDArrayInt
    offset: Array

    @staticmethod
    def on(chain: Chain, height: Array) -> AxisPoints:
        body = chain.body_at(height)
        return AxisPoints(height, body, height - chain.origin[body])


class ChainMotion:
    """State of the chain's axis for one configuration and velocity.

    Parameters
    ----------
    chain : the chain
    jacobian : (6, nv) world-frame joint Jacobian, linear rows first
    root : (3,) translation of the base in m
    v : (nv,) joint velocities

    Attributes
    ----------
    axis, origin : (N + 1, 3) unit vector along each body and place of its frame in m
    twist : (N + 1, 6) spatial velocity of each body at the world's origin
    """

    def __init__(self, chain: Chain, jacobian: Array, root: Array, v: Array) -> None:
        self.chain = chain
        self.jacobian = jacobian
        self.dof_body = dof_body(chain)
        self._last_dof = chain.roots + 3 * np.arange(chain.elements + 1) - 1
        about_z = jacobian[3:, self._last_dof] if chain.free_root else self._clamped_axes(jacobian)
        self.axis = about_z.T
        rise = np.diff(chain.origin)[:, None] * self.axis[:-1]
        base = np.array([[0.0, 0.0, chain.base]]) + root
        self.origin = base + np.concatenate([np.zeros((1, 3)), np.cumsum(rise, axis=0)])
        self.twist = self.body_sums(jacobian * v)

    def _clamped_axes(self, jacobian: Array) -> Array:
        return np.concatenate([[[0.0], [0.0], [1.0]], jacobian[3:, self._last_dof[1:]]], axis=1)

    def body_sums(self, columns: Array) -> Array:
        """(N + 1, 6) sums of the joint columns (6, nv) at and below each body."""
        total = np.zeros((6, columns.shape[1] + 1))
        np.cumsum(columns, axis=1, out=total[:, 1:])
        return total[:, self._last_dof + 1].T

    def points(self, points: AxisPoints) -> PointMotion:
        """Position, displacement, velocity and axis of points."""
        axis = self.axis[points.body]
        position = self.origin[points.body] + points.offset[:, None] * axis
        displacement = position.copy()
        displacement[:, 2] -= points.height
        twist = self.twist[points.body]
        velocity = twist[:, :3] + cross(twist[:, 3:], position)
        return PointMotion(position, displacement, velocity, axis)

    def points_at(self, height: Array) -> PointMotion:
        """Motion of the points of the axis at undeformed heights in m."""
        return self.points(AxisPoints.on(self.chain, height))

    def point_acceleration(self, points: AxisPoints, motion: PointMotion, rate: Array) -> Array:
        """(n, 3) acceleration of points in m/s2; rate (N + 1, 6) from :meth:`twist_rate`."""
        body_rate = rate[points.body]
        spin = self.twist[points.body, 3:]
        return (
            body_rate[:, :3]
            + cross(body_rate[:, 3:], motion.position)
            + cross(spin, motion.velocity)
        )

    def twist_rate(self, jacobian_rate: Array, v: Array, a: Array) -> Array:
        """(N + 1, 6) time derivative of the bodies' twists."""
        return self.body_sums(self.jacobian * a + jacobian_rate * v)

    def generalised_force(
        self, points: AxisPoints, position: Array, force: Array, moment: Array
    ) -> Array:
        """(nv,) generalised force of point forces (n, 3) and moments (n, 3) fixed in the world."""
        above = self._wrench_above(points, position, force, moment)
        return np.einsum("ij,ji->i", above[self.dof_body], self.jacobian)

    def congruence(self, points: AxisPoints, position: Array, blocks: Array) -> Array:
        """(nv, nv) matrix sum of J_P' B J_P over points with blocks B (n, 3, 3)."""
        return self._assemble(self._sums_above(points, _at_origin(position, blocks)))

    def geometric_stiffness(
        self, points: AxisPoints, position: Array, force: Array, moment: Array
    ) -> Array:
        """(nv, nv) derivative of the generalised force by q, with forces and moments held.

        Two parts: the points move, so that moments about the joints change; and the joint axes
        turn, dS_j / dq_k = S_k x S_j for k below j.
        """
        arm = np.zeros((len(position), 6, 6))
        dyad = np.einsum("ni,nj->nij", position, force)
        trace = np.einsum("nii->n", dyad)
        arm[:, 3:, :3] = -skew(force)
        arm[:, 3:, 3:] = dyad - trace[:, None, None] * np.eye(3)
        moved = self._assemble(self._sums_above(points, arm))
        above = self._wrench_above(points, position, force, moment)[self.dof_body]
        linear, angular = self.jacobian[:3].T, self.jacobian[3:].T
        turned = np.concatenate(
            [
                cross(angular, above[:, :3]),
                cross(linear, above[:, :3]) + cross(angular, above[:, 3:]),
            ],
            axis=1,
        )
        return moved + np.tril(turned @ self.jacobian, -1)

    def _wrench_above(
        self, points: AxisPoints, position: Array, force: Array, moment: Array
    ) -> Array:
        """(N + 1, 6) sum of wrenches about the world's origin on each body and all above it."""
        wrench = np.concatenate([force, cross(position, force) + moment], axis=1)
        return self._sums_above(points, wrench)

    def _sums_above(self, points: AxisPoints, values: Array) -> Array:
        """(N + 1, ...) sums of the points' values on each body and all above it."""
        total = np.zeros((self.chain.elements + 1, *values.shape[1:]))
        np.add.at(total, points.body, values)
        return total[::-1].cumsum(axis=0)[::-1]

    def _assemble(self, above: Array) -> Array:
        """(nv, nv) matrix with entry S_j' B S_k, B the sum above the higher of joints j and k."""
        at_joint = above[self.dof_body]
        row = np.einsum("ij,jik->jk", self.jacobian, at_joint) @ self.jacobian
        column = self.jacobian.T @ np.einsum("jik,kj->ij", at_joint, self.jacobian)
        return np.tril(row) + np.triu(column, 1)


def dof_body(chain: Chain) -> NDArrayInt:
    """(nv,) index of the lowest body that each joint moves."""
    return np.concatenate(
        [np.zeros(chain.roots, dtype=np.intp), np.repeat(np.arange(1, chain.elements + 1), 3)]
    )


def cross(a: Array, b: Array) -> Array:
    """Row-wise cross product of (n, 3) arrays, several times faster than numpy.cross."""
    result = np.empty(np.broadcast_shapes(a.shape, b.shape))
    result[:, 0] = a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1]
    result[:, 1] = a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2]
    result[:, 2] = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return result


def skew(vector: Array) -> Array:
    """(n, 3, 3) matrices W with W x = vector cross x."""
    result = np.zeros((len(vector), 3, 3))
    result[:, 0, 1], result[:, 0, 2] = -vector[:, 2], vector[:, 1]
    result[:, 1, 0], result[:, 1, 2] = vector[:, 2], -vector[:, 0]
    result[:, 2, 0], result[:, 2, 1] = -vector[:, 1], vector[:, 0]
    return result


def _at_origin(position: Array, blocks: Array) -> Array:
    """(n, 6, 6) blocks X' B X, with X = [I, -[p]] from a twist at the origin to the point."""
    reach = np.zeros((len(position), 3, 6))
    reach[:, :, :3] = np.eye(3)
    reach[:, :, 3:] = -skew(position)
    return reach.transpose(0, 2, 1) @ blocks @ reach
