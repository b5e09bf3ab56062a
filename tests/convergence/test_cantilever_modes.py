"""Natural frequencies of clamped tubes without gravity."""

import numpy as np
import pytest
from helpers.numerics import fitted_order
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.verification.beams import cantilever_roots, ritz_frequencies
from offwind_pin.verification.plain_tubes import (
    DENSITY,
    LENGTH,
    SHEAR,
    TORSION,
    YOUNG,
    bending_stiffness,
    frequencies,
    mass_per_length,
    tube,
)

Array = NDArray[np.float64]

SLENDER = (0.05, 0.0005)
"""Diameter and wall in m: over 100 m the rotary inertia, which Euler and Bernoulli leave out and
the frusta have, changes the fifth frequency by 1e-5, far below the errors that are fitted."""


def bending(turbine: ow.Turbine, rule: str, n: int, count: int) -> Array:
    """(count,) frequencies in the fore-aft plane in rad/s."""
    return frequencies(ow.build(turbine, "clamped", elements=n, stiffness=rule), count)


def rotary_inertia_share(count: int) -> Array:
    """Relative drop of the frequencies by rotary inertia, (r / L)^2 x^2 (...) at most this."""
    radius = SLENDER[0] / np.sqrt(8)
    return 3 * (radius / LENGTH * cantilever_roots(count)) ** 2


def test_uniform(rule: str) -> None:
    """First five Euler-Bernoulli frequencies, each with order 2."""
    counts = np.array([16, 24, 36])
    roots = cantilever_roots(5)
    assert roots[:2] == pytest.approx([1.8751040687, 4.6940911330], rel=1e-10)
    exact = roots**2 * np.sqrt(bending_stiffness(*SLENDER) / mass_per_length(*SLENDER) / LENGTH**4)
    turbine = tube(bottom=SLENDER, top=SLENDER, top_mass=1e-9)
    errors = np.array([bending(turbine, rule, int(n), 5) for n in counts]) / exact - 1
    assert np.all(rotary_inertia_share(5) < 0.02 * np.abs(errors[-1]))
    for mode in range(5):
        assert fitted_order(1 / counts, errors[:, mode]) == pytest.approx(2.0, abs=0.1)
    assert np.all(np.abs(errors[-1]) < 2e-3)


def test_tapered(rule: str) -> None:
    """The same on a taper, against Rayleigh-Ritz with polynomial shapes."""
    counts = np.array([16, 24, 36])
    bottom, top = (0.06, 0.0006), (0.045, 0.0005)

    def inner_outer(s: Array) -> tuple[Array, Array]:
        outer = bottom[0] + (top[0] - bottom[0]) * s / LENGTH
        return outer, outer - 2 * (bottom[1] + (top[1] - bottom[1]) * s / LENGTH)

    def stiffness(s: Array) -> Array:
        outer, inner = inner_outer(s)
        return YOUNG * np.pi / 64 * (outer**4 - inner**4)

    def mass(s: Array) -> Array:
        outer, inner = inner_outer(s)
        return DENSITY * np.pi / 4 * (outer**2 - inner**2)

    exact = ritz_frequencies(LENGTH, stiffness, mass, 5)
    turbine = tube(bottom=bottom, top=top, top_mass=1e-9)
    errors = np.array([bending(turbine, rule, int(n), 5) for n in counts]) / exact - 1
    for mode in range(5):
        assert fitted_order(1 / counts, errors[:, mode]) == pytest.approx(2.0, abs=0.1)
    assert np.all(np.abs(errors[-1]) < 2e-3)


def test_ritz_reference_meets_the_uniform_beam() -> None:
    """The reference of the last test is itself right: the roots of cos x cosh x = -1 to 1e-9."""
    found = ritz_frequencies(1.0, np.ones_like, np.ones_like, 5)
    assert found == pytest.approx(cantilever_roots(5) ** 2, rel=1e-9)


def test_torsion(rule: str) -> None:
    """Clamped-free torsion (2 k - 1) pi / 2 L sqrt(G / rho), with order 2."""
    counts = np.array([8, 12, 18, 27])
    wave = np.sqrt(SHEAR / DENSITY)
    exact = np.array([1, 3, 5]) * np.pi / 2 / LENGTH * wave
    errors = []
    for n in counts:
        system = ow.build(tube(), "clamped", elements=int(n), stiffness=rule)
        errors.append(frequencies(system, 3, TORSION) / exact - 1)
    for mode in range(3):
        order = fitted_order(1 / counts, np.array(errors)[:, mode])
        assert order == pytest.approx(2.0, abs=0.1)


def test_heavy_top() -> None:
    """A massless-like tube with a body m on top: sqrt(3 EI / m L^3), with order 2."""
    turbine = tube(top_mass=1e10)
    exact = np.sqrt(3 * bending_stiffness() / 1e10 / LENGTH**3)
    counts = np.array([4, 8, 16])
    errors = []
    for n in counts:
        system = ow.build(turbine, "clamped", elements=int(n))
        errors.append(frequencies(system, 1)[0] / exact - 1)
    # The deflection at the tip is 1 / (4 n^2) too small, so the frequency 1 / (8 n^2) too high.
    assert errors == pytest.approx(1 / (8 * counts**2), rel=0.05, abs=2e-5)


def test_mode_shape_of_the_uniform_beam() -> None:
    """First mode: the height of the peak is the tip, and at half height 0.3395 of it."""
    system = ow.build(tube(top_mass=1.0, gravity=1.0), "clamped", elements=40)
    result = ow.modes(system, 2)
    fore_aft = result.shape[result.index("FA1"), :, 0]
    half = fore_aft[np.argmin(np.abs(result.height - 30.0))]
    assert fore_aft[-1] == pytest.approx(1.0, rel=1e-12)
    assert half == pytest.approx(0.33952, abs=2e-3)
