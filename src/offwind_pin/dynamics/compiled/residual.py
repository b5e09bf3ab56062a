"""The equations of motion in compiled code: what the joints lack for equilibrium, in O(N)."""

from __future__ import annotations

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
    move,
    move_points,
    row_of,
    scale,
)
from offwind_pin.dynamics.compiled.tuned_mass import balance_sliders, load_carriers, move_sliders


@kernel
def balance(s: ChainArrays, row: Array, q: Array, v: Array, a: Array) -> Array:
    """(nv,) r = rnea(q, v, a) + K q + D v + R(q, v) - Q: generalised forces out of balance.

    row : numbers of the loads that depend on time alone
    """
    move(s, row, q, v, a)
    if len(s.slider_body) > 0:
        move_sliders(s, q, v, a)
    move_points(s, row)
    evaluate_loads(s, row)
    collect_wrenches(s)
    dof = 0
    for k in range(len(s.rise) + 1):
        count = s.roots if k == 0 else s.node_joints
        for _ in range(count):
            work = 0.0
            for j in range(6):
                work += s.joint[dof, j] * s.wrench[k, j]
            s.residual[dof] = s.stiffness[dof] * q[dof] + s.damping[dof] * v[dof] - work
            dof += 1
    if len(s.slider_body) > 0:
        balance_sliders(s, q, v)
    if s.roots > 0:
        add_root(s, q, v)
    return s.residual


@kernel
def evaluate_loads(s: ChainArrays, row: Array) -> None:
    """Set the forces of all loads at their points."""
    for i in range(s.loads):
        points = slice(s.first_point[i], s.first_point[i + 1])
        numbers = row[s.first_number[i] : s.first_number[i + 1]]
        past = s.memory[s.first_memory[i] : s.first_memory[i + 1]]
        s.lost[i] = s.forces[i](s.motion[points], s.constants[i], numbers, past, s.force[points])


@kernel
def commit(s: ChainArrays, row: Array, q: Array) -> None:
    """End a step: what loads and root keep of their past becomes that of the state evaluated."""
    for i in range(s.loads):
        points = slice(s.first_point[i], s.first_point[i + 1])
        past = s.memory[s.first_memory[i] : s.first_memory[i + 1]]
        numbers = row[s.first_number[i] : s.first_number[i + 1]]
        s.heat[i] = s.commits[i](s.motion[points], s.constants[i], numbers, past)
    if s.roots > 0:
        past = s.memory[s.first_memory[s.loads] :]
        s.heat[s.loads] = s.restraint_commit[0](q[:6], s.restraint_numbers, past)


@kernel
def collect_wrenches(s: ChainArrays) -> None:
    """Set the wrench on each body and all above: loads less inertia and weight."""
    last = len(s.rise)
    for k in range(last + 1):
        need, turn, place = body_needs(s, k)
        moment = add(cross(place, need), turn)
        for j in range(3):
            s.wrench[k, j], s.wrench[k, 3 + j] = -need[j], -moment[j]
    need, turn, place = rna_needs(s)
    moment = add(cross(place, need), turn)
    for j in range(3):
        s.wrench[last, j] -= need[j]
        s.wrench[last, 3 + j] -= moment[j]
    for i in range(len(s.point_body)):
        k = s.point_body[i]
        force = row_of(s.force, i)
        lever = cross(row_of(s.motion, i), force)
        for j in range(3):
            s.wrench[k, j] += force[j]
            s.wrench[k, 3 + j] += lever[j] + s.force[i, 3 + j]
    if len(s.slider_body) > 0:
        load_carriers(s)
    for k in range(last - 1, -1, -1):
        for j in range(6):
            s.wrench[k, j] += s.wrench[k + 1, j]


@kernel
def body_needs(s: ChainArrays, k: int) -> tuple[Vector, Vector, Vector]:
    """Force, moment about its centre of mass, and place of that centre, that a body needs."""
    return round_body_needs(s, k, s.body[k, 0], s.body[k, 1], s.body[k, 2], s.body[k, 3])


@kernel
def round_body_needs(
    s: ChainArrays, k: int, mass: float, center: float, transverse: float, axial: float
) -> tuple[Vector, Vector, Vector]:
    """The same for a round body that moves with body k, its centre that far above the frame."""
    axis, spin, spin_rate = axis_of(s.rotation, k), row_of(s.spin, k), row_of(s.spin_rate, k)
    arm = scale(center, axis)
    _, acceleration = carried(
        arm, row_of(s.velocity, k), spin, row_of(s.acceleration, k), spin_rate
    )
    force = scale(mass, (acceleration[0], acceleration[1], acceleration[2] + s.gravity))
    more = axial - transverse
    rate = add(scale(transverse, spin_rate), scale(more * dot(axis, spin_rate), axis))
    gyroscopic = scale(more * dot(axis, spin), cross(spin, axis))
    return force, add(rate, gyroscopic), add(row_of(s.origin, k), arm)


@kernel
def rna_needs(s: ChainArrays) -> tuple[Vector, Vector, Vector]:
    """Force, moment about its centre of mass, and place, that the rotor-nacelle assembly needs."""
    k = len(s.rise)
    spin, spin_rate = row_of(s.spin, k), row_of(s.spin_rate, k)
    center = (s.rna_center[0], s.rna_center[1], s.rna_center[2] + s.top_rise)
    arm = to_world(s.rotation[k], center)
    _, acceleration = carried(
        arm, row_of(s.velocity, k), spin, row_of(s.acceleration, k), spin_rate
    )
    force = scale(s.rna_mass, (acceleration[0], acceleration[1], acceleration[2] + s.gravity))
    momentum = rna_inertia_times(s, spin)
    moment = add(rna_inertia_times(s, spin_rate), cross(spin, momentum))
    return force, moment, add(row_of(s.origin, k), arm)


@kernel
def rna_inertia_times(s: ChainArrays, vector: Vector) -> Vector:
    """Inertia of the rotor-nacelle assembly about its centre, times a vector of the world."""
    k = len(s.rise)
    local = to_body(s.rotation[k], vector)
    turned = (
        dot(row_of(s.rna_inertia, 0), local),
        dot(row_of(s.rna_inertia, 1), local),
        dot(row_of(s.rna_inertia, 2), local),
    )
    return to_world(s.rotation[k], turned)


@kernel
def to_world(turn: Array, vector: Vector) -> Vector:
    return (
        dot(row_of(turn, 0), vector),
        dot(row_of(turn, 1), vector),
        dot(row_of(turn, 2), vector),
    )


@kernel
def to_body(turn: Array, vector: Vector) -> Vector:
    return (
        turn[0, 0] * vector[0] + turn[1, 0] * vector[1] + turn[2, 0] * vector[2],
        turn[0, 1] * vector[0] + turn[1, 1] * vector[1] + turn[2, 1] * vector[2],
        turn[0, 2] * vector[0] + turn[1, 2] * vector[1] + turn[2, 2] * vector[2],
    )


@kernel
def add_root(s: ChainArrays, q: Array, v: Array) -> None:
    """Add the restraint's reaction to the root's residual."""
    reaction, stiffness, damping = s.root_reaction, s.root_stiffness, s.root_damping
    numbers, past = s.restraint_numbers, s.memory[s.first_memory[s.loads] :]
    lost, stored = s.restraint[0](q[:6], v[:6], numbers, past, reaction, stiffness, damping)
    s.root_power[0], s.root_power[1] = lost, stored
    for i in range(6):
        s.residual[i] += reaction[i]
