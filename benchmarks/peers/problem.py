"""Problem P: one structure, soil and load for every code of the work-precision comparison.

OC6 Phase II with its pile, 80 elements, soil nodes on mesh nodes, p = k y_u tanh(y / y_u), constant
dashpots, added mass in still water, stiffness-proportional damping, gravity, and a tower-top force
that is put on at t = 0 to the structure at rest under gravity alone. The motion is planar; each
soil node has two independent uniaxial springs.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import offwind_pin as ow
from offwind_pin.definitions.rotor_nacelle import RigidBody
from offwind_pin.structure.chain import Chain, build_chain
from offwind_pin.structure.frustum import AxialBody
from offwind_pin.structure.section import frusta, outer_diameter

sys.path.append(str(Path(__file__).parents[1]))

import problem_p
from problem_p import (
    DASHPOT_FACTOR,
    DASHPOT_FREQUENCY,
    ELEMENTS,
    FORCE_MEAN,
    FORCE_SINES,
    SOIL_DISPLACEMENT,
    SOIL_MODULUS,
)

Array = NDArray[np.float64]

GRAVITY = 9.80665
WATER_LINE = 0.0
WATER_DENSITY = 1025.0
ADDED_MASS_COEFFICIENT = 1.0
DASHPOT_TIME = DASHPOT_FACTOR / (np.pi * DASHPOT_FREQUENCY)
"""Dashpot coefficient over initial stiffness in s."""

OUTPUT_STEP = 0.05


@dataclass(frozen=True, eq=False)
class Mesh:
    """Tables of the discretised structure, from the toe upwards; N elements, N + 1 nodes.

    Attributes
    ----------
    chain : the package's own chain with the same elements
    height : (N + 1,) heights of the nodes in m
    length : (N,) element lengths in m
    bending, torsion, axial : (N,) EI and GJ in N m2, EA in N; element means of the flexibility
    body : N + 1 rigid bodies between the element middles, one for each node
    added_mass : (N + 1,) lateral added mass in kg
    rna : rotor-nacelle assembly, offsets from the yaw bearing
    soil : number of soil nodes, the lowest nodes of the mesh
    soil_length : (soil,) tributary lengths in m
    """

    chain: Chain
    height: Array
    length: Array
    bending: Array
    torsion: Array
    axial: Array
    body: tuple[AxialBody, ...]
    added_mass: Array
    rna: RigidBody
    soil: int
    soil_length: Array

    @property
    def elements(self) -> int:
        return len(self.length)

    @property
    def mudline_element(self) -> int:
        """Index of the element whose lower end is at the mudline."""
        return self.soil - 1

    @property
    def soil_stiffness(self) -> Array:
        """(soil,) initial stiffness of the springs in N/m."""
        return SOIL_MODULUS * self.soil_length

    @property
    def soil_dashpot(self) -> Array:
        """(soil,) dashpot coefficients in N s/m."""
        return self.soil_stiffness * DASHPOT_TIME


@dataclass(frozen=True, eq=False)
class PeerRun:
    """What one code gives for one step size.

    Attributes
    ----------
    code, version : name and version of the code
    dt : step in s
    steps : steps from 0 to the duration
    wall_s : seconds of the transient alone; building, gravity and modes are left out
    cpu_s : processor seconds of the same, which other work on the machine disturbs less
    time : (n,) output instants in s, 20 Hz or every step if that is longer
    seabed_moment : (n,) fore-aft moment at the mudline in N m, positive for a force downwind
    section_moment : (n, N) fore-aft moments of all elements in N m
    section_place : where on an element its moment is taken
    frequency_hz : first fore-aft frequency of the structure under gravity, if the code gives it
    notes : settings and peculiarities
    """

    code: str
    version: str
    dt: float
    steps: int
    wall_s: float
    cpu_s: float
    time: Array
    seabed_moment: Array
    section_moment: Array
    section_place: str
    frequency_hz: float | None = None
    notes: dict[str, Any] = field(default_factory=dict)


@dataclass
class Stopwatch:
    """Seconds on the wall and of the processor."""

    wall_s: float = 0.0
    cpu_s: float = 0.0


@contextmanager
def stopwatch() -> Iterator[Stopwatch]:
    """Time of what runs inside."""
    result = Stopwatch()
    wall, cpu = time.perf_counter(), time.process_time()
    yield result
    result.wall_s, result.cpu_s = time.perf_counter() - wall, time.process_time() - cpu


def build_mesh() -> Mesh:
    """Tables of problem P out of the package's definition of the turbine."""
    turbine = problem_p.turbine()
    chain = build_chain(turbine, base=turbine.toe, free_root=True, elements=ELEMENTS)
    height = chain.boundary
    length = np.diff(height)
    axial = [
        sum(
            shell.lump().mass / shell.density
            for _, shell in frusta(turbine, height[i], height[i + 1])
        )
        / length[i]
        for i in range(len(length))
    ]
    modulus = next(iter(turbine.materials.values())).youngs_modulus
    soil = ELEMENTS["pile"] + 1
    soil_length = np.full(soil, length[0])
    soil_length[[0, -1]] /= 2
    return Mesh(
        chain=chain,
        height=height,
        length=length,
        bending=chain.joint_stiffness[:, 1] * length,
        torsion=chain.joint_stiffness[:, 2] * length,
        axial=modulus * np.array(axial),
        body=chain.body,
        added_mass=_added_mass(turbine, chain.cut, height),
        rna=chain.rna,
        soil=soil,
        soil_length=soil_length,
    )


def tower_top_force(time: float) -> float:
    """Fore-aft force at the yaw bearing in N."""
    waves = (a * np.sin(2 * np.pi * f * time) for a, f in FORCE_SINES)
    return FORCE_MEAN + float(sum(waves))


def soil_force(displacement: Array, initial_stiffness: Array) -> Array:
    """Resistance in N of springs with the given initial stiffness in N/m."""
    return initial_stiffness * SOIL_DISPLACEMENT * np.tanh(displacement / SOIL_DISPLACEMENT)


def step_count(dt: float, duration: float) -> int:
    """Whole number of steps.

    Raises
    ------
    ValueError : the duration is no multiple of the step
    """
    steps = round(duration / dt)
    if abs(steps * dt - duration) > 1e-9 * duration:
        raise ValueError(f"{duration} s is no multiple of the step {dt} s")
    return steps


def output_stride(dt: float) -> int:
    """Steps from one output to the next: 20 Hz, or every step if steps are longer.

    Raises
    ------
    ValueError : a step that neither divides the output interval nor is longer
    """
    stride = max(1, round(OUTPUT_STEP / dt))
    if dt < OUTPUT_STEP and abs(stride * dt - OUTPUT_STEP) > 1e-9:
        raise ValueError(f"the step {dt} s does not divide {OUTPUT_STEP} s")
    return stride


def _added_mass(turbine: ow.Turbine, cut: Array, height: Array) -> Array:
    """(N + 1,) water that moves with each node's share of the wetted length, in kg."""
    mudline = turbine.site.mudline
    wetted = np.diff(np.clip(cut, mudline, WATER_LINE))
    diameter = outer_diameter(turbine, np.clip(height, mudline, WATER_LINE))
    return WATER_DENSITY * ADDED_MASS_COEFFICIENT * np.pi / 4 * diameter**2 * wetted
