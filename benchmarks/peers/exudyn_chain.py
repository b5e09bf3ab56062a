"""Problem P in Exudyn: rigid bodies in space joined by six-component springs.

A body lies between the middles of neighbouring elements, with its node at the mesh node. Half an
element on either side of a spring with EI/l in bending and 12 EI/l^3 in shear has exactly the
stiffness of an Euler-Bernoulli beam. There are no constraints, so that the equations are ordinary.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
from exudyn import itemInterface
from exudyn.advancedUtilities import CreateSymbolicUserFunction
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
    tower_top_force,
)
from problem_p import (
    JOINT_DAMPING_TIME,
    SOIL_DISPLACEMENT,
    TOE_TORSIONAL_STIFFNESS,
    TOE_VERTICAL_STIFFNESS,
)

from offwind_pin.definitions.rotor_nacelle import RigidBody, point_inertia

SPECTRAL_RADIUS = 0.9
RELATIVE_TOLERANCE = 1e-8
ABSOLUTE_TOLERANCE = 0.3
FORE, SIDE, UP, TWIST = 0, 1, 2, 5
"""Coordinates of a node."""


@dataclass(frozen=True)
class Model:
    """Exudyn's system and the numbers of what is asked of it; the soil law is kept alive here."""

    system: Any
    container: Any
    sensors: list[Any]
    top_node: Any
    soil_law: Any


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s."""
    mesh = build_mesh()
    steps = step_count(dt, duration)
    stride = output_stride(dt)
    model = build(mesh)
    solve_gravity(model)
    frequency = first_frequency(model)
    interval = max(dt, OUTPUT_STEP)
    model.system.variables["loaded"] = True
    settings = transient_settings(steps, duration, interval)
    with stopwatch() as spent:
        # A step that does not converge raises Exudyn's SolverError.
        model.system.SolveDynamic(
            settings,
            solverType=exudyn.DynamicSolverType.GeneralizedAlpha,
            updateInitialValues=False,
        )
    torque = [model.system.GetSensorStoredData(number) for number in model.sensors[:-1]]
    shear = model.system.GetSensorStoredData(model.sensors[-1])
    instants = torque[0][:, 0]
    if len(instants) != steps // stride + 1:
        raise RuntimeError(f"{len(instants)} output instants, not {steps // stride + 1}")
    section = np.column_stack([data[:, 2] for data in torque])
    first = mesh.mudline_element
    return PeerRun(
        code="exudyn_chain",
        version=exudyn.__version__,
        dt=dt,
        steps=steps,
        wall_s=spent.wall_s,
        cpu_s=spent.cpu_s,
        time=instants,
        seabed_moment=section[:, first] + shear[:, 1] * mesh.length[first] / 2,
        section_moment=section,
        section_place="middle",
        frequency_hz=frequency,
        notes={
            "solver": f"generalised-alpha, spectral radius {SPECTRAL_RADIUS}",
            "linear_solver": "EigenSparse",
            "newton": "modified, the tangent renewed where convergence is slow",
            "relative_tolerance": RELATIVE_TOLERANCE,
            "soil": "tanh as a symbolic function, evaluated without Python",
            "moment": "spring and damper",
        },
    )


def build(mesh: Mesh) -> Model:
    """Bodies, springs between them, soil, weight and the tower-top force."""
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    system.variables["loaded"] = False
    ground = system.AddMarker(
        itemInterface.MarkerNodeCoordinate(
            nodeNumber=system.AddNode(itemInterface.NodePointGround()), coordinate=0
        )
    )
    nodes, bodies = zip(*(add_body(system, mesh, i) for i in range(mesh.elements + 1)), strict=True)
    springs = tuple(add_beam(system, mesh, i, bodies) for i in range(mesh.elements))
    law = add_soil(system, mesh, nodes, ground)
    add_force(system, bodies[-1])
    sensors = add_sensors(system, springs, mesh)
    # Assembling resets the initial state, so that nothing may be added after gravity.
    system.Assemble()
    return Model(system, container, sensors, nodes[-1], law)


def add_body(system: Any, mesh: Mesh, i: int) -> tuple[Any, Any]:
    """Rigid body around mesh node i with its weight and added mass; the top one holds the RNA."""
    z = mesh.height[i]
    axial = mesh.body[i]
    body = RigidBody(axial.mass, np.array([0.0, 0.0, axial.center - z]), axial.inertia())
    if i == mesh.elements:
        body = RigidBody.combine([body, mesh.rna])
    inertia = body.inertia + point_inertia(body.mass, body.center_of_mass)
    node = system.AddNode(itemInterface.NodeRigidBodyRxyz(referenceCoordinates=[0, 0, z, 0, 0, 0]))
    number = system.AddObject(
        itemInterface.ObjectRigidBody(
            nodeNumber=node,
            physicsMass=body.mass,
            physicsInertia=[inertia[k] for k in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))],
            physicsCenterOfMass=body.center_of_mass.tolist(),
        )
    )
    system.AddLoad(
        itemInterface.LoadMassProportional(
            markerNumber=system.AddMarker(itemInterface.MarkerBodyMass(bodyNumber=number)),
            loadVector=[0, 0, -GRAVITY],
        )
    )
    if mesh.added_mass[i] > 0:
        water = np.zeros((6, 6))
        water[FORE, FORE] = water[SIDE, SIDE] = mesh.added_mass[i]
        system.AddObject(itemInterface.ObjectGenericODE2(nodeNumbers=[node], massMatrix=water))
    return node, number


def add_beam(system: Any, mesh: Mesh, i: int, bodies: tuple[Any, ...]) -> Any:
    """Spring and damper of element i at its middle."""
    half = mesh.length[i] / 2
    low, high = (
        system.AddMarker(
            itemInterface.MarkerBodyRigid(bodyNumber=bodies[k], localPosition=[0, 0, arm])
        )
        for k, arm in ((i, half), (i + 1, -half))
    )
    length, bending = mesh.length[i], mesh.bending[i]
    shear = 12 * bending / length**3
    stiffness = np.diag(
        [
            *(shear, shear, mesh.axial[i] / length),
            *(bending / length, bending / length, mesh.torsion[i] / length),
        ]
    )
    return system.AddObject(
        itemInterface.RigidBodySpringDamper(
            markerNumbers=[low, high],
            stiffness=stiffness,
            damping=JOINT_DAMPING_TIME * stiffness,
            useIntrinsicFormulation=True,
        )
    )


def add_soil(system: Any, mesh: Mesh, nodes: tuple[Any, ...], ground: Any) -> Any:
    """p-y springs with dashpots, and the springs at the toe; the law of the p-y springs."""
    law = CreateSymbolicUserFunction(
        system,
        function=soil_spring_force,
        userFunctionName="springForceUserFunction",
        itemTypeName="ObjectConnectorCoordinateSpringDamper",
    )
    for i, stiffness in enumerate(mesh.soil_stiffness):
        for coordinate in (FORE, SIDE):
            add_spring(system, ground, nodes[i], coordinate, stiffness, DASHPOT_TIME, law)
    add_spring(system, ground, nodes[0], UP, TOE_VERTICAL_STIFFNESS, 0.0, 0)
    add_spring(system, ground, nodes[0], TWIST, TOE_TORSIONAL_STIFFNESS, 0.0, 0)
    return law


def soil_spring_force(
    mbs: Any,
    t: Any,
    itemNumber: Any,  # noqa: N803
    u: Any,
    v: Any,
    k: Any,
    d: Any,
    offset: Any,
) -> Any:
    """Force of spring and dashpot; names and order are Exudyn's."""
    return k * SOIL_DISPLACEMENT * exudyn.symbolic.tanh(u / SOIL_DISPLACEMENT) + d * v


