"""Coefficients that vary over height or with the Keulegan-Carpenter number."""

from typing import Any

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.definitions.hydrodynamics import Hydrodynamics, coefficient_at
from offwind_pin.loads.sea.forces.keulegan_carpenter import keulegan_carpenter
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel

BASE: dict[str, Any] = {"added_mass_coefficient": 1.0, "drag_coefficient": 1.0}


def hydrodynamics(**keys: Any) -> Hydrodynamics:
    return Hydrodynamics.model_validate(BASE | keys)


def test_a_number_stays_a_number() -> None:
    assert hydrodynamics().drag_coefficient == 1.0
    assert coefficient_at(0.7, np.zeros(3), np.zeros(3)).tolist() == [0.7, 0.7, 0.7]


def test_over_height() -> None:
    """Linear between the heights, constant beyond; whatever the Keulegan-Carpenter number."""
    table = hydrodynamics(drag_coefficient={"z_m": [-20, -10, 0], "value": [0.6, 1.0, 1.4]})
    z = np.array([-30.0, -20.0, -15.0, -2.5, 4.0])
    found = coefficient_at(table.drag_coefficient, z, np.full(5, 99.0))
    assert found == pytest.approx([0.6, 0.6, 0.8, 1.3, 1.4])


def test_over_the_keulegan_carpenter_number() -> None:
    table = hydrodynamics(
        added_mass_coefficient={"keulegan_carpenter": [3, 17], "value": [1.0, 0.4]}
    )
    number = np.array([0.0, 3.0, 10.0, 40.0])
    found = coefficient_at(table.added_mass_coefficient, np.zeros(4), number)
    assert found == pytest.approx([1.0, 1.0, 0.7, 0.4])


def test_number_of_a_regular_wave() -> None:
    """u_m T / D of its own; a mean and the vertical motion do not count."""
    omega = np.array([0.0, 0.8])
    velocity = np.zeros((3, 2, 2), dtype=complex)
    velocity[0] = [[0.5, 1.2 * np.exp(0.3j)], [0.5, 0.3]]
    velocity[2, :, 1] = 5.0
    found = keulegan_carpenter(velocity, omega, np.array([2.0, 4.0]))
    period = 2 * np.pi / 0.8
    assert found == pytest.approx([1.2 * period / 2.0, 0.3 * period / 4.0], rel=1e-13)
    turned = velocity.copy()
    turned[1] = turned[0] * 0.6
    turned[0] *= 0.8
    assert keulegan_carpenter(turned, omega, np.array([2.0, 4.0])) == pytest.approx(found)


def test_number_of_an_irregular_sea_by_its_orbits() -> None:
    """2 pi sqrt(2) sigma / D of the path that a particle goes, by summing up its velocity."""
    rng = np.random.default_rng(1)
    harmonic = np.arange(40, 120)
    omega = 2 * np.pi * harmonic / 600.0
    velocity = np.zeros((3, 1, len(omega)), dtype=complex)
    velocity[0, 0] = 0.2 * rng.random(80) * np.exp(2j * np.pi * rng.random(80))
    velocity[1, 0] = 0.1 * rng.random(80) * np.exp(2j * np.pi * rng.random(80))
    time = np.linspace(0.0, 600.0, 24001)
    path = np.zeros((2, len(time)))
    for i in range(2):
        speed = (velocity[i, 0] @ np.exp(1j * np.outer(omega, time))).real
        path[i] = np.append(0.0, np.cumsum((speed[1:] + speed[:-1]) / 2)) * time[1]
    sigma = np.sqrt(np.sum(path[:, :-1].var(axis=1)))
    found = keulegan_carpenter(velocity, omega, np.array([3.0]))[0]
    assert found == pytest.approx(2 * np.pi * np.sqrt(2) * sigma / 3.0, rel=1e-3)


def test_still_water_has_none() -> None:
    nothing = np.zeros((3, 2, 0), dtype=complex)
    assert keulegan_carpenter(nothing, np.zeros(0), np.ones(2)).tolist() == [0.0, 0.0]


def test_strips_take_the_coefficient_of_their_number(oc6: ow.Turbine) -> None:
    """In a sea the tables are read at the numbers of the strips, which grow to the surface."""
    table = hydrodynamics(
        drag_coefficient={"keulegan_carpenter": [0, 10], "value": [0.0, 10.0]},
        added_mass_coefficient={"z_m": [-30, 0], "value": [0.0, 3.0]},
    )
    turbine = oc6.model_copy(update={"hydrodynamics": table})
    still = HydrodynamicModel.of(turbine, ow.StillWater())
    assert np.all(still.drag == 0)
    model = HydrodynamicModel.of(turbine, ow.IrregularWaves(6.0, 10.0, seed=1, repeat_period=600.0))
    assert np.all(np.diff(model.drag) > 0)
    assert model.added_mass == pytest.approx(3 * (1 + model.strips.height / 30), rel=1e-12)
    # in deep water orbits are as high as the waves: 2 pi sqrt(2) Hs / 4 over 9 m, and more with the
    # coth kh of this depth
    least = 2 * np.pi * np.sqrt(2) * 6.0 / 4 / 9.0
    assert least < model.drag[-1] < 1.5 * least
