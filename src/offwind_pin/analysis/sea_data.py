"""Waves of a run and their loads as data: profiles, spectra and forces over height."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import xarray as xr

from offwind_pin.analysis.wave_checks import wave_facts
from offwind_pin.base.definition import Array
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import wet_share
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel
from offwind_pin.loads.sea.irregular_waves import IrregularWaves
from offwind_pin.loads.sea.kinematics import WaterSeries, WaterSurface
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.sea.waves.wave_field import WaveField
from offwind_pin.results.reading import analysed
from offwind_pin.signal.spectra import power_spectral_density

_HEIGHTS = 121
"""Number of heights of a profile between the mudline and the highest surface."""
_SEARCHED = 10
"""Number of mean wave periods around a crest in which its zero crossing and trough are sought."""
_PER_PERIOD = 200
_SPECTRUM = 20
"""Number of components from which waves have a spectrum."""
_AT_ONCE = 2000
_MOST_INSTANTS = 20000
"""Largest number of instants of an envelope of forces; longer times are thinned."""
_SHOWN_DEPTH = 5e-3
"""Fraction of its largest value above which a spectrum is shown."""
_TARGET_LINES = 400
INSTANTS = ("crest", "zero crossing before it", "trough after it")

Density = Callable[[Array], Array]
Spectrum = tuple[Array, Array]
"""Frequencies (f,) in Hz and densities (f,) in m2/Hz."""


def waves_dataset(
    system: System, histories: xr.Dataset | None, segment: float
) -> xr.Dataset | None:
    """The realised waves, and their kinematics, spectrum and forces in a run.

    Parameters
    ----------
    histories : Dataset or None
        Time histories, if any.
    segment : float, s
        Longest Welch segment of the run's spectrum.

    Returns
    -------
    Dataset or None
        None for a sea without waves; without histories after the ramp it has attributes only.
    """
    hydrodynamics, sea = system.hydrodynamics, system.sea
    waves = None if hydrodynamics is None else hydrodynamics.surface.waves
    if hydrodynamics is None or sea is None or waves is None:
        return None
    facts = wave_facts(system)
    for name in ("notes", "cautions"):
        facts[name] = json.dumps(facts[name])
    data = xr.Dataset(
        attrs=facts
        | {
            "waves": sea.in_words,
            "stretching": sea.stretching,
            "exact_surface": int(waves.exact_surface),
            "mudline_m": system.turbine.site.mudline,
            "water_level_m": hydrodynamics.surface.level,
        }
    )
    part = None if histories is None else analysed(histories)
    if part is None or part.sizes["time"] < 2:
        return data
    time = np.asarray(part["time"].to_numpy(), dtype=float)
    elevation = np.asarray(part["wave_elevation"].to_numpy(), dtype=float)
    moment = part["mudline_moment"].sel(direction=["x", "y"]).to_numpy()
    crest = float(time[np.argmax(elevation)])
    worst = float(time[np.argmax(np.linalg.norm(moment, axis=1))])
    along = wave_direction(waves)
    when = phases(hydrodynamics.surface, waves, crest)
    shown = profiles(hydrodynamics, sea, np.array([when.crest, when.crossing, when.trough]))
    force = hydrodynamics.wave_force()
    variables = {
        **_profile_variables(shown),
        **_force_variables(
            force_per_length(force, np.array([worst]), along), force_envelope(force, time, along)
        ),
    }
    if has_spectrum(waves):
        window = min(segment, float(time[-1] - time[0]))
        run = power_spectral_density(elevation, float(time[1] - time[0]), window)
        bands = component_density(waves, 1 / window)
        target = target_density(sea, waves.depth, waves.gravity)
        variables |= _spectrum_variables(run, bands, target)
        data.attrs["segment_s"] = window
    data.attrs |= {"crest_s": crest, "worst_s": worst, "along_x": along[0], "along_y": along[1]}
    about = {"long_name": "instant of the profile"}
    return data.assign(
        {
            name: (dims, values, {"long_name": text, "units": unit})
            for name, (dims, values, text, unit) in variables.items()
        }
    ).assign_coords(
        instant=("instant", list(INSTANTS), about),
        axis=("axis", ["x", "y"], {"long_name": "axis of the inertial frame"}),
    )


_Variables = dict[str, tuple[tuple[str, ...], Array, str, str]]


def _profile_variables(shown: list[Profile]) -> _Variables:
    highest = max(shown, key=lambda profile: len(profile.height))
    count = len(highest.height)

    def padded(values: Array) -> Array:
        return np.pad(values, ((0, count - len(values)), (0, 0)), constant_values=np.nan)

    over = ("instant", "height", "axis")
    velocity = np.array([padded(profile.velocity) for profile in shown])
    acceleration = np.array([padded(profile.acceleration) for profile in shown])
    return {
        "profile_time": (
            ("instant",),
            np.array([profile.time for profile in shown]),
            "time of the profile",
            "s",
        ),
        "profile_elevation": (
            ("instant",),
            np.array([profile.elevation for profile in shown]),
            "surface elevation relative to the mean water level",
            "m",
        ),
        "profile_height": (("height",), highest.height, "height of the profile point", "m"),
        "velocity": (over, velocity, "velocity of the water, NaN above the surface", "m/s"),
        "acceleration": (
            over,
            acceleration,
            "acceleration of the water, NaN above the surface",
            "m/s2",
        ),
        "current": (("height", "axis"), highest.current, "velocity of the current", "m/s"),
    }


def _force_variables(worst: ForcePerLength, envelope: tuple[Array, Array]) -> _Variables:
    values = {
        "strip_height": (worst.height, "height of the middle of the strip", "m"),
        "strip_length": (worst.length, "length of the strip", "m"),
        "inertia": (worst.inertia[0], "fluid inertia force at the instant worst_s", "N/m"),
        "drag": (worst.drag[0], "drag force at the instant worst_s", "N/m"),
        "smallest_force": (envelope[0], "smallest force after the ramp", "N/m"),
        "largest_force": (envelope[1], "largest force after the ramp", "N/m"),
    }
    return {name: (("strip",), *entry) for name, entry in values.items()}


def _spectrum_variables(run: Spectrum, bands: Spectrum, target: Density | None) -> _Variables:
    about = {
        "run": (run, "spectrum of the surface after the ramp"),
        "band": (bands, "spectrum of the components in bands"),
    }
    if target is not None:
        start, end = frequency_range(run, bands)
        lines = np.linspace(max(start / 2, end / 1000), 1.05 * end, _TARGET_LINES)
        about["target"] = ((lines, target(lines)), "target spectrum")
    variables: _Variables = {}
    for name, ((frequency, density), text) in about.items():
        line = (f"{name}_line",)
        variables[f"{name}_frequency"] = (line, frequency, "frequency", "Hz")
        variables[f"{name}_density"] = (line, density, text, "m2/Hz")
    return variables


def profiles_of(data: xr.Dataset) -> list[Profile]:
    """Profiles of :func:`waves_dataset`."""
    height, current = data["profile_height"].to_numpy(), data["current"].to_numpy()
    shown = []
    for i in range(data.sizes["instant"]):
        velocity = data["velocity"][i].to_numpy()
        wet = np.isfinite(velocity[:, 0])
        shown.append(
            Profile(
                float(data["profile_time"][i]),
                float(data["profile_elevation"][i]),
                height[wet],
                velocity[wet],
                data["acceleration"][i].to_numpy()[wet],
                current[wet],
            )
        )
    return shown


def worst_force_of(data: xr.Dataset) -> ForcePerLength:
    """Forces of :func:`waves_dataset` at the instant of the largest mudline moment."""
    return ForcePerLength(
        np.array([float(data.attrs["worst_s"])]),
        data["strip_height"].to_numpy(),
        data["strip_length"].to_numpy(),
        data["inertia"].to_numpy()[None],
        data["drag"].to_numpy()[None],
    )


def spectrum_of(data: xr.Dataset, name: str) -> Spectrum | None:
    """Spectrum ``run``, ``band`` or ``target`` of :func:`waves_dataset`."""
    if f"{name}_density" not in data:
        return None
    return data[f"{name}_frequency"].to_numpy(), data[f"{name}_density"].to_numpy()


def frequency_range(*spectra: Spectrum | None) -> tuple[float, float]:
    """Frequency range in Hz over which to show spectra."""
    given = [pair for pair in spectra if pair is not None]
    frequency, density = (np.concatenate(parts) for parts in zip(*given, strict=True))
    # A quiet run may be below the threshold everywhere
    high = frequency[density > _SHOWN_DEPTH * density.max()]
    return float(high.min()), float(high.max())


def wave_direction(waves: WaveField) -> Array:
    """(2,) unit vector of the mean direction of the waves' energy flux.

    A component's velocity at the surface is in phase with its elevation, in its direction of
    travel.
    """
    surface = waves.velocity(np.zeros(1))[:2, 0]
    flux = np.real(surface @ np.conj(waves.elevation))
    return np.asarray(flux / np.hypot(*flux))


def mean_period(waves: WaveField) -> float:
    """m0 / m1 of the surface, in s."""
    variance = np.abs(waves.elevation) ** 2
    moving = waves.omega > 0
    mean_frequency = np.average(waves.omega[moving], weights=variance[moving]) / (2 * np.pi)
    return float(1 / mean_frequency)


@dataclass(frozen=True)
class Phases:
    """Times in s of a crest, of the zero crossing before it, and of the trough after it.

    In a regular wave the particles' acceleration along the wave is largest at that crossing.
    """

    crest: float
    crossing: float
    trough: float


def phases(surface: WaterSurface, waves: WaveField, crest: float) -> Phases:
    """Zero up-crossing before a crest, and the lowest surface before the next zero up-crossing.

    crest : time in s of a crest of these waves
    """
    step = mean_period(waves) / _PER_PERIOD
    ahead: Array = step * np.arange(_SEARCHED * _PER_PERIOD, dtype=float)
    before, after = surface.elevation(crest - ahead), surface.elevation(crest + ahead)
    up = int(np.argmax(before < 0))
    down = int(np.argmax(after < 0))
    next_up = down + int(np.argmax(after[down:] > 0))
    end = next_up if next_up > down else len(after)
    low = down + int(np.argmin(after[down:end]))
    # the crossing is between the last two samples
    share = before[up - 1] / (before[up - 1] - before[up]) if up > 0 else 0.0
    return Phases(crest, crest - step * (max(up - 1, 0) + share), crest + step * low)


@dataclass(frozen=True)
class Profile:
    """Motion of the undisturbed water over height at one instant, up to its surface.

    Attributes
    ----------
    time : float, s
    elevation : float, m
        Surface above the level.
    height : (n,) array, m
        Heights from the mudline to the surface.
    velocity, acceleration : (n, 2) array, m/s and m/s2
        Along x and y; the velocity includes the current.
    current : (n, 2) array, m/s
    """

    time: float
    elevation: float
    height: Array
    velocity: Array
    acceleration: Array
    current: Array


def profiles(hydrodynamics: HydrodynamicModel, sea: Sea, times: Array) -> list[Profile]:
    """Profiles of waves without ramp at times (t,) in s, with the sea's stretching."""
    surface, mudline = hydrodynamics.surface, hydrodynamics.turbine.site.mudline
    tops = surface.at(times, np.ones(len(times)))
    # densest at both ends, where currents decrease and waves increase
    share = (1 - np.cos(np.linspace(0, np.pi, _HEIGHTS))) / 2
    height = np.union1d(mudline + share * (tops.max() - mudline), tops)
    current = np.zeros((len(height), 3))
    if sea.current is not None:
        current = sea.current.velocity(height - surface.level, surface.level - mudline)
    water = WaterSeries(height, surface, current=current)
    rows = water.time_inputs(times, np.ones(len(times)))
    motion = rows[:, 1:].reshape(len(times), 2, len(height), 3)
    elevation = surface.elevation(times)
    return [
        Profile(
            float(time),
            float(elevation[i]),
            height[height <= tops[i]],
            motion[i, 0, height <= tops[i], :2],
            motion[i, 1, height <= tops[i], :2],
            current[height <= tops[i], :2],
        )
        for i, time in enumerate(times)
    ]


