"""Motion of the chain from joint displacements, velocities and accelerations, in O(N).

The recursion of the Newton-Euler algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008,
chapter 5) in world axes, written out for a serial chain of three revolute joints a node, with two
prismatic ones below them where elements shear.
"""

from __future__ import annotations

import math

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.model import Data, Model, State, evaluation_kernel
from offwind_pin.dynamics.compiled.vectors import (
    add,
    axis_of,
    cross,
    rigid_point_motion,
    row_of,
    scale,
    store,
    subtract,
)


@evaluation_kernel
def move_bodies(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Set position, orientation, velocity and acceleration of every body, and the joints' columns.

    The base moves with the ground.
    """
    q, v, a = state.q, state.v, state.a
    ground, joint, rotation, length = data.ground, data.joint, data.rotation, model.length
    base = len(ground) - 1
    x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    position = (ground[base, 0], ground[base, 1], model.base + ground[base, 2])
    velocity = (ground[base, 3], ground[base, 4], ground[base, 5])
    acceleration = (ground[base, 6], ground[base, 7], ground[base, 8])
    angular_velocity = angular_acceleration = (0.0, 0.0, 0.0)
    dof = 0
    for k in range(len(length) + 1):
        count = model.node_joints if k > 0 else model.roots
        if k > 0:
            arm = scale(length[k - 1], z)
            velocity, acceleration = rigid_point_motion(
                arm, velocity, angular_velocity, acceleration, angular_acceleration
            )
            position = add(position, arm)
        for i in range(count):
            turning = i - (count - 3)
            kind = turning if turning >= 0 else i
            axis = x if kind == 0 else (y if kind == 1 else z)
            if turning < 0:
                arm, rate = scale(q[dof], axis), scale(v[dof], axis)
                velocity, acceleration = rigid_point_motion(
                    arm, velocity, angular_velocity, acceleration, angular_acceleration
                )
                position = add(position, arm)
                velocity = add(velocity, rate)
                coriolis = scale(2 * v[dof], cross(angular_velocity, axis))
                acceleration = add(add(acceleration, coriolis), scale(a[dof], axis))
                for j in range(3):
                    joint[dof, j], joint[dof, 3 + j] = axis[j], 0.0
            else:
                turned = add(angular_acceleration, scale(a[dof], axis))
                angular_acceleration = add(turned, scale(v[dof], cross(angular_velocity, axis)))
                angular_velocity = add(angular_velocity, scale(v[dof], axis))
                lever = cross(position, axis)
                for j in range(3):
                    joint[dof, j], joint[dof, 3 + j] = lever[j], axis[j]
                cosine, sine = math.cos(q[dof]), math.sin(q[dof])
                one, two = (y, z) if kind == 0 else ((z, x) if kind == 1 else (x, y))
                first = add(scale(cosine, one), scale(sine, two))
                second = subtract(scale(cosine, two), scale(sine, one))
                if kind == 0:
                    y, z = first, second
                elif kind == 1:
                    z, x = first, second
                else:
                    x, y = first, second
            dof += 1
        store(data.position, k, position)
        store(data.velocity, k, velocity)
        store(data.angular_velocity, k, angular_velocity)
        store(data.acceleration, k, acceleration)
        store(data.angular_acceleration, k, angular_acceleration)
        for j in range(3):
            rotation[k, j, 0], rotation[k, j, 1], rotation[k, j, 2] = x[j], y[j], z[j]


@evaluation_kernel
def move_points(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Set the motion of the loaded points.

    Where they meet the ground, displacement and velocity are those relative to it.
    """
    motion, ground, rotation = data.motion, data.ground, data.rotation
    point_body, offset, height = model.point_body, model.point_offset, model.point_height
    for i in range(len(point_body)):
        k = point_body[i]
        axis = axis_of(rotation, k)
        arm = scale(offset[i], axis)
        position = add(row_of(data.position, k), arm)
        angular_velocity = row_of(data.angular_velocity, k)
        velocity, acceleration = rigid_point_motion(
            arm,
            row_of(data.velocity, k),
            angular_velocity,
            row_of(data.acceleration, k),
            row_of(data.angular_acceleration, k),
        )
        for j in range(3):
            motion[i, j] = position[j]
            undeformed = height[i] if j == 2 else 0.0
            motion[i, 3 + j] = position[j] - undeformed - ground[i, j]
            motion[i, 6 + j] = velocity[j] - ground[i, 3 + j]
            motion[i, 9 + j] = axis[j]
            motion[i, 12 + j] = acceleration[j]
            motion[i, 18 + j] = angular_velocity[j]
        motion[i, 15] = (rotation[k, 2, 1] - rotation[k, 1, 2]) / 2
        motion[i, 16] = (rotation[k, 0, 2] - rotation[k, 2, 0]) / 2
        motion[i, 17] = (rotation[k, 1, 0] - rotation[k, 0, 1]) / 2
