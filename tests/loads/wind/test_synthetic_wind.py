"""The synthetic tower-top load: mean, seed, variance and harmonics."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.wind.synthetic_thrust import SyntheticWind, operate_rotor, steady_load

WIND, PASSING, PERIOD, STEP = 9.06, 0.388, 500.0, 0.05


def steady(oc6: ow.Turbine) -> Array:
    return steady_load(oc6.rna, operate_rotor(oc6.rna, WIND, PASSING))


def ratio(oc6: ow.Turbine, wind: SyntheticWind) -> Array:
    """Departure of one period of thrust from its steady value, over that value."""
    history = wind.generate(oc6.rna, duration=PERIOD, repeat_period=PERIOD, dt=STEP)
    return history.load[:-1, 0] / steady(oc6)[0] - 1


def test_mean_over_a_period_is_the_steady_load(oc6: ow.Turbine) -> None:
    """Over any whole period the mean is the steady load, to rounding."""
    wind = SyntheticWind(WIND, PASSING)
    history = wind.generate(oc6.rna, duration=2 * PERIOD, repeat_period=PERIOD, dt=STEP)
    for start in (0.0, 123.4):
        assert_allclose(history.mean(start, start + PERIOD), steady(oc6), rtol=1e-12, atol=1e-6)


def test_history_is_periodic_and_says_that_it_is_synthetic(oc6: ow.Turbine) -> None:
    """It repeats after its period, and carries its warning."""
    wind = SyntheticWind(WIND, PASSING, seed=4)
    history = wind.generate(oc6.rna, duration=1.5 * PERIOD, repeat_period=PERIOD, dt=STEP)
    count = round(PERIOD / STEP)
    assert_allclose(history.load[count:], history.load[: len(history.load) - count], rtol=0)
    assert history.surrogate is not None
    assert "synthetic" in history.surrogate


def test_seed_makes_it_reproducible(oc6: ow.Turbine) -> None:
    """One seed, one history; another seed, another one of the same turbulence variance."""
    one, same, other = (ratio(oc6, SyntheticWind(WIND, PASSING, seed=s)) for s in (1, 1, 2))
    assert_allclose(one, same, rtol=0)
    assert np.max(np.abs(one - other)) > 0.1


def test_pure_tones_stand_at_3p_6p_9p(oc6: ow.Turbine) -> None:
    """Without turbulence only three lines are left, each with the variance asked for."""
    sigma = (0.05, 0.02, 0.012)
    wind = SyntheticWind(
        WIND, PASSING, turbulence_intensity=0.0, harmonics=sigma, coherent_fraction=1.0
    )
    lines = np.abs(np.fft.rfft(ratio(oc6, wind))) * 2 * STEP / PERIOD
    frequency = np.arange(len(lines)) / PERIOD
    at = np.argsort(lines)[-3:][::-1]
    assert_allclose(frequency[at], [PASSING, 2 * PASSING, 3 * PASSING], atol=1e-9)
    assert_allclose(lines[at], np.sqrt(2) * np.array(sigma), rtol=1e-9)
    assert np.sort(lines)[-4] < 1e-12


def test_tones_stand_out_of_the_turbulence(oc6: ow.Turbine) -> None:
    """With the default shares the tone at 3P is above every line around it."""
    lines = np.abs(np.fft.rfft(ratio(oc6, SyntheticWind(WIND, PASSING))))
    at = round(PASSING * PERIOD)
    around = np.r_[lines[at - 20 : at], lines[at + 1 : at + 21]]
    assert lines[at] > 2 * around.max()


@pytest.mark.parametrize("order", [1, 2, 3])
def test_incoherent_harmonic_has_its_variance(oc6: ow.Turbine, order: int) -> None:
    """A band alone holds sigma^2, less the tails of its Lorentzian below 0 and above 5 Hz."""
    harmonics = [0.0, 0.0, 0.0]
    harmonics[order - 1] = 0.03
    wind = SyntheticWind(
        WIND,
        PASSING,
        turbulence_intensity=0.0,
        harmonics=tuple(harmonics),
        coherent_fraction=0.0,
    )
    center = order * PASSING
    half_width = order * WIND / (2 * np.pi * operate_rotor(oc6.rna, WIND, PASSING).radius)
    inside = (np.arctan((5 - center) / half_width) + np.arctan(center / half_width)) / np.pi
    # The line at zero frequency is left out and half of it would be inside: under 1e-3.
    assert np.var(ratio(oc6, wind)) == pytest.approx(0.03**2 * inside, rel=1e-3)


def test_thrust_follows_the_square_of_the_wind(oc6: ow.Turbine) -> None:
    """Turbulence of intensity I gives a thrust deviation below 2 I: the rotor averages the gusts."""
    deviation = [
        np.std(
            ratio(
                oc6,
                SyntheticWind(WIND, PASSING, turbulence_intensity=i, harmonics=(0.0, 0.0, 0.0)),
            )
        )
        for i in (0.05, 0.10)
    ]
    assert deviation[1] == pytest.approx(2 * deviation[0], rel=1e-9)
    assert 0.5 * 0.10 < deviation[1] < 2 * 0.10


def test_load_keeps_its_direction(oc6: ow.Turbine) -> None:
    """Quasi-steady: every sample is a multiple of the steady wrench."""
    wind = SyntheticWind(WIND, PASSING)
    load = wind.generate(oc6.rna, duration=20.0, repeat_period=PERIOD, dt=STEP).load
    reference = steady(oc6)
    assert_allclose(load, np.outer(load[:, 0] / reference[0], reference), rtol=1e-12, atol=1e-6)


@pytest.mark.parametrize(
    ("dt", "period"), [(0.2, 100.0), (0.0, 100.0), (0.02, 0.0), (0.02, float("nan"))]
)
def test_sampling_that_cannot_hold_the_load_is_refused(
    oc6: ow.Turbine, dt: float, period: float
) -> None:
    """A step too coarse for the harmonics, or one that does not divide the period, is refused."""
    wind = ow.SyntheticWind(9.06, 0.388)
    with pytest.raises(ow.InputError, match="synthetic wind"):
        wind.generate(oc6.rna, duration=period, repeat_period=period, dt=dt)


@pytest.mark.parametrize("period", [1.0, 3.05, 100.0])
def test_mean_over_any_period_is_the_steady_load(oc6: ow.Turbine, period: float) -> None:
    """Whatever the period, whole samples fit it, and its mean is the steady load."""
    wind = ow.SyntheticWind(9.06, 0.388)
    history = wind.generate(oc6.rna, duration=2 * period, repeat_period=period)
    steady = steady_load(oc6.rna, operate_rotor(oc6.rna, 9.06, 0.388))
    assert_allclose(history.mean(0.0, period), steady, rtol=1e-9, atol=1e-3)
    assert history.time[-1] >= 2 * period - 1e-9
