"""Hydrodynamic properties of members: coefficients, marine growth, water inside, buoyancy."""

from __future__ import annotations

import itertools
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Discriminator, Field, Tag, model_validator

from offwind_pin.base.definition import Array, Definition, Flag, NonNegative, Number, Positive

Height = Annotated[Number, Field(ge=-1000, le=1000)]
CoefficientValue = Annotated[NonNegative, Field(le=10)]
Values = Annotated[tuple[CoefficientValue, ...], Field(min_length=2)]


class CoefficientOverHeight(Definition):
    """Coefficient over height, linear in between, constant beyond both ends."""

    z: Annotated[tuple[Height, ...], Field(min_length=2)] = Field(alias="z_m")
    value: Values

    @model_validator(mode="after")
    def _table_is_complete(self) -> CoefficientOverHeight:
        _check_table("z_m", self.z, self.value)
        return self

    def at(self, height: Array, keulegan_carpenter: Array) -> Array:
        """(n,) coefficient at heights in m."""
        return np.interp(height, self.z, self.value)


class CoefficientOverKeuleganCarpenter(Definition):
    """Coefficient over the Keulegan-Carpenter number, linear in between, constant beyond."""

    keulegan_carpenter: Annotated[tuple[NonNegative, ...], Field(min_length=2)]
    value: Values

    @model_validator(mode="after")
    def _table_is_complete(self) -> CoefficientOverKeuleganCarpenter:
        _check_table("keulegan_carpenter", self.keulegan_carpenter, self.value)
        return self

    def at(self, height: Array, keulegan_carpenter: Array) -> Array:
        """(n,) coefficient at Keulegan-Carpenter numbers."""
        return np.interp(keulegan_carpenter, self.keulegan_carpenter, self.value)


def _check_table(name: str, place: tuple[float, ...], value: tuple[float, ...]) -> None:
    """Check the columns of a table.

    Raises
    ------
    ValueError
        Columns of different lengths, or positions that do not rise.
    """
    if len(place) != len(value):
        raise ValueError(
            f"{name} has {len(place)} entries and value {len(value)}; give one value per entry"
        )
    if np.any(np.diff(place) <= 0):
        raise ValueError(f"{name} must increase strictly; sort the table")


def _kind_of_coefficient(value: Any) -> str:
    if isinstance(value, CoefficientOverHeight):
        return "height"
    if isinstance(value, CoefficientOverKeuleganCarpenter):
        return "keulegan_carpenter"
    if isinstance(value, dict):
        return "keulegan_carpenter" if "keulegan_carpenter" in value else "height"
    return "constant"


Coefficient = Annotated[
    Annotated[CoefficientValue, Tag("constant")]
    | Annotated[CoefficientOverHeight, Tag("height")]
    | Annotated[CoefficientOverKeuleganCarpenter, Tag("keulegan_carpenter")],
    Discriminator(_kind_of_coefficient),
]
"""A plain number, ``{z_m, value}`` or ``{keulegan_carpenter, value}``."""


def coefficient_at(coefficient: Coefficient, height: Array, keulegan_carpenter: Array) -> Array:
    """(n,) coefficient at heights in m and Keulegan-Carpenter numbers."""
    if isinstance(coefficient, CoefficientOverHeight | CoefficientOverKeuleganCarpenter):
        return coefficient.at(height, keulegan_carpenter)
    return np.full(len(height), coefficient)


class MarineGrowth(Definition):
    """Layer of marine growth between two heights, on the outside of the wall.

    The default density is that of DNV's rules for offshore structures in the absence of data. The
    drag coefficient is that of the rough surface, by default the one without growth.
    """

    z: tuple[Height, Height] = Field(alias="z_m")
    thickness: Annotated[Positive, Field(le=1)] = Field(alias="thickness_m")
    density: Annotated[Positive, Field(ge=1000, le=3000)] = Field(
        alias="density_kg_per_m3", default=1325.0
    )
    drag_coefficient: CoefficientValue | None = None

    @model_validator(mode="after")
    def _has_height(self) -> MarineGrowth:
        if self.z[1] <= self.z[0]:
            raise ValueError(
                f"z_m runs from {self.z[0]} to {self.z[1]} m; give the lower end first"
            )
        return self

    @property
    def bottom(self) -> float:
        return self.z[0]

    @property
    def top(self) -> float:
        return self.z[1]


class SealedPile(Definition):
    """No water inside."""

    kind: Literal["sealed"]


class FloodedPile(Definition):
    """Water inside, from a plug (by default at the mudline) up to a level."""

    kind: Literal["flooded"]
    level: Height = Field(alias="level_m")
    plug: Height | None = Field(alias="plug_m", default=None)
    density: Annotated[Positive, Field(ge=900, le=1500)] | None = Field(
        alias="density_kg_per_m3", default=None
    )


Contents = Annotated[SealedPile | FloodedPile, Field(discriminator="kind")]


class Hydrodynamics(Definition):
    """Coefficients of Morison's equation and other hydrodynamic settings.

    Attributes
    ----------
    added_mass_coefficient, drag_coefficient : float or table
        Constant, over height, or over the Keulegan-Carpenter number.
    diffraction : {"none", "maccamy_fuchs"}
        Diffraction theory for the wave's inertia force.
    marine_growth : tuple of MarineGrowth
        Layers, from the lowest to the highest.
    contents : SealedPile or FloodedPile
        Content of the pile.
    buoyancy : bool
        Whether hydrostatic pressure acts on the walls.
    """

    added_mass_coefficient: Coefficient
    drag_coefficient: Coefficient
    diffraction: Literal["none", "maccamy_fuchs"] = "none"
    marine_growth: tuple[MarineGrowth, ...] = ()
    contents: Contents = SealedPile(kind="sealed")
    buoyancy: Flag = True

    @model_validator(mode="after")
    def _layers_rise(self) -> Hydrodynamics:
        for lower, upper in itertools.pairwise(self.marine_growth):
            if upper.bottom < lower.top:
                raise ValueError(
                    f"a layer of marine_growth begins at z_m = {upper.bottom}, below the top of "
                    f"the previous layer ({lower.top}); list layers from the lowest up, without "
                    "overlap"
                )
        return self

    @property
    def needs_keulegan_carpenter(self) -> bool:
        """Whether a coefficient depends on the Keulegan-Carpenter number."""
        given = (self.added_mass_coefficient, self.drag_coefficient)
        return any(isinstance(one, CoefficientOverKeuleganCarpenter) for one in given)

    def growth_at(self, height: Array) -> Array:
        """(n,) thickness of marine growth in m at heights; on a boundary of the upper layer."""
        thickness = np.zeros(len(height))
        for layer in self.marine_growth:
            thickness[(height >= layer.bottom) & (height < layer.top)] = layer.thickness
        return thickness

    def check_fits(self, mudline: float, top: float) -> None:
        """Check that marine growth and water inside are within the structure.

        Raises
        ------
        ValueError
            They are not.
        """
        for layer in self.marine_growth:
            if layer.bottom < mudline or layer.top > top:
                raise ValueError(
                    f"marine growth from z_m = {layer.bottom} to {layer.top} is not within the "
                    f"structure above the mudline, {mudline} to {top} m; correct its ends"
                )
        if isinstance(self.contents, FloodedPile):
            plug = mudline if self.contents.plug is None else self.contents.plug
            if not mudline <= plug < self.contents.level <= top:
                raise ValueError(
                    f"water inside from plug_m = {plug} to level_m = {self.contents.level} is not "
                    f"between the mudline and the top ({mudline} to {top} m); correct plug_m or "
                    "level_m"
                )
