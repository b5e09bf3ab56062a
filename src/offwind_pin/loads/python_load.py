"""Point loads written in Python, called from compiled code.

Compiled code cannot hold Python objects; it refers to a load by its index in a register.
"""

from __future__ import annotations

import itertools
from weakref import WeakValueDictionary

import numpy as np
from numba import objmode

from offwind_pin.base.channels import Channel
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
    PointForces,
    PointLoad,
    PointMotion,
    PointTangents,
    force_kernel,
    tangent_kernel,
)

_register: WeakValueDictionary[int, PythonLoad] = WeakValueDictionary()
_places = itertools.count()


_PLACE = 0
"""Column of the constants: index in the register."""
_TIME, _RAMP_FACTOR = range(2)
"""Columns of the time inputs."""


def _call_forces(place: float, motion: Array, time_inputs: Array, force: Array) -> float:
    return _register[int(place)].write_forces(motion, time_inputs, force)


def _call_tangents(place: float, motion: Array, time_inputs: Array, blocks: Array) -> None:
    _register[int(place)].write_tangents(motion, time_inputs, blocks)


@force_kernel.allocating
def _forces(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, force: Array
) -> float:
    with objmode(power="float64"):
        power = _call_forces(constants[0, _PLACE], motion, time_inputs, force)
    return power  # noqa: RET504 (a block in object mode cannot return)


@tangent_kernel.allocating
def _tangents(
    motion: Array, constants: Array, time_inputs: Array, memory: Array, blocks: Array
) -> None:
    with objmode():
        _call_tangents(constants[0, _PLACE], motion, time_inputs, blocks)


class PythonLoad(KernelLoad):
    """A load written in Python, wrapped for compiled code; its energy counts as work.

    An exception in the load is stored and its forces become NaN, so that the solver stops; the
    caller of the solver raises it again.
    """

    inertial = True
    force_kernel = _forces
    tangent_kernel = _tangents

    def __init__(self, load: PointLoad) -> None:
        self.load = load
        self._failure: Exception | None = None
        self._place = next(_places)
        _register[self._place] = self

    @property
    def name(self) -> str:
        return self.load.name

    @property
    def height(self) -> Array:
        return self.load.height

    @property
    def moves_with_ground(self) -> bool:  # type: ignore[override]
        return self.load.moves_with_ground

    @property
    def constants(self) -> Array:
        return np.full((len(self.height), 1), float(self._place))

    @property
    def channels(self) -> tuple[Channel, ...]:
        return self.load.channels

    @property
    def surrogate(self) -> str | None:
        return self.load.surrogate

    def outputs(self, time: Array, ramp_factor: Array) -> dict[str, Array]:
        return self.load.outputs(time, ramp_factor)

    def attributes(self) -> dict[str, str]:
        return self.load.attributes()

    def fingerprint(self) -> str:
        return self.load.fingerprint()

    def time_inputs(self, time: Array, ramp_factor: Array) -> Array:
        """(t, 2) time and ramp factor."""
        return np.column_stack([time, ramp_factor])

    def raise_failure(self) -> None:
        if self._failure is not None:
            failure, self._failure = self._failure, None
            raise failure

    def forces(
        self, time: float, motion: PointMotion, ramp_factor: float, memory: Array | None = None
    ) -> PointForces:
        return self.load.forces(time, motion, ramp_factor)

    def tangents(
        self, time: float, motion: PointMotion, ramp_factor: float, memory: Array | None = None
    ) -> PointTangents:
        return self.load.tangents(time, motion, ramp_factor)

    def write_forces(self, motion: Array, time_inputs: Array, force: Array) -> float:
        time, ramp_factor = time_inputs[_TIME], time_inputs[_RAMP_FACTOR]
        try:
            result = self.load.forces(time, _motion(motion), ramp_factor)
        except Exception as failure:
            self._failure = failure
            force[:] = np.nan
            return 0.0
        force[:, :3], force[:, 3:] = result.force, result.moment
        return float(result.dissipation)

    def write_tangents(self, motion: Array, time_inputs: Array, blocks: Array) -> None:
        time, ramp_factor = time_inputs[_TIME], time_inputs[_RAMP_FACTOR]
        try:
            result = self.load.tangents(time, _motion(motion), ramp_factor)
        except Exception as failure:
            self._failure = failure
            blocks[:] = np.nan
            return
        blocks[:] = result.blocks()


def _motion(columns: Array) -> PointMotion:
    """A copy, so that no load can change or keep the solver's arrays."""
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
