# ruff: noqa: N806
"""Inverse dynamics, mass matrix and forward dynamics of a tree, one joint at a time.

R. Featherstone, Rigid Body Dynamics Algorithms (Springer, 2008): tables 5.1, 6.2 and 7.1, in their
letters (hence capitals among the variables). X[i] takes motions from the parent of body i to body
i, its transpose takes forces back; S is the joint's freedom; index 0 is the base, which accelerates
upwards in place of gravity. Inputs are as Pinocchio takes them, in SI units.
"""

from __future__ import annotations

import numpy as np
from kinematic_tree import KinematicTree
from spatial import Array, cross_force, cross_motion


def rnea(tree: KinematicTree, q: Array, qd: Array, qdd: Array) -> Array:
    """Joint forces (nv,) for given accelerations: recursive Newton-Euler, table 5.1."""
    X = _transforms(tree, q)
    v, a, f = [np.zeros(6)], [-tree.gravity], [np.zeros(6)]
    for i, body in enumerate(tree.bodies, 1):
        S, I = body.joint.subspace, body.inertia  # noqa: E741
        v_J = S @ qd[body.v]
        v.append(X[i] @ v[body.parent] + v_J)
        a.append(X[i] @ a[body.parent] + S @ qdd[body.v] + cross_motion(v[i]) @ v_J)
        f.append(I @ a[i] + cross_force(v[i]) @ (I @ v[i]))
    tau = np.zeros(tree.nv)
    for i, body in reversed(list(enumerate(tree.bodies, 1))):
        tau[body.v] = body.joint.subspace.T @ f[i]
        f[body.parent] += X[i].T @ f[i]
    return tau


def crba(tree: KinematicTree, q: Array) -> Array:
    """Mass matrix (nv, nv), both triangles: composite rigid bodies, table 6.2."""
    X = _transforms(tree, q)
    I_c = [np.zeros((6, 6)), *(body.inertia.copy() for body in tree.bodies)]
    H = np.zeros((tree.nv, tree.nv))
    for i, body in reversed(list(enumerate(tree.bodies, 1))):
        I_c[body.parent] += X[i].T @ I_c[i] @ X[i]
        F = I_c[i] @ body.joint.subspace
        H[body.v, body.v] = body.joint.subspace.T @ F
        j, above = i, body
        while above.parent > 0:
            F = X[j].T @ F
            j = above.parent
            above = tree.bodies[j - 1]
            H[above.v, body.v] = above.joint.subspace.T @ F
            H[body.v, above.v] = H[above.v, body.v].T
    return H


def aba(tree: KinematicTree, q: Array, qd: Array, tau: Array) -> Array:
    """Accelerations (nv,) for given joint forces: articulated bodies, table 7.1."""
    X = _transforms(tree, q)
    v, c = [np.zeros(6)], [np.zeros(6)]
    I_A = [np.zeros((6, 6)), *(body.inertia.copy() for body in tree.bodies)]
    p_A = [np.zeros(6)]
    for i, body in enumerate(tree.bodies, 1):
        v_J = body.joint.subspace @ qd[body.v]
        v.append(X[i] @ v[body.parent] + v_J)
        c.append(cross_motion(v[i]) @ v_J)
        p_A.append(cross_force(v[i]) @ (body.inertia @ v[i]))

    U, D_inverse, u = {}, {}, {}
    for i, body in reversed(list(enumerate(tree.bodies, 1))):
        S = body.joint.subspace
        U[i] = I_A[i] @ S
        D_inverse[i] = np.linalg.inv(S.T @ U[i])
        u[i] = tau[body.v] - S.T @ p_A[i]
        I_a = I_A[i] - U[i] @ D_inverse[i] @ U[i].T
        p_a = p_A[i] + I_a @ c[i] + U[i] @ (D_inverse[i] @ u[i])
        I_A[body.parent] += X[i].T @ I_a @ X[i]
        p_A[body.parent] += X[i].T @ p_a

    a, qdd = [-tree.gravity], np.zeros(tree.nv)
    for i, body in enumerate(tree.bodies, 1):
        a_rest = X[i] @ a[body.parent] + c[i]
        qdd[body.v] = D_inverse[i] @ (u[i] - U[i].T @ a_rest)
        a.append(a_rest + body.joint.subspace @ qdd[body.v])
    return qdd


def _transforms(tree: KinematicTree, q: Array) -> list[Array]:
    """X[i] = X_J X_T for every body, and the identity for the base."""
    moved = [body.joint.transform(q[body.q]) @ body.placement for body in tree.bodies]
    return [np.eye(6), *moved]
