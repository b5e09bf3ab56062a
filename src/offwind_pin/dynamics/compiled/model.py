"""Model, data, state and factorisation of a chain under loads: the records of the compiled code.

N nodes of d joints (three, or five with shear), r root joints (six or none), D tuned mass dampers
of one or two joints, which come last; nv degrees of freedom, P loaded points, L loads. Axes are
those of the world, and wrenches and spatial velocities are about the world's origin, linear part
first.
"""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from numba import types

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import exchangeable
from offwind_pin.base.records import (
    Count,
    Counts,
    Counts2,
    Number,
    Numbers,
    Numbers2,
    Numbers3,
    Numbers4,
    Record,
)

Vector = tuple[float, float, float]

NO_JOINT = -1
"""In place of the number of a joint that a damper does not have."""


class TunedMasses(Record):
    """Tuned mass dampers, and the kernels that move them, where there are any.

    Attributes
    ----------
    body : (D,) carrier of each damper
    joint : (D, 2) joint along x and y of the carrier, or :data:`NO_JOINT`
    mass : (D,) in kg
    offset : (D,) along the carrier in m
    height : (D,) undeformed, in m
    before, after, between, energies : addresses of the kernels in
        :mod:`offwind_pin.dynamics.compiled.tuned_mass`; 0 without dampers
    """

    body: Counts
    joint: Counts2
    mass: Numbers
    offset: Numbers
    height: Numbers
    before: Count
    after: Count
    between: Count
    energies: Count


class CoupledDampers(Record):
    """Dampers that couple points of the structure: k of them, see :mod:`coupled`.

    Attributes
    ----------
    rate : (k,) own force per unit of the sum of velocities that each acts on
    first_point : (k,) first of its points
    first_wrench : (k + 1,) where its wrenches begin in the next array, one for each point, from
        below
    wrench : (..., 6) force and moment at a point per unit of the damper's own force
    factorise, solve : addresses of the kernels that know nothing of them; 0 without dampers
    """

    rate: Numbers
    first_point: Counts
    first_wrench: Counts
    wrench: Numbers2
    factorise: Count
    solve: Count


class Model(Record):
    """What does not change: the chain, its restraint and its loads.

    Attributes
    ----------
    base : height of the base in m
    gravity : in m/s2
    roots, node_joints : number of root joints, and of joints of a node
    length : (N,) distance from each body's frame to the joint above it in m
    top_length : from the last body's frame to the yaw bearing in m
    body : (N + 1, 4) mass, centre of mass above the frame, transverse and axial inertia
    rna_mass, rna_center, rna_inertia : of the rotor-nacelle assembly; (3,) from the yaw bearing in
        m, (3, 3) about the centre of mass in kg m2
    tmd : tuned mass dampers
    coupled : dampers that couple points
    stiffness, damping : (nv,) of the joint springs and dampers
    restraint, restraint_commit : addresses of the root's kernels; the second is 0 without memory
    restraint_constants : (c,) of the restraint
    point_body : (P,) body that carries each loaded point
    point_offset, point_height : (P,) along it, and undeformed, in m
    ground_level, ground_share : (P + 1,) level of the ground at or below each point and, last, the
        base, -1 where none is met; share of the next level
    first_point, first_input, first_constant : (L + 1,) where each load's points, time inputs and
        constants begin
    columns : (L,) of each load's constants, which have a row for each of its points
    constants : of all loads, one after another
    first_memory : (L + 2,) where the memory of each load, and of the root, begins
    forces, tangents, commits : (L,) addresses of the loads' kernels; 0 for a load without tangents,
        or without memory
    evaluation : addresses of the kernels that evaluate a state, in their order
    assembly, elimination : of those that set the bodies' matrices, and factorise them
    """

    base: Number
    gravity: Number
    roots: Count
    node_joints: Count
    length: Numbers
    top_length: Number
    body: Numbers2
    rna_mass: Number
    rna_center: Numbers
    rna_inertia: Numbers2
    tmd: TunedMasses
    coupled: CoupledDampers
    stiffness: Numbers
    damping: Numbers
    restraint: Count
    restraint_commit: Count
    restraint_constants: Numbers
    point_body: Counts
    point_offset: Numbers
    point_height: Numbers
    ground_level: Counts
    ground_share: Numbers
    first_point: Counts
    first_input: Counts
    first_constant: Counts
    columns: Counts
    constants: Numbers
    first_memory: Counts
    forces: Counts
    tangents: Counts
    commits: Counts
    evaluation: Counts
    assembly: Counts
    elimination: Counts


