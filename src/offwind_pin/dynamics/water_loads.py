"""What water does to the members of a system: the loads on their strips."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.dynamics.sea import Sea
from offwind_pin.loads.added_mass import AddedMass, SplashAddedMass
from offwind_pin.loads.buoyancy import Buoyancy
from offwind_pin.loads.diffraction import inertia_factor
from offwind_pin.loads.keulegan_carpenter import keulegan_carpenter
from offwind_pin.loads.morison import MorisonForce
from offwind_pin.loads.points import KernelLoad
from offwind_pin.loads.strips import Strips, Water, strips_up_to
from offwind_pin.loads.waves import IrregularSea, WaveKinematics, wave_number
from offwind_pin.structure.section import inner_diameter, wetted_diameter
from offwind_pin.turbines.base import Array, ComplexArray
from offwind_pin.turbines.definition import Turbine
from offwind_pin.turbines.hydrodynamics import FloodedPile, coefficient_at

_BLOCK = 128
"""Times for which all components are held in memory at once."""


@dataclass(frozen=True, eq=False)
class _LinearWater:
    """Airy waves up to still water level.

    inertia_factor (n, m) by which the amplitude of each component's acceleration is multiplied at
    each strip; None for 1
    """

    kinematics: WaveKinematics
    inertia_factor: ComplexArray | None = None
    highest_surface: float = 0.0
    lowest_surface: float = 0.0

    def rows(self, time: Array, rise: Array) -> Array:
        n = len(self.kinematics.horizontal)
        rows = np.zeros((len(time), 1 + 6 * n))
        if len(self.kinematics.omega) > 0:
            moved = self.kinematics.at_times(time)
            if self.inertia_factor is not None:
                moved[:, 1] = self._accelerations(time, self.inertia_factor)
            rows[:, 1:] = rise[:, None] * moved.reshape(len(time), -1)
        return rows

    def _accelerations(self, time: Array, factor: ComplexArray) -> Array:
        """(t, n, 3) accelerations with a factor (n, m), by blocks of times."""
        waves = self.kinematics
        result = np.zeros((len(time), len(waves.horizontal), 3))
        turned = 1j * waves.omega * factor * np.exp(-1j * waves.phase)
        for axis, amplitude in ((0, waves.horizontal + 0j), (2, 1j * waves.vertical)):
            of_component = (turned * amplitude).T
            for block in np.array_split(np.arange(len(time)), len(time) // _BLOCK + 1):
                angle = np.outer(time[block], waves.omega)
                moved = np.cos(angle) @ of_component.real - np.sin(angle) @ of_component.imag
                result[block, :, axis] = moved
        return result


@dataclass(frozen=True, eq=False)
class Waters:
    """Strips of a turbine in a sea, with all that its forces depend on.

    Attributes
    ----------
    strips : from the mudline up to the highest surface
    water : its motion at the strips
    still : height of the still surface in m
    added_mass, drag : (n,) coefficients of the strips
    """

    turbine: Turbine
    strips: Strips
    water: Water
    still: float
    added_mass: Array
    drag: Array

    @staticmethod
    def of(turbine: Turbine, sea: Sea) -> Waters:
        realised: IrregularSea = sea.realise(turbine)
        strips = wetted_strips(turbine, still=0.0, lowest=0.0, highest=0.0)
        kinematics = realised.kinematics_at(strips.height)
        amplitude = [kinematics.horizontal, 0 * kinematics.horizontal, 1j * kinematics.vertical]
        added, drag = coefficients(turbine, strips, np.stack(amplitude), kinematics.omega)
        k = wave_number(kinematics.omega, realised.depth, realised.gravity)
        water = _LinearWater(kinematics, diffraction(turbine, strips, k, added))
        return Waters(turbine, strips, water, 0.0, added, drag)

    def loads(self) -> list[KernelLoad]:
        """Every load of the water, the permanent added mass first."""
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
        """Of the strips that never fall dry."""
        wet = self.strips.wet
        return AddedMass.of(
            self.strips.part(wet), self.turbine.site.water_density, self.added_mass[wet]
        )

    def splash_added_mass(self) -> SplashAddedMass:
        """Of the strips that the surface wets and leaves."""
        dry = ~self.strips.wet
        part = self.strips.part(dry)
        mass = self.turbine.site.water_density * self.added_mass[dry] * part.volume
        return SplashAddedMass(part, mass, self.water)

    def wave_force(self) -> MorisonForce:
        """Fluid inertia and drag: of waves, if there are any, and on a structure that moves."""
        return MorisonForce(
            self.strips,
            self.water,
            self.turbine.site.water_density,
            self.added_mass,
            self.drag,
        )

    def buoyancy(self) -> Buoyancy:
        """Of the water outside."""
        end = wetted_diameter(self.turbine, np.array([self.turbine.site.mudline]))[0]
        weight = self.turbine.site.water_density * self.turbine.site.gravity
        return Buoyancy(self.strips, weight, np.pi / 4 * end**2, self.still, self.water)


def wetted_strips(turbine: Turbine, still: float, lowest: float, highest: float) -> Strips:
    """Strips from the mudline up to what a sea reaches, with their marine growth.

    still, lowest, highest : heights of the surface in m; all equal where waves are not stretched
    """
    height, length, wet = strips_up_to(
        turbine.site.mudline, turbine.yaw_bearing, still, lowest, highest
    )
    return Strips(height, length, wetted_diameter(turbine, height), wet)


def coefficients(
    turbine: Turbine, strips: Strips, velocity: ComplexArray, omega: Array
) -> tuple[Array, Array]:
    """Added-mass and drag coefficients (n,) of strips in waves.

    velocity (3, n, m) complex amplitudes of the water at the strips in m/s, taken at the still
    surface where a strip lies above it; omega (m,) in rad/s
    """
    z, hydrodynamics = strips.height, turbine.hydrodynamics
    number = keulegan_carpenter(velocity, omega, strips.diameter)
    added = coefficient_at(hydrodynamics.added_mass_coefficient, z, number)
    drag = coefficient_at(hydrodynamics.drag_coefficient, z, number)
    for layer in hydrodynamics.marine_growth:
        if layer.drag_coefficient is not None:
            drag[(z >= layer.bottom) & (z < layer.top)] = layer.drag_coefficient
    return added, drag


def diffraction(
    turbine: Turbine, strips: Strips, wave_number: Array, added_mass: Array
) -> ComplexArray | None:
    """(n, m) factors of the acceleration of each harmonic at each strip, or None for one."""
    if turbine.hydrodynamics.diffraction == "none":
        return None
    return inertia_factor(strips.diameter, wave_number, added_mass)


def contents(turbine: Turbine, inside: FloodedPile) -> list[KernelLoad]:
    """Mass of the water inside, and where buoyancy acts its pressure on the wall.

    The water moves with the wall across the axis, and stands still along it: its weight rests on
    the plug, and its pressure on the wall.
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


def water_loads(turbine: Turbine, sea: Sea) -> list[KernelLoad]:
    """Every load of the water on a turbine in a sea; the permanent added mass comes first."""
    return Waters.of(turbine, sea).loads()
