"""Problem P in MuJoCo: the package's chain as MJCF, with joint springs and soil as outer forces.

A body has three hinges at the middle of the element below it, with stiffness and damping. Soil
springs act as forces at the positions of each step, set between MuJoCo's two halves of a step;
dashpots are velocity actuators at the nodes, which the integrator treats implicitly. Added mass is
part of the body at its node and its weight is compensated, which leaves it too much inertia along
the axis, where nothing moves.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from problem import (
    GRAVITY,
    Array,
    Mesh,
    PeerRun,
    build_mesh,
    output_stride,
    soil_force,
    step_count,
    stopwatch,
    tower_top_force,
)
from problem_p import JOINT_DAMPING_TIME, TOE_TORSIONAL_STIFFNESS, TOE_VERTICAL_STIFFNESS
from scipy.linalg import eigh

from offwind_pin.definitions.rotor_nacelle import RigidBody

INTEGRATOR = "implicitfast"
ROOT = 6
GRAVITY_TOLERANCE = 1e-9


def run(dt: float, duration: float) -> PeerRun:
    """Problem P with steps of dt s.

    Raises
    ------
    RuntimeError : the motion grows without bound, or no equilibrium is found
    """
    mesh = build_mesh()
    steps = step_count(dt, duration)
    stride = output_stride(dt)
    model = mujoco.MjModel.from_xml_string(write_mjcf(mesh, dt))
    data = mujoco.MjData(model)
    soil = SoilSprings(model, mesh)
    tangent = solve_gravity(model, data, soil)
    frequency = first_frequency(model, data, tangent)
    pitch = np.arange(ROOT + 1, model.nv, 3)
    stiffness = mesh.bending / mesh.length
    section = np.empty((steps // stride + 1, mesh.elements))
    section[0] = stiffness * data.qpos[pitch]
    start_half_a_step_back(model, data, dt)
    with stopwatch() as spent:
        for step in range(steps):
            mujoco.mj_step1(model, data)
            soil.apply(data)
            push(data, tower_top_force(step * dt))
            mujoco.mj_step2(model, data)
            if (step + 1) % stride == 0:
                moment = stiffness * (data.qpos[pitch] + JOINT_DAMPING_TIME * data.qvel[pitch])
                section[(step + 1) // stride] = moment
    if data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number or np.abs(section).max() > 1e10:
        raise RuntimeError(f"MuJoCo is unstable with dt {dt} s")
    first = mesh.mudline_element
    slope = (section[:, first] - section[:, first + 1]) / mesh.length[first]
    return PeerRun(
        code="mujoco_chain",
        version=mujoco.mj_versionString(),
        dt=dt,
        steps=steps,
        wall_s=spent.wall_s,
        cpu_s=spent.cpu_s,
        time=np.arange(len(section), dtype=float) * stride * dt,
        seabed_moment=section[:, first] + slope * mesh.length[first] / 2,
        section_moment=section,
        section_place="middle",
        frequency_hz=frequency,
        notes={
            "integrator": INTEGRATOR,
            "soil": "springs explicit, in Python once a step; dashpots as implicit actuators",
            "moment": "spring and damper; the seabed's from the two elements above it",
        },
    )


def write_mjcf(mesh: Mesh, dt: float) -> str:
    """MJCF text of the chain for one step size."""
    lines = [
        '<mujoco><compiler angle="radian" boundmass="0" boundinertia="0"/>',
        f'<option timestep="{dt!r}" gravity="0 0 {-GRAVITY}" integrator="{INTEGRATOR}">',
        '<flag contact="disable" constraint="disable"/></option>',
        "<worldbody>",
    ]
    lines += [f'<site name="g{i}" pos="0 0 {float(mesh.height[i])!r}"/>' for i in range(mesh.soil)]
    for i in range(mesh.elements + 1):
        lines += open_body(mesh, i)
    lines += ["</body>"] * (mesh.elements + 1) + ["</worldbody>", "<actuator>"]
    for i, dashpot in enumerate(mesh.soil_dashpot):
        lines += [
            f'<general site="s{i}" refsite="g{i}" gear="{gear} 0 0 0 0" gainprm="0" '
            f'biastype="affine" biasprm="0 0 {-float(dashpot)!r}"/>'
            for gear in ("1 0", "0 1")
        ]
    return "\n".join([*lines, "</actuator></mujoco>"])


def open_body(mesh: Mesh, i: int) -> list[str]:
    """Body i with its joints, up to where the next one begins; its frame is the joints' place."""
    origin = mesh.chain.origin
    z = origin[i]
    place = z - origin[i - 1] if i else z
    axial = mesh.body[i]
    body = RigidBody(axial.mass, np.array([0.0, 0.0, axial.center]), axial.inertia())
    if i == mesh.elements:
        raised = mesh.rna.center_of_mass + np.array([0.0, 0.0, mesh.height[-1]])
        body = RigidBody.combine([body, RigidBody(mesh.rna.mass, raised, mesh.rna.inertia)])
    compensated = 0.0
    if water := mesh.added_mass[i]:
        point = RigidBody(water, np.array([0.0, 0.0, mesh.height[i]]), np.zeros((3, 3)))
        body = RigidBody.combine([body, point])
        compensated = water / body.mass
    x, y, center = body.center_of_mass - np.array([0.0, 0.0, z])
    inertia = " ".join(
        repr(float(body.inertia[k])) for k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    )
    lines = [f'<body name="b{i}" pos="0 0 {float(place)!r}" gravcomp="{float(compensated)!r}">']
    lines += joints(mesh, i)
    lines.append(
        f'<inertial pos="{float(x)!r} {float(y)!r} {float(center)!r}" mass="{float(body.mass)!r}" '
        f'fullinertia="{inertia}"/>'
    )
    if i < mesh.soil or i == mesh.elements:
        lines.append(f'<site name="s{i}" pos="0 0 {float(mesh.height[i] - z)!r}"/>')
    return lines


