"""MuJoCo, an independent rigid-body code, reads the shipped URDF and finds the same dynamics."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from helpers.dampers import several

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.structure.urdf import urdf_text

SHIPPED = Path(__file__).resolve().parents[2] / "urdf"

# MuJoCo gives every body some mass; what it gives to the massless links between joints is far
# below rounding beside bodies of tens of tonnes.
OPTIONS = (
    '<mujoco><compiler boundmass="1e-9" boundinertia="1e-9" balanceinertia="false" '
    'discardvisual="true"/></mujoco>'
)


def _mass_and_bias(foundation: str, q: Array, v: Array) -> tuple[list[str], Array, Array]:
    """Joint names, mass matrix (nv, nv) and bias forces (nv,) as MuJoCo computes them."""
    path = SHIPPED / f"oc6_phase2_{foundation}" / "oc6_phase2.urdf"
    return _by_mujoco(path.read_text(), q, v)


def _by_mujoco(urdf: str, q: Array, v: Array) -> tuple[list[str], Array, Array]:
    """The same of a URDF text, q and v in the order in which MuJoCo reads its joints."""
    text = urdf.replace('<link name="world" />', f'{OPTIONS}<link name="world" />', 1)
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.gravity[:] = [0.0, 0.0, -9.80665]
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = q, v
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    names = [model.joint(i).name for i in range(model.njnt)]
    return names, mass, np.array(data.qfrc_bias)


@pytest.mark.parametrize("foundation", ["clamped", "distributed_springs"])
def test_mass_matrix_and_bias_forces(foundation: str, oc6: ow.Turbine) -> None:
    """Mass matrix, and gravity with Coriolis and centrifugal forces, in a bent and moving state."""
    system = ow.build(oc6, foundation)
    rng = np.random.default_rng(7)
    q, v = rng.uniform(-0.02, 0.02, (2, system.nv))
    names, mass, bias = _mass_and_bias(foundation, q, v)
    assert tuple(names) == system.chain.joint_name
    data = system.scratch.data
    upper = np.triu(pin.crba(system.pin_model, data, q))
    ours = upper + np.triu(upper, 1).T
    assert np.abs(mass - ours).max() < 1e-12 * np.abs(ours).max()
    expected = pin.rnea(system.pin_model, data, q, v, np.zeros(system.nv))
    assert np.abs(bias - expected).max() < 1e-12 * np.abs(expected).max()


def test_tuned_mass_dampers(undamped: ow.Turbine) -> None:
    """The same of a model with dampers, whose joints MuJoCo may read in another order."""
    system = ow.build(several(undamped), "distributed_springs", elements=10)
    text, names = urdf_text(system.turbine, system.chain), system.chain.joint_name
    rng = np.random.default_rng(9)
    q, v = rng.uniform(-0.02, 0.02, (2, system.nv))
    theirs = _by_mujoco(text, np.zeros(system.nv), np.zeros(system.nv))[0]
    order = np.array([names.index(name) for name in theirs])
    _, mass, bias = _by_mujoco(text, q[order], v[order])
    assert sorted(theirs) == sorted(names)
    data = system.scratch.data
    upper = np.triu(pin.crba(system.pin_model, data, q))
    ours = (upper + np.triu(upper, 1).T)[np.ix_(order, order)]
    assert np.abs(mass - ours).max() < 1e-12 * np.abs(ours).max()
    expected = pin.rnea(system.pin_model, data, q, v, np.zeros(system.nv))[order]
    assert np.abs(bias - expected).max() < 1e-12 * np.abs(expected).max()
    sliding = np.flatnonzero(order >= system.chain.axis_joints)
    assert np.abs(bias - expected)[sliding].max() < 1e-9 * np.abs(expected[sliding]).max()


def test_another_state_has_another_mass_matrix(oc6: ow.Turbine) -> None:
    """Negative control: the comparison sees a bend of a hundredth of a radian."""
    still, bent = np.zeros((2, ow.build(oc6, "clamped").nv))
    bent[3] = 0.01
    first, second = (_mass_and_bias("clamped", q, np.zeros_like(q))[1] for q in (still, bent))
    assert np.abs(first - second).max() > 1e-6 * np.abs(first).max()
