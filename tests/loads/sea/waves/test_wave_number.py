"""Dispersion at finite depth."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from offwind_pin.loads.sea.waves.dispersion import wave_number, wave_number_in_current

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


@pytest.mark.parametrize("current", [-1.5, -0.3, 0.0, 0.4, 3.0])
@pytest.mark.parametrize("depth", [4.0, 30.0, 2000.0])
def test_dispersion_in_a_current(current: float, depth: float) -> None:
    """(omega - k U)^2 = g k tanh(k h), on the branch that goes over into that without a current."""
    omega = 2 * np.pi * np.array([0.02, 0.08, 0.15, 0.25])
    k = wave_number_in_current(omega, depth, GRAVITY, np.full(4, current))
    moving = np.isfinite(k)
    assert np.count_nonzero(moving) >= 3
    own = omega - k * current
    assert_allclose((GRAVITY * k * np.tanh(k * depth))[moving], own[moving] ** 2, rtol=1e-11)
    assert np.all(own[moving] > 0)
    free = wave_number(omega, depth, GRAVITY)
    assert np.all((np.sign(free - k) == np.sign(current))[moving] | (current == 0))


def test_current_in_deep_water() -> None:
    """k = k_0 (2 / (1 + sqrt(1 + 4 U omega / g)))^2, and blocked below U = -g / (4 omega)."""
    omega = np.full(4, 1.2)
    limit = GRAVITY / (4 * omega[0])
    current = limit * np.array([2.0, -0.5, -0.99, -1.01])
    k = wave_number_in_current(omega, 1e4, GRAVITY, current)
    root = 1 + np.sqrt(1 + current[:3] / limit)
    assert_allclose(k[:3], omega[:3] ** 2 / GRAVITY * (2 / root) ** 2, rtol=1e-10)
    assert np.isnan(k[3])
