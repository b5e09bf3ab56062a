"""Lumping of rotor and nacelle into one rigid body at the yaw bearing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Blade, RigidBodyRNA, RotorNacelleRNA


@dataclass(frozen=True, eq=False)
class RigidBody:
    """Mass (kg), centre of mass (3,) (m) and inertia about it (3, 3) (kg m2), axes x, y, z."""

    mass: float
    center_of_mass: Array
    inertia: Array

    @staticmethod
    def combine(parts: list[RigidBody]) -> RigidBody:
        """Combine rigid bodies by the parallel-axis theorem."""
        mass = float(sum(part.mass for part in parts))
        center = np.sum([part.mass * part.center_of_mass for part in parts], axis=0) / mass
        inertia = np.sum(
            [
                part.inertia + point_inertia(part.mass, part.center_of_mass - center)
                for part in parts
            ],
            axis=0,
        )
        return RigidBody(mass, center, inertia)


def point_inertia(mass: float, offset: Array) -> Array:
    """Inertia (3, 3) of a point mass at an offset: m (r.r I - r r')."""
    return mass * (offset @ offset * np.eye(3) - np.outer(offset, offset))


def lump_rna(rna: RigidBodyRNA | RotorNacelleRNA) -> RigidBody:
    """Rotor-nacelle assembly as one rigid body, offsets from the yaw bearing.

    The rotor is parked and locked with one blade pointing up; the generator rotates with the shaft,
    so its inertia counts about the shaft axis. The yaw bearing is a point mass at the origin.
    """
    if isinstance(rna, RigidBodyRNA):
        return RigidBody(rna.mass, np.array(rna.center_of_mass), np.array(rna.inertia))
    apex, shaft = rotor_apex(rna)
    hub = RigidBody(
        rna.hub_mass,
        apex + rna.hub_center_of_mass * shaft,
        (rna.hub_inertia + rna.generator_inertia) * np.outer(shaft, shaft),
    )
    nacelle_center = np.array(rna.nacelle_center_of_mass)
    yaw_arm = nacelle_center[0] ** 2 + nacelle_center[1] ** 2
    nacelle = RigidBody(
        rna.nacelle_mass,
        nacelle_center,
        np.diag([0.0, 0.0, rna.nacelle_yaw_inertia - rna.nacelle_mass * yaw_arm]),
    )
    yaw_bearing = RigidBody(rna.yaw_bearing_mass, np.zeros(3), np.zeros((3, 3)))
    blades = [
        _blade_body(rna, apex, shaft, azimuth=2 * np.pi * i / rna.blades) for i in range(rna.blades)
    ]
    return RigidBody.combine([hub, nacelle, yaw_bearing, *blades])


def rotor_apex(rna: RotorNacelleRNA) -> tuple[Array, Array]:
    """Rotor apex (3,) from the yaw bearing in m, and unit vector (3,) of the shaft, downwind."""
    tilt = np.radians(rna.shaft_tilt)
    shaft = np.array([np.cos(tilt), 0.0, np.sin(tilt)])
    return np.array([0.0, 0.0, rna.tower_to_shaft]) + rna.overhang * shaft, shaft


def rotor_radius(rna: RotorNacelleRNA) -> float:
    """Radius in m of the disc that the coned rotor sweeps."""
    return float((rna.hub_radius + rna.blade.length) * np.cos(np.radians(rna.precone)))


def _blade_body(rna: RotorNacelleRNA, apex: Array, shaft: Array, azimuth: float) -> RigidBody:
    """One blade as a straight line of mass; azimuth in rad from the upright position."""
    upright = np.array([-shaft[2], 0.0, shaft[0]])
    sideways = np.cross(shaft, upright)
    cone = np.radians(rna.precone)
    radial = np.cos(azimuth) * upright + np.sin(azimuth) * sideways
    along = np.cos(cone) * radial + np.sin(cone) * shaft
    mass, first, second = (_mass_moment(rna.blade, rna.hub_radius, order) for order in range(3))
    return RigidBody(
        mass,
        apex + first / mass * along,
        (second - first**2 / mass) * (np.eye(3) - np.outer(along, along)),
    )


def _mass_moment(blade: Blade, hub_radius: float, order: int) -> float:
    """Integral of mass density times radius^order; exact for a piecewise linear density."""
    points, weights = np.polynomial.legendre.leggauss(3)
    fraction = np.array(blade.span_fraction)
    half = np.diff(fraction)[:, None] / 2
    span = fraction[:-1, None] + half * (1 + points)
    density = np.interp(span, fraction, blade.mass_density)
    radius = hub_radius + span * blade.length
    return float(blade.length * np.sum(half * weights * density * radius**order))
