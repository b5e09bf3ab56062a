"""A measured surface, replayed by linear theory."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from offwind_pin.base.errors import InputError
from offwind_pin.loads.sea.sea import LinearSea, require_angle
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import require_positive
from offwind_pin.loads.sea.waves.statistics import moments, peak_frequency
from offwind_pin.loads.sea.waves.surface_record import (
    RecordHarmonics,
    SurfaceRecord,
    read_surface_record,
)
from offwind_pin.loads.sea.waves.warnings import irregular_wave_cautions
from offwind_pin.loads.sea.waves.wave_field import WaveField

MOST_LEFT_OUT = 0.05
"""Of the record's variance, beyond which cuts are told of as a caution."""


@dataclass(frozen=True)
class MeasuredWaves(LinearSea):
    """Long-crested linear waves whose surface at the axis is a record between two frequencies.

    record : from a file by :meth:`read`, or made by :meth:`SurfaceRecord.of`
    low_cut, high_cut : in Hz, between which the record is taken for free linear waves; below lie
        tides and bound waves, above noise and bound waves again, which linear theory would let
        decay too slowly, or too fast, with depth
    direction_deg : in which they travel, from +x towards +y
    taper : in s, over which each end fades; by default a hundredth of the record
    """

    record: SurfaceRecord
    low_cut: float
    high_cut: float
    direction_deg: float = 0.0
    taper: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.order != 1:
            raise InputError(
                "waves, field order",
                self.order,
                "1 for a measured surface, which holds the waves of second order already",
                "Leave it out.",
            )
        for name in ("low_cut", "high_cut"):
            require_positive(f"waves, field {name}", getattr(self, name))
        nyquist = 0.5 / self.record.dt
        if not self.high_cut < nyquist:
            allowed = f"below {nyquist:.4g} Hz, half the record's sampling frequency"
            raise InputError("waves, field high_cut", self.high_cut, allowed, "Lower it.")
        if self.high_cut * self.record.duration < self.low_cut * self.record.duration + 5:
            received = f"{self.low_cut:g} to {self.high_cut:g} Hz"
            allowed = "a band of five harmonics of the record or more"
            raise InputError("waves, fields low_cut and high_cut", received, allowed, "Widen it.")
        longest = self.record.duration / 2
        if self.taper is not None and not 0 <= self.taper <= longest:
            allowed = f"0 to half the record ({longest:g} s)"
            raise InputError("waves, field taper", self.taper, allowed, "Shorten it.")
        require_angle(self.direction_deg)

    @staticmethod
    def read(path: Path | str, low_cut: float, high_cut: float, **settings: Any) -> MeasuredWaves:
        """From a file of times in s and elevations in m, see :func:`read_surface_record`."""
        record = read_surface_record(Path(path))
        return MeasuredWaves(record, low_cut, high_cut, **settings)

    @property
    def main_period(self) -> float:
        found, duration = self._harmonics, self.record.duration
        square = np.abs(found.elevation) ** 2
        return 1 / peak_frequency(found.harmonic / duration, square, duration)

    @property
    def longest_time(self) -> float:
        return self.record.duration

    @cached_property
    def _harmonics(self) -> RecordHarmonics:
        return self.record.harmonics(self.low_cut, self.high_cut, self.taper)

    def linear(self, depth: float, gravity: float) -> LinearWaves:
        found = self._harmonics
        if not np.any(found.elevation):
            received = f"no variance from {self.low_cut:g} to {self.high_cut:g} Hz"
            allowed = "a band that holds waves"
            raise InputError("waves, fields low_cut and high_cut", received, allowed, "Widen it.")
        angle = float(np.radians(self.direction_deg))
        return self.free_waves(
            self.record.duration, found.harmonic, found.elevation, depth, gravity, angle
        )

    def notes(self) -> list[str]:
        found, record = self._harmonics, self.record
        told = []
        if record.start != 0:
            told.append(f"the record's first time, {record.start:g} s, is time 0")
        return [
            *told,
            f"a mean of {found.mean:.3g} m and a trend of {found.trend:.3g} m over the record are "
            "taken off; a tide is given as water level",
            f"the record's ends fade over {found.fade:.3g} s each, so that it may repeat",
            f"below {self.low_cut:g} and above {self.high_cut:g} Hz {100 * found.left_out:.2g} % "
            "of the variance is left out",
        ]

    def cautions(self, waves: WaveField) -> list[str]:
        told, lost = super().cautions(waves), self._harmonics.left_out
        if self.record.resampled:
            told.append(
                "the record's times are not evenly spaced; it is interpolated linearly at steps "
                f"of {self.record.dt:g} s, which flattens its short waves"
            )
        if lost > MOST_LEFT_OUT:
            told.append(
                f"the cuts at {self.low_cut:g} and {self.high_cut:g} Hz leave out "
                f"{100 * lost:.2g} % of the record's variance"
            )
        state = moments(waves)
        return told + irregular_wave_cautions(
            state.significant_height,
            state.peak_period,
            waves.depth,
            waves.gravity,
            wind_sea=False,
        )

    @property
    def in_words(self) -> str:
        source = self.record.origin.split(" (SHA-256")[0]
        told = f"waves measured, {source}, from {self.low_cut:g} to {self.high_cut:g} Hz"
        return f"{told}, carried by the current" if self.doppler else told
