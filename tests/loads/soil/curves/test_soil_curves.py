"""p-y curves: secants, tangents, plateaus, interpolation in depth."""

import itertools
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from offwind_pin.base.errors import InputError
from offwind_pin.loads.soil.curves.laws import (
    ConicCurves,
    LinearCurves,
    PowerCurves,
    TanhCurves,
)
from offwind_pin.loads.soil.curves.soil_curve import SoilCurve, stack_curves
from offwind_pin.loads.soil.curves.tabulated import tabulated_curve, tabulated_curves

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


def make(kind: str, table: Path) -> SoilCurve:
    """Three nodes of each kind of curve."""
    if kind == "linear":
        return LinearCurves(MODULUS)
    if kind == "tanh":
        return TanhCurves(MODULUS, ULTIMATE)
    if kind == "power":
        return PowerCurves(
            ULTIMATE, np.array([0.2, 0.05, 0.01]), np.full(3, 0.25), np.full(3, 1e-4)
        )
    if kind == "conic":
        ratio, curvature = np.array([3.0, 300.0, 40.0]), np.array([0.8, 0.94, 0.1])
        return ConicCurves(np.array([0.2, 0.5, 0.05]), ULTIMATE, ratio, curvature)
    if kind == "bilinear":
        return ConicCurves(np.full(3, 0.5), ULTIMATE, np.full(3, 25.0), np.zeros(3))
    return tabulated_curves(table, np.array([0.0, 5.0, 10.0]))


KINDS = ["linear", "tanh", "table", "power", "conic", "bilinear"]

CORNERS = [0.0, 1e-4, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5]
"""Where curves of one kind or another have a corner or end."""


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
    """dp/dy by central differences; truncation is (step / y)^2, rounding that of p over the step."""
    curves, at, step = make(kind, table), np.full(3, y), 1e-6
    slope = (curves.resistance(at + step) - curves.resistance(at - step)) / (2 * step)
    assert_allclose(curves.tangent(at), slope, rtol=1e-6, atol=0.05)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("y", [0.0, 1e-9, 2e-6, 1e-4, 0.013, 0.3])
def test_energy_is_the_integral_of_the_resistance(kind: str, y: float, table: Path) -> None:
    """The integral of p from 0 to y, by Gauss on fine panels between the corners of the curves."""
    curves = make(kind, table)
    points, weights = np.polynomial.legendre.leggauss(20)
    fine = np.concatenate([CORNERS, np.geomspace(1e-5, 0.5, 60)])
    edges = np.unique(np.concatenate([np.minimum(fine, y), [y]]))
    expected = np.zeros(3)
    for low, high in itertools.pairwise(edges):
        for x, weight in zip((1 + points) / 2, weights / 2, strict=True):
            p = curves.resistance(np.full(3, low + x * (high - low)))
            expected += weight * (high - low) * p
    assert_allclose(curves.energy(np.full(3, y)), expected, rtol=1e-10, atol=1e-40)


def test_linear_numbers() -> None:
    """p = k y."""
    assert_allclose(LinearCurves(MODULUS).resistance(np.full(3, 0.01)), MODULUS * 0.01)


def test_tanh_plateau() -> None:
    """Far out p is the ultimate resistance, and the tangent has gone, without overflow."""
    curves, far = TanhCurves(MODULUS, ULTIMATE), np.full(3, 100.0)
    assert_allclose(curves.resistance(far), ULTIMATE, rtol=1e-12)
    assert np.all(curves.tangent(far) < 1e-200)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.0, 10.0), st.floats(0.0, 10.0))
def test_tanh_softens(y: float, more: float) -> None:
    """The secant falls with displacement and lies between tangent and initial modulus."""
    curves = TanhCurves(MODULUS, ULTIMATE)
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
    ("text", "message"),
    [
        ("", "no rows"),
        (HEADER, "no rows"),
        ("depth,y,p\n0,0,0\n", "header"),
        (HEADER + "0,0,0\n0,0.01\n", "line 3"),
        (HEADER + "0,0,0\n0,0.01,many\n", "column 3"),
        (HEADER + "0,0,0\n0,nan,1\n", "column 2"),
        (HEADER + "0,0,0\n0,0.01,-5\n", "line 3"),
        (HEADER + "0,0.02,5\n0,0.01,6\n", "increasing"),
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
def test_bad_table_is_refused(tmp_path: Path, text: str, message: str) -> None:
    """Every fault is reported with the file and the place."""
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message) as caught:
        tabulated_curves(path, np.zeros(1))
    assert str(path) in str(caught.value)