def joints(mesh: Mesh, i: int) -> list[str]:
    """Three hinges of body i; the lowest body has six joints, held where the toe has springs."""
    axes = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
    if i == 0:
        held = {("slide", "z"): TOE_VERTICAL_STIFFNESS, ("hinge", "z"): TOE_TORSIONAL_STIFFNESS}
        return [
            f'<joint type="{kind}" axis="{axis}" stiffness="{held.get((kind, name), 0.0)}"/>'
            for kind in ("slide", "hinge")
            for name, axis in axes.items()
        ]
    bending, torsion = (k[i - 1] / mesh.length[i - 1] for k in (mesh.bending, mesh.torsion))
    return [
        f'<joint type="hinge" axis="{axis}" stiffness="{float(stiffness)!r}" '
        f'damping="{float(JOINT_DAMPING_TIME * stiffness)!r}"/>'
        for axis, stiffness in zip(axes.values(), (bending, bending, torsion), strict=True)
    ]


class SoilSprings:
    """Forces of the p-y springs on the bodies of the embedded pile."""

    def __init__(self, model: mujoco.MjModel, mesh: Mesh) -> None:
        self.stiffness = mesh.soil_stiffness[:, None]
        self.site = np.array([model.site(f"s{i}").id for i in range(mesh.soil)])
        self.body = model.site_bodyid[self.site]

    def apply(self, data: mujoco.MjData) -> None:
        """Set the outer forces to the springs' at the positions last computed."""
        place = data.site_xpos[self.site]
        force = -soil_force(place[:, :2], self.stiffness)
        arm = place - data.xipos[self.body]
        outer = data.xfrc_applied
        outer[self.body, :2] = force
        outer[self.body, 3] = -arm[:, 2] * force[:, 1]
        outer[self.body, 4] = arm[:, 2] * force[:, 0]
        outer[self.body, 5] = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]


def push(data: mujoco.MjData, force: float) -> None:
    """Fore-aft force in N at the yaw bearing: the last site, on the last body."""
    top = len(data.xipos) - 1
    arm = data.site_xpos[-1] - data.xipos[top]
    data.xfrc_applied[top, 0] = force
    data.xfrc_applied[top, 4] = arm[2] * force
    data.xfrc_applied[top, 5] = -arm[1] * force


def start_half_a_step_back(model: mujoco.MjModel, data: mujoco.MjData, dt: float) -> None:
    """Set the velocities to those half a step before t = 0, under the force that acts from then on.

    The integrator is a leapfrog with velocities between the steps; started with those at t = 0 it
    would be out by half a step, a first-order error.
    """
    push(data, tower_top_force(0.0))
    mujoco.mj_forward(model, data)
    data.qvel[:] = -dt / 2 * data.qacc


def solve_gravity(model: mujoco.MjModel, data: mujoco.MjData, soil: SoilSprings) -> Array:
    """Newton's method for the equilibrium; its last tangent stiffness (nv, nv), by differences."""
    tangent = np.zeros((model.nv, model.nv))
    weight = GRAVITY * float(model.body_mass.sum())
    for _ in range(20):
        residual = unbalance(model, data, soil)
        base = data.qpos.copy()
        for k in range(model.nv):
            size = 1e-6
            data.qpos[k] = base[k] + size
            tangent[:, k] = (unbalance(model, data, soil) - residual) / size
            data.qpos[k] = base[k]
        if np.abs(residual).max() < GRAVITY_TOLERANCE * weight:
            unbalance(model, data, soil)
            return tangent
        data.qpos[:] = base - np.linalg.solve(tangent, residual)
    raise RuntimeError("MuJoCo's model found no equilibrium under gravity")


def unbalance(model: mujoco.MjModel, data: mujoco.MjData, soil: SoilSprings) -> Array:
    """(nv,) generalised forces that are missing for equilibrium at rest, in N and N m."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    soil.apply(data)
    mujoco.mj_forward(model, data)
    return -np.array(data.qfrc_smooth)


def first_frequency(model: mujoco.MjModel, data: mujoco.MjData, tangent: Array) -> float:
    """Frequency in Hz of the first mode in which the bodies pitch rather than roll."""
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    squares, shapes = eigh((tangent + tangent.T) / 2, mass, subset_by_index=[0, 3])
    for value, shape in zip(squares, shapes.T, strict=True):
        hinges: Any = np.abs(shape[ROOT:]).reshape(-1, 3).sum(axis=0)
        if hinges[1] > hinges[0]:
            return float(np.sqrt(value) / (2 * np.pi))
    raise RuntimeError("no fore-aft mode among the first four")
