"""Other programs, where they are installed."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from offwind_pin.analysis.build import build
from offwind_pin.dynamics.system import System
from offwind_pin.structure.urdf import write_urdf
from offwind_pin.turbines.base import Array
from offwind_pin.turbines.reader import load_turbine

_OPTIONS = (
    '<mujoco><compiler boundmass="1e-9" boundinertia="1e-9" balanceinertia="false" '
    'discardvisual="true"/></mujoco>'
)
"""MuJoCo gives every body some mass; what massless links get is far below rounding."""


@cache
def _mujoco(foundation: str) -> tuple[float, float]:
    """Largest differences of mass matrix and bias forces in a bent, moving state, over the largest.

    MuJoCo reads the URDF that Pinocchio runs.
    """
    import mujoco

    system = build(load_turbine("oc6_phase2"), foundation)
    text = write_urdf(system.turbine, system.chain)
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
    """The same without springs, dampers and soil, of which a URDF says nothing."""
    nothing = np.zeros(system.nv)
    free = replace(system.foundation, root=None, soil=())
    return replace(system, foundation=free, joint_stiffness=nothing, joint_damping=nothing)


def _off(found: Array, ours: Array) -> float:
    return float(np.abs(found - ours).max() / np.abs(ours).max())


def mujoco_mass_matrix(foundation: str) -> float:
    return _mujoco(foundation)[0]


def mujoco_bias_forces(foundation: str) -> float:
    return _mujoco(foundation)[1]
