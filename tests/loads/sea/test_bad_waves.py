"""Seas in a case file that cannot be used: each is told, with its place, and nothing is written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import offwind_pin as ow
from offwind_pin.cases.case import load_case
from offwind_pin.cases.run import run_case

CASE: dict[str, Any] = {
    "name": "bad",
    "turbine": "oc6_phase2",
    "foundation": "clamped",
    "elements": 6,
    "analysis": {
        "kind": "transient",
        "duration_s": 30.0,
        "ramp_s": 4.0,
        "dt_s": 0.1,
        "output_dt_s": 0.2,
        "psd_segment_s": 10.0,
    },
}
WAVES = {"kind": "irregular_waves", "significant_height_m": 2.0, "peak_period_s": 8.0}
BARE = {"kind": "irregular_waves"}
BUOY = {"kind": "measured_waves", "file": "buoy.csv", "low_cut_hz": 0.05, "high_cut_hz": 0.4}
REGULAR = {"kind": "regular_waves", "height_m": 2.0, "period_s": 8.0}
AGAINST = {"kind": "uniform", "speed_m_per_s": 4.0, "direction_deg": 180.0}


def table(frequency: list[Any], density: list[Any]) -> dict[str, Any]:
    spectrum = {"kind": "table", "frequency_hz": frequency, "density_m2_per_hz": density}
    return BARE | {"spectrum": spectrum}


def spectrum(**keys: Any) -> dict[str, Any]:
    return BARE | {"spectrum": keys}


FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {
    "height in cm": (WAVES | {"significant_height_m": 200}, ["significant_height_m", "200"]),
    "height below zero": (WAVES | {"significant_height_m": -2}, ["significant_height_m"]),
    "height as text": (WAVES | {"significant_height_m": "high"}, ["significant_height_m", "high"]),
    "period in minutes": (WAVES | {"peak_period_s": 0.13}, ["peak_period_s", "0.13"]),
    "no period": (BARE | {"significant_height_m": 2.0}, ["peak_period_s"]),
    "no state": (BARE, ["peak_period_s", "or a spectrum"]),
    "state twice": (
        WAVES | {"spectrum": {"kind": "white_noise", "significant_height_m": 2.0}},
        ["spectrum"],
    ),
    "height beside a spectrum": (
        spectrum(kind="tma", significant_height_m=2.0, peak_period_s=8.0) | {"peak_shape": 3.3},
        ["inside spectrum"],
    ),
    "unknown spectrum": (spectrum(kind="ochi_hubble"), ["jonswap", "tma", "white_noise", "table"]),
    "misspelt key": (
        spectrum(kind="tma", significant_height_m=2.0, peak_periode_s=8.0),
        ["peak_periode_s", "peak_period_s"],
    ),
    "peak shape of ten": (WAVES | {"peak_shape": 10.0}, ["peak_shape", "10.0"]),
    "peak shape of a name in capitals": (
        WAVES | {"peak_shape": "IEC"},
        ["peak_shape", "IEC", "'iec'"],
    ),
    "noise upside down": (
        spectrum(kind="white_noise", significant_height_m=2.0, lowest_hz=0.5, highest_hz=0.1),
        ["0.5 to 0.1 Hz"],
    ),
    "noise without width": (
        spectrum(kind="white_noise", significant_height_m=2.0, lowest_hz=0.1, highest_hz=0.104),
        ["3 components", "at least 10 are required"],
    ),
    "density below zero": (table([0.1, 0.2, 0.3], [1, -1, 1]), ["density at 0.2 Hz", "-1.0"]),
    "unsorted table": (table([0.1, 0.3, 0.2], [1, 1, 1]), ["Sort the table"]),
    "gap in the table": (table([0.1, 0.11, 0.12, 0.3], [1, 1, 1, 1]), ["missing rows"]),
    "word in the table": (table([0.1, 0.2, 0.3], [1, "x", 1]), ["density_m2_per_hz", "x"]),
    "not a number in the table": (
        table([0.1, 0.2, 0.3], [1, float("nan"), 1]),
        ["density_m2_per_hz"],
    ),
    "unequal columns": (table([0.1, 0.2, 0.3], [1, 1]), ["3 frequencies and 2 densities"]),
    "empty table": (spectrum(kind="table"), ["both given, or neither", "frequency_hz"]),
    "table file that is not there": (spectrum(kind="table", file="none.csv"), ["none.csv"]),
    "table file with another header": (spectrum(kind="table", file="buoy.csv"), ["frequency_hz"]),
    "unknown amplitudes": (WAVES | {"amplitudes": "rayleigh"}, ["amplitudes", "random"]),
    "unknown spreading": (
        WAVES | {"spreading": {"kind": "cos2", "exponent": 4}},
        ["spreading.kind", "cos_2s"],
    ),
    "exponent of zero": (
        WAVES | {"spreading": {"kind": "cos_2s", "exponent": 0}},
        ["spreading.exponent"],
    ),
    "doppler without current": (WAVES | {"doppler": True}, ["doppler", "current"]),
    "waves that are blocked": (
        WAVES | {"doppler": True, "current": AGAINST},
        ["blocks", "Check the current"],
    ),
    "a regular wave that is blocked": (
        REGULAR | {"period_s": 4.0, "doppler": True, "current": AGAINST},
        ["blocks 100 %"],
    ),
    "crest too high": (WAVES | {"crest": {"height_m": 4.5, "time_s": 20}}, ["twice the"]),
    "crest in the ramp": (WAVES | {"crest": {"height_m": 2, "time_s": 2}}, ["after the ramp"]),
    "crest after the end": (WAVES | {"crest": {"height_m": 2, "time_s": 31}}, ["before the end"]),
    "crest without a time": (WAVES | {"crest": {"height_m": 2}}, ["time_s", "required"]),
    "waves that repeat": (WAVES | {"peak_period_s": 5, "repeat_period_s": 25}, ["would repeat"]),
    "too few waves before they repeat": (WAVES | {"repeat_period_s": 30}, ["five peak periods"]),
    "too few steps": (WAVES | {"peak_period_s": 1.5}, ["dt", "15 steps", "Shorten"]),
    "regular waves in too few steps": (REGULAR | {"period_s": 1.9}, ["19 steps", "0.095"]),
    "record that is not there": (BUOY | {"file": "none.csv"}, ["none.csv", "no such file"]),
    "record too short": (BUOY | {"file": "short.csv"}, ["short.csv", "would repeat"]),
    "record with a gap": (BUOY | {"file": "gap.csv"}, ["gap.csv", "a step of"]),
    "record with a word": (BUOY | {"file": "word.csv"}, ["word.csv", "line 50", "'----'"]),
    "record in cm": (BUOY | {"file": "cm.csv"}, ["cm.csv", "Is the unit m?"]),
    "cut beyond the sampling": (BUOY | {"high_cut_hz": 1.5}, ["high_cut", "half the record's"]),
    "cuts upside down": (BUOY | {"low_cut_hz": 0.45}, ["low_cut and high_cut"]),
    "record without cuts": ({"kind": "measured_waves", "file": "buoy.csv"}, ["low_cut_hz"]),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With records, sound and unsound."""
    place = tmp_path_factory.mktemp("seas")
    time = np.arange(0, 60, 0.5)
    rows = [f"{t},{np.sin(2 * np.pi * t / 7):.4f}" for t in time]
    (place / "buoy.csv").write_text("\n".join(["time_s,elevation_m", *rows]))
    (place / "gap.csv").write_text("\n".join(rows[:60] + rows[75:]))
    (place / "word.csv").write_text("\n".join([*rows[:49], "24.5,----", *rows[50:]]))
    (place / "cm.csv").write_text("\n".join(f"{t},{90 * np.sin(t)}" for t in time))
    (place / "short.csv").write_text("\n".join(f"{t / 3},{np.sin(t)}" for t in time))
    return place


