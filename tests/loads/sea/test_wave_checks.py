"""Warnings about waves, and checks before a simulation: breaking, steepness, repeats, steps."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import offwind_pin as ow
from offwind_pin.analysis.wave_checks import check_waves, wave_facts
from offwind_pin.cases.case import Case
from offwind_pin.cases.run import run_case
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.warnings import (
    breaking_height,
    second_harmonic_share,
    steepest_sea,
)

GRAVITY = 9.80665
CASE: dict[str, Any] = {
    "name": "waves",
    "turbine": "oc6_phase2",
    "foundation": "clamped",
    "sea": {"kind": "irregular_waves", "significant_height_m": 1.25, "peak_period_s": 5.5},
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


def cautions_of(sea: Sea, depth: float) -> str:
    waves = sea.waves(depth, GRAVITY)
    assert waves is not None
    return " | ".join(sea.cautions(waves))


def irregular(height: float, period: float, **more: Any) -> ow.IrregularWaves:
    return ow.IrregularWaves(height, period, seed=1, repeat_period=600.0, **more)


# Cautions


def test_breaking_heights() -> None:
    """0.142 of the length in deep water, 0.78 of the depth in shallow; above Fenton's highest wave."""
    assert breaking_height(0.1, 500.0) == pytest.approx(0.142 * 2 * np.pi / 0.1)
    assert breaking_height(1e-3, 10.0) == pytest.approx(7.8)
    k = float(wave_number(np.array([2 * np.pi / 9]), 20.0, GRAVITY)[0])
    assert 0.8 < breaking_height(k, 20.0) / (0.142 * 2 * np.pi / k) < 1


def test_second_harmonic_of_a_steep_wave() -> None:
    """Stokes's share is that of the full nonlinear solution for a low wave: error of second order."""
    height, period, depth = 0.8, 8.0, 15.0
    field = ow.StreamWaves(height, period).waves(depth, GRAVITY)
    exact = abs(field.elevation[list(field.harmonic).index(2)]) / abs(
        field.elevation[list(field.harmonic).index(1)]
    )
    k = float(wave_number(np.array([2 * np.pi / period]), depth, GRAVITY)[0])
    assert second_harmonic_share(height / 2, k, depth) == pytest.approx(exact, rel=0.02)
    assert second_harmonic_share(1.0, 0.2, 1e4) == pytest.approx(0.1)


def test_regular_waves_that_break_are_reported() -> None:
    """At Miche's height in deep water and at 0.78 of the depth in shallow; not below."""
    k = float(wave_number(np.array([2 * np.pi / 6]), 30.0, GRAVITY)[0])
    limit = breaking_height(k, 30.0)
    assert "breaks in 30 m" in cautions_of(ow.RegularWaves(1.01 * limit, 6.0), 30.0)
    assert "breaks" not in cautions_of(ow.RegularWaves(0.99 * limit, 6.0), 30.0)
    assert "breaks" in cautions_of(ow.RegularWaves(8.0, 14.0), 10.0)


def test_linear_theory_beyond_its_range_is_reported() -> None:
    """A wave whose second harmonic is large; not a low one."""
    assert "stream function waves" in cautions_of(ow.RegularWaves(5.0, 12.0), 12.0)
    assert cautions_of(ow.RegularWaves(0.5, 6.0), 30.0) == ""
    assert "second harmonic" in cautions_of(irregular(4.0, 12.0), 12.0)


def test_steep_and_shallow_seas_are_reported() -> None:
    """By DNV's steepness, by Tp / sqrt(Hs), by the depth; the sea of LC 5.1 passes in silence."""
    assert steepest_sea(5.0) == pytest.approx(1 / 15)
    assert steepest_sea(20.0) == pytest.approx(1 / 25)
    assert steepest_sea(11.5) == pytest.approx((1 / 15 + 1 / 25) / 2)
    assert "steepness of 1/" in cautions_of(irregular(6.0, 7.0), 60.0)
    assert "Tp / sqrt(Hs) is 3.4" in cautions_of(irregular(2.0, 4.81), 60.0)
    assert "exceeds the breaking limit" in cautions_of(irregular(6.0, 12.0), 12.0)
    assert cautions_of(irregular(1.25, 5.5), 14.0) == ""


