"""P-delta: columns under their own weight."""

import numpy as np
import pytest
from helpers.numerics import fitted_order
from scipy.optimize import brentq
from scipy.special import jv

import offwind_pin as ow
from offwind_pin.verification.plain_tubes import (
    LENGTH,
    bending_stiffness,
    frequencies,
    mass_per_length,
    tube,
)

THIN = (1.0, 0.01)
CRITICAL = 9 / 4 * brentq(lambda x: jv(-1 / 3, x), 1.5, 2.2) ** 2
"""w L^3 / EI at which a uniform clamped column buckles under its weight (Greenhill, 1881): 7.837."""


def lowest_eigenvalue(n: int, gravity: float, rule: str) -> float:
    """Smallest eigenvalue of the tangent stiffness over that of the joint springs."""
    turbine = tube(bottom=THIN, top=THIN, gravity=gravity, top_mass=1e-6)
    system = ow.build(turbine, "clamped", elements=n, stiffness=rule)
    rest = np.zeros(system.nv)
    stiffness, _ = system.equations((), np.inf).tangents(0.0, rest, rest)
    return float(np.linalg.eigvalsh(stiffness)[0]) / system.joint_stiffness[0]


def critical_load(n: int, rule: str) -> float:
    """w L^3 / EI at which the straight chain loses its stiffness."""
    to_gravity = bending_stiffness(*THIN) / mass_per_length(*THIN) / LENGTH**3
    return brentq(lambda load: lowest_eigenvalue(n, load * to_gravity, rule), 4.0, 12.0, xtol=1e-10)


def test_buckling_under_its_own_weight(rule: str) -> None:
    """The critical weight 7.837 EI / L^3 with order 2."""
    assert pytest.approx(7.837, abs=5e-4) == CRITICAL
    counts = np.array([5, 10, 20])
    errors = [critical_load(int(n), rule) / CRITICAL - 1 for n in counts]
    assert abs(errors[-1]) < 5e-3
    assert fitted_order(1 / counts, errors) == pytest.approx(2.0, abs=0.1)


def test_frequency_falls_to_zero_with_the_critical_weight() -> None:
    """omega^2 falls with the weight almost linearly: half the critical weight takes half of it.

    Southwell's theorem bounds it: omega^2 / omega_0^2 >= 1 - w / w_c, and it is within 1 % of that.
    """
    to_gravity = bending_stiffness(*THIN) / mass_per_length(*THIN) / LENGTH**3
    squares = []
    for share in (0.0, 0.5, 0.9):
        gravity = share * CRITICAL * to_gravity
        turbine = tube(bottom=THIN, top=THIN, gravity=gravity, top_mass=1e-6)
        squares.append(frequencies(ow.build(turbine, "clamped", elements=30), 1)[0] ** 2)
    ratio = np.array(squares[1:]) / squares[0]
    assert ratio == pytest.approx([0.5, 0.1], abs=0.01)
    assert ratio[0] > 0.5 - 1e-3


def test_weight_on_top_of_a_light_column() -> None:
    """Euler's load pi^2 EI / 4 L^2 of a heavy body on a light column, by the lowest eigenvalue."""
    mass = 1e7
    light = (1.0, 1e-3)
    euler = np.pi**2 * bending_stiffness(*light) / 4 / LENGTH**2

    def lowest(weight: float, n: int) -> float:
        turbine = tube(bottom=light, top=light, density=100.0, gravity=weight / mass, top_mass=mass)
        system = ow.build(turbine, "clamped", elements=n)
        rest = np.zeros(system.nv)
        stiffness, _ = system.equations((), np.inf).tangents(0.0, rest, rest)
        return float(np.linalg.eigvalsh(stiffness)[0])

    counts = np.array([5, 10, 20])
    errors = [
        brentq(lambda w, n=int(n): lowest(w, n), 0.5 * euler, 2 * euler, xtol=1e-9 * euler) / euler
        - 1
        for n in counts
    ]
    # The chain of n hinges half an element from the ends buckles at 2 n sin(pi / 4 n) / (pi / 2).
    assert fitted_order(1 / counts, errors) == pytest.approx(2.0, abs=0.1)
    assert abs(errors[-1]) < 2e-3
