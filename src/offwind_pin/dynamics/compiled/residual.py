"""The equations of motion in compiled code: the residual of every joint, in O(N)."""

from __future__ import annotations

from numba import types

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import exchangeable, inner
from offwind_pin.base.records import matrix, part
from offwind_pin.dynamics.compiled.model import (
    DATA,
    MODEL,
    ROW,
    STATE,
    Data,
    Model,
    State,
    Vector,
    evaluation_kernel,
)
from offwind_pin.dynamics.compiled.vectors import (
    add,
    axis_of,
    cross,
    dot,
    rigid_point_motion,
    row_of,
    rows_dot,
    scale,
    to_world,
)
from offwind_pin.loads.point_load import commit_kernel, force_kernel
from offwind_pin.loads.root_restraint import restraint_commit, restraint_kernel

state_kernel = exchangeable(types.void(MODEL, DATA, STATE, ROW), nogil=True)
"""Decorator for ``kernel(model, data, state, time_inputs)``, also called from Python."""

_force, _commit = force_kernel.call, commit_kernel.call
_reaction, _root_commit = restraint_kernel.call, restraint_commit.call
_evaluation = evaluation_kernel.call


@state_kernel
def evaluate(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Set the data of a state, the residual r = rnea(q, v, a) + K q + D v + R(q, v) - Q last.

    time_inputs : numbers of ground and loads that depend on time alone
    """
    for i in range(len(model.evaluation)):
        _evaluation(model.evaluation[i], (model, data, state, time_inputs))


@evaluation_kernel
def balance(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Sum the bodies' wrenches from the top down, and set the residual of the chain's joints."""
    q, v, stiffness, damping = state.q, state.v, model.stiffness, model.damping
    joint, wrench, residual = data.joint, data.wrench, data.residual
    for k in range(len(wrench) - 2, -1, -1):
        for j in range(6):
            wrench[k, j] += wrench[k + 1, j]
    dof = 0
    for k in range(len(wrench)):
        count = model.node_joints if k > 0 else model.roots
        for _ in range(count):
            work = rows_dot(joint, dof, wrench, k)
            residual[dof] = stiffness[dof] * q[dof] + damping[dof] * v[dof] - work
            dof += 1


@evaluation_kernel
def restrain(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Add the reaction of the root's restraint to the residual of the root's joints."""
    loads = len(model.forces)
    past = part(state.memory, model.first_memory[loads], model.first_memory[loads + 1])
    data.root_power[0], data.root_power[1] = _reaction(
        model.restraint,
        (
            part(state.q, 0, 6),
            part(state.v, 0, 6),
            model.restraint_constants,
            past,
            data.root_reaction,
            data.root_stiffness,
            data.root_damping,
        ),
    )
    for i in range(6):
        data.residual[i] += data.root_reaction[i]


@evaluation_kernel
def evaluate_loads(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Set the forces of all loads at their points."""
    for i in range(len(model.forces)):
        first, last = model.first_point[i], model.first_point[i + 1]
        data.dissipated_power[i] = _force(
            model.forces[i],
            (
                part(data.motion, first, last),
                matrix(model.constants, model.first_constant[i], last - first, model.columns[i]),
                part(time_inputs, model.first_input[i], model.first_input[i + 1]),
                part(state.memory, model.first_memory[i], model.first_memory[i + 1]),
                part(data.force, first, last),
            ),
        )


@state_kernel
def commit(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """End a step: the memory of loads and root becomes that of the state in the data."""
    memory, first_memory, loads = state.memory, model.first_memory, len(model.forces)
    for i in range(loads):
        if model.commits[i] != 0:
            first, last = model.first_point[i], model.first_point[i + 1]
            data.dissipated_energy[i] = _commit(
                model.commits[i],
                (
                    part(data.motion, first, last),
                    matrix(
                        model.constants, model.first_constant[i], last - first, model.columns[i]
                    ),
                    part(time_inputs, model.first_input[i], model.first_input[i + 1]),
                    part(memory, first_memory[i], first_memory[i + 1]),
                ),
            )
    if model.restraint_commit != 0:
        past = part(memory, first_memory[loads], first_memory[loads + 1])
        data.dissipated_energy[loads] = _root_commit(
            model.restraint_commit, (part(state.q, 0, 6), model.restraint_constants, past)
        )


@evaluation_kernel
def collect_wrenches(model: Model, data: Data, state: State, time_inputs: Array) -> None:
    """Set the wrench on each body by itself: loads less inertia and weight."""
    wrench, force, body, point_body = data.wrench, data.force, model.body, model.point_body
    last = len(wrench) - 1
    for k in range(last + 1):
        need, moment, center = inertial_wrench(
            model, data, k, body[k, 0], body[k, 1], body[k, 2], body[k, 3]
        )
        moment = add(cross(center, need), moment)
        for j in range(3):
            wrench[k, j], wrench[k, 3 + j] = -need[j], -moment[j]
    need, moment, center = rna_wrench(model, data)
    moment = add(cross(center, need), moment)
    for j in range(3):
        wrench[last, j] -= need[j]
        wrench[last, 3 + j] -= moment[j]
    for i in range(len(point_body)):
        k = point_body[i]
        lever = cross(row_of(data.motion, i), row_of(force, i))
        for j in range(3):
            wrench[k, j] += force[i, j]
            wrench[k, 3 + j] += lever[j] + force[i, 3 + j]


@inner
def inertial_wrench(
    model: Model, data: Data, k: int, mass: float, center: float, transverse: float, axial: float
) -> tuple[Vector, Vector, Vector]:
    """Force and moment that a round body needs for its motion and weight, and where.

    It moves with body k, its centre of mass that far above the frame; the moment is about that
    centre, whose position comes last.
    """
    axis = axis_of(data.rotation, k)
    angular_velocity = row_of(data.angular_velocity, k)
    angular_acceleration = row_of(data.angular_acceleration, k)
    arm = scale(center, axis)
    _, acceleration = rigid_point_motion(
        arm,
        row_of(data.velocity, k),
        angular_velocity,
        row_of(data.acceleration, k),
        angular_acceleration,
    )
    force = scale(mass, (acceleration[0], acceleration[1], acceleration[2] + model.gravity))
    more = axial - transverse
    rate = add(
        scale(transverse, angular_acceleration), scale(more * dot(axis, angular_acceleration), axis)
    )
    gyroscopic = scale(more * dot(axis, angular_velocity), cross(angular_velocity, axis))
    return force, add(rate, gyroscopic), add(row_of(data.position, k), arm)


@inner
def rna_wrench(model: Model, data: Data) -> tuple[Vector, Vector, Vector]:
    """The same of the rotor-nacelle assembly."""
    k = len(model.length)
    angular_velocity = row_of(data.angular_velocity, k)
    angular_acceleration = row_of(data.angular_acceleration, k)
    arm = rna_arm(model, data)
    _, acceleration = rigid_point_motion(
        arm,
        row_of(data.velocity, k),
        angular_velocity,
        row_of(data.acceleration, k),
        angular_acceleration,
    )
    force = scale(
        model.rna_mass, (acceleration[0], acceleration[1], acceleration[2] + model.gravity)
    )
    momentum = rna_inertia_times(model, data, angular_velocity)
    moment = add(
        rna_inertia_times(model, data, angular_acceleration), cross(angular_velocity, momentum)
    )
    return force, moment, add(row_of(data.position, k), arm)


@inner
def rna_arm(model: Model, data: Data) -> Vector:
    """From the last body's frame to the centre of mass of the rotor-nacelle assembly, in m."""
    center = model.rna_center
    arm = (center[0], center[1], center[2] + model.top_length)
    return to_world(data.rotation, len(model.length), arm)


@inner
def rna_inertia_times(model: Model, data: Data, vector: Vector) -> Vector:
    """Inertia of the rotor-nacelle assembly about its centre, times a vector of the world."""
    k, rotation, inertia = len(model.length), data.rotation, model.rna_inertia
    local = (
        rotation[k, 0, 0] * vector[0]
        + rotation[k, 1, 0] * vector[1]
        + rotation[k, 2, 0] * vector[2],
        rotation[k, 0, 1] * vector[0]
        + rotation[k, 1, 1] * vector[1]
        + rotation[k, 2, 1] * vector[2],
        rotation[k, 0, 2] * vector[0]
        + rotation[k, 1, 2] * vector[1]
        + rotation[k, 2, 2] * vector[2],
    )
    turned = (
        dot(row_of(inertia, 0), local),
        dot(row_of(inertia, 1), local),
        dot(row_of(inertia, 2), local),
    )
    return to_world(rotation, k, turned)
