"""The Pierson-Moskowitz spectrum and the sea made from it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from offwind_pin.loads.waves import IrregularSea, pierson_moskowitz


def sea(seed: int = 1, repeat_period: float = 600.0) -> IrregularSea:
    """The sea of LC 5.1."""
    return IrregularSea.pierson_moskowitz(
        1.25, 5.5, depth=30.0, gravity=9.80665, repeat_period=repeat_period, seed=seed
    )


def test_area_is_the_variance() -> None:
    """The area under the spectrum is Hs^2 / 16."""
    area = sum(
        quad(lambda f: float(pierson_moskowitz(np.array(f), 1.25, 5.5)), low, high, epsabs=1e-14)[0]
        for low, high in ((0.02, 0.2), (0.2, 1.0), (1.0, np.inf))
    )
    assert area == pytest.approx(1.25**2 / 16, rel=1e-9)


def test_peak_is_at_the_peak_frequency() -> None:
    """The spectrum is stationary at 1 / Tp and falls on both sides."""
    f = np.array([0.999, 1.0, 1.001]) / 5.5
    density = pierson_moskowitz(f, 1.25, 5.5)
    assert density[1] > density[0]
    assert density[1] > density[2]


def test_elevation_variance_is_half_the_sum_of_squares() -> None:
    """Over one period of the sea the components are orthogonal: the variance is sum a^2 / 2."""
    waves = sea()
    elevation = waves.elevation(np.arange(0, 600.0, 0.25))
    assert np.var(elevation) == pytest.approx(np.sum(waves.amplitude**2) / 2, rel=1e-10)
    assert np.mean(elevation) == pytest.approx(0.0, abs=1e-12)


def test_realised_height_and_period() -> None:
    """The band kept holds 99.8 % of the variance; the largest component is next to the peak."""
    waves = sea()
    held = np.exp(-1.25 / 5**4) - np.exp(-1.25 / 0.4**4)
    assert waves.significant_height == pytest.approx(1.25 * np.sqrt(held), rel=1e-4)
    assert 1 / waves.peak_period == pytest.approx(1 / 5.5, abs=0.5 / 600)


def test_seed_sets_the_phases_alone() -> None:
    """The same seed gives the same sea; another gives the same amplitudes at other phases."""
    one, same, other = sea(1), sea(1), sea(2)
    assert_allclose(one.phase, same.phase, rtol=0)
    assert_allclose(one.amplitude, other.amplitude, rtol=0)
    assert np.max(np.abs(one.phase - other.phase)) > 1


def test_sea_repeats_itself() -> None:
    """All components are harmonics of one period."""
    waves, time = sea(), np.linspace(0, 50, 101)
    assert_allclose(waves.elevation(time + 600.0), waves.elevation(time), atol=1e-10)