def add_spring(
    system: Any,
    ground: Any,
    node: Any,
    coordinate: int,
    stiffness: float,
    damping_time: float,
    law: Any,
) -> None:
    """Spring of one coordinate of a node to the ground; law 0 is linear."""
    marker = system.AddMarker(
        itemInterface.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate)
    )
    system.AddObject(
        itemInterface.CoordinateSpringDamper(
            markerNumbers=[ground, marker],
            stiffness=stiffness,
            damping=damping_time * stiffness,
            springForceUserFunction=law,
        )
    )


def add_force(system: Any, top: Any) -> None:
    """Tower-top force, which does not act while gravity is solved for."""

    def force(mbs: Any, t: float, load: Any) -> list[float]:
        return [tower_top_force(t) if mbs.variables["loaded"] else 0.0, 0.0, 0.0]

    system.AddLoad(
        itemInterface.LoadForceVector(
            markerNumber=system.AddMarker(
                itemInterface.MarkerBodyPosition(bodyNumber=top, localPosition=[0, 0, 0])
            ),
            loadVectorUserFunction=force,
        )
    )


def solve_gravity(model: Model) -> None:
    """Equilibrium under gravity, from which the transient starts."""
    settings = quiet_settings()
    settings.staticSolver.numberOfLoadSteps = 1
    if not model.system.SolveStatic(settings, updateInitialValues=True):
        raise RuntimeError("Exudyn found no equilibrium under gravity")


def first_frequency(model: Model) -> float:
    """Frequency in Hz of the first mode that moves the yaw bearing fore-aft."""
    squares, vectors = model.system.ComputeODE2Eigenvalues()
    start = model.system.GetNodeODE2Index(model.top_node)
    order = np.argsort(np.real(squares))
    for mode in order[:4]:
        shape = np.abs(vectors[start : start + 2, mode])
        if shape[FORE] > shape[SIDE]:
            return float(np.sqrt(np.real(squares[mode])) / (2 * np.pi))
    raise RuntimeError("no fore-aft mode among the first four")


def add_sensors(system: Any, springs: tuple[Any, ...], mesh: Mesh) -> list[Any]:
    """Torque in every element's middle, and last the force in the first one above the mudline."""
    torque, force = exudyn.OutputVariableType.TorqueLocal, exudyn.OutputVariableType.ForceLocal
    wanted = [(spring, torque) for spring in springs]
    wanted.append((springs[mesh.mudline_element], force))
    return [
        system.AddSensor(
            itemInterface.SensorObject(
                objectNumber=spring, outputVariableType=kind, storeInternal=True
            )
        )
        for spring, kind in wanted
    ]


def quiet_settings() -> Any:
    settings = exudyn.SimulationSettings()
    settings.linearSolverType = exudyn.LinearSolverType.EigenSparse
    settings.parallel.numberOfThreads = 1
    settings.solutionSettings.writeSolutionToFile = False
    settings.displayComputationTime = False
    return settings


def transient_settings(steps: int, duration: float, interval: float) -> Any:
    """Fixed steps, generalised-alpha, sensors every interval s."""
    settings = quiet_settings()
    settings.solutionSettings.sensorsWritePeriod = interval
    integration = settings.timeIntegration
    integration.numberOfSteps = steps
    integration.endTime = duration
    integration.adaptiveStep = False
    integration.generalizedAlpha.spectralRadius = SPECTRAL_RADIUS
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance = RELATIVE_TOLERANCE
    integration.newton.absoluteTolerance = ABSOLUTE_TOLERANCE
    return settings
