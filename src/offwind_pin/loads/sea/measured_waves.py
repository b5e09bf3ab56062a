"""A measured surface, reproduced by linear theory."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from offwind_pin.base.definition import Direction, File, NonNegative, key
from offwind_pin.base.errors import InputError
from offwind_pin.loads.sea.sea import LinearSea
from offwind_pin.loads.sea.waves.linear import LinearWaves
from offwind_pin.loads.sea.waves.spectra import WaveFrequency
from offwind_pin.loads.sea.waves.statistics import moments, peak_frequency
from offwind_pin.loads.sea.waves.surface_record import (
    RecordHarmonics,
    SurfaceRecord,
    read_surface_record,
)
from offwind_pin.loads.sea.waves.warnings import irregular_wave_cautions
from offwind_pin.loads.sea.waves.wave_field import WaveField

MOST_LEFT_OUT = 0.05
"""Fraction of the record's variance outside the cuts above which a caution is given."""


def _file_or_samples(value: Any) -> str:
    samples = isinstance(value, SurfaceRecord) or (isinstance(value, dict) and "path" not in value)
    return "samples" if samples else "file"


RecordChoice = Annotated[
    Annotated[SurfaceRecord, Tag("samples")] | Annotated[File, Tag("file")],
    Discriminator(_file_or_samples),
]


class MeasuredWaves(LinearSea, kw_only=False):
    """Long-crested linear waves whose surface at the axis is a record between two frequencies.

    Attributes
    ----------
    record : SurfaceRecord or Path
        A file, see :func:`read_surface_record`, or samples, see :meth:`SurfaceRecord.of`.
    low_cut, high_cut : float, Hz
        Band in which the record is treated as free linear waves. Below are tides and bound waves,
        above noise and bound waves, whose decay with depth linear theory would make too slow or too
        fast.
    direction_deg : float
        Direction of travel in degrees from +x towards +y.
    taper : float or None, s
        Length of the taper at each end; by default a hundredth of the record.
    """

    kind: Literal["measured_waves"] = Field(default="measured_waves", kw_only=True)
    order: Literal[1] = Field(default=1, kw_only=True)
    record: RecordChoice = key("file")
    low_cut: WaveFrequency = key("low_cut_hz")
    high_cut: WaveFrequency = key("high_cut_hz")
    direction_deg: Direction = 0.0
    taper: NonNegative | None = key("taper_s", default=None)

    @model_validator(mode="after")
    def _samples_fit(self) -> Self:
        if isinstance(self.record, SurfaceRecord):
            fault = self._fault_of_settings(self.record)
            if fault is not None:
                raise ValueError(f"{fault[0]} is {fault[1]}, allowed: {fault[2]}; {fault[3]}")
        return self

    @cached_property
    def samples(self) -> SurfaceRecord:
        """The record.

        Raises
        ------
        InputError
            An invalid file, or settings that do not fit its content.
        """
        if isinstance(self.record, SurfaceRecord):
            return self.record
        record = read_surface_record(self.record)
        fault = self._fault_of_settings(record)
        if fault is not None:
            name, received, allowed, remedy = fault
            remedy = f"{remedy[:1].upper()}{remedy[1:]}."
            raise InputError(f"{self.record}, with {name}", received, allowed, remedy)
        return record

    def _fault_of_settings(self, record: SurfaceRecord) -> tuple[str, object, str, str] | None:
        """Name, value, allowed values and remedy of a setting that does not fit a record."""
        nyquist = 0.5 / record.dt
        if not self.high_cut < nyquist:
            allowed = f"below {nyquist:.4g} Hz, half the record's sampling frequency"
            return "high_cut", self.high_cut, allowed, "lower it"
        if self.high_cut * record.duration < self.low_cut * record.duration + 5:
            received = f"{self.low_cut:g} to {self.high_cut:g} Hz"
            allowed = "a band of five harmonics of the record or more"
            return "low_cut and high_cut", received, allowed, "widen it"
        longest = record.duration / 2
        if self.taper is not None and self.taper > longest:
            return "taper", self.taper, f"0 to half the record ({longest:g} s)", "shorten it"
        return None

    @property
    def main_period(self) -> float:
        found, duration = self.harmonics, self.samples.duration
        square = np.abs(found.elevation) ** 2
        return 1 / peak_frequency(found.harmonic / duration, square, duration)

    @property
    def marked_frequency(self) -> None:
        return None

    @property
    def longest_time(self) -> float:
        return self.samples.duration

    @cached_property
    def harmonics(self) -> RecordHarmonics:
        """Harmonics of the record between its cuts, tapered at its ends."""
        return self.samples.harmonics(self.low_cut, self.high_cut, self.taper)

    def linear(self, depth: float, gravity: float) -> LinearWaves:
        found, record = self.harmonics, self.samples
        if not np.any(found.elevation):
            received = f"no variance from {self.low_cut:g} to {self.high_cut:g} Hz"
            allowed = "a band that contains waves"
            raise InputError("sea, fields low_cut and high_cut", received, allowed, "Widen it.")
        angle = float(np.radians(self.direction_deg))
        return self.free_waves(
            record.duration, found.harmonic, found.elevation, depth, gravity, angle
        )

    def notes(self) -> list[str]:
        found, record = self.harmonics, self.samples
        start = []
        if record.start != 0:
            start.append(f"the record's first time, {record.start:g} s, is time 0")
        return [
            *start,
            f"a mean of {found.mean:.3g} m and a trend of {found.trend:.3g} m over the record were "
            "removed; use water_level_m for a tide",
            f"both ends of the record are tapered over {found.fade:.3g} s so that it can repeat",
            f"{100 * found.left_out:.2g} % of the variance, below {self.low_cut:g} and above "
            f"{self.high_cut:g} Hz, was removed",
        ]

    def cautions(self, waves: WaveField) -> list[str]:
        texts, left_out = super().cautions(waves), self.harmonics.left_out
        if self.samples.resampled:
            texts.append(
                "the record is not evenly sampled; it is interpolated linearly at steps of "
                f"{self.samples.dt:g} s, which attenuates its short waves"
            )
        if left_out > MOST_LEFT_OUT:
            texts.append(
                f"the cuts at {self.low_cut:g} and {self.high_cut:g} Hz remove "
                f"{100 * left_out:.2g} % of the record's variance"
            )
        state = moments(waves)
        return texts + irregular_wave_cautions(
            state.significant_height,
            state.peak_period,
            waves.depth,
            waves.gravity,
            wind_sea=False,
        )

    @property
    def in_words(self) -> str:
        source = self.samples.origin.split(" (SHA-256")[0]
        band = f"from {self.low_cut:g} to {self.high_cut:g} Hz"
        return f"measured waves, {source}, {band}{self.theory_in_words}"
