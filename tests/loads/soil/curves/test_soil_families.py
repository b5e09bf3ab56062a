"""Published p-y families against their formulas, written out here with plain numbers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from offwind_pin.base.errors import InputError
from offwind_pin.definitions.soil.layers import LayeredGround
from offwind_pin.loads.soil.curves.layered import (
    base_moment_curve,
    base_shear_curve,
    lateral_curves,
    rocking_curves,
)
from offwind_pin.loads.soil.curves.soil_curve import SoilCurves
from offwind_pin.loads.soil.soil_profile import PileNodes

DIAMETER, LENGTH = 8.0, 32.0
DEPTHS = [0.0, 1.5, 7.0, 20.0, 32.0]
DISPLACEMENTS = [1e-6, 1e-4, 1e-3, 4e-3, 0.02, 0.07, 0.15, 0.4, 1.0, 5.0]
ROTATIONS = [1e-7, 1e-5, 1e-4, 4e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.5]
WEIGHT = 9.5e3


def ground(loading: str, **layer: Any) -> LayeredGround:
    """One layer from the mudline down."""
    layer |= {"top_m": 0.0, "submerged_unit_weight_n_per_m3": WEIGHT}
    return LayeredGround.model_validate({"kind": "layers", "loading": loading, "layers": [layer]})


def at(depth: float, scour: float = 0.0) -> PileNodes:
    """One node."""
    return PileNodes(np.array([depth]), np.array([DIAMETER]), LENGTH, scour)


def value(curves: SoilCurves | None, y: float) -> float:
    """p(y) of the only node."""
    assert curves is not None
    return float(curves.resistance(np.array([y]))[0])


def slope(curves: SoilCurves | None) -> float:
    """Initial slope of the only node."""
    assert curves is not None
    return float(curves.secant(np.zeros(1))[0])


def sand_numbers(phi_deg: float, depth: float, *, cyclic: bool) -> tuple[float, float]:
    """API RP 2GEO: A p_u in N/m and k z in N/m2."""
    phi, b = math.radians(phi_deg), 0.4
    beta = math.radians(45 + phi_deg / 2)
    c1 = (
        b * math.tan(phi) * math.sin(beta) / (math.tan(beta - phi) * math.cos(phi / 2))
        + math.tan(beta) ** 2 * math.tan(phi / 2) / math.tan(beta - phi)
        + b * math.tan(beta) * (math.tan(phi) * math.sin(beta) - math.tan(phi / 2))
    )
    ka = math.tan(math.radians(45 - phi_deg / 2)) ** 2
    c2 = math.tan(beta) / math.tan(beta - phi) - ka
    c3 = b * math.tan(phi) * math.tan(beta) ** 4 + ka * (math.tan(beta) ** 8 - 1)
    stress = WEIGHT * depth
    pu = min((c1 * depth + c2 * DIAMETER) * stress, c3 * DIAMETER * stress)
    a = 0.9 if cyclic else max(0.9, 3 - 0.8 * depth / DIAMETER)
    k = max(5400.0, 1000 * (0.1978 * phi_deg**2 - 10.232 * phi_deg + 136.82)) * 1e3
    return a * pu, k * depth


@pytest.mark.parametrize("loading", ["static", "cyclic"])
@pytest.mark.parametrize("phi", [24.0, 30.0, 36.0, 40.0])
@pytest.mark.parametrize("depth", DEPTHS)
def test_api_sand(loading: str, phi: float, depth: float) -> None:
    """p = A p_u tanh(k z y / (A p_u)); nothing at the mudline."""
    curves = lateral_curves(ground(loading, model="api_sand", friction_angle_deg=phi), at(depth))
    plateau, k = sand_numbers(phi, depth, cyclic=loading == "cyclic")
    for y in DISPLACEMENTS:
        expected = plateau * math.tanh(k * y / plateau) if depth else 0.0
        assert value(curves, y) == pytest.approx(expected, rel=1e-10)
    assert slope(curves) == pytest.approx(k, rel=1e-12)
    assert curves.ultimate[0] == pytest.approx(plateau, rel=1e-12)


def test_api_sand_of_a_chart() -> None:
    """Coefficients at 30 degrees as read off API's chart: C1 1.9, C2 2.7, C3 29."""
    deep, shallow = (
        sand_numbers(30.0, 30.0, cyclic=True)[0],
        sand_numbers(30.0, 1e-6, cyclic=True)[0],
    )
    assert shallow / (0.9 * WEIGHT * 1e-6 * DIAMETER) == pytest.approx(2.7, rel=0.02)
    c1 = (deep / (0.9 * WEIGHT * 30) - 2.67 * DIAMETER) / 30
    assert c1 == pytest.approx(1.9, rel=0.03)


