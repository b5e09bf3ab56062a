"""Work and precision of several codes on problem P: the largest step within an error, and its cost.

For each code: a fine solution of its own, checked against our statics and modes and against the
other codes; then the error of every step size, the largest step within 2 % and 0.2 %, and the
median time there. Writes JSON. Run with one BLAS thread.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.append(str(Path(__file__).parents[1]))

import measuring
from problem import PeerRun
from problem_p import DURATION
from reference import expectations
from worker import FailedRunError, NotInstalledError, run_apart

Indices = NDArray[np.intp]

STEPS = (0.2, 0.1, 0.05, 0.025, 0.05 / 3, 0.0125, 0.01, 0.00625, 0.005, 0.0025, 0.00125)
"""Step sizes in s, largest first; the short ones divide the output interval."""
LIMITS = (0.02, 0.002)
"""Errors for which the largest step is sought, largest first."""
FINE_CHANGE = 2e-4
"""A solution is fine when halving the step changes it by less than this."""
FINEST_STEP = 3e-4
CHECK_TOLERANCE = 0.01
AGREEMENT = 0.05
"""Largest difference between the fine solutions of two codes, over the largest moment."""


@dataclass(frozen=True)
class Entry:
    """A code: module with ``run(dt, duration)``, and the step in s at which to look for fine."""

    module: str
    first_fine_step: float = 0.005


FASTER = {
    ("opensees_pdelta", 0.02): 10.0,
    ("opensees_pdelta", 0.002): 5.0,
    ("opensees_corotational", 0.02): 50.0,
    ("opensees_corotational", 0.002): 25.0,
}
"""Ratios asked for, by peer and error."""

ENTRIES = (
    Entry("offwind_chain"),
    Entry("opensees_pdelta"),
    Entry("opensees_pdelta_linear"),
    Entry("opensees_planar"),
    Entry("opensees_corotational"),
    Entry("exudyn_chain"),
    Entry("mujoco_chain", first_fine_step=0.00125),
)


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Compare the codes and write the results."""
    names = [entry.module for entry in ENTRIES]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/benchmarks/peers.json"))
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--only", nargs="+", choices=names, default=names)
    arguments = parser.parse_args(argv)
    before = os.getloadavg()
    expected = expectations()
    rows: dict[str, Any] = {}
    fine: dict[str, PeerRun] = {}
    for entry in ENTRIES:
        if entry.module in arguments.only:
            rows[entry.module], solution = measure(entry, expected, arguments.repeats)
            if solution is not None:
                fine[entry.module] = solution
            print(json.dumps({entry.module: rows[entry.module]}, indent=2), flush=True)
    return measuring.write(
        arguments.out,
        {
            "load_average_before": before[0],
            "expected": expected,
            "rows": rows,
            "agreement": agreement(fine),
            "targets": targets(rows),
        },
    )


def targets(rows: dict[str, Any]) -> list[dict[str, Any]]:
    """How many times faster ours must be, and is, on the wall, at each error."""
    found = []
    for (module, limit), allowed in FASTER.items():
        both = [rows.get(name, {}).get("within", {}) for name in (module, "offwind_chain")]
        there = all(str(limit) in within for within in both)
        theirs, ours = (within[str(limit)]["wall_s"] if there else 1.0 for within in both)
        what = f"wall time of {module} over ours at {100 * limit:g} % error"
        found.append(
            measuring.target(what, allowed, theirs / ours if there else None, at_least=True)
        )
    return found


def measure(
    entry: Entry, expected: dict[str, float], repeats: int
) -> tuple[dict[str, Any], PeerRun | None]:
    """Table of one code and its fine solution; without one the table says why."""

    def run(dt: float) -> PeerRun:
        return run_apart(entry.module, dt, DURATION)

    try:
        fine, change = fine_solution(run, entry.first_fine_step)
    except NotInstalledError as reason:
        return {"status": f"not run: {reason}"}, None
    except FailedRunError as reason:
        return {"status": f"failed: {reason}"}, None
    checks = check(fine, expected)
    row: dict[str, Any] = {
        "status": "checked" if all(c["passed"] for c in checks.values()) else "wrong",
        "version": fine.version,
        "notes": fine.notes,
        "section_moment_at": fine.section_place,
        "checks": checks,
        "fine": {"dt_s": fine.dt, "change_from_double_step": change, "wall_s": fine.wall_s},
    }
    if row["status"] == "checked":
        row["steps"], row["within"] = search(run, fine, repeats)
    return row, fine


