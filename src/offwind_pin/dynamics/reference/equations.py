"""The equations of motion by Pinocchio: residual, mass matrix and tangents, all exact and dense.

    r(t, q, v, a) = rnea(q, v, a) + K q + D v + R(q, v) - Q(t, q, v, a)

with the joint springs and dampers K, D, the root's restraint R, and the generalised force Q of all
point loads, including the inertia of the added mass. Pinocchio computes the rigid bodies and their
derivatives; everything else acts through the chain's axis.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.acting_loads import (
    all_loads,
    base_excitation_of,
    compiled_loads,
    smooth_ramp,
    split_memory,
)
from offwind_pin.dynamics.base_excitation import BASE
from offwind_pin.dynamics.reference.chain_kinematics import AxisPoints, ChainMotion
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import (
    MOMENT_BY_POSITION,
    MOMENT_BY_SPIN,
    MOMENT_BY_TURN,
    SPIN,
    VELOCITY,
    PointForces,
    PointLoad,
    PointMotion,
    dissipated_power,
)
from offwind_pin.loads.root_restraint import FREE

_RATE = np.r_[VELOCITY, SPIN]
"""Columns of velocity and spin."""


@dataclass(frozen=True, eq=False)
class Evaluation:
    """One evaluation of the chain and its loads.

    motion : of the chain, relative to a base that may move; points, forces : motion of the loaded
    points, and forces on them, those of the added mass first
    """

    motion: ChainMotion
    points: PointMotion
    forces: PointForces


class Equations:
    """Residual, mass matrix and tangents of a system under loads.

    Returned arrays do not refer to Pinocchio's scratch data.

    Attributes
    ----------
    loads : sequence of PointLoad
        Soil, water and given loads; with water the added mass comes first.
    points : AxisPoints
        Loaded points.
    model : Model
        Pinocchio's model.
    data : Data
        Pinocchio's scratch data of this thread.
    last_joint : (N + 1,) int array
        Joint of the model that moves each body.
    """

    def __init__(
        self,
        system: System,
        loads: Sequence[PointLoad],
        ramp_time: float | None,
        memory: Array | None = None,
        ground_motion: GroundMotion | None = None,
    ) -> None:
        self.system = system
        self.chain = system.chain
        self.ramp_time = ramp_time
        self.loads = compiled_loads(all_loads(system, loads))
        self.model, self.data = system.pin_model, system.scratch.data
        self._ground_motion = ground_motion
        self._base_excitation = base_excitation_of(system, self.loads, ground_motion)
        self._ground_now: tuple[float, Array] | None = None
        if ground_motion is not None:
            self.model = pin.Model(system.pin_model)  # its gravity will change
        heights = [np.zeros(0), *(load.height for load in self.loads)]
        self.points = AxisPoints.on(system.chain, np.concatenate(heights))
        edges = np.cumsum([len(height) for height in heights])
        self._parts = [slice(int(a), int(b)) for a, b in itertools.pairwise(edges)]
        root = system.foundation.root
        self._root = FREE if root is None else root.compiled()
        self._memory = [part.copy() for part in split_memory(self.loads, self._root, memory)]
        joints = len(system.chain.node_joints)
        last = system.chain.roots + joints * np.arange(system.chain.elements + 1)
        self.last_joint = [int(joint) for joint in last]

    @property
    def memory(self) -> Array:
        """(m,) memory of soil and foundation; a copy."""
        return np.concatenate(self._memory)

    @memory.setter
    def memory(self, past: Array) -> None:
        self._memory = [part.copy() for part in split_memory(self.loads, self._root, past)]

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        """(nv,) residual generalised forces in N and N m."""
        state = self.inverse_dynamics(time, q, v, a)
        balance = self.data.tau + self.system.joint_stiffness * q + self.system.joint_damping * v
        balance -= state.motion.generalised_force(
            self.points, state.points.position, state.forces.force, state.forces.moment
        )
        if self.chain.roots:
            balance[:6] += self._root.reaction(q[:6], v[:6], self._memory[-1])
        return balance

    def mass(self, q: Array, time: float | None = None) -> Array:
        """(nv, nv) mass matrix dr/da with the added mass; in still water unless a time is given."""
        upper = np.triu(pin.crba(self.model, self.data, q))
        total = upper + np.triu(upper, 1).T
        motion = self.chain_motion(q, np.zeros_like(q))
        points = motion.points(self.points)
        now = 0.0 if time is None else time
        ramp_factor = 0.0 if time is None else float(smooth_ramp(np.array(time), self.ramp_time))
        for load, part, past in zip(self.loads, self._parts, self._memory[:-1], strict=True):
            if not load.inertial:
                continue
            seen = points if time is None else self._seen(now, points)
            tangents = load.tangents(now, seen[part], ramp_factor, past)
            moved = motion.position_derivatives(self.points[part], points[part].position)
            change = np.einsum("nij,njk->nik", tangents.inertia, moved)
            total -= np.tensordot(moved, change, axes=([0, 1], [0, 1]))
        return total

    def tangents(
        self, time: float, q: Array, v: Array, a: Array | None = None
    ) -> tuple[Array, Array]:
        """Stiffness dr/dq and damping dr/dv, both (nv, nv), exact; a is zero unless given."""
        rate = np.zeros_like(q) if a is None else a
        by_q, by_v, _ = self._load_tangents(time, q, v, rate)
        self._lean(time)
        pin.computeRNEADerivatives(self.model, self.data, q, v, rate)
        stiffness = by_q + self.data.dtau_dq + np.diag(self.system.joint_stiffness)
        damping = by_v + self.data.dtau_dv + np.diag(self.system.joint_damping)
        if self.chain.roots:
            by_displacement, by_rate = self._root.tangents(q[:6], v[:6], self._memory[-1])
            stiffness[:6, :6] += by_displacement
            damping[:6, :6] += by_rate
        return stiffness, damping

    def dissipation(self, q: Array, vectors: Array) -> Array:
        """(L + 1, n) power that each load and, last, the root dissipates at rest in q, in W.

        vectors : (nv, n) small joint velocities
        """
        rest = np.zeros_like(q)
        points = self.chain_motion(q, rest).points(self.points)
        powers = np.zeros((len(self.loads) + 1, vectors.shape[1]))
        moving = [self.chain_motion(q, vector).points(self.points) for vector in vectors.T]
        parts = zip(self.loads, self._parts, self._memory[:-1], strict=True)
        for n, (load, part, past) in enumerate(parts):
            blocks = load.tangents(0.0, points[part], 0.0, past).blocks()
            for i, rates in enumerate(moving):
                rate = rates.columns()[part][:, _RATE]
                powers[n, i] = dissipated_power(load, blocks, rate)
        if self.chain.roots:
            _, damping = self._root.tangents(q[:6], rest[:6], self._memory[-1])
            powers[-1] = np.sum(vectors[:6] * (damping @ vectors[:6]), axis=0)
        return powers

    def acceleration(self, time: float, q: Array, v: Array) -> Array:
        """(nv,) acceleration that satisfies the equations."""
        rhs = self.residual(time, q, v, np.zeros_like(q))
        return np.asarray(-np.linalg.solve(self.mass(q, time), rhs))

    def evaluate(self, time: float, q: Array, v: Array, a: Array) -> Evaluation:
        """Motion of the chain and of the loaded points, and every point force.

        In an earthquake the motion is relative to the base; loads receive the motion that they
        refer to.
        """
        motion = self.chain_motion(q, v, a)
        points = motion.points(self.points)
        seen = self._seen(time, points)
        force, moment = np.zeros((2, len(self.points.height), 3))
        ramp_factor = float(smooth_ramp(np.array(time), self.ramp_time))
        for load, part, past in zip(self.loads, self._parts, self._memory[:-1], strict=True):
            result = load.forces(time, seen[part], ramp_factor, past)
            force[part], moment[part] = result.force, result.moment
        return Evaluation(motion, points, PointForces(force, moment))

    def inverse_dynamics(self, time: float, q: Array, v: Array, a: Array) -> Evaluation:
        """The same, with Pinocchio's data as computed by rnea in that state."""
        state = self.evaluate(time, q, v, a)
        self._lean(time)
        pin.rnea(self.model, self.data, q, v, a)
        return state

    def commit(self, time: float, q: Array, v: Array, a: Array) -> None:
        """End a step: update the memory of loads and root to a state."""
        seen = self._seen(time, self.chain_motion(q, v, a).points(self.points))
        ramp_factor = float(smooth_ramp(np.array(time), self.ramp_time))
        for load, part, past in zip(self.loads, self._parts, self._memory[:-1], strict=True):
            if load.memory_size:
                load.commit(seen[part], past, time, ramp_factor)
        if self.chain.roots:
            self._root.commit(q[:6], self._memory[-1])

    def _ground(self, time: float) -> Array:
        """(P + 1, 3, 3) ground's displacement, velocity, acceleration at points and base."""
        if self._ground_motion is None:
            return self._base_excitation.at(np.zeros((0, 3, 3)))
        # A step asks for one instant again and again.
        if self._ground_now is None or self._ground_now[0] != time:
            moved = self._ground_motion.motion(np.array([time]))[0]
            self._ground_now = time, self._base_excitation.at(moved)
        return self._ground_now[1]

    def _lean(self, time: float) -> None:
        """Set gravity as seen from the accelerating base."""
        if self._ground_motion is not None:
            own = self.system.pin_model.gravity.linear
            self.model.gravity.linear = own - self._ground(time)[BASE, 2]

    def _seen(self, time: float, points: PointMotion) -> PointMotion:
        """Motion that loads refer to: absolute, for the soil relative to the ground.

        points : relative to the base
        """
        if self._ground_motion is None:
            return points
        ground = self._ground(time)
        moved = ground[BASE] - ground[:-1]
        acceleration = points.acceleration
        return replace(
            points,
            position=points.position + ground[BASE, 0],
            displacement=points.displacement + moved[:, 0],
            velocity=points.velocity + moved[:, 1],
            acceleration=None if acceleration is None else acceleration + ground[BASE, 2],
        )

    def worst_joint(self, residual: Array) -> tuple[str, float]:
        """Name and size of the largest entry of a residual."""
        worst = int(np.argmax(np.where(np.isfinite(residual), np.abs(residual), np.inf)))
        return self.chain.joint_name[worst], float(abs(residual[worst]))

    def chain_motion(self, q: Array, v: Array, a: Array | None = None) -> ChainMotion:
        """Motion of the chain's axis."""
        pin.computeJointJacobiansTimeVariation(self.model, self.data, q, v)
        rate = np.zeros_like(q) if a is None else a
        rotation = np.array([self.data.oMi[joint].rotation for joint in self.last_joint])
        jacobian, its_rate = np.array(self.data.J), np.array(self.data.dJ)
        return ChainMotion(self.chain, jacobian, its_rate, rotation, q, v, rate)

    def _load_tangents(
        self, time: float, q: Array, v: Array, a: Array
    ) -> tuple[Array, Array, Array]:
        """(nv, nv) derivatives of minus the loads' generalised force by q, v and a."""
        state = self.evaluate(time, q, v, a)
        seen = self._seen(time, state.points)
        ramp_factor = float(smooth_ramp(np.array(time), self.ramp_time))
        by_q, by_v, by_a = np.zeros((3, len(q), len(q)))
        derivatives = state.motion.derivatives(self.points, state.points)
        for load, part, past in zip(self.loads, self._parts, self._memory[:-1], strict=True):
            tangents = load.tangents(time, seen[part], ramp_factor, past)
            how = derivatives[part]
            change = np.einsum("nij,njk->nik", tangents.stiffness, how.position)
            change += np.einsum("nij,njk->nik", tangents.damping, how.velocity_by_q)
            change += np.einsum("nij,njk->nik", tangents.inertia, how.acceleration_by_q)
            change += np.einsum("nij,njk->nik", tangents.turning, how.axis)
            by_q -= np.tensordot(how.position, change, axes=([0, 1], [0, 1]))
            change = np.einsum("nij,njk->nik", tangents.damping, how.position)
            change += np.einsum("nij,njk->nik", tangents.inertia, how.acceleration_by_v)
            by_v -= np.tensordot(how.position, change, axes=([0, 1], [0, 1]))
            change = np.einsum("nij,njk->nik", tangents.inertia, how.position)
            by_a -= np.tensordot(how.position, change, axes=([0, 1], [0, 1]))
            blocks = tangents.blocks()
            if np.any(blocks[:, MOMENT_BY_POSITION:]):
                change = np.einsum("nij,njk->nik", blocks[:, MOMENT_BY_POSITION], how.position)
                change += np.einsum("nij,njk->nik", blocks[:, MOMENT_BY_TURN], how.turn)
                change += np.einsum("nij,njk->nik", blocks[:, MOMENT_BY_SPIN], how.spin_by_q)
                by_q -= np.tensordot(how.rotation, change, axes=([0, 1], [0, 1]))
                change = np.einsum("nij,njk->nik", blocks[:, MOMENT_BY_SPIN], how.rotation)
                by_v -= np.tensordot(how.rotation, change, axes=([0, 1], [0, 1]))
            if load.coupling is not None:
                wrench, rate = load.coupling
                by_speed = _sums(wrench, how.position, how.rotation)
                moved = _sums(wrench, how.velocity_by_q, how.spin_by_q)
                by_v += by_speed.T @ (rate[:, None] * by_speed)
                by_q += by_speed.T @ (rate[:, None] * moved)
        by_q -= state.motion.geometric_stiffness(
            self.points, state.points.position, state.forces.force, state.forces.moment
        )
        return by_q, by_v, by_a


def _sums(wrench: Array, linear: Array, angular: Array) -> Array:
    """(k, nv) weighted sums of derivatives (n, 3, nv) of velocities and spins of points.

    wrench : (k, n, 6) weights
    """
    by_velocity = np.tensordot(wrench[..., :3], linear, axes=([1, 2], [0, 1]))
    return np.asarray(by_velocity + np.tensordot(wrench[..., 3:], angular, axes=([1, 2], [0, 1])))
