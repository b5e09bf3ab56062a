"""What the README and the docs show works as printed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
import yaml

import offwind_pin as ow
from offwind_pin.cases.case import Case, load_case
from offwind_pin.cases.run import run_case
from offwind_pin.definitions.hydrodynamics import Hydrodynamics
from offwind_pin.loads.soil.curves.layered import (
    base_moment_curve,
    base_shear_curve,
    lateral_curves,
    rocking_curves,
)
from offwind_pin.loads.soil.curves.shaft_and_tip import (
    toe_bearing_curve,
    torsional_curves,
    vertical_curves,
)
from offwind_pin.loads.soil.soil_profile import PileNodes

ROOT = Path(__file__).resolve().parents[2]


def _blocks(page: str, language: str) -> list[str]:
    """Fenced blocks of one language, in order."""
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / page).read_text(), flags=re.DOTALL)


@pytest.fixture
def written(tmp_path: Path) -> Path:
    """A folder with the files of the docs, as a reader would write them."""
    turbine = _blocks("docs/turbine_file.md", "yaml")[0]
    (tmp_path / "my_turbine.yaml").write_text(turbine)
    (tmp_path / "curves.csv").write_text(_blocks("docs/turbine_file.md", "csv")[0])
    (tmp_path / "my_case.yaml").write_text(_blocks("docs/case_file.md", "yaml")[0])
    (tmp_path / "my_load.txt").write_text(_blocks("docs/case_file.md", "text")[0])
    return tmp_path


def test_readme_example(capsys: Any) -> None:
    """The ten lines run; the history stays at the static moment under the load."""
    scope: dict[str, Any] = {}
    exec(_blocks("README.md", "python")[0], scope)  # our own text
    frequencies, moment = capsys.readouterr().out.strip().splitlines()
    assert "'FA1': 0.24" in frequencies
    assert float(moment) == pytest.approx(scope["state"].mudline_load[4] / 1e6, rel=1e-6)
    assert float(moment) > 100


def test_turbine_of_the_docs(written: Path) -> None:
    """The complete file: published first frequency about 0.25 Hz without gravity, a little less with."""
    turbine = ow.load_turbine(written / "my_turbine.yaml")
    modes = ow.modes(ow.build(turbine, "coupled_springs", ow.StillWater()))
    assert modes.frequency_hz[modes.index("FA1")] == pytest.approx(0.2403, rel=5e-3)
    assert modes.damping_ratio[modes.index("FA1")] == pytest.approx(0.01, rel=1e-6)


def test_table_of_the_docs(written: Path) -> None:
    """The CSV table takes the place of the tanh curve; its content is part of the hash."""
    path = written / "my_turbine.yaml"
    text = path.read_text()
    tanh = re.search(r"    curve:\n(?:      .*\n)+", text)
    assert tanh
    path.write_text(text.replace(tanh[0], "    curve: {kind: table, file: curves.csv}\n"))
    hashes = []
    for factor in ("2.0e7", "1.0e7"):
        table = written / "curves.csv"
        table.write_text(table.read_text().replace("2.0e7", factor))
        turbine = ow.load_turbine(path)
        modes = ow.modes(ow.build(turbine, "distributed_springs", ow.StillWater()))
        assert 0.2 < modes.frequency_hz[modes.index("FA1")] < 0.26
        ow.export_urdf(ow.build(turbine, "distributed_springs"), written / "urdf")
        sidecar = (written / "urdf" / "my_turbine.json").read_text()
        hashes.append(re.findall(r'"definition_sha256": "(\w+)"', sidecar)[0])
    assert hashes[0] != hashes[1]


def test_layers_of_the_docs(written: Path) -> None:
    """The layered springs take the place of the tanh springs; every reaction that they name is there."""
    path = written / "my_turbine.yaml"
    data = yaml.safe_load(path.read_text())
    data["soil"] |= yaml.safe_load(_blocks("docs/turbine_file.md", "yaml")[2])
    path.write_text(yaml.safe_dump(data))
    springs = ow.load_turbine(path).soil.distributed_springs
    assert springs is not None
    ground = PileNodes(np.linspace(0, 36, springs.nodes), np.full(springs.nodes, 6.0), 36.0)
    lateral = lateral_curves(springs.curve, ground)
    assert np.all(lateral.ultimate[1:] > 0)
    rocking = rocking_curves(springs.curve, ground)
    assert rocking is not None
    assert np.count_nonzero(rocking[1].curves.ultimate) == 19
    for curve in (base_shear_curve, base_moment_curve):
        assert curve(springs.curve, ground) is not None
    for along in (vertical_curves, torsional_curves, toe_bearing_curve):
        assert along(springs, ground) is not None


def test_dampers_of_the_docs(written: Path) -> None:
    """The first is Den Hartog's for the turbine above it, the second is tuned to no mode."""
    path = written / "my_turbine.yaml"
    bare = ow.load_turbine(path)
    data = yaml.safe_load(path.read_text())
    text = next(b for b in _blocks("docs/turbine_file.md", "yaml") if "tuned_mass" in b)
    data |= yaml.safe_load(text)
    path.write_text(yaml.safe_dump(data))
    damped = ow.load_turbine(path)
    first = ow.modes(ow.build(bare, "coupled_springs", ow.StillWater()), 2)
    at = first.index("FA1")
    modal_mass = 1 / first.mass_normalised[at, -1, 0] ** 2
    nacelle = damped.tuned_mass_dampers[0]
    best = ow.den_hartog(nacelle.mass / modal_mass)
    assert nacelle.frequency == pytest.approx(
        best.frequency_ratio * first.frequency_hz[at], rel=2e-3
    )
    assert nacelle.damping_ratio == pytest.approx(best.damping_ratio, rel=5e-3)
    found = ow.modes(ow.build(damped, "coupled_springs", ow.StillWater()), 8)
    assert {"FA1", "SS1", "TMD1", "TMD2"} <= set(found.label)


