"""A tuned mass damper with Den Hartog's tuning gives his optimum amplification."""

import numpy as np
import pytest
from helpers.dampers import damper
from numpy.typing import NDArray
from scipy.signal import argrelmax

import offwind_pin as ow
from offwind_pin.analysis.foundation.pile_only import axis_jacobian
from offwind_pin.definitions.tuned_mass_damper import TunedMassDamper
from offwind_pin.verification.plain_tubes import tube

Array = NDArray[np.float64]

MASS_RATIOS = [0.01, 0.05, 0.1]


@pytest.fixture(scope="module")
def mast() -> ow.Turbine:
    """500 t on a clamped tube of 11 t: one mode of bending in each plane, the next 60 times higher.

    It weighs a thousandth of what it would on Earth.
    """
    return tube(density=100.0, top_mass=5e5, gravity=0.01)


@pytest.fixture(scope="module")
def mode(mast: ow.Turbine) -> tuple[float, float]:
    """Frequency in Hz and modal mass in kg of the first mode, its shape one at the top."""
    result = ow.modes(ow.build(mast, "clamped", elements=6), 2)
    top = result.mass_normalised[result.index("FA1"), -1, 0]
    return float(result.frequency_hz[result.index("FA1")]), float(1 / top**2)


def tuned(
    mode: tuple[float, float], ratio: float, *, frequency: float = 1.0, damping: float = 1.0
) -> TunedMassDamper:
    """Den Hartog's damper for a mode, at the top; its frequency and damping times factors."""
    best = ow.den_hartog(ratio)
    return damper(
        "absorber",
        80.0,
        "fore_aft",
        ratio * mode[1],
        frequency_hz=frequency * best.frequency_ratio * mode[0],
        damping_ratio=damping * best.damping_ratio,
    )


def amplification(mast: ow.Turbine, absorber: TunedMassDamper, frequency: Array) -> Array:
    """Motion of the top under a harmonic force there over that under a constant one."""
    system = ow.build(carrying(mast, absorber), "clamped", elements=6)
    equations, rest = system.equations((), np.inf), np.zeros(system.nv)
    stiffness, damping = equations.tangents(0.0, rest, rest)
    mass = equations.mass(rest)
    along = axis_jacobian(equations.chain_motion(rest, rest), system.chain.top)[0]
    omega = 2 * np.pi * frequency
    moved = [
        along @ np.linalg.solve(stiffness + 1j * w * damping - w**2 * mass, along) for w in omega
    ]
    return np.abs(moved) / float(along @ np.linalg.solve(stiffness, along))


def carrying(mast: ow.Turbine, absorber: TunedMassDamper) -> ow.Turbine:
    """The mast with a damper, not validated: its gravity would be refused."""
    return mast.model_copy(update={"tuned_mass_dampers": (absorber,)})


def peaks(mast: ow.Turbine, absorber: TunedMassDamper, frequency: float) -> Array:
    """Heights of the two resonances."""
    found = amplification(mast, absorber, frequency * np.linspace(0.7, 1.3, 1201))
    return found[argrelmax(found)]


@pytest.mark.parametrize("ratio", MASS_RATIOS)
def test_optimum_amplification(mast: ow.Turbine, mode: tuple[float, float], ratio: float) -> None:
    """sqrt(1 + 2 / mu) within 2 % is asked; the two peaks are equal within a thousandth."""
    found = peaks(mast, tuned(mode, ratio), mode[0])
    expected = np.sqrt(1 + 2 / ratio)
    assert ow.den_hartog(ratio).amplification == pytest.approx(expected, rel=1e-15)
    assert len(found) == 2
    assert found == pytest.approx(expected, rel=2e-3)
    assert found[0] == pytest.approx(found[1], rel=1e-3)


def test_it_is_an_optimum(mast: ow.Turbine, mode: tuple[float, float]) -> None:
    """Negative control: another frequency or damping gives more than 2 % above it."""
    best = ow.den_hartog(0.05).amplification
    for change in (
        {"frequency": 0.98},
        {"frequency": 1.02},
        {"damping": 0.75},
        {"damping": 1.35},
    ):
        assert peaks(mast, tuned(mode, 0.05, **change), mode[0]).max() > 1.02 * best


def test_damping_ratio_is_of_the_damper_alone(mast: ow.Turbine, mode: tuple[float, float]) -> None:
    """Negative control: Brock's ratio is over the structure's frequency; taken as the damper's own it
    is too small by 1 + mu, and the peaks differ."""
    found = peaks(mast, tuned(mode, 0.1, damping=1 / 1.1), mode[0])
    assert np.ptp(found) > 0.015 * found.min()


def test_fixed_points(mast: ow.Turbine, mode: tuple[float, float]) -> None:
    """At two frequencies the damping does not matter, and there the height is the optimum's."""
    frequency = mode[0] * np.linspace(0.7, 1.3, 2401)
    light, heavy = (
        amplification(mast, tuned(mode, 0.05, damping=factor), frequency) for factor in (0.5, 1.5)
    )
    crossings = np.flatnonzero(np.diff(np.sign(light - heavy)))
    assert len(crossings) == 2
    assert light[crossings] == pytest.approx(np.sqrt(1 + 2 / 0.05), rel=5e-3)


def test_in_time(mast: ow.Turbine, mode: tuple[float, float]) -> None:
    """Pushed at the lower resonance until it is steady, the top swings by the optimum."""
    absorber = tuned(mode, 0.05)
    frequency = mode[0] * np.linspace(0.7, 1.3, 1201)
    linear = amplification(mast, absorber, frequency)
    at = int(argrelmax(linear)[0][0])
    pushed, force, cycles = float(frequency[at]), 1e4, 45
    system = ow.build(carrying(mast, absorber), "clamped", elements=6)
    step = 1 / pushed / 100
    time = np.arange(100 * cycles + 1) * step
    load = np.zeros((len(time), 6))
    load[:, 0] = force * np.sin(2 * np.pi * pushed * time)
    history = ow.LoadHistory(time, load, "harmonic")
    undamped = ow.GeneralizedAlpha(ow.FixedStep(step), 1.0)
    data = ow.simulate(system, time[-1], loads=[history], integrator=undamped)
    moved = data["tower_top_displacement"].to_numpy()[-100:, 0]
    still = ow.static(system, np.array([force, 0, 0, 0, 0, 0])).tower_top_displacement[0]
    found = np.abs(2 * np.mean(moved * np.exp(2j * np.pi * np.arange(100) / 100))) / still
    assert found == pytest.approx(np.sqrt(1 + 2 / 0.05), rel=0.02)
    assert found == pytest.approx(linear[at], rel=5e-3)


def test_numbers_of_the_formula() -> None:
    """The values for a mass ratio of 1/20, and what is refused."""
    best = ow.den_hartog(0.05)
    assert best.frequency_ratio == pytest.approx(0.952381, rel=1e-6)
    assert best.damping_ratio == pytest.approx(0.133631, rel=1e-5)
    for ratio in (0.0, -0.1, np.nan, np.inf):
        with pytest.raises(ow.InputError, match="mass_ratio"):
            ow.den_hartog(ratio)
