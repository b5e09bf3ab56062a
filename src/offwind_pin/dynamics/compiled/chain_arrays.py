"""A system as plain arrays, for compiled code: what is constant, and room for what is computed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import compiled_list
from offwind_pin.dynamics.base_excitation import GROUND_NUMBERS, Grounding
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import (
    KernelLoad,
    force_kernel,
    no_tangents,
    nothing_kept,
    nothing_stored,
)
from offwind_pin.loads.root_restraint import KernelRestraint
from offwind_pin.structure.chain import NDArrayInt


class ChainArrays(NamedTuple):
    """The chain, its restraint and its loads, and the state last computed.

    N nodes of d joints (three, or five with shear), r root joints (six or none), D tuned mass
    dampers of one or two joints, which come last; nv degrees of freedom, P loaded points, L loads.
    Axes are those of the world, and wrenches and spatial velocities are about the world's origin,
    linear part first.
    """

    # What does not change
    base: float  # height of the base in m
    roots: int  # root joints
    node_joints: int  # joints of a node
    rise: Array  # (N,) distance from each body's frame to the joint above it in m
    top_rise: float  # from the last body's frame to the yaw bearing in m
    body: Array  # (N + 1, 4) mass, centre of mass above the frame, transverse and axial inertia
    rna_mass: float
    rna_center: Array  # (3,) from the yaw bearing in m
    rna_inertia: Array  # (3, 3) about the centre of mass in kg m2
    slider_body: NDArrayInt  # (D,) carrier of each tuned mass damper
    slider: Array  # (D, 3) mass, offset along the carrier and undeformed height in m
    slider_joint: NDArrayInt  # (D, 2) joint along x and y of the carrier, or -1
    gravity: float
    stiffness: Array  # (nv,) of the joint springs
    damping: Array  # (nv,) of the joint dampers
    restraint: Any  # lists of one exchangeable kernel each: the root's reaction, and end of a step
    restraint_commit: Any
    restraint_numbers: Array  # its constants
    point_body: NDArrayInt  # (P,) body that carries each loaded point
    point_offset: Array  # (P,) along it in m
    point_height: Array  # (P,) undeformed height in m
    loads: int  # L
    first_point: NDArrayInt  # (L + 1,) where each load's points begin
    ground_level: NDArrayInt  # (P + 1,) level of the ground at or below each point and, last, the
    # base; -1 where none is met
    ground_share: Array  # (P + 1,) of the next level
    first_number: NDArrayInt  # (L + 1,) where each load's numbers begin in a row
    forces: Any  # lists of the loads' exchangeable kernels, and of their constants; not empty
    tangents: Any
    energies: Any
    commits: Any
    constants: Any
    first_memory: NDArrayInt  # (L + 2,) where the memory of each load, and of the root, begins
    # The past, as of the last step: with the state it determines all that follows
    memory: Array  # (M,) of the loads and of the root
    # What was last computed
    origin: Array  # (N + 1, 3) place of each body's frame in m
    rotation: Array  # (N + 1, 3, 3) orientation of each body
    velocity: Array  # (N + 1, 3) of the frame's origin in m/s
    spin: Array  # (N + 1, 3) angular velocity in rad/s
    acceleration: Array  # (N + 1, 3) of the frame's origin in m/s2
    spin_rate: Array  # (N + 1, 3) in rad/s2
    joint: Array  # (nv, 6) spatial velocity per unit velocity of each joint
    slider_place: Array  # (D, 3) of the dampers' masses in m
    slider_velocity: Array  # (D, 3) in m/s
    slider_acceleration: Array  # (D, 3) in m/s2
    motion: Array  # (P, 21) motion of the loaded points
    force: Array  # (P, 6) forces and moments there
    lost: Array  # (L,) power that each load dissipates in W
    heat: Array  # (L + 1,) energy in J that each load and the root made heat by ending the step
    wrench: Array  # (N + 1, 6) on each body and all above: loads less inertia and weight
    root_reaction: Array  # (6,) of the restraint
    root_stiffness: Array  # (6, 6)
    root_damping: Array  # (6, 6)
    root_power: Array  # (2,) power that the restraint dissipates in W, energy it stores in J
    residual: Array  # (nv,)
    # The iteration matrix, factorised
    blocks: Array  # (P, 7, 3, 3) derivatives of the forces and moments
    articulated: Array  # (N + 1, 6, 6) matrix of each body, then of all above it as well
    joint_then: Array  # (nv, 6) the joints' columns when it was made
    carry: Array  # (nv, 6) wrench that a joint passes down per unit of its right side
    follow: Array  # (nv, 6) how a joint follows the twist below it
    pivot: Array  # (N + 1, 6, 6) inverted pivot block of each node, the root first
    slider_pivot: Array  # (D, 2, 2) inverted pivot block of each damper
    lack: Array  # (6,) right sides of a node, on the way down
    solution: Array  # (nv,)


@force_kernel
def _no_force(motion: Array, constants: Array, row: Array, memory: Array, force: Array) -> float:
    """Of no load."""
    return 0.0


def chain_arrays(
    system: System, loads: Sequence[KernelLoad], root: KernelRestraint, ground: Grounding
) -> ChainArrays:
    """Arrays of a system under loads, its root held by a restraint if it has joints.

    ground : how points and base meet it
    """
    chain = system.chain
    n, nv = chain.elements, system.nv
    sliding = chain.sliding_mass
    height = np.concatenate([np.zeros(0), *(load.height for load in loads)])
    carrier = chain.body_at(height)
    origin = chain.origin
    widths = [len(load.mean_inputs()) for load in loads]
    sizes = [*(load.memory_size for load in loads), root.memory_size]
    return ChainArrays(
        base=chain.base,
        roots=chain.roots,
        node_joints=len(chain.node_joints),
        rise=np.diff(origin),
        top_rise=float(chain.top - origin[-1]),
        body=np.array(
            [
                [body.mass, body.center - place, body.transverse, body.axial]
                for body, place in zip(chain.body, origin, strict=True)
            ]
        ),
        rna_mass=float(chain.rna.mass),
        rna_center=np.array(chain.rna.center_of_mass, dtype=float),
        rna_inertia=np.array(chain.rna.inertia, dtype=float),
        slider_body=np.array([mass.body for mass in sliding], dtype=np.intp),
        slider=np.array(
            [[mass.mass, mass.height - origin[mass.body], mass.height] for mass in sliding]
        ).reshape(-1, 3),
        slider_joint=_slider_joints(system),
        gravity=float(system.turbine.site.gravity),
        stiffness=system.joint_stiffness,
        damping=system.joint_damping,
        restraint=compiled_list([root.reaction_kernel]),
        restraint_commit=compiled_list([root.commit_kernel]),
        restraint_numbers=root.constants,
        point_body=carrier,
        point_offset=height - origin[carrier],
        point_height=height,
        loads=len(loads),
        first_point=np.cumsum([0, *(len(load.height) for load in loads)], dtype=np.intp),
        ground_level=ground.level,
        ground_share=ground.share,
        # the time comes first, then the ground
        first_number=1 + GROUND_NUMBERS * ground.levels + np.cumsum([0, *widths], dtype=np.intp),
        forces=compiled_list([load.force_kernel for load in loads] or [_no_force]),
        tangents=compiled_list([load.tangent_kernel for load in loads] or [no_tangents]),
        energies=compiled_list([load.energy_kernel for load in loads] or [nothing_stored]),
        commits=compiled_list([load.commit_kernel for load in loads] or [nothing_kept]),
        constants=compiled_list(
            [np.ascontiguousarray(load.constants, dtype=float) for load in loads]
            or [np.zeros((0, 0))]
        ),
        first_memory=np.cumsum([0, *sizes], dtype=np.intp),
        memory=np.zeros(sum(sizes)),
        origin=np.zeros((n + 1, 3)),
        rotation=np.zeros((n + 1, 3, 3)),
        velocity=np.zeros((n + 1, 3)),
        spin=np.zeros((n + 1, 3)),
        acceleration=np.zeros((n + 1, 3)),
        spin_rate=np.zeros((n + 1, 3)),
        joint=np.zeros((nv, 6)),
        slider_place=np.zeros((len(sliding), 3)),
        slider_velocity=np.zeros((len(sliding), 3)),
        slider_acceleration=np.zeros((len(sliding), 3)),
        motion=np.zeros((len(height), 21)),
        force=np.zeros((len(height), 6)),
        lost=np.zeros(len(loads)),
        heat=np.zeros(len(loads) + 1),
        wrench=np.zeros((n + 1, 6)),
        root_reaction=np.zeros(6),
        root_stiffness=np.zeros((6, 6)),
        root_damping=np.zeros((6, 6)),
        root_power=np.zeros(2),
        residual=np.zeros(nv),
        blocks=np.zeros((len(height), 7, 3, 3)),
        articulated=np.zeros((n + 1, 6, 6)),
        joint_then=np.zeros((nv, 6)),
        carry=np.zeros((nv, 6)),
        follow=np.zeros((nv, 6)),
        pivot=np.zeros((n + 1, 6, 6)),
        slider_pivot=np.zeros((len(sliding), 2, 2)),
        lack=np.zeros(6),
        solution=np.zeros(nv),
    )


def _slider_joints(system: System) -> NDArrayInt:
    """(D, 2) place of each tuned mass damper's joints along x and y in q, or -1."""
    names = system.chain.joint_name
    rows = [
        [
            names.index(mass.joint_names[mass.joints.index(joint)]) if joint in mass.joints else -1
            for joint in ("px", "py")
        ]
        for mass in system.chain.sliding_mass
    ]
    return np.array(rows, dtype=np.intp).reshape(-1, 2)
