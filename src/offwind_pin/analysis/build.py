"""From a turbine definition to a system of equations."""

from __future__ import annotations

from offwind_pin.analysis.assemble import assemble
from offwind_pin.analysis.foundation.registry import make_foundation
from offwind_pin.analysis.structural_damping import StructuralDamping, calibrate_damping
from offwind_pin.base.arguments import checked
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import Sea, StillWater
from offwind_pin.loads.soil.foundation import Foundation
from offwind_pin.structure.chain import Elements, Stiffness


@checked
def build(
    turbine: Turbine,
    foundation: str | Foundation = "distributed_springs",
    sea: Sea | None = None,
    *,
    elements: Elements = None,
    stiffness: Stiffness = "flexibility",
    element: Element = "euler_bernoulli",
) -> System:
    """Assemble chain, foundation and sea of a turbine, with calibrated structural damping.

    Parameters
    ----------
    turbine : Turbine
    foundation : str or Foundation
        Name of a kind of foundation, such as ``"clamped"`` or ``"distributed_springs"``, or a
        :class:`Foundation`.
    sea : Sea, optional
        Sea state, such as :class:`StillWater`; None for a dry structure.
    elements : int, dict of str to int, or None
        Number of multibody beam elements, in total or by region (``{"tower": 30}``). The default
        gives the first five frequencies within 0.1 % of the converged ones.
    stiffness : {"flexibility", "midpoint"}
        Rule for the joint stiffness: integrated flexibility of the element, or the paper's EI / l
        at mid-height.
    element : {"euler_bernoulli", "timoshenko"}
        Beam element; ``"timoshenko"`` includes shear.

    Returns
    -------
    System

    Raises
    ------
    InputError
        An invalid argument or part of the turbine.
    """
    if not (sea is None or isinstance(sea, Sea)):
        raise InputError("sea", sea, "a sea such as StillWater(), or None", "Give one of them.")
    system = assemble(
        turbine,
        make_foundation(turbine, foundation),
        sea,
        elements=elements,
        stiffness=stiffness,
        element=element,
    )
    if turbine.structural_damping is None:
        return system
    damping = structural_damping(turbine, element)
    joints = system.joint_damping.copy()
    joints[system.chain.roots : system.chain.axis_joints] = damping.of(system.chain).ravel()
    return system.with_damping(joints, damping.achieved)


def structural_damping(turbine: Turbine, element: Element = "euler_bernoulli") -> StructuralDamping:
    """Damping factors of a turbine, calibrated on its calibration foundation, wet or dry.

    Tuned mass dampers are locked: only the damping of the structure is calibrated.
    """
    calibration = turbine.structural_damping
    if calibration is None:
        raise InputError(
            f"turbine {turbine.name}, field structural_damping",
            "a required key is missing",
            "",
            "Add the block, or leave the structure undamped.",
        )
    if calibration.foundation == "coupled_springs" and turbine.site.scour_depth != 0:
        raise InputError(
            f"turbine {turbine.name}, field structural_damping.foundation",
            f"coupled_springs with a scour_depth_m of {turbine.site.scour_depth:g}",
            "clamped, or no scour, since the 6x6 refers to the original mudline",
            "Calibrate the structural damping on clamped.",
        )
    sea = StillWater() if calibration.still_water else None
    turbine = turbine.with_dampers_locked()
    held = make_foundation(turbine, calibration.foundation)
    undamped = assemble(turbine, held, sea, element=element)
    return calibrate_damping(undamped, calibration)
