"""A case's results as one tree: groups, reports and summaries made from the file alone."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
import yaml
from helpers.earthquakes import shaking

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import static_dataset
from offwind_pin.base.whole_files import write_netcdf
from offwind_pin.cases import run as case_run
from offwind_pin.cases.case import Case, load_case
from offwind_pin.cases.report import report, report_again
from offwind_pin.cases.run import run_case
from offwind_pin.cases.tree_summary import summary
from offwind_pin.display.figures import results as plots
from offwind_pin.results.reading import open_case, open_results
from offwind_pin.results.tree import part, parts, required

BASE: dict[str, Any] = {
    "turbine": "oc6_phase2",
    "foundation": "distributed_springs",
    "elements": 8,
    "seed": 3,
    "published": [
        {"quantity": "first fore-aft", "key": "FA1_hz", "value": 0.236, "unit": "Hz"},
        {"quantity": "damage", "key": "damage", "value": 1.0, "unit": "-"},
    ],
}
TRANSIENT = {
    "kind": "transient",
    "duration_s": 30.0,
    "ramp_s": 6.0,
    "dt_s": 0.05,
    "output_dt_s": 0.1,
    "psd_segment_s": 10.0,
}
RECORD = {"file": "record.txt", "acceleration_unit": "g", "components": ["x", "z"]}
IRREGULAR = {"kind": "irregular_waves", "significant_height_m": 2.0, "peak_period_s": 6.0}
CASES: dict[str, dict[str, Any]] = {
    "static": {
        "sea": {"kind": "dry"},
        "analysis": {"kind": "static", "compare_with": "clamped", "settle_s": 20.0},
    },
    "modes": {"sea": {"kind": "still_water"}, "analysis": {"kind": "modes", "count": 5}},
    "transient": {
        "sea": IRREGULAR,
        "analysis": TRANSIENT,
        "tower_top_load": {
            "kind": "synthetic",
            "wind_speed_m_per_s": 9.06,
            "blade_passing_frequency_hz": 0.388,
        },
        "earthquake": RECORD | {"start_s": 8.0},
    },
    "rotor": {
        "sea": {"kind": "regular_waves", "height_m": 3.0, "period_s": 8.0},
        "analysis": TRANSIENT,
        "foundation": "clamped",
        "tower_top_load": {
            "kind": "rotor",
            "wind_speed_m_per_s": 9.0,
            "turbulence_intensity": 0.1,
        },
    },
}
GROUPS = {
    "static": {"static", "settling", "soil"},
    "modes": {"static", "soil"},
    "transient": {
        "static", "modes", "spectrum", "soil", "waves", "tower_top", "wind", "earthquake",
    },
    "rotor": {"static", "modes", "spectrum", "waves", "tower_top", "rotor"},
}  # fmt: skip


def write_case(folder: Path, name: str) -> Path:
    motion = shaking(12.0, 0.02)
    table = np.column_stack([motion.time, motion.acceleration[:, [0, 2]] / 98.0])
    np.savetxt(folder / "record.txt", table)
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(BASE | {"name": name} | CASES[name]))
    return path


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Output directories of a case of each kind."""
    folder = tmp_path_factory.mktemp("runs")
    for name in CASES:
        run_case(write_case(folder, name), folder / name)
    return {name: folder / name for name in CASES}


@pytest.fixture(params=list(CASES))
def run(request: pytest.FixtureRequest, runs: dict[str, Path]) -> tuple[str, Path]:
    return request.param, runs[request.param]


