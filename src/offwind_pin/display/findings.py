"""What a report says: its headline, its key numbers, and the rows of its tables."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import metadata
from typing import TYPE_CHECKING, Any

import numpy as np

from offwind_pin.analysis.modal import mode_name
from offwind_pin.display.plots import FOUNDATION_NAMES
from offwind_pin.display.wording import (
    DASH,
    as_given,
    count,
    difference,
    fixed,
    listing,
    number,
    orders_of_magnitude,
    quantity,
    relative_difference,
    sentence,
    significant_digits,
)
from offwind_pin.dynamics.sea import IrregularWaves
from offwind_pin.dynamics.system import System
from offwind_pin.loads.synthetic_wind import AIR_DENSITY
from offwind_pin.structure.urdf import definition_hash

if TYPE_CHECKING:
    import xarray as xr

    from offwind_pin.analysis.static import StaticResult
    from offwind_pin.display.report import CaseReport, MomentSpectrum, Published, WindDescription

CLOSE = 0.02
"""Relative difference from a published value that the headline calls close."""

_BAR = 0.10
"""Relative difference at which the bars in the table of published values end."""

_DESCRIPTIVE = {"title", "surrogates", "frame", "status", "mudline_m"}
_PROVENANCE_NAMES = {
    "turbine": "turbine",
    "definition_sha256": "hash of the definition (SHA-256)",
    "foundation": "foundation",
    "sea": "sea",
    "elements": "multibody beam elements",
    "wave_seed": "seed of the waves",
    "tower_top_load_origin": "tower-top load",
    "integrator": "time integration",
    "dt_s": "time step, s",
    "ramp_s": "ramp, s",
    "spectral_radius": "spectral radius at infinite frequency",
    "residual_tolerance": "tolerance of the residual over the load scale",
    "offwind_pin_version": "offwind-pin",
    "pinocchio_version": "Pinocchio",
}


@dataclass(frozen=True)
class Card:
    """One key number with its unit and what it is."""

    value: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Surrogate:
    """What stands in, why, and how to replace it."""

    what: str
    why: str
    remedy: str


@dataclass(frozen=True)
class PublishedRow:
    """A published value beside ours; bar from -1 to 1, or None without ours."""

    published: Published
    ours: str
    difference: str
    bar: float | None


@dataclass(frozen=True)
class ModeRow:
    """A mode as the table shows it; published joins the values printed for it, in Hz."""

    label: str
    name: str
    frequency_hz: float
    damping_ratio: float
    peak_height_ratio: float
    peak_height: float
    published: str


def foundation_name(name: str) -> str:
    return FOUNDATION_NAMES.get(name, name)


def headline(report: CaseReport) -> list[str]:
    """The outcome in a few sentences, the most telling first."""
    said = [
        _status_sentence(report),
        *_history_sentences(report),
        *_spectrum_sentences(report),
        *static_increases(report),
        *_mode_sentences(report),
        _published_sentence(report),
    ]
    return [sentence(text) for text in said if text]


def cards(report: CaseReport) -> list[Card]:
    """Up to four key numbers, those of the richest analysis of the case."""
    chosen = [
        *_history_cards(report),
        *_spectrum_cards(report.psd),
        *_static_cards(report),
        *_mode_cards(report),
    ]
    return chosen[:4]


def _status_sentence(report: CaseReport) -> str:
    if report.histories is None:
        return ""
    status = report.histories.attrs.get("status", "complete")
    if status == "complete":
        return ""
    end = float(report.histories.time.values[-1])
    return f"this run is {status}: it ends at {number(end)} s, and what follows is what there is"


def _spectrum_sentences(report: CaseReport) -> list[str]:
    psd = report.psd
    if psd is None:
        return []
    said = []
    peaks = [psd.peak_in(band)[1] for band in psd.bands[:2]]
    found = [f"{peak:.3f} Hz" for peak in peaks if peak is not None]
    if found:
        said.append(f"in the bands of the bending modes its spectrum peaks at {listing(found)}")
    if psd.ratio is not None and any(
        row.quantity.startswith("PSD sum") for row in report.published
    ):
        first, second = psd.bands[:2]
        said.append(
            f"between {first.low:g} and {first.high:g} Hz it has {number(psd.ratio, 3)} times the "
            f"variance that it has between {second.low:g} and {second.high:g} Hz: "
            f"{orders_of_magnitude(psd.ratio)}"
        )
    return said


def _history_sentences(report: CaseReport) -> list[str]:
    data = report.analysed
    if data is None:
        return []
    top = data.tower_top_displacement.sel(direction="x")
    moment = data.mudline_moment.sel(direction="y") / 1e6
    return [
        f"after the ramp the tower top moves between {number(float(top.min()), 3)} and "
        f"{number(float(top.max()), 3)} m along x, and the fore-aft moment at the mudline between "
        f"{number(float(moment.min()), 3)} and {number(float(moment.max()), 3)} MN m"
    ]


def ordered_statics(report: CaseReport) -> dict[str, StaticResult]:
    """The static states, the clamped one first: the others are compared with it."""
    return dict(sorted(report.statics.items(), key=lambda item: item[0] != "clamped"))


def _held(foundation: str) -> str:
    """How a foundation holds the structure, as an adverb."""
    return ("" if foundation == "clamped" else "on ") + foundation_name(foundation)


def static_increases(report: CaseReport) -> list[str]:
    """How much further the tower top leans on each foundation than on the first in order."""
    if len(report.statics) < 2:
        return []
    (name, first), *others = ordered_statics(report).items()
    before = float(first.tower_top_displacement[0])
    if before == 0:
        return []
    said = []
    for other, result in others:
        now = float(result.tower_top_displacement[0])
        change = 100 * (abs(now) / abs(before) - 1)
        word = "further" if change >= 0 else "less far"
        said.append(
            f"the tower top leans {abs(change):.1f} % {word} {_held(other)} than {_held(name)}: "
            f"{fixed(now, 3)} m along x instead of {fixed(before, 3)} m"
        )
    return said


def _mode_sentences(report: CaseReport) -> list[str]:
    if report.modes is None:
        return []
    modes = report.modes
    said = [
        f"{mode_name(label)} {modes.frequency_hz[modes.index(label)]:.3f} Hz"
        for label in ("FA1", "SS1", "FA2")
        if label in modes.label
    ]
    where = foundation_name(report.system.foundation.name)
    water = "in water" if report.system.sea is not None else "dry"
    return [f"natural frequencies, {where}, {water}: {listing(said)}"] if said else []


def _published_sentence(report: CaseReport) -> str:
    compared = [
        (abs(relative), row, row.ours)
        for row in report.published
        if row.ours is not None
        and (relative := relative_difference(row.ours, row.value)) is not None
    ]
    if not compared:
        return ""
    close = sum(size <= CLOSE for size, *_ in compared)
    _, farthest, ours = max(compared, key=lambda entry: entry[0])
    how = difference(ours, farthest.value, farthest.unit)
    return (
        f"published values met within {100 * CLOSE:g} %: {close} of {len(compared)}; the farthest "
        f"is {farthest.quantity}: {how}"
    )


def _history_cards(report: CaseReport) -> list[Card]:
    data = report.analysed
    if data is None:
        return []
    moment = float(abs(_moment(data, "y")).max())
    top = float(abs(data.tower_top_displacement.sel(direction="x")).max())
    return [
        Card(number(moment, 3), "MN m", "largest fore-aft moment at the mudline"),
        Card(number(top, 3), "m", "largest tower-top displacement along x"),
    ]


def _spectrum_cards(psd: MomentSpectrum | None) -> list[Card]:
    if psd is None:
        return []
    found = []
    for band in psd.bands[:2]:
        mode, peak = psd.peak_in(band)
        if peak is not None:
            where = f"by the {mode_name(mode)} mode" if mode else f"in {band.name}"
            found.append(Card(f"{peak:.3f}", "Hz", f"peak of the mudline moment {where}"))
    return found


def _static_cards(report: CaseReport) -> list[Card]:
    if report.histories is not None or (report.modes is not None and len(report.statics) < 2):
        return []
    states = ordered_statics(report)
    found = [
        Card(
            fixed(float(result.tower_top_displacement[0]), 3),
            "m",
            f"tower top along x, {foundation_name(name)}",
        )
        for name, result in states.items()
    ]
    if len(states) == 2:
        first, second = (abs(state.tower_top_displacement[0]) for state in states.values())
        if first > 0:
            change = fixed(100 * (second / first - 1), 1, sign=True)
            where = " over ".join(foundation_name(name) for name in reversed(states))
            found.append(Card(change, "%", f"deflection, {where}"))
    return found


def _mode_cards(report: CaseReport) -> list[Card]:
    modes = report.modes
    if modes is None:
        return []
    return [
        Card(f"{modes.frequency_hz[modes.index(label)]:.3f}", "Hz", f"{mode_name(label)} mode")
        for label in ("FA1", "FA2", "SS1", "T1")
        if label in modes.label
    ]


def surrogates(report: CaseReport) -> list[Surrogate]:
    """Everything that stands in for numbers that are not to hand."""
    found = []
    soil = report.system.foundation.surrogate
    if soil:
        remedy = (
            "put the real p-y curves into a CSV table (depth_m, y_m, p_n_per_m) and name it in "
        )
        found.append(Surrogate("The soil", soil, remedy + "the turbine file."))
    attributes = {} if report.histories is None else report.histories.attrs
    loads = str(attributes.get("surrogates", "none")).split(" | ")
    if report.histories is None and report.wind is not None:
        loads.append(report.wind.generator.surrogate)
    found += [
        Surrogate(
            "The load at the tower top",
            sentence(text),
            "give the real history as seven columns: t, Fx, Fy, Fz, Mx, My, Mz in s, N and N m.",
        )
        for text in loads
        if text not in ("none", "", soil)
    ]
    return found


def statistics(report: CaseReport) -> list[tuple[str, str, list[float]]]:
    """Name, unit, and mean, standard deviation, smallest and largest value after the ramp."""
    data = report.analysed
    if data is None:
        return []
    rows = [
        ("tower-top displacement along x", "m", data.tower_top_displacement.sel(direction="x")),
        ("tower-top displacement along y", "m", data.tower_top_displacement.sel(direction="y")),
        ("fore-aft moment at the mudline (y)", "MN m", _moment(data, "y")),
        ("side-side moment at the mudline (x)", "MN m", _moment(data, "x")),
        ("shear at the mudline along x", "MN", data.mudline_force.sel(direction="x") / 1e6),
        ("applied tower-top force along x", "MN", data.tower_top_load.sel(component="Fx") / 1e6),
        ("wave elevation", "m", data.wave_elevation),
    ]
    return [
        (name, unit, [float(v) for v in (x.mean(), x.std(), x.min(), x.max())])
        for name, unit, x in rows
    ]


def _moment(data: xr.Dataset, direction: str) -> xr.DataArray:
    """Moment at the mudline in MN m."""
    return data.mudline_moment.sel(direction=direction) / 1e6


def published_rows(report: CaseReport) -> list[PublishedRow]:
    rows = []
    for row in report.published:
        if row.ours is None:
            rows.append(PublishedRow(row, DASH, "not computed", None))
            continue
        relative = relative_difference(row.ours, row.value)
        bar = 0.0 if relative is None else float(np.clip(relative / _BAR, -1, 1))
        ours = number(row.ours, max(4, significant_digits(row.value)))
        rows.append(PublishedRow(row, ours, difference(row.ours, row.value, row.unit), bar))
    return rows


def structure_facts(system: System) -> list[tuple[str, str]]:
    """Name and value with its unit, the numbers an engineer asks for first."""
    turbine, chain = system.turbine, system.chain
    mudline = turbine.site.mudline
    mass = sum(body.mass for body in chain.body)
    above = "mudline" if chain.base >= mudline else "pile toe"
    facts = [
        ("foundation", foundation_name(system.foundation.name)),
        ("sea", describe_sea(system)),
        ("height, mudline to yaw bearing", quantity(chain.top - mudline, "m", 5)),
        ("water depth", quantity(turbine.site.water_depth, "m", 3)),
    ]
    if chain.base < mudline:
        facts.append(("embedded length", quantity(mudline - chain.base, "m", 3)))
    facts += [
        (f"tower and monopile, from the {above}", quantity(mass / 1e3, "t")),
        ("rotor-nacelle assembly", quantity(chain.rna.mass / 1e3, "t")),
        ("multibody beam elements", str(chain.elements)),
        ("degrees of freedom", str(system.nv)),
    ]
    return facts


def describe_sea(system: System) -> str:
    """The sea in words."""
    sea = system.sea
    if sea is None:
        return "none (dry)"
    if isinstance(sea, IrregularWaves):
        return (
            f"Pierson-Moskowitz waves, Hs {as_given(sea.significant_height)} m, "
            f"Tp {as_given(sea.peak_period)} s"
        )
    return "still water"


def mode_rows(report: CaseReport) -> list[ModeRow]:
    modes = report.modes
    if modes is None:
        return []
    mudline, top = report.system.turbine.site.mudline, report.system.chain.top
    rows = []
    for i, label in enumerate(modes.label):
        ratio = float(modes.shape_peak_height_ratio[i])
        printed = [f"{row.value:g}" for row in report.published if _is_frequency_of(row, label)]
        rows.append(
            ModeRow(
                label,
                mode_name(label),
                float(modes.frequency_hz[i]),
                float(modes.damping_ratio[i]),
                ratio,
                mudline + ratio * (top - mudline),
                " / ".join(dict.fromkeys(printed)),
            )
        )
    return rows


def _is_frequency_of(row: Published, label: str) -> bool:
    """A published frequency belongs to the mode it names, by label or in the same plain words."""
    if row.mode is not None:
        return row.mode == label
    return row.unit == "Hz" and row.quantity in (label, mode_name(label))


def wind_facts(wind: WindDescription | None) -> dict[str, float]:
    """What the derivation of the mean load needs besides the rotor's own numbers."""
    if wind is None:
        return {}
    passing = 2 * np.pi * wind.generator.blade_passing_frequency
    return {
        "blades": round(passing / wind.rotor.rotor_speed),
        "rotor_speed_rpm": wind.rotor.rotor_speed * 30 / np.pi,
        "air_density": AIR_DENSITY,
    }


