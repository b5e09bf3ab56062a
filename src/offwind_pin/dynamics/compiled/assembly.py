"""The model of a system under loads, for compiled code."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from offwind_pin.base.kernels import ExchangeableKernel
from offwind_pin.dynamics.base_excitation import GROUND_NUMBERS, BaseExcitation
from offwind_pin.dynamics.compiled.coupled import coupled_dampers
from offwind_pin.dynamics.compiled.forward_kinematics import move_bodies, move_points
from offwind_pin.dynamics.compiled.ground import move_ground
from offwind_pin.dynamics.compiled.model import NO_JOINT, Model, TunedMasses
from offwind_pin.dynamics.compiled.newton_matrix import (
    body_matrices,
    eliminate,
    load_matrices,
    load_tangents,
)
from offwind_pin.dynamics.compiled.residual import (
    balance,
    collect_wrenches,
    evaluate_loads,
    restrain,
)
from offwind_pin.dynamics.compiled.tuned_mass import (
    tmd_after,
    tmd_before,
    tmd_between,
    tmd_eliminate,
    tmd_energies,
    tmd_residual,
)
from offwind_pin.dynamics.system import System
from offwind_pin.loads.point_load import KernelLoad, no_tangents, nothing_kept
from offwind_pin.loads.root_restraint import KernelRestraint, nothing_kept_by_root
from offwind_pin.structure.chain import NDArrayInt

_NO_KERNEL = 0


def make_model(
    system: System, loads: Sequence[KernelLoad], root: KernelRestraint, ground: BaseExcitation
) -> Model:
    """Model of a system under loads, its root held by a restraint if it has joints.

    ground : how points and base meet it
    """
    chain = system.chain
    height = np.concatenate([np.zeros(0), *(load.height for load in loads)])
    carrier = chain.body_at(height)
    origin = chain.origin
    widths = [len(load.mean_inputs()) for load in loads]
    constants = [np.asarray(load.constants, dtype=float) for load in loads]
    damped = bool(chain.tuned_masses)
    evaluation = [
        *([move_ground] if ground.levels else []),
        move_bodies,
        move_points,
        evaluate_loads,
        collect_wrenches,
        *([tmd_residual] if damped else []),
        balance,
        *([restrain] if chain.roots else []),
    ]
    elimination = [*([tmd_eliminate] if damped else []), eliminate]
    sizes = [*(load.memory_size for load in loads), root.memory_size]
    return Model(
        base=chain.base,
        gravity=float(system.turbine.site.gravity),
        roots=chain.roots,
        node_joints=len(chain.node_joints),
        length=np.diff(origin),
        top_length=float(chain.top - origin[-1]),
        body=np.array(
            [
                [body.mass, body.center - place, body.transverse, body.axial]
                for body, place in zip(chain.body, origin, strict=True)
            ]
        ),
        rna_mass=float(chain.rna.mass),
        rna_center=np.array(chain.rna.center_of_mass, dtype=float),
        rna_inertia=np.array(chain.rna.inertia, dtype=float),
        tmd=_tuned_masses(system),
        coupled=coupled_dampers(loads),
        stiffness=np.ascontiguousarray(system.joint_stiffness, dtype=float),
        damping=np.ascontiguousarray(system.joint_damping, dtype=float),
        restraint=root.reaction_kernel.address if chain.roots else _NO_KERNEL,
        restraint_commit=(
            _NO_KERNEL if root.commit_kernel is nothing_kept_by_root else root.commit_kernel.address
        ),
        restraint_constants=np.ascontiguousarray(root.constants, dtype=float),
        point_body=carrier,
        point_offset=height - origin[carrier],
        point_height=height,
        ground_level=ground.level,
        ground_share=ground.share,
        first_point=_beginnings([len(load.height) for load in loads]),
        # the time comes first, then the ground
        first_input=1 + GROUND_NUMBERS * ground.levels + _beginnings(widths),
        first_constant=_beginnings([table.size for table in constants]),
        columns=np.array([table.shape[1] for table in constants], dtype=np.intp),
        constants=np.concatenate([np.zeros(0), *(table.ravel() for table in constants)]),
        first_memory=_beginnings(sizes),
        forces=addresses([load.force_kernel for load in loads]),
        tangents=addresses(
            [None if load.tangent_kernel is no_tangents else load.tangent_kernel for load in loads]
        ),
        commits=addresses(
            [None if load.commit_kernel is nothing_kept else load.commit_kernel for load in loads]
        ),
        evaluation=addresses(evaluation),
        assembly=addresses([body_matrices, load_tangents, load_matrices]),
        elimination=addresses(elimination),
    )


def _tuned_masses(system: System) -> TunedMasses:
    names, origin = system.chain.joint_name, system.chain.origin
    sliding = system.chain.tuned_masses
    joints = [
        [
            names.index(mass.joint_names[mass.joints.index(joint)])
            if joint in mass.joints
            else NO_JOINT
            for joint in ("px", "py")
        ]
        for mass in sliding
    ]
    body = np.array([mass.body for mass in sliding], dtype=np.intp)
    height = np.array([mass.height for mass in sliding], dtype=float)
    kernels = [tmd_before, tmd_after, tmd_between, tmd_energies]
    return TunedMasses(
        body,
        np.array(joints, dtype=np.intp).reshape(-1, 2),
        np.array([mass.mass for mass in sliding], dtype=float),
        height - origin[body],
        height,
        *(kernel.address if sliding else _NO_KERNEL for kernel in kernels),
    )


def _beginnings(sizes: Sequence[int]) -> NDArrayInt:
    return np.cumsum([0, *sizes], dtype=np.intp)


def addresses(kernels: Sequence[ExchangeableKernel | None]) -> NDArrayInt:
    """(n,) addresses of kernels; 0 for none."""
    found = [_NO_KERNEL if kernel is None else kernel.address for kernel in kernels]
    return np.array(found, dtype=np.intp)
