"""Linear equations of small motions about a static state, by products and solutions in O(N)."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.matrix_products import ChainGeometry, MatrixProducts
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
        self._shift: float | None = None

    def stiffness_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape."""
        return self._stiffness.times(vectors)

    def symmetric_stiffness_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape, by the symmetric part of the stiffness."""
        return self._symmetric_stiffness.times(vectors)

    def mass_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape."""
        return self._mass.times(vectors)

    def damping_times(self, vectors: Array) -> Array:
        """(nv, n) of the same shape."""
        return self._damping.times(vectors)

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

    @cached_property
    def _geometry(self) -> ChainGeometry:
        return ChainGeometry(self._chain.model, self._chain.data)

    @cached_property
    def _stiffness(self) -> MatrixProducts:
        model, data = self._chain.model, self._chain.data
        return MatrixProducts(
            self._geometry,
            self._bodies(0.0, 0.0),
            np.array([damper.stiffness for damper in self._geometry.dampers]).reshape(-1, 6, 6),
            model.stiffness,
            data.root_stiffness[: model.roots, : model.roots].copy(),
            turning=1.0,
        )

    @cached_property
    def _symmetric_stiffness(self) -> MatrixProducts:
        return self._stiffness.symmetric()

    @cached_property
    def _mass(self) -> MatrixProducts:
        model = self._chain.model
        return MatrixProducts(
            self._geometry,
            (self._bodies(0.0, _LARGE) - self._stiffness.bodies) / _LARGE,
            np.array([damper.mass for damper in self._geometry.dampers]).reshape(-1, 6, 6),
            np.zeros(len(self._q)),
            np.zeros((model.roots, model.roots)),
        )

    @cached_property
    def _damping(self) -> MatrixProducts:
        model, data = self._chain.model, self._chain.data
        return MatrixProducts(
            self._geometry,
            (self._bodies(_LARGE, 0.0) - self._stiffness.bodies) / _LARGE,
            np.zeros((len(self._geometry.dampers), 6, 6)),
            model.damping,
            data.root_damping[: model.roots, : model.roots].copy(),
        )

    def _bodies(self, dv_dq: float, da_dq: float) -> Array:
        """(N + 1, 6, 6) matrices of the bodies in da_dq M + dv_dq D + K."""
        chain = self._chain
        factors = Factorisation.of(chain.model)
        arguments = (chain.model, chain.data, chain.state, factors, self._time_inputs)
        with chain.running():
            assemble(*arguments, dv_dq, da_dq)
        return factors.articulated
