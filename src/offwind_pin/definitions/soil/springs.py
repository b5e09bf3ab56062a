"""Soil of a foundation: springs at the mudline, or curves along the pile.

Depths of linear, tanh and tabulated curves are measured from the actual mudline, so that scour
moves the weak top curves down; those of layers from the original one (see ``layers``).
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator

from offwind_pin.base.definition import (
    Array,
    Definition,
    File,
    Integer,
    NonNegative,
    Positive,
    Vector6,
)
from offwind_pin.definitions.soil.depth_profile import DepthProfile
from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.ranges import check_skin_friction


class CoupledSprings(Definition):
    """6x6 stiffness of pile and soil at the mudline, order x, y, z, rx, ry, rz (N, m, rad).

    It refers to the unscoured mudline.
    """

    stiffness: tuple[Vector6, Vector6, Vector6, Vector6, Vector6, Vector6]

    @model_validator(mode="after")
    def _positive_definite(self) -> CoupledSprings:
        matrix = np.array(self.stiffness)
        if not np.allclose(matrix, matrix.T, rtol=1e-9, atol=1e-9 * np.abs(matrix).max()):
            raise ValueError("the 6x6 stiffness is not symmetric; give the same value at ij and ji")
        if np.linalg.eigvalsh(matrix)[0] <= 0:
            raise ValueError(
                "the 6x6 stiffness is not positive definite; check the signs of the coupling terms "
                "(x-ry negative, y-rx positive)"
            )
        # A pile head rotates in the direction of the force: no pile has the opposite signs.
        if matrix[0, 4] > 0 or matrix[1, 3] < 0:
            raise ValueError(
                f"coupling terms x-ry = {matrix[0, 4]:g} N and y-rx = {matrix[1, 3]:g} N would "
                "rotate the pile head against the force; make x-ry negative and y-rx positive"
            )
        return self


class LinearModulus(Definition):
    """p = k y, with the modulus k in N/m per m of pile."""

    kind: Literal["linear"]
    modulus: DepthProfile = Field(alias="modulus_n_per_m2")


class TanhCurve(Definition):
    """p = p_u tanh(k y / p_u), initial modulus k in N/m2, ultimate resistance p_u in N/m."""

    kind: Literal["tanh"]
    initial_modulus: DepthProfile = Field(alias="initial_modulus_n_per_m2")
    ultimate_resistance: DepthProfile = Field(alias="ultimate_resistance_n_per_m")


class CurveTable(Definition):
    """p-y curves by depth from a CSV file with columns ``depth_m, y_m, p_n_per_m``.

    Curves are not interpolated across ``boundaries``; a depth on a boundary belongs to the layer
    below.
    """

    kind: Literal["table"]
    file: File
    boundaries: tuple[Positive, ...] = Field(alias="boundaries_m", default=())

    @model_validator(mode="after")
    def _boundaries_rise(self) -> CurveTable:
        if np.any(np.diff(self.boundaries) <= 0):
            raise ValueError(
                f"boundaries_m are {list(self.boundaries)}; they must increase strictly from the "
                "mudline down"
            )
        return self


class ShaftTable(Definition):
    """t-z curves by depth from a CSV file with columns ``depth_m, z_m, t_n_per_m``."""

    kind: Literal["table"]
    file: File


class _ShaftFriction(Definition):
    """Skin friction mobilised along the shaft, API RP 2GEO.

    ``residual_ratio`` is the fraction of the peak that remains in clay beyond z = 0.02 D.
    """

    kind: Literal["api"]
    soil: Literal["sand", "clay"]
    skin_friction: Annotated[DepthProfile, AfterValidator(check_skin_friction)] = Field(
        alias="skin_friction_pa"
    )
    residual_ratio: Annotated[Positive, Field(ge=0.7, le=1)] | None = None

    @model_validator(mode="after")
    def _residual_in_clay(self) -> _ShaftFriction:
        if (self.residual_ratio is None) == (self.soil == "clay"):
            raise ValueError(
                f"residual_ratio is {self.residual_ratio} in {self.soil}; give it for clay (API: "
                "0.7 to 0.9), and leave it out for sand"
            )
        return self


class ApiShaft(_ShaftFriction):
    """t-z curves of API RP 2GEO."""


class LinearTorsion(Definition):
    """Torque per length k theta, with k in N m/m per rad."""

    kind: Literal["linear"]
    stiffness: DepthProfile = Field(alias="stiffness_nm_per_m_per_rad")


class TanhTorsion(Definition):
    """Torque per length T_u tanh(k theta / T_u)."""

    kind: Literal["tanh"]
    initial_stiffness: DepthProfile = Field(alias="initial_stiffness_nm_per_m_per_rad")
    ultimate_torque: DepthProfile = Field(alias="ultimate_torque_nm_per_m")


class TorsionTable(Definition):
    """Curves by depth from a CSV file with columns ``depth_m, twist_rad, torque_nm_per_m``."""

    kind: Literal["table"]
    file: File


class ApiTorsion(_ShaftFriction):
    """The t-z curves of API RP 2GEO for torsion: the wall moves by twist times radius."""


class LinearBearing(Definition):
    """Q = K z at the toe."""

    kind: Literal["linear"]
    stiffness: Positive = Field(alias="stiffness_n_per_m")


class TanhBearing(Definition):
    """Q = Q_u tanh(K z / Q_u) at the toe."""

    kind: Literal["tanh"]
    initial_stiffness: Positive = Field(alias="initial_stiffness_n_per_m")
    ultimate_resistance: Positive = Field(alias="ultimate_resistance_n")


class BearingTable(Definition):
    """Q-z curve from a CSV file with columns ``z_m, q_n``."""

    kind: Literal["table"]
    file: File


class ApiBearing(Definition):
    """Q-z curve of API RP 2GEO; the end bearing acts on ``area``, or on pi D^2 / 4."""

    kind: Literal["api"]
    # API's largest value, 12 MPa in very dense sand, is 12000 in kPa.
    end_bearing: Annotated[Positive, Field(ge=1.5e4, le=1e8)] = Field(alias="end_bearing_pa")
    area: Positive | None = Field(alias="area_m2", default=None)


LateralCurve = LinearModulus | TanhCurve | CurveTable | LayeredGround
VerticalCurve = LinearModulus | TanhCurve | ShaftTable | ApiShaft
TorsionalCurve = LinearTorsion | TanhTorsion | TorsionTable | ApiTorsion
BearingCurve = LinearBearing | TanhBearing | BearingTable | ApiBearing


DampingFactor = Annotated[NonNegative, Field(le=2)]


class DampingCurve(Definition):
    """Damping factor over displacement, linear in log y, constant beyond both ends."""

    displacement: Annotated[tuple[Positive, ...], Field(min_length=2)] = Field(
        alias="displacement_m"
    )
    factor: Annotated[tuple[DampingFactor, ...], Field(min_length=2)]

    @model_validator(mode="after")
    def _table_is_complete(self) -> DampingCurve:
        if len(self.displacement) != len(self.factor):
            raise ValueError(
                f"displacement_m has {len(self.displacement)} entries and factor "
                f"{len(self.factor)}; give one factor per displacement"
            )
        if np.any(np.diff(self.displacement) <= 0):
            raise ValueError("displacement_m must increase strictly; sort the table")
        return self

    def at(self, displacement: Array) -> Array:
        """Factor at displacements y >= 0 in m."""
        smallest = self.displacement[0]
        y = np.log(np.maximum(displacement, smallest))
        return np.interp(y, np.log(self.displacement), self.factor)


class SoilDashpot(Definition):
    """Dashpot parallel to each spring: C_s = K_s damping_factor / (pi load_frequency).

    K_s is the secant stiffness at the spring's displacement, or the initial stiffness, which gives
    a constant dashpot. The factor is a number, or varies with the displacement.
    """

    stiffness: Literal["secant", "initial"] = "secant"
    damping_factor: Annotated[
        Annotated[DampingFactor, Tag("number")] | Annotated[DampingCurve, Tag("curve")],
        Discriminator(
            lambda value: "curve" if isinstance(value, dict | DampingCurve) else "number"
        ),
    ]
    load_frequency: Annotated[Positive, Field(le=100)] = Field(alias="load_frequency_hz")

    @model_validator(mode="after")
    def _constant_is_constant(self) -> SoilDashpot:
        if self.stiffness == "initial" and isinstance(self.damping_factor, DampingCurve):
            raise ValueError(
                "a dashpot with stiffness: initial is constant, but damping_factor varies with "
                "displacement; give a number, or stiffness: secant"
            )
        return self


class Hysteresis(Definition):
    """Springs as parallel Iwan sliders, which follow the curves and Masing's rules."""

    sliders: Annotated[Integer, Field(ge=4, le=200)]


