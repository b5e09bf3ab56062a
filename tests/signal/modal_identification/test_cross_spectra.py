"""Cross-spectral matrices against SciPy's pairs, Parseval, and closed forms of noise."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import signal

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.cross_spectra import cross_spectral_matrix
from offwind_pin.signal.spectra import power_spectral_density

RATE = 20.0


def _mixed(count: int, seed: int = 1) -> Array:
    """Three channels that share noise, with delays, offsets and colour."""
    noise = np.random.default_rng(seed).normal(size=(count + 4, 3))
    noise = signal.lfilter([1.0], [1.0, -1.2, 0.6], noise, axis=0)
    return np.column_stack(
        [noise[4:, 0] + 3.0, noise[:-4, 0] + 0.5 * noise[4:, 1], noise[4:, 1] - noise[2:-2, 2]]
    )


@pytest.mark.parametrize(
    ("length", "overlap", "window"), [(200, 0.5, "hann"), (151, 0.25, "hann"), (128, 0.0, "boxcar")]
)
def test_every_pair_is_scipys(length: int, overlap: float, window: str) -> None:
    """Entry (i, j) is SciPy's pair (j, i), for even and odd segments."""
    values = _mixed(2000)
    found = cross_spectral_matrix(values, RATE, length / RATE, overlap, window)
    centred = values - values.mean(axis=0)
    for i in range(3):
        for j in range(3):
            frequency, pair = signal.csd(
                centred[:, j],
                centred[:, i],
                fs=RATE,
                window=window,
                nperseg=length,
                noverlap=int(overlap * length),
                detrend=False,
            )
            assert_allclose(found.frequency, frequency, rtol=1e-12, atol=1e-12)
            assert_allclose(found.matrix[:, i, j], pair, rtol=1e-9, atol=1e-12)


def test_diagonal_is_the_power_spectral_density() -> None:
    """The package has one convention of spectra."""
    values = _mixed(3000)
    found = cross_spectral_matrix(values, RATE, 10.0)
    for i in range(3):
        frequency, density = power_spectral_density(values[:, i], 1 / RATE, 10.0)
        assert_allclose(found.frequency, frequency, rtol=1e-12)
        assert_allclose(found.matrix[:, i, i].real, density, rtol=1e-9, atol=1e-14)
        assert np.max(np.abs(found.matrix[:, i, i].imag)) < 1e-12


@pytest.mark.parametrize("count", [1000, 1001])
def test_integral_is_the_covariance(count: int) -> None:
    """One segment without taper: the real parts add up to the covariances exactly (Parseval)."""
    values = _mixed(count)
    found = cross_spectral_matrix(values, RATE, count / RATE, 0.0, "boxcar")
    total = found.matrix.sum(axis=0).real * found.frequency[1]
    assert_allclose(total, np.cov(values.T, bias=True), rtol=1e-10, atol=1e-12)


def test_phase_is_that_by_which_a_channel_leads() -> None:
    """A channel five samples late lags by 2 pi f 5 / rate."""
    noise = np.random.default_rng(2).normal(size=40_005)
    found = cross_spectral_matrix(np.column_stack([noise[5:], noise[:-5]]), RATE, 20.0)
    phase = np.unwrap(np.angle(found.matrix[1:-1, 0, 1]))
    assert_allclose(phase, 2 * np.pi * found.frequency[1:-1] * 5 / RATE, atol=0.05)


def test_level_of_white_noise() -> None:
    """One-sided: sigma^2 over half the sampling rate on the diagonal, nothing beside it."""
    noise = np.random.default_rng(3).normal(0, 2.0, (100_000, 2))
    found = cross_spectral_matrix(noise, RATE, 10.0)
    level = np.mean(found.matrix[1:-1], axis=0)
    assert_allclose(level.diagonal().real, 4.0 / (RATE / 2), rtol=0.02)
    assert abs(level[0, 1]) < 0.01 * level[0, 0].real


@pytest.mark.parametrize(("overlap", "window"), [(0.0, "hann"), (0.5, "hann"), (0.75, "hann")])
def test_scatter_is_that_of_independent_averages(overlap: float, window: str) -> None:
    """Lines of white noise scatter by 1 / sqrt(averages), whatever the overlap."""
    squares = []
    for seed in range(40):
        noise = np.random.default_rng(seed).normal(size=(4000, 2))
        found = cross_spectral_matrix(noise, 1.0, 200.0, overlap, window)
        level = found.matrix[2:-2, [0, 1], [0, 1]].real
        squares.append(np.mean((level / 2.0 - 1) ** 2))
    assert np.sqrt(np.mean(squares)) == pytest.approx(1 / np.sqrt(found.averages), rel=0.04)
    if overlap == 0:
        assert found.averages == found.segments == 20
    else:
        # Negative control: the segments as they are counted are too many.
        assert found.averages < 0.96 * found.segments


def test_averages_in_closed_form() -> None:
    """Two Hann windows overlap by half with a correlation of 1/6; each has one neighbour."""
    noise = np.random.default_rng(1).normal(size=(3000, 2))
    two = cross_spectral_matrix(noise, 1.0, 2000.0)
    assert two.segments == 2
    assert two.averages == pytest.approx(2 / (1 + 1 / 6**2), rel=1e-6)


GOOD = _mixed(400)


def _with(row: int, column: int, value: float) -> Array:
    changed = GOOD.copy()
    changed[row, column] = value
    return changed


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"acceleration": GOOD[:, 0]}, "shape"),
        ({"acceleration": GOOD.T}, "transposed"),
        ({"acceleration": _with(7, 1, np.nan)}, "row 7, channel 1"),
        ({"acceleration": GOOD * [1, 0, 1]}, "channel 1.*same number"),
        ({"sample_rate": 0.0}, "sample_rate"),
        ({"segment_s": 20.1}, "segment_s"),
        ({"segment_s": 0.3}, "segment_s"),
        ({"segment_s": np.nan}, "segment_s"),
        ({"overlap": 1.0}, "overlap"),
        ({"overlap": -0.1}, "overlap"),
        ({"window": "hanning-ish"}, "window"),
        ({"window": "kaiser"}, "window"),
    ],
)
def test_bad_input(change: dict[str, Any], message: str) -> None:
    """Each mistake is reported, with what is allowed."""
    good: dict[str, Any] = {"acceleration": GOOD, "sample_rate": RATE, "segment_s": 5.0}
    cross_spectral_matrix(**good)
    with pytest.raises(InputError, match=message):
        cross_spectral_matrix(**(good | change))
