"""A load case as data: turbine, foundation, sea, loads, analysis, and published values."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, ValidationInfo, model_validator

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.base.definition import (
    Definition,
    Integer,
    NonNegative,
    Number,
    Positive,
    Seed,
    key,
)
from offwind_pin.base.input_files import is_file
from offwind_pin.cases.schema.tower_top import TowerTopLoadChoice
from offwind_pin.cases.shipped import shipped_cases
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.engine import Engine
from offwind_pin.definitions.reader import find_definition, load_turbine, read_definition
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.earthquake import Earthquake
from offwind_pin.loads.load_definition import LoadDefinition
from offwind_pin.loads.sea.sea import DrySea, Sea
from offwind_pin.loads.sea.seas import SeaChoice
from offwind_pin.loads.wind.tower_drag import TowerWind
from offwind_pin.solvers.steps import MOST_OUTPUTS
from offwind_pin.structure.chain import MOST_ELEMENTS


def _known_foundation(name: str) -> str:
    if name not in FOUNDATIONS:
        raise ValueError(f"{name!r} is not a foundation; choose one of {', '.join(FOUNDATIONS)}")
    return name


def _load_turbine(value: Any, info: ValidationInfo) -> Any:
    """A turbine by shipped name or file; paths are relative to the folder of the case file."""
    if not isinstance(value, str | Path):
        return value
    local = Path((info.context or {}).get("folder", "")) / value
    return load_turbine(local if is_file(local) else value)


FoundationName = Annotated[str, AfterValidator(_known_foundation)]
TurbineChoice = Annotated[Turbine, BeforeValidator(_load_turbine)]
"""A turbine, or in a file also a shipped name or the path of a turbine file."""
ElementCount = Annotated[Integer, Field(ge=1, le=MOST_ELEMENTS)]


_COARSEST_OUTPUT = 0.3
"""s; the highest band of interest ends at 1.5 Hz."""


class StaticAnalysis(Definition):
    """Equilibrium under gravity, optionally compared with that on another foundation.

    settle : for how long the undeformed structure is followed in time as it comes to rest under
        gravity, beside the direct solution; or None
    engine : what evaluates the equations of motion
    """

    kind: Literal["static"]
    engine: Engine = "compiled"
    compare_with: FoundationName | None = None
    settle: Annotated[Positive, Field(ge=10, le=1e5)] | None = key("settle_s", default=None)


class OperationalModesSettings(Definition):
    """A record of accelerations under white noise, and the settings that identify modes in it.

    duration : of the record; the damping ratio of a mode scatters by 1 / sqrt(2 pi zeta f T) of
        itself at least
    segment : of Welch's method
    nodes : from the mudline to the yaw bearing
    """

    duration: Annotated[Positive, Field(ge=600, le=1e5)] = key("duration_s")
    segment: Annotated[Positive, Field(ge=20)] = key("segment_s")
    nodes: Annotated[Integer, Field(ge=3, le=60)] = 13

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

    identify : settings of an operational modal analysis of the fore-aft modes, or None
    engine : what evaluates the equations of motion
    """

    kind: Literal["modes"]
    engine: Engine = "compiled"
    count: Annotated[Integer, Field(ge=1, le=50)] = 8
    identify: OperationalModesSettings | None = None


class TransientAnalysis(Definition):
    """Time histories, and the spectrum of the fore-aft moment at the mudline after the ramp.

    engine : what evaluates the equations of motion
    """

    kind: Literal["transient"]
    engine: Engine = "compiled"
    duration: Annotated[Positive, Field(le=1e5)] = key("duration_s")
    ramp: NonNegative = key("ramp_s")
    dt: Annotated[Positive, Field(ge=1e-5, le=1)] = key("dt_s")
    output_dt: Positive = key("output_dt_s")
    psd_segment: Positive = key("psd_segment_s")

    @model_validator(mode="after")
    def _window_holds_a_segment(self) -> TransientAnalysis:
        if self.ramp >= self.duration:
            raise ValueError(
                f"ramp_s = {self.ramp} is not shorter than duration_s = {self.duration}; shorten it"
            )
        if self.duration / self.output_dt > MOST_OUTPUTS:
            raise ValueError(
                f"output_dt_s = {self.output_dt} gives more than {MOST_OUTPUTS:.3g} outputs in "
                f"duration_s = {self.duration}; lengthen it"
            )
        if self.output_dt > _COARSEST_OUTPUT:
            raise ValueError(
                f"output_dt_s = {self.output_dt} is too coarse for the PSD sum up to 1.5 Hz; use "
                f"{_COARSEST_OUTPUT} or less"
            )
        if self.psd_segment < 10 * self.output_dt:
            raise ValueError(
                f"psd_segment_s = {self.psd_segment} contains fewer than ten samples; lengthen it"
            )
        if self.psd_segment > self.duration - self.ramp - self.output_dt:
            raise ValueError(
                f"psd_segment_s = {self.psd_segment} is longer than the analysed "
                f"{self.duration - self.ramp - self.output_dt} s; shorten it or lengthen duration_s"
            )
        return self


