"""URDF of a chain, its meshes, and the sidecar with what URDF cannot say."""

from __future__ import annotations

import hashlib
import struct
import xml.etree.ElementTree as ET
from typing import Any

import numpy as np

from offwind_pin.structure.chain import NODE_JOINTS, Chain
from offwind_pin.structure.section import frusta
from offwind_pin.turbines.definition import Array, Turbine

_AXIS = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
_FACETS = 24
_YELLOW, _WHITE = "0.93 0.77 0.20 1", "0.88 0.89 0.90 1"


def write_urdf(turbine: Turbine, chain: Chain) -> str:
    """URDF text of a chain; every number with 17 significant digits.

    A node is three revolute joints in series (x, y, z), with massless links between them. Each body
    has one mesh of its frusta as visual, ``meshes/LINK.stl`` beside the file.
    """
    robot = ET.Element("robot", name=turbine.name)
    ET.SubElement(robot, "link", name="world")
    _materials(robot)
    parent, height = "world", 0.0
    links = body_links(chain)
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
        for i, axis in enumerate(NODE_JOINTS):
            joint = chain.joint_name[chain.roots + 3 * k + i]
            child = links[k + 1] if axis == "rz" else f"{joint}_link"
            _moving_joint(robot, joint, parent, child, chain.joint_height[k] - height)
            parent, height = child, chain.joint_height[k]
            if axis != "rz":
                ET.SubElement(robot, "link", name=child)
        _body(robot, chain, k + 1)
    _fixed_joint(robot, "yaw_bearing", parent, "rna", [0.0, 0.0, chain.top - height])
    rna = ET.SubElement(robot, "link", name="rna")
    _inertial(rna, chain.rna.mass, chain.rna.center_of_mass, chain.rna.inertia)
    ET.indent(robot)
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"
    )


def body_links(chain: Chain) -> list[str]:
    """Names of the links that have mass, from the base upwards."""
    names = [
        chain.joint_name[chain.roots + 3 * k].removesuffix("_rx") for k in range(chain.elements)
    ]
    return ["base", *(name.replace("_e", "_b") for name in names)]


def write_meshes(turbine: Turbine, chain: Chain) -> dict[str, bytes]:
    """Binary STL of each body, by file name; coordinates in the frame of its link, in m."""
    cuts = np.concatenate([[chain.base], chain.joint_height, [chain.top]])
    result = {}
    for k, link in enumerate(body_links(chain)):
        shells = frusta(turbine, cuts[k], cuts[k + 1])
        triangles = np.concatenate(
            [
                _hollow_frustum(
                    base - chain.origin[k],
                    shell.height,
                    (shell.outer_bottom, shell.outer_top),
                    (shell.inner_bottom, shell.inner_top),
                )
                for base, shell in shells
            ]
        )
        result[f"{link}.stl"] = _stl(triangles)
    return result


def write_sidecar(
    turbine: Turbine, chain: Chain, damping: Array, foundation: dict[str, Any]
) -> dict[str, Any]:
    """What URDF cannot say, as plain data: stiffness, damping, node map, hash of the definition.

    damping is (N, 3) in N m s/rad, like the joint stiffness.
    """
    node_joints = chain.joint_name[chain.roots :]
    return {
        "turbine": turbine.name,
        "definition_sha256": definition_hash(turbine),
        "units": {"length": "m", "mass": "kg", "stiffness": "N m/rad", "damping": "N m s/rad"},
        "joint_stiffness": dict(
            zip(node_joints, chain.joint_stiffness.ravel().tolist(), strict=True)
        ),
        "joint_damping": dict(zip(node_joints, damping.ravel().tolist(), strict=True)),
        "nodes": [
            {"element": name.removesuffix("_rx"), "region": region, "z_m": float(z)}
            for name, region, z in zip(
                node_joints[::3], chain.region, chain.joint_height, strict=True
            )
        ],
        "element_boundaries_z_m": chain.boundary.tolist(),
        "foundation": foundation,
    }


def definition_hash(turbine: Turbine) -> str:
    """SHA-256 of the definition's canonical JSON."""
    return hashlib.sha256(turbine.model_dump_json().encode()).hexdigest()


def _materials(robot: ET.Element) -> None:
    for name, rgba in (("tower_white", _WHITE), ("monopile_yellow", _YELLOW)):
        material = ET.SubElement(robot, "material", name=name)
        ET.SubElement(material, "color", rgba=rgba)


def _moving_joint(robot: ET.Element, name: str, parent: str, child: str, rise: float) -> None:
    """Prismatic or revolute joint about the axis that the last letter of its name tells."""
    kind = {"p": "prismatic", "r": "revolute"}[name[-2]]
    joint = ET.SubElement(robot, "joint", name=name, type=kind)
    _origin(joint, [0.0, 0.0, rise])
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
    name = body_links(chain)[k]
    link = ET.SubElement(robot, "link", name=name)
    body = chain.body[k]
    center = np.array([0.0, 0.0, body.center - chain.origin[k]])
    _inertial(link, body.mass, center, body.inertia())
    visual = ET.SubElement(link, "visual")
    geometry = ET.SubElement(visual, "geometry")
    ET.SubElement(geometry, "mesh", filename=f"meshes/{name}.stl")
    colour = "tower_white" if name.startswith("tower") else "monopile_yellow"
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


def _hollow_frustum(
    base: float, height: float, outer: tuple[float, float], inner: tuple[float, float]
) -> Array:
    """(n, 3, 3) triangles of a closed hollow frustum, normals outwards."""
    angle = np.linspace(0, 2 * np.pi, _FACETS, endpoint=False)
    unit = np.stack([np.cos(angle), np.sin(angle)], axis=1)

    def ring(radius: float, z: float) -> Array:
        return np.column_stack([radius * unit, np.full(_FACETS, z)])

    loop = [
        ring(outer[0], base),
        ring(outer[1], base + height),
        ring(inner[1], base + height),
        ring(inner[0], base),
    ]
    quads = []
    for start, end in zip(loop, [*loop[1:], loop[0]], strict=True):
        start_next, end_next = np.roll(start, -1, axis=0), np.roll(end, -1, axis=0)
        quads.append(np.stack([start, start_next, end_next], axis=1))
        quads.append(np.stack([start, end_next, end], axis=1))
    return np.concatenate(quads)


def _stl(triangles: Array) -> bytes:
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = normal / np.where(length > 0, length, 1)
    record = np.zeros(
        len(triangles), dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("unused", "<u2")]
    )
    record["normal"], record["corner"] = normal, triangles
    header = b"offwind-pin body".ljust(80, b" ")
    return header + struct.pack("<I", len(triangles)) + record.tobytes()
