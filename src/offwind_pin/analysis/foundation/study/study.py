"""Soil of a turbine: curves, state, pushover, stiffness at the mudline, damping."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
import xarray as xr

from offwind_pin.analysis.assemble import assemble
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.foundation.equivalent import (
    apparent_fixity,
    condensed_stiffness,
    macro_element,
)
from offwind_pin.analysis.foundation.equivalent_damping import equivalent_damping
from offwind_pin.analysis.foundation.pushover import Pushover, pushover
from offwind_pin.analysis.foundation.study.damping_models import (
    damping_model,
    damping_models,
    damping_node,
)
from offwind_pin.analysis.foundation.study.state import (
    SoilState,
    load_origin,
    reached_in_run,
    reached_statically,
    run_origin,
)
from offwind_pin.analysis.foundation.study.tabulate import (
    OtherSprings,
    describe_springs,
    finite,
    sampled,
    units_of,
)
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError, SolverError
from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.definitions.soil.springs import DistributedSprings
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.soil.foundation import Foundation, distributed_springs
from offwind_pin.loads.soil.macro_element import MacroElement
from offwind_pin.loads.soil.soil_profile import PileNodes, layer_index
from offwind_pin.loads.soil.springs.elastic import SoilSprings
from offwind_pin.loads.soil.springs.frictional_moment import FrictionalMoment
from offwind_pin.structure.section import outer_diameter

Made = TypeVar("Made")

_FREQUENCIES = (0.1, 0.25, 1.0)
"""Hz; approximate frequencies of waves and of the first and second bending modes."""
_AMPLITUDES = np.geomspace(1e-5, 1e-2, 25)
"""Amplitudes over the pile's diameter; a monopile counts as failed at a tenth."""


@dataclass(frozen=True)
class Fixity:
    """A cantilever of apparent fixity, with the 6x6 that it replaces.

    length in m, bending_stiffness in N m2, load_arm in m; stiffness and reference (2, 2) of x and
    ry in N, m, rad
    """

    length: float
    bending_stiffness: float
    load_arm: float
    stiffness: Array
    reference: Array

    @property
    def difference(self) -> Array:
        """(2, 2) difference of the cantilever from the 6x6, over the latter."""
        return np.asarray(self.stiffness / self.reference - 1)


