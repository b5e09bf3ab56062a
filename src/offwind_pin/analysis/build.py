"""From a turbine definition to a system of equations."""

from __future__ import annotations

from dataclasses import replace

from offwind_pin.analysis.assemble import assemble
from offwind_pin.analysis.foundation.registry import make_foundation
from offwind_pin.analysis.structural_damping import damped
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.dynamics.system import System
from offwind_pin.loads.sea.sea import Sea, StillWater
from offwind_pin.loads.soil.foundation import Foundation
from offwind_pin.structure.chain import Elements, Stiffness


def build(
    turbine: Turbine,
    foundation: str | Foundation = "distributed_springs",
    sea: Sea | None = None,
    *,
    elements: Elements = None,
    stiffness: Stiffness = "flexibility",
    element: Element = "euler_bernoulli",
) -> System:
    """Assemble chain, foundation and sea of a turbine, with structural damping.

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

    def reference(kind: str | None, *, wet: bool) -> System:
        level = 0.0 if sea is None else sea.water_level
        locked = turbine.with_dampers_locked()
        held, division = _locked(system.foundation), elements
        if kind is not None:
            held, division = _named_foundation(locked, kind), None
        return assemble(
            locked,
            held,
            StillWater(water_level=level) if wet else None,
            elements=division,
            stiffness=stiffness,
            element=element,
        )

    return damped(system, turbine.structural_damping, reference)


def _locked(foundation: Foundation) -> Foundation:
    """A foundation whose own structure, if it has one, has its tuned mass dampers locked."""
    if foundation.structure is None:
        return foundation
    return replace(foundation, structure=foundation.structure.with_dampers_locked())


def _named_foundation(turbine: Turbine, kind: str) -> Foundation:
    """The foundation that ratios refer to."""
    try:
        return make_foundation(turbine, kind)
    except InputError as error:
        raise InputError(
            f"turbine {turbine.name}, field structural_damping.foundation",
            kind,
            f"a foundation that this turbine can have ({error})",
            "Name another one, or leave it out for the run's own.",
        ) from None
