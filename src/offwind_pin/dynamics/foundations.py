"""Foundations behind one interface: where the chain starts, what holds its root, which springs act.

A foundation is three answers. Clamped and apparent fixity start at a height and hold the root
rigidly; coupled springs and a macro-element start at the mudline and restrain the root's six
joints; distributed springs start at the toe, with a restraint there and point loads along the pile.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from offwind_pin.dynamics.restraints import LinearRestraint, RootRestraint
from offwind_pin.errors import InputError
from offwind_pin.loads.points import PointLoad
from offwind_pin.loads.dashpots import Dashpot
from offwind_pin.loads.pile_soil import pile_soil
from offwind_pin.turbines.definition import Turbine


@dataclass(frozen=True, eq=False)
class Foundation:
    """One way to hold a monopile.

    Attributes
    ----------
    name : as in the public interface
    base : height of the chain's base in m
    root : restraint of the base's six joints, or None where the base does not move
    soil : loads along the embedded pile
    surrogate : why its numbers stand in for others, or None
    """

    name: str
    base: float
    root: RootRestraint | None = None
    soil: tuple[PointLoad, ...] = ()
    surrogate: str | None = None

    def describe(self) -> dict[str, object]:
        """Plain data for the sidecar: what holds the root and where the soil acts."""
        return {
            "name": self.name,
            "base_z_m": self.base,
            "root": None if self.root is None else self.root.describe(),
            "soil_nodes_z_m": [height for load in self.soil for height in load.height.tolist()],
            "surrogate": self.surrogate,
        }


def clamped(turbine: Turbine) -> Foundation:
    """Rigidly held at the mudline; nothing below exists."""
    return Foundation("clamped", turbine.site.mudline)


def coupled_springs(turbine: Turbine) -> Foundation:
    """A 6x6 stiffness at the mudline stands for pile and soil."""
    springs = turbine.soil.coupled_springs
    if springs is None:
        raise _missing(turbine, "coupled_springs")
    stiffness = np.array(springs.stiffness)
    return Foundation(
        "coupled_springs", turbine.site.mudline, LinearRestraint(stiffness, np.zeros((6, 6)))
    )


def distributed_springs(turbine: Turbine) -> Foundation:
    """The pile to its toe, with p-y springs along it and vertical and torsional springs there."""
    springs = turbine.soil.distributed_springs
    if springs is None:
        raise _missing(turbine, "distributed_springs")
    if turbine.toe >= turbine.site.mudline:
        raise InputError(
            f"turbine {turbine.name}, field members",
            f"a lowest station at z_m = {turbine.toe}",
            f"a pile that reaches below the mudline (z = {turbine.site.mudline} m)",
            "Add a station at the toe, or use another foundation.",
        )
    toe = np.diag(
        [0, 0, springs.toe_vertical_stiffness, 0, 0, springs.toe_torsional_stiffness]
    ).astype(float)
    dashpot = Dashpot.of(springs.dashpot)
    toe_time = dashpot.initial_time + dashpot.secant_time[0]
    return Foundation(
        "distributed_springs",
        turbine.toe,
        LinearRestraint(toe, toe_time * toe),
        pile_soil(springs, turbine.site.mudline, turbine.toe),
        springs.surrogate,
    )


FOUNDATIONS = {
    "clamped": clamped,
    "coupled_springs": coupled_springs,
    "distributed_springs": distributed_springs,
}


def make_foundation(turbine: Turbine, name: str) -> Foundation:
    """The foundation of that name for a turbine.

    Raises
    ------
    InputError : no foundation of that name, or the turbine lacks what it needs
    """
    if name not in FOUNDATIONS:
        raise InputError("foundation", name, ", ".join(FOUNDATIONS), "Choose one of them.")
    return FOUNDATIONS[name](turbine)


def _missing(turbine: Turbine, field: str) -> InputError:
    return InputError(
        f"turbine {turbine.name}, field soil.{field}",
        "nothing",
        "the numbers of this foundation",
        "Add them to the turbine file, or choose another foundation.",
    )