@dataclass(frozen=True, eq=False)
class SoilOverview:
    """Curves, state and stiffness of a turbine's soil.

    Attributes
    ----------
    turbine : Turbine
        The turbine.
    springs : DistributedSprings
        Its distributed springs as defined.
    foundation : Foundation
        The resulting foundation.
    lateral : SoilSprings
        The lateral springs along the pile.
    depth, diameter : (n,) array, m
        Depth and pile diameter of the nodes.
    model : (n,) tuple of str
        Name of the law of each node's curve.
    state : SoilState or None
        State of the nodes; None without a result or a load.
    pushover : Pushover
        Pushover of the pile; it ends early if the soil fails.
    macro_element : (t, 2) array or None
        Load in N and rotation in rad of the macro-element at the pushover's displacements.
    stiffness : dict of str to array
        (6, 6) stiffness matrices at the mudline in N, m and rad, by name.
    fixity : Fixity or None
        The turbine's apparent fixity.
    damping : dict of str to Dataset
        Equivalent damping over amplitude and frequency at one node, by damping model.
    damping_model : str or None
        The turbine's own model, or None.
    remarks : tuple of str
        Parts that could not be computed, with reasons.
    """

    turbine: Turbine
    springs: DistributedSprings
    foundation: Foundation
    lateral: SoilSprings
    depth: Array
    diameter: Array
    model: tuple[str, ...]
    state: SoilState | None
    pushover: Pushover
    macro_element: Array | None
    stiffness: dict[str, Array]
    fixity: Fixity | None
    damping: dict[str, xr.Dataset]
    damping_model: str | None
    remarks: tuple[str, ...]

    __repr__ = one_line

    @property
    def others(self) -> tuple[OtherSprings, ...]:
        """All other springs with curves."""
        return tuple(load for load in self.foundation.soil[1:] if isinstance(load, OtherSprings))

    @property
    def head_diameter(self) -> float:
        """Pile diameter at the mudline in m."""
        return float(self.diameter[0])

    @property
    def ended_early(self) -> bool:
        """Whether the soil failed before the end of the pushover."""
        return any(remark.startswith(_PUSHOVER) for remark in self.remarks)

    @property
    def damping_depth(self) -> float:
        """Depth below the mudline in m of the spring whose damping is reported."""
        return float(self.depth[damping_node(self.lateral, self.depth, self.head_diameter)])

    def lateral_curves(self) -> list[tuple[float, float, float]]:
        """Depth in m, y in m and p in N/m of every node, as in a curve table.

        Returns
        -------
        list of (float, float, float)
        """
        return [
            (float(depth), y, p)
            for depth, points in zip(
                self.depth, sampled(self.lateral.curves, self.head_diameter), strict=True
            )
            for y, p in points
        ]

    def other_curves(self) -> list[tuple[str, float, float, str, float, str]]:
        """Spring, depth in m, deflection and its unit, resistance and its unit, of the other
        springs.

        Resistances are per metre of pile along the shaft, and total at the toe; for frictional
        moments the lever in m is given in place of a resistance.

        Returns
        -------
        list of tuple
        """
        rows = []
        for load in self.others:
            turns, units = units_of(load)
            curves = load.lever if isinstance(load, FrictionalMoment) else load.curves
            scale = 1.0 if turns else self.head_diameter
            depth = self.turbine.site.mudline - load.height
            for below, points in zip(depth, sampled(curves, scale), strict=True):
                rows += [(load.name, float(below), y, units[0], p, units[1]) for y, p in points]
        return rows

    def nodes(self) -> list[dict[str, Any]]:
        """One row of plain data for each node, from the mudline down.

        Returns
        -------
        list of dict of str to object
        """
        soil, state = self.lateral, self.state
        initial, ultimate = soil.curves.secant(np.zeros(len(self.depth))), soil.curves.ultimate
        rows = []
        for i, model in enumerate(self.model):
            row: dict[str, Any] = {
                "depth_m": float(self.depth[i]),
                "height_m": float(soil.height[i]),
                "diameter_m": float(self.diameter[i]),
                "tributary_length_m": float(soil.tributary_length[i]),
                "model": model,
                "initial_modulus_n_per_m2": float(initial[i]),
                "ultimate_resistance_n_per_m": finite(ultimate[i]),
            }
            if state is not None:
                row |= {
                    "displacement_m": float(state.displacement[i]),
                    "resistance_n_per_m": float(state.resistance[i]),
                    "secant_stiffness_n_per_m2": float(state.secant[i]),
                    "utilisation": finite(state.utilisation[i]),
                }
            rows.append(row)
        return rows

    def as_dict(self) -> dict[str, Any]:
        """Plain data, SI units in the keys.

        Returns
        -------
        dict of str to object
        """
        springs, push = self.springs, self.pushover
        return {
            "turbine": self.turbine.name,
            "definition_sha256": self.turbine.content_hash,
            "surrogate": self.foundation.surrogate,
            "cautions": list(self.foundation.cautions),
            "remarks": list(self.remarks),
            "scour_depth_m": self.turbine.site.scour_depth,
            "nodes": self.nodes(),
            "other_springs": [
                describe_springs(load, self.turbine.site.mudline) for load in self.others
            ],
            "toe_vertical_stiffness_n_per_m": springs.toe_vertical_stiffness,
            "toe_torsional_stiffness_nm_per_rad": springs.toe_torsional_stiffness,
            "state": self._state(),
            "pushover": {
                "arm_m": push.arm,
                "load_n": push.load.tolist(),
                "moment_nm": push.moment.tolist(),
                "displacement_m": push.displacement.tolist(),
                "rotation_rad": push.rotation.tolist(),
                "macro_element": None
                if self.macro_element is None
                else {
                    "load_n": self.macro_element[:, 0].tolist(),
                    "rotation_rad": self.macro_element[:, 1].tolist(),
                },
            },
            "stiffness_6x6": {name: matrix.tolist() for name, matrix in self.stiffness.items()},
            "apparent_fixity": None
            if self.fixity is None
            else {
                "length_m": self.fixity.length,
                "bending_stiffness_nm2": self.fixity.bending_stiffness,
                "load_arm_m": self.fixity.load_arm,
                "lateral_stiffness": self.fixity.stiffness.tolist(),
                "lateral_stiffness_of_6x6": self.fixity.reference.tolist(),
                "difference": self.fixity.difference.tolist(),
            },
            "equivalent_damping": {
                "model_of_turbine": self.damping_model,
                "models": {name: _damping(found) for name, found in self.damping.items()},
            },
        }

    def _state(self) -> dict[str, Any] | None:
        if self.state is None:
            return None
        used = self.state.utilisation
        known = bool(np.any(np.isfinite(used)))
        at = int(np.nanargmax(used)) if known else 0
        return {
            "origin": self.state.origin,
            "largest_displacement_m": float(self.state.displacement.max()),
            "largest_utilisation": float(used[at]) if known else None,
            "depth_of_largest_utilisation_m": float(self.depth[at]) if known else None,
        }


