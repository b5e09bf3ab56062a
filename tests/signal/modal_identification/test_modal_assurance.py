"""The modal assurance criterion and the complexity of shapes in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from offwind_pin.base.errors import InputError
from offwind_pin.signal.modal_identification.modal_assurance import modal_assurance, real_shape

HEIGHT = np.linspace(0.1, 1.0, 13)
SHAPES = np.array([HEIGHT**2, np.sin(1.4 * np.pi * HEIGHT), np.sin(2.5 * np.pi * HEIGHT)])


@given(st.floats(0.01, 100), st.floats(-3.1, 3.1))
def test_scale_and_phase_do_not_matter(scale: float, phase: float) -> None:
    """A shape is itself, by whatever complex factor."""
    other = SHAPES * scale * np.exp(1j * phase)
    found = modal_assurance(SHAPES, other)
    assert_allclose(found.diagonal(), 1.0, rtol=1e-12)
    assert_allclose(found, modal_assurance(SHAPES, SHAPES), rtol=1e-9, atol=1e-12)


def test_closed_form() -> None:
    """Of two vectors at an angle, the squared cosine; of normal ones, nothing."""
    angle = 0.3
    a, b = np.array([1.0, 0.0]), np.array([np.cos(angle), np.sin(angle)])
    assert modal_assurance(a, b)[0, 0] == pytest.approx(np.cos(angle) ** 2, rel=1e-12)
    assert modal_assurance(a, [0.0, 5.0])[0, 0] == 0
    # A wave and its mirror image are two shapes, which the transpose alone would not tell.
    assert modal_assurance([1, 1j], [1, -1j])[0, 0] == 0


def test_different_modes_are_unlike() -> None:
    """Negative control: the matrix is symmetric, and small off its diagonal."""
    found = modal_assurance(SHAPES, SHAPES)
    assert_allclose(found, found.T, rtol=1e-12)
    assert np.max(found - np.diag(found.diagonal())) < 0.3
    assert modal_assurance(SHAPES[:2], SHAPES).shape == (2, 3)


def test_real_shape_is_found_whatever_its_phase() -> None:
    """A real shape has no complexity, and a unit peak."""
    for phase in np.linspace(0, 2 * np.pi, 9):
        shape, complexity = real_shape(-0.3 * SHAPES[1] * np.exp(1j * phase))
        assert complexity < 1e-28
        assert_allclose(shape, SHAPES[1] / SHAPES[1][np.argmax(np.abs(SHAPES[1]))], rtol=1e-12)


def test_complexity_in_closed_form() -> None:
    """A part at right angles counts by its square; a wave that runs has a half."""
    a, b = np.array([1.0, 1.0, 0.0]), np.array([0.0, 0.0, 0.4])
    shape, complexity = real_shape((a + 1j * b) * np.exp(0.7j))
    assert complexity == pytest.approx(0.16 / 2.16, rel=1e-12)
    assert_allclose(shape, a, atol=1e-12)
    angle = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    assert real_shape(np.exp(1j * angle))[1] == pytest.approx(0.5, rel=1e-9)


@pytest.mark.parametrize(
    ("a", "b", "message"),
    [
        (SHAPES, SHAPES[:, 1:], "13 and 12 sensors"),
        (SHAPES, SHAPES * 0, "b, mode 0"),
        (SHAPES * np.array([[1], [np.nan], [1]]), SHAPES, "a, mode 1"),
        (np.zeros((2, 3, 4)), SHAPES, "shape"),
        ([], SHAPES, "shape"),
    ],
)
def test_bad_input(a: Any, b: Any, message: str) -> None:
    """Each mistake is reported."""
    with pytest.raises(InputError, match=message):
        modal_assurance(a, b)
