"""Hollow frusta in closed form against quadrature of the defining integrals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from offwind_pin.structure.frustum import AxialBody, Frustum

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(64)
# The integrands are polynomials, so that quadrature and closed form differ by rounding alone; a
# wall of a hundredth of the radius loses two digits of sixteen.
TOLERANCE = 1e-12


def by_quadrature(frustum: Frustum) -> AxialBody:
    """Rahman et al. (MECC 2025), Eq. 5, by 64 Gauss points."""
    s = (1 + POINTS) / 2
    z, weight = frustum.height * s, frustum.height / 2 * WEIGHTS
    outer = frustum.outer_bottom + (frustum.outer_top - frustum.outer_bottom) * s
    inner = frustum.inner_bottom + (frustum.inner_top - frustum.inner_bottom) * s
    mass_density = frustum.density * np.pi * (outer**2 - inner**2)
    ring = frustum.density * np.pi * (outer**4 - inner**4)
    mass = weight @ mass_density
    center = weight @ (mass_density * z) / mass
    transverse = weight @ (ring / 4 + mass_density * (z - center) ** 2)
    return AxialBody(mass, center, transverse, weight @ ring / 2)


def assert_same(body: AxialBody, reference: AxialBody) -> None:
    for name in ("mass", "center", "transverse", "axial"):
        assert getattr(body, name) == pytest.approx(getattr(reference, name), rel=TOLERANCE)


@pytest.mark.parametrize(
    "frustum",
    [
        Frustum(4.0, 4.5, 4.5, 4.39, 4.39, 8500.0),
        Frustum(10.51, 4.15, 4.01, 4.08, 3.94, 8500.0),
        Frustum(10.0, 2.0, 0.5, 0.0, 0.0, 1000.0),
    ],
    ids=["monopile", "tower", "solid cone"],
)
def test_closed_form_equals_quadrature(frustum: Frustum) -> None:
    """Mass, centre and both moments of inertia are the integrals."""
    assert_same(frustum.lump(), by_quadrature(frustum))


radius = st.floats(0.3, 10.0)
share = st.floats(0.0, 0.99)


@settings(max_examples=60, deadline=None)
@given(radius, radius, share, share, st.floats(0.05, 50.0))
def test_closed_form_equals_quadrature_for_any_radii(
    bottom: float, top: float, hollow_bottom: float, hollow_top: float, height: float
) -> None:
    """The same for any taper, wider above or below, solid or hollow."""
    frustum = Frustum(height, bottom, top, hollow_bottom * bottom, hollow_top * top, 7850.0)
    assert_same(frustum.lump(), by_quadrature(frustum))


@settings(max_examples=30, deadline=None)
@given(radius, radius, st.floats(0.1, 0.9))
def test_cut_and_combined_frustum_is_the_whole(bottom: float, top: float, cut: float) -> None:
    """Two parts, joined by the parallel-axis theorem, weigh and turn like the whole."""
    height, wall = 7.0, 0.1
    at_cut = bottom + cut * (top - bottom)
    whole = Frustum(height, bottom, top, bottom - wall, top - wall, 8000.0)
    lower = Frustum(cut * height, bottom, at_cut, bottom - wall, at_cut - wall, 8000.0)
    upper = Frustum((1 - cut) * height, at_cut, top, at_cut - wall, top - wall, 8000.0)
    assert_same(AxialBody.combine([lower.lump(), upper.lump(cut * height)]), whole.lump())


def test_base_height_shifts_the_centre_alone() -> None:
    """Moving a frustum up moves its centre and nothing else."""
    frustum = Frustum(4.0, 3.0, 2.5, 2.9, 2.4, 8000.0)
    low, high = frustum.lump(), frustum.lump(base=37.0)
    assert high.center - low.center == pytest.approx(37.0, rel=1e-15)
    assert (high.mass, high.transverse, high.axial) == (low.mass, low.transverse, low.axial)


def test_combining_nothing_weighs_nothing() -> None:
    """No parts, and massless parts, make a massless body rather than a division by zero."""
    assert AxialBody.combine([]).mass == 0
    assert AxialBody.combine([AxialBody(0.0, 3.0, 0.0, 0.0)]) == AxialBody(0.0, 3.0, 0.0, 0.0)
