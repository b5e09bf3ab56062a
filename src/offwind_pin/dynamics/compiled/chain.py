"""A system under loads in compiled code: residual, iteration matrix and records in O(N).

Counterpart of :class:`offwind_pin.dynamics.reference.equations.Equations`, which gets the
same residual from Pinocchio; the tests compare the two.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numba import types
from numba.extending import overload
from numpy.typing import NDArray

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import announce, exchanging_kernels
from offwind_pin.dynamics.acting_loads import (
    all_loads,
    grounding,
    smooth_ramp,
)
from offwind_pin.dynamics.base_excitation import GROUND_NUMBERS
from offwind_pin.dynamics.compiled.chain_arrays import ChainArrays, chain_arrays
from offwind_pin.dynamics.compiled.newton_matrix import correction, factorise, unstable_directions
from offwind_pin.dynamics.compiled.recorder_arrays import (
    Cuts,
    RecorderArrays,
    Segments,
    make_cuts,
    make_recorder,
    make_segments,
    make_soil_nodes,
)
from offwind_pin.dynamics.compiled.recording import take_note
from offwind_pin.dynamics.compiled.residual import balance, commit
from offwind_pin.dynamics.resting_axis import RestingAxis
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.root_restraint import FREE
from offwind_pin.solvers import generalized_alpha

if TYPE_CHECKING:
    from offwind_pin.dynamics.reference.equations import Equations


class Run(NamedTuple):
    """A chain and its recorder: what generalised-alpha works on."""

    chain: ChainArrays
    recorder: RecorderArrays


class CompiledChain:
    """A system under loads, for statics and motion in time.

    Attributes
    ----------
    arrays : the system as arrays, with the state last evaluated
    acting : loads of water and soil, and those given
    parts : of each of them, as compiled code sees it
    loads : all these parts
    soil : nodes at which the foundation's soil acts
    ground_motion : of the ground below, or None
    """

    def __init__(
        self,
        system: System,
        loads: Sequence[PointLoad] = (),
        ramp_time: float | None = 0.0,
        ground_motion: GroundMotion | None = None,
    ) -> None:
        announce()
        self.system = system
        self.ramp_time = ramp_time
        self.ground_motion = ground_motion
        self._given = loads
        self.acting = all_loads(system, loads)
        self.parts = [load.compiled() for load in self.acting]
        self.loads = [part for parts in self.parts for part in parts]
        self.soil = make_soil_nodes(self.loads)
        root = system.foundation.root
        self._root = FREE if root is None else root.compiled()
        ground = grounding(system, self.loads, ground_motion)
        self.arrays = chain_arrays(system, self.loads, self._root, ground)

    def rows(self, time: Array) -> Array:
        """(t, 1 + w) time, the ground's motion, and the loads' numbers that depend on time alone.

        time : (t,) in s
        """
        ramp_factor = smooth_ramp(time, self.ramp_time)
        inputs = (load.time_inputs(time, ramp_factor) for load in self.loads)
        parts = [np.asarray(time)[:, None], *inputs]
        if self.ground_motion is not None:
            parts.insert(1, self.ground_motion.motion(time).reshape(len(time), -1))
        return np.ascontiguousarray(np.hstack(parts))

    def mean_inputs(self) -> Array:
        """(1 + w,) the same of the means of the loads, on ground at rest."""
        levels = 0 if self.ground_motion is None else len(self.ground_motion.levels)
        parts = [np.zeros(1 + GROUND_NUMBERS * levels)]
        return np.concatenate([*parts, *(load.mean_inputs() for load in self.loads)])

    def residual(self, row: Array, q: Array, v: Array, a: Array) -> Array:
        """(nv,) generalised forces out of balance, in N and N m; row from :meth:`rows`."""
        with self.running():
            return balance(self.arrays, row, q, v, a).copy()

    def factorise(self, row: Array, q: Array, v: Array, a: Array, by_v: float, by_a: float) -> None:
        """Make the iteration matrix about a state; both factors zero give the static tangent."""
        with self.running():
            balance(self.arrays, row, q, v, a)
            factorise(self.arrays, row, by_v, by_a)

    def correction(self, residual: Array) -> Array:
        """(nv,) solution of the iteration matrix for a right side."""
        with exchanging_kernels():
            return correction(self.arrays, residual).copy()

    @property
    def memory(self) -> Array:
        """(m,) what soil and foundation keep of their past; a copy."""
        return self.arrays.memory.copy()

    @memory.setter
    def memory(self, past: Array) -> None:
        self.arrays.memory[:] = past

    def at_rest(self, row: Array, q: Array, height: Array) -> RestingAxis:
        """Axis and section loads of a state of rest, which soil and foundation then remember."""
        rest = np.zeros_like(q)
        self.residual(row, q, rest, rest)
        with self.running():
            commit(self.arrays, row, q)
        record = self.record(self.sections(height), row, q, rest, rest)
        direction = self.arrays.rotation[self.system.chain.body_at(height), :, 2]
        return RestingAxis(record.displacement[0], direction, record.section_load[0])

    def start(self, q: Array) -> Array:
        """(6, nv) vectors of generalised-alpha at time 0, at rest at joint displacements."""
        return generalized_alpha.start(self, self.rows(np.zeros(1))[0], q, np.zeros_like(q))

    def advance(
        self,
        recorder: RecorderArrays,
        method: generalized_alpha.Method,
        vectors: Array,
        instants: Array,
        last: Array,
    ) -> tuple[int, int, float]:
        """Generalised-alpha's steps to the instants (t,) in s, recorded; see :func:`advance`."""
        rows = self.rows(instants)
        with self.running():
            result: tuple[int, int, float] = generalized_alpha.compiled_advance(
                Run(self.arrays, recorder), method, vectors, rows, last
            )
        return result

    def unstable_directions(self) -> int:
        """Number of motions away from the factorised static state that need no work."""
        with exchanging_kernels():
            return int(unstable_directions(self.arrays))

    def sections(
        self, height: Array, segments: Sequence[tuple[float, float]] = ()
    ) -> tuple[Cuts, Segments]:
        """Cuts at heights (m,) in m for section loads and motions, and segments between them."""
        cuts = make_cuts(self.system, self.arrays, np.array(height, dtype=float))
        return cuts, make_segments(self.system, self.arrays, cuts, segments)

    def recorder(
        self, sections: tuple[Cuts, Segments], every: int = 1, records: int = 1
    ) -> RecorderArrays:
        """An empty recorder that takes every so manieth step, for a number of records."""
        return make_recorder(self.arrays, *sections, self.soil, self.stores, every, records)

    @property
    def stores(self) -> NDArray[np.bool_]:
        """(L,) whether each load stores energy, and so does no work of its own."""
        return np.array([load.stores_energy for load in self.loads], dtype=np.bool_)

    def record(
        self, sections: tuple[Cuts, Segments], row: Array, q: Array, v: Array, a: Array
    ) -> RecorderArrays:
        """One record of a state: motions and section loads at cuts, and energies."""
        recorder = self.recorder(sections)
        self.note(recorder, row, q, v, a)
        return recorder

    def note(
        self,
        recorder: RecorderArrays,
        row: Array,
        q: Array,
        v: Array,
        a: Array,
        scale: float = 1.0,
        iterations: int = 0,
    ) -> None:
        """Let a recorder take note of a state; the residual is over a scale."""
        with self.running():
            size = float(np.max(np.abs(balance(self.arrays, row, q, v, a)))) / scale
            take_note(self.arrays, recorder, row, q, v, iterations, size)

    def equations(self) -> Equations:
        """The same equations of motion by Pinocchio."""
        from offwind_pin.dynamics.reference.equations import Equations

        return Equations(self.system, self._given, self.ramp_time, self.memory, self.ground_motion)

    def worst_joint(self, residual: Array) -> tuple[str, float]:
        """Name and size of the largest entry of a residual."""
        worst = int(np.argmax(np.where(np.isfinite(residual), np.abs(residual), np.inf)))
        return self.system.chain.joint_name[worst], float(abs(residual[worst]))

    @contextmanager
    def running(self) -> Iterator[None]:
        """Calls of compiled code; in the end raises what a load of the user's own raised."""
        try:
            with exchanging_kernels():
                yield
        finally:
            for load in self.loads:
                load.raise_failure()


