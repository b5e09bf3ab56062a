"""The rows of a report's tables."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import metadata
from typing import TYPE_CHECKING, Any

import numpy as np

from offwind_pin.analysis.wave_checks import wave_facts
from offwind_pin.base.mode_labels import mode_name
from offwind_pin.display.wording import (
    DASH,
    base_name,
    count,
    difference,
    foundation_name,
    number,
    quantity,
    relative_difference,
    sentence,
    significant_digits,
)
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.current import mean_velocity
from offwind_pin.loads.sea.sea import StillWater
from offwind_pin.loads.wind.synthetic_thrust import AIR_DENSITY
from offwind_pin.structure.urdf import definition_hash

if TYPE_CHECKING:
    import xarray as xr

    from offwind_pin.analysis.static import StaticResult
    from offwind_pin.display.report.contents import CaseReport, Published, WindDescription
    from offwind_pin.signal.moment_spectrum import MomentSpectrum

_ROUNDING = 1e-12
"""Of the largest number of a unit, below which another is none."""
_BAR = 0.10
"""Relative difference at which the bars in the table of published values end."""

_DESCRIPTIVE = {
    "title",
    "surrogates",
    "frame",
    "status",
    "mudline_m",
    "water_level_m",
    "waves",
    "rotor_nacelle",
}
_PROVENANCE_NAMES = {
    "turbine": "turbine",
    "definition_sha256": "hash of the definition (SHA-256)",
    "foundation": "foundation",
    "sea": "sea",
    "elements": "multibody beam elements",
    "wave_seed": "seed of the waves",
    "tower_top_load_origin": "tower-top load",
    "ground_motion_origin": "ground motion",
    "ground_motion_baseline": "baseline of the ground motion",
    "ground_motion_cautions": "cautions about the ground motion",
    "integrator": "time integration",
    "engine": "engine of the equations of motion",
    "dt_s": "time step, s",
    "ramp_s": "ramp, s",
    "spectral_radius": "spectral radius at infinite frequency",
    "residual_tolerance": "tolerance of the residual over the load scale",
    "offwind_pin_version": "offwind-pin",
    "pinocchio_version": "Pinocchio",
}

_SLIDES = {"fore_aft": "fore-aft", "side_side": "side-side", "both": "both ways"}


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


def ordered_statics(report: CaseReport) -> dict[str, StaticResult]:
    """The static states, the clamped one first: the others are compared with it."""
    return dict(sorted(report.statics.items(), key=lambda item: item[0] != "clamped"))


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
        ("fore-aft moment at the mudline (y)", "MN m", mudline_moment(data, "y")),
        ("side-side moment at the mudline (x)", "MN m", mudline_moment(data, "x")),
        ("shear at the mudline along x", "MN", data.mudline_force.sel(direction="x") / 1e6),
        ("wave elevation", "m", data.wave_elevation),
    ]
    applied = data.tower_top_load.sel(component="Fx") / 1e6
    if bool((applied != 0).any()):  # a running rotor's thrust is not among what is applied
        rows.append(("applied tower-top force along x", "MN", applied))
    if "tuned_mass_displacement" in data:
        for name in data["damper"].to_numpy():
            for axis in data["across"].to_numpy():
                slip = data.tuned_mass_displacement.sel(damper=name, across=axis)
                rows.append((f"tuned mass {name} in its carrier along {axis}", "m", slip))
    found = [
        (name, unit, [float(v) for v in (x.mean(), x.std(), x.min(), x.max())])
        for name, unit, x in rows
    ]
    largest = {unit: max(map(abs, values)) for _, unit, values in sorted(found, key=_size)}
    return [
        (name, unit, [v if abs(v) > _ROUNDING * largest[unit] else 0.0 for v in values])
        for name, unit, values in found
    ]


def _size(row: tuple[str, str, list[float]]) -> float:
    """Largest number of a row of statistics."""
    return max(map(abs, row[2]))


def mudline_moment(data: xr.Dataset, direction: str) -> xr.DataArray:
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
    above = "mudline" if chain.base >= mudline else base_name(system.foundation.name)
    facts = [
        ("foundation", foundation_name(system.foundation.name)),
        ("sea", describe_sea(system)),
        *_realised_waves(system),
        ("height, mudline to yaw bearing", quantity(chain.top - mudline, "m", 5)),
        ("water depth", quantity(turbine.site.water_depth, "m", 3)),
    ]
    if chain.base < mudline:
        length = f"from the mudline to the {base_name(system.foundation.name)}"
        facts.append((length, quantity(mudline - chain.base, "m", 3)))
    facts += [
        (f"tower and monopile, from the {above}", quantity(mass / 1e3, "t")),
        ("rotor-nacelle assembly", quantity(chain.rna.mass / 1e3, "t")),
        *_tuned_masses(system),
        ("multibody beam elements", str(chain.elements)),
        ("degrees of freedom", str(system.nv)),
    ]
    return facts


def _tuned_masses(system: System) -> list[tuple[str, str]]:
    """A line about each tuned mass damper."""
    return [
        (
            f"tuned mass damper {mass.name}",
            f"{quantity(mass.mass / 1e3, 't', 3)} at z = {number(mass.z, 4)} m, "
            f"{number(np.sqrt(mass.stiffness / mass.mass) / (2 * np.pi), 3)} Hz, "
            f"{_SLIDES[mass.direction]}",
        )
        for mass in system.turbine.tuned_mass_dampers
    ]


def describe_sea(system: System) -> str:
    """The sea in words."""
    sea = system.sea
    if sea is None:
        return "none (dry)"
    told = [sea.in_words]
    if sea.water_level:
        told.append(f"mean level at z = {sea.water_level:g} m")
    if sea.stretching != "none" and not isinstance(sea, StillWater):
        told.append(f"stretched to the surface ({sea.stretching})")
    if sea.current is not None:
        x, y, _ = mean_velocity(sea.current, sea.water_level - system.turbine.site.mudline)
        speed, towards = float(np.hypot(x, y)), float(np.degrees(np.arctan2(y, x)))
        told.append(f"current of {speed:.3g} m/s in the mean over depth, towards {towards:.3g}°")
    return ", ".join(told)


def _realised_waves(system: System) -> list[tuple[str, str]]:
    """One line about the waves as they came out, none without waves."""
    facts = wave_facts(system)
    if not facts:
        return []
    told = []
    if "significant_height_m" in facts:
        told += [
            f"Hs {quantity(facts['significant_height_m'], 'm', 3)}",
            f"Tp {quantity(facts['peak_period_s'], 's', 3)}",
        ]
    told += [
        f"Tz {quantity(facts['zero_crossing_period_s'], 's', 3)}",
        f"highest crest {quantity(facts['highest_crest_m'], 'm', 3)}",
        f"lowest trough {quantity(facts['lowest_trough_m'], 'm', 3)}",
    ]
    return [("waves as realised", ", ".join(told))]


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
