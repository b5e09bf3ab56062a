"""Text of users on the terminal: neither markup nor control characters; errors name the file."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import pytest

import offwind_pin as ow
from offwind_pin.base.errors import brief, printable
from offwind_pin.cli.main import complain
from offwind_pin.cli.tables import print_values

NASTY = "\x1b[31m[red]\x07\u202egnp.[/red]\r[link=file:x]\udcff:smile:"
LIBRARY = Path(ow.__file__).parent / "definitions" / "library"


def test_printable() -> None:
    """Controls, a change of direction and lone surrogates are shown as escapes; text is not changed."""
    shown = printable(NASTY)
    assert shown.isprintable()
    assert shown == r"\x1b[31m[red]\x07\u202egnp.[/red]\r[link=file:x]\udcff:smile:"
    for plain in ("Hs = 3 m, \u00e4\u00f6\u03bb, 5 %", ""):
        assert printable(plain) == plain


def test_tables(capsys: pytest.CaptureFixture[str]) -> None:
    """A title and a value with markup are printed as they are."""
    print_values(NASTY, {"[bold]key": NASTY})
    printed = capsys.readouterr().out
    for text in ("[red]", "[/red]", "[link=file:x]", ":smile:", r"\x1b[31m", "[bold]key"):
        assert text in printed
    assert "\x1b" not in printed
    assert "\x07" not in printed


def test_errors_and_log(offwind: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A path with controls in an error, on standard output and in the log."""
    complain(f"offwind: {NASTY}")
    assert printable(NASTY) in capsys.readouterr().err
    folder = tmp_path / "\x1b[31m[red]"
    folder.mkdir()
    path = folder / "turbine.yaml"
    path.write_text((LIBRARY / "oc3_phase2.yaml").read_text())
    code, out, err = offwind("urdf", str(path), "--foundation", "clamped", "--out", str(folder))
    assert code == 0, err
    assert r"\x1b[31m[red]" in out
    assert "\x1b" not in out + err
    code, _, err = offwind("modes", str(path), "--foundation", "none")
    assert code == 2
    assert r"\x1b[31m[red]" in err
    assert "\x1b" not in err


def test_errors_behind_the_definition_name_its_file(offwind: Any, tmp_path: Path) -> None:
    """What is found while the system is built is told with the user's file."""
    path = tmp_path / "mine.yaml"
    path.write_text((LIBRARY / "oc3_phase2.yaml").read_text())
    for argv in (
        ["modes", str(path), "--foundation", "nothing"],
        ["static", str(path), "--elements", "100000"],
        ["urdf", str(path), "--out", str(tmp_path / "x"), "--elements", "100000"],
    ):
        code, _, err = offwind(*argv)
        assert code == 2
        assert err.startswith(f"offwind: {path}: "), err


@pytest.mark.parametrize(
    "argv",
    [
        ["modes", "oc3_phase2", "--elements", "1_0"],
        ["modes", "oc3_phase2", "--elements", "4.0"],
        ["modes", "oc3_phase2", "--count", "\u0664"],
        ["view", "oc3_phase2", "--fps", "nan"],
        ["view", "oc3_phase2", "--start", "1_0"],
        ["soil", "oc3_phase2", "--arm", "inf"],
        ["static", "oc3_phase2", "--tower-top-load", "1_0,0,0,0,0,0"],
        ["static", "oc3_phase2", "--tower-top-load", "nan,0,0,0,0,0"],
        ["show", "n" * 5000],
        ["show", "a\x1bb"],
        ["report", "n" * 5000],
        ["run", "n" * 5000, "--out", "x"],
        ["modes", "oc3_phase2", "--\x1b[31mx"],
    ],
)
def test_bad_words(offwind: Any, argv: list[str]) -> None:
    code, out, err = offwind(*argv)
    assert (code, out) == (2, "")
    assert "\x1b" not in err
    assert "Traceback" not in err


def test_log_of_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    from offwind_pin.cli.main import Plain

    record = logging.LogRecord("x", logging.INFO, "x", 1, "read %s", (NASTY,), None)
    assert Plain("offwind: %(message)s").format(record) == f"offwind: read {printable(NASTY)}"


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        ([1, [2, "a"]], "[1, [2, 'a']]"),
        ({"a": (1,), 2: None}, "{'a': (1,), 2: None}"),
        ((), "()"),
        (1.5, "1.5"),
    ],
)
def test_values_in_messages(value: object, shown: str) -> None:
    assert brief(value) == shown


def test_no_more_of_a_value_is_looked_at_than_is_shown() -> None:
    """Lists that share their parts have 10^40 items; each is shown at once."""
    shared: list[Any] = ["x"] * 10
    for _ in range(40):
        shared = [shared] * 10
    assert len(brief(shared)) == 240
    endless: list[Any] = []
    endless.append(endless)
    assert len(brief(endless)) == 240
    assert len(brief("x" * 10**7)) == 240
    assert brief(10**5000) == "an integer of 16610 bits"
