"""Condensation to the mudline: against statics, secant against load, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.soils import hysteretic, layered

import offwind_pin as ow
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.foundation.pile_only import pile_only, pile_part
from offwind_pin.definitions.soil.depth_profile import DepthLine
from offwind_pin.definitions.soil.springs import LinearModulus, TanhTorsion

LOAD = np.array([6e6, 2e6, 0, 0, 0, 3e6])


@pytest.fixture(scope="module")
def system(undamped: ow.Turbine) -> ow.System:
    return ow.build(undamped, "distributed_springs", ow.StillWater())


@pytest.fixture(scope="module")
def loaded(system: ow.System) -> ow.StaticResult:
    return ow.static(system, LOAD)


def test_tangent_is_the_change_of_statics(system: ow.System, loaded: ow.StaticResult) -> None:
    """Small changes of the mudline load move the head of the pile by the flexibility.

    Static solutions of the pile alone, about the state it has under the whole structure.
    """
    tangent = condense(system, loaded)
    pile = pile_part(system)
    flexibility = np.linalg.inv(tangent.stiffness)
    steps = np.array([1e3, 1e3, 1e3, 1e4, 1e4])
    for i, step in enumerate(steps):
        change = np.eye(6)[i] * step
        ahead, behind = (ow.static(pile, tangent.load + s * change) for s in (1, -1))
        moved = (ahead.mudline_displacement - behind.mudline_displacement) / (2 * step)
        turned = (ahead.tower_top_rotation - behind.tower_top_rotation) / (2 * step)
        assert moved == pytest.approx(flexibility[:3, i], rel=1e-4, abs=1e-15)
        assert turned[:2] == pytest.approx(flexibility[3:5, i], rel=1e-3, abs=1e-15)


def test_secant_takes_the_pile_to_the_state_in_one_step(
    system: ow.System, loaded: ow.StaticResult
) -> None:
    """Secant stiffness times displacement is the load, but for weight times tilt; not so tangents."""
    secant = condense(system, loaded, stiffness="secant")
    reached = secant.stiffness @ secant.displacement
    geometric = np.linalg.norm(secant.displacement[3:]) * abs(secant.load[2])
    assert geometric < 0.02 * secant.load[0]
    assert reached[:2] == pytest.approx(secant.load[:2], abs=geometric)
    assert reached[2] == pytest.approx(secant.load[2], rel=0.02)
    assert reached[3:5] == pytest.approx(secant.load[3:5], rel=2e-3)
    tangent = condense(system, loaded)
    lack = (tangent.stiffness @ tangent.displacement)[0] - tangent.load[0]
    assert abs(lack) > 5 * geometric


def test_both_agree_without_load(system: ow.System) -> None:
    """A pile alone under its own weight: secants are tangents, and the matrix is symmetric."""
    pile = pile_part(system)
    state = ow.static(pile)
    tangent, secant = condense(pile, state), condense(pile, state, stiffness="secant")
    scale = np.sqrt(np.diag(tangent.stiffness))
    difference = (secant.stiffness - tangent.stiffness) / np.outer(scale, scale)
    assert np.max(np.abs(difference)) < 1e-9
    assert tangent.symmetry_defect < 1e-9


def test_tangent_softens_along_the_load_only(system: ow.System) -> None:
    """Across the load the exact tangent of the springs is their secant."""
    state = ow.static(system, np.array([8e6, 0, 0, 0, 0, 0]))
    tangent, secant = condense(system, state), condense(system, state, stiffness="secant")
    assert tangent.stiffness[0, 0] < 0.95 * secant.stiffness[0, 0]
    assert tangent.stiffness[1, 1] == pytest.approx(secant.stiffness[1, 1], rel=1e-3)
    assert secant.stiffness[0, 0] == pytest.approx(secant.stiffness[1, 1], rel=1e-3)


def test_load_about_another_axis_turns_the_matrix(system: ow.System) -> None:
    """The pile is round: turning its load about z by 90 degrees turns the 6x6.

    But for torsion times tilt, which joints that follow one another about x, y and z share out.
    """
    pile = pile_part(system)
    load = np.array([5e6, 1e6, -2e7, -3e7, 2e8, 0])
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    both = np.kron(np.eye(2), turn)
    one = condense(pile, ow.static(pile, load)).stiffness
    other = condense(pile, ow.static(pile, both @ load)).stiffness
    scale = np.sqrt(np.diag(other))
    assert np.max(np.abs(other - both @ one @ both.T) / np.outer(scale, scale)) < 1e-4


def test_symmetry_defect_grows_with_the_moment(system: ow.System, loaded: ow.StaticResult) -> None:
    """It is the moment over the rotational stiffness: small, and reported."""
    one = condense(system, loaded)
    assert one.symmetry_defect == pytest.approx(
        abs(one.load[4]) / np.sqrt(one.stiffness[3, 3] * one.stiffness[5, 5]), rel=0.1
    )
    assert np.array_equal(one.symmetric, one.symmetric.T)


def test_coupled_springs_of_the_condensed_stiffness(
    undamped: ow.Turbine, system: ow.System
) -> None:
    """On its own condensed 6x6 the structure keeps its first frequencies.

    The pile's own mass below the mudline is left out, which second modes feel a little.
    """
    state = ow.static(system)
    condensed = condense(system, state).replacing_soil(undamped)
    whole = ow.modes(system, n=4, about=state)
    short = ow.modes(ow.build(condensed, "coupled_springs", ow.StillWater()), n=4)
    assert short.label == whole.label
    assert short.frequency_hz[:2] == pytest.approx(whole.frequency_hz[:2], rel=1e-3)
    assert short.frequency_hz[2:] == pytest.approx(whole.frequency_hz[2:], rel=1e-2)


def test_refusals(system: ow.System, loaded: ow.StaticResult, coupled_wet: ow.System) -> None:
    with pytest.raises(ow.InputError, match="stiffness"):
        condense(system, loaded, stiffness="initial")  # type: ignore[arg-type]
    with pytest.raises(ow.InputError, match="degrees of freedom"):
        condense(system, ow.static(coupled_wet))
    with pytest.raises(ow.InputError, match="chain reaches the pile toe"):
        condense(coupled_wet, ow.static(coupled_wet))
    other = ow.static(ow.build(system.turbine, "distributed_springs", elements={"pile": 15}))
    assert condense(system, other).load == pytest.approx(other.mudline_load)
    stiff = system.turbine.materials["steel"].model_copy(update={"youngs_modulus": 100e9})
    soft = system.turbine.model_copy(update={"materials": {"steel": stiff}})
    with pytest.raises(ow.InputError, match="residual"):
        condense(ow.build(soft, "distributed_springs"), loaded)


def test_secants_take_rotational_springs_along(oc6: ow.Turbine) -> None:
    """In clay and sand by PISA the secant stiffness times the displacement is the load, moments and
    all, but for the weight on the tilt; without the rotational springs it is not."""
    pisa = layered(oc6.model_copy(update={"structural_damping": None}))
    whole = ow.build(pisa, "distributed_springs")
    state = ow.static(whole, np.array([4e6, 0, 0, 0, 0, 0]))
    names = {load.name for load in whole.foundation.soil}
    assert {"soil_rocking", "soil_friction", "soil_base_moment"} <= names
    found = condense(whole, state, stiffness="secant")
    pushed = (found.stiffness @ found.displacement)[[0, 4]]
    assert pushed == pytest.approx(found.load[[0, 4]], rel=0.02)
    assert found.stiffness[4, 4] > 1.02 * condense(whole, state).stiffness[4, 4]


def test_small_motions_about_a_held_load_see_sliders_unyielded(oc6: ow.Turbine) -> None:
    """The tangent of hysteretic springs in a loaded state is that of the unloaded ones."""
    undamped = oc6.model_copy(update={"structural_damping": None})
    elastic, sliding = (
        ow.build(turbine, "distributed_springs") for turbine in (undamped, hysteretic(undamped, 60))
    )
    load = np.array([4e6, 0, 0, 0, 0, 0])
    held = condense(sliding, ow.static(sliding, load)).stiffness
    unloaded = condense(elastic, ow.static(elastic)).stiffness
    going_on = condense(elastic, ow.static(elastic, load)).stiffness
    assert held[0, 0] == pytest.approx(unloaded[0, 0], rel=5e-3)
    assert going_on[0, 0] < 0.96 * held[0, 0]
    secant = condense(sliding, ow.static(sliding, load), stiffness="secant").stiffness
    expected = condense(elastic, ow.static(elastic, load), stiffness="secant").stiffness
    assert secant[0, 0] == pytest.approx(expected[0, 0], rel=5e-3)


@pytest.fixture(scope="module")
def held_along_the_shaft(undamped: ow.Turbine) -> ow.System:
    """A pile alone in soil that resists at the mudline too, sideways, in settlement and twist."""
    springs = undamped.soil.distributed_springs
    assert springs is not None
    uniform = DepthLine(at_mudline=1e8, source="a test's own")
    torque = DepthLine(at_mudline=1e5, source="a test's own")
    curves = {
        "curve": LinearModulus(kind="linear", modulus_n_per_m2=uniform, source="-"),
        "vertical": LinearModulus(kind="linear", modulus_n_per_m2=uniform, source="-"),
        "torsional": TanhTorsion(
            kind="tanh",
            initial_stiffness_nm_per_m_per_rad=uniform,
            ultimate_torque_nm_per_m=torque,
            source="-",
        ),
        "toe_vertical_stiffness": 0.0,
        "toe_torsional_stiffness": 0.0,
    }
    soil = undamped.soil.model_copy(
        update={"distributed_springs": springs.model_copy(update=curves)}
    )
    pile = pile_only(undamped.model_copy(update={"soil": soil}))
    return ow.build(pile, "distributed_springs")


def test_soil_at_the_head_is_no_load(held_along_the_shaft: ow.System) -> None:
    """Its node's springs belong to the pile: the load is a gram, the stiffness that of statics."""
    pile = held_along_the_shaft
    state = ow.static(pile)
    found = condense(pile, state)
    assert np.abs(found.load).max() < 0.02
    push = np.array([1e3, 0, 0, 0, 0, 0])
    ahead, behind = ow.static(pile, push), ow.static(pile, -push)
    moved = (ahead.mudline_displacement - behind.mudline_displacement)[0] / 2e3
    assert np.linalg.inv(found.stiffness)[0, 0] == pytest.approx(moved, rel=1e-6)


def test_secant_keeps_torsion(held_along_the_shaft: ow.System) -> None:
    """Secant stiffness times twist is the torque, far into the torsional curves."""
    torque = 2e6
    state = ow.static(held_along_the_shaft, np.array([0, 0, 0, 0, 0, torque]))
    secant = condense(held_along_the_shaft, state, stiffness="secant")
    tangent = condense(held_along_the_shaft, state)
    assert secant.stiffness[5, 5] * secant.displacement[5] == pytest.approx(torque, rel=1e-6)
    assert tangent.stiffness[5, 5] < 0.95 * secant.stiffness[5, 5]
