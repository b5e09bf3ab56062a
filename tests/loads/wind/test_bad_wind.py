"""Winds that cannot be used: the error names the field, and the value or the fault."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import offwind_pin as ow

CALM = ow.TowerWind(12.0, 119.0, ow.PowerLaw(0.14), 0.65)

FAULTS: dict[str, tuple[Callable[[], object], list[str]]] = {
    "speed below zero": (lambda: CALM.replace(speed=-1.0), ["speed", "-1.0"]),
    "reference at sea level": (
        lambda: CALM.replace(reference_height=0.0),
        ["reference_height", "0.0"],
    ),
    "drag below zero": (lambda: CALM.replace(drag_coefficient=-0.1), ["drag_coefficient", "-0.1"]),
    "direction that is no number": (
        lambda: CALM.replace(direction_deg=np.nan),
        ["direction_deg", "nan"],
    ),
    "direction by its old name": (
        lambda: ow.TowerWind(12.0, 119.0, ow.PowerLaw(), 0.65, direction=0.5),
        ["direction", "direction_deg"],
    ),
    "air without end": (lambda: CALM.replace(air_density=np.inf), ["air_density", "inf"]),
    "exponent of 14": (lambda: ow.PowerLaw(14.0), ["exponent", "14.0"]),
    "roughness in cm": (lambda: ow.LogLaw(2.0), ["roughness", "2.0"]),
    "gust of nothing": (lambda: ow.ExtremeOperatingGust(0.0, 1.0), ["size", "0.0"]),
    "gust before the start": (lambda: ow.ExtremeOperatingGust(5.0, -1.0), ["start", "-1.0"]),
    "gust above the extreme wind": (
        lambda: ow.ExtremeOperatingGust.of_class(
            60.0, 119.0, 198.0, reference_speed=50.0, turbulence=0.14, start=0.0
        ),
        ["hub_speed", "56"],
    ),
    "times that stop": (lambda: ow.WindSeries([0.0, 0.0], [0.0, 0.0]), ["increase", "Sort"]),
    "unequal series": (lambda: ow.WindSeries(np.arange(2), np.zeros(3)), ["2 times", "3"]),
    "series that is no number": (
        lambda: ow.WindSeries([0.0, 1.0], [0.0, np.nan]),
        ["departure.1", "nan"],
    ),
    "no turbulence": (lambda: ow.RotorWind(9.0), ["turbulence_class", "turbulence_intensity"]),
    "turbulence twice": (
        lambda: ow.RotorWind(9.0, 0.14, turbulence_class="B"),
        ["turbulence_class", "turbulence_intensity"],
    ),
    "turbulence in percent": (lambda: ow.RotorWind(9.0, 14.0), ["turbulence_intensity", "14.0"]),
    "seed below zero": (lambda: ow.RotorWind(9.0, 0.14, seed=-1), ["seed", "-1"]),
    "storm for the synthetic load": (lambda: ow.SyntheticWind(50.0, 0.4), ["wind_speed", "50.0"]),
    "passing frequency of zero": (
        lambda: ow.SyntheticWind(9.0, 0.0),
        ["blade_passing_frequency", "0.0"],
    ),
    "coherent fraction in percent": (
        lambda: ow.SyntheticWind(9.0, 0.4, coherent_fraction=30.0),
        ["coherent_fraction", "30.0"],
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_it_is_refused(fault: str) -> None:
    make, words = FAULTS[fault]
    with pytest.raises(ow.InputError) as error:
        make()
    assert [word for word in words if word not in str(error.value)] == []
