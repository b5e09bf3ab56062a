"""Section loads, motions and energies of an evaluated state, in compiled code."""

from __future__ import annotations

import math
from typing import Any

from numba import types

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import exchangeable, inner
from offwind_pin.base.records import matrix, part
from offwind_pin.dynamics.compiled.model import (
    DATA,
    MODEL,
    NO_JOINT,
    ROW,
    STATE,
    Data,
    Model,
    State,
    Vector,
)
from offwind_pin.dynamics.compiled.recorder import (
    JOINT_DAMPERS,
    ROOT,
    Cuts,
    Recorder,
)
from offwind_pin.dynamics.compiled.residual import (
    inertial_wrench,
    rna_arm,
    rna_inertia_times,
    rna_wrench,
    state_kernel,
)
from offwind_pin.dynamics.compiled.vectors import (
    add,
    axis_of,
    cross,
    dot,
    rigid_point_motion,
    row_of,
    scale,
    store,
    subtract,
)
from offwind_pin.loads.point_load import energy_kernel

CUTS, RECORDER = Cuts.numba_type(), Recorder.numba_type()
_VECTOR: Any = types.UniTuple(types.float64, 3)  # type: ignore[no-untyped-call]
_VECTORS: Any = types.UniTuple(_VECTOR, 2)  # type: ignore[no-untyped-call]
_NUMBERS: Any = types.UniTuple(types.float64, 2)  # type: ignore[no-untyped-call]
_MATRIX: Any = types.float64[:, ::1]

cuts_kernel = exchangeable(types.void(MODEL, DATA, CUTS, _MATRIX, _MATRIX, _MATRIX), nogil=True)
note_kernel = exchangeable(
    types.void(MODEL, DATA, STATE, RECORDER, ROW, types.intp, types.float64), nogil=True
)
record_kernel = exchangeable(types.void(MODEL, DATA, STATE, RECORDER), python=False)
"""Decorator for ``kernel(model, data, state, recorder)``: a part of a step's or record's notes."""
tmd_between_kernel = exchangeable(_VECTORS(MODEL, DATA, types.float64, types.float64), python=False)
"""Decorator for ``kernel(model, data, low, high)``: what dampers between two heights need."""
tmd_energies_kernel = exchangeable(_NUMBERS(MODEL, DATA), python=False)
"""Decorator for ``kernel(model, data)``: their kinetic and gravitational energies."""

_energy, _commit, _at_cuts = energy_kernel.call, state_kernel.call, cuts_kernel.call
_note = record_kernel.call
_tmd_between, _tmd_energies = tmd_between_kernel.call, tmd_energies_kernel.call


@note_kernel
def take_note(
    model: Model,
    data: Data,
    state: State,
    recorder: Recorder,
    time_inputs: Array,
    iterations: int,
    size: float,
) -> None:
    """End a step: keep its past, sum energies up to it, and write a record where one is due.

    data : of the state, as :func:`evaluate` set it
    """
    if recorder.commit != 0:
        _commit(recorder.commit, (model, data, state, time_inputs))
    for n in range(len(recorder.each_step)):
        _note(recorder.each_step[n], (model, data, state, recorder))
    recorder.clock[0] = state.clock[0]
    recorder.tally[0] += 1
    if recorder.tally[0] % recorder.every == 0:
        i = recorder.tally[1]
        recorder.time[i], recorder.iterations[i] = recorder.clock[0], iterations
        recorder.residual[i] = size
        for n in range(len(recorder.each_record)):
            _note(recorder.each_record[n], (model, data, state, recorder))
        recorder.tally[1] += 1


@record_kernel
def record_motion(model: Model, data: Data, state: State, recorder: Recorder) -> None:
    """Record motions, section loads, forces of the soil, strokes and summed energies."""
    i, soil, tmd_joint = recorder.tally[1], recorder.soil, model.tmd.joint
    _at_cuts(
        recorder.at_cuts,
        (
            model,
            data,
            recorder.cuts,
            recorder.displacement[i],
            recorder.acceleration[i],
            recorder.section_load[i],
        ),
    )
    for n in range(len(soil.point)):
        for j in range(3):
            recorder.soil_force[i, soil.node[n], j] += data.force[soil.point[n], j]
    for d in range(len(tmd_joint)):
        for j in range(2):
            dof = tmd_joint[d, j]
            if dof != NO_JOINT:
                recorder.stroke[i, d, j] = state.q[dof]
    for j in range(recorder.energy.shape[1]):
        recorder.dissipated[i, j] = recorder.energy[0, j]
        recorder.worked[i, j] = recorder.energy[1, j]


