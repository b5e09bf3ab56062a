"""Rows of a report's tables."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

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
    surrogate_notes,
)

if TYPE_CHECKING:
    import xarray as xr

    from offwind_pin.display.report.contents import CaseReport, Published
    from offwind_pin.signal.moment_spectrum import MomentSpectrum

_ROUNDING = 1e-12
"""Fraction of the largest value with the same unit below which a value is shown as zero."""
_BAR = 0.10
"""Relative difference at the end of the bars in the table of published values."""

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
    "residual_tolerance": "tolerance of the residual relative to the load scale",
    "offwind_pin_version": "offwind-pin",
    "pinocchio_version": "Pinocchio",
}

_SLIDES = {"fore_aft": "fore-aft", "side_side": "side-side", "both": "both ways"}


@dataclass(frozen=True)
class Surrogate:
    """Replaced data, reason, and how to provide the real data."""

    what: str
    why: str
    remedy: str


@dataclass(frozen=True)
class PublishedRow:
    """A published and the computed value; bar from -1 to 1, or None without the latter."""

    published: Published
    ours: str
    difference: str
    bar: float | None


@dataclass(frozen=True)
class ModeRow:
    """A mode in the table; published joins its published frequencies in Hz."""

    label: str
    name: str
    frequency_hz: float
    damping_ratio: float
    damping_parts: list[float]
    damping_asked: float | None
    peak_height_ratio: float
    peak_height: float
    published: str


def surrogates(report: CaseReport) -> list[Surrogate]:
    """Replacements for data that are not available."""
    found = []
    soil = str(report.structure.attrs["surrogate"])
    if soil:
        remedy = (
            "provide the real p-y curves as a CSV table (depth_m, y_m, p_n_per_m) "
            "in the turbine file."
        )
        found.append(Surrogate("Soil", soil, remedy))
    attributes = {} if report.histories is None else report.histories.attrs
    found += [
        Surrogate(
            "Tower-top load",
            sentence(text),
            "provide the real history as seven columns: t, Fx, Fy, Fz, Mx, My, Mz in s, N and N m.",
        )
        for text in surrogate_notes(attributes)
        if text != soil
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
    if bool((applied != 0).any()):  # does not contain the thrust of an operating rotor
        rows.append(("applied tower-top force along x", "MN", applied))
    if "tuned_mass_displacement" in data:
        for name in data["damper"].to_numpy():
            for axis in data["across"].to_numpy():
                stroke = data.tuned_mass_displacement.sel(damper=name, across=axis)
                if bool((stroke != 0).any()):  # it may slide in one direction only
                    rows.append((f"stroke of tuned mass {name} along {axis}", "m", stroke))
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


def structure_facts(report: CaseReport) -> list[tuple[str, str]]:
    """Names and values of the main dimensions and masses."""
    data = report.structure
    about = data.attrs
    mudline, base, top = (float(about[f"{name}_m"]) for name in ("mudline", "base", "yaw_bearing"))
    support = float(data["support_structure_mass"])
    above = "mudline" if base >= mudline else base_name(report.foundation)
    facts = [
        ("foundation", foundation_name(report.foundation)),
        ("sea", str(about["sea_in_words"])),
        *_realised_waves(report.summary.get("waves", {})),
        ("height, mudline to yaw bearing", quantity(top - mudline, "m", 5)),
        ("water depth", quantity(float(about["water_depth_m"]), "m", 3)),
    ]
    if base < mudline:
        length = f"from the mudline to the {base_name(report.foundation)}"
        facts.append((length, quantity(mudline - base, "m", 3)))
    facts += [
        (f"tower and monopile, from the {above}", quantity(support / 1e3, "t")),
        (
            "rotor-nacelle assembly",
            quantity(float(data["rotor_nacelle_mass"]) / 1e3, "t"),
        ),
        *_tuned_masses(data),
        ("multibody beam elements", str(about["elements"])),
        ("degrees of freedom", str(about["degrees_of_freedom"])),
    ]
    return facts


def _tuned_masses(data: xr.Dataset) -> list[tuple[str, str]]:
    """One line per tuned mass damper."""
    if "damper" not in data.dims:
        return []
    dampers = (data.sel(damper=name) for name in data["damper"].to_numpy())
    return [
        (
            f"tuned mass damper {mass['damper'].item()}",
            f"{quantity(float(mass['damper_mass']) / 1e3, 't', 3)} at "
            f"z = {number(float(mass['damper_height']), 4)} m, "
            f"{number(float(mass['damper_frequency']), 3)} Hz, "
            f"{_SLIDES[mass['damper_direction'].item()]}",
        )
        for mass in dampers
    ]


def _realised_waves(facts: Mapping[str, Any]) -> list[tuple[str, str]]:
    """One line on the realised waves, if any."""
    if not facts:
        return []
    values = []
    if "significant_height_m" in facts:
        values += [
            f"Hs {quantity(facts['significant_height_m'], 'm', 3)}",
            f"Tp {quantity(facts['peak_period_s'], 's', 3)}",
        ]
    values += [
        f"Tz {quantity(facts['zero_crossing_period_s'], 's', 3)}",
        f"highest crest {quantity(facts['highest_crest_m'], 'm', 3)}",
        f"lowest trough {quantity(facts['lowest_trough_m'], 'm', 3)}",
    ]
    return [("waves as realised", ", ".join(values))]


def mode_rows(report: CaseReport) -> list[ModeRow]:
    modes = report.modes
    if modes is None:
        return []
    about = report.structure.attrs
    mudline, top = float(about["mudline_m"]), float(about["yaw_bearing_m"])
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
                modes.damping_parts[i].tolist(),
                None if np.isnan(modes.damping_asked[i]) else float(modes.damping_asked[i]),
                ratio,
                mudline + ratio * (top - mudline),
                " / ".join(dict.fromkeys(printed)),
            )
        )
    return rows


def _is_frequency_of(row: Published, label: str) -> bool:
    """Whether a published frequency is that of a mode, by label or by name."""
    if row.mode is not None:
        return row.mode == label
    return row.unit == "Hz" and row.quantity in (label, mode_name(label))


def wind_facts(wind: xr.Dataset | None) -> dict[str, Any]:
    """Derivation of a synthetic load by name, including harmonics."""
    if wind is None:
        return {}
    scalars = {str(name): float(data) for name, data in wind.data_vars.items() if not data.dims}
    return scalars | {
        "blades": int(wind.attrs["blades"]),
        "seed": int(wind.attrs["seed"]),
        "rotor_speed_rpm": scalars["rotor_speed"] * 30 / np.pi,
        "harmonics": wind["harmonics"].to_numpy().tolist(),
    }


def rotor_facts(rotor: xr.Dataset | None) -> list[tuple[str, str]]:
    """Names and values of the operating point of a rotor."""
    if rotor is None:
        return []
    control = str(rotor.attrs["control"])
    if "control_time" in rotor:
        control += f", time constant {quantity(float(rotor['control_time']), 's')}"
    wake = "in equilibrium"
    if "wake_time" in rotor:
        wake = f"dynamic, time constant {quantity(float(rotor['wake_time']), 's', 3)}"
    return [
        ("mean wind at the hub", quantity(float(rotor["mean_wind"]), "m/s")),
        (
            "standard deviation of the rotor-effective wind",
            quantity(float(rotor["wind_standard_deviation"]), "m/s", 3),
        ),
        ("thrust coefficient", number(float(rotor["thrust_coefficient"]), 3)),
        ("mean thrust", quantity(float(rotor["mean_thrust"]) / 1e6, "MN")),
        (
            "blade-passing frequency",
            quantity(float(rotor["blade_passing_frequency"]), "Hz", 3),
        ),
        ("controller", control),
        ("wake", wake),
        ("wind", str(rotor.attrs["wind"])),
    ]


def earthquake_facts(earthquake: xr.Dataset | None) -> list[tuple[str, str]]:
    """Names and values of the strength of an earthquake, and its origin."""
    if earthquake is None:
        return []

    def listed(name: str, unit: str) -> str:
        values = earthquake[name].to_numpy()
        return f"{', '.join(number(value, 3) for value in values)} {unit}"

    return [
        ("peak ground acceleration x, y, z", listed("peak_ground_acceleration", "m/s²")),
        ("peak ground velocity x, y, z", listed("peak_ground_velocity", "m/s")),
        ("peak ground displacement x, y, z", listed("peak_ground_displacement", "m")),
        ("Arias intensity x, y, z", listed("arias_intensity", "m/s")),
        ("baseline", str(earthquake.attrs["baseline"])),
        ("record", str(earthquake.attrs["origin"])),
        *(("caution", text) for text in json.loads(earthquake.attrs["cautions"])),
    ]


def identified_facts(data: xr.Dataset | None) -> dict[str, Any]:
    """Record of an operational modal analysis, and cautions about it."""
    if data is None:
        return {}
    return {
        "seed": int(data.attrs["seed"]),
        "record_s": float(data.attrs["record_s"]),
        "nodes": data.sizes["height"],
        "cautions": json.loads(data.attrs["cautions"]),
    }


def psd_rows(spectrum: MomentSpectrum | None) -> list[tuple[str, float, float | None]]:
    """Name, frequency and nearest peak of each marked frequency, in order of frequency."""
    if spectrum is None:
        return []
    marked = sorted(spectrum.marked.items(), key=lambda item: item[1])
    return [(name, frequency, spectrum.nearest_peak(frequency)) for name, frequency in marked]


def damping_rows(data: xr.Dataset | None) -> list[tuple[str, float, float]]:
    """Label, damping ratio requested and achieved on the system of the calibration."""
    if data is None:
        return []
    columns = (data[name].to_numpy() for name in ("mode", "requested", "achieved"))
    return [
        (str(label), float(requested), float(achieved))
        for label, requested, achieved in zip(*columns, strict=True)
        if np.isfinite(requested) and np.isfinite(achieved)
    ]


def solver_account(report: CaseReport) -> list[tuple[str, str]]:
    """Names and values of solver statistics."""
    rows: list[tuple[str, str]] = []
    data, summary = report.histories, report.summary
    if data is not None:
        time, taken = data.time.values, data.solver_iterations.values[1:]
        rows += [
            ("status", report.status),
            ("simulated time", quantity(float(time[-1]), "s")),
            ("time steps", count(round(float(time[-1]) / float(data.attrs["dt_s"])))),
        ]
        if len(taken):
            rows.append(
                (
                    "Newton iterations per step",
                    f"{taken.mean():.2f} on average, at most {taken.max()}",
                )
            )
            worst = float(data.solver_residual.max())
            tolerance = float(data.attrs["residual_tolerance"])
            rows.append(
                (
                    "largest residual relative to the load scale",
                    f"{number(worst, 2)} (tolerance: {number(tolerance, 2)})",
                )
            )
    rows += [
        (
            f"static state, {foundation_name(name)}",
            f"{state.iterations} Newton iterations, residual {number(state.residual, 2)}",
        )
        for name, state in report.statics.items()
    ]
    if "wall_s" in summary:
        rows.append(("wall time", quantity(float(summary["wall_s"]), "s", 3)))
    if data is not None and "realtime_factor" in summary:
        factor = number(float(summary["realtime_factor"]), 3)
        rows.append(("real-time factor", f"{factor} (simulated time over wall time)"))
    return rows


def provenance(report: CaseReport) -> list[tuple[str, str]]:
    """Versions, seeds, settings, and hash of the definition."""
    about = report.structure.attrs
    names = ("turbine", "definition_sha256", "foundation", "elements")
    known: dict[str, Any] = {name: about[name] for name in names}
    known |= {name: report.case[name] for name in ("offwind_pin_version", "pinocchio_version")}
    if report.histories is not None:
        known |= report.histories.attrs
        if known.get("wave_seed") == -1:
            del known["wave_seed"]
    known["sea"] = about["sea_in_words"]
    wind = report.part("wind")
    if wind is not None:
        known["seed of the synthetic wind"] = wind.attrs["seed"]
    ordered = [key for key in _PROVENANCE_NAMES if key in known]
    others = [key for key in known if key not in _PROVENANCE_NAMES and key not in _DESCRIPTIVE]
    return [(_PROVENANCE_NAMES.get(key, key), str(known[key])) for key in ordered + others]
