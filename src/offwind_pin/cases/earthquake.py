"""The earthquake of a case: what acts, and what summary and report say about it."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from typing import Any

import numpy as np

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.base.definition import Array
from offwind_pin.display.wording import number
from offwind_pin.loads.earthquake.description import EarthquakeDescription
from offwind_pin.loads.earthquake.earthquake import Earthquake
from offwind_pin.loads.earthquake.ground_motion import GroundMotion, ground_motion_cautions
from offwind_pin.loads.earthquake.records import AXES
from offwind_pin.signal.response_spectrum import (
    ResponseSpectrum,
    arias_intensity,
    response_spectrum,
    significant_duration,
)

_log = logging.getLogger(__name__)

PERIODS = np.geomspace(0.05, 10.0, 200)
"""s, of the response spectrum that is drawn."""
DAMPING_RATIO = 0.05
"""Of the response spectrum; the ratio that codes print theirs for."""
MODES_TOLD = 6


@dataclass(frozen=True, eq=False)
class Shaking:
    """An earthquake that acts in a case.

    Attributes
    ----------
    motion : of the ground
    cautions : what looks wrong with it
    gravity : in m/s2, for the Arias intensity
    level : that is reported, the highest
    """

    motion: GroundMotion
    cautions: list[str]
    gravity: float

    @staticmethod
    def of(earthquake: Earthquake, gravity: float, dt: float, duration: float) -> Shaking:
        """Read what a case asks for; cautions go to the log as well, by here and by the simulation.

        Raises
        ------
        InputError : a record that cannot be used, or that begins after the end
        """
        motion, cautions = earthquake.ground_motion()
        for caution in cautions:
            _log.warning("earthquake: %s", caution)
        cautions += ground_motion_cautions(motion, dt, duration)
        return Shaking(motion, cautions, gravity)

    @property
    def step(self) -> float:
        """Interval in s at which the record is looked at: its own, or its smallest."""
        return float(np.min(np.diff(self.motion.time)))

    @property
    def sampled(self) -> Array:
        """(n, 3, 3) displacement, velocity, acceleration of the highest level, evenly sampled."""
        first, last = self.motion.time[[0, -1]]
        count = max(2, 1 + round((last - first) / self.step))
        return self.motion.motion(np.minimum(first + self.step * np.arange(count), last))[:, -1]

    def spectrum(self, period: Array = PERIODS) -> ResponseSpectrum:
        """Response spectrum (p, 3) of the three components, 5 % damped."""
        return response_spectrum(self.sampled[:, 2], self.step, period, DAMPING_RATIO)

    def summary(self, found: ModalResult) -> dict[str, Any]:
        """For ``summary.json``: how strong it is, and its spectrum at the structure's periods."""
        values = self.sampled
        peak = np.max(np.abs(values), axis=0)
        names = ("displacement_m", "velocity_m_per_s", "acceleration_m_per_s2")
        intensity = arias_intensity(values[:, 2], self.step, self.gravity)
        ordinates = self.spectrum(1 / found.frequency_hz[:MODES_TOLD])
        return {
            "origin": self.motion.origin,
            "baseline": self.motion.baseline,
            "cautions": self.cautions,
            **{f"peak_ground_{name}": _by_axis(row) for name, row in zip(names, peak, strict=True)},
            "arias_intensity_m_per_s": _by_axis(intensity),
            "significant_duration_5_95_s": {
                axis: significant_duration(values[:, 2, i], self.step)
                for i, axis in enumerate(AXES)
            },
            "response_spectrum_damping_ratio": DAMPING_RATIO,
            "response_spectrum_at_modes": [
                {
                    "label": label,
                    "period_s": float(ordinates.period[i]),
                    "displacement_m": _by_axis(ordinates.displacement[i]),
                    "pseudo_velocity_m_per_s": _by_axis(ordinates.pseudo_velocity[i]),
                    "pseudo_acceleration_m_per_s2": _by_axis(ordinates.pseudo_acceleration[i]),
                }
                for i, label in enumerate(found.label[:MODES_TOLD])
            ],
        }

    def description(self, found: ModalResult) -> EarthquakeDescription:
        """For the report."""
        values = self.sampled
        time = self.motion.time[0] + self.step * np.arange(len(values))
        peak = np.max(np.abs(values), axis=0)
        intensity = arias_intensity(values[:, 2], self.step, self.gravity)
        periods = 1 / found.frequency_hz[:MODES_TOLD]
        return EarthquakeDescription(
            time,
            values[:, 2],
            self.spectrum(),
            dict(zip(found.label, periods.tolist(), strict=False)),
            (
                ("largest acceleration x, y, z", _listed(peak[2], "m/s²")),
                ("largest velocity x, y, z", _listed(peak[1], "m/s")),
                ("largest displacement x, y, z", _listed(peak[0], "m")),
                ("Arias intensity x, y, z", _listed(intensity, "m/s")),
                ("baseline", self.motion.baseline),
                ("record", self.motion.origin),
                *(("caution", text) for text in self.cautions),
            ),
        )


def _listed(values: Array, unit: str) -> str:
    return f"{', '.join(number(value, 3) for value in values)} {unit}"


def _by_axis(values: Array) -> dict[str, float]:
    return {axis: float(value) for axis, value in zip(AXES, values, strict=True)}
