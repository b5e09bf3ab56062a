"""Section loads from Pinocchio's joint forces."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.reference.chain_kinematics import AxisPoints
from offwind_pin.dynamics.reference.equations import Equations
from offwind_pin.structure.section import lump


def section_loads(
    equations: Equations, time: float, q: Array, v: Array, a: Array, height: Array
) -> Array:
    """(m, 6) force (N) and moment (N m) about each cut, of the part above on the part below.

    They are the loads above the cut minus the inertia and weight of the bodies above it: those that
    Pinocchio computes at the next node, and those of the part of the cut body.

    Parameters
    ----------
    height : (m,) array, m
        Undeformed heights of the cuts.
    """
    chain = equations.chain
    state = equations.inverse_dynamics(time, q, v, a)
    cut = AxisPoints.on(chain, height)
    place = state.motion.points(cut).position
    force = state.forces.force
    moment = np.cross(state.points.position, force) + state.forces.moment
    acting = np.hstack([force, moment])
    loaded = equations.points
    result = np.zeros((len(height), 6))
    for i, (z, body) in enumerate(zip(height, cut.body, strict=True)):
        # A soil node at the cut belongs below it in spite of rounding errors of its height; a load
        # at the yaw bearing acts on the assembly above every cut.
        above = (loaded.height > z + 1e-9) | (loaded.height == chain.top)
        own = acting[(loaded.body > body) | ((loaded.body == body) & above)].sum(axis=0)
        load = own - _needed_above(equations, int(body), float(z))
        load[3:] -= np.cross(place[i], load[:3])
        result[i] = load
    return result


def _needed_above(equations: Equations, body: int, height: float) -> Array:
    """(6,) inertia and weight above a cut as a wrench about the world's origin."""
    chain, model, data = equations.chain, equations.model, equations.data
    joint = equations.last_joint[body]
    own = chain.origin[body] if joint else 0.0  # a clamped base moves with the world
    end = chain.cut[body + 1]
    part = lump(equations.system.turbine, height, end)
    inertia = np.diag([part.transverse, part.transverse, part.axial])
    bodies = pin.Inertia(part.mass, np.array([0.0, 0.0, part.center - own]), inertia)
    if body == chain.elements:
        center = np.array(chain.rna.center_of_mass)
        center[2] += chain.top - own
        bodies = bodies + pin.Inertia(chain.rna.mass, center, np.array(chain.rna.inertia))
    moving = data.v[joint]
    need = data.oMi[joint].act(bodies * data.a_gf[joint] + moving.cross(bodies * moving)).vector
    further = [joint + 1] if body < chain.elements else []
    further += [
        model.getJointId(mass.joint_names[0])
        for mass in chain.tuned_masses
        if mass.body == body and height <= mass.height
    ]
    for other in further:
        need = need + data.oMi[other].act(data.f[other]).vector
    return np.asarray(need)
