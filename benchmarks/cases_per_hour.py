"""Cases an hour: LC 5.1 with many seeds, one process or two, and what each process costs to start.

Each process has one BLAS thread. Throughput is counted once all processes are up, have loaded their
machine code and have solved a case.
"""

from __future__ import annotations

import multiprocessing
import statistics
import time
from concurrent.futures import ProcessPoolExecutor
from typing import Any, NamedTuple

import measuring
from operational_case import operational_case

PROCESSES = (1, 2)
SECONDS, CASES = 660.0, 12
WARM_UP = 2.0


class Solved(NamedTuple):
    """What one case took in s of wall and of processor time, and its largest moment in N m."""

    wall: float
    processor: float
    peak_moment: float


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Solve the same cases over each number of processes, and write the results."""
    parser = measuring.options("cases_per_hour", __doc__, repeats=1)
    parser.add_argument("--processes", type=int, nargs="+", default=PROCESSES)
    parser.add_argument("--cases", type=int, default=CASES)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="simulated time of a case")
    given = parser.parse_args(argv)
    solve(0, WARM_UP)  # machine code is made once for all processes
    rows = [
        measure(processes, given.cases, given.seconds, given.repeats)
        for processes in given.processes
    ]
    for row in rows:
        alone = rows[0]["cases_per_hour"] / rows[0]["processes"]
        row["parallel_efficiency"] = row["cases_per_hour"] / row["processes"] / alone
    if any(row["peak_moments_nm"] != rows[0]["peak_moments_nm"] for row in rows):
        raise RuntimeError("results depend on the number of processes; the times count for nothing")
    return measuring.write(
        given.out,
        {
            "cases": given.cases,
            "simulated_s": given.seconds,
            "repeats": given.repeats,
            "rows": rows,
        },
    )


def measure(processes: int, cases: int, seconds: float, repeats: int) -> dict[str, Any]:
    """Cases per hour on several processes, excluding the start, reported separately."""
    spawn = multiprocessing.get_context("spawn")
    begun = time.perf_counter()
    with ProcessPoolExecutor(
        processes, spawn, initializer=_start, initargs=(spawn.Barrier(processes),)
    ) as pool:
        list(pool.map(_warm_up, range(processes)))
        start = time.perf_counter() - begun
        walls, solved = [], []
        for _ in range(repeats):
            begun = time.perf_counter()
            solved = list(pool.map(solve, range(1, cases + 1), [seconds] * cases))
            walls.append(time.perf_counter() - begun)
    return {
        "processes": processes,
        "start_s": start,
        "wall_s": statistics.median(walls),
        "cases_per_hour": 3600 * cases / statistics.median(walls),
        "case_wall_s": statistics.median(case.wall for case in solved),
        "case_processor_s": statistics.median(case.processor for case in solved),
        "peak_moments_nm": [case.peak_moment for case in solved],
    }


def solve(seed: int, seconds: float) -> Solved:
    """Build and solve LC 5.1 with a seed."""
    wall, processor = time.perf_counter(), time.process_time()
    data = operational_case(seconds, seed=seed).simulate()
    peak = float(abs(data["mudline_moment"].sel(direction="y")).max())
    return Solved(time.perf_counter() - wall, time.process_time() - processor, peak)


_all_up: list[Any] = []


def _start(barrier: Any) -> None:
    """In each process at its start: keep the barrier at which all of them meet."""
    _all_up.append(barrier)


def _warm_up(_: int) -> None:
    """Solve a case in each process; the barrier keeps one of them from taking two."""
    solve(0, WARM_UP)
    _all_up[0].wait(timeout=600)


if __name__ == "__main__":
    main()
