"""Time histories: from the static state under the mean loads, with every channel recorded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import xarray as xr

from offwind_pin.analysis.static import load_scale, static
from offwind_pin.dynamics.sea import IrregularWaves
from offwind_pin.dynamics.section_loads import SectionCuts
from offwind_pin.dynamics.system import Equations, System, smooth_ramp
from offwind_pin.errors import InputError, InterruptedSimulation, SolverError
from offwind_pin.loads.points import PointLoad
from offwind_pin.loads.tower_top import LoadHistory, TowerTopLoad, constant_load
from offwind_pin.results.dataset import make_dataset
from offwind_pin.solve.generalized_alpha import GeneralizedAlpha, Step, StepFailed
from offwind_pin.structure.urdf import definition_hash
from offwind_pin.turbines.definition import Array

Progress = Callable[[float], None]


def simulate(
    system: System,
    duration: float,
    dt: float = 0.02,
    loads: Sequence[PointLoad | LoadHistory | Array] = (),
    *,
    ramp: float = 0.0,
    output_dt: float | None = None,
    spectral_radius: float = 0.9,
    provenance: dict[str, Any] | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Motion under waves and loads, by generalised-alpha with a converged residual every step.

    The start is the static state under the mean loads. During the ramp, waves and the departures of
    the loads from their means rise to full strength.

    Parameters
    ----------
    duration : simulated time in s, the ramp included
    dt : time step in s
    loads : what acts: at the yaw bearing a constant load (6,) Fx, Fy, Fz, Mx, My, Mz in N and N m
        or a history, whose mean is taken over the time after the ramp; or point loads of one's own
    ramp : seconds over which the fluctuations rise
    output_dt : interval of the output in s, a multiple of dt; by default every step
    spectral_radius : numerical damping at infinite frequency, 1 for none
    provenance : further attributes for the dataset
    progress : called with the simulated time after every step

    Returns
    -------
    Dataset with ``displacement``, ``acceleration``, ``section_force`` and ``section_moment`` over
    time and height (element boundaries), the mudline and tower-top channels, the applied load, the
    waves, and the solver's own account; see ``attrs`` for versions, seeds and settings.

    Raises
    ------
    InputError : an argument that cannot be used, or a history that is too short
    SolverError : a step did not converge; ``results`` holds the dataset so far
    InterruptedSimulation : the user stopped it; ``results`` holds the dataset so far
    """
    every = _check_settings(duration, dt, ramp, output_dt, spectral_radius)
    acting = [_at_yaw_bearing(system, load, ramp, duration) for load in loads]
    start = static(system, loads=acting)
    equations = system.equations(acting, ramp_time=ramp)
    count = round(duration / dt)
    recorder = _Recorder(equations, count // every + 1)
    attributes = _provenance(system, acting, dt, ramp, spectral_radius) | (provenance or {})
    method = GeneralizedAlpha(dt, spectral_radius)
    steps = method.steps(
        equations, start.q, np.zeros(system.nv), count=count, scale=load_scale(system)
    )
    try:
        for step in steps:
            if step.number % every == 0:
                recorder.record(step)
            if progress is not None:
                progress(step.time)
    except StepFailed as failure:
        joint, size = equations.worst_joint(failure.residual)
        raise SolverError(
            "the time step did not converge (a smaller dt may help)",
            time=failure.time,
            step=failure.number,
            joint=joint,
            residual=size,
            results=recorder.dataset(attributes | {"status": "failed"}),
        ) from None
    except KeyboardInterrupt:
        raise InterruptedSimulation(
            recorder.last_time, recorder.dataset(attributes | {"status": "interrupted"})
        ) from None
    return recorder.dataset(attributes | {"status": "complete"})


class _Recorder:
    """Channels of the steps so far, in arrays set aside at the start."""

    def __init__(self, equations: Equations, capacity: int) -> None:
        system = equations.system
        self._equations = equations
        self._cuts = SectionCuts(equations, system.chain.boundary)
        self._tops = [load for load in equations.loads if isinstance(load, TowerTopLoad)]
        self._size = 0
        heights = len(system.chain.boundary)
        self._time = np.zeros(capacity)
        self._displacement = np.zeros((capacity, heights, 3))
        self._acceleration = np.zeros((capacity, heights, 3))
        self._section_load = np.zeros((capacity, heights, 6))
        self._tower_top = np.zeros((capacity, 6))
        self._iterations = np.zeros(capacity, dtype=np.int32)
        self._residual = np.zeros(capacity)

    @property
    def last_time(self) -> float:
        return float(self._time[max(self._size - 1, 0)])

    def record(self, step: Step) -> None:
        i = self._size
        state = self._equations.evaluate(step.time, step.q, step.v, step.a)
        points = state.motion.points(self._cuts.points)
        rise = smooth_ramp(step.time, self._equations.ramp_time)
        self._time[i] = step.time
        self._displacement[i] = points.displacement
        self._acceleration[i] = state.motion.point_acceleration(
            self._cuts.points, points, state.twist_rate
        )
        self._section_load[i] = self._cuts.loads(state, step.q, step.v, step.a)
        for top in self._tops:
            self._tower_top[i] += top.load(step.time, rise)
        self._iterations[i], self._residual[i] = step.iterations, step.residual
        self._size = i + 1

    def dataset(self, attributes: dict[str, Any]) -> xr.Dataset:
        n = self._size
        system = self._equations.system
        time = self._time[:n]
        elevation = np.zeros(n)
        if isinstance(system.sea, IrregularWaves):
            rise = np.array([smooth_ramp(t, self._equations.ramp_time) for t in time])
            elevation = rise * system.sea.realise(system.turbine).elevation(time)
        return make_dataset(
            time,
            system.chain.boundary,
            displacement=self._displacement[:n],
            acceleration=self._acceleration[:n],
            section_load=self._section_load[:n],
            tower_top_load=self._tower_top[:n],
            wave_elevation=elevation,
            iterations=self._iterations[:n],
            residual=self._residual[:n],
            mudline=system.turbine.site.mudline,
            attributes=attributes,
        )


def _check_settings(
    duration: float, dt: float, ramp: float, output_dt: float | None, spectral_radius: float
) -> int:
    """Number of steps between outputs."""
    for name, value, low in (("duration", duration, 0.0), ("dt", dt, 0.0)):
        if not (np.isfinite(value) and value > low):
            raise InputError(name, value, "a positive number of seconds", "Correct it.")
    if not 0 <= ramp < duration:
        raise InputError("ramp", ramp, f"0 to less than the duration ({duration} s)", "Shorten it.")
    if output_dt is not None and not (np.isfinite(output_dt) and output_dt > 0):
        raise InputError("output_dt", output_dt, "a positive number of seconds", "Correct it.")
    if not 0 <= spectral_radius <= 1:
        raise InputError("spectral_radius", spectral_radius, "0 to 1", "Correct it.")
    if abs(duration / dt - round(duration / dt)) > 1e-6:
        raise InputError("duration", duration, f"a multiple of dt = {dt} s", "Adjust one of them.")
    every = 1 if output_dt is None else round(output_dt / dt)
    if every < 1 or (output_dt is not None and abs(every * dt - output_dt) > 1e-9):
        raise InputError(
            "output_dt", output_dt, f"a multiple of dt = {dt} s", "Adjust one of them."
        )
    return every


def _at_yaw_bearing(
    system: System, load: PointLoad | LoadHistory | Array, ramp: float, duration: float
) -> PointLoad:
    if isinstance(load, np.ndarray):
        return constant_load(system.chain.top, load)
    if not isinstance(load, LoadHistory):
        return load
    if load.time[0] > 0 or load.time[-1] < duration - 1e-9:
        raise InputError(
            f"load history {load.origin!r}, time",
            f"{load.time[0]} to {load.time[-1]} s",
            f"samples from 0 to at least {duration} s",
            "Shorten the simulation or extend the file.",
        )
    return TowerTopLoad(system.chain.top, load, load.mean(ramp, duration))


def _provenance(
    system: System, loads: Sequence[PointLoad], dt: float, ramp: float, spectral_radius: float
) -> dict[str, Any]:
    origins = [load.history for load in loads if isinstance(load, TowerTopLoad)]
    surrogates = [system.foundation.surrogate, *(history.surrogate for history in origins)]
    return {
        "turbine": system.turbine.name,
        "definition_sha256": definition_hash(system.turbine),
        "foundation": system.foundation.name,
        "sea": repr(system.sea) if system.sea else "dry",
        "wave_seed": system.sea.seed if isinstance(system.sea, IrregularWaves) else -1,
        "tower_top_load_origin": "; ".join(history.origin for history in origins) or "none",
        "surrogates": " | ".join(text for text in surrogates if text) or "none",
        "elements": system.chain.elements,
        "integrator": "generalised-alpha",
        "dt_s": dt,
        "ramp_s": ramp,
        "spectral_radius": spectral_radius,
        "residual_tolerance": GeneralizedAlpha(dt).relative_tolerance,
    }
