"""The parts of a time step, each timed by calls in a row, and how often a step needs each.

The parts are the package's own kernels, looped over in compiled code.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import measuring  # noqa: F401  (first: one BLAS thread)
import numpy as np
from numba import njit, types
from numba.extending import overload
from numpy.typing import NDArray

from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.analysis.static import load_scale, static
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.compiled.chain import CompiledChain, Run
from offwind_pin.dynamics.compiled.model import evaluation_kernel
from offwind_pin.dynamics.compiled.newton_matrix import factorise_kernel, solve_kernel
from offwind_pin.dynamics.compiled.recording import note_kernel
from offwind_pin.dynamics.compiled.residual import state_kernel
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.solvers import generalized_alpha
from offwind_pin.solvers.generalized_alpha import Method, advance, compiled_advance, start
from offwind_pin.solvers.steps import FixedStep

Array = NDArray[np.float64]

STEPS = 1000
"""In one go, as many as :func:`offwind_pin.simulate` takes between two blocks at dt = 0.02 s."""
SETTLING = 1.0
"""s of motion before the parts are timed."""


@dataclass(frozen=True, eq=False)
class Motion:
    """A chain on its way.

    Attributes
    ----------
    state : (6, nv) after the steps that were counted
    rows : of the next steps
    calls : of each part, for one step
    """

    chain: CompiledChain
    method: Method
    state: Array
    rows: Array
    calls: dict[str, float]


def in_motion(system: System, loads: Sequence[PointLoad], dt: float, steps: int = STEPS) -> Motion:
    """Integrate from the static state in plain Python, which can count, and stop there."""
    chain = CompiledChain(system, loads, ramp_time=SETTLING)
    settings = GeneralizedAlpha(FixedStep(dt))
    method = Method(
        dt,
        settings.spectral_radius,
        load_scale(system),
        settings.relative_tolerance,
        settings.increment_tolerance,
    )
    instants: Array = dt * np.arange(1, 2 * steps + 1, dtype=float)
    rows = chain.time_inputs(instants)
    q = static(system, loads=loads).q
    state = start(chain, chain.time_inputs(np.zeros(1))[0], q, np.zeros_like(q))
    counted = Counted(chain)
    done, reason, _ = advance(counted, method, state, rows[:steps], np.zeros_like(q))
    if done < steps:
        raise RuntimeError(f"step {done} failed (reason {reason}); its time counts for nothing")
    calls = {name: number / steps for name, number in counted.count.items()}
    return Motion(chain, method, state, rows[steps:], calls)


@dataclass
class Counted:
    """A chain for ``advance`` in plain Python that counts what is asked of it."""

    chain: CompiledChain
    count: dict[str, int] = field(
        default_factory=lambda: {"balance": 0, "factorisation": 0, "solution": 0, "correction": 0}
    )

    def residual(self, row: Array, q: Array, v: Array, a: Array) -> Array:
        self.count["balance"] += 1
        return self.chain.residual(row, q, v, a)

    def factorise(
        self, row: Array, q: Array, v: Array, a: Array, dv_dq: float, da_dq: float
    ) -> None:
        self.count["factorisation"] += 1
        self.chain.factorise(row, q, v, a, dv_dq, da_dq)

    def correction(self, residual: Array) -> Array:
        self.count["solution"] += 1
        return self.chain.correction(residual)

    def observe(self, row: Array, state: Array, iterations: int, size: float) -> None:
        self.count["correction"] += iterations


def part_runs(motion: Motion, sections: Any, every: int) -> dict[str, Callable[[int], object]]:
    """Functions that do a part so many times in a row; the last two do a whole block of steps.

    sections : what is recorded; every : steps between records
    """
    chain, row = motion.chain, motion.rows[0]
    q, v, a = motion.state[:3]
    run = chain.run(chain.recorder(sections, every, 1))
    da_dq = 1 / motion.method.step**2
    dv_dq = motion.method.step / 2 * da_dq
    idle, rest = Idle(np.zeros_like(q)), np.zeros_like(motion.state)
    residual = chain.residual(row, q, v, a)
    instants = motion.rows[:, 0].copy()
    chain.factorise(row, q, v, a, dv_dq, da_dq)
    return {
        "motion": lambda n: _evaluations(run, row, 0, 2, n),
        "loads": lambda n: _evaluations(run, row, 2, 3, n),
        "balance": lambda n: _balances(run, row, n),
        "solution": lambda n: _solutions(run, residual, n),
        "factorisation": lambda n: _factorisations(run, row, dv_dq, da_dq, n),
        "notes": lambda n: _notes(run, row, n),
        "idle": lambda n: _idle_advance(idle, motion.method, rest, np.zeros((n, 1)), rest[0]),
        "compiled block": lambda n: compiled_steps(motion, sections, every, n),
        "rows of a block": lambda n: numbers(chain, instants, n),
    }


def seconds_of_a_step(motion: Motion, taken: dict[str, float]) -> dict[str, float]:
    """What each part takes of a whole step of ``simulate``.

    taken : seconds of each of :func:`part_runs`; for one step, those of ``simulate`` and of what it
        does once, its ``start``
    """
    calls, steps = motion.calls, len(motion.rows)
    rows, compiled = taken["rows of a block"] / steps, taken["compiled block"] / steps
    collected = taken["balance"] - taken["motion"] - taken["loads"]
    inside = {
        "forward motion": taken["motion"] * calls["balance"],
        "loads": taken["loads"] * calls["balance"],
        "balance of forces": collected * calls["balance"],
        "solution for a correction": taken["solution"] * calls["solution"],
        "factorisation": taken["factorisation"] * calls["factorisation"],
        "recording and energies": taken["notes"],
        "integrator's arithmetic": taken["idle"],
    }
    return {
        **inside,
        "compiled, not in the above": compiled - sum(inside.values()),
        "waves and load history": rows,
        "static state and start": taken["start"],
        "records into a dataset": taken["simulate"] - taken["start"] - compiled - rows,
    }


def compiled_steps(motion: Motion, sections: Any, every: int, count: int) -> None:
    """Take the motion's next steps in compiled code, again and again."""
    records = len(motion.rows) // every
    last = np.zeros(motion.state.shape[1])
    for _ in range(count):
        recorder = motion.chain.recorder(sections, every, records)
        run = motion.chain.run(recorder)
        done, _, _ = compiled_advance(run, motion.method, motion.state.copy(), motion.rows, last)
        if done < len(motion.rows):
            raise RuntimeError(f"step {done} failed; its time counts for nothing")


