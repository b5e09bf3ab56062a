"""6x6 matrices of the iteration matrix, in spatial velocities about the world's origin."""

from __future__ import annotations

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.compiled.forward_kinematics import Vector


@kernel
def add_inertia(matrix: Array, factor: float, mass: float, place: Vector, inertia: Array) -> None:
    """Add a rigid body's spatial inertia about the world's origin, times a factor."""
    square = place[0] ** 2 + place[1] ** 2 + place[2] ** 2
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        matrix[i, i] += factor * mass
        matrix[i, 3 + j] += factor * mass * place[k]
        matrix[i, 3 + k] -= factor * mass * place[j]
        matrix[3 + j, i] += factor * mass * place[k]
        matrix[3 + k, i] -= factor * mass * place[j]
        matrix[3 + i, 3 + i] += factor * mass * square
        for m in range(3):
            matrix[3 + i, 3 + m] += factor * (inertia[i, m] - mass * place[i] * place[m])


@kernel
def add_arm(matrix: Array, place: Vector, force: Vector) -> None:
    """Take off the moment that a held force gains as its place moves, d(p x f) = dp x f."""
    along = place[0] * force[0] + place[1] * force[1] + place[2] * force[2]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        # -[f] by translation, [f][p] by rotation
        matrix[3 + i, j] -= force[k]
        matrix[3 + i, k] += force[j]
        matrix[3 + i, 3 + i] += along
        for m in range(3):
            matrix[3 + i, 3 + m] -= place[i] * force[m]
