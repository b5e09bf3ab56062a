"""Steady waves of finite height: published coefficients, boundary conditions, limits, field."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.fourier_wave import SteadyWave, highest_wave
from offwind_pin.loads.sea.waves.stream_function import StreamFunctionWaves

GRAVITY = 9.80665

FENTON = {
    # height, length over depth: order, speed, Bernoulli, B_1 ... B_6, E_1 ... E_6 over g and wave number
    (0.375, 9.7556): (
        8,
        0.7905,
        0.9597,
        [1.3540388e-01, 2.4808040e-02, 4.2638109e-03, 5.5394551e-04],
        [1.0563897e-01, 3.8999027e-02, 1.3066154e-02, 4.5740107e-03, 1.7217481e-03],
    ),
    (0.300, 8.0): (
        20,
        0.8326,
        1.1346,
        [1.3372527e-01, 1.5944230e-02, 1.5073329e-03, 5.7889960e-05, -1.0718677e-05],
        [1.1060569e-01, 2.7800975e-02, 6.6573116e-03, 1.7363711e-03, 4.9366487e-04],
    ),
}
"""Results of J. D. Fenton's program FOURIER without an Eulerian current, from output files that come
with public codes (proteus, nonlinearWaves/Solution.res; FentonStokesClass, Solution(Fourier).res).

A third file, for H/d = 0.544 and L/d = 6.2534, is left out: its coefficients hardly fall, and its
speed of 0.9370 misses Stokes' third order by 1 %, where ours is 0.9462."""


@pytest.mark.parametrize("shape", FENTON, ids=str)
def test_published_coefficients(shape: tuple[float, float]) -> None:
    """Speed, Bernoulli's constant and coefficients within 0.5 %; all that are not rounding."""
    order, speed, bernoulli, stream, surface = FENTON[shape]
    height, length = shape
    wave = SteadyWave.solve(height, length=length, depth=1.0, gravity=1.0, order=order)
    k = wave.wave_number
    assert wave.speed * np.sqrt(k) == pytest.approx(speed, rel=2e-4)
    assert wave.bernoulli * k + k == pytest.approx(bernoulli, rel=2e-4)
    assert wave.eulerian_current == pytest.approx(0.0, abs=1e-12)
    assert_allclose(wave.stream[: len(stream)] * k**1.5, stream, rtol=5e-3)
    assert_allclose(wave.surface[: len(surface)] * k, surface, rtol=5e-3)
    assert wave.crest - np.sum(wave.surface * (-1.0) ** np.arange(1, order + 1)) == pytest.approx(
        height
    )


@pytest.mark.parametrize(
    ("height", "period", "depth"), [(16.0, 14.0, 30.0), (1.9, 12.0, 4.0), (20.0, 12.0, 1000.0)]
)
def test_surface_conditions_between_the_points(height: float, period: float, depth: float) -> None:
    """At points that were not collocated the surface is a streamline of constant pressure."""
    wave = SteadyWave.solve(height, period=period, depth=depth, gravity=GRAVITY)
    x = np.linspace(0.013, 0.971, 37) * wave.length / 2
    j = np.arange(1, wave.order + 1)
    eta = np.cos(np.outer(x, j) * wave.wave_number) @ wave.surface
    k = j * wave.wave_number
    scale = np.cosh(np.minimum(k * depth, 700.0))
    big = k * depth > 300
    up = np.where(big, np.exp(k * eta[:, None]), np.cosh(k * (eta[:, None] + depth)) / scale)
    side = np.where(big, np.exp(k * eta[:, None]), np.sinh(k * (eta[:, None] + depth)) / scale)
    cos, sin = np.cos(np.outer(x, k)), np.sin(np.outer(x, k))
    u = -wave.mean_speed + (up * cos) @ (k * wave.stream)
    w = (side * sin) @ (k * wave.stream)
    flux = wave.mean_speed * (eta + depth) - (side * cos) @ wave.stream
    assert_allclose(flux, wave.volume_flux, rtol=2e-5)
    pressure = wave.bernoulli - (u**2 + w**2) / 2 - GRAVITY * eta
    assert np.max(np.abs(pressure)) < 2e-3 * GRAVITY * height