def test_api_sand_with_a_modulus_of_its_own() -> None:
    """A given rise of the modulus takes the place of the formula."""
    layer = {"model": "api_sand", "friction_angle_deg": 33.0, "initial_modulus_n_per_m3": 1.7e7}
    assert slope(lateral_curves(ground("static", **layer), at(6.0))) == pytest.approx(1.7e7 * 6)


SU, EPS = 42e3, 0.012


@pytest.mark.parametrize("loading", ["static", "cyclic"])
@pytest.mark.parametrize("j", [0.25, 0.5])
@pytest.mark.parametrize("depth", DEPTHS)
def test_matlock_clay(loading: str, j: float, depth: float) -> None:
    """Polygons over y / y50; cyclic curves fall above z_R."""
    layer = {
        "model": "matlock_clay",
        "undrained_shear_strength_pa": SU,
        "strain_50": EPS,
        "j": j,
    }
    curves = lateral_curves(ground(loading, **layer), at(depth))
    y50 = 2.5 * EPS * DIAMETER
    pu = min(9 * SU * DIAMETER, (3 * SU + WEIGHT * depth) * DIAMETER + j * SU * depth)
    points = [(0, 0), (0.1, 0.23), (0.3, 0.33), (1, 0.5), (3, 0.72), (8, 1.0)]
    if loading == "cyclic":
        reach = max(2.5 * DIAMETER, 6 * DIAMETER / (WEIGHT * DIAMETER / SU + j))
        points = [*points[:5], (15, 0.72 * min(1.0, depth / reach))]
    for y in [*DISPLACEMENTS, *(x * y50 for x, _ in points[1:])]:
        expected = np.interp(y / y50, *np.array(points, dtype=float).T) * pu
        assert value(curves, y) == pytest.approx(expected, rel=1e-10, abs=1e-9 * pu)
    assert slope(curves) == pytest.approx(2.3 * pu / y50, rel=1e-12)
    assert curves.ultimate[0] == pytest.approx((1.0 if loading == "static" else 0.72) * pu)


@pytest.mark.parametrize("cycles", [None, 1, 200, 1e4])
@pytest.mark.parametrize("depth", DEPTHS)
def test_stiff_clay(cycles: float | None, depth: float) -> None:
    """The cyclic displacement y_s + y50 C log N with C = 9.6 (p / p_u)^4, turned round for p."""
    layer = {"model": "stiff_clay", "undrained_shear_strength_pa": 130e3, "strain_50": 0.005}
    if cycles is not None:
        layer["cycles"] = cycles
    curves = lateral_curves(ground("static" if cycles is None else "cyclic", **layer), at(depth))
    y50 = 2.5 * 0.005 * DIAMETER
    pu = min(9 * 130e3 * DIAMETER, (3 * 130e3 + WEIGHT * depth) * DIAMETER + 0.5 * 130e3 * depth)

    def displacement(share: float) -> float:
        static = y50 * (2 * share) ** 4
        return static + y50 * 9.6 * share**4 * math.log10(cycles or 1)

    end = displacement(1.0)
    for y in np.geomspace(end / 150, 3 * end, 10):
        share = 1.0 if y >= end else brentq(lambda s, y=y: displacement(s) - y, 0, 1, xtol=1e-15)
        assert value(curves, float(y)) == pytest.approx(share * pu, rel=1e-10)
    assert displacement(160**-0.25) == pytest.approx(end / 160, rel=1e-12)
    assert slope(curves) == pytest.approx(160**0.75 * pu / end, rel=1e-12)
    assert value(curves, end / 320) == pytest.approx(160**-0.25 * pu / 2, rel=1e-12)
    assert curves.ultimate[0] == pytest.approx(pu)


