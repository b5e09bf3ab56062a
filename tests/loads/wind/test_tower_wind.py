"""Wind on the tower: profiles and gusts by hand, drag against quadrature, its effect at rest."""

import itertools

import numpy as np
import pytest
from helpers.hydrodynamics import upright
from scipy.integrate import quad

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.wind.profiles import (
    ExtremeOperatingGust,
    LogLaw,
    PowerLaw,
    Profile,
    WindSeries,
)
from offwind_pin.loads.wind.tower_drag import TowerDrag, TowerWind, tower_drag
from offwind_pin.structure.section import outer_diameter

CALM = TowerWind(12.0, 119.0, PowerLaw(0.14), 0.65)
GUST = ExtremeOperatingGust(8.0, start=3.0)


@pytest.fixture(scope="module")
def system(oc6: ow.Turbine) -> ow.System:
    return ow.build(oc6, "clamped", ow.StillWater(), elements=20)


def force_of(load: TowerDrag, time: float = 0.0, rise: float = 1.0, velocity: float = 0.0) -> Array:
    return load.forces(time, upright(load.height, velocity), rise).force


def test_profiles_by_hand() -> None:
    """The reference speed at the reference height, and the laws' own ratios elsewhere."""
    z = np.array([10.0, 50.0, 100.0])
    assert PowerLaw(0.2).ratio(z, 100.0) == pytest.approx([0.1**0.2, 0.5**0.2, 1.0])
    expected = np.log(z / 0.002) / np.log(100.0 / 0.002)
    assert LogLaw(0.002).ratio(z, 100.0) == pytest.approx(expected)
    assert np.all(PowerLaw(0.0).ratio(z, 100.0) == 1)
    for profile in (PowerLaw(0.14), LogLaw(0.001)):
        low = profile.ratio(np.array([0.0, 0.5, 1.0]), 90.0)
        assert np.all(low == low[-1])


@pytest.mark.parametrize("profile", [PowerLaw(0.14), LogLaw(0.002)], ids=["power", "log"])
def test_drag_is_the_integral_over_the_tower(
    system: ow.System, oc6: ow.Turbine, profile: Profile
) -> None:
    """Force and moment about still water of rho/2 Cd D U(z)^2, from the water to the bearing."""
    load = tower_drag(system, CALM.replace(profile=profile))
    ends = [0.0, 1.0, *(station.z for member in oc6.members for station in member.stations)]
    ends = sorted({z for z in ends if z >= 0})

    def line(z: float, power: int) -> float:
        at = np.array([z])
        speed = 12.0 * profile.ratio(at, 119.0)[0]
        return float(0.5 * 1.225 * 0.65 * outer_diameter(oc6, at)[0] * speed**2 * z**power)

    exact = [
        sum(quad(line, a + 1e-12, b - 1e-12, args=(p,))[0] for a, b in itertools.pairwise(ends))
        for p in (0, 1)
    ]
    force = force_of(load)
    assert np.all(force[:, 1:] == 0)
    found = [force[:, 0].sum(), load.height @ force[:, 0]]
    assert found == pytest.approx(exact, rel=1e-4)


def test_direction_turns_the_force(system: ow.System) -> None:
    along = force_of(tower_drag(system, CALM))
    turned = force_of(tower_drag(system, CALM.replace(direction_deg=np.degrees(0.7))))
    assert turned[:, 0] == pytest.approx(np.cos(0.7) * along[:, 0], rel=1e-13)
    assert turned[:, 1] == pytest.approx(np.sin(0.7) * along[:, 0], rel=1e-13)


def test_a_tower_that_moves_with_the_wind_feels_none(system: ow.System) -> None:
    load = tower_drag(system, CALM.replace(profile=PowerLaw(0.0)))
    assert np.all(force_of(load, velocity=12.0) == 0)
    with_it, against = (force_of(load, velocity=v)[:, 0].sum() for v in (2.0, -2.0))
    assert with_it / against == pytest.approx((10 / 14) ** 2, rel=1e-13)


def test_it_is_morison_s_kernel() -> None:
    """One kernel for the drag of water and wind."""
    assert TowerDrag.force_kernel is MorisonForce.force_kernel
    assert TowerDrag.tangent_kernel is MorisonForce.tangent_kernel


