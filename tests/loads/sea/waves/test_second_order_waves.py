"""Second-order waves: boundary conditions, published closed forms, a second implementation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.definitions.hydrodynamics import Hydrodynamics
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.kinematics import WaterSeries, WaterSurface
from offwind_pin.loads.sea.waves import second_order as second_order_waves
from offwind_pin.loads.sea.waves.fourier_wave import SteadyWave
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.second_order import SecondOrderWaves
from offwind_pin.loads.sea.waves.stream_function import StreamFunctionWaves

GRAVITY = 9.80665


def free(
    harmonic: list[int],
    amplitude: list[complex],
    direction: list[float] | float = 0.0,
    depth: float = 30.0,
    period: float = 600.0,
) -> LinearWaves:
    number, elevation = np.array(harmonic, dtype=float), np.array(amplitude, dtype=complex)
    return LinearWaves.free(period, number, elevation, depth, GRAVITY, np.array(direction))


SHORT_CRESTED = free(
    [47, 55, 62, 80, 81], [0.4, 0.5j, -0.3 + 0.2j, 0.3, 0.2 - 0.3j], [0.3, -0.8, 2.9, 1.1, 0.2]
)


def second(linear: LinearWaves, *, total_acceleration: bool = True) -> SecondOrderWaves:
    """With every component taking part."""
    return SecondOrderWaves(linear, cutoff=np.inf, total_acceleration=total_acceleration)


def moved(linear: LinearWaves, x: float, y: float) -> LinearWaves:
    """The same waves as seen at another place."""
    way = x * np.cos(linear.direction) + y * np.sin(linear.direction)
    return replace(linear, elevation=linear.elevation * np.exp(-1j * linear.wave_number * way))


def bound_velocity(waves: SecondOrderWaves, height: Array) -> ComplexArray:
    """(3, n, m) without the linear part."""
    result = waves.velocity(height)
    np.subtract.at(result, (..., waves.linear.harmonic.astype(int)), waves.linear.velocity(height))
    return result


# --- closed forms -----------------------------------------------------------------------------


@pytest.mark.parametrize(("depth", "period"), [(20.0, 10.0), (10.0, 9.0), (50.0, 6.0), (1.0, 60.0)])
def test_regular_wave_is_stokes(depth: float, period: float) -> None:
    """Elevation, set-down and velocity of Stokes' second order in finite depth.

    Dean and Dalrymple, Water Wave Mechanics for Engineers and Scientists, 1984, chapter 11.
    """
    a = 0.7 * np.exp(0.4j)
    waves = second(free([1], [a], 0.5, depth, period))
    k, sigma = waves.linear.wave_number[0], waves.linear.omega[0]
    kd = k * depth
    crest = k * np.cosh(kd) * (2 + np.cosh(2 * kd)) / (4 * np.sinh(kd) ** 3)
    assert waves.harmonic.tolist() == [0.0, 1.0, 2.0]
    expected = [-(abs(a) ** 2) * k / (2 * np.sinh(2 * kd)), a, crest * a**2]
    assert_allclose(waves.elevation, expected, rtol=1e-10)
    z = np.array([-depth, -0.4 * depth, 0.0, 3.0])
    velocity = waves.velocity(z)
    up = np.minimum(z, 0) + depth
    along = 0.75 * sigma * k * a**2 * np.cosh(2 * k * up) / np.sinh(kd) ** 4
    rise = 0.75j * sigma * k * a**2 * np.sinh(2 * k * up) / np.sinh(kd) ** 4
    size = np.max(np.abs(along))
    assert_allclose(velocity[0, :, 2], along * np.cos(0.5), rtol=0, atol=1e-6 * size)
    assert_allclose(velocity[1, :, 2], along * np.sin(0.5), rtol=0, atol=1e-6 * size)
    assert_allclose(velocity[2, :, 2], rise, rtol=0, atol=1e-6 * size)
    assert np.all(velocity[:, :, 0] == 0)


def test_two_waves_in_deep_water() -> None:
    """Sum a b (k + other) / 2, difference -a b |k - l| / 2, and a return flow of the groups alone.

    Longuet-Higgins, J. Fluid Mech. 17, 1963, 459; Dalzell, Appl. Ocean Res. 21, 1999, 105.
    """
    a, b = 0.6 * np.exp(0.3j), 0.8 * np.exp(-1.1j)
    waves = second(free([70, 100], [a, b], depth=2000.0))
    k, other = waves.linear.wave_number
    assert waves.elevation[170] == pytest.approx(a * b * (k + other) / 2, rel=1e-9)
    assert waves.elevation[30] == pytest.approx(-b * np.conj(a) * (other - k) / 2, rel=1e-9)
    assert waves.elevation[140] == pytest.approx(a**2 * k / 2, rel=1e-9)
    z = np.array([-60.0, -10.0, 0.0])
    velocity = bound_velocity(waves, z)
    sigma = waves.linear.omega[1]
    back = -b * np.conj(a) * sigma * (other - k) * np.exp((other - k) * z)
    assert_allclose(velocity[0, :, 30], back, rtol=1e-6)
    assert_allclose(velocity[2, :, 30], 1j * back, rtol=1e-6)
    assert np.max(np.abs(velocity[:, :, [140, 170, 200]])) < 1e-9 * np.max(np.abs(back))


# --- a second implementation ------------------------------------------------------------------


def sharma_and_dean(linear: LinearWaves, height: Array) -> tuple[ComplexArray, ComplexArray]:
    """Elevation (m,) and velocity (3, n, m) by their double sum over ordered pairs.

    The kernels of Sharma and Dean 1981 as the documentation of OpenFAST's Waves2 gives them, which
    takes no potential for a wave's difference with itself, as here.
    """
    count = 2 * int(np.max(linear.harmonic)) + 1
    elevation = np.zeros(count, dtype=complex)
    velocity = np.zeros((3, len(height), count), dtype=complex)
    towards = np.array([np.cos(linear.direction), np.sin(linear.direction)])
    k, depth = linear.wave_number, linear.depth
    r = k * np.tanh(k * depth)
    for n in range(len(k)):
        for m in range(len(k)):
            for s in (1, -1):
                vector = k[n] * towards[:, n] + s * k[m] * towards[:, m]
                size = np.hypot(*vector)
                root = np.sqrt(r[n]) + s * np.sqrt(r[m])
                inner = k[n] * k[m] * towards[:, n] @ towards[:, m] - s * r[n] * r[m]
                kernel = 0.0
                if n != m or s == 1:
                    forced = np.sqrt(r[m]) * (k[n] ** 2 - r[n] ** 2) + s * np.sqrt(r[n]) * (
                        k[m] ** 2 - r[m] ** 2
                    )
                    kernel = (root * forced + 2 * root**2 * inner) / (
                        root**2 - size * np.tanh(size * depth)
                    )
                rise = ((kernel - inner) / np.sqrt(r[n] * r[m]) + r[n] + r[m]) / 4
                other = linear.elevation[m] if s == 1 else np.conj(linear.elevation[m])
                both = linear.elevation[n] * other
                number = int(linear.harmonic[n] + s * linear.harmonic[m])
                sign = number >= 0
                both, number = (both, number) if sign else (np.conj(both), -number)
                elevation[number] += rise * (both.real if number == 0 else both)
                if number == 0:
                    continue
                omega = linear.omega[n] + s * linear.omega[m]
                product = linear.omega[n] * linear.omega[m]
                potential = GRAVITY**2 / 4 / product * kernel / omega * both
                cosh = np.cosh(size * (height + depth)) / np.cosh(size * depth)
                sinh = np.sinh(size * (height + depth)) / np.cosh(size * depth)
                for axis in (0, 1):
                    velocity[axis, :, number] += vector[axis] * potential * cosh
                velocity[2, :, number] += 1j * (1 if sign else -1) * size * potential * sinh
    return elevation, velocity


@pytest.mark.parametrize("depth", [8.0, 30.0, 90.0])
def test_against_sharma_and_dean(depth: float) -> None:
    """Short-crested waves of five frequencies, one of them against the others."""
    linear = replace(SHORT_CRESTED, depth=depth)
    linear = LinearWaves.free(
        600.0, linear.harmonic, linear.elevation, depth, GRAVITY, linear.direction
    )
    waves = second(linear)
    z = np.linspace(-depth, 0.0, 7)
    elevation, velocity = sharma_and_dean(linear, z)
    assert np.count_nonzero(np.abs(elevation) > 1e-6) > 15
    assert_allclose(waves.bound[: len(elevation)], elevation, rtol=1e-9, atol=1e-12)
    found = bound_velocity(waves, z)[:, :, : len(elevation)]
    assert_allclose(found, velocity, rtol=0, atol=1e-6 * np.max(np.abs(velocity)))


def test_nodes_converge(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the sixth power of the nodes' distance, for polynomials of fifth degree."""
    z, draw = np.linspace(-30.0, 0.0, 16), np.random.default_rng(6)
    number = draw.choice(np.arange(40, 160), 20, replace=False)
    linear = free(list(number), [0.1 + 0j] * 20, list(draw.uniform(-1.5, 1.5, 20)))
    exact = sharma_and_dean(linear, z)[1]
    steps, off = np.geomspace(0.3, 0.1, 6), []
    for step in steps:
        monkeypatch.setattr(second_order_waves, "_STEP", step)
        found = bound_velocity(second(linear), z)[:, :, : exact.shape[2]]
        off.append(np.sqrt(np.mean(np.abs(found - exact) ** 2)))
    order = np.polyfit(np.log(steps), np.log(off), 1)[0]
    assert order == pytest.approx(6.0, abs=0.3)
    assert off[-1] < 1e-6 * np.sqrt(np.mean(np.abs(exact) ** 2))


