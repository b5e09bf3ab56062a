"""The ramp that brings waves and fluctuations in."""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.dynamics.system import smooth_ramp


def test_half_a_cosine() -> None:
    """0 at the start, a half half-way, 1 from the end on, flat at both ends."""
    assert [smooth_ramp(t, 20.0) for t in (-1.0, 0.0)] == [0.0, 0.0]
    assert smooth_ramp(10.0, 20.0) == pytest.approx(0.5, rel=1e-15)
    assert [smooth_ramp(t, 20.0) for t in (20.0, 1e3)] == [1.0, 1.0]
    for time in (0.01, 19.99):
        slope = (smooth_ramp(time + 0.005, 20.0) - smooth_ramp(time - 0.005, 20.0)) / 0.01
        assert 0 < slope < 1e-3


def test_no_ramp_and_an_endless_one() -> None:
    """Without a ramp everything acts at once, with an endless one nothing ever."""
    assert smooth_ramp(0.0, 0.0) == 1.0
    assert smooth_ramp(1e6, np.inf) == 0.0


def test_waves_rise_with_it(coarse: ow.System) -> None:
    """Half-way up the ramp half the wave's inertia acts on a structure at rest."""
    rest = np.zeros(coarse.nv)
    none, half, full = (
        coarse.equations(ramp_time=ramp).evaluate(5.0, rest, rest, rest).forces.force[60:, 0].sum()
        for ramp in (np.inf, 10.0, 0.0)
    )
    assert none == 0.0
    # Drag goes with the square; on 9 m of diameter it is a hundredth of the inertia.
    assert half == pytest.approx(full / 2, rel=0.03)
    assert abs(full) > 1e4