def target_density(sea: Sea, depth: float, gravity: float) -> Density | None:
    """Spectrum in m2/Hz over frequency in Hz from which a sea was generated, or None."""
    if not isinstance(sea, IrregularWaves):
        return None
    target = sea.target
    return lambda frequency: target.density(frequency, depth, gravity)


def has_spectrum(waves: WaveField) -> bool:
    """Whether waves have enough components for a density to be meaningful."""
    return int(np.count_nonzero(waves.elevation)) >= _SPECTRUM


def component_density(waves: WaveField, width: float) -> tuple[Array, Array]:
    """Variance density of the components in m2/Hz, in bands of at least a width in Hz.

    All bands have the same number of harmonics; a last, incomplete one is omitted. Waves narrower
    than one band form a single band of their own width.

    Returns
    -------
    frequency : (b,) array, Hz
        Centres of the bands.
    density : (b,) array, m2/Hz
    """
    each = max(1, int(np.ceil(width * waves.period)))
    moving = waves.harmonic > 0  # the set-down of second-order waves has no variance
    harmonic = waves.harmonic[moving].astype(np.intp)
    variance = np.zeros(int(harmonic.max()) + 1)
    np.add.at(variance, harmonic, np.abs(waves.elevation[moving]) ** 2 / 2)
    first = int(harmonic.min())
    each = min(each, len(variance) - first)
    bands = (len(variance) - first) // each
    whole = variance[first : first + bands * each].reshape(bands, each)
    middle: Array = first + each * np.arange(bands, dtype=float) + (each - 1) / 2
    return middle / waves.period, np.asarray(whole.sum(axis=1) * waves.period / each)


