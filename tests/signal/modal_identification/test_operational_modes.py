"""Frequency domain decomposition of systems whose modes are known."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from helpers.white_noise import THREE_FORCES, ModalSystem, three_modes
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.identify import OperationalModes, operational_modes
from offwind_pin.signal.modal_identification.modal_assurance import modal_assurance

DT = 0.05
SYSTEM = three_modes()


@pytest.fixture(scope="module")
def record() -> Array:
    """(400000, 5) accelerations of the three modes over 20000 s."""
    return SYSTEM.accelerations(THREE_FORCES, DT, 400_000, seed=11)


@pytest.fixture(scope="module")
def identified(record: Array) -> OperationalModes:
    return operational_modes(record, 1 / DT, 100.0)


def test_simulation_has_its_closed_form_variance(record: Array) -> None:
    """The helper itself: the velocity's variance of each mode is S / (4 zeta omega), as its mean
    acceleration over a step has it by the correlation at one step."""
    system = ModalSystem(np.array([0.8]), np.array([0.015]), np.eye(1))
    values = system.accelerations(np.array([[2.0]]), DT, 400_000, seed=1)
    omega, ratio = 2 * np.pi * 0.8, 0.015
    damped = omega * np.sqrt(1 - ratio**2)
    cosine, sine = np.cos(damped * DT), np.sin(damped * DT)
    # Correlation of the velocity over a step: e^(-zeta omega dt) (cos - zeta omega / omega_d sin).
    kept = np.exp(-ratio * omega * DT) * (cosine - ratio * omega / damped * sine)
    variance = 2 * (2.0**2 / (4 * ratio * omega)) * (1 - kept) / DT**2
    assert np.var(values) == pytest.approx(variance, rel=0.06)
    assert np.var(record[:100_000]) == pytest.approx(np.var(record[-100_000:]), rel=0.1)


def test_three_modes(identified: OperationalModes) -> None:
    """Frequencies within 0.2 %, damping within 10 %, shapes by a MAC above 0.999; none too many."""
    assert len(identified.frequency_hz) == 3
    assert_allclose(identified.frequency_hz, SYSTEM.frequency_hz, rtol=2e-3)
    assert_allclose(identified.damping_ratio, SYSTEM.damping_ratio, rtol=0.1)
    match = modal_assurance(identified.shape, SYSTEM.shape)
    assert np.min(match.diagonal()) > 0.999
    # Negative control: another mode's shape does not pass.
    assert np.max(match - np.diag(match.diagonal())) < 0.8
    assert identified.cautions == ()


def test_result_is_whole(identified: OperationalModes) -> None:
    """Shapes have a unit peak, bells hold their peaks and do not overlap, values fall."""
    assert_allclose(np.max(identified.shape, axis=1), 1.0)
    low, high = identified.bell_hz.T
    assert np.all((low < identified.peak_hz) & (identified.peak_hz < high))
    assert np.all(high[:-1] <= low[1:])
    assert np.all(np.diff(identified.singular_values, axis=1) <= 0)
    assert np.all(identified.complexity < 1e-3)
    assert identified.names[0] == "channel 1"
    assert identified.segments == 399
    assert 350 < identified.averages < identified.segments
    assert ow.operational_modes is operational_modes


def test_given_frequencies_and_their_order(record: Array, identified: OperationalModes) -> None:
    """Peaks near given frequencies are those found without, in the order asked for."""
    asked = operational_modes(record, 1 / DT, 100.0, near=[4.2, 0.83], names=list("abcde"))
    assert_allclose(asked.frequency_hz, identified.frequency_hz[[2, 0]], rtol=1e-12)
    assert_allclose(asked.bell_hz[:, 1] >= asked.peak_hz, True)
    assert asked.names == tuple("abcde")


def test_band_and_count(record: Array, identified: OperationalModes) -> None:
    """The most prominent peaks, or those of a band."""
    part = record[:100_000]
    # The second mode, least damped, rises most, the first least.
    assert_allclose(
        operational_modes(part, 1 / DT, 100.0, count=2).frequency_hz, [2.1, 4.4], rtol=5e-3
    )
    banded = operational_modes(part, 1 / DT, 100.0, band=(1.5, 3.0))
    assert_allclose(banded.frequency_hz, [SYSTEM.frequency_hz[1]], rtol=5e-3)


def test_units_of_time_and_channels_do_not_matter(record: Array) -> None:
    """A film run twice as fast has twice the frequencies; channels in another order, other columns."""
    part = record[:80_000]
    plain = operational_modes(part, 20.0, 100.0)
    fast = operational_modes(part * 7.0, 40.0, 50.0)
    assert_allclose(fast.frequency_hz, 2 * plain.frequency_hz, rtol=1e-9)
    assert_allclose(fast.damping_ratio, plain.damping_ratio, rtol=1e-7)
    order = [3, 0, 4, 1, 2]
    turned = operational_modes(part[:, order], 20.0, 100.0)
    assert_allclose(turned.damping_ratio, plain.damping_ratio, rtol=1e-6)
    assert_allclose(turned.shape, plain.shape[:, order], atol=1e-8)


def test_measured_noise_is_borne(record: Array) -> None:
    """Noise of a tenth of the signal in every sensor moves no frequency and no shape."""
    noise = np.random.default_rng(4).normal(size=record.shape) * 0.1 * np.std(record, axis=0)
    found = operational_modes(record + noise, 1 / DT, 100.0, near=SYSTEM.frequency_hz)
    assert_allclose(found.frequency_hz, SYSTEM.frequency_hz, rtol=2e-3)
    assert_allclose(found.damping_ratio, SYSTEM.damping_ratio, rtol=0.1)
    assert np.min(modal_assurance(found.shape, SYSTEM.shape).diagonal()) > 0.999


def _two_directions(count: int) -> tuple[ModalSystem, Array]:
    """Fore-aft and side-side first modes 1 % apart at four heights, seen by eight channels."""
    height = np.linspace(0.25, 1.0, 4)
    fore_aft = np.concatenate([height**2, np.zeros(4)])
    side_side = np.concatenate([np.zeros(4), height**1.7])
    system = ModalSystem(
        np.array([0.5, 0.505]), np.array([0.02, 0.015]), np.array([fore_aft, side_side])
    )
    return system, system.accelerations(np.array([[1.0, 0.0], [0.0, 0.6]]), 0.1, count, seed=8)


def test_two_modes_at_nearly_one_frequency() -> None:
    """The stronger one is in the first singular value, the weaker one in the second, and the reader is told."""
    system, values = _two_directions(200_000)
    settings: dict[str, Any] = {"segment_s": 100.0, "near": [0.5]}
    first = operational_modes(values, 10.0, **settings)
    second = operational_modes(values, 10.0, singular_value=2, **settings)
    assert any("another mode or noise is close" in caution for caution in first.cautions)
    assert not any("another mode or noise is close" in caution for caution in second.cautions)
    found = np.array([first.frequency_hz[0], second.frequency_hz[0]])
    assert_allclose(found, system.frequency_hz, rtol=2e-3)
    assert_allclose(
        [first.damping_ratio[0], second.damping_ratio[0]], system.damping_ratio, rtol=0.15
    )
    shapes = np.vstack([first.shape, second.shape])
    assert np.min(modal_assurance(shapes, system.shape).diagonal()) > 0.99
    # Channels of one direction see one mode, and nothing is to be told.
    alone = operational_modes(values[:, 4:], 10.0, **settings)
    assert alone.frequency_hz[0] == pytest.approx(0.505, rel=2e-3)
    assert not any("another mode or noise is close" in caution for caution in alone.cautions)


def test_harmonic_is_no_mode(record: Array) -> None:
    """A tone rises as a mode does, but does not die away: it is left out, or refused if asked for."""
    part = record[:200_000]
    time = np.arange(len(part)) * DT
    tone = np.outer(np.sin(2 * np.pi * 1.3 * time), [0.2, 0.4, 0.6, 0.8, 1.0])
    found = operational_modes(part + 0.5 * np.std(part) * tone, 1 / DT, 100.0)
    assert np.min(np.abs(found.frequency_hz - 1.3)) > 0.4
    assert any("peak at 1.3 Hz left out" in caution for caution in found.cautions)
    with pytest.raises(InputError):
        operational_modes(part + 0.5 * np.std(part) * tone, 1 / DT, 100.0, near=[1.3])


def test_scatter_is_told() -> None:
    """Ratios of many short records scatter by at least the bound, and by less than three times it."""
    system = ModalSystem(
        np.array([1.0, 3.0]), np.array([0.01, 0.01]), np.array([[1.0, 0.4], [-0.5, 1.0]])
    )
    ratio, bound = [], []
    for seed in range(40):
        values = system.accelerations(np.eye(2) * [[1.0], [3.0]], 0.05, 30_000, seed)
        found = operational_modes(values, 20.0, 60.0, near=[1.0, 3.0])
        ratio.append(found.damping_ratio)
        bound.append(found.damping_scatter)
    scatter = np.std(ratio, axis=0) / np.sqrt(np.mean(np.square(bound), axis=0))
    assert np.all((scatter > 0.8) & (scatter < 3.0))
    assert_allclose(np.mean(ratio, axis=0), 0.01, rtol=0.05)


def test_cautions(record: Array) -> None:
    """Few segments, short segments and short records are told."""
    few = " ".join(operational_modes(record[:8_000], 20.0, 100.0, near=[0.8]).cautions)
    assert "independent ones" in few
    assert "damping ratios from records" in few
    barely = operational_modes(record[:6_000], 20.0, 100.0, near=[4.4]).cautions
    assert any("small singular values" in caution for caution in barely)
    short = operational_modes(record, 20.0, 15.0, near=[0.8]).cautions
    assert any("does not decay to 0.4" in caution for caution in short)


def test_shape_out_of_phase_is_told(record: Array) -> None:
    """A channel that comes late makes the shapes complex."""
    late = record[:100_000].copy()
    late[:, 4] = np.roll(late[:, 4], 2)
    found = operational_modes(late, 20.0, 100.0, near=[2.1])
    assert found.complexity[0] > 0.02
    assert any("out of phase" in caution for caution in found.cautions)


GOOD = SYSTEM.accelerations(THREE_FORCES, DT, 20_000, seed=2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"acceleration": GOOD[:, :1]}, "1 channel.*no mode shapes"),
        ({"acceleration": GOOD[:, 0]}, "shape"),
        ({"segment_s": 400.0}, "4 segments for 5 channels"),
        ({"near": [0.8], "count": 1}, "one of the two"),
        ({"near": []}, "one of the two"),
        ({"near": [1.3]}, "no peak within 10 % of 1.3 Hz"),
        ({"near": [30.0]}, "near"),
        ({"near": [0.79, 0.81]}, "one peak"),
        ({"count": 9}, "9 or more"),
        ({"band": (5.0, 3.0)}, "band"),
        ({"band": (0.1, 0.3)}, "0 peaks"),
        ({"prominence_db": 90.0}, "0 peaks"),
        ({"singular_value": 3}, "singular_value"),
        ({"mac_limit": 1.0}, "mac_limit"),
        ({"near": [0.8], "mac_limit": 0.9999999}, "harmonic"),
        ({"amplitude_range": (0.2, 0.9)}, "amplitude_range"),
        ({"names": ["a", "b"]}, "2 names"),
    ],
)
def test_bad_input(change: dict[str, Any], message: str) -> None:
    """Each mistake is told, with what is allowed."""
    good: dict[str, Any] = {"acceleration": GOOD, "sample_rate": 20.0, "segment_s": 50.0}
    operational_modes(**good)
    with pytest.raises(InputError, match=message):
        operational_modes(**(good | change))
