"""The mass matrix by three ways: composite bodies, Newton-Euler, the residual."""

from importlib import metadata

import numpy as np
import pinocchio as pin
from helpers.numerics import relative_difference
from helpers.states import State, element_of

import offwind_pin as ow


def test_composite_bodies_equal_newton_euler(any_system: ow.System, state: State) -> None:
    """Column j of M is the joint force that a unit acceleration of joint j needs."""
    model, data = any_system.pin_model, any_system.pin_model.createData()
    upper = np.triu(pin.crba(model, data, state.q))
    mass = upper + np.triu(upper, 1).T
    rest = np.zeros(model.nv)
    gravity = pin.rnea(model, data, state.q, rest, rest)
    columns = [pin.rnea(model, data, state.q, rest, unit) - gravity for unit in np.eye(model.nv)]
    # The weight is subtracted: a tenth of the largest entries' size, no digits lost.
    assert relative_difference(mass, np.array(columns).T) < 1e-12


def test_mass_is_the_slope_of_the_residual(any_system: ow.System, state: State) -> None:
    """dr/da, added mass included, in a moving state; r is linear in a, so any step is exact."""
    equations = any_system.equations()
    still = equations.residual(0.0, state.q, state.v, np.zeros(any_system.nv))
    columns = [
        equations.residual(0.0, state.q, state.v, unit) - still for unit in np.eye(any_system.nv)
    ]
    assert relative_difference(equations.mass(state.q), np.array(columns).T) < 1e-9


def test_added_mass_is_in_it(any_system: ow.System) -> None:
    """Negative control: the dry mass matrix is not the wet one.

    The water over the wetted monopile weighs rho pi D^2/4 h = 1.956e6 kg; moved sideways as a whole
    it is added once.
    """
    element = element_of(any_system)
    dry = ow.build(any_system.turbine, any_system.foundation.name, elements=7, element=element)
    rest = np.zeros(dry.nv)
    extra = any_system.equations().mass(rest) - dry.equations().mass(rest)
    water = 1025.0 * np.pi / 4 * 81.0 * 30.0
    if any_system.chain.free_root:
        assert np.allclose(np.diag(extra)[:2], water, rtol=1e-12)
        assert abs(extra[2, 2]) < 1e-9 * water
    assert np.max(np.abs(extra)) > water


def test_mass_is_symmetric_positive_definite(any_system: ow.System, state: State) -> None:
    """Kinetic energy is positive for every motion."""
    mass = any_system.equations().mass(state.q)
    assert np.array_equal(mass, mass.T) or relative_difference(mass, mass.T) < 1e-14
    assert np.linalg.eigvalsh(mass)[0] > 0


def test_a_robot_passes_the_same_check() -> None:
    """The Newton-Euler check on a robot arm of example-robot-data, as a check of the check."""
    robots = metadata.distribution("example-robot-data")
    urdf = "cmeel.prefix/share/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf"
    model = pin.buildModelFromUrdf(str(robots.locate_file(urdf)))
    assert model.nv == 6
    data, rng = model.createData(), np.random.default_rng(1)
    q, rest = rng.uniform(-1, 1, model.nq), np.zeros(model.nv)
    upper = np.triu(pin.crba(model, data, q))
    gravity = pin.rnea(model, data, q, rest, rest)
    columns = [pin.rnea(model, data, q, rest, unit) - gravity for unit in np.eye(model.nv)]
    assert relative_difference(upper + np.triu(upper, 1).T, np.array(columns).T) < 1e-12
