"""The section of a report that shows the sea and what it does to the structure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from offwind_pin.base.definition import Array
from offwind_pin.display.figures import sea as sea_plots
from offwind_pin.display.figures import sea_data
from offwind_pin.display.wording import fixed, number
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.sea.waves.wave_field import WaveField
from offwind_pin.signal.spectra import power_spectral_density

if TYPE_CHECKING:
    from offwind_pin.display.report.contents import CaseReport

_SEGMENT = 200.0
"""s; Welch's windows where the case names none."""

_STRETCHING = {
    "none": "without stretching, so that a crest acts up to the mean water level only",
    "vertical": "as at the mean water level above it (vertical stretching)",
    "extrapolation": "continued above the mean water level with the slope there (extrapolation)",
    "wheeler": "stretched to the moving surface (Wheeler)",
}


@dataclass(frozen=True, eq=False)
class SeaPicture:
    """A figure, its name in the page, its title for those who cannot see it, and its caption."""

    name: str
    title: str
    caption: str
    figure: Figure


def sea_pictures(report: CaseReport) -> list[SeaPicture]:
    """Elevation, profiles, spectrum and forces of a time history in waves; else nothing."""
    waters, sea, data = report.system.waters, report.system.sea, report.analysed
    if waters is None or sea is None or data is None or report.histories is None:
        return []
    waves = waters.surface.waves
    if waves is None:
        return []
    time = np.asarray(data.time.values, dtype=float)
    elevation = np.asarray(data.wave_elevation.values, dtype=float)
    whole = report.histories
    pictures = [
        _elevation(sea, whole.time.values, whole.wave_elevation.values, float(time[0])),
        _kinematics(waters, waves, sea, float(time[np.argmax(elevation)])),
    ]
    if sea_data.has_spectrum(waves):
        asked = _SEGMENT if report.psd is None else report.psd.segment
        pictures.append(_spectrum(waves, sea, time, elevation, asked))
    moment = np.linalg.norm(data.mudline_moment.sel(direction=["x", "y"]).values, axis=1)
    pictures.append(_forces(waters, waves, time, float(time[np.argmax(moment)])))
    return pictures


def _elevation(sea: Sea, time: Array, elevation: Array, ramp: float) -> SeaPicture:
    title = sea.in_words[:1].upper() + sea.in_words[1:]
    analysed = elevation[time >= ramp]
    return SeaPicture(
        "sea-elevation",
        "Surface elevation over time",
        "The undisturbed surface at the structure's axis; the dot is the highest crest after the "
        f"ramp. Four standard deviations of this run are {number(4 * float(analysed.std()), 3)} m.",
        sea_plots.surface_elevation(time, elevation, title=title, ramp=ramp),
    )


def _kinematics(waters: HydrodynamicModel, waves: WaveField, sea: Sea, crest: float) -> SeaPicture:
    when = sea_data.phases(waters.surface, waves, crest)
    along = sea_data.wave_direction(waves)
    shown = sea_data.profiles(waters, sea, np.array([when.crest, when.crossing, when.trough]))
    reach = _STRETCHING[sea.stretching]
    if waves.exact_surface:
        reach = "by the wave's own theory up to its surface"
    current = " The velocity holds the current." if sea.current is not None else ""
    return SeaPicture(
        "sea-kinematics",
        "Velocity and acceleration of the water over height",
        f"The undisturbed water about the highest crest of the run, at {fixed(crest, 1)} s, in the "
        f"direction of the waves ({_degrees(along)} from x towards y), {reach}.{current} What the "
        "structure does to the waves is not in these profiles.",
        sea_plots.kinematics(shown, along, waters.turbine.site.mudline, waters.surface.level),
    )


def _spectrum(
    waves: WaveField, sea: Sea, time: Array, elevation: Array, segment: float
) -> SeaPicture:
    window = min(segment, float(time[-1] - time[0]))
    run = power_spectral_density(elevation, float(time[1] - time[0]), window)
    target = sea_data.target_density(sea, waves.depth, waves.gravity)
    dashed = "" if target is None else " Dashed: the spectrum that the waves were made from."
    return SeaPicture(
        "sea-spectrum",
        "Spectrum of the surface elevation",
        f"Shaded: the surface after the ramp, Welch's method with Hann windows of "
        f"{number(window, 3)} s. Dots: the components of the sea, in bands of "
        f"{number(1 / window, 2)} Hz or a little more.{dashed} One run is one realisation, whose "
        "own peaks and gaps say little.",
        sea_plots.elevation_spectrum(
            run, sea_data.component_density(waves, 1 / window), target, title="Spectrum"
        ),
    )


def _forces(waters: HydrodynamicModel, waves: WaveField, time: Array, worst: float) -> SeaPicture:
    mudline = waters.turbine.site.mudline
    force, along = waters.wave_force(), sea_data.wave_direction(waves)
    then = sea_data.force_per_length(force, np.array([worst]), along)
    return SeaPicture(
        "sea-forces",
        "Force of the water over height",
        f"Along the waves, on the structure as if it stood upright and still. Left: at "
        f"{fixed(worst, 1)} s, when the moment at the mudline is largest, which wind and inertia "
        f"may have made rather than this wave; there the water pushes with "
        f"{number(float(then.resultant[0]) / 1e6, 3)} MN and turns about the mudline with "
        f"{number(float(then.moment(mudline)[0]) / 1e6, 3)} MN m. A step is a strip of the model, "
        "and counts with all its length, wet or not.",
        sea_plots.force_over_height(
            then,
            sea_data.force_envelope(force, time, along),
            mudline,
            waters.surface.level,
            title=f"At {fixed(worst, 1)} s",
        ),
    )


def _degrees(along: Array) -> str:
    return f"{fixed(round(float(np.degrees(np.arctan2(along[1], along[0]))), 1) + 0.0, 0)}°"
