"""Cost of the kinematics of a long irregular sea: to set up, in a step, and in memory.

The sea of LC 5.1 over hours, which has thousands of components, at the structure's strips. Its part
of a run is what it takes in :func:`offwind_pin.simulate` of the case; runs of the simulation are
short, and a step's time is extrapolated to the hours, which the results say.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import measuring
import numpy as np
from operational_case import NAME, OperationalCase, operational_case

import offwind_pin as ow
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel

SETUP_ALLOWED = 0.05
BLOCK = 1000
"""Steps whose rows are made at once, as in a block of a run of 20 s."""


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure with and without stretching, and write the results."""
    parser = measuring.options("wave_setup", __doc__)
    parser.add_argument("--hours", type=float, default=3.0, help="after which the sea repeats")
    parser.add_argument("--seconds", type=float, default=600.0, help="simulated time of a run")
    given = parser.parse_args(argv)
    whole = 3600 * given.hours
    case = operational_case(given.seconds)
    rows = [row(case, stretching, whole, given.repeats) for stretching in ("none", "wheeler")]
    return measuring.write(
        given.out,
        {
            "case": NAME,
            "hours": given.hours,
            "simulated_s": given.seconds,
            "extrapolated": given.seconds < whole,
            "repeats": given.repeats,
            "rows": rows,
            "targets": [
                measuring.target(
                    f"set-up of the waves over a run of {given.hours:g} h",
                    SETUP_ALLOWED,
                    max(row["setup_over_run"] for row in rows),
                    at_least=False,
                )
            ],
        },
    )


def row(case: OperationalCase, stretching: str, whole: float, repeats: int) -> dict[str, Any]:
    """One kind of stretching: wall times of set-up, rows and run, and what part they are."""
    sea = case.system.sea
    if not isinstance(sea, ow.IrregularWaves):
        raise TypeError(f"{NAME} is no longer a case in irregular waves")
    long = sea.replace(repeat_period=whole, stretching=stretching)
    turbine = case.system.turbine
    running = replace(case, system=replace(case.system, sea=long))
    hydrodynamics = HydrodynamicModel.of(turbine, long)
    steps = case.duration / case.dt
    time = 100.0 + case.dt * np.arange(BLOCK, dtype=float)
    rise = np.ones(BLOCK)
    runs: dict[str, Callable[[int], object]] = {
        "setup": lambda count: [HydrodynamicModel.of(turbine, long) for _ in range(count)],
        "rows": lambda count: [hydrodynamics.water.time_inputs(time, rise) for _ in range(count)],
        "run": lambda count: [running.simulate() for _ in range(count)],
    }
    taken = measuring.rounds(runs, repeats)
    waves = hydrodynamics.surface.waves
    per_step = [t / steps for t in taken["run"]]
    of_run = [
        setup / (whole / case.dt * step)
        for setup, step in zip(taken["setup"], per_step, strict=True)
    ]
    of_step = [r / BLOCK / step for r, step in zip(taken["rows"], per_step, strict=True)]
    return {
        "stretching": stretching,
        "components": 0 if waves is None else len(waves.harmonic),
        "strips": len(hydrodynamics.strips.height),
        "setup_s": statistics.median(taken["setup"]),
        "rows_per_step_s": statistics.median(taken["rows"]) / BLOCK,
        "table_bytes": table_bytes(hydrodynamics),
        "step_s": statistics.median(per_step),
        "setup_over_run": statistics.median(of_run),
        "rows_over_step": statistics.median(of_step),
    }


def table_bytes(hydrodynamics: HydrodynamicModel) -> int:
    """Size of the arrays that the kinematics hold, those of surface and waves included."""
    seen: dict[int, int] = {}

    def collect(thing: object, depth: int) -> None:
        if isinstance(thing, np.ndarray):
            seen[id(thing)] = thing.nbytes
        elif isinstance(thing, list | tuple):
            for part in thing:
                collect(part, depth)
        elif depth and hasattr(thing, "__dict__"):
            for part in vars(thing).values():
                collect(part, depth - 1)

    collect(hydrodynamics.water, 4)
    return sum(seen.values())


if __name__ == "__main__":
    main()
