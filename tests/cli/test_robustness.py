"""What breaks a program that trusts its input: each answered, none in silence."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import offwind_pin as ow
from offwind_pin.definitions.turbine import Member, Station
from offwind_pin.signal.spectra import band_sum

SHIPPED = yaml.safe_load(
    (resources.files("offwind_pin.definitions") / "library" / "oc6_phase2.yaml").read_text()
)


@pytest.fixture
def symmetric(oc6: ow.Turbine) -> ow.Turbine:
    """The benchmark with a top mass that is the same in every direction."""
    rna = {
        "kind": "rigid_body",
        "mass_kg": 8e5,
        "center_of_mass_m": [0, 0, 3],
        "inertia_about_center_of_mass_kg_m2": [[1e8, 0, 0], [0, 1e8, 0], [0, 0, 1e8]],
    }
    return ow.Turbine.model_validate(copy.deepcopy(SHIPPED) | {"rna": rna})


def test_pile_of_two_walls(oc6: ow.Turbine) -> None:
    """A wall that changes below the mudline makes two spans of one region, numbered through."""
    lower, upper = (
        Member(
            name=name,
            material="steel",
            stations=tuple(Station(z=z, diameter=9.0, thickness=wall) for z in ends),
        )
        for name, wall, ends in (("toe", 0.09, (-75, -50)), ("monopile", 0.11, (-50, 10)))
    )
    split = oc6.model_copy(update={"members": (lower, upper, oc6.members[1])})
    system = ow.build(split, "distributed_springs", elements={"pile": 20, "tower": 20})
    assert system.chain.region.count("pile") == 20
    assert len(set(system.chain.joint_name)) == system.nv
    whole = ow.modes(ow.build(oc6, "distributed_springs", elements={"pile": 20, "tower": 20}))
    assert ow.modes(system).frequency_hz[0] == pytest.approx(whole.frequency_hz[0], rel=5e-3)


def test_planes_of_a_symmetric_turbine_are_distinguished(symmetric: ow.Turbine) -> None:
    """Where fore-aft and side-side are one, the modes still lie in the two planes, and are damped
    as asked."""
    for elements in (10, 13, None):
        system = ow.build(symmetric, "coupled_springs", ow.StillWater(), elements=elements)
        modes = ow.modes(system, 4)
        assert sorted(modes.label) == ["FA1", "FA2", "SS1", "SS2"]
        assert np.all(modes.participation.max(axis=1) > 0.999)
        assert ow.modes(system, 1).participation.max() > 0.999
    assert modes.damping_ratio[modes.index("FA2")] == pytest.approx(0.0127, rel=1e-3)
    assert modes.damping_ratio[modes.index("SS2")] == pytest.approx(0.0133, rel=1e-3)


def test_buckled_state_is_no_answer(clamped_dry: ow.System) -> None:
    """Beyond the critical load the lean reverses; that state is refused, a lesser load is not."""
    with pytest.raises(ow.SolverError, match="unstable"):
        ow.static(clamped_dry, np.array([0, 0, -4e8, 0, 0, 0.0]))
    assert ow.static(clamped_dry, np.array([0, 0, -3e7, 0, 0, 0.0])).tower_top_displacement[0] < 0


def test_more_elements_than_pinocchio_s_memory(undamped: ow.Turbine) -> None:
    """Beyond what Pinocchio's tensors allow, its engine is refused by number; the chain goes on."""
    system = ow.build(undamped, "clamped", elements=240)
    with pytest.raises(ow.InputError, match=r"720 joints.*at most 700 joints"):
        ow.modes(system, engine="pinocchio")
    fine, default = ow.static(system), ow.static(ow.build(undamped, "clamped"))
    lean = default.tower_top_displacement[0]
    assert fine.tower_top_displacement[0] == pytest.approx(lean, rel=1e-3)


