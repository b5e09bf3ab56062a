"""Vectors in space as triples, and matrices in spatial velocities, for compiled code."""

from __future__ import annotations

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import inner
from offwind_pin.dynamics.compiled.model import Vector


@inner
def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@inner
def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inner
def add(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@inner
def subtract(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@inner
def scale(factor: float, a: Vector) -> Vector:
    return (factor * a[0], factor * a[1], factor * a[2])


@inner
def row_of(values: Array, i: int) -> Vector:
    return (values[i, 0], values[i, 1], values[i, 2])


@inner
def store(values: Array, i: int, a: Vector) -> None:
    values[i, 0], values[i, 1], values[i, 2] = a


@inner
def axis_of(rotation: Array, k: int) -> Vector:
    """Unit vector along body k of those with orientations (n, 3, 3), upwards."""
    return (rotation[k, 0, 2], rotation[k, 1, 2], rotation[k, 2, 2])


@inner
def to_world(rotation: Array, k: int, a: Vector) -> Vector:
    """A vector of body k's axes in the world's."""
    return (
        rotation[k, 0, 0] * a[0] + rotation[k, 0, 1] * a[1] + rotation[k, 0, 2] * a[2],
        rotation[k, 1, 0] * a[0] + rotation[k, 1, 1] * a[1] + rotation[k, 1, 2] * a[2],
        rotation[k, 2, 0] * a[0] + rotation[k, 2, 1] * a[1] + rotation[k, 2, 2] * a[2],
    )


@inner
def rigid_point_motion(
    arm: Vector,
    velocity: Vector,
    angular_velocity: Vector,
    acceleration: Vector,
    angular_acceleration: Vector,
) -> tuple[Vector, Vector]:
    """Velocity and acceleration of a point fixed in a rigid body, given those of another point."""
    around = cross(angular_velocity, arm)
    there = add(
        acceleration, add(cross(angular_acceleration, arm), cross(angular_velocity, around))
    )
    return add(velocity, around), there


@inner
def rows_dot(a: Array, i: int, b: Array, k: int) -> float:
    """Scalar product of row i of (n, 6) and row k of (m, 6)."""
    total = 0.0
    for j in range(6):
        total += a[i, j] * b[k, j]
    return total


@inner
def row_dot(values: Array, i: int, vector: Array) -> float:
    """Scalar product of row i of (n, 6) and a vector (6,)."""
    total = 0.0
    for j in range(6):
        total += values[i, j] * vector[j]
    return total


@inner
def add_row(vector: Array, factor: float, values: Array, i: int) -> None:
    """Add row i of (n, 6), times a factor, to a vector (6,)."""
    for j in range(6):
        vector[j] += factor * values[i, j]


@inner
def add_inertia(matrix: Array, factor: float, mass: float, center: Vector, inertia: Array) -> None:
    """Add a rigid body's spatial inertia about the world's origin, times a factor, to a matrix."""
    square = center[0] ** 2 + center[1] ** 2 + center[2] ** 2
    for i in range(3):
        j, m = (i + 1) % 3, (i + 2) % 3
        first = factor * mass * center[m]
        second = factor * mass * center[j]
        matrix[i, i] += factor * mass
        matrix[i, 3 + j] += first
        matrix[i, 3 + m] -= second
        matrix[3 + j, i] += first
        matrix[3 + m, i] -= second
        matrix[3 + i, 3 + i] += factor * mass * square
        for n in range(3):
            rest = inertia[i, n] - mass * center[i] * center[n]
            matrix[3 + i, 3 + n] += factor * rest


@inner
def add_arm(matrix: Array, position: Vector, force: Vector) -> None:
    """Take off a matrix the moment that a held force gains as its point moves, dp x f."""
    along = dot(position, force)
    for i in range(3):
        j, m = (i + 1) % 3, (i + 2) % 3
        # -[f] by translation, [f][p] by rotation
        matrix[3 + i, j] -= force[m]
        matrix[3 + i, m] += force[j]
        matrix[3 + i, 3 + i] += along
        for n in range(3):
            matrix[3 + i, 3 + n] -= position[i] * force[n]
