"""The embedded pile alone: as a separate turbine, or as part of a system."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.rotor_nacelle import lump_rna
from offwind_pin.definitions.turbine import Member, RigidBodyRNA, Station, Turbine
from offwind_pin.dynamics.reference.chain_kinematics import AxisPoints, ChainMotion
from offwind_pin.dynamics.system import System
from offwind_pin.formats.wisdem import WisdemPile
from offwind_pin.structure.section import diameter_and_thickness, lump, pieces

_NOTHING = RigidBodyRNA(
    kind="rigid_body",
    mass_kg=1e-3,
    center_of_mass_m=(0.0, 0.0, 0.0),
    inertia_about_center_of_mass_kg_m2=((1e-3, 0.0, 0.0), (0.0, 1e-3, 0.0), (0.0, 0.0, 1e-3)),
)
"""Mass on the pile in place of a rotor-nacelle assembly: a gram on a pile of 1000 t."""


def pile_only(turbine: Turbine, stick_up: float = 0.0) -> Turbine:
    """The bare pile of a turbine, without structural damping.

    Build it on ``"distributed_springs"``; ``tower_top_load`` of :func:`static` then acts at its
    head.

    Parameters
    ----------
    turbine : Turbine
    stick_up : float, m
        Length of structure to keep above the mudline, for loads that act there.

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        No pile below the mudline, or a stick-up beyond the structure.
    """
    mudline = turbine.site.mudline
    _check_pile(turbine)
    longest = turbine.yaw_bearing - mudline
    if not 0 <= stick_up <= longest:
        raise InputError("stick_up", stick_up, f"0 to {longest} m", "Cut within the structure.")
    head = mudline + stick_up
    # Copied without validation: a definition requires structure above the mudline.
    return turbine.model_copy(
        update={
            "members": tuple(_below(m, head) for m in turbine.members if m.bottom < head),
            "point_masses": tuple(mass for mass in turbine.point_masses if mass.z < head),
            "tuned_mass_dampers": tuple(d for d in turbine.tuned_mass_dampers if d.z < head),
            "rna": _NOTHING,
            "structural_damping": None,
        }
    )


def wisdem_pile(turbine: Turbine, *, shear: bool = True) -> WisdemPile:
    """The embedded pile in WISDEM's terms, for its springs.

    The shear area is WISDEM's (``Tube`` in ``wisdem/commonse/cross_sections.py``), a polynomial
    in the ratio of the radii that does not follow Poisson's ratio.

    Parameters
    ----------
    shear : bool
        WISDEM's Frame3DD option of that name; if False the pile is rigid in shear.

    Raises
    ------
    InputError
        No pile below the mudline, or one whose section or material changes there.
    """
    mudline = turbine.site.mudline
    _check_pile(turbine)
    sections = {
        (*np.concatenate(diameter_and_thickness(member, np.array([z]))).tolist(), member.material)
        for bottom, top, member in pieces(turbine, turbine.toe, mudline)
        for z in (bottom, top)
    }
    if len(sections) > 1:
        raise InputError(
            f"turbine {turbine.name}, field members",
            f"{len(sections)} different sections below the mudline",
            "one section and material",
            "Give a WisdemPile with the section of WISDEM's pile.",
        )
    diameter, thickness, name = sections.pop()
    material = turbine.materials[name]
    inner = diameter - 2 * thickness
    area, inertia = np.pi / 4 * (diameter**2 - inner**2), np.pi / 64 * (diameter**4 - inner**4)
    ratio = inner / diameter
    shear_area = area / (1.124235 + 0.055610 * ratio + 1.097134 * ratio**2 - 0.630057 * ratio**3)
    return WisdemPile(
        length=mudline - turbine.toe,
        bending=material.youngs_modulus * inertia,
        shear=material.shear_modulus * shear_area if shear else np.inf,
        axial=material.youngs_modulus * area,
        torsional=material.shear_modulus * 2 * inertia,
    )


def _check_pile(turbine: Turbine) -> None:
    mudline = turbine.site.mudline
    if turbine.toe >= mudline:
        raise InputError(
            f"turbine {turbine.name}, field members",
            f"a lowest station at z_m = {turbine.toe}",
            f"a pile that reaches below the mudline (z = {mudline} m)",
            "Add a station at the toe.",
        )


def _below(member: Member, head: float) -> Member:
    """The part of a member below a height."""
    if member.top <= head:
        return member
    diameter, thickness = diameter_and_thickness(member, np.array([head]))
    cut = Station(z_m=head, diameter_m=float(diameter[0]), thickness_m=float(thickness[0]))
    kept = (*(station for station in member.stations if station.z < head), cut)
    return member.model_copy(update={"stations": kept})


def pile_part(system: System) -> System:
    """The pile of a system with the same elements, dry and undamped.

    Its joints are the first ones of the whole system.

    Raises
    ------
    InputError
        A system whose chain ends at the mudline.
    """
    chain, mudline = system.chain, system.turbine.site.mudline
    elements = chain.region.count("pile")
    if elements == 0:
        raise InputError(
            "system",
            f"the foundation {system.foundation.name!r}, with nothing below the mudline",
            "a system whose chain reaches the pile toe",
            'Build it with foundation="distributed_springs".',
        )
    joints = chain.roots + elements * len(chain.node_joints)
    turbine = pile_only(system.turbine)
    head = lump(turbine, float(chain.joint_height[elements - 1]), mudline)
    part = replace(
        chain,
        top=mudline,
        boundary=chain.boundary[: elements + 1],
        region=chain.region[:elements],
        joint_name=chain.joint_name[:joints],
        joint_height=chain.joint_height[:elements],
        joint_stiffness=chain.joint_stiffness[:elements],
        body=(*chain.body[:elements], head),
        rna=lump_rna(turbine.rna),
        tuned_masses=(),
    )
    return replace(
        system,
        turbine=turbine,
        chain=part,
        sea=None,
        joint_stiffness=system.joint_stiffness[:joints],
        joint_damping=np.zeros(joints),
        damping_ratios={},
        structural_loads=(),
    )


def axis_jacobian(motion: ChainMotion, height: float) -> Array:
    """(6, nv) velocity (m/s) and angular velocity (rad/s) of the axis per unit joint velocity.

    Its transpose maps a force and moment there, fixed in space, to generalised forces.
    """
    points = AxisPoints.on(motion.chain, np.array([height]))
    position = motion.points(points).position
    rows = [
        motion.generalised_force(points, position, unit[None, :3], unit[None, 3:])
        for unit in np.eye(6)
    ]
    return np.array(rows)
