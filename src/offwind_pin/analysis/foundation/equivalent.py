"""Equivalent foundations: a cantilever of apparent fixity, and a macro-element.

Both take their stiffness for small motions at the mudline from a 6x6, given or condensed from the
unloaded distributed springs; the macro-element also follows a monotonic loading of the mudline.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from offwind_pin.analysis.assemble import assemble
from offwind_pin.analysis.foundation.condensation import condense
from offwind_pin.analysis.foundation.pile_only import pile_only
from offwind_pin.analysis.foundation.pushover import pushover
from offwind_pin.analysis.static import static
from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.base.number_tables import read_numbers
from offwind_pin.definitions.soil.springs import (
    ApparentFixity,
    MacroElementCalibration,
    StiffnessSource,
)
from offwind_pin.definitions.turbine import Material, Member, Station, Turbine
from offwind_pin.loads.soil.foundation import (
    Foundation,
    distributed_springs,
    given_stiffness,
    missing,
)
from offwind_pin.loads.soil.macro_element import MacroElement, check_planes
from offwind_pin.structure.section import diameter_and_thickness, outer_diameter

_APPARENT = "apparent_pile"
_FIRST_SHARE = 1e-6
"""Fraction of the largest displacement at which the first yield surface of a pushover lies."""
_COLUMNS = ("horizontal_load_n", "displacement_m", "rotation_rad")


def apparent_fixity(turbine: Turbine) -> Foundation:
    """A cantilever below the mudline, clamped at its foot, in place of pile and soil.

    Its length and bending stiffness are such that, under a horizontal load at the arm, displacement
    and rotation of the mudline are those of the 6x6; its torsional stiffness is that of the 6x6. It
    has the diameter, wall and density of the pile at the mudline, and is inextensible.

    Raises
    ------
    InputError
        No stiffness is given, it differs between planes, or there is no such cantilever.
    """
    choice = turbine.soil.apparent_fixity or ApparentFixity()
    stiffness = mudline_stiffness(turbine, choice.stiffness_from)
    arm = _arm(turbine, choice.load_arm)
    length, bending = equivalent_cantilever(stiffness, arm)
    mudline = turbine.site.mudline
    held = next(m for m in turbine.members if m.bottom <= mudline < m.top)
    diameter, thickness = (float(x[0]) for x in diameter_and_thickness(held, np.array([mudline])))
    inner = diameter - 2 * thickness
    area_moment = math.pi / 64 * (diameter**4 - inner**4)
    torsional = float(stiffness[5, 5]) * length
    material = Material.model_construct(
        youngs_modulus=bending / area_moment,
        shear_modulus=torsional / (2 * area_moment),
        density=turbine.materials[held.material].density,
        source="apparent fixity",
    )
    ends = (mudline - length, mudline)
    stations = tuple(Station(z_m=z, diameter_m=diameter, thickness_m=thickness) for z in ends)
    pile = Member(name=_APPARENT, material=_APPARENT, stations=stations)
    structure = turbine.model_copy(
        update={
            "materials": {**turbine.materials, _APPARENT: material},
            "members": (pile, *_above(turbine, mudline)),
            "point_masses": tuple(m for m in turbine.point_masses if m.z >= mudline),
        }
    )
    facts: dict[str, object] = {
        "apparent_fixity": {
            "length_m": length,
            "bending_stiffness_nm2": bending,
            "torsional_stiffness_nm2": torsional,
            "load_arm_m": arm,
            "mudline_stiffness": stiffness.tolist(),
        }
    }
    return Foundation(
        "apparent_fixity",
        mudline - length,
        surrogate=_surrogate(turbine, choice.stiffness_from),
        structure=structure,
        facts=facts,
    )


def equivalent_cantilever(stiffness: Array, arm: float) -> tuple[float, float]:
    """Length in m and EI in N m2 of the cantilever equivalent to a 6x6.

    Under a horizontal load H at an arm e, u = H (L^3 / 3 + e L^2 / 2) / EI and
    theta = H (L^2 / 2 + e L) / EI; their ratio is a quadratic equation for L.

    Parameters
    ----------
    stiffness : (6, 6) array, N, m, rad
        Stiffness at the mudline.
    arm : float, m
        Height of the load above the mudline.

    Raises
    ------
    InputError
        Planes of different stiffness, or a 6x6 without an equivalent cantilever.
    """
    check_planes(stiffness)
    flexibility = np.linalg.inv(stiffness[np.ix_([0, 4], [0, 4])])
    shift, turn = flexibility @ [1.0, arm]
    if not (shift > 0 and turn > 0):
        raise InputError(
            "6x6 stiffness at the mudline",
            f"a displacement of {shift:.3g} m and a rotation of {turn:.3g} rad per N",
            "both in the direction of the load",
            "Check the sign of the coupling term x-ry (negative).",
        )
    ratio = shift / turn
    half = 0.75 * (arm - ratio)
    length = -half + math.sqrt(half**2 + 3 * ratio * arm) if arm > 0 else 1.5 * ratio
    return float(length), float((length**2 / 2 + arm * length) / turn)


def macro_element(turbine: Turbine) -> Foundation:
    """Kinematic-hardening plasticity at the mudline, calibrated to a monotonic loading.

    Raises
    ------
    InputError
        No source for the loading or the 6x6, or parts that do not match.
    SolverError
        The soil failed before the end of the pushover.
    """
    calibration = turbine.soil.macro_element or MacroElementCalibration()
    arm = _arm(turbine, calibration.load_arm)
    source: StiffnessSource = (
        "distributed_springs" if calibration.file is None else "coupled_springs"
    )
    if calibration.file is not None:
        load, displacement, rotation = _read_path(calibration.file)
    else:
        mudline = turbine.site.mudline
        diameter = float(outer_diameter(turbine, np.array([mudline]))[0])
        furthest = calibration.until_displacement or diameter / 10
        at = np.geomspace(_FIRST_SHARE * furthest, furthest, calibration.surfaces)
        pushed = pushover(_undamped(turbine), arm, displacements=at)
        load, displacement, rotation = pushed.load[1:], pushed.displacement[1:], pushed.rotation[1:]
    stiffness = mudline_stiffness(turbine, source)
    element = MacroElement.along(stiffness, displacement, rotation, load, arm * load)
    return Foundation(
        "macro_element",
        turbine.site.mudline,
        element,
        surrogate=_surrogate(turbine, source),
        facts={"macro_element": {"load_arm_m": arm, "surfaces": len(element.limit)}},
    )


def mudline_stiffness(turbine: Turbine, source: StiffnessSource | None) -> Array:
    """(6, 6) at the mudline in N, m, rad; by default the given one, if any."""
    if _is_condensed(turbine, source):
        return condensed_stiffness(turbine)
    return given_stiffness(turbine)


def _is_condensed(turbine: Turbine, source: StiffnessSource | None) -> bool:
    if source is None:
        return turbine.soil.coupled_springs is None
    return source == "distributed_springs"


def condensed_stiffness(turbine: Turbine) -> Array:
    """(6, 6) stiffness for small motions of the unloaded pile at the mudline, in N, m, rad."""
    pile = pile_only(_undamped(turbine))
    system = assemble(pile, distributed_springs(pile))
    return condense(system, static(system)).symmetric


def _undamped(turbine: Turbine) -> Turbine:
    """A copy with elastic springs, without dashpots or sliders."""
    springs = turbine.soil.distributed_springs
    if springs is None:
        raise missing(turbine, "distributed_springs")
    elastic = springs.model_copy(update={"dashpot": None, "hysteretic": None})
    soil = turbine.soil.model_copy(update={"distributed_springs": elastic})
    return turbine.model_copy(update={"soil": soil})


def _arm(turbine: Turbine, given: float | None) -> float:
    """Height in m above the mudline at which the load acts."""
    return turbine.yaw_bearing - turbine.site.mudline if given is None else given


def _above(turbine: Turbine, mudline: float) -> tuple[Member, ...]:
    """The members above the mudline, with the one across it cut."""
    kept = []
    for member in turbine.members:
        if member.bottom >= mudline:
            kept.append(member)
        elif member.top > mudline:
            diameter, thickness = diameter_and_thickness(member, np.array([mudline]))
            foot = Station(
                z_m=mudline, diameter_m=float(diameter[0]), thickness_m=float(thickness[0])
            )
            above = tuple(station for station in member.stations if station.z > mudline)
            kept.append(member.model_copy(update={"stations": (foot, *above)}))
    return tuple(kept)


def _surrogate(turbine: Turbine, source: StiffnessSource | None) -> str | None:
    """The remark of the springs that were used."""
    springs = turbine.soil.distributed_springs
    if springs is None or not _is_condensed(turbine, source):
        return None
    return springs.surrogate


def _read_path(file: Path) -> tuple[Array, Array, Array]:
    """Load in N, displacement in m and rotation in rad of a loading, without its initial point."""
    rows = read_numbers(file, _COLUMNS).values
    loaded = rows[np.any(rows != 0, axis=1)]
    if len(loaded) == 0:
        raise InputError(
            str(file), "zero loads only", "one loaded point or more", "Is the file complete?"
        )
    load, displacement, rotation = loaded.T
    return load, displacement, rotation