def numbers(chain: CompiledChain, instants: Array, count: int) -> None:
    """Wave kinematics and load histories at instants, for a new block of them each time."""
    length = instants[-1] - instants[0] + instants[1] - instants[0]
    for i in range(count):
        chain.time_inputs(instants + (i % 7) * length)


_call_evaluate, _call_factorise = state_kernel.call, factorise_kernel.call
_call_part = evaluation_kernel.call
_call_solve, _call_take_note = solve_kernel.call, note_kernel.call


@kernel
def _evaluations(run: Run, row: Array, first: int, last: int, count: int) -> None:
    """Some of the kernels that evaluate a state: bodies and points move, then loads act."""
    for _ in range(count):
        for i in range(first, last):
            _call_part(run.model.evaluation[i], (run.model, run.data, run.state, row))


@kernel
def _balances(run: Run, row: Array, count: int) -> None:
    for _ in range(count):
        _call_evaluate(run.evaluate, (run.model, run.data, run.state, row))


@kernel
def _solutions(run: Run, residual: Array, count: int) -> None:
    for _ in range(count):
        _call_solve(run.solve, (run.model, run.factors, residual))


@kernel
def _factorisations(run: Run, row: Array, dv_dq: float, da_dq: float, count: int) -> None:
    for _ in range(count):
        arguments = (run.model, run.data, run.state, run.factors, row, dv_dq, da_dq)
        _call_factorise(run.factorise, arguments)


@kernel
def _notes(run: Run, row: Array, count: int) -> None:
    for _ in range(count):
        run.recorder.tally[1] = 0
        arguments = (run.model, run.data, run.state, run.recorder, row, 1, 1.0)
        _call_take_note(run.take_note, arguments)


class Idle(NamedTuple):
    """A system always in equilibrium, to time the integrator's own arithmetic: (n,) zeros."""

    zero: Array


def _is_idle(system: Any) -> bool:
    return isinstance(system, types.NamedUniTuple) and system.instance_class is Idle


@overload(generalized_alpha.residual)
def _residual(system: Any, row: Any, q: Any, v: Any, a: Any) -> Any:
    def of_idle(system: Any, row: Any, q: Any, v: Any, a: Any) -> Any:
        return system.zero

    return of_idle if _is_idle(system) else None


@overload(generalized_alpha.factorise)
def _factorise(system: Any, row: Any, q: Any, v: Any, a: Any, dv_dq: Any, da_dq: Any) -> Any:
    def of_idle(system: Any, row: Any, q: Any, v: Any, a: Any, dv_dq: Any, da_dq: Any) -> Any:
        pass

    return of_idle if _is_idle(system) else None


@overload(generalized_alpha.correction)
def _correction(system: Any, r: Any) -> Any:
    def of_idle(system: Any, r: Any) -> Any:
        return system.zero

    return of_idle if _is_idle(system) else None


@overload(generalized_alpha.observe)
def _observe(system: Any, row: Any, state: Any, iterations: Any, size: Any) -> Any:
    def of_idle(system: Any, row: Any, state: Any, iterations: Any, size: Any) -> Any:
        pass

    return of_idle if _is_idle(system) else None


# Not among the package's kept machine code, which must not refer to a class of a script.
_idle_advance: Any = njit(error_model="numpy")(advance)
