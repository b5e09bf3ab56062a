"""An earthquake as data: accelerogram, strength, and response spectra."""

from __future__ import annotations

import json
import logging
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.base.definition import Array
from offwind_pin.loads.earthquake.earthquake import Earthquake
from offwind_pin.loads.earthquake.ground_motion import GroundMotion, ground_motion_cautions
from offwind_pin.loads.earthquake.records import AXES
from offwind_pin.signal.response_spectrum import (
    arias_intensity,
    response_spectrum,
    significant_duration,
)

_log = logging.getLogger(__name__)

PERIODS = np.geomspace(0.05, 10.0, 200)
"""s, of the response spectrum that is drawn."""
DAMPING_RATIO = 0.05
"""Of the response spectrum; design codes use this ratio."""
MODES = 6
"""Modes whose spectral ordinates are listed."""

_PEAKS = {
    "peak_ground_displacement": "m",
    "peak_ground_velocity": "m/s",
    "peak_ground_acceleration": "m/s2",
}
_ORDINATES = {"displacement": "m", "pseudo_velocity": "m/s", "pseudo_acceleration": "m/s2"}


@dataclass(frozen=True, eq=False)
class CaseEarthquake:
    """An earthquake that acts in a case.

    Attributes
    ----------
    motion : GroundMotion
        Of the ground.
    cautions : list of str
        Possible faults of the record.
    gravity : float, m/s2
        For the Arias intensity.
    level : int
        Index of the reported level, the highest.
    """

    motion: GroundMotion
    cautions: list[str]
    gravity: float

    @staticmethod
    def of(earthquake: Earthquake, gravity: float, dt: float, duration: float) -> CaseEarthquake:
        """Read the earthquake of a case; cautions also go to the log.

        Raises
        ------
        InputError
            A record that cannot be used, or that begins after the end.
        """
        motion, cautions = earthquake.ground_motion()
        for caution in cautions:
            _log.warning("earthquake: %s", caution)
        cautions += ground_motion_cautions(motion, dt, duration)
        return CaseEarthquake(motion, cautions, gravity)

    @property
    def step(self) -> float:
        """Sampling interval in s: the record's own, or its smallest."""
        return float(np.min(np.diff(self.motion.time)))

    @property
    def sampled(self) -> Array:
        """(n, 3, 3) displacement, velocity, acceleration of the highest level, evenly sampled."""
        first, last = self.motion.time[[0, -1]]
        count = max(2, 1 + round((last - first) / self.step))
        return self.motion.motion(np.minimum(first + self.step * np.arange(count), last))[:, -1]


def earthquake_dataset(shaking: CaseEarthquake, modes: ModalResult) -> xr.Dataset:
    """The ground motion at its highest level, and its spectra at periods and natural modes."""
    values, step = shaking.sampled, shaking.step
    acceleration = values[:, 2]
    peak = np.max(np.abs(values), axis=0)
    label = modes.label[:MODES]
    whole = response_spectrum(acceleration, step, PERIODS, DAMPING_RATIO)
    at_modes = response_spectrum(acceleration, step, 1 / modes.frequency_hz[:MODES], DAMPING_RATIO)
    over: dict[str, tuple[Any, Array, str, str]] = {
        "acceleration": (
            ("time", "direction"),
            acceleration,
            "acceleration of the ground, scaled and corrected",
            "m/s2",
        ),
        "arias_intensity": (
            "direction",
            arias_intensity(acceleration, step, shaking.gravity),
            "Arias intensity",
            "m/s",
        ),
        "significant_duration": (
            "direction",
            np.array([significant_duration(acceleration[:, i], step) for i in range(3)]),
            "significant duration, 5 to 95 % of the Arias intensity",
            "s",
        ),
        "mode_period": ("mode", at_modes.period, "natural period of the mode", "s"),
    }
    for row, (name, unit) in zip(peak, _PEAKS.items(), strict=True):
        over[name] = ("direction", row, name.replace("_", " "), unit)
    for name, unit in _ORDINATES.items():
        text = f"{name.replace('_', ' ')} of the response spectrum"
        over[name] = (("period", "direction"), getattr(whole, name), text, unit)
        over[f"mode_{name}"] = (
            ("mode", "direction"),
            getattr(at_modes, name),
            f"{text} at the mode",
            unit,
        )
    time = shaking.motion.time[0] + step * np.arange(len(values))
    return xr.Dataset(
        {
            name: (dims, data, {"long_name": text, "units": unit})
            for name, (dims, data, text, unit) in over.items()
        },
        {
            "time": ("time", time, {"long_name": "simulated time", "units": "s"}),
            "period": ("period", whole.period, {"long_name": "undamped period", "units": "s"}),
            "direction": ("direction", list(AXES), {"long_name": "axis of the inertial frame"}),
            "mode": ("mode", label, {"long_name": "label of the mode"}),
        },
        {
            "origin": shaking.motion.origin,
            "baseline": shaking.motion.baseline,
            "cautions": json.dumps(shaking.cautions),
            "damping_ratio": DAMPING_RATIO,
        },
    )


def summarise_earthquake(data: xr.Dataset) -> dict[str, Any]:
    """For ``summary.json``: strength, and the spectrum at the natural periods."""
    units = {"m": "m", "m/s": "m_per_s", "m/s2": "m_per_s2"}
    return {
        "origin": data.attrs["origin"],
        "baseline": data.attrs["baseline"],
        "cautions": json.loads(data.attrs["cautions"]),
        **{f"{name}_{units[unit]}": _by_axis(data[name]) for name, unit in _PEAKS.items()},
        "arias_intensity_m_per_s": _by_axis(data["arias_intensity"]),
        "significant_duration_5_95_s": _by_axis(data["significant_duration"]),
        "response_spectrum_damping_ratio": float(data.attrs["damping_ratio"]),
        "response_spectrum_at_modes": [
            {
                "label": str(label),
                "period_s": float(data["mode_period"].sel(mode=label)),
                **{
                    f"{name}_{units[unit]}": _by_axis(data[f"mode_{name}"].sel(mode=label))
                    for name, unit in _ORDINATES.items()
                },
            }
            for label in data["mode"].to_numpy()
        ],
    }


def _by_axis(values: xr.DataArray) -> dict[str, float]:
    return {axis: float(values.sel(direction=axis)) for axis in AXES}
