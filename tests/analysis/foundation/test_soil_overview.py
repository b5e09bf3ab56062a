"""`offwind soil` and what it is made of: numbers, files that other things read, pages, refusals."""

from __future__ import annotations

import json
import shutil
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
import yaml
from numpy.testing import assert_allclose

import offwind_pin as ow
from offwind_pin.analysis.foundation.equivalent import equivalent_cantilever
from offwind_pin.analysis.foundation.pushover import Pushover
from offwind_pin.analysis.foundation.study.study import macro_element_response
from offwind_pin.cases.run import run_case
from offwind_pin.display.figures import soil as soil_plots
from offwind_pin.display.report import soil_report as soil_page
from offwind_pin.formats.openfast.subdyn_soildyn import read_soildyn, read_subdyn_ssi
from offwind_pin.loads.soil.curves.tabulated import tabulated_curves
from offwind_pin.loads.soil.macro_element import MacroElement

LOAD = np.array([1.5e6, 0, 0, 0, 3e6, 1e6])
GIVEN = "1.5e6,0,0,0,3e6,1e6"


def changed(change: Any) -> dict[str, Any]:
    """The shipped turbine's file with its distributed springs changed."""
    library = resources.files("offwind_pin.definitions") / "library"
    data: dict[str, Any] = yaml.safe_load((library / "oc6_phase2.yaml").read_text())
    del data["structural_damping"]
    change(data)
    return data


def layered(data: dict[str, Any]) -> None:
    """Every spring that there is: layers of clay and PISA's sand, and curves along the shaft."""

    def line(value: float) -> dict[str, Any]:
        return {"at_mudline": value, "source": "a test's own"}

    data["name"] = "layered"
    springs = data["soil"]["distributed_springs"]
    weight = {"submerged_unit_weight_n_per_m3": 9e3, "source": "a test's own"}
    springs["nodes"] = 16
    springs["curve"] = {
        "kind": "layers",
        "loading": "static",
        "source": "a test's own",
        "layers": [
            {
                "model": "matlock_clay",
                "top_m": 0,
                "undrained_shear_strength_pa": line(4e4),
                "strain_50": 0.01,
                **weight,
            },
            {
                "model": "pisa",
                "top_m": 13.5,
                "calibration": "general_dunkirk_sand",
                "shear_modulus_pa": line(1.5e8),
                "relative_density": 0.75,
                **weight,
            },
        ],
    }
    springs["vertical"] = {
        "kind": "linear",
        "modulus_n_per_m2": line(3e8),
        "source": "a test's own",
    }
    springs["torsional"] = {
        "kind": "tanh",
        "initial_stiffness_nm_per_m_per_rad": line(5e10),
        "ultimate_torque_nm_per_m": line(3e7),
        "source": "a test's own",
    }
    del springs["toe_vertical_stiffness_n_per_m"], springs["toe_torsional_stiffness_nm_per_rad"]


@pytest.fixture(scope="module")
def overview(oc6: ow.Turbine) -> ow.SoilOverview:
    return ow.soil_overview(oc6, load=LOAD)


