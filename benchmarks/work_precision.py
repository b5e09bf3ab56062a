"""Work and precision of the time integrators on problem P: error over wall time and over the step.

The error is that of the fore-aft moment at the mudline: the largest difference over the peak, and
the root mean square over the standard deviation. Over the whole of problem P the package's own
integrators are held against their own solution at a fine step; over its first seconds they and
SciPy's are held against Radau at a tight tolerance, which shares no integrator and, by Pinocchio,
no equations of motion with them.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import measuring
import numpy as np
import problem_p
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.analysis.integrators import GeneralizedAlpha, Integrator, SciPyIVP
from offwind_pin.solvers.steps import AdaptiveStep, FixedStep

Array = NDArray[np.float64]

OUTPUT = 0.05
"""s between the samples that are compared; longer steps are compared where they end."""
STEPS = (0.2, 0.1, 0.05, 0.025, 0.0125, 0.005, 0.0025)
RADII = (1.0, 0.9, 0.5)
STEP_TOLERANCES = (1e-6, 1e-7, 1e-8, 1e-9)
SCIPY_TOLERANCES = (1e-2, 1e-3, 1e-4)
"""Relative; the absolute one is a thousandth."""
TIGHT = 1e-6
FINE = 0.001
SHORT = 2.0


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Solve with every integrator and setting, and write errors and wall times."""
    parser = measuring.options("work_precision", __doc__, repeats=3)
    parser.add_argument("--seconds", type=float, default=problem_p.DURATION)
    parser.add_argument("--short", type=float, default=SHORT, help="s that SciPy solves, too")
    parser.add_argument("--elements", type=int, help="in all, instead of problem P's own 80")
    parser.add_argument("--fine", type=float, default=FINE, help="step in s of the reference")
    parser.add_argument("--tight", type=float, default=TIGHT, help="tolerance of the reference")
    parser.add_argument("--steps", type=float, nargs="+", default=STEPS)
    parser.add_argument("--scipy", type=float, nargs="*", default=SCIPY_TOLERANCES)
    given = parser.parse_args(argv)
    structure = problem_p.system(given.elements)
    fine = Solver("generalised-alpha, radius 1", fixed(1.0, given.fine), dt=given.fine)
    own = list(own_solvers(given.steps))
    scipy = [s for tolerance in given.scipy for s in scipy_solvers(tolerance)]
    radau = Solver("Radau", scipy_ivp("Radau", given.tight), tolerance=given.tight)
    return measuring.write(
        given.out,
        {
            "problem": "P",
            "elements": structure.chain.elements,
            "degrees_of_freedom": structure.nv,
            "repeats": given.repeats,
            "whole": compare(structure, fine, own, given.seconds, given.repeats),
            "first_seconds": compare(
                structure, radau, [*own, *scipy, fine], given.short, given.repeats
            ),
        },
    )


@dataclass(frozen=True)
class Solver:
    """An integrator under a name, with its step in s or its tolerance."""

    family: str
    integrator: Integrator
    dt: float | None = None
    tolerance: float | None = None


def own_solvers(steps: Sequence[float]) -> Iterator[Solver]:
    """The package's own integrators with all their settings; steps in s."""
    for radius in RADII:
        for dt in steps:
            yield Solver(f"generalised-alpha, radius {radius:g}", fixed(radius, dt), dt=dt)
    for tolerance in STEP_TOLERANCES:
        policy = AdaptiveStep(tolerance, largest=OUTPUT)
        yield Solver("adaptive steps", GeneralizedAlpha(policy), tolerance=tolerance)


def fixed(radius: float, dt: float) -> GeneralizedAlpha:
    """Generalised-alpha with steps of one size."""
    return GeneralizedAlpha(FixedStep(dt), spectral_radius=radius)


def scipy_solvers(tolerance: float) -> Iterator[Solver]:
    for method in ("Radau", "BDF", "LSODA"):
        yield Solver(f"SciPy {method}", scipy_ivp(method, tolerance), tolerance=tolerance)


def scipy_ivp(method: Any, tolerance: float) -> SciPyIVP:
    return SciPyIVP(method, relative_tolerance=tolerance, absolute_tolerance=tolerance / 1000)


def compare(
    structure: ow.System, reference: Solver, solvers: list[Solver], seconds: float, repeats: int
) -> dict[str, Any]:
    """Errors of solvers against a reference over so many seconds, and their wall times."""
    exact, _, taken, _ = solve(structure, reference, seconds, 1)
    peak, spread = float(np.max(np.abs(exact))), float(np.std(exact))
    rows = []
    for solver in solvers:
        own = isinstance(solver.integrator, GeneralizedAlpha)
        moment, every, wall, processor = solve(structure, solver, seconds, repeats if own else 1)
        difference = moment - exact[::every]
        rows.append(
            {
                "family": solver.family,
                "dt_s": solver.dt,
                "tolerance": solver.tolerance,
                "wall_s": wall,
                "cpu_s": processor,
                "error_over_peak": float(np.max(np.abs(difference))) / peak,
                "rms_over_deviation": float(np.sqrt(np.mean(difference**2))) / spread,
            }
        )
        print(rows[-1], flush=True)
    return {
        "simulated_s": seconds,
        "reference": reference.family,
        "reference_dt_s": reference.dt,
        "reference_tolerance": reference.tolerance,
        "reference_wall_s": taken,
        "peak_moment_nm": peak,
        "deviation_of_moment_nm": spread,
        "runs": rows,
    }


def solve(
    structure: ow.System, solver: Solver, seconds: float, repeats: int
) -> tuple[Array, int, float, float]:
    """Moment (t,) in N m; common outputs from one to the next; median wall and processor s."""
    every = 1 if solver.dt is None else max(1, round(solver.dt / OUTPUT))
    results: list[Array] = []
    processor: list[float] = []

    def run() -> None:
        output, begun = every * OUTPUT, time.process_time()
        data = problem_p.run(
            output, seconds, structure, output_dt=output, integrator=solver.integrator
        )
        results.append(np.asarray(problem_p.seabed_moment(data)))
        processor.append(time.process_time() - begun)

    wall = measuring.median_wall(run, repeats)
    return results[0], every, wall, statistics.median(processor)


if __name__ == "__main__":
    main()
