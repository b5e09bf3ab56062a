"""Spatial vectors: six numbers for the motion of a body or the force on it, the angular part first.

R. Featherstone, Rigid Body Dynamics Algorithms (Springer, 2008), chapter 2. SI units: motions in
rad/s over m/s, forces in N m over N, both seen from the origin of the frame they are given in.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def skew(r: Array) -> Array:
    """(3, 3) matrix r x, so that skew(r) @ s is the cross product of r and s."""
    x, y, z = r.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def plucker_transform(rotation: Array, origin: Array) -> Array:
    """(6, 6) transform of motions from frame A to frame B: [[E, 0], [-E r x, E]].

    ``rotation`` is E, from A's coordinates to B's; ``origin`` is r, B's origin in A's coordinates
    in m. Its transpose takes forces from B to A.
    """
    transform = np.zeros((6, 6))
    transform[:3, :3] = transform[3:, 3:] = rotation
    transform[3:, :3] = -rotation @ skew(origin)
    return transform


def cross_motion(motion: Array) -> Array:
    """(6, 6) matrix v x on motions: [[w x, 0], [v_O x, w x]]."""
    a, b, c, x, y, z = motion.tolist()
    return np.array(
        [
            [0.0, -c, b, 0.0, 0.0, 0.0],
            [c, 0.0, -a, 0.0, 0.0, 0.0],
            [-b, a, 0.0, 0.0, 0.0, 0.0],
            [0.0, -z, y, 0.0, -c, b],
            [z, 0.0, -x, c, 0.0, -a],
            [-y, x, 0.0, -b, a, 0.0],
        ]
    )


def cross_force(motion: Array) -> Array:
    """(6, 6) matrix v x* on forces, the negative transpose of v x."""
    return -cross_motion(motion).T


def rigid_body_inertia(mass: float, center_of_mass: Array, inertia: Array) -> Array:
    """(6, 6) inertia of a body: [[I_c + m c x c x^T, m c x], [m c x^T, m 1]].

    ``mass`` in kg, ``center_of_mass`` c in m, ``inertia`` I_c (3, 3) about it in kg m^2.
    """
    cx = skew(center_of_mass)
    return np.block([[inertia + mass * cx @ cx.T, mass * cx], [mass * cx.T, mass * np.eye(3)]])
