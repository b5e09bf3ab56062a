"""Motion of axis points and generalised forces against Pinocchio's frames, point by point."""

from dataclasses import astuple

import numpy as np
import pinocchio as pin
import pytest
from helpers.numerics import relative_difference
from helpers.point_loads import Probe
from helpers.poses import body_poses
from helpers.states import State
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.reference.chain_kinematics import AxisPoints
from offwind_pin.loads.point_load import PointMotion

Array = NDArray[np.float64]
WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
TOLERANCE = 1e-12


class Frames:
    """A frame of Pinocchio's own at each height, carried by the body that is there."""

    def __init__(self, system: ow.System, height: Array, state: State) -> None:
        self.model = pin.Model(system.pin_model)
        chain = system.chain
        self.ids: list[int] = []
        self.places: list[tuple[int, pin.SE3]] = []
        for z, body in zip(height, chain.body_at(height), strict=True):
            joint = chain.roots + len(chain.node_joints) * int(body)
            origin = chain.origin[body] if joint else 0.0
            placement = pin.SE3(np.eye(3), np.array([0.0, 0.0, z - origin]))
            frame = pin.Frame(f"at {z}", joint, placement, pin.FrameType.OP_FRAME)
            self.ids.append(self.model.addFrame(frame))
            self.places.append((joint, placement))
        self.data = self.model.createData()
        self.state = state
        pin.forwardKinematics(self.model, self.data, state.q, state.v, state.a)
        pin.updateFramePlacements(self.model, self.data)

    def position(self) -> Array:
        return np.array([self.data.oMf[i].translation for i in self.ids])

    def axis(self) -> Array:
        return np.array([self.data.oMf[i].rotation[:, 2] for i in self.ids])

    def velocity(self) -> Array:
        return np.array(
            [pin.getFrameVelocity(self.model, self.data, i, WORLD).linear for i in self.ids]
        )

    def acceleration(self) -> Array:
        return np.array(
            [
                pin.getFrameClassicalAcceleration(self.model, self.data, i, WORLD).linear
                for i in self.ids
            ]
        )

    def axis_by_q(self) -> Array:
        """(n, 3, nv) derivatives of the axis: angular Jacobian times axis."""
        return -np.cross(self.axis()[:, :, None], self.jacobians()[:, 3:], axis=1)

    def acceleration_derivatives(self) -> tuple[Array, Array, Array, Array]:
        """Each (n, 3, nv): of the velocity by q, and of the acceleration by q, v and a."""
        model, data, (q, v, a) = self.model, self.data, astuple(self.state)
        pin.computeForwardKinematicsDerivatives(model, data, q, v, a)
        rows = [
            pin.getPointClassicAccelerationDerivatives(model, data, joint, placement, WORLD)
            if joint
            else [np.zeros((3, model.nv))] * 4
            for joint, placement in self.places
        ]
        by_q, acceleration_by_q, acceleration_by_v, by_a = (
            np.array(part) for part in zip(*rows, strict=True)
        )
        return by_q, acceleration_by_q, acceleration_by_v, by_a

    def jacobians(self) -> Array:
        """(n, 6, nv)."""
        return np.array(
            [
                pin.computeFrameJacobian(self.model, self.data, self.state.q, i, WORLD).copy()
                for i in self.ids
            ]
        )


@pytest.fixture
def height(any_system: ow.System) -> Array:
    """Points all along, at the ends and at a joint."""
    chain = any_system.chain
    inside = chain.base + (chain.top - chain.base) * np.random.default_rng(2).uniform(0, 1, 12)
    return np.concatenate([[chain.base, chain.joint_height[2], chain.top], inside])


def assert_same_motion(found: PointMotion, frames: Frames, height: Array) -> None:
    """Every part of the motion of points, as frame kinematics has it."""
    undeformed = np.column_stack([np.zeros((len(height), 2)), height])
    assert relative_difference(found.position, frames.position()) < TOLERANCE
    assert relative_difference(found.displacement, frames.position() - undeformed) < TOLERANCE
    assert relative_difference(found.velocity, frames.velocity()) < TOLERANCE
    assert relative_difference(found.axis, frames.axis()) < TOLERANCE
    assert found.acceleration is not None
    assert relative_difference(found.acceleration, frames.acceleration()) < TOLERANCE


