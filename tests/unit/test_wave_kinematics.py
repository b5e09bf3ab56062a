"""Airy kinematics: limits, boundary conditions, consistency."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from offwind_pin.loads.waves import IrregularSea, wave_number

GRAVITY = 9.80665


def regular(amplitude: float, frequency: float, depth: float, phase: float = 0.0) -> IrregularSea:
    """A sea of one component."""
    return IrregularSea(
        np.array([amplitude]), np.array([frequency]), np.array([phase]), depth, GRAVITY
    )


@pytest.fixture(scope="module")
def irregular() -> IrregularSea:
    return IrregularSea.pierson_moskowitz(
        1.25, 5.5, depth=30.0, gravity=GRAVITY, repeat_period=120.0, seed=7
    )


def test_deep_water_orbits_are_circles() -> None:
    """Both velocity amplitudes are a omega exp(k z)."""
    sea = regular(0.8, 0.4, 400.0)
    z = np.array([-40.0, -10.0, 0.0])
    omega = 2 * np.pi * 0.4
    expected = 0.8 * omega * np.exp(omega**2 / GRAVITY * z)
    water = sea.kinematics_at(z)
    assert_allclose(water.horizontal[:, 0], expected, rtol=1e-10)
    assert_allclose(water.vertical[:, 0], expected, rtol=1e-10)


def test_shallow_water_moves_as_a_column() -> None:
    """The horizontal amplitude is a sqrt(g / h) at every height, the vertical one linear."""
    depth, frequency = 10.0, 1e-4
    z = np.array([-10.0, -5.0, 0.0])
    water = regular(0.3, frequency, depth).kinematics_at(z)
    small = (2 * np.pi * frequency) ** 2 * depth / GRAVITY
    assert_allclose(water.horizontal[:, 0], 0.3 * np.sqrt(GRAVITY / depth), rtol=small)
    omega = 2 * np.pi * frequency
    assert_allclose(water.vertical[:, 0], 0.3 * omega * (1 + z / depth), rtol=small, atol=1e-15)


def test_no_flow_through_the_bed(irregular: IrregularSea) -> None:
    """The vertical velocity vanishes at the bed for every component."""
    water = irregular.kinematics_at(np.array([-30.0]))
    assert np.all(water.vertical == 0)
    assert np.max(water.horizontal) > 0


def test_surface_moves_with_the_water(irregular: IrregularSea) -> None:
    """At z = 0 the vertical velocity is d(eta)/dt."""
    step = 1e-4
    rate = np.diff(irregular.elevation(np.array([12.3 - step, 12.3 + step])))[0] / (2 * step)
    velocity, _ = irregular.kinematics_at(np.array([0.0])).at(12.3)
    assert velocity[0, 2] == pytest.approx(rate, rel=1e-6)


def test_crest_moves_along_x() -> None:
    """Under a crest the water moves with the wave, towards +x, and is pushed neither way."""
    velocity, acceleration = regular(1.0, 0.2, 30.0).kinematics_at(np.array([-3.0])).at(0.0)
    assert velocity[0, 0] > 0
    assert acceleration[0, 0] == pytest.approx(0.0, abs=1e-15)
    assert acceleration[0, 2] < 0
    assert np.all(velocity[:, 1] == 0)


def test_acceleration_is_the_rate_of_velocity(irregular: IrregularSea) -> None:
    """du/dt = a at fixed points by central differences, truncation (omega step)^2 / 6."""
    water, step = irregular.kinematics_at(np.array([-25.0, -4.0, 0.0])), 1e-4
    rate = (water.at(31.7 + step)[0] - water.at(31.7 - step)[0]) / (2 * step)
    _, acceleration = water.at(31.7)
    tolerance = (irregular.frequency.max() * 2 * np.pi * step) ** 2 * np.abs(acceleration).max()
    assert_allclose(acceleration, rate, rtol=0, atol=max(tolerance, 1e-10))


def test_water_is_incompressible() -> None:
    """dw/dz = -du/dx, which for a wave of number k is dW/dz = k U between the amplitudes."""
    sea, step = regular(1.0, 0.15, 30.0), 1e-3
    z = np.array([-20.0, -5.0])
    up, down = (sea.kinematics_at(z + d).vertical[:, 0] for d in (step, -step))
    k = wave_number(2 * np.pi * sea.frequency, 30.0, GRAVITY)
    assert_allclose((up - down) / (2 * step), k * sea.kinematics_at(z).horizontal[:, 0], rtol=1e-7)


def test_very_short_waves_neither_overflow_nor_reach_down() -> None:
    """A ripple over deep water leaves the bed at rest, without a warning."""
    water = regular(0.01, 20.0, 500.0).kinematics_at(np.array([-500.0, 0.0]))
    assert water.horizontal[0, 0] == pytest.approx(0.0, abs=1e-250)
    assert water.horizontal[1, 0] == pytest.approx(0.01 * 2 * np.pi * 20.0, rel=1e-12)
