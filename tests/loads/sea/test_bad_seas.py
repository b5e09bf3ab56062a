"""Seas in Python that cannot be used: the error names the field, and the value or the fault."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import offwind_pin as ow

TIME = 0.25 * np.arange(400)
RECORD = ow.SurfaceRecord.of(TIME, np.sin(TIME), "here")
PERIOD = {"seed": 1, "repeat_period": 600.0}
NARROW = ow.WhiteNoise(2.0, 0.1, 0.101)
NOISE = ow.WhiteNoise(2.0, 0.1, 0.3)


def table(*columns: tuple[float, ...]) -> Callable[[], object]:
    return lambda: ow.TableSpectrum(*columns)


def irregular(*values: float, **named: Any) -> Callable[[], object]:
    return lambda: ow.IrregularWaves(*values, **(PERIOD | named))


def measured(**named: Any) -> Callable[[], object]:
    settings = {"record": RECORD, "low_cut": 0.03, "high_cut": 1.0} | named
    return lambda: ow.MeasuredWaves(**settings)


FAULTS: dict[str, tuple[Callable[[], object], list[str]]] = {
    "current below zero": (lambda: ow.UniformCurrent(-1.0), ["speed", "-1.0"]),
    "current too fast": (lambda: ow.UniformCurrent(11.0), ["speed", "11.0"]),
    "current without direction": (
        lambda: ow.UniformCurrent(1.0, float("nan")),
        ["direction_deg", "nan"],
    ),
    "exponent of zero": (lambda: ow.PowerLawCurrent(1.0, exponent=0.0), ["exponent", "0.0"]),
    "reach below zero": (lambda: ow.SurfaceCurrent(1.0, reach=-1.0), ["reach", "-1.0"]),
    "no table of a current": (lambda: ow.CurrentTable(1.0), ["depth", "missing"]),
    "unequal table of a current": (
        lambda: ow.CurrentTable(1.0, depth=(0.0, 1.0), factor=(1.0,)),
        ["2 depths and 1 factors"],
    ),
    "unsorted table of a current": (
        lambda: ow.CurrentTable(1.0, depth=(1.0, 0.0), factor=(1.0, 1.0)),
        ["depths", "Sort"],
    ),
    "factor that is no number": (
        lambda: ow.CurrentTable(1.0, depth=(0.0, 1.0), factor=(1.0, float("nan"))),
        ["factor.1", "nan"],
    ),
    "factors that are speeds": (
        lambda: ow.CurrentTable(2.0, depth=(0.0, 1.0), factor=(1.0, -5.1)),
        ["10.2 m/s"],
    ),
    "sum of nothing": (lambda: ow.CurrentSum(()), ["parts"]),
    "regular wave of no height": (lambda: ow.RegularWaves(-1.0, 9.0), ["height", "-1.0"]),
    "regular wave to nowhere": (
        lambda: ow.RegularWaves(1.0, 9.0, np.inf),
        ["direction_deg", "inf"],
    ),
    "steep wave to nowhere": (lambda: ow.StreamWaves(6.0, 9.0, np.nan), ["direction_deg"]),
    "steep wave at no time": (
        lambda: ow.StreamWaves(6.0, 9.0, crest_time=np.nan),
        ["crest_time", "nan"],
    ),
    "stretched steep wave": (
        lambda: ow.StreamWaves(6.0, 9.0, stretching="wheeler"),
        ["stretching", "wheeler", "none"],
    ),
    "misspelt keyword": (lambda: ow.RegularWaves(1.0, perod=9.0), ["perod", "'period'"]),
    "missing argument": (lambda: ow.RegularWaves(1.0), ["period", "missing"]),
    "unknown order": (irregular(2.0, 8.0, order=3), ["order", "3", "1 or 2"]),
    "carried to second order": (
        irregular(2.0, 8.0, order=2, doppler=True, current=ow.UniformCurrent(1.0)),
        ["doppler", "order"],
    ),
    "carried by nothing": (irregular(2.0, 8.0, doppler=True), ["doppler", "current"]),
    "unknown amplitudes": (irregular(2.0, 8.0, amplitudes="rayleigh"), ["amplitudes", "random"]),
    "no spectrum": (irregular(), ["spectrum", "significant_height"]),
    "no period": (irregular(2.0), ["peak_period"]),
    "spectrum twice": (irregular(2.0, 8.0, spectrum=NOISE), ["spectrum", "significant_height"]),
    "shape beside a spectrum": (irregular(spectrum=NOISE, peak_shape=3.3), ["peak_shape"]),
    "too few components": (irregular(spectrum=NARROW), ["components", "at least 10"]),
    "repeats too soon": (irregular(2.0, 10.0, repeat_period=20.0), ["five peak periods"]),
    "period of zero": (irregular(2.0, 0.0), ["peak_period", "0.0"]),
    "shape of nine": (irregular(2.0, 8.0, peak_shape=9.0), ["peak_shape", "9.0"]),
    "shape of half": (irregular(2.0, 8.0, peak_shape=0.5), ["peak_shape", "0.5"]),
    "shape of another name": (irregular(2.0, 8.0, peak_shape="pm"), ["peak_shape", "pm", "iec"]),
    "direction that is no number": (
        irregular(2.0, 8.0, direction_deg=np.nan),
        ["direction_deg", "nan"],
    ),
    "seed below zero": (irregular(2.0, 8.0, seed=-1), ["seed", "-1"]),
    "seed that is not whole": (irregular(2.0, 8.0, seed=1.5), ["seed", "1.5"]),
    "crest after the waves repeat": (
        irregular(2.0, 8.0, crest=ow.Crest(2.0, 700.0)),
        ["crest", "700"],
    ),
    "no waves without a repeat period": (
        lambda: ow.IrregularWaves(2.0, 8.0).waves(20.0, 9.81),
        ["repeat_period"],
    ),
    "exponent of a spreading": (lambda: ow.Spreading("cos_2s", 0.0), ["exponent", "0.0"]),
    "kind of a spreading": (lambda: ow.Spreading("cos2s", 4.0), ["kind", "cos2s", "cos_2s"]),
    "crest below the water": (lambda: ow.Crest(-1.0, 0.0), ["height", "-1.0"]),
    "crest at no time": (lambda: ow.Crest(1.0, np.nan), ["time", "nan"]),
    "two frequencies": (table((0.1, 0.2), (1.0, 1.0)), ["2 frequencies", "three"]),
    "unequal columns": (table((0.1, 0.2, 0.3), (1.0, 1.0)), ["3 frequencies and 2 densities"]),
    "unsorted spectrum": (table((0.1, 0.3, 0.2), (1.0,) * 3), ["0.2 Hz", "Sort"]),
    "frequency of zero": (table((0.0, 0.1, 0.2), (1.0,) * 3), ["0 Hz"]),
    "density below zero": (table((0.1, 0.2, 0.3), (1.0, -1.0, 1.0)), ["0.2 Hz", "-1.0"]),
    "density that is no number": (
        table((0.1, 0.2, 0.3), (1.0, np.nan, 1.0)),
        ["ordinate.1", "nan"],
    ),
    "spectrum of nothing": (table((0.1, 0.2, 0.3), (0.0,) * 3), ["zero", "still water"]),
    "gap in a spectrum": (table((0.1, 0.11, 0.12, 0.3), (1.0,) * 4), ["missing rows"]),
    "noise upside down": (lambda: ow.WhiteNoise(2.0, 0.5, 0.1), ["0.5 to 0.1 Hz"]),
    "noise from zero": (lambda: ow.WhiteNoise(2.0, 0.0, 0.1), ["lowest", "0.0"]),
    "noise without end": (lambda: ow.WhiteNoise(2.0, 0.1, np.inf), ["highest", "inf"]),
    "cut above the sampling": (measured(high_cut=2.0), ["high_cut", "half the record's"]),
    "cuts upside down": (measured(low_cut=0.5, high_cut=0.4), ["low_cut and high_cut"]),
    "no low cut": (measured(low_cut=0.0), ["low_cut", "0.0"]),
    "taper longer than the record": (measured(taper=400.0), ["taper", "400.0"]),
    "record to nowhere": (measured(direction_deg=np.nan), ["direction_deg"]),
    "record carried by nothing": (measured(doppler=True), ["doppler", "current"]),
    "record of second order": (measured(order=2), ["order", "2"]),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_it_is_refused(fault: str) -> None:
    make, words = FAULTS[fault]
    with pytest.raises(ow.InputError) as error:
        make()
    assert [word for word in words if word not in str(error.value)] == []


def test_as_functions_do() -> None:
    """Arguments that no function would take are a TypeError."""
    with pytest.raises(TypeError, match="3 positional"):
        ow.RegularWaves(1.0, 9.0, 0.0, 4.0)
    with pytest.raises(TypeError, match="'height'"):
        ow.RegularWaves(1.0, 9.0, height=2.0)


def test_a_file_is_checked_when_it_is_read(tmp_path: Path) -> None:
    """A spectrum or a record out of a file that does not fit is refused with the file's name."""
    short = tmp_path / "short.csv"
    short.write_text("frequency_hz,density_m2_per_hz\n0.1,1\n0.2,1\n")
    with pytest.raises(ow.InputError, match=r"short\.csv.*three"):
        ow.IrregularWaves(spectrum=ow.TableSpectrum(file=short), **PERIOD).waves(20.0, 9.81)
    slow = tmp_path / "slow.csv"
    slow.write_text("\n".join(f"{t},{np.sin(t)}" for t in TIME))
    with pytest.raises(ow.InputError, match=r"slow\.csv.*high_cut.*half the record"):
        ow.MeasuredWaves(slow, 0.03, 2.5).waves(20.0, 9.81)
