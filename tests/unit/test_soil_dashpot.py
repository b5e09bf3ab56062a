"""Energy that the soil dashpots take in a cycle."""

import numpy as np
import pytest

from offwind_pin.loads.points import PointMotion
from offwind_pin.loads.soil import SoilSprings, dashpot_time
from offwind_pin.loads.soil_curves import LinearCurves, SoilCurves, TanhCurves
from offwind_pin.turbines.definition import SoilDashpot

FACTOR, FREQUENCY, LENGTH = 0.03, 0.236, 0.75
DASHPOT = SoilDashpot(damping_factor=FACTOR, load_frequency=FREQUENCY)
MODULUS, ULTIMATE = np.array([3e8]), np.array([5e6])


def dissipated(curves: SoilCurves, x: float, y: float, frequency: float) -> float:
    """Energy in J per cycle of the motion (x cos, y sin), by the periodic trapezoidal rule.

    The rule is exact to rounding for the smooth periodic integrands here.
    """
    soil = SoilSprings(np.array([-40.0]), np.array([LENGTH]), curves, dashpot_time(DASHPOT))
    omega, work, count = 2 * np.pi * frequency, 0.0, 400
    for phase in 2 * np.pi * np.arange(count) / count:
        u = np.array([[x * np.cos(phase), y * np.sin(phase), 0.0]])
        v = omega * np.array([[-x * np.sin(phase), y * np.cos(phase), 0.0]])
        force = soil.forces(0.0, PointMotion(u, u, v, np.array([[0.0, 0.0, 1.0]])), 1.0).force
        work -= float(np.sum(force * v)) / frequency / count
    return work


def test_cycle_along_a_line() -> None:
    """At f_load a linear spring's dashpot takes 2 pi beta K y^2, the equivalent viscous ratio beta."""
    energy = dissipated(LinearCurves(MODULUS), 0.02, 0.0, FREQUENCY)
    stiffness = MODULUS[0] * LENGTH
    assert energy == pytest.approx(2 * np.pi * FACTOR * stiffness * 0.02**2, rel=1e-10)


def test_cycle_on_a_circle() -> None:
    """On a circle the secant of a tanh curve is constant, and two directions take their share."""
    curves = TanhCurves(MODULUS, ULTIMATE)
    energy = dissipated(curves, 0.02, 0.02, FREQUENCY)
    secant = curves.secant(np.array([0.02]))[0] * LENGTH
    assert secant < 0.9 * MODULUS[0] * LENGTH
    assert energy == pytest.approx(2 * 2 * np.pi * FACTOR * secant * 0.02**2, rel=1e-10)


def test_dissipation_is_viscous() -> None:
    """The dashpot is viscous: twice the frequency takes twice the energy in a cycle."""
    curves = LinearCurves(MODULUS)
    slow, fast = (dissipated(curves, 0.01, 0.0, f) for f in (FREQUENCY, 2 * FREQUENCY))
    assert fast / slow == pytest.approx(2.0, rel=1e-10)


def test_no_dashpot_takes_nothing() -> None:
    """Without a dashpot the springs are elastic."""
    assert dashpot_time(None) == 0.0
