"""The benchmarks run, with tiny settings, and say what they must; none of them is timed here."""

import importlib
import json
import sys
from pathlib import Path
from typing import Any

import pytest

# The benchmarks are a folder of scripts; they find one another as they do when run.
FOLDER = Path(__file__).parents[2] / "benchmarks"
sys.path.insert(0, str(FOLDER))
(
    cases_per_hour,
    memory,
    page,
    real_time,
    run_all,
    soil_cost,
    step_cost,
    wave_setup,
    work_precision,
) = (
    importlib.import_module(name)
    for name in (
        "cases_per_hour",
        "memory",
        "page",
        "real_time",
        "run_all",
        "soil_cost",
        "step_cost",
        "wave_setup",
        "work_precision",
    )
)
figures, measuring, pinocchio_pair = (
    importlib.import_module(name) for name in ("figures", "measuring", "pinocchio_pair")
)
sys.path.remove(str(FOLDER))


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the JSON of each benchmark in its smallest form."""
    folder = tmp_path_factory.mktemp("results")

    def run(benchmark: Any, name: str, settings: str) -> None:
        out = ["--out", str(folder / f"{name}.json"), "--repeats", "1"]
        benchmark.main(out + settings.split())

    run(step_cost, "step_cost", "--elements 8 12 --seconds 1 --steps 20")
    run(real_time, "real_time", "--seconds 2 --no-command")
    run(soil_cost, "soil_cost", "--seconds 2 --steps 20")
    run(wave_setup, "wave_setup", "--seconds 2 --hours 0.1")
    tiny = "--elements 8 --seconds 1 --short 0.2 --steps 0.05 0.0125 --scipy 1e-2"
    run(work_precision, "work_precision", tiny + " --fine 0.005 --tight 1e-5")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(FOLDER))  # the new processes look for the script there
        run(cases_per_hour, "cases_per_hour", "--cases 2 --seconds 2 --processes 1")
    run(memory, "memory", "--seconds 2 4 --elements 8")
    return folder


def read(folder: Path, name: str) -> dict[str, Any]:
    return json.loads((folder / f"{name}.json").read_text())


def test_the_machine_is_described_and_not_named(results: Path):
    machine = read(results, "step_cost")["machine"]
    assert machine["cores"] >= 1
    assert machine["versions"].keys() == set(measuring.PACKAGES)
    assert importlib.import_module("platform").node() not in json.dumps(machine)


def test_a_step_is_the_sum_of_its_parts(results: Path):
    for row in read(results, "step_cost")["rows"]:
        assert sum(row["parts_s"].values()) == pytest.approx(row["step_smallest_s"])
        assert row["parts_s"].keys() == figures.PARTS.keys()
        assert row["residual_difference"] < step_cost.SAME_RESIDUAL
        assert row["largest_residual"] < step_cost.CONVERGED
        assert row["calls"]["balance"] == pytest.approx(row["calls"]["correction"] + 1)
        assert row["calls"]["solution"] >= row["calls"]["balance"]
        assert 1 <= row["mean_corrections"] < 4


def test_a_target_that_was_not_measured_is_neither_met_nor_missed(results: Path):
    by_size, growth = read(results, "step_cost")["targets"]
    assert (by_size["met"], growth["met"]) == (None, None)
    assert measuring.target("", 3.0, 2.9, at_least=False)["met"]
    assert not measuring.target("", 3.0, 3.1, at_least=False)["met"]
    assert measuring.target("", 100.0, 100.0, at_least=True)["met"]
    assert not measuring.target("", 100.0, 99.0, at_least=True)["met"]


def test_the_exponent_is_that_of_a_power():
    assert measuring.exponent([1, 2, 4], [3, 12, 48]) == pytest.approx(2)
    assert measuring.exponent([1], [3]) is None


def test_every_round_times_all_and_no_first_call(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(measuring, "SHORTEST_RUN", 0.0)
    calls: dict[str, list[int]] = {"first": [], "second": []}
    taken = measuring.rounds({name: seen.append for name, seen in calls.items()}, 3)
    assert {name: len(times) for name, times in taken.items()} == {"first": 3, "second": 3}
    assert calls == {"first": [1] * 5, "second": [1] * 5}


def test_integrators_converge_to_one_another(results: Path):
    report = read(results, "work_precision")
    whole, short = report["whole"]["runs"], report["first_seconds"]["runs"]
    for radius in work_precision.RADII:
        runs = [r for r in whole if r["family"] == f"generalised-alpha, radius {radius:g}"]
        assert [run["dt_s"] for run in runs] == [0.05, 0.0125]
        assert runs[0]["error_over_peak"] > 5 * runs[1]["error_over_peak"]
    families = {run["family"] for run in short}
    assert families == figures.OWN.keys()
    assert short[-1]["dt_s"] == 0.005
    assert short[-1]["error_over_peak"] < 2e-3
    assert all(0 < run["rms_over_deviation"] < 1 for run in short)


def test_the_same_cases_however_many_processes(results: Path):
    (row,) = read(results, "cases_per_hour")["rows"]
    assert len(set(row["peak_moments_nm"])) == 2
    assert row["parallel_efficiency"] == pytest.approx(1)


def test_each_ground_is_what_it_says(results: Path):
    rows = {row["ground"]: row for row in read(results, "soil_cost")["rows"]}
    assert rows.keys() == soil_cost.GROUNDS.keys()
    assert rows["shipped springs"]["over_shipped"] == 1
    loads = {name: soil_loads(name) for name in rows}
    assert loads["shipped springs"] == {"soil": "SoilSprings"}
    assert loads["hysteretic springs"] == {"soil": "HystereticSprings"}
    assert {"soil_rocking", "soil_base_shear", "soil_base_moment"} < loads["PISA clay"].keys()
    assert {"soil_shaft", "soil_torsion", "soil_bearing"} < loads["layered ground"].keys()
    assert loads["macro-element"] == {}
    for name, row in rows.items():
        assert (row["tangents_call_s"] > 0) == bool(loads[name])
        assert row["largest_residual"] <= step_cost.CONVERGED


def test_a_long_sea_is_set_up_at_the_strips(results: Path):
    report = read(results, "wave_setup")
    assert report["extrapolated"]
    level, moving = report["rows"]
    # harmonics of 360 s from 0.4 to 5 times the peak at 1 / 5.5 s
    assert level["components"] == moving["components"] == 327 - 27 + 1
    assert moving["strips"] > level["strips"] == 60
    # two numbers at least for each sum, at more than twice as many points as harmonics
    assert level["table_bytes"] > 8 * 2 * 2 * 2 * 327
    shares = [row["setup_over_run"] for row in report["rows"]]
    assert report["targets"][0]["measured"] == max(shares)
    for row in report["rows"]:
        assert row["rows_over_step"] > 0


def soil_loads(ground: str) -> dict[str, str]:
    """Names and kinds of the soil's loads."""
    foundation = soil_cost.case_on(ground, 2.0).system.foundation
    return {load.name: type(load).__name__ for load in foundation.soil}


