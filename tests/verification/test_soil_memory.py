"""Soil and foundations with a memory in whole systems: statics, modes, time, ledger, resume."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.numerics import fitted_order
from helpers.soils import hysteretic
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis import simulate as transient
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.point_load import PointForces, PointLoad, PointMotion, PointTangents
from offwind_pin.loads.root_restraint import LinearRestraint

Array = NDArray[np.float64]

STRONG = np.array([4e6, 0, 0, 0, 0, 0])
"""At the yaw bearing, in N: several times what operation gives, so that the soil yields."""


class Swing(PointLoad):
    """A force at the yaw bearing that swings along x."""

    name = "swing"

    def __init__(self, yaw_bearing: float, amplitude: float, period: float) -> None:
        self.height = np.array([yaw_bearing])
        self.amplitude, self.period = amplitude, period

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        size = ramp_factor * self.amplitude * np.sin(2 * np.pi * time / self.period)
        return PointForces(np.array([[size, 0.3 * size, 0.0]]), np.zeros((1, 3)))

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        return PointTangents.zeros(1)


def with_memory(undamped: Turbine, name: str, elements: int | None = 16) -> ow.System:
    """A system on hysteretic springs or on a macro-element, in still water."""
    if name == "hysteretic":
        return ow.build(
            hysteretic(undamped), "distributed_springs", ow.StillWater(), elements=elements
        )
    return ow.build(undamped, name, ow.StillWater(), elements=elements)


@pytest.fixture(scope="module", params=["hysteretic", "macro_element"])
def system(undamped: Turbine, request: pytest.FixtureRequest) -> ow.System:
    return with_memory(undamped, request.param)


@pytest.mark.parametrize("name", ["hysteretic", "macro_element"])
def test_first_loading_is_that_of_the_elastic_springs(undamped: Turbine, name: str) -> None:
    """Sliders and macro-element follow the curves that they were made from, within 1 %."""
    elastic = ow.build(undamped, "distributed_springs", ow.StillWater())
    system = with_memory(undamped, name, None)
    for share in (-0.3, 0.1, 0.3, 1.0):
        expected = ow.static(elastic, share * STRONG).mudline_displacement[0]
        found = ow.static(system, share * STRONG).mudline_displacement[0]
        assert found == pytest.approx(expected, rel=0.01)


def test_modes_about_a_held_load_are_those_of_small_motions(system: ow.System) -> None:
    """Small motions do not yield, however large the load that is held."""
    free, held = ow.modes(system, 4), ow.modes(system, 4, ow.static(system, STRONG))
    assert held.frequency_hz == pytest.approx(free.frequency_hz, rel=4e-3)
    assert np.any(ow.static(system, STRONG).memory != 0)


def test_static_loops_close(system: ow.System) -> None:
    """Between two loads the mudline comes back to where it was, and remains off when unloaded.

    The first time it has another past: with the assembly's overhang the reversed load is the larger.
    The macro-element's translation and rotation do not rise in proportion, so that what it has
    slipped by depends a little on the size of the steps.
    """
    loaded = ow.static(system, STRONG)
    states = [loaded]
    for sign in (-1, 1, -1, 1):
        states.append(ow.static(system, sign * STRONG, after=states[-1]))
    place = [state.mudline_displacement for state in states]
    proportional = isinstance(system.foundation.root, LinearRestraint)
    closed = 1e-9 if proportional else 1e-3
    assert place[4] == pytest.approx(place[2], rel=closed)
    assert place[3] == pytest.approx(place[1], rel=closed)
    assert place[2] == pytest.approx(place[0], rel=5e-3)
    free = ow.static(system)
    unloaded = ow.static(system, 0 * STRONG, after=loaded)
    left = unloaded.mudline_displacement[0] - free.mudline_displacement[0]
    assert 1e-5 < left < 0.5 * loaded.mudline_displacement[0]
    with pytest.raises(ow.InputError, match="another system"):
        ow.static(ow.build(system.turbine, "clamped"), after=loaded)


def test_time_starts_from_the_held_load(system: ow.System) -> None:
    """Nothing moves when nothing changes, and nothing turns into heat."""
    history = ow.simulate(system, 2.0, 0.02, [STRONG])
    top = history["tower_top_displacement"].sel(direction="x").to_numpy()
    assert np.ptp(top) < 1e-8
    assert float(history["energy_dissipated"].isel(time=-1).sum()) < 1e-3


def swung(system: ow.System, dt: float, amplitude: float = 3e6) -> xr.Dataset:
    load = Swing(system.chain.top, amplitude, 5.0)
    return ow.simulate(system, 20.0, dt, [load], ramp=5.0, save_at=ow.SaveAt(0.1))


def soil_heat(history: xr.Dataset) -> Array:
    """(t,) energy in J that soil or foundation has turned into heat."""
    sinks = [name for name in history["sink"].to_numpy() if str(name) in ("soil", "foundation")]
    return history["energy_dissipated"].sel(sink=sinks).sum("sink").to_numpy()


def test_ledger_closes_with_second_order(system: ow.System) -> None:
    """What the soil takes is summed from step to step; the balance falls with the square of dt."""
    steps = np.array([0.02, 0.01, 0.005])
    errors = []
    for dt in steps:
        history = swung(system, float(dt))
        heat = soil_heat(history)
        assert np.all(np.diff(heat) >= -1e-9 * heat[-1])
        assert heat[-1] > 1e4
        worst = float(np.abs(history["energy_balance"]).max())
        errors.append(worst / float(history["energy_dissipated"].isel(time=-1).sum()))
    assert errors[0] < 5e-3
    assert fitted_order(steps, errors) > 1.4


def test_forgotten_slips_are_seen(
    system: ow.System, undamped: Turbine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: sliders that start every block anew lose heat, and the ledger shows it."""
    honest = swung(system, 0.02)
    monkeypatch.setattr(transient, "_BLOCK_SECONDS", 1.0)
    forgetting = property(
        lambda self: self.state.memory.copy(), lambda self, _: self.state.memory.fill(0)
    )
    monkeypatch.setattr(CompiledChain, "memory", forgetting)
    forgetful = swung(system, 0.02)
    balance = [float(np.abs(h["energy_balance"]).max()) for h in (honest, forgetful)]
    assert balance[1] > 3 * balance[0]


