"""Cost of one time step, of its parts, and of statics and modes, over the number of elements.

Writes JSON. Medians of repeats; the ratio to one call of Pinocchio's rnea and joint Jacobians in
the same run says how far a step is from the least that it needs. Run with one BLAS thread.
"""

from __future__ import annotations

import argparse
import json
import platform
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin

import offwind_pin as ow

ELEMENTS = (20, 40, 80)


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure, check that each run is right before it counts, and write the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/benchmarks/step_cost.json"))
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=10.0, help="simulated time of a run")
    arguments = parser.parse_args(argv)
    rows = [measure(n, arguments.repeats, arguments.seconds) for n in ELEMENTS]
    report = {"machine": platform.processor() or platform.machine(), "rows": rows}
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(json.dumps(report, indent=2) + "\n")
    print(json.dumps(report, indent=2))
    return report


def measure(elements: int, repeats: int, seconds: float) -> dict[str, Any]:
    """Medians in seconds for one number of elements, and the ratio to Pinocchio's own calls."""
    turbine = ow.load_turbine("oc6_phase2")
    waves = ow.IrregularWaves(1.25, 5.5, seed=1, repeat_period=600.0)
    system = ow.build(turbine, "distributed_springs", waves, elements=elements)
    state = ow.static(system)
    dt = 0.02
    history = ow.simulate(system, seconds, dt, output_dt=0.1)
    if float(history["solver_residual"].max()) > 1e-8:
        raise RuntimeError("the run did not converge; its time counts for nothing")
    step = median(lambda: ow.simulate(system, seconds, dt, output_dt=0.1), repeats) * dt / seconds
    rigid = median(lambda: rigid_body_calls(system, state.q, 1000), repeats) / 1000
    return {
        "elements": elements,
        "degrees_of_freedom": system.nv,
        "step_s": step,
        "mean_iterations": float(history["solver_iterations"][1:].mean()),
        "rnea_and_jacobians_s": rigid,
        "step_over_rnea_and_jacobians": step / rigid,
        "static_s": median(lambda: ow.static(system), repeats),
        "modes_s": median(lambda: ow.modes(system, 8, state), repeats),
    }


def rigid_body_calls(system: ow.System, q: np.ndarray[Any, Any], count: int) -> None:
    """What any integrator with this model has to call at least once a step."""
    model, data = system.pin_model, system.scratch.data
    v = np.zeros(model.nv)
    for _ in range(count):
        pin.rnea(model, data, q, v, v)
        pin.computeJointJacobians(model, data, q)


def median(run: Callable[[], object], repeats: int) -> float:
    """Median wall time of a call in s."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


if __name__ == "__main__":
    main()
