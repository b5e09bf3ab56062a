"""The pile by itself, as a turbine and as a part of a system."""

from __future__ import annotations

import numpy as np
import pytest

import offwind_pin as ow
from offwind_pin.analysis.foundation.pile_only import axis_jacobian, pile_only, pile_part
from offwind_pin.definitions.turbine import PointMass


def test_pile_only_ends_at_the_mudline(oc6: ow.Turbine) -> None:
    """Members above are gone, the cut has the section that is there, and nothing is damped."""
    pile = pile_only(oc6)
    assert (pile.toe, pile.yaw_bearing) == (-75.0, -30.0)
    assert [member.name for member in pile.members] == ["monopile"]
    assert pile.members[0].stations[-1].diameter == 9.0
    assert pile.structural_damping is None
    system = ow.build(pile, "distributed_springs")
    steel = 8500 * np.pi / 4 * (9.0**2 - 8.78**2) * 45
    assert ow.static(system).mudline_load[2] == pytest.approx(0.0, abs=1.0)
    weight = -ow.static(system).section_load[0, 2]
    assert weight == pytest.approx(steel * 9.80665, rel=1e-6)


def test_stick_up_interpolates_the_section(oc6: ow.Turbine) -> None:
    """A cut between two stations of the tower takes the diameter and thickness there."""
    pile = pile_only(oc6, stick_up=30.0 + (10.0 + 20.51) / 2)
    assert [member.name for member in pile.members] == ["monopile", "tower"]
    cut = pile.members[-1].stations[-1]
    assert cut.diameter == pytest.approx((8.30 + 8.02) / 2)
    assert cut.thickness == pytest.approx(0.070)
    assert len(pile.members[-1].stations) == 2


def test_a_point_mass_above_the_cut_goes_with_it(oc6: ow.Turbine) -> None:
    masses = [
        PointMass(name=name, z_m=z, mass_kg=1e4) for name, z in (("flange", 10.0), ("plug", -50.0))
    ]
    heavy = oc6.model_copy(update={"point_masses": tuple(masses)})
    assert [mass.name for mass in pile_only(heavy).point_masses] == ["plug"]


@pytest.mark.parametrize("stick_up", [-1.0, 200.0, float("nan")])
def test_a_cut_off_the_structure_is_refused(oc6: ow.Turbine, stick_up: float) -> None:
    with pytest.raises(ow.InputError, match="stick_up"):
        pile_only(oc6, stick_up)


def test_a_turbine_without_a_pile_is_refused(oc6: ow.Turbine) -> None:
    monopile = oc6.members[0]
    top = monopile.stations[-1]
    short = monopile.model_copy(update={"stations": (top.model_copy(update={"z": -30.0}), top)})
    clamped = oc6.model_copy(update={"members": (short, *oc6.members[1:])})
    with pytest.raises(ow.InputError, match="below the mudline"):
        pile_only(clamped)


@pytest.mark.parametrize("element", ["euler_bernoulli", "timoshenko"])
def test_part_of_a_system_is_the_pile_built_alone(undamped: ow.Turbine, element: str) -> None:
    """Cut out of the whole chain or built from the pile's own definition: the same equations."""
    whole = ow.build(undamped, "distributed_springs", ow.StillWater(), element=element)  # type: ignore[arg-type]
    part = pile_part(whole)
    alone = ow.build(pile_only(undamped), "distributed_springs", element=element)  # type: ignore[arg-type]
    assert part.chain.joint_name == alone.chain.joint_name
    assert part.chain.boundary == pytest.approx(alone.chain.boundary, abs=1e-12)
    q = 1e-3 * np.random.default_rng(1).standard_normal(part.nv)
    a, b = part.equations(), alone.equations()
    assert a.mass(q) == pytest.approx(b.mass(q), rel=1e-9, abs=1e-3)
    stiffness = b.tangents(0.0, q, 0 * q)[0]
    assert a.tangents(0.0, q, 0 * q)[0] == pytest.approx(stiffness, rel=1e-9, abs=1.0)


def test_a_system_that_ends_at_the_mudline_has_no_pile(clamped_dry: ow.System) -> None:
    with pytest.raises(ow.InputError, match="distributed_springs"):
        pile_part(clamped_dry)


def test_axis_jacobian_is_the_motion_of_the_head(undamped: ow.Turbine) -> None:
    """Against differences of the head's place and axis, in a bent state."""
    pile = ow.build(pile_only(undamped), "distributed_springs", elements=4)
    rng = np.random.default_rng(2)
    q, v = 1e-2 * rng.standard_normal(pile.nv), rng.standard_normal(pile.nv)
    equations = pile.equations()
    jacobian = axis_jacobian(equations.chain_motion(q, 0 * q), -30.0)

    def head(step: float) -> np.ndarray:
        motion = equations.chain_motion(q + step * v, 0 * q).points_at(np.array([-30.0]))
        return np.concatenate([motion.position[0], motion.axis[0]])

    rate = (head(1e-6) - head(-1e-6)) / 2e-6
    moved = jacobian @ v
    assert rate[:3] == pytest.approx(moved[:3], rel=1e-7)
    assert rate[3:] == pytest.approx(np.cross(moved[3:], head(0.0)[3:]), abs=1e-7)
