"""p-y curves: secants, tangents, plateaus, interpolation in depth."""

import itertools
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from offwind_pin.errors import InputError
from offwind_pin.loads.soil_curves import (
    SoilCurves,
    curve_energy,
    linear_curves,
    tabulated_curves,
    tanh_curves,
)

MODULUS = np.array([0.0, 2e7, 9e8])
ULTIMATE = np.array([0.0, 1e6, 4e7])

TABLE = """\
# two depths, the upper one on another grid
depth_m,y_m,p_n_per_m
0,0,0
0,0.01,1e5
0,0.05,2e5
10,0.01,4e5
10,0.10,6e5
"""


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "curves.csv"
    path.write_text(TABLE)
    return path


def make(kind: str, table: Path) -> SoilCurves:
    """Three nodes of each kind of curve."""
    if kind == "linear":
        return linear_curves(MODULUS)
    if kind == "tanh":
        return tanh_curves(MODULUS, ULTIMATE)
    return tabulated_curves(table, np.array([0.0, 5.0, 10.0]))


KINDS = ["linear", "tanh", "table"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("y", [1e-9, 1e-4, 0.013, 0.3])
def test_secant_is_resistance_over_displacement(kind: str, y: float, table: Path) -> None:
    """K_s(y) y = p(y)."""
    curves, at = make(kind, table), np.full(3, y)
    assert_allclose(curves.secant(at) * at, curves.resistance(at), rtol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_secant_at_rest_is_the_initial_tangent(kind: str, table: Path) -> None:
    """The limit of p / y at y = 0 is dp/dy, and the secant gets there without a jump."""
    curves, zero = make(kind, table), np.zeros(3)
    assert_allclose(curves.secant(zero), curves.tangent(zero), rtol=1e-15)
    assert_allclose(curves.secant(zero + 1e-12), curves.secant(zero), rtol=1e-8)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("y", [0.004, 0.03, 0.07])
def test_tangent_against_differences(kind: str, y: float, table: Path) -> None:
    """dp/dy by central differences; truncation is (step / y)^2."""
    curves, at, step = make(kind, table), np.full(3, y), 1e-6
    slope = (curves.resistance(at + step) - curves.resistance(at - step)) / (2 * step)
    assert_allclose(curves.tangent(at), slope, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("y", [0.0, 1e-9, 2e-6, 1e-4, 0.013, 0.3])
def test_energy_is_the_integral_of_the_resistance(kind: str, y: float, table: Path) -> None:
    """The integral of p from 0 to y, by Gauss between the table's points; past its end p is flat."""
    curves = make(kind, table)
    points, weights = np.polynomial.legendre.leggauss(20)
    edges = np.unique(np.concatenate([np.minimum([0.0, 0.01, 0.05, 0.1], y), [y]]))
    expected = np.zeros(3)
    for low, high in itertools.pairwise(edges):
        for x, weight in zip((1 + points) / 2, weights / 2, strict=True):
            p = curves.resistance(np.full(3, low + x * (high - low)))
            expected += weight * (high - low) * p
    found = [curve_energy(numbers, y) for numbers in curves.numbers]
    assert_allclose(found, expected, rtol=1e-11)


def test_linear_numbers() -> None:
    """p = k y."""
    assert_allclose(linear_curves(MODULUS).resistance(np.full(3, 0.01)), MODULUS * 0.01)


def test_tanh_plateau() -> None:
    """Far out p is the ultimate resistance, and the tangent has gone, without overflow."""
    curves, far = tanh_curves(MODULUS, ULTIMATE), np.full(3, 100.0)
    assert_allclose(curves.resistance(far), ULTIMATE, rtol=1e-12)
    assert np.all(curves.tangent(far) < 1e-200)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.0, 10.0), st.floats(0.0, 10.0))
def test_tanh_softens(y: float, more: float) -> None:
    """The secant falls with displacement and lies between tangent and initial modulus."""
    curves = tanh_curves(MODULUS, ULTIMATE)
    here, further = np.full(3, y), np.full(3, y + more)
    slack = 1e-12 * MODULUS
    assert np.all(curves.secant(further) <= curves.secant(here) + slack)
    assert np.all(curves.tangent(here) <= curves.secant(here) + slack)
    assert np.all(curves.secant(here) <= MODULUS + slack)


def test_table_meets_its_points_and_stays_flat_beyond(table: Path) -> None:
    """At tabulated depths p is the tabulated p; past the last y it stays."""
    curves = tabulated_curves(table, np.array([0.0, 10.0]))
    assert_allclose(curves.resistance(np.array([0.01, 0.01])), [1e5, 4e5])
    assert_allclose(curves.resistance(np.array([0.05, 0.10])), [2e5, 6e5])
    assert_allclose(curves.resistance(np.array([7.0, 7.0])), [2e5, 6e5])
    assert_allclose(curves.tangent(np.array([7.0, 7.0])), 0.0)


def test_table_without_origin_is_led_to_it(table: Path) -> None:
    """The curve at 10 m starts at y = 0.01 m: a straight line joins it to the origin."""
    curves = tabulated_curves(table, np.array([10.0]))
    assert_allclose(curves.secant(np.array([0.0])), 4e5 / 0.01)
    assert_allclose(curves.resistance(np.array([0.005])), 2e5)


def test_table_is_linear_in_depth_and_held_outside(table: Path) -> None:
    """Between depths p is interpolated at equal y; above and below the nearest curve holds."""
    curves = tabulated_curves(table, np.array([-1.0, 0.0, 2.5, 10.0, 40.0]))
    p = curves.resistance(np.full(5, 0.01))
    assert_allclose(p, [1e5, 1e5, 1.75e5, 4e5, 4e5])
    p = curves.resistance(np.full(5, 0.1))
    assert_allclose(p, [2e5, 2e5, 3e5, 6e5, 6e5])


HEADER = "depth_m,y_m,p_n_per_m\n"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "no rows"),
        (HEADER, "no rows"),
        ("depth,y,p\n0,0,0\n", "header"),
        (HEADER + "0,0,0\n0,0.01\n", "line 3"),
        (HEADER + "0,0,0\n0,0.01,many\n", "column 3"),
        (HEADER + "0,0,0\n0,nan,1\n", "column 2"),
        (HEADER + "0,0,0\n0,0.01,-5\n", "line 3"),
        (HEADER + "0,0.02,5\n0,0.01,6\n", "rising"),
        (HEADER + "0,0,7\n0,0.01,8\n", "origin"),
        (HEADER + "0,0,0\n", "two points"),
    ],
    ids=[
        "empty",
        "header only",
        "header",
        "short",
        "word",
        "nan",
        "sign",
        "order",
        "origin",
        "one",
    ],
)
def test_bad_table_is_refused(tmp_path: Path, text: str, told: str) -> None:
    """Every fault is told with the file and the place."""
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=told) as caught:
        tabulated_curves(path, np.zeros(1))
    assert str(path) in str(caught.value)


def test_missing_table_is_refused(tmp_path: Path) -> None:
    """A table that is not there is named."""
    with pytest.raises(InputError, match="no such file"):
        tabulated_curves(tmp_path / "none.csv", np.zeros(1))


def test_ground_without_strength_gives_nothing() -> None:
    """Where p_u is zero, resistance, secant and tangent are zero, whatever the modulus."""
    curves = tanh_curves(np.array([1e7, 1e7]), np.array([0.0, 1e6]))
    y = np.array([0.1, 0.1])
    assert curves.resistance(y)[0] == curves.secant(y)[0] == curves.tangent(y)[0] == 0
    assert curves.secant(y)[1] > 0


def test_ground_without_stiffness_gives_nothing() -> None:
    """Where the modulus is zero, as at the mudline of sand, neither force nor energy is there."""
    (numbers,) = (curves := tanh_curves(np.zeros(1), np.array([1e6]))).numbers
    y = np.array([0.1])
    assert curves.resistance(y)[0] == curves.tangent(y)[0] == curve_energy(numbers, 0.1) == 0
