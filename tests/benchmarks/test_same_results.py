"""The comparison of two revisions' results reports what differs; nothing is solved here."""

import importlib
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

FOLDER = Path(__file__).parents[2] / "benchmarks"
sys.path.insert(0, str(FOLDER))
result_differences, same_results = (
    importlib.import_module(name) for name in ("result_differences", "same_results")
)
sys.path.remove(str(FOLDER))

SUMMARY = {
    "case": "some_case",
    "wall_s": 12.0,
    "offwind_pin_version": "1",
    "tower_top_x_m": 0.5,
    "tower_top_y_m": 1e-17,
    "mean_iterations": 1.7,
    "largest_residual": 4e-6,
    "modes": [{"label": "FA1", "frequency_hz": 0.25}],
    "notes": ["a sentence for people"],
    "stiffness": [[2.0e9, 1e-6], [1e-6, 3.0e9]],
}
GROUP = "oc6-lc5.1"


def histories() -> xr.Dataset:
    """Every kind of channel that has a bound of its own."""
    time = np.arange(200) * 0.1
    wave = np.sin(time)
    six = np.outer(wave, np.ones(6))
    channels = {
        "mudline_moment": (("time", "direction"), np.outer(wave, [1e6, 2e8, 0.0])),
        "section_force": (("time", "height", "direction"), np.ones((200, 2, 3)) * 1e6),
        "section_moment": (("time", "height", "direction"), np.ones((200, 2, 3)) * 1e8),
        "segment_imbalance": (("time", "segment", "component"), six[:, None] * 1e-6),
        "energy_stored": (("time", "holder"), six[:, :2] * 1e6),
        "energy_dissipated": (("time", "sink"), six[:, :2] * 1e4),
        "energy_worked": (("time", "source"), six[:, :1] * 1e6),
        "energy_balance": (("time",), wave * 10.0),
        "solver_step": (("time",), np.full(200, np.nan)),
        "tuned_mass_travel": (("damper",), np.array([2.5, np.inf])),
        "solver_iterations": (("time",), np.full(200, 2)),
        "solver_residual": (("time",), np.full(200, 3e-6)),
    }
    coordinates = {"time": time, "direction": ["x", "y", "z"]}
    attributes = {
        "residual_tolerance": 1e-5,
        "dt_s": 0.02,
        "sea": "waves of a spectrum",
        "integrator": "generalised-alpha",
    }
    return xr.Dataset(channels, coordinates, attributes)  # type: ignore[arg-type]


def write(folder: Path, data: xr.Dataset, summary: dict[str, Any]) -> None:
    """A folder as a run leaves it, channels over the height in single precision."""
    folder.mkdir(parents=True)
    single = {name: {"dtype": "float32"} for name in data.data_vars if data[name].ndim == 3}
    data.to_netcdf(folder / "results.nc", encoding=single)
    (folder / "summary.json").write_text(json.dumps(summary))
    (folder / "model.urdf").write_text(
        '<robot><origin xyz="0 1e-17 2.5"/><mass value="1e6"/></robot>'
    )
    (folder / "curves.csv").write_text("depth_m,p_n_per_m\n0.5,2e6\n1.5,4e6\n")
    (folder / "stiffness.txt").write_text("a title\n1.5e9 0 1e-7\n")
    (folder / "report.html").write_text("<p>12 s</p>")


@pytest.fixture
def compared(tmp_path: Path) -> Callable[..., Any]:
    """Compare the histories and the summary with changed ones."""
    write(tmp_path / "old", histories(), SUMMARY)

    def compare(
        data: xr.Dataset | None = None,
        summary: dict[str, Any] | None = None,
        files: dict[str, str] | None = None,
        accept: tuple[str, ...] = (),
    ) -> Any:
        new = tmp_path / "new"
        write(new, histories() if data is None else data, summary or SUMMARY)
        for name, text in (files or {}).items():
            (new / name).write_text(text)
        return result_differences.compare_group(GROUP, tmp_path / "old", new, accept)

    return compare


def changed(name: str, change: Callable[[Any], Any]) -> xr.Dataset:
    data = histories()
    return data.assign({name: data[name].copy(data=change(data[name].to_numpy().copy()))})