def test_a_crest_beyond_breaking_is_reported() -> None:
    """A crest of 6 m in 14 m of water belongs to a wave that breaks; one of 2 m does not."""
    assert "a crest of 6 m" in cautions_of(irregular(4.0, 9.0, crest=ow.Crest(6.0, 50.0)), 14.0)
    assert "a crest of" not in cautions_of(irregular(4.0, 9.0, crest=ow.Crest(2.0, 50.0)), 14.0)


# Refusals


def small(sea: Sea, oc6: ow.Turbine) -> ow.System:
    return ow.build(oc6.model_copy(update={"structural_damping": None}), "clamped", sea, elements=6)


@pytest.mark.parametrize(
    ("sea", "settings", "words"),
    [
        (irregular(2.0, 8.0), (601.0, 10.0, 0.05), "would repeat"),
        (irregular(2.0, 8.0), (60.0, 10.0, 0.5), "16 steps in the waves' period of 8 s"),
        (ow.RegularWaves(2.0, 4.0), (60.0, 10.0, 0.21), "20 steps or more"),
        (ow.StreamWaves(2.0, 5.0), (60.0, 10.0, 0.3), "20 steps or more"),
        (
            ow.IrregularWaves(spectrum=ow.WhiteNoise(1.0, 0.05, 5.0), seed=1, repeat_period=600.0),
            (60.0, 10.0, 0.11),
            "two steps or more",
        ),
        (irregular(2.0, 8.0, crest=ow.Crest(2.0, 5.0)), (60.0, 10.0, 0.05), "after the ramp"),
        (irregular(2.0, 8.0, crest=ow.Crest(2.0, 70.0)), (60.0, 10.0, 0.05), "before the end"),
    ],
)
def test_it_is_refused(
    sea: Sea, settings: tuple[float, float, float], words: str, oc6: ow.Turbine
) -> None:
    with pytest.raises(ow.InputError, match=words):
        check_waves(small(sea, oc6), *settings)
    # negative control: the same sea within its limits
    crest = getattr(sea, "crest", None)
    length = 80.0 if crest is not None else 60.0
    check_waves(small(sea, oc6), length, 4.0, 0.02)


@pytest.mark.parametrize("stretching", ["none", "wheeler"])
def test_waves_that_bare_the_bed_are_refused(stretching: Any, oc6: ow.Turbine) -> None:
    """Whatever the theory says of them: Hs of hundreds of metres is a mistaken unit."""

    def table(density: float) -> ow.IrregularWaves:
        spectrum = ow.TableSpectrum((0.05, 0.1, 0.15, 0.2), (0.0, density, density, 0.0))
        return ow.IrregularWaves(
            spectrum=spectrum, seed=1, repeat_period=600.0, stretching=stretching
        )

    check_waves(small(table(10.0), oc6), 60.0, 4.0, 0.05)  # negative control: 4 m
    with pytest.raises(ow.InputError, match=r"a trough of -.* m in 30 m of water"):
        check_waves(small(table(1e5), oc6), 60.0, 4.0, 0.05)


def test_simulate_refuses_waves_that_repeat(oc6: ow.Turbine) -> None:
    """Before the first step, with the remedy; a record counts by its length."""
    with pytest.raises(ow.InputError, match="raise repeat_period"):
        ow.simulate(small(irregular(2.0, 8.0), oc6), 600.5, 0.5)
    time = np.arange(0, 100, 0.5)
    record = ow.SurfaceRecord.of(time, np.sin(2 * np.pi * time / 10), "here")
    sea = ow.MeasuredWaves(record, 0.05, 0.3)
    with pytest.raises(ow.InputError, match=r"got 100 s of .* allowed: at least .*101 s"):
        ow.simulate(small(sea, oc6), 101.0, 0.5)


def test_still_and_dry_structures_pass(oc6: ow.Turbine, clamped_dry: ow.System) -> None:
    """Nothing to check, nothing to tell."""
    still = small(ow.StillWater(), oc6)
    for system in (still, clamped_dry):
        check_waves(system, 1e6, 0.0, 10.0)
        assert wave_facts(system) == {}


# What is written