def conic(x: float, xu: float, k: float, n: float, yu: float) -> float:
    """The published conic, solved by bracketing on its way from the origin to the plateau."""
    if x >= xu:
        return yu
    if n == 0:
        return min(k * x, yu)

    def residual(y: float) -> float:
        return -n * (y / yu - x / xu) ** 2 + (1 - n) * (y / yu - x * k / yu) * (y / yu - 1)

    # above the chord and below both the initial slope and the plateau lies one root only
    return brentq(residual, yu * x / xu, min(k * x, yu), xtol=1e-300, rtol=1e-15)


G0, DR = 90e6, 0.72


def cowden(z: float) -> dict[str, tuple[float, float, float, float]]:
    """Byrne et al. (2020): (x_u, k, n, y_u) of the four reactions."""
    r, s = z / DIAMETER, LENGTH / DIAMETER
    m = (1.42 - 0.09643 * r, 0.2899 - 0.04775 * r)
    return {
        "p": (241.4, 10.6 - 1.65 * r, 0.939 - 0.03345 * r, 10.7 - 7.101 * math.exp(-0.3085 * r)),
        "m": (m[1] / m[0], m[0], 0.0, m[1]),
        "H": (235.7, 2.717 - 0.3575 * s, 0.8793 - 0.0315 * s, 0.4038 + 0.04812 * s),
        "M": (173.1, 0.2146 - 0.002132 * s, 1.079 - 0.1087 * s, 0.8192 - 0.08588 * s),
    }


def bothkennar(z: float) -> dict[str, tuple[float, float, float, float]]:
    """Burd et al. (2020), Bothkennar clay."""
    r, s = z / DIAMETER, LENGTH / DIAMETER
    m = (1.698 - 0.1576 * r, 0.4862 - 0.05674 * r)
    return {
        "p": (
            173.8,
            12.05 - 1.547 * r,
            0.7204 - 0.002679 * r,
            7.743 - 3.945 * math.exp(-0.8456 * r),
        ),
        "m": (m[1] / m[0], m[0], 0.0, m[1]),
        "H": (291.5, 3.008 - 0.2701 * s, 0.3113 + 0.04263 * s, 0.5279 + 0.06864 * s),
        "M": (187.0, 0.3409 - 0.01995 * s, 0.699 - 0.1155 * s, 0.8756 - 0.09195 * s),
    }


def dunkirk(z: float) -> dict[str, tuple[float, float, float, float]]:
    """Burd et al. (2020), General Dunkirk Sand Model."""
    r, q, s = z / DIAMETER, z / LENGTH, LENGTH / DIAMETER
    mu = 0.2605 + (-0.1989 + 0.2019 * DR) * q
    return {
        "p": (
            146.1 - 92.11 * DR,
            8.731 - 0.6982 * DR - 0.9178 * r,
            0.917 + 0.06193 * DR,
            0.3667 + 25.89 * DR + (0.3375 - 8.9 * DR) * q,
        ),
        "m": (mu / 17.0, 17.0, 0.0, mu),
        "H": (
            0.5150 + 2.883 * DR + (0.1695 - 0.7018 * DR) * s,
            6.505 - 2.985 * DR + (-0.007969 - 0.4299 * DR) * s,
            0.09978 + 0.7974 * DR + (0.004994 - 0.07005 * DR) * s,
            0.09952 + 0.7996 * DR + (0.03988 - 0.1606 * DR) * s,
        ),
        "M": (
            44.89,
            0.3515,
            0.300 + 0.4986 * DR,
            0.09981 + 0.3710 * DR + (0.01998 - 0.09041 * DR) * s,
        ),
    }


CLAY = {"undrained_shear_strength_pa": 110e3, "shear_modulus_pa": G0}
PUBLISHED: dict[str, tuple[Any, dict[str, float]]] = {
    "cowden_till": (cowden, CLAY),
    "bothkennar_clay": (bothkennar, CLAY),
    "general_dunkirk_sand": (dunkirk, {"relative_density": DR, "shear_modulus_pa": G0}),
}


