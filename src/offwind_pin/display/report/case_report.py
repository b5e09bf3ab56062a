"""A case as one self-contained HTML page: what came out, what stands in for what, and the proof.

>>> write_report(Path("report.html"), CaseReport("lc2.1", "Clamped, dry", "", system, {}, modes=m))
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from offwind_pin.analysis.foundation.study.state import soil_displacement_reached, soil_springs
from offwind_pin.base.definition import Array
from offwind_pin.base.whole_files import write_text
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
    "surrogates": "What is a surrogate here, and why",
    "published": "Beside the published numbers",
    "structure": "The structure",
    "modes": "Natural modes",
    "identified": "Modes out of accelerations",
    "statics": "Static equilibrium",
    "wind": "The synthetic wind",
    "rotor": "The running rotor",
    "sea": "The sea",
    "earthquake": "The earthquake",
    "histories": "Time histories",
    "psd": "Spectrum of the mudline moment",
    "envelope": "Section loads over height",
    "soil": "Soil curves",
    "damping": "Structural damping",
    "solver": "What the solver did",
    "provenance": "Provenance",
}
"""Sections in their order; those without data are left out."""
_MORE_TITLES = {"settling": "The static state reached in time"}
"""Of figures that stand in a section beside its own."""


def write_report(path: Path, report: CaseReport) -> None:
    """Write a case as one HTML file without any outside resource, whole or not at all."""
    write_text(path, render_report(report))


def render_report(report: CaseReport) -> str:
    """The HTML text of a report."""
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
    """What each section shows besides its figure; empty where the section has nothing to say."""
    return {
        "surrogates": tables.surrogates(report),
        "published": tables.published_rows(report),
        "structure": tables.structure_facts(report.system),
        "modes": tables.mode_rows(report),
        "statics": tables.ordered_statics(report),
        "settling": report.settling,
        "increases": headline.static_increases(report),
        "wind": tables.wind_facts(report.wind),
        "rotor": list(report.rotor),
        "rotor_damping": report.summary.get("aerodynamic_damping", []),
        "earthquake": report.earthquake,
        "identified": report.identified,
        "histories": report.histories is not None,
        "statistics": tables.statistics(report),
        "psd": report.psd,
        "psd_rows": tables.psd_rows(report.psd),
        "envelope": report.analysed is not None,
        "soil": soil_springs(report.system) is not None,
        "damping": True,
        "damping_rows": tables.damping_rows(report.system),
        "solver": tables.solver_account(report),
        "provenance": tables.provenance(report),
        "summary_json": json.dumps(report.summary, indent=2, default=str),
    }


def _pictures(report: CaseReport, sea: list[SeaPicture]) -> dict[str, Markup]:
    """SVG by the section that holds it; matplotlib has escaped the names in it."""
    figures = _figures(report) | {picture.name: picture.figure for picture in sea}
    return {name: Markup(to_svg(figure, name)) for name, figure in figures.items()}  # noqa: S704


def _figures(report: CaseReport) -> dict[str, Figure]:
    """Figures by the section that holds them."""
    system, mudline = report.system, report.system.turbine.site.mudline
    water = None if system.sea is None else system.sea.water_level
    figures = {"structure": plots.structure(system)}
    if report.modes is not None:
        figures["modes"] = plots.mode_shapes(report.modes, mudline, water=water)
    if report.statics:
        figures["statics"] = plots.statics(tables.ordered_statics(report), water=water)
    if report.settling is not None:
        figures["settling"] = settling_plot(report.settling)
    if report.identified is not None:
        figures["identified"] = identified_plot(report.identified)
    if report.earthquake is not None:
        figures["earthquake"] = response_spectrum_plot(report.earthquake)
    if report.histories is not None:
        figures["histories"] = plots.time_histories(report.histories)
    if report.psd is not None:
        figures["psd"] = _psd_figure(report.psd)
    if report.histories is not None and report.analysed is not None:
        figures["envelope"] = plots.section_load_envelope(report.histories)
    soil = soil_springs(system)
    if soil is not None:
        reached = _soil_reached(report)
        figures["soil"] = plots.p_y_curves(soil, mudline, reached=reached)
    return figures


def _psd_figure(psd: MomentSpectrum) -> Figure:
    near = {psd.nearest_peak(frequency) for frequency in psd.marked.values()}
    return plots.moment_psd(
        psd.frequency,
        psd.density,
        psd.marked,
        bands=tuple((band.low, band.high) for band in psd.bands),
        peaks=tuple(sorted(peak for peak in near if peak is not None)),
    )


def _soil_reached(report: CaseReport) -> Array | None:
    """Largest displacement of the soil's nodes: in the analysed time, or in the static state."""
    soil = soil_springs(report.system)
    if soil is None:
        return None
    if report.analysed is not None:
        return soil_displacement_reached(report.analysed, soil)
    state = report.statics.get(report.system.foundation.name)
    if state is None:
        return None
    return np.interp(soil.height, state.height, np.hypot(*state.displacement[:, :2].T))
