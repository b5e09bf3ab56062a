"""Definition of a turbine and its site, in SI units.

Keys in files have units (``diameter_m``), names in Python do not (``diameter``). Axes: x downwind,
y left looking downwind, z up from still water level.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import Annotated, Literal

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from offwind_pin.base.definition import (
    Definition,
    Integer,
    NonNegative,
    Number,
    Positive,
    Vector3,
)
from offwind_pin.base.descriptions import html_table
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.hydrodynamics import Height, Hydrodynamics
from offwind_pin.definitions.rotor import GEOMETRY, Rotor
from offwind_pin.definitions.section import Section
from offwind_pin.definitions.soil.springs import Soil
from offwind_pin.definitions.structural_damping import StructuralDamping, with_kind
from offwind_pin.definitions.tuned_mass_damper import TunedMassDamper

Angle = Annotated[Number, Field(ge=-30, le=30)]

_KEPT_NAMES = {"base", "mono", "pile", "rna", "root", "world"}
"""Names reserved for parts of the chain."""
_KEPT_BEGINNING = "zz"
"""Prefix of joints that must come last in the alphabet; see
:mod:`offwind_pin.structure.tuned_mass`."""


class Material(Definition):
    """Isotropic linear material."""

    youngs_modulus: Annotated[Positive, Field(ge=1e6, le=1e13)] = Field(alias="youngs_modulus_pa")
    shear_modulus: Annotated[Positive, Field(ge=1e6, le=1e13)] = Field(alias="shear_modulus_pa")
    density: Annotated[Positive, Field(ge=100, le=25e3)] = Field(alias="density_kg_per_m3")


class Station(Definition):
    """Circular hollow section at one height; between stations both numbers vary linearly."""

    z: Height = Field(alias="z_m")
    diameter: Annotated[Positive, Field(ge=1e-3, le=50)] = Field(alias="diameter_m")
    thickness: Annotated[Positive, Field(ge=1e-5, le=1)] = Field(alias="thickness_m")

    @model_validator(mode="after")
    def _wall_fits(self) -> Station:
        if self.thickness > self.diameter / 2:
            raise ValueError(
                f"the wall thickness {self.thickness} m is larger than the radius "
                f"{self.diameter / 2} m; thickness must not exceed half the diameter"
            )
        return self


class Member(Definition):
    """Part of the support structure between its lowest and highest station."""

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
    material: str
    stations: Annotated[tuple[Station, ...], Field(min_length=2)]

    @model_validator(mode="after")
    def _stations_rise(self) -> Member:
        heights = [station.z for station in self.stations]
        for lower, upper in itertools.pairwise(heights):
            if upper == lower:
                raise ValueError(
                    f"two stations are at z_m = {upper}; start another member there for a step of "
                    "diameter or wall thickness, or remove one of the two"
                )
            if upper < lower:
                raise ValueError(
                    f"stations must increase strictly in z_m, but {upper} follows {lower}; "
                    "sort them from the lowest to the highest"
                )
        return self

    @property
    def bottom(self) -> float:
        return self.stations[0].z

    @property
    def top(self) -> float:
        return self.stations[-1].z


class PointMass(Definition):
    """Mass on the axis of the structure (flange, platform, transition piece)."""

    name: str
    z: Height = Field(alias="z_m")
    mass: NonNegative = Field(alias="mass_kg")
    inertia: tuple[NonNegative, NonNegative, NonNegative] = Field(
        alias="inertia_kg_m2", default=(0.0, 0.0, 0.0)
    )

    @model_validator(mode="after")
    def _round(self) -> PointMass:
        if self.inertia[0] != self.inertia[1]:
            raise ValueError(
                f"inertia_kg_m2 has {self.inertia[0]} about x and {self.inertia[1]} about y; "
                "give the same value twice, since bodies of the chain are axisymmetric"
            )
        return self


class RigidBodyRNA(Definition):
    """Rotor-nacelle assembly as one rigid body; offsets from the yaw bearing."""

    kind: Literal["rigid_body"]
    mass: Positive = Field(alias="mass_kg")
    center_of_mass: Vector3 = Field(alias="center_of_mass_m")
    inertia: tuple[Vector3, Vector3, Vector3] = Field(alias="inertia_about_center_of_mass_kg_m2")

    @model_validator(mode="after")
    def _inertia_is_physical(self) -> RigidBodyRNA:
        tensor = np.array(self.inertia)
        if not np.allclose(tensor, tensor.T, rtol=1e-9, atol=1e-6 * np.abs(tensor).max()):
            raise ValueError(
                "the inertia tensor is not symmetric; give the same value at ij and ji"
            )
        principal = np.linalg.eigvalsh(tensor)
        if principal[0] <= 0 or principal[2] > principal[0] + principal[1]:
            raise ValueError(
                f"principal moments {principal.tolist()} kg m2 cannot belong to a rigid body; each "
                "must be positive and at most the sum of the other two"
            )
        return self


class Blade(Definition):
    """Mass per length of one blade over its normalised span."""

    length: Positive = Field(alias="length_m")
    span_fraction: Annotated[tuple[NonNegative, ...], Field(min_length=2)]
    mass_density: Annotated[tuple[NonNegative, ...], Field(min_length=2)] = Field(
        alias="mass_density_kg_per_m"
    )

    @model_validator(mode="after")
    def _table_is_complete(self) -> Blade:
        if len(self.span_fraction) != len(self.mass_density):
            raise ValueError(
                f"span_fraction has {len(self.span_fraction)} entries and mass_density_kg_per_m "
                f"{len(self.mass_density)}; give one density per fraction"
            )
        if self.span_fraction[0] != 0 or self.span_fraction[-1] != 1:
            raise ValueError("span_fraction must run from 0 (root) to 1 (tip)")
        if np.any(np.diff(self.span_fraction) <= 0):
            raise ValueError(
                "span_fraction must increase strictly; sort the table from root to tip"
            )
        return self


class RotorNacelleRNA(Definition):
    """Rotor and nacelle inputs, to be lumped into one rigid body (rotor parked and locked).

    Lengths and signs follow OpenFAST's ElastoDyn: overhang negative for an upwind rotor.
    """

    kind: Literal["rotor_nacelle"]
    blades: Annotated[Integer, Field(ge=1, le=6)]
    blade: Blade
    hub_radius: Positive = Field(alias="hub_radius_m")
    precone: Angle = Field(alias="precone_deg")
    hub_center_of_mass: Number = Field(alias="hub_center_of_mass_m")
    overhang: Number = Field(alias="overhang_m")
    shaft_tilt: Angle = Field(alias="shaft_tilt_deg")
    tower_to_shaft: Number = Field(alias="tower_to_shaft_m")
    hub_mass: NonNegative = Field(alias="hub_mass_kg")
    hub_inertia: NonNegative = Field(alias="hub_inertia_kg_m2")
    generator_inertia: NonNegative = Field(alias="generator_inertia_kg_m2")
    nacelle_mass: NonNegative = Field(alias="nacelle_mass_kg")
    nacelle_yaw_inertia: NonNegative = Field(alias="nacelle_yaw_inertia_kg_m2")
    nacelle_center_of_mass: Vector3 = Field(alias="nacelle_center_of_mass_m")
    yaw_bearing_mass: NonNegative = Field(alias="yaw_bearing_mass_kg")

    @model_validator(mode="after")
    def _masses_are_physical(self) -> RotorNacelleRNA:
        x, y, _ = self.nacelle_center_of_mass
        if self.nacelle_yaw_inertia < self.nacelle_mass * (x**2 + y**2):
            raise ValueError(
                f"nacelle_yaw_inertia_kg_m2 = {self.nacelle_yaw_inertia} is less than the "
                f"nacelle's mass times its arm squared ({self.nacelle_mass * (x**2 + y**2)}); "
                "give the inertia about the yaw axis"
            )
        if not any(self.blade.mass_density):
            raise ValueError("mass_density_kg_per_m is all zero; give the blade's mass density")
        return self


class Site(Definition):
    """Water, mudline and gravity.

    The original mudline is at z = -water_depth, the actual one deeper by the scour depth (higher if
    it is negative, for deposition).
    """

    water_depth: Annotated[Positive, Field(le=500)] = Field(alias="water_depth_m")
    scour_depth: Annotated[Number, Field(ge=-20, le=50)] = Field(alias="scour_depth_m", default=0.0)
    water_density: Annotated[Positive, Field(ge=900, le=1200)] = Field(
        alias="water_density_kg_per_m3"
    )
    gravity: Annotated[Positive, Field(ge=1, le=30)] = Field(alias="gravity_m_per_s2")

    @model_validator(mode="after")
    def _mudline_under_water(self) -> Site:
        if self.mudline >= 0:
            raise ValueError(
                f"a scour_depth_m of {self.scour_depth} raises the mudline to z = {self.mudline} "
                "m, out of the water; give a smaller deposition (negative scour depth)"
            )
        return self

    @property
    def mudline(self) -> float:
        """Height of the actual mudline in m."""
        return -(self.water_depth + self.scour_depth)


def _range(values: Iterable[float]) -> str:
    lowest, *_, highest = sorted(values)
    return f"{lowest:g}" if lowest == highest else f"{lowest:g} to {highest:g}"


class Turbine(Definition):
    """A turbine: what a turbine file contains.

    Attributes
    ----------
    name : str
        Short name, used in file names.
    description : str
    site : Site
        Mudline, water and gravity.
    materials : dict of str to Material
        By name.
    members : tuple of Member
        Pile, monopile and tower, from below.
    point_masses : tuple of PointMass
        Masses on the axis.
    tuned_mass_dampers : tuple of TunedMassDamper
    rna : RigidBodyRNA or RotorNacelleRNA
        Rotor-nacelle assembly.
    rotor : Rotor or None
        Tables of the operating rotor.
    hydrodynamics : Hydrodynamics
        Coefficients and settings of the hydrodynamic loads.
    soil : Soil
        Parameters of each kind of foundation.
    structural_damping : StiffnessDamping, ModalDamping, RayleighDamping or None
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$")]
    description: str = ""
    site: Site
    materials: dict[str, Material]
    members: Annotated[tuple[Member, ...], Field(min_length=1)]
    point_masses: tuple[PointMass, ...] = ()
    tuned_mass_dampers: tuple[TunedMassDamper, ...] = ()
    rna: Annotated[RigidBodyRNA | RotorNacelleRNA, Field(discriminator="kind")]
    rotor: Rotor | None = None
    hydrodynamics: Hydrodynamics
    soil: Soil
    structural_damping: Annotated[StructuralDamping | None, BeforeValidator(with_kind)] = None

    def __repr__(self) -> str:
        return (
            f"Turbine({self.name}, members {', '.join(member.name for member in self.members)}, "
            f"toe {self.toe:g} m, mudline {self.site.mudline:g} m, "
            f"yaw bearing {self.yaw_bearing:g} m)"
        )

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        rows = [
            (
                member.name,
                member.material,
                f"{member.bottom:g} to {member.top:g}",
                _range(station.diameter for station in member.stations),
                _range(1e3 * station.thickness for station in member.stations),
            )
            for member in reversed(self.members)
        ]
        columns = ("member", "material", "z (m)", "diameter (m)", "thickness (mm)")
        return html_table(f"{self.name}: {self.description}", columns, rows)

    @model_validator(mode="after")
    def _parts_fit(self) -> Turbine:
        for member in self.members:
            if member.material not in self.materials:
                raise ValueError(
                    f"the material {member.material!r} of member {member.name} is not in "
                    f"materials; choose one of {', '.join(self.materials)}"
                )
        names = [member.name for member in self.members]
        if len(set(names)) < len(names) or not _KEPT_NAMES.isdisjoint(names):
            raise ValueError(
                f"members are named {', '.join(names)}; use different names, other than "
                f"{', '.join(sorted(_KEPT_NAMES))}"
            )
        for name in names:
            if name.startswith(_KEPT_BEGINNING):
                raise ValueError(
                    f"the name of member {name} begins with {_KEPT_BEGINNING}, which is reserved "
                    "for tuned mass dampers; choose another name"
                )
        for lower, upper in zip(self.members, self.members[1:], strict=False):
            if upper.bottom != lower.top:
                raise ValueError(
                    f"member {upper.name} starts at z_m = {upper.bottom}, but {lower.name} ends at "
                    f"{lower.top}; list members from the toe upwards, without gaps"
                )
        if self.site.mudline < self.toe:
            raise ValueError(
                f"the mudline (z = {self.site.mudline} m, from water_depth_m and "
                f"scour_depth_m) is below the pile toe (z = {self.toe} m); "
                "lower the toe or reduce the water depth"
            )
        if self.site.mudline >= self.yaw_bearing:
            raise ValueError("the whole structure is below the mudline; check z_m of the stations")
        for mass in self.point_masses:
            if not self.toe <= mass.z <= self.yaw_bearing:
                raise ValueError(
                    f"point mass {mass.name!r} at z_m = {mass.z} is outside the structure; give a "
                    f"height from {self.toe} to {self.yaw_bearing} m"
                )
        self.hydrodynamics.check_fits(self.site.mudline, self.yaw_bearing)
        return self

    @model_validator(mode="after")
    def _rotor_is_placed_once(self) -> Turbine:
        if self.rotor is None or isinstance(self.rna, RigidBodyRNA):
            return self
        given = [name for name in GEOMETRY if getattr(self.rotor, name) is not None]
        if given not in ([], ["radius"]):
            raise ValueError(
                f"rotor repeats {', '.join(given)} of rna; leave them out (radius_m may stay)"
            )
        return self

    @model_validator(mode="after")
    def _dampers_fit(self) -> Turbine:
        names = [damper.name for damper in self.tuned_mass_dampers]
        if len(set(names)) < len(names):
            raise ValueError(
                f"tuned mass dampers are named {', '.join(names)}; use different names"
            )
        for damper in self.tuned_mass_dampers:
            if not self.site.mudline <= damper.z <= self.yaw_bearing:
                raise ValueError(
                    f"tuned mass damper {damper.name} at z_m = {damper.z} is outside the structure "
                    f"above the mudline; give a height from {self.site.mudline} to "
                    f"{self.yaw_bearing} m"
                )
        return self

    def with_dampers_locked(self) -> Turbine:
        """The same turbine with tuned mass dampers as fixed point masses.

        Returns
        -------
        Turbine
        """
        locked = tuple(
            PointMass(name=damper.name, z_m=damper.z, mass_kg=damper.mass)
            for damper in self.tuned_mass_dampers
        )
        masses = (*self.point_masses, *locked)
        return self.model_copy(update={"point_masses": masses, "tuned_mass_dampers": ()})

    def section(self, z: float, side: Literal["above", "below"] = "above") -> Section:
        """Section of the structure at a height; between stations its dimensions are linear.

        Parameters
        ----------
        z : float, m
            From the toe to the yaw bearing.
        side : {"above", "below"}
            Which section to use where two members of different sections meet.

        Returns
        -------
        Section

        Raises
        ------
        InputError
            A height outside the structure, or an unknown side.
        """
        if not self.toe <= z <= self.yaw_bearing:
            raise InputError(
                f"turbine {self.name}, section, z",
                z,
                f"{self.toe:g} to {self.yaw_bearing:g} m, from the toe to the yaw bearing",
                "Give the height above still water level.",
            )
        if side not in ("above", "below"):
            raise InputError("section, side", side, "above or below", "Choose one.")
        touching = [member for member in self.members if member.bottom <= z <= member.top]
        member = touching[-1 if side == "above" else 0]
        heights = [station.z for station in member.stations]
        diameter = float(np.interp(z, heights, [s.diameter for s in member.stations]))
        thickness = float(np.interp(z, heights, [s.thickness for s in member.stations]))
        return Section(float(z), member.name, member.material, diameter, thickness)

    @property
    def toe(self) -> float:
        """Height of the lowest station in m."""
        return self.members[0].bottom

    @property
    def yaw_bearing(self) -> float:
        """Height of the highest station in m, the yaw bearing."""
        return self.members[-1].top
