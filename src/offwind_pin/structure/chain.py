"""The lumped chain: multibody beam elements with three revolute joints each.

An element of length l has two rigid halves and, at mid-height, revolute joints about x, y and z;
with shear it also has prismatic joints along x and y below them. Neighbouring elements are rigidly
joined, so body k is the upper half of element k and the lower half of element k + 1; body 0 is the
lower half of the first element, at the base.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.rotor_nacelle import RigidBody, lump_rna
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.structure.frustum import AxialBody
from offwind_pin.structure.section import (
    bending_stiffness,
    flexibility,
    lump,
    pieces,
    shear_flexibility,
    shear_stiffness,
    torsional_stiffness,
)
from offwind_pin.structure.tuned_mass import TunedMass, tuned_masses_of

Stiffness = Literal["flexibility", "midpoint"]
Elements = int | Mapping[str, int] | None

ELEMENT_LENGTH = {"pile": 3.0, "monopile": 4.0, "tower": 4.0}
"""Longest default element in m by region; any other member is divided like the tower.

Chosen by the convergence study in tests/convergence: the first five frequencies of the benchmark
are within 0.1 % of the converged ones.
"""

MOST_ELEMENTS = 1000

ROOT_JOINTS = ("px", "py", "pz", "rx", "ry", "rz")
NODE_JOINTS: dict[Element, tuple[str, ...]] = {
    "euler_bernoulli": ("rx", "ry", "rz"),
    "timoshenko": ("px", "py", "rx", "ry", "rz"),
}
"""Joints of a node from the lower body up: p prismatic along, r revolute about an axis."""


@dataclass(frozen=True, eq=False)
class Chain:
    """Tower and monopile as rigid bodies and joints, from the base upwards.

    Attributes
    ----------
    base, top : float, m
        Heights of the base and of the yaw bearing.
    free_root : bool
        Whether the base moves on three prismatic and three revolute joints.
    boundary : (N + 1,) array, m
        Heights of the element boundaries.
    region : tuple of str
        Names of the regions of the N elements.
    node_joints : tuple of str
        Joints of a node, see :data:`NODE_JOINTS`.
    joint_name : tuple of str
        Names of all joints in the order of the configuration vector.
    joint_height : (N,) array, m
        Heights of the nodes.
    joint_stiffness : (N, d) array
        Stiffness of each node's joints, in N m/rad of the revolute and N/m of the prismatic ones.
    body : tuple of AxialBody
        The N + 1 rigid bodies, with heights of their centres as z.
    rna : RigidBody
        Rotor-nacelle assembly, fixed to the last body; offsets from the yaw bearing.
    tuned_masses : tuple of TunedMass
        Tuned mass dampers in the order of their joints, which come last.
    """

    base: float
    top: float
    free_root: bool
    boundary: Array
    region: tuple[str, ...]
    node_joints: tuple[str, ...]
    joint_name: tuple[str, ...]
    joint_height: Array
    joint_stiffness: Array
    body: tuple[AxialBody, ...]
    rna: RigidBody
    tuned_masses: tuple[TunedMass, ...] = ()

    @property
    def elements(self) -> int:
        return len(self.joint_height)

    @property
    def roots(self) -> int:
        """Number of joints below the first element: six or none."""
        return len(ROOT_JOINTS) if self.free_root else 0

    @property
    def axis_joints(self) -> int:
        """Number of joints of root and nodes, without those of tuned mass dampers."""
        return self.roots + len(self.node_joints) * self.elements

    @property
    def node_joint_name(self) -> tuple[str, ...]:
        """Names of the nodes' joints."""
        return self.joint_name[self.roots : self.axis_joints]

    @property
    def mass(self) -> float:
        """Total mass in kg."""
        sliding = sum(mass.mass for mass in self.tuned_masses)
        return self.rna.mass + sum(body.mass for body in self.body) + sliding

    @property
    def origin(self) -> Array:
        """(N + 1,) heights of the body frames: the base, then the joints."""
        return np.concatenate([[self.base], self.joint_height])

    @property
    def cut(self) -> Array:
        """(N + 2,) heights at which the bodies end: body k is between cuts k and k + 1."""
        return np.concatenate([[self.base], self.joint_height, [self.top]])

    @property
    def body_name(self) -> list[str]:
        """Names of the N + 1 bodies, from the base upwards."""
        first = self.node_joint_name[:: len(self.node_joints)]
        elements = [name.rsplit("_", 1)[0] for name in first]
        return ["base", *("_b".join(name.rsplit("_e", 1)) for name in elements)]

    def body_at(self, height: Array) -> NDArrayInt:
        """Index of the body at each height of the axis; at a joint, the body above."""
        return np.searchsorted(self.joint_height, height, side="right")


