"""Mass, centre and inertia of hollow conical frusta in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array


@dataclass(frozen=True)
class Frustum:
    """Hollow conical frustum on the z axis: radii vary linearly from bottom to top (m, kg/m3)."""

    height: float
    outer_bottom: float
    outer_top: float
    inner_bottom: float
    inner_top: float
    density: float

    def lump(self, base: float = 0.0) -> AxialBody:
        """Closed form of the paper's integrals (Rahman et al., MECC 2025, Eq. 5).

        With s = z / height, each integrand is a power of a linear function times a power of s.
        """
        h, rho = self.height, self.density
        outer, inner = (self.outer_bottom, self.outer_top), (self.inner_bottom, self.inner_top)
        area = _square(*outer) - _square(*inner)
        area_s = _square_s(*outer) - _square_s(*inner)
        area_ss = _square_ss(*outer) - _square_ss(*inner)
        fourth = _fourth(*outer) - _fourth(*inner)
        mass = rho * np.pi * h * area
        center = h * area_s / area
        axial = rho * np.pi / 2 * h * fourth
        about_base = axial / 2 + rho * np.pi * h**3 * area_ss
        return AxialBody(mass, base + center, about_base - mass * center**2, axial)


@dataclass(frozen=True)
class AxialBody:
    """Rigid body symmetric about the z axis.

    mass in kg, height of the centre of mass in m, moments of inertia about the centre of mass in
    kg m2 (transverse: about x and y; axial: about z).
    """

    mass: float
    center: float
    transverse: float
    axial: float

    @staticmethod
    def combine(parts: list[AxialBody]) -> AxialBody:
        """Combine bodies on the same axis by the parallel-axis theorem."""
        mass = sum(part.mass for part in parts)
        if mass == 0:
            return AxialBody(0.0, parts[0].center if parts else 0.0, 0.0, 0.0)
        center = sum(part.mass * part.center for part in parts) / mass
        transverse = sum(
            part.transverse + part.mass * (part.center - center) ** 2 for part in parts
        )
        return AxialBody(mass, center, transverse, sum(part.axial for part in parts))

    def inertia(self) -> Array:
        """Inertia (3, 3) about the centre of mass."""
        return np.diag([self.transverse, self.transverse, self.axial])


def _square(a: float, b: float) -> float:
    """Integral over s of r(s)^2, with r linear from a at s = 0 to b at s = 1."""
    return (a * a + a * b + b * b) / 3


def _square_s(a: float, b: float) -> float:
    """Integral over s of r(s)^2 s."""
    return (a * a + 2 * a * b + 3 * b * b) / 12


def _square_ss(a: float, b: float) -> float:
    """Integral over s of r(s)^2 s^2."""
    return (a * a + 3 * a * b + 6 * b * b) / 30


def _fourth(a: float, b: float) -> float:
    """Integral over s of r(s)^4."""
    return (a**4 + a**3 * b + a * a * b * b + a * b**3 + b**4) / 5