class DistributedSprings(Definition):
    """Springs along the pile: lateral ones at every node, others optional.

    The pile must be restrained vertically and in torsion, by a stiffness at the toe or by curves.
    """

    nodes: Annotated[Integer, Field(ge=2, le=2000)]
    curve: Annotated[LateralCurve, Field(discriminator="kind")]
    vertical: Annotated[VerticalCurve, Field(discriminator="kind")] | None = None
    torsional: Annotated[TorsionalCurve, Field(discriminator="kind")] | None = None
    toe_bearing: Annotated[BearingCurve, Field(discriminator="kind")] | None = None
    toe_vertical_stiffness: NonNegative = Field(alias="toe_vertical_stiffness_n_per_m", default=0.0)
    toe_torsional_stiffness: NonNegative = Field(
        alias="toe_torsional_stiffness_nm_per_rad", default=0.0
    )
    dashpot: SoilDashpot | None = None
    hysteretic: Hysteresis | None = None
    surrogate: str | None = Field(
        default=None, description="why these curves replace the real ones; shown everywhere"
    )

    @model_validator(mode="after")
    def _pile_is_held(self) -> DistributedSprings:
        if not self.toe_vertical_stiffness and self.vertical is None and self.toe_bearing is None:
            raise ValueError(
                "nothing restrains the pile vertically; give toe_vertical_stiffness_n_per_m, "
                "vertical or toe_bearing"
            )
        if not self.toe_torsional_stiffness and self.torsional is None:
            raise ValueError(
                "nothing restrains the pile in torsion; give toe_torsional_stiffness_nm_per_rad or "
                "torsional"
            )
        return self

    @model_validator(mode="after")
    def _damped_once(self) -> DistributedSprings:
        if self.hysteretic and self.dashpot and self.dashpot.stiffness == "secant":
            raise ValueError(
                "hysteretic springs dissipate energy themselves, and a secant dashpot would "
                "count the same loss twice; leave the dashpot out, or give it stiffness: initial"
            )
        return self