def first(value: float) -> Callable[[Any], Any]:
    def change(values: Any) -> Any:
        values[:1] += value
        return values

    return change


def failed(found: Any) -> list[str]:
    return [difference.name.split(": ")[-1] for difference in found.failures]


def test_the_same_results_pass(compared: Callable[..., Any]) -> None:
    """Also where the machine was slower, sentences read better, and the report looks different."""
    summary = SUMMARY | {
        "wall_s": 99.0,
        "offwind_pin_version": "2",
        "notes": ["better words", "and more"],
    }
    data = histories().assign_attrs(sea="a better sentence")
    found = compared(data, summary, {"report.html": "<p>99 s</p>"})
    assert found.passed
    assert len(found.compared) >= 30
    assert found.worst("float64").size == found.worst("float32").size == 0
    assert len(found.notes) == 2


@pytest.mark.parametrize(
    ("name", "change", "passes"),
    [
        ("mudline_moment", lambda x: x * (1 + 5e-10), True),
        ("mudline_moment", lambda x: x * (1 + 1e-6), False),
        ("mudline_moment", first(0.3), False),
        ("section_moment", lambda x: x * (1 + 1e-7), True),
        ("section_moment", lambda x: x * (1 + 1e-6), False),
        ("segment_imbalance", lambda x: -x, True),
        ("segment_imbalance", first(0.01), False),
        ("energy_balance", first(9e-4), True),
        ("energy_balance", first(2e-3), False),
        ("solver_residual", lambda x: x * 3, True),
        ("solver_residual", lambda x: x * 4, False),
        ("solver_residual", lambda x: x * np.nan, False),
        ("solver_iterations", first(1), True),
        ("solver_iterations", first(2), False),
        ("solver_iterations", lambda x: x + 1, False),
        ("solver_step", lambda x: np.nan_to_num(x), False),
        ("solver_step", lambda x: x, True),
        ("tuned_mass_travel", lambda x: x * [1 + 1e-6, 1], False),
        ("tuned_mass_travel", lambda x: x * [1, -1], False),
        ("tuned_mass_travel", lambda x: np.array([2.5, 3.0]), False),
    ],
)
def test_a_channel_is_held_to_its_own_bound(
    compared: Callable[..., Any], name: str, change: Callable[[Any], Any], passes: bool
) -> None:
    found = compared(changed(name, change))
    assert found.passed == passes
    assert failed(found) == ([] if passes else [name])
    if not passes:
        assert max(found.compared, key=lambda d: d.size / max(d.allowed, 1e-99)).name.endswith(name)


def test_missing_and_extra_variables_are_reported(compared: Callable[..., Any]) -> None:
    data = histories().drop_vars("mudline_moment").assign(new_channel=("time", np.zeros(200)))
    found = compared(data)
    assert not found.passed
    assert found.missing == ["results.nc: mudline_moment"]
    assert found.extra == ["results.nc: new_channel"]


def test_a_variable_that_moved_to_a_group_is_found(
    compared: Callable[..., Any], tmp_path: Path
) -> None:
    """It is compared there, and the move is noted."""
    compared(histories().drop_vars("mudline_moment"))
    moved = histories()[["mudline_moment"]].rename(time="waves_time") * (1 + 1e-6)
    moved.to_netcdf(tmp_path / "new" / "results.nc", mode="a", group="waves")
    found = result_differences.compare_group(GROUP, tmp_path / "old", tmp_path / "new")
    assert found.missing == []
    assert failed(found) == ["mudline_moment"]
    assert found.notes == ["results.nc: mudline_moment is waves/mudline_moment now"]


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ({"tower_top_x_m": 0.5 * (1 + 1e-6)}, "tower_top_x_m"),
        ({"tower_top_y_m": 1e-9}, "tower_top_y_m"),
        ({"mean_iterations": 1.72}, "mean_iterations"),
        ({"largest_residual": 2e-5}, "largest_residual"),
        ({"modes": [{"label": "SS1", "frequency_hz": 0.25}]}, "label"),
        ({"modes": [{"label": "FA1", "frequency_hz": 0.2500001}]}, "frequency_hz"),
        ({"modes": []}, "modes"),
        ({"stiffness": [[2.0e9, 100.0], [1e-6, 3.0e9]]}, "stiffness"),
        ({"stiffness": [[2.0e9, 1e-6]]}, "stiffness"),
        ({"tower_top_x_m": None}, "tower_top_x_m"),
    ],
)
def test_numbers_and_names_of_a_summary(
    compared: Callable[..., Any], change: dict[str, Any], where: str
) -> None:
    found = compared(summary=SUMMARY | change)
    assert [d.name.split(", ")[-1] for d in found.failures] == [where]