# --- the equations ----------------------------------------------------------------------------


def surface_residuals(scale: float, *, order: int) -> Array:
    """(2,) rms of the kinematic and the dynamic condition at the moving surface.

    A particle at the surface stays there, w = eta_t + u.grad eta; and along the surface the
    pressure is constant, (Du/Dt + g e_z).(e + grad eta e_z) = 0 for e = e_x and e_y. The motion
    there is that at the mean water level and, of the linear waves, its change with height.
    """
    linear = replace(SHORT_CRESTED, elevation=scale * SHORT_CRESTED.elevation)
    time, top, h = np.linspace(0.0, 600.0, 41), np.zeros(1), 1e-3

    def surface(x: float, y: float) -> tuple[ComplexArray, Array]:
        there = moved(linear, x, y)
        waves = second(there) if order == 2 else there
        return waves.elevation, waves.omega

    waves = second(linear) if order == 2 else linear
    turn, first = (
        np.exp(1j * np.outer(waves.omega, time)),
        np.exp(1j * np.outer(linear.omega, time)),
    )
    eta = (waves.elevation @ turn).real
    eta_t = ((1j * waves.omega * waves.elevation) @ turn).real
    slope = [
        ((surface(*(h * e))[0] - surface(*(-h * e))[0]) / (2 * h) @ turn).real for e in np.eye(2)
    ]
    velocity = (waves.velocity(top)[:, 0] @ turn).real
    acceleration = (waves.acceleration(top)[:, 0] @ turn).real
    if order == 2:
        k, depth = linear.wave_number, linear.depth
        at_top = linear.velocity(top)[:, 0]
        by_z = at_top * k * np.array([np.tanh(k * depth)] * 2 + [1 / np.tanh(k * depth)])
        velocity += eta * (by_z @ first).real
        acceleration += eta * ((1j * linear.omega * by_z) @ first).real
    kinematic = eta_t + velocity[0] * slope[0] + velocity[1] * slope[1] - velocity[2]
    dynamic = [acceleration[i] + (GRAVITY + acceleration[2]) * slope[i] for i in range(2)]
    return np.array([np.sqrt(np.mean(kinematic**2)), np.sqrt(np.mean(np.square(dynamic)))])