@pytest.fixture
def nothing_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Building or solving anything fails the test."""

    def refuse(*_: Any, **__: Any) -> None:
        raise AssertionError("something was solved")

    for name in (
        "analysis.assemble.assemble",
        "analysis.build.build",
        "cases.run.run_case",
        "definitions.reader.load_turbine",
        "dynamics.compiled.chain.CompiledChain.__init__",
    ):
        monkeypatch.setattr(f"offwind_pin.{name}", refuse)


def nodes(tree: xr.DataTree) -> Iterator[tuple[str, xr.Dataset]]:
    for node in tree.subtree:
        yield node.path, node.to_dataset(inherit=False)


class TestTree:
    def test_has_the_groups_of_its_kind(self, run: tuple[str, Path]) -> None:
        name, out = run
        always = {"case", "structure", "structural_damping", "published"}
        with open_results(out) as tree:
            assert set(tree.children) == GROUPS[name] | always

    def test_root_opens_as_a_dataset(self, runs: dict[str, Path]) -> None:
        """With the names of the channels that scripts use."""
        with xr.open_dataset(runs["transient"] / "results.nc") as data:
            assert {"mudline_moment", "section_moment", "wave_elevation"} <= set(data.data_vars)
            assert data.sizes["time"] == 301
        with xr.open_dataset(runs["modes"] / "results.nc") as data:
            assert {"frequency", "shape"} <= set(data.data_vars)
        with xr.open_dataset(runs["static"] / "results.nc") as data:
            assert {"displacement", "section_moment"} <= set(data.data_vars)

    def test_dimensions_belong_to_one_group(self, run: tuple[str, Path]) -> None:
        """A name of a dimension begins with its group; the root has none of these."""
        with xr.open_datatree(run[1] / "results.nc") as tree:
            root = set(tree.to_dataset(inherit=False).dims)
            for path, data in nodes(tree):
                group = path.split("/")[1]
                if group:
                    assert all(str(name).startswith(f"{group}_") for name in data.dims), path
                    assert not root & set(data.dims)

    def test_variables_have_names_and_units(self, run: tuple[str, Path]) -> None:
        """Texts have no unit; every number has one."""
        checked = 0
        with open_results(run[1]) as tree:
            for path, data in nodes(tree):
                for name, variable in data.variables.items():
                    assert variable.attrs.get("long_name"), f"{path} {name}"
                    if variable.dtype.kind in "fi":
                        assert variable.attrs.get("units"), f"{path} {name}"
                        checked += 1
        assert checked > 20

    def test_definition_is_stored(self, run: tuple[str, Path]) -> None:
        """With its turbine in it; read back, it is the case that was run."""
        name, out = run
        case = load_case(out.with_suffix(".yaml"))
        with open_case(out) as tree:
            stored = tree["case"].attrs
        assert Case.model_validate(json.loads(stored["definition"])) == case
        assert stored["content_hash"] == case.content_hash
        assert stored["name"] == name


class TestFromResultsAlone:
    @pytest.mark.usefixtures("nothing_solved")
    def test_summary_is_that_of_the_run(self, run: tuple[str, Path]) -> None:
        with open_case(run[1]) as tree:
            assert summary(tree) == json.loads((run[1] / "summary.json").read_text())

    @pytest.mark.usefixtures("nothing_solved")
    def test_report_is_that_of_the_run(
        self, run: tuple[str, Path], tmp_path: Path, offwind: Any
    ) -> None:
        """By the command, in another directory with nothing else in it."""
        shutil.copy(run[1] / "results.nc", tmp_path)
        code, out, _ = offwind("report", str(tmp_path))
        assert code == 0
        assert "report.html" in "".join(out.split())
        again, first = (folder / "report.html" for folder in (tmp_path, run[1]))
        assert again.read_text() == first.read_text()
        assert {path.name for path in tmp_path.iterdir()} == {"results.nc", "report.html"}

    def test_the_report_depends_on_the_results(self, runs: dict[str, Path]) -> None:
        """Negative control: other numbers in the tree, another page and another summary."""
        with open_case(runs["modes"]) as tree:
            page, numbers = report(tree), summary(tree)
            changed = tree.copy(deep=True)
        changed["frequency"] = 1.1 * changed["frequency"]
        assert report(changed) != page
        assert summary(changed)["FA1_hz"] == pytest.approx(1.1 * numbers["FA1_hz"])

    def test_a_failure_leaves_the_old_report(
        self, runs: dict[str, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        shutil.copy(runs["modes"] / "results.nc", tmp_path)
        old = report_again(tmp_path).read_text()

        def fail(data: xr.Dataset) -> None:
            raise RuntimeError("no picture")

        monkeypatch.setattr(plots, "structure", fail)
        with pytest.raises(RuntimeError, match="no picture"):
            report_again(tmp_path)
        assert {path.name for path in tmp_path.iterdir()} == {"results.nc", "report.html"}
        assert (tmp_path / "report.html").read_text() == old


class TestRunning:
    def test_without_a_report(self, tmp_path: Path, offwind: Any) -> None:
        """The same numbers; the report can be made later."""
        case, out = write_case(tmp_path, "modes"), tmp_path / "out"
        code, _, _ = offwind("run", str(case), "--out", str(out), "--no-report")
        assert code == 0
        assert {path.name for path in out.iterdir()} == {
            "manifest.json",
            "results.nc",
            "summary.json",
        }
        assert offwind("report", str(out))[0] == 0
        assert (out / "report.html").is_file()

    def test_interrupted_and_continued(
        self, tmp_path: Path, runs: dict[str, Path], monkeypatch: pytest.MonkeyPatch, offwind: Any
    ) -> None:
        """What there is can be reported as incomplete; continued, all groups are as of one run."""
        path, out = write_case(tmp_path, "transient"), tmp_path / "out"

        def stop(now: float, _: float) -> None:
            if now >= 20.0:
                raise KeyboardInterrupt

        with pytest.raises(ow.InterruptedSimulation):
            run_case(path, out, progress=stop)
        told = json.loads((out / "summary.json").read_text())
        assert told["status"] == "interrupted"
        with open_case(out) as tree:
            assert summary(tree) == told
        assert offwind("report", str(out))[0] == 0
        page = (out / "report.html").read_text()
        assert "Not complete." in page
        assert "complete</dd>" not in page
        assert 'id="psd"' not in page
        found = run_case(path, out)
        assert found["status"] == "complete"
        assert found["resumed_at_s"] == told["simulated_s"]
        whole = json.loads((runs["transient"] / "summary.json").read_text())
        for key in ("wall_s", "realtime_factor", "resumed_at_s"):
            found.pop(key)
            whole.pop(key, None)
        assert found == whole
        with open_case(out) as again, open_case(runs["transient"]) as once:
            assert again.drop_nodes("case").identical(once.drop_nodes("case"))

    def test_killed_before_the_groups(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, offwind: Any
    ) -> None:
        """Histories alone are no finished case, although they are complete themselves."""
        path, out = write_case(tmp_path, "rotor"), tmp_path / "out"

        def killed(*_: Any) -> None:
            raise SystemExit

        with monkeypatch.context() as patch:
            patch.setattr(case_run, "_add_groups", killed)
            with pytest.raises(SystemExit):
                run_case(path, out)
        assert {entry.name for entry in out.iterdir()} == {"blocks", "manifest.json", "results.nc"}
        code, _, err = offwind("report", str(out))
        assert code == 2
        assert "Run the case again" in err
        assert run_case(path, out)["status"] == "complete"
        assert offwind("report", str(out))[0] == 0

    def test_results_of_another_origin_are_refused(
        self, tmp_path: Path, offwind: Any, clamped_dry: ow.System
    ) -> None:
        """Nothing there, a file without groups as older versions wrote it, and foreign files."""
        state = static_dataset(clamped_dry, ow.static(clamped_dry))
        for name in ("old", "foreign", "text", "empty"):
            (tmp_path / name).mkdir()
        write_netcdf(tmp_path / "old" / "results.nc", state)
        write_netcdf(tmp_path / "foreign" / "results.nc", state.assign_attrs(title="other"))
        (tmp_path / "text" / "results.nc").write_text("no results")
        for name in ("old", "foreign", "text", "empty", "nowhere"):
            code, _, err = offwind("report", str(tmp_path / name))
            assert code == 2
            assert name in err
            assert "Traceback" not in err
            assert not (tmp_path / name / "report.html").exists()
        with xr.open_dataset(tmp_path / "old" / "results.nc") as data:
            assert data.identical(state)

    @pytest.mark.usefixtures("nothing_solved")
    def test_modes_of_a_time_history_are_shown(
        self, runs: dict[str, Path], tmp_path: Path, offwind: Any
    ) -> None:
        """The viewer reads them from their group; the history is what it shows by itself."""
        html = tmp_path / "a.html"
        for words, title in ((["--modes", "FA1,SS1"], "Natural modes"), ([], "soil on the pile")):
            code, _, err = offwind("view", str(runs["transient"]), "--html", str(html), *words)
            assert code == 0, err
            assert title in html.read_text()


class TestStates:
    def test_static_states_come_back(self, distributed_wet: ow.System, tmp_path: Path) -> None:
        """Through a file, to the bit; and a state without loads serves as one that was solved."""
        state = ow.static(distributed_wet)
        write_netcdf(tmp_path / "a.nc", state.to_dataset())
        with xr.open_dataset(tmp_path / "a.nc") as data:
            again = ow.StaticResult.from_dataset(data)
        for name in ("q", "height", "displacement", "rotation", "section_load", "memory"):
            np.testing.assert_array_equal(getattr(again, name), getattr(state, name))
        assert (again.iterations, again.residual) == (state.iterations, state.residual)
        np.testing.assert_array_equal(again.mudline_load, state.mudline_load)
        found, expected = (ow.modes(distributed_wet, 3, about) for about in (again, state))
        np.testing.assert_array_equal(found.frequency_hz, expected.frequency_hz)

    def test_a_state_without_its_loads_is_not_linearised(self, clamped_dry: ow.System) -> None:
        state = ow.static(clamped_dry, np.array([1e6, 0, 0, 0, 0, 0]))
        again = ow.StaticResult.from_dataset(state.to_dataset())
        assert again.loads is None
        with pytest.raises(ow.InputError, match="does not contain the loads"):
            ow.modes(clamped_dry, 3, again)

    def test_modes_come_back(self, coupled_wet: ow.System, tmp_path: Path) -> None:
        modes = ow.modes(coupled_wet, 6)
        write_netcdf(tmp_path / "a.nc", modes.to_dataset())
        with xr.open_dataset(tmp_path / "a.nc") as data:
            again = ow.ModalResult.from_dataset(data)
        assert again.label == modes.label
        assert again.direction("FA2") == "FA"
        for name in (
            "frequency_hz", "damping_ratio", "participation", "damper_share", "height", "shape",
            "mass_normalised", "vector", "shape_peak_height_ratio",
        ):  # fmt: skip
            np.testing.assert_array_equal(getattr(again, name), getattr(modes, name))

    def test_as_tables(self, coupled_wet: ow.System) -> None:
        modes, state = ow.modes(coupled_wet, 4), ow.static(coupled_wet)
        table = modes.to_dataframe()
        assert table.loc["FA1", "frequency_hz"] == modes.frequency_hz[modes.index("FA1")]
        heights = state.to_dataframe()
        assert heights["My"].iloc[0] == state.section_load[0, 4]
        assert heights.index[-1] == state.height[-1]

    def test_states_in_the_tree_are_those_of_the_case(self, runs: dict[str, Path]) -> None:
        with open_case(runs["static"]) as tree:
            first, second = parts(tree, "static")
            assert first.attrs["foundation"] == "distributed_springs"
            assert second.attrs["foundation"] == "clamped"
            assert set(first.dims) == set(second.dims) >= {"height", "direction"}

    def test_soil_curves_are_those_of_the_system(self, runs: dict[str, Path]) -> None:
        """At the displacements reached the curves have the spring's own secant."""
        system = ow.build(ow.load_turbine("oc6_phase2"), "distributed_springs", elements=8)
        (springs, *_) = system.foundation.soil
        with open_case(runs["transient"]) as tree:
            soil = required(tree, "soil").load()
        with open_case(runs["rotor"]) as tree:
            assert part(tree, "soil") is None
        reached = soil["reached"].to_numpy()
        assert 0 < reached.max() < 0.1
        curve = [
            float(np.interp(value, soil["y"], soil["resistance"][node]))
            for node, value in enumerate(reached)
        ]
        np.testing.assert_allclose(curve, springs.curves.resistance(reached), rtol=2e-3)


def test_a_finished_page_is_not_called_incomplete(runs: dict[str, Path]) -> None:
    """Negative control of the checks on the page of a run that was interrupted."""
    page = (runs["transient"] / "report.html").read_text()
    assert "Not complete." not in page
    assert "complete</dd>" in page
    assert 'id="psd"' in page