@pytest.fixture(scope="module")
def every_spring(tmp_path_factory: pytest.TempPathFactory) -> ow.SoilOverview:
    path = tmp_path_factory.mktemp("layered") / "turbine.yaml"
    path.write_text(yaml.safe_dump(changed(layered)))
    return ow.soil_overview(ow.load_turbine(path), arm=30.0)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results of a short case on distributed springs."""
    folder = tmp_path_factory.mktemp("run")
    case = folder / "case.yaml"
    case.write_text(
        yaml.safe_dump(
            {
                "name": "short",
                "title": "a short case",
                "turbine": "oc6_phase2",
                "foundation": "distributed_springs",
                "sea": {
                    "kind": "irregular_waves",
                    "significant_height_m": 1.25,
                    "peak_period_s": 5.5,
                },
                "analysis": {
                    "kind": "transient",
                    "duration_s": 14.0,
                    "ramp_s": 4.0,
                    "dt_s": 0.05,
                    "output_dt_s": 0.1,
                    "psd_segment_s": 8.0,
                },
                "seed": 7,
            }
        )
    )
    run_case(case, folder / "out", report=False)
    return folder / "out"


def test_state_under_a_load(overview: ow.SoilOverview, oc6: ow.Turbine) -> None:
    """Displacements are the statics'; resistance, secant and utilisation follow from tanh."""
    state = overview.state
    assert state is not None
    found = ow.static(ow.build(oc6, "distributed_springs"), LOAD)
    size = np.hypot(*found.displacement[:, :2].T)
    height, place = overview.lateral.height, np.round(found.height, 6)
    (recorded,) = np.nonzero(np.isin(np.round(height, 6), place))
    assert len(recorded) > 10
    at_nodes = np.interp(height[recorded], found.height, size)
    assert_allclose(state.displacement[recorded], at_nodes, rtol=1e-6)
    node = 12
    depth, y = overview.depth[node], state.displacement[node]
    modulus, ultimate = 4.5e7 * depth, 9.96e5 * depth
    assert state.utilisation[node] == pytest.approx(np.tanh(modulus * y / ultimate), rel=1e-9)
    assert state.secant[node] * y == pytest.approx(state.resistance[node], rel=1e-12)
    assert np.isnan(state.utilisation[0])
    assert overview.as_dict()["state"]["largest_utilisation"] == np.nanmax(state.utilisation)


def test_stiffness_and_fixity(overview: ow.SoilOverview, oc6: ow.Turbine) -> None:
    """The unloaded tangent is the stiffest; the cantilever is exact for its own load only."""
    assert list(overview.stiffness) == ["tangent_unloaded", "tangent_loaded", "secant_loaded"]
    unloaded, tangent, secant = (matrix[0, 0] for matrix in overview.stiffness.values())
    assert unloaded > secant > tangent
    fixity = overview.fixity
    assert fixity is not None
    assert oc6.soil.coupled_springs is not None
    given = np.array(oc6.soil.coupled_springs.stiffness)
    assert_allclose(fixity.reference, given[np.ix_([0, 4], [0, 4])])
    expected = equivalent_cantilever(given, fixity.load_arm)
    assert (fixity.length, fixity.bending_stiffness) == pytest.approx(expected)
    load = np.array([1.0, fixity.load_arm])
    moved, wanted = (np.linalg.solve(k, load) for k in (fixity.stiffness, fixity.reference))
    assert_allclose(moved, wanted, rtol=1e-9)
    assert np.all(np.abs(fixity.difference) > 0.5)


def test_macro_element_follows_the_pushover(overview: ow.SoilOverview) -> None:
    """At the same displacements it resists alike, within what its fit leaves."""
    push, followed = overview.pushover, overview.macro_element
    assert followed is not None
    assert push.displacement[-1] == pytest.approx(0.9)
    assert_allclose(followed[:, 0], push.load, rtol=0.03, atol=1.0)
    assert_allclose(followed[:, 1], push.rotation, rtol=0.05, atol=1e-9)


def test_linear_macro_element_is_its_6x6() -> None:
    """Of one element that never yields: the load that the flexibility gives."""
    stiffness = np.diag([6e9, 6e9, 1e10, 8e11, 8e11, 2e11])
    stiffness[0, 4] = stiffness[4, 0] = -5e10
    stiffness[1, 3] = stiffness[3, 1] = 5e10
    arm = -5e10 / 6e9
    rotation = 8e11 - arm**2 * 6e9
    element = MacroElement(stiffness, np.array([6e9]), np.array([rotation]), np.array([np.inf]))
    displacement = np.array([0.0, 0.01, 0.02])
    pushed = Pushover(100.0, np.zeros(3), np.zeros(3), displacement, np.zeros(3))
    load, turned = macro_element_response(element, pushed).T
    moved = np.linalg.solve(stiffness, [1.0, 0, 0, 0, 100.0, 0])
    assert_allclose(load, displacement / moved[0], rtol=1e-9, atol=1e-6)
    assert_allclose(turned, displacement / moved[0] * moved[4], rtol=1e-9, atol=1e-15)