@pytest.mark.parametrize("order", [2, 1])
def test_surface_conditions_to_second_order(order: int) -> None:
    """What is left of them falls with the third power of the steepness; linearly, with the second.

    The linear case shows that the residuals see the second order.
    """
    scale = np.array([1.0, 0.5, 0.25])
    left = np.array([surface_residuals(s, order=order) for s in scale])
    for condition in left.T:
        fitted = np.polyfit(np.log(scale), np.log(condition), 1)[0]
        assert fitted == pytest.approx(order + 1, abs=0.1)


def test_water_is_kept_and_does_not_turn() -> None:
    """div u = 0 and curl u = 0 for every harmonic, and nothing flows through the bed."""
    z, h = -7.0, 1e-2
    place = np.array([z])

    def velocity(x: float, y: float, z: float) -> ComplexArray:
        return bound_velocity(second(moved(SHORT_CRESTED, x, y)), np.array([z]))[:, 0]

    at = np.array([0.0, 0.0, z])
    by = [(velocity(*(at + e)) - velocity(*(at - e))) / (2 * h) for e in h * np.eye(3)]
    size = np.max(np.abs(by))
    assert size > 0
    assert np.max(np.abs(by[0][0] + by[1][1] + by[2][2])) < 1e-4 * size
    for i, j in ((0, 1), (1, 2), (2, 0)):
        assert np.max(np.abs(by[i][j] - by[j][i])) < 1e-4 * size
    bed = bound_velocity(second(SHORT_CRESTED), np.array([-30.0]))
    assert np.all(bed[2] == 0)
    assert np.max(np.abs(bed[:2])) > 0.01 * np.max(
        np.abs(bound_velocity(second(SHORT_CRESTED), place))
    )


