"""From a turbine definition to a system that can be solved."""

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
    """Chain, foundation and sea of a turbine as one system, with its structural damping.

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
