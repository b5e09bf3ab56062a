"""Stiffnesses and masses without proportion: an error of the solver, no traceback."""

from __future__ import annotations

import copy
from importlib import resources
from typing import Any

import pytest
import yaml

import offwind_pin as ow

SHIPPED: dict[str, Any] = yaml.safe_load(
    (resources.files("offwind_pin.definitions") / "library" / "oc6_phase2.yaml").read_text()
)


@pytest.mark.parametrize("value", [2.5, 1e20])
def test_torsional_spring_of_another_order(value: float) -> None:
    """Ten orders away from the others: solved or refused."""
    data = copy.deepcopy(SHIPPED)
    del data["structural_damping"]
    data["soil"]["coupled_springs"]["stiffness"][5][5] = value
    system = ow.build(ow.Turbine.model_validate(data), "coupled_springs", elements=4)
    try:
        lowest = ow.modes(system, 2).frequency_hz.min()
    except ow.SolverError:
        return
    assert lowest > 0


def test_rotor_of_impossible_inertia() -> None:
    data = copy.deepcopy(SHIPPED)
    del data["structural_damping"]
    data["rna"]["generator_inertia_kg_m2"] = 1e20
    system = ow.build(
        ow.Turbine.model_validate(data), "coupled_springs", ow.StillWater(), elements=3
    )
    with pytest.raises(ow.SolverError, match="natural modes"):
        ow.modes(system, 2)