def run(sea: dict[str, Any], folder: Path, out: Path) -> dict[str, Any]:
    path = folder / f"{out.parent.name}.yaml"
    path.write_text(yaml.safe_dump(CASE | {"sea": sea}))
    return run_case(load_case(path), out)


@pytest.mark.parametrize("fault", FAULTS)
def test_it_is_refused(fault: str, folder: Path, tmp_path: Path) -> None:
    sea, words = FAULTS[fault]
    with pytest.raises(ow.InputError) as error:
        run(sea, folder, tmp_path / "out")
    message = str(error.value)
    assert [word for word in words if word not in message] == []
    assert not (tmp_path / "out").exists()


SOUND: list[dict[str, Any]] = [
    WAVES | {"crest": {"height_m": 2, "time_s": 20}, "repeat_period_s": 40},
    WAVES | {"peak_shape": "iec", "amplitudes": "random", "stretching": "wheeler"},
    WAVES | {"spreading": {"kind": "cos_n", "exponent": 4}, "direction_deg": 20},
    WAVES | {"doppler": True, "current": AGAINST | {"speed_m_per_s": 0.5}},
    REGULAR | {"doppler": True, "current": AGAINST | {"speed_m_per_s": 0.5}},
    table([0.1, 0.15, 0.2, 0.3], [1, 2, 1, 0]),
    spectrum(kind="table", file="spectrum.csv"),
    spectrum(kind="tma", significant_height_m=2.0, peak_period_s=8.0, peak_shape="iec"),
    spectrum(kind="jonswap", significant_height_m=2.0, peak_period_s=8.0),
    spectrum(kind="white_noise", significant_height_m=2.0, lowest_hz=0.1, highest_hz=0.5),
    BUOY | {"taper_s": 3.0, "direction_deg": 90.0},
]


@pytest.mark.parametrize("sea", SOUND, ids=str)
def test_what_is_right_is_read(sea: dict[str, Any], folder: Path, tmp_path: Path) -> None:
    """Negative control: the same keys with sound values make waves."""
    (folder / "spectrum.csv").write_text(
        "frequency_hz,density_m2_per_hz\n0.1,1\n0.15,2\n0.2,1\n0.3,0\n"
    )
    path = folder / f"{tmp_path.name}.yaml"
    path.write_text(yaml.safe_dump(CASE | {"sea": sea}))
    made = load_case(path).water
    assert made is not None
    waves = made.waves(20.0, 9.80665)
    assert waves is not None
    assert np.sum(np.abs(waves.elevation) ** 2) > 0.01
    marked = made.marked_frequency
    assert marked is None or 0.1 < marked < 0.2
