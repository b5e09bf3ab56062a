"""Wave spectra and the irregular seas made from them."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad, trapezoid

import offwind_pin as ow
from offwind_pin.loads.sea.waves.dispersion import wave_number
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import (
    depth_factor,
    iec_peak_shape,
    jonswap,
    pierson_moskowitz,
)
from offwind_pin.loads.sea.waves.statistics import moments

GRAVITY = 9.80665


def moment(shape: float, order: int, edges: tuple[float, ...]) -> float:
    """Spectral moment of a sea of 1.25 m and 5.5 s in m2 Hz^order, between frequencies in Hz."""

    def density(f: float) -> float:
        return f**order * float(jonswap(np.array(f), 1.25, 5.5, shape))

    return sum(
        quad(density, low, high, epsabs=1e-14, limit=200)[0]
        for low, high in itertools.pairwise(edges)
    )


def area(shape: float) -> float:
    """The variance, of all waves, in m2."""
    return moment(shape, 0, (0.02, 1 / 5.5, 0.4, 1.0, np.inf))


def sea(seed: int = 1, period: float = 600.0, **more: Any) -> LinearWaves:
    """The sea of LC 5.1, if not said otherwise."""
    return ow.IrregularWaves(1.25, 5.5, seed=seed, repeat_period=period, **more).waves(
        30.0, 9.80665
    )


def test_area_is_the_variance() -> None:
    """Hs^2 / 16 exactly for Pierson and Moskowitz, within the stated 1 and 3 % for JONSWAP."""
    assert area(1.0) == pytest.approx(1.25**2 / 16, rel=1e-9)
    for shape in (1.5, 3.3, 5.0):
        assert area(shape) == pytest.approx(1.25**2 / 16, rel=0.01)
    assert area(7.0) == pytest.approx(1.25**2 / 16, rel=0.03)


def test_peak() -> None:
    """Stationary at 1 / Tp, and there gamma times the level as high as without."""
    f = np.array([0.999, 1.0, 1.001]) / 5.5
    for shape in (1.0, 3.3):
        density = jonswap(f, 1.25, 5.5, shape)
        assert density[1] > density[0]
        assert density[1] > density[2]
    flat = pierson_moskowitz(f[1:2], 1.25, 5.5)
    assert density[1] / flat[0] == pytest.approx(3.3 * (1 - 0.287 * np.log(3.3)))


def test_shape_by_steepness() -> None:
    """IEC's three branches, continuous within 1 % where they meet."""
    assert iec_peak_shape(9.0, 9.0) == 5.0
    assert iec_peak_shape(1.0, 6.0) == 1.0
    assert iec_peak_shape(1.0, 4.3) == pytest.approx(np.exp(5.75 - 1.15 * 4.3))
    assert iec_peak_shape(1.0, 3.6001) == pytest.approx(5.0, rel=0.01)
    assert iec_peak_shape(1.0, 4.9999) == pytest.approx(1.0, rel=0.01)
    steep = ow.IrregularWaves(9.0, 9.0, seed=1, repeat_period=600.0, peak_shape="iec")
    assert isinstance(steep.target, ow.JonswapSpectrum)
    assert steep.target.shape == 5.0
    assert "JONSWAP (gamma 5)" in steep.in_words


def test_elevation_variance_is_half_the_sum_of_squares() -> None:
    """Over one period of the sea the components are orthogonal: the variance is sum a^2 / 2."""
    waves, time = sea(), np.arange(0, 600.0, 0.25)
    elevation = (np.exp(1j * np.outer(time, waves.omega)) @ waves.elevation).real
    variance = np.sum(np.abs(waves.elevation) ** 2) / 2
    assert np.var(elevation) == pytest.approx(variance, rel=1e-10)
    assert np.mean(elevation) == pytest.approx(0.0, abs=1e-12)


