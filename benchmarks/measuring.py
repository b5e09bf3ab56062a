"""What all benchmarks share: one BLAS thread, wall times, facts of the machine, and the JSON.

It is imported before NumPy, which reads the number of threads when it is loaded.
"""

from __future__ import annotations

import argparse
import functools
import json
import os
import platform
import statistics
import sys
import time
from collections.abc import Callable, Hashable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any, TypeVar

_TOO_LATE = "numpy" in sys.modules and "OPENBLAS_NUM_THREADS" not in os.environ
for _variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

Name = TypeVar("Name", bound=Hashable)

RESULTS = Path("out/benchmarks")
PACKAGES = ("offwind-pin", "pin", "numpy", "scipy", "numba")
SHORTEST_RUN = 0.02
"""s; faster calls are timed in a row."""


def options(name: str, about: str | None, repeats: int = 5) -> argparse.ArgumentParser:
    """Arguments that every benchmark takes; the JSON goes to ``out/benchmarks/name.json``."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--out", type=Path, default=RESULTS / f"{name}.json")
    parser.add_argument("--repeats", type=int, default=repeats)
    return parser


def write(path: Path, report: dict[str, Any]) -> dict[str, Any]:
    """Write a report with the facts of the machine, print it, and return it."""
    whole = {"machine": machine(), **report}
    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(whole, indent=2, allow_nan=False)
    path.write_text(text + "\n")
    print(text)
    return whole


def machine() -> dict[str, Any]:
    """Processor, cores, versions, and how busy the machine was; nothing that names it."""
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "versions": {name: metadata.version(name) for name in PACKAGES},
        "blas_threads": "unknown" if _TOO_LATE else os.environ["OPENBLAS_NUM_THREADS"],
        "load_average": round(os.getloadavg()[0], 2),
    }


def processor() -> str:
    """Model name of the processor, with its family and model number where the name says little."""
    facts = Path("/proc/cpuinfo")
    if not facts.is_file():
        return platform.processor() or platform.machine()
    known: dict[str, str] = {}
    for line in facts.read_text().splitlines():
        key, _, value = line.partition(":")
        known.setdefault(key.strip(), value.strip())
    name = known.get("model name", platform.machine())
    if "cpu family" in known:
        name += f" (family {known['cpu family']}, model {known.get('model', '?')})"
    return name


def wall(run: Callable[[], object]) -> float:
    """Wall time of a call in s."""
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def median_wall(run: Callable[[], object], repeats: int) -> float:
    """Median wall time of a call in s."""
    return statistics.median(wall(run) for _ in range(repeats))


def rounds(runs: Mapping[Name, Callable[[int], object]], repeats: int) -> dict[Name, list[float]]:
    """Wall times in s of one call of each, as many as there are rounds.

    Each run makes so many calls in a row as it is asked for. Every round times all of them one
    after another, so that what else the machine does bears on all alike. The first calls, which
    may compile, do not count.
    """
    counts = {name: _calls_to_time(run) for name, run in runs.items()}
    taken: dict[Name, list[float]] = {name: [] for name in runs}
    for _ in range(repeats):
        for name, run in runs.items():
            taken[name].append(wall(functools.partial(run, counts[name])) / counts[name])
    return taken


def _calls_to_time(run: Callable[[int], object]) -> int:
    """How many calls in a row are long enough for the clock."""
    run(1)
    count, taken = 1, wall(functools.partial(run, 1))
    while taken < SHORTEST_RUN:
        count *= round(min(max(2.0, SHORTEST_RUN / max(taken, 1e-9)), 1000.0))
        taken = wall(functools.partial(run, count))
    return count


def exponent(sizes: Sequence[float], seconds: Sequence[float]) -> float | None:
    """p of seconds ~ size^p by least squares over the logarithms; None for a single size."""
    import numpy as np

    if len(sizes) < 2:
        return None
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def target(what: str, allowed: float, measured: float | None, *, at_least: bool) -> dict[str, Any]:
    """A target with what was measured; it is met, missed (False) or was not measured (None)."""
    met = None
    if measured is not None:
        met = measured >= allowed if at_least else measured <= allowed
    return {
        "what": what,
        "bound": "at least" if at_least else "at most",
        "allowed": allowed,
        "measured": measured,
        "met": met,
    }
