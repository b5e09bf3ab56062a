"""A system under loads by Pinocchio, for Newton's method and generalised-alpha.

Counterpart of :class:`offwind_pin.dynamics.compiled.chain.CompiledChain`, with dense matrices.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.reference.equations import Equations
from offwind_pin.dynamics.reference.section_loads import section_loads
from offwind_pin.dynamics.resting_axis import RestingAxis


class DenseChain:
    """Residual and exact iteration matrix of a system under loads.

    Of the time inputs only the first, the time, is used.
    """

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        nv = equations.system.nv
        self._matrix = np.zeros((nv, nv))
        self._factors = (self._matrix, np.zeros(nv, dtype=np.int32))

    def time_inputs(self, time: Array) -> Array:
        """(t, 1) times (t,) in s."""
        return np.asarray(time, dtype=float)[:, None]

    def mean_inputs(self) -> Array:
        """(1,) time 0; equations without a ramp time use the means of the loads alone."""
        return np.zeros(1)

    def residual(self, time_inputs: Array, q: Array, v: Array, a: Array) -> Array:
        """(nv,) residual generalised forces in N and N m."""
        return self.equations.residual(float(time_inputs[0]), q, v, a)

    def factorise(
        self, time_inputs: Array, q: Array, v: Array, a: Array, dv_dq: float, da_dq: float
    ) -> None:
        """Factorise the iteration matrix da_dq dr/da + dv_dq dr/dv + dr/dq about a state.

        Raises
        ------
        LinAlgError
            The matrix is singular.
        """
        time = float(time_inputs[0])
        stiffness, damping = self.equations.tangents(time, q, v, a)
        self._matrix = stiffness + dv_dq * damping
        if da_dq:
            self._matrix += da_dq * self.equations.mass(q, time)
        lu, pivots = lu_factor(self._matrix, check_finite=False)
        if not np.all(np.diag(lu)):
            raise np.linalg.LinAlgError("Matrix is singular to machine precision.")
        self._factors = (lu, pivots)

    def correction(self, residual: Array) -> Array:
        """(nv,) solution of the iteration matrix for a right side."""
        return np.asarray(lu_solve(self._factors, residual, check_finite=False))

    def unstable_directions(self) -> int:
        """Number of unstable directions of the factorised static state."""
        symmetric = (self._matrix + self._matrix.T) / 2
        return int(np.sum(np.linalg.eigvalsh(symmetric) <= 0))

    @property
    def memory(self) -> Array:
        """(m,) memory of soil and foundation; a copy."""
        return self.equations.memory

    @memory.setter
    def memory(self, past: Array) -> None:
        self.equations.memory = past

    def at_rest(self, time_inputs: Array, q: Array, height: Array) -> RestingAxis:
        """Axis and section loads of a state of rest, to which memories are updated."""
        time, rest = float(time_inputs[0]), np.zeros_like(q)
        self.equations.commit(time, q, rest, rest)
        motion = self.equations.chain_motion(q, rest)
        return RestingAxis(
            motion.points_at(height).displacement,
            motion.axis[self.equations.chain.body_at(height)],
            section_loads(self.equations, time, q, rest, rest, height),
        )

    def worst_joint(self, residual: Array) -> tuple[str, float]:
        """Name and size of the largest entry of a residual."""
        return self.equations.worst_joint(residual)
