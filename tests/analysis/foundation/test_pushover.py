"""Pushover of a pile: closed forms of a rigid one, both ways of control, refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.foundation.pushover import pushover
from offwind_pin.definitions.soil.springs import CurveTable
from offwind_pin.verification.long_pile import LongPile

RIGID = LongPile(length=20.0, thickness=0.5, youngs_modulus=1e13)
RESISTANCE = 1e6  # N/m, constant with depth
PLASTIC = {
    "kind": "tanh",
    "initial_modulus_n_per_m2": {"at_mudline": 1e8},
    "ultimate_resistance_n_per_m": {"at_mudline": RESISTANCE},
}


def _failure_load(arm: float) -> float:
    """Rigid pile in soil of constant resistance, from the two equations of equilibrium.

    It turns about the depth a: H = p (2 a - L) and H e = p (L^2 / 2 - a^2), hence
    H / p = sqrt((L + 2 e)^2 + L^2) - (L + 2 e); Broms, J. Soil Mech. Found. Div. 90 (1964), 27-63.
    """
    reach = RIGID.length + 2 * arm
    return float(RESISTANCE * (np.hypot(reach, RIGID.length) - reach))


@pytest.mark.parametrize("arm", [0.0, 15.0, -5.0])
def test_rigid_pile_in_linear_soil(arm: float) -> None:
    """Displacement and rotation of a rigid bar on k: two equations, solved by hand."""
    pile = RIGID.turbine(nodes=201)
    found = pushover(pile, arm, until_load=1e6, points=4)
    k, length = RIGID.modulus, RIGID.length
    bar = k * np.array([[length, -(length**2) / 2], [-(length**2) / 2, length**3 / 3]])
    moved = np.linalg.solve(bar, [1e6, 1e6 * arm])
    assert found.load == pytest.approx(np.linspace(0, 1e6, 5), rel=1e-12)
    assert found.moment == pytest.approx(arm * found.load)
    assert found.displacement[-1] == pytest.approx(moved[0], rel=3e-3)
    assert found.rotation[-1] == pytest.approx(moved[1], rel=3e-3)


@pytest.mark.parametrize("arm", [0.0, 10.0, 60.0])
def test_rigid_pile_in_plastic_soil_fails_as_broms_says(arm: float) -> None:
    """Pushed far, the load stays at the failure load of the mechanism."""
    found = pushover(RIGID.turbine(401, PLASTIC), arm, until_displacement=0.5, points=5)
    assert found.load[0] == pytest.approx(0.0, abs=1e-3)
    assert found.load[-2:] == pytest.approx(_failure_load(arm), rel=1e-2)


def test_a_load_that_the_soil_cannot_bear_is_told() -> None:
    """The error says how far it came, and holds the states up to there."""
    failure = _failure_load(10.0)
    with pytest.raises(ow.SolverError, match="the soil fails") as told:
        pushover(RIGID.turbine(101, PLASTIC), 10.0, until_load=1.5 * failure, points=30)
    so_far = told.value.results
    assert 0.9 * failure < so_far.load[-1] < 1.01 * failure
    assert len(so_far.displacement) == len(so_far.load)
    assert np.all(np.diff(so_far.displacement) > 0)


def test_default_ends_at_a_tenth_of_the_diameter(oc6: ow.Turbine) -> None:
    found = pushover(oc6, 30.0, points=5)
    assert found.displacement == pytest.approx(0.9 * np.linspace(0, 1, 6), rel=1e-6)
    assert found.load[0] == pytest.approx(0.0, abs=1e-3)
    assert np.all(np.diff(found.load) > 0)
    assert np.all(np.diff(found.load, 2) < 0)  # the soil yields


def test_control_by_load_and_by_displacement_agree(oc6: ow.Turbine) -> None:
    by_displacement = pushover(oc6, 30.0, until_displacement=0.1, points=4)
    by_load = pushover(oc6, 30.0, until_load=float(by_displacement.load[-1]), points=7)
    assert by_load.displacement[-1] == pytest.approx(0.1, rel=1e-8)
    assert by_load.rotation[-1] == pytest.approx(by_displacement.rotation[-1], rel=1e-8)


def test_pushover_is_statics_of_the_pile(oc6: ow.Turbine) -> None:
    """The same equilibrium by the compiled solver, and by a load on a stick-up of the arm's length.

    The stick-up bends and weighs, but what reaches the mudline is the same to second order.
    """
    found = pushover(oc6, 30.0, until_load=1e7, points=1)
    load = np.array([1e7, 0, 0, 0, 3e8, 0])
    state = ow.static(ow.build(pile_only(oc6), "distributed_springs"), load)
    assert state.mudline_displacement[0] == pytest.approx(found.displacement[-1], rel=1e-9)
    tall = ow.build(pile_only(oc6, stick_up=30.0), "distributed_springs", elements={"pile": 15})
    pushed = ow.static(tall, np.array([1e7, 0, 0, 0, 0, 0]))
    assert pushed.mudline_displacement[0] == pytest.approx(found.displacement[-1], rel=2e-3)


def test_first_slope_is_the_condensed_flexibility(oc6: ow.Turbine) -> None:
    found = pushover(oc6, 20.0, until_load=1e3, points=1)
    pile = ow.build(pile_only(oc6), "distributed_springs")
    flexibility = np.linalg.inv(condense(pile, ow.static(pile)).stiffness)
    slope = flexibility @ np.array([1, 0, 0, 0, 20.0, 0])
    assert found.displacement[-1] / 1e3 == pytest.approx(slope[0], rel=1e-6)
    assert found.rotation[-1] / 1e3 == pytest.approx(slope[4], rel=1e-6)


@pytest.mark.parametrize(
    ("arguments", "where"),
    [
        ({"arm": np.nan}, "arm"),
        ({"arm": 0.0, "points": 0}, "points"),
        ({"arm": 0.0, "until_displacement": -0.1}, "until_displacement"),
        ({"arm": 0.0, "until_load": np.inf}, "until_load"),
        ({"arm": 0.0, "until_load": 1e6, "until_displacement": 0.1}, "until_displacement"),
    ],
)
def test_bad_arguments(oc6: ow.Turbine, arguments: dict[str, float], where: str) -> None:
    with pytest.raises(ow.InputError, match=where):
        pushover(oc6, **arguments)  # type: ignore[arg-type]


def test_tabulated_curves_beyond_their_last_point(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Straight pieces and a plateau: Newton's method meets the kinks, and past the plateau of every
    spring, where the pile is a mechanism, the displacement still holds it.
    """
    table = tmp_path / "curves.csv"
    rows = [
        f"{depth},{y},{share * (1e6 + 1e6 * depth)}"
        for depth in range(0, 46, 5)
        for y, share in ((0.005, 0.3), (0.02, 0.6), (0.08, 0.9), (0.2, 1.0))
    ]
    table.write_text("\n".join(["depth_m,y_m,p_n_per_m", *rows]) + "\n")
    springs = oc6.soil.distributed_springs
    assert springs is not None
    curve = CurveTable(kind="table", file=table)
    soil = oc6.soil.model_copy(
        update={"distributed_springs": springs.model_copy(update={"curve": curve})}
    )
    tabulated = oc6.model_copy(update={"soil": soil})
    found = pushover(tabulated, 30.0, until_displacement=4.0, points=8)
    assert found.displacement[-1] == pytest.approx(4.0, rel=1e-9)
    assert found.load[-1] == pytest.approx(found.load[-2], rel=3e-3)
    assert found.load[1] < 0.95 * found.load[-1]