def test_damping_of_the_turbine_is_reported(overview: ow.SoilOverview) -> None:
    """The shipped turbine has a secant dashpot; the others are made of its factor and curve."""
    assert overview.damping_model == "secant_dashpot"
    assert list(overview.damping) == ["secant_dashpot", "initial_dashpot", "sliders"]
    assert overview.damping_depth == pytest.approx(9.0)
    ratio = overview.damping["secant_dashpot"].damping_ratio
    assert float(ratio[0].sel(frequency=0.25)) == pytest.approx(0.03 * 0.25 / 0.236, rel=1e-3)


def test_json_is_plain_and_complete(
    overview: ow.SoilOverview, every_spring: ow.SoilOverview
) -> None:
    for soil in (overview, every_spring):
        data = json.loads(json.dumps(soil.as_dict(), allow_nan=False))
        assert data.keys() == {
            "turbine",
            "definition_sha256",
            "surrogate",
            "cautions",
            "remarks",
            "scour_depth_m",
            "nodes",
            "other_springs",
            "toe_vertical_stiffness_n_per_m",
            "toe_torsional_stiffness_nm_per_rad",
            "state",
            "pushover",
            "stiffness_6x6",
            "apparent_fixity",
            "equivalent_damping",
        }
        assert len(data["nodes"]) == len(soil.depth)
    assert overview.as_dict()["nodes"][4].keys() == {
        "depth_m",
        "height_m",
        "diameter_m",
        "tributary_length_m",
        "model",
        "initial_modulus_n_per_m2",
        "ultimate_resistance_n_per_m",
        "displacement_m",
        "resistance_n_per_m",
        "secant_stiffness_n_per_m2",
        "utilisation",
    }


def test_models_by_layer(every_spring: ow.SoilOverview) -> None:
    """A node on a boundary belongs to the layer below; every spring has its curves and units."""
    assert every_spring.state is None
    below = np.array([model == "pisa" for model in every_spring.model])
    assert np.array_equal(below, every_spring.depth > 13.5 - 1e-6)
    assert every_spring.foundation.cautions
    units = {(row[0], row[3], row[5]) for row in every_spring.other_curves()}
    assert units == {
        ("soil_friction", "rad", "m"),
        ("soil_base_shear", "m", "N"),
        ("soil_base_moment", "rad", "N m"),
        ("soil_shaft", "m", "N/m"),
        ("soil_torsion", "rad", "N m/m"),
    }
    torsion = np.array([row[1:] for row in every_spring.other_curves() if row[0] == "soil_torsion"])
    twist, torque = (torsion[:, i].astype(float) for i in (1, 3))
    assert_allclose(torque, 3e7 * np.tanh(5e10 * twist / 3e7), rtol=1e-12)
    assert every_spring.pushover.arm == 30.0


def test_curves_go_round_by_the_table(
    overview: ow.SoilOverview, every_spring: ow.SoilOverview, tmp_path: Path
) -> None:
    """p_y_curves.csv read as a table gives the same at its points, and nearly so in between."""
    for soil in (overview, every_spring):
        ow.write_soil(soil, tmp_path)
        read = tabulated_curves(tmp_path / "p_y_curves.csv", soil.depth)
        n = len(soil.depth)
        for y in sorted({row[1] for row in soil.lateral_curves()}):
            at = np.full(n, y)
            assert_allclose(read.resistance(at), soil.lateral.curves.resistance(at), rtol=1e-12)
        for y in np.geomspace(1e-5, 1.0, 23):
            at = np.full(n, y)
            assert_allclose(read.resistance(at), soil.lateral.curves.resistance(at), rtol=1e-2)


