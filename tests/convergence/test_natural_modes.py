"""Natural modes of a chain of equal masses and springs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from offwind_pin.solvers.eigen import lowest_modes, natural_modes

Array = NDArray[np.float64]

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


class Springs:
    """A large pencil of single oscillators, each frequency twice.

    For the first ``times`` counts there seem to be so many modes more.
    """

    def __init__(self, more: int, times: int) -> None:
        self.squares = np.repeat(np.arange(1.0, 51.0) ** 2, 2)
        self.more, self.times = more, times

    def mass_times(self, vectors: Array) -> Array:
        return vectors

    def symmetric_stiffness_times(self, vectors: Array) -> Array:
        return (self.squares * vectors.T).T

    def solve(self, rhs: Array) -> Array:
        return rhs / self.squares

    def below(self, square: float) -> int:
        self.times -= 1
        return int(np.sum(self.squares < square)) + (self.more if self.times >= 0 else 0)


def test_pairs_by_lanczos() -> None:
    """Both of every pair are found, and the vectors are orthonormal."""
    squares, vectors = lowest_modes(Springs(0, 0), 100, 7)
    assert_allclose(squares, [1, 1, 4, 4, 9, 9, 16], rtol=1e-10)
    assert_allclose(vectors.T @ vectors, np.eye(7), atol=1e-10)


def test_a_missed_mode_is_looked_for_again() -> None:
    """While the law of inertia counts one more; it is not given up silently."""
    squares, _ = lowest_modes(Springs(1, 2), 100, 7)
    assert_allclose(squares, [1, 1, 4, 4, 9, 9, 16], rtol=1e-10)
    with pytest.raises(np.linalg.LinAlgError, match="not found"):
        lowest_modes(Springs(1, 100), 100, 7)
