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
from offwind_pin.base.kernels import exchangeable, inner
from offwind_pin.base.records import clear, matrix, part, stack_matrix, stack_row
from offwind_pin.dynamics.compiled.model import (
    FACTORISATION,
    MODEL,
    ROW,
    Data,
    Factorisation,
    Model,
    State,
    Vector,
    matrix_kernel,
)
from offwind_pin.dynamics.compiled.residual import inertial_wrench, rna_wrench
from offwind_pin.dynamics.compiled.vectors import (
    add_arm,
    add_inertia,
    add_row,
    axis_of,
    row_dot,
    row_of,
    rows_dot,
    scale,
)
from offwind_pin.loads.point_load import tangent_kernel

factorise_kernel = exchangeable(matrix_kernel.signature, nogil=True)
solve_kernel = exchangeable(types.void(MODEL, FACTORISATION, ROW), nogil=True)
tmd_before_kernel = exchangeable(types.void(MODEL, FACTORISATION, ROW), python=False)
"""Decorator for ``kernel(model, factors, rhs)``: the dampers on a carrier at rest."""
tmd_after_kernel = exchangeable(types.void(MODEL, FACTORISATION), python=False)
"""Decorator for ``kernel(model, factors)``: what the twists of the carriers add."""

_tangents, _step = tangent_kernel.call, matrix_kernel.call
_tmd_before, _tmd_after = tmd_before_kernel.call, tmd_after_kernel.call


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
    arguments = (model, data, state, factors, time_inputs, dv_dq, da_dq)
    for i in range(len(model.assembly)):
        _step(model.assembly[i], arguments)
    for i in range(len(model.elimination)):
        _step(model.elimination[i], arguments)


@factorise_kernel
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
    for i in range(len(model.assembly)):
        _step(model.assembly[i], (model, data, state, factors, time_inputs, dv_dq, da_dq))


@solve_kernel
def solve(model: Model, factors: Factorisation, rhs: Array) -> None:
    """Set the solution of the factorised system for a right side (nv,)."""
    joint, carry, follow, pivot = factors.joint, factors.carry, factors.follow, factors.pivot
    x, own, passed, tmd_body = factors.solution, factors.rhs, factors.tmd_passed, model.tmd.body
    roots, node_joints, last = model.roots, model.node_joints, len(model.length)
    down = stack_row(6)
    clear(down)
    if model.tmd.before != 0:
        _tmd_before(model.tmd.before, (model, factors, rhs))
    for k in range(last, -1, -1):
        count = node_joints if k > 0 else roots
        first = roots + node_joints * (k - 1) if k > 0 else 0
        for d in range(len(tmd_body)):
            if tmd_body[d] == k:
                add_row(down, 1.0, passed, d)
        for i in range(count):
            own[i] = rhs[first + i] - row_dot(joint, first + i, down)
        for i in range(count):
            value = 0.0
            for j in range(count):
                value += pivot[k, i, j] * own[j]
            x[first + i] = value
        for i in range(count):
            add_row(down, x[first + i], carry, first + i)
    clear(down)  # from here on the twist of the bodies, from the base upwards
    dof = 0
    for k in range(last + 1):
        count = node_joints if k > 0 else roots
        for i in range(dof, dof + count):
            x[i] -= row_dot(follow, i, down)
        for i in range(dof, dof + count):
            add_row(down, x[i], joint, i)
        for d in range(len(tmd_body)):
            if tmd_body[d] == k:
                for j in range(6):
                    passed[d, j] = down[j]
        dof += count
    if model.tmd.after != 0:
        _tmd_after(model.tmd.after, (model, factors))


