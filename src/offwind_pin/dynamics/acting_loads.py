"""All loads on a system, their memory, and their excitation by the ground."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.dynamics.base_excitation import BaseExcitation, check_reach
from offwind_pin.dynamics.system import System
from offwind_pin.loads.earthquake.ground_motion import GroundMotion
from offwind_pin.loads.point_load import KernelLoad, PointLoad
from offwind_pin.loads.root_restraint import KernelRestraint

_REACH = 20.0
"""Height in m above the yaw bearing up to which the last body carries loads."""


def base_excitation_of(
    system: System, loads: Sequence[PointLoad], motion: GroundMotion | None
) -> BaseExcitation:
    """Excitation of base and soil by a moving ground.

    Raises
    ------
    InputError
        The motion is not given at all required depths.
    """
    height = np.concatenate([np.zeros(0), *(load.height for load in loads)])
    if motion is None:
        return BaseExcitation.nowhere(len(height))
    chain = system.chain
    check_reach(motion, chain.base, system.turbine.site.mudline)
    meets = [np.full(len(load.height), load.moves_with_ground) for load in loads]
    everywhere = np.append(height, chain.base)
    return BaseExcitation.of(motion, everywhere, np.concatenate([*meets, [True]]))


def split_memory(
    loads: Sequence[KernelLoad], root: KernelRestraint, memory: Array | None
) -> list[Array]:
    """Memory of each load and, last, of the root; zero by default."""
    sizes = [*(load.memory_size for load in loads), root.memory_size]
    whole = np.zeros(sum(sizes)) if memory is None else memory
    return np.split(whole, np.cumsum(sizes)[:-1])


def all_loads(system: System, loads: Sequence[PointLoad]) -> list[PointLoad]:
    """All point loads of a system: hydrodynamic loads, soil, structural damping, given loads.

    Raises
    ------
    InputError
        A load outside the structure, or an object that is not a load.
    """
    for given in loads:
        if not isinstance(given, PointLoad):
            raise InputError(
                "loads",
                type(given).__name__,
                "loads derived from PointLoad",
                "Derive the class of your own load from offwind_pin.PointLoad.",
            )
    water = [] if system.hydrodynamics is None else system.hydrodynamics.loads()
    everything: list[PointLoad] = [
        *water,
        *system.foundation.soil,
        *system.structural_loads,
        *loads,
    ]
    for load in everything:
        highest = system.chain.top + _REACH
        outside = (load.height < system.chain.base) | (load.height > highest)
        if np.any(outside):
            raise InputError(
                f"load {load.name!r}, height",
                float(load.height[outside][0]),
                f"{system.chain.base} to {highest} m",
                "Choose heights on the axis of the structure, or of the nacelle above it.",
            )
    return everything


def part_of_loads(system: System, loads: Sequence[PointLoad]) -> list[str]:
    """Which of :data:`DAMPING_PARTS` each load belongs to, of all in compiled code."""
    water = [] if system.hydrodynamics is None else system.hydrodynamics.loads()
    groups = {
        "water": water,
        "soil": system.foundation.soil,
        "structural": system.structural_loads,
        "other": loads,
    }
    return [name for name, group in groups.items() for _ in compiled_loads(list(group))]


def compiled_loads(loads: Sequence[PointLoad]) -> list[KernelLoad]:
    """All loads for compiled code, part by part."""
    return [part for load in loads for part in load.compiled()]


def smooth_ramp(time: Array, duration: float | None) -> Array:
    """(t,) half a cosine from 0 at time 0 to 1 at the end of the ramp.

    duration : in s; None for the means of the loads alone, for statics and modes
    """
    time = np.asarray(time, dtype=float)
    if duration is None:
        return np.zeros_like(time)
    if duration == 0:
        return np.ones_like(time)
    return 0.5 * (1 - np.cos(np.pi * np.clip(time / duration, 0.0, 1.0)))
