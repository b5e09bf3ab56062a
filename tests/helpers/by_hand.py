"""A chain built by hand through Pinocchio's interface, cut open where section loads are wanted."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.dynamics.reference.equations import Equations
from offwind_pin.structure.section import lump

Array = NDArray[np.float64]

JOINTS = {
    "px": pin.JointModelPX,
    "py": pin.JointModelPY,
    "pz": pin.JointModelPZ,
    "rx": pin.JointModelRX,
    "ry": pin.JointModelRY,
    "rz": pin.JointModelRZ,
}


@dataclass(frozen=True, eq=False)
class HandBuilt:
    """A model whose bodies are cut at some heights.

    model : with one joint more at each cut, which never moves; cuts : (m,) indices of those joints;
    own : (nv,) places of the chain's own joints in the configuration vector
    """

    model: pin.Model
    cuts: list[int]
    own: list[int]

    def widened(self, values: Array) -> Array:
        """The chain's vector with zeros for the cuts' joints."""
        wide = np.zeros(self.model.nv)
        wide[self.own] = values
        return wide


def build_by_hand(system: ow.System, height: Sequence[float] | Array = ()) -> HandBuilt:
    """Bodies and joints straight from the chain; each body that is cut becomes two or more.

    A cut at a node lies just above the node's joints.
    """
    chain, turbine = system.chain, system.turbine
    model = pin.Model()
    bodies = chain.body_at(np.asarray(height, dtype=float))
    parent, place = 0, 0.0
    own: list[int] = []
    cuts = [0] * len(height)

    def joint(name: str, kind: str, at: float) -> None:
        nonlocal parent, place
        shift = pin.SE3(np.eye(3), np.array([0.0, 0.0, at - place]))
        parent = model.addJoint(parent, JOINTS[kind](), shift, name)
        place = at

    def own_joint(name: str, at: float) -> None:
        joint(name, name[-2:], at)
        own.append(model.joints[parent].idx_v)

    def body(k: int) -> None:
        """Body k, in pieces between the cuts that go through it."""
        inside = [i for i in np.argsort(height, kind="stable") if bodies[i] == k]
        edges = [chain.cut[k], *(height[i] for i in inside), chain.cut[k + 1]]
        for number, (low, high) in enumerate(itertools.pairwise(edges)):
            if number > 0:
                joint(f"cut_{inside[number - 1]}", "rx", low)
                cuts[inside[number - 1]] = parent
            piece = lump(turbine, low, high) if inside else chain.body[k]
            lever = np.array([0.0, 0.0, piece.center - place])
            inertia = pin.Inertia(piece.mass, lever, piece.inertia())
            model.appendBodyToJoint(parent, inertia, pin.SE3.Identity())
            last = high == chain.cut[k + 1]
            for i, mass in enumerate(chain.tuned_masses):
                if mass.body == k and low <= mass.height and (last or mass.height < high):
                    carriers[i] = (parent, place)

    carriers: dict[int, tuple[int, float]] = {}
    names = iter(chain.joint_name)
    for _ in range(chain.roots):
        own_joint(next(names), chain.base)
    body(0)
    for k in range(chain.elements):
        for _ in chain.node_joints:
            own_joint(next(names), chain.joint_height[k])
        body(k + 1)
    rna = pin.Inertia(chain.rna.mass, chain.rna.center_of_mass, chain.rna.inertia)
    bearing = pin.SE3(np.eye(3), np.array([0.0, 0.0, chain.top - place]))
    model.appendBodyToJoint(parent, rna, bearing)
    for i, mass in enumerate(chain.tuned_masses):
        parent, place = carriers[i]
        for _ in mass.joints:
            own_joint(next(names), mass.height)
        point = pin.Inertia(mass.mass, np.zeros(3), np.zeros((3, 3)))
        model.appendBodyToJoint(parent, point, pin.SE3.Identity())
    model.gravity.linear = np.array([0.0, 0.0, -turbine.site.gravity])
    return HandBuilt(model, cuts, own)


def section_loads(
    equations: Equations, height: Array, time: float, q: Array, v: Array, a: Array
) -> Array:
    """(m, 6) what the part above each cut exerts on the part below, in N and N m about the cut.

    Pinocchio's force in a joint at the cut is what the bodies above need for their weight and their
    motion; what acts on them from outside is taken off.
    """
    cut = build_by_hand(equations.system, height)
    data = cut.model.createData()
    wide = cut.widened(q)
    pin.rnea(cut.model, data, wide, cut.widened(v), cut.widened(a))
    pin.forwardKinematics(cut.model, data, wide)
    state = equations.evaluate(time, q, v, a)
    place, force = state.points.position, state.forces.force
    wrench = np.hstack([force, np.cross(place, force) + state.forces.moment])
    at_top = equations.points.height == equations.chain.top
    rows = []
    for z, index in zip(height, cut.cuts, strict=True):
        needed = data.oMi[index].act(data.f[index]).vector
        # A soil node at the cut belongs below it, a load at the yaw bearing above every cut.
        outside = wrench[(equations.points.height > z + 1e-9) | at_top].sum(axis=0)
        about = outside - needed
        about[3:] -= np.cross(data.oMi[index].translation, about[:3])
        rows.append(about)
    return np.array(rows)
