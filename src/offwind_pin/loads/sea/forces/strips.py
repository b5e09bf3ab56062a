"""Strips of a cylinder in water, and their wet shares."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel

STRIP_LENGTH = 0.5
"""Longest strip in m: the force of a wave 6.5 m long is accurate to 1 %, that of longer ones
better."""

SMOOTHING = STRIP_LENGTH / 2
"""Half the height in m over which the surface is averaged for the wet shares."""


class Water(Protocol):
    """Motion of water at the centres of n strips, and its surface."""

    @property
    def highest_surface(self) -> float:
        """Upper bound of the surface in m."""

    @property
    def lowest_surface(self) -> float:
        """Lower bound of the surface in m; equal to the upper one if it does not move."""

    def elevation(self, time: Array, ramp_factor: Array) -> Array:
        """(t,) surface of the waves above the mean water level in m."""

    def surface(self, time: Array, ramp_factor: Array) -> Array:
        """(t,) height in m up to which strips are wet; without waves the mean water level."""

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 1 + 6 n) surface in m, velocity (n, 3) in m/s and acceleration (n, 3) in m/s2."""


@dataclass(frozen=True, eq=False)
class Strips:
    """Strips from the mudline up to the highest surface.

    height (n,) of the strip centres in m, length (n,) in m, diameter (n,) in m, always_wet (n,)
    whether the surface always stays above a strip; by default all strips.
    """

    height: Array
    length: Array
    diameter: Array
    always_wet: NDArray[np.bool_] | None = None

    @staticmethod
    def between(mudline: float, water_line: float) -> tuple[Array, Array]:
        """Heights of the centres and lengths of equal strips."""
        count = int(np.ceil((water_line - mudline) / STRIP_LENGTH))
        edges = np.linspace(mudline, water_line, count + 1)
        return (edges[:-1] + edges[1:]) / 2, np.diff(edges)

    @property
    def volume(self) -> Array:
        """(n,) volume of each strip in m3."""
        return np.pi / 4 * self.diameter**2 * self.length

    @property
    def wet(self) -> NDArray[np.bool_]:
        """(n,) whether the surface always stays above a strip."""
        always = self.always_wet
        return np.ones(len(self.height), dtype=np.bool_) if always is None else always

    @cached_property
    def ends(self) -> Array:
        """(n, 2) lower end and length in m for :func:`wet_share`.

        A strip that is always wet begins infinitely deep, so that its share is exactly 1.
        """
        bottom = np.where(self.wet, -np.inf, self.height - self.length / 2)
        return np.column_stack([bottom, self.length])

    def part(self, chosen: NDArray[np.bool_]) -> Strips:
        """Some of the strips."""
        return Strips(
            self.height[chosen], self.length[chosen], self.diameter[chosen], self.wet[chosen]
        )


def strips_up_to(
    mudline: float, top: float, still: float, lowest: float, highest: float
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Centres (n,) and lengths (n,) of strips in m, and whether the surface always stays above
    them.

    If the surface does not move, equal strips end at it. If it does, equal strips up to the still
    surface are followed by equal ones through the splash zone, up to :data:`SMOOTHING` above the
    highest surface. No strip extends above the top of the structure.
    """
    below = Strips.between(mudline, min(still, top))
    if highest == lowest or still >= top:
        height, length = below
    else:
        above = Strips.between(still, min(highest + SMOOTHING, top))
        height, length = (np.concatenate(pair) for pair in zip(below, above, strict=True))
    if highest == lowest:
        return height, length, np.ones(len(height), dtype=np.bool_)
    return height, length, height + length / 2 <= lowest - SMOOTHING


@kernel
def wet_share(surface: float, bottom: float, length: float) -> float:
    """Fraction of a strip below the surface, between 0 and 1.

    The share min(max((surface - bottom) / length, 0), 1) is averaged over surfaces within h =
    :data:`SMOOTHING` of the surface, so that it has a continuous slope. Since all strips are
    averaged alike, their wet lengths add up exactly to the surface's height above the lowest strip,
    as long as the surface is at least h from the ends of the row of strips. Since each strip acts
    at its centre, the error of the first moment of the wet length is at most length^2 / 8 + h^2 /
    6.
    """
    if surface >= bottom + length + SMOOTHING:
        return 1.0
    if surface <= bottom - SMOOTHING:
        return 0.0
    upper = _area_below((surface - bottom + SMOOTHING) / length)
    lower = _area_below((surface - bottom - SMOOTHING) / length)
    return (upper - lower) * length / (2 * SMOOTHING)


@kernel
def _area_below(share: float) -> float:
    """Integral of min(max(x, 0), 1) up to a share x."""
    if share <= 0:
        return 0.0
    return share**2 / 2 if share < 1 else share - 0.5
