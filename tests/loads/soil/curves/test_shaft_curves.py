"""t-z, torsion and Q-z curves against API's tables, written out here."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from offwind_pin.definitions.soil.springs import DistributedSprings
from offwind_pin.loads.soil.curves.shaft_and_tip import (
    toe_bearing_curve,
    torsional_curves,
    vertical_curves,
)
from offwind_pin.loads.soil.soil_profile import PileNodes

DIAMETER = 6.0
NODES = PileNodes(np.array([2.0, 10.0]), np.full(2, DIAMETER), 30.0)
FRICTION = {"depth_m": [0, 20], "values": [10e3, 90e3]}
F = np.array([18e3, 50e3])
"""Unit skin friction at the two nodes."""

CLAY = [
    (0, 0),
    (0.0016, 0.3),
    (0.0031, 0.5),
    (0.0057, 0.75),
    (0.008, 0.9),
    (0.01, 1.0),
    (0.02, 0.8),
]
TOE = [(0, 0), (0.002, 0.25), (0.013, 0.5), (0.042, 0.75), (0.073, 0.9), (0.1, 1.0)]
DISPLACEMENTS = [1e-5, 1e-4, 1e-3, 2.5e-3, 0.01, 0.03, 0.05, 0.09, 0.3, 2.0]


def springs(**curves: Any) -> DistributedSprings:
    return DistributedSprings.model_validate(
        {
            "nodes": 2,
            "curve": {"kind": "linear", "modulus_n_per_m2": 1e7},
            "toe_vertical_stiffness_n_per_m": 1e9,
            "toe_torsional_stiffness_nm_per_rad": 1e9,
            **curves,
        }
    )


def api(soil: str) -> dict[str, Any]:
    residual = {"residual_ratio": 0.8} if soil == "clay" else {}
    return {"kind": "api", "soil": soil, "skin_friction_pa": FRICTION, **residual}


def friction(soil: str, z: float) -> float:
    """t / t_max."""
    if soil == "sand":
        return min(z / 2.5e-3, 1.0)
    return float(np.interp(z / DIAMETER, *np.array(CLAY, dtype=float).T))


@pytest.mark.parametrize("soil", ["sand", "clay"])
def test_vertical(soil: str) -> None:
    """t = pi D f: in sand in full at 2.5 mm, in clay by z / D with a residual."""
    curves = vertical_curves(springs(vertical=api(soil)), NODES)
    assert curves is not None
    for z in DISPLACEMENTS:
        expected = math.pi * DIAMETER * F * friction(soil, z)
        assert_allclose(curves.resistance(np.full(2, z)), expected, rtol=1e-10)
    assert_allclose(curves.ultimate, math.pi * DIAMETER * F, rtol=1e-14)


@pytest.mark.parametrize("soil", ["sand", "clay"])
def test_torsional(soil: str) -> None:
    """The wall moves by theta D / 2 and pulls at D / 2: pi D^2 / 2 f(theta D / 2)."""
    curves = torsional_curves(springs(torsional=api(soil)), NODES)
    assert curves is not None
    for z in DISPLACEMENTS:
        twist = z / (DIAMETER / 2)
        expected = math.pi * DIAMETER**2 / 2 * F * friction(soil, z)
        assert_allclose(curves.resistance(np.full(2, twist)), expected, rtol=1e-10)


@pytest.mark.parametrize("area", [None, 1.7])
def test_toe_bearing(area: float | None) -> None:
    """Q-z by z / D on the gross section, or on a given area."""
    curve = toe_bearing_curve(
        springs(toe_bearing={"kind": "api", "end_bearing_pa": 6e6, "area_m2": area}), NODES
    )
    assert curve is not None
    full = 6e6 * (area or math.pi * DIAMETER**2 / 4)
    for z in DISPLACEMENTS:
        expected = full * np.interp(z / DIAMETER, *np.array(TOE, dtype=float).T)
        assert_allclose(curve.resistance(np.array([z])), [expected], rtol=1e-10)


def test_none_without_a_definition() -> None:
    """What is not given does not act."""
    for curves in (vertical_curves, torsional_curves, toe_bearing_curve):
        assert curves(springs(), NODES) is None


@pytest.mark.parametrize(
    ("make", "key", "linear", "tanh"),
    [
        (
            vertical_curves,
            "vertical",
            {"modulus_n_per_m2": 4e6},
            {"initial_modulus_n_per_m2": 4e6, "ultimate_resistance_n_per_m": 5e5},
        ),
        (
            torsional_curves,
            "torsional",
            {"stiffness_nm_per_m_per_rad": 4e6},
            {"initial_stiffness_nm_per_m_per_rad": 4e6, "ultimate_torque_nm_per_m": 5e5},
        ),
        (
            toe_bearing_curve,
            "toe_bearing",
            {"stiffness_n_per_m": 4e6},
            {"initial_stiffness_n_per_m": 4e6, "ultimate_resistance_n": 5e5},
        ),
    ],
    ids=["vertical", "torsional", "toe"],
)
def test_lines_and_tanh(make: Any, key: str, linear: Any, tanh: Any) -> None:
    """k x and u tanh(k x / u)."""
    straight = make(springs(**{key: {"kind": "linear", **linear}}), NODES)
    bent = make(springs(**{key: {"kind": "tanh", **tanh}}), NODES)
    x = np.full(len(straight), 0.2)
    assert_allclose(straight.resistance(x), 8e5)
    assert_allclose(bent.resistance(x), 5e5 * math.tanh(1.6), rtol=1e-12)


@pytest.mark.parametrize(
    ("make", "key", "text"),
    [
        (vertical_curves, "vertical", "depth_m,z_m,t_n_per_m\n0,0.01,1e5\n20,0.01,3e5\n"),
        (
            torsional_curves,
            "torsional",
            "depth_m,twist_rad,torque_nm_per_m\n0,0.01,1e5\n20,0.01,3e5\n",
        ),
        (toe_bearing_curve, "toe_bearing", "z_m,q_n\n0.01,1e5\n0.1,1.2e5\n"),
    ],
    ids=["vertical", "torsional", "toe"],
)
def test_tables(make: Any, key: str, text: str, tmp_path: Path) -> None:
    """Each table has columns of its own; those along the shaft are interpolated in depth."""
    path = tmp_path / "curves.csv"
    path.write_text(text)
    curves = make(springs(**{key: {"kind": "table", "file": path}}), NODES)
    found = curves.resistance(np.full(len(curves), 0.01))
    assert_allclose(found, [1e5] if key == "toe_bearing" else [1.2e5, 2e5])
