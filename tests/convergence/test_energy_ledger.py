"""The ledger of energies of an operational case: it closes, to second order in dt.

A shortened LC 5.1: distributed springs, irregular waves, synthetic wind, ramp. The wind is linear
between samples 0.02 s apart; every step tried divides that, so that no step has a kink inside.
"""

import numpy as np
import pytest
import xarray as xr
from helpers.numerics import fitted_order
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.soil.springs import TanhCurve
from offwind_pin.definitions.turbine import RotorNacelleRNA

Array = NDArray[np.float64]

DURATION, RAMP, SAMPLING = 120.0, 60.0, 0.02
STEPS = np.array([0.02, 0.01, 0.005, 0.0025])
TOLERANCE = 1e-3
"""Of the balance over the energy dissipated by the end, the least of the energies exchanged."""


@pytest.fixture(scope="module")
def system(oc6: ow.Turbine) -> ow.System:
    waves = ow.IrregularWaves(1.25, 5.5, seed=1, repeat_period=600.0)
    return ow.build(oc6, "distributed_springs", waves, elements=20)


@pytest.fixture(scope="module")
def runs(system: ow.System) -> list[xr.Dataset]:
    """One for each step; the heights are those of the soil's nodes."""
    rna = system.turbine.rna
    assert isinstance(rna, RotorNacelleRNA)
    wind = ow.SyntheticWind(9.06, 0.388, 0.10, seed=1).generate(
        rna, duration=DURATION, repeat_period=DURATION - RAMP
    )
    assert np.allclose(np.diff(wind.time), SAMPLING)
    nodes = system.foundation.soil[0].height
    return [
        ow.simulate(system, DURATION, dt, [wind], ramp=RAMP, save_at=ow.SaveAt(0.2, heights=nodes))
        for dt in STEPS.tolist()
    ]


@pytest.fixture(scope="module")
def coarsest(runs: list[xr.Dataset]) -> xr.Dataset:
    return runs[0]


def dissipated(data: xr.Dataset) -> float:
    """Energy turned into heat by the end in J."""
    return float(data["energy_dissipated"].isel(time=-1).sum())


def test_balance_closes(coarsest: xr.Dataset) -> None:
    """At dt = 0.02 s the balance is below a thousandth of what was dissipated, worked or stored."""
    error = np.abs(coarsest["energy_balance"].to_numpy()).max()
    ranges = [
        np.ptp(coarsest[name].sum(dim).to_numpy())
        for name, dim in (("energy_worked", "source"), ("energy_stored", "holder"))
    ]
    scale = dissipated(coarsest)
    assert 5e4 < scale < min(ranges)
    assert error < TOLERANCE * scale


def test_balance_is_the_sum_of_its_parts(coarsest: xr.Dataset) -> None:
    """Stored since the start, and dissipated, less worked."""
    stored = coarsest["energy_stored"].sum("holder")
    parts = stored - stored[0] + coarsest["energy_dissipated"].sum("sink")
    parts = parts - coarsest["energy_worked"].sum("source")
    assert np.abs(parts - coarsest["energy_balance"]).max() < 1e-9 * stored.max()


def test_balance_is_of_second_order(runs: list[xr.Dataset]) -> None:
    errors = [np.abs(data["energy_balance"].to_numpy()).max() for data in runs]
    assert fitted_order(STEPS, errors) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize(
    ("channel", "part"),
    [
        ("energy_dissipated", "joint_dampers"),
        ("energy_dissipated", "foundation"),
        ("energy_dissipated", "waves"),
        ("energy_dissipated", "soil"),
        ("energy_worked", "waves"),
        ("energy_worked", "tower_top"),
        ("energy_stored", "kinetic"),
        ("energy_stored", "gravitational"),
        ("energy_stored", "elastic"),
        ("energy_stored", "foundation"),
        ("energy_stored", "added_mass"),
        ("energy_stored", "soil"),
    ],
)
def test_a_missing_part_is_seen(runs: list[xr.Dataset], channel: str, part: str) -> None:
    """Negative control: without any one entry the balance does not close, and no step mends it."""
    sign = -1.0 if channel == "energy_worked" else 1.0
    errors = []
    for data in runs:
        entry = data[channel].isel({str(data[channel].dims[1]): list_of(data, channel).index(part)})
        balance = data["energy_balance"] - sign * (entry - entry[0])
        errors.append(np.abs(balance.to_numpy()).max())
    assert errors[0] > TOLERANCE * dissipated(runs[0])
    assert errors[-1] == pytest.approx(errors[0], rel=0.05)


def list_of(data: xr.Dataset, channel: str) -> list[str]:
    """Names of a channel's entries."""
    return [str(name) for name in data[data[channel].dims[1]].to_numpy()]


def test_every_entry_was_tried(coarsest: xr.Dataset) -> None:
    """The names above are all there are, but for loads that turn nothing into heat."""
    assert list_of(coarsest, "energy_worked") == ["waves", "tower_top"]
    sinks = coarsest["energy_dissipated"]
    assert sinks.sel(sink=["added_mass", "tower_top"]).to_numpy().max() == 0
    assert len(sinks["sink"]) == 6
    assert len(coarsest["holder"]) == 6


def test_heat_only_grows(runs: list[xr.Dataset]) -> None:
    """No sink ever gives energy back, and four of them take some."""
    for data in runs:
        heat = data["energy_dissipated"].to_numpy()
        assert np.all(np.diff(heat, axis=0) >= 0)
        assert np.count_nonzero(heat[-1] > 0) == 4


def test_soil_s_energy_is_the_integral_of_its_curves(
    system: ow.System, coarsest: xr.Dataset
) -> None:
    """Over the recorded displacements of the nodes, by quadrature of p_u tanh(k y / p_u)."""
    springs = system.turbine.soil.distributed_springs
    assert springs is not None
    assert isinstance(springs.curve, TanhCurve)
    data = coarsest.sel(height=coarsest["height"] <= -30.0).isel(time=slice(0, None, 20))
    depth = -30.0 - data["height"].to_numpy()
    assert len(depth) == springs.nodes
    length = np.full(springs.nodes, 45.0 / (springs.nodes - 1))
    length[[0, -1]] /= 2
    modulus, ultimate = 4.5e7 * depth, 9.96e5 * depth
    y = np.hypot(*(data["displacement"].sel(direction=axis).to_numpy() for axis in "xy"))
    points, weights = np.polynomial.legendre.leggauss(20)
    energy = np.zeros_like(y)
    for point, weight in zip((1 + points) / 2, weights / 2, strict=True):
        with np.errstate(invalid="ignore"):
            resistance = ultimate * np.tanh(modulus * point * y / ultimate)
        energy += weight * y * np.where(depth > 0, resistance, 0.0)
    found = data["energy_stored"].sel(holder="soil").to_numpy()
    assert found == pytest.approx(energy @ length, rel=1e-10)
    assert np.ptp(found) > 5e3
