"""Foundations that stand for another, and a mudline that has moved."""

from pathlib import Path

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.equivalent import (
    condensed_stiffness,
    equivalent_cantilever,
)
from offwind_pin.analysis.foundation.registry import FOUNDATIONS, described_foundations
from offwind_pin.definitions.soil.springs import ApparentFixity, MacroElementCalibration
from offwind_pin.definitions.turbine import Turbine

THRUST = np.array([1.1e6, 0, 0, 0, 0, 0])


def with_soil(turbine: Turbine, **blocks: object) -> Turbine:
    return turbine.model_copy(update={"soil": turbine.soil.model_copy(update=blocks)})


@pytest.mark.parametrize("name", FOUNDATIONS)
def test_all_five_run_statics_modes_and_time(undamped: Turbine, name: str) -> None:
    """Each leans downwind under a thrust, has its first mode where the others have it, and moves."""
    system = ow.build(undamped, name, ow.StillWater())
    state = ow.static(system, THRUST)
    assert 0.1 < state.tower_top_displacement[0] < 0.2
    modes = ow.modes(system, 5, state)
    assert modes.frequency_hz[modes.index("FA1")] == pytest.approx(0.255, rel=0.08)
    history = ow.simulate(system, 0.4, 0.02, [THRUST])
    assert history["tower_top_displacement"].values[-1, 0] == pytest.approx(
        state.tower_top_displacement[0], rel=1e-6
    )


def test_those_that_a_turbine_describes(oc6: Turbine) -> None:
    """The names in the order of the interface, those without numbers left out."""
    assert described_foundations(oc6) == list(FOUNDATIONS)
    bare = with_soil(oc6, distributed_springs=None, macro_element=None)
    assert described_foundations(bare) == ["clamped", "apparent_fixity", "coupled_springs"]


def test_cantilever_moves_as_the_6x6() -> None:
    """By the closed form of a cantilever, at any arm; without one, by the force alone."""
    stiffness = np.diag([6.3e9, 6.3e9, 1e10, 8.1e11, 8.1e11, 2.5e11])
    stiffness[0, 4] = stiffness[4, 0] = -5.0e10
    stiffness[1, 3] = stiffness[3, 1] = 5.0e10
    for arm in (0.0, 20.0, 150.0, 1e4):
        length, bending = equivalent_cantilever(stiffness, arm)
        shift = (length**3 / 3 + arm * length**2 / 2) / bending
        turn = (length**2 / 2 + arm * length) / bending
        moved = np.linalg.solve(stiffness[np.ix_([0, 4], [0, 4])], [1.0, arm])
        assert (shift, turn) == pytest.approx(tuple(moved), rel=1e-10)
    uneven = stiffness.copy()
    uneven[3, 3] *= 1.01
    with pytest.raises(ow.InputError, match="both planes"):
        equivalent_cantilever(uneven, 100.0)
    wrong = stiffness.copy()
    wrong[[0, 4, 1, 3], [4, 0, 3, 1]] *= -1
    with pytest.raises(ow.InputError, match="sign of the coupling"):
        equivalent_cantilever(wrong, 1.0)


def test_apparent_fixity_is_right_at_its_arm(undamped: Turbine) -> None:
    """Under a thrust the mudline moves and turns as on the 6x6; under a moment alone less so."""
    apart = {}
    for load in (THRUST, np.array([0, 0, 0, 0, 1e8, 0])):
        moved = []
        for name in ("apparent_fixity", "coupled_springs"):
            system = ow.build(undamped, name)
            free = ow.static(system)
            state = ow.static(system, load)
            at = int(np.argmin(np.abs(state.height - undamped.site.mudline)))
            shift = state.displacement[at, 0] - free.displacement[at, 0]
            moved.append([shift, state.rotation[at, 1] - free.rotation[at, 1]])
        apart[load[0]] = np.abs(np.array(moved[0]) / moved[1] - 1)
    assert np.max(apart[THRUST[0]]) < 3e-3
    assert 3e-3 < np.max(apart[0.0]) < 0.2


def test_apparent_fixity_takes_the_springs_too(undamped: Turbine) -> None:
    """From the condensed springs it is the longer cantilever, as they are the softer foundation."""
    lengths = []
    for source in ("coupled_springs", "distributed_springs"):
        chosen = with_soil(undamped, apparent_fixity=ApparentFixity(stiffness_from=source))
        foundation = FOUNDATIONS["apparent_fixity"].make(chosen)
        lengths.append(undamped.site.mudline - foundation.base)
        assert (foundation.surrogate is not None) == (source == "distributed_springs")
    assert 10 < lengths[0] < lengths[1] < 25


