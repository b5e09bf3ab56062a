"""Free decays of one mode from the static state."""

from __future__ import annotations

import numpy as np

from offwind_pin.analysis.integrators import GeneralizedAlpha, Records
from offwind_pin.analysis.modal import modes
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.pencil import CompiledPencil
from offwind_pin.dynamics.system import System
from offwind_pin.solvers.generalized_alpha import start
from offwind_pin.solvers.steps import FixedStep

STEPS = 120
"""Per period: without numerical damping it changes the ratio by less than a thousandth."""


class FreeDecay:
    """A system released in its static state with the velocities of one mode.

    Parameters
    ----------
    system : System
        What moves.
    label : str
        Mode.
    speed : float, m/s
        Of the yaw bearing at first.

    Attributes
    ----------
    modes : ModalResult
        Of the system.
    chain : CompiledChain
        What is integrated.
    motion : MotionState
        Reached so far.
    """

    def __init__(self, system: System, label: str, speed: float) -> None:
        state = static(system)
        self._rest = state.q
        self.modes = modes(system, min(10, system.nv), state)
        self._index = self.modes.index(label)
        self._pencil = CompiledPencil(CompiledChain(system), state.q)
        self.chain = CompiledChain(system)
        self.chain.memory = state.memory
        shape = self.modes.vector[:, self._index]
        top = np.abs(self.modes.mass_normalised[self._index, -1, :2]).max()
        self.step = 1 / self.modes.frequency_hz[self._index] / STEPS
        self._method = GeneralizedAlpha(
            FixedStep(self.step), 1.0, relative_tolerance=1e-13, increment_tolerance=1e-13
        )
        self._sections = self.chain.sections(system.chain.boundary)
        inputs = self.chain.time_inputs(np.zeros(1))[0]
        vectors = start(self.chain, inputs, state.q, speed / top * shape)
        begin = self._method.begin(self.chain, state.q, self.step)
        self.motion = begin._replace(vectors=vectors)

    def advance(self, steps: int) -> Records:
        """Records of further steps."""
        times = self.motion.time + self.step * np.arange(1, steps + 1)
        self.motion, records = self._method.advance(self.chain, self._sections, self.motion, times)
        return records

    @property
    def speeds(self) -> Array:
        """(n,) velocities of all modes, mass-normalised."""
        return np.asarray(self.modes.vector.T @ self._pencil.mass_times(self.motion.vectors[1]))

    def ratio(self, periods: int) -> float:
        """Damping ratio of the mode by the logarithmic decrement over a number of periods."""
        first = self._amplitude
        self.advance(periods * STEPS)
        decrement = np.log(first / self._amplitude) / periods
        return float(decrement / np.hypot(2 * np.pi, decrement))

    @property
    def _amplitude(self) -> float:
        """Of the velocity, whatever the phase."""
        moved = self._pencil.mass_times(self.motion.vectors[0] - self._rest)
        omega = 2 * np.pi * self.modes.frequency_hz[self._index]
        displacement = self.modes.vector[:, self._index] @ moved
        return float(np.hypot(self.speeds[self._index], omega * displacement))
