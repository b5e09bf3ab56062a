"""Moments along a pile that its lateral resistance carries: PISA's m-psi springs in sand.

The shear stress on the shaft is a share of the lateral pressure, so that m = |p(y)| c(psi) with a
lever c in m (Burd et al., Geotechnique 70, 2020, pages 1048 to 1066). No energy belongs to that;
what it takes counts as work.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import (
    DISPLACEMENT,
    MOMENT_BY_POSITION,
    MOMENT_BY_TURN,
    TURN,
    KernelLoad,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.soil.curves.laws import SoilCurves, curve_at
from offwind_pin.loads.soil.springs.elastic import deflection_size

_LENGTH, _LEVER, _CURVE = range(3)
"""Columns of a node's constants: tributary length, and where the numbers of the lever's and of the
lateral curve begin."""

_U, _R = DISPLACEMENT.start, TURN.start


@force_kernel
def _forces(motion: Array, constants: Array, row: Array, memory: Array, force: Array) -> float:
    for i in range(len(motion)):
        c = constants[i]
        y, angle = deflection_size(motion[i], _U, 2), deflection_size(motion[i], _R, 2)
        secant, _ = curve_at(c[int(c[_CURVE]) :], y)
        lever, _ = curve_at(c[int(c[_LEVER]) :], angle)
        stiffness = c[_LENGTH] * secant * y * lever
        force[i] = 0.0
        for j in range(2):
            force[i, 3 + j] = -stiffness * motion[i, _R + j]
    return 0.0


@tangent_kernel
def _tangents(motion: Array, constants: Array, row: Array, memory: Array, blocks: Array) -> None:
    for i in range(len(motion)):
        c = constants[i]
        y, angle = deflection_size(motion[i], _U, 2), deflection_size(motion[i], _R, 2)
        secant, tangent = curve_at(c[int(c[_CURVE]) :], y)
        lever, slope = curve_at(c[int(c[_LEVER]) :], angle)
        for j in range(2):
            turn = motion[i, _R + j]
            for k in range(2):
                if y > 0:
                    along = motion[i, _U + k] / y
                    by_size = -c[_LENGTH] * tangent * lever * turn
                    blocks[i, MOMENT_BY_POSITION, j, k] = by_size * along
                if angle > 0:
                    along = motion[i, _R + k] / angle
                    by_angle = -c[_LENGTH] * secant * y * (slope - lever) / angle * turn
                    blocks[i, MOMENT_BY_TURN, j, k] = by_angle * along
            blocks[i, MOMENT_BY_TURN, j, j] -= c[_LENGTH] * secant * y * lever


@dataclass(frozen=True, eq=False)
class FrictionalMoment(KernelLoad):
    """Moments m = |p(y)| c(psi) at the nodes, against the rotation about horizontal axes.

    Attributes
    ----------
    height : (n,) heights of the nodes in m
    tributary_length : (n,) in m
    lateral : p in N/m over y in m
    lever : c in m over psi in rad
    """

    height: Array
    tributary_length: Array
    lateral: SoilCurves
    lever: SoilCurves
    name: str = "soil_friction"

    force_kernel = _forces
    tangent_kernel = _tangents

    @cached_property
    def constants(self) -> Array:
        n, begin = len(self.height), 3
        places = [begin, begin + self.lever.numbers.shape[1]]
        head = np.column_stack([self.tributary_length, np.tile(places, (n, 1))])
        return np.hstack([head, self.lever.numbers, self.lateral.numbers])
