"""Static condensation of pile and soil to a 6x6 stiffness at the mudline, about a loaded state."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, get_args

import numpy as np

from offwind_pin.analysis.foundation.pile_only import pile_part
from offwind_pin.analysis.static import StaticResult, load_scale, static
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.acting_loads import compiled_loads, split_memory
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import (
    BY_POSITION,
    MOMENT_BY_TURN,
    KernelLoad,
    PointForces,
    PointLoad,
    PointMotion,
    PointTangents,
)
from offwind_pin.loads.root_restraint import FREE
from offwind_pin.loads.tower_top.load_history import constant_load

CondensedStiffness = Literal["tangent", "secant"]

_OUT_OF_BALANCE = 1e-6
"""Residual of the pile over the load scale above which a state does not belong to the system."""


@dataclass(frozen=True, eq=False)
class Condensation:
    """Pile and soil condensed to the mudline.

    Order x, y, z, rx, ry, rz; N, m, rad. Forces and moments act at the axis at the mudline and keep
    their directions.

    Attributes
    ----------
    kind : {"tangent", "secant"}
        Kind of stiffness.
    height : float, m
        Height of the mudline.
    stiffness : (6, 6) array
        Stiffness as computed.
    load : (6,) array, N and N m
        Load of the structure above in the state.
    displacement : (6,) array, m and rad
        Displacement of the axis at the mudline relative to the pile under its own weight. The
        secant stiffness times it is the load, up to products of displacements.
    """

    kind: CondensedStiffness
    height: float
    stiffness: Array
    load: Array
    displacement: Array

    __repr__ = one_line

    @property
    def symmetric(self) -> Array:
        """(6, 6) symmetric part of the stiffness, as required by linear foundations."""
        return (self.stiffness + self.stiffness.T) / 2

    @property
    def symmetry_defect(self) -> float:
        """Largest K_ij - K_ji over the root of K_ii K_jj.

        Zero without load. A moment of constant direction on a rotating axis has no potential, so
        the defect grows with the moments over the rotational stiffness.
        """
        size = np.sqrt(np.abs(np.diag(self.stiffness)))
        difference = self.stiffness - self.stiffness.T
        return float(np.max(np.abs(difference) / np.outer(size, size)))

    def replacing_soil(self, turbine: Turbine) -> Turbine:
        """A turbine with the symmetric part as its soil's ``coupled_springs``.

        Parameters
        ----------
        turbine : Turbine

        Returns
        -------
        Turbine
        """
        source = f"{self.kind} stiffness of distributed springs, condensed to the mudline"
        springs = {"stiffness": self.symmetric.tolist(), "source": source}
        soil = turbine.soil.model_validate({**dict(turbine.soil), "coupled_springs": springs})
        return turbine.model_copy(update={"soil": soil})


def condense(
    system: System, about: StaticResult, *, stiffness: CondensedStiffness = "tangent"
) -> Condensation:
    """Condense everything below the mudline in a static state of a whole structure.

    K = (J T^-1 J')^-1 with the exact tangent T of the pile's equations in that state, the mudline
    load's share of it included, and the Jacobian J of the axis at the mudline.

    Parameters
    ----------
    system : System
        A structure on distributed springs.
    about : StaticResult
        A static state of it.
    stiffness : {"tangent", "secant"}
        ``"tangent"`` for small motions about the state, as in modes and time histories;
        ``"secant"`` with each soil spring replaced by a linear one of force over displacement in
        the state, which takes the unloaded pile to that state in one step.

    Returns
    -------
    Condensation

    Raises
    ------
    InputError
        A system without a pile, or a state of another system.
    """
    if stiffness not in get_args(CondensedStiffness):
        allowed = ", ".join(get_args(CondensedStiffness))
        raise InputError("stiffness", stiffness, allowed, "Choose one of them.")
    if about.q.shape != (system.nv,):
        allowed = f"a static state of this system, with {system.nv} degrees of freedom"
        raise InputError(
            "about",
            f"a state with {len(about.q)} degrees of freedom",
            allowed,
            "Solve the static state again.",
        )
    pile = pile_part(system)
    q, rest = about.q[: pile.nv], np.zeros(pile.nv)
    load = about.mudline_load
    if system.chain.top == pile.chain.top:  # the topmost section has its own node's soil above it
        load = load - _soil_at_head(pile, q, about.memory)
    acting = [constant_load(pile.chain.top, load)]
    chain = CompiledChain(pile, acting)
    chain.memory = about.memory
    residual = float(np.max(np.abs(chain.residual(chain.mean_inputs(), q, rest, rest))))
    residual /= load_scale(system)
    if residual > _OUT_OF_BALANCE:
        allowed = "a static state of this system, in balance"
        raise InputError(
            "about",
            f"a residual of {residual:.2g} of the loads",
            allowed,
            "Solve the static state again.",
        )
    if stiffness == "secant":
        soil = tuple(
            SecantSprings.of(springs, chain.points_at(springs.height), past)
            for springs, past in _soil_and_past(pile, about.memory)
        )
        pile = replace(pile, foundation=replace(pile.foundation, soil=soil))
        chain = CompiledChain(pile, acting)
    chain.factorise(chain.mean_inputs(), q, rest, rest, 0.0, 0.0)
    jacobian = chain.top_jacobian()
    flexibility = jacobian @ np.column_stack([chain.correction(row) for row in jacobian])
    return Condensation(
        kind=stiffness,
        height=pile.chain.top,
        stiffness=np.asarray(np.linalg.inv(flexibility), dtype=float),
        load=load,
        displacement=_displacement(pile, about),
    )


@dataclass(frozen=True, eq=False)
class SecantSprings(PointLoad):
    """Linear springs that replace nonlinear ones, with the same forces and moments in one state.

    Attributes
    ----------
    height : (n,) array, m
        Heights of the nodes.
    stiffness : (n, 3) array, N/m
        Stiffness along x, y and z.
    rotational : (n, 3) array, N m/rad
        Stiffness about x, y and z.
    """

    height: Array
    stiffness: Array
    rotational: Array
    name: str = "secant soil"

    moves_with_ground: ClassVar[bool] = True

    @staticmethod
    def of(springs: KernelLoad, motion: PointMotion, past: Array) -> SecantSprings:
        """Secants of springs in a state, across and along the pile; tangents where undeflected."""
        forces = springs.forces(0.0, motion, 0.0, past)
        blocks = springs.tangents(0.0, motion, 0.0, past).blocks()
        turn = np.zeros_like(motion.axis) if motion.turn is None else motion.turn
        return SecantSprings(
            springs.height,
            _secants(forces.force, motion.displacement, blocks[:, BY_POSITION]),
            _secants(forces.moment, turn, blocks[:, MOMENT_BY_TURN]),
        )

    def forces(self, time: float, motion: PointMotion, ramp_factor: float) -> PointForces:
        turn = np.zeros_like(motion.axis) if motion.turn is None else motion.turn
        return PointForces(-self.stiffness * motion.displacement, -self.rotational * turn)

    def tangents(self, time: float, motion: PointMotion, ramp_factor: float) -> PointTangents:
        return replace(
            PointTangents.zeros(len(self.height)),
            stiffness=-self.stiffness[:, :, None] * np.eye(3),
            moment_stiffness=-self.rotational[:, :, None] * np.eye(3),
        )


def _secants(pull: Array, moved: Array, tangents: Array) -> Array:
    """(n, 3) force over deflection, both (n, 3), horizontal parts together."""
    result = -np.diagonal(tangents, axis1=1, axis2=2).copy()
    for directions in ([0, 1], [2]):
        distance = np.linalg.norm(moved[:, directions], axis=1)
        size = np.linalg.norm(pull[:, directions], axis=1)
        some = distance > 0
        result[np.ix_(some, directions)] = (size[some] / distance[some])[:, None]
    return result


def _soil_at_head(pile: System, q: Array, memory: Array) -> Array:
    """(6,) force and moment of the soil at the node that lies at the mudline, in N and N m."""
    chain, rest = CompiledChain(pile), np.zeros(pile.nv)
    chain.residual(chain.mean_inputs(), q, rest, rest)
    total = np.zeros(6)
    for springs, past in _soil_and_past(pile, memory):
        found = springs.forces(0.0, chain.points_at(springs.height), 0.0, past)
        at_head = springs.height == pile.chain.top
        total += np.concatenate([found.force[at_head].sum(0), found.moment[at_head].sum(0)])
    return total


def _soil_and_past(pile: System, memory: Array) -> Iterator[tuple[KernelLoad, Array]]:
    """Each soil load, with its memory."""
    soil, root = compiled_loads(pile.foundation.soil), pile.foundation.root
    held = FREE if root is None else root.compiled()
    return zip(soil, split_memory(soil, held, memory)[:-1], strict=True)


def _displacement(pile: System, about: StaticResult) -> Array:
    """(6,) displacement and small rotation of the head from the unloaded pile, in m and rad."""
    at = int(np.argmin(np.abs(about.height - about.mudline)))
    rotation = about.rotation[at].copy()
    torsion = [name.endswith("_rz") for name in pile.chain.joint_name]
    rotation[2] = about.q[: pile.nv][torsion].sum()
    settled = static(pile).mudline_displacement
    return np.concatenate([about.mudline_displacement - settled, rotation])
