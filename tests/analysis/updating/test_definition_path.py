"""Numbers of a definition by dotted paths."""

from __future__ import annotations

import pytest

import offwind_pin as ow
from offwind_pin.analysis.updating.definition_path import number_at, with_number

GRADIENT = "soil.distributed_springs.curve.initial_modulus.gradient"


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (GRADIENT, 4.5e7),
        ("soil.distributed_springs.curve.initial_modulus_n_per_m2.gradient", 4.5e7),
        ("site.water_depth_m", 30.0),
        ("materials.steel.youngs_modulus", 210e9),
        ("members.1.stations.0.diameter", 8.30),
        ("soil.distributed_springs.nodes", 61),
        ("soil.coupled_springs.stiffness.0.4", -5.015421e10),
    ],
)
def test_numbers_are_read_and_replaced(oc6: ow.Turbine, path: str, value: float) -> None:
    """Fields by either name, keys and places; the rest stays, and the original too."""
    assert number_at(oc6, path) == value
    if path.endswith("0.4"):
        return  # one entry alone would make the matrix unsymmetric
    changed = with_number(oc6, path, round(1.1 * value))
    assert number_at(changed, path) == round(1.1 * value)
    assert number_at(oc6, path) == value
    assert with_number(changed, path, value) == oc6


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("soil.distributed_spring.curve", "Did you mean 'distributed_springs'"),
        ("soil.distributed_springs.curve.initial_modulus.gradiant", "Did you mean 'gradient'"),
        ("members.7.stations.0.z", "allowed: 0, 1"),
        ("materials.stel.density", "Did you mean 'steel'"),
        ("site.gravity.more", "'site.gravity' has no further steps"),
        ("soil", "the path of a number"),
        ("name", "the path of a number"),
        ("", "step 1"),
    ],
)
def test_paths_that_lead_nowhere(oc6: ow.Turbine, path: str, message: str) -> None:
    with pytest.raises(ow.InputError, match=message):
        number_at(oc6, path)


def test_limits_of_the_definition_hold(oc6: ow.Turbine) -> None:
    """A number is checked where it is, and with all that it must fit."""
    with pytest.raises(ow.InputError, match="greater than or equal to 0"):
        with_number(oc6, GRADIENT, -1.0)
    with pytest.raises(ow.InputError, match="is below the pile"):
        with_number(oc6, "site.water_depth", 80.0)
    with pytest.raises(ow.InputError, match="not symmetric"):
        with_number(oc6, "soil.coupled_springs.stiffness.0.4", 0.0)
