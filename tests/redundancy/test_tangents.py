"""Residual and tangents: by Pinocchio, by differences, and by the compiled chain."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.numerics import (
    blockwise_difference,
    central_differences,
    fourth_order_differences,
    relative_difference,
)
from helpers.point_loads import EveryKind
from helpers.states import (
    State,
    joint_kinds,
    joint_kinds_apart,
    random_state,
    without_joint_springs,
)
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.reference.chain_kinematics import AxisPoints, ChainMotion
from offwind_pin.dynamics.reference.equations import Equations
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.tower_top.load_history import TowerTopLoad, constant_load

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


TIME = 1.7
MOVING_TOLERANCE = 1e-9
"""As above, of blocks that are up to a thousand times smaller than the largest one."""


def everything(system: ow.System) -> list[PointLoad]:
    """A load at the top with moments, and one that depends on all parts of the motion."""
    height = np.linspace(system.chain.base, system.chain.top, 4)
    return [constant_load(system.chain.top, TOP_LOAD), EveryKind(height)]


def moving_tangents(equations: Equations, state: State) -> dict[str, Array]:
    """dr/dq, dr/dv and dr/da about a moving state, as they are computed."""
    stiffness, damping = equations.tangents(TIME, state.q, state.v, state.a)
    return {"q": stiffness, "v": damping, "a": equations.mass(state.q)}


def moving_differences(equations: Equations, state: State) -> dict[str, Array]:
    """The same by differences; the residual is linear in a."""

    def residual(**changed: Array) -> Array:
        at = replace(state, **changed)
        return equations.residual(TIME, at.q, at.v, at.a)

    return {
        "q": fourth_order_differences(lambda q: residual(q=q), state.q, STEP),
        "v": fourth_order_differences(lambda v: residual(v=v), state.v, STEP),
        "a": central_differences(lambda a: residual(a=a), state.a, 1.0),
    }


def moving_tolerance(system: ow.System) -> float:
    """In layered ground the differences reach across kinks of tabulated curves."""
    return 1e-5 if len(system.foundation.soil) > 1 else MOVING_TOLERANCE


@pytest.fixture(scope="module")
def differences(in_waves: ow.System) -> dict[str, Array]:
    """Of everything, about the random state."""
    equations = without_joint_springs(in_waves).equations(everything(in_waves))
    return moving_differences(equations, random_state(in_waves))


def test_tangents_in_motion_and_in_waves(
    in_waves: ow.System, state: State, differences: dict[str, Array]
) -> None:
    """dr/dq, dr/dv and dr/da with everything moving, on each foundation, of each element."""
    equations = without_joint_springs(in_waves).equations(everything(in_waves))
    found, kinds = moving_tangents(equations, state), joint_kinds(in_waves)
    for by in ("q", "v", "a"):
        error = blockwise_difference(found[by], differences[by], kinds)
        assert error < moving_tolerance(in_waves)


@pytest.mark.parametrize(
    ("by", "left_out"), [("q", "v"), ("q", "a"), ("v", "v"), ("q", "load"), ("a", "load")]
)
def test_a_term_of_motion_left_out_is_seen(
    in_waves: ow.System, state: State, differences: dict[str, Array], by: str, left_out: str
) -> None:
    """Negative control: without velocity, acceleration or one of the loads the tangents differ."""
    bare, loads = without_joint_springs(in_waves), everything(in_waves)
    if left_out == "load":
        found = moving_tangents(bare.equations(loads[:1]), state)[by]
    else:
        still = replace(state, **{left_out: np.zeros_like(state.q)})
        found = moving_tangents(bare.equations(loads), still)[by]
    error = blockwise_difference(found, differences[by], joint_kinds(in_waves))
    assert error > 1000 * MOVING_TOLERANCE


def compiled_residual(chain: CompiledChain, state: State) -> Array:
    row = chain.time_inputs(np.array([TIME]))[0]
    return chain.residual(row, state.q, state.v, state.a)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("ramp", [0.0, 4.0])
def test_compiled_residual_is_pinocchio_s(in_waves: ow.System, seed: int, ramp: float) -> None:
    """Two implementations of r(t, q, v, a): compiled recursions, and Pinocchio with NumPy."""
    state, bare = random_state(in_waves, seed), without_joint_springs(in_waves)
    time = np.array([0.0, 5.0])
    history = ow.LoadHistory(time, np.array([0.5 * TOP_LOAD, 2 * TOP_LOAD]), "rising")
    loads = [*everything(in_waves), TowerTopLoad(in_waves.chain.top, history, TOP_LOAD)]
    expected = bare.equations(loads, ramp).residual(TIME, state.q, state.v, state.a)
    found = compiled_residual(CompiledChain(bare, loads, ramp), state)
    assert blockwise_difference(found, expected, joint_kinds_apart(in_waves)) < 1e-12


def test_compiled_chain_gives_its_equations(in_waves: ow.System, state: State) -> None:
    """With joint springs and dampers, and the equations that the compiled chain itself offers."""
    system = in_waves.with_damping(2e-3 * in_waves.joint_stiffness, {})
    chain = CompiledChain(system, everything(system), ramp_time=4.0)
    expected = chain.equations().residual(TIME, state.q, state.v, state.a)
    found = compiled_residual(chain, state)
    assert blockwise_difference(found, expected, joint_kinds_apart(system)) < 1e-12


def test_another_state_is_seen(in_waves: ow.System, state: State) -> None:
    """Negative control: velocities off by a millionth are another residual."""
    chain = CompiledChain(without_joint_springs(in_waves), everything(in_waves))
    found = compiled_residual(chain, replace(state, v=(1 + 1e-6) * state.v))
    expected = chain.equations().residual(TIME, state.q, state.v, state.a)
    assert blockwise_difference(found, expected, joint_kinds_apart(in_waves)) > 1e-12


STATIC, STEPPING = (0.0, 0.0), (111.0, 1.23e4)
"""dv_dq, da_dq of statics, and of a time step of about 0.02 s."""
INVERSE_TOLERANCE = 1e-8
"""Of the matrix times its inverse: rounding times condition numbers of up to 1e8."""


def inverse_error(
    chain: CompiledChain, q: Array, factors: tuple[float, float], dense: tuple[float, float]
) -> float:
    """Largest entry of A X - 1 with the compiled inverse X and the dense A, in a state of rest."""
    rest, unit = np.zeros_like(q), np.eye(len(q))
    chain.factorise(chain.time_inputs(np.array([TIME]))[0], q, rest, rest, *factors)
    inverse = np.array([chain.correction(column) for column in unit]).T
    equations, (dv_dq, da_dq) = chain.equations(), dense
    stiffness, damping = equations.tangents(TIME, q, rest)
    matrix = da_dq * equations.mass(q) + dv_dq * damping + stiffness
    return float(np.abs(matrix @ inverse - unit).max())


def compiled(system: ow.System, *, springs: bool) -> CompiledChain:
    """With springs and dampers in the joints, or with what else there is alone."""
    damped = system.with_damping(2e-3 * system.joint_stiffness, {})
    return CompiledChain(damped if springs else without_joint_springs(system), everything(system))


@pytest.mark.parametrize("springs", [True, False], ids=["springs", "bare"])
@pytest.mark.parametrize("factors", [STATIC, STEPPING], ids=["static", "stepping"])
def test_compiled_iteration_matrix_at_rest(
    in_waves: ow.System, state: State, factors: tuple[float, float], *, springs: bool
) -> None:
    """Factorised in O(N), da_dq M + dv_dq D + K is the dense one: statics and time steps from rest."""
    chain = compiled(in_waves, springs=springs)
    assert inverse_error(chain, state.q, factors, factors) < INVERSE_TOLERANCE


@pytest.mark.parametrize("dense", [(111.0, 1.23e4 * 1.001), (111.0 * 1.05, 1.23e4)])
def test_another_iteration_matrix_is_seen(
    in_waves: ow.System, state: State, dense: tuple[float, float]
) -> None:
    """Negative control: a mass off by a thousandth, or a damping off by a twentieth."""
    chain = compiled(in_waves, springs=True)
    assert inverse_error(chain, state.q, STEPPING, dense) > 100 * INVERSE_TOLERANCE


def test_lost_geometric_stiffness_is_seen_in_the_inverse(
    in_waves: ow.System, state: State, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: a dense tangent without the geometric part is not the compiled one."""
    monkeypatch.setattr(ChainMotion, "geometric_stiffness", lambda *_: 0.0)
    chain = compiled(in_waves, springs=True)
    assert inverse_error(chain, state.q, STATIC, STATIC) > 100 * INVERSE_TOLERANCE


def test_unstable_directions_are_negative_eigenvalues(in_waves: ow.System) -> None:
    """A chain of weak springs buckles in some ways, the turbine in none: as many as by LAPACK."""
    rest, state = np.zeros(in_waves.nv), random_state(in_waves, size=0.01)
    force = constant_load(in_waves.chain.top, np.array([2e6, -7e5, -9e6, 0, 0, 0]))
    counts = []
    for factor in (1e-3, 1.0):
        system = replace(in_waves, joint_stiffness=factor * in_waves.joint_stiffness)
        chain = CompiledChain(system, [force], ramp_time=np.inf)
        chain.factorise(chain.time_inputs(np.zeros(1))[0], state.q, rest, rest, 0.0, 0.0)
        stiffness, _ = chain.equations().tangents(0.0, state.q, rest)
        expected = np.linalg.eigvalsh((stiffness + stiffness.T) / 2)
        assert chain.unstable_directions() == np.sum(expected <= 0)
        counts.append(chain.unstable_directions())
    assert counts[0] > 1 + counts[1]
