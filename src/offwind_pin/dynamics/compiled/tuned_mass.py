"""Tuned mass dampers in compiled code: point masses that slide across the axis of their carriers.

Each is a leaf of the tree: its joints are eliminated first, into the matrix of the body that
carries it, and solved for last (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7).
The chain calls these kernels by address, so that a structure without dampers compiles none.
"""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import inner
from offwind_pin.base.records import clear, stack_matrix, stack_row
from offwind_pin.dynamics.compiled.model import (
    NO_JOINT,
    Data,
    Factorisation,
    Model,
    State,
    Vector,
    evaluation_kernel,
    matrix_kernel,
)
from offwind_pin.dynamics.compiled.newton_matrix import tmd_after_kernel, tmd_before_kernel
from offwind_pin.dynamics.compiled.recording import tmd_between_kernel, tmd_energies_kernel
from offwind_pin.dynamics.compiled.vectors import (
    add,
    add_arm,
    add_inertia,
    axis_of,
    cross,
    dot,
    rigid_point_motion,
    row_of,
    scale,
    store,
)


@evaluation_kernel
def tmd_residual(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Set the residual of the dampers' joints, and take their masses off the carriers' wrenches."""
    q, v, tmd = state.q, state.v, model.tmd
    for d in range(len(tmd.body)):
        move_damper(model, data, state, d)
        k, need = tmd.body[d], tmd_force(model, data, d)
        moment = cross(row_of(data.tmd_position, d), need)
        for j in range(3):
            data.wrench[k, j] -= need[j]
            data.wrench[k, 3 + j] -= moment[j]
        for i in range(2):
            dof = tmd.joint[d, i]
            if dof != NO_JOINT:
                held = model.stiffness[dof] * q[dof] + model.damping[dof] * v[dof]
                data.residual[dof] = held + dot(row_of(data.joint, dof), need)


@inner
def move_damper(model: Model, data: Data, state: State, d: int) -> None:
    """Set position, velocity and acceleration of a damper's mass, and its joints' columns."""
    k, rotation, joint = model.tmd.body[d], data.rotation, data.joint
    angular_velocity = row_of(data.angular_velocity, k)
    stroke = (0.0, 0.0, 0.0)
    rate = (0.0, 0.0, 0.0)
    second = (0.0, 0.0, 0.0)
    for i in range(2):
        dof = model.tmd.joint[d, i]
        if dof == NO_JOINT:
            continue
        axis = (rotation[k, 0, i], rotation[k, 1, i], rotation[k, 2, i])
        stroke = add(stroke, scale(state.q[dof], axis))
        rate = add(rate, scale(state.v[dof], axis))
        second = add(second, scale(state.a[dof], axis))
        for j in range(3):
            joint[dof, j], joint[dof, 3 + j] = axis[j], 0.0
    arm = add(scale(model.tmd.offset[d], axis_of(rotation, k)), stroke)
    velocity, acceleration = rigid_point_motion(
        arm,
        row_of(data.velocity, k),
        angular_velocity,
        row_of(data.acceleration, k),
        row_of(data.angular_acceleration, k),
    )
    coriolis = scale(2.0, cross(angular_velocity, rate))
    store(data.tmd_position, d, add(row_of(data.position, k), arm))
    store(data.tmd_velocity, d, add(velocity, rate))
    store(data.tmd_acceleration, d, add(acceleration, add(coriolis, second)))


@inner
def tmd_force(model: Model, data: Data, d: int) -> Vector:
    """Force in N that a damper's mass needs for its motion and its weight."""
    x, y, z = row_of(data.tmd_acceleration, d)
    return scale(model.tmd.mass[d], (x, y, z + model.gravity))


@matrix_kernel
def tmd_eliminate(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """Eliminate the dampers' joints: what is left of their matrices goes to their carriers.

    Their own axes turn with the carrier, which the wrench on the carrier accounts for on the joints
    below; sliding turns no axis, so that the pivot blocks need no such term.
    """
    carry, follow, pivots = factors.carry, factors.follow, factors.tmd_pivot
    point, matrix, turning = stack_matrix(3, 3), stack_matrix(6, 6), stack_row(6)
    clear(point)
    clear(turning)
    for d in range(len(model.tmd.body)):
        need, position = tmd_force(model, data, d), row_of(data.tmd_position, d)
        clear(matrix)
        add_inertia(matrix, da_dq, model.tmd.mass[d], position, point)
        add_arm(matrix, position, scale(-1.0, need))
        block = pivots[d]
        clear(block)
        for i in range(2):
            dof = model.tmd.joint[d, i]
            if dof == NO_JOINT:
                block[i, i] = 1.0
                continue
            # Work of the held force on the joint's axis as the carrier turns it
            axis = row_of(data.joint, dof)
            turned = cross(need, axis)
            for j in range(3):
                turning[3 + j] = turned[j]
            for j in range(6):
                passed, returned = 0.0, -turning[j]
                for m in range(3):
                    passed += matrix[j, m] * axis[m]
                    returned += matrix[m, j] * axis[m]
                factors.joint[dof, j] = data.joint[dof, j]
                carry[dof, j], follow[dof, j] = passed, returned
            block[i, i] = model.stiffness[dof] + dv_dq * model.damping[dof]
        for i in range(2):
            for m in range(2):
                first, other = model.tmd.joint[d, i], model.tmd.joint[d, m]
                if first != NO_JOINT and other != NO_JOINT:
                    for j in range(3):
                        block[i, m] += data.joint[first, j] * carry[other, j]
        a, b, c, e = block[0, 0], block[0, 1], block[1, 0], block[1, 1]
        determinant = a * e - b * c
        if determinant == 0:
            raise np.linalg.LinAlgError("Matrix is singular to machine precision.")
        block[0, 0], block[1, 1] = e / determinant, a / determinant
        block[0, 1], block[1, 0] = -b / determinant, -c / determinant
        follow_through(model, factors, d, matrix)
        k = model.tmd.body[d]
        for i in range(6):
            for j in range(6):
                factors.articulated[k, i, j] += matrix[i, j]


@inner
def follow_through(model: Model, factors: Factorisation, d: int, matrix: Array) -> None:
    """Set how a damper's joints follow its carrier, and take what that relieves off its matrix."""
    carry, follow = factors.carry, factors.follow
    x, y = model.tmd.joint[d, 0], model.tmd.joint[d, 1]
    for j in range(6):
        along_x = follow[x, j] if x != NO_JOINT else 0.0
        along_y = follow[y, j] if y != NO_JOINT else 0.0
        for i in range(2):
            dof = model.tmd.joint[d, i]
            if dof != NO_JOINT:
                value = factors.tmd_pivot[d, i, 0] * along_x + factors.tmd_pivot[d, i, 1] * along_y
                follow[dof, j] = value
                for m in range(6):
                    matrix[m, j] -= carry[dof, m] * value


@tmd_before_kernel
def tmd_before(model: Model, factors: Factorisation, rhs: Array) -> None:
    """Solve for the dampers as if their carriers were at rest, and for what they pass down."""
    for d in range(len(model.tmd.body)):
        for j in range(6):
            factors.tmd_passed[d, j] = 0.0
        for i in range(2):
            dof = model.tmd.joint[d, i]
            if dof == NO_JOINT:
                continue
            value = 0.0
            for m in range(2):
                other = model.tmd.joint[d, m]
                if other != NO_JOINT:
                    value += factors.tmd_pivot[d, i, m] * rhs[other]
            factors.solution[dof] = value
            for j in range(6):
                factors.tmd_passed[d, j] += factors.carry[dof, j] * value


@tmd_after_kernel
def tmd_after(model: Model, factors: Factorisation) -> None:
    """Complete the solution for the dampers with the twists of their carriers."""
    for d in range(len(model.tmd.body)):
        for i in range(2):
            dof = model.tmd.joint[d, i]
            if dof != NO_JOINT:
                for j in range(6):
                    factors.solution[dof] -= factors.follow[dof, j] * factors.tmd_passed[d, j]


@tmd_between_kernel
def tmd_between(model: Model, data: Data, low: float, high: float) -> tuple[Vector, Vector]:
    """Force, and moment about the world's origin, that dampers with low <= z < high need."""
    force = moment = (0.0, 0.0, 0.0)
    for d in range(len(model.tmd.body)):
        if low <= model.tmd.height[d] < high:
            need = tmd_force(model, data, d)
            force = add(force, need)
            moment = add(moment, cross(row_of(data.tmd_position, d), need))
    return force, moment


@tmd_energies_kernel
def tmd_energies(model: Model, data: Data) -> tuple[float, float]:
    """Kinetic and gravitational energy (zero undeformed) of the dampers' masses in J."""
    kinetic = gravitational = 0.0
    for d in range(len(model.tmd.body)):
        velocity = row_of(data.tmd_velocity, d)
        kinetic += model.tmd.mass[d] * dot(velocity, velocity) / 2
        lifted = data.tmd_position[d, 2] - model.tmd.height[d]
        gravitational += model.tmd.mass[d] * model.gravity * lifted
    return kinetic, gravitational
