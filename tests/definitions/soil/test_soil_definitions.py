"""Definitions of the ground: what is accepted, and which mistake a refusal guesses."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from numpy.testing import assert_allclose
from pydantic import TypeAdapter

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.reader import find_definition, load_turbine
from offwind_pin.definitions.soil.depth_profile import DepthProfile
from offwind_pin.definitions.soil.springs import CurveTable, DampingCurve, ShaftTable, SoilDashpot

SHIPPED = yaml.safe_load(find_definition("oc6_phase2", ["oc6_phase2"], "turbine").read_text())

SAND = {
    "top_m": 0,
    "model": "api_sand",
    "friction_angle_deg": 34,
    "submerged_unit_weight_n_per_m3": 10e3,
}
CLAY = {
    "top_m": 0,
    "model": "matlock_clay",
    "undrained_shear_strength_pa": {"at_mudline": 5e3, "gradient": 1.5e3},
    "strain_50": 0.01,
    "submerged_unit_weight_n_per_m3": 8e3,
}
STIFF = {
    "top_m": 0,
    "model": "stiff_clay",
    "undrained_shear_strength_pa": 120e3,
    "strain_50": 0.005,
    "submerged_unit_weight_n_per_m3": 9e3,
}
TILL = {
    "top_m": 0,
    "model": "pisa",
    "calibration": "cowden_till",
    "undrained_shear_strength_pa": {"depth_m": [0, 20], "values": [80e3, 160e3]},
    "shear_modulus_pa": 9e7,
    "submerged_unit_weight_n_per_m3": 9e3,
}
DUNKIRK = {
    "top_m": 0,
    "model": "pisa",
    "calibration": "general_dunkirk_sand",
    "relative_density": 0.75,
    "shear_modulus_pa": {"at_mudline": 2e7, "gradient": 4e6},
    "submerged_unit_weight_n_per_m3": 10e3,
}


def layers(*items: dict[str, Any], loading: str | None = "static") -> dict[str, Any]:
    return {
        "kind": "layers",
        "layers": [*items],
        **({} if loading is None else {"loading": loading}),
    }


def turbine(folder: Path, site: dict[str, Any] | None = None, **springs: Any) -> Any:
    """The shipped turbine with other springs, by way of a file; None takes a key away."""
    data = copy.deepcopy(SHIPPED)
    data["site"] |= site or {}
    block = data["soil"]["distributed_springs"]
    block |= springs
    for key in [key for key, value in springs.items() if value is None]:
        del block[key]
    path = folder / "turbine.yaml"
    path.write_text(yaml.safe_dump(data))
    return load_turbine(path)


@pytest.mark.parametrize(
    "curve",
    [
        layers(SAND, {**CLAY, "top_m": 4}, {**STIFF, "top_m": 9}, {**TILL, "top_m": 20}),
        layers(SAND, {**CLAY, "top_m": 4}, {**STIFF, "top_m": 9, "cycles": 100}, loading="cyclic"),
        layers(DUNKIRK),
        layers({**SAND, "initial_modulus_n_per_m3": 2e7}),
    ],
    ids=["all four", "cyclic", "sand", "modulus"],
)
def test_good_layers_are_accepted(curve: dict[str, Any], tmp_path: Path) -> None:
    """Negative control of the faults below: the blocks they start from are fine."""
    found = turbine(tmp_path, curve=curve).soil.distributed_springs.curve
    assert [layer.model for layer in found.layers] == [item["model"] for item in curve["layers"]]


FAULTS: dict[str, tuple[dict[str, Any], str, str]] = {
    "no loading": (layers(SAND, loading=None), "curve.loading", "required"),
    "unknown model": (layers({**SAND, "model": "api_snad"}), "layers.0.model", "api_sand"),
    "unknown key": (layers({**SAND, "phi": 30}), "layers.0.phi", "unknown key"),
    "key of another model": (
        layers({**SAND, "undrained_shear_strength_pa": 1e5}),
        "layers.0.undrained_shear_strength_pa",
        "allowed: friction_angle_deg, initial_modulus_n_per_m3, model, source, "
        "submerged_unit_weight_n_per_m3, top_m. Remove it",
    ),
    "no layers": (layers(), "springs.curve", "no layers"),
    "first layer below": (layers({**SAND, "top_m": 2}), "springs.curve", "top_m = 0"),
    "layers not rising": (layers(SAND, {**CLAY, "top_m": 0}), "springs.curve", "increase strictly"),
    "PISA under cycles": (layers(TILL, loading="cyclic"), "springs.curve", "monotonic"),
    "cycles missing": (layers(STIFF, loading="cyclic"), "springs.curve", "Give cycles"),
    "cycles of static loading": (layers({**STIFF, "cycles": 10}), "springs.curve", "static"),
    "half a cycle": (layers({**STIFF, "cycles": 0.5}, loading="cyclic"), "cycles", "0.5"),
    "strength in kPa": (
        layers({**CLAY, "undrained_shear_strength_pa": 50}),
        "layers.0.undrained_shear_strength_pa",
        "looks like kPa",
    ),
    "gradient in kPa": (
        layers({**CLAY, "undrained_shear_strength_pa": {"gradient": 1.5}}),
        "undrained_shear_strength_pa",
        "looks like kPa",
    ),
    "strength of rock": (
        layers({**CLAY, "undrained_shear_strength_pa": 5e7}),
        "undrained_shear_strength_pa",
        "rock",
    ),
    "negative strength": (
        layers({**CLAY, "undrained_shear_strength_pa": {"at_mudline": -5e3}}),
        "undrained_shear_strength_pa.at_mudline",
        "-5000",
    ),
    "stiffness in kPa": (
        layers({**TILL, "shear_modulus_pa": 90e3}),
        "shear_modulus_pa",
        "looks like kPa or MPa",
    ),
    "stiffness of steel": (layers({**TILL, "shear_modulus_pa": 8e10}), "shear_modulus_pa", "rock"),
    "stiffness out of proportion": (
        layers({**TILL, "shear_modulus_pa": 1.5e9, "undrained_shear_strength_pa": 2e3}),
        "curve.layers.0",
        "outside the range of clay",
    ),
    "weight in kN": (
        layers({**SAND, "submerged_unit_weight_n_per_m3": 10}),
        "submerged_unit_weight_n_per_m3",
        "kN/m3",
    ),
    "total weight": (
        layers({**SAND, "submerged_unit_weight_n_per_m3": 20e3}),
        "submerged_unit_weight_n_per_m3",
        "total unit weight",
    ),
    "angle in radians": (layers({**SAND, "friction_angle_deg": 0.6}), "friction_angle", "radians"),
    "angle too steep": (layers({**SAND, "friction_angle_deg": 55}), "friction_angle_deg", "55"),
    "strain in percent": (layers({**CLAY, "strain_50": 0.5}), "strain_50", "percent"),
    "strain of nothing": (layers({**CLAY, "strain_50": 1e-5}), "strain_50", "too small for clay"),
    "J out of range": (layers({**CLAY, "j": 0.9}), "layers.0.j", "0.9"),
    "density in percent": (layers({**DUNKIRK, "relative_density": 75}), "density", "percent"),
    "modulus in MN": (
        layers({**SAND, "initial_modulus_n_per_m3": 20}),
        "initial_modulus_n_per_m3",
        "unit",
    ),
    "clay of sand": (layers({**DUNKIRK, "calibration": "cowden_till"}), "layers.0", "requires"),
    "sand of clay": (
        layers({**TILL, "calibration": "general_dunkirk_sand"}),
        "layers.0",
        "relative_density",
    ),
    "no calibration": (
        layers({key: value for key, value in TILL.items() if key != "calibration"}),
        "layers.0",
        "one of calibration and parameters",
    ),
    "unnamed ratio": (
        layers(
            {
                **{key: value for key, value in TILL.items() if key != "calibration"},
                "parameters": {
                    "soil": "clay",
                    **{
                        reaction: {
                            "initial_stiffness": {"constant": 2, "slope": 1},
                            "curvature": 0.5,
                            "ultimate_resistance": 1,
                        }
                        for reaction in ("lateral", "rocking", "base_shear", "base_moment")
                    },
                },
            }
        ),
        "parameters.lateral.initial_stiffness",
        "not given",
    ),
    "profile of unequal lengths": (
        layers({**CLAY, "undrained_shear_strength_pa": {"depth_m": [0, 5], "values": [2e4]}}),
        "undrained_shear_strength_pa",
        "one value per depth",
    ),
    "profile not rising": (
        layers({**CLAY, "undrained_shear_strength_pa": {"depth_m": [5, 5], "values": [2e4, 3e4]}}),
        "undrained_shear_strength_pa",
        "increase strictly",
    ),
    "profile of zeros": (
        layers({**CLAY, "undrained_shear_strength_pa": {"depth_m": [5], "values": [0]}}),
        "undrained_shear_strength_pa",
        "all zero",
    ),
    "profile true": (
        layers({**CLAY, "undrained_shear_strength_pa": True}),
        "undrained_shear_strength_pa",
        "true or false",
    ),
    "profile of words": (
        layers({**CLAY, "undrained_shear_strength_pa": "soft"}),
        "layers.0.undrained_shear_strength_pa",
        "valid number",
    ),
    "boundaries not rising": (
        {"kind": "table", "file": "a.csv", "boundaries_m": [5, 3]},
        "springs.curve",
        "increase strictly",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_fault_of_a_curve(fault: str, tmp_path: Path) -> None:
    """Each fault is told with its field and the likely mistake."""
    curve, field, text = FAULTS[fault]
    with pytest.raises(InputError) as caught:
        turbine(tmp_path, curve=curve)
    assert field in caught.value.where
    assert "layers.layers" not in caught.value.where
    assert text in str(caught.value)


DASHPOT = {"damping_factor": 0.03, "load_frequency_hz": 0.2}
SHAFT = {"kind": "api", "soil": "sand", "skin_friction_pa": 5e4}

SPRING_FAULTS: dict[str, tuple[dict[str, Any], str]] = {
    "nothing vertical": (
        {"toe_vertical_stiffness_n_per_m": None},
        "nothing restrains the pile vertically",
    ),
    "zero vertical": (
        {"toe_vertical_stiffness_n_per_m": 0},
        "nothing restrains the pile vertically",
    ),
    "nothing torsional": (
        {"toe_torsional_stiffness_nm_per_rad": None, "vertical": SHAFT},
        "nothing restrains the pile in torsion",
    ),
    "loss counted twice": ({"hysteretic": {"sliders": 20}, "dashpot": DASHPOT}, "count the same"),
    "few sliders": ({"hysteretic": {"sliders": 3}}, "greater than or equal to 4"),
    "many sliders": ({"hysteretic": {"sliders": 201}}, "less than or equal to 200"),
    "residual of sand": ({"vertical": {**SHAFT, "residual_ratio": 0.8}}, "leave it out for sand"),
    "no residual of clay": ({"torsional": {**SHAFT, "soil": "clay"}}, "Give it for clay"),
    "friction in kPa": ({"vertical": {**SHAFT, "skin_friction_pa": 60}}, "looks like kPa"),
    "gradient of friction in kPa": (
        {"torsional": {**SHAFT, "skin_friction_pa": {"gradient": 2.5}}},
        "looks like kPa",
    ),
    "friction of steel": ({"vertical": {**SHAFT, "skin_friction_pa": 6e7}}, "too large for soil"),
    "bearing in kPa": ({"toe_bearing": {"kind": "api", "end_bearing_pa": 12e3}}, "15000"),
    "constant dashpot that varies": (
        {
            "dashpot": {
                **DASHPOT,
                "stiffness": "initial",
                "damping_factor": {"displacement_m": [0.01, 0.1], "factor": [0.01, 0.1]},
            }
        },
        "Give a number",
    ),
    "damping of unequal lengths": (
        {
            "dashpot": {
                **DASHPOT,
                "damping_factor": {"displacement_m": [1e-3, 1], "factor": [0, 1, 1]},
            }
        },
        "one factor per",
    ),
    "damping not rising": (
        {"dashpot": {**DASHPOT, "damping_factor": {"displacement_m": [1, 0.1], "factor": [0, 1]}}},
        "increase strictly",
    ),
    "damping in percent": (
        {"dashpot": {**DASHPOT, "damping_factor": 5}},
        "less than or equal to 2",
    ),
}


@pytest.mark.parametrize("fault", SPRING_FAULTS)
def test_fault_of_springs(fault: str, tmp_path: Path) -> None:
    """Each fault is told with what to do."""
    change, text = SPRING_FAULTS[fault]
    with pytest.raises(InputError, match="distributed_springs") as caught:
        turbine(tmp_path, **({"dashpot": None} | change))
    assert text in str(caught.value)


def test_a_pile_can_be_held_by_curves_alone(tmp_path: Path) -> None:
    """Shaft and toe curves take the place of the toe's stiffnesses."""
    nothing = {"toe_vertical_stiffness_n_per_m": None, "toe_torsional_stiffness_nm_per_rad": None}
    bearing = {"kind": "api", "end_bearing_pa": 5e6}
    springs = turbine(tmp_path, **nothing, torsional=SHAFT, toe_bearing=bearing)
    springs = springs.soil.distributed_springs
    assert springs.toe_vertical_stiffness == springs.toe_torsional_stiffness == 0


