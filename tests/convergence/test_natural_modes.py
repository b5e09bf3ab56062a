"""Natural modes of a chain of equal masses and springs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from offwind_pin.solvers.eigen import natural_modes

N, MASS, SPRING = 12, 3.0, 50.0
K = SPRING * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
M = MASS * np.eye(N)


def test_chain_between_two_walls() -> None:
    """omega_k = 2 sqrt(k / m) sin(k pi / 2 (n + 1)), shapes sin(i k pi / (n + 1))."""
    squares, vectors = natural_modes(K, M, 5)
    order = np.arange(1, 6)
    exact = 2 * np.sqrt(SPRING / MASS) * np.sin(order * np.pi / 2 / (N + 1))
    assert_allclose(np.sqrt(squares), exact, rtol=1e-12)
    shape = np.sin(np.outer(np.arange(1, N + 1), order) * np.pi / (N + 1))
    shape *= np.sqrt(2 / (N + 1) / MASS)
    assert_allclose(np.abs(vectors.T @ M @ shape), np.eye(5), atol=1e-12)


def test_modal_mass_is_one() -> None:
    """phi' M phi = 1 and phi' K phi = omega^2, with a full mass matrix."""
    mass = M + 0.5 * np.ones((N, N))
    squares, vectors = natural_modes(K, mass, N)
    assert_allclose(vectors.T @ mass @ vectors, np.eye(N), atol=1e-12)
    assert_allclose(vectors.T @ K @ vectors, np.diag(squares), atol=1e-9)


def test_free_chain_has_a_rigid_mode() -> None:
    """Without walls the chain moves as a whole at frequency zero."""
    free = K.copy()
    free[0, 0] = free[-1, -1] = SPRING
    squares, vectors = natural_modes(free, M, 2)
    assert squares[0] == pytest.approx(0.0, abs=1e-12)
    assert np.ptp(vectors[:, 0]) < 1e-10
    assert squares[1] > 0.1


def test_unstable_structure_has_a_negative_square() -> None:
    """A column beyond its buckling load: omega^2 < 0, and the modes are still given."""
    squares, _ = natural_modes(K - 1.1 * np.linalg.eigvalsh(K)[0] * np.eye(N), M, 2)
    assert squares[0] < 0 < squares[1]
