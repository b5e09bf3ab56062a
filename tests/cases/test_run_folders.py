"""What a second run into a directory does, and what a run that ended early leaves."""

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

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.cases import run as case_run
from offwind_pin.cases.planned_runs import planned_runs, seed_numbers
from offwind_pin.cases.run import run_case
from offwind_pin.results.folder_lock import FolderLock
from offwind_pin.results.manifest import read_manifest

MODES: dict[str, Any] = {
    "name": "still",
    "turbine": "oc6_phase2",
    "foundation": "clamped",
    "elements": 4,
    "sea": {"kind": "still_water"},
    "analysis": {"kind": "modes", "count": 3},
}
TRANSIENT: dict[str, Any] = MODES | {
    "name": "waves",
    "sea": {"kind": "irregular_waves", "significant_height_m": 2.0, "peak_period_s": 6.0},
    "analysis": {
        "kind": "transient",
        "duration_s": 45.0,
        "ramp_s": 5.0,
        "dt_s": 0.1,
        "output_dt_s": 0.2,
        "psd_segment_s": 10.0,
    },
}


def write(folder: Path, case: dict[str, Any]) -> str:
    path = folder / f"{case['name']}.yaml"
    path.write_text(yaml.safe_dump(case))
    return str(path)


def case_of(case: dict[str, Any]) -> ow.Case:
    return ow.Case.model_validate(case)


def contents(directory: Path) -> dict[str, tuple[bytes, int]]:
    """Bytes and time of change of every file."""
    return {
        str(path.relative_to(directory)): (path.read_bytes(), path.stat().st_mtime_ns)
        for path in sorted(directory.rglob("*"))
        if path.is_file()
    }


