"""The iteration matrix of Newton's method, factorised and applied in O(N).

Written in spatial velocities, the matrix by_a M + by_v D + K of a chain is

    A = diag(joints) + S' B S - (turning joint axes),

with one 6x6 matrix B for each body. Eliminating the joints from the top down is the recursion of
the articulated-body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7), the
matrices B in place of the bodies' inertias, and springs in the joints. Nothing is assembled.
"""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.compiled.chain_arrays import ChainArrays
from offwind_pin.dynamics.compiled.forward_kinematics import Vector, axis_of, row_of
from offwind_pin.dynamics.compiled.residual import body_needs, rna_needs
from offwind_pin.dynamics.compiled.spatial import add_arm, add_inertia
from offwind_pin.dynamics.compiled.tuned_mass import (
    eliminate_sliders,
    slide_alone,
    slide_along,
    unstable_sliders,
)


@kernel
def factorise(s: ChainArrays, row: Array, by_v: float, by_a: float) -> None:
    """Make the iteration matrix anew about the state last evaluated by ``balance``.

    by_v, by_a : derivatives of velocity and acceleration by displacement in the integrator's step,
        in 1/s and 1/s2; both zero for statics, where the matrix is the exact tangent. In motion the
        terms of the inertia forces that depend on velocity are left out.
    """
    body_matrices(s, by_a)
    load_matrices(s, row, by_v, by_a)
    if len(s.slider_body) > 0:
        eliminate_sliders(s, by_v, by_a)
    eliminate(s, by_v)


@kernel
def correction(s: ChainArrays, right: Array) -> Array:
    """(nv,) solution of the factorised system for a right side (nv,)."""
    down = np.zeros(6)
    x = s.solution
    last = len(s.rise)
    for k in range(last, -1, -1):
        count = s.node_joints if k > 0 else s.roots
        first = s.roots + s.node_joints * (k - 1) if k > 0 else 0
        if len(s.slider_body) > 0:
            slide_alone(s, right, k, down)
        for i in range(count):
            lack = right[first + i]
            for j in range(6):
                lack -= s.joint_then[first + i, j] * down[j]
            s.lack[i] = lack
        for i in range(count):
            value = 0.0
            for j in range(count):
                value += s.pivot[k, i, j] * s.lack[j]
            x[first + i] = value
        for i in range(count):
            for j in range(6):
                down[j] += s.carry[first + i, j] * x[first + i]
    down[:] = 0.0  # from here on the twist of the bodies, from the base upwards
    dof = 0
    for k in range(last + 1):
        count = s.node_joints if k > 0 else s.roots
        for i in range(count):
            for j in range(6):
                x[dof + i] -= s.follow[dof + i, j] * down[j]
        for i in range(count):
            for j in range(6):
                down[j] += s.joint_then[dof + i, j] * x[dof + i]
        if len(s.slider_body) > 0:
            slide_along(s, k, down)
        dof += count
    return x


@kernel
def unstable_directions(s: ChainArrays) -> int:
    """Number of negative eigenvalues of the symmetric part of a factorised tangent.

    By Sylvester's law of inertia it is that of its pivot blocks.
    """
    negative = 0
    for k in range(len(s.rise) + 1):
        count = s.node_joints if k > 0 else s.roots
        if count > 0:
            block = s.pivot[k, :count, :count].copy()
            negative += int(np.sum(np.linalg.eigvalsh((block + block.T) / 2) <= 0))
    return negative + unstable_sliders(s)


@kernel
def eliminate(s: ChainArrays, by_v: float) -> None:
    """Eliminate the joints from the top down; each body's matrix then holds all above it as well.

    The loop is in here because a call with all the arrays costs as much as a node.
    """
    block, inverse, follow = np.empty((6, 6)), np.empty((6, 6)), np.empty((6, 6))
    turning = np.empty(6)
    for k in range(len(s.rise), -1, -1):
        count = s.node_joints if k > 0 else s.roots
        first = s.roots + s.node_joints * (k - 1) if k > 0 else 0
        matrix = s.articulated[k]
        force = (s.wrench[k, 0], s.wrench[k, 1], s.wrench[k, 2])
        moment = (s.wrench[k, 3], s.wrench[k, 4], s.wrench[k, 5])
        for i in range(count):
            dof = first + i
            axis_turn(s.joint[dof], force, moment, turning)
            for j in range(6):
                carry, back = 0.0, -turning[j]
                for m in range(6):
                    carry += matrix[j, m] * s.joint[dof, m]
                    back += matrix[m, j] * s.joint[dof, m]
                s.joint_then[dof, j] = s.joint[dof, j]
                s.carry[dof, j], s.follow[dof, j] = carry, back
            for m in range(count):
                block[i, m] = 0.0
            for m in range(i):
                for j in range(6):
                    block[i, m] -= turning[j] * s.joint[first + m, j]
            block[i, i] += s.stiffness[dof] + by_v * s.damping[dof]
        for i in range(count):
            for m in range(count):
                for j in range(6):
                    block[i, m] += s.joint[first + i, j] * s.carry[first + m, j]
                if k == 0:
                    block[i, m] += s.root_stiffness[i, m] + by_v * s.root_damping[i, m]
        invert(block, count, inverse)
        for i in range(count):
            for j in range(6):
                follow[i, j] = 0.0
            for m in range(count):
                s.pivot[k, i, m] = inverse[i, m]
                for j in range(6):
                    follow[i, j] += inverse[i, m] * s.follow[first + m, j]
        for i in range(count):
            for j in range(6):
                s.follow[first + i, j] = follow[i, j]
                for m in range(6):
                    matrix[m, j] -= s.carry[first + i, m] * follow[i, j]
        if k > 0:
            for i in range(6):
                for j in range(6):
                    s.articulated[k - 1, i, j] += matrix[i, j]


