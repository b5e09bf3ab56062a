"""Tuned mass dampers in compiled code: point masses that slide across the axis of their carriers.

Each is a leaf of the tree: its joints are eliminated first, into the matrix of the body that
carries it, and solved for last (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7).
Callers ask first whether there are any, since a call with all the arrays costs as much as a node.
"""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.compiled.chain_arrays import ChainArrays
from offwind_pin.dynamics.compiled.forward_kinematics import (
    Vector,
    add,
    axis_of,
    carried,
    cross,
    dot,
    row_of,
    scale,
    store,
)
from offwind_pin.dynamics.compiled.spatial import add_arm, add_inertia

NO_JOINT = -1
"""In place of the number of a joint that a damper does not have."""


@kernel
def move_sliders(s: ChainArrays, q: Array, v: Array, a: Array) -> None:
    """Set place, velocity and acceleration of the dampers' masses, and their joints' columns."""
    for d in range(len(s.slider_body)):
        k = s.slider_body[d]
        spin, spin_rate = row_of(s.spin, k), row_of(s.spin_rate, k)
        arm = scale(s.slider[d, 1], axis_of(s.rotation, k))
        slip = (0.0, 0.0, 0.0)
        rate = (0.0, 0.0, 0.0)
        second = (0.0, 0.0, 0.0)
        for i in range(2):
            dof = s.slider_joint[d, i]
            if dof == NO_JOINT:
                continue
            axis = (s.rotation[k, 0, i], s.rotation[k, 1, i], s.rotation[k, 2, i])
            slip = add(slip, scale(q[dof], axis))
            rate = add(rate, scale(v[dof], axis))
            second = add(second, scale(a[dof], axis))
            for j in range(3):
                s.joint[dof, j], s.joint[dof, 3 + j] = axis[j], 0.0
        arm = add(arm, slip)
        velocity, acceleration = carried(
            arm, row_of(s.velocity, k), spin, row_of(s.acceleration, k), spin_rate
        )
        store(s.slider_place, d, add(row_of(s.origin, k), arm))
        store(s.slider_velocity, d, add(velocity, rate))
        coriolis = scale(2.0, cross(spin, rate))
        store(s.slider_acceleration, d, add(acceleration, add(coriolis, second)))


@kernel
def slider_needs(s: ChainArrays, d: int) -> Vector:
    """Force in N that a damper's mass needs for its motion and its weight."""
    x, y, z = row_of(s.slider_acceleration, d)
    return scale(s.slider[d, 0], (x, y, z + s.gravity))


@kernel
def load_carriers(s: ChainArrays) -> None:
    """Take what the dampers' masses need off the wrench on their carriers alone."""
    for d in range(len(s.slider_body)):
        k, need = s.slider_body[d], slider_needs(s, d)
        moment = cross(row_of(s.slider_place, d), need)
        for j in range(3):
            s.wrench[k, j] -= need[j]
            s.wrench[k, 3 + j] -= moment[j]


@kernel
def balance_sliders(s: ChainArrays, q: Array, v: Array) -> None:
    """Set the residual of the dampers' joints."""
    for d in range(len(s.slider_body)):
        need = slider_needs(s, d)
        for i in range(2):
            dof = s.slider_joint[d, i]
            if dof != NO_JOINT:
                held = s.stiffness[dof] * q[dof] + s.damping[dof] * v[dof]
                s.residual[dof] = held + dot(row_of(s.joint, dof), need)


@kernel
def eliminate_sliders(s: ChainArrays, by_v: float, by_a: float) -> None:
    """Eliminate the dampers' joints: what is left of their matrices goes to their carriers.

    Their own axes turn with the carrier, which the wrench on the carrier accounts for on the joints
    below; sliding turns no axis, so that the pivot blocks need no such term.
    """
    point, matrix, inverse = np.zeros((3, 3)), np.zeros((6, 6)), np.zeros((2, 2))
    turning = np.zeros(6)
    for d in range(len(s.slider_body)):
        need, place = slider_needs(s, d), row_of(s.slider_place, d)
        matrix[:] = 0.0
        add_inertia(matrix, by_a, s.slider[d, 0], place, point)
        add_arm(matrix, place, scale(-1.0, need))
        block = s.slider_pivot[d]
        block[:] = 0.0
        for i in range(2):
            dof = s.slider_joint[d, i]
            if dof == NO_JOINT:
                block[i, i] = 1.0
                continue
            # Work of the held force on the joint's axis as the carrier turns it
            axis = row_of(s.joint, dof)
            turn = cross(need, axis)
            for j in range(3):
                turning[3 + j] = turn[j]
            for j in range(6):
                carry, back = 0.0, -turning[j]
                for m in range(3):
                    carry += matrix[j, m] * axis[m]
                    back += matrix[m, j] * axis[m]
                s.joint_then[dof, j] = s.joint[dof, j]
                s.carry[dof, j], s.follow[dof, j] = carry, back
            block[i, i] = s.stiffness[dof] + by_v * s.damping[dof]
        for i in range(2):
            for m in range(2):
                first, other = s.slider_joint[d, i], s.slider_joint[d, m]
                if first != NO_JOINT and other != NO_JOINT:
                    for j in range(3):
                        block[i, m] += s.joint[first, j] * s.carry[other, j]
        determinant = block[0, 0] * block[1, 1] - block[0, 1] * block[1, 0]
        if determinant == 0:
            raise np.linalg.LinAlgError("Matrix is singular to machine precision.")
        inverse[0, 0], inverse[1, 1] = block[1, 1] / determinant, block[0, 0] / determinant
        inverse[0, 1], inverse[1, 0] = -block[0, 1] / determinant, -block[1, 0] / determinant
        block[:] = inverse
        follow_through(s, d, matrix)
        carrier = s.articulated[s.slider_body[d]]
        for i in range(6):
            for j in range(6):
                carrier[i, j] += matrix[i, j]


