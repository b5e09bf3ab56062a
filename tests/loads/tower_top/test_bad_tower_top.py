"""Tower-top loads and rotors that cannot be used: each is told, and nothing is written."""

from __future__ import annotations

from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from helpers.openfast_files import UNITS, YAW_BEARING, some_load, write_out, write_outb

import offwind_pin as ow
from offwind_pin.cases.run import run_case

CASE: dict[str, Any] = {
    "name": "top",
    "turbine": "oc6_phase2",
    "foundation": "clamped",
    "sea": {"kind": "dry"},
    "elements": 6,
    "analysis": {
        "kind": "transient",
        "duration_s": 20.0,
        "ramp_s": 4.0,
        "dt_s": 0.05,
        "output_dt_s": 0.1,
        "psd_segment_s": 10.0,
    },
}
ROTOR = {"kind": "rotor", "wind_speed_m_per_s": 9.0, "turbulence_class": "B"}
OPENFAST = {"kind": "openfast_output", "file": "run.outb"}
APEX = OPENFAST | {"frame": "rotor_apex"}

LOAD_FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {
    "unknown kind": (
        {"kind": "openfast", "file": "run.outb"},
        ["synthetic, file, openfast_output"],
    ),
    "no file": ({"kind": "file"}, ["both given, or neither"]),
    "file and files": (
        OPENFAST | {"files": [{"file": "run.outb"}]},
        ["both given, or neither"],
    ),
    "factor beside files": (
        {"kind": "file", "factor": 2.0, "files": [{"file": "run.outb"}]},
        ["factor in each entry"],
    ),
    "missing file": (OPENFAST | {"file": "none.outb"}, ["none.outb", "no such file"]),
    "not binary": (OPENFAST | {"file": "words.outb"}, ["words.outb", "FileID"]),
    "truncated": (OPENFAST | {"file": "cut.outb"}, ["cut.outb", "truncated"]),
    "unknown channel": (OPENFAST | {"channels": {"Fx": "YawBrFx"}}, ["Is it YawBrFxp"]),
    "unknown component": (OPENFAST | {"channels": {"Fq": "YawBrFxp"}}, ["Fq"]),
    "channel of another kind": (OPENFAST | {"channels": {"Fx": "YawBrMxp"}}, ["kN-m", "force"]),
    "unknown unit": (OPENFAST | {"file": "kip.out"}, ["YawBrFxp", "(kip)", "kN"]),
    "channels of seven columns": (
        {"kind": "file", "file": "wind.txt", "channels": {"Fx": "Fx"}},
        ["seven columns", "channels"],
    ),
    "no load at the apex": (APEX, ["RtAeroFxh"]),
    "apex without azimuth": (
        APEX | {"channels": {"Fy": "YawBrFyp"}},
        ["Fy", "azimuth_channel"],
    ),
    "azimuth at the yaw bearing": (OPENFAST | {"azimuth_channel": "Azimuth"}, ["rotor_apex"]),
    "weight at the apex": (APEX | {"subtract_weight": True}, ["subtract_weight"]),
    "factor of zero": (OPENFAST | {"factor": 0}, ["factor of 0"]),
    "shift beyond the file": (OPENFAST | {"shift_s": 5.0}, ["samples from 0"]),
    "files that do not overlap": (
        {"kind": "file", "files": [{"file": "run.outb"}, {"file": "run.outb", "shift_s": 900}]},
        ["overlap"],
    ),
    "no turbulence": ({"kind": "rotor", "wind_speed_m_per_s": 9.0}, ["turbulence_class"]),
    "turbulence twice": (ROTOR | {"turbulence_intensity": 0.1}, ["turbulence_class"]),
    "turbulence in percent": (
        {"kind": "rotor", "wind_speed_m_per_s": 9.0, "turbulence_intensity": 14},
        ["turbulence_intensity", "14"],
    ),
    "unknown class": (ROTOR | {"turbulence_class": "D"}, ["turbulence_class", "'D'"]),
    "unknown control": (ROTOR | {"control": "fast"}, ["control", "'lagged'"]),
    "no control time": (ROTOR | {"control_time_s": 0}, ["control_time_s"]),
    "wind beyond the table": (ROTOR | {"wind_speed_m_per_s": 30.0}, ["30", "thrust coefficient"]),
    "unknown key of a rotor": (
        ROTOR | {"shear_exponant": 0.1},
        ["Did you mean 'shear_exponent'?"],
    ),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Load files that are sound, cut, and of units that nobody knows."""
    time = np.arange(0, 20.2, 0.1)
    write_outb(tmp_path / "run.outb", 2, time, YAW_BEARING, UNITS, some_load(time))
    (tmp_path / "cut.outb").write_bytes((tmp_path / "run.outb").read_bytes()[:-3])
    (tmp_path / "words.outb").write_text("seven columns, in words")
    write_out(tmp_path / "kip.out", time, YAW_BEARING, ["(kip)", *UNITS[1:]], some_load(time))
    (tmp_path / "wind.txt").write_text("0 8e5 0 0 0 0 0\n30 8e5 0 0 0 0 0\n")
    return tmp_path


def run(folder: Path, **changes: Any) -> dict[str, Any]:
    (folder / "case.yaml").write_text(yaml.safe_dump(CASE | changes))
    return run_case(folder / "case.yaml", folder / "out")


@pytest.mark.parametrize("fault", LOAD_FAULTS)
def test_load_fault(fault: str, folder: Path) -> None:
    """Each fault of a tower-top load is told, and nothing is written."""
    load, told = LOAD_FAULTS[fault]
    with pytest.raises(ow.InputError) as caught:
        run(folder, tower_top_load=load)
    assert all(word in str(caught.value) for word in told), str(caught.value)
    assert not (folder / "out").exists()


SHIPPED = yaml.safe_load(
    (resources.files("offwind_pin.definitions") / "library" / "oc6_phase2.yaml").read_text()
)
RIGID = yaml.safe_load(
    (resources.files("offwind_pin.definitions") / "library" / "oc3_phase2.yaml").read_text()
)

Change = Callable[[dict[str, Any]], None]


def table(key: str, to: Any) -> Change:
    return lambda rotor: rotor["thrust_coefficient"].update({key: to})


ROTOR_FAULTS: dict[str, tuple[dict[str, Any], Change, list[str]]] = {
    "thrust in kN": (SHIPPED, table("value", [155.0] * 20), ["155", "kN"]),
    "unequal lengths": (SHIPPED, table("value", [0.8, 0.7, 0.5]), ["20 entries", "3"]),
    "negative coefficient": (SHIPPED, table("value", [-0.1] * 20), ["value"]),
    "all zero": (SHIPPED, table("value", [0.0] * 20), ["all zero"]),
    "falling wind speeds": (
        SHIPPED,
        table("wind_speed_m_per_s", list(range(25, 5, -1))),
        ["increase strictly"],
    ),
    "rated off the table": (
        SHIPPED,
        lambda rotor: rotor.update(rated_wind_speed_m_per_s=40.0),
        ["rated_wind_speed_m_per_s", "Extend"],
    ),
    "geometry twice": (
        SHIPPED,
        lambda rotor: rotor.update(overhang_m=-5.0),
        ["overhang", "repeats overhang of rna"],
    ),
    "air in g/m3": (
        SHIPPED,
        lambda rotor: rotor.update(air_density_kg_per_m3=1225.0),
        ["air_density_kg_per_m3", "1225"],
    ),
    "speed in rad/s per table": (
        SHIPPED,
        lambda rotor: rotor["rotor_speed_rpm"].update(value=[0.0] * 7),
        ["rotor_speed_rpm"],
    ),
}


@pytest.mark.parametrize("fault", ROTOR_FAULTS)
def test_rotor_fault(fault: str, tmp_path: Path) -> None:
    """Each fault of a turbine's rotor is told with its field."""
    shipped, change, told = ROTOR_FAULTS[fault]
    data = yaml.safe_load(yaml.safe_dump(shipped))
    change(data["rotor"])
    path = tmp_path / "turbine.yaml"
    path.write_text(yaml.safe_dump(data))
    with pytest.raises(ow.InputError) as caught:
        ow.load_turbine(path)
    assert "rotor" in str(caught.value)
    assert all(word in str(caught.value) for word in told), str(caught.value)


def test_rotor_without_its_place(folder: Path) -> None:
    """A rigid body tells nothing of its rotor: what lacks is named where the rotor is needed."""
    data = yaml.safe_load(yaml.safe_dump(RIGID))
    del data["rotor"]["shaft_tilt_deg"], data["rotor"]["blades"]
    (folder / "rigid.yaml").write_text(yaml.safe_dump(data))
    with pytest.raises(ow.InputError, match="no blades, shaft_tilt_deg"):
        run(folder, turbine="rigid.yaml", tower_top_load=ROTOR)


def test_turbine_without_a_rotor(folder: Path) -> None:
    """A rotor load on a turbine that tells nothing of its rotor names the block to add."""
    data = {key: value for key, value in SHIPPED.items() if key != "rotor"}
    (folder / "bare.yaml").write_text(yaml.safe_dump(data))
    with pytest.raises(ow.InputError, match="field rotor"):
        run(folder, turbine="bare.yaml", tower_top_load=ROTOR)


def test_sound_loads_pass(folder: Path) -> None:
    """Negative control: the loads that the faults were made of run."""
    summary = run(folder, tower_top_load=OPENFAST)
    assert summary["status"] == "complete"
