"""Earthquake of a load case: files of one record, or of one record per level."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, Direction, File, NonNegative, Number, key
from offwind_pin.base.errors import InputError
from offwind_pin.loads.earthquake.ground_motion import Baseline, GroundMotion
from offwind_pin.loads.earthquake.records import (
    Accelerogram,
    Axis,
    Unit,
    read_at2_components,
    read_columns,
    unit_cautions,
)


class RecordFile(Definition):
    """One accelerogram: columns of a file, or AT2 files by axis."""

    file: File | None = None
    acceleration_unit: Unit | None = None
    components: Annotated[tuple[Axis, ...], Field(min_length=1, max_length=3)] | None = None
    at2: Annotated[dict[Axis, File], Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _one_record(self) -> RecordFile:
        self._check_files()
        return self

    def _check_files(self) -> None:
        if (self.file is None) == (self.at2 is None):
            raise ValueError(
                "file and at2 are both given, or neither is; give file (columns of numbers) or at2 "
                "(files by axis)"
            )
        if self.at2 is not None and (self.acceleration_unit or self.components):
            raise ValueError(
                "at2 files name their unit and are given by axis; leave acceleration_unit and "
                "components out"
            )
        if self.file is not None and not (self.acceleration_unit and self.components):
            raise ValueError(
                "the file's unit or axes are missing; give acceleration_unit (m_per_s2, cm_per_s2 "
                "or g) and components, the axes of the columns after the time, such as [x, y, z]"
            )

    def read(self) -> tuple[Accelerogram, list[str]]:
        """The record, and cautions about its unit."""
        if self.at2 is not None:
            record = read_at2_components(self.at2)
            return record, unit_cautions(record.acceleration, "g")
        if self.file is None or self.acceleration_unit is None or self.components is None:
            raise RuntimeError("a record without a file was not rejected")
        record = read_columns(self.file, self.acceleration_unit, self.components)
        return record, unit_cautions(record.acceleration, self.acceleration_unit)


class LevelRecord(RecordFile):
    """The accelerogram at a height."""

    z: Number = key("z_m")


class Earthquake(RecordFile):
    """Motion of the ground: one record, or one at each of several levels.

    Attributes
    ----------
    levels : tuple of LevelRecord or None
        Records by height, in place of a single one.
    scale : float
        Multiplier of the accelerations.
    direction_deg : float
        Angle in degrees from +x towards +y by which the record is rotated about z.
    start : float, s
        Simulated time of the record's time 0.
    baseline : {"none", "parabolic"}
        See :class:`GroundMotion`.
    """

    levels: Annotated[tuple[LevelRecord, ...], Field(min_length=2)] | None = None
    scale: Annotated[Number, Field(ge=-100, le=100)] = 1.0
    direction_deg: Direction = 0.0
    start: NonNegative = key("start_s", default=0.0)
    baseline: Baseline = "none"

    def _check_files(self) -> None:
        if self.levels is None:
            super()._check_files()
        elif self.file or self.at2 or self.acceleration_unit or self.components:
            raise ValueError("file and at2 cannot be combined with levels; give them in each level")
        if self.scale == 0:
            raise ValueError(
                "a scale of 0 removes the earthquake; leave the earthquake out instead"
            )

    def ground_motion(self) -> tuple[GroundMotion, list[str]]:
        """Ground motion, and cautions about the units.

        Raises
        ------
        InputError
            An invalid file, or levels with different times.
        """
        if self.levels is None:
            record, cautions = self.read()
            motion = GroundMotion(
                record.time, record.acceleration, None, self.baseline, record.origin
            )
        else:
            motion, cautions = self._by_level(self.levels)
        angle = np.radians(self.direction_deg)
        changed = motion.scaled(self.scale).later(self.start)
        return (changed.turned(angle) if angle else changed), cautions

    def _by_level(self, levels: tuple[LevelRecord, ...]) -> tuple[GroundMotion, list[str]]:
        rising = sorted(levels, key=lambda level: level.z)
        read = [level.read() for level in rising]
        first = read[0][0]
        for level, (record, _) in zip(rising, read, strict=True):
            same = len(record.time) == len(first.time)
            if not (same and np.allclose(record.time, first.time, rtol=0, atol=1e-9)):
                raise InputError(
                    f"earthquake, level z_m = {level.z:g}",
                    f"{len(record.time)} samples from {record.time[0]:g} to {record.time[-1]:g} s",
                    f"the times of the level below, {len(first.time)} samples from "
                    f"{first.time[0]:g} to {first.time[-1]:g} s",
                    "Resample the records at the same times.",
                )
        motion = GroundMotion(
            first.time,
            np.array([record.acceleration for record, _ in read]),
            np.array([level.z for level in rising]),
            self.baseline,
            "; ".join(f"z = {a.z:g} m: {r.origin}" for a, (r, _) in zip(rising, read, strict=True)),
        )
        return motion, [caution for _, found in read for caution in found]
