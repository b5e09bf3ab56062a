"""Natural modes as shapes that a picture can show, made of their results alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.mode_labels import mode_family
from offwind_pin.display.viewer.history_frames import outline
from offwind_pin.display.viewer.mode_motion import PEAK_SHARE, PEAK_TWIST

PEAK_TILT = np.radians(25.0)
"""Largest rotation of a bending mode in rad: a linear shape lengthens the axis by 10 % there."""
RING = 2.5
"""Largest distance in m of the rings of the wall."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """Modes (n,) at the rings (r,) of the wall, at the size in which they are drawn.

    Attributes
    ----------
    label : list of str
        n labels.
    frequency_hz, damping_ratio : (n,) array
    height, radius : (r,) array, m
        Of the rings at rest.
    motion : (n, r, 6) array
        Displacement in m and rotation in rad of each ring's centre at the peak.
    share : (n, r) array
        Displacement, or rotation for torsion, over the largest.
    peak : (n,) array, m or rad
        The largest; in rad for torsion.
    """

    label: list[str]
    frequency_hz: Array
    damping_ratio: Array
    height: Array
    radius: Array
    motion: Array
    share: Array
    peak: Array

    def index(self, label: str) -> int:
        """Position of a label.

        Raises
        ------
        InputError
            No mode of that label.
        """
        if label not in self.label:
            raise InputError("modes", label, ", ".join(self.label), "Choose among them.")
        return self.label.index(label)

    def chosen(self, labels: list[str] | None, most: int) -> list[int]:
        """Positions of the labels asked for, by default of the first modes that bend.

        Raises
        ------
        InputError
            A label that is not there, one asked for twice, or too many.
        """
        if labels is None:
            bending = [i for i, label in enumerate(self.label) if label[:2] in {"FA", "SS"}]
            return sorted((bending or [0])[:most], key=lambda i: (self.label[i][2:], self.label[i]))
        if not 1 <= len(labels) <= most or len(set(labels)) < len(labels):
            allowed = f"1 to {most} different labels"
            raise InputError("modes", ", ".join(labels), allowed, "Choose fewer.")
        return [self.index(label) for label in labels]


def shapes(results: xr.Dataset) -> Shapes:
    """Shapes of natural modes, scaled so that they can be seen.

    The peak is 8 % of the structure's height, or less where the axis would tilt by more than 25
    degrees; a torsional mode turns by 30 degrees. A shape is linear: places move along straight
    lines, in proportion to the amplitude.

    Parameters
    ----------
    results : Dataset
        A dataset of natural modes, in memory or from ``results.nc``.

    Raises
    ------
    InputError
        Results without what a picture needs.
    """
    needed = ("shape", "frequency", "damping_ratio", "outline_height", "outline_diameter")
    missing = [name for name in needed if name not in results]
    if missing:
        raise InputError(
            "results",
            f"no {', '.join(missing)}",
            "natural modes written by this version",
            "Run the case again.",
        )
    height, radius = outline(results, RING)
    at = np.asarray(results.height.values, dtype=float)
    labels = [str(label) for label in results.mode.values]
    motions, shares, peaks = [], [], []
    for label, shape in zip(labels, np.asarray(results["shape"].values, dtype=float), strict=True):
        size = _size(label, shape)
        largest = float(size.max())
        scale = _scale(label, shape, largest, float(at[-1] - at[0]))
        ring = np.column_stack([np.interp(height, at, column) for column in shape.T])
        motions.append(scale * ring)
        shares.append(_size(label, ring) / (largest or 1.0))
        peaks.append(scale * largest)
    return Shapes(
        label=labels,
        frequency_hz=np.asarray(results.frequency.values, dtype=float),
        damping_ratio=np.asarray(results.damping_ratio.values, dtype=float),
        height=height,
        radius=radius,
        motion=np.array(motions),
        share=np.array(shares),
        peak=np.array(peaks),
    )


def _size(label: str, shape: Array) -> Array:
    """(m,) rotation about the axis in torsion, displacement in other modes."""
    if mode_family(label) == "T":
        return np.abs(shape[:, 5])
    return np.asarray(np.linalg.norm(shape[:, :3], axis=1))


def _scale(label: str, shape: Array, largest: float, height: float) -> float:
    if largest == 0:
        return 0.0  # a tuned mass damper on a clamped base moves nothing else
    if mode_family(label) == "T":
        return float(PEAK_TWIST / largest)
    tilt = float(np.linalg.norm(shape[:, 3:5], axis=1).max())
    return float(min(PEAK_SHARE * height / largest, PEAK_TILT / tilt if tilt > 0 else np.inf))
