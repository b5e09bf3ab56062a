"""Report section on the sea and its forces on the structure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from offwind_pin.analysis import sea_data
from offwind_pin.base.definition import Array
from offwind_pin.display.figures import sea as sea_plots
from offwind_pin.display.wording import fixed, number

if TYPE_CHECKING:
    from offwind_pin.display.report.contents import CaseReport

_STRETCHING = {
    "none": "without stretching, so that waves act up to the mean water level only",
    "vertical": "constant above the mean water level (vertical stretching)",
    "extrapolation": "extrapolated linearly above the mean water level",
    "wheeler": "stretched to the moving surface (Wheeler)",
}


@dataclass(frozen=True, eq=False)
class SeaPicture:
    """A figure with its name in the page, its title as alternative text, and its caption."""

    name: str
    title: str
    caption: str
    figure: Figure


def sea_pictures(report: CaseReport) -> list[SeaPicture]:
    """Elevation, profiles, spectrum and forces of a time history in waves, if any."""
    waves, whole, data = report.part("waves"), report.histories, report.analysed
    if waves is None or whole is None or data is None or "velocity" not in waves:
        return []
    ramp = float(data.time.values[0])
    pictures = [_elevation(waves, whole.time.values, whole.wave_elevation.values, ramp)]
    pictures.append(_kinematics(waves))
    if "run_density" in waves:
        pictures.append(_spectrum(waves))
    return [*pictures, _forces(waves)]


def _elevation(waves: xr.Dataset, time: Array, elevation: Array, ramp: float) -> SeaPicture:
    words = str(waves.attrs["waves"])
    analysed = elevation[time >= ramp]
    return SeaPicture(
        "sea-elevation",
        "Surface elevation over time",
        "Undisturbed surface at the axis of the structure; the dot marks the highest crest after "
        "the ramp. Four standard deviations of this run are "
        f"{number(4 * float(analysed.std()), 3)} m.",
        sea_plots.surface_elevation(
            time, elevation, title=words[:1].upper() + words[1:], ramp=ramp
        ),
    )


def _kinematics(waves: xr.Dataset) -> SeaPicture:
    crest, along = float(waves.attrs["crest_s"]), _along(waves)
    reach = _STRETCHING[str(waves.attrs["stretching"])]
    if waves.attrs["exact_surface"]:
        reach = "by the wave's theory up to its surface"
    current = ""
    if bool((waves["current"] != 0).any()):
        current = " The velocity includes the current."
    return SeaPicture(
        "sea-kinematics",
        "Velocity and acceleration of the water over height",
        f"Undisturbed water around the highest crest of the run, at {fixed(crest, 1)} s, in the "
        f"direction of the waves ({_degrees(along)} from x towards y), {reach}.{current} "
        "Disturbance of the waves by the structure is not included.",
        sea_plots.kinematics(sea_data.profiles_of(waves), along, *_levels(waves)),
    )


def _spectrum(waves: xr.Dataset) -> SeaPicture:
    window = float(waves.attrs["segment_s"])
    run, band, target = (sea_data.spectrum_of(waves, n) for n in ("run", "band", "target"))
    dashed = "" if target is None else " Dashed: target spectrum of the waves."
    return SeaPicture(
        "sea-spectrum",
        "Spectrum of the surface elevation",
        f"Shaded: surface elevation after the ramp, Welch's method with Hann windows of "
        f"{number(window, 3)} s. Dots: all wave components, averaged over bands of at least "
        f"{number(1 / window, 2)} Hz.{dashed} A single run is one realisation; its individual "
        "peaks and gaps are not significant.",
        sea_plots.elevation_spectrum(run, band, target, title="Spectrum"),
    )


def _forces(waves: xr.Dataset) -> SeaPicture:
    mudline, level = _levels(waves)
    worst = float(waves.attrs["worst_s"])
    then = sea_data.worst_force_of(waves)
    envelope = waves["smallest_force"].to_numpy(), waves["largest_force"].to_numpy()
    return SeaPicture(
        "sea-forces",
        "Hydrodynamic force over height",
        f"In the direction of the waves, on the upright structure at rest. Left: at "
        f"{fixed(worst, 1)} s, the instant of the largest mudline moment, which may be due to wind "
        f"and inertia rather than to this wave: hydrodynamic force "
        f"{number(float(then.resultant[0]) / 1e6, 3)} MN, mudline moment "
        f"{number(float(then.moment(mudline)[0]) / 1e6, 3)} MN m. Each step is a strip of the "
        "model, with its force divided by its full length, wet or not.",
        sea_plots.force_over_height(
            then, envelope, mudline, level, title=f"At {fixed(worst, 1)} s"
        ),
    )


def _levels(waves: xr.Dataset) -> tuple[float, float]:
    """Heights of mudline and mean water surface in m."""
    return float(waves.attrs["mudline_m"]), float(waves.attrs["water_level_m"])


def _along(waves: xr.Dataset) -> Array:
    return np.array([waves.attrs["along_x"], waves.attrs["along_y"]])


def _degrees(along: Array) -> str:
    return f"{fixed(round(float(np.degrees(np.arctan2(along[1], along[0]))), 1) + 0.0, 0)}°"
