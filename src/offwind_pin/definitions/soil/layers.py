"""Layered ground: each layer with a published family of p-y curves and its own parameters.

Depths of layer tops and of profiles within a layer are measured from the original mudline, whatever
the scour.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args

import numpy as np
from pydantic import AfterValidator, Field, GetCoreSchemaHandler, model_validator
from pydantic_core import CoreSchema, core_schema

from offwind_pin.base.definition import Definition, NonNegative, Number, Positive
from offwind_pin.definitions.soil.depth_profile import DepthProfile
from offwind_pin.definitions.soil.pisa import CALIBRATIONS, PisaParameters
from offwind_pin.definitions.soil.ranges import (
    check_friction_angle,
    check_relative_density,
    check_rigidity,
    check_shear_modulus,
    check_strain_50,
    check_strength,
    check_unit_weight,
)

Strength = Annotated[DepthProfile, AfterValidator(check_strength)]
ShearModulus = Annotated[DepthProfile, AfterValidator(check_shear_modulus)]
Strain50 = Annotated[Positive, AfterValidator(check_strain_50)]

_JUDGED_THICKNESS = np.linspace(0.0, 10.0, 11)
"""Depths below a layer's top, in m, at which its stiffness and strength are compared."""


Loading = Literal["static", "cyclic"]


class SoilLayer(Definition):
    """A layer of the ground: base class of the package's layers and of your own.

    A subclass adds its parameters, and a field ``model`` whose ``Literal`` is the name in files.

    Attributes
    ----------
    model : str
        Name of the kind of layer.
    top : float, m
        Depth of the top below the original mudline.
    submerged_unit_weight : float, N/m3
    """

    model: str
    top: NonNegative = Field(alias="top_m")
    submerged_unit_weight: Annotated[Positive, AfterValidator(check_unit_weight)] = Field(
        alias="submerged_unit_weight_n_per_m3"
    )

    def check_loading(self, loading: Loading) -> None:
        """Reject a kind of loading to which the layer's curves do not apply.

        Parameters
        ----------
        loading : Loading
            Static or cyclic.

        Raises
        ------
        ValueError
            With the fault, a semicolon and the remedy.
        """


class ApiSand(SoilLayer):
    """Sand of API RP 2GEO: p = A p_u tanh(k z y / (A p_u)).

    ``initial_modulus`` is k, the rate of increase of the initial modulus with depth; by default it
    follows from the friction angle.
    """

    model: Literal["api_sand"]
    friction_angle: Annotated[Positive, AfterValidator(check_friction_angle)] = Field(
        alias="friction_angle_deg"
    )
    initial_modulus: Annotated[Positive, Field(ge=1e5, le=1e9)] | None = Field(
        alias="initial_modulus_n_per_m3", default=None
    )


class MatlockClay(SoilLayer):
    """Soft clay of Matlock (1970), as in API RP 2GEO."""

    model: Literal["matlock_clay"]
    undrained_shear_strength: Strength = Field(alias="undrained_shear_strength_pa")
    strain_50: Strain50
    j: Annotated[Number, Field(ge=0.25, le=0.5)] = Field(
        default=0.5, description="Matlock's J; 0.5 is his value for soft clay"
    )


class StiffClay(SoilLayer):
    """Stiff clay without free water, Reese and Welch (1975): p = p_u / 2 (y / y50)^(1/4)."""

    model: Literal["stiff_clay"]
    undrained_shear_strength: Strength = Field(alias="undrained_shear_strength_pa")
    strain_50: Strain50
    cycles: Annotated[Number, Field(ge=1, le=1e9)] | None = None

    def check_loading(self, loading: Loading) -> None:
        if (self.cycles is None) == (loading == "cyclic"):
            raise ValueError(
                f"a stiff_clay layer has cycles = {self.cycles} under {loading} loading; give "
                "cycles for cyclic loading, and leave it out for static loading"
            )


class Pisa(SoilLayer):
    """Soil reactions of the PISA project, for monotonic loading of monopiles.

    Clay requires the undrained shear strength, sand the relative density.
    """

    model: Literal["pisa"]
    calibration: Literal["cowden_till", "bothkennar_clay", "general_dunkirk_sand"] | None = None
    parameters: PisaParameters | None = None
    shear_modulus: ShearModulus = Field(alias="shear_modulus_pa")
    undrained_shear_strength: Strength | None = Field(
        alias="undrained_shear_strength_pa", default=None
    )
    relative_density: Annotated[Positive, AfterValidator(check_relative_density)] | None = None

    @model_validator(mode="after")
    def _complete(self) -> Pisa:
        if (self.calibration is None) == (self.parameters is None):
            raise ValueError(
                "a pisa layer requires one of calibration and parameters; give one of them "
                f"(calibrations: {', '.join(CALIBRATIONS)})"
            )
        needed, other = "undrained_shear_strength", "relative_density"
        if self.reactions.soil == "sand":
            needed, other = other, needed
        if getattr(self, needed) is None or getattr(self, other) is not None:
            keys = {"undrained_shear_strength": "undrained_shear_strength_pa"}
            raise ValueError(
                f"a pisa layer of {self.reactions.soil} requires {keys.get(needed, needed)} and "
                f"not {keys.get(other, other)}; give the former only"
            )
        if self.undrained_shear_strength is not None:
            depth = self.top + _JUDGED_THICKNESS
            check_rigidity(self.shear_modulus.at(depth), self.undrained_shear_strength.at(depth))
        return self

    def check_loading(self, loading: Loading) -> None:
        if loading == "cyclic":
            raise ValueError(
                "PISA's soil reactions are valid for monotonic loading only, but loading is "
                "cyclic; set loading: static, or use api_sand, matlock_clay or stiff_clay"
            )

    @property
    def reactions(self) -> PisaParameters:
        """The layer's parameters, published or its own."""
        if self.parameters is not None:
            return self.parameters
        return CALIBRATIONS[str(self.calibration)]


LAYER_KINDS: list[type[SoilLayer]] = [ApiSand, MatlockClay, StiffClay, Pisa]
"""Kinds of layers accepted in files and :class:`LayeredGround`; see ``register_layer``."""


class _OfKnownKind:
    """Selects the class of a layer by its ``model``."""

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        choices = {model_name(kind): handler(kind) for kind in LAYER_KINDS}
        return core_schema.tagged_union_schema(choices, discriminator="model")


def model_name(kind: type[SoilLayer]) -> str:
    """Name of a kind of layer in files."""
    return str(get_args(kind.model_fields["model"].annotation)[0])


class LayeredGround(Definition):
    """p-y curves from soil layers; a depth on a boundary belongs to the layer below."""

    kind: Literal["layers"]
    loading: Loading
    layers: tuple[Annotated[SoilLayer, _OfKnownKind()], ...]

    @model_validator(mode="after")
    def _layers_fit(self) -> LayeredGround:
        if not self.layers:
            raise ValueError("there are no layers; give at least one, with top_m = 0")
        tops = [layer.top for layer in self.layers]
        if tops[0] != 0:
            raise ValueError(
                f"the first layer starts at top_m = {tops[0]}; it must start at the mudline, "
                "top_m = 0"
            )
        if np.any(np.diff(tops) <= 0):
            raise ValueError(
                f"top_m of the layers are {tops}; they must increase strictly from the mudline down"
            )
        for layer in self.layers:
            layer.check_loading(self.loading)
        return self