class State(Record):
    """What determines all that follows: copies and pickles, and is copied into (:meth:`set`).

    Attributes
    ----------
    q, v, a : (nv,) displacements, velocities and accelerations of the joints
    memory : (M,) what loads and root keep of their past, as of the last step
    clock : (1,) time in s
    """

    q: Numbers
    v: Numbers
    a: Numbers
    memory: Numbers
    clock: Numbers

    @classmethod
    def of(cls, model: Model) -> Self:
        """At rest, undeformed, without a past."""
        nv = len(model.stiffness)
        memory = np.zeros(model.first_memory[-1])
        return cls(np.zeros(nv), np.zeros(nv), np.zeros(nv), memory, np.zeros(1))

    @property
    def time(self) -> float:
        """In s."""
        return float(self.clock[0])

    def copy(self) -> Self:
        """Of the same contents, with arrays of its own."""
        return type(self)(*(array.copy() for array in self._arrays()))

    def set(self, other: State) -> None:
        """Copy the contents of a state of the same system."""
        for array, given in zip(self._arrays(), other._arrays(), strict=True):
            if array.shape != given.shape:
                raise ValueError(f"a state of another system: shape {given.shape}, {array.shape}")
            array[:] = given

    def _arrays(self) -> tuple[Array, ...]:
        return self.q, self.v, self.a, self.memory, self.clock


class Data(Record):
    """What the residual's kernel computes of a state.

    Attributes
    ----------
    position : (N + 1, 3) of each body's frame in m
    rotation : (N + 1, 3, 3) orientation of each body
    velocity, acceleration : (N + 1, 3) of the frame's origin in m/s and m/s2
    angular_velocity, angular_acceleration : (N + 1, 3) in rad/s and rad/s2
    joint : (nv, 6) spatial velocity per unit velocity of each joint
    tmd_position, tmd_velocity, tmd_acceleration : (D, 3) of the dampers' masses in m, m/s, m/s2
    ground : (P + 1, 9) displacement, velocity and acceleration of the ground at the loaded points
        and, last, the base; zero where none is met
    motion : (P, 21) of the loaded points
    force : (P, 6) forces and moments there
    dissipated_power : (L,) of each load in W
    dissipated_energy : (L + 1,) by each load and the root at the end of the last step, in J
    wrench : (N + 1, 6) on each body and all above: loads less inertia and weight
    root_reaction, root_stiffness, root_damping : (6,), (6, 6) and (6, 6) of the restraint
    root_power : (2,) power that the restraint dissipates in W, energy that it stores in J
    residual : (nv,)
    """

    position: Numbers2
    rotation: Numbers3
    velocity: Numbers2
    acceleration: Numbers2
    angular_velocity: Numbers2
    angular_acceleration: Numbers2
    joint: Numbers2
    tmd_position: Numbers2
    tmd_velocity: Numbers2
    tmd_acceleration: Numbers2
    ground: Numbers2
    motion: Numbers2
    force: Numbers2
    dissipated_power: Numbers
    dissipated_energy: Numbers
    wrench: Numbers2
    root_reaction: Numbers
    root_stiffness: Numbers2
    root_damping: Numbers2
    root_power: Numbers
    residual: Numbers

    @classmethod
    def of(cls, model: Model) -> Self:
        """Room for a model."""
        bodies, nv = len(model.body), len(model.stiffness)
        dampers, points, loads = len(model.tmd.body), len(model.point_body), len(model.forces)
        return cls(
            position=np.zeros((bodies, 3)),
            rotation=np.zeros((bodies, 3, 3)),
            velocity=np.zeros((bodies, 3)),
            acceleration=np.zeros((bodies, 3)),
            angular_velocity=np.zeros((bodies, 3)),
            angular_acceleration=np.zeros((bodies, 3)),
            joint=np.zeros((nv, 6)),
            tmd_position=np.zeros((dampers, 3)),
            tmd_velocity=np.zeros((dampers, 3)),
            tmd_acceleration=np.zeros((dampers, 3)),
            ground=np.zeros((points + 1, 9)),
            motion=np.zeros((points, 21)),
            force=np.zeros((points, 6)),
            dissipated_power=np.zeros(loads),
            dissipated_energy=np.zeros(loads + 1),
            wrench=np.zeros((bodies, 6)),
            root_reaction=np.zeros(6),
            root_stiffness=np.zeros((6, 6)),
            root_damping=np.zeros((6, 6)),
            root_power=np.zeros(2),
            residual=np.zeros(nv),
        )