def test_hysteresis_beside_a_constant_dashpot(tmp_path: Path) -> None:
    """Radiation may be added to what sliders lose."""
    dashpot = {**DASHPOT, "stiffness": "initial"}
    springs = turbine(tmp_path, hysteretic={"sliders": 20}, dashpot=dashpot)
    assert springs.soil.distributed_springs.hysteretic.sliders == 20


def test_mudline_of_a_scoured_site(tmp_path: Path) -> None:
    """Scour lowers the mudline, deposition lifts it."""
    depth = SHIPPED["site"]["water_depth_m"]
    assert turbine(tmp_path).site.mudline == -depth
    assert turbine(tmp_path, {"scour_depth_m": 3.5}).site.mudline == -depth - 3.5
    assert turbine(tmp_path, {"scour_depth_m": -2}).site.mudline == -depth + 2


@pytest.mark.parametrize(
    ("site", "text"),
    [
        ({"scour_depth_m": 51}, "scour_depth_m"),
        ({"scour_depth_m": -21}, "scour_depth_m"),
        ({"scour_depth_m": 48}, "pile toe"),
        ({"scour_depth_m": -15, "water_depth_m": 14}, "deposition"),
    ],
)
def test_scour_that_cannot_be(site: dict[str, Any], text: str, tmp_path: Path) -> None:
    """Out of range, below the toe, out of the water."""
    with pytest.raises(InputError, match=text):
        turbine(tmp_path, site)