@dataclass(frozen=True)
class ForcePerLength:
    """Forces in N/m on strips in one direction, over their whole length, wet or dry.

    Attributes
    ----------
    time : (t,) array, s
    height, length : (n,) array, m
        Of the strips.
    inertia, drag : (t, n) array
    """

    time: Array
    height: Array
    length: Array
    inertia: Array
    drag: Array

    @property
    def total(self) -> Array:
        """(t, n) inertia and drag together."""
        return self.inertia + self.drag

    @property
    def resultant(self) -> Array:
        """(t,) total force on all strips in N."""
        return self.total @ self.length

    def moment(self, mudline: float) -> Array:
        """(t,) moment of the total force about a height in m, in N m."""
        return self.total @ (self.length * (self.height - mudline))


def force_per_length(force: MorisonForce, time: Array, along: Array) -> ForcePerLength:
    """Forces of waves without ramp at times (t,) in s on an upright structure at rest.

    along : (2,) horizontal unit vector
    """
    strips = force.strips
    n = len(strips.height)
    rows = force.time_inputs(time, np.ones(len(time)))
    motion = rows[:, 1:].reshape(len(time), 2, n, 3)[..., :2]
    inertia, drag = force.constants[:, 0], force.constants[:, 1]
    share = _shares(rows[:, 0], force.constants[:, 2], force.constants[:, 3])
    speed = np.linalg.norm(motion[:, 0], axis=-1)
    return ForcePerLength(
        time,
        strips.height,
        strips.length,
        share * inertia * (motion[:, 1] @ along) / strips.length,
        share * drag * speed * (motion[:, 0] @ along) / strips.length,
    )


def force_envelope(force: MorisonForce, time: Array, along: Array) -> tuple[Array, Array]:
    """(n,) smallest and largest force per length in N/m over times (t,) in s."""
    some = time[:: max(1, -(-len(time) // _MOST_INSTANTS))]
    low = np.full(len(force.strips.height), np.inf)
    high = -low
    for first in range(0, len(some), _AT_ONCE):
        total = force_per_length(force, some[first : first + _AT_ONCE], along).total
        low, high = np.minimum(low, total.min(axis=0)), np.maximum(high, total.max(axis=0))
    return low, high


def _shares(surface: Array, bottom: Array, length: Array) -> Array:
    """(t, n) wet shares of strips."""
    result = np.ones((len(surface), len(bottom)))
    for i in np.flatnonzero(np.isfinite(bottom)):
        result[:, i] = [wet_share(level, bottom[i], length[i]) for level in surface]
    return result