@pytest.mark.parametrize("name", PUBLISHED)
@pytest.mark.parametrize("depth", [0.5, 7.0, 20.0, 32.0])
def test_pisa(name: str, depth: float) -> None:
    """The four reactions with their normalisation; initial slopes and plateaus."""
    parameters, layer = PUBLISHED[name]
    sand = name == "general_dunkirk_sand"
    curve, node = ground("static", model="pisa", calibration=name, **layer), at(depth)
    found = rocking_curves(curve, node)
    assert found is not None
    _, rocking = found
    assert rocking.by_lateral[0] == sand
    strength = WEIGHT * depth if sand else 110e3
    toe = WEIGHT * LENGTH if sand else 110e3
    # size of the resistance, scale of the displacement
    scales = {
        "p": (lateral_curves(curve, node), strength * DIAMETER, DIAMETER * strength / G0),
        "m": (rocking.curves, DIAMETER if sand else strength * DIAMETER**2, strength / G0),
        "H": (base_shear_curve(curve, node), toe * DIAMETER**2, DIAMETER * toe / G0),
        "M": (base_moment_curve(curve, node), toe * DIAMETER**3, toe / G0),
    }
    for reaction, (curves, size, scale) in scales.items():
        numbers = parameters(depth)[reaction]
        for x in DISPLACEMENTS if reaction in "pH" else ROTATIONS:
            expected = conic(x / scale, *numbers) * size
            assert value(curves, x) == pytest.approx(expected, rel=1e-10), reaction
        assert slope(curves) == pytest.approx(numbers[1] * size / scale, rel=1e-10)
        assert curves is not None
        assert curves.ultimate[0] == pytest.approx(numbers[3] * size, rel=1e-12)
        assert value(curves, 1.01 * numbers[0] * scale) == pytest.approx(curves.ultimate[0])


def test_pisa_sand_at_the_mudline_gives_nothing() -> None:
    """No stress, no resistance, neither lateral nor rocking, and no NaN."""
    layer = PUBLISHED["general_dunkirk_sand"][1]
    curve = ground("static", model="pisa", calibration="general_dunkirk_sand", **layer)
    found = rocking_curves(curve, at(0.0))
    assert found is not None
    _, rocking = found
    for curves in (lateral_curves(curve, at(0.0)), rocking.curves):
        assert value(curves, 0.1) == slope(curves) == curves.ultimate[0] == 0.0


def test_pisa_with_parameters_of_ones_own() -> None:
    """Cowden's numbers typed in give Cowden's curves; another plateau another one."""
    reaction = {"ultimate_displacement": 235.7, "initial_stiffness": 2.0, "curvature": 0.7}
    parameters = {
        "soil": "clay",
        "lateral": {
            "ultimate_displacement": 241.4,
            "initial_stiffness": {"constant": 10.6, "slope": -1.65, "over": "z/D"},
            "curvature": {"constant": 0.939, "slope": -0.03345, "over": "z/D"},
            "ultimate_resistance": {
                "constant": 10.7,
                "amplitude": -7.101,
                "rate": 0.3085,
                "over": "z/D",
            },
        },
        "rocking": {"initial_stiffness": 1.2, "curvature": 0.0, "ultimate_resistance": 0.2},
        "base_shear": {**reaction, "ultimate_resistance": 0.5},
        "base_moment": {**reaction, "ultimate_resistance": 0.6},
    }
    own = ground("static", model="pisa", parameters=parameters, **CLAY)
    published = ground("static", model="pisa", calibration="cowden_till", **CLAY)
    y, node = np.array([0.05]), at(9.0)
    assert_allclose(
        lateral_curves(own, node).resistance(y), lateral_curves(published, node).resistance(y)
    )
    assert base_shear_curve(own, node).ultimate[0] == pytest.approx(0.5 * 110e3 * DIAMETER**2)  # type: ignore[union-attr]


def test_pisa_far_outside_its_calibration_is_refused() -> None:
    """At L/D = 8 the stiffness of Cowden till is negative at the toe: reported with the reaction."""
    curve = ground("static", model="pisa", calibration="cowden_till", **CLAY)
    node = PileNodes(np.array([60.0]), np.array([DIAMETER]), 64.0)
    with pytest.raises(InputError, match=r"reaction lateral.*z/D = 7.5"):
        lateral_curves(curve, node)
    with pytest.raises(InputError, match="base_shear"):
        base_shear_curve(curve, node)


def test_pisa_without_stiffness_is_refused() -> None:
    """A shear modulus of zero where the clay has strength is no curve."""
    layer = {**CLAY, "shear_modulus_pa": {"gradient": 1e7}}
    curve = ground("static", model="pisa", calibration="cowden_till", **layer)
    with pytest.raises(InputError, match="shear_modulus_pa"):
        lateral_curves(curve, at(0.0))