def test_three_hours_hold_the_spectrum() -> None:
    """Deterministic amplitudes: m0 and m2 of the kept band to the rule of equal steps; Hs with it."""
    waves = sea(period=10800.0, peak_shape=3.3)
    frequency, square = waves.harmonic / 10800.0, np.abs(waves.elevation) ** 2 / 2
    low, high = 0.4 / 5.5, 5 / 5.5
    for order in (0, 2):
        held = moment(3.3, order, (low, 1 / 5.5, 0.4, high))
        assert np.sum(frequency**order * square) == pytest.approx(held, rel=2e-4)
    assert 4 * np.sqrt(np.sum(square)) == pytest.approx(1.25, rel=5e-3)


def test_realised_height_and_period() -> None:
    """The band kept holds 99.8 % of the variance; the largest component is next to the peak."""
    waves = sea()
    held = np.exp(-1.25 / 5**4) - np.exp(-1.25 / 0.4**4)
    height = 4 * np.sqrt(np.sum(np.abs(waves.elevation) ** 2) / 2)
    assert height == pytest.approx(1.25 * np.sqrt(held), rel=1e-4)
    largest = waves.harmonic[np.argmax(np.abs(waves.elevation))] / 600.0
    assert largest == pytest.approx(1 / 5.5, abs=0.5 / 600)


def test_seed_sets_the_phases_alone() -> None:
    """The same seed gives the same sea; another gives the same amplitudes at other phases."""
    one, same, other = sea(1), sea(1), sea(2)
    assert np.array_equal(one.elevation, same.elevation)
    assert_allclose(np.abs(one.elevation), np.abs(other.elevation), rtol=1e-14)
    assert np.max(np.abs(np.angle(one.elevation / other.elevation))) > 1


def test_draws_are_pinned() -> None:
    """LC 5.1's phases are the first draws of its seed, its amplitudes those of the spectrum.

    Whatever options are added, published results stay.
    """
    waves, period = sea(seed=1), 600.0
    harmonic = np.arange(44, 546)
    assert np.array_equal(waves.harmonic, harmonic)
    phase = np.random.default_rng((1, 1)).uniform(0, 2 * np.pi, len(harmonic))
    density = jonswap(harmonic / period, 1.25, 5.5, 1.0)
    assert_allclose(
        waves.elevation, np.sqrt(2 * density / period) * np.exp(-1j * phase), rtol=1e-12
    )
    assert waves.elevation[100] == pytest.approx(0.008961612148991153 + 0.03741093582958593j)


def test_direction_turns_all_components() -> None:
    """Towards +y there is nothing along x."""
    velocity = sea(direction_deg=90.0).velocity(np.array([-3.0]))
    straight = sea().velocity(np.array([-3.0]))
    assert_allclose(velocity[1], straight[0], rtol=1e-12)
    assert np.max(np.abs(velocity[0])) < 1e-12


def test_depth_factor_by_its_definition() -> None:
    """(k^-3 dk/domega) over that of deep water, with dk/domega by differences of the dispersion."""
    f, step = np.array([0.03, 0.08, 0.15, 0.4]), 1e-6

    def number(frequency: Any) -> Any:
        return wave_number(2 * np.pi * frequency, 18.0, GRAVITY)

    rate = (number(f + step) - number(f - step)) / (4 * np.pi * step)
    omega = 2 * np.pi * f
    deep = (omega**2 / GRAVITY) ** -3 * 2 * omega / GRAVITY
    assert_allclose(depth_factor(f, 18.0, GRAVITY), number(f) ** -3 * rate / deep, rtol=1e-7)


def test_depth_factor_in_deep_and_shallow_water() -> None:
    """1 where the bottom is out of reach; omega^2 h / (2 g) where the waves are long."""
    assert_allclose(depth_factor(np.array([0.2, 2.0]), 2000.0, GRAVITY), 1.0, rtol=1e-12)
    f = np.array([1e-3, 2e-3])
    small = (2 * np.pi * f) ** 2 * 5.0 / (2 * GRAVITY)
    assert_allclose(depth_factor(f, 5.0, GRAVITY), small, rtol=1e-3)


