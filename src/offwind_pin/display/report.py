"""A case as one self-contained HTML page: what came out, what stands in for what, and the proof.

>>> write_report(Path("report.html"), CaseReport("lc2.1", "Clamped, dry", "", system, {}, modes=m))
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from markupsafe import Markup
from matplotlib.figure import Figure

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.display import headline, plots, tables
from offwind_pin.display.earthquake_plots import EarthquakeDescription, response_spectrum_plot
from offwind_pin.display.identified_plots import IdentifiedModes, identified_plot
from offwind_pin.display.page import environment
from offwind_pin.display.sea_section import SeaPicture, sea_pictures
from offwind_pin.display.settling_plot import Settling, settling_plot
from offwind_pin.display.style import to_svg
from offwind_pin.display.wording import DASH, is_mode
from offwind_pin.dynamics.system import System
from offwind_pin.loads.synthetic_wind import RotorOperation, SyntheticWind
from offwind_pin.results.files import write_text
from offwind_pin.turbines.base import Array

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


@dataclass(frozen=True)
class Published:
    """A published number and ours.

    Attributes
    ----------
    quantity : in plain words
    value, unit : published; the unit is empty for a pure number
    source : where it is printed
    ours : the same quantity from this case, or None where it was not computed
    mode : label of the mode whose frequency it is, for the table of modes; a quantity in Hz named
        like a mode ("FA1" or "first fore-aft") is put there without it
    """

    quantity: str
    value: float
    unit: str
    source: str
    ours: float | None = None
    mode: str | None = None


@dataclass(frozen=True)
class WindDescription:
    """The generator of a synthetic wind load, and the rotor's steady state that it starts from."""

    generator: SyntheticWind
    rotor: RotorOperation


@dataclass(frozen=True)
class Band:
    """Area under a PSD between two frequencies: low, high in Hz, area in (N m)^2."""

    low: float
    high: float
    area: float

    @property
    def name(self) -> str:
        return f"{self.low:g}{DASH}{self.high:g} Hz"


@dataclass(frozen=True)
class MomentSpectrum:
    """PSD of the fore-aft moment at the mudline after the ramp.

    Attributes
    ----------
    frequency : (f,) in Hz
    density : (f,) one-sided, in (N m)^2/Hz
    peaks : frequencies of the peaks found, in Hz
    bands : areas of the bands of the first and the second fore-aft mode
    marked : frequencies in Hz by name: "wave peak", "3P", "FA1", ...
    segment : length of Welch's windows in s
    """

    frequency: Array
    density: Array
    peaks: tuple[float, ...]
    bands: tuple[Band, ...]
    marked: Mapping[str, float]
    segment: float

    @property
    def ratio(self) -> float | None:
        """Area of the first band over that of the second, or None without two bands."""
        if len(self.bands) < 2 or self.bands[1].area == 0:
            return None
        return self.bands[0].area / self.bands[1].area

    def strongest_peak(self, low: float, high: float) -> float | None:
        """Of the peaks found between two frequencies in Hz, the one with the largest density."""
        inside = [peak for peak in self.peaks if low <= peak <= high]
        return max(
            inside, key=lambda f: float(np.interp(f, self.frequency, self.density)), default=None
        )

    def nearest_peak(self, frequency: float, nearness: float = 0.02) -> float | None:
        """The peak found within a share of a frequency in Hz that is nearest to it, or None."""
        near = min(self.peaks, key=lambda peak: abs(peak - frequency), default=None)
        if near is None or abs(near - frequency) > nearness * frequency:
            return None
        return near

    def peak_in(self, band: Band) -> tuple[str | None, float | None]:
        """Label of a marked mode in a band and the peak next to it; else None and the strongest."""
        for name, frequency in self.marked.items():
            peak = self.nearest_peak(frequency)
            if is_mode(name) and peak is not None and band.low <= peak <= band.high:
                return name, peak
        return None, self.strongest_peak(band.low, band.high)


@dataclass(frozen=True)
class CaseReport:
    """Everything a report shows; what is None or empty leaves its section out.

    Attributes
    ----------
    name, title, description : of the case
    system : what was solved
    summary : what goes into ``summary.json``; ``wall_s``, ``simulated_s``, ``realtime_factor`` and
        ``status`` are shown among the solver's account
    modes : of the system
    statics : by name of the foundation; others are compared with the clamped one, or the first
    histories : from :func:`offwind_pin.simulate`
    published : numbers to compare with
    wind : how the tower-top load was made, where it is synthetic
    psd : of the fore-aft moment at the mudline
    rotor : name and value of what is to be told of a rotor that runs, or nothing
    earthquake : that moves the ground, or None
    identified : modes out of accelerations, or None
    settling : the static state reached in time, or None
    """

    name: str
    title: str
    description: str
    system: System
    summary: dict[str, Any]
    modes: ModalResult | None = None
    statics: dict[str, StaticResult] = field(default_factory=dict)
    histories: xr.Dataset | None = None
    published: tuple[Published, ...] = ()
    wind: WindDescription | None = None
    psd: MomentSpectrum | None = None
    rotor: tuple[tuple[str, str], ...] = ()
    earthquake: EarthquakeDescription | None = None
    identified: IdentifiedModes | None = None
    settling: Settling | None = None

    @property
    def analysed(self) -> xr.Dataset | None:
        """The histories after the ramp, or None where fewer than two samples are left."""
        if self.histories is None:
            return None
        rest = plots.analysed(self.histories)
        return rest if rest.sizes["time"] > 1 else None


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
        "soil": plots.soil_springs(report.system) is not None,
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
    soil = plots.soil_springs(system)
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
    soil = plots.soil_springs(report.system)
    if soil is None:
        return None
    if report.analysed is not None:
        return plots.soil_displacement_reached(report.analysed, soil)
    state = report.statics.get(report.system.foundation.name)
    if state is None:
        return None
    return np.interp(soil.height, state.height, np.hypot(*state.displacement[:, :2].T))
