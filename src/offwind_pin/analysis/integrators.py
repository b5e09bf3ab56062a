"""Integrators of a system's motion behind one interface: a state and instants in, records out."""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np

from offwind_pin.analysis.static import load_scale
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.engine import Engine
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.recorder import Cuts, Recorder, Segments
from offwind_pin.results.channels import CHANNELS
from offwind_pin.solvers.generalized_alpha import (
    CONVERGED,
    REASONS,
    Method,
)
from offwind_pin.solvers.steps import FixedStep, StepPolicy

_log = logging.getLogger(__name__)


class MotionState(NamedTuple):
    """State of an integration; with the system and the settings it determines all that follows.

    time in s; vectors (6, nv): q, v, acceleration, and auxiliary vectors of the integrator; memory
    (m,) of soil and foundation; energy, power (2, L + 2) of the recorder; steps : number of steps
    of the next interval
    """

    time: float
    vectors: Array
    memory: Array
    energy: Array
    power: Array
    steps: int


class StepFailed(Exception):
    """A step did not converge.

    Parameters
    ----------
    reason : str
        In words.
    time : float, s
        Of the end of the step.
    residual : (nv,) array, N and N m
        The last finite one.
    number : int
        Of the step, counted in the steps that the policy begins with; 0 where it is not known.

    Attributes
    ----------
    advanced : tuple of MotionState and dict of str to array, optional
        State and records of the intervals before it in the same call.
    """

    advanced: tuple[MotionState, Records] | None = None

    def __init__(self, reason: str, time: float, residual: Array, number: int = 0) -> None:
        self.reason = reason
        self.time = time
        self.residual = residual
        self.number = number
        super().__init__(f"{reason} at {time} s")


Sections = tuple[Cuts, Segments]
"""Cuts at which motion and section loads are recorded, and segments whose equilibrium is."""

Records = dict[str, Array]
"""Channels by name, over records first; see :class:`Recorder`."""


class Integrator(ABC):
    """Takes a system from one instant to the next ones: base class of all methods in time.

    A user's own method is most easily a :class:`OneStepMethod`.

    Attributes
    ----------
    engines : tuple of str
        Engines that evaluate the equations of motion for it, the default first.
    """

    engines: ClassVar[tuple[Engine, ...]] = ("compiled",)

    @property
    def time_step(self) -> float | None:
        """Time step in s where all steps have one size, else None."""
        return None

    @abstractmethod
    def begin(self, chain: CompiledChain, q: Array, interval: float) -> MotionState:
        """State at time 0 at rest; the memory of soil and foundation is the chain's.

        Parameters
        ----------
        chain : CompiledChain
            The system under loads.
        q : (nv,) array, m and rad
            Joint displacements.
        interval : float, s
            Between two outputs.

        Returns
        -------
        MotionState
        """

    @abstractmethod
    def advance(
        self, chain: CompiledChain, sections: Sections, state: MotionState, times: Array
    ) -> tuple[MotionState, Records]:
        """Advance to output times.

        Parameters
        ----------
        chain : CompiledChain
            Compiled equations of motion.
        sections : Sections
            Heights and segments to record.
        state : MotionState
            State at the last output.
        times : (t,) array, s
            Output times.

        Returns
        -------
        state : MotionState
            State at the last output.
        records : Records
            Records at all outputs.

        Raises
        ------
        StepFailed
            A step did not converge with any step that the policy allows.
        """

    @abstractmethod
    def describe(self) -> dict[str, Any]:
        """Settings as attributes of the results.

        Returns
        -------
        dict of str to object
        """