@cuts_kernel
def at_cuts(
    model: Model,
    data: Data,
    cuts: Cuts,
    displacement: Array,
    acceleration: Array,
    section_load: Array,
) -> None:
    """Set displacement and acceleration (m, 3) of cuts, and (m, 6) their section loads.

    These are force and moment about each cut that the part above exerts on the part below.
    """
    last, wrench = len(model.length), data.wrench
    for m in range(len(cuts.height)):
        k = cuts.body[m]
        arm = scale(cuts.offset[m], axis_of(data.rotation, k))
        position = add(row_of(data.position, k), arm)
        _, accelerated = rigid_point_motion(
            arm,
            row_of(data.velocity, k),
            row_of(data.angular_velocity, k),
            row_of(data.acceleration, k),
            row_of(data.angular_acceleration, k),
        )
        store(displacement, m, position)
        store(acceleration, m, accelerated)
        displacement[m, 2] -= cuts.height[m]
        if k < last:
            force = row_of(wrench, k + 1)
            moment = (wrench[k + 1, 3], wrench[k + 1, 4], wrench[k + 1, 5])
        else:
            need, turn, center = rna_wrench(model, data)
            force = scale(-1.0, need)
            moment = scale(-1.0, add(cross(center, need), turn))
        need, turn, center = piece_wrench(model, data, k, cuts.piece, m)
        force = subtract(force, need)
        moment = subtract(moment, add(cross(center, need), turn))
        for n in range(cuts.first[m], cuts.first[m + 1]):
            pull, turn = point_wrench(data, cuts.point[n])
            force = add(force, pull)
            moment = add(moment, add(cross(row_of(data.motion, cuts.point[n]), pull), turn))
        if model.tmd.between != 0:
            need, turn = _tmd_between(model.tmd.between, (model, data, cuts.height[m], cuts.end[m]))
            force, moment = subtract(force, need), subtract(moment, turn)
        moment = subtract(moment, cross(position, force))
        for j in range(3):
            section_load[m, j], section_load[m, 3 + j] = force[j], moment[j]


@record_kernel
def record_inertial(model: Model, data: Data, state: State, recorder: Recorder) -> None:
    """Record what inertial damping contributes to the section loads."""
    i = recorder.tally[1]
    height, first, moved = recorder.cuts.height, recorder.first_inertial, recorder.displacement
    force = moment = (0.0, 0.0, 0.0)
    point = recorder.end_inertial
    for m in range(len(height) - 1, -1, -1):
        while point > first[m]:
            point -= 1
            pull, turn = point_wrench(data, point)
            force = add(force, pull)
            moment = add(moment, add(cross(row_of(data.motion, point), pull), turn))
        position = add(row_of(moved[i], m), (0.0, 0.0, height[m]))
        about = subtract(moment, cross(position, force))
        recorder.inertial_load[i, m, 0] = math.sqrt(dot(force, force))
        recorder.inertial_load[i, m, 1] = math.sqrt(dot(about, about))


@inner
def piece_wrench(
    model: Model, data: Data, k: int, pieces: Array, i: int
) -> tuple[Vector, Vector, Vector]:
    """What a piece of body k needs, see :func:`inertial_wrench`."""
    return inertial_wrench(model, data, k, pieces[i, 0], pieces[i, 1], pieces[i, 2], pieces[i, 3])


@inner
def point_wrench(data: Data, i: int) -> tuple[Vector, Vector]:
    """Force and moment at a loaded point."""
    return row_of(data.force, i), (data.force[i, 3], data.force[i, 4], data.force[i, 5])


@record_kernel
def imbalances(model: Model, data: Data, state: State, recorder: Recorder) -> None:
    """Set (g, 6) what section loads, applied loads and inertia of each segment leave over.

    Section loads are summed from the top down; here each segment is summed by itself. Moments are
    about its lower cut.
    """
    i, segments, cuts = recorder.tally[1], recorder.segments, recorder.cuts
    load, moved, result = recorder.section_load[i], recorder.displacement[i], recorder.imbalance[i]
    for n in range(len(segments.cut)):
        low, high = segments.cut[n, 0], segments.cut[n, 1]
        about = add(row_of(moved, low), (0.0, 0.0, cuts.height[low]))
        above = add(row_of(moved, high), (0.0, 0.0, cuts.height[high]))
        upper = row_of(load, high)
        force = subtract(row_of(load, low), upper)
        moment = scale(-1.0, cross(subtract(above, about), upper))
        for j in range(segments.first_piece[n], segments.first_piece[n + 1]):
            need, turn, center = piece_wrench(model, data, segments.body[j], segments.piece, j)
            force = add(force, need)
            moment = add(moment, add(cross(subtract(center, about), need), turn))
        for j in range(segments.first_point[n], segments.first_point[n + 1]):
            pull, turn = point_wrench(data, segments.point[j])
            arm = subtract(row_of(data.motion, segments.point[j]), about)
            force = subtract(force, pull)
            moment = subtract(moment, add(cross(arm, pull), turn))
        if model.tmd.between != 0:
            ends = (model, data, cuts.height[low], cuts.height[high])
            need, turn = _tmd_between(model.tmd.between, ends)
            force = add(force, need)
            moment = add(moment, subtract(turn, cross(about, need)))
        for j in range(3):
            result[n, j] = force[j]
            result[n, 3 + j] = moment[j] + load[low, 3 + j] - load[high, 3 + j]