def test_missing_table_is_refused(tmp_path: Path) -> None:
    """A table that is not there is named."""
    with pytest.raises(InputError, match="no such file"):
        tabulated_curves(tmp_path / "none.csv", np.zeros(1))


def test_ground_without_strength_gives_nothing() -> None:
    """Where p_u is zero, resistance, secant and tangent are zero, whatever the modulus."""
    curves = TanhCurves(np.array([1e7, 1e7]), np.array([0.0, 1e6]))
    y = np.array([0.1, 0.1])
    assert curves.resistance(y)[0] == curves.secant(y)[0] == curves.tangent(y)[0] == 0
    assert curves.secant(y)[1] > 0


def test_ground_without_stiffness_gives_nothing() -> None:
    """Where the modulus is zero, as at the mudline of sand, neither force nor energy is there."""
    curves = TanhCurves(np.zeros(1), np.array([1e6]))
    y = np.array([0.1])
    assert curves.resistance(y)[0] == curves.tangent(y)[0] == curves.energy(y)[0] == 0


def test_power_numbers() -> None:
    """p_u (y / y_u)^n between the line from the origin and the plateau."""
    curves = PowerCurves(*(np.full(3, v) for v in (6e5, 0.4, 0.25, 1e-3)))
    p = curves.resistance(np.array([5e-4, 0.025, 0.9]))
    assert_allclose(p, [6e5 * (1e-3 / 0.4) ** 0.25 / 2, 6e5 / 2, 6e5], rtol=1e-14)
    assert_allclose(curves.tangent(np.array([5e-4, 0.025, 0.9]))[1:], [3e5 / 0.1, 0], rtol=1e-14)


@settings(max_examples=200, deadline=None)
@given(
    st.floats(0.0, 0.99),
    st.floats(1.0, 1e4),
    st.floats(1e-9, 1.5),
)
def test_conic_lies_on_its_equation(n: float, ratio: float, x: float) -> None:
    """-n (Y - X)^2 + (1 - n) (Y - K X) (Y - 1) = 0, on the branch above the chord."""
    end, ultimate = 0.3, 7e5
    curves = ConicCurves(*(np.array([v]) for v in (end, ultimate, ratio, n)))
    y = curves.resistance(np.array([x * end]))[0] / ultimate
    if x >= 1:
        assert y == pytest.approx(1.0, rel=1e-14)
        return
    residual = -n * (y - x) ** 2 + (1 - n) * (y - ratio * x) * (y - 1)
    assert abs(residual) < 1e-13 * (1 + ratio * x)
    assert x * (1 - 1e-12) <= y <= min(1.0, ratio * x) * (1 + 1e-12)
    tangent = curves.tangent(np.array([x * end]))[0]
    secant = curves.secant(np.array([x * end]))[0]
    assert -1e-12 * secant <= tangent <= secant * (1 + 1e-9)


@pytest.mark.parametrize("n", [1e-4, 0.1, 0.5, 0.9, 0.99])
@pytest.mark.parametrize("ratio", [1.5, 20.0, 5000.0])
def test_energy_of_sharp_and_round_conics(n: float, ratio: float) -> None:
    """Against the corrected rule of trapezoids on graded points, near the knee and beyond."""
    curve = ConicCurves(*(np.array([v]) for v in (1.0, 1.0, ratio, n)))
    for y in (0.1 / ratio, 2 / ratio, 0.3, 0.999):
        grid = np.concatenate([[0.0], np.geomspace(y * 1e-6, y, 20000)])
        curves = curve.at(np.zeros(len(grid), dtype=np.intp))
        p, slope = curves.resistance(grid), curves.tangent(grid)
        step = np.diff(grid)
        # with slopes at the ends of each step (Euler and Maclaurin) the error is of fourth order
        expected = np.sum((p[1:] + p[:-1]) / 2 * step - step**2 / 12 * np.diff(slope))
        assert curve.energy(np.array([y]))[0] == pytest.approx(expected, rel=1e-8)


def test_conic_without_curvature_bends_once() -> None:
    """The initial slope up to the plateau, which comes before y_u."""
    curves = ConicCurves(*(np.full(3, v) for v in (0.5, 4e6, 10.0, 0.0)))
    y = np.array([0.04, 0.05, 0.3])
    assert_allclose(curves.resistance(y), [3.2e6, 4e6, 4e6], rtol=1e-14)
    assert_allclose(curves.tangent(y), [8e7, 0, 0], rtol=1e-14)