StiffnessSource = Literal["coupled_springs", "distributed_springs"]
"""Source of a stiffness at the mudline: given, or condensed from the unloaded springs."""


class ApparentFixity(Definition):
    """A cantilever that replaces pile and soil, with equal displacement and rotation at the
    mudline.

    They are equal under a horizontal load at ``load_arm`` above the mudline, by default at the yaw
    bearing. ``stiffness_from`` is by default the 6x6, if given.
    """

    stiffness_from: StiffnessSource | None = None
    load_arm: NonNegative | None = Field(alias="load_arm_m", default=None)


class MacroElementCalibration(Definition):
    """A monotonic loading of the mudline to which a macro-element is calibrated.

    It is a pushover of the distributed springs by a load at ``load_arm`` above the mudline, by
    default at the yaw bearing, up to ``until_displacement``, by default a tenth of the diameter.
    Alternatively it is read from a CSV ``file`` with columns ``horizontal_load_n, displacement_m,
    rotation_rad``; the moment is then the load times the arm, and the 6x6 that of coupled_springs.
    """

    surfaces: Annotated[Integer, Field(ge=5, le=200)] = 40
    load_arm: NonNegative | None = Field(alias="load_arm_m", default=None)
    until_displacement: Positive | None = Field(alias="until_displacement_m", default=None)
    file: File | None = None

    @model_validator(mode="after")
    def _one_path(self) -> MacroElementCalibration:
        if self.file is not None and self.until_displacement is not None:
            raise ValueError("until_displacement_m has no effect with file; leave it out")
        return self


class Soil(Definition):
    """Descriptions of the same ground, one per kind of foundation."""

    coupled_springs: CoupledSprings | None = None
    distributed_springs: DistributedSprings | None = None
    apparent_fixity: ApparentFixity | None = None
    macro_element: MacroElementCalibration | None = None
