"""Properties of a circular hollow section."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Section:
    """Circular hollow section of the structure at one height.

    Attributes
    ----------
    z : float, m
        Height above still water level.
    member, material : str
        Names in the turbine's definition.
    diameter : float, m
        Outer diameter.
    thickness : float, m
        Wall thickness.
    """

    z: float
    member: str
    material: str
    diameter: float
    thickness: float

    @property
    def inner_diameter(self) -> float:
        """Inner diameter in m."""
        return self.diameter - 2 * self.thickness

    @property
    def area(self) -> float:
        """Area of the wall in m2."""
        return math.pi * self.thickness * (self.diameter - self.thickness)

    @property
    def second_moment(self) -> float:
        """Second moment of area about a diameter in m4."""
        # (D^2 + d^2)/16 A avoids the cancellation of D^4 - d^4 for thin walls.
        return self.area * (self.diameter**2 + self.inner_diameter**2) / 16

    @property
    def section_modulus(self) -> float:
        """Elastic section modulus in m3; moment over modulus is the stress at the outside."""
        return 2 * self.second_moment / self.diameter

    @property
    def polar_moment(self) -> float:
        """Polar second moment of area about the axis in m4, the torsion constant of a tube."""
        return 2 * self.second_moment
