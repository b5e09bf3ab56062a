"""Linear equations of small motions about a static state, by products and solutions in O(N)."""

from __future__ import annotations

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.matrix_products import MatrixProducts
from offwind_pin.dynamics.compiled.model import Factorisation
from offwind_pin.dynamics.compiled.newton_matrix import assemble
from offwind_pin.solvers.eigen import lowest_modes

_LARGE = 1e12
"""In 1/s and 1/s2: beside it the stiffness is nearly rounding, and the rest is subtracted."""


class CompiledPencil:
    """Mass, damping and stiffness of small motions of a chain about joint displacements at rest.

    In joint coordinates these matrices are full; they are assembled on request only.
    """

    def __init__(self, chain: CompiledChain, q: Array) -> None:
        self._chain = chain
        self._time_inputs = chain.mean_inputs()
        self._q, self._rest = q, np.zeros_like(q)
        chain.residual(self._time_inputs, q, self._rest, self._rest)
        self._products: dict[tuple[float, float], MatrixProducts] = {}
        self._shift: float | None = None

    def stiffness_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape."""
        return self._times(vectors, 0.0, 0.0)

    def symmetric_stiffness_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape, by the symmetric part of the stiffness."""
        straight = self._times(vectors, 0.0, 0.0)
        return (straight + self._times(vectors, 0.0, 0.0, transposed=True)) / 2

    def mass_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape."""
        return (self._times(vectors, 0.0, _LARGE) - self._times(vectors, 0.0, 0.0)) / _LARGE

    def damping_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape."""
        return (self._times(vectors, _LARGE, 0.0) - self._times(vectors, 0.0, 0.0)) / _LARGE

    def matrices(self) -> tuple[Array, Array, Array]:
        """Mass, damping and stiffness, (nv, nv) each."""
        unit = np.eye(len(self._q))
        return self.mass_times(unit), self.damping_times(unit), self.stiffness_times(unit)

    def lowest(self, count: int) -> tuple[Array, Array]:
        """(count,) squared angular frequencies, rising; (nv, count) mass-normalised modes."""
        return lowest_modes(self, len(self._q), count)

    def axis_shape(self, vector: Array, height: Array) -> Array:
        """(m, 6) displacement and rotation of the axis at heights (m,) per unit of a vector."""
        chain, data = self._chain.system.chain, self._chain.data
        moved = data.joint[: chain.axis_joints] * vector[: chain.axis_joints, None]
        twists = np.vstack([np.zeros(6), np.cumsum(moved, axis=0)])
        body = chain.body_at(height)
        twist = twists[chain.roots + len(chain.node_joints) * body]
        arm = (height - chain.origin[body])[:, None] * data.rotation[body, :, 2]
        position = data.position[body] + arm
        return np.hstack([twist[:, :3] + np.cross(twist[:, 3:], position), twist[:, 3:]])

    def solve(self, rhs: Array, shift: float = 0.0) -> Array:
        """(nv,) solution of (K - shift M) x = b."""
        self._factorise(shift)
        return self._chain.correction(rhs)

    def below(self, square: float) -> int:
        """Number of squared angular frequencies below a value, by Sylvester's law of inertia."""
        self._factorise(square)
        return self._chain.unstable_directions()

    def _factorise(self, shift: float) -> None:
        if shift == self._shift:
            return
        arguments = (self._time_inputs, self._q, self._rest, self._rest, 0.0, -shift)
        self._chain.factorise(*arguments)
        self._shift = shift

    def _times(
        self, vectors: Array, dv_dq: float, da_dq: float, *, transposed: bool = False
    ) -> Array:
        chain, key = self._chain, (dv_dq, da_dq)
        if key not in self._products:
            factors = Factorisation.of(chain.model)
            arguments = (chain.model, chain.data, chain.state, factors)
            with chain.running():
                assemble(*arguments, self._time_inputs, dv_dq, da_dq)
            self._products[key] = MatrixProducts(
                chain.model, chain.data, factors.articulated, dv_dq, da_dq
            )
        times = self._products[key].times
        if vectors.ndim == 1:
            return times(vectors, transposed=transposed)
        return np.column_stack([times(vector, transposed=transposed) for vector in vectors.T])
