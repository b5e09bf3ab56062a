"""Cost of one time step over the number of elements, in all and by parts.

A step is one of :func:`offwind_pin.simulate` in irregular waves under a tower-top history, with
everything that the call does: static state, section loads at every element at 25 Hz, dataset. It is
held against one call each of Pinocchio's rnea and joint Jacobians on the same model in the same
run. Before anything is timed the run has converged, and the compiled residual is Pinocchio's.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import measuring
import numpy as np
import pinocchio_pair
from numpy.typing import NDArray
from step_parts import STEPS, Motion, in_motion, part_runs, seconds_of_a_step

import offwind_pin as ow
from offwind_pin.analysis.static import load_scale
from offwind_pin.definitions.turbine import RotorNacelleRNA
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.tower_top.load_history import TowerTopLoad

Array = NDArray[np.float64]

ELEMENTS = (20, 40, 80, 160, 320, 640)
DT, EVERY = 0.02, 2
"""Step in s, and steps between outputs."""
SAME_RESIDUAL = 1e-12
LARGEST_COMPARED = 80
"""Elements up to which Pinocchio's whole scratch data is made, to compare with."""
CONVERGED = 1e-5
CALLS = "motion", "loads", "balance", "solution", "factorisation", "notes", "idle"
PAIRS_ALLOWED, PAIRS_AT = 3.0, 80
EXPONENT_ALLOWED, EXPONENT_FROM = 1.2, 40


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure every size, fit the growth, and write the results."""
    parser = measuring.options("step_cost", __doc__)
    parser.add_argument("--elements", type=int, nargs="+", default=ELEMENTS)
    parser.add_argument("--seconds", type=float, default=200.0, help="simulated time of a run")
    parser.add_argument("--steps", type=int, default=STEPS, help="over which calls are counted")
    given = parser.parse_args(argv)
    sizes = [prepare(n, given.seconds, given.steps) for n in given.elements]
    # In each round all sizes take their turn, so that a busy minute does not bend the curve.
    runs = {(size.elements, name): run for size in sizes for name, run in size.runs.items()}
    taken = measuring.rounds(runs, given.repeats)
    rows = [
        row_of(size, {name: taken[size.elements, name] for name in size.runs}, given.seconds)
        for size in sizes
    ]
    return measuring.write(
        given.out,
        {
            "dt_s": DT,
            "output_dt_s": EVERY * DT,
            "simulated_s": given.seconds,
            "repeats": given.repeats,
            "rows": rows,
            **judge(rows),
        },
    )


@dataclass(frozen=True, eq=False)
class Size:
    """One number of elements, checked, with the calls to time and what is known without a clock."""

    elements: int
    motion: Motion
    runs: dict[str, Callable[[int], object]]
    facts: dict[str, Any]


def prepare(elements: int, seconds: float, steps: int) -> Size:
    """Build, check and solve once.

    Raises
    ------
    RuntimeError : the solution has not converged, or its residual is not Pinocchio's
    """
    system, history = operating(elements, seconds)
    load = TowerTopLoad(system.chain.top, history, history.mean(0.0, seconds))
    motion = in_motion(system, [load], DT, steps)
    difference = check(system, [load], motion)
    data = simulate(system, history, seconds)
    largest = float(data["solver_residual"].max())
    if not largest <= CONVERGED:
        raise RuntimeError(f"a step ended with residual {largest:.1e}; its time counts for nothing")
    scratch, kind = pinocchio_pair.scratch_data(system.pin_model)
    runs = part_runs(motion, motion.chain.sections(system.chain.boundary), EVERY)
    runs["simulate"] = lambda count: repeat(count, system, history, seconds)
    runs["start"] = lambda count: repeat(count, system, history, EVERY * DT)
    runs["pair"] = pinocchio_pair.pair(system.pin_model, scratch, *motion.state[:3])
    facts = {
        "elements": elements,
        "degrees_of_freedom": system.nv,
        "mean_corrections": float(data["solver_iterations"][1:].mean()),
        "largest_residual": largest,
        "residual_difference": difference,
        "pinocchio_data": kind,
        "calls": motion.calls,
    }
    return Size(elements, motion, runs, facts)


def row_of(size: Size, taken: dict[str, list[float]], seconds: float) -> dict[str, Any]:
    """Times in s for one number of elements, and the ratio to the pair of calls.

    The step and the pair are medians. The parts are the smallest times of all repeats, so that
    their differences are not those of what else the machine did, and sum to the smallest step.
    """
    for name in ("simulate", "start"):
        taken[name] = [whole / round(seconds / DT) for whole in taken[name]]
    ratios = [a / b for a, b in zip(taken["simulate"], taken["pair"], strict=True)]
    least = {name: min(times) for name, times in taken.items()}
    return {
        **size.facts,
        "step_s": statistics.median(taken["simulate"]),
        "step_smallest_s": least["simulate"],
        "step_largest_s": max(taken["simulate"]),
        "pair_s": statistics.median(taken["pair"]),
        "pair_smallest_s": least["pair"],
        "step_over_pair": statistics.median(ratios),
        "smallest_step_over_smallest_pair": least["simulate"] / least["pair"],
        "parts_s": seconds_of_a_step(size.motion, least),
        "one_call_s": {name: least[name] for name in CALLS},
        "compiled_step_s": least["compiled block"] / len(size.motion.rows),
    }


def operating(elements: int, seconds: float) -> tuple[ow.System, ow.LoadHistory]:
    """OC6 Phase II on distributed springs in the waves and wind of LC 5.1."""
    turbine = ow.load_turbine("oc6_phase2")
    if not isinstance(turbine.rna, RotorNacelleRNA):
        raise TypeError("the turbine has no rotor")
    waves = ow.IrregularWaves(1.25, 5.5, seed=1, repeat_period=max(seconds, 600.0))
    history = ow.SyntheticWind(9.06, 0.388, 0.1, seed=1).generate(
        turbine.rna, duration=seconds, repeat_period=600.0
    )
    return ow.build(turbine, "distributed_springs", waves, elements=elements), history


def simulate(system: ow.System, history: ow.LoadHistory, seconds: float) -> Any:
    """What is timed."""
    return ow.simulate(system, seconds, DT, [history], save_at=ow.SaveAt(EVERY * DT))


def repeat(count: int, system: ow.System, history: ow.LoadHistory, seconds: float) -> None:
    for _ in range(count):
        simulate(system, history, seconds)


def check(system: ow.System, loads: list[PointLoad], motion: Motion) -> float | None:
    """Difference from Pinocchio in the state of motion, where its scratch data can be made.

    Raises
    ------
    RuntimeError : the two do not agree
    """
    if system.chain.elements > LARGEST_COMPARED:
        return None
    row, (q, v, a) = motion.rows[0], motion.state[:3]
    chain: CompiledChain = motion.chain
    ours = chain.residual(row, q, v, a)
    theirs = chain.equations().residual(float(row[0]), q, v, a)
    difference = float(np.max(np.abs(ours - theirs))) / load_scale(system)
    if not difference <= SAME_RESIDUAL:
        raise RuntimeError(f"the residual differs from Pinocchio's by {difference:.1e}")
    pinocchio_pair.check_slim_data(system.pin_model, q, v, a)
    return difference


def judge(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Fitted growth of a step, and the two targets."""
    large = [row for row in rows if row["elements"] >= EXPONENT_FROM]
    sizes = [row["elements"] for row in large]
    growth, least = (
        measuring.exponent(sizes, [row[name] for row in large])
        for name in ("step_s", "step_smallest_s")
    )
    pairs = [row["step_over_pair"] for row in rows if row["elements"] == PAIRS_AT]
    return {
        "exponent": growth,
        "exponent_of_smallest": least,
        "targets": [
            measuring.target(
                f"a step, in pairs of rnea and joint Jacobians, at {PAIRS_AT} elements",
                PAIRS_ALLOWED,
                pairs[0] if pairs else None,
                at_least=False,
            ),
            measuring.target(
                f"exponent of a step's cost over the number of elements, from {EXPONENT_FROM} up",
                EXPONENT_ALLOWED,
                growth,
                at_least=False,
            ),
        ],
    }


if __name__ == "__main__":
    main()
