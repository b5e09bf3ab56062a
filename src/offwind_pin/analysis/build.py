"""From a turbine definition to a system that can be solved."""

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
    """Chain, foundation and sea of a turbine as one system, its structural damping calibrated.

    Parameters
    ----------
    foundation : str or Foundation
        A name, ``"clamped"`` for example, of the kinds in
        :mod:`offwind_pin.analysis.foundation.registry`, or a :class:`Foundation`.
    sea : Sea, optional
        :class:`StillWater`, :class:`IrregularWaves`, or None for a dry structure.
    elements : int, dict of str to int, or None
        Number of multibody beam elements in all, by region, or None for the default, which puts the
        first five frequencies within 0.1 % of the converged ones.
    stiffness : {"flexibility", "midpoint"}
        ``"flexibility"`` or ``"midpoint"``, see :func:`build_chain`.
    element : {"euler_bernoulli", "timoshenko"}
        ``"euler_bernoulli"``, or ``"timoshenko"`` for elements that shear as well.

    Raises
    ------
    InputError
        An argument or a part of the turbine that cannot be used.
    """
    if not (sea is None or isinstance(sea, Sea)):
        raise InputError(
            "sea", sea, "StillWater(), IrregularWaves(...) or None", "Give one of them."
        )
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
    """Damping factors of a turbine, calibrated on the foundation and in the water it names.

    Tuned mass dampers are locked there: what is calibrated is the damping of the structure.
    """
    calibration = turbine.structural_damping
    if calibration is None:
        raise InputError(
            f"turbine {turbine.name}, field structural_damping",
            "nothing",
            "ratios of critical for named modes",
            "Add the block, or leave the structure undamped.",
        )
    if calibration.foundation == "coupled_springs" and turbine.site.scour_depth != 0:
        raise InputError(
            f"turbine {turbine.name}, field structural_damping.foundation",
            f"coupled_springs with a scour_depth_m of {turbine.site.scour_depth:g}",
            "clamped, or no scour: the 6x6 belongs to the original mudline",
            "Calibrate the structure's damping on clamped.",
        )
    sea = StillWater() if calibration.still_water else None
    turbine = turbine.with_dampers_locked()
    held = make_foundation(turbine, calibration.foundation)
    undamped = assemble(turbine, held, sea, element=element)
    return calibrate_damping(undamped, calibration)
