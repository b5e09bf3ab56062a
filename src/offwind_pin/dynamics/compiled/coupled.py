"""Dampers that couple points, in the iteration matrix: its factorisation and solution in O(N k).

With the k dampers' generalised forces G (k, nv) and rates R the matrix is A + dv_dq G' R G, where A
is what :mod:`newton_matrix` factorises. By the formula of Sherman, Morrison and Woodbury

    (A + dv_dq G' R G)^-1 = A^-1 - Z (1 + dv_dq R G Z)^-1 dv_dq R G A^-1,    Z = A^-1 G'.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from offwind_pin.base.definition import Array
from offwind_pin.base.kernels import inner
from offwind_pin.base.records import clear, stack_row
from offwind_pin.dynamics.compiled.model import CoupledDampers, Data, Factorisation, Model, State
from offwind_pin.dynamics.compiled.newton_matrix import (
    factorise,
    factorise_kernel,
    invert,
    solve,
    solve_kernel,
)
from offwind_pin.loads.point_load import KernelLoad

_factorise, _solve = factorise_kernel.call, solve_kernel.call


def coupled_dampers(loads: Sequence[KernelLoad]) -> CoupledDampers:
    """Those of all loads of a system."""
    rates, wrenches, first_points = [np.zeros(0)], [np.zeros((0, 6))], []
    counts: list[int] = []
    beginning = 0
    for load in loads:
        if load.coupling is not None:
            wrench, rate = load.coupling
            rates.append(rate)
            wrenches.append(wrench.reshape(-1, 6))
            first_points += [beginning] * len(rate)
            counts += [len(load.height)] * len(rate)
        beginning += len(load.height)
    return CoupledDampers(
        rate=np.concatenate(rates),
        first_point=np.array(first_points, dtype=np.intp),
        first_wrench=np.cumsum([0, *counts], dtype=np.intp),
        wrench=np.ascontiguousarray(np.concatenate(wrenches)),
        factorise=factorise.address if counts else 0,
        solve=solve.address if counts else 0,
    )


@factorise_kernel
def factorise_coupled(
    model: Model,
    data: Data,
    state: State,
    factors: Factorisation,
    time_inputs: Array,
    dv_dq: float,
    da_dq: float,
) -> None:
    """The same as :func:`factorise`, with coupled dampers."""
    coupled = model.coupled
    arguments = (model, data, state, factors, time_inputs, dv_dq, da_dq)
    _factorise(coupled.factorise, arguments)
    rows, columns, inverse = factors.coupled_row, factors.coupled_column, factors.coupled_inverse
    count, nv = len(coupled.rate), rows.shape[1]
    if dv_dq == 0:
        inverse.fill(0.0)
        return
    for i in range(count):
        set_row(model, data, factors, i)
        _solve(coupled.solve, (model, factors, rows[i]))
        for m in range(nv):
            columns[i, m] = factors.solution[m]
    block = factors.coupled_block
    for i in range(count):
        for j in range(count):
            block[i, j] = 0.0
            for m in range(nv):
                block[i, j] += dv_dq * coupled.rate[i] * rows[i, m] * columns[j, m]
        block[i, i] += 1.0
    invert(block, count, inverse)
    for i in range(count):
        for j in range(count):
            inverse[i, j] *= dv_dq * coupled.rate[j]


@inner
def set_row(model: Model, data: Data, factors: Factorisation, i: int) -> None:
    """Set the generalised force of a damper per unit of its own."""
    coupled, row, motion, axes = model.coupled, factors.coupled_row, data.motion, data.joint
    first, begin = coupled.first_point[i], coupled.first_wrench[i]
    n = coupled.first_wrench[i + 1] - begin - 1
    above = stack_row(6)
    clear(above)
    last = len(model.length)
    dof = model.roots + model.node_joints * last
    for k in range(last, -1, -1):
        while n >= 0 and model.point_body[first + n] == k:
            for j in range(3):
                m, o = (j + 1) % 3, (j + 2) % 3
                above[j] += coupled.wrench[begin + n, j]
                above[3 + j] += coupled.wrench[begin + n, 3 + j]
                above[3 + j] += motion[first + n, m] * coupled.wrench[begin + n, o]
                above[3 + j] -= motion[first + n, o] * coupled.wrench[begin + n, m]
            n -= 1
        for _ in range(model.node_joints if k > 0 else model.roots):
            dof -= 1
            row[i, dof] = 0.0
            for j in range(6):
                row[i, dof] += axes[dof, j] * above[j]


@solve_kernel
def solve_coupled(model: Model, factors: Factorisation, rhs: Array) -> None:
    """The same as :func:`solve`, with coupled dampers."""
    _solve(model.coupled.solve, (model, factors, rhs))
    rows, columns, inverse = factors.coupled_row, factors.coupled_column, factors.coupled_inverse
    x, force = factors.solution, factors.coupled_force
    count = len(force)
    for i in range(count):
        force[i] = 0.0
        for m in range(len(x)):
            force[i] += rows[i, m] * x[m]
    for i in range(count):
        amount = 0.0
        for j in range(count):
            amount += inverse[i, j] * force[j]
        for m in range(len(x)):
            x[m] -= columns[i, m] * amount
