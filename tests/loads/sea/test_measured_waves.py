"""Replay of a measured surface: the record comes back, and what is done to it is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.kinematics import WaterSurface
from offwind_pin.loads.sea.waves.surface_record import read_surface_record

GRAVITY = 9.80665
DEPTH = 30.0
STEP = 0.25
COUNT = 2400
TIME = STEP * np.arange(COUNT)


def surface(duration: float = COUNT * STEP) -> Array:
    """A sea of 2 m and 7 s at TIME, periodic in a duration in s."""
    sea = ow.IrregularWaves(2.0, 7.0, seed=9, repeat_period=duration, amplitudes="random")
    return WaterSurface(sea.waves(DEPTH, GRAVITY), 0.0, "none").elevation(TIME)


def replayed(elevation: Array, low: float = 0.03, high: float = 1.0, **more: Any) -> Array:
    sea = ow.MeasuredWaves(ow.SurfaceRecord.of(TIME, elevation, "here"), low, high, **more)
    return WaterSurface(sea.waves(DEPTH, GRAVITY), 0.0, "none").elevation(TIME)


def write(path: Path, time: Array, elevation: Array, header: str = "", between: str = ",") -> Path:
    rows = [f"{t:.6f}{between}{eta:.9f}" for t, eta in zip(time, elevation, strict=True)]
    path.write_text("\n".join([header, *rows] if header else rows) + "\n")
    return path


def filtered(elevation: Array, low: float, high: float, fade: float) -> Array:
    """The same by another route: a straight line off, cosine ends, and a mask on a whole FFT."""
    level = elevation - np.polynomial.Polynomial.fit(TIME, elevation, 1)(TIME)
    if fade > 0:
        # the fade ends on the record's last sample, one step before it repeats
        length = fade * (COUNT - 1) / COUNT
        edge = np.minimum(np.minimum(TIME, TIME[-1] - TIME) / length, 1.0)
        level = level * np.sin(np.pi / 2 * edge) ** 2
    line = np.fft.fft(level)
    frequency = np.abs(np.fft.fftfreq(COUNT, STEP))
    line[(frequency < low) | (frequency > high)] = 0
    return np.fft.ifft(line).real


@pytest.mark.parametrize(
    ("low", "high", "fade"), [(0.0301, 1.001, 0.0), (0.0601, 0.3001, 6.0), (0.001, 1.999, 20.0)]
)
def test_the_filtered_record_comes_back(low: float, high: float, fade: float) -> None:
    """At every sample, to rounding, from a record that is not periodic, with mean and trend."""
    given = surface(777.7) + 0.4 + 1e-3 * TIME
    wanted = filtered(given, low, high, fade)
    assert_allclose(replayed(given, low, high, taper=fade), wanted, atol=1e-10)
    assert np.max(np.abs(wanted)) > 0.9


def test_a_sea_comes_back() -> None:
    """Between its ends a record of a sea is what is replayed, but for the fitted trend."""
    wanted = surface()
    trend = np.polynomial.Polynomial.fit(TIME, wanted, 1)(TIME)
    assert np.ptp(trend) < 0.1
    inside = (TIME > 30) & (TIME < 570)
    assert_allclose(replayed(wanted)[inside], (wanted - trend)[inside], atol=0.01)
    # negative control: cuts that leave something out are seen
    assert np.max(np.abs(replayed(wanted, 0.1, 0.2) - wanted)[inside]) > 0.2


def test_cuts_take_away_what_they_say() -> None:
    """A swell below the low cut and a ripple above the high one leave no trace."""
    swell = 0.5 * np.cos(2 * np.pi * 12 / (COUNT * STEP) * TIME)
    ripple = 0.2 * np.cos(2 * np.pi * 900 / (COUNT * STEP) * TIME)
    wanted = surface()
    assert_allclose(replayed(wanted + swell + ripple, taper=0.0), wanted, atol=1e-4)
    sea = ow.MeasuredWaves(
        ow.SurfaceRecord.of(TIME, wanted + swell + ripple, "here"), 0.03, 1.0, taper=0.0
    )
    told = sea.cautions(sea.waves(DEPTH, GRAVITY))
    share = (0.5**2 + 0.2**2) / 2 / np.var(wanted + swell + ripple)
    assert any(f"remove {100 * share:.2g} %" in text for text in told)


def test_mean_and_trend_are_told() -> None:
    """Both are taken off, and named in metres."""
    record = ow.SurfaceRecord.of(TIME + 5.0, surface() + 0.7 + 1e-3 * TIME, "here")
    notes = " ".join(ow.MeasuredWaves(record, 0.03, 1.0).notes())
    assert "mean of 1 m" in notes
    assert "trend of 0.6" in notes
    assert "first time, 5 s, is time 0" in notes
    assert "tapered over 6 s" in notes


@pytest.mark.parametrize("between", [",", " ", "\t", " ; "])
@pytest.mark.parametrize("header", ["", "time_s,elevation_m", "# time elevation"])
def test_files(tmp_path: Path, between: str, header: str) -> None:
    """CSV or columns, with names or without, are the same record."""
    wanted = surface()
    path = write(tmp_path / "buoy.csv", TIME, wanted, header, between)
    record = read_surface_record(path)
    assert record.dt == pytest.approx(STEP, rel=1e-9)
    assert record.duration == pytest.approx(600.0)
    assert_allclose(record.elevation, wanted, atol=1e-9)
    assert "buoy.csv (SHA-256" in record.origin
    assert not record.resampled


def test_uneven_times_are_interpolated_and_told(tmp_path: Path) -> None:
    """Jittered times are put on even ones; times rounded in the file are taken as even."""
    jitter = TIME + 0.05 * np.sin(np.arange(COUNT))
    exact = np.interp(jitter, TIME, surface())
    record = ow.SurfaceRecord.of(jitter, exact, "here")
    assert record.resampled
    assert_allclose(record.elevation[1:-1], surface()[1 : len(record.elevation) - 1], atol=0.05)
    sea = ow.MeasuredWaves(record, 0.03, 1.0)
    assert any("not evenly sampled" in text for text in sea.cautions(sea.waves(DEPTH, GRAVITY)))
    rounded = ow.SurfaceRecord.of(np.round(TIME * 1.28, 2) + 0, surface(), "here")
    assert not rounded.resampled


def test_direction_and_current_reach_the_waves() -> None:
    """The record's waves go where they are told to, on the current if asked."""
    record = ow.SurfaceRecord.of(TIME, surface(), "here")
    flow = {"doppler": True, "current": ow.UniformCurrent(1.0, 90.0)}
    waves = ow.MeasuredWaves(record, 0.03, 0.5, 90.0, **flow).waves(DEPTH, GRAVITY)  # type: ignore[arg-type]
    still = ow.MeasuredWaves(record, 0.03, 0.5, 90.0).waves(DEPTH, GRAVITY)
    velocity = np.abs(still.velocity(np.array([-3.0])))
    assert velocity[0].max() < 1e-12
    assert velocity[1].max() > 0.01
    assert np.all(waves.wave_number < still.wave_number)


