"""Linear equations of small motions about a static state, by products and solutions in O(N)."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.dynamics.compiled.chain import CompiledChain
from offwind_pin.dynamics.compiled.matrix_products import ChainGeometry, MatrixProducts
from offwind_pin.dynamics.compiled.model import Factorisation
from offwind_pin.dynamics.compiled.newton_matrix import assemble
from offwind_pin.loads.point_load import POSITION, dissipated_power
from offwind_pin.solvers.eigen import lowest_modes
from offwind_pin.structure.chain import dof_body

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
        rows, rate = self._coupling
        return self._damping.times(vectors) + rows.T @ (rate * (rows @ vectors).T).T

    def matrices(self) -> tuple[Array, Array, Array]:
        """Mass, damping and stiffness, (nv, nv) each."""
        unit = np.eye(len(self._q))
        return self.mass_times(unit), self.damping_times(unit), self.stiffness_times(unit)

    def lowest(self, count: int) -> tuple[Array, Array]:
        """(count,) squared angular frequencies, rising; (nv, count) mass-normalised modes."""
        return lowest_modes(self, len(self._q), count)

    def axis_shape(self, vector: Array, height: Array) -> Array:
        """(m, 6) displacement and rotation of the axis at heights (m,) per unit of a vector."""
        twist = self._twists(vector)[self._chain.system.chain.body_at(height)]
        position = self.position(height)
        return np.hstack([twist[:, :3] + np.cross(twist[:, 3:], position), twist[:, 3:]])

    def position(self, height: Array) -> Array:
        """(m, 3) places in m of points of the axis at undeformed heights (m,) in m."""
        chain, data = self._chain.system.chain, self._chain.data
        body = chain.body_at(height)
        arm = (height - chain.origin[body])[:, None] * data.rotation[body, :, 2]
        return np.asarray(data.position[body] + arm)

    def inertia_wrenches(self, vector: Array) -> tuple[Array, Array]:
        """(N + 1, 6) of the bodies and their water, (6,) of the rotor-nacelle assembly.

        They are the forces and moments about the world's origin that an acceleration by a vector
        needs.
        """
        chain, data = self._chain.system.chain, self._chain.data
        twist = self._twists(vector)
        bodies = np.einsum("kij,kj->ki", self._mass.bodies, twist)
        orientation, top = data.rotation[-1], twist[-1]
        x, y, z = chain.rna.center_of_mass
        arm = np.array([x, y, z + chain.top - chain.origin[-1]])
        center = data.position[-1] + orientation @ arm
        force = chain.rna.mass * (top[:3] + np.cross(top[3:], center))
        about_center = orientation @ chain.rna.inertia @ orientation.T @ top[3:]
        rna = np.concatenate([force, np.cross(center, force) + about_center])
        bodies[-1] -= rna
        return bodies, rna

    def dissipation(self, vectors: Array) -> Array:
        """(L + 1, n) power that each load and, last, the root dissipates at velocities (nv, n)."""
        chain, model = self._chain, self._chain.model
        blocks = self._assembled(0.0, 0.0).blocks
        powers = np.zeros((len(chain.loads) + 1, vectors.shape[1]))
        for i, vector in enumerate(vectors.T):
            at_points = self.axis_shape(vector, model.point_height)
            for n, load in enumerate(chain.loads):
                part = slice(model.first_point[n], model.first_point[n + 1])
                powers[n, i] = dissipated_power(load, blocks[part], at_points[part])
        root = vectors[: model.roots]
        powers[-1] = np.sum(
            root * (chain.data.root_damping[: model.roots, : model.roots] @ root), 0
        )
        return powers

    def _twists(self, vector: Array) -> Array:
        """(N + 1, 6) spatial velocities of the bodies at the world's origin."""
        chain = self._chain.system.chain
        moved = self._chain.data.joint[: chain.axis_joints] * vector[: chain.axis_joints, None]
        twists = np.vstack([np.zeros(6), np.cumsum(moved, axis=0)])
        return np.asarray(twists[chain.roots :: len(chain.node_joints)])

    @cached_property
    def _coupling(self) -> tuple[Array, Array]:
        """(k, nv) coupled dampers as generalised forces, and (k,) their rates."""
        chain, model, joint = self._chain.system.chain, self._chain.model, self._chain.data.joint
        rows, rates = [np.zeros((0, len(joint)))], [np.zeros(0)]
        for load, first in zip(self._chain.loads, model.first_point[:-1], strict=True):
            if load.coupling is None:
                continue
            wrench, rate = load.coupling
            points = slice(first, first + len(load.height))
            body = model.point_body[points]
            position = self._chain.data.motion[points, POSITION]
            on_body = np.zeros((chain.elements + 2, len(rate), 6))
            moment = wrench[..., 3:] + np.cross(position, wrench[..., :3])
            about_origin = np.concatenate([wrench[..., :3], moment], axis=2)
            np.add.at(on_body, body, about_origin.transpose(1, 0, 2))
            above = on_body[::-1].cumsum(axis=0)[::-1]
            rows.append(np.einsum("dkj,dj->kd", above[dof_body(chain)], joint))
            rates.append(rate)
        return np.concatenate(rows), np.concatenate(rates)

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
        return self._assembled(dv_dq, da_dq).articulated

    def _assembled(self, dv_dq: float, da_dq: float) -> Factorisation:
        """That matrix, nothing eliminated."""
        chain = self._chain
        factors = Factorisation.of(chain.model)
        arguments = (chain.model, chain.data, chain.state, factors, self._time_inputs)
        with chain.running():
            assemble(*arguments, dv_dq, da_dq)
        return factors
