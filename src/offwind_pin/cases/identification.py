"""Modes out of accelerations in a case: white noise shakes the structure, nodes are recorded.

The way of Rahman et al. (MECC 2025) for LC 2.3: accelerations at 13 nodes from the seabed to the
yaw bearing, frequency domain decomposition; here beside the modes of the eigenanalysis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.simulate import simulate
from offwind_pin.base.definition import Array
from offwind_pin.cases.case import Identification
from offwind_pin.definitions.engine import Engine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.tower_top.load_history import LoadHistory
from offwind_pin.signal.modal_identification.identify import IdentifiedModes, operational_modes
from offwind_pin.signal.modal_identification.modal_assurance import modal_assurance

Progress = Callable[[float, float], None]

STEP = 0.02
"""s; generalised-alpha lengthens a period by (omega dt)^2 / 12, 0.2 % at 1.2 Hz."""
SETTLING = 200.0
"""s from the start on that are left out."""
FORCE, MOMENT = 20e3, 1e6
"""Standard deviations of Fx in N and My in N m at the yaw bearing. So small that the soil stays
linear; the moment reaches the second mode, which hardly moves there but turns."""
LABELS = ("FA1", "FA2")


def identify(
    system: System,
    modes: ModalResult,
    asked: Identification,
    seed: int,
    progress: Progress | None = None,
) -> IdentifiedModes:
    """Shake a system, take its fore-aft modes out of the accelerations, and compare.

    Raises
    ------
    InputError : modes that were not computed, or a record too short for what is asked
    """
    height = np.linspace(system.turbine.site.mudline, system.chain.top, asked.nodes)
    rows = [modes.index(label) for label in LABELS]
    data = _shaken(system, height, asked.duration, seed, modes.engine, progress)
    channels = data["acceleration"].sel(direction="x").sel(height=height, method="nearest")
    record = channels.to_numpy()[data["time"].to_numpy() >= SETTLING]
    moves = np.ptp(record, axis=0) > 0  # not the mudline of a clamped base
    found = operational_modes(
        record[:, moves],
        1 / STEP,
        asked.segment,
        near=modes.frequency_hz[rows].tolist(),
        names=[f"z {z:.4g} m" for z in height[moves]],
    )
    everywhere = np.zeros((len(LABELS), asked.nodes))
    everywhere[:, moves] = found.shape
    found = replace(found, shape=everywhere)
    shape = np.array([np.interp(height, modes.height, modes.shape[row, :, 0]) for row in rows])
    shape /= np.max(np.abs(shape), axis=1, keepdims=True)
    return IdentifiedModes(
        label=LABELS,
        height=height,
        found=found,
        frequency_hz=modes.frequency_hz[rows],
        damping_ratio=modes.damping_ratio[rows],
        shape=shape,
        assurance=modal_assurance(found.shape, shape).diagonal().copy(),
        peak_height_ratio=np.array([_peak(row) for row in found.shape]) / (asked.nodes - 1),
        duration=asked.duration,
        seed=seed,
    )


def summarise_identified(result: IdentifiedModes) -> dict[str, Any]:
    """Keys of the summary: a row for each mode, and single numbers for published ones to name."""
    found = result.found
    rows = [
        {
            "label": label,
            "frequency_hz": float(found.frequency_hz[i]),
            "eigenanalysis_frequency_hz": float(result.frequency_hz[i]),
            "damping_ratio": float(found.damping_ratio[i]),
            "damping_scatter": float(found.damping_scatter[i]),
            "eigenanalysis_damping_ratio": float(result.damping_ratio[i]),
            "modal_assurance": float(result.assurance[i]),
            "shape_peak_height_ratio": float(result.peak_height_ratio[i]),
        }
        for i, label in enumerate(result.label)
    ]
    single = {f"identified_{row['label']}_hz": row["frequency_hz"] for row in rows}
    single |= {
        f"identified_{row['label']}_peak_height_ratio": row["shape_peak_height_ratio"]
        for row in rows
    }
    return {
        "identified_modes": rows,
        "identification_cautions": list(found.cautions),
        "simulated_s": SETTLING + result.duration,
        "seed": result.seed,
        **single,
    }


def identified_variables(result: IdentifiedModes) -> dict[str, xr.DataArray]:
    """Identified shapes and singular values for the dataset of the modes."""
    found = result.found
    nodes = ("node_height", result.height, {"units": "m"})
    lines = ("fdd_frequency", found.frequencies, {"units": "Hz"})
    return {
        "identified_shape": xr.DataArray(
            found.shape,
            dims=("identified_mode", "node_height"),
            coords={"identified_mode": list(result.label), "node_height": nodes},
            attrs={"long_name": "fore-aft shape out of accelerations, unit peak", "units": "1"},
        ),
        "singular_value": xr.DataArray(
            found.singular_values,
            dims=("fdd_frequency", "singular_value_number"),
            coords={"fdd_frequency": lines},
            attrs={"long_name": "of the accelerations' cross-spectra", "units": "(m/s2)2/Hz"},
        ),
    }


def _shaken(
    system: System,
    height: Array,
    duration: float,
    seed: int,
    engine: Engine,
    progress: Progress | None,
) -> xr.Dataset:
    """Time history under white noise in Fx and My at the yaw bearing."""
    steps = round((SETTLING + duration) / STEP)
    load = np.zeros((steps + 1, 6))
    noise = np.random.default_rng(seed).normal(size=(steps + 1, 2))
    load[:, [0, 4]] = noise * [FORCE, MOMENT]
    time = np.linspace(0.0, steps * STEP, steps + 1)
    return simulate(
        system,
        steps * STEP,
        STEP,
        [LoadHistory(time, load, f"white noise, seed {seed}")],
        ramp=20.0,
        spectral_radius=1.0,  # no numerical damping, which would be identified too
        engine=engine,
        heights=height.tolist(),
        segments=[],
        progress=None if progress is None else lambda now: progress(now, steps * STEP),
    )


def _peak(shape: Array) -> float:
    """Number of the node at the peak, and the part of a step to the vertex of a parabola there."""
    at = int(np.argmax(shape))
    if at in (0, len(shape) - 1):
        return float(at)
    left, middle, right = shape[at - 1 : at + 2]
    return float(at + 0.5 * (left - right) / (left - 2 * middle + right))
