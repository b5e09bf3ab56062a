"""Generalised-alpha against SciPy's Radau on problem P of the benchmarks, with fewer elements."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from helpers.numerics import fitted_order
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import SciPyIVP
from offwind_pin.loads.soil.springs.elastic import CONSTANT_DASHPOT

Array = NDArray[np.float64]

DURATION, OUTPUT = 4.0, 0.05
"""The structure swings over to its largest moment, 2.2 s from the start, and back.

Radau takes long: the structure bounces on its toe at 7 Hz, undamped."""
TOLERANCE = 1e-3
"""Of the seabed moment, over its peak, at dt = 0.01 s."""


@pytest.fixture(scope="module")
def problem() -> ModuleType:
    """The script of the benchmarks, by its path."""
    path = Path(__file__).parents[2] / "benchmarks" / "problem_p.py"
    spec = importlib.util.spec_from_file_location("problem_p", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["problem_p"] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def structure(problem: ModuleType) -> ow.System:
    return problem.system({"pile": 6, "monopile": 2, "tower": 4})


@pytest.fixture(scope="module")
def by_radau(problem: ModuleType, structure: ow.System) -> Array:
    """Seabed moment by the other integrator, on Pinocchio's equations."""
    integrator = SciPyIVP("Radau", 1e-6, 1e-8)
    data = problem.run(OUTPUT, DURATION, structure, output_dt=OUTPUT, integrator=integrator)
    return problem.seabed_moment(data)


def difference(problem: ModuleType, structure: ow.System, by_radau: Array, dt: float) -> float:
    """Of generalised-alpha's seabed moment from Radau's, over the peak."""
    data = problem.run(dt, DURATION, structure, output_dt=OUTPUT)
    return float(np.abs(problem.seabed_moment(data) - by_radau).max() / np.abs(by_radau).max())


def test_seabed_moment_is_radau_s(
    problem: ModuleType, structure: ow.System, by_radau: Array
) -> None:
    """Within 0.1 % of the peak at dt = 0.01 s."""
    assert difference(problem, structure, by_radau, 0.01) < TOLERANCE


def test_difference_falls_with_the_square_of_the_step(
    problem: ModuleType, structure: ow.System, by_radau: Array
) -> None:
    """It is the integrator's own error, and vanishes with it."""
    steps = [0.05, 0.025, 0.0125]
    errors = [difference(problem, structure, by_radau, dt) for dt in steps]
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.1)


def test_a_coarse_step_is_seen(problem: ModuleType, structure: ow.System, by_radau: Array) -> None:
    """Negative control: with dt = 0.05 s the two differ by more."""
    assert difference(problem, structure, by_radau, 0.05) > TOLERANCE


def test_start_is_the_state_under_gravity_alone(problem: ModuleType, structure: ow.System) -> None:
    """The force is not in the static state, and is there in full in the first instant of motion."""
    data = problem.run(0.01, 0.05, structure)
    gravity, loaded = (
        ow.static(structure, None if load is None else np.array([load, 0, 0, 0, 0, 0]))
        for load in (None, problem.FORCE_MEAN)
    )
    top = data["tower_top_displacement"].to_numpy()
    assert top[0] == pytest.approx(gravity.tower_top_displacement, rel=1e-12)
    assert abs(loaded.tower_top_displacement[0] - top[0, 0]) > 0.3
    applied = data["tower_top_load"].sel(component="Fx").to_numpy()
    assert applied == pytest.approx(problem.force(data["time"].to_numpy()), rel=1e-12)
    assert applied[0] == problem.FORCE_MEAN


def test_samples_are_dense_enough(problem: ModuleType, structure: ow.System) -> None:
    """Between its samples the force is off by a millionth at most."""
    load = problem.load(structure, 10.0)
    time = np.linspace(0, 10, 9973)
    error = load.time_inputs(time, np.ones_like(time))[:, 0] - problem.force(time)
    assert 0 < np.abs(error).max() < 1e-6 * problem.FORCE_MEAN


def test_problem_is_as_stated(problem: ModuleType, structure: ow.System) -> None:
    """Soil, toe, dashpots, dampers and water of problem P, read back from what will be solved."""
    whole = problem.system()
    assert whole.chain.elements == 80
    assert [whole.chain.region.count(name) for name in ("pile", "monopile", "tower")] == [60, 6, 14]
    (soil,) = whole.foundation.soil
    spacing = 45.0 / 60
    length = np.full(61, spacing)
    length[[0, -1]] /= 2
    y = np.full(61, 0.004)
    assert soil.height == pytest.approx(np.linspace(-30, -75, 61))
    assert soil.curves.resistance(y) == pytest.approx(2e8 * 0.01 * np.tanh(y / 0.01), rel=1e-12)
    assert soil.tributary_length == pytest.approx(length)
    (springs,) = soil.compiled()
    viscous = springs.constants[:, CONSTANT_DASHPOT]
    assert viscous == pytest.approx(2e8 * length * 0.1 / (np.pi * 0.236), rel=1e-12)
    assert np.all(soil.dashpot.secant_time == 0)
    toe = whole.foundation.root
    assert np.count_nonzero(toe.stiffness) == 2
    assert (toe.stiffness[2, 2], toe.stiffness[5, 5]) == (1.12e10, 2.55e11)
    assert not np.any(toe.damping)
    ratio = whole.joint_damping[6:] / whole.joint_stiffness[6:]
    assert ratio * 2 * np.pi * 0.24 / 2 == pytest.approx(0.01, rel=1e-12)
    assert whole.turbine.hydrodynamics.drag_coefficient == 0
    assert whole.turbine.hydrodynamics.added_mass_coefficient == 1
    assert whole.sea == ow.StillWater()
