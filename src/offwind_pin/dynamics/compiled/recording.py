"""Section loads, motions and energies of the state last evaluated, in compiled code."""

from __future__ import annotations

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import kernel
from offwind_pin.dynamics.compiled.base_motion import power_of_ground
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
    subtract,
)
from offwind_pin.dynamics.compiled.recorder_arrays import (
    GROUND,
    JOINT_DAMPERS,
    ROOT,
    Cuts,
    RecorderArrays,
    SoilNodes,
)
from offwind_pin.dynamics.compiled.residual import (
    commit,
    rna_inertia_times,
    rna_needs,
    round_body_needs,
    to_world,
)
from offwind_pin.dynamics.compiled.tuned_mass import slider_energies, sliders_between, slips


@kernel
def take_note(
    s: ChainArrays,
    r: RecorderArrays,
    row: Array,
    q: Array,
    v: Array,
    iterations: int,
    size: float,
) -> None:
    """End a step: keep its past, sum energies up to it, and write a record where one is due."""
    if len(s.memory) > 0:
        commit(s, row, q)
    time = row[0]
    add_energies(s, r, row, v, time - r.clock[0])
    r.clock[0] = time
    r.tally[0] += 1
    if r.tally[0] % r.every == 0:
        record(s, r, time, q, iterations, size)


@kernel
def record(
    s: ChainArrays,
    r: RecorderArrays,
    time: float,
    q: Array,
    iterations: int,
    size: float,
) -> None:
    """Write a record of the state last evaluated."""
    i = r.tally[1]
    r.time[i], r.iterations[i], r.residual[i] = time, iterations, size
    for m in range(len(r.cuts.height)):
        k = r.cuts.body[m]
        arm = scale(r.cuts.offset[m], axis_of(s.rotation, k))
        place = add(row_of(s.origin, k), arm)
        _, acceleration = carried(
            arm,
            row_of(s.velocity, k),
            row_of(s.spin, k),
            row_of(s.acceleration, k),
            row_of(s.spin_rate, k),
        )
        for j in range(3):
            r.displacement[i, m, j] = place[j]
            r.acceleration[i, m, j] = acceleration[j]
        r.displacement[i, m, 2] -= r.cuts.height[m]
    section_loads(s, r.cuts, r.section_load[i])
    imbalances(s, r, r.section_load[i], r.imbalance[i])
    store_energies(s, q, r.stored[i])
    sum_soil(s, r.soil, r.soil_force[i])
    slips(s, q, r.slip[i])
    r.dissipated[i] = r.energy[0]
    r.worked[i] = r.energy[1]
    r.tally[1] += 1


@kernel
def sum_soil(s: ChainArrays, soil: SoilNodes, result: Array) -> None:
    """Add to (n, 3) the forces of the soil's springs and dashpots on the pile at each node."""
    for i in range(len(soil.point)):
        for j in range(3):
            result[soil.node[i], j] += s.force[soil.point[i], j]


@kernel
def section_loads(s: ChainArrays, cuts: Cuts, result: Array) -> None:
    """Set (m, 6) force and moment about each cut that the part above exerts on the part below."""
    last = len(s.rise)
    for m in range(len(cuts.height)):
        k = cuts.body[m]
        if k < last:
            force = (s.wrench[k + 1, 0], s.wrench[k + 1, 1], s.wrench[k + 1, 2])
            moment = (s.wrench[k + 1, 3], s.wrench[k + 1, 4], s.wrench[k + 1, 5])
        else:
            need, turn, place = rna_needs(s)
            force = scale(-1.0, need)
            moment = scale(-1.0, add(cross(place, need), turn))
        need, turn, place = round_body_needs(
            s, k, cuts.piece[m, 0], cuts.piece[m, 1], cuts.piece[m, 2], cuts.piece[m, 3]
        )
        force = subtract(force, need)
        moment = subtract(moment, add(cross(place, need), turn))
        for n in range(cuts.first[m], cuts.first[m + 1]):
            i = cuts.point[n]
            pull = row_of(s.force, i)
            force = add(force, pull)
            own = (s.force[i, 3], s.force[i, 4], s.force[i, 5])
            moment = add(moment, add(cross(row_of(s.motion, i), pull), own))
        if len(s.slider_body) > 0:
            need, turn = sliders_between(s, cuts.height[m], cuts.end[m])
            force, moment = subtract(force, need), subtract(moment, turn)
        moment = subtract(moment, cross(cut_place(s, cuts, m), force))
        for j in range(3):
            result[m, j], result[m, 3 + j] = force[j], moment[j]