def test_the_gust_s_shape() -> None:
    """Zero outside its period; 0.74 V_gust in the middle, after and before a dip."""
    time = np.linspace(0.0, 20.0, 20001)
    speed = GUST.at(time)
    assert np.abs(speed[(time <= 3.0) | (time >= 13.5)]).max() < 1e-12
    assert speed.max() == pytest.approx(0.74 * 8.0, rel=1e-6)
    assert time[np.argmax(speed)] == pytest.approx(3.0 + 10.5 / 2, abs=1e-3)
    early, late = speed[time < 6.0].min(), speed[time > 10.5].min()
    assert early == pytest.approx(late, rel=1e-5)
    assert -0.37 * 8.0 < early < -0.2 * 8.0


def test_the_gust_of_a_class_by_hand() -> None:
    """Class I, B at 25 m/s, 119 m, rotor 198 m: the scatter governs; near V_e1 the other bound."""
    gust = ExtremeOperatingGust.of_class(
        25.0, 119.0, 198.0, reference_speed=50.0, turbulence=0.14, start=5.0
    )
    assert gust.size == pytest.approx(3.3 * 0.14 * 24.35 / (1 + 19.8 / 42.0), rel=1e-12)
    high = ExtremeOperatingGust.of_class(
        54.0, 119.0, 198.0, reference_speed=50.0, turbulence=0.14, start=5.0
    )
    assert high.size == pytest.approx(1.35 * 2.0, rel=1e-12)
    low = ExtremeOperatingGust.of_class(
        25.0, 40.0, 50.0, reference_speed=50.0, turbulence=0.14, start=5.0
    )
    assert low.size == pytest.approx(3.3 * 0.14 * 24.35 / (1 + 5.0 / 28.0), rel=1e-12)


@pytest.mark.parametrize("gust", [GUST, WindSeries(np.array([0.0, 10.0]), np.array([-1.0, 3.0]))])
def test_the_gust_rises_with_the_simulation(
    system: ow.System, gust: ExtremeOperatingGust | WindSeries
) -> None:
    """At a rise of 0 the mean blows alone; the gust adds the same speed at every height."""
    gusty = tower_drag(system, CALM.replace(profile=PowerLaw(0.0), gust=gust))
    steady = tower_drag(system, CALM.replace(profile=PowerLaw(0.0)))
    assert np.array_equal(force_of(gusty, 8.0, 0.0), force_of(steady))
    more = float(gust.at(np.array([8.0]))[0])
    assert abs(more) > 0.5
    ratio = force_of(gusty, 8.0, 1.0)[:, 0] / force_of(steady)[:, 0]
    assert ratio == pytest.approx(np.full(len(ratio), (1 + more / 12.0) ** 2), rel=1e-12)


def test_the_base_bears_the_wind(system: ow.System) -> None:
    """Statics: shear and moment at the mudline are those of the forces on the deflected tower."""
    load = tower_drag(system, CALM.replace(speed=40.0))
    bare, blown = ow.static(system), ow.static(system, loads=[load])
    force = force_of(load)[:, 0]
    change = blown.mudline_load - bare.mudline_load
    assert change[0] == pytest.approx(force.sum(), rel=1e-3)
    upright_moment = (load.height + 30.0) @ force
    # what is more is the weight on the tower's deflection
    weight = system.turbine.site.gravity * system.chain.rna.mass
    assert (
        upright_moment
        < change[4]
        < upright_moment
        + 3 * weight * (blown.tower_top_displacement[0] - bare.tower_top_displacement[0])
    )


def test_a_steady_wind_in_time_stays_at_its_static_state(system: ow.System) -> None:
    load = tower_drag(system, CALM)
    data = ow.simulate(system, 4.0, 0.02, [load], save_at=ow.SaveAt(0.5))
    static = ow.static(system, loads=[load])
    top = data["displacement"].sel(direction="x").isel(height=-1).to_numpy()
    assert top == pytest.approx(np.full(len(top), static.tower_top_displacement[0]), rel=1e-6)
