"""Layers, overburden and scour around a pile."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.springs import DistributedSprings, LateralCurve, LinearModulus
from offwind_pin.loads.soil.curves.layered import (
    base_moment_curve,
    base_shear_curve,
    lateral_curves,
    rocking_curves,
)
from offwind_pin.loads.soil.soil_profile import PileNodes, effective_stress, layer_index
from offwind_pin.loads.soil.warnings import cautions

LAYERS: list[dict[str, Any]] = [
    {
        "top_m": 0,
        "model": "api_sand",
        "friction_angle_deg": 33,
        "submerged_unit_weight_n_per_m3": 10e3,
    },
    {
        "top_m": 6,
        "model": "matlock_clay",
        "undrained_shear_strength_pa": {"gradient": 4e3},
        "strain_50": 0.01,
        "submerged_unit_weight_n_per_m3": 8e3,
    },
    {
        "top_m": 15,
        "model": "pisa",
        "calibration": "cowden_till",
        "undrained_shear_strength_pa": {"depth_m": [15, 30], "values": [1e5, 2e5]},
        "shear_modulus_pa": {"depth_m": [15, 30], "values": [8e7, 2e8]},
        "submerged_unit_weight_n_per_m3": 9e3,
    },
]


def layered(layers: list[dict[str, Any]] = LAYERS, loading: str = "static") -> LayeredGround:
    return LayeredGround.model_validate({"kind": "layers", "loading": loading, "layers": layers})


def nodes(depth: Any, scour: float = 0.0, diameter: float = 7.0, length: float = 28.0) -> PileNodes:
    depth = np.asarray(depth, dtype=float)
    return PileNodes(depth, np.full(len(depth), diameter), length, scour)


def springs(curve: LateralCurve, nodes: int = 101, **more: Any) -> DistributedSprings:
    return DistributedSprings(
        nodes=nodes,
        curve=curve,
        toe_vertical_stiffness_n_per_m=1e9,
        toe_torsional_stiffness_nm_per_rad=1e9,
        **more,
    )


def test_layer_of_a_node() -> None:
    """A node takes the layer it lies in; exactly on a boundary the one below."""
    depth = [0.0, 5.999, 6.0, 6.0 - 1e-13, 14.9, 15.0, 28.0]
    assert layer_index(layered().layers, nodes(depth)).tolist() == [0, 0, 1, 1, 1, 2, 2]


def test_overburden() -> None:
    """Weights add up through the layers: 10 * 6 + 8 * 9 + 9 * 3 kPa at 18 m."""
    stress = effective_stress(layered().layers, nodes([0.0, 6.0, 10.0, 18.0]))
    assert_allclose(stress, [0.0, 60e3, 92e3, 159e3], rtol=1e-14)


def test_scour_takes_weight_and_depth_but_no_ground() -> None:
    """2 m of scour: 8 m below the actual mudline is 10 m below the original one, 20 kPa lighter."""
    scoured = nodes([0.0, 4.0, 8.0], scour=2.0)
    assert_allclose(effective_stress(layered().layers, scoured), [0.0, 40e3, 72e3], rtol=1e-14)
    assert layer_index(layered().layers, scoured).tolist() == [0, 1, 1]


def test_deposited_soil_is_that_of_the_top_layer() -> None:
    """3 m of deposition add 30 kPa below and have the first layer's properties."""
    covered = nodes([0.0, 1.0, 3.0, 9.0], scour=-3.0)
    assert_allclose(effective_stress(layered().layers, covered), [0.0, 10e3, 30e3, 90e3])
    assert layer_index(layered().layers, covered).tolist() == [0, 0, 0, 1]


def test_scoured_clay_by_hand() -> None:
    """Strength at the original depth, overburden and depth factor from the actual mudline."""
    curves = lateral_curves(layered(), nodes([8.0], scour=2.0))
    strength = 4e3 * 10.0
    ultimate = min(9 * strength * 7, (3 * strength + 72e3) * 7 + 0.5 * strength * 8)
    assert curves.ultimate[0] == pytest.approx(ultimate, rel=1e-13)


def test_scour_down_to_a_uniform_ground_changes_nothing() -> None:
    """In a ground whose properties do not vary the curves follow the mudline down."""
    uniform = layered([LAYERS[0]])
    y = np.full(4, 0.02)
    depth = [0.5, 3.0, 9.0, 20.0]
    expected = lateral_curves(uniform, nodes(depth)).resistance(y)
    for scour in (-2.0, 4.0):
        found = lateral_curves(uniform, nodes(depth, scour)).resistance(y)
        assert_allclose(found, expected, rtol=1e-12)


