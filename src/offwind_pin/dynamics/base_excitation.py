"""Excitation of a chain by a moving ground, at its base and its soil nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.structure.chain import NDArrayInt


@dataclass(frozen=True, eq=False)
class BaseExcitation:
    """Excitation of P loaded points and, last, the base by a ground motion at D levels.

    levels : D, zero without a ground motion
    level : (P + 1,) level at or below each of them, -1 for points that do not move with the ground
    share : (P + 1,) weight of the next level, from 0 to 1
    """

    levels: int
    level: NDArrayInt
    share: Array

    @staticmethod
    def nowhere(points: int) -> BaseExcitation:
        """No excitation, without an earthquake."""
        return BaseExcitation(0, np.full(points + 1, -1, dtype=np.intp), np.zeros(points + 1))

    @staticmethod
    def of(motion: GroundMotion, height: Array, meets: NDArray[np.bool_]) -> BaseExcitation:
        """Excitation at heights (P + 1,) in m; meets (P + 1,) is whether each moves with the
        ground."""
        level, share = between_levels(motion, height)
        return BaseExcitation(
            len(motion.levels), np.where(meets, level, -1), np.where(meets, share, 0.0)
        )

    def at(self, motion: Array) -> Array:
        """(P + 1, 3, 3) displacement, velocity and acceleration from those of levels (D, 3, 3)."""
        if self.levels == 0:
            return np.zeros((len(self.level), 3, 3))
        above = np.minimum(self.level + 1, self.levels - 1)
        share = self.share[:, None, None]
        both = (1 - share) * motion[self.level] + share * motion[above]
        return np.where((self.level >= 0)[:, None, None], both, 0.0)


def between_levels(motion: GroundMotion, height: Array) -> tuple[NDArrayInt, Array]:
    """(n,) level at or below each height in m, and weight of the next; a single level is
    everywhere."""
    if len(motion.levels) == 1:
        return np.zeros(len(height), dtype=np.intp), np.zeros(len(height))
    levels = motion.levels
    level = np.clip(np.searchsorted(levels, height, side="right") - 1, 0, len(levels) - 2)
    share = (height - levels[level]) / (levels[level + 1] - levels[level])
    return level, np.clip(share, 0.0, 1.0)


_NEARNESS = 1e-6
"""m by which a node may be beyond the first or last level, since heights have rounding errors."""


def check_reach(motion: GroundMotion, base: float, mudline: float) -> None:
    """Reject levels that do not extend from the chain's base to the mudline.

    Raises
    ------
    InputError
        The motion would have to be extrapolated.
    """
    if len(motion.levels) == 1:
        return
    low, high = motion.levels[0], motion.levels[-1]
    if low > base + _NEARNESS or high < mudline - _NEARNESS:
        raise InputError(
            "ground motion, height",
            f"levels from z = {low:g} to {high:g} m",
            f"levels from the base (z = {base:g} m) to the mudline (z = {mudline:g} m)",
            "Add levels, or give one motion for all depths.",
        )


GROUND_NUMBERS = 9
"""Numbers of a level of the ground in a row: displacement, velocity and acceleration."""


BASE = -1
"""Index of the chain's base, after the loaded points."""