def test_hydrodynamics_of_the_docs(written: Path) -> None:
    """All of it at once takes the place of the two coefficients, and makes the turbine slower."""
    path = written / "my_turbine.yaml"
    bare = ow.load_turbine(path)
    data = yaml.safe_load(path.read_text())
    data |= yaml.safe_load(_blocks("docs/turbine_file.md", "yaml")[3])
    path.write_text(yaml.safe_dump(data))
    full = ow.load_turbine(path)
    assert set(data["hydrodynamics"]) == set(hydrodynamic_keys())
    frequency = []
    for turbine in (bare, full):
        system = ow.build(turbine, "coupled_springs", ow.StillWater())
        modes = ow.modes(system)
        frequency.append(modes.frequency_hz[modes.index("FA2")])
    assert 0.9 < frequency[1] / frequency[0] < 0.999


def case_of(data: dict[str, Any], folder: Path) -> Case:
    """A case whose relative paths start at a folder."""
    return Case.model_validate(data, context={"folder": folder})


def hydrodynamic_keys() -> list[str]:
    """Every key of the hydrodynamics but the source."""
    return [name for name in Hydrodynamics.model_fields if name != "source"]


def test_case_of_the_docs(written: Path) -> None:
    """The case file with a load file of one's own runs to a report."""
    case = load_case(written / "my_case.yaml")
    short = case.analysis.model_copy(update={"dt": 0.04, "output_dt": 0.08})
    summary = run_case(case.model_copy(update={"analysis": short}), written / "out")
    assert summary["status"] == "complete"
    assert summary["mudline_moment_y_mean_Nm"] > 4e7
    assert "my_load.txt" in (written / "out" / "report.html").read_text()


def test_rotor_of_the_docs(written: Path) -> None:
    """The rotor's block fits a turbine whose rotor and nacelle are one rigid body."""
    path = written / "my_turbine.yaml"
    data = yaml.safe_load(path.read_text())
    data |= yaml.safe_load(_blocks("docs/turbine_file.md", "yaml")[1])
    assert data["rna"]["kind"] == "rigid_body"
    path.write_text(yaml.safe_dump(data))
    thrust = ow.thrust_curve(ow.load_turbine(path), np.array([9.0]))
    assert thrust[0] == pytest.approx(0.5 * 1.225 * np.pi * 63**2 * 0.8 * 81, rel=1e-9)


def test_sea_of_the_docs(written: Path) -> None:
    """The sea that the page shows, and the other kinds it names, run with wind on the tower."""
    base = yaml.safe_load((written / "my_case.yaml").read_text())
    blocks = [yaml.safe_load(block) for block in _blocks("docs/case_file.md", "yaml")]
    shown, irregular, measured = (block for block in blocks if list(block) == ["sea"])
    time = np.arange(0, 60, 0.25)
    rows = [f"{t},{2.5 * np.sin(0.7 * t):.4f}" for t in time]
    (written / "buoy.csv").write_text("\n".join(["time_s,elevation_m", *rows]))
    del base["tower_top_load"]
    short = {"duration_s": 30.0, "ramp_s": 5.0, "dt_s": 0.05, "output_dt_s": 0.1}
    base["analysis"] |= short | {"psd_segment_s": 10.0}
    base |= {"turbine": "oc3_phase2", "foundation": "clamped", "elements": 12}
    base["tower_wind"] = {
        "speed_m_per_s": 20.0,
        "reference_height_m": 90.0,
        "drag_coefficient": 0.7,
        "gust": {"size_m_per_s": 5.0, "start_s": 8.0},
    }
    regular = {"height_m": 6.0, "period_s": 9.0, "direction_deg": 90.0}
    record = case_of(base | measured, written).water
    assert record is not None
    assert "buoy.csv" in record.in_words
    seas = [
        shown["sea"],
        irregular["sea"],
        {"kind": "regular_waves", "stretching": "vertical", **regular},
        {"kind": "stream_function_waves", "crest_time_s": 10.0, **regular},
    ]
    for number, sea in enumerate(seas):
        out = written / f"sea{number}"
        summary = run_case(case_of(base | {"sea": sea}, written), out, report=False)
        assert summary["status"] == "complete"
        with xr.open_dataset(out / "results.nc") as data:
            waves = data["wave_elevation"].sel(time=slice(10, 30))
            assert float(waves.max()) > 2.0
            force = data["mudline_force"].sel(time=slice(10, 30)).std("time")
            lateral = "x" if number < 2 else "y"
            assert float(force.sel(direction=lateral)) > 1e5


