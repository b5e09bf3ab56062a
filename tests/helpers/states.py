"""States far from rest, and systems stripped of what hides small terms."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.element import Element
from offwind_pin.structure.chain import NODE_JOINTS

Array = NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """Joint displacements, velocities and accelerations far from rest and from one another."""

    q: Array
    v: Array
    a: Array


def random_state(system: ow.System, seed: int = 0, size: float = 0.1) -> State:
    rng = np.random.default_rng(seed)
    return State(*(size * rng.uniform(-1, 1, system.nv) for _ in range(3)))


def without_joint_springs(system: ow.System) -> ow.System:
    """The same without the chain's own springs, which would hide every smaller term.

    Tuned mass dampers keep theirs: nothing else holds them across the axis.
    """
    springs = system.joint_stiffness.copy()
    springs[: system.chain.axis_joints] = 0.0
    return replace(system, joint_stiffness=springs)


def joint_kinds(system: ow.System) -> list[str]:
    """Of each joint, whether it is prismatic or revolute: p or r."""
    return [name[-2] for name in system.chain.joint_name]


def joint_kinds_apart(system: ow.System) -> list[str]:
    """The same with d for the joints of tuned mass dampers, whose forces are the smallest."""
    names = system.chain.joint_name
    return ["d" if name.startswith("zz") else name[-2] for name in names]


def element_of(system: ow.System) -> Element:
    """Kind of element that a system is made of."""
    return next(kind for kind, joints in NODE_JOINTS.items() if joints == system.chain.node_joints)
