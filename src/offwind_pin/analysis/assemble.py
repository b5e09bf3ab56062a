"""Assembly of chain, foundation and sea."""

from __future__ import annotations

import numpy as np

from offwind_pin.definitions.element import Element
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.loads.soil.foundation import Foundation
from offwind_pin.structure.chain import Elements, Stiffness, build_chain


def assemble(
    turbine: Turbine,
    foundation: Foundation,
    sea: Sea | None = None,
    *,
    elements: Elements = None,
    stiffness: Stiffness = "flexibility",
    element: Element = "euler_bernoulli",
) -> System:
    """A system without structural damping, but with tuned mass dampers.

    See :func:`build` for the arguments.
    """
    held = foundation.structure or turbine
    chain = build_chain(
        held,
        base=foundation.base,
        free_root=foundation.root is not None,
        elements=elements,
        stiffness=stiffness,
        element=element,
    )
    springs = np.zeros(len(chain.joint_name))
    springs[chain.roots : chain.axis_joints] = chain.joint_stiffness.ravel()
    damping = np.zeros_like(springs)
    of_joint = [mass for mass in chain.tuned_masses for _ in mass.joints]
    springs[chain.axis_joints :] = [mass.stiffness for mass in of_joint]
    damping[chain.axis_joints :] = [mass.damping for mass in of_joint]
    return System(held, foundation, chain, sea, springs, damping, {})
