"""The tower-top load of a load case: files, a synthetic load, or an operating rotor."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from offwind_pin.base.definition import Definition, File, Flag, Number
from offwind_pin.formats.openfast.output import SUFFIXES
from offwind_pin.loads.wind.rotor_load import RotorLoad
from offwind_pin.loads.wind.synthetic_thrust import SyntheticWind

Component = Literal["Fx", "Fy", "Fz", "Mx", "My", "Mz"]
_OPENFAST_ONLY = ("channels", "frame", "azimuth_channel")


class FileSettings(Definition):
    """How a load file is read and changed.

    channels : names by component, the others zero; by default all six of the frame
    frame : point and axes of an OpenFAST file's load
    factor, shift : multiplier and delay of the load
    subtract_weight : whether to remove the weight of rotor and nacelle, which yaw bearing loads
    include
    """

    channels: Annotated[dict[Component, str], Field(min_length=1)] | None = None
    frame: Literal["yaw_bearing", "rotor_apex"] = "yaw_bearing"
    azimuth_channel: str | None = None
    factor: Annotated[Number, Field(ge=-1e6, le=1e6)] = 1.0
    shift: Annotated[Number, Field(ge=-1e5, le=1e5)] = Field(alias="shift_s", default=0.0)
    subtract_weight: Flag = False

    @model_validator(mode="after")
    def _means_something(self) -> FileSettings:
        if self.factor == 0:
            raise ValueError("a factor of 0 removes the load; leave tower_top_load out instead")
        if self.frame == "rotor_apex" and self.subtract_weight:
            raise ValueError(
                "a load at the rotor_apex is aerodynamic and does not include the weight; leave "
                "subtract_weight out"
            )
        if self.frame == "yaw_bearing" and self.azimuth_channel is not None:
            raise ValueError("azimuth_channel applies to frame rotor_apex only; leave it out")
        return self


class LoadFile(FileSettings):
    """One file; a relative path starts at the case file."""

    file: File

    @property
    def is_openfast(self) -> bool:
        """Whether the name is that of OpenFAST output."""
        return self.file.suffix.lower() in SUFFIXES


class TowerTopLoadFile(FileSettings):
    """Files of loads over time, which are summed.

    Seven columns t, Fx, Fy, Fz, Mx, My, Mz, or OpenFAST's output where a file is named ``.out`` or
    ``.outb``.
    """

    kind: Literal["file"]
    file: File | None = None
    files: tuple[LoadFile, ...] = ()

    @model_validator(mode="after")
    def _one_or_many(self) -> TowerTopLoadFile:
        if (self.file is None) == (len(self.files) == 0):
            raise ValueError("file and files are both given, or neither is; give one of them")
        if self.files:
            given = [
                name
                for name, field in FileSettings.model_fields.items()
                if name != "source" and getattr(self, name) != field.default
            ]
            if given:
                raise ValueError(
                    f"{', '.join(given)} cannot be combined with files; set "
                    f"{', '.join(given)} in each entry of files"
                )
        for entry in self.entries:
            needless = [
                key for key in _OPENFAST_ONLY if getattr(entry, key) not in (None, "yaw_bearing")
            ]
            if needless and not self.reads_openfast(entry):
                raise ValueError(
                    f"{', '.join(needless)} has no effect on {entry.file}, a file of seven "
                    "columns; it applies to OpenFAST output (.out, .outb, or kind "
                    "openfast_output)"
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
        return (LoadFile(file=self.file, **settings),)


class OpenFastLoad(TowerTopLoadFile):
    """The same, with every file read as OpenFAST output whatever its name."""

    kind: Literal["openfast_output"]  # type: ignore[assignment]

    def reads_openfast(self, entry: LoadFile) -> bool:
        return True


TowerTopLoadChoice = Annotated[
    SyntheticWind | TowerTopLoadFile | OpenFastLoad | RotorLoad,
    Field(discriminator="kind"),
]
