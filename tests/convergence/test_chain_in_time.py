"""The chain in time: order, agreement with Radau, energy, equilibrium kept."""

from collections.abc import Callable

import numpy as np
import pinocchio as pin
import pytest
from helpers.in_time import integrate
from helpers.numerics import fitted_order, relative_difference
from helpers.point_loads import TurningLoad
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha, MotionState, Records
from offwind_pin.analysis.static import load_scale
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.solvers.generalized_alpha import Method, start
from offwind_pin.solvers.steps import FixedStep

Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def short_chain(undamped: ow.Turbine) -> ow.System:
    """Two elements, clamped, in waves: six degrees of freedom."""
    waves = ow.IrregularWaves(4.0, 8.0, seed=5, repeat_period=60.0)
    return ow.build(undamped, "clamped", waves, elements=2)


def tight(system: ow.System, dt: float, radius: float) -> Method:
    return Method(
        dt, radius, load_scale(system), relative_tolerance=1e-11, increment_tolerance=1e-11
    )


def interpreted(
    system: ow.System, loads: list, q: Array, v: Array, dt: float, end: float, radius: float
) -> Array:
    """(3, t, nv) q, v and a at the start and after each step, in plain Python on Pinocchio."""
    method = tight(system, dt, radius)
    steps = integrate(system.equations(loads), q, v, method, round(end / dt))
    return np.array([[step.q, step.v, step.a] for step in steps]).transpose(1, 0, 2)


def compiled(
    system: ow.System, loads: list, q: Array, v: Array, dt: float, end: float, radius: float
) -> Array:
    """The same by the integrator that simulations use, the chain compiled."""
    states, _ = compiled_with_records(system, loads, q, v, dt, end, radius)
    return np.array([state.vectors[:3] for state in states]).transpose(1, 0, 2)


def compiled_with_records(
    system: ow.System, loads: list, q: Array, v: Array, dt: float, end: float, radius: float
) -> tuple[list[MotionState], Records]:
    """States at the start and after each step, and records of the steps."""
    method = GeneralizedAlpha(FixedStep(dt), radius, 1e-11, 1e-11)
    chain = CompiledChain(system, loads)
    sections = chain.sections(system.chain.boundary)
    vectors = start(chain, chain.time_inputs(np.zeros(1))[0], q, v)
    states = [method.begin(chain, q, dt)._replace(vectors=vectors)]
    records = []
    for number in range(1, round(end / dt) + 1):
        after, record = method.advance(chain, sections, states[-1], np.array([number * dt]))
        states.append(after)
        records.append(record)
    return states, {name: np.concatenate([r[name] for r in records]) for name in records[0]}


Run = Callable[..., Array]


def three_modes(system: ow.System) -> tuple[Array, Array]:
    """Static displacements, and velocities in the first three modes."""
    return ow.static(system).q, ow.modes(system, 3).vector @ [300.0, 500.0, 1000.0]


END = 1.6


@pytest.fixture(scope="module")
def reference(short_chain: ow.System) -> Array:
    """(nv,) displacements at the end by SciPy's Radau."""
    nv = short_chain.nv
    equations = short_chain.equations([TurningLoad(short_chain.chain.top)])

    def rate(t: float, y: Array) -> Array:
        force = equations.residual(t, y[:nv], y[nv:], np.zeros(nv))
        return np.concatenate([y[nv:], -np.linalg.solve(equations.mass(y[:nv]), force)])

    begin = np.concatenate(three_modes(short_chain))
    return solve_ivp(rate, (0, END), begin, method="Radau", rtol=1e-8, atol=1e-10).y[:nv, -1]


@pytest.mark.parametrize("run", [interpreted, compiled])
def test_order_two_and_agreement_with_radau(
    short_chain: ow.System, reference: Array, run: Run
) -> None:
    """Waves, drag, a load that turns, three modes in motion: the limit for dt -> 0 is Radau's."""
    loads = [TurningLoad(short_chain.chain.top)]
    q, v = three_modes(short_chain)
    steps = np.array([0.02, 0.01, 0.005])
    found = [run(short_chain, loads, q, v, float(dt), END, 0.9)[0, -1] for dt in steps]
    errors = [np.abs(state - reference).max() for state in found]
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.1)
    extrapolated = found[2] + (found[2] - found[1]) / 3
    assert np.abs(extrapolated - reference).max() < 0.05 * errors[2]


