"""The commands of the contract: JSON keys, files, exit codes, and what is left after a failure."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
import yaml

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.cases import run as case_run
from offwind_pin.loads.sea.forces.morison import MorisonForce

SHORT_CASE = {
    "name": "short",
    "title": "a short case",
    "turbine": "oc6_phase2",
    "foundation": "coupled_springs",
    "sea": {"kind": "irregular_waves", "significant_height_m": 1.25, "peak_period_s": 5.5},
    "analysis": {
        "kind": "transient",
        "duration_s": 30.0,
        "ramp_s": 5.0,
        "dt_s": 0.05,
        "output_dt_s": 0.1,
        "psd_segment_s": 20.0,
    },
    "seed": 7,
}


@pytest.fixture
def short_case(tmp_path: Path) -> Path:
    path = tmp_path / "short.yaml"
    path.write_text(yaml.safe_dump(SHORT_CASE))
    return path


def test_modes_json(offwind: Any) -> None:
    """`modes --json` has the agreed keys and numbers, dry as well as wet."""
    code, out, _ = offwind("modes", "oc6_phase2", "--foundation", "coupled_springs", "--json")
    assert code == 0
    rows = json.loads(out)["modes"]
    assert rows[0].keys() == {
        "label",
        "frequency_hz",
        "damping_ratio",
        "damping_ratio_asked",
        "damping_ratio_structural",
        "damping_ratio_soil",
        "damping_ratio_water",
        "damping_ratio_other",
        "shape_peak_height_ratio",
    }
    asked = {row["label"]: row["damping_ratio_asked"] for row in rows}
    assert (asked["FA1"], asked["T1"]) == (0.005, None)
    wet = {row["label"]: row["frequency_hz"] for row in rows}
    argv = ["modes", "oc6_phase2", "--foundation", "coupled_springs", "--dry", "--json"]
    dry = {row["label"]: row["frequency_hz"] for row in json.loads(offwind(*argv)[1])["modes"]}
    assert wet["FA2"] == pytest.approx(1.1929, rel=3e-3)
    assert dry["FA2"] == pytest.approx(1.2417, rel=3e-3)


def test_modes_elements(offwind: Any) -> None:
    """`--elements` changes the chain: few elements, other frequencies."""
    argv = ["modes", "oc6_phase2", "--foundation", "clamped", "--json"]
    fine = json.loads(offwind(*argv)[1])["modes"][0]["frequency_hz"]
    rough = json.loads(offwind(*argv, "--elements", "4")[1])["modes"][0]["frequency_hz"]
    assert fine != pytest.approx(rough, rel=1e-3)


def test_static_json(offwind: Any) -> None:
    """`static --json` has the agreed keys; a thrust moves the top downwind."""
    argv = ["static", "oc6_phase2", "--foundation", "clamped", "--json"]
    code, out, _ = offwind(*argv)
    assert code == 0
    still = json.loads(out)
    assert still.keys() >= {
        "tower_top_x_m",
        "tower_top_z_m",
        "tower_top_rotation_y_rad",
        "mudline_displacement_x_m",
        "mudline_moment_y_Nm",
        "iterations",
        "residual",
    }
    pushed = json.loads(offwind(*argv, "--tower-top-load", "1e6,0,0,0,0,0")[1])
    assert still["tower_top_x_m"] == pytest.approx(-0.2072, rel=3e-3)
    assert pushed["tower_top_x_m"] > 0.05
    assert pushed["mudline_moment_y_Nm"] - still["mudline_moment_y_Nm"] > 1.4e8


def test_static_takes_a_negative_load(offwind: Any) -> None:
    """A load that starts with a minus sign is a number, not an option."""
    code, out, err = offwind(
        "static",
        "oc6_phase2",
        "--foundation",
        "clamped",
        "--tower-top-load=-1e6,0,0,0,0,0",
        "--json",
    )
    assert code == 0, err
    assert json.loads(out)["tower_top_x_m"] < -0.4


def test_show(offwind: Any) -> None:
    """`show` prints masses, lengths and frequencies, for people and as JSON."""
    code, out, _ = offwind("show", "oc6_phase2")
    assert code == 0
    for text in ("1,031,930", "839,653", "-30.00", "FA1", "surrogate"):
        assert text in out.replace("Surrogate", "surrogate")
    facts = json.loads(offwind("show", "oc6_phase2", "--json")[1])
    assert facts["embedded_length_m"] == 45.0
    assert facts["frequencies_hz"]["clamped, dry"]["FA1"] == pytest.approx(0.2744, rel=3e-3)


def test_urdf(offwind: Any, tmp_path: Path) -> None:
    """`urdf` writes the file, its sidecar and its meshes."""
    code, _, _ = offwind(
        "urdf", "oc6_phase2", "--foundation", "coupled_springs", "--out", str(tmp_path)
    )
    assert code == 0
    assert (tmp_path / "oc6_phase2.urdf").exists()
    sidecar = json.loads((tmp_path / "oc6_phase2.json").read_text())
    assert sidecar["foundation"]["root"]["stiffness"][0][0] == 6.336198e9
    assert any((tmp_path / "meshes").iterdir())


def test_animate(offwind: Any, tmp_path: Path) -> None:
    """`animate` writes one page that names its mode."""
    page = tmp_path / "ss1.html"
    argv = ["animate", "oc6_phase2", "--foundation", "clamped", "--mode", "SS1"]
    assert offwind(*argv, "--html", str(page))[0] == 0
    assert "SS1" in page.read_text()


def test_run_a_case_of_ones_own(offwind: Any, short_case: Path, tmp_path: Path) -> None:
    """`run` with a YAML path writes the three files; the summary is also on standard output."""
    out = tmp_path / "out"
    code, text, err = offwind("run", str(short_case), "--out", str(out), "--json")
    assert code == 0, err
    assert {path.name for path in out.iterdir()} == {
        "manifest.json", "summary.json", "results.nc", "report.html",
    }  # fmt: skip
    assert json.loads(text) == json.loads((out / "summary.json").read_text())
    assert json.loads(text)["seed"] == 7


def test_run_is_reproducible(offwind: Any, short_case: Path, tmp_path: Path) -> None:
    """The same case gives bitwise the same histories; another seed gives others."""
    for name in ("a", "b"):
        offwind("run", str(short_case), "--out", str(tmp_path / name), "--no-report")
    short_case.write_text(yaml.safe_dump(SHORT_CASE | {"seed": 8}))
    offwind("run", str(short_case), "--out", str(tmp_path / "c"), "--no-report")
    a, b, c = (xr.load_dataset(tmp_path / name / "results.nc")["mudline_moment"] for name in "abc")
    assert a.equals(b)
    assert not a.equals(c)


def test_failed_solve_keeps_what_there_is(
    offwind: Any, short_case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exit status 3; time, step and joint are reported; the histories so far are on disk."""
    honest = MorisonForce.time_inputs

    def failing(self: MorisonForce, time: Array, ramp_factor: Array) -> Array:
        """The water's numbers, not a number from 10 s on, up to rounding of the time."""
        spoiled = np.where(time > 9.999, np.nan, 0.0)
        return honest(self, time, ramp_factor) + spoiled[:, None]

    monkeypatch.setattr(MorisonForce, "time_inputs", failing)
    out = tmp_path / "out"
    code, _, err = offwind("run", str(short_case), "--out", str(out))
    assert code == 3
    message = err.strip().splitlines()[-1]
    for text in ("t = 10 s", "step 200", "joint "):
        assert text in message
    assert "Traceback" not in err
    summary = json.loads((out / "summary.json").read_text())
    assert summary["status"] == "failed"
    data = xr.load_dataset(out / "results.nc")
    assert data.attrs["status"] == "failed"
    assert float(data["time"][-1]) == pytest.approx(9.9)