def test_facts_of_a_case(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Summary, attributes and report hold the realised waves, the log and they the cautions."""
    sea = {
        "kind": "irregular_waves",
        "spectrum": {
            "kind": "tma",
            "significant_height_m": 4.0,
            "peak_period_s": 7.0,
            "peak_shape": 3.3,
        },
        "amplitudes": "random",
        "spreading": {"kind": "cos_2s", "exponent": 12.0},
        "doppler": True,
        "current": {"kind": "uniform", "speed_m_per_s": 0.8, "direction_deg": 180.0},
        "crest": {"height_m": 3.5, "time_s": 12.0},
    }
    case = Case.model_validate(CASE | {"sea": sea, "seed": 11})
    with caplog.at_level(logging.WARNING, logger="offwind_pin"):
        summary = run_case(case, tmp_path / "out")
    waves = summary["waves"]
    assert waves["repeat_period_s"] == 600.0
    assert waves["significant_height_m"] == pytest.approx(4.0, rel=0.15)
    assert waves["significant_height_m"] == pytest.approx(4 * np.sqrt(waves["m0_m2"]))
    assert waves["zero_crossing_period_s"] ** 2 == pytest.approx(
        waves["m0_m2"] / waves["m2_m2_hz2"]
    )
    assert waves["highest_crest_m"] >= 3.5 * (1 - 1e-4)
    assert waves["lowest_trough_m"] < -1.5
    assert any("blocks" in text for text in waves["cautions"])
    assert "blocks" in caplog.text
    assert caplog.text.count("Tp / sqrt(Hs)") == 1
    with xr.open_dataset(tmp_path / "out" / "results.nc") as data:
        assert data.attrs["wave_seed"] == 11
        assert data.attrs["wave_significant_height_m"] == waves["significant_height_m"]
        assert data.attrs["wave_highest_crest_m"] == waves["highest_crest_m"]
        assert "blocks" in data.attrs["wave_notes"]
        elevation = data["wave_elevation"]
        assert elevation.attrs["long_name"].endswith("mean water level")
        assert float(elevation.sel(time=12.0, method="nearest")) == pytest.approx(3.5, abs=1e-3)
        assert float(elevation.max()) <= waves["highest_crest_m"] * (1 + 1e-3)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "waves as realised" in page
    assert f"Hs {waves['significant_height_m']:.3g}" in page


def test_facts_of_a_replayed_record(tmp_path: Path) -> None:
    """The history holds the record's samples, and notes tell what was done to it."""
    time = np.arange(0.0, 40.0, 0.25)
    wanted = 0.8 * np.cos(2 * np.pi * time / 8) + 0.3 * np.cos(2 * np.pi * time / 5 + 1)
    rows = "\n".join(f"{t},{eta}" for t, eta in zip(time, wanted, strict=True))
    (tmp_path / "buoy.csv").write_text("time_s,elevation_m\n" + rows)
    sea = {
        "kind": "measured_waves",
        "file": "buoy.csv",
        "low_cut_hz": 0.04,
        "high_cut_hz": 0.6,
        "taper_s": 0.0,
        "direction_deg": 30.0,
    }
    case = Case.model_validate(CASE | {"sea": sea}, context={"folder": tmp_path})
    summary = run_case(case, tmp_path / "out", report=False)
    assert any("trend" in note for note in summary["waves"]["notes"])
    assert summary["waves"]["repeat_period_s"] == 40.0
    with xr.open_dataset(tmp_path / "out" / "results.nc") as data:
        assert "buoy.csv" in data.attrs["sea"]
        assert data.attrs["wave_seed"] == -1
        found = data["wave_elevation"].sel(time=slice(5, 20))
        trend = np.polynomial.Polynomial.fit(time, wanted, 1)
        exact = np.interp(found["time"], time, wanted - trend(time))
        at_samples = np.isclose(found["time"].to_numpy() % 0.5, 0)
        assert np.count_nonzero(at_samples) > 25
        assert np.max(np.abs(found - exact)[at_samples]) < 0.06


def test_regular_waves_have_no_significant_height(oc6: ow.Turbine) -> None:
    """Their crest, trough and period are reported; Hs and Tp belong to seas."""
    facts = wave_facts(small(ow.RegularWaves(2.0, 8.0), oc6))
    assert facts["highest_crest_m"] == pytest.approx(1.0, rel=1e-4)
    assert facts["lowest_trough_m"] == pytest.approx(-1.0, rel=1e-4)
    assert facts["zero_crossing_period_s"] == pytest.approx(8.0)
    assert "significant_height_m" not in facts
