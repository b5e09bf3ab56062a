"""Masses and stiffness of the shipped turbine against published numbers."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.structure.section import bending_stiffness, diameter_and_thickness, lump

# OpenFAST r-test OC6_phaseII, ElastoDyn tower file: HtFract, TMassDen (kg/m), TwFAStif (N m2).
TOWER = np.array(
    [
        [0.000, 15383.91, 3.2182e12],
        [0.099, 14860.52, 2.9008e12],
        [0.199, 13321.73, 2.4236e12],
        [0.298, 11856.37, 2.0052e12],
        [0.398, 11423.77, 1.7936e12],
        [0.497, 10067.90, 1.4611e12],
        [0.597, 8785.46, 1.1748e12],
        [0.696, 7576.46, 9.3018e11],
        [0.796, 5640.45, 6.3444e11],
        [0.895, 4614.37, 4.7280e11],
        [1.000, 4382.05, 4.0493e11],
    ]
)


def density_of_mass(oc6: ow.Turbine) -> Array:
    """rho A at the tower's stations in kg/m."""
    tower = oc6.members[1]
    outer, wall = diameter_and_thickness(tower, np.array([s.z for s in tower.stations]))
    return oc6.materials["steel"].density * np.pi / 4 * (outer**2 - (outer - 2 * wall) ** 2)


def test_tower_mass_as_published(oc6: ow.Turbine) -> None:
    """With rho A linear between the published fractions the tower weighs 1,032,399 kg."""
    height = oc6.yaw_bearing - 10.0
    mass = np.trapezoid(density_of_mass(oc6), TOWER[:, 0] * height)
    assert mass == pytest.approx(1_032_399, abs=1.0)


def test_tower_mass_of_the_frusta(oc6: ow.Turbine) -> None:
    """With diameter and wall linear it weighs 0.045 % less: A = pi (D - t) t is a parabola.

    Its exact integral over a span L is the trapezoid less pi L dt (dD - dt) / 6.
    """
    tower = oc6.members[1]
    z, outer, wall = (
        np.array([getattr(s, name) for s in tower.stations])
        for name in ("z", "diameter", "thickness")
    )
    bulge = np.pi / 6 * np.diff(z) * np.diff(wall) * (np.diff(outer) - np.diff(wall))
    exact = np.trapezoid(density_of_mass(oc6), z) - 8500.0 * bulge.sum()
    mass = lump(oc6, 10.0, oc6.yaw_bearing).mass
    assert mass == pytest.approx(exact, rel=1e-13)
    assert mass == pytest.approx(1_032_399, rel=5e-4)


def test_monopile_mass(oc6: ow.Turbine) -> None:
    """The monopile from the mudline to +10 m weighs 1,044,536 kg, to the kilogram."""
    assert lump(oc6, -30.0, 10.0).mass == pytest.approx(1_044_536, abs=0.6)


def test_stations_stand_where_the_table_puts_them(oc6: ow.Turbine) -> None:
    """Heights agree with the published fractions, which are cut to three decimals."""
    tower = oc6.members[1]
    fraction = [(s.z - tower.bottom) / (tower.top - tower.bottom) for s in tower.stations]
    assert_allclose(fraction, TOWER[:, 0], atol=1e-3)


def test_tower_mass_per_length(oc6: ow.Turbine) -> None:
    """rho A at the stations to the two decimals that are published."""
    assert_allclose(density_of_mass(oc6), TOWER[:, 1], atol=0.0051)


def test_tower_bending_stiffness(oc6: ow.Turbine) -> None:
    """EI at the stations to the five digits that are published."""
    tower = oc6.members[1]
    height = np.array([station.z for station in tower.stations])
    stiffness = bending_stiffness(tower, oc6.materials["steel"], height)
    last_digit = 10 ** (np.floor(np.log10(TOWER[:, 2])) - 4)
    assert np.all(np.abs(stiffness - TOWER[:, 2]) <= 0.51 * last_digit)
