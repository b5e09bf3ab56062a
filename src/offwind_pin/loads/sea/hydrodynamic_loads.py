"""Hydrodynamic loads on the members of a system, strip by strip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array, ComplexArray
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.hydrodynamics import FloodedPile, coefficient_at
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.point_load import KernelLoad
from offwind_pin.loads.sea.forces.added_mass import AddedMass, SplashAddedMass
from offwind_pin.loads.sea.forces.buoyancy import Buoyancy
from offwind_pin.loads.sea.forces.keulegan_carpenter import keulegan_carpenter
from offwind_pin.loads.sea.forces.maccamy_fuchs import inertia_factor
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips, strips_up_to
from offwind_pin.loads.sea.kinematics import WaterSeries, WaterSurface
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.sea.waves.wave_field import WaveField
from offwind_pin.structure.section import inner_diameter, wetted_diameter


@dataclass(frozen=True, eq=False)
class HydrodynamicModel:
    """Strips of a turbine in a sea, with everything that the hydrodynamic forces depend on.

    Attributes
    ----------
    strips : Strips
        From the mudline up to the highest surface.
    surface : WaterSurface
        Surface of the water.
    water : Water
        Motion of the water at the strips.
    added_mass, drag : (n,) array
        Coefficients of the strips.
    """

    turbine: Turbine
    strips: Strips
    surface: WaterSurface
    water: WaterSeries
    added_mass: Array
    drag: Array

    @staticmethod
    def of(turbine: Turbine, sea: Sea) -> HydrodynamicModel:
        """Realise a sea at a turbine."""
        level, mudline = sea.water_level, turbine.site.mudline
        if not level > mudline:
            allowed = f"above the mudline (z = {mudline} m)"
            raise InputError("sea, field water_level", level, allowed, "Raise it.")
        waves = sea.waves(level - mudline, turbine.site.gravity)
        surface = WaterSurface(waves, level, sea.stretching)
        strips = wetted_strips(turbine, level, surface.lowest, surface.highest)
        added, drag = coefficients(turbine, strips.height, waves, level)
        current = None
        if sea.current is not None:
            current = sea.current.velocity(strips.height - level, level - mudline)
        water = WaterSeries(
            strips.height,
            surface,
            current=current,
            inertia_factor=diffraction(turbine, waves, level),
        )
        return HydrodynamicModel(turbine, strips, surface, water, added, drag)

    def loads(self) -> list[KernelLoad]:
        """All hydrodynamic loads, the permanent added mass first."""
        hydrodynamics = self.turbine.hydrodynamics
        result: list[KernelLoad] = [self.permanent_added_mass(), self.wave_force()]
        if not np.all(self.strips.wet):
            result.append(self.splash_added_mass())
        if hydrodynamics.buoyancy:
            result.append(self.buoyancy())
        if isinstance(hydrodynamics.contents, FloodedPile):
            result += contents(self.turbine, hydrodynamics.contents)
        return result

    def permanent_added_mass(self) -> AddedMass:
        """Added mass of the strips that never fall dry."""
        wet = self.strips.wet
        return AddedMass.of(
            self.strips.part(wet), self.turbine.site.water_density, self.added_mass[wet]
        )

    def splash_added_mass(self) -> SplashAddedMass:
        """Added mass of the strips in the splash zone."""
        dry = ~self.strips.wet
        part = self.strips.part(dry)
        mass = self.turbine.site.water_density * self.added_mass[dry] * part.volume
        return SplashAddedMass(part, mass, self.water)

    def wave_force(self) -> MorisonForce:
        """Fluid inertia and drag, of waves and of the structure's motion."""
        return MorisonForce(
            self.strips,
            self.water,
            self.turbine.site.water_density,
            self.added_mass,
            self.drag,
        )

    def buoyancy(self) -> Buoyancy:
        """Buoyancy in the water outside."""
        end = wetted_diameter(self.turbine, np.array([self.turbine.site.mudline]))[0]
        weight = self.turbine.site.water_density * self.turbine.site.gravity
        return Buoyancy(self.strips, weight, np.pi / 4 * end**2, self.surface.level, self.water)


def wetted_strips(turbine: Turbine, still: float, lowest: float, highest: float) -> Strips:
    """Strips from the mudline to the highest surface, with marine growth.

    still, lowest, highest : heights of the surface in m; all equal where waves are not stretched
    """
    height, length, wet = strips_up_to(
        turbine.site.mudline, turbine.yaw_bearing, still, lowest, highest
    )
    return Strips(height, length, wetted_diameter(turbine, height), wet)


def coefficients(
    turbine: Turbine, height: Array, waves: WaveField | None, water_level: float
) -> tuple[Array, Array]:
    """Added-mass and drag coefficients (n,) of strips at heights (n,) in m in waves.

    Above the mean water level the motion at the level is used. The Keulegan-Carpenter number is
    that of the free waves alone: orbits of slow bound motions grow without limit with the period,
    and act as a current on the free waves.
    """
    hydrodynamics = turbine.hydrodynamics
    number = np.zeros(len(height))
    if waves is not None and hydrodynamics.needs_keulegan_carpenter:
        free = waves.first_order
        velocity = free.velocity(np.minimum(height - water_level, 0.0))
        number = keulegan_carpenter(velocity, free.omega, wetted_diameter(turbine, height))
    added = coefficient_at(hydrodynamics.added_mass_coefficient, height, number)
    drag = coefficient_at(hydrodynamics.drag_coefficient, height, number)
    for layer in hydrodynamics.marine_growth:
        if layer.drag_coefficient is not None:
            drag[(height >= layer.bottom) & (height < layer.top)] = layer.drag_coefficient
    return added, drag


def diffraction(
    turbine: Turbine, waves: WaveField | None, water_level: float
) -> Callable[[Array], ComplexArray] | None:
    """Function for the factors (n, m) of each harmonic's acceleration at heights; None for 1."""
    if turbine.hydrodynamics.diffraction == "none" or waves is None:
        return None

    def factor(height: Array) -> ComplexArray:
        added, _ = coefficients(turbine, height, waves, water_level)
        return inertia_factor(wetted_diameter(turbine, height), waves.wave_number, added)

    return factor


def contents(turbine: Turbine, inside: FloodedPile) -> list[KernelLoad]:
    """Mass of the water inside and, with buoyancy, its pressure on the wall.

    The water moves with the wall normal to the axis but not along it: its weight rests on the plug,
    and its pressure acts on the wall.
    """
    plug = turbine.site.mudline if inside.plug is None else inside.plug
    height, length = Strips.between(plug, inside.level)
    strips = Strips(height, length, inner_diameter(turbine, height))
    density = turbine.site.water_density if inside.density is None else inside.density
    result: list[KernelLoad] = [AddedMass.of(strips, density, 1.0, "contained_water")]
    if turbine.hydrodynamics.buoyancy:
        end = inner_diameter(turbine, np.array([plug]))[0]
        weight = -density * turbine.site.gravity
        area = np.pi / 4 * end**2
        result.append(Buoyancy(strips, weight, area, inside.level, name="contained_pressure"))
    return result
