"""Is LC 5.1 as fast as in another revision? Alternating pairs of processes from two source trees.

Each process solves the shipped case from its own tree, with its own kernel cache, which one run of
each fills first. Measured are the processor time of the call of :func:`offwind_pin.simulate` and of
the whole process, and the peak memory. In a pair both run right after one another, the new tree
first in every second pair, so that what else the machine does bears on both alike. The ratios new
over old are given with the 95 % interval of their geometric mean.

    git worktree add ../before main~5
    python benchmarks/revision_pairs.py --old ../before
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import measuring
import numpy as np
from scipy import stats

WORKER = """
import json, resource, sys, time
from operational_case import operational_case

case = operational_case(float(sys.argv[1]))
begun = time.process_time()
moment = case.simulate()["mudline_moment"]
loop = time.process_time() - begun
usage = resource.getrusage(resource.RUSAGE_SELF)
print(json.dumps({
    "simulate_s": loop,
    "process_s": usage.ru_utime + usage.ru_stime,
    "peak_memory_MB": usage.ru_maxrss / 1024,
    "largest_moment_Nm": float(abs(moment).max()),
}))
"""
MEASURED = "simulate_s", "process_s", "peak_memory_MB"
SAME = 1e-6
"""Relative difference of the largest mudline moment; results are compared by same_results.py."""
SLOWER_ALLOWED = 1.03


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Run the pairs and write the ratios."""
    parser = measuring.options("revision_pairs", __doc__, repeats=15)
    parser.add_argument("--old", type=Path, required=True, help="checkout to compare with")
    parser.add_argument("--new", type=Path, default=Path(__file__).resolve().parents[1])
    parser.add_argument("--seconds", type=float, default=660.0, help="simulated time of a run")
    given = parser.parse_args(argv)
    trees = {"old": given.old.resolve(), "new": given.new.resolve()}
    for tree in trees.values():
        run(tree, given.seconds)
    pairs = []
    for n in range(given.repeats):
        order = ("old", "new") if n % 2 == 0 else ("new", "old")
        pairs.append({name: run(trees[name], given.seconds) for name in order})
    for pair in pairs:
        moments = [taken["largest_moment_Nm"] for taken in pair.values()]
        if abs(moments[0] - moments[1]) > SAME * abs(moments[0]):
            raise RuntimeError(f"the trees give different moments, {moments} N m")
    ratios = {name: interval([p["new"][name] / p["old"][name] for p in pairs]) for name in MEASURED}
    return measuring.write(
        given.out,
        {
            "simulated_s": given.seconds,
            "pairs": pairs,
            "new_over_old": ratios,
            "slower_allowed": SLOWER_ALLOWED,
            "pass": all(ratio["upper"] < SLOWER_ALLOWED for ratio in ratios.values()),
        },
    )


def run(tree: Path, seconds: float) -> dict[str, float]:
    """What one process of a tree takes."""
    path = os.pathsep.join(str(tree / part) for part in ("src", "benchmarks"))
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-c", WORKER, str(seconds)],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": path},
    )
    taken: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return taken


def interval(ratios: list[float]) -> dict[str, float]:
    """Geometric mean of ratios, and its 95 % interval by Student's distribution of the logs."""
    logs = np.log(ratios)
    half = 0.0
    if len(logs) > 1:
        half = stats.t.ppf(0.975, len(logs) - 1) * stats.sem(logs)
    mean = np.mean(logs)
    values = {"mean": mean, "lower": mean - half, "upper": mean + half}
    return {name: float(np.exp(value)) for name, value in values.items()}


if __name__ == "__main__":
    main()