def fine_solution(run: Callable[[float], PeerRun], dt: float) -> tuple[PeerRun, float]:
    """Halve the step until the solution hardly changes; the last one and its change.

    Raises
    ------
    FailedRunError : a run fails, or the finest step allowed is not fine enough
    """
    coarse = run(dt)
    while dt > FINEST_STEP:
        dt /= 2
        fine = run(dt)
        change = errors(coarse, fine)["peak"]
        if change < FINE_CHANGE:
            return fine, change
        coarse = fine
    raise FailedRunError(f"halving the step to {dt} s still changes the solution by {change:.1e}")


def check(fine: PeerRun, expected: dict[str, float]) -> dict[str, dict[str, Any]]:
    """Frequency, moment under gravity and mean moment beside ours."""
    found = {
        "seabed_moment_gravity_nm": float(fine.seabed_moment[0]),
        "seabed_moment_mean_nm": float(fine.seabed_moment.mean()),
    }
    if fine.frequency_hz is not None:
        found["first_fore_aft_hz"] = fine.frequency_hz
    result = {}
    for name, value in found.items():
        difference = abs(value / expected[name] - 1)
        result[name] = {
            "found": value,
            "expected": expected[name],
            "difference": difference,
            "passed": difference < CHECK_TOLERANCE,
        }
    return result


def search(
    run: Callable[[float], PeerRun], fine: PeerRun, repeats: int
) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """Error of each step from the largest down to the last limit, and the cost at each limit."""
    rows: list[dict[str, Any]] = []
    within: dict[str, Any] = {}
    for dt in STEPS:
        if dt <= fine.dt:
            break
        try:
            coarse = run(dt)
        except FailedRunError as reason:
            rows.append({"dt_s": dt, "failed": str(reason)})
            continue
        error = errors(coarse, fine)
        rows.append({"dt_s": dt, **error, "wall_s": coarse.wall_s, "cpu_s": coarse.cpu_s})
        for limit in LIMITS:
            if str(limit) not in within and error["peak"] <= limit:
                runs = [coarse, *(run(dt) for _ in range(repeats - 1))]
                within[str(limit)] = {"dt_s": dt, **error, **cost(runs)}
        if error["peak"] <= LIMITS[-1]:
            break
    return rows, within


def cost(runs: list[PeerRun]) -> dict[str, float]:
    """Median seconds of repeated runs, in all and for each step."""
    wall = statistics.median(run.wall_s for run in runs)
    cpu = statistics.median(run.cpu_s for run in runs)
    steps = runs[0].steps
    return {"wall_s": wall, "cpu_s": cpu, "step_wall_s": wall / steps, "step_cpu_s": cpu / steps}


def errors(coarse: PeerRun, fine: PeerRun) -> dict[str, float]:
    """Largest difference over largest moment, and rms difference over standard deviation.

    Taken at the output instants that both runs have.
    """
    here, there = common_instants(coarse, fine)
    moment = fine.seabed_moment[there]
    difference = coarse.seabed_moment[here] - moment
    return {
        "peak": float(np.abs(difference).max() / np.abs(moment).max()),
        "rms": float(np.sqrt(np.mean(difference**2)) / moment.std()),
    }


def common_instants(first: PeerRun, second: PeerRun) -> tuple[Indices, Indices]:
    """Indices of the instants that two runs share."""
    instants = np.round(first.time, 6), np.round(second.time, 6)
    _, here, there = np.intersect1d(instants[0], instants[1], return_indices=True)
    return here.astype(np.intp), there.astype(np.intp)


def agreement(fine: dict[str, PeerRun]) -> dict[str, Any]:
    """Differences between the fine solutions of every two codes."""
    names = list(fine)
    result = {}
    for i, first in enumerate(names):
        for second in names[i + 1 :]:
            error = errors(fine[second], fine[first])
            result[f"{first} and {second}"] = {**error, "agree": error["peak"] < AGREEMENT}
    return result


if __name__ == "__main__":
    main()
