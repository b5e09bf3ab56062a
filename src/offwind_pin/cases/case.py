"""A load case as data: turbine, foundation, sea, load, analysis, and what others published."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, model_validator

from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.base.definition import Definition, NonNegative, Number, Positive
from offwind_pin.cases.schema.earthquake import Earthquake
from offwind_pin.cases.schema.sea import SeaChoice
from offwind_pin.cases.schema.tower_top import TowerTopLoadChoice
from offwind_pin.cases.schema.tower_wind import TowerWindChoice
from offwind_pin.cases.shipped import shipped_cases
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.engine import Engine
from offwind_pin.definitions.reader import find_definition, read_model
from offwind_pin.structure.chain import MOST_ELEMENTS


def _known_foundation(name: str) -> str:
    if name not in FOUNDATIONS:
        raise ValueError(f"{name!r} is no foundation; choose one of {', '.join(FOUNDATIONS)}")
    return name


FoundationName = Annotated[str, AfterValidator(_known_foundation)]


_COARSEST_OUTPUT = 0.3
"""s; the highest band of interest ends at 1.5 Hz."""


class StaticAnalysis(Definition):
    """Equilibrium under gravity, if asked for beside that on another foundation.

    settle : for how long the undeformed structure is followed in time as it comes to rest under
        gravity, beside the direct solution; or None
    engine : what evaluates the equations of motion
    """

    kind: Literal["static"]
    engine: Engine = "compiled"
    compare_with: FoundationName | None = None
    settle: Annotated[Positive, Field(ge=10, le=1e5)] | None = Field(alias="settle_s", default=None)


class OperationalModesSettings(Definition):
    """A record of accelerations under white noise, and how modes are taken out of it.

    duration : of the record; the damping ratio of a mode scatters by 1 / sqrt(2 pi zeta f T) of
        itself at least
    segment : of Welch's method
    nodes : from the mudline to the yaw bearing
    """

    duration: Annotated[Positive, Field(ge=600, le=1e5)] = Field(alias="duration_s")
    segment: Annotated[Positive, Field(ge=20)] = Field(alias="segment_s")
    nodes: Annotated[int, Field(ge=3, le=60)] = 13

    @model_validator(mode="after")
    def _holds_segments(self) -> OperationalModesSettings:
        if self.segment > self.duration / 4:
            raise ValueError(
                f"segment_s = {self.segment} is longer than a quarter of duration_s = "
                f"{self.duration}; shorten it"
            )
        return self


class ModalAnalysis(Definition):
    """Natural modes about the static state under gravity.

    identify : whether the fore-aft modes are taken out of accelerations as well
    engine : what evaluates the equations of motion
    """

    kind: Literal["modes"]
    engine: Engine = "compiled"
    count: Annotated[int, Field(ge=1, le=50)] = 8
    identify: OperationalModesSettings | None = None


class TransientAnalysis(Definition):
    """Time histories, and the spectrum of the fore-aft moment at the mudline after the ramp.

    engine : what evaluates the equations of motion
    """

    kind: Literal["transient"]
    engine: Engine = "compiled"
    duration: Annotated[Positive, Field(le=1e5)] = Field(alias="duration_s")
    ramp: NonNegative = Field(alias="ramp_s")
    dt: Annotated[Positive, Field(le=1)] = Field(alias="dt_s")
    output_dt: Positive = Field(alias="output_dt_s")
    psd_segment: Positive = Field(alias="psd_segment_s")

    @model_validator(mode="after")
    def _window_holds_a_segment(self) -> TransientAnalysis:
        if self.ramp >= self.duration:
            raise ValueError(
                f"ramp_s = {self.ramp} leaves nothing of duration_s = {self.duration}; shorten it"
            )
        if self.output_dt > _COARSEST_OUTPUT:
            raise ValueError(
                f"output_dt_s = {self.output_dt} is too coarse for the PSD sum up to 1.5 Hz; use "
                f"{_COARSEST_OUTPUT} or less"
            )
        if self.psd_segment < 10 * self.output_dt:
            raise ValueError(
                f"psd_segment_s = {self.psd_segment} holds fewer than ten samples; lengthen it"
            )
        if self.psd_segment > self.duration - self.ramp - self.output_dt:
            raise ValueError(
                f"psd_segment_s = {self.psd_segment} is longer than the analysed "
                f"{self.duration - self.ramp - self.output_dt} s; shorten it or lengthen duration_s"
            )
        return self


class PublishedValue(Definition):
    """A number that others published, and the key of ours in the summary."""

    quantity: str
    key: str
    value: Number
    unit: str


class Case(Definition):
    """One load case."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9._-]+$")]
    title: str = ""
    description: str = ""
    turbine: str
    foundation: FoundationName
    sea: SeaChoice
    tower_top_load: TowerTopLoadChoice | None = None
    tower_wind: TowerWindChoice | None = None
    earthquake: Earthquake | None = None
    analysis: Annotated[
        StaticAnalysis | ModalAnalysis | TransientAnalysis, Field(discriminator="kind")
    ]
    seed: Annotated[int, Field(ge=0, lt=2**31)] = 1
    elements: Annotated[int, Field(ge=1, le=MOST_ELEMENTS)] | dict[str, int] | None = None
    element: Element = "euler_bernoulli"
    published: tuple[PublishedValue, ...] = ()

    @model_validator(mode="after")
    def _loads_have_an_effect(self) -> Case:
        if self.analysis.kind == "transient":
            return self
        loads = {
            "tower_top_load": self.tower_top_load is not None,
            "tower_wind": self.tower_wind is not None,
            "earthquake": self.earthquake is not None,
            self.sea.kind: self.sea.has_waves,
        }
        given = [name for name, is_there in loads.items() if is_there]
        if given:
            raise ValueError(
                f"a {self.analysis.kind} analysis does not take {', '.join(given)}; leave them "
                "out, or use analysis kind transient"
            )
        return self


def load_case(name_or_path: str | Path) -> tuple[Case, Path]:
    """A case by shipped name or from a YAML file, and the folder its relative paths start from.

    Raises
    ------
    InputError : the name is unknown, or the file cannot be read or understood
    """
    path = find_definition(name_or_path, shipped_cases(), "case")
    return read_model(path, Case), path.parent