NDArrayInt = np.ndarray[tuple[int, ...], np.dtype[np.intp]]


def dof_body(chain: Chain) -> NDArrayInt:
    """(nv,) index of the lowest body that each joint moves.

    The joints of tuned mass dampers move none: they count as above the last one, N + 1.
    """
    nodes = np.repeat(np.arange(1, chain.elements + 1), len(chain.node_joints))
    none = np.full(len(chain.joint_name) - chain.axis_joints, chain.elements + 1)
    return np.concatenate([np.zeros(chain.roots, dtype=np.intp), nodes, none])


def build_chain(
    turbine: Turbine,
    *,
    base: float,
    free_root: bool,
    elements: Elements = None,
    stiffness: Stiffness = "flexibility",
    element: Element = "euler_bernoulli",
) -> Chain:
    """Divide the structure above ``base`` into multibody beam elements.

    Parameters
    ----------
    base : float, m
        Height of the lowest point: the mudline, or the pile toe.
    free_root : bool
        Whether to add six joints below the first body, to be restrained by a foundation.
    elements : int, dict of str to int, or None
        Total number, or number by region (``{"tower": 30}``).
    stiffness : {"flexibility", "midpoint"}
        ``"flexibility"`` is 1 / integral(dz / EI) over the element, ``"midpoint"`` the paper's EI /
        l at mid-height (Rahman et al., MECC 2025, Eq. 3).
    element : {"euler_bernoulli", "timoshenko"}
        ``"euler_bernoulli"`` is the paper's, with three revolute joints per node; ``"timoshenko"``
        adds two prismatic joints for shear.

    Raises
    ------
    InputError
        An impossible number of elements, or an unknown region.
    """
    for name, value, kinds in (("stiffness", stiffness, Stiffness), ("element", element, Element)):
        if value not in get_args(kinds):
            raise InputError(name, value, ", ".join(get_args(kinds)), "Choose one.")
    spans = _regions(turbine, base)
    counts = _element_counts(spans, elements)
    boundary: list[float] = [base]
    region: list[str] = []
    names: list[str] = []
    for (name, low, high), count in zip(spans, counts, strict=True):
        boundary.extend(np.linspace(low, high, count + 1)[1:])
        prefix = {"monopile": "mono"}.get(name, name)
        first = region.count(name) + 1
        names.extend(f"{prefix}_e{i:03d}" for i in range(first, first + count))
        region.extend([name] * count)
    edges = np.array(boundary)
    middle = (edges[:-1] + edges[1:]) / 2
    cuts = np.concatenate([[base], middle, [turbine.yaw_bearing]])
    root = [f"root_{joint}" for joint in ROOT_JOINTS] if free_root else []
    sliding = tuned_masses_of(turbine, base, middle.tolist())
    return Chain(
        base=base,
        top=turbine.yaw_bearing,
        free_root=free_root,
        boundary=edges,
        region=tuple(region),
        node_joints=NODE_JOINTS[element],
        joint_name=(
            *root,
            *(f"{name}_{joint}" for name in names for joint in NODE_JOINTS[element]),
            *(joint for mass in sliding for joint in mass.joint_names),
        ),
        joint_height=middle,
        joint_stiffness=_joint_stiffness(turbine, edges, stiffness, NODE_JOINTS[element]),
        body=tuple(lump(turbine, low, high) for low, high in itertools.pairwise(cuts)),
        rna=lump_rna(turbine.rna),
        tuned_masses=tuple(sliding),
    )


