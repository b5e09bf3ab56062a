"""Natural modes of a symmetric pair of matrices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

Array = NDArray[np.float64]


def natural_modes(stiffness: Array, mass: Array, count: int) -> tuple[Array, Array]:
    """Lowest eigenpairs of K phi = omega^2 M phi.

    Returns
    -------
    squares : (count,) omega^2 in rad^2/s^2, rising; negative where the structure is unstable
    vectors : (n, count), phi' M phi = 1
    """
    symmetric = (stiffness + stiffness.T) / 2
    squares, vectors = eigh(symmetric, mass, subset_by_index=(0, count - 1))
    return squares, vectors
