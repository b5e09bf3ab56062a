"""Other programs, where they are installed."""

from __future__ import annotations

import itertools
from dataclasses import replace
from functools import cache

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.analysis.modal import modes
from offwind_pin.base.definition import Array
from offwind_pin.definitions.reader import load_turbine
from offwind_pin.definitions.rotor_nacelle import RigidBody, lump_rna, point_inertia
from offwind_pin.definitions.turbine import RigidBodyRNA
from offwind_pin.dynamics.system import System
from offwind_pin.structure.section import diameter_and_thickness
from offwind_pin.structure.urdf import urdf_text
from offwind_pin.verification.ledger import Found

_OPTIONS = (
    '<mujoco><compiler boundmass="1e-9" boundinertia="1e-9" balanceinertia="false" '
    'discardvisual="true"/></mujoco>'
)
"""MuJoCo gives every body some mass; that of massless links is far below rounding."""


@cache
def _mujoco(foundation: str) -> tuple[float, float]:
    """Largest differences of mass matrix and bias forces in a bent, moving state, over the largest.

    MuJoCo reads the URDF that Pinocchio uses.
    """
    import mujoco

    system = build(load_turbine("oc6_phase2"), foundation)
    text = urdf_text(system.turbine, system.chain)
    text = text.replace('<link name="world" />', f'{_OPTIONS}<link name="world" />', 1)
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.gravity[:] = [0.0, 0.0, -system.turbine.site.gravity]
    data = mujoco.MjData(model)
    q, v = np.random.default_rng(7).uniform(-0.02, 0.02, (2, system.nv))
    data.qpos[:], data.qvel[:] = q, v
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    equations = _rigid_bodies(system).equations()
    bias = equations.residual(0.0, q, v, np.zeros(system.nv))
    return _off(mass, equations.mass(q)), _off(np.array(data.qfrc_bias), bias)


def _rigid_bodies(system: System) -> System:
    """The same without springs, dampers and soil, which a URDF does not contain."""
    nothing = np.zeros(system.nv)
    free = replace(system.foundation, root=None, soil=())
    return replace(
        system,
        foundation=free,
        joint_stiffness=nothing,
        joint_damping=nothing,
        structural_loads=(),
    )


def _off(found: Array, ours: Array) -> float:
    return float(np.abs(found - ours).max() / np.abs(ours).max())


@cache
def _weightless() -> System:
    """The benchmark clamped and dry, without weight and damping, in 90 elements."""
    turbine = load_turbine("oc6_phase2")
    site = turbine.site.model_copy(update={"gravity": 1e-9})
    bare = turbine.model_copy(update={"site": site, "structural_damping": None})
    return build(bare, "clamped", elements=90)


def _ours(mode: str, system: System) -> float:
    found = modes(system, 6)
    return float(found.frequency_hz[found.index(mode)])


@cache
def _opensees() -> Array:
    """(6,) frequencies in Hz of the benchmark in OpenSees: 140 elastic beams, consistent mass.

    The assembly's products of inertia, which OpenSees does not take, are left out; they do not
    act fore-aft.
    """
    import openseespy.opensees as ops

    turbine = _weightless().turbine
    rna = lump_rna(turbine.rna)
    monopile, tower = turbine.members
    height = np.concatenate(
        [
            np.linspace(turbine.site.mudline, monopile.top, 41),
            np.linspace(tower.bottom, tower.top, 101)[1:],
        ]
    )
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i, z in enumerate(height):
        ops.node(i, 0.0, 0.0, float(z))
    ops.fix(0, 1, 1, 1, 1, 1, 1)
    ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)
    for i, (low, high) in enumerate(itertools.pairwise(height)):
        middle = np.array([(low + high) / 2])
        member = monopile if middle[0] < monopile.top else tower
        steel = turbine.materials[member.material]
        outer, wall = (float(size[0]) for size in diameter_and_thickness(member, middle))
        area = np.pi * (outer - wall) * wall
        inertia = np.pi / 64 * (outer**4 - (outer - 2 * wall) ** 4)
        section = (area, steel.youngs_modulus, steel.shear_modulus, 2 * inertia, inertia, inertia)
        mass = ("-mass", steel.density * area, "-cMass")
        ops.element("elasticBeamColumn", i, i, i + 1, *section, 1, *mass)
    top, (x, y, z) = len(height), rna.center_of_mass
    ops.node(top, float(x), float(y), float(turbine.yaw_bearing + z))
    ops.rigidLink("beam", top - 1, top)
    ops.mass(top, rna.mass, rna.mass, rna.mass, *np.diag(rna.inertia).tolist())
    squares = np.array(ops.eigen("-genBandArpack", 6))
    ops.wipe()
    return np.asarray(np.sqrt(squares) / (2 * np.pi))


def opensees_frequency(mode: str) -> Found:
    """In Hz, ours and the nearest one of OpenSees."""
    ours = _ours(mode, _weightless())
    theirs = _opensees()
    return Found(ours, float(theirs[np.argmin(np.abs(theirs - ours))]))