PROFILE: TypeAdapter[Any] = TypeAdapter(DepthProfile)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (7.0, [7, 7, 7, 7, 7]),
        (3, [3, 3, 3, 3, 3]),
        ({"at_mudline": 2, "gradient": 0.5}, [2, 2, 4, 7, 22]),
        ({"depth_m": [4, 10], "values": [1, 7]}, [1, 1, 1, 7, 7]),
        ({"depth_m": [2], "values": [5]}, [5, 5, 5, 5, 5]),
    ],
    ids=["number", "integer", "line", "table", "one row"],
)
def test_profiles(data: Any, expected: list[float]) -> None:
    """A number, a line, or a table that is constant beyond its ends; above the mudline as at it."""
    depth: Array = np.array([-3.0, 0.0, 4.0, 10.0, 40.0])
    assert_allclose(PROFILE.validate_python(data).at(depth), expected)


def test_table_profile_is_linear_between() -> None:
    """Half way between two depths is half way between the values."""
    table = PROFILE.validate_python({"depth_m": [2, 6, 8], "values": [10, 30, 0]})
    assert_allclose(table.at(np.array([4.0, 7.0])), [20, 15])


def test_damping_over_displacement() -> None:
    """Linear in log y, constant beyond the ends, also at rest."""
    curve = DampingCurve(displacement_m=(1e-3, 1e-1), factor=(0.02, 0.1))
    y = np.array([0.0, 1e-4, 1e-3, 1e-2, 1e-1, 3.0])
    assert_allclose(curve.at(y), [0.02, 0.02, 0.02, 0.06, 0.1, 0.1])
    dashpot = SoilDashpot(damping_factor=curve, load_frequency_hz=0.2)
    assert dashpot.damping_factor == curve
    assert SoilDashpot(damping_factor=0.3, load_frequency_hz=0.2).damping_factor == 0.3


def test_files_are_relative_to_the_definition(tmp_path: Path) -> None:
    """Every table that a definition names is looked for beside it."""
    table = {"kind": "table", "file": "a.csv"}
    springs = turbine(tmp_path, curve=table, vertical=table, toe_bearing=table).soil
    springs = springs.distributed_springs
    assert isinstance(springs.curve, CurveTable)
    assert isinstance(springs.vertical, ShaftTable)
    for curve in (springs.curve, springs.vertical, springs.toe_bearing):
        assert curve.file == tmp_path / "a.csv"
