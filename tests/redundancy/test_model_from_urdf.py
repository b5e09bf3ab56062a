"""The model read from URDF against one built by hand through Pinocchio's interface."""

import numpy as np
import pinocchio as pin
import pytest
from helpers.by_hand import build_by_hand
from helpers.numerics import relative_difference
from helpers.states import State
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.structure.urdf import urdf_text, write_sidecar


@pytest.fixture
def by_hand(any_system: ow.System) -> pin.Model:
    return build_by_hand(any_system).model


def test_joints_are_the_same(any_system: ow.System, by_hand: pin.Model) -> None:
    """Names, order, parents and places."""
    model = any_system.pin_model
    assert list(model.names) == list(by_hand.names)
    assert list(model.parents) == list(by_hand.parents)
    for read, built in zip(model.jointPlacements, by_hand.jointPlacements, strict=True):
        assert_allclose(read.homogeneous, built.homogeneous, rtol=1e-14, atol=1e-14)


def test_bodies_are_the_same(any_system: ow.System, by_hand: pin.Model) -> None:
    """Mass, centre and inertia survive the 17 digits of the text."""
    pairs = zip(any_system.pin_model.inertias, by_hand.inertias, strict=True)
    for number, (read, built) in enumerate(pairs):
        if number == 0:  # What is fixed to the world does not move.
            continue
        assert read.mass == pytest.approx(built.mass, rel=1e-15)
        assert_allclose(read.lever, built.lever, rtol=1e-13, atol=1e-13)
        scale = np.abs(built.inertia).max()
        assert_allclose(read.inertia, built.inertia, rtol=0, atol=1e-13 * scale)


def test_motion_needs_the_same_forces(
    any_system: ow.System, by_hand: pin.Model, state: State
) -> None:
    """Inverse dynamics in a state far from rest."""
    model = any_system.pin_model
    read = pin.rnea(model, model.createData(), state.q, state.v, state.a)
    built = pin.rnea(by_hand, by_hand.createData(), state.q, state.v, state.a)
    assert relative_difference(read, built) < 1e-13


def test_mass_of_the_model_is_that_of_the_structure(any_system: ow.System) -> None:
    """Nothing is lost between definition and model: the base, if clamped, stands in the world."""
    chain = any_system.chain
    moving = chain.mass - (0 if chain.free_root else chain.body[0].mass)
    assert pin.computeTotalMass(any_system.pin_model) == pytest.approx(moving, rel=1e-13)


def test_sidecar_carries_the_springs_of_the_system(any_system: ow.System) -> None:
    """Stiffness by joint name equals the system's vector at that joint of the model."""
    chain = any_system.chain
    damping = 0.01 * chain.joint_stiffness
    sidecar = write_sidecar(any_system.turbine, chain, damping, {})
    assert len(sidecar["joint_stiffness"]) == len(chain.node_joints) * chain.elements
    for name, value in sidecar["joint_stiffness"].items():
        index = any_system.pin_model.joints[any_system.pin_model.getJointId(name)].idx_v
        assert value == any_system.joint_stiffness[index]
        assert sidecar["joint_damping"][name] == 0.01 * value
    assert np.all(any_system.joint_stiffness[: chain.roots] == 0)
    heights = [node["z_m"] for node in sidecar["nodes"]]
    assert_allclose(heights, chain.joint_height, rtol=0)
    assert [node["region"] for node in sidecar["nodes"]] == list(chain.region)


def test_text_is_reproducible(any_system: ow.System) -> None:
    """The same chain gives the same text, to the byte."""
    turbine, chain = any_system.turbine, any_system.chain
    assert urdf_text(turbine, chain) == urdf_text(turbine, chain)
