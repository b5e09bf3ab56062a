"""This package's own run of problem P, through its public interface.

What is timed is the whole of ``simulate``: the static state, the steps, every section moment and
the dataset. Compiling is not: a short run comes before.
"""

from __future__ import annotations

import numpy as np
import problem_p
from problem import OUTPUT_STEP, PeerRun, output_stride, step_count, stopwatch

import offwind_pin as ow
from offwind_pin.results.dataset import versions

SPECTRAL_RADIUS = 0.9


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s."""
    system = problem_p.system()
    loads = [problem_p.load(system, duration)]
    interval = output_stride(dt) * dt
    method = ow.GeneralizedAlpha(ow.FixedStep(dt), SPECTRAL_RADIUS)
    saved = ow.SaveAt(interval)
    ow.simulate(system, 10 * interval, loads=loads, integrator=method, save_at=saved)
    with stopwatch() as spent:
        data = ow.simulate(system, duration, loads=loads, integrator=method, save_at=saved)
    mudline, boundary = system.turbine.site.mudline, system.chain.boundary
    moment = data["section_moment"].sel(direction="y").to_numpy()
    lower = np.searchsorted(data["height"].to_numpy(), boundary[:-1] - 1e-6)
    modes = ow.modes(system, n=2)
    return PeerRun(
        code="offwind_chain",
        version=versions()["offwind_pin_version"],
        dt=dt,
        steps=step_count(dt, duration),
        wall_s=spent.wall_s,
        cpu_s=spent.cpu_s,
        time=data["time"].to_numpy(),
        seabed_moment=moment[:, np.argmin(np.abs(data["height"].to_numpy() - mudline))],
        section_moment=moment[:, lower],
        section_place="lower end",
        frequency_hz=float(modes.frequency_hz[modes.index("FA1")]),
        notes={
            "integrator": f"generalised-alpha, spectral radius {SPECTRAL_RADIUS}",
            "output_s": max(dt, OUTPUT_STEP),
            "mean_corrections": float(data["solver_iterations"][1:].mean()),
            "largest_residual_over_load_scale": float(data["solver_residual"].max()),
            "moment": "exact cut force from the dynamics",
            "timed": "static state, steps, records, dataset",
        },
    )
