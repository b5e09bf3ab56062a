"""All benchmarks in sequence, each in a process of its own, and the page of their results.

``--quick`` takes fewer sizes, shorter runs and one repeat: a look at everything in minutes, whose
numbers count for little. A benchmark that fails is named, the others go on.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import measuring

FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Benchmark:
    """A script, and its arguments in a quick run."""

    script: str
    quick: str


BENCHMARKS = {
    "step_cost": Benchmark("step_cost.py", "--repeats 1 --elements 20 40 80 --seconds 20"),
    "real_time": Benchmark("real_time.py", "--repeats 1"),
    "soil_cost": Benchmark("soil_cost.py", "--repeats 1 --seconds 20"),
    "wave_setup": Benchmark("wave_setup.py", "--repeats 1 --seconds 60"),
    "work_precision": Benchmark(
        "work_precision.py",
        "--repeats 1 --elements 20 --seconds 20 --short 1 --fine 0.002 --tight 1e-6 --scipy 1e-3",
    ),
    "cases_per_hour": Benchmark("cases_per_hour.py", "--cases 4 --seconds 60"),
    "memory": Benchmark("memory.py", "--seconds 60 600"),
    "pure_python": Benchmark("pure_python/speedup.py", "--repeats 1 --elements 10 40 80"),
    "peers": Benchmark("peers/compare.py", "--repeats 1"),
}
"""In the order in which they run; the peers are long, and only run when asked for."""


def main(argv: list[str] | None = None) -> list[str]:
    """Run what is asked for and write the page; returns the names of those that failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--peers", action="store_true", help="compare with other codes as well")
    parser.add_argument("--only", nargs="+", choices=list(BENCHMARKS))
    parser.add_argument("--out", type=Path, default=measuring.RESULTS, help="folder of the results")
    given = parser.parse_args(argv)
    names = given.only or [name for name in BENCHMARKS if name != "peers" or given.peers]
    failed = [name for name in names if not run(name, given.out, quick=given.quick)]
    run_script("page.py", ["--results", str(given.out)], None)
    if failed:
        print(f"Failed: {', '.join(failed)}", file=sys.stderr)
    return failed


def run(name: str, out: Path, *, quick: bool) -> bool:
    """Run one benchmark, its words into a file beside its results; whether it went well."""
    benchmark = BENCHMARKS[name]
    out.mkdir(parents=True, exist_ok=True)
    result = out / f"{name}.json"
    result.unlink(missing_ok=True)
    begun = time.perf_counter()
    print(f"{name} ...", end=" ", flush=True)
    arguments = ["--out", str(result), *(benchmark.quick.split() if quick else [])]
    good = run_script(benchmark.script, arguments, out / f"{name}.log")
    took = time.perf_counter() - begun
    print(f"{took:.0f} s" if good else f"failed after {took:.0f} s, see {out / f'{name}.log'}")
    return good


def run_script(script: str, arguments: list[str], log: Path | None) -> bool:
    """Run a script of this folder in a new process with one BLAS thread."""
    command = [sys.executable, str(FOLDER / script), *arguments]
    if log is None:
        return subprocess.run(command, check=False).returncode == 0  # noqa: S603
    with log.open("w", encoding="utf-8") as words:
        done = subprocess.run(  # noqa: S603
            command, check=False, stdout=words, stderr=subprocess.STDOUT
        )
    return done.returncode == 0


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
