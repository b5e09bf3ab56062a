"""A turbine in waves whose surface wets and leaves strips: energies, masses, two integrators."""

import numpy as np
import pytest
import xarray as xr
from helpers.numerics import fitted_order, relative_difference

import offwind_pin as ow
from offwind_pin.dynamics.compiled.chain import CompiledChain

AMPLITUDE, OMEGA, WAVE_NUMBER = 4.0, 0.9, 0.088
STEPS = np.array([0.04, 0.02, 0.01])


@pytest.fixture(scope="module")
def built(oc6: ow.Turbine) -> tuple[ow.System, ow.ModalResult]:
    """In a regular wave 8 m high; with it the modes in still water."""
    turbine = oc6.model_copy(
        update={"hydrodynamics": oc6.hydrodynamics.model_copy(update={"buoyancy": True})}
    )
    still = ow.build(turbine, "coupled_springs", ow.StillWater(), elements=16)
    waves = ow.RegularWaves(2 * AMPLITUDE, 2 * np.pi / OMEGA, stretching="wheeler")
    return ow.build(turbine, "coupled_springs", waves, elements=16), ow.modes(still)


@pytest.fixture(scope="module")
def system(built: tuple[ow.System, ow.ModalResult]) -> ow.System:
    return built[0]


@pytest.fixture(scope="module")
def runs(system: ow.System) -> list[xr.Dataset]:
    return [
        ow.simulate(system, 24.0, dt, ramp=6.0, save_at=ow.SaveAt(0.2)) for dt in STEPS.tolist()
    ]


def balance(data: xr.Dataset) -> float:
    return float(np.abs(data["energy_balance"]).max())


def test_the_ledger_closes(runs: list[xr.Dataset]) -> None:
    """With second order in the step: what the changing mass takes up is counted as work."""
    assert fitted_order(STEPS, [balance(data) for data in runs]) == pytest.approx(2.0, abs=0.15)
    scale = np.ptp(runs[1]["energy_worked"].sel(source="waves").to_numpy())
    assert balance(runs[1]) < 1e-3 * scale


def test_its_work_left_out_is_seen(runs: list[xr.Dataset]) -> None:
    """Negative control: without the splash zone's added mass the ledger stays open at any step."""
    work = runs[-1]["energy_worked"].sel(source="splash_added_mass")
    assert float(np.abs(runs[-1]["energy_balance"] + work).max()) > 10 * balance(runs[-1])


def test_mass_matrix_at_a_time(system: ow.System) -> None:
    """dr/da by differences, as the surface stands; still water unless a time is given."""
    equations = system.equations(ramp_time=0.0)
    rng = np.random.default_rng(2)
    q, v, a = rng.normal(size=(3, system.nv)) * 1e-3
    for time in (0.0, 2.1, 3.5):
        here = equations.residual(time, q, v, a)
        columns = [equations.residual(time, q, v, a + unit) - here for unit in np.eye(system.nv)]
        assert relative_difference(equations.mass(q, time), np.array(columns).T) < 1e-9
    still = equations.mass(q)
    sideways = [m[0, 0] - still[0, 0] for m in (equations.mass(q, 0.0), equations.mass(q, 3.5))]
    line = 1025.0 * np.pi / 4 * 81.0
    for found, time in zip(sideways, (0.0, 3.5), strict=True):
        surface = AMPLITUDE * np.cos(OMEGA * time)
        assert found == pytest.approx(line * surface, rel=0.03)


def test_modes_see_the_still_surface(built: tuple[ow.System, ow.ModalResult]) -> None:
    """The added mass of the splash zone is that up to still water, met within the smoothing."""
    system, still = built
    modes = ow.modes(system)
    assert modes.label == still.label
    assert modes.frequency_hz == pytest.approx(still.frequency_hz, rel=2e-5)
    dry = ow.build(system.turbine, "coupled_springs", elements=16)
    i = still.index("FA2")
    assert abs(ow.modes(dry).frequency_hz[i] / still.frequency_hz[i] - 1) > 1e-3


def test_wind_begins_above_the_highest_surface(system: ow.System) -> None:
    """Strips of the tower start where those of the splash zone cannot be wet."""
    wind = ow.TowerWind(10.0, 100.0, ow.PowerLaw(0.14), 0.7)
    strips = ow.tower_drag(system, wind).strips
    assert strips.height[0] - strips.length[0] / 2 == pytest.approx(AMPLITUDE, rel=1e-14)


def test_compiled_chain_and_pinocchio_agree(system: ow.System) -> None:
    """The same residual at random states and times, the surface anywhere."""
    chain = CompiledChain(system)
    equations = system.equations()
    rng = np.random.default_rng(3)
    for time in (0.3, 2.0, 3.7):
        q, v, a = rng.normal(size=(3, system.nv)) * 1e-2
        row = chain.time_inputs(np.array([time]))[0]
        found, expected = chain.residual(row, q, v, a), equations.residual(time, q, v, a)
        assert relative_difference(found, expected) < 1e-11


def test_generalised_alpha_against_radau(system: ow.System) -> None:
    """Two integrators, of which one asks for the mass matrix at each time; a coarse chain."""
    small = ow.build(system.turbine, "clamped", system.sea, elements=3)
    radau = ow.SciPyIVP("Radau", relative_tolerance=1e-6, absolute_tolerance=1e-8)
    reference = ow.simulate(small, 4.0, ramp=1.0, save_at=ow.SaveAt(0.2), integrator=radau)
    moment = reference["mudline_moment"].to_numpy()
    errors = []
    for dt in (0.02, 0.01, 0.005):
        data = ow.simulate(small, 4.0, dt, ramp=1.0, save_at=ow.SaveAt(0.2))
        errors.append(np.abs(data["mudline_moment"].to_numpy() - moment).max() / np.ptp(moment))
    assert errors[-1] < 1e-3
    assert errors[0] > 3 * errors[1] > 9 * errors[2]
