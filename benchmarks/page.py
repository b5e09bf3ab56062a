"""One self-contained page of all benchmarks, from the JSON that they wrote.

What was not run is named as such, and so is what did not meet its target.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import figures
import measuring
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from matplotlib.figure import Figure

from offwind_pin.display.figures.style import to_svg
from offwind_pin.display.wording import number, quantity

Report = dict[str, Any]

NAMES = {
    "step_cost": "Cost of a step",
    "real_time": "Real time",
    "soil_cost": "What the soil costs",
    "wave_setup": "What long seas cost",
    "work_precision": "Work and precision",
    "peers": "Other codes",
    "pure_python": "The pure-Python core",
    "cases_per_hour": "Cases an hour",
    "memory": "Memory",
}
"""Benchmarks in the order of the page, and their titles."""
LIMITS = (0.02, 0.002)
"""Errors at which codes are compared."""


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Write the page; returns the benchmarks that are on it and those that were not run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=measuring.RESULTS)
    parser.add_argument("--out", type=Path, help="by default index.html beside the results")
    given = parser.parse_args(argv)
    reports = read(given.results)
    out = given.out or given.results / "index.html"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(render(reports), encoding="utf-8")
    missing = [name for name in NAMES if name not in reports]
    print(f"Wrote {out}; not run: {', '.join(missing) or 'nothing'}")
    return {"page": str(out), "shown": list(reports), "missing": missing}


def read(folder: Path) -> dict[str, Report]:
    """The reports that there are, by name."""
    paths = {name: folder / f"{name}.json" for name in NAMES}
    return {
        name: json.loads(path.read_text(encoding="utf-8"))
        for name, path in paths.items()
        if path.is_file()
    }


def render(reports: dict[str, Report]) -> str:
    """The page as HTML."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals.update(number=number, quantity=quantity, part_names=list(figures.PARTS))
    return environment.get_template("page.html.j2").render(
        names=NAMES,
        reports=reports,
        targets=[(name, row) for name in NAMES for row in reports.get(name, {}).get("targets", [])],
        machine=next(
            (r["machine"] for r in reports.values() if isinstance(r["machine"], dict)), {}
        ),
        busy=busy(reports),
        pictures=pictures(reports),
        codes=codes(reports),
        not_run=not_run(reports),
    )


def pictures(reports: dict[str, Report]) -> dict[str, Markup]:
    """SVG of each figure whose report is there."""
    drawn: dict[str, Figure] = {}
    simple: dict[str, Callable[[Report], Figure]] = {
        "step_cost": figures.step_cost,
        "pure_python": figures.pure_python,
        "cases_per_hour": figures.cases_per_hour,
        "memory": figures.memory,
    }
    for name, draw in simple.items():
        if name in reports:
            drawn[name] = draw(reports[name])
    if "work_precision" in reports:
        for part in ("whole", "first_seconds"):
            drawn[part] = figures.work_precision(reports["work_precision"][part])
    if "peers" in reports:
        drawn["peers"] = figures.peers(reports["peers"]["rows"])
    # The pictures are made by this page's own code; the marks in them are no input.
    return {name: Markup(to_svg(figure, name)) for name, figure in drawn.items()}  # noqa: S704


def codes(reports: dict[str, Report]) -> list[Report]:
    """Rows of the table of codes: the largest step within each error, and its cost."""
    rows: list[Report] = []
    for key, row in reports.get("peers", {}).get("rows", {}).items():
        name = figures.PEERS.get(key, (key,))[0]
        checked = row["status"] == "checked"
        within = {limit: row.get("within", {}).get(str(limit)) for limit in LIMITS}
        rows.append({"name": name, "status": "" if checked else row["status"], "within": within})
    own: dict[float, Any] = next(
        (row["within"] for row in rows if row["name"] == "offwind-pin"), {}
    )
    for row in rows:
        row["ratio"] = ratios(row["within"], own)
    return rows


def ratios(theirs: dict[float, Any], ours: dict[float, Any]) -> dict[float, float | None]:
    """Processor time over ours at each error, which other work disturbs less than wall time."""
    result: dict[float, float | None] = {}
    for limit in LIMITS:
        both = theirs.get(limit) and ours.get(limit)
        result[limit] = theirs[limit]["cpu_s"] / ours[limit]["cpu_s"] if both else None
    return result


def busy(reports: dict[str, Report]) -> dict[str, float]:
    """Load average at the end of each benchmark that wrote it, by title."""
    return {
        NAMES[name]: report["machine"]["load_average"]
        for name, report in reports.items()
        if isinstance(report["machine"], dict)
    }


def not_run(reports: dict[str, Report]) -> list[str]:
    """What is missing from the page, in words."""
    missing = [NAMES[name] for name in NAMES if name not in reports]
    for key, row in reports.get("peers", {}).get("rows", {}).items():
        if row["status"].startswith("not run"):
            missing.append(f"{figures.PEERS.get(key, (key,))[0]} ({row['status']})")
    if "peers" in reports:
        measured = reports["peers"]["rows"]
        missing += [name for key, (name, *_) in figures.PEERS.items() if key not in measured]
    if "real_time" in reports and not reports["real_time"]["command_s"]:
        missing.append("offwind run as a whole")
    return missing


if __name__ == "__main__":
    main()
