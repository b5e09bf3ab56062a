"""Operational modal analysis in a case: response to white noise, compared with the eigenanalysis.

The procedure of Rahman et al. (MECC 2025) for LC 2.3: accelerations at 13 nodes from the seabed to
the yaw bearing, frequency domain decomposition.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.analysis.modal import ModalResult
from offwind_pin.analysis.simulate import simulate
from offwind_pin.base.definition import Array
from offwind_pin.base.seeds import random_stream
from offwind_pin.cases.case import OperationalModesSettings
from offwind_pin.definitions.engine import Engine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.tower_top.load_history import LoadHistory
from offwind_pin.results.save_at import SaveAt
from offwind_pin.signal.modal_identification.identify import operational_modes
from offwind_pin.signal.modal_identification.modal_assurance import modal_assurance
from offwind_pin.solvers.steps import FixedStep

Progress = Callable[[float, float], None]

STEP = 0.02
"""s; generalised-alpha lengthens a period by (omega dt)^2 / 12, 0.2 % at 1.2 Hz."""
SETTLING = 200.0
"""s from the start on that are left out."""
FORCE, MOMENT = 20e3, 1e6
"""Standard deviations of Fx in N and My in N m at the yaw bearing. They are small enough for the
soil to stay linear; the moment excites the second mode, which rotates there but hardly moves."""
LABELS = ("FA1", "FA2")


def identify(
    system: System,
    modes: ModalResult,
    asked: OperationalModesSettings,
    seed: int,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Excite a system by white noise, identify its fore-aft modes, and compare.

    Returns
    -------
    Dataset
        Identified modes over the nodes, the computed ones (``computed_...``), and singular values
        over frequency.

    Raises
    ------
    InputError
        Modes that were not computed, or a record that is too short for the settings.
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
    identified = np.zeros((len(LABELS), asked.nodes))
    identified[:, moves] = found.shape
    shape = np.array([np.interp(height, modes.height, modes.shape[row, :, 0]) for row in rows])
    shape /= np.max(np.abs(shape), axis=1, keepdims=True)
    peak = np.array([_peak(row) for row in identified]) / (asked.nodes - 1)
    over: dict[str, tuple[Any, Array, str, str]] = {
        "frequency": ("mode", found.frequency_hz, "identified natural frequency", "Hz"),
        "damping_ratio": ("mode", found.damping_ratio, "identified damping ratio", "1"),
        "damping_scatter": (
            "mode",
            found.damping_scatter,
            "least standard deviation of a damping ratio from a record of this length",
            "1",
        ),
        "shape": (("mode", "height"), identified, "identified fore-aft shape, unit peak", "1"),
        "computed_frequency": ("mode", modes.frequency_hz[rows], "natural frequency", "Hz"),
        "computed_damping_ratio": ("mode", modes.damping_ratio[rows], "damping ratio", "1"),
        "computed_shape": (("mode", "height"), shape, "fore-aft mode shape, unit peak", "1"),
        "assurance": (
            "mode",
            modal_assurance(identified, shape).diagonal().copy(),
            "modal assurance of identified and computed shapes",
            "1",
        ),
        "peak_height_ratio": (
            "mode",
            peak,
            "height of the identified peak, mudline 0, yaw bearing 1",
            "1",
        ),
        "singular_value": (
            ("line", "number"),
            found.singular_values,
            "singular values of the cross-spectra of the accelerations",
            "(m/s2)2/Hz",
        ),
    }
    return xr.Dataset(
        {
            name: (dims, values, {"long_name": text, "units": unit})
            for name, (dims, values, text, unit) in over.items()
        },
        {
            "mode": ("mode", list(LABELS), {"long_name": "label of the mode"}),
            "height": ("height", height, {"long_name": "height of the node", "units": "m"}),
            "line": ("line", found.frequencies, {"long_name": "frequency", "units": "Hz"}),
        },
        {
            "record_s": asked.duration,
            "simulated_s": SETTLING + asked.duration,
            "seed": seed,
            "cautions": json.dumps(found.cautions),
        },
    )


def summarise_identified(data: xr.Dataset) -> dict[str, Any]:
    """Keys of the summary: one row per mode, and single values for comparison with published
    ones."""
    rows = [
        {
            "label": str(label),
            "frequency_hz": float(mode["frequency"]),
            "eigenanalysis_frequency_hz": float(mode["computed_frequency"]),
            "damping_ratio": float(mode["damping_ratio"]),
            "damping_scatter": float(mode["damping_scatter"]),
            "eigenanalysis_damping_ratio": float(mode["computed_damping_ratio"]),
            "modal_assurance": float(mode["assurance"]),
            "shape_peak_height_ratio": float(mode["peak_height_ratio"]),
        }
        for label, mode in ((label, data.sel(mode=label)) for label in data["mode"].to_numpy())
    ]
    single = {f"identified_{row['label']}_hz": row["frequency_hz"] for row in rows}
    single |= {
        f"identified_{row['label']}_peak_height_ratio": row["shape_peak_height_ratio"]
        for row in rows
    }
    return {
        "identified_modes": rows,
        "identification_cautions": json.loads(data.attrs["cautions"]),
        "seed": int(data.attrs["seed"]),
        **single,
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
    noise = random_stream(seed, "identification").normal(size=(steps + 1, 2))
    load[:, [0, 4]] = noise * [FORCE, MOMENT]
    time = np.linspace(0.0, steps * STEP, steps + 1)
    return simulate(
        system,
        steps * STEP,
        loads=[LoadHistory(time, load, f"white noise, seed {seed}")],
        ramp=20.0,
        # no numerical damping, which would be identified too
        integrator=GeneralizedAlpha(FixedStep(STEP), 1.0),
        engine=engine,
        save_at=SaveAt(heights=tuple(height.tolist()), segments=()),
        progress=None if progress is None else lambda now: progress(now, steps * STEP),
    )


def _peak(shape: Array) -> float:
    """Index of the node at the peak plus the offset of the vertex of a parabola, in node
    spacings."""
    at = int(np.argmax(shape))
    if at in (0, len(shape) - 1):
        return float(at)
    left, middle, right = shape[at - 1 : at + 2]
    return float(at + 0.5 * (left - right) / (left - 2 * middle + right))
