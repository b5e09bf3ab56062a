"""Section loads: what the part above a cut exerts on the part below, from the dynamics.

Pinocchio's joint forces say what the rigid bodies above a node need; the piece between the cut and
that node adds its own need, and the external forces above the cut are taken off.
"""

from __future__ import annotations

import numpy as np

from offwind_pin.dynamics.kinematics import AxisPoints, cross
from offwind_pin.dynamics.system import Equations, Evaluation
from offwind_pin.structure.section import lump
from offwind_pin.turbines.definition import Array


class SectionCuts:
    """Cuts of a chain at fixed heights, the weights of the pieces above them made ready.

    Parameters
    ----------
    equations : of the system
    height : (m,) heights of the cuts in m, from the base to the yaw bearing
    """

    def __init__(self, equations: Equations, height: Array) -> None:
        chain = equations.chain
        self.equations = equations
        self.height = height
        self.points = AxisPoints.on(chain, height)
        node_height = np.append(chain.joint_height, chain.top)
        pieces = [
            lump(equations.system.turbine, low, high)
            for low, high in zip(height, node_height[self.points.body], strict=True)
        ]
        self._mass = np.array([piece.mass for piece in pieces])
        center = np.array([piece.center for piece in pieces])
        self._center = AxisPoints(center, self.points.body, center - chain.origin[self.points.body])
        self._transverse = np.array([piece.transverse for piece in pieces])
        self._axial = np.array([piece.axial for piece in pieces])
        # A soil node at the cut belongs below it, whatever the last digit of its height.
        self._loaded_above = equations.points.height[None, :] > height[:, None] + 1e-9
        # A load at the yaw bearing acts on the assembly above it.
        self._loaded_above |= (equations.points.height == chain.top)[None, :]
        self._gravity = np.array([0.0, 0.0, -equations.system.turbine.site.gravity])

    def loads(self, state: Evaluation, q: Array, v: Array, a: Array) -> Array:
        """(m, 6) section forces in N and moments in N m about the cuts, inertial frame."""
        place = state.motion.points(self.points).position
        force, moment = self._needed_by_bodies(state, q, v, a, place)
        applied = state.forces.force
        torque = cross(state.points.position, applied) + state.forces.moment
        pull = self._loaded_above @ applied
        turn = self._loaded_above @ torque - cross(place, pull)
        return np.concatenate([pull - force, turn - moment], axis=1)

    def _needed_by_bodies(
        self, state: Evaluation, q: Array, v: Array, a: Array, place: Array
    ) -> tuple[Array, Array]:
        """(m, 3) force and moment about the cuts that inertia and gravity above them need."""
        node_force, node_moment = self.equations.node_wrenches(q, v, a)
        top_force, top_moment, top_place = self._needed_by_rna(state, q)
        force = np.vstack([node_force, top_force])[self.points.body]
        moment = np.vstack([node_moment, top_moment])[self.points.body]
        node_place = np.vstack([state.motion.origin[1:], top_place])[self.points.body]
        center = state.motion.points(self._center)
        acceleration = state.motion.point_acceleration(self._center, center, state.twist_rate)
        own = self._mass[:, None] * (acceleration - self._gravity)
        spin = state.motion.twist[self.points.body, 3:]
        spin_rate = state.twist_rate[self.points.body, 3:]
        own_moment = self._turn(center.axis, spin_rate) + cross(spin, self._turn(center.axis, spin))
        total = (
            moment
            + cross(node_place - place, force)
            + own_moment
            + cross(center.position - place, own)
        )
        return force + own, total

    def _turn(self, axis: Array, vector: Array) -> Array:
        """Inertia of the pieces times vectors (m, 3)."""
        along = np.einsum("ni,ni->n", axis, vector)
        return (
            self._transverse[:, None] * vector
            + ((self._axial - self._transverse) * along)[:, None] * axis
        )

    def _needed_by_rna(self, state: Evaluation, q: Array) -> tuple[Array, Array, Array]:
        """Force (3,) and moment (3,) at the yaw bearing that the assembly needs; its place."""
        chain = self.equations.chain
        rotation = self.equations.top_rotation(q)
        bearing = state.motion.origin[-1] + (chain.top - chain.origin[-1]) * state.motion.axis[-1]
        arm = rotation @ chain.rna.center_of_mass
        center = bearing + arm
        spin, rate = state.motion.twist[-1, 3:], state.twist_rate[-1]
        velocity = state.motion.twist[-1, :3] + np.cross(spin, center)
        acceleration = rate[:3] + np.cross(rate[3:], center) + np.cross(spin, velocity)
        force = chain.rna.mass * (acceleration - self._gravity)
        inertia = rotation @ chain.rna.inertia @ rotation.T
        moment = np.cross(arm, force) + inertia @ rate[3:] + np.cross(spin, inertia @ spin)
        return force, moment, bearing
