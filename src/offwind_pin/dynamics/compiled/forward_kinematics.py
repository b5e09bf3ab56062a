"""Motion of the chain from joint displacements, velocities and accelerations, in O(N).

The recursion of the Newton-Euler algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008,
chapter 5) in world axes, written out for a serial chain of three revolute joints a node, with two
prismatic ones below them where elements shear.
"""

from __future__ import annotations

import math

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.base_excitation import BASE
from offwind_pin.dynamics.compiled.base_motion import ACCELERATION, DISPLACED, VELOCITY, of_ground
from offwind_pin.dynamics.compiled.chain_arrays import ChainArrays

Vector = tuple[float, float, float]


@kernel
def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@kernel
def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def add(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@kernel
def subtract(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@kernel
def scale(factor: float, a: Vector) -> Vector:
    return (factor * a[0], factor * a[1], factor * a[2])


@kernel
def row_of(values: Array, i: int) -> Vector:
    return (values[i, 0], values[i, 1], values[i, 2])


@kernel
def store(values: Array, i: int, a: Vector) -> None:
    values[i, 0], values[i, 1], values[i, 2] = a


@kernel
def carried(
    arm: Vector, velocity: Vector, spin: Vector, acceleration: Vector, spin_rate: Vector
) -> tuple[Vector, Vector]:
    """Velocity and acceleration of a point of a rigid body, an arm away from one that has these."""
    around = cross(spin, arm)
    there = add(acceleration, add(cross(spin_rate, arm), cross(spin, around)))
    return add(velocity, around), there


@kernel
def move(s: ChainArrays, row: Array, q: Array, v: Array, a: Array) -> None:
    """Set place, orientation, velocity and acceleration of every body, and the joints' columns."""
    x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    place = add((0.0, 0.0, s.base), of_ground(s, row, BASE, DISPLACED))
    velocity = of_ground(s, row, BASE, VELOCITY)
    acceleration = of_ground(s, row, BASE, ACCELERATION)
    spin = spin_rate = (0.0, 0.0, 0.0)
    dof = 0
    for k in range(len(s.rise) + 1):
        slides = 3 if k == 0 else s.node_joints - 3
        turns = k > 0 or s.roots > 0
        if k > 0:
            arm = scale(s.rise[k - 1], z)
            velocity, acceleration = carried(arm, velocity, spin, acceleration, spin_rate)
            place = add(place, arm)
        if turns:
            for i in range(slides):
                axis = x if i == 0 else (y if i == 1 else z)
                slip, rate, second = q[dof], v[dof], a[dof]
                arm = scale(slip, axis)
                velocity, acceleration = carried(arm, velocity, spin, acceleration, spin_rate)
                place = add(place, arm)
                velocity = add(velocity, scale(rate, axis))
                acceleration = add(acceleration, scale(2 * rate, cross(spin, axis)))
                acceleration = add(acceleration, scale(second, axis))
                for j in range(3):
                    s.joint[dof, j], s.joint[dof, 3 + j] = axis[j], 0.0
                dof += 1
            for i in range(3):
                axis = x if i == 0 else (y if i == 1 else z)
                rate = v[dof]
                spin_rate = add(spin_rate, scale(a[dof], axis))
                spin_rate = add(spin_rate, scale(rate, cross(spin, axis)))
                spin = add(spin, scale(rate, axis))
                lever = cross(place, axis)
                for j in range(3):
                    s.joint[dof, j], s.joint[dof, 3 + j] = lever[j], axis[j]
                cosine, sine = math.cos(q[dof]), math.sin(q[dof])
                if i == 0:
                    y, z = (
                        add(scale(cosine, y), scale(sine, z)),
                        subtract(scale(cosine, z), scale(sine, y)),
                    )
                elif i == 1:
                    z, x = (
                        add(scale(cosine, z), scale(sine, x)),
                        subtract(scale(cosine, x), scale(sine, z)),
                    )
                else:
                    x, y = (
                        add(scale(cosine, x), scale(sine, y)),
                        subtract(scale(cosine, y), scale(sine, x)),
                    )
                dof += 1
        store(s.origin, k, place)
        store(s.velocity, k, velocity)
        store(s.spin, k, spin)
        store(s.acceleration, k, acceleration)
        store(s.spin_rate, k, spin_rate)
        for j in range(3):
            s.rotation[k, j, 0], s.rotation[k, j, 1], s.rotation[k, j, 2] = x[j], y[j], z[j]


@kernel
def move_points(s: ChainArrays, row: Array) -> None:
    """Set the motion of the loaded points.

    Where they meet the ground, displacement and velocity are those relative to it.
    """
    for i in range(len(s.point_body)):
        k = s.point_body[i]
        axis = axis_of(s.rotation, k)
        arm = scale(s.point_offset[i], axis)
        place = add(row_of(s.origin, k), arm)
        velocity, acceleration = carried(
            arm,
            row_of(s.velocity, k),
            row_of(s.spin, k),
            row_of(s.acceleration, k),
            row_of(s.spin_rate, k),
        )
        for j in range(3):
            s.motion[i, j] = s.motion[i, 3 + j] = place[j]
            s.motion[i, 6 + j] = velocity[j]
            s.motion[i, 9 + j] = axis[j]
            s.motion[i, 12 + j] = acceleration[j]
            s.motion[i, 18 + j] = s.spin[k, j]
        turn = s.rotation[k]
        s.motion[i, 15] = (turn[2, 1] - turn[1, 2]) / 2
        s.motion[i, 16] = (turn[0, 2] - turn[2, 0]) / 2
        s.motion[i, 17] = (turn[1, 0] - turn[0, 1]) / 2
        s.motion[i, 5] -= s.point_height[i]
        if s.ground_level[i] >= 0:
            displaced = of_ground(s, row, i, DISPLACED)
            moving = of_ground(s, row, i, VELOCITY)
            for j in range(3):
                s.motion[i, 3 + j] -= displaced[j]
                s.motion[i, 6 + j] -= moving[j]


@kernel
def axis_of(rotation: Array, k: int) -> Vector:
    """Unit vector along body k of those with orientations (n, 3, 3), upwards."""
    return (rotation[k, 0, 2], rotation[k, 1, 2], rotation[k, 2, 2])
