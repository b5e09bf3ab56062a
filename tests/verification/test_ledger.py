"""Every row of the ledger holds; and the ledger would see what does not."""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import offwind_pin as ow
from offwind_pin.verification import ledger
from offwind_pin.verification.checks import motion
from offwind_pin.verification.ledger import Found, Row, check, choose, read_ledger, verify
from offwind_pin.verification.page import verification_page

Shipped = Callable[[str], tuple[dict[str, Any], Path]]

ROWS = read_ledger()
PAGE = Path(__file__).resolve().parents[2] / "VERIFICATION.md"


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_row(row: Row, shipped: Shipped, monkeypatch: pytest.MonkeyPatch) -> None:
    """Load cases are run once for these rows and for the tests of the cases."""
    monkeypatch.setattr(motion, "_load_case", lambda name: shipped(name)[0])
    outcome = check(row)
    if outcome.status == "not run":
        assert row.needs not in {None, "mujoco"}  # which is in the development group
        pytest.skip(str(outcome.reason))
    assert outcome.status == "pass", f"{outcome.value} against {outcome.reference}"


def test_load_cases_of_the_rows_are_run() -> None:
    """Outside of these tests, where nothing is shared, a row runs its case itself."""
    summary = motion._load_case("oc6-lc2.1")
    assert summary["FA1_hz"] == pytest.approx(0.2744, rel=3e-3)


def test_there_are_many_rows_with_sources() -> None:
    assert len(ROWS) >= 60
    assert all(row.source and row.quantity and row.tolerance > 0 for row in ROWS)
    assert all(row.reference != 0 or row.kind == "absolute" for row in ROWS)


def made(**change: Any) -> Row:
    """A row about a computed frequency, changed."""
    row = next(row for row in ROWS if row.id == "beam-twist")
    return row.model_copy(update=change)


@pytest.mark.parametrize(
    ("change", "status"),
    [
        ({}, "pass"),
        ({"reference": 1 + 2e-10}, "fail"),
        ({"reference": 1.05, "tolerance": 0.06, "kind": "absolute"}, "pass"),
        ({"reference": 1.05, "tolerance": 0.04, "kind": "absolute"}, "fail"),
        ({"needs": "a_program_that_nobody_has"}, "not run"),
    ],
)
def test_what_is_off_fails(change: dict[str, Any], status: str) -> None:
    """Negative control: a changed reference or tolerance is seen, an absent peer never passes."""
    outcome = check(made(**change))
    assert outcome.status == status
    assert outcome.as_dict()["pass"] is {"pass": True, "fail": False, "not run": None}[status]


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_no_number_fails(monkeypatch: pytest.MonkeyPatch, value: float) -> None:
    monkeypatch.setattr(Row, "function", property(lambda row: lambda: Found(value, 1.0)))
    assert check(made()).status == "fail"


def test_a_check_that_raises_fails_and_the_others_go_on() -> None:
    broken = made(id="broken", check="structure.uniform_frequency", given={"mode": 99})
    outcomes = verify([broken, made()])
    assert [outcome.status for outcome in outcomes] == ["fail", "pass"]
    assert outcomes[0].reason


def test_unknown_rows_are_refused() -> None:
    with pytest.raises(ow.InputError, match="beam"):
        choose("nothing-*")
    assert {row.group for row in choose("mujoco-*")} == {"Peers"}


def test_command(offwind: Any, tmp_path: Path) -> None:
    """JSON rows with the agreed keys; the page names each row; exit status 0."""
    page = tmp_path / "rows.md"
    code, out, _ = offwind("verify", "--only", "beam-t*", "--json", "--page", str(page))
    rows = json.loads(out)["rows"]
    assert code == 0
    assert {"id", "quantity", "value", "reference", "source", "tolerance", "pass"} <= set(rows[0])
    assert all(row["pass"] for row in rows)
    assert logging.getLogger("offwind_pin").isEnabledFor(logging.WARNING)  # as it was before
    text = page.read_text()
    assert all(f"| {row['id']} |" in text for row in rows)


def test_command_fails_with_its_rows(offwind: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ledger, "read_ledger", lambda: (made(id="wrong", reference=2.0),))
    code, out, _ = offwind("verify")
    assert code == 1
    assert "0 of 1 rows passed" in out


def test_the_page_in_the_repository_is_of_this_ledger() -> None:
    """Same rows, references and tolerances; what was found there is of its day."""
    listed = {line.split(" | ")[0].removeprefix("| ") for line in PAGE.read_text().splitlines()}
    assert {row.id for row in ROWS} <= listed
    lines = {line.split(" | ")[0]: line for line in verification_page([check(made())]).splitlines()}
    assert lines["| beam-twist"].split(" | ")[5] in PAGE.read_text()