@cache
def _exudyn() -> Array:
    """(6,) frequencies in Hz of the chain's bodies in Exudyn, connected by stiff springs."""
    import exudyn
    from exudyn import itemInterface

    system = _weightless()
    chain = system.chain
    model = exudyn.SystemContainer().AddSystem()
    ground = model.AddObject(itemInterface.ObjectGround())
    below, at = ground, 0.0
    for k, (part, place) in enumerate(zip(chain.body, chain.origin, strict=True)):
        body = RigidBody(part.mass, np.array([0.0, 0.0, part.center - place]), part.inertia())
        if k == chain.elements:
            rna = chain.rna
            lift = np.array([0.0, 0.0, chain.top - place])
            shifted = RigidBody(rna.mass, rna.center_of_mass + lift, rna.inertia)
            body = RigidBody.combine([body, shifted])
        tensor = body.inertia + point_inertia(body.mass, body.center_of_mass)
        pairs = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
        start = [0.0, 0.0, float(place), 0.0, 0.0, 0.0]
        node = model.AddNode(itemInterface.NodeRigidBodyRxyz(referenceCoordinates=start))
        number = model.AddObject(
            itemInterface.ObjectRigidBody(
                nodeNumber=node,
                physicsMass=body.mass,
                physicsInertia=[float(tensor[pair]) for pair in pairs],
                physicsCenterOfMass=body.center_of_mass.tolist(),
            )
        )
        turning = [_RIGID * 10] * 3 if k == 0 else chain.joint_stiffness[k - 1].tolist()
        ends = ((below, float(place) - at), (number, 0.0))
        markers = [
            model.AddMarker(
                itemInterface.MarkerBodyRigid(bodyNumber=end, localPosition=[0.0, 0.0, arm])
            )
            for end, arm in ends
        ]
        stiffness = np.diag([_RIGID] * 3 + turning)
        model.AddObject(
            itemInterface.RigidBodySpringDamper(markerNumbers=markers, stiffness=stiffness)
        )
        below, at = number, float(place)
    model.Assemble()
    squares, _ = model.ComputeODE2Eigenvalues()
    return np.sqrt(np.sort(np.real(squares))[:6]) / (2 * np.pi)


_RIGID = 1e14
"""N/m of the springs that connect Exudyn's bodies at a joint: stiff compared with the structure's
1e10."""


def exudyn_frequency(mode: str) -> Found:
    """In Hz, ours and the nearest one of Exudyn."""
    ours = _ours(mode, _weightless())
    theirs = _exudyn()
    return Found(ours, float(theirs[np.argmin(np.abs(theirs - ours))]))


@cache
def _point_top() -> System:
    """The weightless benchmark with the assembly's mass at a point of the yaw bearing."""
    system = _weightless()
    point = RigidBodyRNA.model_validate(
        {
            "kind": "rigid_body",
            "mass": float(system.chain.rna.mass),
            "center_of_mass": (0.0, 0.0, 0.0),
            "inertia": np.diag([1.0, 1.0, 1.0]).tolist(),
        }
    )
    return build(system.turbine.model_copy(update={"rna": point}), "clamped", elements=90)


@cache
def _pybmodes() -> Array:
    """(8,) frequencies in Hz of the benchmark with a point mass on top in pyBModes."""
    from pybmodes.models import Tower

    system = _point_top()
    turbine, steel = system.turbine, system.turbine.materials["steel"]
    mudline, length = turbine.site.mudline, turbine.yaw_bearing - turbine.site.mudline
    grid, outer, wall = [], [], []
    for member in turbine.members:
        # just above the station below, whose section ends there
        low = mudline if member.bottom <= mudline else member.bottom + 1e-6
        stations = [station.z for station in member.stations if station.z > low]
        height = np.unique(np.concatenate([np.arange(low, member.top), stations]))
        diameter, thickness = diameter_and_thickness(member, height)
        grid += ((height - mudline) / length).tolist()
        outer += diameter.tolist()
        wall += thickness.tolist()
    tower = Tower.from_geometry(
        grid,
        outer,
        wall,
        flexible_length=length,
        E=steel.youngs_modulus,
        rho=steel.density,
        nu=steel.youngs_modulus / (2 * steel.shear_modulus) - 1,
        tip_mass=float(system.chain.rna.mass),
    )
    return np.asarray(tower.run(n_modes=8).frequencies)


def pybmodes_frequency(mode: str) -> Found:
    """In Hz, ours and the nearest one of pyBModes."""
    ours = _ours(mode, _point_top())
    theirs = _pybmodes()
    return Found(ours, float(theirs[np.argmin(np.abs(theirs - ours))]))


def mujoco_mass_matrix(foundation: str) -> float:
    return _mujoco(foundation)[0]


def mujoco_bias_forces(foundation: str) -> float:
    return _mujoco(foundation)[1]
