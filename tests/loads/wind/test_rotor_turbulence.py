"""The wind that a turning rotor averages, against independent quadratures and limits."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.definitions.rotor_disc import RotorDisc, rotor_disc
from offwind_pin.loads.wind import rotor_effective_wind as rotor_turbulence
from offwind_pin.loads.wind.rotor_effective_wind import (
    HIGHEST_ORDER,
    RotorTurbulence,
    RotorWind,
    Turbulence,
    normal_turbulence,
    scale_parameter,
)

MEAN, DEVIATION, RADIUS, BLADES, SPEED = 9.0, 1.3, 98.5, 3, 0.9
AIR = Turbulence(MEAN, DEVIATION, 42.0)
ROTOR = RotorTurbulence(AIR, RADIUS, BLADES, SPEED, root=0.0)
WIDE = np.geomspace(1e-7, 1e3, 3000)
PERIOD = 600.0
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(1000)


@pytest.fixture(scope="module")
def disc(oc6: ow.Turbine) -> RotorDisc:
    return rotor_disc(oc6)


def integral(spectrum: Array) -> float:
    return float(np.trapezoid(spectrum * WIDE, np.log(WIDE)))


def test_kaimal_holds_the_variance() -> None:
    """The point spectrum integrates to sigma^2; its tail falls with f^(-5/3)."""
    tail = 4 * (AIR.length / MEAN) ** (-2 / 3) / 6 ** (5 / 3) * 1.5 * WIDE[-1] ** (-2 / 3)
    assert integral(AIR.spectrum(WIDE)) / DEVIATION**2 + tail == pytest.approx(1, abs=1e-4)
    assert AIR.spectrum(np.array([2e3]))[0] / AIR.spectrum(np.array([1e3]))[0] == pytest.approx(
        2 ** (-5 / 3), rel=1e-3
    )


def test_coherence_of_the_standard() -> None:
    """exp(-12 hypot(f d / V, 0.12 d / L)) by hand, 50 m apart: 0.8092 at rest, 0.00127 at 0.1 Hz."""
    apart = np.array([50.0])
    assert AIR.coherence(0.0, apart)[0] == pytest.approx(np.exp(-0.211640), rel=1e-5)
    assert AIR.coherence(0.1, apart)[0] == pytest.approx(1.2685e-3, rel=1e-3)
    assert AIR.coherence(0.1, np.zeros(1))[0] == 1


def test_numbers_of_the_standard() -> None:
    """Class B at 15 m/s has 14 %, 1.18 times that at 10 m/s, and 42 m above 60 m."""
    assert normal_turbulence(15.0, "B") / 15 == pytest.approx(0.14 * (0.75 + 5.6 / 15))
    assert normal_turbulence(10.0, "A") == pytest.approx(0.16 * 13.1)
    assert scale_parameter(119.0) == 42.0
    assert scale_parameter(30.0) == 21.0
    with pytest.raises(ow.InputError, match="A, B or C"):
        normal_turbulence(10.0, "D")


def over_the_disc(frequency: float) -> float:
    """Mean coherence of two random points of a disc, from the density of their distance.

    p(d) = 4 d / (pi R^2) arccos(d / 2R) - 2 d^2 / (pi R^3) sqrt(1 - d^2 / 4R^2): disc line picking.
    """
    t = (POINTS + 1) / 2
    d, part = 2 * RADIUS * t**4, WEIGHTS / 2 * 8 * RADIUS * t**3
    density = 4 * d / (np.pi * RADIUS**2) * np.arccos(d / (2 * RADIUS))
    density -= 2 * d**2 / (np.pi * RADIUS**3) * np.sqrt(1 - d**2 / (4 * RADIUS**2))
    return float(np.sum(part * density * AIR.coherence(frequency, d)))


def test_average_over_the_disc() -> None:
    """The zeroth harmonic is the average over the disc, whose distances have a known density."""
    frequency = np.array([1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0])
    expected = [over_the_disc(f) for f in frequency]
    assert_allclose(ROTOR.averaging(frequency, 0), expected, rtol=1e-3)
    assert_allclose(ROTOR.averaging(frequency[:3], 0), expected[:3], rtol=1e-9)


def test_variance_of_the_rotor_average() -> None:
    """The same for the variance, interpolation between the computed frequencies included."""
    inside = np.geomspace(1e-5, 5.0, 400)
    by_distance = AIR.spectrum(inside) * [over_the_disc(f) for f in inside]
    expected = np.trapezoid(by_distance * inside, np.log(inside))
    found = np.trapezoid(ROTOR.harmonic_spectrum(inside, 0) * inside, np.log(inside))
    assert found == pytest.approx(expected, rel=2e-3)
    assert 0.3 < found / DEVIATION**2 < 0.5


def test_tiny_rotor_feels_the_point_spectrum() -> None:
    """A rotor smaller than every eddy takes the whole wind in its zeroth harmonic."""
    tiny = RotorTurbulence(AIR, 0.01, BLADES, SPEED, root=0.0)
    frequency = np.array([1e-3, 0.03, 1.0])
    assert_allclose(tiny.thrust_spectrum(frequency), AIR.spectrum(frequency), rtol=0.03)
    assert_allclose(tiny.averaging(frequency, 0), 1, rtol=0.02)
    assert np.all(tiny.averaging(frequency, 3) < 2e-3)


def along_a_blade(frequency: float) -> float:
    """Mean coherence of two points of one blade; the inner integral over the radius is done by hand."""

    def at(d: float) -> float:
        pairs = (RADIUS**3 - d**3) / 3 - d * (RADIUS**2 - d**2) / 2
        return 8 / RADIUS**4 * pairs * float(AIR.coherence(frequency, np.array(d)))

    return float(quad(at, 0, RADIUS, epsrel=1e-10)[0])


def test_harmonics_hold_the_variance_of_the_blade(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over all n, F_n sums to the coherence along one blade: a Fourier series at its origin."""
    monkeypatch.setattr(rotor_turbulence, "_ANGLES", 200)
    for f in (1e-3, 0.01, 0.03):
        share = np.array([ROTOR.averaging(np.array([f]), n)[0] for n in range(31)])
        # Terms fall like n^-3, so that the rest behind N is N / 2 times the N-th, on either side.
        total = share[0] + 2 * np.sum(share[1:]) + 30 * share[30]
        assert total == pytest.approx(along_a_blade(f), rel=2e-3)
        assert share[0] < 0.9 * total