def test_small_waves_are_airys() -> None:
    """Length and first coefficient go over into linear theory with the square of the height."""
    k = wave_number(np.array([2 * np.pi / 9.0]), 30.0, GRAVITY)[0]
    off = []
    for height in (2.0, 1.0):
        wave = SteadyWave.solve(height, period=9.0, depth=30.0, gravity=GRAVITY)
        off.append(abs(wave.wave_number / k - 1))
        assert wave.surface[0] == pytest.approx(height / 2, rel=2 * off[-1] + 1e-3)
    assert off[0] / off[1] == pytest.approx(4.0, rel=0.02)


def test_stokes_speed_in_deep_water() -> None:
    """c^2 k / g = 1 + e^2 + e^4 / 2 + ..., e = k H / 2 (Stokes; Fenton 1985, Eq. 13)."""
    for steepness in (0.05, 0.1):
        length = 100.0
        height = steepness * length / np.pi
        wave = SteadyWave.solve(height, length=length, depth=1000.0, gravity=GRAVITY)
        square = wave.speed**2 * wave.wave_number / GRAVITY
        expected = 1 + steepness**2 + steepness**4 / 2
        assert square == pytest.approx(expected, abs=2 * steepness**6)


def test_long_waves_travel_as_solitary_ones() -> None:
    """c^2 / (g d) = 1 + H/d - (H/d)^2 / 20 - 3/70 (H/d)^3 about the trough's depth (Fenton 1972)."""
    off = []
    for length in (25.0, 40.0):
        wave = SteadyWave.solve(0.3, length=length, depth=1.0, gravity=1.0)
        trough = 1.0 + wave.crest - 0.3
        ratio = 0.3 / trough
        square = 1 + ratio - ratio**2 / 20 - 3 / 70 * ratio**3
        off.append(abs(wave.volume_flux / trough / np.sqrt(square * trough) - 1))
    assert off[1] < off[0] < 3e-4


def test_speed_of_a_steep_wave() -> None:
    """At 86 % of the highest, within what Stokes' third order leaves out of it."""
    wave = SteadyWave.solve(0.544, length=6.2534, depth=1.0, gravity=1.0)
    k = wave.wave_number
    tanh, steepness = np.tanh(k), k * 0.544 / 2
    third = (9 - 10 * tanh**2 + 9 * tanh**4) / (8 * tanh**4)
    square = tanh * (1 + steepness**2 * third)
    assert wave.speed**2 * k == pytest.approx(square, rel=2e-3)
    assert abs(wave.surface[-1]) < 1e-5


def test_highest_wave_is_refused() -> None:
    """Beyond Williams' limit there is no wave; the message names it."""
    assert highest_wave(1e5, 1.0) == pytest.approx(0.8332, abs=2e-3)
    assert highest_wave(1.0, 1e4) == pytest.approx(0.1411, abs=1e-3)
    with pytest.raises(ow.InputError, match="highest steady wave"):
        SteadyWave.solve(20.0, period=10.0, depth=20.0, gravity=GRAVITY)


@pytest.mark.parametrize(
    "change",
    [
        {"period": None},
        {"length": 100.0},
        {"height": -1.0},
        {"depth": np.nan},
        {"order": 1},
        {"eulerian_current": 1.0, "stokes_current": 0.0},
        {"eulerian_current": -6.0},
    ],
)
def test_bad_waves(change: dict[str, float | None]) -> None:
    settings = {"height": 5.0, "period": 10.0, "depth": 30.0, "gravity": GRAVITY}
    with pytest.raises(ow.InputError, match="stream function wave"):
        SteadyWave.solve(**(settings | change))  # type: ignore[arg-type]


