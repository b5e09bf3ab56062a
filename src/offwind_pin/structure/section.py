"""The support structure over height: dimensions, mass and stiffness of intervals."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Material, Member, Turbine
from offwind_pin.structure.frustum import AxialBody, Frustum

_GAUSS_POINTS, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)


def diameter_and_thickness(member: Member, z: Array) -> tuple[Array, Array]:
    """Outer diameter and wall thickness in m at heights z."""
    heights = [station.z for station in member.stations]
    return (
        np.interp(z, heights, [station.diameter for station in member.stations]),
        np.interp(z, heights, [station.thickness for station in member.stations]),
    )


def outer_diameter(turbine: Turbine, z: Array) -> Array:
    """Outer diameter in m at heights z; at a jump, that of the part above."""
    diameter = np.empty_like(z)
    for member in turbine.members:
        inside = (z >= member.bottom) & (z <= member.top)
        diameter[inside] = diameter_and_thickness(member, z[inside])[0]
    return diameter


def wetted_diameter(turbine: Turbine, z: Array) -> Array:
    """Outer diameter in m at heights z, marine growth included."""
    return outer_diameter(turbine, z) + 2 * turbine.hydrodynamics.growth_at(z)


def inner_diameter(turbine: Turbine, z: Array) -> Array:
    """Inner diameter in m at heights z; at a jump, that of the part above."""
    diameter = np.empty_like(z)
    for member in turbine.members:
        inside = (z >= member.bottom) & (z <= member.top)
        outer, thickness = diameter_and_thickness(member, z[inside])
        diameter[inside] = outer - 2 * thickness
    return diameter


def pieces(turbine: Turbine, low: float, high: float) -> Iterator[tuple[float, float, Member]]:
    """Intervals between low and high within which every section dimension is linear in z."""
    for member in turbine.members:
        cuts = [low, *(station.z for station in member.stations), high]
        inside = sorted({z for z in cuts if max(low, member.bottom) <= z <= min(high, member.top)})
        for bottom, top in itertools.pairwise(inside):
            yield bottom, top, member


def frusta(turbine: Turbine, low: float, high: float) -> list[tuple[float, Frustum]]:
    """Hollow frusta that fill the interval, each with the height of its base."""
    result = []
    for bottom, top, member in pieces(turbine, low, high):
        diameter, thickness = diameter_and_thickness(member, np.array([bottom, top]))
        outer = (diameter / 2).tolist()
        inner = (diameter / 2 - thickness).tolist()
        density = turbine.materials[member.material].density
        result.append(
            (bottom, Frustum(top - bottom, outer[0], outer[1], inner[0], inner[1], density))
        )
    return result


def growth(turbine: Turbine, low: float, high: float) -> list[tuple[float, Frustum]]:
    """Marine growth in the interval: hollow frusta outside the wall, as :func:`frusta` gives."""
    result = []
    for layer in turbine.hydrodynamics.marine_growth:
        bottom, top = max(low, layer.bottom, turbine.site.mudline), min(high, layer.top)
        for base, shell in frusta(turbine, bottom, top):
            low_radius, high_radius = shell.outer_bottom, shell.outer_top
            ring = Frustum(
                shell.height,
                low_radius + layer.thickness,
                high_radius + layer.thickness,
                low_radius,
                high_radius,
                layer.density,
            )
            result.append((base, ring))
    return result


def lump(turbine: Turbine, low: float, high: float, *, with_end: bool = True) -> AxialBody:
    """Rigid body of everything between two heights, marine growth and point masses included.

    A point mass counts where low <= z < high; one at the yaw bearing belongs to the interval that
    ends there, unless ``with_end`` is false.
    """
    parts = [frustum.lump(base) for base, frustum in frusta(turbine, low, high)]
    parts += [layer.lump(base) for base, layer in growth(turbine, low, high)]
    for mass in turbine.point_masses:
        if low <= mass.z < high or (with_end and mass.z == high == turbine.yaw_bearing):
            transverse = (mass.inertia[0] + mass.inertia[1]) / 2
            parts.append(AxialBody(mass.mass, mass.z, transverse, mass.inertia[2]))
    return AxialBody.combine(parts)


def bending_stiffness(member: Member, material: Material, z: Array) -> Array:
    """EI in N m2 at heights z."""
    outer, thickness = diameter_and_thickness(member, z)
    inner = outer - 2 * thickness
    return material.youngs_modulus * np.pi / 64 * (outer**4 - inner**4)


def torsional_stiffness(member: Member, material: Material, z: Array) -> Array:
    """GJ in N m2 at heights z."""
    ratio = 2 * material.shear_modulus / material.youngs_modulus
    return ratio * bending_stiffness(member, material, z)


def shear_stiffness(member: Member, material: Material, z: Array) -> Array:
    """kappa G A in N at heights z, with the shear coefficient of a hollow circle.

    Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966), Table 1.
    """
    outer, thickness = diameter_and_thickness(member, z)
    inner = outer - 2 * thickness
    poisson = material.youngs_modulus / (2 * material.shear_modulus) - 1
    ratio = inner / outer
    square = (1 + ratio**2) ** 2
    kappa = 6 * (1 + poisson) * square
    kappa = kappa / ((7 + 6 * poisson) * square + (20 + 12 * poisson) * ratio**2)
    return kappa * material.shear_modulus * np.pi / 4 * (outer**2 - inner**2)


def shear_flexibility(turbine: Turbine, low: float, high: float) -> float:
    """Integral of 1/(kappa G A) over an interval in m/N, as exact as :func:`flexibility`."""
    total = 0.0
    for z, weight, member in _quadrature(turbine, low, high):
        material = turbine.materials[member.material]
        total += float(weight @ (1 / shear_stiffness(member, material, z)))
    return total


def flexibility(turbine: Turbine, low: float, high: float) -> tuple[float, float]:
    """Integrals of 1/EI and 1/GJ over an interval, in rad/(N m).

    Eight-point Gauss over each linear piece: exact to rounding for any taper a tower has.
    """
    bending = torsion = 0.0
    for z, weight, member in _quadrature(turbine, low, high):
        material = turbine.materials[member.material]
        bending += float(weight @ (1 / bending_stiffness(member, material, z)))
        torsion += float(weight @ (1 / torsional_stiffness(member, material, z)))
    return bending, torsion


def _quadrature(turbine: Turbine, low: float, high: float) -> Iterator[tuple[Array, Array, Member]]:
    """Heights and weights of the points of each linear piece of an interval, with its member."""
    for bottom, top, member in pieces(turbine, low, high):
        half = (top - bottom) / 2
        yield bottom + half * (1 + _GAUSS_POINTS), half * _GAUSS_WEIGHTS, member
