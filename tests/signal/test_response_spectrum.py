"""Response spectra against closed forms and another solver; intensity and duration of a record."""

import numpy as np
import pytest
from helpers.earthquakes import shaking
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import lsim, lti

import offwind_pin as ow
from offwind_pin.signal.response_spectrum import (
    arias_intensity,
    response_spectrum,
    significant_duration,
)

Array = NDArray[np.float64]


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.3])
def test_step_of_acceleration(ratio: float) -> None:
    """Its displacement overshoots the static a / w^2 by exp(-z pi / sqrt(1 - z^2))."""
    periods = np.array([0.1, 0.7, 3.0])
    found = response_spectrum(np.full(2001, 2.0), 0.005, periods, ratio)
    overshoot = 1 + np.exp(-ratio * np.pi / np.sqrt(1 - ratio**2))
    expected = 2.0 * overshoot * (periods / (2 * np.pi)) ** 2
    # An undamped one goes on when the step ends, and may swing wider then.
    assert np.all(found.displacement >= expected * (1 - 1e-3))
    if ratio > 0:
        assert found.displacement == pytest.approx(expected, rel=1e-3)
        assert found.pseudo_acceleration == pytest.approx(2.0 * overshoot, rel=1e-3)
        assert found.pseudo_velocity == pytest.approx(
            found.displacement * 2 * np.pi / periods, rel=1e-12
        )


def test_short_pulse() -> None:
    """A pulse much shorter than the periods is a change of velocity: u = V / w, undamped, after it."""
    record = np.array([0.0, 1.0, 0.0])
    periods = np.array([1.0, 4.0])
    found = response_spectrum(record, 0.005, periods, 0.0)
    assert found.displacement == pytest.approx(0.005 * periods / (2 * np.pi), rel=1e-3)


def test_stiff_and_soft_limits() -> None:
    """Stiff oscillators feel the largest acceleration, soft ones the largest displacement of the ground."""
    motion = shaking()
    record = motion.corrected[0, :, 0]
    found = response_spectrum(record, motion.step, np.array([0.004, 4000.0]))
    ground = motion.motion(motion.time)[:, 0, 0, 0]
    assert found.absolute_acceleration[0] == pytest.approx(np.abs(record).max(), rel=0.01)
    assert found.displacement[1] == pytest.approx(np.abs(ground).max(), rel=0.02)


def test_against_another_solver() -> None:
    """SciPy's Runge-Kutta of order 8 on one oscillator at a time, seen ten times a sample."""
    motion = shaking(6.0)
    record = motion.corrected[0]
    periods = np.array([0.08, 0.5, 2.0])
    found = response_spectrum(record, motion.step, periods)
    after = np.linspace(0, 8.0, 8001)
    for i, period in enumerate(periods):
        w = 2 * np.pi / period
        for j in range(2):

            def rate(time: float, y: Array, w: float = w, j: int = j) -> list[float]:
                a = np.interp(time, motion.time, record[:, j], right=0.0)
                return [y[1], -(w**2) * y[0] - 0.1 * w * y[1] - float(a)]

            solution = solve_ivp(
                rate, (0, 8), [0, 0], "DOP853", after, rtol=1e-9, atol=1e-12, max_step=0.02
            )
            u, v = solution.y
            assert found.displacement[i, j] == pytest.approx(np.abs(u).max(), rel=1e-3)
            absolute = np.abs(w**2 * u + 0.1 * w * v).max()
            assert found.absolute_acceleration[i, j] == pytest.approx(absolute, rel=1e-3)


def test_exact_between_samples() -> None:
    """A record resampled on its own straight lines has the same spectrum, whatever the step."""
    motion = shaking(4.0, 0.02)
    record = motion.corrected[0, :, 0]
    fine = np.linspace(0, 4.0, 1001)
    periods = np.geomspace(0.05, 5, 12)
    coarse = response_spectrum(record, 0.02, periods)
    finer = response_spectrum(np.interp(fine, motion.time, record), 0.004, periods)
    assert finer.displacement == pytest.approx(coarse.displacement, rel=1e-3)
    other = response_spectrum(record, 0.021, periods)  # negative control
    assert np.abs(other.displacement / coarse.displacement - 1).max() > 0.01


def test_against_a_linear_filter() -> None:
    """SciPy's lsim holds straight lines as well; at instants of its own the two agree to rounding."""
    motion = shaking(6.0, 0.002)
    record = motion.corrected[0, :, 0]
    w = 2 * np.pi / 0.25
    system = lti([-1.0], [1.0, 0.1 * w, w**2])
    _, u, _ = lsim(system, record, motion.time)
    found = response_spectrum(record, 0.002, np.array([0.25]))
    assert found.displacement[0] == pytest.approx(np.abs(u).max(), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ({"acceleration": np.zeros(1)}, "acceleration"),
        ({"acceleration": np.zeros(0)}, "acceleration"),
        ({"acceleration": np.array([0.0, np.nan])}, "acceleration"),
        ({"acceleration": np.zeros((2, 2, 2))}, "acceleration"),
        ({"dt": 0.0}, "dt"),
        ({"dt": np.inf}, "dt"),
        ({"period": np.array([0.0, 1.0])}, "period"),
        ({"period": np.zeros(0)}, "period"),
        ({"damping_ratio": 1.0}, "damping_ratio"),
        ({"damping_ratio": -0.1}, "damping_ratio"),
    ],
)
def test_bad_input(change: dict[str, object], where: str) -> None:
    good = {"acceleration": np.ones(5), "dt": 0.01, "period": np.ones(1), "damping_ratio": 0.05}
    response_spectrum(**good)
    with pytest.raises(ow.InputError, match=where):
        response_spectrum(**(good | change))


def test_intensity_and_duration_of_a_harmonic() -> None:
    """pi / (2 g) a^2 T / 2, and 90 % of the time; a record of nothing has none."""
    time = np.linspace(0, 10, 10001)
    record = 2 * np.sin(2 * np.pi * 5 * time)
    expected = np.pi / (2 * 9.81) * 4 / 2 * 10
    assert arias_intensity(record, 0.001, 9.81) == pytest.approx(expected, rel=1e-3)
    assert significant_duration(record, 0.001) == pytest.approx(9.0, abs=0.1)
    assert significant_duration(np.zeros(5), 0.1) == 0.0
    quiet = np.concatenate([np.zeros(3000), record, np.zeros(5000)])
    assert significant_duration(quiet, 0.001) == pytest.approx(9.0, abs=0.1)