def test_resumes_to_the_bit(
    system: ow.System, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A stopped run goes on with the slips that it had."""
    monkeypatch.setattr(transient, "_BLOCK_SECONDS", 1.0)
    load = [np.array([3e6, 0, 0, 0, 0, 0]), Swing(system.chain.top, 2e6, 3.0)]

    def run(directory: Path, stop: float = np.inf) -> xr.Dataset:
        def watch(now: float) -> None:
            if now >= stop:
                raise KeyboardInterrupt

        return ow.simulate(system, 6.0, 0.02, load, directory=directory, progress=watch)

    whole = run(tmp_path / "whole").load()
    with pytest.raises(ow.InterruptedSimulation):
        run(tmp_path / "stopped", stop=3.0)
    resumed = run(tmp_path / "stopped").load()
    for name in whole.data_vars:
        assert np.array_equal(whole[name], resumed[name], equal_nan=True), name


def test_halved_steps_do_not_slip_twice(system: ow.System) -> None:
    """An interval that is done again starts from the slips that it started from before."""
    load = Swing(system.chain.top, 3e6, 5.0)
    fixed = ow.simulate(system, 8.0, 0.005, [load], save_at=ow.SaveAt(0.1))
    adaptive = ow.GeneralizedAlpha(ow.AdaptiveStep(tolerance=2e-7, largest=0.1))
    refused = ow.simulate(system, 8.0, loads=[load], integrator=adaptive, save_at=ow.SaveAt(0.1))
    assert float(refused["solver_step"].min()) < 0.05
    pair = [h["mudline_moment"].sel(direction="y").to_numpy() for h in (fixed, refused)]
    assert pair[1] == pytest.approx(pair[0], abs=0.02 * np.abs(pair[0]).max())


def test_solvers_without_steps_are_refused(system: ow.System) -> None:
    """SciPy's know no converged step after which to remember."""
    with pytest.raises(ow.InputError, match="memory"):
        ow.simulate(system, 1.0, integrator=ow.SciPyIVP(), save_at=ow.SaveAt(0.05))


def test_a_free_decay_is_damped_by_loops(undamped: Turbine) -> None:
    """Without any dashpot the macro-element and the sliders damp what they swing through, more at
    large amplitudes; elastic springs do not."""
    losses = {}
    for name in ("hysteretic", "macro_element"):
        for size in (1e6, 4e6):
            history = swung(with_memory(undamped, name), 0.02, size)
            losses[name, size] = soil_heat(history)[-1] / size**2
        assert losses[name, 4e6] > 2 * losses[name, 1e6]
