"""The summary of a case, from its results alone."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.cases.earthquake import summarise_earthquake
from offwind_pin.cases.identification import summarise_identified
from offwind_pin.cases.settling import summarise_settling
from offwind_pin.cases.summary import summarise_modes, summarise_static
from offwind_pin.cases.tower_top import summarise_tower_top
from offwind_pin.results.tree import part, parts, required
from offwind_pin.signal.moment_spectrum import BANDS_HZ, MomentSpectrum

_WAVES: dict[str, type] = {
    "significant_height_m": float,
    "peak_period_s": float,
    "zero_crossing_period_s": float,
    "highest_crest_m": float,
    "lowest_trough_m": float,
    "m0_m2": float,
    "m2_m2_hz2": float,
    "repeat_period_s": float,
    "components": int,
}
"""Attributes of the waves' group that the summary repeats."""


def summary(tree: xr.DataTree) -> dict[str, Any]:
    """The content of ``summary.json``.

    Parameters
    ----------
    tree : DataTree
        Results of a case, from :func:`offwind_pin.results.reading.open_case`.
    """
    attributes = tree["case"].attrs
    head = summary_head(attributes)
    if attributes["status"] != "complete":
        return head
    foundation = str(attributes["foundation"])
    found: dict[str, Any] = {}
    histories = part(tree, "histories")
    states = static_states(tree)
    modal = part(tree, "modes")
    modes = None if modal is None else ModalResult.from_dataset(modal)
    if histories is not None and modes is not None:
        found = _summarise_transient(tree, histories, states[foundation], modes)
    elif modes is not None:
        found = _summarise_modal(tree, states[foundation], modes)
    else:
        found = _summarise_statics(tree, foundation, states)
    damping = _damping(part(tree, "structural_damping"))
    if histories is not None and "inertial_damping_share" in histories.attrs:
        damping["inertial_share_of_section_loads"] = histories.attrs["inertial_damping_share"]
        if "inertial_damping_caution" in histories.attrs:
            damping["cautions"].append(histories.attrs["inertial_damping_caution"])
    return head | found | {"structural_damping": damping}