@record_kernel
def store_energies(model: Model, data: Data, state: State, recorder: Recorder) -> None:
    """Set kinetic, gravitational (zero undeformed), elastic, the root's and the loads' energy."""
    body, length, position = model.body, model.length, data.position
    result = recorder.stored[recorder.tally[1]]
    last = len(length)
    kinetic = gravitational = elastic = 0.0
    height = model.base
    for k in range(last + 1):
        if k > 0:
            height += length[k - 1]
        axis, spin = axis_of(data.rotation, k), row_of(data.angular_velocity, k)
        arm = scale(body[k, 1], axis)
        velocity = add(row_of(data.velocity, k), cross(spin, arm))
        along = dot(axis, spin)
        kinetic += body[k, 0] * dot(velocity, velocity) / 2
        kinetic += body[k, 2] * dot(spin, spin) / 2
        kinetic += (body[k, 3] - body[k, 2]) * along * along / 2
        lifted = position[k, 2] + arm[2] - (height + body[k, 1])
        gravitational += body[k, 0] * model.gravity * lifted
    arm, spin = rna_arm(model, data), row_of(data.angular_velocity, last)
    velocity = add(row_of(data.velocity, last), cross(spin, arm))
    kinetic += model.rna_mass * dot(velocity, velocity) / 2
    kinetic += dot(spin, rna_inertia_times(model, data, spin)) / 2
    undeformed = height + model.rna_center[2] + model.top_length
    gravitational += model.rna_mass * model.gravity * (position[last, 2] + arm[2] - undeformed)
    if model.tmd.energies != 0:
        moving, lifted = _tmd_energies(model.tmd.energies, (model, data))
        kinetic += moving
        gravitational += lifted
    for n in range(len(state.q)):
        elastic += model.stiffness[n] * state.q[n] * state.q[n] / 2
    result[0], result[1], result[2] = kinetic, gravitational, elastic
    result[3] = data.root_power[1]
    for n in range(len(recorder.energies)):
        if recorder.energies[n] != 0:
            first, last = model.first_point[n], model.first_point[n + 1]
            result[4 + n] = _energy(
                recorder.energies[n],
                (
                    part(data.motion, first, last),
                    matrix(
                        model.constants, model.first_constant[n], last - first, model.columns[n]
                    ),
                    part(state.memory, model.first_memory[n], model.first_memory[n + 1]),
                ),
            )


@record_kernel
def add_energies(model: Model, data: Data, state: State, recorder: Recorder) -> None:
    """Integrate the powers dissipated and worked over a step, by the trapezoidal rule.

    What was dissipated by the end of the step as such is added.
    """
    v, force, motion, now = state.v, data.force, data.motion, recorder.now
    energy, power, heat = recorder.energy, recorder.power, data.dissipated_energy
    loads, step = len(model.forces), state.clock[0] - recorder.clock[0]
    dampers = 0.0
    for i in range(len(v)):
        dampers += model.damping[i] * v[i] * v[i]
    now[0, JOINT_DAMPERS], now[0, ROOT] = dampers, data.root_power[0]
    for n in range(loads):
        now[0, 2 + n] = data.dissipated_power[n]
        if recorder.energies[n] == 0:
            # of a load that the ground carries, relative to it
            work = 0.0
            for i in range(model.first_point[n], model.first_point[n + 1]):
                for j in range(3):
                    work += force[i, j] * motion[i, 6 + j] + force[i, 3 + j] * motion[i, 18 + j]
            now[1, 2 + n] = work + now[0, 2 + n]
    for j in range(loads + 2):
        for i in range(2):
            energy[i, j] += step * (power[i, j] + now[i, j]) / 2
            power[i, j] = now[i, j]
        if j > 0:
            energy[0, j] += heat[loads if j == ROOT else j - 2]
