"""Chain, foundation, sea and loads as one system: residual, mass matrix, tangents.

    r(t, q, v, a) = rnea(q, v, a) + K q + D v + R(q, v) - Q(t, q, v, a)

with the joint springs and dampers K, D, the root's restraint R, and the generalised force Q of all
point loads, the added mass's inertia included. Pinocchio gives the rigid bodies; everything else
acts through the chain's axis.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import pinocchio as pin

from offwind_pin.dynamics.foundations import Foundation
from offwind_pin.dynamics.kinematics import AxisPoints, ChainMotion, cross
from offwind_pin.dynamics.sea import Sea, added_mass, water_load
from offwind_pin.errors import InputError
from offwind_pin.loads.morison import AddedMass, normal_part
from offwind_pin.loads.points import PointForces, PointLoad, PointMotion
from offwind_pin.structure.chain import Chain
from offwind_pin.structure.model import Scratch
from offwind_pin.turbines.definition import Array, Turbine


@dataclass(frozen=True, eq=False)
class System:
    """A turbine on its foundation in its sea, ready to be solved.

    Attributes
    ----------
    turbine, foundation, chain : what was built
    sea : None for a dry structure
    pin_model : the ``pinocchio.Model``, read-only by agreement
    joint_stiffness, joint_damping : (nv,) of the chain's springs and dampers, zero at the root
    damping_ratios : achieved ratios of the calibrated modes by label, for the record
    scratch : Pinocchio's working memory, one for each thread
    """

    turbine: Turbine
    foundation: Foundation
    chain: Chain
    sea: Sea | None
    pin_model: pin.Model
    joint_stiffness: Array
    joint_damping: Array
    damping_ratios: dict[str, float]
    scratch: Scratch = field(repr=False)

    @property
    def nv(self) -> int:
        return int(self.pin_model.nv)

    def with_damping(self, joint_damping: Array, ratios: dict[str, float]) -> System:
        """The same system with other joint dampers."""
        return replace(self, joint_damping=joint_damping, damping_ratios=ratios)

    def equations(self, loads: Sequence[PointLoad] = (), ramp_time: float = 0.0) -> Equations:
        """Equations of motion under loads.

        ramp_time : seconds over which waves, and the loads' departures from their means, rise; an
            infinite one keeps them away, as for statics and modes
        """
        return Equations(self, loads, ramp_time)


@dataclass(frozen=True, eq=False)
class Evaluation:
    """One evaluation of the chain and its loads.

    motion : of the chain; twist_rate : (N + 1, 6) of its bodies; points, forces : motion of the
    loaded points and forces there, the added mass's inertia first and included
    """

    motion: ChainMotion
    twist_rate: Array
    points: PointMotion
    forces: PointForces


class Equations:
    """Residual, mass matrix and tangents of a system under loads.

    Nothing returned points into Pinocchio's scratch data.
    """

    def __init__(self, system: System, loads: Sequence[PointLoad], ramp_time: float) -> None:
        self.system = system
        self.chain = system.chain
        self.ramp_time = ramp_time
        self._model, self._data = system.pin_model, system.scratch.data
        self.water = _added_mass(system)
        self.loads = _all_loads(system, loads)
        heights = [self.water.height, *(load.height for load in self.loads)]
        _check_heights(system, self.loads)
        self.points = AxisPoints.on(system.chain, np.concatenate(heights))
        edges = np.cumsum([0, *(len(h) for h in heights)])
        self._wet = slice(0, int(edges[1]))
        self._parts = [slice(int(a), int(b)) for a, b in itertools.pairwise(edges[1:])]

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        """(nv,) generalised forces out of balance, in N and N m."""
        state = self.evaluate(time, q, v, a)
        return self._balance(state, q, v, pin.rnea(self._model, self._data, q, v, a))

    def mass(self, q: Array) -> Array:
        """(nv, nv) mass matrix with the added mass."""
        upper = np.triu(pin.crba(self._model, self._data, q))
        mass = upper + np.triu(upper, 1).T
        motion = self.chain_motion(q, np.zeros_like(q))
        wet = self._subset(self._wet)
        points = motion.points(wet)
        projector = np.eye(3) - np.einsum("ni,nj->nij", points.axis, points.axis)
        blocks = self.water.mass[:, None, None] * projector
        return mass + motion.congruence(wet, points.position, blocks)

    def tangents(self, time: float, q: Array, v: Array) -> tuple[Array, Array]:
        """Stiffness dr/dq and damping dr/dv, both (nv, nv), at zero acceleration.

        Exact at rest in still water. In motion the terms of the bodies' and the water's inertia
        that depend on velocity are left out, in waves the turning of the axis they act normal to.
        """
        state = self.evaluate(time, q, v, np.zeros_like(q))
        rise = smooth_ramp(time, self.ramp_time)
        position = state.points.position
        gravity = pin.computeGeneralizedGravityDerivatives(self._model, self._data, q)
        stiffness = np.array(gravity) + np.diag(self.system.joint_stiffness)
        damping = np.diag(self.system.joint_damping)
        blocks = [load.tangents(time, state.points[part], rise) for load, part in self._each_load()]
        if blocks:
            loaded = self._subset(slice(self._wet.stop, None))
            place = position[self._wet.stop :]
            by_position = np.concatenate([block.stiffness for block in blocks])
            by_velocity = np.concatenate([block.damping for block in blocks])
            stiffness -= state.motion.congruence(loaded, place, by_position)
            damping -= state.motion.congruence(loaded, place, by_velocity)
        stiffness -= state.motion.geometric_stiffness(
            self.points, position, state.forces.force, state.forces.moment
        )
        if self.system.foundation.root is not None:
            by_q, by_v = self.system.foundation.root.tangents(q[:6], v[:6])
            stiffness[:6, :6] += by_q
            damping[:6, :6] += by_v
        return stiffness, damping

    def evaluate(self, time: float, q: Array, v: Array, a: Array) -> Evaluation:
        """Motion of the chain and of the loaded points, and every point force."""
        motion = self.chain_motion(q, v)
        points = motion.points(self.points)
        force, moment = np.zeros((2, len(self.points.height), 3))
        rise = smooth_ramp(time, self.ramp_time)
        for load, part in self._each_load():
            result = load.forces(time, points[part], rise)
            force[part], moment[part] = result.force, result.moment
        rate = motion.twist_rate(np.array(self._data.dJ), v, a)
        wet, moving = self._subset(self._wet), points[self._wet]
        acceleration = motion.point_acceleration(wet, moving, rate)
        force[self._wet] = -self.water.mass[:, None] * normal_part(acceleration, moving.axis)
        return Evaluation(motion, rate, points, PointForces(force, moment))

    def node_wrenches(self, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """What the rigid bodies above each node of joints need: Pinocchio's joint forces.

        Inertia and gravity of the bodies are in it, other loads are not.

        Returns
        -------
        force, moment : (N, 3) on the part above, in the inertial frame, in N and in N m about the
            node
        """
        jacobian = self.chain_motion(q, v).jacobian
        pin.rnea(self._model, self._data, q, v, a)
        nodes = range(1 + self.chain.roots, self._model.njoints, 3)
        local = np.array([self._data.f[joint].vector for joint in nodes])
        about_x = jacobian[3:, self.chain.roots :: 3].T
        about_y = jacobian[3:, self.chain.roots + 1 :: 3].T
        frame = np.stack([about_x, about_y, cross(about_x, about_y)], axis=2)
        return (
            np.einsum("nij,nj->ni", frame, local[:, :3]),
            np.einsum("nij,nj->ni", frame, local[:, 3:]),
        )

    def top_rotation(self, q: Array) -> Array:
        """(3, 3) orientation of the rotor-nacelle assembly."""
        pin.forwardKinematics(self._model, self._data, q)
        return np.array(self._data.oMi[self._model.njoints - 1].rotation)

    def worst_joint(self, residual: Array) -> tuple[str, float]:
        """Name and size of the largest entry of a residual."""
        worst = int(np.argmax(np.where(np.isfinite(residual), np.abs(residual), np.inf)))
        return self.chain.joint_name[worst], float(abs(residual[worst]))

    def chain_motion(self, q: Array, v: Array) -> ChainMotion:
        """Motion of the chain's axis."""
        pin.computeJointJacobiansTimeVariation(self._model, self._data, q, v)
        root = q[:3] if self.chain.free_root else np.zeros(3)
        return ChainMotion(self.chain, np.array(self._data.J), root, v)

    def _balance(self, state: Evaluation, q: Array, v: Array, bodies: Array) -> Array:
        balance = bodies + self.system.joint_stiffness * q + self.system.joint_damping * v
        balance -= state.motion.generalised_force(
            self.points, state.points.position, state.forces.force, state.forces.moment
        )
        if self.system.foundation.root is not None:
            balance[:6] += self.system.foundation.root.reaction(q[:6], v[:6])
        return balance

    def _each_load(self) -> zip[tuple[PointLoad, slice]]:
        return zip(self.loads, self._parts, strict=True)

    def _subset(self, part: slice) -> AxisPoints:
        return AxisPoints(
            self.points.height[part], self.points.body[part], self.points.offset[part]
        )


def smooth_ramp(time: float, duration: float) -> float:
    """Half a cosine from 0 at time 0 to 1 at the end of the ramp."""
    if time >= duration:
        return 1.0
    return 0.5 * (1 - math.cos(math.pi * max(time, 0.0) / duration))


def _added_mass(system: System) -> AddedMass:
    if system.sea is None:
        return AddedMass(np.zeros(0), np.zeros(0))
    return added_mass(system.turbine)


def _all_loads(system: System, loads: Sequence[PointLoad]) -> list[PointLoad]:
    water = [] if system.sea is None else [water_load(system.turbine, system.sea)]
    return [*system.foundation.soil, *water, *loads]


def _check_heights(system: System, loads: Sequence[PointLoad]) -> None:
    for load in loads:
        outside = (load.height < system.chain.base) | (load.height > system.chain.top)
        if np.any(outside):
            raise InputError(
                f"load {load.name!r}, height",
                float(load.height[outside][0]),
                f"{system.chain.base} to {system.chain.top} m",
                "Loads act on the axis of the structure.",
            )
