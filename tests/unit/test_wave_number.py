"""Dispersion at finite depth."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from offwind_pin.loads.dispersion import wave_number

GRAVITY = 9.80665


@pytest.mark.parametrize("depth", [0.5, 30.0, 4000.0])
def test_dispersion_is_met(depth: float) -> None:
    """omega^2 = g k tanh(k h) to 1e-12, from tides to ripples."""
    omega = 2 * np.pi * np.logspace(-4, 1, 400)
    k = wave_number(omega, depth, GRAVITY)
    assert_allclose(GRAVITY * k * np.tanh(k * depth), omega**2, rtol=1e-12)


def test_deep_water() -> None:
    """k = omega^2 / g where the bottom is out of reach."""
    omega = 2 * np.pi * np.array([0.3, 1.0])
    assert_allclose(wave_number(omega, 300.0, GRAVITY), omega**2 / GRAVITY, rtol=1e-12)


def test_shallow_water() -> None:
    """omega = k sqrt(g h) (1 - (k h)^2 / 6) in shallow water: the first correction, too, is there."""
    omega, depth = np.array([1e-3, 1e-2]), 10.0
    k = wave_number(omega, depth, GRAVITY)
    speed = np.sqrt(GRAVITY * depth) * (1 - (k * depth) ** 2 / 6)
    assert_allclose(omega / k, speed, rtol=10 * float(np.max(k * depth)) ** 4)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.01, 20.0), st.floats(0.1, 1000.0), st.floats(1.0, 30.0))
def test_dispersion_for_any_planet(omega: float, depth: float, gravity: float) -> None:
    """The relation holds for any frequency, depth and gravity."""
    k = wave_number(np.array([omega]), depth, gravity)
    assert_allclose(gravity * k * np.tanh(k * depth), omega**2, rtol=1e-12)
