"""OC6 Phase II and OC3 Phase II: published results for the same turbines."""

from __future__ import annotations

from functools import cache

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.static import static
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.definitions.soil.depth_profile import DepthLine
from offwind_pin.definitions.soil.springs import LinearModulus
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import StillWater
from offwind_pin.verification.ledger import Found


@cache
def system(foundation: str, water: str = "dry", turbine: str = "oc6_phase2") -> System:
    """A shipped turbine on a foundation; ``uniform`` is a Winkler bed of 2.0e8 N/m2.

    water : dry or still
    """
    definition = load_turbine(turbine)
    if foundation == "uniform":
        definition, foundation = _on_uniform_soil(definition), "distributed_springs"
    return build(definition, foundation, StillWater() if water == "still" else None)


def _on_uniform_soil(turbine: Turbine) -> Turbine:
    springs = turbine.soil.distributed_springs
    if springs is None:
        raise RuntimeError(f"{turbine.name} has no distributed springs")
    curve = LinearModulus.model_validate({"kind": "linear", "modulus": DepthLine(at_mudline=2.0e8)})
    uniform = springs.model_copy(update={"curve": curve})
    soil = turbine.soil.model_copy(update={"distributed_springs": uniform})
    return turbine.model_copy(update={"soil": soil, "structural_damping": None})


@cache
def _modes(foundation: str, water: str, turbine: str) -> ModalResult:
    return modes(system(foundation, water, turbine), 6)


def frequency(
    mode: str,
    foundation: str,
    water: str = "dry",
    turbine: str = "oc6_phase2",
) -> float:
    """Natural frequency of a mode in Hz about the static state."""
    found = _modes(foundation, water, turbine)
    return float(found.frequency_hz[found.index(mode)])


def peak_height(mode: str) -> float:
    """Height of the peak of the mode shape, from 0 at the mudline to 1 at the yaw bearing."""
    found = _modes("distributed_springs", "still", "oc6_phase2")
    return float(found.shape_peak_height_ratio[found.index(mode)])


def damping_ratio(mode: str) -> float:
    """Damping ratio of a mode on coupled springs in still water."""
    found = _modes("coupled_springs", "still", "oc6_phase2")
    return float(found.damping_ratio[found.index(mode)])


@cache
def top_displacement(foundation: str, thrust: float = 0.0) -> float:
    """Downwind displacement in m of the yaw bearing under gravity and a thrust in N."""
    load = np.array([thrust, 0, 0, 0, 0, 0])
    return float(static(system(foundation), load).tower_top_displacement[0])


def thrust_response(foundation: str, thrust: float) -> float:
    """Downwind displacement in m that a thrust in N adds."""
    return top_displacement(foundation, thrust) - top_displacement(foundation)


def increase_over_clamped(foundation: str) -> float:
    """Increase of the displacement of the yaw bearing under gravity, in per cent."""
    return 100 * (top_displacement(foundation) / top_displacement("clamped") - 1)


def water_s_part(mode: str) -> float:
    """Frequency in still water over that in air, on coupled springs."""
    return frequency(mode, "coupled_springs", "still") / frequency(mode, "coupled_springs")


def water_on_springs(mode: str) -> float:
    """The same on the shipped distributed springs."""
    foundation = "distributed_springs"
    return frequency(mode, foundation, "still") / frequency(mode, foundation)


def two_foundations_of_oc3(mode: str) -> Found:
    """First frequency in Hz on OC3's distributed springs, and on its 6x6."""
    kinds = ("distributed_springs", "coupled_springs")
    return Found(*(frequency(mode, kind, "dry", "oc3_phase2") for kind in kinds))


def oc3_rocking() -> float:
    """Rocking flexibility of OC3's springs, condensed, over that of its 6x6."""
    chain = system("distributed_springs", "dry", "oc3_phase2")
    springs = chain.turbine.soil.coupled_springs
    if springs is None:
        raise RuntimeError("oc3_phase2 has no coupled springs")
    block = np.ix_([0, 4], [0, 4])
    condensed = np.linalg.inv(condense(chain, static(chain)).symmetric[block])
    return float(condensed[1, 1] / np.linalg.inv(np.array(springs.stiffness)[block])[1, 1])
