"""Motion of points on the chain's axis, point forces as generalised forces, and their derivatives.

Column j of the world-frame Jacobian S, which Pinocchio computes in one call, is the spatial
velocity of the world's origin per unit velocity of joint j. The chain is serial, so the spatial
velocity of a body is a cumulative sum over the columns below it, and the generalised force of joint
j is the product of column j with the sum of all wrenches above it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.structure.chain import Chain, NDArrayInt, dof_body


@dataclass(frozen=True, eq=False)
class AxisPoints:
    """Material points on the axis of a chain.

    height (n,) in m; body (n,) index of the body; offset (n,) along it in m.
    """

    height: Array
    body: NDArrayInt
    offset: Array

    @staticmethod
    def on(chain: Chain, height: Array) -> AxisPoints:
        body = chain.body_at(height)
        return AxisPoints(height, body, height - chain.origin[body])

    def __getitem__(self, part: slice) -> AxisPoints:
        return AxisPoints(self.height[part], self.body[part], self.offset[part])


@dataclass(frozen=True, eq=False)
class PointDerivatives:
    """Derivatives (n, 3, nv) of the motion of points by q, v and a.

    position : of the position by q, of the velocity by v, and of the acceleration by a
    rotation : of the section by q, of its spin by v
    axis, turn, velocity_by_q, spin_by_q, acceleration_by_q, acceleration_by_v : of these by q or v
    """

    position: Array
    rotation: Array
    axis: Array
    turn: Array
    spin_by_q: Array
    velocity_by_q: Array
    acceleration_by_q: Array
    acceleration_by_v: Array

    def __getitem__(self, part: slice) -> PointDerivatives:
        return PointDerivatives(*(getattr(self, field.name)[part] for field in fields(self)))


class ChainMotion:
    """State of the chain's axis for one configuration, velocity and acceleration.

    Parameters
    ----------
    chain : Chain
        The chain.
    jacobian, jacobian_rate : (6, nv) array
        World-frame joint Jacobian and its time derivative, linear rows first.
    rotation : (N + 1, 3, 3) array
        Orientation of each body.
    q, v, a : (nv,) array
        Joint displacements, velocities and accelerations.

    Attributes
    ----------
    axis : (N + 1, 3) array
        Unit vector along each body.
    origin : (N + 1, 3) array, m
        Position of the frame of each body.
    twist, twist_rate : (N + 1, 6) array
        Spatial velocity of each body at the world's origin, and its rate.
    """

    def __init__(
        self,
        chain: Chain,
        jacobian: Array,
        jacobian_rate: Array,
        rotation: Array,
        q: Array,
        v: Array,
        a: Array,
    ) -> None:
        self.chain = chain
        self.jacobian = jacobian
        self.rotation = rotation
        self.dof_body = dof_body(chain)
        joints = len(chain.node_joints)
        self._last_dof = chain.roots + joints * np.arange(chain.elements + 1) - 1
        self.axis = rotation[:, :, 2]
        rise = np.zeros((chain.elements + 1, 3))
        rise[0] = [0.0, 0.0, chain.base]
        rise[1:] = np.diff(chain.origin)[:, None] * self.axis[:-1]
        axis_joints = chain.joint_name[: chain.axis_joints]
        slides = [i for i, name in enumerate(axis_joints) if name[-2] == "p"]
        np.add.at(rise, self.dof_body[slides], (jacobian[:3, slides] * q[slides]).T)
        self.origin = np.cumsum(rise, axis=0)
        self._through = np.cumsum(jacobian * v, axis=1)
        self._rate_through = np.cumsum(jacobian * a + jacobian_rate * v, axis=1)
        self.twist = self._bodies(self._through)
        self.twist_rate = self._bodies(self._rate_through)

    def points(self, points: AxisPoints) -> PointMotion:
        """Position, displacement, velocity, axis and acceleration of points."""
        axis = self.axis[points.body]
        position = self.origin[points.body] + points.offset[:, None] * axis
        displacement = position.copy()
        displacement[:, 2] -= points.height
        twist, rate = self.twist[points.body], self.twist_rate[points.body]
        velocity = twist[:, :3] + cross(twist[:, 3:], position)
        acceleration = rate[:, :3] + cross(rate[:, 3:], position) + cross(twist[:, 3:], velocity)
        turn = axial_vector(self.rotation[points.body])
        return PointMotion(position, displacement, velocity, axis, acceleration, turn, twist[:, 3:])

    def points_at(self, height: Array) -> PointMotion:
        """Motion of the points of the axis at undeformed heights in m."""
        return self.points(AxisPoints.on(self.chain, height))

    def derivatives(self, points: AxisPoints, motion: PointMotion) -> PointDerivatives:
        """Derivatives of the motion of points by q, v and a.

        A joint rotates or translates everything above it as one rigid body. With S the joint's
        column, V and V_S the twists of the point's body and of the body above the joint, and x the
        product of spatial velocities, dV/dq = S x (V - V_S); those of the rate follow by the
        product rule.
        """
        columns, lower = self.jacobian.T[None], self._below(points)
        twist = self.twist[points.body][:, None]
        rate = self.twist_rate[points.body][:, None]
        through, rate_through = self._through.T[None], self._rate_through.T[None]
        beyond = spatial_cross(columns, twist - through)
        turning = spatial_cross(through, columns)
        rate_by_q = spatial_cross(columns, rate - rate_through)
        rate_by_q = rate_by_q + spatial_cross(turning, twist - through)
        rate_by_v = beyond + turning
        place, spin = motion.position[:, None], twist[..., 3:]
        moved = columns[..., :3] + cross(columns[..., 3:], place)
        speed = beyond[..., :3] + cross(beyond[..., 3:], place) + cross(spin, moved)
        pushed = rate_by_q[..., :3] + cross(rate_by_q[..., 3:], place)
        pushed = pushed + cross(rate[..., 3:], moved)
        pushed = pushed + cross(beyond[..., 3:], motion.velocity[:, None])
        pushed = pushed + cross(spin, speed)
        by_v = rate_by_v[..., :3] + cross(rate_by_v[..., 3:], place)
        by_v = by_v + cross(columns[..., 3:], motion.velocity[:, None]) + cross(spin, moved)
        axis = cross(columns[..., 3:], motion.axis[:, None])
        rotation = np.broadcast_to(columns[..., 3:], moved.shape)
        orientation = self.rotation[points.body]
        trace = np.trace(orientation, axis1=1, axis2=2)
        by_rotation = (trace[:, None, None] * np.eye(3) - orientation) / 2
        turn = np.einsum("nij,nkj->nki", by_rotation, rotation)
        parts = (moved, rotation, axis, turn, beyond[..., 3:], speed, pushed, by_v)
        return PointDerivatives(*(self._kept(part, lower) for part in parts))

    def position_derivatives(self, points: AxisPoints, position: Array) -> Array:
        """(n, 3, nv) derivative of the position of points by q alone."""
        columns = self.jacobian.T[None]
        moved = columns[..., :3] + cross(columns[..., 3:], position[:, None])
        return self._kept(moved, self._below(points))

    def generalised_force(
        self, points: AxisPoints, position: Array, force: Array, moment: Array
    ) -> Array:
        """(nv,) generalised force of point forces (n, 3) and moments (n, 3) fixed in the world."""
        above = self._wrench_above(points, position, force, moment)
        return np.einsum("ij,ji->i", above[self.dof_body], self.jacobian)

    def geometric_stiffness(
        self, points: AxisPoints, position: Array, force: Array, moment: Array
    ) -> Array:
        """(nv, nv) derivative of the generalised force by q, with constant forces and moments.

        There are two terms: the points move, which changes moments about the joints; and the joint
        axes rotate, dS_j / dq_k = S_k x S_j for k below j.
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

    def _bodies(self, through: Array) -> Array:
        """(N + 1, 6) values of bodies from cumulative sums (6, nv) over the joints."""
        padded = np.concatenate([np.zeros((6, 1)), through], axis=1)
        return padded[:, self._last_dof + 1].T

    def _below(self, points: AxisPoints) -> NDArray[np.bool_]:
        """(n, nv) whether a joint is below a point and moves it."""
        return np.asarray(self.dof_body[None, :] <= points.body[:, None])

    @staticmethod
    def _kept(values: Array, lower: NDArray[np.bool_]) -> Array:
        """(n, 3, nv) with zeros for joints above the points, from (n, nv, 3)."""
        return np.where(lower[..., None], values, 0.0).transpose(0, 2, 1)

    def _wrench_above(
        self, points: AxisPoints, position: Array, force: Array, moment: Array
    ) -> Array:
        """(N + 2, 6) sum of wrenches about the world's origin on each body and all above it."""
        wrench = np.concatenate([force, cross(position, force) + moment], axis=1)
        return self._sums_above(points, wrench)

    def _sums_above(self, points: AxisPoints, values: Array) -> Array:
        """(N + 2, ...) sums of the points' values on each body and all above it.

        The last row, of zeros, is for the joints of tuned mass dampers.
        """
        total = np.zeros((self.chain.elements + 2, *values.shape[1:]))
        np.add.at(total, points.body, values)
        return total[::-1].cumsum(axis=0)[::-1]

    def _assemble(self, above: Array) -> Array:
        """(nv, nv) matrix with entry S_j' B S_k, B the sum above the higher of joints j and k."""
        at_joint = above[self.dof_body]
        row = np.einsum("ij,jik->jk", self.jacobian, at_joint) @ self.jacobian
        column = self.jacobian.T @ np.einsum("jik,kj->ij", at_joint, self.jacobian)
        return np.tril(row) + np.triu(column, 1)


