"""Momentum theory of the rotor behind the synthetic wind load."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.definitions.rotor_nacelle import rotor_apex, rotor_radius
from offwind_pin.loads.wind.synthetic_thrust import AIR_DENSITY, operate_rotor, steady_load

WIND, PASSING = 9.06, 0.388


def test_momentum_theory(oc6: ow.Turbine) -> None:
    """Ct = 4 a (1 - a); without profile drag Cp = 4 a (1 - a)^2 = Ct (1 - a)."""
    rotor = operate_rotor(oc6.rna, WIND, PASSING, lift_to_drag=1e12)
    a = rotor.induction
    assert 0 < a < 1 / 3
    assert rotor.thrust_coefficient == pytest.approx(4 * a * (1 - a), rel=1e-13)
    assert rotor.power_coefficient == pytest.approx(4 * a * (1 - a) ** 2, rel=1e-9)
    # The power that the disc takes from the air is the thrust times the wind through it.
    assert rotor.torque * rotor.rotor_speed == pytest.approx(
        rotor.thrust * WIND * (1 - a), rel=1e-9
    )


def test_dimensional_loads(oc6: ow.Turbine) -> None:
    """Thrust and torque are the coefficients times dynamic pressure and swept area."""
    rotor = operate_rotor(oc6.rna, WIND, PASSING)
    pressure = AIR_DENSITY * WIND**2 / 2 * np.pi * rotor_radius(oc6.rna) ** 2
    assert rotor.thrust == pytest.approx(rotor.thrust_coefficient * pressure, rel=1e-13)
    assert rotor.torque * rotor.rotor_speed == pytest.approx(
        rotor.power_coefficient * pressure * WIND, rel=1e-13
    )
    assert rotor.rotor_speed == pytest.approx(2 * np.pi * PASSING / 3, rel=1e-15)


def test_drag_costs_power_and_betz_holds(oc6: ow.Turbine) -> None:
    """Profile drag takes power, and no rotor beats 16/27."""
    good, bad = (operate_rotor(oc6.rna, WIND, PASSING, lift_to_drag=r) for r in (1e3, 30.0))
    assert bad.power_coefficient < good.power_coefficient < 16 / 27
    assert bad.thrust == pytest.approx(good.thrust, rel=1e-13)


def test_steady_load_is_thrust_and_torque_along_the_shaft(oc6: ow.Turbine) -> None:
    """The wrench at the yaw bearing, moved to the apex, is along the shaft."""
    rotor = operate_rotor(oc6.rna, WIND, PASSING)
    apex, shaft = rotor_apex(oc6.rna)
    load = steady_load(oc6.rna, rotor)
    assert_allclose(load[:3], rotor.thrust * shaft, rtol=1e-13)
    at_apex = load[3:] - np.cross(apex, load[:3])
    assert_allclose(at_apex, rotor.torque * shaft, rtol=1e-9, atol=1e-9 * rotor.torque)
    assert load[0] > 0
