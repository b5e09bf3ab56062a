"""Foundations: start of the chain, root restraint and soil springs.

Clamped and apparent fixity fix the root of a chain rigidly; coupled springs and a macro-element
restrain its six joints at the mudline; with distributed springs the chain starts at the toe, with a
restraint there and point loads along the pile.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.point_load import PointLoad
from offwind_pin.loads.root_restraint import LinearRestraint, RootRestraint
from offwind_pin.loads.soil.soil_profile import PileNodes
from offwind_pin.loads.soil.springs.dashpot import Dashpot
from offwind_pin.loads.soil.springs.pile import pile_nodes, pile_soil
from offwind_pin.loads.soil.warnings import cautions
from offwind_pin.structure.section import outer_diameter


@dataclass(frozen=True, eq=False)
class Foundation:
    """One way to support a monopile.

    Attributes
    ----------
    name : str
        Name of the kind of foundation.
    base : float, m
        Height of the chain's base.
    root : RootRestraint or None
        Restraint of the base's six joints; None for a fixed base.
    soil : tuple of PointLoad
        Loads along the embedded pile.
    surrogate : str or None
        Why its numbers replace others, or None.
    structure : Turbine or None
        The supported structure, if it is not the turbine as defined.
    facts : dict of str to object
        Plain data about its derivation.
    cautions : tuple of str
        Cautions about curves used outside their range of validity.
    """

    name: str
    base: float
    root: RootRestraint | None = None
    soil: tuple[PointLoad, ...] = ()
    surrogate: str | None = None
    structure: Turbine | None = None
    facts: dict[str, object] = field(default_factory=dict)
    cautions: tuple[str, ...] = ()

    __repr__ = one_line

    def describe(self) -> dict[str, object]:
        """Plain data for the sidecar file: the root restraint and where the soil acts.

        Returns
        -------
        dict of str to object
        """
        return {
            "name": self.name,
            "base_z_m": self.base,
            "root": None if self.root is None else self.root.describe(),
            "soil_nodes_z_m": [height for load in self.soil for height in load.height.tolist()],
            **self.facts,
            "surrogate": self.surrogate,
        }


def clamped(turbine: Turbine) -> Foundation:
    """Fixed rigidly at the mudline; the pile is not modelled."""
    return Foundation("clamped", turbine.site.mudline)


def coupled_springs(turbine: Turbine) -> Foundation:
    """A 6x6 stiffness at the mudline in place of pile and soil."""
    stiffness = given_stiffness(turbine)
    return Foundation(
        "coupled_springs", turbine.site.mudline, LinearRestraint(stiffness, np.zeros((6, 6)))
    )


def given_stiffness(turbine: Turbine) -> Array:
    """(6, 6) of the turbine's coupled springs.

    Raises
    ------
    InputError
        None are given, or scour has moved the mudline to which they refer.
    """
    springs = turbine.soil.coupled_springs
    if springs is None:
        raise missing(turbine, "coupled_springs")
    if turbine.site.scour_depth != 0:
        raise InputError(
            f"turbine {turbine.name}, field site.scour_depth_m",
            turbine.site.scour_depth,
            "0 with soil.coupled_springs, whose 6x6 refers to the original mudline",
            "Condense the distributed springs of the scoured pile, or use them.",
        )
    return np.array(springs.stiffness)


def distributed_springs(turbine: Turbine) -> Foundation:
    """The pile to its toe, with soil springs along it and linear springs at the toe."""
    springs = turbine.soil.distributed_springs
    if springs is None:
        raise missing(turbine, "distributed_springs")
    mudline, toe = turbine.site.mudline, turbine.toe
    if toe >= mudline:
        raise InputError(
            f"turbine {turbine.name}, field members",
            f"a lowest station at z_m = {toe}",
            f"a pile that reaches below the mudline (z = {mudline} m)",
            "Add a station at the toe, or use another foundation.",
        )
    height, length = pile_nodes(springs.nodes, mudline, toe)
    nodes = PileNodes(
        mudline - height, outer_diameter(turbine, height), mudline - toe, turbine.site.scour_depth
    )
    stiffness = np.diag(
        [0, 0, springs.toe_vertical_stiffness, 0, 0, springs.toe_torsional_stiffness]
    ).astype(float)
    dashpot = Dashpot.of(springs.dashpot)
    return Foundation(
        "distributed_springs",
        toe,
        LinearRestraint(stiffness, (dashpot.initial_time + dashpot.secant_time[0]) * stiffness),
        pile_soil(springs, nodes, height, length),
        springs.surrogate,
        cautions=tuple(cautions(springs, nodes)),
    )


def missing(turbine: Turbine, field: str) -> InputError:
    """Error for a missing block of the turbine's soil."""
    return InputError(
        f"turbine {turbine.name}, field soil.{field}",
        "nothing",
        "the parameters of this foundation",
        "Add them to the turbine file, or choose another foundation.",
    )