def test_tower_top_loads_of_the_docs(written: Path) -> None:
    """Every load that the page shows fits the case; the rotor's runs."""
    base = yaml.safe_load((written / "my_case.yaml").read_text())
    blocks = [yaml.safe_load(block) for block in _blocks("docs/case_file.md", "yaml")]
    loads = [block for block in blocks if list(block) == ["tower_top_load"]]
    kinds = []
    for load in loads:
        case = case_of(base | load, written)
        assert case.tower_top_load is not None
        kinds.append(case.tower_top_load.kind)
    assert kinds == ["file", "openfast_output", "openfast_output", "file", "rotor"]
    short = {"duration_s": 30.0, "ramp_s": 5.0, "dt_s": 0.05, "output_dt_s": 0.1}
    analysis = base["analysis"] | short | {"psd_segment_s": 10.0}
    change = {"turbine": "oc3_phase2", "foundation": "clamped", "sea": {"kind": "still_water"}}
    case = case_of(base | loads[-1] | change | {"analysis": analysis}, written)
    summary = run_case(case, written / "out", report=False)
    assert summary["mean_thrust_N"] == pytest.approx(485.2e3, rel=0.01)
    assert {row["label"]: row["ratio"] for row in summary["aerodynamic_damping"]}["FA1"] > 0.03


def test_sea_in_python(capsys: Any) -> None:
    """The lines about the sea print what they say."""
    block = next(b for b in _blocks("docs/case_file.md", "python") if "TmaSpectrum" in b)
    exec(block, {})  # our own text
    words, count = capsys.readouterr().out.strip().splitlines()
    assert words.startswith("TMA waves")
    assert f"# {count}" in block


def test_earthquakes_of_the_docs(written: Path, capsys: Any) -> None:
    """Both that the page shows, of one motion and by depth, run; its lines of Python print what they say."""
    base = yaml.safe_load((written / "my_case.yaml").read_text())
    (written / "my_record.txt").write_text(_blocks("docs/case_file.md", "text")[1])
    shown = [yaml.safe_load(block) for block in _blocks("docs/case_file.md", "yaml")[2:]]
    earthquakes = [block for block in shown if "earthquake" in block]
    assert len(earthquakes) == 2
    del base["tower_top_load"]
    short = {"duration_s": 30.0, "ramp_s": 5.0, "dt_s": 0.05, "output_dt_s": 0.1}
    base["analysis"] |= short | {"psd_segment_s": 10.0}
    base |= {"turbine": "oc3_phase2", "sea": {"kind": "still_water"}, "elements": 12}
    for number, earthquake in enumerate(earthquakes):
        out = written / f"earthquake{number}"
        summary = run_case(case_of(base | earthquake, written), out, report=False)
        scale = 1.5 if number == 0 else 1.0
        peak = summary["earthquake"]["peak_ground_acceleration_m_per_s2"]
        assert np.hypot(peak["x"], peak["y"]) == pytest.approx(0.2 * 9.80665 * scale, rel=1e-9)
        with xr.open_dataset(out / "results.nc") as data:
            assert len(data["level"]) == 1 + number
            assert float(np.abs(data["mudline_moment"][120:]).max()) > 1e7
    block = next(b for b in _blocks("docs/case_file.md", "python") if "GroundMotion" in b)
    exec(block, {})  # our own text
    assert f"# {capsys.readouterr().out.strip().splitlines()[-1]} m" in block


def test_rotor_in_python(capsys: Any) -> None:
    """The lines of the case file's page print what they say."""
    block = _blocks("docs/case_file.md", "python")[1]
    exec(block, {})  # our own text
    curve, damping = capsys.readouterr().out.strip().splitlines()
    assert f"# {curve} MN" in block
    assert f"# {damping}" in block


def test_links_lead_somewhere() -> None:
    """Every relative link of the pages names a file that is there."""
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    for page in pages:
        for target in re.findall(r"\]\((?!https?://|#)([^)#]+)", page.read_text()):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_soil_of_the_docs(capsys: Any) -> None:
    """The lines of the soil's page print what they say."""
    block = _blocks("docs/soil.md", "python")[0]
    exec(block, {})  # our own text
    assert capsys.readouterr().out.strip() == block.rsplit("# ", 1)[1].strip()
