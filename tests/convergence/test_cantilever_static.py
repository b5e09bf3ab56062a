"""A clamped tube under small loads at its tip."""

import numpy as np
import pytest
from helpers.numerics import fitted_order

import offwind_pin as ow
from offwind_pin.verification.plain_tubes import (
    DIAMETER,
    LENGTH,
    SHEAR,
    YOUNG,
    bending_stiffness,
    equilibrium,
    polar_inertia,
    tube,
)

COUNTS = np.array([4, 8, 16, 32])
SMALL = 1e-6
"""Deflection over length, or twist in rad: terms of second order are 1e-12 of the answer."""


@pytest.mark.parametrize("direction", [0, 1], ids=["fore-aft", "side-side"])
def test_tip_deflection(rule: str, direction: int) -> None:
    """P L^3 / 3 EI with order 2; the midpoint rule's own error is 1 / (4 n^2), exactly."""
    force = SMALL * 3 * bending_stiffness() / LENGTH**2
    load = np.zeros(6)
    load[direction] = force
    errors = []
    for n in COUNTS:
        system = ow.build(tube(), "clamped", elements=int(n), stiffness=rule)
        tip = equilibrium(system, load, scale=force * LENGTH).displacement[-1]
        errors.append(tip[direction] / (SMALL * LENGTH) - 1)
        assert abs(tip[1 - direction]) < 1e-9 * SMALL * LENGTH
    assert errors == pytest.approx(-1 / (4 * COUNTS**2), abs=1e-9)
    assert fitted_order(1 / COUNTS, errors) == pytest.approx(2.0, abs=0.1)


def test_tip_moment_is_exact(rule: str) -> None:
    """Under a tip moment the curvature is constant: the tip's M L^2 / 2 EI is met by any number."""
    moment = 2 * SMALL * bending_stiffness() / LENGTH
    for n in (1, 3, 10):
        system = ow.build(tube(), "clamped", elements=n, stiffness=rule)
        tip = equilibrium(system, [0, 0, 0, 0, moment, 0], scale=moment).displacement[-1, 0]
        assert tip == pytest.approx(SMALL * LENGTH, rel=1e-9)


def test_twist(rule: str) -> None:
    """Twist under Mz is M L / G J for any number of elements."""
    moment = SMALL * SHEAR * polar_inertia() / LENGTH
    system = ow.build(tube(), "clamped", elements=5, stiffness=rule)
    q = equilibrium(system, [0, 0, 0, 0, 0, moment], scale=moment).q
    assert q[2::3].sum() == pytest.approx(SMALL, rel=1e-12)
    assert np.abs(np.delete(q, np.s_[2::3])).max() < 1e-9 * SMALL


def tapered(rule: str, n: int) -> ow.System:
    turbine = tube(bottom=(DIAMETER, 0.06), top=(0.75 * DIAMETER, 0.05))
    return ow.build(turbine, "clamped", elements=n, stiffness=rule)


def test_tapered_tip_deflection(rule: str) -> None:
    """P times the integral of (L - s)^2 / EI(s), here by 40 Gauss points, with order 2."""
    points, weights = np.polynomial.legendre.leggauss(40)
    s = LENGTH * (1 + points) / 2
    outer = DIAMETER * (1 - s / LENGTH / 4)
    inner = outer - 2 * (0.06 - 0.01 * s / LENGTH)
    stiffness = YOUNG * np.pi / 64 * (outer**4 - inner**4)
    unit = LENGTH / 2 * weights @ ((LENGTH - s) ** 2 / stiffness)
    force, errors = SMALL * LENGTH / unit, []
    for n in COUNTS:
        tip = equilibrium(tapered(rule, int(n)), [force, 0, 0, 0, 0, 0], scale=force * LENGTH)
        errors.append(tip.displacement[-1, 0] / (SMALL * LENGTH) - 1)
    assert abs(errors[-1]) < 1e-3
    assert fitted_order(1 / COUNTS, errors) == pytest.approx(2.0, abs=0.1)


def test_large_rotation_under_a_tip_moment() -> None:
    """A moment fixed in space bends the tube to a circular arc; the chain follows with order 2.

    With the angle theta = M L / EI the tip is at L sin(theta) / theta and L (1 - cos(theta)) / theta.
    """
    angle, errors = 1.2, []
    moment = angle * bending_stiffness() / LENGTH
    for n in COUNTS:
        system = ow.build(tube(), "clamped", elements=int(n))
        tip = equilibrium(system, [0, 0, 0, 0, moment, 0], scale=moment).displacement[-1]
        errors.append(tip[0] - LENGTH * (1 - np.cos(angle)) / angle)
        drop = tip[2] - LENGTH * (np.sin(angle) / angle - 1)
        assert abs(drop) < 0.1 * LENGTH / n**2
    assert fitted_order(1 / COUNTS, errors) == pytest.approx(2.0, abs=0.1)