class PublishedValue(Definition):
    """A published value, and the key of the computed one in the summary."""

    quantity: str
    key: str
    value: Number
    unit: str


class Case(Definition):
    """One load case: what a case file contains.

    Attributes
    ----------
    name : str
        Short name, used in file names.
    title, description : str
        For the report.
    turbine : Turbine
        In a file also a shipped name or a path.
    foundation : str
        Name of a kind of foundation.
    sea : Sea or DrySea
        Sea state, or ``DrySea()`` for none.
    tower_top_load : TowerTopLoadFile, OpenFastLoad, SyntheticWind, RotorLoad or None
        Load at the tower top.
    tower_wind : TowerWind or None
        Wind on the tower.
    earthquake : Earthquake or None
        Motion of the ground.
    analysis : StaticAnalysis, ModalAnalysis or TransientAnalysis
        What is solved.
    seed : int
        Seed of everything random that has no seed of its own.
    elements : int, dict of str to int, or None
        As for :func:`offwind_pin.build`.
    element : {"euler_bernoulli", "timoshenko"}
        As for :func:`offwind_pin.build`.
    published : tuple of PublishedValue
        Values to compare results with.
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9._-]+$")]
    title: str = ""
    description: str = ""
    turbine: TurbineChoice
    foundation: FoundationName
    sea: SeaChoice
    tower_top_load: TowerTopLoadChoice | None = None
    tower_wind: TowerWind | None = None
    earthquake: Earthquake | None = None
    analysis: Annotated[
        StaticAnalysis | ModalAnalysis | TransientAnalysis, Field(discriminator="kind")
    ]
    seed: Seed = 1
    elements: ElementCount | dict[str, ElementCount] | None = None
    element: Element = "euler_bernoulli"
    published: tuple[PublishedValue, ...] = ()

    @model_validator(mode="after")
    def _loads_have_an_effect(self) -> Case:
        if isinstance(self.analysis, TransientAnalysis):
            return self
        loads = {
            "tower_top_load": self.tower_top_load is not None,
            "earthquake": self.earthquake is not None,
            self.sea.kind: isinstance(self.sea, Sea) and self.sea.has_waves,
            **dict.fromkeys(self.loads, True),
        }
        given = [name for name, is_there in loads.items() if is_there]
        if given:
            raise ValueError(
                f"analysis kind {self.analysis.kind} does not use {', '.join(given)}; leave them "
                "out, or use kind transient"
            )
        return self

    @property
    def loads(self) -> dict[str, LoadDefinition]:
        """Loads that make themselves for a structure, by their keys."""
        given = {name: getattr(self, name) for name in type(self).model_fields}
        return {name: load for name, load in given.items() if isinstance(load, LoadDefinition)}

    @property
    def water(self) -> Sea | None:
        """The sea with the case's seed and length; None for a dry structure."""
        if isinstance(self.sea, DrySea):
            return None
        analysis = self.analysis
        duration = analysis.duration if isinstance(analysis, TransientAnalysis) else 0.0
        return self.sea.completed(self.seed, duration)

    def with_seed(self, seed: int) -> Case:
        """The same case with one seed for everything random.

        Separate seeds of waves and wind are dropped.

        Parameters
        ----------
        seed : int
            Seed of all random numbers.

        Returns
        -------
        Case

        Raises
        ------
        InputError
            An invalid seed.
        """
        parts = {name: getattr(self, name) for name in type(self).model_fields}
        reseeded = {
            name: part.replace(seed=None)
            for name, part in parts.items()
            if isinstance(part, Definition) and getattr(part, "seed", None) is not None
        }
        return self.replace(seed=seed, **reseeded)

    def build(self, foundation: str | None = None) -> System:
        """The case's system, on its own foundation or on another.

        Parameters
        ----------
        foundation : str, optional
            Another kind of foundation than the case's own.

        Returns
        -------
        System

        Raises
        ------
        InputError
            A part of the turbine or of the sea that cannot be used.
        """
        name = self.foundation if foundation is None else foundation
        made = FOUNDATIONS[name].make(self.turbine)
        elements = self.elements
        if isinstance(elements, dict) and not made.soil:  # no pile to divide
            elements = {region: count for region, count in elements.items() if region != "pile"}
        return build(self.turbine, made, self.water, elements=elements, element=self.element)


def load_case(name_or_path: str | Path) -> Case:
    """A case by shipped name or from a YAML file; relative paths in it start at its folder.

    Parameters
    ----------
    name_or_path : str or Path
        Name of a shipped case, or path of a YAML file.

    Returns
    -------
    Case

    Raises
    ------
    InputError
        An unknown name, or a file that cannot be read or is not a valid case.
    """
    path = find_definition(name_or_path, shipped_cases(), "case")
    return read_definition(path, Case)
