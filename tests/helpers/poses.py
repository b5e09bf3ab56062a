"""Where the rigid bodies of a system are, by Pinocchio."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.system import System


def body_poses(system: System, q: Array) -> Array:
    """Poses of the rigid bodies for joint displacements ``q``, by Pinocchio's forward kinematics.

    Body 0 has its frame at the base, the others at the joints below them; z points up along the
    axis. The rotor-nacelle assembly is fixed to the last body, ``chain.top - chain.origin[-1]``
    above its frame.

    Parameters
    ----------
    q : (nv,) array, m and rad
        Joint displacements.

    Returns
    -------
    (N + 1, 4, 4) array
        Homogeneous transforms from body to inertial axes, lengths in m.
    """
    import pinocchio as pin

    chain, data = system.chain, system.scratch.data
    pin.forwardKinematics(system.pin_model, data, q)
    joints = chain.roots + len(chain.node_joints) * np.arange(chain.elements + 1)
    poses = np.array([data.oMi[int(joint)].homogeneous for joint in joints])
    if not chain.free_root:
        poses[0, 2, 3] = chain.base
    return poses
