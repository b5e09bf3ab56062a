"""The iteration matrix of Newton's method, factorised and applied in O(N).

Written in spatial velocities, the matrix da_dq M + dv_dq D + K of a chain is

    A = diag(joints) + S' B S - (turning joint axes),

with one 6x6 matrix B for each body. Eliminating the joints from the top down is the recursion of
the articulated-body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7), the
matrices B in place of the bodies' inertias, and springs in the joints. Nothing is assembled.
"""

from __future__ import annotations

import numpy as np
from numba import types

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import exchangeable, inlined, inner
from offwind_pin.base.records import matrix, part
from offwind_pin.dynamics.compiled.model import Data, Factorisation, Model, State
from offwind_pin.dynamics.compiled.residual import (
    DATA,
    MODEL,
    ROW,
    STATE,
    inertial_wrench,
    rna_wrench,
)
from offwind_pin.dynamics.compiled.vectors import add_arm, add_inertia, axis_of, row_of, scale
from offwind_pin.loads.point_load import tangent_kernel

FACTORISATION = Factorisation.numba_type()

assemble_kernel = exchangeable(
    types.void(MODEL, DATA, STATE, FACTORISATION, ROW, types.float64, types.float64), nogil=True
)
factorise_kernel = exchangeable(
    types.void(MODEL, DATA, STATE, FACTORISATION, ROW, types.float64, types.float64), nogil=True
)
solve_kernel = exchangeable(types.void(MODEL, FACTORISATION, ROW), nogil=True)
tmd_eliminate_kernel = exchangeable(
    types.void(MODEL, DATA, FACTORISATION, types.float64, types.float64)
)
"""Decorator for ``kernel(model, data, factors, dv_dq, da_dq)``; see :mod:`tuned_mass`."""
tmd_before_kernel = exchangeable(types.void(MODEL, FACTORISATION, ROW))
"""Decorator for ``kernel(model, factors, rhs)``: the dampers on a carrier at rest."""
tmd_after_kernel = exchangeable(types.void(MODEL, FACTORISATION))
"""Decorator for ``kernel(model, factors)``: what the twists of the carriers add."""

_tangents, _assemble = tangent_kernel.call, assemble_kernel.call
_tmd_eliminate, _tmd_before = tmd_eliminate_kernel.call, tmd_before_kernel.call
_tmd_after = tmd_after_kernel.call


