"""Everything that water and wind do to members at once, in time: energies and segments balance."""

import numpy as np
import pytest
import xarray as xr
from helpers.numerics import fitted_order

import offwind_pin as ow
from offwind_pin.definitions.hydrodynamics import FloodedPile, MarineGrowth
from offwind_pin.loads.wind.profiles import ExtremeOperatingGust, PowerLaw
from offwind_pin.loads.wind.tower_drag import TowerWind, tower_drag

STEPS = np.array([0.04, 0.02, 0.01])


def everything(oc6: ow.Turbine) -> ow.Turbine:
    """Growth, water inside and buoyancy."""
    keys = {
        "buoyancy": True,
        "contents": FloodedPile(kind="flooded", level=-1.0),
        "marine_growth": (MarineGrowth(z=(-30.0, 1.0), thickness=0.1),),
    }
    return oc6.model_copy(update={"hydrodynamics": oc6.hydrodynamics.model_copy(update=keys)})


@pytest.fixture(scope="module")
def runs(oc6: ow.Turbine) -> list[xr.Dataset]:
    waves = ow.IrregularWaves(5.0, 9.0, seed=1, repeat_period=600.0)
    system = ow.build(everything(oc6), "distributed_springs", waves, elements=20)
    gust = ExtremeOperatingGust(4.0, start=12.0)
    wind = tower_drag(system, TowerWind(8.0, 119.0, PowerLaw(0.14), 0.7, gust=gust))
    return [
        ow.simulate(
            system,
            30.0,
            dt,
            [wind],
            ramp=8.0,
            save_at=ow.SaveAt(0.2, segments=[(-30.0, -9.0), (-9.0, 40.0)]),
        )
        for dt in STEPS.tolist()
    ]


def balance(data: xr.Dataset) -> float:
    return float(np.abs(data["energy_balance"]).max())


def test_the_ledger_closes(runs: list[xr.Dataset]) -> None:
    """With second order in the step, to a small part of what the waves work."""
    assert fitted_order(STEPS, [balance(data) for data in runs]) == pytest.approx(2.0, abs=0.15)
    work = runs[1]["energy_worked"].sel(source="waves").to_numpy()
    assert balance(runs[1]) < 1e-3 * np.ptp(work)


@pytest.mark.parametrize("source", ["buoyancy", "contained_pressure"])
def test_a_work_left_out_is_seen(runs: list[xr.Dataset], source: str) -> None:
    """Negative control: without it the ledger does not close, and no step mends it."""
    errors = [
        float(np.abs(data["energy_balance"] + data["energy_worked"].sel(source=source)).max())
        for data in runs
    ]
    assert errors[-1] > 3 * balance(runs[-1])
    assert errors[-1] == pytest.approx(errors[1], rel=0.3)


def test_segments_balance(runs: list[xr.Dataset]) -> None:
    """Growth, water inside and pressures stand in the section loads as in the motion."""
    data = runs[1]
    force = np.abs(data["segment_imbalance"]).max()
    assert force < 1e-9 * float(np.abs(data["section_moment"]).max())


def test_what_stores_energy(runs: list[xr.Dataset]) -> None:
    """Added mass and contained water do; pressure, waves and wind work."""
    data = runs[0]
    assert {"added_mass", "contained_water"} <= set(data["holder"].to_numpy().tolist())
    sources = data["source"].to_numpy().tolist()
    assert sources == ["waves", "buoyancy", "contained_pressure", "tower_wind"]
