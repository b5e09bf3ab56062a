"""The chain in time: order, agreement with Radau, energy, equilibrium kept."""

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
import pytest
from helpers.numerics import fitted_order
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import offwind_pin as ow
from offwind_pin.analysis.static import load_scale
from offwind_pin.loads.points import PointForces, PointMotion, PointTangents, zeros_like_points
from offwind_pin.solve.generalized_alpha import GeneralizedAlpha, Step

Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def short_chain(undamped: ow.Turbine) -> ow.System:
    """Two elements, clamped, in waves: six degrees of freedom."""
    waves = ow.IrregularWaves(4.0, 8.0, seed=5, repeat_period=60.0)
    return ow.build(undamped, "clamped", waves, elements=2)


def run(
    system: ow.System, loads: list, q: Array, v: Array, dt: float, end: float, radius: float
) -> list[Step]:
    method = GeneralizedAlpha(dt, radius, relative_tolerance=1e-11, increment_tolerance=1e-11)
    equations = system.equations(loads)
    return list(method.steps(equations, q, v, count=round(end / dt), scale=load_scale(system)))


@dataclass(frozen=True)
class TurningLoad:
    """A force and moment at the yaw bearing that grow smoothly and turn around."""

    yaw_bearing: float
    name: str = "turning"

    @property
    def height(self) -> Array:
        return np.array([self.yaw_bearing])

    def forces(self, time: float, motion: PointMotion, rise: float) -> PointForces:
        grown = 1 - np.cos(2 * time)
        force = grown * np.array([2e6 * np.cos(3 * time), 2e6 * np.sin(3 * time), 0.0])
        moment = grown * np.array([1e7, 2e7 * np.cos(time), 1e7 * np.sin(2 * time)])
        return PointForces(force[None], moment[None])

    def tangents(self, time: float, motion: PointMotion, rise: float) -> PointTangents:
        return PointTangents(*zeros_like_points(1))


def test_order_two_and_agreement_with_radau(short_chain: ow.System) -> None:
    """Waves, drag, a load that turns, three modes in motion: the limit for dt -> 0 is Radau's."""
    end, nv = 1.6, short_chain.nv
    loads = [TurningLoad(short_chain.chain.top)]
    q = ow.static(short_chain).q
    v = ow.modes(short_chain, 3).vector @ [300.0, 500.0, 1000.0]
    equations = short_chain.equations(loads)

    def rate(t: float, y: Array) -> Array:
        force = equations.residual(t, y[:nv], y[nv:], np.zeros(nv))
        return np.concatenate([y[nv:], -np.linalg.solve(equations.mass(y[:nv]), force)])

    reference = solve_ivp(
        rate, (0, end), np.concatenate([q, v]), method="Radau", rtol=1e-8, atol=1e-10
    ).y[:nv, -1]
    steps = np.array([0.02, 0.01, 0.005])
    found = [run(short_chain, loads, q, v, float(dt), end, 0.9)[-1].q for dt in steps]
    errors = [np.abs(state - reference).max() for state in found]
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.1)
    extrapolated = found[2] + (found[2] - found[1]) / 3
    assert np.abs(extrapolated - reference).max() < 0.05 * errors[2]


def energy(system: ow.System, step: Step) -> float:
    """Kinetic, gravitational and elastic energy in J."""
    model, data = system.pin_model, system.pin_model.createData()
    potential = pin.computePotentialEnergy(model, data, step.q)
    elastic = system.joint_stiffness @ step.q**2 / 2
    return float(step.v @ system.equations().mass(step.q) @ step.v / 2 + potential + elastic)


def test_energy_of_a_released_tower(undamped: ow.Turbine) -> None:
    """Bent by 1 MN and let go, dry and undamped: the energy oscillates and does not drift."""
    system = ow.build(undamped, "clamped", elements=4)
    bent = ow.static(system, np.array([1e6, 5e5, 0, 0, 0, 1e7]))
    path = run(system, [], bent.q, np.zeros(system.nv), 0.02, 12.0, 1.0)
    values = np.array([energy(system, step) for step in path[::3]])
    rest = ow.static(system).q
    at_rest = energy(system, Step(0, 0.0, rest, np.zeros(system.nv), rest, 0, 0.0))
    error = np.abs(values - values[0]) / (values[0] - at_rest)
    assert error.max() < 0.02
    assert error[-50:].max() < 1.5 * error[:50].max()


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