def test_a_table_keeps_its_points(every_spring: ow.SoilOverview, tmp_path: Path) -> None:
    """A turbine that reads the exported table exports the same table."""
    ow.write_soil(every_spring, tmp_path)

    def by_table(data: dict[str, Any]) -> None:
        springs = data["soil"]["distributed_springs"]
        springs["nodes"] = 16
        file = str(tmp_path / "p_y_curves.csv")
        springs["curve"] = {"kind": "table", "file": file, "source": "a test's own"}

    path = tmp_path / "turbine.yaml"
    path.write_text(yaml.safe_dump(changed(by_table)))
    again = ow.soil_overview(ow.load_turbine(path))
    assert set(again.model) == {"table"}
    assert_allclose(again.lateral_curves(), every_spring.lateral_curves(), rtol=1e-12, atol=1e-15)


def test_files_of_other_codes(overview: ow.SoilOverview, tmp_path: Path) -> None:
    written = ow.write_soil(overview, tmp_path)
    assert {path.name for path in written} == {path.name for path in tmp_path.iterdir()}
    for name, stiffness in overview.stiffness.items():
        assert np.array_equal(read_subdyn_ssi(tmp_path / f"subdyn_ssi_{name}.txt")[0], stiffness)
        soildyn = read_soildyn(tmp_path / f"soildyn_{name}.dat")
        assert np.array_equal(soildyn.stiffness, stiffness)
        assert soildyn.location.tolist() == [0.0, 0.0, -30.0]


def test_page_stands_alone(overview: ow.SoilOverview, every_spring: ow.SoilOverview) -> None:
    """No address of anything outside, every figure, cautions and the surrogate."""
    for soil in (overview, every_spring):
        page = soil_page.render_soil_page(soil)
        assert "://" not in page
        assert "<script" not in page
        assert page.count("<svg") == len(soil_page.figures(soil))
        assert "None" not in page
        assert "nan" not in page
    assert "is a surrogate" in page
    assert "at most 2 m in diameter" in page
    assert 'id="state"' not in page


def test_pictures_show_the_numbers(overview: ow.SoilOverview) -> None:
    """Dots at the state, the pushover's ends, and the damping ratios on their lines."""
    figures = soil_page.figures(overview)
    assert overview.state is not None
    used = figures["curves"].axes[1]
    dots = used.findobj(lambda artist: artist.get_gid() == "reached")
    assert len(dots) > 5
    for dot in dots:
        y = dot.get_xdata()[0] / 1e3  # type: ignore[attr-defined]
        assert np.min(np.abs(overview.state.displacement - y)) < 1e-9
    force, moment = figures["pushover"].axes
    named = {line.get_label(): line for line in force.lines}
    assert_allclose(named["distributed springs"].get_ydata()[-1], overview.pushover.load[-1] / 1e6)
    tangent = named["6\u00d76 for small motions"]
    slope = tangent.get_ydata()[1] / tangent.get_xdata()[1]
    unloaded = overview.stiffness["tangent_unloaded"]
    moved = np.linalg.solve(unloaded, [1.0, 0, 0, 0, overview.pushover.arm, 0])
    assert slope == pytest.approx(1e-6 / moved[0], rel=1e-9)
    assert len(moment.lines) == 3
    panels = figures["damping"].axes
    for axes, data in zip(panels, overview.damping.values(), strict=True):
        assert_allclose(axes.lines[0].get_ydata(), 100 * data.damping_ratio.values[:, 0])
    assert "used" in panels[0].get_title(loc="left")
    assert len(panels[2].lines) == 2


def test_pushover_without_an_arm() -> None:
    """There is no moment to draw: the load stands over the rotation too."""
    grid = np.linspace(0, 1, 5)
    pushed = Pushover(0.0, 1e6 * grid, 0 * grid, grid, grid)
    force, moment = soil_plots.pushover_curves(pushed, np.diag(np.full(6, 1e6))).axes
    assert moment.get_ylabel() == force.get_ylabel()
    assert_allclose(moment.lines[1].get_ydata(), grid)
    assert_allclose(moment.lines[1].get_xdata(), np.degrees(grid))


