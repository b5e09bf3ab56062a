"""Power spectral density, band area and peaks on signals of known content."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from offwind_pin.base.errors import InputError
from offwind_pin.signal.spectra import band_sum, peaks, power_spectral_density

STEP, SEGMENT = 0.05, 100.0
TIME = np.arange(0, 1000.0, STEP)


def tone(frequency: float, amplitude: float) -> np.ndarray:
    return amplitude * np.sin(2 * np.pi * frequency * TIME + 0.4)


def test_tone_has_its_variance() -> None:
    """A sine of amplitude A on a line of the segment holds A^2 / 2, exactly (Parseval)."""
    frequency, density = power_spectral_density(7.0 + tone(0.3, 2.0), STEP, SEGMENT)
    assert density.sum() * frequency[1] == pytest.approx(2.0**2 / 2, rel=1e-10)
    assert frequency[np.argmax(density)] == pytest.approx(0.3, abs=1e-12)


def test_integral_is_the_variance_of_noise() -> None:
    """For white noise the area is the variance; 19 half-overlapped segments scatter by 1 %."""
    values = np.random.default_rng(5).normal(0, 3.0, len(TIME))
    frequency, density = power_spectral_density(values, STEP, SEGMENT)
    assert density.sum() * frequency[1] == pytest.approx(np.var(values), rel=0.03)
    # One-sided: the level is sigma^2 over half the sampling rate, not over the whole.
    assert np.mean(density) == pytest.approx(9.0 / (0.5 / STEP), rel=0.03)


def test_density_does_not_depend_on_the_segment() -> None:
    """A PSD is per hertz: the level of noise stays when the segment changes."""
    values = np.random.default_rng(6).normal(0, 1.0, len(TIME))
    levels = [np.mean(power_spectral_density(values, STEP, s)[1]) for s in (50.0, 200.0)]
    assert levels[0] == pytest.approx(levels[1], rel=0.05)


def test_segment_longer_than_the_signal_is_refused() -> None:
    """Too short a signal is reported, with its length."""
    with pytest.raises(InputError, match="segment"):
        power_spectral_density(TIME[:100], STEP, SEGMENT)


def test_band_sum_of_a_straight_line() -> None:
    """The trapezoid is exact for a linear density, with ends between the lines."""
    frequency = np.linspace(0, 2, 21)
    area = band_sum(frequency, 3 * frequency, 0.123, 1.777)
    assert area == pytest.approx(1.5 * (1.777**2 - 0.123**2), rel=1e-13)


def test_band_sums_add_up() -> None:
    """Neighbouring bands share no area and leave none out."""
    frequency, density = power_spectral_density(tone(0.25, 1.0) + tone(1.1, 0.2), STEP, SEGMENT)
    parts = band_sum(frequency, density, 0.1, 0.6) + band_sum(frequency, density, 0.6, 1.5)
    assert parts == pytest.approx(band_sum(frequency, density, 0.1, 1.5), rel=1e-12)
    assert band_sum(frequency, density, 0.2, 0.3) == pytest.approx(0.5, rel=1e-6)
    assert band_sum(frequency, density, 1.0, 1.2) == pytest.approx(0.02, rel=1e-6)


def test_band_narrower_than_a_line() -> None:
    """A band between two lines has the interpolated area."""
    area = band_sum(np.array([0.0, 1.0]), np.array([2.0, 4.0]), 0.25, 0.75)
    assert area == pytest.approx(1.5, rel=1e-14)


def resonance(frequency: np.ndarray, places: list[float]) -> np.ndarray:
    """Sum of squared resonance curves of 1 % damping."""
    return sum(1 / ((1 - (frequency / p) ** 2) ** 2 + (0.02 * frequency / p) ** 2) for p in places)


def test_peaks_are_found_between_lines() -> None:
    """Two resonances off the grid are placed to a fifth of a line."""
    frequency = np.arange(0, 3, 0.005)
    found = peaks(frequency, resonance(frequency, [0.2361, 1.1372]), 0.1, 2.0)
    assert_allclose(found, [0.2361, 1.1372], atol=0.001)


def test_peaks_outside_the_band_are_left_out() -> None:
    """Only the band asked for is searched."""
    frequency = np.arange(0, 3, 0.005)
    density = resonance(frequency, [0.2361, 1.1372])
    assert len(peaks(frequency, density, 0.5, 2.0)) == 1
    assert peaks(frequency, density, 1.5, 2.0) == []


def test_ripples_are_no_peaks() -> None:
    """A ripple of 1 dB is below the prominence, one of 6 dB above it."""
    frequency = np.arange(0.01, 1, 0.01)
    for decibels, count in ((1.0, 0), (6.0, 1)):
        bump = decibels * np.exp(-(((frequency - 0.5) / 0.05) ** 2))
        assert len(peaks(frequency, 10 ** (bump / 10), 0.1, 0.9)) == count


def test_empty_bands_of_the_density_are_bridged() -> None:
    """Zero density has no logarithm; it is no peak and no warning either."""
    frequency = np.arange(0.0, 1.0, 0.01)
    density = np.where(np.abs(frequency - 0.5) < 0.015, 1.0, 0.0)
    density[50] = 2.0
    assert_allclose(peaks(frequency, density, 0.1, 0.9), [0.5], atol=1e-9)


def test_flat_top_is_a_peak_at_its_middle() -> None:
    """A plateau of equal lines is one peak, without division by zero."""
    frequency = np.linspace(0, 1, 101)
    density = np.ones(101)
    density[40:43] = 10.0
    assert peaks(frequency, density, 0.0, 1.0) == pytest.approx([0.41])


@pytest.mark.parametrize("segment", [0.0, -1.0, 0.05, 200.0])
def test_segments_that_cannot_be_are_refused(segment: float) -> None:
    """Shorter than two samples or longer than the signal: refused with the limits."""
    with pytest.raises(InputError, match="segment"):
        power_spectral_density(np.zeros(1000), 0.1, segment)
