"""Similarity of mode shapes, and how nearly real complex ones are."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from offwind_pin.base.errors import InputError

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


def modal_assurance(a: ArrayLike, b: ArrayLike) -> Array:
    """Modal assurance criterion of every shape of one set with every shape of another.

    |a* b|^2 / ((a* a) (b* b)) with a* the conjugate transpose (Allemang and Brown, 1982): 1 for
    shapes that differ by a factor, 0 for orthogonal shapes. Shapes of different modes are
    orthogonal with respect to the mass, not in general without it. ``modal_assurance(a, a)`` shows
    whether the sensors can distinguish the modes of one set.

    Parameters
    ----------
    a : (m, c) or (c,) array_like
        Mode shapes at c sensors, real or complex.
    b : (n, c) or (c,) array_like
        Mode shapes at the same sensors.

    Returns
    -------
    (m, n) array
        Values from 0 to 1.

    Raises
    ------
    InputError
        Different numbers of sensors, or a shape that is zero or not finite.
    """
    first, second = _shapes("a", a), _shapes("b", b)
    if first.shape[1] != second.shape[1]:
        raise InputError(
            "modal_assurance",
            f"shapes at {first.shape[1]} and {second.shape[1]} sensors",
            "shapes at the same sensors",
            "Give one row per mode and one column per sensor.",
        )
    product = np.abs(first.conj() @ second.T) ** 2
    length = np.outer(np.sum(np.abs(first) ** 2, axis=1), np.sum(np.abs(second) ** 2, axis=1))
    return product / length


def real_shape(vector: ComplexArray) -> tuple[Array, float]:
    """A complex shape rotated in phase so that its imaginary part is smallest, with unit peak.

    Parameters
    ----------
    vector : (c,) complex array
        Of arbitrary phase and length.

    Returns
    -------
    shape : (c,) array
        Real part after the rotation, its largest value 1.
    complexity : float
        Squared length of the imaginary part that remains over that of the whole: 0 where all
        sensors move in phase or in antiphase, 1/2 for a travelling wave with equal real and
        imaginary parts.
    """
    # The rotation that makes the sum of squares real and positive minimises the imaginary part.
    turned = vector * np.exp(-0.5j * np.angle(np.sum(vector**2)))
    real = turned.real
    complexity = float(np.sum(turned.imag**2) / np.sum(np.abs(turned) ** 2))
    return real / real[np.argmax(np.abs(real))], complexity


def _shapes(name: str, given: ArrayLike) -> ComplexArray:
    shapes = np.atleast_2d(np.asarray(given, dtype=np.complex128))
    if shapes.ndim != 2 or not shapes.size:
        allowed = "one row per mode and one column per sensor"
        raise InputError(name, f"an array of shape {shapes.shape}", allowed, "Reshape it.")
    length = np.sum(np.abs(shapes) ** 2, axis=1)
    wrong = np.flatnonzero(~(np.isfinite(length) & (length > 0)))
    if len(wrong):
        raise InputError(
            f"{name}, mode {wrong[0]}",
            "a shape that is zero or not finite",
            "finite shapes that are not zero",
            "Leave that mode out.",
        )
    return shapes