FILE_FAULTS: dict[str, tuple[str, str]] = {
    "empty": ("", "0 rows"),
    "short": ("0,1\n0.5,2\n", "2 rows"),
    "word": ("\n".join(f"{i},0.1" for i in range(70)) + "\n70,calm\n", "line 71, column 2"),
    "not a number": ("\n".join(f"{i},0.1" for i in range(70)) + "\n70,nan\n", "finite number"),
    "three columns": ("\n".join(f"{i},0.1,3" for i in range(70)), "3 cells"),
    "missing cell": ("\n".join(f"{i},0.1" for i in range(70)) + "\n70\n", "1 cells"),
    "gap": (
        "\n".join(f"{i},{i % 3}" for i in [*range(60), *range(200, 260)]),
        "lines 60 to 61",
    ),
    "back in time": ("\n".join(f"{i % 65},{i % 3}" for i in range(80)), "Sort the rows"),
    "missing-value mark": (
        "\n".join(f"{i},{999.99 if i == 9 else i % 3}" for i in range(80)),
        "missing values",
    ),
    "in centimetres": ("\n".join(f"{i},{100 * (i % 3)}" for i in range(80)), "Is the unit m?"),
    "still": ("\n".join(f"{i},0.3" for i in range(80)), "varies"),
}


@pytest.mark.parametrize("fault", FILE_FAULTS)
def test_files_that_cannot_be(fault: str, tmp_path: Path) -> None:
    text, words = FILE_FAULTS[fault]
    path = tmp_path / "buoy.csv"
    path.write_text(text)
    with pytest.raises(ow.InputError, match=r"buoy\.csv") as error:
        read_surface_record(path)
    assert words in str(error.value)