def cross(a: Array, b: Array) -> Array:
    """(..., 3) products of vectors; for few of them several times as fast as NumPy's."""
    product = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        product[..., i] = a[..., j] * b[..., k] - a[..., k] * b[..., j]
    return product


def spatial_cross(a: Array, b: Array) -> Array:
    """(..., 6) product of spatial velocities, linear part first."""
    linear = cross(a[..., 3:], b[..., :3]) + cross(a[..., :3], b[..., 3:])
    return np.concatenate([linear, cross(a[..., 3:], b[..., 3:])], axis=-1)


def axial_vector(rotation: Array) -> Array:
    """(n, 3) vectors t whose skew matrices are the skew parts of rotations (n, 3, 3).

    A rotation phi changes an orientation R by [phi] R, and t by (tr(R) - R) phi / 2.
    """
    skew_part = (rotation - rotation.transpose(0, 2, 1)) / 2
    return skew_part[:, [2, 0, 1], [1, 2, 0]]


def skew(vector: Array) -> Array:
    """(n, 3, 3) matrices W with W x = vector cross x."""
    result = np.zeros((len(vector), 3, 3))
    result[:, 0, 1], result[:, 0, 2] = -vector[:, 2], vector[:, 1]
    result[:, 1, 0], result[:, 1, 2] = vector[:, 2], -vector[:, 0]
    result[:, 2, 0], result[:, 2, 1] = -vector[:, 1], vector[:, 0]
    return result
