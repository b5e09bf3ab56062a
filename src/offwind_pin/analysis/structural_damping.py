"""Structural damping of a system, from what its turbine asks for."""

from __future__ import annotations

import logging
from collections.abc import Collection, Mapping
from typing import Protocol

import numpy as np

from offwind_pin.analysis.inertial_damping import mass_loads, mass_ratios, modal_load
from offwind_pin.analysis.joint_damping import calibrate, joint_ratios
from offwind_pin.analysis.modal import ModalResult, modes
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.structural_damping import (
    ModalDamping,
    RayleighDamping,
    StiffnessDamping,
    StructuralDamping,
)
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.pencil import CompiledPencil
from offwind_pin.dynamics.system import System

_log = logging.getLogger(__name__)


class Reference(Protocol):
    """Makes undamped systems for ratios to refer to, their tuned mass dampers locked."""

    def __call__(self, kind: str | None, *, wet: bool) -> System:
        """On a kind of foundation; by default on the run's own, with the run's elements."""


_SEARCHED_MODES = 12
_MOST_MODES = 64
_MISSED = 0.05
"""Share of a ratio asked for by which structural damping may miss it without a caution."""
_UNASKED, _UNASKED_UP_TO = 0.02, 5.0
"""Ratio that is worth a caution in a mode that nobody named, up to a frequency in Hz."""


def damped(system: System, asked: StructuralDamping, reference: Reference) -> System:
    """A system with the structural damping asked for; cautions go to the log.

    Parameters
    ----------
    system : System
        Without structural damping.
    asked : StiffnessDamping, ModalDamping or RayleighDamping
        From the turbine file.
    reference : Reference
        Makes the systems that ratios refer to.

    Raises
    ------
    InputError
        A mode or foundation that does not exist, or ratios that cannot be reached.
    """
    if isinstance(asked, ModalDamping):
        result = _by_modes(system, asked, reference)
    elif isinstance(asked, RayleighDamping):
        result = _by_rayleigh(system, asked, reference)
    else:
        result = _by_joints(system, asked, reference)
    for caution in result.damping_cautions:
        _log.warning("structural damping: %s", caution)
    return result


def _by_joints(system: System, asked: StiffnessDamping, reference: Reference) -> System:
    """The factors of joint damping are calibrated on one system, and used on another."""
    calibrated = _referred_to(system, asked, reference)
    found = modes(calibrated, min(_SEARCHED_MODES, calibrated.nv))
    _check_named(calibrated, found, asked.ratios)
    damping = calibrate(calibrated, found, asked.ratios)
    ratios = joint_ratios(calibrated, found, damping.of(calibrated.chain).ravel())
    return system.with_damping(
        _in_joints(system, damping.of(system.chain)),
        {label: float(ratios[found.index(label)]) for label in asked.ratios},
        cautions=_cautions(found, ratios, asked.ratios, calibrated),
    )


def _by_modes(system: System, asked: ModalDamping, reference: Reference) -> System:
    """C = C0 + M Phi (diag(2 zeta omega) - Phi' C0 Phi) Phi' M with mass-normalised modes Phi.

    C0 is proportional to the structural stiffness, by the factor that gives the other modes' ratio
    at the cutoff.
    """
    own = reference(None, wet=system.sea is not None)
    found, linear = _modes_up_to(own, asked.cutoff, asked.ratios)
    named = _ratios_on(own, found, asked, reference)
    wanted = np.array([named.get(label, asked.others) for label in found.label])
    joints = asked.others / (np.pi * asked.cutoff) * system.chain.joint_stiffness
    rates = found.vector[own.chain.roots : own.chain.axis_joints]
    by_joints = rates.T @ (joints.ravel()[:, None] * rates)
    gain = np.diag(4 * np.pi * wanted * found.frequency_hz) - by_joints
    load = modal_load(found, linear, own.chain, gain)
    return system.with_damping(_in_joints(system, joints), named, (load,))


def _by_rayleigh(system: System, asked: RayleighDamping, reference: Reference) -> System:
    """Damping alpha M + beta K of the structure itself, without soil and water."""
    own = _referred_to(system, asked, reference)
    found, linear = _modes_up_to(own, _UNASKED_UP_TO, asked.ratios or {})
    by_mass = mass_ratios(found, linear, own.chain)
    by_stiffness = joint_ratios(own, found, own.chain.joint_stiffness.ravel())
    alpha, beta = _factors(own, asked, found, by_mass, by_stiffness)
    ratios = alpha * by_mass + beta * by_stiffness
    named = {} if asked.ratios is None else asked.ratios
    loads = mass_loads(system.chain, alpha) if alpha > 0 else ()
    return system.with_damping(
        _in_joints(system, beta * system.chain.joint_stiffness),
        {label: float(ratios[found.index(label)]) for label in named},
        loads,
        _cautions(found, ratios, named, own),
    )


def _referred_to(system: System, asked: StructuralDamping, reference: Reference) -> System:
    return reference(asked.foundation, wet=asked.wet(in_water=system.sea is not None))


