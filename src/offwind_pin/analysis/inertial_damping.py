"""Structural damping by modes and by mass, which acts between structure and inertial frame."""

from __future__ import annotations

import numpy as np

from offwind_pin.analysis.modal import ModalResult
from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.pencil import CompiledPencil
from offwind_pin.loads.point_load import PointMotion
from offwind_pin.loads.structural.coupled_damping import CoupledDamping
from offwind_pin.loads.structural.mass_damping import MassDamping
from offwind_pin.structure.chain import Chain


def modal_load(
    result: ModalResult, linear: CompiledPencil, chain: Chain, gain: Array
) -> CoupledDamping:
    """The load whose generalised force is -M Phi G Phi' M v.

    The inertia forces of the mode shapes, body by body, take the place of joint moments: so the
    load is in equilibrium with section loads and known to the ledger of energies.

    Parameters
    ----------
    result : ModalResult
        k modes.
    linear : CompiledPencil
        Equations of motion about the same state.
    chain : Chain
        Of the same system.
    gain : (k, k) array, 1/s
        G; symmetric.
    """
    rate, turn = np.linalg.eigh(gain)
    vectors = result.vector @ turn
    height = _body_heights(chain)
    position = linear.position(height)
    wrench = np.zeros((len(rate), len(height), 6))
    for i, vector in enumerate(vectors.T):
        bodies, rna = linear.inertia_wrenches(vector)
        wrench[i] = np.vstack([bodies, rna])
    wrench[..., 3:] -= np.cross(position, wrench[..., :3])
    moving = slice(0 if chain.free_root else 1, None)
    return CoupledDamping("modal damping", height[moving], wrench[:, moving], rate)


def mass_loads(chain: Chain, alpha: float) -> tuple[MassDamping, CoupledDamping]:
    """Damping alpha M of the bodies, and of the rotor-nacelle assembly, undeformed.

    Parameters
    ----------
    alpha : float, 1/s
    """
    height = _body_heights(chain)[:-1]
    rows = [[body.mass] * 3 + [body.transverse] * 2 + [body.axial] for body in chain.body]
    x, y, z = chain.rna.center_of_mass
    across = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    shift = np.hstack([np.eye(3), across])  # velocity of the centre from that of the yaw bearing
    inertia = chain.rna.mass * shift.T @ shift
    inertia[3:, 3:] += chain.rna.inertia
    mass, axes = np.linalg.eigh(inertia)
    name = "mass-proportional damping"
    return (
        MassDamping(name, height, alpha * np.array(rows)),
        CoupledDamping(
            f"{name} of the rotor-nacelle assembly",
            np.array([chain.top]),
            axes.T[:, None],
            alpha * mass,
        ),
    )


def mass_ratios(result: ModalResult, linear: CompiledPencil, chain: Chain) -> Array:
    """(n,) damping ratios of modes for alpha = 1/s."""
    loads = mass_loads(chain, 1.0)
    power = np.zeros(len(result.label))
    for i, vector in enumerate(result.vector.T):
        for load in loads:
            rate = linear.axis_shape(vector, load.height)
            still = np.zeros((len(rate), 3))
            motion = PointMotion(still, still, rate[:, :3], still, angular_velocity=rate[:, 3:])
            power[i] += load.forces(0.0, motion, 0.0).dissipation
    return np.asarray(power / (4 * np.pi * result.frequency_hz))


def _body_heights(chain: Chain) -> Array:
    """(N + 2,) heights of the bodies' centres of mass, and of the yaw bearing, in m."""
    return np.array([*(body.center for body in chain.body), chain.top])
