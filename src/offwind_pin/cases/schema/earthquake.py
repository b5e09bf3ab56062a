"""An earthquake as a case file gives it, what acts, and what is told about it."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from offwind_pin.base.definition import Array, Definition, NonNegative, Number
from offwind_pin.base.errors import InputError
from offwind_pin.loads.earthquake.ground_motion import (
    Baseline,
    GroundMotion,
    ground_motion_cautions,
)
from offwind_pin.loads.earthquake.records import (
    Accelerogram,
    Axis,
    Unit,
    read_at2_components,
    read_columns,
    unit_cautions,
)

_log = logging.getLogger(__name__)


class RecordFile(Definition):
    """One accelerogram: columns of a file, or AT2 files by axis."""

    file: Path | None = None
    acceleration_unit: Unit | None = None
    components: Annotated[tuple[Axis, ...], Field(min_length=1, max_length=3)] | None = None
    at2: Annotated[dict[Axis, Path], Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _one_record(self) -> RecordFile:
        self._check_files()
        return self

    def _check_files(self) -> None:
        if (self.file is None) == (self.at2 is None):
            raise ValueError("give either file (columns of numbers) or at2 (files by axis)")
        if self.at2 is not None and (self.acceleration_unit or self.components):
            raise ValueError("at2 files are in g, by axis; leave acceleration_unit and components")
        if self.file is not None and not (self.acceleration_unit and self.components):
            raise ValueError(
                "a file needs its acceleration_unit (m_per_s2, cm_per_s2 or g) and components, the "
                "axes of its columns after the time's, such as [x, y, z]"
            )

    def read(self, folder: Path) -> tuple[Accelerogram, list[str]]:
        """The record, its relative paths starting at a folder, and cautions about its unit."""
        if self.at2 is not None:
            paths: dict[Axis, Path] = {axis: folder / path for axis, path in self.at2.items()}
            record = read_at2_components(paths)
            return record, unit_cautions(record.acceleration, "g")
        if self.file is None or self.acceleration_unit is None or self.components is None:
            raise RuntimeError("a record without a file was not refused")
        record = read_columns(folder / self.file, self.acceleration_unit, self.components)
        return record, unit_cautions(record.acceleration, self.acceleration_unit)


class LevelRecord(RecordFile):
    """The accelerogram at a height."""

    z: Number = Field(alias="z_m")


class Earthquake(RecordFile):
    """Motion of the ground: one record, or one at each of several levels.

    scale : multiplies accelerations; direction : the record is turned about z, in degrees from x
    towards y; start : when the record's time 0 is; baseline : see :class:`GroundMotion`
    """

    levels: Annotated[tuple[LevelRecord, ...], Field(min_length=2)] | None = None
    scale: Annotated[Number, Field(ge=-100, le=100)] = 1.0
    direction: Annotated[Number, Field(ge=-360, le=360)] = Field(alias="direction_deg", default=0.0)
    start: NonNegative = Field(alias="start_s", default=0.0)
    baseline: Baseline = "none"

    def _check_files(self) -> None:
        if self.levels is None:
            super()._check_files()
        elif self.file or self.at2 or self.acceleration_unit or self.components:
            raise ValueError("with levels, give file or at2 to each of them")
        if self.scale == 0:
            raise ValueError("a scale of 0 leaves no earthquake; leave it out instead")

    def ground_motion(self, folder: Path) -> tuple[GroundMotion, list[str]]:
        """What moves the ground, and cautions about the units.

        Raises
        ------
        InputError : a file that cannot be used, or levels that differ in their times
        """
        if self.levels is None:
            record, cautions = self.read(folder)
            motion = GroundMotion(
                record.time, record.acceleration, None, self.baseline, record.origin
            )
        else:
            motion, cautions = self._by_level(self.levels, folder)
        angle = np.radians(self.direction)
        changed = motion.scaled(self.scale).later(self.start)
        return (changed.turned(angle) if angle else changed), cautions

    def _by_level(
        self, levels: tuple[LevelRecord, ...], folder: Path
    ) -> tuple[GroundMotion, list[str]]:
        rising = sorted(levels, key=lambda level: level.z)
        read = [level.read(folder) for level in rising]
        first = read[0][0]
        for level, (record, _) in zip(rising, read, strict=True):
            same = len(record.time) == len(first.time)
            if not (same and np.allclose(record.time, first.time, rtol=0, atol=1e-9)):
                raise InputError(
                    f"earthquake, level z_m = {level.z:g}",
                    f"{len(record.time)} samples from {record.time[0]:g} to {record.time[-1]:g} s",
                    f"the times of the level below: {len(first.time)} samples from "
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
    def of(
        earthquake: Earthquake, folder: Path, gravity: float, dt: float, duration: float
    ) -> Shaking:
        """Read what a case asks for; cautions go to the log as well, by here and by the simulation.

        Raises
        ------
        InputError : a record that cannot be used, or that begins after the end
        """
        motion, cautions = earthquake.ground_motion(folder)
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
