"""The load at the tower top as a case file gives it: files, the synthetic one, a running rotor."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, NonNegative, Number, Positive
from offwind_pin.formats.openfast.output import SUFFIXES
from offwind_pin.loads.wind.rotor_effective_wind import normal_turbulence
from offwind_pin.loads.wind.rotor_thrust import CONTROL_TIME, Control

Component = Literal["Fx", "Fy", "Fz", "Mx", "My", "Mz"]
_OPENFAST_ONLY = ("channels", "frame", "azimuth_channel")


class SyntheticTowerTopLoad(Definition):
    """The package's own generator; see :class:`SyntheticWind`."""

    kind: Literal["synthetic"]
    wind_speed: Annotated[Positive, Field(ge=1, le=25)] = Field(alias="wind_speed_m_per_s")
    blade_passing_frequency: Annotated[Positive, Field(le=5)] = Field(
        alias="blade_passing_frequency_hz"
    )
    turbulence_intensity: Annotated[NonNegative, Field(le=1)] = 0.10


class FileSettings(Definition):
    """What is done to a load file.

    channels : names by component, others being zero; by default all six of the frame
    frame : where an OpenFAST file's load acts, and in which axes
    factor, shift : the load is multiplied and comes later
    subtract_weight : of rotor and nacelle, which loads on the yaw bearing hold
    """

    channels: Annotated[dict[Component, str], Field(min_length=1)] | None = None
    frame: Literal["yaw_bearing", "rotor_apex"] = "yaw_bearing"
    azimuth_channel: str | None = None
    factor: Annotated[Number, Field(ge=-1e6, le=1e6)] = 1.0
    shift: Annotated[Number, Field(ge=-1e5, le=1e5)] = Field(alias="shift_s", default=0.0)
    subtract_weight: bool = False

    @model_validator(mode="after")
    def _means_something(self) -> FileSettings:
        if self.factor == 0:
            raise ValueError("a factor of 0 leaves no load; leave tower_top_load out instead")
        if self.frame == "rotor_apex" and self.subtract_weight:
            raise ValueError(
                "a load at the rotor_apex is aerodynamic and holds no weight; leave "
                "subtract_weight out"
            )
        if self.frame == "yaw_bearing" and self.azimuth_channel is not None:
            raise ValueError("azimuth_channel is for frame rotor_apex; leave it out")
        return self


class LoadFile(FileSettings):
    """One file; a relative path starts at the case file."""

    file: Path

    @property
    def is_openfast(self) -> bool:
        """By its name."""
        return self.file.suffix.lower() in SUFFIXES


class TowerTopLoadFile(FileSettings):
    """Files of loads over time, which are added up.

    Seven columns t, Fx, Fy, Fz, Mx, My, Mz, or OpenFAST's output where a file is named ``.out`` or
    ``.outb``.
    """

    kind: Literal["file"]
    file: Path | None = None
    files: tuple[LoadFile, ...] = ()

    @model_validator(mode="after")
    def _one_or_many(self) -> TowerTopLoadFile:
        if (self.file is None) == (len(self.files) == 0):
            raise ValueError("give either file, or a list of files")
        if self.files:
            given = self.model_fields_set & FileSettings.model_fields.keys() - {"source"}
            if given:
                raise ValueError(f"with files, give {', '.join(sorted(given))} to each of them")
        for entry in self.entries:
            needless = [
                key for key in _OPENFAST_ONLY if getattr(entry, key) not in (None, "yaw_bearing")
            ]
            if needless and not self.reads_openfast(entry):
                raise ValueError(
                    f"{entry.file} has seven columns; {', '.join(needless)} is for OpenFAST's "
                    "output (.out, .outb, or kind openfast_output)"
                )
        return self

    def reads_openfast(self, entry: LoadFile) -> bool:
        """Whether an entry is read as OpenFAST's output."""
        return entry.is_openfast

    @property
    def entries(self) -> tuple[LoadFile, ...]:
        """Every file with what is done to it."""
        if self.file is None:
            return self.files
        settings = {name: getattr(self, name) for name in FileSettings.model_fields}
        return (LoadFile.model_construct(file=self.file, **settings),)


class OpenFastLoad(TowerTopLoadFile):
    """The same, every file being OpenFAST's output whatever its name."""

    kind: Literal["openfast_output"]  # type: ignore[assignment]

    def reads_openfast(self, entry: LoadFile) -> bool:
        return True


class RotorLoad(Definition):
    """Thrust of the turbine's own rotor in a turbulent wind: ``RotorThrust`` in ``RotorWind``."""

    kind: Literal["rotor"]
    wind_speed: Annotated[Positive, Field(ge=1, le=60)] = Field(alias="wind_speed_m_per_s")
    turbulence_class: Literal["A", "B", "C"] | None = None
    turbulence_intensity: Annotated[NonNegative, Field(le=1)] | None = None
    shear_exponent: Annotated[NonNegative, Field(le=1)] = 0.14
    tower_shadow: bool = True
    control: Control = "lagged"
    control_time: Annotated[Positive, Field(le=1000)] = Field(
        alias="control_time_s", default=CONTROL_TIME
    )
    inflow_lag: bool = False

    @model_validator(mode="after")
    def _one_turbulence(self) -> RotorLoad:
        if (self.turbulence_class is None) == (self.turbulence_intensity is None):
            raise ValueError("give either turbulence_class (A, B or C) or turbulence_intensity")
        return self

    @property
    def intensity(self) -> float:
        """Standard deviation of the wind over its mean."""
        if self.turbulence_class is None:
            return float(self.turbulence_intensity or 0.0)
        return normal_turbulence(self.wind_speed, self.turbulence_class) / self.wind_speed


TowerTopLoadChoice = Annotated[
    SyntheticTowerTopLoad | TowerTopLoadFile | OpenFastLoad | RotorLoad,
    Field(discriminator="kind"),
]
