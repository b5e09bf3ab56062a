"""Logarithmic decrements of decays that are known in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.free_decay import free_decay


def decay(frequency: float, ratio: float, time: Array, phase: float = 0.4) -> Array:
    """Free decay of an oscillator with an undamped frequency in Hz."""
    omega = 2 * np.pi * frequency
    damped = omega * np.sqrt(1 - ratio**2)
    return np.exp(-ratio * omega * time) * np.cos(damped * time + phase)


@pytest.mark.parametrize("ratio", [0.002, 0.01, 0.05, 0.15])
@pytest.mark.parametrize("offset", [0.0, 3.0])
def test_linear_decay(ratio: float, offset: float) -> None:
    """Frequency and ratio come back, on whatever level the signal stands."""
    time = np.arange(0, min(1.5 / ratio, 400.0), 0.02)
    found = free_decay(offset + 0.2 * decay(0.3, ratio, time), 0.02)
    assert found.frequency_hz == pytest.approx(0.3, rel=2e-5)
    assert found.damping_ratio == pytest.approx(ratio, rel=2e-3)
    assert found.damping_error < 2e-3 * ratio
    middle = slice(2, max(4, len(found.local_damping) // 2))
    assert_allclose(found.local_damping[middle], ratio, rtol=4e-3)
    expected = 0.2 * np.exp(-ratio * 2 * np.pi * 0.3 * found.time)
    # Half differences lie on the decay but for the factor that the curve of its logarithm makes.
    assert np.ptp(np.log(found.amplitude / expected)) < 2e-3


def test_dry_friction() -> None:
    """Coulomb: every half cycle loses 2 F / k, so the ratio grows as 2 F / (pi k A)."""
    omega, slip = 2 * np.pi * 0.5, 0.01
    step = 0.005
    half = round(np.pi / omega / step)
    pieces, start = [], 1.0
    for i in range(36):
        centre = slip * (-1) ** i  # the spring's force less the friction's, which turns each half
        time = step * np.arange(half)
        level = centre + (start * (-1) ** i - centre) * np.cos(omega * time)
        pieces.append(level)
        start -= 2 * slip
    found = free_decay(np.concatenate(pieces), step, amplitude_range=(1.0, 0.3))
    assert found.frequency_hz == pytest.approx(0.5, rel=1e-3)
    large = found.local_amplitude > 0.35
    # ln((A + 2 slip) / (A - 2 slip)) over a cycle: the equivalent ratio for slip << A.
    equivalent = 2 * slip / (np.pi * found.local_amplitude)
    assert_allclose(found.local_damping[large], equivalent[large], rtol=5e-3)
    # Negative control: the damping is no constant, which a straight line would claim.
    assert found.local_damping[large][-1] > 2 * found.local_damping[0]
    assert found.damping_error > 0.01 * found.damping_ratio


def test_quadratic_drag() -> None:
    """x'' + omega^2 x + b |x'| x' = 0: an equivalent ratio of 4 b A / (3 pi), which falls with A."""
    omega, drag = 2 * np.pi * 0.25, 0.05
    time = np.arange(0, 400, 0.05)
    motion = solve_ivp(
        lambda t, y: [y[1], -(omega**2) * y[0] - drag * abs(y[1]) * y[1]],
        (0, 400),
        [1.0, 0.0],
        t_eval=time,
        rtol=1e-10,
        atol=1e-12,
    ).y[0]
    found = free_decay(motion, 0.05)
    assert_allclose(found.local_damping, 4 * drag * found.local_amplitude / (3 * np.pi), rtol=0.01)


def test_a_band_tells_two_modes_apart() -> None:
    """The weaker of two modes is found in its band; without it the stronger one."""
    time = np.arange(0, 120, 0.02)
    both = decay(0.25, 0.01, time) + 0.4 * decay(1.2, 0.02, time)
    slow = free_decay(both, 0.02, (0.1, 0.6), (1.0, 0.1))
    fast = free_decay(both, 0.02, (0.7, 2.0), (1.0, 0.1))
    assert slow.frequency_hz == pytest.approx(0.25, rel=1e-3)
    assert slow.damping_ratio == pytest.approx(0.01, rel=0.02)
    assert fast.frequency_hz == pytest.approx(1.2, rel=2e-3)
    assert fast.damping_ratio == pytest.approx(0.02, rel=0.04)


def test_what_comes_before_the_decay_is_left_out() -> None:
    """A pull before the release does not count."""
    time = np.arange(0, 60, 0.02)
    pulled = np.linspace(0, 1, 500) ** 2
    found = free_decay(np.concatenate([pulled, decay(0.5, 0.02, time, 0.0)]), 0.02)
    assert found.damping_ratio == pytest.approx(0.02, rel=0.01)


def test_error_tells_noise() -> None:
    """Ratios of noisy decays scatter about the true one as their standard errors say."""
    time = np.arange(0, 60, 0.02)
    found = []
    for seed in range(40):
        noise = np.random.default_rng(seed).normal(0, 0.01, len(time))
        found.append(free_decay(decay(0.5, 0.015, time) + noise, 0.02, (0.2, 1.2), (1.0, 0.3)))
    ratio = np.array([f.damping_ratio for f in found])
    error = np.sqrt(np.mean([f.damping_error**2 for f in found]))
    assert np.mean(ratio) == pytest.approx(0.015, rel=0.01)
    assert 0.8 < np.std(ratio) / error < 2.2


TIME = np.arange(0, 60, 0.02)
GOOD = decay(0.5, 0.02, TIME)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"values": GOOD[::-1]}, "half cycles"),
        ({"values": np.sin(np.pi * TIME)}, "do not decrease"),
        ({"values": GOOD[:150]}, "half cycles"),
        ({"values": GOOD[:, None]}, "vector"),
        ({"values": GOOD[:20]}, "32 samples"),
        ({"values": np.where(np.arange(len(GOOD)) == 9, np.inf, GOOD)}, "row 9"),
        ({"values": np.full(100, 2.0)}, "same number"),
        ({"values": GOOD[::20]}, "samples per cycle"),
        ({"dt": -0.02}, "dt"),
        ({"frequency_band": (0.8, 0.2)}, "frequency_band"),
        ({"frequency_band": (0.2, 30.0)}, "frequency_band"),
        ({"amplitude_range": (0.1, 0.9)}, "amplitude_range"),
        ({"amplitude_range": (1.0, 0.97)}, "half cycles"),
    ],
)
def test_bad_input(change: dict[str, Any], message: str) -> None:
    """Each mistake is told, a signal that grows or goes on for ever among them."""
    good: dict[str, Any] = {"values": GOOD, "dt": 0.02}
    free_decay(**good)
    with pytest.raises(InputError, match=message):
        free_decay(**(good | change))
