"""Time integration by Pinocchio, recorded by the compiled chain."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.recorder import Recorder
from offwind_pin.dynamics.reference.dense_chain import DenseChain
from offwind_pin.solvers import generalized_alpha


class MovingChain(CompiledChain):
    """A system under loads whose equations of motion are evaluated by Pinocchio.

    Records (motion of the axis, section loads, energies, residual) are evaluated from q, v and a by
    compiled code.
    """

    def start(self, q: Array) -> Array:
        chain = DenseChain(self.equations())
        time_inputs = self.time_inputs(np.zeros(1))[0]
        return generalized_alpha.start(chain, time_inputs, q, np.zeros_like(q))

    def advance(
        self,
        recorder: Recorder,
        method: generalized_alpha.Method,
        vectors: Array,
        instants: Array,
        last: Array,
    ) -> tuple[int, int, float]:
        stepping = _RecordedChain(self, recorder, method.scale)
        time_inputs = self.time_inputs(instants)
        result = generalized_alpha.advance(stepping, method, vectors, time_inputs, last)
        self.memory = stepping.memory
        return result


class _RecordedChain(DenseChain):
    """Pinocchio's equations, whose steps a compiled chain records."""

    def __init__(self, recording: CompiledChain, recorder: Recorder, scale: float) -> None:
        super().__init__(recording.equations())
        self._recording = recording
        self._recorder = recorder
        self._scale = scale

    def observe(self, row: Array, state: Array, iterations: int, size: float) -> None:
        """Record a converged step with the memory used in it, then end it."""
        q, v, a = state[:3]
        self._recording.memory = self.memory
        self._recording.note(self._recorder, row, q, v, a, self._scale, iterations)
        self.equations.commit(float(row[0]), q, v, a)
