"""Report of a case as a self-contained HTML page, from its results alone."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import xarray as xr
from markupsafe import Markup
from matplotlib.figure import Figure

from offwind_pin.base.mode_labels import DAMPING_PARTS
from offwind_pin.display.figures import results as plots
from offwind_pin.display.figures.earthquake import response_spectrum_plot
from offwind_pin.display.figures.operational_modes import identified_plot
from offwind_pin.display.figures.settling import settling_plot
from offwind_pin.display.figures.style import to_svg
from offwind_pin.display.report import headline, tables
from offwind_pin.display.report.contents import CaseReport
from offwind_pin.display.report.sea import SeaPicture, sea_pictures
from offwind_pin.display.report.templates import environment
from offwind_pin.signal.moment_spectrum import MomentSpectrum

SECTIONS = {
    "surrogates": "Surrogate data",
    "published": "Comparison with published values",
    "structure": "Structure",
    "modes": "Natural modes",
    "identified": "Operational modal analysis",
    "statics": "Static equilibrium",
    "wind": "Synthetic wind load",
    "rotor": "Operating rotor",
    "sea": "Sea",
    "earthquake": "Earthquake",
    "histories": "Time histories",
    "psd": "Spectrum of the mudline moment",
    "envelope": "Section loads over height",
    "soil": "Soil curves",
    "damping": "Structural damping",
    "solver": "Solver",
    "provenance": "Provenance",
}
"""Sections in order; those without data are omitted."""
_MORE_TITLES = {"settling": "Settling to the static state in time"}
"""Titles of figures that share a section with another one."""


def render_report(tree: xr.DataTree, summary: Mapping[str, Any]) -> str:
    """The HTML text of the report of a case.

    Parameters
    ----------
    tree : DataTree
        Results of the case.
    summary : mapping of str to object
        Content of ``summary.json``.
    """
    report = CaseReport(tree, summary)
    sea = sea_pictures(report)
    shown = _tables(report) | {"sea": sea}
    return (
        environment()
        .get_template("report.html.j2")
        .render(
            report=report,
            headline=headline.headline(report),
            cards=headline.cards(report),
            shown=shown,
            figures=_pictures(report, sea),
            titles=SECTIONS | _MORE_TITLES | {picture.name: picture.title for picture in sea},
            contents={name: title for name, title in SECTIONS.items() if shown.get(name)},
        )
    )


def _tables(report: CaseReport) -> dict[str, Any]:
    """Content of each section besides its figure; empty for a section without content."""
    damping = report.part("structural_damping")
    return {
        "surrogates": tables.surrogates(report),
        "published": tables.published_rows(report),
        "structure": tables.structure_facts(report),
        "modes": tables.mode_rows(report),
        "statics": report.statics,
        "settling": report.part("settling") is not None,
        "increases": headline.static_increases(report),
        "wind": tables.wind_facts(report.part("wind")),
        "rotor": tables.rotor_facts(report.part("rotor")),
        "rotor_damping": report.summary.get("aerodynamic_damping", []),
        "earthquake": tables.earthquake_facts(report.part("earthquake")),
        "identified": tables.identified_facts(report.part("identified_modes")),
        "identified_rows": report.summary.get("identified_modes", []),
        "histories": report.histories is not None,
        "statistics": tables.statistics(report),
        "psd": report.spectrum,
        "psd_rows": tables.psd_rows(report.spectrum),
        "envelope": report.analysed is not None,
        "soil": report.part("soil") is not None,
        "dampers": "damper" in report.structure.dims,
        "damping": True,
        "damping_of": {} if damping is None else damping.attrs,
        "damping_rows": tables.damping_rows(damping),
        "damping_cautions": report.summary.get("structural_damping", {}).get("cautions", []),
        "damping_parts": DAMPING_PARTS,
        "solver": tables.solver_account(report),
        "provenance": tables.provenance(report),
        "summary_json": json.dumps(report.summary, indent=2, default=str),
    }


def _pictures(report: CaseReport, sea: list[SeaPicture]) -> dict[str, Markup]:
    """SVG by section; matplotlib has escaped the names in it."""
    figures = _figures(report) | {picture.name: picture.figure for picture in sea}
    return {name: Markup(to_svg(figure, name)) for name, figure in figures.items()}  # noqa: S704


def _figures(report: CaseReport) -> dict[str, Figure]:
    """Figures by section."""
    mudline, water = float(report.structure.attrs["mudline_m"]), report.water_level
    figures = {"structure": plots.structure(report.structure)}
    if report.modes is not None:
        figures["modes"] = plots.mode_shapes(report.modes, mudline, water=water)
    if report.statics:
        figures["statics"] = plots.statics(report.statics, water=water)
    if report.histories is not None:
        figures["histories"] = plots.time_histories(report.histories)
    if report.spectrum is not None:
        figures["psd"] = _psd_figure(report.spectrum)
    if report.histories is not None and report.analysed is not None:
        figures["envelope"] = plots.section_load_envelope(report.histories)
    drawn = {
        "settling": ("settling", settling_plot),
        "identified": ("identified_modes", identified_plot),
        "earthquake": ("earthquake", response_spectrum_plot),
        "soil": ("soil", plots.p_y_curves),
    }
    for section, (name, draw) in drawn.items():
        data = report.part(name)
        if data is not None:
            figures[section] = draw(data)
    return figures


def _psd_figure(spectrum: MomentSpectrum) -> Figure:
    near = {spectrum.nearest_peak(frequency) for frequency in spectrum.marked.values()}
    return plots.moment_psd(
        spectrum.frequency,
        spectrum.density,
        spectrum.marked,
        bands=tuple((band.low, band.high) for band in spectrum.bands),
        peaks=tuple(sorted(peak for peak in near if peak is not None)),
    )