class OneStepMethod(Integrator):
    """A method with steps of one size that needs q, v and a at the beginning of a step alone.

    Base class of a user's own integrators, which must have :attr:`time_step`, :meth:`step` and
    :meth:`describe`.
    """

    @property
    @abstractmethod
    def time_step(self) -> float:
        """Time step in s."""

    @abstractmethod
    def step(
        self, chain: CompiledChain, time_inputs: Array, step: float, q: Array, v: Array, a: Array
    ) -> tuple[Array, Array, Array, int]:
        """Take one step.

        Parameters
        ----------
        chain : CompiledChain
            The equations of motion. ``residual(time_inputs, q, v, a)`` gives the generalised forces
            out of balance, (nv,) in N and N m; ``factorise(time_inputs, q, v, a, dv_dq, da_dq)``
            makes the matrix dr/dq + dv_dq dr/dv + da_dq dr/da; ``correction(r)`` solves with it.
        time_inputs : (w,) array
            Of the end of the step; its time in s comes first.
        step : float, s
            Time step.
        q, v, a : (nv,) array
            Joint displacements, velocities and accelerations at the beginning of the step.

        Returns
        -------
        tuple of array, array, array and int
            q, v and a at the end of the step, and the number of Newton iterations.

        Raises
        ------
        StepFailed
            It did not converge.
        """

    def begin(self, chain: CompiledChain, q: Array, interval: float) -> MotionState:
        return _at_start(chain, chain.start(q), FixedStep(self.time_step).first(interval))

    def advance(
        self, chain: CompiledChain, sections: Sections, state: MotionState, times: Array
    ) -> tuple[MotionState, Records]:
        scale = load_scale(chain.system)

        def interval_to(state: MotionState, time: float) -> tuple[MotionState, Records]:
            step = (time - state.time) / state.steps
            recorder = _resumed_recorder(chain, sections, state, state.steps, 1)
            chain.memory = state.memory
            q, v, a = state.vectors[:3]
            instants = np.linspace(state.time, time, state.steps + 1)[1:]
            for row in chain.time_inputs(instants):
                q, v, a, iterations = self.step(chain, row, step, q, v, a)
                chain.note(recorder, row, q, v, a, scale, iterations)
            vectors = np.array([q, v, a, *state.vectors[3:]])
            sums = (recorder.energy, recorder.power)
            after = MotionState(time, vectors, chain.memory, *sums, state.steps)
            return after, _channels(recorder, step)

        return _by_intervals(interval_to, state, times)


class _Advanced(NamedTuple):
    """State after some intervals, records at their ends, and the largest local error of a step."""

    state: MotionState
    records: Records
    error: float


