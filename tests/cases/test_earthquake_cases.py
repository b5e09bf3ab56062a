"""Cases with an earthquake, from the case file to summary, results and report."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray as xr
import yaml
from helpers.earthquakes import shaking

import offwind_pin as ow
from offwind_pin.analysis.foundation.study.state import soil_displacement_reached, soil_springs
from offwind_pin.cases.case import load_case
from offwind_pin.cases.earthquake import PERIODS, CaseEarthquake, earthquake_dataset
from offwind_pin.cases.run import run_case
from offwind_pin.display.figures.earthquake import response_spectrum_plot
from offwind_pin.signal.response_spectrum import response_spectrum

CASE: dict[str, Any] = {
    "name": "shaken",
    "turbine": "oc6_phase2",
    "foundation": "distributed_springs",
    "sea": {"kind": "still_water"},
    "elements": 8,
    "analysis": {
        "kind": "transient",
        "duration_s": 20.0,
        "ramp_s": 2.0,
        "dt_s": 0.02,
        "output_dt_s": 0.02,
        "psd_segment_s": 10.0,
    },
}
RECORD = {"file": "record.txt", "acceleration_unit": "g", "components": ["x", "z"]}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """With a record of 12 s in g, x and z."""
    motion = shaking(12.0, 0.02)
    table = np.column_stack([motion.time, motion.acceleration[:, [0, 2]] / 9.80665])
    np.savetxt(tmp_path / "record.txt", table)
    np.savetxt(tmp_path / "deep.txt", table * [1, 0.7, 0.9])
    return tmp_path


def case(folder: Path, earthquake: dict[str, Any], **changes: Any) -> Path:
    path = folder / "case.yaml"
    path.write_text(yaml.safe_dump(CASE | {"earthquake": earthquake} | changes))
    return path


def test_case_to_report(folder: Path) -> None:
    """Scaled, turned into y, later, corrected: in the results, in the summary and in the page."""
    how = {"scale": 0.5, "direction_deg": 90.0, "start_s": 3.0, "baseline": "parabolic"}
    run_case(case(folder, RECORD | how), folder / "out")
    motion = shaking(12.0, 0.02)
    record = np.zeros((len(motion.time), 3))
    record[:, 1], record[:, 2] = 0.5 * motion.acceleration[:, [0, 2]].T
    expected = ow.GroundMotion(motion.time + 3, record, baseline="parabolic")
    with xr.open_dataset(folder / "out" / "results.nc") as data:
        moved = expected.motion(data["time"].to_numpy())[:, 0]
        for part, name in enumerate(("displacement", "velocity", "acceleration")):
            found = data[f"ground_{name}"].isel(level=0).to_numpy()
            np.testing.assert_allclose(found, moved[:, part], rtol=1e-6, atol=1e-9)
        assert data["level"].to_numpy() == pytest.approx([-30.0])
        assert "record.txt" in data.attrs["ground_motion_origin"]
        assert "absolute" in data["displacement"].attrs["long_name"]
        assert "ground" in data["source"].to_numpy()
    told = json.loads((folder / "out" / "summary.json").read_text())["earthquake"]
    peak = told["peak_ground_acceleration_m_per_s2"]
    assert peak["y"] == pytest.approx(np.abs(expected.corrected[0, :, 1]).max(), rel=1e-9)
    assert peak["x"] == pytest.approx(0.0, abs=1e-12)
    velocity = np.abs(expected.motion(expected.time)[:, 0, 1, 2]).max()
    assert told["peak_ground_velocity_m_per_s"]["z"] == pytest.approx(velocity, rel=1e-9)
    fine = expected.motion(np.linspace(3, 15, 24001))[:, 0, 2, 1]
    squares = np.pi / (2 * 9.81) * np.trapezoid(fine**2, dx=0.0005)
    assert told["arias_intensity_m_per_s"]["y"] == pytest.approx(squares, rel=1e-3)
    assert 3 < told["significant_duration_5_95_s"]["y"] < 9
    first = told["response_spectrum_at_modes"][0]
    ordinate = response_spectrum(expected.corrected[0, :, 1], 0.02, np.array([first["period_s"]]))
    assert 3 < first["period_s"] < 5
    assert first["displacement_m"]["y"] == pytest.approx(ordinate.displacement[0], rel=1e-6)
    page = (folder / "out" / "report.html").read_text()
    assert 'id="earthquake"' in page
    assert "Arias intensity" in page


def test_levels_by_depth(folder: Path) -> None:
    """Two records at toe and mudline, in any order; the soil's displacement is that in the ground."""
    levels = [
        RECORD | {"z_m": -20.0, "components": ["x", "z"]},
        RECORD | {"z_m": -75.0, "file": "deep.txt"},
    ]
    run_case(case(folder, {"levels": levels, "start_s": 1.0}), folder / "out")
    with xr.open_dataset(folder / "out" / "results.nc") as data:
        assert data["level"].to_numpy().tolist() == [-75.0, -20.0]
        ground = data["ground_acceleration"].sel(direction="x").to_numpy()
        np.testing.assert_allclose(ground[:, 0], 0.7 * ground[:, 1], rtol=1e-6, atol=1e-9)
        system = ow.build(ow.load_turbine("oc6_phase2"), "distributed_springs", elements=8)
        soil = soil_springs(system)
        assert soil is not None
        reached = soil_displacement_reached(data, soil)
        absolute = soil_displacement_reached(data.drop_vars("ground_displacement"), soil)
        moved = np.abs(data["ground_displacement"].sel(direction="x")).max()
        assert absolute[-1] > 0.5 * float(moved)
        assert reached[-1] < 0.3 * absolute[-1]