def _factors(
    own: System, asked: RayleighDamping, found: ModalResult, by_mass: Array, by_stiffness: Array
) -> tuple[float, float]:
    """Factors alpha in 1/s and beta in s.

    Parameters
    ----------
    by_mass, by_stiffness : (n,) array
        Ratios of the modes per unit of each.

    Raises
    ------
    InputError
        One of them would be negative.
    """
    if asked.alpha is not None and asked.beta is not None:
        return asked.alpha, asked.beta
    if asked.frequencies is not None and asked.ratios_at_frequencies is not None:
        omega = 2 * np.pi * np.array(asked.frequencies)
        matrix = np.column_stack([1 / (2 * omega), omega / 2])
        wanted = np.array(asked.ratios_at_frequencies)
        field, names = "ratios_at_frequencies", [f"{f:g} Hz" for f in asked.frequencies]
    else:
        ratios = asked.ratios or {}
        index = [found.index(label) for label in ratios]
        matrix = np.column_stack([by_mass[index], by_stiffness[index]])
        wanted = np.array(list(ratios.values()))
        field, names = "ratios_of_critical", list(ratios)
    within = sorted(float(column[1] / column[0]) for column in matrix.T)
    if not within[0] <= wanted[1] / wanted[0] <= within[1]:
        raise InputError(
            f"{_field(own)}.{field}",
            f"{wanted[0]:g} at {names[0]} and {wanted[1]:g} at {names[1]}",
            f"a second ratio from {within[0]:.3g} to {within[1]:.3g} times the first, which "
            "Rayleigh damping can reach without negative factors",
            "Change a ratio, or use kind: modal.",
        )
    alpha, beta = np.linalg.solve(matrix, wanted)
    return max(float(alpha), 0.0), max(float(beta), 0.0)


def _ratios_on(
    own: System, found: ModalResult, asked: ModalDamping, reference: Reference
) -> dict[str, float]:
    """Ratios of the named modes on a system, where they may refer to another one.

    A mode keeps the loss factor of its structure: its ratio is as large as its structure's share of
    its potential energy.
    """
    other = _referred_to(own, asked, reference)
    same = other.foundation.name == own.foundation.name and (other.sea is None) == (own.sea is None)
    if same:
        return dict(asked.ratios)
    theirs, _ = _modes_up_to(other, asked.cutoff, asked.ratios)
    here, there = _structural_share(own, found), _structural_share(other, theirs)
    return {
        label: float(ratio * here[found.index(label)] / there[theirs.index(label)])
        for label, ratio in asked.ratios.items()
    }


def _structural_share(system: System, found: ModalResult) -> Array:
    """(n,) potential energy in the joints of the nodes over that of all, by mode."""
    joints = system.chain.joint_stiffness.ravel()
    return joint_ratios(system, found, joints) / (np.pi * found.frequency_hz)


def _modes_up_to(
    system: System, frequency: float, named: Collection[str]
) -> tuple[ModalResult, CompiledPencil]:
    """Modes up to a frequency in Hz, and further named ones; and the equations that they solve.

    Raises
    ------
    InputError
        A named mode does not exist, or there are too many modes.
    """
    state = static(system)
    count = min(_SEARCHED_MODES, system.nv)
    while True:
        found = modes(system, count, state)
        enough = found.frequency_hz[-1] > frequency and set(named) <= set(found.label)
        if enough or count in (_MOST_MODES, system.nv):
            break
        count = min(2 * count, _MOST_MODES, system.nv)
    _check_named(system, found, named)
    if count < system.nv and found.frequency_hz[-1] <= frequency:
        raise InputError(
            f"{_field(system)}.cutoff_hz",
            frequency,
            f"less than {found.frequency_hz[-1]:.4g} Hz, below which there are {count} modes",
            "Lower it.",
        )
    chain = CompiledChain(system)
    chain.memory = state.memory
    kept = [
        i
        for i, label in enumerate(found.label)
        if found.frequency_hz[i] <= frequency or label in named
    ]
    return found.subset(kept), CompiledPencil(chain, state.q)


def _field(system: System) -> str:
    return f"turbine {system.turbine.name}, field structural_damping"


def _in_joints(system: System, of_nodes: Array) -> Array:
    """(nv,) dampers of all joints, those of the nodes (N, d) given."""
    joints = system.joint_damping.copy()
    joints[system.chain.roots : system.chain.axis_joints] = of_nodes.ravel()
    return joints


def _check_named(system: System, found: ModalResult, named: Collection[str]) -> None:
    for label in named:
        if label not in found.label:
            raise InputError(
                f"{_field(system)}.ratios_of_critical.{label}",
                label,
                ", ".join(found.label),
                "Name modes of the supported structure.",
            )


def _cautions(
    found: ModalResult, ratios: Array, asked: Mapping[str, float], system: System
) -> tuple[str, ...]:
    """What structural damping (n,) of the modes differs in from what was asked for."""
    water = "dry" if system.sea is None else "in still water"
    where = f"on {system.foundation.name}, {water}"
    cautions = [
        f"{label} has {100 * ratios[found.index(label)]:.3g} % {where}, {100 * ratio:.3g} % were "
        "asked for; factors of stiffness cannot reach these ratios together (kind: modal can)"
        for label, ratio in asked.items()
        if abs(ratios[found.index(label)] / ratio - 1) > _MISSED
    ]
    unasked = [
        f"{label} {100 * ratio:.3g} %"
        for label, frequency, ratio in zip(found.label, found.frequency_hz, ratios, strict=True)
        if label not in asked and frequency <= _UNASKED_UP_TO and ratio > _UNASKED
    ]
    if unasked:
        cautions.append(
            f"modes that nobody asked for are damped {where}: {', '.join(unasked)} (kind: modal "
            "takes a ratio for all others)"
        )
    return tuple(cautions)
