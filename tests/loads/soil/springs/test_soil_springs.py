"""Springs along the pile: lengths, directions, rotation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.soil.foundation import distributed_springs
from offwind_pin.loads.soil.springs.elastic import SoilSprings


@pytest.fixture(scope="session")
def soil(oc6: ow.Turbine) -> SoilSprings:
    """The shipped surrogate."""
    load = distributed_springs(oc6).soil[0]
    assert isinstance(load, SoilSprings)
    return load


def motion(soil: SoilSprings, displacement: Array, velocity: Array) -> PointMotion:
    """The same displacement and velocity (3,) at every node."""
    n = len(soil.height)
    place = np.zeros((n, 3))
    place[:, 2] = soil.height
    u, v = np.tile(displacement, (n, 1)), np.tile(velocity, (n, 1))
    return PointMotion(place + u, u, v, np.tile([0.0, 0.0, 1.0], (n, 1)))


def test_tributary_lengths_make_up_the_pile(soil: SoilSprings) -> None:
    """61 nodes 0.75 m apart; the end nodes stand for half, all together for 45 m."""
    assert len(soil.height) == 61
    assert_allclose(-np.diff(soil.height), 0.75, rtol=1e-12)
    assert soil.tributary_length.sum() == pytest.approx(45.0, rel=1e-14)
    assert_allclose(soil.tributary_length[[0, 30, -1]], [0.375, 0.75, 0.375], rtol=1e-12)


def test_size_of_the_force(soil: SoilSprings) -> None:
    """Each node takes p(|u|) l_s, |u| the horizontal distance and not its components."""
    force = soil.forces(0.0, motion(soil, np.array([0.03, 0.04, 0.0]), np.zeros(3)), 1.0).force
    expected = soil.curves.resistance(np.full(61, 0.05)) * soil.tributary_length
    assert_allclose(np.linalg.norm(force, axis=1), expected, rtol=1e-12)


@settings(max_examples=30, deadline=None)
@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-0.1, 0.1))
def test_force_opposes_the_horizontal_displacement(
    soil: SoilSprings, x: float, y: float, z: float
) -> None:
    """Antiparallel to (ux, uy) at every node, and never vertical."""
    force = soil.forces(0.0, motion(soil, np.array([x, y, z]), np.zeros(3)), 1.0).force
    size = np.linalg.norm(force, axis=1)
    assert_allclose(force[:, 0] * y, force[:, 1] * x, atol=1e-12 * size.max() + 1e-300)
    assert np.all(force @ [x, y, 0.0] <= 0)
    assert np.all(force[:, 2] == 0)
    if np.hypot(x, y) > 1e-3:
        assert size[1:].min() > 0


@settings(max_examples=30, deadline=None)
@given(st.floats(0.0, 2 * np.pi), st.floats(-0.3, 0.3), st.floats(-2.0, 2.0))
def test_turning_the_motion_turns_the_force(
    soil: SoilSprings, angle: float, displacement: float, velocity: float
) -> None:
    """The soil has no preferred direction: rotation about z commutes with the law."""
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    u, v = np.array([displacement, 0.02, 0.0]), np.array([0.1, velocity, 0.0])
    force = soil.forces(0.0, motion(soil, u, v), 1.0).force
    turned = soil.forces(0.0, motion(soil, turn @ u, turn @ v), 1.0).force
    assert_allclose(turned, force @ turn.T, rtol=0, atol=1e-12 * np.abs(force).max())