@dataclass(frozen=True)
class GeneralizedAlpha(Integrator):
    """Generalised-alpha with modified Newton.

    Attributes
    ----------
    policy : StepPolicy
        Policy of the step size.
    spectral_radius : float
        Numerical damping at infinite frequency, 1 for none.
    relative_tolerance, increment_tolerance : float
        See :class:`Method`.
    """

    policy: StepPolicy
    spectral_radius: float = 0.9
    relative_tolerance: float = 1e-5
    increment_tolerance: float = 1e-8

    engines: ClassVar[tuple[Engine, ...]] = ("compiled", "pinocchio")

    __repr__ = one_line

    def __post_init__(self) -> None:
        if not 0 <= self.spectral_radius <= 1:
            raise InputError("spectral_radius", self.spectral_radius, "0 to 1", "Correct it.")

    @property
    def time_step(self) -> float | None:
        return self.policy.dt if isinstance(self.policy, FixedStep) else None

    def begin(self, chain: CompiledChain, q: Array, interval: float) -> MotionState:
        return _at_start(chain, chain.start(q), self.policy.first(interval))

    def advance(
        self, chain: CompiledChain, sections: Sections, state: MotionState, times: Array
    ) -> tuple[MotionState, Records]:
        interval = (times[-1] - state.time) / len(times)
        if isinstance(self.policy, FixedStep):
            attempt = self._try(chain, sections, state, times)
            if isinstance(attempt, _Advanced):
                return attempt.state, attempt.records
        return _by_intervals(
            lambda state, time: self._advance_interval(chain, sections, state, time, interval),
            state,
            times,
        )

    def _advance_interval(
        self,
        chain: CompiledChain,
        sections: Sections,
        state: MotionState,
        time: float,
        interval: float,
    ) -> tuple[MotionState, Records]:
        """One interval, repeated with more steps until the policy accepts it."""
        while True:
            attempt = self._try(chain, sections, state, np.array([time]))
            error = attempt.error if isinstance(attempt, _Advanced) else np.inf
            steps = self.policy.next(state.steps, error, interval)
            if isinstance(attempt, _Advanced):
                if steps <= state.steps:
                    return attempt.state._replace(steps=steps), attempt.records
                attempt = _too_inexact(attempt, interval / state.steps)
            else:
                _log.warning("%s at t = %.6g s", attempt.reason, attempt.time)
            if steps > self.policy.most(interval):
                raise attempt
            state = state._replace(steps=steps)

    def _try(
        self, chain: CompiledChain, sections: Sections, state: MotionState, times: Array
    ) -> _Advanced | StepFailed:
        """All intervals up to the instants, each with the state's number of steps."""
        count = state.steps * len(times)
        interval = (times[-1] - state.time) / len(times)
        step = interval / state.steps
        instants = state.time + step * np.arange(1, count + 1)
        method = Method(
            step,
            self.spectral_radius,
            load_scale(chain.system),
            self.relative_tolerance,
            self.increment_tolerance,
        )
        recorder = _resumed_recorder(chain, sections, state, state.steps, len(times))
        vectors, last = state.vectors.copy(), np.zeros(state.vectors.shape[1])
        chain.memory = state.memory
        try:
            done, reason, error = chain.advance(recorder, method, vectors, instants, last)
        except np.linalg.LinAlgError:
            first = float(instants[0])
            number = self._number(first, interval)
            return StepFailed("the iteration matrix is singular", first, last, number)
        if reason != CONVERGED:
            number = self._number(instants[done], interval)
            return StepFailed(REASONS[reason], float(instants[done]), last, number)
        sums = (recorder.energy, recorder.power)
        after = MotionState(float(times[-1]), vectors, chain.memory, *sums, state.steps)
        return _Advanced(after, _channels(recorder, step), float(error))

    def _number(self, time: float, interval: float) -> int:
        """Index of the step that ends at a time, in steps of the policy's first size."""
        return round(time / interval * self.policy.first(interval))

    def describe(self) -> dict[str, Any]:
        return {
            "integrator": "generalised-alpha",
            "spectral_radius": self.spectral_radius,
            "residual_tolerance": self.relative_tolerance,
            "increment_tolerance": self.increment_tolerance,
            **self.policy.describe(),
        }


@dataclass(frozen=True)
class SciPyIVP(Integrator):
    """SciPy's solvers for stiff equations, with the equations of motion by Pinocchio.

    The Jacobian is analytic. This is an independent implementation for checks, not a fast one;
    dissipated energy and work are summed from output to output only.

    Attributes
    ----------
    method : {"Radau", "BDF", "LSODA"}
        Method of :func:`scipy.integrate.solve_ivp`.
    relative_tolerance, absolute_tolerance : float, m and rad
        Tolerances of displacements and of their rates.
    """

    method: Literal["Radau", "BDF", "LSODA"] = "Radau"
    relative_tolerance: float = 1e-8
    absolute_tolerance: float = 1e-10

    engines: ClassVar[tuple[Engine, ...]] = ("pinocchio",)

    __repr__ = one_line

    def begin(self, chain: CompiledChain, q: Array, interval: float) -> MotionState:
        if len(chain.memory):
            raise InputError(
                "integrator",
                f"SciPy's {self.method}",
                "generalised-alpha, for soil or a foundation with memory",
                "Leave the integrator out, or use elastic springs.",
            )
        rest = np.zeros_like(q)
        a = chain.equations().acceleration(0.0, q, rest)
        return _at_start(chain, np.array([q, rest, a, a, a, a]), 1)

    def advance(
        self, chain: CompiledChain, sections: Sections, state: MotionState, times: Array
    ) -> tuple[MotionState, Records]:
        from scipy.integrate import solve_ivp

        equations = chain.equations()
        n = state.vectors.shape[1]

        def rate(time: float, y: Array) -> Array:
            return np.concatenate([y[n:], equations.acceleration(time, y[:n], y[n:])])

        def jacobian(time: float, y: Array) -> Array:
            q, v = y[:n], y[n:]
            a = equations.acceleration(time, q, v)
            stiffness, damping = equations.tangents(time, q, v, a)
            by_state = -np.linalg.solve(equations.mass(q, time), np.hstack([stiffness, damping]))
            return np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), by_state])

        solution = solve_ivp(
            rate,
            (state.time, float(times[-1])),
            np.concatenate(state.vectors[:2]),
            method=self.method,
            t_eval=times,
            rtol=self.relative_tolerance,
            atol=self.absolute_tolerance,
            jac=jacobian,
        )
        if not solution.success:
            time = float(solution.t[-1]) if len(solution.t) else state.time
            reason = f"SciPy's {self.method} failed: {solution.message}"
            raise StepFailed(reason, time, np.zeros(n), len(solution.t))
        recorder = _resumed_recorder(chain, sections, state, 1, len(times))
        vectors = state.vectors
        for time, y in zip(times, solution.y.T, strict=True):
            q, v = y[:n].copy(), y[n:].copy()
            a = equations.acceleration(time, q, v)
            chain.note(
                recorder, chain.time_inputs(np.array([time]))[0], q, v, a, load_scale(chain.system)
            )
            vectors = np.array([q, v, a, a, a, a])
        sums = (recorder.energy, recorder.power)
        after = MotionState(float(times[-1]), vectors, state.memory, *sums, 1)
        return after, _channels(recorder, np.nan)

    def describe(self) -> dict[str, Any]:
        return {
            "integrator": f"SciPy {self.method}",
            "relative_tolerance": self.relative_tolerance,
            "absolute_tolerance": self.absolute_tolerance,
        }