@kernel
def invert(block: Array, count: int, inverse: Array) -> None:
    """Set the inverse of the leading part of a matrix, by cofactors where it is 3 x 3.

    Raises
    ------
    LinAlgError : the part is singular
    """
    if count != 3:
        inverse[:count, :count] = np.linalg.inv(block[:count, :count].copy())
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


@kernel
def axis_turn(joint: Array, force: Vector, moment: Vector, result: Array) -> None:
    """Set (6,) work of a held wrench on a joint's column, as the twist below turns that column."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        result[i] = joint[3 + j] * force[k] - joint[3 + k] * force[j]
        result[3 + i] = joint[j] * force[k] - joint[k] * force[j]
        result[3 + i] += joint[3 + j] * moment[k] - joint[3 + k] * moment[j]


@kernel
def body_matrices(s: ChainArrays, by_a: float) -> None:
    """Set the matrices of the bodies: inertia, and the arms of their weight."""
    last = len(s.rise)
    inertia = np.empty((3, 3))
    for k in range(last + 1):
        axis = axis_of(s.rotation, k)
        for i in range(3):
            for j in range(3):
                inertia[i, j] = (s.body[k, 3] - s.body[k, 2]) * axis[i] * axis[j]
            inertia[i, i] += s.body[k, 2]
        need, _, place = body_needs(s, k)
        s.articulated[k] = 0.0
        add_inertia(s.articulated[k], by_a, s.body[k, 0], place, inertia)
        add_arm(s.articulated[k], place, (-need[0], -need[1], -need[2]))
    need, _, place = rna_needs(s)
    turn = s.rotation[last].copy()
    inertia = turn @ s.rna_inertia @ turn.T
    add_inertia(s.articulated[last], by_a, s.rna_mass, place, inertia)
    add_arm(s.articulated[last], place, (-need[0], -need[1], -need[2]))


@kernel
def load_matrices(s: ChainArrays, row: Array, by_v: float, by_a: float) -> None:
    """Take off the loads' derivatives, and add the arms of their forces."""
    s.blocks[:] = 0.0
    for i in range(s.loads):
        points = slice(s.first_point[i], s.first_point[i + 1])
        numbers = row[s.first_number[i] : s.first_number[i + 1]]
        past = s.memory[s.first_memory[i] : s.first_memory[i + 1]]
        s.tangents[i](s.motion[points], s.constants[i], numbers, past, s.blocks[points])
    by_twist = np.empty((3, 6))
    for i in range(len(s.point_body)):
        k = s.point_body[i]
        place = row_of(s.motion, i)
        axis = (s.motion[i, 9], s.motion[i, 10], s.motion[i, 11])
        for j in range(3):
            for m in range(3):
                by_twist[j, m] = (
                    s.blocks[i, 0, j, m] + by_v * s.blocks[i, 1, j, m] + by_a * s.blocks[i, 2, j, m]
                )
            for m in range(3):
                n, o = (m + 1) % 3, (m + 2) % 3
                # a rotation about m moves the point by e_m x p, and turns the axis by e_m x e
                by_twist[j, 3 + m] = by_twist[j, o] * place[n] - by_twist[j, n] * place[o]
                by_twist[j, 3 + m] += (
                    s.blocks[i, 3, j, o] * axis[n] - s.blocks[i, 3, j, n] * axis[o]
                )
        matrix = s.articulated[k]
        for m in range(6):
            for j in range(3):
                n, o = (j + 1) % 3, (j + 2) % 3
                matrix[j, m] -= by_twist[j, m]
                matrix[3 + j, m] -= place[n] * by_twist[o, m] - place[o] * by_twist[n, m]
        add_arm(matrix, place, row_of(s.force, i))
        if has_entries(s.blocks[i, 4:]):
            add_moment(matrix, s.blocks[i, 4:], place, s.rotation[k], by_v)


@kernel
def has_entries(blocks: Array) -> bool:
    """Whether any derivative of a point's moment is not zero."""
    size = 0.0
    for entry in blocks.flat:
        size += abs(entry)
    return size > 0


@kernel
def add_moment(matrix: Array, blocks: Array, place: Vector, turn: Array, by_v: float) -> None:
    """Take off the derivatives (3, 3, 3) of a point's moment by its place, turn and spin.

    A rotation phi turns an orientation R by [phi] R, and its axial vector by (tr(R) - R) phi / 2.
    """
    trace = turn[0, 0] + turn[1, 1] + turn[2, 2]
    for j in range(3):
        for m in range(3):
            n, o = (m + 1) % 3, (m + 2) % 3
            by_rotation = blocks[0, j, o] * place[n] - blocks[0, j, n] * place[o]
            by_rotation += blocks[1, j, m] * trace / 2 + by_v * blocks[2, j, m]
            for r in range(3):
                by_rotation -= blocks[1, j, r] * turn[r, m] / 2
            matrix[3 + j, m] -= blocks[0, j, m]
            matrix[3 + j, 3 + m] -= by_rotation
