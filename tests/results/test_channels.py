"""Every time history follows the declared table of channels, and so does the page that prints it."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from helpers.doc_pages import ROOT

import offwind_pin as ow
from offwind_pin.base.whole_files import write_netcdf
from offwind_pin.loads.sea.forces.morison import WAVE_ELEVATION
from offwind_pin.loads.tower_top.load_history import TOWER_TOP_LOAD, TowerTopLoad, constant_load
from offwind_pin.results.channels import CHANNELS

DECLARED = {channel.name: channel for channel in (*CHANNELS, TOWER_TOP_LOAD, WAVE_ELEVATION)}
PUSH = np.array([1e5, 0.0, 0.0, 0.0, 0.0, 0.0])


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "clamped", elements=4)


def test_histories_follow_the_table(coarse: ow.System, tmp_path: Path) -> None:
    """On soil and in an earthquake, all but the dampers' channels; in the file with their types."""
    time = np.linspace(0.0, 0.2, 5)
    shaking = np.zeros((5, 3))
    shaking[1:3, 0] = 1.0, -1.0
    motion = ow.GroundMotion(time, shaking)
    data = ow.simulate(coarse, 0.4, 0.1, [PUSH], ground_motion=motion, directory=tmp_path)
    with data:
        found = {name: data[name] for name in data.data_vars if "time" in data[name].dims}
        assert found.keys() == DECLARED.keys() - {
            "tuned_mass_displacement",
            "inertial_damping_load",
        }
        for name, variable in found.items():
            channel = DECLARED[str(name)]
            assert variable.dims == ("time", *channel.dims)
            assert variable.dtype == channel.dtype
            assert channel.attributes.items() <= variable.attrs.items()
        moment = data["section_moment"].sel(height=-30.0, method="nearest")
        xr.testing.assert_allclose(
            moment.drop_vars("height"), data["mudline_moment"].drop_vars("height", errors="ignore")
        )


class OtherChannels(TowerTopLoad):
    """Declares one channel in place of its own."""

    declared: Any

    @property
    def channels(self) -> tuple[ow.Channel, ...]:
        return (self.declared,)


@pytest.mark.parametrize(
    ("channel", "is_refused"),
    [
        (TOWER_TOP_LOAD, False),
        (replace(TOWER_TOP_LOAD, units="kN"), True),
        (ow.Channel("displacement", (), "m", "of a spring"), True),
    ],
    ids=["the same", "other units", "one of every run"],
)
def test_one_name_is_one_channel(
    system: ow.System, channel: ow.Channel, *, is_refused: bool
) -> None:
    made = constant_load(system.chain.top, PUSH)
    load = OtherChannels(made.yaw_bearing, made.history, made.mean, "own")
    object.__setattr__(load, "declared", channel)
    loads = [made, load]
    if not is_refused:
        data = ow.simulate(system, 0.1, 0.1, loads)
        assert float(data["tower_top_load"][-1, 0]) == 2e5
        return
    with pytest.raises(ow.InputError, match=channel.name):
        ow.simulate(system, 0.1, 0.1, loads)


def test_channels_that_are_kept(system: ow.System, tmp_path: Path) -> None:
    """Those asked for, with the numbers of a run that keeps all; in the blocks and the file too."""
    whole = ow.simulate(system, 0.4, 0.1, [PUSH])
    kept = ["energy_balance", "mudline_force", "tower_top_load"]
    save_at = ow.SaveAt(0.2, channels=kept)
    few = ow.simulate(system, 0.4, 0.1, [PUSH], save_at=save_at, directory=tmp_path).load()
    assert {name for name in few.data_vars if "time" in few[name].dims} == set(kept)
    for name in kept:
        np.testing.assert_array_equal(few[name], whole[name][::2])
    few.close()


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"save_at": {"channels": ["mudline_force", "mudline_torque"]}}, "mudline_torque"),
        ({"save_at": {"channels": ["soil_force"]}}, "soil_force"),
        ({"save_at": {"output_dt": 0.0}}, "output_dt"),
        ({"save_at": {"output_dt": 0.15}}, "output_dt"),
        ({"save_at": {"segments": [(5.0, -5.0)]}}, "segments"),
        ({"save_at": {"heights": [200.0]}}, "heights"),
        ({"dt": 0.1, "integrator": ow.GeneralizedAlpha(ow.FixedStep(0.1))}, "dt"),
        ({"dt": None, "integrator": ow.GeneralizedAlpha(ow.AdaptiveStep())}, "save_at"),
    ],
)
def test_settings_that_cannot_be_used(
    system: ow.System, arguments: dict[str, Any], field: str
) -> None:
    def solve(dt: float | None = 0.1, **settings: Any) -> xr.Dataset:
        if "save_at" in settings:
            settings["save_at"] = ow.SaveAt(**settings["save_at"])
        return ow.simulate(system, 0.6, dt, **settings)

    with pytest.raises(ow.InputError, match=field):
        solve(**arguments)


FAULTS: dict[str, Callable[[xr.Dataset], xr.Dataset]] = {
    "units": lambda data: data.assign(mudline_force=data.mudline_force.assign_attrs(units="kN")),
    "dimensions": lambda data: data.rename(direction="axis"),
    "type": lambda data: data.assign(solver_step=data.solver_step.astype(int)),
    "rising": lambda data: data.isel(time=slice(None, None, -1)),
    "no times": lambda data: data.drop_vars("time"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_other_channels_are_not_read(system: ow.System, tmp_path: Path, fault: str) -> None:
    data = ow.simulate(system, 0.2, 0.1)
    data["solver_step"] = data["solver_step"].fillna(0.0)
    write_netcdf(tmp_path / "results.nc", data)
    ow.open_results(tmp_path).close()
    write_netcdf(tmp_path / "results.nc", FAULTS[fault](data))
    with pytest.raises(ow.InputError, match=fault):
        ow.open_results(tmp_path)


def test_page_prints_the_table() -> None:
    """``python docs/channels.py`` would change nothing; of another table the page would differ."""
    script = runpy.run_path(str(ROOT / "docs" / "channels.py"))
    page = script["PAGE"].read_text(encoding="utf-8")
    assert script["page"]() == page
    script["page"].__globals__["CHANNELS"] = CHANNELS[1:]
    assert script["page"]() != page
