"""Linear equations of motion about a static state by Pinocchio, as dense matrices."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.reference.equations import Equations
from offwind_pin.solvers.eigen import natural_modes


class DensePencil:
    """Mass, damping and stiffness of small motions about joint displacements at rest."""

    def __init__(self, equations: Equations, q: Array) -> None:
        self._equations = equations
        self._q = q
        self._stiffness, self._damping = equations.tangents(0.0, q, np.zeros_like(q))
        self._mass = equations.mass(q)

    def lowest(self, count: int) -> tuple[Array, Array]:
        """(count,) squared angular frequencies in order; (nv, count) mass-normalised modes."""
        return natural_modes(self._stiffness, self._mass, count)

    def stiffness_times(self, vectors: Array) -> Array:
        """(nv, n) product with vectors (nv, n)."""
        return np.asarray(self._stiffness @ vectors)

    def damping_times(self, vectors: Array) -> Array:
        """(nv, n) product with vectors (nv, n)."""
        return np.asarray(self._damping @ vectors)

    def dissipation(self, vectors: Array) -> Array:
        """(L + 1, n) power that each load and, last, the root dissipates at velocities (nv, n)."""
        return self._equations.dissipation(self._q, vectors)

    def axis_shape(self, vector: Array, height: Array) -> Array:
        """(m, 6) displacement and rotation of the axis at heights (m,) per unit of a vector."""
        motion = self._equations.chain_motion(self._q, vector)
        body = self._equations.chain.body_at(height)
        points = motion.points_at(height)
        return np.concatenate([points.velocity, motion.twist[body, 3:]], axis=1)