class Factorisation(Record):
    """A matrix da_dq M + dv_dq D + K, factorised about a state.

    Attributes
    ----------
    blocks : (P, 7, 3, 3) derivatives of the forces and moments
    articulated : (N + 1, 6, 6) matrix of each body and, eliminated, of all above it as well
    joint : (nv, 6) the joints' columns when it was made
    carry : (nv, 6) wrench that a joint passes down per unit of its right side
    follow : (nv, 6) how a joint follows the twist below it
    pivot : (N + 1, 6, 6) inverted pivot block of each node, the root first
    tmd_pivot : (D, 2, 2) inverted pivot block of each damper
    tmd_passed : (D, 6) wrench that each damper passes down, then the twist of its carrier
    coupled_row, coupled_column : (k, nv) of the coupled dampers: their generalised forces, and what
        these move
    coupled_block, coupled_inverse, coupled_force : (k, k), (k, k) and (k,)
    rhs : (6,) right sides of a node, on the way down
    solution : (nv,)
    """

    blocks: Numbers4
    articulated: Numbers3
    joint: Numbers2
    carry: Numbers2
    follow: Numbers2
    pivot: Numbers3
    tmd_pivot: Numbers3
    tmd_passed: Numbers2
    coupled_row: Numbers2
    coupled_column: Numbers2
    coupled_block: Numbers2
    coupled_inverse: Numbers2
    coupled_force: Numbers
    rhs: Numbers
    solution: Numbers

    @classmethod
    def of(cls, model: Model) -> Self:
        """Room for a model."""
        bodies, nv = len(model.body), len(model.stiffness)
        dampers, coupled = len(model.tmd.body), len(model.coupled.rate)
        return cls(
            blocks=np.zeros((len(model.point_body), 7, 3, 3)),
            articulated=np.zeros((bodies, 6, 6)),
            joint=np.zeros((nv, 6)),
            carry=np.zeros((nv, 6)),
            follow=np.zeros((nv, 6)),
            pivot=np.zeros((bodies, 6, 6)),
            tmd_pivot=np.zeros((dampers, 2, 2)),
            tmd_passed=np.zeros((dampers, 6)),
            coupled_row=np.zeros((coupled, nv)),
            coupled_column=np.zeros((coupled, nv)),
            coupled_block=np.zeros((coupled, coupled)),
            coupled_inverse=np.zeros((coupled, coupled)),
            coupled_force=np.zeros(coupled),
            rhs=np.zeros(6),
            solution=np.zeros(nv),
        )


MODEL, DATA, STATE = Model.numba_type(), Data.numba_type(), State.numba_type()
FACTORISATION = Factorisation.numba_type()
ROW: Any = types.float64[::1]

evaluation_kernel = exchangeable(types.void(MODEL, DATA, STATE, ROW), python=False)
"""Decorator for ``kernel(model, data, state, time_inputs)``: a part of evaluating a state."""
matrix_kernel = exchangeable(
    types.void(MODEL, DATA, STATE, FACTORISATION, ROW, types.float64, types.float64), python=False
)
"""Decorator for ``kernel(model, data, state, factors, time_inputs, dv_dq, da_dq)``: a part of the
factorisation."""
