"""Tuned mass dampers as bodies of the chain: point masses on prismatic joints.

Their joints come last in the configuration vector. Pinocchio reads a tree depth first, and the
children of a link in the order of their joints' names: a name that begins with ``zz`` comes after
the next element and the rotor-nacelle assembly, so that the dampers of the highest body come first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from offwind_pin.definitions.turbine import Turbine

_JOINTS = {"fore_aft": ("px",), "side_side": ("py",), "both": ("px", "py")}


@dataclass(frozen=True)
class TunedMass:
    """Point mass that slides across the axis of its carrier.

    Attributes
    ----------
    name : str
        Name of the damper.
    height : float, m
        Undeformed height.
    body : int
        Index of the carrier.
    mass : float, kg
    joints : tuple of str
        ``px``, ``py`` or both, along x and y of the carrier.
    stiffness, damping : float
        Stiffness of each joint's spring in N/m and coefficient of its damper in N s/m.
    travel : float, m
        Available travel, or infinite.
    """

    name: str
    height: float
    body: int
    mass: float
    joints: tuple[str, ...]
    stiffness: float
    damping: float
    travel: float

    @property
    def joint_names(self) -> tuple[str, ...]:
        return tuple(f"zz_tmd_{self.name}_{joint}" for joint in self.joints)


def tuned_masses_of(turbine: Turbine, base: float, joint_height: list[float]) -> list[TunedMass]:
    """Dampers of the structure above a base, in the order of their joints.

    joint_height : heights of the nodes in m; at a node the carrier is the body above
    """
    masses = [
        TunedMass(
            name=damper.name,
            height=damper.z,
            body=sum(height <= damper.z for height in joint_height),
            mass=damper.mass,
            joints=_JOINTS[damper.direction],
            stiffness=damper.stiffness,
            damping=damper.damping,
            travel=math.inf if damper.travel is None else damper.travel,
        )
        for damper in turbine.tuned_mass_dampers
        if damper.z >= base
    ]
    return sorted(masses, key=lambda mass: (-mass.body, mass.joint_names[0]))
