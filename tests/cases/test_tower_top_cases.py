"""Cases with load files and with a running rotor, from the case file to the summary."""

from __future__ import annotations

import json
import logging
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
import yaml
from helpers.openfast_files import UNITS, YAW_BEARING, some_load, write_out, write_outb

import offwind_pin as ow
from offwind_pin.analysis.aerodynamic_damping import aerodynamic_damping
from offwind_pin.cases.run import run_case
from offwind_pin.formats.openfast.yaw_bearing_load import weight_at_yaw_bearing
from offwind_pin.loads.wind.thrust_table import thrust_curve

CASE: dict[str, Any] = {
    "name": "top",
    "turbine": "oc6_phase2",
    "foundation": "clamped",
    "sea": {"kind": "dry"},
    "elements": 6,
    "analysis": {
        "kind": "transient",
        "duration_s": 60.0,
        "ramp_s": 10.0,
        "dt_s": 0.05,
        "output_dt_s": 0.1,
        "psd_segment_s": 20.0,
    },
}
TIME = np.arange(0, 60.2, 0.08)
ROTOR = {"kind": "rotor", "wind_speed_m_per_s": 9.0, "turbulence_class": "B"}


def run(folder: Path, load: dict[str, Any], *, report: bool = False) -> dict[str, Any]:
    (folder / "case.yaml").write_text(yaml.safe_dump(CASE | {"tower_top_load": load}))
    run_case(folder / "case.yaml", folder / "out", report=report, overwrite=True)
    summary: dict[str, Any] = json.loads((folder / "out" / "summary.json").read_text())
    return summary


def applied(folder: Path) -> np.ndarray[Any, Any]:
    with xr.open_dataset(folder / "out" / "results.nc") as data:
        return data["tower_top_load"].to_numpy()


def test_openfast_file_less_its_weight(
    tmp_path: Path, oc6: ow.Turbine, caplog: pytest.LogCaptureFixture
) -> None:
    """The yaw bearing's load in kN, less the weight in it, is what acts after the ramp in N."""
    weight = weight_at_yaw_bearing(oc6.rna, oc6.site.gravity)
    load = 1e3 * some_load(TIME) * [1, 1, 0, 1, 1, 1] + weight
    write_outb(tmp_path / "run.outb", 3, TIME, YAW_BEARING, UNITS, load / 1e3)
    kept = {"kind": "openfast_output", "file": "run.outb", "subtract_weight": True}
    with caplog.at_level(logging.INFO, "offwind_pin"):
        summary = run(tmp_path, kept)
    shown = applied(tmp_path)
    after = np.arange(100, 601) * 0.1
    expected = np.interp(after, TIME, 1e3 * some_load(TIME)[:, 0])
    np.testing.assert_allclose(shown[100:, 0], expected, rtol=1e-9)
    assert np.max(np.abs(shown[:, 2])) < 1.0
    assert summary["tower_top_load_cautions"] == []
    assert any(
        "interpolated linearly at steps of 0.05 s" in note
        for note in summary["tower_top_load_notes"]
    )
    assert "interpolated linearly" in caplog.text
    with xr.open_dataset(tmp_path / "out" / "results.nc") as data:
        assert "interpolated" in data.attrs["tower_top_load_notes"]
        assert "less the weight" in data.attrs["tower_top_load_origin"]


def test_mistakes_are_guessed(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A file in kN run as N, and one with the weight in it, run with a caution in log and summary."""
    rows = "\n".join(f"{t:.2f} 900 0 0 0 0 0" for t in TIME)
    (tmp_path / "wind.txt").write_text(rows)
    summary = run(tmp_path, {"kind": "file", "file": "wind.txt"})
    assert "seem to be in kN" in summary["tower_top_load_cautions"][0]
    assert "seem to be in kN" in caplog.text
    scaled = run(tmp_path, {"kind": "file", "file": "wind.txt", "factor": 1000})
    assert scaled["tower_top_load_cautions"] == []
    more = scaled["mudline_moment_y_mean_Nm"] - summary["mudline_moment_y_mean_Nm"]
    assert more == pytest.approx(900e3 * (1 - 1e-3) * 145.63, rel=0.03)


def test_files_add_up(tmp_path: Path) -> None:
    """Two files, one later and of half the size, from two formats, are one load."""
    write_out(tmp_path / "run.out", TIME, ["RotThrust"], ["(kN)"], np.full((len(TIME), 1), 600.0))
    early = np.arange(-10.0, 70.0, 0.5)
    rows = [f"{t} {2e5 * np.sin(0.3 * t):.6f} 0 0 0 0 0" for t in early]
    (tmp_path / "swing.txt").write_text("\n".join(rows))
    load = {
        "kind": "file",
        "files": [
            {"file": "run.out", "channels": {"Fx": "RotThrust"}},
            {"file": "swing.txt", "factor": 0.5, "shift_s": 2.0},
        ],
    }
    summary = run(tmp_path, load)
    shown = applied(tmp_path)[100:, 0]
    time = np.arange(100, 601) * 0.1
    np.testing.assert_allclose(shown, 6e5 + 1e5 * np.sin(0.3 * (time - 2.0)), atol=400.0)
    assert any("swing.txt" in note for note in summary["tower_top_load_notes"])


@pytest.fixture(scope="module")
def rotor(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], Path]:
    folder = tmp_path_factory.mktemp("rotor")
    return run(folder, ROTOR, report=True), folder


def test_rotor_case(rotor: tuple[dict[str, Any], Path], oc6: ow.Turbine) -> None:
    """Mean thrust, damping by mode, blade-passing lines and the origin are in the results."""
    summary, folder = rotor
    assert summary["mean_thrust_N"] == pytest.approx(
        thrust_curve(oc6, np.array([9.0]))[0], rel=1e-9
    )
    reported = {row["label"]: row["ratio"] for row in summary["aerodynamic_damping"]}
    direct = aerodynamic_damping(ow.build(oc6, "clamped", elements=6), 9.0)
    assert reported["FA1"] == pytest.approx(direct.ratio[direct.label.index("FA1")], rel=1e-3)
    assert reported["FA1"] > 0.05
    assert abs(reported["SS1"]) < 1e-6
    assert summary["mudline_moment_y_mean_Nm"] == pytest.approx(
        summary["mudline_moment_y_static_under_mean_loads_Nm"], rel=0.03
    )
    with xr.open_dataset(folder / "out" / "results.nc") as data:
        assert "seed 1" in data.attrs["tower_top_load_origin"]
        assert "IEA-10.0-198-RWT" in data.attrs["tower_top_load_origin"]
    assert "aerodynamic" in (folder / "out" / "report.html").read_text().lower()


def test_instant_control_above_rated_is_reported(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """There the thrust falls with the wind, the damping is negative, and the log says what follows."""
    load = ROTOR | {"wind_speed_m_per_s": 14.0, "control": "instant"}
    summary = run(tmp_path, load)
    reported = {row["label"]: row["ratio"] for row in summary["aerodynamic_damping"]}
    assert reported["FA1"] < 0
    assert "FA1 is unstable" in caplog.text
    lagged = run(tmp_path, ROTOR | {"wind_speed_m_per_s": 14.0, "inflow_lag": True})
    reported = {row["label"]: row["ratio"] for row in lagged["aerodynamic_damping"]}
    assert reported["FA1"] > 0.02
