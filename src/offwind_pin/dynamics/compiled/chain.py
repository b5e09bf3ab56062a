"""A system under loads in compiled code: residual, iteration matrix and records in O(N).

Counterpart of :class:`offwind_pin.dynamics.reference.equations.Equations`, which gets the
same residual from Pinocchio; the tests compare the two.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numba.extending import overload

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import announce
from offwind_pin.base.records import Count, Record
from offwind_pin.dynamics.acting_loads import all_loads, base_excitation_of, smooth_ramp
from offwind_pin.dynamics.base_excitation import GROUND_NUMBERS
from offwind_pin.dynamics.compiled.assembly import addresses, make_model
from offwind_pin.dynamics.compiled.coupled import factorise_coupled, solve_coupled
from offwind_pin.dynamics.compiled.ground import ground_power
from offwind_pin.dynamics.compiled.model import Data, Factorisation, Model, State
from offwind_pin.dynamics.compiled.newton_matrix import (
    factorise,
    factorise_kernel,
    solve,
    solve_kernel,
)
from offwind_pin.dynamics.compiled.recorder import (
    Cuts,
    Kernels,
    Recorder,
    Segments,
    inertial_points,
    make_cuts,
    make_recorder,
    make_segments,
    make_soil_nodes,
)
from offwind_pin.dynamics.compiled.recording import (
    add_energies,
    at_cuts,
    imbalances,
    note_kernel,
    record_inertial,
    record_motion,
    store_energies,
    take_note,
)
from offwind_pin.dynamics.compiled.residual import commit, evaluate, state_kernel
from offwind_pin.dynamics.resting_axis import RestingAxis
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import PointLoad, PointMotion
from offwind_pin.loads.root_restraint import FREE
from offwind_pin.solvers import generalized_alpha
from offwind_pin.structure.chain import NDArrayInt

if TYPE_CHECKING:
    from offwind_pin.dynamics.reference.equations import Equations


class Run(Record):
    """A chain and its recorder, and its kernels by address: what generalised-alpha works on."""

    model: Model
    data: Data
    state: State
    factors: Factorisation
    recorder: Recorder
    evaluate: Count
    factorise: Count
    solve: Count
    take_note: Count


class CompiledChain:
    """A system under loads, for statics and motion in time.

    Chains copy and pickle with their state. Two threads may work on copies at the same time.

    Attributes
    ----------
    model : the system as plain arrays; nothing changes it
    data : of the state last evaluated
    state : with the memory of soil and foundation, which :meth:`residual` and others take from it
    factors : the iteration matrix last factorised
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
        self._given = tuple(loads)
        self.acting = all_loads(system, loads)
        self.parts = [load.compiled() for load in self.acting]
        self.loads = [part for parts in self.parts for part in parts]
        self.soil = make_soil_nodes(self.loads)
        restraint = system.foundation.root
        root = FREE if restraint is None else restraint.compiled()
        self._root = root  # known to the model by its place in a register only
        ground = base_excitation_of(system, self.loads, ground_motion)
        self.model = make_model(system, self.loads, root, ground)
        self.data, self.state = Data.of(self.model), State.of(self.model)
        self.factors = Factorisation.of(self.model)
        coupled = len(self.model.coupled.rate) > 0
        self._factorise = factorise_coupled if coupled else factorise
        self._solve = solve_coupled if coupled else solve

    def __reduce__(self) -> tuple[Any, ...]:
        arguments = (self.system, self._given, self.ramp_time, self.ground_motion)
        return type(self), arguments, self.state

    def __setstate__(self, state: State) -> None:
        self.state.set(state)

    def time_inputs(self, time: Array) -> Array:
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

    def residual(self, time_inputs: Array, q: Array, v: Array, a: Array) -> Array:
        """(nv,) generalised forces out of balance, in N and N m.

        time_inputs : one of :meth:`time_inputs`
        """
        self._evaluate(time_inputs, q, v, a)
        return self.data.residual.copy()

    def factorise(
        self, time_inputs: Array, q: Array, v: Array, a: Array, dv_dq: float, da_dq: float
    ) -> None:
        """Make the iteration matrix about a state; both factors zero give the static tangent."""
        self._evaluate(time_inputs, q, v, a)
        with self.running():
            self._factorise(
                self.model, self.data, self.state, self.factors, time_inputs, dv_dq, da_dq
            )

    def correction(self, residual: Array) -> Array:
        """(nv,) solution of the iteration matrix for a right side."""
        self._solve(self.model, self.factors, np.ascontiguousarray(residual, dtype=float))
        return self.factors.solution.copy()

    def _evaluate(self, time_inputs: Array, q: Array, v: Array, a: Array) -> None:
        state = self.state
        state.q[:], state.v[:], state.a[:], state.clock[0] = q, v, a, time_inputs[0]
        with self.running():
            evaluate(self.model, self.data, state, time_inputs)

    def points_at(self, height: Array) -> PointMotion:
        """Motion of points of the axis at heights (m,) in m, in the state last evaluated."""
        chain, data = self.system.chain, self.data
        k = chain.body_at(height)
        rotation, spin = data.rotation[k], data.angular_velocity[k]
        arm = (height - chain.origin[k])[:, None] * rotation[:, :, 2]
        position = data.position[k] + arm
        around = np.cross(spin, arm)
        inward = np.cross(data.angular_acceleration[k], arm) + np.cross(spin, around)
        skew = (rotation - rotation.transpose(0, 2, 1)) / 2
        return PointMotion(
            position=position,
            displacement=position - np.outer(height, [0.0, 0.0, 1.0]),
            velocity=data.velocity[k] + around,
            axis=rotation[:, :, 2].copy(),
            acceleration=data.acceleration[k] + inward,
            rotation_vector=np.column_stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]]),
            angular_velocity=spin,
        )

    def top_jacobian(self) -> Array:
        """(6, nv) velocity and spin of the chain's top per unit joint velocity, in that state.

        Its transpose turns a force and moment there, fixed in the world, into generalised forces.
        """
        linear, angular = np.split(self.data.joint[: self.system.chain.axis_joints], 2, axis=1)
        top = self.points_at(np.array([self.system.chain.top])).position[0]
        jacobian = np.zeros((6, self.system.nv))
        jacobian[:, : len(linear)] = np.hstack([linear + np.cross(angular, top), angular]).T
        return jacobian

    @property
    def memory(self) -> Array:
        """(m,) what soil and foundation keep of their past; a copy."""
        return self.state.memory.copy()

    @memory.setter
    def memory(self, past: Array) -> None:
        self.state.memory[:] = past

    def at_rest(self, time_inputs: Array, q: Array, height: Array) -> RestingAxis:
        """Axis and section loads of a state of rest, which soil and foundation then remember."""
        rest = np.zeros_like(q)
        self._evaluate(time_inputs, q, rest, rest)
        if self._committing:
            with self.running():
                commit(self.model, self.data, self.state, time_inputs)
            self._evaluate(time_inputs, q, rest, rest)
        cuts = make_cuts(self.system, self.model, np.array(height, dtype=float))
        displacement, acceleration = np.zeros((2, len(height), 3))
        load = np.zeros((len(height), 6))
        at_cuts(self.model, self.data, cuts, displacement, acceleration, load)
        return RestingAxis(displacement, self.data.rotation[cuts.body, :, 2], load)

    @property
    def _committing(self) -> bool:
        """Whether anything keeps of its past."""
        return bool(np.any(self.model.commits)) or self.model.restraint_commit != 0

    def start(self, q: Array) -> Array:
        """(6, nv) vectors of generalised-alpha at time 0, at rest at joint displacements."""
        time_inputs = self.time_inputs(np.zeros(1))[0]
        return generalized_alpha.start(self, time_inputs, q, np.zeros_like(q))

    def advance(
        self,
        recorder: Recorder,
        method: generalized_alpha.Method,
        vectors: Array,
        instants: Array,
        last: Array,
    ) -> tuple[int, int, float]:
        """Generalised-alpha's steps to the instants (t,) in s, recorded; see :func:`advance`."""
        time_inputs = self.time_inputs(instants)
        with self.running():
            result: tuple[int, int, float] = generalized_alpha.compiled_advance(
                self.run(recorder), method, vectors, time_inputs, last
            )
        return result

    def unstable_directions(self) -> int:
        """Number of motions away from the factorised static state that need no work.

        By Sylvester's law of inertia it is the number of negative eigenvalues of the pivot blocks,
        symmetrised.
        """
        roots, node = self.model.roots, self.model.node_joints
        pivot = self.factors.pivot
        blocks = (pivot[:1, :roots, :roots], pivot[1:, :node, :node], self.factors.tmd_pivot)
        return sum(
            int(np.sum(np.linalg.eigvalsh((block + block.transpose(0, 2, 1)) / 2) <= 0))
            for block in blocks
            if block.size
        )

    def sections(
        self, height: Array, segments: Sequence[tuple[float, float]] = ()
    ) -> tuple[Cuts, Segments]:
        """Cuts at heights (m,) in m for section loads and motions, and segments between them."""
        cuts = make_cuts(self.system, self.model, np.array(height, dtype=float))
        return cuts, make_segments(self.system, self.model, cuts, segments)

    def recorder(
        self, sections: tuple[Cuts, Segments], every: int = 1, records: int = 1
    ) -> Recorder:
        """An empty recorder of every n-th step, for a number of records."""
        each_step = [*([] if self.ground_motion is None else [ground_power]), add_energies]
        each_record = [record_motion, *([imbalances] if len(sections[1].cut) else [])]
        each_record.append(store_energies)
        if self.system.structural_loads:
            each_record.append(record_inertial)
        kernels = Kernels(
            energies=self._energies,
            commit=commit.address if self._committing else 0,
            at_cuts=at_cuts.address,
            each_step=addresses(each_step),
            each_record=addresses(each_record),
        )
        height = sections[0].height
        inertial = inertial_points(self.system, self.model, self.loads, height)
        return make_recorder(self.model, *sections, self.soil, inertial, kernels, every, records)

    @property
    def _energies(self) -> NDArrayInt:
        """(L,) addresses of the loads' energy kernels; 0 for a load that stores none."""
        addresses = [load.energy_kernel.address if load.stores_energy else 0 for load in self.loads]
        return np.array(addresses, dtype=np.intp)

    @property
    def stores(self) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """(L,) whether each load stores energy, and so does no work of its own."""
        return np.array([load.stores_energy for load in self.loads], bool)

    def run(self, recorder: Recorder) -> Run:
        """What generalised-alpha works on."""
        return Run(
            self.model,
            self.data,
            self.state,
            self.factors,
            recorder,
            evaluate.address,
            self._factorise.address,
            self._solve.address,
            take_note.address,
        )

    def record(
        self, sections: tuple[Cuts, Segments], time_inputs: Array, q: Array, v: Array, a: Array
    ) -> Recorder:
        """One record of a state: motions and section loads at cuts, and energies."""
        recorder = self.recorder(sections)
        self.note(recorder, time_inputs, q, v, a)
        return recorder

    def note(
        self,
        recorder: Recorder,
        time_inputs: Array,
        q: Array,
        v: Array,
        a: Array,
        scale: float = 1.0,
        iterations: int = 0,
    ) -> None:
        """Let a recorder take note of a state; the residual is over a scale."""
        self._evaluate(time_inputs, q, v, a)
        size = float(np.max(np.abs(self.data.residual))) / scale
        with self.running():
            take_note(self.model, self.data, self.state, recorder, time_inputs, iterations, size)

    def equations(self) -> Equations:
        """The same equations of motion by Pinocchio."""
        from offwind_pin.dynamics.reference.equations import Equations

        return Equations(self.system, self._given, self.ramp_time, self.memory, self.ground_motion)

    def worst_joint(self, residual: Array) -> tuple[str, float]:
        """Name and size of the largest entry of a residual."""
        worst = int(np.argmax(np.where(np.isfinite(residual), np.abs(residual), np.inf)))
        return self.system.chain.joint_name[worst], float(abs(residual[worst]))

    @contextmanager
    def running(self) -> Iterator[Self]:
        """Calls of compiled code; in the end raises what a load of the user's own raised."""
        try:
            yield self
        finally:
            for load in self.loads:
                load.raise_failure()


