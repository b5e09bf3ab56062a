"""Hysteretic soil springs: parallel elastic-plastic sliders, after Iwan (1966).

A slider is a spring that yields in the direction of its force once stretched by its yield
deflection. Parallel sliders follow the backbone on first loading and Masing's rule on unloading;
their dissipation depends on the path and not on its rate.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.kernels import inner
from offwind_pin.loads.point_load import (
    KernelLoad,
    commit_kernel,
    energy_kernel,
    force_kernel,
    tangent_kernel,
)
from offwind_pin.loads.soil.curves.soil_curve import Indices, SoilCurves
from offwind_pin.loads.soil.springs.elastic import (
    DAMPING,
    DEFLECTION,
    FIRST,
    FORCE,
    RATE,
    SIZE,
    STIFFNESS,
    SoilSprings,
    SpringComponent,
)

_DASHPOT, _SLIDERS = 7, 8
"""Columns of a node's constants after those of its component: coefficient of the constant dashpot
and number of sliders, followed by their stiffnesses and their yield deflections."""

_ROUNDING = 1e-10
"""Relative excess of a squared yield deflection below which a slider has not yielded."""
_FIRST_SHARE, _LAST_SHARE = 0.02, 0.999
"""Fractions of the ultimate resistance at which the first and the last slider yield."""
_SEARCHED = np.geomspace(1e-9, 10.0, 2001)
"""Deflections in m or rad among which these two are sought."""


@inner
def _stretch(
    values: Array, u: int, components: int, memory: Array, first: int
) -> tuple[float, float, float]:
    """Stretch of a slider, its two components and the square of its size."""
    x = values[u] - memory[first]
    if components == 1:
        return x, 0.0, x * x
    y = values[u + 1] - memory[first + 1]
    return x, y, x * x + y * y


@force_kernel
def _forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    power, first = 0.0, 0
    for i in range(len(motion)):
        c = constants[i]
        u, v, f, components = int(c[DEFLECTION]), int(c[RATE]), int(c[FORCE]), int(c[SIZE])
        sliders = int(c[_SLIDERS])
        along_x = along_y = 0.0
        for j in range(sliders):
            x, y, square = _stretch(motion[i], u, components, memory, first)
            pull, limit = c[_SLIDERS + 1 + j], c[_SLIDERS + 1 + sliders + j]
            if square > limit * limit * (1 + _ROUNDING):
                pull *= limit / np.sqrt(square)
            along_x += pull * x
            along_y += pull * y
            first += components
        for j in range(6):
            force[i, j] = 0.0
        force[i, f] = -along_x
        if components == 2:
            force[i, f + 1] = -along_y
        for j in range(components):
            force[i, f + j] -= c[_DASHPOT] * motion[i, v + j]
            power += c[_DASHPOT] * motion[i, v + j] ** 2
    return power


@tangent_kernel
def _tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    first = 0
    for i in range(len(motion)):
        c = constants[i]
        u, components, sliders = int(c[DEFLECTION]), int(c[SIZE]), int(c[_SLIDERS])
        stiffness, damping, axis = int(c[STIFFNESS]), int(c[DAMPING]), int(c[FIRST])
        block = blocks[i, stiffness]
        for j in range(sliders):
            x, y, square = _stretch(motion[i], u, components, memory, first)
            pull, limit = c[_SLIDERS + 1 + j], c[_SLIDERS + 1 + sliders + j]
            first += components
            if square <= limit * limit * (1 + _ROUNDING):
                block[axis, axis] -= pull
                if components == 2:
                    block[axis + 1, axis + 1] -= pull
            elif components == 2:  # a yielding slider can still change direction
                across = pull * limit / square**1.5
                block[axis, axis] -= across * y * y
                block[axis, axis + 1] += across * x * y
                block[axis + 1, axis] += across * x * y
                block[axis + 1, axis + 1] -= across * x * x
        for j in range(components):
            blocks[i, damping, axis + j, axis + j] = -c[_DASHPOT]


@energy_kernel
def _energy(motion: Array, constants: Array, memory: Array) -> float:
    energy, first = 0.0, 0
    for i in range(len(motion)):
        c = constants[i]
        u, components, sliders = int(c[DEFLECTION]), int(c[SIZE]), int(c[_SLIDERS])
        for j in range(sliders):
            _, _, square = _stretch(motion[i], u, components, memory, first)
            limit = c[_SLIDERS + 1 + sliders + j]
            energy += c[_SLIDERS + 1 + j] * min(square, limit * limit) / 2
            first += components
    return energy


@commit_kernel
def _commit(motion: Array, constants: Array, time_inputs: Array, memory: Array) -> float:
    dissipated, first = 0.0, 0
    for i in range(len(motion)):
        c = constants[i]
        u, components, sliders = int(c[DEFLECTION]), int(c[SIZE]), int(c[_SLIDERS])
        for j in range(sliders):
            x, y, square = _stretch(motion[i], u, components, memory, first)
            limit = c[_SLIDERS + 1 + sliders + j]
            if square > limit * limit * (1 + _ROUNDING):
                size = np.sqrt(square)
                slip = 1 - limit / size
                dissipated += c[_SLIDERS + 1 + j] * limit * slip * size
                memory[first] += slip * x
                if components == 2:
                    memory[first + 1] += slip * y
            first += components
    return dissipated


@dataclass(frozen=True, eq=False)
class HystereticSprings(SoilSprings):
    """Springs whose curves are the backbones of parallel sliders.

    A constant dashpot may act in parallel.

    sliders : number for each spring
    """

    sliders: int = 20

    @cached_property
    def groups(self) -> tuple[tuple[Indices, KernelLoad], ...]:
        """All nodes: sliders are the same for any law of the backbone."""
        n, length = len(self.height), self.tributary_length[:, None]
        stiffness, limit = sliders_of(self.curves, self.sliders, self.name)
        initial = self.curves.secant(np.zeros(n)) * self.tributary_length
        dashpot = initial * self.dashpot.initial_time
        whole = SpringSliders(
            self.name, self.component, self.height, length * stiffness, limit, dashpot
        )
        return ((np.arange(n), whole),)


@dataclass(frozen=True, eq=False)
class SpringSliders(KernelLoad):
    """The sliders of :class:`HystereticSprings`.

    stiffness, limit : (n, s) in N/m and m, or N m/rad and rad; dashpot : (n,) in N s/m or N m s/rad
    """

    name: str
    component: SpringComponent
    height: Array
    stiffness: Array
    limit: Array
    dashpot: Array

    moves_with_ground: ClassVar[bool] = True
    force_kernel = _forces
    tangent_kernel = _tangents
    energy_kernel = _energy
    commit_kernel = _commit

    @cached_property
    def constants(self) -> Array:
        n, sliders = self.stiffness.shape
        head = np.tile(self.component.columns, (n, 1))
        count = np.full(n, float(sliders))
        return np.column_stack([head, self.dashpot, count, self.stiffness, self.limit])

    @property
    def memory_size(self) -> int:
        """Number of slips of the sliders."""
        return self.stiffness.size * self.component.size


def sliders_of(curves: SoilCurves, count: int, name: str = "soil") -> tuple[Array, Array]:
    """Sliders that follow curves on first loading, by chords between their yield deflections.

    Yield deflections are spaced geometrically from where a fiftieth of the ultimate resistance is
    mobilised to where all but a thousandth is; beyond the last one the resistance is constant. A
    linear curve becomes one spring that never yields.

    Returns
    -------
    stiffness : (n, count) array, N/m2
        Per length.
    limit : (n, count) array, m

    Raises
    ------
    InputError
        A curve that falls or stiffens with deflection.
    """
    n = len(curves)
    stiffness, limit = np.zeros((n, count)), np.full((n, count), np.inf)
    resistance = np.array([curves.resistance(np.full(n, y)) for y in _SEARCHED])
    for i, ultimate in enumerate(curves.ultimate):
        if ultimate == 0:
            continue
        if np.isinf(ultimate):
            stiffness[i, 0] = resistance[0, i] / _SEARCHED[0]
            continue
        shares = np.array([_FIRST_SHARE, _LAST_SHARE]) * ultimate
        ends = np.minimum(np.searchsorted(resistance[:, i], shares), len(_SEARCHED) - 1)
        y = np.geomspace(_SEARCHED[ends[0]], _SEARCHED[ends[1]], count)
        p = np.array([curves.resistance(np.full(n, value))[i] for value in y])
        slope = np.diff(p, prepend=0.0) / np.diff(y, prepend=0.0)
        fall = -np.diff(slope, append=0.0)
        if np.any(fall < -1e-9 * slope[0]):
            worst = int(np.argmin(fall))
            raise InputError(
                f"hysteretic springs {name!r}, node {i + 1} of {n}",
                f"a curve that stiffens or falls at a deflection of {y[worst]:.3g}",
                "a resistance with a decreasing slope that never falls",
                "Use a static curve without residual loss (residual_ratio: 1), or a dashpot "
                "instead of hysteretic springs.",
            )
        stiffness[i], limit[i] = np.maximum(fall, 0.0), y
    return stiffness, limit
