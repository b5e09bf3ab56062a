"""Irregular seas: their draws, their statistics, short crests, a current, an asked-for crest."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.irregular_waves import with_crest
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import jonswap
from offwind_pin.loads.sea.waves.statistics import moments

GRAVITY = 9.80665
DEPTH = 30.0
HOURS3 = 10800.0


def sea(seed: int = 1, **more: Any) -> ow.IrregularWaves:
    settings = {"repeat_period": HOURS3, "peak_shape": 3.3} | more
    return ow.IrregularWaves(6.0, 10.0, seed=seed, **settings)


def realised(seed: int = 1, **more: Any) -> LinearWaves:
    return sea(seed, **more).waves(DEPTH, GRAVITY)


def at(waves: LinearWaves, time: Array, order: int = 0) -> Array:
    """(t,) surface, or its derivative of an order."""
    turn = np.exp(1j * np.outer(time, waves.omega))
    return np.asarray((turn @ ((1j * waves.omega) ** order * waves.elevation)).real)


# Draws


def test_options_leave_the_other_draws_alone() -> None:
    """Phases are the same whatever else is drawn, directions whether amplitudes are random or not."""
    plain = realised()
    spread = ow.Spreading("cos_2s", 8.0)
    drawn = realised(amplitudes="random")
    assert_allclose(np.angle(drawn.elevation / plain.elevation), 0, atol=1e-12)
    assert np.std(np.abs(drawn.elevation / plain.elevation)) > 0.4
    short = realised(spreading=spread)
    assert np.array_equal(short.elevation, plain.elevation)
    both = realised(spreading=spread, amplitudes="random")
    assert np.array_equal(both.direction, short.direction)
    assert np.array_equal(both.elevation, drawn.elevation)


def test_bitwise_from_the_seed() -> None:
    """The same seed gives the same sea to the last bit, another seed another one."""
    options: dict[str, Any] = {
        "amplitudes": "random",
        "spreading": ow.Spreading("cos_n", 4.0),
        "doppler": True,
        "current": ow.UniformCurrent(0.8, 40.0),
        "crest": ow.Crest(5.0, 500.0),
    }
    one, same, other = (realised(seed, **options) for seed in (7, 7, 8))
    for name in ("harmonic", "elevation", "direction", "wave_number"):
        assert np.array_equal(getattr(one, name), getattr(same, name))
    assert not np.any(one.elevation == other.elevation)
    assert not np.any(one.direction == other.direction)


def test_short_form_is_jonswap() -> None:
    """Height and period are short for the spectrum object, to the last bit."""
    spectrum = ow.JonswapSpectrum(6.0, 10.0, 3.3)
    given = ow.IrregularWaves(spectrum=spectrum, seed=1, repeat_period=HOURS3)
    assert np.array_equal(given.waves(DEPTH, GRAVITY).elevation, realised().elevation)


# Statistics


def test_variance_of_random_amplitudes() -> None:
    """m0 and m2 of three hours lie within three standard errors of the spectrum's, Hs with them.

    Each component's variance follows an exponential distribution, whose standard deviation is its
    mean: the variance of a moment is sum (f^n v_j)^2. A deterministic sea has no such error.
    """
    target, drawn = realised(), realised(3, amplitudes="random")
    frequency, v = target.harmonic / HOURS3, np.abs(target.elevation) ** 2 / 2
    wanted, found = moments(target), moments(drawn)
    for order, name in ((0, "m0"), (2, "m2")):
        error = np.sqrt(np.sum((frequency**order * v) ** 2))
        assert error < 0.05 * getattr(wanted, name)
        assert 0 < abs(getattr(found, name) - getattr(wanted, name)) < 3 * error
    assert found.significant_height == pytest.approx(6.0, rel=0.05)
    assert wanted.significant_height == pytest.approx(6.0, rel=6e-3)


def test_amplitudes_are_rayleigh_distributed() -> None:
    """Squares over their means: mean 1, variance 1, and e^-1 of them above 1."""
    v = np.abs(realised().elevation) ** 2
    share = np.concatenate(
        [np.abs(realised(s, amplitudes="random").elevation) ** 2 / v for s in range(10)]
    )
    error = 1 / np.sqrt(len(share))
    assert np.mean(share) == pytest.approx(1, abs=3 * error)
    assert np.var(share) == pytest.approx(1, abs=3 * np.sqrt(8) * error)
    assert np.mean(share > 1) == pytest.approx(np.exp(-1), abs=3 * error)


def test_variance_between_realisations() -> None:
    """Of 400 Gaussian seas the variance's own spread is that of its components; of others none."""
    short = {"repeat_period": 600.0}
    target = realised(**short)
    v = np.abs(target.elevation) ** 2 / 2
    m0 = [moments(realised(s, amplitudes="random", **short)).m0 for s in range(400)]
    assert np.mean(m0) == pytest.approx(np.sum(v), rel=3 * np.std(m0) / np.sum(v) / 20)
    assert np.std(m0) == pytest.approx(np.sqrt(np.sum(v**2)), rel=0.15)
    fixed = [moments(realised(s, **short)).m0 for s in range(5)]
    assert_allclose(fixed, np.sum(v), rtol=1e-12)


