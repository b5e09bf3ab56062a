"""A uniform steel tube as a chain of any number of elements, jointed as the package's own is."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

LENGTH, DIAMETER, THICKNESS, DENSITY = 140.0, 8.0, 0.06, 7850.0  # m, m, m, kg/m^3


def uniform_chain(elements: int) -> pin.Model:
    """Six root joints at the foot, then a node of three revolutes in the middle of each element.

    Between the joints of a root or a node the links are massless; each rigid piece reaches from a
    node to the next, so the first and the last are half an element long.
    """
    model = pin.Model()
    model.name = f"uniform_chain_{elements}"
    element = LENGTH / elements
    root = "px", "py", "pz", "rx", "ry", "rz"
    tip = _add_joints(model, 0, "root", root, height=0.0)
    model.appendBodyToJoint(tip, _tube(element / 2), pin.SE3.Identity())
    length = element / 2
    for node in range(1, elements + 1):
        tip = _add_joints(model, tip, f"e{node:04d}", ("rx", "ry", "rz"), height=length)
        length = element if node < elements else element / 2
        model.appendBodyToJoint(tip, _tube(length), pin.SE3.Identity())
    return model


def _add_joints(
    model: pin.Model, parent: int, name: str, freedoms: tuple[str, ...], height: float
) -> int:
    """Joints in series, all at ``height`` m above the parent's frame; the last one's index."""
    place = pin.SE3(np.eye(3), np.array([0.0, 0.0, height]))
    for freedom in freedoms:
        joint = getattr(pin, f"JointModel{freedom.upper()}")()
        parent = model.addJoint(parent, joint, place, f"{name}_{freedom}")
        place = pin.SE3.Identity()
    return parent


def _tube(length: float) -> pin.Inertia:
    """Inertia of a piece of tube that stands on its frame's origin."""
    outer, inner = DIAMETER / 2, DIAMETER / 2 - THICKNESS
    mass = DENSITY * np.pi * (outer**2 - inner**2) * length
    across = mass / 12 * (3 * (outer**2 + inner**2) + length**2)
    along = mass / 2 * (outer**2 + inner**2)
    center = np.array([0.0, 0.0, length / 2])
    return pin.Inertia(mass, center, np.diag([across, across, along]))
