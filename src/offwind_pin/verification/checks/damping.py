"""Modal structural damping: ratios in free decays, and its part of the energy balance."""

from __future__ import annotations

from functools import cache

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.definitions.structural_damping import ModalDamping
from offwind_pin.dynamics.compiled.recorder import JOINT_DAMPERS
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import StillWater
from offwind_pin.verification.free_decay import STEPS, FreeDecay
from offwind_pin.verification.ledger import Found

_MODAL = ModalDamping(ratios={"FA1": 0.010, "SS1": 0.008, "FA2": 0.020, "SS2": 0.005}, others=0.015)
"""Not in the order of the frequencies in one plane, as joint dampers cannot have them."""


@cache
def _system(foundation: str, *, dashpots: bool) -> System:
    turbine = load_turbine("oc6_phase2").model_copy(update={"structural_damping": _MODAL})
    springs = turbine.soil.distributed_springs
    if springs is not None and not dashpots:
        springs = springs.model_copy(update={"dashpot": None})
        soil = turbine.soil.model_copy(update={"distributed_springs": springs})
        turbine = turbine.model_copy(update={"soil": soil})
    return build(turbine, foundation, StillWater(), elements=14)


def decay_ratio(foundation: str, mode: str) -> Found:
    """Damping ratio of a free decay too small for drag, without soil damping."""
    found = FreeDecay(_system(foundation, dashpots=False), mode, 1e-6).ratio(6)
    return Found(found, _MODAL.ratios[mode])


def structural_energy() -> Found:
    """Energy in J that the structure dissipates in a decay with dashpots and drag."""
    system = _system("distributed_springs", dashpots=True)
    decay = FreeDecay(system, "FA1", 0.2)
    modes = decay.modes
    rates = 4 * np.pi * modes.damping_asked * modes.frequency_hz
    within = np.isfinite(rates)
    powers = [float(np.sum((rates * decay.speeds**2)[within]))]
    for _ in range(3 * STEPS):
        records = decay.advance(1)
        powers.append(float(np.sum((rates * decay.speeds**2)[within])))
    dissipated = records["dissipated"][-1]
    load = 2 + decay.chain.loads.index(system.structural_loads[0])
    return Found(
        float(dissipated[JOINT_DAMPERS] + dissipated[load]),
        float(np.trapezoid(powers, dx=decay.step)),
    )
