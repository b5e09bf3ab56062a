"""Soil of a turbine as files: page, JSON, curves as CSV, and 6x6 files for other programs."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from pathlib import Path

from offwind_pin.analysis.foundation.study.study import SoilOverview
from offwind_pin.base.whole_files import write_json, write_text
from offwind_pin.display.report.soil_report import STIFFNESS_NAMES, render_soil_page
from offwind_pin.formats.openfast.subdyn_soildyn import write_soildyn, write_subdyn_ssi

_LATERAL = ("depth_m", "y_m", "p_n_per_m")
_OTHER = ("spring", "depth_m", "deflection", "deflection_unit", "resistance", "resistance_unit")


def write_soil(soil: SoilOverview, directory: Path) -> list[Path]:
    """Write page, JSON, curves and 6x6 files, each file atomically.

    ``p_y_curves.csv`` can be used for ``curve: {kind: table}`` of a turbine: the resistance is
    linear between its points, and constant beyond the last one.

    Parameters
    ----------
    soil : SoilOverview
    directory : Path
        Created if necessary.

    Returns
    -------
    list of Path
        Paths of the files, the page first.
    """
    page, data = directory / "soil.html", directory / "soil.json"
    write_text(page, render_soil_page(soil))
    write_json(data, soil.as_dict())
    lateral = directory / "p_y_curves.csv"
    write_text(lateral, _csv(_LATERAL, soil.lateral_curves()))
    written = [page, data, lateral]
    if soil.others:
        others = directory / "other_springs.csv"
        write_text(others, _csv(_OTHER, soil.other_curves()))
        written.append(others)
    location = (0.0, 0.0, soil.turbine.site.mudline)
    for name, stiffness in soil.stiffness.items():
        note = f"{soil.turbine.name}: {STIFFNESS_NAMES[name].lower()}, of the distributed springs"
        subdyn = directory / f"subdyn_ssi_{name}.txt"
        write_subdyn_ssi(subdyn, stiffness, note=note)
        soildyn = directory / f"soildyn_{name}.dat"
        write_soildyn(soildyn, stiffness, location, note=note)
        written += [subdyn, soildyn]
    return written


def _csv(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Numbers with all digits, so that reading recovers them exactly."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue()