_evaluate, _factorise = state_kernel.call, factorise_kernel.call
_solve, _take_note = solve_kernel.call, note_kernel.call


def _is_run(system: Any) -> bool:
    return system is Run.numba_type()


@overload(generalized_alpha.residual)
def _overload_residual(system: Any, row: Any, q: Any, v: Any, a: Any) -> Any:
    def of_run(system: Any, row: Any, q: Any, v: Any, a: Any) -> Any:
        state = system.state
        for i in range(len(q)):
            state.q[i], state.v[i], state.a[i] = q[i], v[i], a[i]
        state.clock[0] = row[0]
        _evaluate(system.evaluate, (system.model, system.data, state, row))
        return system.data.residual

    return of_run if _is_run(system) else None


@overload(generalized_alpha.factorise)
def _overload_factorise(
    system: Any, row: Any, q: Any, v: Any, a: Any, dv_dq: Any, da_dq: Any
) -> Any:
    def of_run(system: Any, row: Any, q: Any, v: Any, a: Any, dv_dq: Any, da_dq: Any) -> Any:
        # the residual of this state was evaluated last, and its data with it
        arguments = (system.model, system.data, system.state, system.factors, row, dv_dq, da_dq)
        _factorise(system.factorise, arguments)

    return of_run if _is_run(system) else None


@overload(generalized_alpha.correction)
def _overload_correction(system: Any, r: Any) -> Any:
    def of_run(system: Any, r: Any) -> Any:
        _solve(system.solve, (system.model, system.factors, r))
        return system.factors.solution

    return of_run if _is_run(system) else None


@overload(generalized_alpha.observe)
def _overload_observe(system: Any, row: Any, state: Any, iterations: Any, size: Any) -> Any:
    def of_run(system: Any, row: Any, state: Any, iterations: Any, size: Any) -> Any:
        model, data, recorder = system.model, system.data, system.recorder
        _take_note(system.take_note, (model, data, system.state, recorder, row, iterations, size))

    return of_run if _is_run(system) else None