@factorise_kernel
def factorise(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Factorise the iteration matrix about an evaluated state.

    data : of the state, as :func:`evaluate` set it
    dv_dq, da_dq : derivatives of velocity and acceleration by displacement in the integrator's
        step, in 1/s and 1/s2; both zero for statics, where the matrix is the exact tangent. In
        motion the terms of the inertia forces that depend on velocity are left out.
    """
    _assemble(model.assemble, (model, data, state, factors, time_inputs, dv_dq, da_dq))
    if model.tmd.eliminate != 0:
        _tmd_eliminate(model.tmd.eliminate, (model, data, factors, dv_dq, da_dq))
    eliminate(model, data, factors, dv_dq)


@assemble_kernel
def assemble(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Set the bodies' matrices of an evaluated state and time inputs; nothing is eliminated."""
    body_matrices(model, data, factors, da_dq)
    load_matrices(model, data, state, factors, time_inputs, dv_dq, da_dq)


@solve_kernel
def solve(model: Model, factors: Factorisation, rhs: Array) -> None:
    """Set the solution of the factorised system for a right side (nv,)."""
    joint, carry, follow, pivot = factors.joint, factors.carry, factors.follow, factors.pivot
    x, own, passed, tmd_body = factors.solution, factors.rhs, factors.tmd_passed, model.tmd.body
    roots, node_joints, last = model.roots, model.node_joints, len(model.length)
    down = np.zeros(6)
    if model.tmd.before != 0:
        _tmd_before(model.tmd.before, (model, factors, rhs))
    for k in range(last, -1, -1):
        count = node_joints if k > 0 else roots
        first = roots + node_joints * (k - 1) if k > 0 else 0
        for d in range(len(tmd_body)):
            if tmd_body[d] == k:
                for j in range(6):
                    down[j] += passed[d, j]
        for i in range(count):
            value = rhs[first + i]
            for j in range(6):
                value -= joint[first + i, j] * down[j]
            own[i] = value
        for i in range(count):
            value = 0.0
            for j in range(count):
                value += pivot[k, i, j] * own[j]
            x[first + i] = value
        for i in range(count):
            for j in range(6):
                down[j] += carry[first + i, j] * x[first + i]
    for j in range(6):  # from here on the twist of the bodies, from the base upwards
        down[j] = 0.0
    dof = 0
    for k in range(last + 1):
        count = node_joints if k > 0 else roots
        for i in range(count):
            for j in range(6):
                x[dof + i] -= follow[dof + i, j] * down[j]
        for i in range(count):
            for j in range(6):
                down[j] += joint[dof + i, j] * x[dof + i]
        for d in range(len(tmd_body)):
            if tmd_body[d] == k:
                for j in range(6):
                    passed[d, j] = down[j]
        dof += count
    if model.tmd.after != 0:
        _tmd_after(model.tmd.after, (model, factors))


@inlined
def eliminate(model: Model, data: Data, factors: Factorisation, dv_dq: float) -> None:
    """Eliminate the joints from the top down; each body's matrix then includes all above it."""
    axes, wrench, articulated, joint = data.joint, data.wrench, factors.articulated, factors.joint
    carry, follow, pivot = factors.carry, factors.follow, factors.pivot
    stiffness, damping = model.stiffness, model.damping
    root_stiffness, root_damping = data.root_stiffness, data.root_damping
    block, inverse, turning = np.empty((6, 6)), np.empty((6, 6)), np.empty(6)
    back = np.empty((6, 6))
    for k in range(len(articulated) - 1, -1, -1):
        count = model.node_joints if k > 0 else model.roots
        first = model.roots + model.node_joints * (k - 1) if k > 0 else 0
        for i in range(count):
            dof = first + i
            turn_of_axis(axes, wrench, dof, k, turning)
            for j in range(6):
                joint[dof, j] = axes[dof, j]
                passed, returned = 0.0, -turning[j]
                for m in range(6):
                    passed += articulated[k, j, m] * axes[dof, m]
                    returned += articulated[k, m, j] * axes[dof, m]
                carry[dof, j], back[i, j] = passed, returned
            for m in range(count):
                block[i, m] = 0.0
            for m in range(i):
                for j in range(6):
                    block[i, m] -= turning[j] * axes[first + m, j]
            block[i, i] += stiffness[dof] + dv_dq * damping[dof]
        for i in range(count):
            for m in range(count):
                for j in range(6):
                    block[i, m] += axes[first + i, j] * carry[first + m, j]
                if k == 0:
                    block[i, m] += root_stiffness[i, m] + dv_dq * root_damping[i, m]
        invert(block, count, inverse)
        for i in range(count):
            for m in range(count):
                pivot[k, i, m] = inverse[i, m]
            for j in range(6):
                value = 0.0
                for m in range(count):
                    value += inverse[i, m] * back[m, j]
                follow[first + i, j] = value
                for m in range(6):
                    articulated[k, m, j] -= carry[first + i, m] * value
        if k > 0:
            for i in range(6):
                for j in range(6):
                    articulated[k - 1, i, j] += articulated[k, i, j]


@inner
def turn_of_axis(axes: Array, wrench: Array, dof: int, k: int, turning: Array) -> None:
    """Set (6,) work of the held wrench on a joint's column, as the twist below turns that column.

    k : body that the joint moves
    """
    for i in range(3):
        j, m = (i + 1) % 3, (i + 2) % 3
        turning[i] = axes[dof, 3 + j] * wrench[k, m] - axes[dof, 3 + m] * wrench[k, j]
        value = axes[dof, j] * wrench[k, m] - axes[dof, m] * wrench[k, j]
        value += axes[dof, 3 + j] * wrench[k, 3 + m] - axes[dof, 3 + m] * wrench[k, 3 + j]
        turning[3 + i] = value


@inner
def invert(block: Array, count: int, inverse: Array) -> None:
    """Set the inverse of the leading part of a matrix, by cofactors where it is 3 x 3.

    The block may be overwritten.

    Raises
    ------
    LinAlgError : the part is singular
    """
    if count != 3:
        invert_by_pivots(block, count, inverse)
        return
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        for m in range(3):
            n, o = (m + 1) % 3, (m + 2) % 3
            inverse[m, i] = block[j, n] * block[k, o] - block[j, o] * block[k, n]
    determinant = 0.0
    for i in range(3):
        determinant += block[0, i] * inverse[i, 0]
    if determinant == 0:
        raise np.linalg.LinAlgError("Matrix is singular to machine precision.")
    for i in range(3):
        for j in range(3):
            inverse[i, j] /= determinant


@inner
def invert_by_pivots(block: Array, count: int, inverse: Array) -> None:
    """The same of any size, by Gauss-Jordan elimination with row pivots."""
    for i in range(count):
        for j in range(count):
            inverse[i, j] = 1.0 if i == j else 0.0
    for i in range(count):
        best = i
        for m in range(i + 1, count):
            if abs(block[m, i]) > abs(block[best, i]):
                best = m
        head = block[best, i]
        if head == 0:
            raise np.linalg.LinAlgError("Matrix is singular to machine precision.")
        for j in range(count):
            block[i, j], block[best, j] = block[best, j], block[i, j]
            inverse[i, j], inverse[best, j] = inverse[best, j], inverse[i, j]
        for j in range(count):
            block[i, j] /= head
            inverse[i, j] /= head
        for m in range(count):
            factor = block[m, i]
            if m != i and factor != 0:
                for j in range(count):
                    block[m, j] -= factor * block[i, j]
                    inverse[m, j] -= factor * inverse[i, j]


@inlined
def body_matrices(model: Model, data: Data, factors: Factorisation, da_dq: float) -> None:
    """Set the matrices of the bodies: inertia, and the arms of their weight."""
    articulated, body, rotation = factors.articulated, model.body, data.rotation
    last = len(articulated) - 1
    inertia = np.empty((3, 3))
    for k in range(last + 1):
        axis = axis_of(rotation, k)
        for i in range(3):
            for j in range(3):
                inertia[i, j] = (body[k, 3] - body[k, 2]) * axis[i] * axis[j]
            inertia[i, i] += body[k, 2]
        for i in range(6):
            for j in range(6):
                articulated[k, i, j] = 0.0
        need, _, center = inertial_wrench(
            model, data, k, body[k, 0], body[k, 1], body[k, 2], body[k, 3]
        )
        add_inertia(articulated, k, da_dq, body[k, 0], center, inertia)
        add_arm(articulated, k, center, scale(-1.0, need))
    for i in range(3):
        for j in range(3):
            value = 0.0
            for m in range(3):
                for n in range(3):
                    turned = rotation[last, i, m] * rotation[last, j, n]
                    value += turned * model.rna_inertia[m, n]
            inertia[i, j] = value
    need, _, center = rna_wrench(model, data)
    add_inertia(articulated, last, da_dq, model.rna_mass, center, inertia)
    add_arm(articulated, last, center, scale(-1.0, need))


@inlined
def load_matrices(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Take off the loads' derivatives, and add the arms of their forces."""
    blocks, motion, articulated = factors.blocks, data.motion, factors.articulated
    by_twist = np.empty((3, 6))
    for load in range(len(model.forces)):
        first, last = model.first_point[load], model.first_point[load + 1]
        own = part(blocks, first, last)
        own.fill(0.0)
        if model.tangents[load] != 0:
            _tangents(
                model.tangents[load],
                (
                    part(motion, first, last),
                    matrix(
                        model.constants, model.first_constant[load], last - first, model.columns[load]
                    ),
                    part(time_inputs, model.first_input[load], model.first_input[load + 1]),
                    part(state.memory, model.first_memory[load], model.first_memory[load + 1]),
                    own,
                ),
            )
    for i in range(len(blocks)):
        k = model.point_body[i]
        position = row_of(motion, i)
        axis = (motion[i, 9], motion[i, 10], motion[i, 11])
        for j in range(3):
            for m in range(3):
                by_twist[j, m] = (
                    blocks[i, 0, j, m] + dv_dq * blocks[i, 1, j, m] + da_dq * blocks[i, 2, j, m]
                )
            for m in range(3):
                n, o = (m + 1) % 3, (m + 2) % 3
                # a rotation about m moves the point by e_m x p, and turns the axis by e_m x e
                value = by_twist[j, o] * position[n] - by_twist[j, n] * position[o]
                value += blocks[i, 3, j, o] * axis[n] - blocks[i, 3, j, n] * axis[o]
                by_twist[j, 3 + m] = value
        for m in range(6):
            for j in range(3):
                n, o = (j + 1) % 3, (j + 2) % 3
                articulated[k, j, m] -= by_twist[j, m]
                moment = position[n] * by_twist[o, m] - position[o] * by_twist[n, m]
                articulated[k, 3 + j, m] -= moment
        add_arm(articulated, k, position, row_of(data.force, i))
        size = 0.0
        for n in range(4, 7):
            for j in range(3):
                for m in range(3):
                    size += abs(blocks[i, n, j, m])
        if size > 0:
            add_moment(articulated, k, blocks, i, position, data.rotation, dv_dq)


@inner
def add_moment(
    matrices: Array,
    k: int,
    blocks: Array,
    i: int,
    position: tuple[float, float, float],
    rotation: Array,
    dv_dq: float,
) -> None:
    """Take off matrix k the derivatives of point i's moment by position, rotation and its rate.

    A rotation phi turns an orientation R by [phi] R, and its axial vector by (tr(R) - R) phi / 2.
    """
    trace = rotation[k, 0, 0] + rotation[k, 1, 1] + rotation[k, 2, 2]
    for j in range(3):
        for m in range(3):
            n, o = (m + 1) % 3, (m + 2) % 3
            by_rotation = blocks[i, 4, j, o] * position[n] - blocks[i, 4, j, n] * position[o]
            by_rotation += blocks[i, 5, j, m] * trace / 2 + dv_dq * blocks[i, 6, j, m]
            for r in range(3):
                by_rotation -= blocks[i, 5, j, r] * rotation[k, r, m] / 2
            matrices[k, 3 + j, m] -= blocks[i, 4, j, m]
            matrices[k, 3 + j, 3 + m] -= by_rotation