def test_scour_weakens() -> None:
    """At one height of a pile in layered ground the resistance falls with scour."""
    original = np.array([8.0, 10.0, 20.0])
    before = lateral_curves(layered(), nodes(original)).ultimate
    after = lateral_curves(layered(), nodes(original - 3.0, scour=3.0)).ultimate
    assert np.all(after < before)


def test_other_curves_follow_the_actual_mudline() -> None:
    """Linear curves count depth from the actual mudline, so that scour takes the top down."""
    line = LinearModulus.model_validate({"kind": "linear", "modulus_n_per_m2": {"gradient": 1e6}})
    assert lateral_curves(line, nodes([4.0], scour=3.0)).secant(np.zeros(1))[0] == 4e6


def test_nodes_keep_their_order() -> None:
    """Nodes from the toe upwards get the curves of nodes from the mudline down, turned round."""
    depth = np.linspace(0.5, 28.0, 12)
    y = np.full(12, 0.03)
    down = lateral_curves(layered(), nodes(depth)).resistance(y)
    up = lateral_curves(layered(), nodes(depth[::-1])).resistance(y)
    assert_allclose(up[::-1], down, rtol=1e-15)


def test_rocking_only_in_pisa_layers() -> None:
    """Other layers resist no rotation; without a PISA layer there is none at all."""
    found = rocking_curves(layered(), nodes([3.0, 16.0, 9.0, 25.0]))
    assert found is not None
    places, rocking = found
    assert places.tolist() == [1, 3]
    assert np.all(rocking.curves.secant(np.zeros(2)) > 0)
    assert not rocking.by_lateral.any()
    assert rocking_curves(layered(LAYERS[:2]), nodes([3.0])) is None


def test_base_curves_are_of_the_layer_at_the_toe() -> None:
    """The toe decides, whatever the nodes are."""
    for base in (base_shear_curve, base_moment_curve):
        deep, shallow = nodes([3.0], length=16.0), nodes([3.0], length=10.0)
        found = base(layered(), deep)
        assert found is not None
        assert len(found) == 1
        assert found.ultimate[0] > 0
        assert base(layered(), shallow) is None


def told(curve: LateralCurve, ground: PileNodes, **more: Any) -> str:
    return "\n".join(cautions(springs(curve, **more), ground))


def test_cautions_name_what_is_outside() -> None:
    """Each layer that the pile touches is told, others not."""
    deep = told(layered(), nodes([1.0, 8.0, 20.0]))
    for text in ("api_sand layer from 0 m", "matlock_clay layer from 6 m", "7 m"):
        assert text in deep
    assert "L/D" not in deep
    assert "matlock" not in told(layered(), nodes([1.0], length=14.0))
    assert "L/D from 2 to 6; this pile has L/D = 1.43" in told(
        layered(), nodes([20.0], length=10.0)
    )
    slender = nodes([1.0, 8.0], diameter=1.8, length=10.0)
    assert told(layered(LAYERS[:2]), slender) == ""


def test_cautions_of_sand_and_shaft() -> None:
    """Friction angle, relative density, strength of soft clay, t-z curves."""
    slender = nodes([1.0, 5.0], diameter=1.8, length=9.0)
    sand = {**LAYERS[0], "friction_angle_deg": 44}
    assert "friction angle of 44" in told(layered([sand]), slender)
    clay = {**LAYERS[1], "top_m": 0, "undrained_shear_strength_pa": 150e3}
    assert "soft clay" in told(layered([clay]), slender)
    loose = {
        "top_m": 0,
        "model": "pisa",
        "calibration": "general_dunkirk_sand",
        "relative_density": 0.3,
        "shear_modulus_pa": 5e7,
        "submerged_unit_weight_n_per_m3": 9e3,
    }
    assert "relative density of 0.3" in told(layered([loose]), nodes([5.0]))
    assert told(layered([{**loose, "relative_density": 0.6}]), nodes([5.0])) == ""
    shaft = {"kind": "api", "soil": "sand", "skin_friction_pa": 5e4}
    line = LinearModulus.model_validate({"kind": "linear", "modulus_n_per_m2": 1e6})
    assert "t-z" in told(line, nodes([5.0]), vertical=shaft)
    assert told(line, nodes([5.0])) == ""


def test_cautions_of_nodes_and_of_layers_below_the_toe() -> None:
    """Nodes far apart, and a layer that the pile never reaches."""
    pile = nodes([1.0, 8.0], diameter=1.8, length=10.0)
    assert "soil nodes are 5 m apart" in told(layered(LAYERS[:2]), pile, nodes=3)
    assert "apart" not in told(layered(LAYERS[:2]), pile, nodes=41)
    assert "layer from 6 m: the pile ends above it" in told(
        layered(LAYERS[:2]), nodes([1.0], diameter=1.8, length=5.0), nodes=41
    )