def test_ring_conserves_the_point_variance() -> None:
    """Where all thrust sits at one radius the harmonics sum to the variance of the wind itself."""
    ring = RotorTurbulence(AIR, RADIUS, BLADES, SPEED, root=0.9999 * RADIUS)
    f = np.array([3e-3])
    share = np.array([ring.averaging(f, n)[0] for n in range(25)])
    # A cusp's terms fall like n^-2: the rest behind N is N times the N-th, on either side.
    assert share[0] + 2 * np.sum(share[1:]) + 2 * 24 * share[24] == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("speed", [SPEED, 0.01])
def test_blades_keep_the_variance_of_their_harmonics(speed: float) -> None:
    """Shifting moves energy along the frequency and loses none of it, folded at zero or not."""
    grid = np.arange(0.5, 40000) * 1e-4
    rotor = replace(ROTOR, rotor_speed=speed)
    found = np.sum(rotor.thrust_spectrum(grid)) * 1e-4
    one_sided = [
        np.trapezoid(ROTOR.harmonic_spectrum(WIDE, k * BLADES) * WIDE, np.log(WIDE))
        for k in range(HIGHEST_ORDER + 1)
    ]
    assert found == pytest.approx(one_sided[0] + 2 * sum(one_sided[1:]), rel=5e-3)


def test_peaks_at_3p_6p_9p() -> None:
    """The spectrum peaks at multiples of the blade-passing frequency, each lower than the last."""
    passing = ROTOR.blade_passing_frequency
    at = passing * np.arange(1, 4)
    peak = ROTOR.thrust_spectrum(at)
    between = ROTOR.thrust_spectrum(at + passing / 2)
    before = ROTOR.thrust_spectrum(at - passing / 2)
    assert np.all(peak > 20 * between)
    assert np.all(peak > 20 * before)
    assert np.all(np.diff(peak) < 0)
    odd = ROTOR.thrust_spectrum(np.array([SPEED / (2 * np.pi), 2 * SPEED / (2 * np.pi)]))
    assert np.all(odd < peak[2])


def test_a_still_rotor_has_no_peaks() -> None:
    """Negative control: without rotation the shifts vanish."""
    still = RotorTurbulence(AIR, RADIUS, BLADES, 1e-9, root=0.0)
    frequency = np.geomspace(0.05, 3.0, 200)
    assert np.all(np.diff(still.thrust_spectrum(frequency)) < 0)


def test_history_has_the_spectrum(disc: RotorDisc) -> None:
    """Without shear and shadow the variance is that of the spectrum's lines, line by line."""
    wind = RotorWind(MEAN, 0.14, shear_exponent=0.0, tower_shadow=False, seed=5)
    history = wind.generate(disc, repeat_period=PERIOD)
    assert history.speed.mean() == pytest.approx(MEAN, rel=1e-12)
    lines = np.abs(np.fft.rfft(history.speed)[1:1201]) * 2 / len(history.speed)
    frequency = np.arange(1, 1201) / PERIOD
    expected = wind.of_rotor(disc).thrust_spectrum(frequency)
    assert_allclose(lines**2 / 2 * PERIOD, expected, rtol=1e-6)


def test_shear_of_the_first_order_averages_out(disc: RotorDisc) -> None:
    """A linear shear gives three blades the same sum at every azimuth; a curved one does not."""
    calm = {"turbulence_intensity": 0.0, "tower_shadow": False}
    straight = RotorWind(MEAN, shear_exponent=1.0, **calm).tones(disc)  # type: ignore[arg-type]
    curved = RotorWind(MEAN, shear_exponent=0.14, **calm).tones(disc)  # type: ignore[arg-type]
    none = RotorWind(MEAN, shear_exponent=0.0, **calm).tones(disc)  # type: ignore[arg-type]
    assert np.all(np.abs(straight) < 1e-12)
    assert np.all(np.abs(none) < 1e-12)
    assert np.abs(curved[0]) > 1e-3