def test_total_acceleration() -> None:
    """Du/Dt to second order: the local one, and (u . grad) u of the linear waves by differences."""
    z, h = np.array([-25.0, -9.0, -1.0]), 1e-3
    waves, local = second(SHORT_CRESTED), second(SHORT_CRESTED, total_acceleration=False)
    assert_allclose(local.acceleration(z), 1j * waves.omega * waves.velocity(z), rtol=1e-13)
    convective = waves.acceleration(z) - local.acceleration(z)
    for time in (0.0, 33.3, 471.0):
        first = np.exp(1j * SHORT_CRESTED.omega * time)

        def velocity(x: float, y: float, dz: float, turn: ComplexArray = first) -> Array:
            return (moved(SHORT_CRESTED, x, y).velocity(z + dz) @ turn).real

        by = [(velocity(*e) - velocity(*-e)) / (2 * h) for e in h * np.eye(3)]
        u = velocity(0, 0, 0)
        expected = sum(u[i] * by[i] for i in range(3))
        found = (convective @ np.exp(1j * waves.omega * time)).real
        size = np.max(np.abs(expected))
        assert size > 1e-3
        assert_allclose(found, expected, rtol=0, atol=1e-5 * size)


def test_stream_function_wave_goes_over_into_it() -> None:
    """Elevation, velocity and total acceleration of a regular wave, with the height squared."""
    z, off = np.array([-20.0, -8.0, -2.0]), []
    for height in (1.6, 0.8):
        wave = SteadyWave.solve(height, period=8.0, depth=20.0, gravity=GRAVITY)
        exact = StreamFunctionWaves(wave, direction=0.4)
        linear = free([1], [exact.elevation[1]], 0.4, 20.0, 8.0)
        waves = second(linear)
        pairs = [
            (waves.elevation[None], exact.elevation[None]),
            (waves.velocity(z)[[0, 2], :, 2], exact.velocity(z)[[0, 2], :, 2]),
            (waves.acceleration(z)[[0, 2], :, 2], exact.acceleration(z)[[0, 2], :, 2]),
        ]
        pairs[0] = (pairs[0][0][:, 2], pairs[0][1][:, 2])
        off.append([np.max(np.abs(f - e)) / np.max(np.abs(e)) for f, e in pairs])
    assert np.all(np.array(off[0]) < 0.1)
    assert_allclose(np.array(off[0]) / off[1], 4.0, atol=0.5)
    local = second(linear, total_acceleration=False).acceleration(z)[[0, 2], :, 2]
    assert np.max(np.abs(local - pairs[2][1])) > 0.05 * np.max(np.abs(pairs[2][1]))


# --- invariances ------------------------------------------------------------------------------


def test_turned_waves_have_turned_motion() -> None:
    turn, z = 0.7, np.array([-20.0, -3.0])
    here = second(SHORT_CRESTED)
    there = second(replace(SHORT_CRESTED, direction=SHORT_CRESTED.direction + turn))
    rotation = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    )
    assert_allclose(there.elevation, here.elevation, atol=1e-12)
    for field in ("velocity", "acceleration"):
        expected = np.einsum("ij,jnm->inm", rotation, getattr(here, field)(z))
        assert_allclose(getattr(there, field)(z), expected, atol=1e-12)


def test_order_and_division_of_components_do_not_matter() -> None:
    """Components in another order, and one of them as two of half its height."""
    z = np.array([-20.0, -3.0])
    here = second(SHORT_CRESTED)
    pick = np.array([3, 0, 4, 2, 1, 3])
    share = np.where(pick == 3, 0.5, 1.0)
    there = second(
        replace(
            SHORT_CRESTED,
            harmonic=SHORT_CRESTED.harmonic[pick],
            elevation=share * SHORT_CRESTED.elevation[pick],
            direction=SHORT_CRESTED.direction[pick],
            wave_number=SHORT_CRESTED.wave_number[pick],
        )
    )
    assert_allclose(there.elevation, here.elevation, atol=1e-12)
    assert_allclose(there.velocity(z), here.velocity(z), atol=1e-12)
    assert_allclose(there.acceleration(z), here.acceleration(z), atol=1e-12)


