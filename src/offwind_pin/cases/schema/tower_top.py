"""The load at the tower top of a load case: files, the synthetic one, a running rotor."""

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
    subtract_weight: Flag = False

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

    file: File

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
    file: File | None = None
    files: tuple[LoadFile, ...] = ()

    @model_validator(mode="after")
    def _one_or_many(self) -> TowerTopLoadFile:
        if (self.file is None) == (len(self.files) == 0):
            raise ValueError(
                "the load is given twice or not at all; give either file, or a list of files"
            )
        if self.files:
            given = [
                name
                for name, field in FileSettings.model_fields.items()
                if name != "source" and getattr(self, name) != field.default
            ]
            if given:
                raise ValueError(
                    f"{', '.join(given)} cannot be given beside files; give "
                    f"{', '.join(given)} to each of them"
                )
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
        return (LoadFile(file=self.file, **settings),)


class OpenFastLoad(TowerTopLoadFile):
    """The same, every file being OpenFAST's output whatever its name."""

    kind: Literal["openfast_output"]  # type: ignore[assignment]

    def reads_openfast(self, entry: LoadFile) -> bool:
        return True


TowerTopLoadChoice = Annotated[
    SyntheticWind | TowerTopLoadFile | OpenFastLoad | RotorLoad,
    Field(discriminator="kind"),
]
