"""The recorded forces of the soil are what its springs and dashpots did, node by node."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.soil.springs.elastic import SoilSprings


def lateral(system: ow.System) -> SoilSprings:
    return next(load for load in system.foundation.soil if isinstance(load, SoilSprings))


def history(system: ow.System, **settings: Any) -> xr.Dataset:
    return ow.simulate(
        system, 2.0, 0.01, save_at=ow.SaveAt(heights=lateral(system).height.tolist()), **settings
    )


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    """An oblique wave, so that both directions act."""
    return ow.build(undamped, "distributed_springs", ow.RegularWaves(6.0, 8.0, 30.0), elements=12)


@pytest.fixture(scope="module")
def results(system: ow.System) -> xr.Dataset:
    return history(system, loads=[np.array([1e6, 3e5, 0, 0, 0, 0])], ramp=1.0)


def law(system: ow.System, data: xr.Dataset, *, moving: bool = True) -> Array:
    """(t, n, 2) force of the springs, and of the dashpots, at the recorded displacement.

    By the load's own forces in Python, one instant after the other; velocities are differences.
    """
    soil = lateral(system)
    place = data.displacement.sel(height=soil.height, method="nearest").values.astype(float)
    velocity = np.gradient(place, data.time.values, axis=0, edge_order=2) * moving
    upright = np.tile([0.0, 0.0, 1.0], (len(soil.height), 1))
    rest = np.column_stack([np.zeros((len(soil.height), 2)), soil.height])
    forces = [
        soil.forces(0.0, PointMotion(rest + u, u, v, upright), 1.0).force
        for u, v in zip(place, velocity, strict=True)
    ]
    return np.array(forces)[:, np.argsort(soil.height), :2]


def test_nodes_are_the_springs(system: ow.System, results: xr.Dataset) -> None:
    assert_allclose(results.soil_node, np.sort(lateral(system).height))
    assert results.soil_force.dims == ("time", "soil_node", "direction")
    assert results.soil_force.attrs["units"] == "N"


def test_force_is_the_law_at_the_recorded_motion(system: ow.System, results: xr.Dataset) -> None:
    """To the error of the differences that stand for the velocity; both directions act."""
    found = results.soil_force.values[1:-1, :, :2]
    expected = law(system, results)[1:-1]
    scale = np.abs(expected).max(axis=(0, 1))
    assert np.all(scale > 1e4)
    assert np.abs((found - expected) / scale).max() < 1e-3
    # negative control: dashpots take part by far more than that
    assert np.abs((found - law(system, results, moving=False)[1:-1]) / scale).max() > 5e-3


def test_soil_carries_what_comes_down(system: ow.System) -> None:
    """At rest the soil's horizontal forces are the load at the top, and none is at the toe."""
    load = np.array([1e6, 3e5, 0, 0, 0, 0])
    data = history(replace(system, sea=None), loads=[load])
    first = data.soil_force.isel(time=0).sum("soil_node").values
    assert_allclose(first[:2], -load[:2], rtol=1e-5)


def test_no_soil_no_channel(undamped: ow.Turbine) -> None:
    for foundation in ("clamped", "coupled_springs"):
        data = ow.simulate(ow.build(undamped, foundation, elements=6), 0.1, 0.05)
        assert "soil_force" not in data
        assert "soil_node" not in data.coords


def test_a_file_holds_it(system: ow.System, results: xr.Dataset, tmp_path: Path) -> None:
    load = np.array([1e6, 3e5, 0, 0, 0, 0])
    history(system, loads=[load], ramp=1.0, directory=tmp_path).close()
    with xr.open_dataset(tmp_path / "results.nc") as data:
        largest = float(np.abs(results.soil_force).max())
        assert_allclose(data.soil_force, results.soil_force, atol=1e-6 * largest)