# --- irregular seas ---------------------------------------------------------------------------


def test_skewness_is_that_of_the_pairs() -> None:
    """Third central moment 3 E[eta1^2 eta2] over a period, by Sharma and Dean's pairs.

    The frequencies are those of a Golomb ruler, so that sums and differences coincide with no
    others, and averages over the period are those over random phases.
    """
    ruler = np.array([0, 1, 4, 9, 15, 22, 32, 34]) + 60
    draw = np.random.default_rng(4)
    amplitude = 0.05 * draw.uniform(0.5, 1.0, 8) * np.exp(2j * np.pi * draw.random(8))
    linear = free(list(ruler), list(amplitude), depth=15.0)
    rise = sharma_and_dean(linear, np.zeros(1))[0]
    square = np.zeros(len(rise), dtype=complex)
    for n, number in enumerate(ruler):
        for m, other in enumerate(ruler):
            square[number + other] += amplitude[n] * amplitude[m] / 2
            if number > other:
                square[number - other] += amplitude[n] * np.conj(amplitude[m])
    theory = 3 * np.sum((rise * np.conj(square))[1:].real) / 2
    waves = second(linear)
    time = np.arange(4000) * 600.0 / 4000
    eta = (waves.elevation @ np.exp(1j * np.outer(waves.omega, time))).real
    moment = np.mean((eta - eta.mean()) ** 3)
    assert moment == pytest.approx(theory, rel=5e-3)
    assert theory > 0