def psd_rows(psd: MomentSpectrum | None) -> list[tuple[str, float, float | None]]:
    """Marked name, its frequency, and the nearest peak found, by rising frequency."""
    if psd is None:
        return []
    marked = sorted(psd.marked.items(), key=lambda item: item[1])
    return [(name, frequency, psd.nearest_peak(frequency)) for name, frequency in marked]


def damping_rows(system: System) -> list[tuple[str, float, float]]:
    """Label, damping ratio asked for and achieved on the calibration's own system."""
    calibration = system.turbine.structural_damping
    if calibration is None:
        return []
    return [
        (label, calibration.ratios[label], achieved)
        for label, achieved in system.damping_ratios.items()
        if label in calibration.ratios
    ]


def solver_account(report: CaseReport) -> list[tuple[str, str]]:
    """What the solver did, name and value."""
    rows: list[tuple[str, str]] = []
    data, summary = report.histories, report.summary
    if data is not None:
        time, taken = data.time.values, data.solver_iterations.values[1:]
        rows += [
            ("status", str(data.attrs.get("status", "unknown"))),
            ("simulated time", quantity(float(time[-1]), "s")),
            ("time steps", count(round(float(time[-1]) / float(data.attrs["dt_s"])))),
        ]
        if len(taken):
            rows.append(
                (
                    "Newton iterations a step",
                    f"{taken.mean():.2f} on average, {taken.max()} at most",
                )
            )
            worst = float(data.solver_residual.max())
            tolerance = float(data.attrs["residual_tolerance"])
            rows.append(
                (
                    "largest residual over the load scale",
                    f"{number(worst, 2)} (allowed: {number(tolerance, 2)})",
                )
            )
    rows += [
        (
            f"static state, {foundation_name(name)}",
            f"{state.iterations} Newton iterations, residual {number(state.residual, 2)}",
        )
        for name, state in ordered_statics(report).items()
    ]
    if "wall_s" in summary:
        rows.append(("wall time", quantity(float(summary["wall_s"]), "s", 3)))
    if data is not None and "realtime_factor" in summary:
        factor = number(float(summary["realtime_factor"]), 3)
        rows.append(("real-time factor", f"{factor} (simulated over wall time)"))
    return rows


def provenance(report: CaseReport) -> list[tuple[str, str]]:
    """Versions, seeds, settings and the hash of the definition."""
    system = report.system
    known: dict[str, Any] = {
        "turbine": system.turbine.name,
        "definition_sha256": definition_hash(system.turbine),
        "foundation": system.foundation.name,
        "elements": system.chain.elements,
        "offwind_pin_version": metadata.version("offwind-pin"),
        "pinocchio_version": metadata.version("pin"),
    }
    if report.histories is not None:
        known |= report.histories.attrs
        if known.get("wave_seed") == -1:
            del known["wave_seed"]
    known["sea"] = describe_sea(system)
    if report.wind is not None:
        known["seed of the synthetic wind"] = report.wind.generator.seed
    ordered = [key for key in _PROVENANCE_NAMES if key in known]
    others = [key for key in known if key not in _PROVENANCE_NAMES and key not in _DESCRIPTIVE]
    return [(_PROVENANCE_NAMES.get(key, key), str(known[key])) for key in ordered + others]
