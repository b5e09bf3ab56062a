"""Mass and its moments, whatever the number of elements."""

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.registry import make_foundation
from offwind_pin.structure.chain import build_chain
from offwind_pin.structure.frustum import AxialBody
from offwind_pin.verification.plain_tubes import tube

FOUNDATIONS = ["clamped", "distributed_springs"]


def whole(turbine: ow.Turbine, foundation: str, elements: int | None) -> AxialBody:
    """All bodies of the chain as one."""
    support = make_foundation(turbine, foundation)
    chain = build_chain(
        turbine, base=support.base, free_root=support.root is not None, elements=elements
    )
    return AxialBody.combine(list(chain.body))


@pytest.mark.parametrize("foundation", FOUNDATIONS)
@pytest.mark.parametrize("elements", [3, 8, 25, 111])
def test_moments_do_not_depend_on_the_elements(
    oc6: ow.Turbine, foundation: str, elements: int
) -> None:
    """Mass, centre and both inertias of the benchmark are those of its default chain."""
    found, reference = whole(oc6, foundation, elements), whole(oc6, foundation, None)
    for name in ("mass", "center", "transverse", "axial"):
        assert getattr(found, name) == pytest.approx(getattr(reference, name), rel=1e-12)


def test_mass_matrix_of_rigid_motion(undamped: ow.Turbine) -> None:
    """The root's six rows are the rigid body's, on few elements and on many, assembly included."""
    blocks = [
        ow.build(undamped, "coupled_springs", elements=n)
        .equations()
        .mass(np.zeros(6 + 3 * n))[:6, :6]
        for n in (3, 30)
    ]
    assert blocks[0] == pytest.approx(blocks[1], rel=1e-12, abs=1e-12 * blocks[0].max())


def test_point_masses_are_counted_once() -> None:
    """Masses at the base, on a boundary, at a joint and at the top each weigh once."""
    plain = tube()
    heights = (-20.0, 5.0, 30.0, 42.5, 80.0)
    masses = [
        {"name": f"m{i}", "z": z, "mass": 1000.0 * (i + 1), "inertia": (10.0, 10.0, 20.0)}
        for i, z in enumerate(heights)
    ]
    loaded = ow.Turbine.model_validate(
        plain.model_dump()
        | {
            "point_masses": masses,
            "site": {"water_depth": 20.0, "water_density": 1000.0, "gravity": 1.0},
        }
    )
    for elements in (1, 2, 4, 8, 20):
        extra = whole(loaded, "clamped", elements).mass - whole(plain, "clamped", elements).mass
        assert extra == pytest.approx(15000.0, rel=1e-9)
