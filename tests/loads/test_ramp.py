"""The ramp that brings waves and fluctuations in."""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.dynamics.acting_loads import smooth_ramp


def test_half_a_cosine() -> None:
    """0 at the start, a half half-way, 1 from the end on, flat at both ends."""
    rise = smooth_ramp(np.array([-1.0, 0.0, 10.0, 20.0, 1e3]), 20.0)
    assert rise[:2].tolist() == [0.0, 0.0]
    assert rise[2] == pytest.approx(0.5, rel=1e-15)
    assert rise[3:].tolist() == [1.0, 1.0]
    ends = np.array([0.01, 19.99])
    slope = (smooth_ramp(ends + 0.005, 20.0) - smooth_ramp(ends - 0.005, 20.0)) / 0.01
    assert np.all((slope > 0) & (slope < 1e-3))


def test_no_ramp_and_an_endless_one() -> None:
    """Without a ramp everything acts at once, with an endless one nothing ever."""
    assert smooth_ramp(np.array([0.0, 3.0]), 0.0).tolist() == [1.0, 1.0]
    assert smooth_ramp(np.array([0.0, 1e6]), np.inf).tolist() == [0.0, 0.0]


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
