"""Cost of a step of LC 5.1 with modal structural damping, over that with joint dampers alone.

Both take their turn in pairs. Processor time of the whole call of :func:`offwind_pin.simulate` is
compared, after one of each that nobody counts; the interval is that of the mean of the logarithms.
"""

from __future__ import annotations

import math
import statistics
import time
from dataclasses import replace
from typing import Any

import measuring
from operational_case import NAME, OperationalCase, operational_case

import offwind_pin as ow
from offwind_pin.dynamics.compiled.chain import CompiledChain

ALLOWED = 1.05
_DAMPING = ow.ModalDamping(
    ratios={"FA1": 0.005, "SS1": 0.005, "FA2": 0.0127, "SS2": 0.0133}, others=0.015
)


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Time pairs of runs, and write the ratio."""
    parser = measuring.options("damping_cost", __doc__, repeats=15)
    parser.add_argument("--seconds", type=float, default=60.0, help="simulated time of a run")
    given = parser.parse_args(argv)
    joints = operational_case(given.seconds)
    modal = replace(joints, system=_with_modal_damping(joints.system))
    iterations = [_iterations(case) for case in (joints, modal)]
    pairs = [[_processor_time(case) for case in (joints, modal)] for _ in range(given.repeats)]
    logs = [math.log(after / before) for before, after in pairs]
    mean = statistics.fmean(logs)
    spread = 1.96 * statistics.stdev(logs) / math.sqrt(len(logs)) if len(logs) > 1 else math.inf
    found = [math.exp(mean), math.exp(mean + spread)]
    return measuring.write(
        given.out,
        {
            "case": NAME,
            "simulated_s": given.seconds,
            "pairs_processor_s": pairs,
            "dampers": len(CompiledChain(modal.system).model.coupled.rate),
            "mean_iterations": iterations,
            "ratio": found[0],
            "ratio_upper_95": found[1] if math.isfinite(found[1]) else None,
            "allowed": ALLOWED,
            "within": found[0] <= ALLOWED,
        },
    )


def _with_modal_damping(system: ow.System) -> ow.System:
    turbine = system.turbine.model_copy(update={"structural_damping": _DAMPING})
    return ow.build(turbine, system.foundation, system.sea)


def _iterations(case: OperationalCase) -> float:
    return float(case.simulate()["solver_iterations"][1:].mean())


def _processor_time(case: OperationalCase) -> float:
    begun = time.process_time()
    case.simulate()
    return time.process_time() - begun


if __name__ == "__main__":
    main()
