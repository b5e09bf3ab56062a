"""Motion of axis points and generalised forces against Pinocchio's frames, point by point."""

import numpy as np
import pinocchio as pin
import pytest
from helpers.numerics import relative_difference
from helpers.states import State
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.dynamics.kinematics import AxisPoints

Array = NDArray[np.float64]
WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
TOLERANCE = 1e-12


class Frames:
    """A frame of Pinocchio's own at each height, carried by the body that is there."""

    def __init__(self, system: ow.System, height: Array, state: State) -> None:
        self.model = pin.Model(system.pin_model)
        chain = system.chain
        self.ids = []
        for z, body in zip(height, chain.body_at(height), strict=True):
            joint = chain.roots + 3 * int(body)
            origin = chain.origin[body] if joint else 0.0
            placement = pin.SE3(np.eye(3), np.array([0.0, 0.0, z - origin]))
            frame = pin.Frame(f"at {z}", joint, placement, pin.FrameType.OP_FRAME)
            self.ids.append(self.model.addFrame(frame))
        self.data = self.model.createData()
        self.q = state.q
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

    def jacobians(self) -> Array:
        """(n, 6, nv)."""
        return np.array(
            [
                pin.computeFrameJacobian(self.model, self.data, self.q, i, WORLD).copy()
                for i in self.ids
            ]
        )


@pytest.fixture
def height(any_system: ow.System) -> Array:
    """Points all along, at the ends and at a joint."""
    chain = any_system.chain
    inside = chain.base + (chain.top - chain.base) * np.random.default_rng(2).uniform(0, 1, 12)
    return np.concatenate([[chain.base, chain.joint_height[2], chain.top], inside])


def test_positions_velocities_accelerations(
    any_system: ow.System, state: State, height: Array
) -> None:
    """Cumulative sums along the chain give what frame kinematics gives."""
    frames = Frames(any_system, height, state)
    equations = any_system.equations()
    motion = equations.chain_motion(state.q, state.v)
    points = AxisPoints.on(any_system.chain, height)
    found = motion.points(points)
    rate = motion.twist_rate(np.array(equations._data.dJ), state.v, state.a)
    acceleration = motion.point_acceleration(points, found, rate)
    assert relative_difference(found.position, frames.position()) < TOLERANCE
    assert relative_difference(found.axis, frames.axis()) < TOLERANCE
    assert relative_difference(found.velocity, frames.velocity()) < TOLERANCE
    assert relative_difference(acceleration, frames.acceleration()) < TOLERANCE
    undeformed = np.column_stack([np.zeros((len(height), 2)), height])
    assert relative_difference(found.displacement, frames.position() - undeformed) < TOLERANCE


def test_top_rotation(any_system: ow.System, state: State) -> None:
    """The assembly turns with the last body."""
    frames = Frames(any_system, np.array([any_system.chain.top]), state)
    rotation = any_system.equations().top_rotation(state.q)
    assert relative_difference(rotation, frames.data.oMf[frames.ids[0]].rotation) < TOLERANCE


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


def test_congruence_is_the_sum_over_points(
    any_system: ow.System, state: State, height: Array
) -> None:
    """sum J' B J for blocks without any symmetry."""
    blocks = np.random.default_rng(4).normal(size=(len(height), 3, 3))
    jacobian = Frames(any_system, height, state).jacobians()[:, :3]
    expected = np.einsum("nia,nij,njb->ab", jacobian, blocks, jacobian)
    motion = any_system.equations().chain_motion(state.q, state.v)
    points = AxisPoints.on(any_system.chain, height)
    found = motion.congruence(points, motion.points(points).position, blocks)
    assert relative_difference(found, expected) < TOLERANCE


def test_node_wrenches_project_to_joint_forces(any_system: ow.System, state: State) -> None:
    """The node's moment along each of its three joint axes is what inverse dynamics asks for."""
    equations, model = any_system.equations(), any_system.pin_model
    _, moment = equations.node_wrenches(state.q, state.v, state.a)
    torque = pin.rnea(model, model.createData(), state.q, state.v, state.a)
    axes = equations.chain_motion(state.q, state.v).jacobian[3:, any_system.chain.roots :]
    found = np.einsum("nj,jnk->nk", moment, axes.reshape(3, -1, 3)).ravel()
    assert relative_difference(found, torque[any_system.chain.roots :]) < TOLERANCE