def _regions(turbine: Turbine, base: float) -> list[tuple[str, float, float]]:
    """Name, bottom and top of the parts to divide; the section jumps only between them."""
    mudline = turbine.site.mudline
    spans = []
    for member in turbine.members:
        low = max(member.bottom, base)
        if low < min(member.top, mudline):
            spans.append(("pile", low, min(member.top, mudline)))
        if max(low, mudline) < member.top:
            spans.append((member.name, max(low, mudline), member.top))
    return spans


def _element_counts(spans: list[tuple[str, float, float]], elements: Elements) -> list[int]:
    """Number of elements of each span: the default, or a share of the given number."""
    default = [
        int(np.ceil((high - low) / ELEMENT_LENGTH.get(name, ELEMENT_LENGTH["tower"]) - 1e-9))
        for name, low, high in spans
    ]
    if elements is None:
        counts = default
    elif isinstance(elements, Mapping):
        counts = _counts_by_region([name for name, *_ in spans], default, elements)
    else:
        counts = _share(elements, default, "elements")
    if sum(counts) > MOST_ELEMENTS:
        raise InputError(
            "elements",
            sum(counts),
            f"at most {MOST_ELEMENTS}",
            "Use fewer elements; are the heights in m?",
        )
    return counts


def _counts_by_region(
    names: list[str], default: list[int], elements: Mapping[str, int]
) -> list[int]:
    """Counts with the given regions set; a region may contain several spans."""
    counts = list(default)
    for name, total in elements.items():
        places = [i for i, region in enumerate(names) if region == name]
        if not places:
            known = ", ".join(dict.fromkeys(names))
            raise InputError(f"elements[{name!r}]", total, f"the regions {known}", "Rename it.")
        shares = _share(total, [default[i] for i in places], f"elements[{name!r}]")
        for i, count in zip(places, shares, strict=True):
            counts[i] = count
    return counts


def _share(total: int, weights: list[int], where: str) -> list[int]:
    """Divide a total in proportion to weights, at least one each."""
    if total < len(weights):
        allowed = f"at least {len(weights)}, one per part between jumps of the section"
        raise InputError(where, total, allowed, "Use more elements.")
    shares = np.array(weights) * total / sum(weights)
    counts = np.maximum(1, np.floor(shares).astype(int))
    while counts.sum() < total:
        counts[np.argmax(shares - counts)] += 1
    while counts.sum() > total:
        counts[np.argmax(np.where(counts > 1, counts - shares, -np.inf))] -= 1
    return [int(count) for count in counts]


def _joint_stiffness(
    turbine: Turbine, boundary: Array, rule: Stiffness, joints: tuple[str, ...]
) -> Array:
    """(N, d) stiffness of the joints of each node, in N m/rad and N/m."""
    of_element = _whole_stiffness if rule == "flexibility" else _midpoint_stiffness
    rows = []
    for low, high in itertools.pairwise(boundary):
        bending, torsion, shear = of_element(turbine, low, high)
        of_joint = {"rx": bending, "ry": bending, "rz": torsion, "px": shear, "py": shear}
        rows.append([of_joint[joint] for joint in joints])
    return np.array(rows)


def _whole_stiffness(turbine: Turbine, low: float, high: float) -> tuple[float, float, float]:
    """Stiffness of an element in bending, torsion and shear: one over its flexibility."""
    bending, torsion = flexibility(turbine, low, high)
    return 1 / bending, 1 / torsion, 1 / shear_flexibility(turbine, low, high)


def _midpoint_stiffness(turbine: Turbine, low: float, high: float) -> tuple[float, float, float]:
    """The same for a prism with the section at mid-height."""
    middle = np.array([(low + high) / 2])
    member = next(m for bottom, top, m in pieces(turbine, low, high) if bottom <= middle[0] <= top)
    material = turbine.materials[member.material]
    kinds = (bending_stiffness, torsional_stiffness, shear_stiffness)
    bending, torsion, shear = (float(of(member, material, middle)[0]) for of in kinds)
    length = high - low
    return bending / length, torsion / length, shear / length