def test_moments_are_those_of_the_surface() -> None:
    """Over a period the surface has variance m0, its rate (2 pi)^2 m2; crossings give Tz (Rice)."""
    waves = realised(5, amplitudes="random")
    state = moments(waves)
    time = np.arange(0, HOURS3, 0.25)
    lines = np.zeros(len(time) // 2 + 1, dtype=complex)
    lines[waves.harmonic.astype(int)] = waves.elevation * len(time) / 2
    surface = np.fft.irfft(lines, len(time))
    assert np.var(surface) == pytest.approx(state.m0, rel=1e-9)
    rate = np.fft.irfft(lines * 2j * np.pi * np.arange(len(lines)) / HOURS3, len(time))
    assert np.var(rate) == pytest.approx((2 * np.pi) ** 2 * state.m2, rel=1e-9)
    crossings = np.count_nonzero((surface[:-1] < 0) & (surface[1:] >= 0))
    assert HOURS3 / crossings == pytest.approx(state.zero_crossing_period, rel=0.03)
    assert moments(realised()).peak_period == pytest.approx(10.0, rel=0.02)
    assert state.peak_period == pytest.approx(10.0, rel=0.1)


# Short crests


@pytest.mark.parametrize(("kind", "exponent"), [("cos_2s", 2.0), ("cos_2s", 25.0), ("cos_n", 4.0)])
def test_spreading_is_a_density(kind: Any, exponent: float) -> None:
    """Its area is 1, its circular deviation the closed form's; angles are its quantiles."""
    spreading = ow.Spreading(kind, exponent)

    def density(angle: float) -> float:
        return float(spreading.density(np.array(angle)))

    def integral(weight: Any, low: float, high: float) -> float:
        inside = [p for p in (-np.pi / 2, 0.0, np.pi / 2) if low < p < high]
        value, _ = quad(lambda a: weight(a) * density(a), low, high, points=inside or None)
        return float(value)

    assert integral(lambda a: 1.0, -np.pi, np.pi) == pytest.approx(1, rel=1e-9)
    cosine = integral(np.cos, -np.pi, np.pi)
    assert spreading.deviation == pytest.approx(np.sqrt(2 * (1 - cosine)), rel=1e-8)
    share = np.array([0.02, 0.3, 0.5, 0.9])
    below = [integral(lambda a: 1.0, -np.pi, angle) for angle in spreading.angles(share)]
    assert_allclose(below, share, atol=1e-8)


def test_deviation_in_closed_form() -> None:
    """sqrt(2 / (1 + s)) for cos^2s; cos^n for n = 2 by hand: E cos = 8 / (3 pi)."""
    assert ow.Spreading("cos_2s", 7.0).deviation == pytest.approx(0.5)
    by_hand = np.sqrt(2 * (1 - 8 / (3 * np.pi)))
    assert ow.Spreading("cos_n", 2.0).deviation == pytest.approx(by_hand, rel=1e-12)


@pytest.mark.parametrize("spreading", [ow.Spreading("cos_2s", 10.0), ow.Spreading("cos_n", 2.0)])
def test_directions_of_a_sea(spreading: ow.Spreading) -> None:
    """Mean direction and circular deviation of a sea's components, within the sampling error."""
    mean = 130.0
    angle = np.concatenate(
        [realised(s, spreading=spreading, direction_deg=mean).direction for s in range(4)]
    ) - np.radians(mean)
    count = len(angle)
    assert count > 15000
    resultant = np.mean(np.exp(1j * angle))
    deviation = np.sqrt(2 * (1 - np.abs(resultant)))
    assert np.angle(resultant) == pytest.approx(0, abs=3 * deviation / np.sqrt(count))
    assert deviation == pytest.approx(spreading.deviation, rel=0.02)
    assert np.std(np.sin(angle)) > 0.1


def test_short_crests_share_the_motion() -> None:
    """Horizontal velocity variance is that of long crests, split between the axes by cos^2, sin^2.

    For cos^2s the second angular moment is s (s - 1) / ((s + 1) (s + 2)).
    """
    s = 10.0
    spread = realised(spreading=ow.Spreading("cos_2s", s))
    long = realised()
    z = np.array([-5.0])
    x, y, up = np.sum(np.abs(spread.velocity(z)) ** 2, axis=(1, 2))
    whole, nothing, same = np.sum(np.abs(long.velocity(z)) ** 2, axis=(1, 2))
    assert nothing == 0
    assert up == pytest.approx(same, rel=1e-12)
    assert x + y == pytest.approx(whole, rel=1e-12)
    second = s * (s - 1) / ((s + 1) * (s + 2))
    assert (x - y) / whole == pytest.approx(second, abs=0.03)


# Waves carried by a current


def test_encounter_frequency() -> None:
    """Every component obeys (omega - k U cos)^2 = g k tanh kh with the current along it."""
    current = ow.PowerLawCurrent(1.4, 60.0)
    waves = realised(
        direction_deg=20.0, doppler=True, current=current, spreading=ow.Spreading("cos_2s", 12.0)
    )
    # the mean of (1 + z/h)^(1/7) over the depth is 7/8, to 2e-4 by quadrature
    along = 1.4 * 7 / 8 * np.cos(waves.direction - np.radians(60.0))
    own = waves.omega - waves.wave_number * along
    k = waves.wave_number
    assert_allclose(own**2, GRAVITY * k * np.tanh(k * DEPTH), rtol=5e-4)
    assert np.all(own > 0)
    still = wave_number(waves.omega, DEPTH, GRAVITY)
    assert np.max(np.abs(k / still - 1)) > 0.1
    assert_allclose(waves.intrinsic_omega, own, rtol=5e-4)


def test_surface_moves_with_water_that_flows() -> None:
    """At z = 0 the vertical velocity is the rate of the surface for one who drifts along."""
    waves = ow.RegularWaves(2.0, 8.0, 180.0, doppler=True, current=ow.UniformCurrent(1.0)).waves(
        DEPTH, GRAVITY
    )
    assert waves.omega[0] == pytest.approx(2 * np.pi / 8)
    assert waves.wave_number[0] > wave_number(waves.omega, DEPTH, GRAVITY)[0]
    vertical = waves.velocity(np.array([0.0]))[2, 0]
    drift = 1j * (waves.omega + waves.wave_number * 1.0) * waves.elevation
    assert_allclose(vertical, drift, rtol=1e-12)
    acceleration = waves.acceleration(np.array([0.0]))[2, 0]
    assert_allclose(acceleration, 1j * (waves.omega + waves.wave_number) * vertical, rtol=1e-12)


def test_a_current_across_changes_nothing() -> None:
    """It has no part along the waves; without ``doppler`` no current has an effect on them."""
    plain = realised()
    across = realised(doppler=True, current=ow.UniformCurrent(2.0, 90.0))
    assert_allclose(across.wave_number, plain.wave_number, rtol=1e-12)
    carried = realised(current=ow.UniformCurrent(2.0, 0.0))
    assert np.array_equal(carried.wave_number, plain.wave_number)


def test_blocked_waves_are_left_out_and_reported() -> None:
    """Above the blocking frequency nothing is left; all draws below it are those of the whole sea."""
    against = sea(doppler=True, current=ow.UniformCurrent(1.6, 180.0))
    waves, plain = against.waves(DEPTH, GRAVITY), realised()
    kept = len(waves.harmonic)
    assert 0 < kept < len(plain.harmonic)
    assert np.array_equal(waves.elevation, plain.elevation[:kept])
    lost = np.abs(plain.elevation[kept:]) ** 2
    share = np.sum(lost) / np.sum(np.abs(plain.elevation) ** 2)
    assert waves.blocked == pytest.approx(share, rel=1e-9)
    assert any("blocks" in text for text in against.cautions(waves))
    assert not any("blocks" in text for text in sea().cautions(plain))
    # deep water: blocked from omega = g / (4 U) on
    assert waves.omega[-1] == pytest.approx(GRAVITY / (4 * 1.6), rel=0.01)


def test_a_current_that_blocks_the_sea() -> None:
    """More than a twentieth of the variance is refused, for regular waves as well."""
    for waves in (
        sea(doppler=True, current=ow.UniformCurrent(3.5, 180.0)),
        ow.RegularWaves(1.0, 4.0, doppler=True, current=ow.UniformCurrent(4.0, 180.0)),
    ):
        with pytest.raises(ow.InputError, match=r"blocks .* %"):
            waves.waves(DEPTH, GRAVITY)


# A crest at a moment


def test_the_crest_comes() -> None:
    """Height as asked for and slope zero, to rounding; curved downwards; nothing above it nearby."""
    for seed in (1, 2, 3):
        waves = realised(seed, amplitudes="random", crest=ow.Crest(6.5, 4000.0))
        now = np.array([4000.0])
        assert at(waves, now)[0] == pytest.approx(6.5, abs=1e-11)
        assert at(waves, now, 1)[0] == pytest.approx(0.0, abs=1e-11)
        assert at(waves, now, 2)[0] < 0
        near = at(waves, np.linspace(3999.0, 4001.0, 201))
        assert np.argmax(near) == 100


def test_the_crest_comes_in_short_crests_and_a_current() -> None:
    """Also where components were blocked, and each goes its own way."""
    waves = realised(
        2,
        spreading=ow.Spreading("cos_n", 4.0),
        doppler=True,
        current=ow.UniformCurrent(1.5, 180.0),
        crest=ow.Crest(5.5, 900.0),
    )
    assert waves.blocked > 0
    assert at(waves, np.array([900.0]))[0] == pytest.approx(5.5, abs=1e-11)
    assert at(waves, np.array([900.0]), 1)[0] == pytest.approx(0.0, abs=1e-11)


def test_mean_of_many_is_newwave() -> None:
    """Elevations about the crest average to its height times the autocovariance over m0.

    About it they scatter with variance m0 (1 - r^2 - r'^2 m0 / m2), at most m0.
    """
    target = sea(repeat_period=600.0)
    waves = target.waves(DEPTH, GRAVITY)
    v = np.abs(waves.elevation) ** 2 / 2
    m0, m2 = np.sum(v), np.sum(waves.omega**2 * v)
    lag = np.linspace(-30.0, 30.0, 41)
    cosine = np.cos(np.outer(lag, waves.omega)) @ v / m0
    count, time = 1500, 300.0 + lag
    turn = np.exp(1j * np.outer(time, waves.omega))
    draw = np.random.default_rng(4)
    surfaces = np.empty((count, len(lag)))
    for i in range(count):
        size = np.sqrt(2 * v * draw.standard_exponential(len(v)))
        phase = np.exp(1j * draw.uniform(0, 2 * np.pi, len(v)))
        random = replace(waves, elevation=size * phase)
        surfaces[i] = (turn @ with_crest(random, v, ow.Crest(7.0, 300.0)).elevation).real
    slope = np.sin(np.outer(lag, waves.omega)) @ (waves.omega * v) / m0
    spread = np.sqrt(np.maximum(m0 * (1 - cosine**2 - slope**2 * m0 / m2), 0.0))
    error = np.abs(np.mean(surfaces, axis=0) - 7.0 * cosine)
    assert np.all(error <= 3.5 * spread / np.sqrt(count) + 1e-9)
    assert_allclose(np.std(surfaces, axis=0), spread, atol=0.08 * np.sqrt(m0))
    # negative control: the plain seas do not average to it
    assert np.max(7.0 * np.abs(cosine)) > 20 * np.sqrt(m0 / count)


def test_far_from_the_crest_the_sea_is_the_same() -> None:
    """Minutes away the autocovariance has died out."""
    plain, with_one = (
        realised(amplitudes="random"),
        realised(amplitudes="random", crest=ow.Crest(7.0, 3000.0)),
    )
    far = np.linspace(3600.0, 5000.0, 300)
    assert_allclose(at(with_one, far), at(plain, far), atol=0.05)
    assert np.max(np.abs(at(with_one, far - 1100) - at(plain, far - 1100))) > 1


def test_crests_that_cannot_be() -> None:
    """Beyond twice Hs, outside the repeat period, or where the surface would be a trough."""
    with pytest.raises(ow.InputError, match="twice the significant height"):
        realised(crest=ow.Crest(12.5, 100.0))
    with pytest.raises(ow.InputError, match="crest"):
        realised(crest=ow.Crest(5.0, 20000.0))
    waves = realised(repeat_period=1800.0)
    v = np.abs(waves.elevation) ** 2 / 2
    time = np.arange(0.0, 1500.0, 1.0)
    # what is left of the curvature once the surface is lifted by the spectrum's own shape
    bend = at(waves, time, 2) + at(waves, time) * np.sum(waves.omega**2 * v) / np.sum(v)
    low = ow.Crest(0.01, float(time[np.argmax(bend)]))
    with pytest.raises(ow.InputError, match="higher crest"):
        with_crest(waves, v, low)
    high = with_crest(waves, v, low.replace(height=9.0))
    assert at(high, np.array([low.time]), 2)[0] < 0


def test_whole_spectrum_at_another_depth() -> None:
    """JONSWAP's density does not know the depth."""
    f = np.array([0.08, 0.1, 0.2])
    spectrum = ow.JonswapSpectrum(6.0, 10.0, 3.3)
    assert_allclose(spectrum.density(f, 8.0, GRAVITY), jonswap(f, 6.0, 10.0, 3.3), rtol=0)


def test_seas_in_words() -> None:
    """The description contains every option given, and no other."""
    assert sea().in_words == "JONSWAP (gamma 3.3) waves, Hs 6 m, Tp 10 s"
    reported = sea(
        amplitudes="random",
        spreading=ow.Spreading("cos_2s", 8.0),
        doppler=True,
        current=ow.UniformCurrent(0.5),
        crest=ow.Crest(5.0, 20.0),
    ).in_words
    assert reported == (
        "JONSWAP (gamma 3.3) waves, Hs 6 m, Tp 10 s, carried by the current, random amplitudes, "
        "spread by cos^2s(theta/2), s = 8, a crest of 5 m at 20 s"
    )
    noise = ow.IrregularWaves(spectrum=ow.WhiteNoise(2.0, 0.1, 0.5), seed=1, repeat_period=600.0)
    assert noise.in_words == "white noise from 0.1 to 0.5 Hz, Hs 2 m"
