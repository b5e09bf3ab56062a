"""A tower let go, dry and undamped: its energy is kept, to second order in dt and without drift."""

import numpy as np
import pytest
import xarray as xr
from helpers.numerics import fitted_order
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.solvers.steps import FixedStep

Array = NDArray[np.float64]

NOTHING = ow.LoadHistory(np.zeros(1), np.zeros((1, 6)), "nothing")
BENT_BY = np.array([1e6, 3e5, 0, 0, 0, 1e7])
"""Load that the tower is let go from: its top swings by 0.6 m fore-aft."""
LONG, LATE = 1000.0, 100.0


@pytest.fixture(scope="module")
def tower(undamped: ow.Turbine) -> ow.System:
    system = ow.build(undamped, "clamped", elements=10)
    return system.with_damping(np.zeros(system.nv), {})


def let_go(
    system: ow.System, duration: float, integrator: GeneralizedAlpha, output_dt: float
) -> xr.Dataset:
    """The load is the mean of a history of nothing: it is there in statics, and gone in motion."""
    load = TowerTopLoad(system.chain.top, NOTHING, BENT_BY)
    return ow.simulate(
        system,
        duration,
        loads=[load],
        save_at=ow.SaveAt(output_dt, heights=[0.0]),
        integrator=integrator,
    )


def of_motion(system: ow.System, data: xr.Dataset) -> float:
    """Energy at the start above that of the equilibrium without the load, in J."""
    rest = ow.simulate(system, 0.01, 0.01)
    stored = [run["energy_stored"].isel(time=0).sum().item() for run in (data, rest)]
    return stored[0] - stored[1]


def tight(dt: float, radius: float = 1.0) -> GeneralizedAlpha:
    return GeneralizedAlpha(FixedStep(dt), radius, 1e-11, 1e-12)


def trend_over_amplitude(time: Array, error: Array) -> float:
    """What the straight line through a late error rises by, over the error's range."""
    late = time >= LATE
    slope = np.polyfit(time[late], error[late], 1)[0]
    return float(abs(slope) * (LONG - LATE) / np.ptp(error[late]))


@pytest.fixture(scope="module")
def long_run(tower: ow.System) -> xr.Dataset:
    return let_go(tower, LONG, tight(0.01), 0.2)


def test_it_swings_freely(tower: ow.System, long_run: xr.Dataset) -> None:
    """The start is the bent state, at rest; then nothing works, nothing is lost, and it swings."""
    bent = ow.static(tower, BENT_BY)
    top = long_run["tower_top_displacement"].to_numpy()
    assert top[0] == pytest.approx(bent.tower_top_displacement, rel=1e-12)
    assert long_run["energy_stored"].sel(holder="kinetic")[0].item() == 0
    assert np.all(long_run["energy_worked"] == 0)
    assert np.all(long_run["energy_dissipated"] == 0)
    last_period = top[long_run["time"].to_numpy() > LONG - 4]
    assert np.ptp(last_period[:, 0]) > 1.5 * (top[0, 0] - ow.static(tower).displacement[-1, 0])


def test_energy_is_kept(tower: ow.System, long_run: xr.Dataset) -> None:
    """After 1000 s at dt = 0.01 s the energy is off by less than 1e-5 of that of the motion."""
    error = long_run["energy_balance"].to_numpy()
    scale = of_motion(tower, long_run)
    assert scale > 1e5
    assert np.abs(error).max() < 1e-5 * scale


def test_energy_does_not_drift(long_run: xr.Dataset) -> None:
    """The error swings about zero: over 900 s its trend is a hundredth of its range, or less."""
    time, error = long_run["time"].to_numpy(), long_run["energy_balance"].to_numpy()
    assert trend_over_amplitude(time, error) < 0.01
    early, late = (np.abs(error[part]).max() for part in (time < LATE, time > LONG - LATE))
    assert late < 1.2 * early


def test_default_tolerances_keep_energy_as_well(tower: ow.System) -> None:
    """With what Newton's iteration leaves by default the error still stays below 1e-5."""
    data = let_go(tower, LONG, GeneralizedAlpha(FixedStep(0.01), 1.0), 0.2)
    error = np.abs(data["energy_balance"].to_numpy()).max()
    assert error < 1e-5 * of_motion(tower, data)


def test_error_is_of_second_order(tower: ow.System) -> None:
    """Root mean square of the error at every step, over a minute."""
    steps = np.array([0.04, 0.02, 0.01, 0.005])
    errors = []
    for dt in steps.tolist():
        balance = let_go(tower, 60.0, tight(dt), dt)["energy_balance"].to_numpy()
        errors.append(np.sqrt(np.mean(balance**2)))
    assert fitted_order(steps, errors) == pytest.approx(2.0, abs=0.1)


def test_numerical_damping_is_seen(tower: ow.System) -> None:
    """Negative control: with spectral radius 0.9 energy is lost, and the loss is a trend."""
    data = let_go(tower, LONG, tight(0.01, 0.9), 0.2)
    time, error = data["time"].to_numpy(), data["energy_balance"].to_numpy()
    assert error[-1] < -1e-5 * of_motion(tower, data)
    assert trend_over_amplitude(time, error) > 0.5
