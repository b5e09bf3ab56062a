"""Moments along a pile due to friction under its lateral resistance: PISA's m-psi springs in sand.

The shear stress on the shaft is proportional to the lateral pressure, so that m = |p(y)| c(psi)
with a lever c in m (Burd et al., Geotechnique 70, 2020, pages 1048 to 1066). There is no stored
energy; its power counts as work.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import ClassVar, NamedTuple

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import ExchangeableKernel
from offwind_pin.base.records import clear, part
from offwind_pin.loads.point_load import (
    DISPLACEMENT,
    MOMENT_BY_POSITION,
    MOMENT_BY_TURN,
    TURN,
    GroupedLoad,
    KernelLoad,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.soil.curves.soil_curve import (
    Indices,
    SoilCurve,
    SoilCurves,
    law_functions,
)
from offwind_pin.loads.soil.springs.elastic import deflection_size

_LENGTH, _LEVER_SIZE, _LEVER = range(3)
"""Columns of a node's constants: tributary length, number of the lever's parameters, and from the
last on these parameters, followed by those of the lateral curve."""

_U, _R, _MOMENT = DISPLACEMENT.start, TURN.start, 3


class _FrictionKernels(NamedTuple):
    force: ExchangeableKernel
    tangent: ExchangeableKernel


@cache
def _friction_kernels(lateral: type[SoilCurve], lever: type[SoilCurve]) -> _FrictionKernels:
    """Kernels of moments for one law of lateral curves and one of levers."""
    secant_at, tangent_at, _, lateral_source = law_functions(lateral)
    lever_at, lever_tangent_at, _, lever_source = law_functions(lever)
    source = lateral_source + lever_source

    @force_kernel
    def friction_moments(
        motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
    ) -> float:
        _source = source
        clear(force)
        for i in range(len(motion)):
            c = constants[i]
            end = _LEVER + int(c[_LEVER_SIZE])
            lever, curve = part(c, _LEVER, end), part(c, end, len(c))
            y, angle = deflection_size(motion[i], _U, 2), deflection_size(motion[i], _R, 2)
            stiffness = c[_LENGTH] * secant_at(curve, y) * y * lever_at(lever, angle)
            for j in range(2):
                force[i, _MOMENT + j] = -stiffness * motion[i, _R + j]
        return 0.0

    @tangent_kernel
    def friction_tangents(
        motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
    ) -> None:
        _source = source
        for i in range(len(motion)):
            c = constants[i]
            end = _LEVER + int(c[_LEVER_SIZE])
            lever, curve = part(c, _LEVER, end), part(c, end, len(c))
            y, angle = deflection_size(motion[i], _U, 2), deflection_size(motion[i], _R, 2)
            secant, tangent = secant_at(curve, y), tangent_at(curve, y)
            arm = lever_at(lever, angle)
            slope = lever_tangent_at(lever, angle)
            for j in range(2):
                turn = motion[i, _R + j]
                for k in range(2):
                    if y > 0:
                        along = motion[i, _U + k] / y
                        by_size = -c[_LENGTH] * tangent * arm * turn
                        blocks[i, MOMENT_BY_POSITION, j, k] = by_size * along
                    if angle > 0:
                        along = motion[i, _R + k] / angle
                        by_angle = -c[_LENGTH] * secant * y * (slope - arm) / angle * turn
                        blocks[i, MOMENT_BY_TURN, j, k] = by_angle * along
                blocks[i, MOMENT_BY_TURN, j, j] -= c[_LENGTH] * secant * y * arm

    return _FrictionKernels(friction_moments, friction_tangents)


@dataclass(frozen=True, eq=False)
class FrictionalMoment(GroupedLoad):
    """Moments m = |p(y)| c(psi) at the nodes, against the rotation about horizontal axes.

    Attributes
    ----------
    height : (n,) array, m
        Heights of the nodes.
    tributary_length : (n,) array, m
    lateral : SoilCurves
        p in N/m over y in m.
    lever : SoilCurves
        c in m over psi in rad.
    """

    height: Array
    tributary_length: Array
    lateral: SoilCurves
    lever: SoilCurves
    name: str = "soil_friction"

    moves_with_ground: ClassVar[bool] = True

    @cached_property
    def groups(self) -> tuple[tuple[Indices, KernelLoad], ...]:
        """Nodes of each pair of laws, with their moments."""
        found = []
        for members, lateral in self.lateral.groups:
            for places, lever in self.lever.at(members).groups:
                nodes = members[places]
                parts = self.height[nodes], self.tributary_length[nodes]
                found.append((nodes, FrictionOfLaws(*parts, lateral.at(places), lever, self.name)))
        return tuple(found)


@dataclass(frozen=True, eq=False)
class FrictionOfLaws(KernelLoad):
    """Moments of :class:`FrictionalMoment` for one law of curves and one of levers."""

    height: Array
    tributary_length: Array
    lateral: SoilCurve
    lever: SoilCurve
    name: str

    moves_with_ground: ClassVar[bool] = True

    @property
    def force_kernel(self) -> ExchangeableKernel:
        return _friction_kernels(type(self.lateral), type(self.lever)).force

    @property
    def tangent_kernel(self) -> ExchangeableKernel:
        return _friction_kernels(type(self.lateral), type(self.lever)).tangent

    @cached_property
    def constants(self) -> Array:
        lever = self.lever.parameters
        size = np.full(len(lever), float(lever.shape[1]))
        return np.column_stack([self.tributary_length, size, lever, self.lateral.parameters])