def soil_overview(
    turbine: Turbine,
    *,
    load: Array | None = None,
    result: Path | None = None,
    arm: float | None = None,
    elements: int | None = None,
) -> SoilOverview:
    """Curves, state, pushover, stiffness and damping of a turbine's distributed springs.

    Parameters
    ----------
    turbine : Turbine
    load : (6,) array, N and N m, optional
        Load at the yaw bearing for the state, with gravity, without water.
    result : Path, optional
        Directory with ``results.nc`` of a transient on these springs. The state is then the largest
        displacement of each node after the ramp, linear between recorded heights.
    arm : float, m, optional
        Height of the pushover load above the mudline, by default that of the yaw bearing.
    elements : int, optional
        Total number of multibody beam elements of the structure, for the state under a load.

    Returns
    -------
    SoilOverview

    Raises
    ------
    InputError
        No pile or no distributed springs, both a load and a result, or a result that is unreadable,
        has no displacement below the mudline, or is of another turbine.
    SolverError
        No equilibrium under the load.
    """
    if load is not None and result is not None:
        raise InputError("load and result", "both", "one of them", "Leave the other out.")
    if arm is not None and not 0 <= arm < np.inf:
        raise InputError("arm", arm, "a height of 0 m or more", "Give the height of the load.")
    foundation = distributed_springs(turbine)
    springs = cast(DistributedSprings, turbine.soil.distributed_springs)
    soil = cast(SoilSprings, foundation.soil[0])
    mudline = turbine.site.mudline
    depth, diameter = mudline - soil.height, outer_diameter(turbine, soil.height)
    stiffness = {"tangent_unloaded": condensed_stiffness(turbine)}
    state = None
    if result is not None:
        state = SoilState.of(soil.curves, reached_in_run(turbine, soil, result), run_origin(result))
    if load is not None:
        system = assemble(turbine, foundation, elements=elements)
        found = static(system, load)
        state = SoilState.of(
            soil.curves, reached_statically(system, soil, found), load_origin(load)
        )
        for kind in ("tangent", "secant"):
            stiffness[f"{kind}_loaded"] = condense(system, found, stiffness=kind).symmetric
    remarks: list[str] = []
    pushed = _pushed(turbine, turbine.yaw_bearing - mudline if arm is None else arm, remarks)
    held = _attempt("macro-element", lambda: macro_element(turbine), remarks)
    followed = None
    if held is not None:
        follow = partial(macro_element_response, cast(MacroElement, held.root), pushed)
        followed = _attempt("macro-element", follow, remarks)
    node = damping_node(soil, depth, float(diameter[0]))
    models = damping_models(springs, soil, node)
    return SoilOverview(
        turbine=turbine,
        springs=springs,
        foundation=foundation,
        lateral=soil,
        depth=depth,
        diameter=diameter,
        model=_models(springs, turbine, depth, diameter),
        state=state,
        pushover=pushed,
        macro_element=followed,
        stiffness=stiffness,
        fixity=_attempt("apparent fixity", lambda: _fixity(turbine), remarks),
        damping=_dampings(models, float(diameter[0]), remarks),
        damping_model=damping_model(springs),
        remarks=tuple(remarks),
    )


