"""The ledger as a page: claims, computed values, date and versions."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from datetime import UTC, datetime

from offwind_pin.results.dataset import versions
from offwind_pin.verification.ledger import Outcome, Row

_HEAD = """# Verification

Every row is a claim with its reference, tolerance and source. `offwind verify` and the tests check
all rows; `offwind verify --only ID` checks one. Rows that need a program that is not installed are
marked as not run. This page is written by `offwind verify --page VERIFICATION.md`.
"""
_COLUMNS = """| row | quantity | computed | reference | difference | tolerance | status | source |
| --- | --- | --- | --- | --- | --- | --- | --- |"""


def verification_page(outcomes: Sequence[Outcome]) -> str:
    """Markdown with a table for each group of rows."""
    made = ", ".join(f"{name.removesuffix('_version')} {v}" for name, v in versions().items())
    day = datetime.now(UTC).date().isoformat()
    passed = sum(outcome.status == "pass" for outcome in outcomes)
    absent = sum(outcome.status == "not run" for outcome in outcomes)
    lines = [
        _HEAD,
        f"Checked on {day} with {made}, Python {platform.python_version()}: {passed} of "
        f"{len(outcomes)} rows pass, {absent} were not run.",
    ]
    for group in dict.fromkeys(outcome.row.group for outcome in outcomes):
        rows = [outcome for outcome in outcomes if outcome.row.group == group]
        lines += ["", f"## {group}", "", _COLUMNS]
        lines += [_line(*outcome_cells(outcome), outcome.row.source) for outcome in rows]
        remarks = dict.fromkeys(row.row.remark for row in rows if row.row.remark is not None)
        for remark in remarks:
            ids = [f"`{row.row.id}`" for row in rows if row.row.remark == remark]
            lines += ["", f"{', '.join(ids)}: {remark}"]
    return "\n".join(lines) + "\n"


def outcome_cells(outcome: Outcome) -> tuple[str, str, str, str, str, str, str]:
    """Id, quantity, computed value, reference, difference, tolerance and status, as text."""
    row = outcome.row
    unit = "" if row.unit == "-" else f" {row.unit}"
    value, reference = (
        "" if number is None else f"{number:.5g}{unit}"
        for number in (outcome.value, outcome.reference)
    )
    off = "" if outcome.distance is None else _size(outcome.distance, row)
    allowed = _size(row.tolerance, row)
    return row.id, row.quantity, value, reference, off, allowed, outcome.status


def _size(number: float, row: Row) -> str:
    """A difference: in per cent if it is relative and not tiny."""
    if row.kind == "relative" and (number == 0 or number >= 1e-6):
        return f"{100 * number:.2g} %"
    unit = "" if row.unit == "-" or row.kind == "relative" else f" {row.unit}"
    return f"{number:.2g}{unit}"


def _line(*cells: str) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