@pytest.mark.parametrize("radius", [0.5, 1.0])
def test_compiled_steps_are_the_interpreted_ones(coarse: ow.System, radius: float) -> None:
    """One text, two systems: compiled in O(N), and in plain Python on Pinocchio's dense matrices.

    Both meet the equations of every step to a tolerance, by iteration matrices of their own.
    """
    loads = [TurningLoad(coarse.chain.top)]
    runs = [
        run(coarse, loads, *three_modes(coarse), 0.02, 1.0, radius)
        for run in (interpreted, compiled)
    ]
    for plain, fast in zip(*runs, strict=True):
        assert relative_difference(fast, plain) < 1e-8
    assert np.ptp(runs[0][0], axis=0).max() > 1e-3


def test_another_step_is_seen(coarse: ow.System) -> None:
    """Negative control: with half the step the motion differs by more than that."""
    loads = [TurningLoad(coarse.chain.top)]
    whole, half = (
        compiled(coarse, loads, *three_modes(coarse), dt, 1.0, 1.0) for dt in (0.02, 0.01)
    )
    assert relative_difference(half[0, ::2], whole[0]) > 1e-5


def energy(system: ow.System, q: Array, v: Array) -> float:
    """Kinetic, gravitational and elastic energy in J."""
    model, data = system.pin_model, system.pin_model.createData()
    potential = pin.computePotentialEnergy(model, data, q)
    elastic = system.joint_stiffness @ q**2 / 2
    return float(v @ system.equations().mass(q) @ v / 2 + potential + elastic)


@pytest.fixture(scope="module")
def released(undamped: ow.Turbine) -> tuple[ow.System, Array]:
    """A dry and undamped tower, bent by 1 MN."""
    system = ow.build(undamped, "clamped", elements=4)
    return system, ow.static(system, np.array([1e6, 5e5, 0, 0, 0, 1e7])).q


@pytest.mark.parametrize("run", [interpreted, compiled])
def test_energy_of_a_released_tower(released: tuple[ow.System, Array], run: Run) -> None:
    """Bent by 1 MN and let go, dry and undamped: the energy oscillates and does not drift."""
    system, bent = released
    rest = np.zeros(system.nv)
    q, v, _ = run(system, [], bent, rest, 0.02, 12.0, 1.0)
    values = np.array([energy(system, *state) for state in zip(q[::3], v[::3], strict=True)])
    at_rest = energy(system, ow.static(system).q, rest)
    error = np.abs(values - values[0]) / (values[0] - at_rest)
    assert error.max() < 0.02
    assert error[-50:].max() < 1.5 * error[:50].max()


def test_recorded_energy_is_pinocchio_s(released: tuple[ow.System, Array]) -> None:
    """What the compiled records hold of the same motion, counted from the undeformed place."""
    system, bent = released
    rest = np.zeros(system.nv)
    states, records = compiled_with_records(system, [], bent, rest, 0.02, 2.0, 1.0)
    expected = [energy(system, *state.vectors[:2]) for state in states[1:]]
    found = records["stored"].sum(axis=1) + energy(system, rest, rest)
    assert np.abs(found - expected).max() < 1e-10 * np.abs(expected).max()
    assert np.abs(found - expected).max() < 1e-7 * records["stored"][:, 0].max()


def test_equilibrium_is_kept(coarse: ow.System) -> None:
    """Started under its mean load, with nothing that changes, the structure stays where it is."""
    load = np.array([[1e6, 2e5, 0, 0, 1e7, 3e6]] * 2)
    history = ow.LoadHistory(np.array([0.0, 5.0]), load, "steady")
    still = ow.build(coarse.turbine, "distributed_springs", ow.StillWater(), elements=8)
    result = ow.simulate(still, 2.0, 0.05, [history])
    top = result.tower_top_displacement.to_numpy()
    assert np.abs(top[0, 0]) > 0.1
    assert np.abs(top - top[0]).max() < 1e-7
    start = ow.static(still, load[0])
    assert top[0] == pytest.approx(start.tower_top_displacement, rel=1e-12)
    moment = result.mudline_moment.to_numpy()
    assert moment[-1] == pytest.approx(start.mudline_load[3:], rel=1e-6)


def test_a_load_that_changes_moves_it(coarse: ow.System) -> None:
    """Negative control of the last test: with a pulse the top moves, the applied load is recorded."""
    time = np.array([0.0, 0.5, 1.0, 5.0])
    load = np.zeros((4, 6))
    load[1, 0] = 2e6
    still = ow.build(coarse.turbine, "distributed_springs", ow.StillWater(), elements=8)
    result = ow.simulate(still, 2.0, 0.05, [ow.LoadHistory(time, load, "pulse")])
    assert result.tower_top_load.sel(time=0.5, component="Fx").item() == pytest.approx(2e6)
    assert np.ptp(result.tower_top_displacement.sel(direction="x").to_numpy()) > 0.01