def test_tma_keeps_the_height() -> None:
    """Its area is that of the JONSWAP spectrum of the same height, at 15 m as at 3000 m."""
    spectrum = ow.TmaSpectrum(6.0, 10.0, 3.3)
    f = np.linspace(0.02, 4.0, 400001)
    whole = trapezoid(jonswap(f, 6.0, 10.0, 3.3), f)
    for depth in (15.0, 30.0, 3000.0):
        assert trapezoid(spectrum.density(f, depth, GRAVITY), f) == pytest.approx(whole, rel=2e-5)
    assert not np.allclose(spectrum.density(f, 15.0, GRAVITY), jonswap(f, 6.0, 10.0, 3.3), rtol=0.1)


def test_tma_is_the_depth_factor_times_jonswap() -> None:
    """Their ratio is the same at all frequencies; in deep water it is 1."""
    spectrum, f = ow.TmaSpectrum(6.0, 10.0, 3.3), np.linspace(0.05, 0.5, 60)
    parent = jonswap(f, 6.0, 10.0, 3.3)
    ratio = spectrum.density(f, 15.0, GRAVITY) / (parent * depth_factor(f, 15.0, GRAVITY))
    assert_allclose(ratio, ratio[0], rtol=1e-12)
    assert ratio[0] > 1.2
    assert_allclose(spectrum.density(f, 5000.0, GRAVITY), parent, rtol=1e-12)


def test_tma_sea_has_its_height() -> None:
    """A realised sea in 15 m of water holds the height asked for, less what the band cuts off."""
    waves = ow.IrregularWaves(
        spectrum=ow.TmaSpectrum(3.0, 9.0, 3.3), seed=1, repeat_period=3600.0
    ).waves(15.0, GRAVITY)
    assert moments(waves).significant_height == pytest.approx(3.0, rel=0.01)
    assert 8.4 < moments(waves).peak_period < 9.05


def test_white_noise_is_flat() -> None:
    """All components are alike, on the ends of the band as well, and hold the height asked for."""
    noise = ow.IrregularWaves(
        spectrum=ow.WhiteNoise(2.0, 0.05, 0.45), seed=2, repeat_period=3600.0
    ).waves(30.0, GRAVITY)
    assert noise.harmonic[0] == 180
    assert noise.harmonic[-1] == 1620
    variance = np.abs(noise.elevation) ** 2 / 2
    assert_allclose(variance, 2.0**2 / 16 / 0.4 / 3600, rtol=1e-12)
    # 1441 components stand at both ends of 1440 intervals
    assert 16 * np.sum(variance) == pytest.approx(4.0 * 1441 / 1440, rel=1e-12)


def test_table_gives_back_its_spectrum() -> None:
    """A fine table of JONSWAP's densities gives JONSWAP's sea; beyond the table there is nothing."""
    f = np.arange(0.04, 0.501, 0.001)
    density = jonswap(f, 3.0, 8.0, 3.3)
    table = ow.TableSpectrum(tuple(f), tuple(density))
    assert table.significant_height == pytest.approx(4 * np.sqrt(trapezoid(density, f)), rel=1e-12)
    assert table.peak_period == pytest.approx(8.0, rel=1e-9)
    assert np.all(table.density(np.array([0.03, 0.51]), 30.0, GRAVITY) == 0)
    mine = ow.IrregularWaves(spectrum=table, seed=1, repeat_period=1000.0).waves(30.0, GRAVITY)
    exact = jonswap(mine.harmonic / 1000.0, 3.0, 8.0, 3.3)
    assert_allclose(np.abs(mine.elevation) ** 2 / 2 * 1000.0, exact, rtol=1e-9)
    assert "SHA-256" in repr(table)
    assert repr(table) != repr(ow.TableSpectrum(tuple(f), tuple(2 * density)))