@kernel
def follow_through(s: ChainArrays, d: int, matrix: Array) -> None:
    """Set how a damper's joints follow its carrier, and take what that relieves off its matrix."""
    x, y = s.slider_joint[d, 0], s.slider_joint[d, 1]
    for j in range(6):
        along_x = s.follow[x, j] if x != NO_JOINT else 0.0
        along_y = s.follow[y, j] if y != NO_JOINT else 0.0
        for i in range(2):
            dof = s.slider_joint[d, i]
            if dof != NO_JOINT:
                value = s.slider_pivot[d, i, 0] * along_x + s.slider_pivot[d, i, 1] * along_y
                s.follow[dof, j] = value
                for m in range(6):
                    matrix[m, j] -= s.carry[dof, m] * value


@kernel
def slide_alone(s: ChainArrays, right: Array, k: int, down: Array) -> None:
    """Solve for the dampers on body k as if it stood still, and add what they pass down to it."""
    for d in range(len(s.slider_body)):
        if s.slider_body[d] != k:
            continue
        for i in range(2):
            dof = s.slider_joint[d, i]
            if dof == NO_JOINT:
                continue
            value = 0.0
            for m in range(2):
                other = s.slider_joint[d, m]
                if other != NO_JOINT:
                    value += s.slider_pivot[d, i, m] * right[other]
            s.solution[dof] = value
            for j in range(6):
                down[j] += s.carry[dof, j] * value


@kernel
def slide_along(s: ChainArrays, k: int, twist: Array) -> None:
    """Complete the solution for the dampers on body k with the twist of that body."""
    for d in range(len(s.slider_body)):
        if s.slider_body[d] == k:
            for i in range(2):
                dof = s.slider_joint[d, i]
                if dof != NO_JOINT:
                    for j in range(6):
                        s.solution[dof] -= s.follow[dof, j] * twist[j]


@kernel
def unstable_sliders(s: ChainArrays) -> int:
    """Number of negative eigenvalues of the dampers' pivot blocks; those of no joint are one."""
    negative = 0
    for d in range(len(s.slider_body)):
        block = s.slider_pivot[d].copy()
        negative += int(np.sum(np.linalg.eigvalsh((block + block.T) / 2) <= 0))
    return negative


@kernel
def sliders_between(s: ChainArrays, low: float, high: float) -> tuple[Vector, Vector]:
    """Force, and moment about the world's origin, that dampers with low <= z < high need."""
    force = moment = (0.0, 0.0, 0.0)
    for d in range(len(s.slider_body)):
        if low <= s.slider[d, 2] < high:
            need = slider_needs(s, d)
            force = add(force, need)
            moment = add(moment, cross(row_of(s.slider_place, d), need))
    return force, moment


@kernel
def slider_energies(s: ChainArrays) -> tuple[float, float]:
    """Kinetic and gravitational energy (zero undeformed) of the dampers' masses in J."""
    kinetic = gravitational = 0.0
    for d in range(len(s.slider_body)):
        velocity = row_of(s.slider_velocity, d)
        kinetic += s.slider[d, 0] * dot(velocity, velocity) / 2
        rise = s.slider_place[d, 2] - s.slider[d, 2]
        gravitational += s.slider[d, 0] * s.gravity * rise
    return kinetic, gravitational


@kernel
def slips(s: ChainArrays, q: Array, result: Array) -> None:
    """Set (D, 2) displacements of the dampers' masses along x and y of their carriers in m."""
    for d in range(len(s.slider_body)):
        for i in range(2):
            dof = s.slider_joint[d, i]
            result[d, i] = q[dof] if dof != NO_JOINT else 0.0