def test_positions_velocities_accelerations(
    any_system: ow.System, state: State, height: Array
) -> None:
    """Cumulative sums along the chain give what frame kinematics gives."""
    motion = any_system.equations().chain_motion(state.q, state.v, state.a)
    assert_same_motion(motion.points_at(height), Frames(any_system, height, state), height)


def test_loads_are_shown_the_same_motion(
    any_system: ow.System, state: State, height: Array
) -> None:
    """A load at the points is shown it, by Pinocchio's equations as by the compiled recursion."""
    frames, probe = Frames(any_system, height, state), Probe(height)
    any_system.equations([probe]).residual(0.0, state.q, state.v, state.a)
    assert_same_motion(probe.seen.pop(), frames, height)
    chain = CompiledChain(any_system, [probe])
    chain.residual(chain.time_inputs(np.zeros(1))[0], state.q, state.v, state.a)
    assert_same_motion(probe.seen.pop(), frames, height)


def test_records_show_the_same_motion(any_system: ow.System, state: State, height: Array) -> None:
    """So do the compiled records at cuts."""
    frames, chain = Frames(any_system, height, state), CompiledChain(any_system)
    row = chain.time_inputs(np.zeros(1))[0]
    record = chain.record(chain.sections(height), row, state.q, state.v, state.a)
    undeformed = np.column_stack([np.zeros((len(height), 2)), height])
    assert relative_difference(record.displacement[0], frames.position() - undeformed) < TOLERANCE
    assert relative_difference(record.acceleration[0], frames.acceleration()) < TOLERANCE


def test_a_joint_that_does_not_turn_is_seen(
    any_system: ow.System, state: State, height: Array
) -> None:
    """Negative control: a thousandth of a radian at one joint is another motion."""
    frames = Frames(any_system, height, state)
    bent = state.q.copy()
    chain = any_system.chain
    bent[chain.axis_joints - 1 - len(chain.node_joints)] += 1e-3
    motion = any_system.equations().chain_motion(bent, state.v, state.a)
    assert relative_difference(motion.points_at(height).velocity, frames.velocity()) > 1e-6


def test_top_rotation(any_system: ow.System, state: State) -> None:
    """The assembly turns with the last body."""
    frames = Frames(any_system, np.array([any_system.chain.top]), state)
    expected = frames.data.oMf[frames.ids[0]].rotation
    poses = body_poses(any_system, state.q)
    assert relative_difference(poses[-1, :3, :3], expected) < TOLERANCE
    chain = CompiledChain(any_system)
    chain.residual(chain.time_inputs(np.zeros(1))[0], state.q, state.v, state.a)
    assert relative_difference(chain.data.rotation, poses[:, :3, :3]) < TOLERANCE


def test_derivatives_of_the_motion(any_system: ow.System, state: State, height: Array) -> None:
    """How the points' motion depends on q, v and a, against Pinocchio's own derivatives."""
    frames = Frames(any_system, height, state)
    motion = any_system.equations().chain_motion(state.q, state.v, state.a)
    points = AxisPoints.on(any_system.chain, height)
    found = motion.derivatives(points, motion.points(points))
    velocity_by_q, acceleration_by_q, acceleration_by_v, by_a = frames.acceleration_derivatives()
    assert relative_difference(found.position, frames.jacobians()[:, :3]) < TOLERANCE
    assert relative_difference(found.position, by_a) < TOLERANCE
    assert relative_difference(found.axis, frames.axis_by_q()) < TOLERANCE
    assert relative_difference(found.velocity_by_q, velocity_by_q) < TOLERANCE
    assert relative_difference(found.acceleration_by_q, acceleration_by_q) < TOLERANCE
    assert relative_difference(found.acceleration_by_v, acceleration_by_v) < TOLERANCE


def test_generalised_force_is_virtual_work(
    any_system: ow.System, state: State, height: Array
) -> None:
    """Q = sum J' (f, m) with the frame Jacobians."""
    rng = np.random.default_rng(3)
    force, moment = rng.normal(size=(2, len(height), 3))
    jacobian = Frames(any_system, height, state).jacobians()
    wrench = np.concatenate([force, moment], axis=1)
    expected = np.einsum("nij,ni->j", jacobian, wrench)
    motion = any_system.equations().chain_motion(state.q, state.v)
    points = AxisPoints.on(any_system.chain, height)
    position = motion.points(points).position
    found = motion.generalised_force(points, position, force, moment)
    assert relative_difference(found, expected) < TOLERANCE