@matrix_kernel
def eliminate(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Eliminate the joints from the top down; each body's matrix then includes all above it."""
    axes, articulated, joint = data.joint, factors.articulated, factors.joint
    carry, follow, pivot = factors.carry, factors.follow, factors.pivot
    stiffness, damping = model.stiffness, model.damping
    root_stiffness, root_damping = data.root_stiffness, data.root_damping
    block, inverse, back = stack_matrix(6, 6), stack_matrix(6, 6), stack_matrix(6, 6)
    turning = stack_row(6)
    for k in range(len(articulated) - 1, -1, -1):
        count = model.node_joints if k > 0 else model.roots
        first = model.roots + model.node_joints * (k - 1) if k > 0 else 0
        body = articulated[k]
        for i in range(count):
            dof = first + i
            turn_of_axis(axes, data.wrench, dof, k, turning)
            for j in range(6):
                joint[dof, j] = axes[dof, j]
                carry[dof, j] = rows_dot(body, j, axes, dof)
                back[i, j] = -turning[j]
            for j in range(6):
                add_row(back[i], axes[dof, j], body, j)
            for m in range(count):
                block[i, m] = -row_dot(axes, first + m, turning) if m < i else 0.0
            block[i, i] = stiffness[dof] + dv_dq * damping[dof]
        for i in range(count):
            for m in range(count):
                block[i, m] += rows_dot(axes, first + i, carry, first + m)
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
            for j in range(6):
                add_row(body[j], -carry[first + i, j], follow, first + i)
        if k > 0:
            for j in range(6):
                add_row(articulated[k - 1, j], 1.0, body, j)


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
    """Set the inverse of the leading part of a matrix, by Gauss-Jordan elimination with row pivots.

    The block is overwritten.

    Raises
    ------
    LinAlgError
        The part is singular.
    """
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
            upper, lower = block[best, j], inverse[best, j]
            block[best, j], inverse[best, j] = block[i, j], inverse[i, j]
            block[i, j], inverse[i, j] = upper / head, lower / head
        for m in range(count):
            factor = block[m, i]
            if m != i:
                for j in range(count):
                    block[m, j] -= factor * block[i, j]
                    inverse[m, j] -= factor * inverse[i, j]


@matrix_kernel
def body_matrices(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Set the matrices of the bodies: inertia, and the arms of their weight."""
    articulated, body, rotation = factors.articulated, model.body, data.rotation
    last = len(articulated) - 1
    inertia = stack_matrix(3, 3)
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
        add_inertia(articulated[k], da_dq, body[k, 0], center, inertia)
        add_arm(articulated[k], center, scale(-1.0, need))
    for i in range(3):
        for j in range(3):
            value = 0.0
            for m in range(3):
                for n in range(3):
                    turned = rotation[last, i, m] * rotation[last, j, n]
                    value += turned * model.rna_inertia[m, n]
            inertia[i, j] = value
    need, _, center = rna_wrench(model, data)
    add_inertia(articulated[last], da_dq, model.rna_mass, center, inertia)
    add_arm(articulated[last], center, scale(-1.0, need))


@matrix_kernel
def load_tangents(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Set the loads' derivatives at their points."""
    for i in range(len(model.forces)):
        first, last = model.first_point[i], model.first_point[i + 1]
        blocks = part(factors.blocks, first, last)
        clear(blocks)
        if model.tangents[i] != 0:
            _tangents(
                model.tangents[i],
                (
                    part(data.motion, first, last),
                    matrix(
                        model.constants, model.first_constant[i], last - first, model.columns[i]
                    ),
                    part(time_inputs, model.first_input[i], model.first_input[i + 1]),
                    part(state.memory, model.first_memory[i], model.first_memory[i + 1]),
                    blocks,
                ),
            )


@matrix_kernel
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
    motion, by_twist = data.motion, stack_matrix(3, 6)
    for i in range(len(motion)):
        k = model.point_body[i]
        block, body = factors.blocks[i], factors.articulated[k]
        position = row_of(motion, i)
        axis = (motion[i, 9], motion[i, 10], motion[i, 11])
        for j in range(3):
            for m in range(3):
                by_twist[j, m] = block[0, j, m] + dv_dq * block[1, j, m] + da_dq * block[2, j, m]
            for m in range(3):
                n, o = (m + 1) % 3, (m + 2) % 3
                # a rotation about m moves the point by e_m x p, and turns the axis by e_m x e
                value = by_twist[j, o] * position[n] - by_twist[j, n] * position[o]
                value += block[3, j, o] * axis[n] - block[3, j, n] * axis[o]
                by_twist[j, 3 + m] = value
        for m in range(6):
            for j in range(3):
                n, o = (j + 1) % 3, (j + 2) % 3
                body[j, m] -= by_twist[j, m]
                body[3 + j, m] -= position[n] * by_twist[o, m] - position[o] * by_twist[n, m]
        add_arm(body, position, row_of(data.force, i))
        size = 0.0
        for n in range(4, 7):
            for j in range(3):
                for m in range(3):
                    size += abs(block[n, j, m])
        if size > 0:
            add_moment(body, block, position, data.rotation[k], dv_dq)


@inner
def add_moment(
    matrix: Array, block: Array, position: Vector, rotation: Array, dv_dq: float
) -> None:
    """Take off a matrix the derivatives of a moment by position, rotation and its rate.

    A rotation phi turns an orientation R by [phi] R, and its axial vector by (tr(R) - R) phi / 2.
    """
    trace = rotation[0, 0] + rotation[1, 1] + rotation[2, 2]
    for j in range(3):
        for m in range(3):
            n, o = (m + 1) % 3, (m + 2) % 3
            by_rotation = block[4, j, o] * position[n] - block[4, j, n] * position[o]
            by_rotation += block[5, j, m] * trace / 2 + dv_dq * block[6, j, m]
            for r in range(3):
                by_rotation -= block[5, j, r] * rotation[r, m] / 2
            matrix[3 + j, m] -= block[4, j, m]
            matrix[3 + j, 3 + m] -= by_rotation
