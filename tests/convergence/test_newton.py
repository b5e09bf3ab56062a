"""Newton's method: quadratic convergence, limited steps, graceful failure."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from offwind_pin.solvers.newton import newton

Array = NDArray[np.float64]


def circle_and_line(x: Array) -> Array:
    return np.array([x[0] ** 2 + x[1] ** 2 - 1.0, x[0] - x[1]])


def circle_and_line_tangent(x: Array) -> Array:
    return np.array([[2 * x[0], 2 * x[1]], [1.0, -1.0]])


def solved(tangent: Callable[[Array], Array]) -> Callable[[Array, Array], Array]:
    """The correction that Newton's method asks for, with a dense tangent."""
    return lambda x, residual: np.linalg.solve(tangent(x), residual)


def test_scalar_convergence_is_quadratic() -> None:
    """x = cos x: each error is f'' / 2 f' times the square of the one before."""
    root, visited = 0.7390851332151607, []

    def residual(x: Array) -> Array:
        visited.append(float(x[0]))
        return x - np.cos(x)

    result = newton(
        residual,
        solved(lambda x: np.array([[1 + np.sin(x[0])]])),
        np.array([2.0]),
        scale=1.0,
        largest_step=10.0,
    )
    assert result.converged
    assert result.x[0] == pytest.approx(root, abs=1e-14)
    error = np.abs(np.array(visited) - root)
    constant = np.cos(root) / 2 / (1 + np.sin(root))
    useful = [i for i in range(1, len(error) - 1) if 1e-7 < error[i] < 0.2]
    assert len(useful) >= 2
    for i in useful:
        assert error[i + 1] / error[i] ** 2 == pytest.approx(constant, rel=0.2)


def test_system_of_two() -> None:
    """The unit circle and a diagonal meet at 1 / sqrt 2."""
    result = newton(
        circle_and_line,
        solved(circle_and_line_tangent),
        np.array([1.0, 0.2]),
        scale=1.0,
        largest_step=1.0,
    )
    assert result.converged
    assert result.x == pytest.approx([np.sqrt(0.5)] * 2, abs=1e-15)
    assert result.iterations <= 7
    assert np.abs(result.residual).max() < 1e-10


def test_a_wrong_tangent_is_slow() -> None:
    """Negative control: with the tangent doubled, convergence is linear and takes many steps."""
    good, bad = (
        newton(
            circle_and_line,
            solved(lambda x, f=factor: f * circle_and_line_tangent(x)),
            np.array([1.0, 0.2]),
            scale=1.0,
            largest_step=1.0,
        )
        for factor in (1.0, 2.0)
    )
    assert bad.iterations > 3 * good.iterations


def test_steps_are_limited() -> None:
    """No entry moves further than the largest step, and the root is still found."""
    visited = []

    def residual(x: Array) -> Array:
        visited.append(x.copy())
        return x - [1.0, -0.5]

    result = newton(
        residual, solved(lambda x: np.eye(2)), np.zeros(2), scale=1.0, largest_step=0.05
    )
    assert result.converged
    assert np.abs(np.diff(visited, axis=0)).max() < 0.05 * (1 + 1e-12)
    assert result.x == pytest.approx([1.0, -0.5], abs=1e-15)


def test_no_root_is_not_converged() -> None:
    """x^2 + 1 has no real root: the end is reported after the allowed number of steps."""
    result = newton(
        lambda x: x**2 + 1,
        solved(lambda x: np.diag(2 * x)),
        np.array([0.7]),
        scale=1.0,
        max_iterations=30,
    )
    assert not result.converged
    assert result.iterations == 30
    assert result.residual[0] >= 1


def test_residual_that_is_not_a_number_ends_the_search() -> None:
    """A residual of nan ends at once, unconverged."""
    result = newton(lambda x: x * np.nan, solved(lambda x: np.eye(1)), np.ones(1), scale=1.0)
    assert not result.converged
    assert result.iterations == 0


def test_singular_tangent_ends_the_search() -> None:
    """At a stationary point there is no step: unconverged, without an exception or a warning."""
    result = newton(
        lambda x: x**2 + 1, solved(lambda x: np.diag(2 * x)), np.array([0.0]), scale=1.0
    )
    assert not result.converged


def test_scale_sets_the_tolerance() -> None:
    """The residual is judged by the size of what it balances."""
    results = [
        newton(
            lambda x: x**3 - 8e-9,
            solved(lambda x: np.diag(3 * x**2)),
            np.array([0.01]),
            scale=scale,
            increment_tolerance=1.0,
        )
        for scale in (1.0, 1e-9)
    ]
    assert results[0].iterations < results[1].iterations
    assert results[1].x[0] == pytest.approx(0.002, rel=1e-9)