def same_results(one: Path, other: Path) -> bool:
    """Every variable and attribute to the bit, but for times and where a run was resumed."""
    paths = (one / "results.nc", other / "results.nc")
    with xr.open_datatree(paths[0]) as first, xr.open_datatree(paths[1]) as second:
        for tree in (first, second):
            for name in ("wall_s", "resumed_at_s"):
                tree["case"].attrs.pop(name)
        if not first.identical(second):
            return False
        return all(
            a.to_dataset(inherit=False)[name].to_numpy().tobytes()
            == b.to_dataset(inherit=False)[name].to_numpy().tobytes()
            for a, b in zip(first.subtree, second.subtree, strict=True)
            for name in a.to_dataset(inherit=False).variables
            if a.to_dataset(inherit=False)[name].dtype.kind not in "OU"
        )


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The time history, run once and left alone."""
    out = tmp_path_factory.mktemp("whole")
    run_case(case_of(TRANSIENT), out, report=False)
    return out


@pytest.fixture
def nothing_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any, **__: Any) -> None:
        raise AssertionError("something was solved")

    monkeypatch.setattr(case_run, "_solve", refuse)


def stop_at(time: float, error: type[BaseException] = KeyboardInterrupt) -> Any:
    def progress(now: float, _: float) -> None:
        if now >= time:
            raise error

    return progress


class TestSecondRun:
    def test_of_the_same_case(
        self,
        tmp_path: Path,
        offwind: Any,
        monkeypatch: pytest.MonkeyPatch,
        caplog: pytest.LogCaptureFixture,
    ) -> None:
        """It is complete already: exit 0, nothing solved, nothing written."""
        case, out = write(tmp_path, MODES), tmp_path / "out"
        words = ["run", case, "--out", str(out), "--json", "--no-report"]
        first = offwind(*words)
        assert first[0] == 0
        before = contents(out)
        monkeypatch.setattr(case_run, "_solve", None)
        code, text, _ = offwind(*words)
        assert (code, text) == (0, first[1])
        assert "already complete" in caplog.text
        assert contents(out) == before

    @pytest.mark.usefixtures("nothing_solved")
    def test_makes_a_report_that_was_left_out(self, whole: Path, tmp_path: Path) -> None:
        out = tmp_path / "out"
        shutil.copytree(whole, out)
        run_case(case_of(TRANSIENT), out, report=False)
        assert not (out / "report.html").exists()
        run_case(case_of(TRANSIENT), out)
        assert (out / "report.html").exists()
        assert contents(out)["results.nc"][0] == contents(whole)["results.nc"][0]

    @pytest.mark.parametrize(
        ("change", "named"),
        [
            ({"name": "other"}, "case still"),
            ({"seed": 4}, "seed 1"),
            ({"elements": 5}, "content_hash"),
        ],
    )
    def test_of_another_case(
        self, tmp_path: Path, offwind: Any, change: dict[str, Any], named: str
    ) -> None:
        """Exit 2 and nothing touched; --overwrite replaces it."""
        out = tmp_path / "out"
        assert offwind("run", write(tmp_path, MODES), "--out", str(out), "--no-report")[0] == 0
        (out / "note.txt").write_text("mine")
        before = contents(out)
        other = write(tmp_path, MODES | change)
        words = ["run", other, "--out", str(out), "--no-report"]
        code, _, err = offwind(*words)
        assert code == 2
        assert named in err
        assert "--overwrite" in err
        assert contents(out) == before
        assert offwind(*words, "--overwrite")[0] == 0
        assert json.loads((out / "summary.json").read_text())["case"] == (MODES | change)["name"]
        after = contents(out)
        assert after["note.txt"] == before["note.txt"]
        assert set(after) == set(before)
        assert all(after[name] != before[name] for name in before if name != "note.txt")

    def test_of_another_version(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        run_case(case_of(MODES), tmp_path, report=False)
        newer = case_run.versions() | {"offwind_pin_version": "99.0"}
        monkeypatch.setattr(case_run, "versions", lambda: newer)
        with pytest.raises(ow.InputError, match=r"offwind_pin_version .* 99\.0"):
            run_case(case_of(MODES), tmp_path)
        run_case(case_of(MODES), tmp_path, report=False, overwrite=True)

    def test_at_the_same_time(self, tmp_path: Path, offwind: Any) -> None:
        """The second ends with exit 2, whatever it wants; a report is not made either."""
        out = tmp_path / "out"
        case = write(tmp_path, MODES)
        assert offwind("run", case, "--out", str(out), "--no-report")[0] == 0
        lock = FolderLock(out)
        before = contents(out)
        for words in (
            ["run", case, "--out", str(out)],
            ["run", case, "--out", str(out), "--overwrite"],
            ["report", str(out)],
        ):
            code, _, err = offwind(*words)
            assert code == 2
            assert "another run" in err
        assert contents(out) == before
        lock.release()
        assert offwind("run", case, "--out", str(out), "--no-report")[0] == 0

    @pytest.mark.parametrize("name", ["results.nc", "summary.json", "report.html", "blocks/a.txt"])
    @pytest.mark.parametrize("overwrite", [False, True])
    def test_among_files_of_other_origin(
        self, tmp_path: Path, offwind: Any, name: str, overwrite: bool
    ) -> None:
        """Not even with --overwrite."""
        path = tmp_path / "out" / name
        path.parent.mkdir(parents=True)
        path.write_text("mine")
        before = contents(tmp_path / "out")
        words = ["run", write(tmp_path, MODES), "--out", str(tmp_path / "out"), "--no-report"]
        code, _, err = offwind(*words, *(["--overwrite"] if overwrite else []))
        assert code == 2
        assert name.split("/")[0] in err
        assert contents(tmp_path / "out") == before

    def test_bad_input_leaves_the_earlier_results(self, tmp_path: Path) -> None:
        """A fault that is only found while solving comes before the first file is replaced."""
        run_case(case_of(MODES), tmp_path, report=False)
        before = contents(tmp_path)
        repeating = case_of(TRANSIENT | {"sea": TRANSIENT["sea"] | {"repeat_period_s": 31.0}})
        with pytest.raises(ow.InputError, match="repeat"):
            run_case(repeating, tmp_path, overwrite=True)
        assert contents(tmp_path) == before


class TestReportOfResults:
    def test_is_the_runs_own(self, tmp_path: Path, offwind: Any) -> None:
        """Made again, it still belongs to the run; a page of someone else is not replaced.

        In a directory without a manifest a report is known by its head.
        """
        run, copy = tmp_path / "run", tmp_path / "copy"
        run_case(case_of(MODES), run)
        copy.mkdir()
        shutil.copy(run / "results.nc", copy)
        shutil.copy(run / "report.html", copy)
        for out in (run, copy):
            assert offwind("report", str(out))[0] == 0
            (out / "report.html").write_text("<html>mine</html>")
            code, _, err = offwind("report", str(out))
            assert code == 2
            assert "report.html" in err
            assert (out / "report.html").read_text() == "<html>mine</html>"


class TestEndedEarly:
    def test_after_the_results(
        self, tmp_path: Path, whole: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """Blocks are there until the summary is; nothing is solved again."""
        with monkeypatch.context() as patch:
            patch.setattr(case_run, "summary", lambda _: (_ for _ in ()).throw(SystemExit))
            with pytest.raises(SystemExit):
                run_case(case_of(TRANSIENT), tmp_path, report=False)
        assert (tmp_path / "blocks").is_dir()
        assert not (tmp_path / "summary.json").exists()
        monkeypatch.setattr(case_run, "_solve", None)
        assert run_case(case_of(TRANSIENT), tmp_path, report=False)["status"] == "complete"
        assert {path.name for path in tmp_path.iterdir()} == {
            "manifest.json", "results.nc", "summary.json",
        }  # fmt: skip
        assert same_results(tmp_path, whole)

    def test_on_a_full_disk(
        self,
        tmp_path: Path,
        whole: Path,
        monkeypatch: pytest.MonkeyPatch,
        caplog: pytest.LogCaptureFixture,
        offwind: Any,
    ) -> None:
        """Exit 1 with a message that names the file; the same command continues."""

        def full(path: Path, *_: Any) -> None:
            raise OSError(28, "No space left on device", str(path))

        case, out = write(tmp_path, TRANSIENT), tmp_path / "out"
        for step, name in (
            ("add_groups", "results.nc"),
            ("write_text", "report.html"),
            ("write_json", "summary.json"),
        ):
            caplog.clear()
            with monkeypatch.context() as patch:
                patch.setattr(case_run, step, full)
                code, _, err = offwind("run", case, "--out", str(out))
            assert code == 1
            assert "No space left on device" in err
            assert name in err
            assert "continues" in caplog.text
            monkeypatch.setattr(GeneralizedAlpha, "advance", None)  # nothing is simulated again
        assert offwind("run", case, "--out", str(out), "--no-report")[0] == 0
        assert same_results(out, whole)

    def test_without_its_directory(
        self, tmp_path: Path, offwind: Any, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """At the next block the run stops with exit 1; the directory is not made again."""
        case, out = write(tmp_path, TRANSIENT), tmp_path / "out"
        reached: list[float] = []
        advance = GeneralizedAlpha.advance

        def and_remove(*arguments: Any) -> Any:
            state, records = advance(*arguments)
            reached.append(state.time)
            shutil.rmtree(out)
            return state, records

        monkeypatch.setattr(GeneralizedAlpha, "advance", and_remove)
        code, _, err = offwind("run", case, "--out", str(out))
        assert code == 1
        assert "removed or replaced" in err
        assert reached == [pytest.approx(20.0)]
        assert not out.exists()

    def test_by_the_user(self, tmp_path: Path, whole: Path) -> None:
        """Interrupted and continued: bitwise the same."""
        with pytest.raises(ow.InterruptedSimulation):
            run_case(case_of(TRANSIENT), tmp_path, report=False, progress=stop_at(20.0))
        manifest = read_manifest(tmp_path)
        assert manifest is not None
        assert manifest.state == "interrupted"
        assert json.loads((tmp_path / "summary.json").read_text())["status"] == "interrupted"
        found = run_case(case_of(TRANSIENT), tmp_path, report=False)
        assert found["resumed_at_s"] == pytest.approx(20.0)
        assert same_results(tmp_path, whole)

    def test_with_blocks_of_another_run(self, tmp_path: Path) -> None:
        """Blocks of another seed in the place of one's own are refused, exit 2."""
        for seed in (1, 2):
            with pytest.raises(ow.InterruptedSimulation):
                run_case(
                    case_of(TRANSIENT).with_seed(seed), tmp_path / str(seed), progress=stop_at(20.0)
                )
        shutil.rmtree(tmp_path / "1" / "blocks")
        shutil.copytree(tmp_path / "2" / "blocks", tmp_path / "1" / "blocks")
        with pytest.raises(ow.InputError, match="block_000001"):
            run_case(case_of(TRANSIENT).with_seed(1), tmp_path / "1")
        run_case(case_of(TRANSIENT).with_seed(2), tmp_path / "2", report=False)

    def test_comparison_sees_one_bit(self, whole: Path, tmp_path: Path) -> None:
        """Negative control."""
        shutil.copytree(whole, tmp_path / "copy")
        assert same_results(whole, tmp_path / "copy")
        path = tmp_path / "copy" / "results.nc"
        with xr.open_dataset(path) as data:
            changed = data["mudline_moment"].load().copy()
        changed[-1, 1] = np.nextafter(changed[-1, 1], np.inf)
        import netCDF4

        with netCDF4.Dataset(path, "a") as file:
            file["mudline_moment"][:] = changed.to_numpy()
        assert not same_results(whole, tmp_path / "copy")


