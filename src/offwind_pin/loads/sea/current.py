"""Steady currents over the depth."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError

FASTEST = 10.0
"""m/s; the fastest tidal streams reach half of it."""

SURFACE_LAYER = 20.0
"""m below which a current that the wind drives is gone (IEC 61400-3-1:2019, 6.3.3.3.3)."""


@dataclass(frozen=True)
class Current(ABC):
    """Water that flows one way.

    speed : at the mean water level in m/s; direction_deg : towards which, from +x towards +y
    """

    speed: float
    direction_deg: float = 0.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.speed) and 0 <= self.speed <= FASTEST):
            allowed = f"0 to {FASTEST:g} m/s; where it goes says direction_deg"
            raise InputError("current, field speed", self.speed, allowed, "Correct it.")
        if not np.isfinite(self.direction_deg):
            raise InputError(
                "current, field direction_deg",
                self.direction_deg,
                "an angle in degrees",
                "Give it.",
            )

    @abstractmethod
    def share(self, height: Array, depth: float) -> Array:
        """(n,) of the speed at heights above the mean water level in m, over a depth in m."""

    def velocity(self, height: Array, depth: float) -> Array:
        """(n, 3) in m/s at heights (n,) in m above the mean water level, over a depth in m.

        Above the mean water level it is that at it.
        """
        angle = np.radians(self.direction_deg)
        towards = np.array([np.cos(angle), np.sin(angle), 0.0])
        size = self.speed * self.share(np.minimum(height, 0.0), depth)
        return np.asarray(size[:, None] * towards)


@dataclass(frozen=True)
class UniformCurrent(Current):
    """The same at all depths."""

    def share(self, height: Array, depth: float) -> Array:
        return np.ones(len(height))


@dataclass(frozen=True)
class PowerLawCurrent(Current):
    """((z + h) / h)^exponent; 1/7 for tides and surges (IEC 61400-3-1:2019, 6.3.3.3.2)."""

    exponent: float = 1 / 7

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (np.isfinite(self.exponent) and 0 < self.exponent <= 1):
            allowed = "above 0 and at most 1"
            raise InputError("current, field exponent", self.exponent, allowed, "Correct it.")

    def share(self, height: Array, depth: float) -> Array:
        return np.asarray(np.maximum(1 + height / depth, 0.0) ** self.exponent)


@dataclass(frozen=True)
class SurfaceCurrent(Current):
    """Driven by the wind: linear from the surface down to nothing at a reach in m."""

    reach: float = SURFACE_LAYER

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (np.isfinite(self.reach) and self.reach > 0):
            raise InputError(
                "current, field reach", self.reach, "a positive depth in m", "Give it."
            )

    def share(self, height: Array, depth: float) -> Array:
        return np.maximum(1 + height / self.reach, 0.0)


@dataclass(frozen=True)
class CurrentTable(Current):
    """Factors of the speed at depths in m below the mean water level, linear in between.

    Above the first and below the last they stay; ``speed`` is usually that where the factor is 1.
    """

    depth: tuple[float, ...] = ()
    factor: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.depth) < 2 or len(self.depth) != len(self.factor):
            received = f"{len(self.depth)} depths and {len(self.factor)} factors"
            allowed = "two depths or more, and a factor for each"
            raise InputError(
                "current, fields depth and factor", received, allowed, "Complete them."
            )
        if not np.all(np.isfinite([*self.depth, *self.factor])):
            received = "NaN or infinity"
            raise InputError("current, table", received, "finite numbers", "Correct them.")
        if np.any(np.diff(self.depth) <= 0) or self.depth[0] < 0:
            raise InputError(
                "current, field depth", list(self.depth), "rising depths from 0 down", "Sort them."
            )
        fastest = self.speed * max(abs(factor) for factor in self.factor)
        if fastest > FASTEST:
            raise InputError(
                "current, field factor",
                f"{fastest:g} m/s where its size is largest",
                f"up to {FASTEST:g} m/s",
                "Factors multiply the speed; are they speeds?",
            )

    def share(self, height: Array, depth: float) -> Array:
        return np.interp(-height, self.depth, self.factor)


@dataclass(frozen=True)
class CurrentSum:
    """Several currents at once, such as a tide and what the wind drives."""

    parts: tuple[Current, ...]

    def velocity(self, height: Array, depth: float) -> Array:
        """(n, 3) in m/s, see :meth:`Current.velocity`."""
        return np.sum([part.velocity(height, depth) for part in self.parts], axis=0)


def mean_velocity(current: Current | CurrentSum, depth: float) -> Array:
    """(3,) mean over the depth in m/s, by Gauss's quadrature on twelve panels."""
    node, weight = np.polynomial.legendre.leggauss(4)
    edges = -depth * np.linspace(0, 1, 13)[::-1] ** 2
    half, middle = np.diff(edges)[:, None] / 2, (edges[1:] + edges[:-1])[:, None] / 2
    height, share = (middle + half * node).ravel(), (half * weight).ravel() / depth
    return np.asarray(share @ current.velocity(height, depth))