def test_currents() -> None:
    """A following current lengthens the wave; without mass transport the Eulerian one opposes."""
    still = SteadyWave.solve(9.0, period=10.0, depth=30.0, gravity=GRAVITY)
    with_it = SteadyWave.solve(9.0, period=10.0, depth=30.0, gravity=GRAVITY, eulerian_current=1.0)
    closed = SteadyWave.solve(9.0, period=10.0, depth=30.0, gravity=GRAVITY, stokes_current=0.0)
    assert with_it.length > 1.05 * still.length
    assert [still.period, with_it.period] == pytest.approx([10.0, 10.0])
    assert with_it.eulerian_current == pytest.approx(1.0)
    assert closed.eulerian_current < -0.05
    assert closed.stokes_current == pytest.approx(0.0, abs=1e-12)


@pytest.fixture(scope="module")
def field() -> StreamFunctionWaves:
    wave = SteadyWave.solve(12.0, period=11.0, depth=30.0, gravity=GRAVITY)
    return StreamFunctionWaves(wave, direction=0.4, crest_time=2.0)


def at(field: StreamFunctionWaves, height: Array, time: float) -> tuple[Array, Array, float]:
    turn = np.exp(1j * field.omega * time)
    velocity, acceleration = field.velocity(height), field.acceleration(height)
    return (velocity @ turn).real.T, (acceleration @ turn).real.T, (field.elevation @ turn).real


def test_field_passes_with_its_crest(field: StreamFunctionWaves) -> None:
    """The crest is there at its time, under it the water moves in the wave's direction."""
    wave = field.wave
    velocity, acceleration, elevation = at(field, np.array([-3.0, wave.crest]), 2.0)
    assert elevation == pytest.approx(wave.crest)
    assert_allclose(velocity[:, 1] / velocity[:, 0], np.tan(0.4))
    assert_allclose(acceleration[:, :2], 0, atol=1e-9)
    assert np.all(acceleration[:, 2] < 0)
    _, _, trough = at(field, np.zeros(1), 2.0 + wave.period / 2)
    assert elevation - trough == pytest.approx(12.0)


def test_particle_acceleration_is_the_total_one(field: StreamFunctionWaves) -> None:
    """Du/Dt = du/dt + u du/dx + w du/dz with differences in time, and in place by u(x - c t)."""
    z, time, step = np.array([-12.0, -2.0, 1.0]), 3.3, 1e-4
    along = np.array([np.cos(0.4), np.sin(0.4), 0.0])

    def moved(dt: float, dz: float) -> Array:
        velocity = at(field, z + dz, time + dt)[0]
        return np.column_stack([velocity @ along, velocity[:, 2]])

    here = moved(0.0, 0.0)
    by_time = (moved(step, 0) - moved(-step, 0)) / (2 * step)
    by_z = (moved(0, step) - moved(0, -step)) / (2 * step)
    by_x = -by_time / field.wave.speed
    total = by_time + here[:, :1] * by_x + here[:, 1:] * by_z
    acceleration = at(field, z, time)[1]
    found = np.column_stack([acceleration @ along, acceleration[:, 2]])
    assert_allclose(found, total, rtol=1e-5, atol=1e-6)
    local = StreamFunctionWaves(field.wave, direction=0.4, crest_time=2.0, total_acceleration=False)
    alone = at(local, z, time)[1]
    assert_allclose(np.column_stack([alone @ along, alone[:, 2]]), by_time, rtol=1e-5, atol=1e-6)
    assert np.max(np.abs(total - by_time)) > 0.1


def test_surface_is_that_of_the_water(field: StreamFunctionWaves) -> None:
    """A particle at the surface stays there: d eta/dt + u d eta/dx = w, between the points too."""
    step = 1e-4
    for time in (2.31, 4.4, 8.05):
        elevation = at(field, np.zeros(1), time)[2]
        velocity = at(field, np.array([elevation]), time)[0][0]
        rate = (at(field, np.zeros(1), time + step)[2] - at(field, np.zeros(1), time - step)[2]) / (
            2 * step
        )
        along = velocity[0] * np.cos(0.4) + velocity[1] * np.sin(0.4)
        assert rate * (1 - along / field.wave.speed) == pytest.approx(velocity[2], abs=2e-3)