def test_memory_and_results_are_counted(results: Path):
    short, long = read(results, "memory")["rows"]
    assert 1e7 < short["peak_before_bytes"] <= short["peak_bytes"]
    assert short["results_bytes"] < long["results_bytes"]


def test_the_page_shows_what_was_run_and_names_the_rest(results: Path, tmp_path: Path):
    out = tmp_path / "index.html"
    shown = page.main(["--results", str(results), "--out", str(out)])
    assert shown["missing"] == ["peers", "pure_python"]
    text = out.read_text()
    assert "Other codes; The pure-Python core; offwind run as a whole" in text
    assert text.count('<p class="missing">Not run.</p>') == 2
    assert text.count("<svg") == 5
    assert "not measured" in text
    assert "http" not in text.replace("http://www.w3.org", "")


def test_other_codes_stand_beside_ours(tmp_path: Path):
    steps = [
        {"dt_s": 0.1, "failed": "no"},
        {"dt_s": 0.05, "peak": 1e-2, "rms": 1e-2, "wall_s": 6.0, "cpu_s": 3.0},
    ]
    rows = {
        "exudyn_chain": {"status": "checked", "steps": steps, "within": {"0.02": steps[1]}},
        "mujoco_chain": {"status": "not run: mujoco is not installed"},
    }
    own = {"dt_s": 0.1, "peak": 0.015, "rms": 0.03, "wall_s": 2.0, "cpu_s": 1.0}
    rows = {"offwind_chain": {"status": "checked", "steps": [own], "within": {"0.02": own}}} | rows
    reports = {"peers": {"machine": "some", "rows": rows}}
    ours, exudyn, mujoco = page.codes(reports)
    assert ours["ratio"] == {0.02: 1.0, 0.002: None}
    assert exudyn["ratio"] == {0.02: 3.0, 0.002: None}
    assert mujoco["status"].startswith("not run")
    text = page.render(reports)
    assert "MuJoCo (not run: mujoco is not installed)" in text
    assert "OpenSees, planar" in text


def test_an_empty_folder_gives_a_page_that_says_so(tmp_path: Path):
    shown = page.main(["--results", str(tmp_path)])
    assert shown["missing"] == list(page.NAMES)
    assert "Nothing with a target was run." in Path(shown["page"]).read_text()


def test_a_benchmark_that_fails_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    broken = run_all.Benchmark("memory.py", "--no-such-option")
    monkeypatch.setitem(run_all.BENCHMARKS, "memory", broken)
    assert run_all.main(["--quick", "--only", "memory", "--out", str(tmp_path)]) == ["memory"]
    assert "no-such-option" in (tmp_path / "memory.log").read_text()
    assert (tmp_path / "index.html").is_file()


def test_every_benchmark_has_its_script_and_its_place_on_the_page():
    assert run_all.BENCHMARKS.keys() == page.NAMES.keys()
    assert all((FOLDER / benchmark.script).is_file() for benchmark in run_all.BENCHMARKS.values())