def first_record(
    chain: CompiledChain, sections: Sections, state: MotionState
) -> tuple[MotionState, Records]:
    """Record at the start, and the state with the powers there."""
    recorder = _resumed_recorder(chain, sections, state, 1, 1)
    q, v, a = state.vectors[:3]
    chain.note(recorder, chain.time_inputs(np.zeros(1))[0], q, v, a, load_scale(chain.system))
    sums = np.zeros_like(state.energy)
    return state._replace(energy=sums, power=recorder.power), _channels(recorder, np.nan)


def _by_intervals(
    advance: Callable[[MotionState, float], tuple[MotionState, Records]],
    state: MotionState,
    times: Array,
) -> tuple[MotionState, Records]:
    """One interval after the other; a failure has what came before it."""
    pieces: list[Records] = []
    for time in times.tolist():
        try:
            state, records = advance(state, time)
        except StepFailed as failure:
            failure.advanced = (state, _joined(pieces)) if pieces else None
            raise
        pieces.append(records)
    return state, _joined(pieces)


def _joined(pieces: list[Records]) -> Records:
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def _at_start(chain: CompiledChain, vectors: Array, steps: int) -> MotionState:
    sums = np.zeros((2, len(chain.loads) + 2))
    return MotionState(0.0, vectors, chain.memory, sums, sums, steps)


def _resumed_recorder(
    chain: CompiledChain, sections: Sections, state: MotionState, every: int, records: int
) -> Recorder:
    """A recorder that continues sums from a state; the first record is after ``every`` steps."""
    recorder = chain.recorder(sections, every, records)
    recorder.clock[0] = state.time
    recorder.energy[:], recorder.power[:] = state.energy, state.power
    return recorder


def _too_inexact(attempt: _Advanced, step: float) -> StepFailed:
    reason = f"the local error is still {attempt.error:.3g} with steps of {step:.3g} s"
    nothing = np.zeros(attempt.state.vectors.shape[1])
    return StepFailed(reason, attempt.state.time, nothing, round(attempt.state.time / step))


def _channels(recorder: Recorder, step: float) -> Records:
    """What was recorded, all with steps of one size in s."""
    names = {"time", *(channel.record for channel in CHANNELS)} & Recorder.__annotations__.keys()
    channels = {name: getattr(recorder, name) for name in names}
    channels["iterations"] = recorder.iterations.astype(np.int32)
    return channels | {"step": np.full(len(recorder.time), step)}