@kernel
def imbalances(s: ChainArrays, r: RecorderArrays, section_load: Array, result: Array) -> None:
    """Set (g, 6) what section loads, applied loads and inertia of each segment leave over.

    Section loads are summed from the top down; here each segment is summed by itself. Moments are
    about its lower cut.
    """
    g = r.segments
    for n in range(len(g.cut)):
        low, high = g.cut[n, 0], g.cut[n, 1]
        about, above = cut_place(s, r.cuts, low), cut_place(s, r.cuts, high)
        upper = row_of(section_load, high)
        force = subtract(row_of(section_load, low), upper)
        moment = scale(-1.0, cross(subtract(above, about), upper))
        for j in range(g.first_piece[n], g.first_piece[n + 1]):
            need, turn, place = round_body_needs(
                s, g.body[j], g.piece[j, 0], g.piece[j, 1], g.piece[j, 2], g.piece[j, 3]
            )
            force = add(force, need)
            moment = add(moment, add(cross(subtract(place, about), need), turn))
        for j in range(g.first_point[n], g.first_point[n + 1]):
            i = g.point[j]
            pull = row_of(s.force, i)
            own = (s.force[i, 3], s.force[i, 4], s.force[i, 5])
            force = subtract(force, pull)
            turn = add(cross(subtract(row_of(s.motion, i), about), pull), own)
            moment = subtract(moment, turn)
        if len(s.slider_body) > 0:
            need, turn = sliders_between(s, r.cuts.height[low], r.cuts.height[high])
            force = add(force, need)
            moment = add(moment, subtract(turn, cross(about, need)))
        for j in range(3):
            result[n, j] = force[j]
            result[n, 3 + j] = moment[j] + section_load[low, 3 + j] - section_load[high, 3 + j]


@kernel
def cut_place(s: ChainArrays, cuts: Cuts, m: int) -> Vector:
    """Place of a cut in m."""
    k = cuts.body[m]
    return add(row_of(s.origin, k), scale(cuts.offset[m], axis_of(s.rotation, k)))


@kernel
def store_energies(s: ChainArrays, q: Array, result: Array) -> None:
    """Set kinetic, gravitational (zero undeformed), elastic, the root's and the loads' energy."""
    last = len(s.rise)
    kinetic = gravitational = elastic = 0.0
    height = s.base
    for k in range(last + 1):
        if k > 0:
            height += s.rise[k - 1]
        axis, spin = axis_of(s.rotation, k), row_of(s.spin, k)
        arm = scale(s.body[k, 1], axis)
        velocity = add(row_of(s.velocity, k), cross(spin, arm))
        along = dot(axis, spin)
        kinetic += s.body[k, 0] * dot(velocity, velocity) / 2
        kinetic += s.body[k, 2] * dot(spin, spin) / 2
        kinetic += (s.body[k, 3] - s.body[k, 2]) * along**2 / 2
        rise = s.origin[k, 2] + arm[2] - (height + s.body[k, 1])
        gravitational += s.body[k, 0] * s.gravity * rise
    center = (s.rna_center[0], s.rna_center[1], s.rna_center[2] + s.top_rise)
    arm, spin = to_world(s.rotation[last], center), row_of(s.spin, last)
    velocity = add(row_of(s.velocity, last), cross(spin, arm))
    kinetic += s.rna_mass * dot(velocity, velocity) / 2
    kinetic += dot(spin, rna_inertia_times(s, spin)) / 2
    gravitational += s.rna_mass * s.gravity * (s.origin[last, 2] + arm[2] - height - center[2])
    if len(s.slider_body) > 0:
        of_motion, of_height = slider_energies(s)
        kinetic += of_motion
        gravitational += of_height
    for i in range(len(q)):
        elastic += s.stiffness[i] * q[i] ** 2 / 2
    result[0], result[1], result[2], result[3] = kinetic, gravitational, elastic, s.root_power[1]
    for i in range(s.loads):
        points = slice(s.first_point[i], s.first_point[i + 1])
        past = s.memory[s.first_memory[i] : s.first_memory[i + 1]]
        result[4 + i] = s.energies[i](s.motion[points], s.constants[i], past)


@kernel
def add_energies(s: ChainArrays, r: RecorderArrays, row: Array, v: Array, step: float) -> None:
    """Integrate the powers dissipated and worked over a step, by the trapezoidal rule.

    What was dissipated by the end of the step as such is added.
    """
    dampers = 0.0
    for i in range(len(v)):
        dampers += s.damping[i] * v[i] ** 2
    add_power(r.energy[0], r.power[0], JOINT_DAMPERS, dampers, step)
    add_power(r.energy[0], r.power[0], ROOT, s.root_power[0], step)
    r.energy[0, ROOT] += s.heat[s.loads]
    add_power(r.energy[1], r.power[1], GROUND, power_of_ground(s, row), step)
    for i in range(s.loads):
        add_power(r.energy[0], r.power[0], 2 + i, s.lost[i], step)
        r.energy[0, 2 + i] += s.heat[i]
        if not r.stores[i]:
            add_power(r.energy[1], r.power[1], 2 + i, power_of(s, i) + s.lost[i], step)


@kernel
def add_power(energy: Array, before: Array, column: int, power: float, step: float) -> None:
    energy[column] += step * (before[column] + power) / 2
    before[column] = power


@kernel
def power_of(s: ChainArrays, load: int) -> float:
    """Power in W of a load on the structure; of one that the ground carries, relative to it."""
    power = 0.0
    for i in range(s.first_point[load], s.first_point[load + 1]):
        spin = row_of(s.spin, s.point_body[i])
        for j in range(3):
            power += s.force[i, j] * s.motion[i, 6 + j] + s.force[i, 3 + j] * spin[j]
    return power
