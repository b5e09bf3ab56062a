"""Steady currents over the depth."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    Tag,
    model_serializer,
    model_validator,
)

from offwind_pin.base.definition import (
    Array,
    Definition,
    Direction,
    NonNegative,
    Numbers,
    Positive,
    key,
)

FASTEST = 10.0
"""m/s; the fastest tidal streams reach half of this."""

SURFACE_LAYER = 20.0
"""Depth in m at which a wind-driven current vanishes (IEC 61400-3-1:2019, 6.3.3.3.3)."""


class Current(Definition, kw_only=False):
    """A steady current in one direction.

    Attributes
    ----------
    speed : float, m/s
        At the mean water level.
    direction_deg : float
        Direction towards which it flows, in degrees from +x towards +y.
    """

    speed: Annotated[NonNegative, Field(le=FASTEST)] = key("speed_m_per_s")
    direction_deg: Direction = 0.0

    @abstractmethod
    def share(self, height: Array, depth: float) -> Array:
        """Velocity profile, as a fraction of the speed.

        Parameters
        ----------
        height : (n,) array, m
            Above the mean water level.
        depth : float, m
            Water depth.

        Returns
        -------
        (n,) array
        """

    def velocity(self, height: Array, depth: float) -> Array:
        """Velocity; above the mean water level that at the level.

        Parameters
        ----------
        height : (n,) array, m
            Above the mean water level.
        depth : float, m
            Water depth.

        Returns
        -------
        (n, 3) array, m/s
        """
        angle = np.radians(self.direction_deg)
        towards = np.array([np.cos(angle), np.sin(angle), 0.0])
        size = self.speed * self.share(np.minimum(height, 0.0), depth)
        return np.asarray(size[:, None] * towards)


class UniformCurrent(Current):
    """The same at all depths."""

    kind: Literal["uniform"] = "uniform"

    def share(self, height: Array, depth: float) -> Array:
        return np.ones(len(height))


class PowerLawCurrent(Current, kw_only=False):
    """Profile ((z + h) / h)^exponent; 1/7 for tides and surges (IEC 61400-3-1:2019, 6.3.3.3.2).

    Attributes
    ----------
    exponent : float
    """

    kind: Literal["power_law"] = Field(default="power_law", kw_only=True)
    exponent: Annotated[Positive, Field(le=1)] = 1 / 7

    def share(self, height: Array, depth: float) -> Array:
        return np.asarray(np.maximum(1 + height / depth, 0.0) ** self.exponent)


class SurfaceCurrent(Current, kw_only=False):
    """Wind-driven current: linear from the surface down to zero.

    Attributes
    ----------
    reach : float, m
        Depth at which it is zero.
    """

    kind: Literal["surface"] = Field(default="surface", kw_only=True)
    reach: Positive = key("reach_m", default=SURFACE_LAYER)

    def share(self, height: Array, depth: float) -> Array:
        return np.maximum(1 + height / self.reach, 0.0)


class CurrentTable(Current):
    """Profile from a table of factors of the speed, linear in between.

    Above the first and below the last depth the factor is constant; ``speed`` is usually the speed
    where the factor is 1.

    Attributes
    ----------
    depth : tuple of float, m
        Rising depths below the mean water level.
    factor : tuple of float
        Factor of the speed at each depth.
    """

    kind: Literal["table"] = "table"
    depth: Numbers = key("depth_m")
    factor: Numbers

    @model_validator(mode="after")
    def _is_a_table(self) -> CurrentTable:
        if len(self.depth) < 2 or len(self.depth) != len(self.factor):
            raise ValueError(
                f"the table has {len(self.depth)} depths and {len(self.factor)} factors; give two "
                "depths or more, and one factor per depth"
            )
        if np.any(np.diff(self.depth) <= 0) or self.depth[0] < 0:
            raise ValueError(
                "depths must increase strictly from 0; sort them from the surface down"
            )
        fastest = self.speed * max(abs(factor) for factor in self.factor)
        if fastest > FASTEST:
            raise ValueError(
                f"the current reaches {fastest:g} m/s, above {FASTEST:g} m/s; give factors that "
                "multiply the speed, not speeds"
            )
        return self

    def share(self, height: Array, depth: float) -> Array:
        return np.interp(-height, self.depth, self.factor)


SingleCurrent = Annotated[
    UniformCurrent | PowerLawCurrent | SurfaceCurrent | CurrentTable, Field(discriminator="kind")
]


class CurrentSum(Definition, kw_only=False):
    """Sum of several currents, such as a tide and a wind-driven current; a list in a file.

    Attributes
    ----------
    parts : tuple of Current
        Currents to add.
    """

    parts: Annotated[tuple[SingleCurrent, ...], Field(min_length=1)]

    @model_serializer
    def _as_list(self) -> tuple[SingleCurrent, ...]:
        return self.parts

    def velocity(self, height: Array, depth: float) -> Array:
        """Velocity, see :meth:`Current.velocity`.

        Parameters
        ----------
        height : (n,) array, m
            Above the mean water level.
        depth : float, m
            Water depth.

        Returns
        -------
        (n, 3) array, m/s
        """
        return np.sum([part.velocity(height, depth) for part in self.parts], axis=0)


def _one_or_many(value: Any) -> str:
    return "many" if isinstance(value, list | tuple | CurrentSum) else "one"


def _summed(value: Any) -> Any:
    return {"parts": value} if isinstance(value, list | tuple) else value


CurrentChoice = Annotated[
    Annotated[SingleCurrent, Tag("one")]
    | Annotated[CurrentSum, BeforeValidator(_summed), Tag("many")],
    Discriminator(_one_or_many),
]
"""One current, or a list of currents to be summed."""


def mean_velocity(current: Current | CurrentSum, depth: float) -> Array:
    """(3,) mean over the depth in m/s, by Gauss's quadrature on twelve panels."""
    node, weight = np.polynomial.legendre.leggauss(4)
    edges = -depth * np.linspace(0, 1, 13)[::-1] ** 2
    half, middle = np.diff(edges)[:, None] / 2, (edges[1:] + edges[:-1])[:, None] / 2
    height, share = (middle + half * node).ravel(), (half * weight).ravel() / depth
    return np.asarray(share @ current.velocity(height, depth))
