"""The compiled chain against Pinocchio: residual, statics, modes and motion."""

from __future__ import annotations

from functools import cache

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.registry import FOUNDATIONS
from offwind_pin.analysis.integrators import GeneralizedAlpha
from offwind_pin.analysis.modal import modes
from offwind_pin.analysis.simulate import simulate
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.definitions.engine import Engine
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.irregular_waves import IrregularWaves
from offwind_pin.loads.tower_top.load_history import LoadHistory
from offwind_pin.solvers.steps import FixedStep

_LOAD = np.array([1e6, 2e5, -1e5, 3e6, 2e7, 1e6])
"""At the yaw bearing in N and N m."""
_TIME = 7.0
_ENGINES: tuple[Engine, ...] = ("compiled", "pinocchio")


@cache
def _system(foundation: str = "distributed_springs") -> System:
    waves = IrregularWaves(2.0, 6.0, seed=3, repeat_period=60.0)
    return build(load_turbine("oc6_phase2"), foundation, waves, elements=10)


def residual() -> float:
    """Largest difference over the largest entry, forces and moments apart, in a random state."""
    system = _system()
    q, v, a = 0.1 * np.random.default_rng(1).uniform(-1, 1, (3, system.nv))
    chain = CompiledChain(system)
    ours = chain.residual(chain.time_inputs(np.array([_TIME]))[0], q, v, a)
    other = system.equations().residual(_TIME, q, v, a)
    slides = np.array([name[-2] == "p" for name in system.chain.joint_name])
    return max(_difference(ours[kind], other[kind]) for kind in (slides, ~slides))


def static_states() -> float:
    """Largest difference of displacements and section loads, over all foundations."""
    found = 0.0
    for foundation in FOUNDATIONS:
        one, other = (static(_system(foundation), _LOAD, engine=name) for name in _ENGINES)
        for part in ("displacement", "rotation", "section_load"):
            found = max(found, _difference(getattr(one, part), getattr(other, part)))
    return found


def frequencies(count: int) -> float:
    """Largest relative difference of the lowest natural frequencies."""
    one, other = (modes(_system(), count, engine=name).frequency_hz for name in _ENGINES)
    return float(np.max(np.abs(one / other - 1)))


def motion(duration: float) -> float:
    """Largest difference of displacements, section loads and energies over their peaks."""
    time = np.linspace(0.0, duration, 401)
    swell = np.sin(np.pi * time / duration) ** 2
    push = LoadHistory(time, np.outer(swell, _LOAD), "push")
    one, other = (
        simulate(
            _system(),
            duration,
            loads=[push],
            ramp=duration / 4,
            integrator=GeneralizedAlpha(FixedStep(0.02), 0.9, 1e-12, 1e-13),
            engine=name,
        )
        for name in _ENGINES
    )
    channels = ("displacement", "section_force", "section_moment", "energy_stored")
    return max(_difference(one[name].to_numpy(), other[name].to_numpy()) for name in channels)


def _difference(value: Array, reference: Array) -> float:
    return float(np.max(np.abs(value - reference)) / np.max(np.abs(reference)))