def _is_run(system: Any) -> bool:
    return isinstance(system, types.NamedTuple) and system.instance_class is Run


@overload(generalized_alpha.residual)
def _residual(system: Any, row: Any, q: Any, v: Any, a: Any) -> Any:
    def of_run(system: Any, row: Any, q: Any, v: Any, a: Any) -> Any:
        return balance(system.chain, row, q, v, a)

    return of_run if _is_run(system) else None


@overload(generalized_alpha.factorise)
def _factorise(system: Any, row: Any, q: Any, v: Any, a: Any, by_v: Any, by_a: Any) -> Any:
    def of_run(system: Any, row: Any, q: Any, v: Any, a: Any, by_v: Any, by_a: Any) -> Any:
        factorise(system.chain, row, by_v, by_a)

    return of_run if _is_run(system) else None


@overload(generalized_alpha.correction)
def _correction(system: Any, r: Any) -> Any:
    def of_run(system: Any, r: Any) -> Any:
        return correction(system.chain, r)

    return of_run if _is_run(system) else None


@overload(generalized_alpha.observe)
def _observe(system: Any, row: Any, state: Any, iterations: Any, size: Any) -> Any:
    def of_run(system: Any, row: Any, state: Any, iterations: Any, size: Any) -> Any:
        take_note(system.chain, system.recorder, row, state[0], state[1], iterations, size)

    return of_run if _is_run(system) else None
