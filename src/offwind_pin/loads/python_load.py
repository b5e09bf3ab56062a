"""Point loads written in Python, called from compiled code.

Numbers cross the border, objects do not: a load is known there by its place in a register.
"""

from __future__ import annotations

import itertools
from weakref import WeakValueDictionary

import numpy as np
from numba import objmode

from offwind_pin.base.definition import Array
from offwind_pin.loads.point_load import (
    ACCELERATION,
    AXIS,
    DISPLACEMENT,
    POSITION,
    SPIN,
    TURN,
    VELOCITY,
    KernelLoad,
    PointLoad,
    PointMotion,
    force_kernel,
    tangent_kernel,
)

_register: WeakValueDictionary[int, PythonLoad] = WeakValueDictionary()
_numbers = itertools.count()


def _call_forces(number: float, motion: Array, row: Array, force: Array) -> float:
    return _register[int(number)].write_forces(motion, row, force)


def _call_tangents(number: float, motion: Array, row: Array, blocks: Array) -> None:
    _register[int(number)].write_tangents(motion, row, blocks)


@force_kernel
def _forces(motion: Array, constants: Array, row: Array, memory: Array, force: Array) -> float:
    with objmode(lost="float64"):
        lost = _call_forces(constants[0, 0], motion, row, force)
    return lost  # noqa: RET504 (a block in object mode cannot return)


@tangent_kernel
def _tangents(motion: Array, constants: Array, row: Array, memory: Array, blocks: Array) -> None:
    with objmode():
        _call_tangents(constants[0, 0], motion, row, blocks)


class PythonLoad(KernelLoad):
    """A load of the user's own, wrapped; what it does to energy counts as work.

    An exception in the load is kept in ``failure``, and its forces become NaN, so that the solver
    stops; whoever called the solver raises it again.
    """

    inertial = True
    force_kernel = _forces
    tangent_kernel = _tangents

    def __init__(self, load: PointLoad) -> None:
        self.load = load
        self.failure: Exception | None = None
        self._number = next(_numbers)
        _register[self._number] = self

    @property
    def name(self) -> str:
        return self.load.name

    @property
    def height(self) -> Array:
        return self.load.height

    @property
    def constants(self) -> Array:
        return np.full((len(self.height), 1), float(self._number))

    def rows(self, time: Array, rise: Array) -> Array:
        """(t, 2) time and rise."""
        return np.column_stack([time, rise])

    def write_forces(self, motion: Array, row: Array, force: Array) -> float:
        try:
            result = self.load.forces(row[0], _motion(motion), row[1])
        except Exception as failure:
            self.failure = failure
            force[:] = np.nan
            return 0.0
        force[:, :3], force[:, 3:] = result.force, result.moment
        return float(result.dissipation)

    def write_tangents(self, motion: Array, row: Array, blocks: Array) -> None:
        try:
            result = self.load.tangents(row[0], _motion(motion), row[1])
        except Exception as failure:
            self.failure = failure
            blocks[:] = np.nan
            return
        blocks[:] = result.blocks()


def as_kernel_load(load: PointLoad) -> KernelLoad:
    """The load itself if its physics is compiled already, else wrapped."""
    return load if isinstance(load, KernelLoad) else PythonLoad(load)


def _motion(columns: Array) -> PointMotion:
    """A copy, so that no load can change or keep what the solver works on."""
    columns = columns.copy()
    return PointMotion(
        columns[:, POSITION],
        columns[:, DISPLACEMENT],
        columns[:, VELOCITY],
        columns[:, AXIS],
        columns[:, ACCELERATION],
        columns[:, TURN],
        columns[:, SPIN],
    )
