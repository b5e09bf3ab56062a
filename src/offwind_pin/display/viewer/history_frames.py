"""A time history as frames that a picture can show, made of its results alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.dynamics.acting_loads import smooth_ramp
from offwind_pin.loads.sea.waves.surface import SurfaceWaves

PATCH = 150.0
"""Side in m of the patch of sea about the structure."""
SPACING = 2.5
"""Distance in m of its points; waves shorter than two of them cannot be drawn, and are left out."""
RATE = 5.0
"""Frames a second that are wanted."""
LEAST_RATE = 2.0
MOST_HEIGHTS = 1_600_000
"""Heights of the sea in all frames; each takes two bytes."""


@dataclass(frozen=True, eq=False)
class Frames:
    """Motion of axis and sea at f times, which are times of the results.

    Attributes
    ----------
    time : (f,) array, s
    height : (m,) array, m
        Of the axis at rest.
    displacement : (f, m, 3) array, m
        Of the axis.
    elevation : (f,) array, m
        Of the surface at the axis, above its mean.
    moment : (f, 2) array, N m
        At the mudline about x and y.
    x, y : array, m
        (p,) and (q,) coordinates of the patch of sea.
    sea : (f, p, q) array or None, m
        Surface above its mean; None where it does not move.
    bending : (f, m) array, N m
        Size of the bending moment, of the section moments about x and y.
    top_force : (f, 3) array, N
        Load applied at the yaw bearing.
    soil_height : (n,) array, m
        Of the nodes of the soil at rest; none where results hold none.
    soil_force : (f, n, 3) array, N
        Of the soil on the pile.
    """

    time: Array
    height: Array
    displacement: Array
    elevation: Array
    moment: Array
    x: Array
    y: Array
    sea: Array | None
    bending: Array
    top_force: Array
    soil_height: Array
    soil_force: Array


def frames(
    results: xr.Dataset,
    start: float,
    duration: float,
    *,
    rate: float = RATE,
    patch: float = PATCH,
    spacing: float = SPACING,
) -> Frames:
    """Frames of a part of a time history.

    Where a sea in motion would have more than :data:`MOST_HEIGHTS`, there are fewer frames.

    Parameters
    ----------
    results : Dataset
        Of :func:`offwind_pin.simulate`.
    start, duration : float, s
        Of the part.
    rate : float
        Frames a second, at most as many as the results have.
    patch, spacing : float, m
        Side of the square of sea, and distance of its points.

    Raises
    ------
    InputError
        Results without what a picture needs, or a part that they do not hold, or one that is so
        long that its sea would move in jerks.
    """
    _require(results)
    time = np.asarray(results.time.values, dtype=float)
    inside = np.flatnonzero((time >= start - 1e-9) & (time <= start + duration + 1e-9))
    if start < time[0] - 1e-9 or start + duration > time[-1] + 1e-6 or len(inside) < 2:
        raise InputError(
            "time history, start and duration",
            f"{start} s and {duration} s",
            f"a part of {time[0]:g} to {time[-1]:g} s with two outputs at least",
            "Choose another part.",
        )
    x = np.linspace(-patch / 2, patch / 2, max(2, round(patch / spacing) + 1))
    waves = surface_waves(results)
    interval = float(np.median(np.diff(time[inside])))
    step = max(1, round(1 / (rate * interval)))
    if waves is not None:
        allowed = MOST_HEIGHTS // len(x) ** 2
        step = max(step, -(-len(inside) // allowed))
        if step * interval > 1 / LEAST_RATE and step > round(1 / (rate * interval)):
            longest = allowed / LEAST_RATE
            raise InputError(
                "time history, duration", f"{duration} s", f"at most {longest:g} s", "Shorten it."
            )
    chosen = inside[::step]
    part = results.isel(time=chosen)
    sea = None
    if waves is not None:
        drawn = waves.longer_than(2 * spacing)
        rise = smooth_ramp(time[chosen], float(results.attrs.get("ramp_s", 0.0)))
        sea = rise[:, None, None] * drawn.at(time[chosen], x, x)
    return Frames(
        time[chosen],
        np.asarray(results.height.values, dtype=float),
        np.asarray(part.displacement.values, dtype=float),
        np.asarray(part.wave_elevation.values, dtype=float),
        np.asarray(part.mudline_moment.sel(direction=["x", "y"]).values, dtype=float),
        x,
        x,
        sea,
        _bending(part),
        np.asarray(part.tower_top_load.sel(component=["Fx", "Fy", "Fz"]).values, dtype=float),
        *_soil(part),
    )


def _bending(part: xr.Dataset) -> Array:
    moment = part.section_moment.sel(direction=["x", "y"]).values
    return np.linalg.norm(np.asarray(moment, dtype=float), axis=2)


def _soil(part: xr.Dataset) -> tuple[Array, Array]:
    """Heights (n,) of the soil's nodes and forces (f, n, 3) there; n is zero without any."""
    if "soil_force" not in part:
        return np.zeros(0), np.zeros((part.sizes["time"], 0, 3))
    height = np.asarray(part.soil_node.values, dtype=float)
    return height, np.asarray(part.soil_force.values, dtype=float)


def surface_waves(results: xr.Dataset) -> SurfaceWaves | None:
    """The waves that results carry; None for a dry structure or still water."""
    if "wave_frequency" not in results:
        return None
    phase = np.exp(1j * results.wave_phase.values)
    return SurfaceWaves(
        np.asarray(results.wave_frequency.values, dtype=float),
        np.asarray(results.wave_amplitude.values * phase),
        np.asarray(results.wave_number_x.values, dtype=float),
        np.asarray(results.wave_number_y.values, dtype=float),
    )


def outline(results: xr.Dataset, longest: float) -> tuple[Array, Array]:
    """Heights (r,) and outer radii (r,) in m of the wall, points no further apart than asked for.

    Heights repeat where the diameter jumps.
    """
    height = np.asarray(results.outline_height.values, dtype=float)
    radius = np.asarray(results.outline_diameter.values, dtype=float) / 2
    heights, radii = [height[:1]], [radius[:1]]
    for low, high in zip(range(len(height) - 1), range(1, len(height)), strict=True):
        count = max(1, int(np.ceil((height[high] - height[low]) / longest)))
        share = np.arange(1, count + 1) / count
        heights.append(height[low] + share * (height[high] - height[low]))
        radii.append(radius[low] + share * (radius[high] - radius[low]))
    z, r = np.concatenate(heights), np.concatenate(radii)
    new = np.append(True, (np.diff(z) > 1e-9) | (np.abs(np.diff(r)) > 1e-9))
    return z[new], r[new]


def _require(results: xr.Dataset) -> None:
    needed = (
        "displacement",
        "section_moment",
        "mudline_moment",
        "tower_top_load",
        "outline_height",
        "outline_diameter",
    )
    missing = [name for name in needed if name not in results]
    if missing or "time" not in results.dims:
        raise InputError(
            "results",
            f"no {', '.join(missing) or 'time'}",
            "a time history written by this version",
            "Run the case again.",
        )
