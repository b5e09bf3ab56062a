"""Short-crested seas: spreading of wave directions about their mean."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from offwind_pin.base.definition import Array, Definition, Positive

LARGEST_EXPONENT = 1000.0


class Spreading(Definition, kw_only=False):
    """Density of directions about the mean, in two conventions of the exponent.

    Attributes
    ----------
    kind : {"cos_2s", "cos_n"}
        ``"cos_2s"`` for cos^(2 s)((theta - mean) / 2) over the whole circle, whose exponent is s
        (Longuet-Higgins, Cartwright and Smith 1963), or ``"cos_n"`` for cos^n(theta - mean) within
        90 degrees, whose exponent is n; DNV-RP-C205, 3.5.8, has both.
    exponent : float
        s or n; larger values give narrower spreading.
    """

    kind: Literal["cos_2s", "cos_n"]
    exponent: Annotated[Positive, Field(le=LARGEST_EXPONENT)]

    def density(self, angle: Array) -> Array:
        """Density of directions.

        Parameters
        ----------
        angle : (n,) array, rad
            From the mean direction, between -pi and pi.

        Returns
        -------
        (n,) array, 1/rad
        """
        from scipy.special import gammaln

        if self.kind == "cos_2s":
            s = self.exponent
            level = np.exp(gammaln(s + 1) - gammaln(s + 0.5)) / (2 * np.sqrt(np.pi))
            return np.asarray(level * np.cos(angle / 2) ** (2 * s))
        n = self.exponent
        level = np.exp(gammaln(n / 2 + 1) - gammaln(n / 2 + 0.5)) / np.sqrt(np.pi)
        return np.asarray(level * np.maximum(np.cos(angle), 0.0) ** n)

    def angles(self, share: Array) -> Array:
        """Quantiles of the direction, relative to the mean.

        The squared sine of the angle, or of its half, follows a beta distribution.

        Parameters
        ----------
        share : (n,) array
            Cumulative shares from 0 to 1.

        Returns
        -------
        (n,) array, rad
        """
        from scipy.special import betaincinv

        side = 2 * share - 1
        if self.kind == "cos_2s":
            square = betaincinv(0.5, self.exponent + 0.5, np.abs(side))
            return np.asarray(np.sign(side) * 2 * np.arcsin(np.sqrt(square)))
        square = betaincinv(0.5, (self.exponent + 1) / 2, np.abs(side))
        return np.asarray(np.sign(side) * np.arcsin(np.sqrt(square)))

    @property
    def deviation(self) -> float:
        """Circular standard deviation sqrt(2 (1 - E cos(theta - mean))) in rad (Kuik et al. 1988).

        sqrt(2 / (1 + s)) for cos^2s.
        """
        from scipy.special import gammaln

        if self.kind == "cos_2s":
            return float(np.sqrt(2 / (1 + self.exponent)))
        n = self.exponent
        mean_cosine = np.exp(2 * gammaln(n / 2 + 1) - gammaln(n / 2 + 0.5) - gammaln(n / 2 + 1.5))
        return float(np.sqrt(2 * (1 - mean_cosine)))

    @property
    def in_words(self) -> str:
        """Short description for reports."""
        formula = "cos^2s(theta/2), s" if self.kind == "cos_2s" else "cos^n(theta), n"
        return f"spread by {formula} = {self.exponent:g}"