class TestSeeds:
    def test_replace_all_of_a_case(self) -> None:
        """Those that waves and wind have of their own as well."""
        own = case_of(
            TRANSIENT
            | {
                "sea": TRANSIENT["sea"] | {"seed": 7},
                "tower_top_load": {
                    "kind": "synthetic",
                    "wind_speed_m_per_s": 9.0,
                    "blade_passing_frequency_hz": 0.388,
                    "seed": 8,
                },
            }
        )
        water = own.water
        assert water is not None
        assert water.wave_seed == 7
        again = own.with_seed(3)
        load = again.tower_top_load
        assert again.water is not None
        assert load is not None
        assert again.water.wave_seed == again.seed == 3
        assert load.completed(again.seed).wind_seed == 3  # type: ignore[union-attr]
        assert again.with_seed(3) == again
        assert again.content_hash != own.content_hash
        with pytest.raises(ow.InputError, match="seed"):
            own.with_seed(-1)

    def test_one_run_of_each(self, tmp_path: Path, offwind: Any) -> None:
        """Each in a directory of its own, with the results that it has alone."""
        names = [write(tmp_path, case) for case in (MODES, TRANSIENT)]
        out = tmp_path / "out"
        words = ["--seeds", "2-3", "--no-report", "--json"]
        code, text, _ = offwind("run", *names, "--out", str(out), *words)
        assert code == 0
        rows = json.loads(text)["runs"]
        places = [(row["case"], row["seed"], row["directory"]) for row in rows]
        assert places == [
            (name, seed, str(out / name / f"seed_{seed:04d}"))
            for name in ("still", "waves")
            for seed in (2, 3)
        ]
        alone = tmp_path / "alone"
        assert offwind("run", names[1], "--seed", "3", "--out", str(alone), "--no-report")[0] == 0
        assert same_results(out / "waves" / "seed_0003", alone)
        moments = [row["mudline_moment_y_std_Nm"] for row in rows[2:]]
        assert moments[0] != moments[1]
        assert offwind("run", *names, "--out", str(out), *words)[0] == 0

    def test_one_failure_does_not_stop_the_others(self, tmp_path: Path, offwind: Any) -> None:
        names = [write(tmp_path, case) for case in (MODES, MODES | {"name": "second"})]
        foreign = tmp_path / "out" / "still" / "seed_0001" / "results.nc"
        foreign.parent.mkdir(parents=True)
        foreign.write_text("mine")
        code, text, err = offwind(
            "run", *names, "--out", str(tmp_path / "out"), "--json", "--no-report"
        )
        assert code == 2
        assert "results.nc" in err
        assert [row["status"] for row in json.loads(text)["runs"]] == ["failed", "complete"]

    @pytest.mark.parametrize(
        "words", [["--seed", "-1"], ["--seeds", "3-1"], ["--seed", "1", "--seeds", "2"]]
    )
    def test_that_cannot_be(self, tmp_path: Path, offwind: Any, words: list[str]) -> None:
        case = write(tmp_path, MODES)
        code, _, err = offwind("run", case, "--out", str(tmp_path / "out"), *words)
        assert code == 2
        assert "seed" in err
        assert not (tmp_path / "out").exists()

    def test_lists(self) -> None:
        assert seed_numbers("1-3") == [1, 2, 3]
        assert seed_numbers("4") == [4]
        assert seed_numbers(" 1, 4 ,7-9") == [1, 4, 7, 8, 9]
        for text in (
            "",
            "a",
            "1-",
            "-1",
            "1,1",
            "1-3,2",
            "3-1",
            "1.5",
            "1-99999",
            "٣",
            "1_0",
            "9" * 12,
        ):
            with pytest.raises(ow.InputError, match="--seeds"):
                seed_numbers(text)

    def test_two_cases_of_one_name(self, tmp_path: Path) -> None:
        with pytest.raises(ow.InputError, match="still given twice"):
            planned_runs([case_of(MODES), case_of(MODES | {"elements": 5})], None, tmp_path)


@pytest.fixture(autouse=True)
def _released(tmp_path: Path) -> Iterator[None]:
    """However a run ends, its lock is gone."""
    yield
    assert not list(tmp_path.rglob(".offwind-pin.lock"))