def test_macro_element_has_the_condensed_stiffness(undamped: Turbine) -> None:
    """Small motions see the springs' own 6x6, to 1e-6."""
    root = FOUNDATIONS["macro_element"].make(undamped).root
    assert root is not None
    found, _ = root.tangents(np.zeros(6), np.zeros(6))
    expected = condensed_stiffness(undamped)
    assert np.max(np.abs(found - expected)) < 1e-6 * np.max(np.abs(expected))


def test_macro_element_from_a_table(undamped: Turbine, tmp_path: Path) -> None:
    """A user's own load-displacement table, with the 6x6 of the coupled springs."""
    assert undamped.soil.coupled_springs is not None
    block = np.array(undamped.soil.coupled_springs.stiffness)[np.ix_([0, 4], [0, 4])]
    arm = 100.0
    load = np.concatenate([[0.0], np.geomspace(1e4, 2e7, 25)])
    rows = ["horizontal_load_n,displacement_m,rotation_rad"]
    for force in load:
        u, turn = np.linalg.solve(block, [force, arm * force]) / (1 - force / 6e7)
        rows.append(f"{force:.9g},{u:.12g},{turn:.12g}")
    (tmp_path / "path.csv").write_text("\n".join(rows) + "\n")
    calibration = MacroElementCalibration(load_arm=arm, file=tmp_path / "path.csv")
    turbine = with_soil(undamped, macro_element=calibration, distributed_springs=None)
    root = FOUNDATIONS["macro_element"].make(turbine).root
    assert root is not None
    u, turn = np.linalg.solve(block, [1e7, arm * 1e7]) / (1 - 1e7 / 6e7)
    reaction = root.reaction(np.array([u, 0, 0, 0, turn, 0]), np.zeros(6))
    assert reaction[[0, 4]] == pytest.approx([1e7, arm * 1e7], rel=0.01)


def test_a_table_without_load_is_refused(undamped: Turbine, tmp_path: Path) -> None:
    """A loading that never leaves zero holds nothing to follow; the message names the file."""
    file = tmp_path / "path.csv"
    file.write_text("horizontal_load_n,displacement_m,rotation_rad\n0,0,0\n")
    turbine = with_soil(undamped, macro_element=MacroElementCalibration(file=file))
    with pytest.raises(ow.InputError, match=r"path\.csv.*zero loads only"):
        ow.build(turbine, "macro_element")


def test_scour_and_a_damping_calibrated_on_the_6x6() -> None:
    """On any foundation the message names the calibration, which is what cannot be scoured."""
    turbine = ow.load_turbine("oc6_phase2")
    assert turbine.structural_damping is not None
    assert turbine.structural_damping.foundation == "coupled_springs"
    site = turbine.site.model_copy(update={"scour_depth": 3.0})
    scoured = turbine.model_copy(update={"site": site})
    with pytest.raises(ow.InputError, match=r"structural_damping\.foundation"):
        ow.build(scoured, "distributed_springs")
    on_clamped = turbine.structural_damping.model_copy(update={"foundation": "clamped"})
    ow.build(scoured.model_copy(update={"structural_damping": on_clamped}), "distributed_springs")


def test_scour_takes_the_mudline_down(undamped: Turbine) -> None:
    """The pile stands in deeper water and in less soil, so that the first frequency falls; soil laid
    down on top raises it. A 6x6 belongs to its own mudline."""

    def moved(depth: float) -> Turbine:
        site = undamped.site.model_copy(update={"scour_depth": depth})
        return undamped.model_copy(update={"site": site})

    first = []
    for depth in (-2.0, 0.0, 3.0):
        turbine = moved(depth)
        assert turbine.site.mudline == -30.0 - depth
        system = ow.build(turbine, "distributed_springs", ow.StillWater())
        assert system.foundation.soil[0].height[0] == turbine.site.mudline
        modes = ow.modes(system, 4)
        first.append(modes.frequency_hz[modes.index("FA1")])
    assert first[0] > first[1] > first[2]
    assert first[1] / first[2] > 1.01
    for name in ("coupled_springs", "apparent_fixity"):
        with pytest.raises(ow.InputError, match="scour_depth_m"):
            ow.build(moved(3.0), name)
    assert ow.build(moved(3.0), "macro_element").foundation.base == -33.0