def test_conic_along_its_chord_is_straight() -> None:
    """K = 1 leaves no room for a curve: the chord, whatever the curvature."""
    curves = ConicCurves(*(np.full(2, v) for v in (0.5, 4e6, 1.0, 0.7)))
    assert_allclose(curves.resistance(np.array([0.2, 0.8])), [1.6e6, 4e6], rtol=1e-12)
    assert curves.energy(np.full(2, 0.2)) == pytest.approx([1.6e5, 1.6e5], rel=1e-12)


def test_laws_stack(table: Path) -> None:
    """Each curve keeps its values, tangents and energies among others, wherever it goes."""
    parts = [make(kind, table) for kind in KINDS]
    places = np.random.default_rng(3).permutation(3 * len(KINDS)).reshape(len(KINDS), 3)
    stacked = stack_curves(list(zip(places, parts, strict=True)))
    for y in (0.0, 0.003, 0.07, 0.9):
        at = np.full(3 * len(KINDS), y)
        for where, part in zip(places, parts, strict=True):
            assert_allclose(stacked.secant(at)[where], part.secant(at[:3]), rtol=1e-15)
            assert_allclose(stacked.tangent(at)[where], part.tangent(at[:3]), rtol=1e-15)
            assert_allclose(stacked.energy(at)[where], part.energy(at[:3]), rtol=1e-15)


@pytest.mark.parametrize("kind", KINDS)
def test_ultimate_is_the_largest_resistance(kind: str, table: Path) -> None:
    """No displacement gives more, and some gives that much; a straight line has no end."""
    curves = make(kind, table)
    if kind == "linear":
        assert curves.ultimate.tolist() == [0.0, np.inf, np.inf]
        return
    most = np.max([curves.resistance(np.full(3, y)) for y in np.geomspace(1e-3, 1e3, 200)], axis=0)
    assert_allclose(curves.ultimate, most, rtol=1e-9)


LAYERED = """\
depth_m,y_m,p_n_per_m
0,0.1,1e5
4,0.1,3e5
5,0.1,9e5
8,0.1,6e5
"""


def test_table_is_not_interpolated_across_boundaries(tmp_path: Path) -> None:
    """Between 4 and 5 m the boundary decides; on it the layer below holds."""
    path = tmp_path / "layered.csv"
    path.write_text(LAYERED)
    depth = np.array([2.0, 4.2, 4.5 - 1e-6, 4.5, 4.5 - 1e-12, 4.9, 6.5])
    y = np.full(len(depth), 0.1)
    p = tabulated_curves(path, depth, (4.5,)).resistance(y)
    assert_allclose(p, [2e5, 3e5, 3e5, 9e5, 9e5, 9e5, 7.5e5])
    p = tabulated_curves(path, depth, (5.0,)).resistance(y)
    assert_allclose(p, [2e5, 3e5, 3e5, 3e5, 3e5, 3e5, 7.5e5])
    assert tabulated_curves(path, depth).resistance(y)[1] == pytest.approx(4.2e5)


def test_layer_without_a_curve_is_refused(tmp_path: Path) -> None:
    """A layer that the table says nothing of is named with its edges."""
    path = tmp_path / "layered.csv"
    path.write_text(LAYERED)
    with pytest.raises(InputError, match=r"no curve from 5.5 m to 7.0 m"):
        tabulated_curves(path, np.zeros(1), (5.5, 7.0))


def test_table_of_one_curve(tmp_path: Path) -> None:
    """Displacement and resistance without depth."""
    path = tmp_path / "toe.csv"
    path.write_text("z_m,q_n\n0.01,2e6\n0.1,5e6\n")
    curve = tabulated_curve(path, ("z_m", "q_n"))
    assert curve.secant(np.zeros(1))[0] == pytest.approx(2e8)
    assert curve.ultimate.tolist() == [5e6]
    path.write_text("z_m,q_n\n0.1,2e6\n0.01,5e6\n")
    with pytest.raises(InputError, match="z_m"):
        tabulated_curve(path, ("z_m", "q_n"))


def test_like_laws_are_one_group(table: Path) -> None:
    """Layers of one law are evaluated together; parts of a mixture keep their curves and order."""
    one, other = make("tanh", table), make("linear", table)
    stacked = stack_curves(
        [(np.arange(3), one), (np.arange(3, 6), other), (np.arange(6, 9), make("tanh", table))]
    )
    assert [type(law) for _, law in stacked.groups] == [TanhCurves, LinearCurves]
    chosen = np.array([7, 4, 1, 8])
    y = np.full(9, 0.02)
    assert_allclose(stacked.at(chosen).secant(y[:4]), stacked.secant(y)[chosen], rtol=1e-15)
    assert type(stacked.at(np.array([0, 7]))) is TanhCurves
