"""A tree of bodies and joints, read from a Pinocchio model so that a robot is described once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from joints import FreeFlyer, Joint, Prismatic, Revolute, Spherical, UnboundedRevolute
from spatial import Array, plucker_transform, rigid_body_inertia

_ABOUT_AN_AXIS: dict[str, Callable[[Array], Joint]] = {
    **{f"JointModelR{axis}": Revolute for axis in "XYZ"},
    **{f"JointModelRUB{axis}": UnboundedRevolute for axis in "XYZ"},
    **{f"JointModelP{axis}": Prismatic for axis in "XYZ"},
    "JointModelRevoluteUnaligned": Revolute,
    "JointModelRevoluteUnboundedUnaligned": UnboundedRevolute,
    "JointModelPrismaticUnaligned": Prismatic,
}
_WITHOUT_AN_AXIS: dict[str, Callable[[], Joint]] = {
    "JointModelSpherical": Spherical,
    "JointModelFreeFlyer": FreeFlyer,
}


@dataclass(frozen=True)
class Body:
    """A body and the joint that carries it.

    ``parent`` counts from 1, and 0 is the base; ``placement`` is X_T (6, 6), from the parent's
    frame to the joint's; ``inertia`` (6, 6) in the body's frame; ``q`` and ``v`` are the joint's
    places in the configuration and the velocity.
    """

    parent: int
    joint: Joint
    placement: Array
    inertia: Array
    q: slice
    v: slice


@dataclass(frozen=True)
class KinematicTree:
    """Bodies 1 to N_B, every parent before its children, and gravity a_g (6,) in m/s^2."""

    bodies: tuple[Body, ...]
    gravity: Array
    nv: int


def read_tree(model: pin.Model) -> KinematicTree:
    """The same tree as a Pinocchio model.

    Raises
    ------
    ValueError : a joint of another kind, or rotor inertia, which these algorithms leave out
    """
    if np.any(model.armature):
        raise ValueError(f"model {model.name} has rotor inertia (armature); set it to zero")
    bodies = tuple(_read_body(model, i) for i in range(1, model.njoints))
    return KinematicTree(bodies, np.concatenate([np.zeros(3), model.gravity.linear]), model.nv)


def _read_body(model: pin.Model, i: int) -> Body:
    """Body ``i`` with its joint."""
    place, inertia = model.jointPlacements[i], model.inertias[i]
    return Body(
        parent=model.parents[i],
        joint=_read_joint(model, i),
        placement=plucker_transform(place.rotation.T, place.translation),
        inertia=rigid_body_inertia(inertia.mass, inertia.lever, inertia.inertia),
        q=slice(model.idx_qs[i], model.idx_qs[i] + model.nqs[i]),
        v=slice(model.idx_vs[i], model.idx_vs[i] + model.nvs[i]),
    )


def _read_joint(model: pin.Model, i: int) -> Joint:
    """Joint ``i`` by its Pinocchio type; one half of its freedom is zero, the other the axis."""
    joint = model.joints[i]
    kind = joint.shortname()
    if kind in _WITHOUT_AN_AXIS:
        return _WITHOUT_AN_AXIS[kind]()
    if kind in _ABOUT_AN_AXIS:
        data = joint.createData()
        joint.calc(data, pin.neutral(model))
        return _ABOUT_AN_AXIS[kind](np.reshape(data.S, (2, 3)).sum(axis=0))
    raise ValueError(f"joint {model.names[i]} is a {kind}; use a revolute, prismatic or free one")
