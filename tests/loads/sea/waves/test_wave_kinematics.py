"""Airy kinematics: limits, boundary conditions, consistency."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.waves.linear import LinearWaves

GRAVITY = 9.80665


def regular(amplitude: float, frequency: float, depth: float) -> LinearWaves:
    """A wave of one component with its crest at time 0."""
    elevation = np.array([amplitude + 0j])
    return LinearWaves.free(1 / frequency, np.ones(1), elevation, depth, GRAVITY)


def at(waves: LinearWaves, height: Array, time: float) -> tuple[Array, Array]:
    """Velocity and acceleration (n, 3) at a time."""
    turn = np.exp(1j * waves.omega * time)
    motions = (waves.velocity(height), waves.acceleration(height))
    velocity, acceleration = ((motion @ turn).real.T for motion in motions)
    return velocity, acceleration


@pytest.fixture(scope="module")
def irregular() -> LinearWaves:
    return ow.IrregularWaves(1.25, 5.5, seed=7, repeat_period=120.0).waves(30.0, GRAVITY)


def test_deep_water_orbits_are_circles() -> None:
    """Both velocity amplitudes are a omega exp(k z)."""
    z = np.array([-40.0, -10.0, 0.0])
    omega = 2 * np.pi * 0.4
    expected = 0.8 * omega * np.exp(omega**2 / GRAVITY * z)
    velocity = regular(0.8, 0.4, 400.0).velocity(z)
    assert_allclose(velocity[0, :, 0], expected, rtol=1e-10)
    assert_allclose(velocity[2, :, 0], 1j * expected, rtol=1e-10)


def test_shallow_water_moves_as_a_column() -> None:
    """The horizontal amplitude is a sqrt(g / h) at every height, the vertical one linear."""
    depth, frequency = 10.0, 1e-4
    z = np.array([-10.0, -5.0, 0.0])
    velocity = np.abs(regular(0.3, frequency, depth).velocity(z))
    small = (2 * np.pi * frequency) ** 2 * depth / GRAVITY
    assert_allclose(velocity[0, :, 0], 0.3 * np.sqrt(GRAVITY / depth), rtol=small)
    omega = 2 * np.pi * frequency
    assert_allclose(velocity[2, :, 0], 0.3 * omega * (1 + z / depth), rtol=small, atol=1e-15)


def test_no_flow_through_the_bed(irregular: LinearWaves) -> None:
    """The vertical velocity vanishes at the bed for every component."""
    velocity = irregular.velocity(np.array([-30.0]))
    assert np.all(velocity[2] == 0)
    assert np.max(np.abs(velocity[0])) > 0


def test_surface_moves_with_the_water(irregular: LinearWaves) -> None:
    """At z = 0 the vertical velocity is d(eta)/dt, component by component."""
    velocity = irregular.velocity(np.array([0.0]))
    assert_allclose(velocity[2, 0], 1j * irregular.omega * irregular.elevation, rtol=1e-12)


def test_crest_moves_along_x() -> None:
    """Under a crest the water moves with the wave, towards +x, and is pushed neither way."""
    velocity, acceleration = at(regular(1.0, 0.2, 30.0), np.array([-3.0]), 0.0)
    assert velocity[0, 0] > 0
    assert acceleration[0, 0] == pytest.approx(0.0, abs=1e-15)
    assert acceleration[0, 2] < 0
    assert np.all(velocity[:, 1] == 0)


def test_direction_turns_the_motion() -> None:
    """A wave towards +y moves the water there as one towards +x does along x."""
    z = np.array([-7.0, -1.0])
    straight = regular(1.0, 0.2, 30.0).velocity(z)
    turned = ow.RegularWaves(2.0, 5.0, direction_deg=90.0).waves(30.0, GRAVITY).velocity(z)
    assert_allclose(turned[1], straight[0], rtol=1e-14)
    assert_allclose(turned[0], 0, atol=1e-15)
    assert_allclose(turned[2], straight[2], rtol=1e-14)


def test_acceleration_is_the_rate_of_velocity(irregular: LinearWaves) -> None:
    """du/dt = a at fixed points by central differences, truncation (omega step)^2 / 6."""
    z, step = np.array([-25.0, -4.0, 0.0]), 1e-4
    rate = (at(irregular, z, 31.7 + step)[0] - at(irregular, z, 31.7 - step)[0]) / (2 * step)
    _, acceleration = at(irregular, z, 31.7)
    tolerance = (irregular.omega.max() * step) ** 2 * np.abs(acceleration).max()
    assert_allclose(acceleration, rate, rtol=0, atol=max(tolerance, 1e-10))


def test_water_is_incompressible() -> None:
    """dw/dz = -du/dx, which for a wave of number k is dW/dz = i k U between the amplitudes."""
    waves, step = regular(1.0, 0.15, 30.0), 1e-3
    z = np.array([-20.0, -5.0])
    slope = (waves.velocity(z + step)[2] - waves.velocity(z - step)[2]) / (2 * step)
    assert_allclose(slope, 1j * waves.wave_number * waves.velocity(z)[0], rtol=1e-7)


def test_very_short_waves_neither_overflow_nor_reach_down() -> None:
    """A ripple over deep water leaves the bed at rest, without a warning."""
    velocity = np.abs(regular(0.01, 20.0, 500.0).velocity(np.array([-500.0, 0.0])))
    assert velocity[0, 0, 0] == pytest.approx(0.0, abs=1e-250)
    assert velocity[0, 1, 0] == pytest.approx(0.01 * 2 * np.pi * 20.0, rel=1e-12)
