"""Stiffness and damping of the system against differences of its residual."""

import numpy as np
import pytest
from helpers.numerics import (
    central_differences,
    fourth_order_differences,
    relative_difference,
)
from helpers.states import State, random_state, without_joint_springs
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.dynamics.kinematics import AxisPoints, ChainMotion
from offwind_pin.dynamics.system import Equations
from offwind_pin.loads.tower_top import constant_load

Array = NDArray[np.float64]

TOP_LOAD = np.array([2e6, -7e5, 5e5, 3e7, 4e7, -2e7])
STEP = 1e-4
"""rad; truncation of the five-point differences is about STEP^4 / 30 for motions of unit size, and
rounding 1e-16 / STEP of the residual's size."""
TOLERANCE = 1e-10


def loaded(system: ow.System) -> Equations:
    """Equations under gravity, soil and a tower-top load with moments, waves away."""
    load = constant_load(system.chain.top, TOP_LOAD)
    return without_joint_springs(system).equations([load], ramp_time=np.inf)


def stiffness_error(equations: Equations, state: State, step: float = STEP) -> float:
    rest = np.zeros_like(state.q)
    expected = fourth_order_differences(
        lambda q: equations.residual(0.0, q, rest, rest), state.q, step
    )
    return relative_difference(equations.tangents(0.0, state.q, rest)[0], expected)


def test_geometric_stiffness(any_system: ow.System, state: State) -> None:
    """dQ/dq of forces and moments that keep their direction while the chain turns."""
    rng = np.random.default_rng(6)
    height = any_system.chain.base + 100 * rng.uniform(0, 1, 9)
    force, moment = rng.normal(size=(2, 9, 3))
    points = AxisPoints.on(any_system.chain, height)
    equations, rest = any_system.equations(), np.zeros(any_system.nv)

    def generalised_force(q: Array) -> Array:
        motion = equations.chain_motion(q, rest)
        return motion.generalised_force(points, motion.points(points).position, force, moment)

    motion = equations.chain_motion(state.q, rest)
    found = motion.geometric_stiffness(points, motion.points(points).position, force, moment)
    expected = fourth_order_differences(generalised_force, state.q, STEP)
    assert relative_difference(found, expected) < TOLERANCE


@pytest.mark.parametrize("foundation", ["clamped", "coupled_springs"])
def test_stiffness_with_gravity_and_tower_top_load(undamped: ow.Turbine, foundation: str) -> None:
    """dr/dq on a rigid and on an elastic base, bent by up to 0.1 rad at every joint."""
    system = ow.build(undamped, foundation, ow.StillWater(), elements=7)
    assert stiffness_error(loaded(system), random_state(system)) < TOLERANCE


def test_stiffness_with_linear_soil(linear_soil: ow.System) -> None:
    """The same on distributed springs, whose generalised stiffness turns with the pile."""
    assert stiffness_error(loaded(linear_soil), random_state(linear_soil)) < TOLERANCE


def test_stiffness_with_softening_soil(coarse: ow.System) -> None:
    """The same on tanh curves at displacements of 0.05 m and more.

    A step of 1e-6 rad moves the pile by up to 1e-4 m, where (1e-4 / 0.05)^4 = 2e-11 is truncation and
    1e-16 / 1e-6 = 1e-10 rounding.
    """
    state = random_state(coarse, size=0.003)
    state.q[:2] = 0.1, 0.15
    assert stiffness_error(loaded(coarse), state, step=1e-6) < 2e-9


def test_damping_with_dashpots(linear_soil: ow.System) -> None:
    """dr/dv at rest: joint dampers, soil and toe dashpots; drag, being quadratic, has none.

    The central difference of |w| w is proportional to the step, so that two steps remove it; what
    is left of the residual is linear in v or even.
    """
    equations, state = linear_soil.equations(), random_state(linear_soil)
    rest = np.zeros(linear_soil.nv)
    near, far = (
        central_differences(lambda v: equations.residual(0.0, state.q, v, rest), rest, step)
        for step in (1e-3, 2e-3)
    )
    expected = 2 * near - far
    damping = equations.tangents(0.0, state.q, rest)[1]
    assert np.max(np.abs(damping)) > 1e8
    assert relative_difference(damping, expected) < 1e-10


def test_tangents_are_symmetric_where_the_loads_are_conservative(linear_soil: ow.System) -> None:
    """Gravity, springs and a dead force have a potential, so the stiffness is symmetric."""
    force = constant_load(linear_soil.chain.top, np.array([2e6, -7e5, 5e5, 0, 0, 0]))
    equations = without_joint_springs(linear_soil).equations([force], ramp_time=np.inf)
    state = random_state(linear_soil)
    stiffness, damping = equations.tangents(0.0, state.q, np.zeros_like(state.q))
    assert relative_difference(stiffness, stiffness.T) < 1e-12
    assert relative_difference(damping, damping.T) < 1e-12


def test_a_dead_moment_is_not_conservative(linear_soil: ow.System) -> None:
    """Negative control of the last test: a moment fixed in space has no potential."""
    state = random_state(linear_soil)
    stiffness, _ = loaded(linear_soil).tangents(0.0, state.q, np.zeros_like(state.q))
    assert relative_difference(stiffness, stiffness.T) > 1e-9


def test_lost_geometric_stiffness_is_seen(
    linear_soil: ow.System, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: without the geometric part the check fails."""
    monkeypatch.setattr(ChainMotion, "geometric_stiffness", lambda *_: 0.0)
    assert stiffness_error(loaded(linear_soil), random_state(linear_soil)) > 100 * TOLERANCE
