"""Energy that the soil dashpots take in a cycle."""

from typing import Literal

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.definitions.soil.springs import SoilDashpot
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.soil.curves.laws import LinearCurves, TanhCurves
from offwind_pin.loads.soil.curves.soil_curve import SoilCurves
from offwind_pin.loads.soil.springs.dashpot import NO_DASHPOT, Dashpot
from offwind_pin.loads.soil.springs.elastic import LATERAL, SoilSprings

FACTOR, FREQUENCY, LENGTH = 0.03, 0.236, 0.75
DASHPOT = SoilDashpot(damping_factor=FACTOR, load_frequency=FREQUENCY)
MODULUS, ULTIMATE = np.array([3e8]), np.array([5e6])


def dissipated(
    curves: SoilCurves, x: float, y: float, frequency: float, *, initial: bool = False
) -> float:
    """Energy in J per cycle of the motion (x cos, y sin), by the periodic trapezoidal rule.

    The rule is exact to rounding for the smooth periodic integrands here. What the springs work over
    a cycle is nothing, so that the work done equals the heat that the load says it makes.
    """
    definition = DASHPOT.model_copy(update={"stiffness": "initial" if initial else "secant"})
    dashpot = Dashpot.of(definition)
    soil = SoilSprings("soil", LATERAL, np.array([-40.0]), np.array([LENGTH]), curves, dashpot)
    omega, work, heat, count = 2 * np.pi * frequency, 0.0, 0.0, 400
    for phase in 2 * np.pi * np.arange(count) / count:
        u = np.array([[x * np.cos(phase), y * np.sin(phase), 0.0]])
        v = omega * np.array([[-x * np.sin(phase), y * np.cos(phase), 0.0]])
        result = soil.forces(0.0, PointMotion(u, u, v, np.array([[0.0, 0.0, 1.0]])), 1.0)
        work -= float(np.sum(result.force * v)) / frequency / count
        heat += result.dissipation / frequency / count
    assert heat == pytest.approx(work, rel=1e-10)
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


def test_initial_dashpot_does_not_soften() -> None:
    """With the initial stiffness the dashpot of a softened spring takes what it took unsoftened."""
    curves = TanhCurves(MODULUS, ULTIMATE)
    energy = dissipated(curves, 0.02, 0.02, FREQUENCY, initial=True)
    stiffness = MODULUS[0] * LENGTH
    assert energy == pytest.approx(2 * 2 * np.pi * FACTOR * stiffness * 0.02**2, rel=1e-10)
    assert energy > 1.1 * dissipated(curves, 0.02, 0.02, FREQUENCY)


@pytest.mark.parametrize("kind", ["secant", "initial"])
def test_kind_of_dashpot_is_read_from_the_turbine(
    oc6: ow.Turbine, kind: Literal["secant", "initial"]
) -> None:
    """The field ``stiffness`` of the turbine's dashpot chooses the law; the secant is the default."""
    springs = oc6.soil.distributed_springs
    assert springs is not None
    assert springs.dashpot is not None
    assert springs.dashpot.stiffness == "secant"
    definition = springs.dashpot.model_copy(update={"stiffness": kind})
    dashpot = Dashpot.of(definition)
    time = springs.dashpot.damping_factor / (np.pi * springs.dashpot.load_frequency)
    found = (dashpot.secant_time[0], dashpot.initial_time)
    assert found == pytest.approx((time, 0.0) if kind == "secant" else (0.0, time), rel=1e-15)


def test_dissipation_is_viscous() -> None:
    """The dashpot is viscous: twice the frequency takes twice the energy in a cycle."""
    curves = LinearCurves(MODULUS)
    slow, fast = (dissipated(curves, 0.01, 0.0, f) for f in (FREQUENCY, 2 * FREQUENCY))
    assert fast / slow == pytest.approx(2.0, rel=1e-10)


def test_no_dashpot_takes_nothing() -> None:
    """Without a dashpot the springs are elastic."""
    assert Dashpot.of(None) is NO_DASHPOT
    soil = SoilSprings("soil", LATERAL, np.zeros(1), np.ones(1), LinearCurves(MODULUS), NO_DASHPOT)
    u, v = np.array([[0.02, 0.0, 0.0]]), np.array([[0.3, 0.1, 0.0]])
    still = soil.forces(0.0, PointMotion(u, u, 0 * v, np.array([[0.0, 0.0, 1.0]])), 1.0)
    moving = soil.forces(0.0, PointMotion(u, u, v, np.array([[0.0, 0.0, 1.0]])), 1.0)
    assert np.array_equal(moving.force, still.force)
    assert moving.dissipation == 0