BAD_ARGUMENTS: dict[str, tuple[Callable[[ow.Turbine], object], str]] = {
    "stiffness rule": (
        lambda turbine: ow.build(turbine, "clamped", stiffness="flexibilty"),  # type: ignore[arg-type]
        "flexibility, midpoint",
    ),
    **{
        f"{number} elements": (
            lambda turbine, n=number: ow.build(turbine, "clamped", elements=n),
            "elements",
        )
        for number in (0, -5, 1001, 10_000)
    },
    **{
        f"sea {sea}": (lambda turbine, s=sea: ow.build(turbine, "clamped", s), "sea")
        for sea in ("still_water", ow.StillWater, 1.25)
    },
    **{
        f"load history, {name}": (
            lambda turbine, t=time, f=load: ow.LoadHistory(np.array(t), f, "made here"),
            "load history",
        )
        for name, time, load in (
            ("five columns", [0.0, 1.0], np.zeros((2, 5))),
            ("lengths", [0.0, 1.0], np.zeros((3, 6))),
            ("order", [1.0, 0.0], np.zeros((2, 6))),
            ("NaN", [0.0, 1.0], np.full((2, 6), np.nan)),
            ("empty", [], np.zeros((0, 6))),
        )
    },
    "output_dt": (lambda turbine: ow.SaveAt(float("nan")), "output_dt"),
    "spectral_radius": (
        lambda turbine: ow.GeneralizedAlpha(ow.FixedStep(0.1), 2.0),
        "spectral_radius",
    ),
}
"""A call with an argument that cannot be used, and the name or the allowed values in its message.
Too many elements are refused before any memory is taken."""


@pytest.mark.parametrize("name", BAD_ARGUMENTS)
def test_bad_arguments(undamped: ow.Turbine, name: str) -> None:
    call, message = BAD_ARGUMENTS[name]
    with pytest.raises(ow.InputError, match=message):
        call(undamped)


def test_band_beyond_the_spectrum() -> None:
    """A band that the sampling cannot see is refused, not made up."""
    frequency = np.linspace(0, 1.0, 101)
    with pytest.raises(ow.InputError, match="higher sampling rate"):
        band_sum(frequency, np.ones(101), 1.0, 1.5)
    assert band_sum(frequency, np.ones(101), 0.2, 0.3) == pytest.approx(0.1)


def test_state_of_another_system(clamped_dry: ow.System, coupled_wet: ow.System) -> None:
    """Modes about a state that belongs to another system are refused."""
    with pytest.raises(ow.InputError, match="about"):
        ow.modes(clamped_dry, 3, ow.static(coupled_wet))


def test_places_that_cannot_be_written(offwind: Any, tmp_path: Path) -> None:
    """A file in the way of a folder is found before the solve, for every command that writes."""
    blocking = tmp_path / "file"
    blocking.write_text("kept")
    for argv in (
        ["run", "oc6-lc2.1", "--out", str(blocking / "x")],
        ["urdf", "oc6_phase2", "--out", str(blocking)],
        ["animate", "oc6_phase2", "--html", str(blocking / "x.html")],
    ):
        code, _, err = offwind(*argv)
        assert code == 2
        assert "a directory;" in err
    assert blocking.read_text() == "kept"


def test_a_failed_run_leaves_nothing_of_an_older_one(offwind: Any, tmp_path: Path) -> None:
    """Files of an earlier, complete run do not stand beside the summary of a failed one."""
    assert offwind("run", "oc6-lc2.1", "--out", str(tmp_path))[0] == 0
    heavy = copy.deepcopy(SHIPPED)
    heavy["materials"]["steel"]["youngs_modulus_pa"] = 1e9
    heavy.pop("structural_damping")
    (tmp_path / "t.yaml").write_text(yaml.safe_dump(heavy))
    case = {
        "name": "heavy",
        "turbine": "t.yaml",
        "foundation": "clamped",
        "sea": {"kind": "dry"},
        "analysis": {"kind": "modes"},
    }
    (tmp_path / "c.yaml").write_text(yaml.safe_dump(case))
    words = ["run", str(tmp_path / "c.yaml"), "--out", str(tmp_path), "--overwrite"]
    assert offwind(*words)[0] == 3
    assert '"status": "failed"' in (tmp_path / "summary.json").read_text()
    assert not (tmp_path / "report.html").exists()
    assert not (tmp_path / "results.nc").exists()


def test_small_structures_show_what_modes_they_have(offwind: Any) -> None:
    """With fewer degrees of freedom than modes wanted by default, all of them are shown."""
    argv = ["modes", "oc6_phase2", "--foundation", "clamped", "--elements", "2", "--json"]
    code, out, _ = offwind(*argv)
    assert code == 0
    assert len(json.loads(out)["modes"]) == 6