def test_static_without_equilibrium(offwind: Any) -> None:
    """A load beyond what the soil can bear is a failed solve: exit status 3 and the joint."""
    code, _, err = offwind("static", "oc6_phase2", "--tower-top-load", "1e9,0,0,0,0,0")
    assert code == 3
    assert "no static equilibrium" in err
    assert "joint" in err


def test_interrupted_run_keeps_what_there_is(
    offwind: Any, short_case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C: exit status 130, and the histories so far on disk."""
    honest = case_run.simulate

    reported = []

    def interrupted(*args: Any, **kwargs: Any) -> Any:
        def stop(now: float) -> None:
            reported.append(now)
            if now >= 5.0:
                raise KeyboardInterrupt

        return honest(*args, **(kwargs | {"progress": stop}))

    monkeypatch.setattr(case_run, "simulate", interrupted)
    code, _, err = offwind("run", str(short_case), "--out", str(tmp_path / "out"))
    assert code == 130
    assert "stopped" in err
    data = xr.load_dataset(tmp_path / "out" / "results.nc")
    assert data.attrs["status"] == "interrupted"
    assert float(data["time"][-1]) == pytest.approx(reported[-1])
    assert 5.0 <= reported[-1] < SHORT_CASE["analysis"]["duration_s"]


def test_public_example(oc6: ow.Turbine) -> None:
    """The calls of the contract, as written there."""
    system = ow.build(oc6, foundation="distributed_springs", sea=None)
    state = ow.static(system)
    modes = ow.modes(system, n=8, about=state)
    result = ow.simulate(system, duration=1.0, dt=0.02, loads=[])
    assert system.pin_model.nv == len(state.q)
    assert len(modes.label) == len(modes.frequency_hz) == len(modes.damping_ratio) == 8
    assert isinstance(result, xr.Dataset)
