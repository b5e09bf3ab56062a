"""Damping out of the bell of one mode whose spectrum is known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import signal

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.cross_spectra import CrossSpectra
from offwind_pin.signal.modal_identification.enhanced_fdd import (
    Bell,
    correlation,
    mode_of_bell,
    single_mode_bell,
)
from offwind_pin.signal.modal_identification.fdd import singular_values

RATE = 20.0
FREQUENCY, RATIO = 0.6, 0.01
SHAPE = np.array([0.3, 1.0, -0.5])


def _true_correlation(lag: Array, frequency: float = FREQUENCY, ratio: float = RATIO) -> Array:
    """Of the acceleration of a lightly damped oscillator but for its phase: a decaying cosine."""
    omega = 2 * np.pi * frequency
    return np.exp(-ratio * omega * lag) * np.cos(omega * np.sqrt(1 - ratio**2) * lag)


def _expected_spectra(
    segment_s: float, frequency: float = FREQUENCY, ratio: float = RATIO
) -> CrossSpectra:
    """What Welch's method gives in expectation: the transform of correlation times window's own.

    Summed over all lags of the window, so that what wraps round is there too.
    """
    length = round(segment_s * RATE)
    window = signal.get_window("hann", length)
    own = np.correlate(window, window, "full")[length - 1 :] / np.sum(window**2)
    lag = np.arange(length)
    tapered = own * _true_correlation(lag / RATE, frequency, ratio)
    wrapped = tapered.copy()
    wrapped[1:] += tapered[:0:-1]
    density = np.maximum(np.fft.rfft(wrapped).real, 0.0) * 2 / RATE
    return CrossSpectra(
        frequency=np.arange(len(density)) * RATE / length,
        matrix=density[:, None, None] * np.outer(SHAPE, SHAPE).astype(complex),
        segments=100,
        averages=90.0,
        window=window,
        sample_rate=RATE,
        duration=50 * segment_s,
    )


def _bell(spectra: CrossSpectra, mac_limit: float = 0.8) -> tuple[Bell, float]:
    values, vectors = singular_values(spectra)
    peak = int(np.argmax(values[:, 0]))
    limits = (0, len(values) - 1)
    bell = single_mode_bell(values, vectors, peak, vectors[peak, :, 0], mac_limit, limits)
    return bell, float(spectra.frequency[peak])


@pytest.mark.parametrize("segment_s", [60.0, 167.0, 400.0])
def test_window_adds_no_damping(segment_s: float) -> None:
    """1 / (zeta f) is 167 s; of much shorter segments too the ratio comes back."""
    spectra = _expected_spectra(segment_s)
    bell, peak = _bell(spectra)
    found = mode_of_bell(bell, spectra, peak, (0.9, 0.4))
    assert found.frequency_hz == pytest.approx(FREQUENCY, rel=2e-4)
    assert found.damping_ratio == pytest.approx(RATIO, rel=0.03)
    assert found.reached == (segment_s > 100.0)


@pytest.mark.parametrize(("frequency", "ratio"), [(8.3, 0.002), (0.6, 0.1)])
def test_few_samples_and_strong_damping(frequency: float, ratio: float) -> None:
    """At 2.4 samples a cycle too; of strong damping the undamped frequency comes back."""
    spectra = _expected_spectra(200.0, frequency, ratio)
    bell, peak = _bell(spectra)
    found = mode_of_bell(bell, spectra, peak, (0.9, 0.2))
    assert found.frequency_hz == pytest.approx(frequency, rel=1e-3)
    assert found.damping_ratio == pytest.approx(ratio, rel=0.03)
    # Without samples in between, amplitudes off the line by parts of a per cent would show here.
    assert found.damping_error < 0.01 * ratio


def test_window_would_add_damping() -> None:
    """Negative control: the same correlation without the division has 30 % more damping."""
    spectra = _expected_spectra(167.0)
    bell, _ = _bell(spectra)
    untapered = np.ones(len(spectra.window))
    flat = CrossSpectra(**(vars(spectra) | {"window": untapered}))
    # A flat window's own correlation is a triangle; over it, what a Hann window leaves.
    function, step = correlation(bell, flat)
    lag = np.arange(len(function)) * step
    raw = function * (1 - lag / 167.0)
    crest = signal.find_peaks(raw)[0]
    slope = np.polyfit(lag[crest], np.log(raw[crest]), 1)[0]
    assert -slope / (2 * np.pi * FREQUENCY) > 1.3 * RATIO


def test_correlation_is_the_true_one() -> None:
    """Whole bell of a long segment: the oscillator's own correlation, finely sampled."""
    spectra = _expected_spectra(600.0)
    bell, _ = _bell(spectra)
    function, step = correlation(bell, spectra)
    lag = np.arange(len(function)) * step
    assert lag[-1] == pytest.approx(200.0, rel=1e-3)
    assert_allclose(function, _true_correlation(lag), atol=0.01)


def _two_modes() -> tuple[Array, Array, Array]:
    """Singular values (f, 2) and vectors of two normal shapes that cross at line 50."""
    lines = np.arange(101)
    a = 1 / (1 + ((lines - 40) / 6.0) ** 2)
    b = 1 / (1 + ((lines - 60) / 6.0) ** 2)
    first_is_a = a >= b
    values = np.stack([np.maximum(a, b), np.minimum(a, b)], axis=1)
    vectors = np.zeros((101, 2, 2), dtype=complex)
    vectors[first_is_a] = np.eye(2)
    vectors[~first_is_a] = np.eye(2)[::-1]
    return values, vectors, a


def test_bell_goes_on_in_the_second_singular_value() -> None:
    """Where another mode outweighs it, the mode's own lines are those of the second value."""
    values, vectors, own = _two_modes()
    bell = single_mode_bell(values, vectors, 40, np.array([1.0, 0j]), 0.8, (0, 100))
    assert (bell.first, bell.last) == (0, 100)
    assert_allclose(bell.density, own, rtol=1e-12)
    within = single_mode_bell(values, vectors, 40, np.array([1.0, 0j]), 0.8, (22, 55))
    assert (within.first, within.last) == (22, 55)


def test_bell_ends_where_shapes_differ() -> None:
    """A bell is lines in a row: those beyond another shape do not belong to it."""
    values = np.column_stack([np.ones(41), np.full(41, 0.1), np.full(41, 0.01)])
    vectors = np.tile(np.eye(3, dtype=complex), (41, 1, 1))
    vectors[[12, 26]] = np.eye(3)[:, [2, 1, 0]]  # the shape is the third one there
    shape = np.array([1.0, 0j, 0j])
    bell = single_mode_bell(values, vectors, 20, shape, 0.8, (0, 40))
    assert (bell.first, bell.last) == (13, 25)


def test_few_lines_are_refused() -> None:
    """Five lines are a bell, four are not."""
    values = np.column_stack([np.ones(41), np.full(41, 0.1), np.full(41, 0.01)])
    vectors = np.tile(np.eye(3, dtype=complex)[:, [2, 1, 0]], (41, 1, 1))
    shape = np.array([1.0, 0j, 0j])
    vectors[18:23] = np.eye(3)
    assert len(single_mode_bell(values, vectors, 20, shape, 0.8, (0, 40)).density) == 5
    vectors[22] = vectors[0]
    with pytest.raises(InputError, match=r"4 lines.*5 or more.*harmonic"):
        single_mode_bell(values, vectors, 20, shape, 0.8, (0, 40))
