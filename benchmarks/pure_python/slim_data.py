"""Pinocchio's scratch data without the tensors that grow with the cube of the degrees of freedom.

``model.createData()`` sets aside and fills four tensors of nv^3 numbers and one of 6 nv^2. Only the
second-order derivatives use them (https://github.com/stack-of-tasks/pinocchio/issues/2949). The
default constructor leaves every member empty, and the members are open to Python.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import pinocchio as pin


def tensor_bytes(nv: int) -> int:
    """What the tensors of ``createData`` take."""
    return 8 * (4 * nv**3 + 6 * nv**2)


def slim_data(model: pin.Model) -> pin.Data:
    """Scratch data for rnea, for aba in its default form, and for crba in both.

    Each member that one of the three reads or writes (Pinocchio 4.1) is given its size; the others
    stay empty. No other algorithm may be called with it: it would write through a null pointer and
    end the process. A build of Pinocchio with assertions, which the wheels are not, refuses it.

    Raises
    ------
    ValueError : the model has mimic joints, for which crba needs further members
    """
    if model.nv != model.nvExtended:
        raise ValueError(f"model {model.name} has mimic joints; use model.createData()")
    data, nv, joints = pin.Data(), model.nv, range(model.njoints)
    data.joints = _vector(
        pin.StdVec_JointDataVector, (joint.createData() for joint in model.joints)
    )
    data.v = _vector(pin.StdVec_Motion, (pin.Motion.Zero() for _ in joints))
    data.a = _vector(pin.StdVec_Motion, (pin.Motion.Zero() for _ in joints))
    data.a_gf = _vector(pin.StdVec_Motion, (pin.Motion.Zero() for _ in joints))
    data.h = _vector(pin.StdVec_Force, (pin.Force.Zero() for _ in joints))
    data.f = _vector(pin.StdVec_Force, (pin.Force.Zero() for _ in joints))
    data.liMi = _vector(pin.StdVec_SE3, (pin.SE3.Identity() for _ in joints))
    data.oMi = _vector(pin.StdVec_SE3, (pin.SE3.Identity() for _ in joints))
    data.Ycrb = _vector(pin.StdVec_Inertia, (pin.Inertia.Zero() for _ in joints))
    data.oYcrb = _vector(pin.StdVec_Inertia, (pin.Inertia.Zero() for _ in joints))
    data.Yaba = _vector(pin.StdVec_Matrix6, (np.zeros((6, 6)) for _ in joints))
    data.mass = _vector(pin.StdVec_Double, (0.0 for _ in joints))
    data.com = _vector(pin.StdVec_Vector3, (np.zeros(3) for _ in joints))
    data.nvSubtree = _vector(pin.StdVec_int, _freedoms_above(model))
    data.Fcrb = _vector(pin.StdVec_Matrix6x, (np.zeros((6, nv)) for _ in joints))
    data.tau, data.ddq = np.zeros(nv), np.zeros(nv)
    data.J, data.Ag = np.zeros((6, nv), order="F"), np.zeros((6, nv), order="F")
    data.M = np.zeros((nv, nv), order="F")
    return data


def _freedoms_above(model: pin.Model) -> list[int]:
    """Degrees of freedom of each joint and all that it carries."""
    freedoms = list(model.nvs)
    for i in range(model.njoints - 1, 0, -1):
        freedoms[model.parents[i]] += freedoms[i]
    return freedoms


def _vector(kind: Any, items: Iterable[Any]) -> Any:
    """A vector of Pinocchio's from Python items."""
    vector = kind()
    for item in items:
        vector.append(item)
    return vector
