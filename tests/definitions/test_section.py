"""Sections of the structure at a height, by closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.structure.section import bending_stiffness, lump


def test_uniform_tube_by_hand(oc6: ow.Turbine) -> None:
    """The monopile is 9 m by 110 mm from end to end."""
    outer, inner = 9.0, 9.0 - 0.22
    second = math.pi / 64 * (outer**4 - inner**4)
    for z in (-75.0, -30.0, 9.0):
        section = oc6.section(z)
        assert (section.member, section.material) == ("monopile", "steel")
        assert (section.diameter, section.thickness) == (9.0, 0.11)
        assert section.inner_diameter == pytest.approx(inner)
        assert section.area == pytest.approx(math.pi / 4 * (outer**2 - inner**2), rel=1e-12)
        assert section.second_moment == pytest.approx(second, rel=1e-12)
        assert section.section_modulus == pytest.approx(second / (outer / 2), rel=1e-12)
        assert section.polar_moment == pytest.approx(2 * second, rel=1e-12)


def test_taper_is_linear(oc6: ow.Turbine) -> None:
    """Halfway between two stations both dimensions are the means of theirs."""
    tower = next(member for member in oc6.members if member.name == "tower")
    for low, high in zip(tower.stations, tower.stations[1:], strict=False):
        section = oc6.section((low.z + high.z) / 2)
        assert section.diameter == pytest.approx((low.diameter + high.diameter) / 2)
        assert section.thickness == pytest.approx((low.thickness + high.thickness) / 2)


def test_a_step_has_two_sides(oc6: ow.Turbine) -> None:
    """Where the tower stands on the monopile its own section counts unless that below is asked for."""
    assert oc6.section(10.0) == oc6.section(10.0, "above")
    assert oc6.section(10.0).diameter == 8.3
    assert oc6.section(10.0, "below").diameter == 9.0
    # no step within a member, and one side only at both ends
    for z in (20.51, -75.0, oc6.yaw_bearing):
        assert oc6.section(z, "above") == oc6.section(z, "below")


def test_mass_of_a_tapered_member(oc6: ow.Turbine) -> None:
    """Density times area, by Gauss over each linear piece, weighs what the chain's frusta weigh."""
    node, weight = np.polynomial.legendre.leggauss(3)
    tower = next(member for member in oc6.members if member.name == "tower")
    bare = oc6.model_copy(update={"point_masses": ()})
    mass = 0.0
    for low, high in zip(tower.stations, tower.stations[1:], strict=False):
        half = (high.z - low.z) / 2
        area = [oc6.section(low.z + half * (1 + x)).area for x in node]
        mass += oc6.materials["steel"].density * half * float(weight @ area)
    assert mass == pytest.approx(lump(bare, tower.bottom, tower.top).mass, rel=1e-12)


def test_stiffness_is_that_of_the_chain(oc6: ow.Turbine) -> None:
    """Young's modulus times the second moment is the chain's bending stiffness."""
    steel = oc6.materials["steel"]
    for member in oc6.members:
        for z in np.linspace(member.bottom + 0.1, member.top - 0.1, 7):
            expected = bending_stiffness(member, steel, np.array([z]))[0]
            found = steel.youngs_modulus * oc6.section(float(z)).second_moment
            assert found == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((-75.1,), ["z", "-75.1", "-75 to 115.63"]),
        ((116.0,), ["z", "116.0"]),
        ((float("nan"),), ["z", "nan"]),
        ((10.0, "inside"), ["side", "inside", "above or below"]),
    ],
)
def test_what_is_no_section(oc6: ow.Turbine, arguments: Any, words: list[str]) -> None:
    with pytest.raises(ow.InputError) as error:
        oc6.section(*arguments)
    assert [word for word in words if word not in str(error.value)] == []
