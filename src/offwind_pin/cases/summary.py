"""The numbers of a case that go into ``summary.json`` and to standard output."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.static import StaticResult
from offwind_pin.dynamics.system import System
from offwind_pin.signal.moment_spectrum import BANDS_HZ, MomentSpectrum

if TYPE_CHECKING:
    import xarray as xr


def summarise_modes(result: ModalResult) -> list[dict[str, Any]]:
    """One row for each mode, as in ``offwind modes --json``."""
    return [
        {
            "label": label,
            "frequency_hz": float(result.frequency_hz[i]),
            "damping_ratio": float(result.damping_ratio[i]),
            "shape_peak_height_ratio": float(result.shape_peak_height_ratio[i]),
        }
        for i, label in enumerate(result.label)
    ]


def summarise_damping(system: System) -> dict[str, Any]:
    """Structural damping as asked for and as achieved on the system it was calibrated on."""
    calibration = system.turbine.structural_damping
    asked = {} if calibration is None else dict(calibration.ratios)
    return {"asked": asked, "achieved": system.damping_ratios}


def summarise_static(state: StaticResult) -> dict[str, Any]:
    """As in ``offwind static --json``."""
    return {
        "tower_top_x_m": float(state.tower_top_displacement[0]),
        "tower_top_z_m": float(state.tower_top_displacement[2]),
        "tower_top_rotation_y_rad": float(state.tower_top_rotation[1]),
        "mudline_displacement_x_m": float(state.mudline_displacement[0]),
        "mudline_moment_y_Nm": float(state.mudline_load[4]),
        "iterations": state.iterations,
        "residual": state.residual,
    }


def summarise_run_s_waves(data: xr.Dataset) -> dict[str, float]:
    """Crest and trough of the run itself, after the ramp, about the mean water level."""
    surface = data["wave_elevation"].where(data["time"] > data.attrs["ramp_s"], drop=True)
    return {
        "highest_crest_of_run_m": float(surface.max()),
        "lowest_trough_of_run_m": float(surface.min()),
    }


def summarise_dampers(data: xr.Dataset) -> dict[str, Any]:
    """How far each tuned mass damper slides, the ramp included; empty without dampers."""
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
