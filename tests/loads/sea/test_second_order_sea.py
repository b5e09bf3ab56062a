"""Seas of second order, as they are asked for: in Python and in case files, and what is told of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

import offwind_pin as ow
from offwind_pin.analysis.wave_checks import wave_facts
from offwind_pin.loads.sea.kinematics import WaterSeries, WaterSurface
from offwind_pin.loads.sea.seas import SeaChoice
from offwind_pin.loads.sea.waves.second_order import SecondOrderWaves
from offwind_pin.loads.sea.waves.surface import SurfaceWaves

DEPTH, GRAVITY = 30.0, 9.80665


def sea(order: Any = 2, **more: Any) -> ow.IrregularWaves:
    return ow.IrregularWaves(3.0, 9.0, seed=2, repeat_period=600.0, order=order, **more)


def test_its_first_order_is_the_linear_sea() -> None:
    """The same draws; the bound part is what comes on top."""
    linear, whole = (sea(order).waves(DEPTH, GRAVITY) for order in (1, 2))
    assert isinstance(whole, SecondOrderWaves)
    assert np.array_equal(whole.first_order.elevation, linear.elevation)
    time = np.linspace(0.0, 600.0, 6001)

    def surface(waves: Any) -> Any:
        return (np.exp(1j * np.outer(time, waves.omega)) @ waves.elevation).real

    bound = surface(whole) - surface(linear)
    assert 0.01 < np.std(bound) / np.std(surface(linear)) < 0.2
    assert np.mean(bound) < 0  # set-down


def test_a_regular_wave_gets_its_second_harmonic() -> None:
    wave = ow.RegularWaves(3.0, 10.0, order=2).waves(DEPTH, GRAVITY)
    assert wave.harmonic.tolist() == [0, 1, 2]
    assert wave.elevation[2].real > 0 > wave.elevation[0].real


def test_case_file() -> None:
    keys = {"kind": "irregular_waves", "significant_height_m": 3.0, "peak_period_s": 9.0}
    adapter: TypeAdapter[Any] = TypeAdapter(SeaChoice)
    made = adapter.validate_python({**keys, "order": 2}).completed(1, 600.0)
    assert made.order == 2
    assert "to second order" in made.in_words
    with pytest.raises(ValidationError, match="1 or 2"):
        adapter.validate_python({**keys, "order": 3})
    current = {"kind": "uniform", "speed_m_per_s": 1.0}
    with pytest.raises(ValidationError, match="cannot be combined"):
        adapter.validate_python({**keys, "order": 2, "doppler": True, "current": current})


def test_what_it_cannot_do_is_refused() -> None:
    with pytest.raises(ow.InputError, match="1 or 2"):
        sea(order=3)
    with pytest.raises(ow.InputError, match="doppler"):
        sea(doppler=True, current=ow.UniformCurrent(1.0))


def test_facts_and_cautions(oc6: ow.Turbine) -> None:
    """The realised sea is told of with its bound part; waves too long and high are cautioned."""
    linear, second = (wave_facts(ow.build(oc6, "coupled_springs", sea(order))) for order in (1, 2))
    assert second["highest_crest_m"] > 1.02 * linear["highest_crest_m"]
    assert second["significant_height_m"] == pytest.approx(linear["significant_height_m"], rel=0.02)
    long = ow.RegularWaves(8.0, 16.0, order=2)
    told = wave_facts(ow.build(oc6, "coupled_springs", long))["cautions"]
    assert "secondary crests in the troughs" in told[0]
    milder = ow.RegularWaves(3.0, 8.0, order=2)
    assert wave_facts(ow.build(oc6, "coupled_springs", milder))["cautions"] == []


def test_higher_crests_bend_the_pile_more(oc6: ow.Turbine) -> None:
    """A steep regular wave on a stiff structure, stretched: between linear and stream function."""
    moments = []
    kinds = (
        ow.RegularWaves(6.0, 10.0, stretching="extrapolation"),
        ow.RegularWaves(6.0, 10.0, order=2, stretching="extrapolation"),
        ow.StreamWaves(6.0, 10.0),
    )
    for kind in kinds:
        system = ow.build(oc6, "coupled_springs", kind, elements=12)
        data = ow.simulate(system, 60.0, 0.1, ramp=20.0, save_at=ow.SaveAt(heights=[0.0]))
        last = data["mudline_moment"].sel(direction="y").to_numpy()[-200:]
        moments.append(float(np.ptp(last)))
    assert moments[1] == pytest.approx(moments[2], rel=0.03)
    assert abs(moments[1] / moments[2] - 1) < abs(moments[0] / moments[2] - 1)


def test_extrapolation_continues_the_first_order_alone() -> None:
    """Above the mean level: the second order as it stands there, the first with its slope."""
    time, above = np.array([0.0, 1.3]), 1.2
    first, whole = (
        ow.RegularWaves(4.0, 9.0, order=order, stretching="extrapolation") for order in (1, 2)
    )

    def motion(kind: Any, height: float) -> Any:
        surface = WaterSurface(kind.waves(DEPTH, GRAVITY), 0.0, "extrapolation")
        return WaterSeries(np.array([height]), surface).time_inputs(time, np.ones(2))[:, 1:]

    at_crest = motion(whole, above)[0] - motion(whole, 0.0)[0]
    assert at_crest == pytest.approx(motion(first, above)[0] - motion(first, 0.0)[0], abs=1e-9)
    assert at_crest[0] > 0.05
    assert motion(whole, 0.0)[0, 0] != pytest.approx(motion(first, 0.0)[0, 0], rel=1e-2)


def test_the_drawn_surface_is_the_linear_part() -> None:
    """What is bound to pairs has many lengths at one frequency; a picture draws what is free."""
    linear, whole = (SurfaceWaves.of(sea(order).waves(DEPTH, GRAVITY)) for order in (1, 2))
    assert linear is not None
    assert whole is not None
    assert np.array_equal(whole.elevation, linear.elevation)
    assert np.array_equal(whole.number_x, linear.number_x)
