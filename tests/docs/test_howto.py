"""A newcomer with nothing but the how-to pages gets to what they promise."""

from __future__ import annotations

import json
import re
import runpy
from pathlib import Path
from typing import Any

import pytest
import xarray as xr
from helpers.doc_pages import ROOT, Block, blocks, compare, follow

import offwind_pin as ow
from offwind_pin import cli

FOLDER = ROOT / "docs" / "howto"
WITH_MORE = {"own_turbine", "own_load_file"}
"""Pages that a test of their own follows and then looks at what came out."""
PAGES = sorted(page for page in FOLDER.glob("*.md") if page.stem not in WITH_MORE)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, in which the reader works on a terminal of 100 columns."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    return tmp_path


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: Any) -> Any:
    """Run ``offwind ...`` or ``python file.py``; anything else, and any failure, fails the test."""

    def command(words: list[str]) -> str:
        program, *rest = words
        capsys.readouterr()
        if program == "python":
            (name,) = rest
            runpy.run_path(name, run_name="__main__")
        else:
            assert program == "offwind"
            monkeypatch.setattr("sys.argv", words)
            with pytest.raises(SystemExit) as stop:
                cli.main()
            assert not stop.value.code, capsys.readouterr().err
        return str(capsys.readouterr().out)

    return command


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page(page: Path, folder: Path, run: Any) -> None:
    """Every file can be saved, every command runs, and what it prints is what the page shows."""
    _follow(page.stem, folder, run)


def _follow(name: str, folder: Path, run: Any) -> None:
    commands = follow(FOLDER / f"{name}.md", folder, run)
    assert len(commands) >= 3
    assert any(line.startswith("offwind ") for line in commands)


def test_first_turbine(folder: Path, run: Any) -> None:
    """From nothing to first modes and a report: the files are there and agree with the package."""
    _follow("own_turbine", folder, run)
    modes = ow.modes(ow.build(ow.load_turbine(folder / "coast_clamped.yaml"), "clamped"))
    assert modes.frequency_hz[modes.index("FA1")] == pytest.approx(0.3017, rel=1e-3)
    summary = json.loads((folder / "storm" / "summary.json").read_text())
    assert summary["status"] == "complete"
    assert summary["mudline_moment_y_max_Nm"] > summary["mudline_moment_y_mean_Nm"] > 3.7e7
    report = (folder / "storm" / "report.html").read_text()
    assert "A storm at the coast" in report
    assert "<svg" in report
    assert "FA2" in (folder / "fa2.html").read_text()


def test_misspelt_key_of_the_page(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """The page says how a wrong key is answered."""
    (turbine,) = (b.text for b in blocks(FOLDER / "own_turbine.md") if b.file == "coast.yaml")
    (folder / "bad.yaml").write_text(turbine.replace("diameter_m", "diametre_m"))
    monkeypatch.setattr("sys.argv", ["offwind", "show", "bad.yaml"])
    with pytest.raises(SystemExit) as stop:
        cli.main()
    assert stop.value.code == 2
    assert "Did you mean 'diameter_m'?" in capsys.readouterr().err


def test_kilonewtons_are_guessed(folder: Path, run: Any, caplog: pytest.LogCaptureFixture) -> None:
    """Without the factor the log guesses, as the page says."""
    _follow("own_load_file", folder, run)
    case = (folder / "pushed_kn.yaml").read_text()
    (folder / "forgotten.yaml").write_text(case.replace("factor: 1000.0", "factor: 1.0"))
    assert "factor: 1000.0" in case
    caplog.clear()
    run(["offwind", "run", "forgotten.yaml", "--out", "forgotten"])
    assert any("seem to be in kN" in record.message for record in caplog.records)


def test_aliases_are_those_of_the_dataset() -> None:
    """The table of channels names every alias of the results, and no other."""
    system = ow.build(ow.load_turbine("oc3_phase2"), "clamped", ow.StillWater(), elements=8)
    history = ow.simulate(system, 0.2, 0.1)
    assert isinstance(history, xr.Dataset)
    page = (FOLDER / "compare_with_openfast.md").read_text()
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*?) \|", page, flags=re.MULTILINE))
    told = {name: re.findall(r"`(-?\w+)`", cell) for name, cell in rows.items()}
    aliases = {
        name: channel.attrs["openfast_alias"].split()
        for name, channel in history.data_vars.items()
        if "openfast_alias" in channel.attrs
    }
    assert told == aliases


def test_the_reader_can_stumble(folder: Path, run: Any) -> None:
    """Negative controls: a printed line that is not, lines in another order, a block without a place."""
    compare("a 1\nb 2", "┃ a ┃ 1 ┃\nother\n│ b │ 2 │")
    for shown in ("a 2", "b 2\na 1"):
        with pytest.raises(AssertionError, match="not printed"):
            compare(shown, "a 1\nb 2")
    page = folder / "page.md"
    page.write_text("Save as `x.txt`:\n\n```text\n1\n```\n")
    assert blocks(page) == [Block("x.txt", "text", "1\n")]
    assert follow(page, folder, run) == []
    assert (folder / "x.txt").read_text() == "1\n"
    for text, message in (
        ("Look:\n\n```yaml\na: 1\n```\n", "nothing runs"),
        ("Look:\n\n```text\na: 1\n```\n", "no command"),
    ):
        page.write_text(text)
        with pytest.raises(AssertionError, match=message):
            follow(page, folder, run)
    page.write_text("Run:\n\n```console\noffwind show nothing.yaml\n```\n")
    with pytest.raises(AssertionError):
        follow(page, folder, run)
