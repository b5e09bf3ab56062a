"""Tables and notes on standard output."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table

from offwind_pin.base.mode_labels import DAMPING_PARTS, mode_name

if TYPE_CHECKING:
    from offwind_pin.analysis.foundation.study.study import SoilOverview
    from offwind_pin.cases.turbine_overview import Overview
    from offwind_pin.dynamics.system import System
    from offwind_pin.verification.ledger import Outcome


def print_modes(title: str, rows: Sequence[Mapping[str, Any]]) -> None:
    """One line per mode, as returned by :func:`summarise_modes`."""
    table = Table("mode", "", "frequency", "damping", "peak at", title=title)
    for row in rows:
        table.add_row(
            row["label"],
            mode_name(row["label"]),
            f"{row['frequency_hz']:.4f} Hz",
            f"{100 * row['damping_ratio']:.2f} %",
            f"{row['shape_peak_height_ratio']:.2f} of height",
        )
    Console().print(table)
    parts = [f"damping_ratio_{name}" for name in DAMPING_PARTS]
    columns = ["damping_ratio_asked", *parts, "damping_ratio"]
    table = Table("mode", "asked", *DAMPING_PARTS, "total", title="Damping in % of critical")
    for column in table.columns[1:]:
        column.justify = "right"
    for row in rows:
        table.add_row(row["label"], *(_percent(row[name]) for name in columns))
    Console().print(table)


def _percent(ratio: float | None) -> str:
    return "" if ratio is None else f"{100 * ratio:.2f}"


def print_values(title: str, summary: Mapping[str, Any]) -> None:
    """The numbers and texts of a summary."""
    table = Table("quantity", "value", title=title)
    for key, value in summary.items():
        if isinstance(value, int | float | str):
            table.add_row(key, f"{value:.6g}" if isinstance(value, float) else str(value))
    Console().print(table)


def print_surrogate(surrogate: str | None) -> None:
    if surrogate:
        Console().print(f"Surrogate soil: {surrogate}", style="yellow")


def print_notes(system: System) -> None:
    """Remarks on the modes of a system: a surrogate soil, and its structural damping."""
    from offwind_pin.cases.summary import summarise_damping

    print_surrogate(system.foundation.surrogate)
    damping = summarise_damping(system)
    if damping["kind"] is None:
        text = "No structural damping: the turbine file has no structural_damping block."
        Console().print(text, style="yellow")


def print_outcomes(outcomes: Sequence[Outcome]) -> None:
    """One table per group, and the failures repeated at the end."""
    from offwind_pin.verification.page import outcome_cells

    console = Console()
    for group in dict.fromkeys(outcome.row.group for outcome in outcomes):
        table = Table("row", "value", "difference", "tolerance", "", title=f"\n{group}", box=None)
        table.title_justify = "left"
        for outcome in outcomes:
            if outcome.row.group == group:
                name, _, found, _, *cells = outcome_cells(outcome)
                table.add_row(name, found, *cells, style=_OUTCOME_STYLE[outcome.status])
        console.print(table)
    passed = sum(outcome.status == "pass" for outcome in outcomes)
    absent = [outcome for outcome in outcomes if outcome.status == "not run"]
    console.print(f"{passed} of {len(outcomes)} rows passed, {len(absent)} not run.")
    for outcome in outcomes:
        if outcome.status != "pass":
            text = f"{outcome.row.id}: {outcome.status}, {outcome.row.quantity}"
            text += "" if outcome.reason is None else f" ({outcome.reason})"
            console.print(text, soft_wrap=True, markup=False)


_OUTCOME_STYLE = {"pass": "", "fail": "bold red", "not run": "yellow"}


def print_soil(overview: SoilOverview) -> None:
    from offwind_pin.display.report.soil_report import soil_tables

    console = Console()
    for title, columns, rows in soil_tables(overview):
        table = Table(*columns, title=title, title_justify="left", show_header=any(columns))
        for column in table.columns[1:]:
            column.justify = "right"
        for row in rows:
            table.add_row(*row)
        console.print(table)
    if overview.state is not None:
        console.print(f"State: {overview.state.origin}", soft_wrap=True)
    for text in (*overview.foundation.cautions, *overview.remarks):
        console.print(text, style="yellow", markup=False)
    print_surrogate(overview.foundation.surrogate)


def print_overview(facts: Overview) -> None:
    console = Console()
    for title, rows in facts.tables():
        table = Table(title=title, show_header=False, title_justify="left")
        for name, value in rows:
            table.add_row(name, value)
        console.print(table)
    print_surrogate(facts.surrogate)
