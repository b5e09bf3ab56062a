"""Products with the matrices of small motions about a state, in O(N).

The matrix da_dq M + dv_dq D + K is never assembled: see :mod:`newton_matrix` for its factors.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import exchangeable
from offwind_pin.dynamics.compiled.model import Data, Factorisation, Model
from offwind_pin.dynamics.compiled.newton_matrix import (
    FACTORISATION,
    turn_of_axis,
)
from offwind_pin.dynamics.compiled.residual import DATA, MODEL, ROW

_MATRIX: Any = types.float64[:, ::1]
_FACTORS = (types.float64, types.float64)

multiply_kernel = exchangeable(
    types.void(MODEL, DATA, FACTORISATION, *_FACTORS, types.intp, _MATRIX, _MATRIX), nogil=True
)
tmd_multiply_kernel = exchangeable(
    types.void(MODEL, DATA, FACTORISATION, *_FACTORS, types.intp, ROW, ROW)
)
"""Decorator for ``kernel(model, data, factors, dv_dq, da_dq, transposed, vector, product)``: what
tuned mass dampers add; the twists of their carriers are in the factors, and become wrenches."""

_tmd_multiply = tmd_multiply_kernel.call


@multiply_kernel
def multiply(
    model: Model,
    data: Data,
    factors: Factorisation,
    dv_dq: float,
    da_dq: float,
    transposed: int,
    vectors: Array,
    products: Array,
) -> None:
    """Set products (n, nv) of the matrix, or of its transpose (1, not 0), with vectors (n, nv).

    factors : as :func:`assemble` set them for the same state and factors
    """
    axes, held, matrices = data.joint, data.wrench, factors.articulated
    passed, tmd_body = factors.tmd_passed, model.tmd.body
    roots, node_joints, last = model.roots, model.node_joints, len(model.length)
    twist, wrench, turning = np.empty((last + 1, 6)), np.empty(6), np.empty(6)
    below = np.empty((len(model.stiffness), 6))
    for n in range(len(vectors)):
        x, y = vectors[n], products[n]
        wrench.fill(0.0)  # the twist of the bodies at first, from the base upwards
        dof = 0
        for k in range(last + 1):
            count = node_joints if k > 0 else roots
            for _ in range(count):
                for j in range(6):
                    below[dof, j] = wrench[j]
                    wrench[j] += axes[dof, j] * x[dof]
                dof += 1
            for j in range(6):
                twist[k, j] = wrench[j]
        for d in range(len(tmd_body)):
            for j in range(6):
                passed[d, j] = twist[tmd_body[d], j]
        if model.tmd.multiply != 0:
            arguments = (model, data, factors, dv_dq, da_dq, transposed, x, y)
            _tmd_multiply(model.tmd.multiply, arguments)
        wrench.fill(0.0)
        for k in range(last, -1, -1):
            for i in range(6):
                for j in range(6):
                    entry = matrices[k, j, i] if transposed != 0 else matrices[k, i, j]
                    wrench[i] += entry * twist[k, j]
            for d in range(len(tmd_body)):
                if tmd_body[d] == k:
                    for j in range(6):
                        wrench[j] += passed[d, j]
            count = node_joints if k > 0 else roots
            for _ in range(count):
                dof -= 1
                value = (model.stiffness[dof] + dv_dq * model.damping[dof]) * x[dof]
                turn_of_axis(axes, held, dof, k, turning)
                for j in range(6):
                    value += axes[dof, j] * wrench[j]
                    if transposed != 0:
                        wrench[j] -= turning[j] * x[dof]
                    else:
                        value -= turning[j] * below[dof, j]
                y[dof] = value
        for i in range(roots):
            for j in range(roots):
                m, o = (j, i) if transposed != 0 else (i, j)
                y[i] += (data.root_stiffness[m, o] + dv_dq * data.root_damping[m, o]) * x[j]