def macro_element_response(element: MacroElement, pushed: Pushover) -> Array:
    """(t, 2) load in N and rotation in rad of a macro-element at a pushover's displacements.

    The load acts at the pushover's arm.
    """
    memory, x = np.zeros(element.memory_size), np.zeros(6)
    rest, per_load = np.zeros(6), np.array([1.0, 0.0, 0.0, 0.0, pushed.arm, 0.0])
    found: list[tuple[float, float]] = []
    for displacement, rotation, load in zip(
        pushed.displacement, pushed.rotation, pushed.load, strict=True
    ):
        x[[0, 4]] = displacement, rotation
        for _ in range(_MOST_ITERATIONS):
            reaction, (stiffness, _) = (
                element.reaction(x, rest, memory),
                element.tangents(x, rest, memory),
            )
            error = load * per_load - reaction
            if np.max(np.abs(error)) <= _TOLERANCE * np.max(np.abs(reaction)):
                break
            step = np.linalg.solve(np.column_stack([-per_load, stiffness[:, 1:]]), error)
            load += step[0]
            x[1:] += step[1:]
        else:
            raise SolverError(
                "the macro-element cannot follow the pushover",
                step=len(found),
                joint="mudline",
                residual=float(np.max(np.abs(error))),
            )
        element.commit(x, memory)
        found.append((load, float(x[4])))
    return np.array(found)


_MOST_ITERATIONS, _TOLERANCE = 60, 1e-9


def _models(
    springs: DistributedSprings, turbine: Turbine, depth: Array, diameter: Array
) -> tuple[str, ...]:
    """Name of the law at every node."""
    if not isinstance(springs.curve, LayeredGround):
        return (springs.curve.kind,) * len(depth)
    nodes = PileNodes(depth, diameter, float(depth[-1]), turbine.site.scour_depth)
    layers = springs.curve.layers
    return tuple(layers[i].model for i in layer_index(layers, nodes))


_PUSHOVER = "pushover"


def _pushed(turbine: Turbine, arm: float, remarks: list[str]) -> Pushover:
    """Pushover to a tenth of the diameter, or until the soil fails."""
    try:
        return pushover(turbine, arm)
    except SolverError as error:
        if error.results is None or len(error.results.load) < 2:
            raise
        remarks.append(f"{_PUSHOVER}: {error}")
        return error.results


def _attempt(what: str, make: Callable[[], Made], remarks: list[str]) -> Made | None:
    """A result, or a remark why there is none; other parts of an overview do not depend on it."""
    try:
        return make()
    except (InputError, SolverError) as error:
        remarks.append(f"{what}: {error}")
        return None


def _fixity(turbine: Turbine) -> Fixity:
    facts = cast(dict[str, Any], apparent_fixity(turbine).facts["apparent_fixity"])
    length, bending = facts["length_m"], facts["bending_stiffness_nm2"]
    cantilever = np.array([[12 / length**2, -6 / length], [-6 / length, 4.0]]) * bending / length
    whole = np.array(facts["mudline_stiffness"])
    return Fixity(length, bending, facts["load_arm_m"], cantilever, whole[np.ix_([0, 4], [0, 4])])


def _dampings(
    models: dict[str, SoilSprings], diameter: float, remarks: list[str]
) -> dict[str, xr.Dataset]:
    """Equivalent damping of each model that can follow the spring's curve."""
    found = {}
    for name, model in models.items():
        drive = partial(equivalent_damping, model, _AMPLITUDES * diameter, _FREQUENCIES, node=0)
        data = _attempt(f"damping, {name.replace('_', ' ')}", drive, remarks)
        if data is not None:
            found[name] = data
    return found


def _damping(found: xr.Dataset) -> dict[str, Any]:
    return {
        "height_m": found.attrs["height_m"],
        "amplitude_m": found.amplitude.values.tolist(),
        "frequency_hz": found.frequency.values.tolist(),
        "damping_ratio": found.damping_ratio.values.tolist(),
        "secant_stiffness_n_per_m": found.secant_stiffness.values.tolist(),
    }
