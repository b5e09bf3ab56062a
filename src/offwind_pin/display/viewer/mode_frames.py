"""Natural modes as shapes that a picture can show, made of their results alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from scipy.spatial.transform import Rotation

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.display.viewer.history_frames import outline
from offwind_pin.display.viewer.scene import RING
from offwind_pin.display.viewer.springs import Springs, foundation_springs

PEAK_SHARE = 0.08
"""Peak displacement, of the axis or of a tuned mass damper, over the height of the structure."""
PEAK_TWIST = np.radians(30.0)
"""Peak rotation of a torsional mode in rad."""
PEAK_TILT = np.radians(25.0)
"""Largest rotation of a bending mode in rad: a linear shape lengthens the axis by 10 % there."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """Modes (n,) at the rings (r,) of the wall, at the size in which they are drawn.

    Attributes
    ----------
    label : list of str
        n labels.
    family : list of str
        n of FA, SS, T, V: how the axis moves, in a mode of a tuned mass damper as well.
    frequency_hz, damping_ratio : (n,) array
    height, radius : (r,) array, m
        Of the rings at rest.
    motion : (n, r, 6) array, m and rad
        Of each ring's centre at the peak.
    share : (n, r) array
        Displacement, or rotation for torsion, over the largest.
    peak : (n,) array, m or rad
        The largest; in rad for torsion.
    damper_height : (d,) array, m
        Of tuned mass dampers.
    stroke : (n, d, 3) array, m
        Of the dampers at the peak.
    springs : list of Springs
        Of the foundation, for each mode in its plane; the moving ends have the same heights.
    """

    label: list[str]
    family: list[str]
    frequency_hz: Array
    damping_ratio: Array
    height: Array
    radius: Array
    motion: Array
    share: Array
    peak: Array
    damper_height: Array
    stroke: Array
    springs: list[Springs]

    @property
    def size(self) -> float:
        """Height of the structure in m."""
        return float(self.height[-1] - self.height[0])

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
        """Positions of the labels asked for, by default of the first bending modes.

        Raises
        ------
        InputError
            A label that does not exist, one asked for twice, or too many.
        """
        if labels is None:
            bending = [i for i, label in enumerate(self.label) if label[:2] in {"FA", "SS"}]
            return sorted((bending or [0])[:most], key=lambda i: (self.label[i][2:], self.label[i]))
        if not 1 <= len(labels) <= most or len(set(labels)) < len(labels):
            allowed = f"1 to {most} different labels"
            raise InputError("modes", ", ".join(labels), allowed, "Choose fewer.")
        return [self.index(label) for label in labels]

    def motion_at(self, height: Array) -> Array:
        """(n, k, 6) motion of the axis at heights (k,) at the peak, in m and rad."""
        return np.array(
            [
                np.column_stack([np.interp(height, self.height, column) for column in motion.T])
                for motion in self.motion
            ]
        )

    def peak_in_words(self, mode: int) -> str:
        """Amplitude as drawn: a displacement or a rotation, and the stroke of a damper."""
        peak = self.peak[mode]
        words = f"{np.degrees(peak):.0f}°" if self.family[mode] == "T" else f"{peak:.1f} m"
        stroke = float(np.linalg.norm(self.stroke[mode], axis=1).max(initial=0.0))
        return f"{words}, damper stroke {stroke:.1f} m" if stroke else words


def carried(motion: Array, height: Array, offset: Array) -> tuple[Array, Array]:
    """Points fixed to the axis, and how the axis has turned there.

    Parameters
    ----------
    motion : (k, 6) array, m and rad
        Of the axis.
    height : (k,) array, m
    offset : (k, ..., 3) array, m
        Of the points from the axis at rest.

    Returns
    -------
    points : (k, ..., 3) array, m
    turn : (k, 3, 3) array
    """
    turn = Rotation.from_rotvec(motion[:, 3:]).as_matrix().reshape(-1, 3, 3)
    centre = motion[:, :3] + height[:, None] * [0.0, 0.0, 1.0]
    points = np.einsum("kij,k...j->k...i", turn, offset)
    return points + centre.reshape(len(centre), *(1,) * (offset.ndim - 2), 3), turn


def shapes(results: xr.Dataset) -> Shapes:
    """Shapes of natural modes, scaled so that they can be seen.

    The peak is 8 % of the structure's height, or less where the axis would tilt by more than 25
    degrees or a tuned mass damper would slide further; a torsional mode turns by 30 degrees. A
    shape is linear: points move along straight lines, in proportion to the amplitude.

    Parameters
    ----------
    results : Dataset
        Natural modes, in memory or from ``results.nc``.

    Raises
    ------
    InputError
        Results without what a picture needs.
    """
    needed = ("mass_normalised", "frequency", "damping_ratio", "outline_height", "outline_diameter")
    missing = [name for name in needed if name not in results]
    missing += [name for name in ("root",) if name not in results.attrs]
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
    family = [
        str(name) for name in results.family.values[results.participation.argmax("family").values]
    ]
    damper_height, stroke = np.zeros(0), np.zeros((len(labels), 0, 3))
    if "damper_stroke" in results:
        damper_height = np.asarray(results.damper_height.values, dtype=float)
        stroke = np.asarray(results.damper_stroke.values, dtype=float)
    motions, shares, peaks, strokes = [], [], [], []
    normalised = np.asarray(results.mass_normalised.values, dtype=float)
    for name, shape, slid in zip(family, normalised, stroke, strict=True):
        largest = float(_amplitude(name, shape).max())
        scale = _scale(name, shape, slid, float(at[-1] - at[0]))
        ring = np.column_stack([np.interp(height, at, column) for column in shape.T])
        motions.append(scale * ring)
        shares.append(_amplitude(name, ring) / (largest or 1.0))
        peaks.append(scale * largest)
        strokes.append(scale * slid)
    planes = {"SS": np.array([0.0, 1.0, 0.0])}
    return Shapes(
        label=labels,
        family=family,
        frequency_hz=np.asarray(results.frequency.values, dtype=float),
        damping_ratio=np.asarray(results.damping_ratio.values, dtype=float),
        height=height,
        radius=radius,
        motion=np.array(motions),
        share=np.array(shares),
        peak=np.array(peaks),
        damper_height=damper_height,
        stroke=np.array(strokes),
        springs=[
            foundation_springs(results, height, radius, planes.get(name, np.array([1.0, 0.0, 0.0])))
            for name in family
        ],
    )


def _amplitude(family: str, shape: Array) -> Array:
    """(m,) rotation about the axis in torsion, displacement in other modes."""
    if family == "T":
        return np.abs(shape[:, 5])
    return np.asarray(np.linalg.norm(shape[:, :3], axis=1))


def _scale(family: str, shape: Array, stroke: Array, height: float) -> float:
    """The factor at which the first of the limits is reached."""
    limits = [(PEAK_SHARE * height, np.linalg.norm(stroke, axis=1))]
    if family == "T":
        limits.append((PEAK_TWIST, _amplitude("T", shape)))
    else:
        limits.append((PEAK_SHARE * height, _amplitude(family, shape)))
        limits.append((PEAK_TILT, np.linalg.norm(shape[:, 3:5], axis=1)))
    largest = [(limit, float(sizes.max(initial=0.0))) for limit, sizes in limits]
    return min(limit / size for limit, size in largest if size > 0)
