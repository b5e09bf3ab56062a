"""Speed-up of Pinocchio over the pure-Python core: rnea, crba and aba on chains of many elements.

Writes JSON. Seconds are medians of repeats; the two sides agree within 1e-10 before they are timed.
Up to 160 elements the chain is the package's own, on distributed springs; beyond, a uniform tube
with the same joints. A call of Pinocchio is one from Python, which copies the result: nv^2 numbers
for crba. Run with one BLAS thread.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import algorithms
import numpy as np
import pinocchio as pin
from kinematic_tree import read_tree
from slim_data import slim_data, tensor_bytes
from spatial import Array
from uniform_chain import uniform_chain

import offwind_pin as ow

ELEMENTS = (10, 20, 40, 80, 160, 320, 640)
LARGEST_OWN_CHAIN = 160
LARGEST_TENSORS = 1e9  # bytes; above, Pinocchio's scratch data is made without them
AGREEMENT = 1e-10  # largest difference over the largest entry
SHORTEST_RUN = 0.02  # s; faster calls are timed in a row


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure every size, fit the growth with the degrees of freedom, and write the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/benchmarks/pure_python.json"))
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--elements", type=int, nargs="+", default=ELEMENTS)
    arguments = parser.parse_args(argv)
    rows = [measure(n, arguments.repeats) for n in arguments.elements]
    report = {
        "machine": platform.processor() or platform.machine(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "pinocchio": pin.__version__,
        "omp_num_threads": os.environ.get("OMP_NUM_THREADS"),
        "repeats": arguments.repeats,
        "rows": rows,
        "exponents": exponents(rows),
    }
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(json.dumps(report, indent=2) + "\n")
    print(json.dumps(report, indent=2))
    return report


def measure(elements: int, repeats: int) -> dict[str, Any]:
    """Both sides' seconds a call on one chain, their ratios, and how closely they agree."""
    model = make_chain(elements)
    whole = tensor_bytes(model.nv) <= LARGEST_TENSORS
    start = time.perf_counter()
    data = model.createData() if whole else slim_data(model)
    creation = time.perf_counter() - start
    return {
        "elements": elements,
        "degrees_of_freedom": model.nv,
        "chain": "own" if elements <= LARGEST_OWN_CHAIN else "uniform tube",
        "pinocchio_data": "createData" if whole else "without second-order tensors",
        "pinocchio_data_s": creation,
        "tensors_of_create_data_gb": tensor_bytes(model.nv) / 1e9,
        "algorithms": {
            name: race(name, pair, repeats) for name, pair in pairs(model, data).items()
        },
    }


def make_chain(elements: int) -> pin.Model:
    """The package's chain as far as it goes, a uniform one beyond."""
    if elements > LARGEST_OWN_CHAIN:
        return uniform_chain(elements)
    turbine = ow.load_turbine("oc6_phase2")
    return ow.build(turbine, "distributed_springs", elements=elements).pin_model


@dataclass(frozen=True)
class Pair:
    """One algorithm on both sides, and the quantity in which their results are compared."""

    python: Callable[[], Array]
    pinocchio: Callable[[], Array]
    compared: Callable[[Array], Array]


def pairs(model: pin.Model, data: pin.Data) -> dict[str, Pair]:
    """Each algorithm in one state away from rest.

    Pinocchio has crba in two forms, in the bodies' frames (its default) and in the world's, and
    fills the upper triangle only. aba is given the joint forces of the state's accelerations; its
    results are compared by the joint forces that they need, because a mass matrix of condition
    1e8 leaves few common digits in accelerations that are both exact to rounding in the forces.
    """
    tree = read_tree(model)
    q, v, a = 0.1 * np.random.default_rng(0).uniform(-1, 1, (3, model.nv))
    tau = pin.rnea(model, data, q, v, a).copy()
    return {
        "rnea": Pair(
            lambda: algorithms.rnea(tree, q, v, a),
            lambda: pin.rnea(model, data, q, v, a),
            np.copy,
        ),
        "crba": Pair(
            lambda: algorithms.crba(tree, q),
            lambda: pin.crba(model, data, q),
            np.triu,
        ),
        "crba_world": Pair(
            lambda: algorithms.crba(tree, q),
            lambda: pin.crba(model, data, q, pin.Convention.WORLD),
            np.triu,
        ),
        "aba": Pair(
            lambda: algorithms.aba(tree, q, v, tau),
            lambda: pin.aba(model, data, q, v, tau),
            lambda qdd: pin.rnea(model, data, q, v, qdd).copy(),
        ),
    }


def race(name: str, pair: Pair, repeats: int) -> dict[str, float]:
    """Seconds a call on both sides and their ratio, once the two agree."""
    difference = relative_difference(pair.compared(pair.python()), pair.compared(pair.pinocchio()))
    if not difference <= AGREEMENT:
        raise RuntimeError(f"{name} differs by {difference:.1e}; its time counts for nothing")
    python, pinocchio = (seconds_a_call(run, repeats) for run in (pair.python, pair.pinocchio))
    return {
        "pure_python_s": python,
        "pinocchio_s": pinocchio,
        "speed_up": python / pinocchio,
        "relative_difference": difference,
    }


def relative_difference(value: Array, reference: Array) -> float:
    """Largest difference over the largest reference entry."""
    return float(np.max(np.abs(value - reference)) / np.max(np.abs(reference)))


def seconds_a_call(run: Callable[[], object], repeats: int) -> float:
    """Median wall time of a call in s, over runs long enough for the clock."""
    start = time.perf_counter()
    run()
    calls = math.ceil(SHORTEST_RUN / (time.perf_counter() - start))
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        for _ in range(calls):
            run()
        times.append((time.perf_counter() - start) / calls)
    return statistics.median(times)


def exponents(rows: list[dict[str, Any]]) -> dict[str, dict[str, dict[str, float]]]:
    """p in seconds ~ nv^p: least squares over all sizes, and over the last two alone."""
    log_nv = np.log([row["degrees_of_freedom"] for row in rows])
    fitted: dict[str, dict[str, dict[str, float]]] = {}
    for name in rows[0]["algorithms"] if len(rows) > 1 else ():
        fitted[name] = {}
        for side in "pure_python", "pinocchio":
            log_s = np.log([row["algorithms"][name][f"{side}_s"] for row in rows])
            fitted[name][side] = {
                "all_sizes": float(np.polyfit(log_nv, log_s, 1)[0]),
                "last_two": float(np.polyfit(log_nv[-2:], log_s[-2:], 1)[0]),
            }
    return fitted


if __name__ == "__main__":
    main()
