"""Generalised-alpha on small systems: order, agreement with Radau, energy, failure."""

from functools import cache

import numpy as np
import pytest
from helpers.in_time import DenseEquations, Step, attempt, integrate
from helpers.numerics import fitted_order
from helpers.oscillators import Array, ElasticPendulum, Oscillator
from scipy.integrate import solve_ivp

from offwind_pin.solvers.generalized_alpha import CONVERGED, DIVERGED, NOT_FINITE, Method

RADII = [0.0, 0.5, 0.9, 1.0]


def run(
    system: DenseEquations, q: Array, v: Array, *, dt: float, end: float, radius: float
) -> list[Step]:
    """All steps, converged to rounding."""
    method = Method(dt, radius, 10.0, relative_tolerance=1e-13, increment_tolerance=1e-11)
    return integrate(system, q, v, method, round(end / dt))


@pytest.mark.parametrize("radius", RADII)
def test_order_two_on_an_oscillator(radius: float) -> None:
    """Displacement and velocity of a damped, driven oscillator, at every numerical damping."""
    system, steps, end = Oscillator(), np.array([0.08, 0.04, 0.02, 0.01]), 8.0
    errors = []
    for dt in steps:
        path = run(system, np.array([0.3]), np.array([-0.5]), dt=float(dt), end=end, radius=radius)
        time = np.array([step.time for step in path])
        q, v, _ = system.exact(time, 0.3, -0.5)
        found = np.array([[step.q[0], step.v[0]] for step in path])
        errors.append(np.abs(found - np.column_stack([q, v])).max(axis=0))
    for column in np.array(errors).T:
        assert fitted_order(steps, column) == pytest.approx(2.0, abs=0.1)


def test_acceleration_meets_the_equations_of_motion() -> None:
    """The reported acceleration is the true one of each step's end: the residual vanishes with it."""
    system = Oscillator()
    path = run(system, np.array([0.3]), np.array([-0.5]), dt=0.05, end=5.0, radius=0.5)
    left = [system.residual(step.time, step.q, step.v, step.a)[0] for step in path]
    assert np.abs(left).max() < 1e-11


START = (np.array([1.3, 0.9]), np.array([0.0, 0.4]))


@cache
def radau(end: float) -> Array:
    """(4,) state of the elastic pendulum by SciPy's Radau."""
    system = ElasticPendulum()

    def rate(time: float, y: Array) -> Array:
        q, v = y[:2], y[2:]
        force = system.residual(time, q, v, np.zeros(2))
        return np.concatenate([v, -np.linalg.solve(system.mass(q), force)])

    solution = solve_ivp(
        rate, (0, end), np.concatenate(START), method="Radau", rtol=1e-11, atol=1e-12
    )
    assert solution.success
    return solution.y[:, -1]


@pytest.mark.parametrize("radius", RADII)
def test_order_two_and_agreement_with_radau_on_a_pendulum(radius: float) -> None:
    """A nonlinear system with a mass matrix that changes: order 2, and the limit is Radau's."""
    system, steps, end = ElasticPendulum(), np.array([0.008, 0.004, 0.002]), 2.0
    found = []
    for dt in steps:
        last = run(system, *START, dt=float(dt), end=end, radius=radius)[-1]
        found.append(np.concatenate([last.q, last.v]))
    reference = radau(end)
    errors = [np.abs(state - reference).max() for state in found]
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.1)
    extrapolated = found[2] + (found[2] - found[1]) / 3
    assert np.abs(extrapolated - reference).max() < 0.05 * errors[2]


def test_energy_of_a_linear_oscillator_is_kept() -> None:
    """With spectral radius 1 an undamped, unforced oscillator keeps its energy for 1000 periods."""
    system = Oscillator(damping=0.0, load=0.0)
    path = run(system, np.array([1.0]), np.array([0.0]), dt=0.3, end=3000.0, radius=1.0)
    energy = [system.mass_ * s.v[0] ** 2 / 2 + system.stiffness * s.q[0] ** 2 / 2 for s in path]
    assert np.abs(np.array(energy) / energy[0] - 1).max() < 1e-9


def test_energy_of_a_pendulum_does_not_drift() -> None:
    """Nonlinear: the energy error oscillates within O(dt^2) and does not grow."""
    system = ElasticPendulum()
    path = run(system, *START, dt=0.01, end=30.0, radius=1.0)
    energy = np.array([system.energy(step.q, step.v) for step in path])
    # The scale is the energy above the state of rest.
    low = ElasticPendulum().energy(np.array([1 + 9.81 / 40, 0.0]), np.zeros(2))
    error = np.abs(energy - energy[0]) / (energy[0] - low)
    early, late = error[:1000].max(), error[-1000:].max()
    assert error.max() < 0.01
    assert late < 1.5 * early


def test_numerical_damping_takes_energy() -> None:
    """Negative control: with spectral radius 0.5 the same pendulum loses energy."""
    system = ElasticPendulum()
    path = run(system, *START, dt=0.05, end=60.0, radius=0.5)
    assert system.energy(path[-1].q, path[-1].v) < system.energy(*START) - 0.1


def test_high_frequency_is_damped_as_asked() -> None:
    """For omega dt -> infinity the method's three roots meet at the spectral radius rho.

    A threefold root makes the amplitude fall as n^2 rho^n.
    """
    system = Oscillator(mass_=1.0, damping=0.0, stiffness=1e10, load=0.0)
    method = Method(1.0, 0.8, 1e4, relative_tolerance=1e-13)
    path = integrate(system, np.array([1e-6]), np.zeros(1), method, 90)
    size = np.array([abs(step.q[0]) for step in path])
    assert size[90] > 1e-17
    fall = (size[90] / size[60] / (90 / 60) ** 2) ** (1 / 30)
    assert fall == pytest.approx(0.8, rel=5e-3)


class BreaksDown(Oscillator):
    """An oscillator whose load is not a number after one second."""

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        return super().residual(time, q, v, a) + (np.nan if time > 1.0 else 0.0)


class HasNoSolution(Oscillator):
    """Out of balance, from 0.45 s on, whatever the motion."""

    def residual(self, time: float, q: Array, v: Array, a: Array) -> Array:
        return np.ones(1) if time > 0.45 else super().residual(time, q, v, a)


@pytest.mark.parametrize(
    ("system", "completed", "reason"),
    [(BreaksDown(), 10, NOT_FINITE), (HasNoSolution(), 4, DIVERGED)],
)
def test_failed_step_is_reported(system: DenseEquations, completed: int, reason: int) -> None:
    """The failed step and why are reported; the steps before it stand, and its last finite residual."""
    ended = attempt(system, np.zeros(1), np.zeros(1), Method(0.1, 0.9, 1.0), 20)
    assert (ended.completed, ended.reason) == (completed, reason)
    assert ended.error == np.inf
    assert len(ended.steps) == 1 + completed
    assert ended.steps[-1].time == pytest.approx(0.1 * completed)
    assert np.array_equal(
        ended.state[:3], [ended.steps[-1].q, ended.steps[-1].v, ended.steps[-1].a]
    )
    assert np.all(np.isfinite(ended.last))
    if reason == DIVERGED:
        assert ended.last == pytest.approx([1.0])


def test_a_run_that_ends_well_says_so() -> None:
    """Negative control: the honest oscillator takes all its steps, with a finite local error."""
    ended = attempt(Oscillator(), np.zeros(1), np.zeros(1), Method(0.1, 0.9, 1.0), 20)
    assert (ended.completed, ended.reason) == (20, CONVERGED)
    assert 0 < ended.error < 0.01