def test_rounding_in_a_summary_is_no_difference(compared: Callable[..., Any]) -> None:
    """About zero as well, where the displacement beside it says what is small."""
    small = {"tower_top_x_m": 0.5 * (1 + 5e-8), "tower_top_y_m": -3e-17, "mean_iterations": 1.705}
    assert compared(summary=SUMMARY | small).passed


def test_keys_attributes_and_files_that_are_missing(
    compared: Callable[..., Any], tmp_path: Path
) -> None:
    data = histories()
    del data.attrs["dt_s"]
    compared(data, {key: value for key, value in SUMMARY.items() if key != "modes"})
    (tmp_path / "new" / "report.html").unlink()
    found = result_differences.compare_group(GROUP, tmp_path / "old", tmp_path / "new")
    assert found.missing == [
        "report.html",
        "results.nc: attributes, dt_s",
        "summary.json, modes",
    ]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("model.urdf", '<robot><origin xyz="0 0 2.500001"/><mass value="1e6"/></robot>'),
        ("model.urdf", '<robot><origin xyz="0 0 2.5"/><weight value="1e6"/></robot>'),
        ("curves.csv", "depth_m,p_n_per_m\n0.5000001,2e6\n1.5,4e6\n"),
        ("stiffness.txt", "a title\n1.5e9 2.0 1e-7\n"),
    ],
)
def test_files_of_text(compared: Callable[..., Any], name: str, text: str) -> None:
    """Numbers by attribute or column, so that a small one beside large ones counts."""
    found = compared(files={name: text})
    assert {d.name.split(": ")[0].split(", ")[0] for d in found.failures} == {name}


def test_what_is_meant_can_be_accepted(compared: Callable[..., Any]) -> None:
    data = changed("mudline_moment", lambda x: 2 * x).drop_vars("solver_step")
    found = compared(data, accept=("oc6-*/*mudline_moment", "*/*solver_step"))
    assert found.passed
    assert found.accepted == ["results.nc: mudline_moment", "results.nc: solver_step"]


def test_an_empty_folder_does_not_pass(tmp_path: Path) -> None:
    for name in ("old", "new"):
        (tmp_path / name).mkdir()
    assert not result_differences.compare_group(GROUP, tmp_path / "old", tmp_path / "new").passed


def test_exit_status_and_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two folders of results from the command line, the same and differing in one channel."""
    write(tmp_path / "old" / GROUP, histories(), SUMMARY)
    write(tmp_path / "new" / GROUP, changed("mudline_moment", lambda x: x * (1 + 1e-6)), SUMMARY)

    def run(new: str) -> int:
        folders = ["--reference-results", str(tmp_path / "old"), "--results", str(tmp_path / new)]
        return int(
            same_results.main([*folders, "--only", GROUP, "--json", str(tmp_path / "report.json")])
        )

    assert run("old") == 0
    assert json.loads((tmp_path / "report.json").read_text())["passed"]
    assert run("new") == 1
    (group,) = json.loads((tmp_path / "report.json").read_text())["groups"]
    (failure,) = group["failures"]
    assert failure["name"] == "results.nc: mudline_moment"
    assert failure["size"] == pytest.approx(1e-6, rel=1e-3)
    assert "mudline_moment" in capsys.readouterr().out


def test_the_groups_are_those_that_can_be_collected() -> None:
    """The list in the script is that of the program that writes them."""
    text = (FOLDER / "same_results" / "collect.py").read_text()
    for name in same_results.GROUPS:
        assert name in text or (FOLDER / "same_results" / f"{name}.yaml").is_file()