def skewness(field: LinearWaves | SecondOrderWaves) -> float:
    size = 16384
    lines = np.zeros(size // 2 + 1, dtype=complex)
    lines[field.harmonic.astype(int)] = field.elevation * size / 2
    lines[0] *= 2
    eta = np.fft.irfft(lines, n=size)
    return float(np.mean((eta - eta.mean()) ** 3) / np.std(eta) ** 3)


def test_crests_are_higher_than_troughs_are_deep() -> None:
    """Skewness of a sea in 30 m, where linear waves have none; crests rise by more than 4 %."""
    sea = [
        ow.IrregularWaves(6.0, 10.0, seed=seed, repeat_period=1800.0).waves(30.0, GRAVITY)
        for seed in range(4)
    ]
    bound = [SecondOrderWaves(linear) for linear in sea]
    assert abs(np.mean([skewness(linear) for linear in sea])) < 0.06
    assert 0.15 < np.mean([skewness(waves) for waves in bound]) < 0.4
    for linear, waves in zip(sea, bound, strict=True):
        plain, steep = WaterSurface(linear, 0.0, "none"), WaterSurface(waves, 0.0, "none")
        assert steep.highest_elevation > 1.04 * plain.highest_elevation
        assert steep.highest_elevation > -steep.lowest_elevation


def test_cutoff() -> None:
    """Components above it stay as they are and bind nothing; the default is sqrt(2 g / Hs)."""
    linear = ow.IrregularWaves(6.0, 10.0, seed=2, repeat_period=600.0).waves(30.0, GRAVITY)
    waves = SecondOrderWaves(linear)
    assert waves.cutoff == pytest.approx(np.sqrt(2 * GRAVITY / 6.0), rel=2e-3)
    low = linear.omega <= waves.cutoff
    assert 0.4 * len(low) < np.sum(low) < 0.8 * len(low)
    alone = second(
        LinearWaves.free(600.0, linear.harmonic[low], linear.elevation[low], 30.0, GRAVITY)
    )
    size = min(len(alone.bound), len(waves.bound))
    assert_allclose(waves.bound[:size], alone.bound[:size], atol=1e-12)
    assert np.all(waves.bound[size:] == 0)
    high = linear.harmonic[~low].astype(int)
    assert_allclose((waves.elevation - waves.bound)[high], linear.elevation[~low])
    assert not np.allclose(second(linear).bound[:size], alone.bound[:size], atol=1e-3)


def test_free_waves_of_its_frequencies() -> None:
    """Wave numbers for diffraction; the mean has none."""
    waves = second(SHORT_CRESTED)
    assert waves.wave_number[0] == 0
    k = waves.wave_number[1:]
    assert_allclose(GRAVITY * k * np.tanh(k * 30.0), waves.omega[1:] ** 2, rtol=1e-10)
    assert waves.first_order is SHORT_CRESTED
    assert SHORT_CRESTED.first_order is SHORT_CRESTED


class BoundWaves(ow.IrregularWaves):
    def waves(self, depth: float, gravity: float) -> SecondOrderWaves:  # type: ignore[override]
        return SecondOrderWaves(super().waves(depth, gravity))


def test_at_a_turbine(oc6: ow.Turbine) -> None:
    """With diffraction and coefficients over the Keulegan-Carpenter number, which the slow motions
    of bound waves leave alone."""
    table = Hydrodynamics.model_validate(
        {
            "added_mass_coefficient": 1.0,
            "drag_coefficient": {"keulegan_carpenter": [0, 10], "value": [0.0, 10.0]},
            "diffraction": "maccamy_fuchs",
        }
    )
    turbine = oc6.model_copy(update={"hydrodynamics": table})
    bound = HydrodynamicModel.of(turbine, BoundWaves(6.0, 10.0, seed=1, repeat_period=600.0))
    plain = HydrodynamicModel.of(turbine, ow.IrregularWaves(6.0, 10.0, seed=1, repeat_period=600.0))
    assert_allclose(bound.drag, plain.drag, rtol=1e-13)
    time = np.array([13.0, 250.0])
    rows, linear = (w.water.time_inputs(time, np.ones(2)) for w in (bound, plain))
    assert np.all(np.isfinite(rows))
    off = np.max(np.abs(rows - linear), axis=0)
    assert 0 < np.max(off) < 0.5 * np.max(np.abs(linear))


@pytest.mark.parametrize("stretching", ["none", "extrapolation"])
def test_series_is_the_sum(stretching: str) -> None:
    """Tables over time against the harmonics' direct sum, at strips that stay under water."""
    linear = ow.IrregularWaves(3.0, 8.0, seed=5, repeat_period=600.0).waves(30.0, GRAVITY)
    waves = SecondOrderWaves(linear)
    z, time = np.array([-29.0, -12.0, -6.0]), np.array([17.3, 402.0])
    surface = WaterSurface(waves, 0.0, stretching)  # type: ignore[arg-type]
    rows = WaterSeries(z, surface).time_inputs(time, np.ones(2))[:, 1:].reshape(2, 2, 3, 3)
    turn = np.exp(1j * np.outer(waves.omega, time))
    for quantity, field in enumerate((waves.velocity(z), waves.acceleration(z))):
        assert_allclose(rows[:, quantity], (field @ turn).real.transpose(2, 1, 0), atol=1e-4)


# --- refusals ---------------------------------------------------------------------------------


def test_current_in_the_waves_is_refused() -> None:
    with pytest.raises(ow.InputError, match=r"field current_along.*water at rest"):
        SecondOrderWaves(replace(SHORT_CRESTED, current_along=np.full(5, 0.5)))
    SecondOrderWaves(replace(SHORT_CRESTED, current_along=np.zeros(5)))


def test_other_fields_are_refused() -> None:
    wave = SteadyWave.solve(2.0, period=8.0, depth=20.0, gravity=GRAVITY)
    with pytest.raises(ow.InputError, match="StreamFunctionWaves"):
        SecondOrderWaves(StreamFunctionWaves(wave))  # type: ignore[arg-type]


@pytest.mark.parametrize("cutoff", [0.0, -1.0, np.nan, 0.4])
def test_cutoff_below_all_is_refused(cutoff: float) -> None:
    with pytest.raises(ow.InputError, match=r"field cutoff.*slowest component"):
        SecondOrderWaves(SHORT_CRESTED, cutoff=cutoff)


def test_waves_that_break_are_refused() -> None:
    with pytest.raises(ow.InputError, match="Lower the waves"):
        SecondOrderWaves(free([1], [5.0], period=5.0))


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"harmonic": np.array([0.0, 1, 2, 3, 4])}, "harmonic"),
        ({"harmonic": np.array([1.5, 2, 3, 4, 5])}, "harmonic"),
        ({"elevation": np.array([1, np.nan, 1, 1, 1 + 0j])}, "elevation"),
    ],
)
def test_bad_components_are_refused(change: dict[str, Array], word: str) -> None:
    with pytest.raises(ow.InputError, match=f"field {word}"):
        SecondOrderWaves(replace(SHORT_CRESTED, **change))  # type: ignore[arg-type]