def test_state_of_curves_without_an_end() -> None:
    """Linear curves are never used up: the picture says so."""
    ones = np.ones(3)
    depth = np.array([0.0, 1.0, 2.0])
    figure = soil_plots.state_over_depth(depth, ones, ones, ones, np.full(3, np.nan))
    assert any("no ultimate resistance" in text.get_text() for text in figure.axes[2].texts)


def test_state_of_a_run(oc6: ow.Turbine, run: Path, offwind: Any) -> None:
    """The largest displacement after the ramp, linear between the recorded heights."""
    code, out, err = offwind("soil", "oc6_phase2", "--result", str(run), "--json")
    assert code == 0, err
    data = json.loads(out)
    with xr.open_dataset(run / "results.nc") as histories:
        late = histories.displacement.sel(direction=["x", "y"], time=histories.time >= 4.0)
        largest = np.hypot(late[..., 0], late[..., 1]).max("time")
        heights = [row["height_m"] for row in data["nodes"]]
        expected = np.interp(heights, histories.height, largest)
    assert_allclose([row["displacement_m"] for row in data["nodes"]], expected, rtol=1e-6)
    assert str(run) in data["state"]["origin"]
    assert list(data["stiffness_6x6"]) == ["tangent_unloaded"]


def test_command_prints_and_writes(offwind: Any, tmp_path: Path) -> None:
    code, out, err = offwind("soil", "oc6_phase2", "--load", GIVEN, "--out", str(tmp_path))
    assert code == 0, err
    for text in ("Pushover", "Apparent fixity", "Equivalent damping", "Surrogate soil", "Fx = 1.5"):
        assert text in out
    assert json.loads((tmp_path / "soil.json").read_text())["turbine"] == "oc6_phase2"
    assert (tmp_path / "soil.html").read_text().startswith("<!doctype html>")


def without(part: str) -> Any:
    def change(data: dict[str, Any]) -> None:
        del data["soil"][part]

    return change


def no_pile(data: dict[str, Any]) -> None:
    data["members"][0]["stations"][0]["z_m"] = -30.0


@pytest.mark.parametrize(
    ("change", "says"),
    [(without("distributed_springs"), "soil.distributed_springs"), (no_pile, "below the mudline")],
)
def test_turbine_without_soil(change: Any, says: str, offwind: Any, tmp_path: Path) -> None:
    path = tmp_path / "turbine.yaml"
    path.write_text(yaml.safe_dump(changed(change)))
    code, _, err = offwind("soil", str(path))
    assert code == 2
    assert says in err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--load", "1e6,0"], "six"),
        (["--load", "a,b"], "--load"),
        (["--load", GIVEN, "--result", "."], "one of them"),
        (["--result", "nowhere"], "results.nc"),
        (["--arm", "nan"], "arm"),
    ],
)
def test_arguments_that_cannot_be_used(arguments: list[str], says: str, offwind: Any) -> None:
    code, _, err = offwind("soil", "oc6_phase2", *arguments)
    assert code == 2
    assert says in err


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda data: data.drop_vars("displacement"), "displacement over time"),
        (lambda data: data.assign_attrs(turbine="another"), "of turbine another"),
        (lambda data: data.assign_attrs(definition_sha256="0"), "of a changed oc6_phase2"),
        (lambda data: data.sel(height=data.height >= -30.0), "down to"),
        (lambda data: data.assign_attrs(ramp_s=1e3), "ramp"),
    ],
)
def test_results_that_cannot_be_used(
    change: Any, says: str, run: Path, offwind: Any, tmp_path: Path
) -> None:
    shutil.copy(run / "results.nc", tmp_path / "whole.nc")
    with xr.open_dataset(tmp_path / "whole.nc") as data:
        change(data).to_netcdf(tmp_path / "results.nc")
    code, _, err = offwind("soil", "oc6_phase2", "--result", str(tmp_path))
    assert code == 2
    assert says in err