def summary_head(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """First keys of a summary; of a run that stopped, all of them.

    Parameters
    ----------
    attributes : mapping
        Of the group ``case``.
    """
    wall, simulated = float(attributes["wall_s"]), float(attributes["simulated_s"])
    begun = float(attributes["resumed_at_s"])
    head = {
        "case": str(attributes["name"]),
        "status": str(attributes["status"]),
        "wall_s": wall,
        "simulated_s": simulated,
        "realtime_factor": max(simulated - begun, 0.0) / wall,
        **({"resumed_at_s": begun} if begun > 0 else {}),
        "offwind_pin_version": str(attributes["offwind_pin_version"]),
        "pinocchio_version": str(attributes["pinocchio_version"]),
    }
    return head | ({"message": str(attributes["message"])} if "message" in attributes else {})


def static_states(tree: xr.DataTree) -> dict[str, StaticResult]:
    """The static states of a case by name of their foundation."""
    return {
        str(data.attrs["foundation"]): StaticResult.from_dataset(data)
        for data in parts(tree, "static")
    }


def _summarise_statics(
    tree: xr.DataTree, foundation: str, states: Mapping[str, StaticResult]
) -> dict[str, Any]:
    found = summarise_static(states[foundation]) | {"foundation": foundation}
    for other in parts(tree, "static")[1:]:
        name = str(other.attrs["foundation"])
        reference = float(states[name].tower_top_displacement[0])
        found[f"{name}_tower_top_x_m"] = reference
        if reference != 0:
            increase = float(states[foundation].tower_top_displacement[0]) / reference - 1
            found[f"increase_over_{name}_percent"] = 100 * increase
    settling = part(tree, "settling")
    return found | ({} if settling is None else summarise_settling(settling))


def _summarise_modal(tree: xr.DataTree, state: StaticResult, modes: ModalResult) -> dict[str, Any]:
    table = summarise_modes(modes)
    identified = part(tree, "identified_modes")
    return {
        "foundation": str(tree["case"].attrs["foundation"]),
        "modes": table,
        **_frequencies(modes),
        **{f"{row['label']}_peak_height_ratio": row["shape_peak_height_ratio"] for row in table},
        **summarise_static(state),
        **({} if identified is None else summarise_identified(identified)),
    }


def _summarise_transient(
    tree: xr.DataTree, histories: xr.Dataset, state: StaticResult, modes: ModalResult
) -> dict[str, Any]:
    attributes = tree["case"].attrs
    spectrum = MomentSpectrum.from_dataset(required(tree, "spectrum"))
    earthquake, waves = part(tree, "earthquake"), part(tree, "waves")
    found = summarise_spectrum(histories, spectrum) | {
        "foundation": str(attributes["foundation"]),
        "seed": int(attributes["seed"]),
        "mudline_moment_y_static_under_mean_loads_Nm": float(state.mudline_load[4]),
        "natural_frequencies_hz": dict(zip(modes.label, modes.frequency_hz.tolist(), strict=True)),
        "modes": summarise_modes(modes),
        **_frequencies(modes),
        "steps": int(attributes["steps"]),
        "mean_iterations": float(histories["solver_iterations"][1:].mean()),
        "largest_residual": float(histories["solver_residual"].max()),
        **summarise_dampers(histories),
        **summarise_tower_top(part(tree, "tower_top"), part(tree, "rotor")),
    }
    if earthquake is not None:
        found["earthquake"] = summarise_earthquake(earthquake)
    if waves is not None:
        found["waves"] = summarise_waves(waves) | summarise_surface(histories)
    return found


def _frequencies(modes: ModalResult) -> dict[str, float]:
    """Natural frequencies by keys such as ``FA1_hz``, for published values to name."""
    return {
        f"{label}_hz": float(frequency)
        for label, frequency in zip(modes.label, modes.frequency_hz, strict=True)
    }


def _damping(data: xr.Dataset | None) -> dict[str, Any]:
    """As :func:`summarise_damping`, from results."""
    if data is None:
        return {"kind": None, "asked": {}, "achieved": {}, "cautions": []}
    ratios = {
        key: {
            str(label): float(ratio)
            for label, ratio in zip(data["mode"].to_numpy(), data[name].to_numpy(), strict=True)
            if np.isfinite(ratio)
        }
        for key, name in (("asked", "requested"), ("achieved", "achieved"))
    }
    return {
        "kind": str(data.attrs["kind"]),
        **ratios,
        "cautions": json.loads(data.attrs["cautions"]),
    }


def summarise_waves(waves: xr.Dataset) -> dict[str, Any]:
    """The realised waves over one of their periods."""
    facts = {name: kind(waves.attrs[name]) for name, kind in _WAVES.items() if name in waves.attrs}
    return facts | {name: json.loads(waves.attrs[name]) for name in ("notes", "cautions")}


def summarise_surface(data: xr.Dataset) -> dict[str, float]:
    """Crest and trough of the run itself, after the ramp, relative to the mean water level."""
    surface = data["wave_elevation"].where(data["time"] > data.attrs["ramp_s"], drop=True)
    return {
        "highest_crest_of_run_m": float(surface.max()),
        "lowest_trough_of_run_m": float(surface.min()),
    }


def summarise_dampers(data: xr.Dataset) -> dict[str, Any]:
    """Largest displacement of each tuned mass damper, the ramp included; empty without dampers."""
    if "tuned_mass_displacement" not in data:
        return {}
    far = np.hypot(*data["tuned_mass_displacement"].transpose("across", ...).to_numpy()).max(axis=0)
    room = data["tuned_mass_travel"].to_numpy()
    rows = [
        {"name": str(name), "largest_displacement_m": float(far[i])}
        | ({"travel_m": float(room[i])} if np.isfinite(room[i]) else {})
        for i, name in enumerate(data["damper"].to_numpy())
    ]
    return {"tuned_mass_dampers": rows}


def summarise_spectrum(data: xr.Dataset, spectrum: MomentSpectrum) -> dict[str, Any]:
    """Mean and standard deviation of the moment, peaks and band sums."""
    after_ramp = data["time"] > data.attrs["ramp_s"]
    moments = data["mudline_moment"].where(after_ramp, drop=True)
    analysed, sideways = moments.sel(direction="y"), moments.sel(direction="x")
    top = data["tower_top_displacement"].sel(direction="x").where(after_ramp, drop=True)
    near = {name: spectrum.nearest_peak(at) for name, at in spectrum.marked.items()}
    found = {name: at for name, at in near.items() if at is not None}
    return {
        "mudline_moment_y_mean_Nm": float(analysed.mean()),
        "mudline_moment_y_std_Nm": float(analysed.std()),
        "mudline_moment_y_min_Nm": float(analysed.min()),
        "mudline_moment_y_max_Nm": float(analysed.max()),
        "mudline_moment_x_mean_Nm": float(sideways.mean()),
        "mudline_moment_x_std_Nm": float(sideways.std()),
        "mudline_moment_x_min_Nm": float(sideways.min()),
        "mudline_moment_x_max_Nm": float(sideways.max()),
        "tower_top_x_mean_m": float(top.mean()),
        "tower_top_x_std_m": float(top.std()),
        "tower_top_x_min_m": float(top.min()),
        "tower_top_x_max_m": float(top.max()),
        "psd_peaks_hz": sorted(set(found.values())),
        "psd_peaks_near_hz": found,
        **{f"psd_peak_{name}_hz": at for name, at in found.items()},
        **{name: band.area for name, band in zip(BANDS_HZ, spectrum.bands, strict=True)},
        "psd_sum_ratio": spectrum.ratio,
        "psd_segment_s": spectrum.segment,
    }
