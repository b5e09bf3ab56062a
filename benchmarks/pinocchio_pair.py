"""Pinocchio's rnea and joint Jacobians on a model, the least that a step has to call."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import measuring  # noqa: F401  (first: one BLAS thread)
import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

Array = NDArray[np.float64]

sys.path.append(str(Path(__file__).parent / "pure_python"))
slim_data = importlib.import_module("slim_data")

LARGEST_TENSORS = 1e9
"""Bytes; above, Pinocchio's scratch data is made without its tensors of nv^3 numbers."""


def scratch_data(model: pin.Model) -> tuple[pin.Data, str]:
    """Scratch data for the two algorithms, and how it was made."""
    if slim_data.tensor_bytes(model.nv) <= LARGEST_TENSORS:
        return model.createData(), "createData"
    return slim_data.slim_data(model), "without second-order tensors"


def pair(model: pin.Model, data: pin.Data, q: Array, v: Array, a: Array) -> Callable[[int], None]:
    """A function that calls the two so many times in a row."""

    def run(count: int) -> None:
        for _ in range(count):
            pin.rnea(model, data, q, v, a)
            pin.computeJointJacobians(model, data, q)

    return run


def check_slim_data(model: pin.Model, q: Array, v: Array, a: Array) -> None:
    """Both kinds of scratch data give bitwise the same results.

    Raises
    ------
    RuntimeError : they do not
    """
    results: list[list[Any]] = []
    for data in (model.createData(), slim_data.slim_data(model)):
        force = pin.rnea(model, data, q, v, a).copy()
        results.append([force, pin.computeJointJacobians(model, data, q).copy()])
    if not all(np.array_equal(x, y) for x, y in zip(*results, strict=True)):
        raise RuntimeError("Pinocchio's results depend on how its scratch data was made")
