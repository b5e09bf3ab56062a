"""The shipped load cases, run as a user runs them, against what they must show."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import offwind_pin as ow
from offwind_pin.cases.case import load_case
from offwind_pin.cases.run import run_case
from offwind_pin.cases.settling import settle
from offwind_pin.cases.shipped import shipped_cases
from offwind_pin.results.reading import open_case
from offwind_pin.results.tree import required

ALWAYS = {"case", "wall_s", "simulated_s", "realtime_factor", "status"}


Shipped = Callable[[str], tuple[dict[str, Any], Path]]


@pytest.fixture(scope="module")
def lc51(shipped: Shipped) -> tuple[dict[str, Any], Path]:
    """LC 5.1 as shipped: 660 s at 0.02 s."""
    return shipped("oc6-lc5.1")


def test_the_contract_names_four_cases() -> None:
    """The shipped cases are those of the contract."""
    assert shipped_cases() == ["oc6-lc1.2", "oc6-lc2.1", "oc6-lc2.3", "oc6-lc5.1"]


def test_lc12_increase_over_clamped(shipped: Shipped) -> None:
    """Gravity: the surrogate soil lets the tower lean 11.4 % further; 14.3 % is published."""
    summary, out = shipped("oc6-lc1.2")
    assert summary.keys() >= ALWAYS
    assert summary["status"] == "complete"
    assert summary["clamped_tower_top_x_m"] == pytest.approx(-0.2072, rel=3e-3)
    assert summary["increase_over_clamped_percent"] == pytest.approx(11.4, abs=0.2)
    assert summary["simulated_s"] == 3000.0
    assert (out / "report.html").stat().st_size > 10_000
    with xr.open_dataset(out / "results.nc") as data:
        top = float(data["displacement"].sel(direction="x")[-1])
    with open_case(out) as tree:
        data = required(tree, "settling")
        settling = data["tower_top_displacement"].sel(direction="x").to_numpy()
        off = data["difference"].to_numpy()
    assert settling[0] == 0
    assert settling[-1] == pytest.approx(top, abs=1e-9)
    assert off[0] > 0.2
    assert off[-1] == summary["settled_difference_m"]
    assert top == pytest.approx(summary["tower_top_x_m"], rel=1e-6)


def test_lc21_frequencies(shipped: Shipped) -> None:
    """Clamped and dry: five frequencies on which four independent programs agree."""
    summary, out = shipped("oc6-lc2.1")
    expected = {"FA1": 0.2744, "SS1": 0.2716, "T1": 1.2692, "FA2": 1.4436, "SS2": 1.3416}
    found = {row["label"]: row["frequency_hz"] for row in summary["modes"]}
    for label, frequency in expected.items():
        assert found[label] == pytest.approx(frequency, rel=3e-3)
    with xr.open_dataset(out / "results.nc") as data:
        assert list(data["mode"].to_numpy()[:2]) == [row["label"] for row in summary["modes"][:2]]


def test_lc23_frequencies_and_peak(shipped: Shipped) -> None:
    """The first two fore-aft modes, by eigenanalysis and from three hours of accelerations."""
    summary, out = shipped("oc6-lc2.3")
    modes = {row["label"]: row for row in summary["modes"]}
    assert 0.235 < modes["FA1"]["frequency_hz"] < 0.245
    assert 1.12 < modes["FA2"]["frequency_hz"] < 1.16
    for row in summary["identified_modes"]:
        computed = modes[row["label"]]
        assert row["frequency_hz"] == pytest.approx(computed["frequency_hz"], rel=0.01)
        assert row["frequency_hz"] == summary[f"identified_{row['label']}_hz"]
        assert row["modal_assurance"] > 0.99
    first, second = summary["identified_modes"]
    assert second["damping_ratio"] == pytest.approx(modes["FA2"]["damping_ratio"], rel=0.2)
    least = 1 / np.sqrt(2 * np.pi * 0.0063 * 0.2426 * 10800.0)
    assert first["damping_scatter"] == pytest.approx(least * first["damping_ratio"], rel=0.2)
    with open_case(out) as tree:
        data = required(tree, "identified_modes")
        assert data["shape"].shape == (2, 13)
        assert data["height"].to_numpy()[[0, -1]] == pytest.approx([-30.0, 115.63])
        # Negative control: the other mode's shape does not pass for it.
        shape = data["shape"].to_numpy()
        assert ow.modal_assurance(shape[0], shape[1])[0, 0] < 0.5
    assert 'id="identified"' in (out / "report.html").read_text()


def test_lc51_summary_has_the_agreed_keys(lc51: tuple[dict[str, Any], Path]) -> None:
    """The keys others read are there, and the run took what the case says."""
    summary, _ = lc51
    agreed = {
        "psd_peaks_hz",
        "psd_sum_0p2_0p3",
        "psd_sum_1p0_1p5",
        "mudline_moment_y_mean_Nm",
        "mudline_moment_y_std_Nm",
        "seed",
    }
    assert ALWAYS | agreed <= summary.keys()
    assert summary["simulated_s"] == 660.0
    assert summary["seed"] == 1
    assert summary["mudline_moment_x_min_Nm"] < summary["mudline_moment_x_max_Nm"]
    waves = summary["waves"]
    assert 0.6 < waves["highest_crest_of_run_m"] <= waves["highest_crest_m"]
    assert waves["lowest_trough_m"] <= waves["lowest_trough_of_run_m"] < -0.6


def test_lc51_spectrum_peaks(lc51: tuple[dict[str, Any], Path]) -> None:
    """The moment's spectrum peaks at the system's own first two fore-aft modes and at the wave."""
    summary, _ = lc51
    natural, near = summary["natural_frequencies_hz"], summary["psd_peaks_near_hz"]
    assert near["FA1"] == pytest.approx(natural["FA1"], rel=0.02)
    assert near["FA2"] == pytest.approx(natural["FA2"], rel=0.02)
    assert near["wave"] == pytest.approx(1 / 5.5, rel=0.02)
    assert set(near.values()) == set(summary["psd_peaks_hz"])


def test_lc51_results_file(lc51: tuple[dict[str, Any], Path]) -> None:
    """Channels have units and frames, the attributes say where they come from, the solver converged."""
    summary, out = lc51
    with xr.open_dataset(out / "results.nc") as data:
        assert data.sizes["time"] == 660 * 25 + 1
        assert data["section_moment"].attrs["units"] == "N m"
        assert "inertial" in data["section_moment"].attrs["frame"]
        assert data.attrs["wave_seed"] == 1
        assert data.attrs["dt_s"] == 0.02
        assert "synthetic" in data.attrs["surrogates"]
        assert float(data["solver_residual"].max()) <= data.attrs["residual_tolerance"]
        moment = data["mudline_moment"].sel(direction="y")
        analysed = moment.where(data["time"] > 60, drop=True)
        assert float(analysed.std()) == pytest.approx(summary["mudline_moment_y_std_Nm"], rel=1e-9)
        over_height = data["section_moment"].sel(direction="y", height=-30.0)
        assert np.allclose(over_height, moment, rtol=1e-6, atol=10.0)


def test_lc51_start_is_steady(lc51: tuple[dict[str, Any], Path]) -> None:
    """Started from statics under the mean loads, the first second moves less than 1 % of the std."""
    summary, out = lc51
    with xr.open_dataset(out / "results.nc") as data:
        moment = data["mudline_moment"].sel(direction="y")
        first = moment.where(data["time"] < 1.0, drop=True)
    assert float(abs(first - first[0]).max()) < 0.01 * summary["mudline_moment_y_std_Nm"]


def test_lc51_report_calls_surrogates_so(lc51: tuple[dict[str, Any], Path]) -> None:
    """The report names both surrogates, soil and wind, and needs nothing from a network."""
    _, out = lc51
    text = (out / "report.html").read_text().lower()
    assert "surrogate" in text
    assert "synthetic" in text
    assert 'src="http' not in text


def test_lc51_halving_the_step(lc51: tuple[dict[str, Any], Path], tmp_path: Path) -> None:
    """Half the time step changes the standard deviation of the moment by less than 1 %."""
    case = load_case("oc6-lc5.1")
    halved = case.model_copy(
        update={"analysis": case.analysis.model_copy(update={"dt": case.analysis.dt / 2})}
    )
    summary = run_case(halved, tmp_path, report=False)
    assert summary["steps"] == 2 * lc51[0]["steps"]
    assert summary["mudline_moment_y_std_Nm"] == pytest.approx(
        lc51[0]["mudline_moment_y_std_Nm"], rel=0.01
    )


def test_a_structure_that_does_not_settle_is_told(
    undamped: ow.Turbine, caplog: pytest.LogCaptureFixture
) -> None:
    """Clamped, dry and without damping it swings on."""
    system = ow.build(undamped, "clamped", elements=6)
    settling = settle(system, ow.static(system), 20.0)
    assert float(settling["difference"][-1]) > 1e-3
    assert "settle_s" in caplog.text
