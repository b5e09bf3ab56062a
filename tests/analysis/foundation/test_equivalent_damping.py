"""Equivalent damping of soil springs beside closed forms."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.analysis.foundation.equivalent_damping import equivalent_damping
from offwind_pin.base.definition import Array
from offwind_pin.definitions.soil.springs import DampingCurve, SoilDashpot
from offwind_pin.loads.soil.curves.laws import LinearCurves, TanhCurves
from offwind_pin.loads.soil.springs.dashpot import NO_DASHPOT, Dashpot
from offwind_pin.loads.soil.springs.elastic import LATERAL, ROCKING, SoilSprings, SpringComponent
from offwind_pin.loads.soil.springs.hysteretic import HystereticSprings

MODULUS, ULTIMATE, LENGTH = 3e8, 2e6, 0.75
HEIGHT = np.array([-31.0, -40.0])
FACTOR, LOAD_FREQUENCY = 0.04, 0.236
AMPLITUDES = np.array([1e-3, 5e-3, 2e-2])
FREQUENCIES = np.array([0.1, 0.236, 1.1])


def springs(dashpot: Dashpot, component: SpringComponent = LATERAL) -> SoilSprings:
    """A first node where nothing resists, and a second one on a tanh curve."""
    curves = TanhCurves(np.array([0.0, MODULUS]), np.array([0.0, ULTIMATE]))
    return SoilSprings("soil", component, HEIGHT, np.full(2, LENGTH), curves, dashpot)


def dashpot(
    stiffness: Literal["secant", "initial"], factor: float | DampingCurve = FACTOR
) -> Dashpot:
    return Dashpot.of(
        SoilDashpot(stiffness=stiffness, damping_factor=factor, load_frequency_hz=LOAD_FREQUENCY)
    )


def secant(amplitude: Array) -> Array:
    """K_s(Y) of the second node, by hand."""
    return LENGTH * ULTIMATE * np.tanh(MODULUS * amplitude / ULTIMATE) / amplitude


@pytest.mark.parametrize("component", [LATERAL, ROCKING])
def test_secant_dashpot_of_a_linear_spring(component: SpringComponent) -> None:
    """Of constant stiffness: beta f / f_load, whatever the amplitude and what is resisted."""
    curves = LinearCurves(np.array([MODULUS]))
    soil = SoilSprings("soil", component, HEIGHT[:1], np.ones(1), curves, dashpot("secant"))
    found = equivalent_damping(soil, AMPLITUDES, FREQUENCIES, node=0)
    expected = np.tile(FACTOR * FREQUENCIES / LOAD_FREQUENCY, (3, 1))
    assert_allclose(found.damping_ratio, expected, rtol=1e-9)


def test_constant_dashpot() -> None:
    """beta K_0 / K_s(Y) f / f_load: the larger, the softer the spring has become."""
    found = equivalent_damping(springs(dashpot("initial")), AMPLITUDES, FREQUENCIES, node=1)
    softening = MODULUS * LENGTH / secant(AMPLITUDES)
    assert softening[-1] > 2
    expected = FACTOR * np.outer(softening, FREQUENCIES / LOAD_FREQUENCY)
    assert_allclose(found.damping_ratio, expected, rtol=1e-9)
    assert_allclose(found.secant_stiffness, secant(AMPLITUDES), rtol=1e-12)
    assert_allclose(
        found.energy_per_cycle,
        2 * np.pi * expected * (secant(AMPLITUDES) * AMPLITUDES**2)[:, None],
        rtol=1e-9,
    )


@pytest.mark.parametrize(
    "factor", [FACTOR, DampingCurve(displacement_m=(1e-3, 1e-2), factor=(0.01, 0.2))]
)
def test_secant_dashpot_of_a_softening_spring(factor: float | DampingCurve) -> None:
    """Energy per cycle: the integral of beta(y) K_s(y) v^2 / (pi f_load), by fine quadrature."""
    found = equivalent_damping(springs(dashpot("secant", factor)), AMPLITUDES, FREQUENCIES, node=1)
    angle = 2 * np.pi * (np.arange(40000) + 0.5) / 40000
    for i, size in enumerate(AMPLITUDES):
        y = np.abs(size * np.cos(angle))
        beta = factor.at(y) if isinstance(factor, DampingCurve) else factor
        for j, f in enumerate(FREQUENCIES):
            speed = 2 * np.pi * f * size * np.sin(angle)
            power = beta * secant(y) * speed**2 / (np.pi * LOAD_FREQUENCY)
            assert found.energy_per_cycle[i, j] == pytest.approx(power.mean() / f, rel=1e-3)


def test_sliders_follow_masing() -> None:
    """(8 E(Y) - 4 p Y) / (2 pi p Y), and the same at every frequency."""
    soil = springs(NO_DASHPOT)
    parts = ("soil", LATERAL, HEIGHT, soil.tributary_length, soil.curves, NO_DASHPOT)
    found = equivalent_damping(HystereticSprings(*parts, 200), AMPLITUDES, FREQUENCIES, node=1)
    energy = LENGTH * soil.curves.at(np.ones(3, dtype=np.intp)).energy(AMPLITUDES)
    work = secant(AMPLITUDES) * AMPLITUDES**2
    expected = (8 * energy - 4 * work) / (2 * np.pi * work)
    assert_allclose(found.damping_ratio, np.tile(expected[:, None], 3), rtol=1e-3)
    assert np.all(np.ptp(found.damping_ratio.values, axis=1) < 1e-12)
    assert 0.0 < expected[0] < expected[-1] < 2 / np.pi


def test_few_sliders_miss_masing() -> None:
    """The negative control: with four chords the loop is another."""
    soil = springs(NO_DASHPOT)
    parts = ("soil", LATERAL, HEIGHT, soil.tributary_length, soil.curves, NO_DASHPOT)
    few, many = (
        equivalent_damping(HystereticSprings(*parts, count), AMPLITUDES, [1.0], node=1)
        for count in (4, 200)
    )
    off = np.abs(few.damping_ratio / many.damping_ratio - 1)
    assert float(off.max()) > 0.02


def test_elastic_springs_take_nothing() -> None:
    """Without dashpot or sliders a cycle gives all back."""
    found = equivalent_damping(springs(NO_DASHPOT), AMPLITUDES, FREQUENCIES, node=1)
    assert np.all(np.abs(found.damping_ratio) < 1e-14)


@pytest.mark.parametrize(
    ("amplitudes", "frequencies", "node", "says"),
    [
        ([0.0, 1e-3], [1.0], 1, "amplitudes"),
        ([1e-3], [-1.0], 1, "frequencies"),
        ([1e-3], [1.0], 2, "0 to 1"),
        ([1e-3], [1.0], 0, "soil resists"),
    ],
)
def test_what_cannot_be_driven(
    amplitudes: list[float], frequencies: list[float], node: int, says: str
) -> None:
    with pytest.raises(ow.InputError, match=says):
        equivalent_damping(springs(NO_DASHPOT), amplitudes, frequencies, node=node)
