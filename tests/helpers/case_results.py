"""Results of a case put together by hand, for what reads them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import xarray as xr

import offwind_pin as ow
from offwind_pin.analysis.drawing_data import (
    damping_dataset,
    soil_dataset,
    static_dataset,
    structure_dataset,
)
from offwind_pin.analysis.foundation.study.state import soil_springs
from offwind_pin.display.report.case_report import render_report
from offwind_pin.display.report.contents import CaseReport
from offwind_pin.results.tree import make_tree

Groups = dict[str, xr.Dataset]


@dataclass(frozen=True, eq=False)
class Results:
    """Main dataset, groups with plain dimensions, and summary."""

    root: xr.Dataset
    groups: Groups
    summary: dict[str, Any]

    def tree(self) -> xr.DataTree:
        return make_tree(self.root, self.groups)

    def report(self) -> CaseReport:
        return CaseReport(self.tree(), self.summary)

    def html(self) -> str:
        return render_report(self.tree(), self.summary)

    def without(self, name: str) -> Results:
        if name == "histories":
            return replace(self, root=EMPTY)
        return replace(self, groups={k: v for k, v in self.groups.items() if k != name})

    def with_groups(self, **groups: xr.Dataset) -> Results:
        return replace(self, groups=self.groups | groups)

    def with_attributes(self, name: str, /, **attributes: Any) -> Results:
        return self.with_groups(**{name: self.groups[name].assign_attrs(attributes)})


EMPTY = xr.Dataset(attrs={"title": "offwind-pin"})


def results(
    system: ow.System,
    summary: dict[str, Any] | None = None,
    *,
    root: xr.Dataset = EMPTY,
    statics: Mapping[str, tuple[ow.System, ow.StaticResult]] | None = None,
    status: str = "complete",
    name: str = "try",
    title: str = "A try",
    description: str = "",
    **groups: xr.Dataset | None,
) -> Results:
    """Results with all groups that need no solve, and those given."""
    case = {
        "name": name,
        "title": title,
        "description": description,
        "status": status,
        "foundation": system.foundation.name,
        "offwind_pin_version": "0",
        "pinocchio_version": "0",
    }
    soil = soil_springs(system)
    mudline = system.turbine.site.mudline
    found: dict[str, xr.Dataset | None] = {
        "case": xr.Dataset(attrs=case),
        "structure": structure_dataset(system),
        "structural_damping": damping_dataset(system),
        "soil": None if soil is None else soil_dataset(soil, mudline),
        **groups,
    }
    for number, (other, (built, state)) in enumerate((statics or {}).items()):
        data = static_dataset(built, state).assign_attrs(foundation=other)
        found[f"static/{number}"] = data
    return Results(root, {k: v for k, v in found.items() if v is not None}, summary or {})


def published(*rows: tuple[str, float, str, str, str]) -> xr.Dataset:
    """Rows of quantity, value, unit, origin, and key of the summary."""
    names = ("quantity", "value", "unit", "origin", "key")
    return xr.Dataset(
        {
            name: ("row", list(column))
            for name, column in zip(names, zip(*rows, strict=True), strict=True)
        }
    )
