"""Axes and signs, one experiment each: x downwind, y left looking downwind, z up."""

import numpy as np
import pytest
from helpers.poses import body_poses
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import offwind_pin as ow

Array = NDArray[np.float64]
FX, FY, FZ, MX, MY, MZ = range(6)


@pytest.fixture(scope="module")
def turbine(undamped: ow.Turbine) -> ow.Turbine:
    """The benchmark with an axisymmetric assembly, so that nothing moves until it is loaded."""
    rna = {
        "kind": "rigid_body",
        "mass": 8.4e5,
        "center_of_mass": (0.0, 0.0, 3.2),
        "inertia": np.diag([1.4e8, 1.4e8, 1.1e8]).tolist(),
    }
    data = undamped.model_dump() | {"rna": rna}
    return ow.Turbine.model_validate(data)


@pytest.fixture(scope="module", params=["clamped", "coupled_springs", "distributed_springs"])
def system(turbine: ow.Turbine, request: pytest.FixtureRequest) -> ow.System:
    return ow.build(turbine, request.param, ow.StillWater(), elements=20)


def answer(system: ow.System, component: int, size: float) -> ow.StaticResult:
    load = np.zeros(6)
    load[component] = size
    return ow.static(system, load)


def twist(system: ow.System, q: Array) -> float:
    """Rotation of the assembly about z in rad."""
    rotation = body_poses(system, q)[-1]
    return float(np.arctan2(rotation[1, 0], rotation[0, 0]))


def test_nothing_moves_sideways_without_a_load(system: ow.System) -> None:
    """Under gravity alone an axisymmetric turbine stands upright."""
    result = ow.static(system)
    assert np.abs(result.displacement[:, :2]).max() < 1e-12
    assert np.abs(result.mudline_load[[FX, FY, MX, MY, MZ]]).max() < 1e-3
    assert result.mudline_load[FZ] < 0


def test_push_downwind(system: ow.System) -> None:
    """+Fx: the top moves to +x and leans about +y; at the mudline Fx and My are positive."""
    result = answer(system, FX, 1e6)
    assert result.tower_top_displacement[0] > 0.1
    assert abs(result.tower_top_displacement[1]) < 1e-9
    assert result.tower_top_rotation[1] > 0
    assert result.mudline_load[FX] == pytest.approx(1e6, rel=1e-9)
    # Arm of 145.63 m, and the weight on the deflected axis adds to it.
    assert result.mudline_load[MY] > 1e6 * 145.63
    assert abs(result.mudline_load[MX]) < 1e-6 * result.mudline_load[MY]


def test_push_to_the_left(system: ow.System) -> None:
    """+Fy: the top moves to +y and leans about -x; at the mudline Fy is positive, Mx negative."""
    result = answer(system, FY, 1e6)
    assert result.tower_top_displacement[1] > 0.1
    assert result.tower_top_rotation[0] < 0
    assert result.mudline_load[FY] == pytest.approx(1e6, rel=1e-9)
    assert result.mudline_load[MX] < -1e6 * 145.63


def test_pull_up(system: ow.System) -> None:
    """+Fz: less weight at the mudline by the pull; on springs the structure rises."""
    rest, result = ow.static(system), answer(system, FZ, 1e6)
    assert result.mudline_load[FZ] - rest.mudline_load[FZ] == pytest.approx(1e6, rel=1e-9)
    rise = result.tower_top_displacement[2] - rest.tower_top_displacement[2]
    # The chain itself is stiff along its axis; the springs of 1.119691e10 N/m are not.
    expected = 0.0 if system.foundation.root is None else 1e6 / 1.119691e10
    assert rise == pytest.approx(expected, rel=1e-6, abs=1e-12)


def test_twist(system: ow.System) -> None:
    """+Mz: the assembly turns about +z, and the mudline carries +Mz."""
    result = answer(system, MZ, 1e7)
    assert twist(system, result.q) > 1e-5
    assert result.mudline_load[MZ] == pytest.approx(1e7, rel=1e-9)


def test_nod_and_roll(system: ow.System) -> None:
    """+My bends the top towards +x, +Mx towards -y."""
    assert answer(system, MY, 1e8).tower_top_displacement[0] > 0
    assert answer(system, MX, 1e8).tower_top_displacement[1] < 0


@pytest.mark.parametrize("degrees", [30.0, 90.0, 200.0])
def test_turning_the_load_turns_the_answer(system: ow.System, degrees: float) -> None:
    """Rotation of the load about z rotates displacements and section loads.

    A node's three angles in series are not quite symmetric: with 1e-3 rad at a node, terms of third
    order are 1e-6 of the answer.
    """
    angle = np.radians(degrees)
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    load = np.array([1e6, 0, 0, 0, 2e7, 0])
    turned_load = np.concatenate([turn @ load[:3], turn @ load[3:]])
    straight, turned = ow.static(system, load), ow.static(system, turned_load)
    size = np.abs(straight.displacement).max()
    assert_allclose(turned.displacement, straight.displacement @ turn.T, atol=1e-6 * size)
    for part in (slice(0, 3), slice(3, 6)):
        expected = straight.section_load[:, part] @ turn.T
        assert_allclose(
            turned.section_load[:, part], expected, rtol=0, atol=1e-5 * np.abs(expected).max()
        )


def test_the_benchmark_itself_is_not_symmetric(undamped: ow.Turbine) -> None:
    """Negative control: with the real assembly, a turned load does not give the turned answer."""
    system = ow.build(undamped, "clamped", elements=20)
    along, across = answer(system, FX, 1e6), answer(system, FY, 1e6)
    assert abs(along.tower_top_displacement[0] - across.tower_top_displacement[1]) > 0.05
