"""URDF of a chain, its meshes, and a sidecar file with data that URDF cannot contain."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from typing import Any

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.structure.chain import Chain
from offwind_pin.structure.meshes import Mesh, body_meshes, damper_disc
from offwind_pin.structure.rotor import rna_meshes
from offwind_pin.structure.section import outer_diameter
from offwind_pin.structure.tuned_mass import TunedMass

_AXIS = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
_YELLOW, _WHITE, _RED = "0.93 0.77 0.20 1", "0.88 0.89 0.90 1", "0.75 0.22 0.17 1"


def urdf_text(turbine: Turbine, chain: Chain) -> str:
    """URDF text of a chain; every number with 17 significant digits.

    A node is three revolute joints in series (x, y, z), below them two prismatic ones (x, y) where
    elements shear, with massless links between them. A tuned mass damper is a point mass on one or
    two prismatic joints. Each body has one mesh of its frusta as visual, ``meshes/LINK.stl`` beside
    the file, and the rotor-nacelle assembly one of nacelle, hub and blades (:func:`write_meshes`).
    """
    robot = ET.Element("robot", name=turbine.name)
    ET.SubElement(robot, "link", name="world")
    _materials(robot, dampers=bool(chain.tuned_masses))
    parent, height = "world", 0.0
    links = chain.body_name
    if chain.free_root:
        for joint in chain.joint_name[:6]:
            child = links[0] if joint.endswith("rz") else f"{joint}_link"
            _moving_joint(robot, joint, parent, child, chain.base - height)
            parent, height = child, chain.base
            if child != links[0]:
                ET.SubElement(robot, "link", name=child)
    else:
        _fixed_joint(robot, "base_fixed", parent, links[0], [0.0, 0.0, chain.base])
    _body(robot, chain, 0)
    parent, height = links[0], chain.base
    for k in range(chain.elements):
        for i, axis in enumerate(chain.node_joints):
            joint = chain.joint_name[chain.roots + len(chain.node_joints) * k + i]
            child = links[k + 1] if axis == "rz" else f"{joint}_link"
            _moving_joint(robot, joint, parent, child, chain.joint_height[k] - height)
            parent, height = child, chain.joint_height[k]
            if axis != "rz":
                ET.SubElement(robot, "link", name=child)
        _body(robot, chain, k + 1)
    _fixed_joint(robot, "yaw_bearing", parent, "rna", [0.0, 0.0, chain.top - height])
    rna = ET.SubElement(robot, "link", name="rna")
    _inertial(rna, chain.rna.mass, chain.rna.center_of_mass, chain.rna.inertia)
    _visual(rna, "rna", "tower_white")
    for mass in chain.tuned_masses:
        _tuned_mass(robot, turbine, chain, mass)
    ET.indent(robot)
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"
    )


def write_meshes(turbine: Turbine, chain: Chain) -> dict[str, bytes]:
    """Binary STL of each body and of the rotor-nacelle assembly, by file name.

    Coordinates are in the frame of the link, in m.
    """
    meshes = body_meshes(turbine, chain)
    diameter = float(outer_diameter(turbine, np.array([chain.top]))[0])
    meshes["rna"] = Mesh.combine(list(rna_meshes(turbine.rna, diameter).values()))
    return {f"{name}.stl": mesh.to_stl() for name, mesh in meshes.items()}


def write_sidecar(
    turbine: Turbine, chain: Chain, damping: Array, foundation: dict[str, Any]
) -> dict[str, Any]:
    """Data that URDF cannot contain: stiffness, damping, node map, hash of the definition.

    damping is (N, d) like the joint stiffness, in N m s/rad and N s/m.
    """
    node_joints = chain.node_joint_name
    return {
        "turbine": turbine.name,
        "definition_sha256": turbine.content_hash,
        "units": {
            "length": "m",
            "mass": "kg",
            "stiffness": "N m/rad of revolute, N/m of prismatic joints",
            "damping": "N m s/rad of revolute, N s/m of prismatic joints",
        },
        "node_joints": list(chain.node_joints),
        "joint_stiffness": dict(
            zip(node_joints, chain.joint_stiffness.ravel().tolist(), strict=True)
        ),
        "joint_damping": dict(zip(node_joints, damping.ravel().tolist(), strict=True)),
        "nodes": [
            {"element": name.rsplit("_", 1)[0], "region": region, "z_m": float(z)}
            for name, region, z in zip(
                node_joints[:: len(chain.node_joints)],
                chain.region,
                chain.joint_height,
                strict=True,
            )
        ],
        "element_boundaries_z_m": chain.boundary.tolist(),
        "foundation": foundation,
        **_sliding_masses(chain),
    }


def _sliding_masses(chain: Chain) -> dict[str, Any]:
    """Spring and damper of each joint of a tuned mass damper; no entry where there is none."""
    dampers = {
        joint: {"stiffness": mass.stiffness, "damping": mass.damping, "z_m": mass.height}
        for mass in chain.tuned_masses
        for joint in mass.joint_names
    }
    return {"tuned_mass_dampers": dampers} if dampers else {}


def _materials(robot: ET.Element, *, dampers: bool) -> None:
    colours = {"tower_white": _WHITE, "monopile_yellow": _YELLOW}
    for name, rgba in (colours | ({"damper_red": _RED} if dampers else {})).items():
        material = ET.SubElement(robot, "material", name=name)
        ET.SubElement(material, "color", rgba=rgba)


def _moving_joint(robot: ET.Element, name: str, parent: str, child: str, offset: float) -> None:
    """Prismatic or revolute joint about the axis named by the last letter of its name."""
    kind = {"p": "prismatic", "r": "revolute"}[name[-2]]
    joint = ET.SubElement(robot, "joint", name=name, type=kind)
    _origin(joint, [0.0, 0.0, offset])
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    ET.SubElement(joint, "axis", xyz=_AXIS[name[-1]])
    ET.SubElement(joint, "limit", lower="-3", upper="3", effort="1e12", velocity="1e3")


def _fixed_joint(robot: ET.Element, name: str, parent: str, child: str, xyz: list[float]) -> None:
    joint = ET.SubElement(robot, "joint", name=name, type="fixed")
    _origin(joint, xyz)
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)


def _body(robot: ET.Element, chain: Chain, k: int) -> None:
    name = chain.body_name[k]
    link = ET.SubElement(robot, "link", name=name)
    body = chain.body[k]
    center = np.array([0.0, 0.0, body.center - chain.origin[k]])
    _inertial(link, body.mass, center, body.inertia())
    _visual(link, name, "tower_white" if name.startswith("tower") else "monopile_yellow")


def _tuned_mass(robot: ET.Element, turbine: Turbine, chain: Chain, mass: TunedMass) -> None:
    """Prismatic joints of a tuned mass damper, and a point mass drawn as a disc."""
    parent, offset = chain.body_name[mass.body], mass.height - chain.origin[mass.body]
    for joint in mass.joint_names:
        last = joint == mass.joint_names[-1]
        child = f"zz_tmd_{mass.name}_mass" if last else f"{joint}_link"
        _moving_joint(robot, joint, parent, child, offset)
        parent, offset = child, 0.0
        link = ET.SubElement(robot, "link", name=child)
    _inertial(link, mass.mass, np.zeros(3), np.zeros((3, 3)))
    visual = ET.SubElement(link, "visual")
    diameter = float(outer_diameter(turbine, np.array([mass.height]))[0])
    radius, thickness = damper_disc(diameter)
    disc = {"radius": _text(radius), "length": _text(thickness)}
    ET.SubElement(ET.SubElement(visual, "geometry"), "cylinder", disc)
    ET.SubElement(visual, "material", name="damper_red")


def _visual(link: ET.Element, name: str, colour: str) -> None:
    visual = ET.SubElement(link, "visual")
    geometry = ET.SubElement(visual, "geometry")
    ET.SubElement(geometry, "mesh", filename=f"meshes/{name}.stl")
    ET.SubElement(visual, "material", name=colour)


def _inertial(link: ET.Element, mass: float, center: Array, inertia: Array) -> None:
    inertial = ET.SubElement(link, "inertial")
    _origin(inertial, center)
    ET.SubElement(inertial, "mass", value=_text(mass))
    keys = {
        "ixx": (0, 0),
        "ixy": (0, 1),
        "ixz": (0, 2),
        "iyy": (1, 1),
        "iyz": (1, 2),
        "izz": (2, 2),
    }
    ET.SubElement(inertial, "inertia", {key: _text(inertia[index]) for key, index in keys.items()})


def _origin(parent: ET.Element, xyz: Array | list[float]) -> None:
    ET.SubElement(parent, "origin", xyz=" ".join(_text(value) for value in xyz), rpy="0 0 0")


def _text(value: float) -> str:
    return format(float(value), ".17g")