def test_at2_files(folder: Path) -> None:
    """By axis; their unit is g."""
    values = shaking(12.0, 0.02).acceleration[:, 0] / 9.80665
    head = f"A\nB\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(values)}, DT= .0200 SEC\n"
    (folder / "a.AT2").write_text(head + "\n".join(f"{v:.9e}" for v in values))
    earthquake = load_case(case(folder, {"at2": {"y": "a.AT2"}, "scale": 2.0})).earthquake
    assert earthquake is not None
    motion, cautions = earthquake.ground_motion()
    assert np.abs(motion.acceleration).max(axis=0) == pytest.approx([0, 6.0, 0], rel=1e-6)
    assert motion.time[-1] == pytest.approx(12.0)
    assert cautions == []


FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {
    "no file": ({"scale": 2.0}, ["both given, or neither", "at2"]),
    "no unit": ({"file": "record.txt", "components": ["x", "z"]}, ["acceleration_unit"]),
    "no components": ({"file": "record.txt", "acceleration_unit": "g"}, ["components"]),
    "unknown unit": (RECORD | {"acceleration_unit": "gal"}, ["m_per_s2", "cm_per_s2"]),
    "unknown axis": (RECORD | {"components": ["x", "w"]}, ["components"]),
    "unknown key": (RECORD | {"factor": 2.0}, ["factor"]),
    "scale of nothing": (RECORD | {"scale": 0.0}, ["a scale of 0"]),
    "start before the beginning": (RECORD | {"start_s": -1.0}, ["start_s"]),
    "start after the end": (RECORD | {"start_s": 30.0}, ["a start at 30 s"]),
    "baseline": (RECORD | {"baseline": "linear"}, ["parabolic"]),
    "at2 with a unit": (
        {"at2": {"x": "a.AT2"}, "acceleration_unit": "g"},
        ["at2 files name their unit"],
    ),
    "file and levels": (
        RECORD | {"levels": [RECORD | {"z_m": -20.0}, RECORD | {"z_m": -75.0}]},
        ["file and at2", "in each level"],
    ),
    "one level": ({"levels": [RECORD | {"z_m": -20.0}]}, ["levels"]),
    "levels that stop above the toe": (
        {"levels": [RECORD | {"z_m": -20.0}, RECORD | {"z_m": -50.0}]},
        ["z = -50 to -20 m", "z = -75 m"],
    ),
    "a level twice": (
        {"levels": [RECORD | {"z_m": -20.0}, RECORD | {"z_m": -20.0}]},
        ["rising heights"],
    ),
    "levels at other times": (
        {"levels": [RECORD | {"z_m": -20.0}, RECORD | {"z_m": -75.0, "file": "short.txt"}]},
        ["z_m = -20", "the times of the level below"],
    ),
    "missing file": (RECORD | {"file": "none.txt"}, ["none.txt", "no such file"]),
    "cm/s2 as m/s2": (RECORD | {"scale": 60.0}, ["at most 100 m/s2"]),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_bad_earthquakes(fault: str, folder: Path) -> None:
    """Told with what is allowed; nothing is written."""
    earthquake, told = FAULTS[fault]
    np.savetxt(folder / "short.txt", [[0, 0.1, 0.1], [1, 0.2, 0]])
    with pytest.raises(ow.InputError) as error:
        run_case(case(folder, earthquake), folder / "out")
    assert all(text in str(error.value) for text in told)
    assert not (folder / "out" / "summary.json").exists()
    assert not (folder / "out" / "results.nc").exists()


def test_only_time_histories_are_shaken(folder: Path) -> None:
    path = case(folder, RECORD, analysis={"kind": "modes", "count": 4})
    with pytest.raises(ow.InputError, match="does not use earthquake"):
        load_case(path)


def test_picture_has_what_it_should() -> None:
    """A panel for each component that moves, the spectrum's lines, and marks at the periods shown."""
    motion = shaking(peak=(3.0, 0.0, 1.0))
    record = motion.corrected[0]
    spectrum = response_spectrum(record, motion.step, PERIODS)
    periods = {"FA1": 4.2, "SS1": 4.25, "FA2": 0.9, "beyond": 20.0}
    modes = SimpleNamespace(label=list(periods), frequency_hz=1 / np.array([*periods.values()]))
    figure = response_spectrum_plot(earthquake_dataset(CaseEarthquake(motion, [], 9.81), modes))
    assert len(figure.axes) == 3
    lines = {line.get_label(): line for line in figure.axes[-1].lines}
    np.testing.assert_allclose(lines["x"].get_ydata(), spectrum.pseudo_acceleration[:, 0])
    np.testing.assert_allclose(lines["z"].get_ydata(), spectrum.pseudo_acceleration[:, 2])
    assert "y" not in lines
    marks = [line.get_gid() for line in figure.axes[-1].lines if line.get_gid()]
    assert marks == ["mark FA1", "mark SS1", "mark FA2"]
    assert "m/s²" in figure.axes[0].get_ylabel()
