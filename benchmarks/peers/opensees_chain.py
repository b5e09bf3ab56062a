"""Problem P in OpenSees: elastic beam-columns, tabulated soil springs, a run for one step size.

The model is made in space or in the fore-aft plane. Masses are lumped at the nodes; the
rotor-nacelle assembly sits on a node of its own behind a stiff strut, so that the overturning of
its weight counts. A zero-length element holds spring and dashpot of a soil node.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import openseespy.opensees as ops
from problem import (
    DASHPOT_TIME,
    GRAVITY,
    OUTPUT_STEP,
    Mesh,
    PeerRun,
    build_mesh,
    output_stride,
    step_count,
    stopwatch,
)
from problem_p import (
    FORCE_MEAN,
    FORCE_SINES,
    JOINT_DAMPING_TIME,
    SOIL_DISPLACEMENT,
    TOE_TORSIONAL_STIFFNESS,
    TOE_VERTICAL_STIFFNESS,
)

STRUT_STIFFENING = 100.0
"""Stiffness of the strut to the centre of the rotor and nacelle over that of the tower top."""
FIRST_INSTANT = 1e-6
"""Length in s of a step at t = 0 that finds the accelerations to the suddenly applied force."""
CURVE_POINTS = 4001
CURVE_REACH = 10.0
"""Tabulated range of the soil curve on either side, in units of y_u."""
GRAVITY_PATTERN, FORCE_PATTERN = 1, 2


@dataclass(frozen=True)
class Directions:
    """Numbers of the degrees of freedom, 0 where there is none, and how many a node has."""

    fore: int
    side: int
    up: int
    roll: int
    pitch: int
    twist: int
    count: int

    @property
    def planar(self) -> bool:
        return self.count == 3

    def vector(self, **values: float) -> list[float]:
        """Load or mass of a node by the names of the directions; others are zero."""
        result = [0.0] * self.count
        for name, value in values.items():
            if number := getattr(self, name):
                result[number - 1] = value
        return result


SPACE = Directions(fore=1, side=2, up=3, roll=4, pitch=5, twist=6, count=6)
PLANE = Directions(fore=1, side=0, up=2, roll=0, pitch=3, twist=0, count=3)


@dataclass(frozen=True)
class Settings:
    """How OpenSees is asked to solve; force_tolerance is a residual norm in N and N m."""

    transformation: str
    directions: Directions = SPACE
    system: str = "BandSPD"
    algorithm: str = "ModifiedNewton"
    integrator: tuple[str, float, float] = ("Newmark", 0.5, 0.25)
    force_tolerance: float = 0.1


@dataclass(frozen=True)
class Section:
    """EA in N, EI and GJ in N m2 of a beam."""

    axial: float
    bending: float
    torsion: float


def run(code: str, settings: Settings, dt: float, duration: float) -> PeerRun:
    """Gravity, then the transient with steps of dt s; 20 Hz output."""
    mesh = build_mesh()
    steps = step_count(dt, duration)
    stride = output_stride(dt)
    build(mesh, settings)
    solve_gravity(settings)
    # OpenSees' eigenvalues belong to the tangent, which holds the geometric stiffness by now.
    frequency = first_frequency(mesh, settings.directions)
    apply_force(mesh, settings.directions)
    start_transient(settings)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "moments.txt"
        record_moments(path, mesh, settings.directions.pitch, max(dt, OUTPUT_STEP))
        ops.record()  # t = 0, from which the recorder counts its intervals
        with stopwatch() as spent:
            failed = ops.analyze(steps, dt)
        ops.remove("recorders")
        moments = np.loadtxt(path)
    iterations = ops.testIter()
    ops.wipe()
    if failed:
        raise RuntimeError(f"OpenSees did not converge (code {failed}, dt {dt} s)")
    # Pitch is positive downwind in space; in OpenSees' plane the third axis points the other way.
    section = moments[:, 1:] if settings.directions.planar else -moments[:, 1:]
    expected = steps // stride + 1
    if len(section) != expected:
        raise RuntimeError(f"{len(section)} output instants where {expected} were expected")
    return PeerRun(
        code=code,
        version=ops.version(),
        dt=dt,
        steps=steps,
        wall_s=spent.wall_s,
        cpu_s=spent.cpu_s,
        time=moments[:, 0],
        seabed_moment=section[:, mesh.mudline_element],
        section_moment=section,
        section_place="lower end",
        frequency_hz=frequency,
        notes={
            "system": settings.system,
            "algorithm": settings.algorithm,
            "integrator": " ".join(map(str, settings.integrator)),
            "force_tolerance_n": settings.force_tolerance,
            "iterations_last_step": iterations,
            "moment": "elastic part; stiffness-proportional damping is not in it",
        },
    )


def build(mesh: Mesh, settings: Settings) -> None:
    """Nodes, masses, beams, strut, soil and toe."""
    directions = settings.directions
    ops.wipe()
    ops.model("basic", "-ndm", 2 if directions.planar else 3, "-ndf", directions.count)
    nodes = mesh.elements + 1
    for i, z in enumerate(mesh.height):
        add_node(i + 1, directions, 0.0, z)
        body = mesh.body[i]
        lateral = body.mass + mesh.added_mass[i]
        pitch = body.transverse + body.mass * (body.center - z) ** 2
        add_mass(i + 1, directions, lateral, body.mass, (pitch, pitch, body.axial))
    rna = nodes + 1
    offset, z_top = mesh.rna.center_of_mass, mesh.height[-1]
    add_node(rna, directions, offset[0], z_top + offset[2])
    add_mass(rna, directions, mesh.rna.mass, mesh.rna.mass, tuple(np.diag(mesh.rna.inertia)))
    add_beams(mesh, settings, rna)
    add_soil(mesh, directions)


def add_node(tag: int, directions: Directions, x: float, z: float) -> None:
    place = (x, z) if directions.planar else (x, 0.0, z)
    ops.node(tag, *map(float, place))


def add_mass(
    tag: int,
    directions: Directions,
    lateral: float,
    vertical: float,
    inertia: tuple[float, float, float],
) -> None:
    """Diagonal mass; inertia about x, y, z in kg m2."""
    values = directions.vector(
        fore=lateral,
        side=lateral,
        up=vertical,
        roll=inertia[0],
        pitch=inertia[1],
        twist=inertia[2],
    )
    ops.mass(tag, *map(float, values))


def add_beams(mesh: Mesh, settings: Settings, rna: int) -> None:
    """Elastic beams with stiffness-proportional damping, and the strut to the RNA without."""
    planar = settings.directions.planar
    upright, oblique = 1, 1 if planar else 2
    ops.geomTransf(settings.transformation, upright, *(() if planar else (1.0, 0.0, 0.0)))
    if not planar:
        ops.geomTransf(settings.transformation, oblique, 0.0, 1.0, 0.0)
    tags = list(range(1, mesh.elements + 1))
    for tag, *numbers in zip(tags, mesh.axial, mesh.bending, mesh.torsion, strict=True):
        add_beam(tag, (tag, tag + 1), Section(*numbers), upright, planar=planar)
    strut = Section(
        STRUT_STIFFENING * mesh.axial[-1],
        STRUT_STIFFENING * mesh.bending[-1],
        STRUT_STIFFENING * mesh.torsion[-1],
    )
    add_beam(rna, (mesh.elements + 1, rna), strut, oblique, planar=planar)
    ops.region(1, "-ele", *tags, "-rayleigh", 0.0, 0.0, JOINT_DAMPING_TIME, 0.0)


def add_beam(
    tag: int, nodes: tuple[int, int], section: Section, transformation: int, *, planar: bool
) -> None:
    """Beam between two nodes; moduli of 1 Pa carry its stiffnesses."""
    numbers = [section.axial, 1.0, section.bending]
    if not planar:
        numbers[2:] = [1.0, section.torsion, section.bending, section.bending]
    ops.element("elasticBeamColumn", tag, *nodes, *map(float, numbers), transformation)


def add_soil(mesh: Mesh, directions: Directions) -> None:
    """Ground nodes, p-y springs with dashpots, and the springs at the toe.

    The curve is nonlinear elastic, linear between closely tabulated points.
    """
    y = np.linspace(-CURVE_REACH, CURVE_REACH, CURVE_POINTS)
    sideways = [number for number in (directions.fore, directions.side) if number]
    first_ground = mesh.elements + 10
    for i, stiffness in enumerate(mesh.soil_stiffness):
        node, ground, material = i + 1, first_ground + i, i + 1
        add_node(ground, directions, 0.0, mesh.height[i])
        ops.fix(ground, *[1] * directions.count)
        ops.uniaxialMaterial(
            "ElasticMultiLinear",
            material,
            float(stiffness * DASHPOT_TIME),
            "-strain",
            *(SOIL_DISPLACEMENT * y).tolist(),
            "-stress",
            *(stiffness * SOIL_DISPLACEMENT * np.tanh(y)).tolist(),
        )
        materials, numbers = [material] * len(sideways), list(sideways)
        if i == 0:
            for number, toe in (
                (directions.up, TOE_VERTICAL_STIFFNESS),
                (directions.twist, TOE_TORSIONAL_STIFFNESS),
            ):
                if number:
                    ops.uniaxialMaterial("Elastic", 1000 + number, toe)
                    materials.append(1000 + number)
                    numbers.append(number)
        ops.element("zeroLength", 1000 + i, ground, node, "-mat", *materials, "-dir", *numbers)


def solve_gravity(settings: Settings) -> None:
    """Weight of everything, held constant afterwards."""
    directions = settings.directions
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", GRAVITY_PATTERN, 1)
    for tag in ops.getNodeTags():
        if mass := ops.nodeMass(tag, directions.up):
            ops.load(tag, *directions.vector(up=-GRAVITY * mass))
    common_solver(settings)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.0)
    ops.analysis("Static", "-noWarnings")
    if ops.analyze(1):
        raise RuntimeError("OpenSees found no equilibrium under gravity")
    ops.loadConst("-time", 0.0)


def common_solver(settings: Settings) -> None:
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(settings.system)
    ops.test("NormUnbalance", settings.force_tolerance, 30)


def first_frequency(mesh: Mesh, directions: Directions) -> float:
    """Frequency in Hz of the first mode that moves the yaw bearing fore-aft."""
    top = mesh.elements + 1
    values = ops.eigen(4)
    for i, value in enumerate(values, 1):
        fore = abs(ops.nodeEigenvector(top, i, directions.fore))
        side = abs(ops.nodeEigenvector(top, i, directions.side)) if directions.side else 0.0
        if fore > side:
            return float(np.sqrt(value) / (2 * np.pi))
    raise RuntimeError("no fore-aft mode among the first four")


def apply_force(mesh: Mesh, directions: Directions) -> None:
    """The tower-top force, its mean and each sine by a load pattern of its own."""
    top = mesh.elements + 1
    parts: list[tuple[float, tuple[Any, ...]]] = [(FORCE_MEAN, ("Constant",))]
    parts += [(a, ("Trig", -1.0, 1e6, 1 / f)) for a, f in FORCE_SINES]
    for i, (amplitude, (kind, *numbers)) in enumerate(parts):
        tag = FORCE_PATTERN + i
        if kind == "Trig":
            # The series starts a second early so that a step onto t = 0 is inside it.
            lag = 2 * np.pi * numbers[0] / numbers[2]
            ops.timeSeries(kind, tag, *numbers, "-phaseShift", float(lag))
        else:
            ops.timeSeries(kind, tag)
        ops.pattern("Plain", tag, tag)
        ops.load(top, *directions.vector(fore=amplitude))


def start_transient(settings: Settings) -> None:
    """Set up time stepping and find the accelerations at t = 0+."""
    ops.wipeAnalysis()
    common_solver(settings)
    ops.algorithm(settings.algorithm)
    ops.integrator(*settings.integrator)
    ops.analysis("Transient", "-noWarnings")
    if ops.analyze(1, FIRST_INSTANT):
        raise RuntimeError("OpenSees found no accelerations at the start")
    ops.setTime(0.0)


def record_moments(path: Path, mesh: Mesh, pitch: int, interval: float) -> None:
    """Record the moment at the lower end of every beam."""
    ops.recorder(
        "Element",
        *("-file", str(path), "-precision", 12, "-time", "-dT", interval),
        *("-ele", *range(1, mesh.elements + 1), "-dof", pitch, "globalForce"),
    )