def test_tower_slows_the_blade_before_it(disc: RotorDisc) -> None:
    """The blades' wind is least when one hangs down before the tower, half a third of a turn on."""
    wind = RotorWind(MEAN, 0.0, shear_exponent=0.0)
    tones = wind.tones(disc)
    turn = 2 * np.pi * np.arange(360) / 360
    sampled = sum(np.real(c * np.exp(3j * (k + 1) * turn)) for k, c in enumerate(tones))
    assert np.degrees(turn[np.argmin(np.asarray(sampled)[:120])]) == pytest.approx(60, abs=1)
    history = wind.generate(disc, repeat_period=PERIOD)
    assert np.std(history.speed) == pytest.approx(np.sqrt(np.sum(np.abs(tones) ** 2) / 2), rel=1e-9)


def test_seed_and_period(disc: RotorDisc) -> None:
    """One seed, one wind; another one differs; the wind repeats after its period."""
    one, same, other = (
        RotorWind(MEAN, 0.1, seed=seed).generate(disc, repeat_period=100.0) for seed in (1, 1, 2)
    )
    assert_allclose(one.speed, same.speed, rtol=0)
    assert np.max(np.abs(one.speed - other.speed)) > 0.1
    time = np.linspace(0, 100, 37)
    assert_allclose(one.at(time), one.at(time + one.period), rtol=1e-9)
    assert "seed 1" in one.origin


@pytest.mark.parametrize(
    ("dt", "period"), [(0.3, 100.0), (0.0, 100.0), (0.02, 1.0), (0.02, float("nan"))]
)
def test_sampling_that_cannot_hold_the_wind(disc: RotorDisc, dt: float, period: float) -> None:
    """A step too coarse for 12P, or a period in which no blade passes, is refused."""
    with pytest.raises(ow.InputError, match="rotor wind"):
        RotorWind(MEAN, 0.1).generate(disc, repeat_period=period, dt=dt)


def test_blades_through_a_field_in_space() -> None:
    """A second implementation: a field at fixed points of a ring, through which three blades turn.

    The points are made coherent by the Cholesky factor of their cross spectra, as Veers (1988) does;
    the blades step from point to point. Over 200 fields the bands about 0P, 3P and 6P, and between
    them, hold what the shifted harmonics say. A field has no line at zero frequency, and so none at
    the very multiples of 3P.
    """
    around, step, period, fields, radius = 96, 0.05, 240.0, 200, 24.0
    ring = RotorTurbulence(AIR, radius, BLADES, 2 * np.pi / (around * step), root=0.9999 * radius)
    steps, count = round(period / step), round(1.2 * period)
    frequency = np.arange(1, count + 1) / period
    apart = 2 * radius * np.abs(np.sin(np.pi * np.arange(around) / around))
    between = apart[(np.arange(around)[:, None] - np.arange(around)) % around]
    cross = AIR.coherence(frequency[:, None, None], between[None])
    factor = np.linalg.cholesky(cross + 1e-9 * np.eye(around))
    amplitude = np.sqrt(AIR.spectrum(frequency) / period)[:, None]
    rng = np.random.default_rng(7)
    blade = (np.arange(steps)[:, None] + around // BLADES * np.arange(BLADES)) % around
    density = np.zeros(steps // 2 + 1)
    for _ in range(fields):
        noise = rng.normal(size=(2, count, around))
        drawn = np.einsum("fij,fj->fi", factor, noise[0] + 1j * noise[1])
        lines = np.zeros((steps // 2 + 1, around), dtype=complex)
        lines[1 : count + 1] = steps / 2 * amplitude * drawn
        field = np.fft.irfft(lines, n=steps, axis=0)
        met = field[np.arange(steps)[:, None], blade].mean(axis=1)
        density += np.abs(np.fft.rfft(met)) ** 2 * 2 * step / steps / fields
    order = np.arange(1, steps // 2 + 1) / (period * ring.blade_passing_frequency)
    predicted = ring.thrust_spectrum(order * ring.blade_passing_frequency)
    for low, high, noise_left in [
        (0.0, 0.1, 0.1),
        (0.1, 0.9, 0.04),
        (0.9, 1.1, 0.04),
        (1.1, 1.9, 0.04),
        (1.9, 2.1, 0.04),
    ]:
        band = (order > low) & (order <= high) & (np.abs(order - np.round(order)) > 1e-9)
        ratio = np.sum(density[1:][band]) / np.sum(predicted[band])
        assert ratio == pytest.approx(1.0, abs=noise_left)
    peak = np.abs(order - 1) < 0.1
    straight = ring.harmonic_spectrum(order[peak] * ring.blade_passing_frequency, 0)
    assert np.sum(straight) < 0.5 * np.sum(predicted[peak])
