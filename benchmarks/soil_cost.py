"""Cost of a step of LC 5.1 on other descriptions of the ground, over that on the shipped springs.

A step is one of :func:`offwind_pin.simulate` with all that the call does. All grounds take their
turn in each round. Of a step, the part of the soil's tangents is measured by itself: calls of the
loads' own kernels in a row, times how often a step rebuilds the iteration matrix.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import measuring
import numpy as np
from numpy.typing import NDArray
from operational_case import NAME, OperationalCase, operational_case
from step_cost import CONVERGED
from step_parts import STEPS, Motion, in_motion

import offwind_pin as ow
from offwind_pin.base.kernels import kernel
from offwind_pin.base.records import matrix, part
from offwind_pin.dynamics.compiled.chain import Run
from offwind_pin.loads.point_load import tangent_kernel
from offwind_pin.loads.tower_top.load_history import TowerTopLoad

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

SHIPPED = "shipped springs"
TANGENTS_ALLOWED = 0.1

_TILL: dict[str, Any] = {
    "top_m": 0.0,
    "model": "pisa",
    "calibration": "cowden_till",
    "submerged_unit_weight_n_per_m3": 1.1e4,
    "undrained_shear_strength_pa": {"depth_m": [0, 45], "values": [80e3, 250e3]},
    "shear_modulus_pa": {"depth_m": [0, 45], "values": [20e6, 250e6]},
}
_LAYERS: list[dict[str, Any]] = [
    {
        "top_m": 0.0,
        "model": "api_sand",
        "submerged_unit_weight_n_per_m3": 1.0e4,
        "friction_angle_deg": 34.0,
    },
    {
        "top_m": 9.0,
        "model": "matlock_clay",
        "submerged_unit_weight_n_per_m3": 9.0e3,
        "undrained_shear_strength_pa": 1.2e5,
        "strain_50": 0.005,
    },
    _TILL | {"top_m": 18.0},
    {
        "top_m": 32.0,
        "model": "pisa",
        "calibration": "general_dunkirk_sand",
        "submerged_unit_weight_n_per_m3": 1.0e4,
        "relative_density": 0.75,
        "shear_modulus_pa": {"depth_m": [0, 45], "values": [30e6, 150e6]},
    },
]
_AXIAL: dict[str, Any] = {
    "vertical": {"kind": "api", "soil": "clay", "skin_friction_pa": 8e4, "residual_ratio": 0.8},
    "torsional": {"kind": "api", "soil": "clay", "skin_friction_pa": 8e4, "residual_ratio": 0.8},
    "toe_bearing": {"kind": "api", "end_bearing_pa": 5e6},
}

GROUNDS: dict[str, tuple[str, dict[str, Any]]] = {
    SHIPPED: ("distributed_springs", {}),
    "PISA clay": ("distributed_springs", {"curve": [_TILL]}),
    "layered ground": ("distributed_springs", {"curve": _LAYERS, **_AXIAL}),
    "hysteretic springs": ("distributed_springs", {"hysteretic": {"sliders": 20}, "dashpot": None}),
    "macro-element": ("macro_element", {}),
}
"""Foundation, and what the shipped springs become for it; a curve is the list of its layers."""


def main(argv: list[str] | None = None) -> dict[str, Any]:
    """Measure every ground and write the results."""
    parser = measuring.options("soil_cost", __doc__)
    parser.add_argument("--seconds", type=float, default=200.0, help="simulated time of a run")
    parser.add_argument("--steps", type=int, default=STEPS, help="over which calls are counted")
    given = parser.parse_args(argv)
    cases = {name: case_on(name, given.seconds) for name in GROUNDS}
    facts = {name: check(case) for name, case in cases.items()}
    motions = {name: moving(case, given.steps) for name, case in cases.items()}
    runs: dict[tuple[str, str], Callable[[int], object]] = {}
    for name in GROUNDS:
        runs[name, "step"] = partial(repeat, cases[name])
        if len(soil_loads(motions[name])):
            runs[name, "tangents"] = partial(tangents, motions[name])
    taken = measuring.rounds(runs, given.repeats)
    steps = given.seconds / cases[SHIPPED].dt
    reference = taken[SHIPPED, "step"]
    rows = []
    for name, motion in motions.items():
        whole = taken[name, "step"]
        one_call = statistics.median(taken.get((name, "tangents"), [0.0]))
        of_step = one_call * motion.calls["factorisation"]  # few steps need a new matrix
        rows.append(
            {
                "ground": name,
                **facts[name],
                "calls": motion.calls,
                "step_s": statistics.median(whole) / steps,
                "over_shipped": statistics.median(
                    a / b for a, b in zip(whole, reference, strict=True)
                ),
                "tangents_call_s": one_call,
                "tangents_share": of_step * steps / statistics.median(whole),
            }
        )
    return measuring.write(
        given.out,
        {
            "case": NAME,
            "simulated_s": given.seconds,
            "repeats": given.repeats,
            "rows": rows,
            "targets": [
                measuring.target(
                    "share of the soil's tangents in a step, on the dearest ground",
                    TANGENTS_ALLOWED,
                    max(row["tangents_share"] for row in rows),
                    at_least=False,
                )
            ],
        },
    )


def case_on(name: str, seconds: float) -> OperationalCase:
    """LC 5.1 on another ground."""
    case = operational_case(seconds)
    foundation, changes = GROUNDS[name]
    turbine = case.system.turbine
    springs = turbine.soil.distributed_springs
    if springs is None:
        raise TypeError(f"the turbine of {NAME} has no distributed springs")
    data = springs.model_dump(by_alias=True, exclude_none=True) | changes
    if isinstance(data["curve"], list):
        data["curve"] = {"kind": "layers", "loading": "static", "layers": data["curve"]}
    soil = turbine.soil.model_copy(update={"distributed_springs": type(springs)(**data)})
    changed = turbine.model_copy(update={"soil": soil})
    return replace(case, system=ow.build(changed, foundation, case.system.sea))


def check(case: OperationalCase) -> dict[str, Any]:
    """Facts of a run.

    Raises
    ------
    RuntimeError : a step has not converged
    """
    data = case.simulate()
    largest = float(data["solver_residual"].max())
    if not largest <= CONVERGED:
        raise RuntimeError(f"a step ended with residual {largest:.1e}; its time counts for nothing")
    return {
        "elements": case.system.chain.elements,
        "mean_corrections": float(data["solver_iterations"][1:].mean()),
        "largest_residual": largest,
    }


def moving(case: OperationalCase, steps: int) -> Motion:
    """The case on its way, the calls of a step counted."""
    mean = case.load.mean(case.ramp, case.duration)
    load = TowerTopLoad(case.system.chain.top, case.load, mean)
    return in_motion(case.system, [load], case.dt, steps)


def repeat(case: OperationalCase, count: int) -> None:
    for _ in range(count):
        case.simulate()


def soil_loads(motion: Motion) -> Indices:
    """Places of the soil's loads among all; none where a restraint of the root is the soil."""
    moving = [load.moves_with_ground for load in motion.chain.loads]
    return np.flatnonzero(moving)


def tangents(motion: Motion, count: int) -> None:
    """The tangents of all soil loads, so many times in a row."""
    chain = motion.chain
    run = chain.run(chain.recorder(chain.sections(chain.system.chain.boundary)))
    _tangents(run, motion.rows[0], soil_loads(motion), count)


_call = tangent_kernel.call


@kernel
def _tangents(run: Run, time_inputs: Array, chosen: Indices, count: int) -> None:
    model, motion, memory, blocks = run.model, run.data.motion, run.state.memory, run.factors.blocks
    for _ in range(count):
        for i in chosen:
            first, last = model.first_point[i], model.first_point[i + 1]
            numbers = part(time_inputs, model.first_input[i], model.first_input[i + 1])
            past = part(memory, model.first_memory[i], model.first_memory[i + 1])
            points = part(motion, first, last)
            table = matrix(model.constants, model.first_constant[i], last - first, model.columns[i])
            _call(model.tangents[i], (points, table, numbers, past, part(blocks, first, last)))


if __name__ == "__main__":
    main()
