"""Tangents and energies of every point load against central differences of its forces."""

import importlib
import pkgutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.hydrodynamics import RegularWater
from helpers.numerics import relative_difference
from helpers.point_loads import EveryKind

import offwind_pin as ow
from offwind_pin.base.definition import Array
from offwind_pin.definitions.hydrodynamics import FloodedPile
from offwind_pin.definitions.rotor_disc import rotor_disc
from offwind_pin.definitions.soil.depth_profile import DepthLine
from offwind_pin.definitions.soil.springs import CurveTable, LinearModulus
from offwind_pin.loads.point_load import GroupedLoad, KernelLoad, PointMotion, PointTangents
from offwind_pin.loads.python_load import PythonLoad
from offwind_pin.loads.sea.forces.added_mass import AddedMass, SplashAddedMass
from offwind_pin.loads.sea.forces.buoyancy import Buoyancy
from offwind_pin.loads.sea.forces.morison import MorisonForce
from offwind_pin.loads.sea.forces.strips import Strips, strips_up_to
from offwind_pin.loads.sea.hydrodynamic_loads import HydrodynamicModel, contents
from offwind_pin.loads.soil.curves.laws import (
    ConicCurves,
    LinearCurves,
    PolygonCurves,
    PowerCurves,
    TanhCurves,
)
from offwind_pin.loads.soil.curves.soil_curve import stack_curves
from offwind_pin.loads.soil.curves.tabulated import soil_curves
from offwind_pin.loads.soil.springs.dashpot import NO_DASHPOT, Dashpot
from offwind_pin.loads.soil.springs.elastic import (
    LATERAL,
    ROCKING,
    TORSIONAL,
    VERTICAL,
    SoilSprings,
    SpringComponent,
)
from offwind_pin.loads.soil.springs.frictional_moment import FrictionalMoment
from offwind_pin.loads.soil.springs.hysteretic import HystereticSprings
from offwind_pin.loads.soil.springs.pile import pile_nodes
from offwind_pin.loads.structural.coupled_damping import CoupledDamping
from offwind_pin.loads.structural.inertial_damping import InertialDamping
from offwind_pin.loads.structural.mass_damping import MassDamping
from offwind_pin.loads.tower_top.load_history import TowerTopLoad
from offwind_pin.loads.wind.history import WindHistory
from offwind_pin.loads.wind.profiles import ExtremeOperatingGust, PowerLaw
from offwind_pin.loads.wind.rotor_thrust import Control, RotorThrust
from offwind_pin.loads.wind.tower_drag import TowerDrag, TowerWind, tower_drag

TIME, RISE = 2.3, 0.7
STEP, SIZE = 1e-5, 0.05
"""Difference step and size of the motion, in m, m/s or m/s2; truncation is about
(STEP / SIZE)^2 = 4e-8, rounding 1e-16 SIZE / STEP = 1e-12."""
TOLERANCE = 10 * (STEP / SIZE) ** 2

TABLE = "depth_m,y_m,p_n_per_m\n0,0.01,1e4\n0,0.1,2e4\n50,0.02,1e7\n50,0.1,3e7\n"

Load = KernelLoad | GroupedLoad
Maker = Callable[[ow.Turbine, Path], Load]


def soil(kind: str, dashpot: str) -> Maker:
    """Springs on a kind of curve, with a kind of dashpot or none."""

    def make(oc6: ow.Turbine, folder: Path) -> SoilSprings:
        springs = oc6.soil.distributed_springs
        assert springs is not None
        if kind == "linear":
            curve = LinearModulus(kind="linear", modulus=DepthLine(at_mudline=2e8))
            springs = springs.model_copy(update={"curve": curve})
        elif kind == "table":
            (folder / "py.csv").write_text(TABLE)
            table = CurveTable(kind="table", file=folder / "py.csv")
            springs = springs.model_copy(update={"curve": table})
        height, length = pile_nodes(springs.nodes, oc6.site.mudline, oc6.toe)
        curves = soil_curves(springs.curve, oc6.site.mudline - height)
        return SoilSprings("soil", LATERAL, height, length, curves, DASHPOTS[dashpot])

    return make


DASHPOTS = {
    "elastic": NO_DASHPOT,
    "secant": Dashpot(np.zeros(1), np.array([0.04])),
    "secant by size": Dashpot(np.array([0.01, 0.07, 0.2]), np.array([0.01, 0.05, 0.3])),
    "initial": Dashpot(np.zeros(1), np.zeros(1), 0.04),
}


def along(direction: SpringComponent, dashpot: str) -> Maker:
    """Springs that resist another motion than the lateral one."""

    def make(oc6: ow.Turbine, folder: Path) -> SoilSprings:
        height, length = pile_nodes(7, oc6.site.mudline, oc6.toe)
        curves = TanhCurves(np.full(7, 3e8), np.full(7, 2e7))
        return SoilSprings("soil", direction, height, length, curves, DASHPOTS[dashpot])

    return make


def mixed(oc6: ow.Turbine, folder: Path) -> SoilSprings:
    """Nodes of every law, in no order."""
    height, length = pile_nodes(11, oc6.site.mudline, oc6.toe)
    two = np.full(2, 1.0)
    laws = (
        LinearCurves(2e8 * two),
        TanhCurves(3e8 * two, 2e7 * two),
        PolygonCurves(np.outer(two, [0, 0.03, 0.3]), np.outer(two, [0, 4e6, 9e6])),
        PowerCurves(2e7 * two, 0.4 * two, 0.25 * two, 0.01 * two),
        ConicCurves(0.5 * two, 2e7 * two, 9.0 * two, 0.8 * two),
    )
    places = np.array([[4, 1], [0, 9], [3, 8], [7, 2], [6, 5]])
    last = np.array([10]), laws[1].at(np.array([0]))
    curves = stack_curves([*zip(places, laws, strict=True), last])
    return SoilSprings("soil", LATERAL, height, length, curves, NO_DASHPOT)


def sliding(direction: SpringComponent, size: float) -> Maker:
    """Sliders, most of which yield in the motion below for a small size of their deflections."""

    def make(oc6: ow.Turbine, folder: Path) -> HystereticSprings:
        height, length = pile_nodes(7, oc6.site.mudline, oc6.toe)
        curves = TanhCurves(np.full(7, 3e8), np.full(7, 3e8 * size))
        dashpot = DASHPOTS["initial"]
        return HystereticSprings("soil", direction, height, length, curves, dashpot, sliders=9)

    return make


def friction(oc6: ow.Turbine, folder: Path) -> FrictionalMoment:
    height, length = pile_nodes(7, oc6.site.mudline, oc6.toe)
    lateral = TanhCurves(np.full(7, 3e8), np.full(7, 2e7))
    return FrictionalMoment(height, length, lateral, TanhCurves(np.full(7, 40.0), np.full(7, 2.0)))


def waves(oc6: ow.Turbine, folder: Path) -> MorisonForce:
    return HydrodynamicModel.of(
        oc6, ow.IrregularWaves(2.0, 6.0, seed=2, repeat_period=60.0)
    ).wave_force()


def still_water(oc6: ow.Turbine, folder: Path) -> MorisonForce:
    return HydrodynamicModel.of(oc6, ow.StillWater()).wave_force()


def moving_water(oc6: ow.Turbine, folder: Path) -> AddedMass:
    return HydrodynamicModel.of(oc6, ow.StillWater()).permanent_added_mass()


def splashed(oc6: ow.Turbine) -> tuple[Strips, RegularWater]:
    """Strips through the splash zone of a wave 3 m high whose surface lies amid a strip."""
    height, length, wet = strips_up_to(-6.0, 4.0, still=0.0, lowest=-3.0, highest=3.0)
    water = RegularWater(height, -oc6.site.mudline, 3.0, 0.7, 0.05, stretched=True)
    return Strips(height, length, np.full(len(height), 9.0), wet), water


def splashing(oc6: ow.Turbine, folder: Path) -> MorisonForce:
    strips, water = splashed(oc6)
    return MorisonForce(strips, water, 1025.0, 1.0, 1.0)


def splash_added_mass(oc6: ow.Turbine, folder: Path) -> SplashAddedMass:
    strips, water = splashed(oc6)
    return SplashAddedMass(strips, 1025.0 * strips.volume, water)


def buoyancy(oc6: ow.Turbine, folder: Path) -> Buoyancy:
    strips, water = splashed(oc6)
    return Buoyancy(strips, 1e4, 63.6, 0.0, water)


def water_inside(oc6: ow.Turbine, folder: Path) -> KernelLoad:
    return contents(oc6, FloodedPile(kind="flooded", level=-1.0))[0]


def pressure_inside(oc6: ow.Turbine, folder: Path) -> KernelLoad:
    wet = oc6.hydrodynamics.model_copy(update={"buoyancy": True})
    turbine = oc6.model_copy(update={"hydrodynamics": wet})
    return contents(turbine, FloodedPile(kind="flooded", level=-1.0))[1]


def wind(oc6: ow.Turbine, folder: Path) -> TowerDrag:
    gust = ExtremeOperatingGust(8.0, start=0.0)
    blowing = TowerWind(20.0, 100.0, PowerLaw(0.14), 0.7, direction_deg=np.degrees(0.5), gust=gust)
    return tower_drag(ow.build(oc6, "clamped", elements=12), blowing)


def tower_top(oc6: ow.Turbine, folder: Path) -> TowerTopLoad:
    history = ow.LoadHistory(np.array([0.0, 5.0]), np.ones((2, 6)) * [[1e6], [2e6]], "test")
    return TowerTopLoad(oc6.yaw_bearing, history, history.at(0.0))


def running_rotor(mean: float, control: Control, *, inflow_lag: bool = False) -> Maker:
    """A rotor in a wind that differs from its mean."""

    def make(oc6: ow.Turbine, folder: Path) -> RotorThrust:
        wind = WindHistory(4.0, np.array([0.97, 1.06]) * mean, mean, "test")
        return RotorThrust(rotor_disc(oc6), wind, control, inflow_lag=inflow_lag)

    return make


def written_in_python(oc6: ow.Turbine, folder: Path) -> PythonLoad:
    return PythonLoad(EveryKind(np.linspace(oc6.site.mudline, oc6.yaw_bearing, 4)))


def in_proportion_to_mass(oc6: ow.Turbine, folder: Path) -> MassDamping:
    height = np.linspace(oc6.site.mudline, oc6.yaw_bearing, 4)
    return MassDamping("mass", height, np.arange(1.0, 25.0).reshape(4, 6) * 1e4)


EXAMPLES: dict[type[Load], dict[str, Maker]] = {
    SoilSprings: {
        f"soil {kind} {dashpot}": soil(kind, dashpot)
        for kind in ("linear", "tanh", "table")
        for dashpot in DASHPOTS
    }
    | {
        "soil vertical": along(VERTICAL, "secant by size"),
        "soil rocking": along(ROCKING, "secant by size"),
        "soil torsional": along(TORSIONAL, "initial"),
        "soil mixed elastic": mixed,
    },
    HystereticSprings: {
        "soil sliding": sliding(LATERAL, 0.02),
        "soil sliding vertically": sliding(VERTICAL, 0.02),
        "soil sliding in rocking": sliding(ROCKING, 0.05),
        "soil sliding in torsion": sliding(TORSIONAL, 0.02),
    },
    FrictionalMoment: {"friction": friction},
    MorisonForce: {"waves": waves, "still water": still_water, "splashing": splashing},
    AddedMass: {"added mass": moving_water, "water inside": water_inside},
    TowerDrag: {"wind": wind},
    SplashAddedMass: {"splash added mass": splash_added_mass},
    Buoyancy: {"buoyancy": buoyancy, "pressure inside": pressure_inside},
    TowerTopLoad: {"tower top": tower_top},
    RotorThrust: {
        "rotor below rated": running_rotor(8.4, "lagged"),
        "rotor above rated": running_rotor(12.6, "lagged"),
        "rotor with an instant controller": running_rotor(12.6, "instant"),
        "rotor in a wake that lags": running_rotor(8.4, "lagged", inflow_lag=True),
        "rotor beyond its table": running_rotor(24.9, "instant"),
    },
    PythonLoad: {"written in Python": written_in_python},
    MassDamping: {"damping in proportion to mass": in_proportion_to_mass},
}
"""Every load there is, with examples that reach each of its branches."""

LOADS = {name: make for examples in EXAMPLES.values() for name, make in examples.items()}
STORING = [
    name
    for kind, examples in EXAMPLES.items()
    for name in examples
    if kind in (SoilSprings, AddedMass)
]
"""Loads that store what they do not dissipate; sliders that yield do not, see test_hysteretic."""


def descendants(kind: type[Load]) -> Iterator[type[Load]]:
    for child in kind.__subclasses__():
        yield child
        yield from descendants(child)


def without_example(kinds: Iterable[type[Load]], parts: set[type[KernelLoad]]) -> list[str]:
    """The package's loads that are neither in the table above nor parts of loads that are.

    Inertial damping is a base class. Coupled damping has no tangents of its own: tests of modal
    damping check the Newton matrix.
    """
    own = [
        kind
        for kind in kinds
        if kind.__module__.startswith("offwind_pin.")
        and kind not in {InertialDamping, CoupledDamping}
    ]
    return [kind.__name__ for kind in own if not (EXAMPLES.get(kind) or kind in parts)]


def test_every_load_has_an_example(oc6: ow.Turbine, tmp_path: Path) -> None:
    """A new load, wherever in the package, must come into the table and so be checked."""
    for module in pkgutil.walk_packages(ow.__path__, "offwind_pin."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    found = [*descendants(KernelLoad), *descendants(GroupedLoad)]
    assert set(EXAMPLES) <= set(found)
    parts = set()
    for kind, examples in EXAMPLES.items():
        for make in examples.values():
            load = make(oc6, tmp_path)
            assert type(load) is kind
            parts |= {type(part) for part in load.compiled()}
    assert without_example(found, parts) == []


def test_a_load_without_example_is_found() -> None:
    """Negative control: a class that is not in the table is named."""
    assert without_example([SoilSprings, KernelLoad], set()) == ["KernelLoad"]


def some_motion(load: Load) -> PointMotion:
    """Points off their places, moving and accelerated, on an inclined axis."""
    n = len(load.height)
    rng = np.random.default_rng(n)
    u = rng.uniform(-SIZE, SIZE, (n, 3))
    u[:, :2] += np.sign(u[:, :2]) * SIZE
    v, a = rng.uniform(-SIZE, SIZE, (2, n, 3))
    axis = np.array([0.0, 0.0, 1.0]) + rng.uniform(-0.1, 0.1, (n, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    turn, spin = rng.uniform(SIZE, 2 * SIZE, (2, n, 3)) * rng.choice([-1, 1], (2, n, 3))
    place = u + np.column_stack([np.zeros((n, 2)), load.height])
    return PointMotion(place, u, v, axis, a, turn, spin)


BLOCKS = {
    "stiffness": ("force", ("position", "displacement")),
    "damping": ("force", ("velocity",)),
    "inertia": ("force", ("acceleration",)),
    "turning": ("force", ("axis",)),
    "moment_coupling": ("moment", ("position", "displacement")),
    "moment_stiffness": ("moment", ("rotation_vector",)),
    "moment_damping": ("moment", ("angular_velocity",)),
}
"""What each block of the tangents is a derivative of, and by which parts of the motion."""

NOT_THERE = [
    (of, by)
    for of in ("force", "moment")
    for by in (
        ("position", "displacement"),
        ("velocity",),
        ("acceleration",),
        ("axis",),
        ("rotation_vector",),
        ("angular_velocity",),
    )
    if (of, by) not in BLOCKS.values()
]
"""Derivatives that no block is for: they must vanish."""


def shifted(motion: PointMotion, parts: tuple[str, ...], by: Array) -> PointMotion:
    return replace(motion, **{part: getattr(motion, part) + by for part in parts})


def by_differences(load: Load, motion: PointMotion, of: str, parts: tuple[str, ...]) -> Array:
    """(n, 3, 3) derivatives of forces or moments by parts of the motion."""
    derivative = np.empty((len(load.height), 3, 3))
    for i, unit in enumerate(STEP * np.eye(3)):
        there, back = (
            getattr(load.forces(TIME, shifted(motion, parts, d), RISE), of) for d in (unit, -unit)
        )
        derivative[:, :, i] = (there - back) / (2 * STEP)
    return derivative


def errors(load: Load, motion: PointMotion, tangents: PointTangents) -> dict[str, float]:
    """Largest difference over the largest entry, of each block that is not zero."""
    result = {}
    for block, (of, parts) in BLOCKS.items():
        reference = by_differences(load, motion, of, parts)
        value = getattr(tangents, block)
        if np.any(reference != 0):
            result[block] = relative_difference(value, reference)
        else:
            assert value is None or np.all(value == 0)
    for of, parts in NOT_THERE:
        assert np.all(by_differences(load, motion, of, parts) == 0)
    return result


def depends_on(name: str) -> set[str]:
    """Blocks of a load that must not be zero."""
    if name in ("soil rocking", "soil torsional") or (" in " in name and "sliding" in name):
        return {"moment_stiffness", "moment_damping"}
    if name.startswith("rotor"):
        return {"damping", "turning"}
    if name.startswith("soil"):
        return {"stiffness"} if name.endswith("elastic") else {"stiffness", "damping"}
    return {
        "waves": {"damping", "turning"},
        "still water": {"damping", "turning"},
        "splashing": {"damping", "turning"},
        "wind": {"damping", "turning"},
        "added mass": {"inertia", "turning"},
        "water inside": {"inertia", "turning"},
        "splash added mass": {"inertia", "turning"},
        "buoyancy": {"turning"},
        "pressure inside": {"turning"},
        "tower top": set[str](),
        "damping in proportion to mass": {"damping", "moment_damping"},
        "friction": {"moment_coupling", "moment_stiffness"},
        "written in Python": {"stiffness", "damping", "inertia", "turning"},
    }[name]


@pytest.mark.parametrize("name", LOADS)
def test_tangents_against_differences(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """dF/dx, dF/dv, dF/da and dF/de of the points, every entry."""
    load = LOADS[name](oc6, tmp_path)
    motion = some_motion(load)
    found = errors(load, motion, load.tangents(TIME, motion, RISE))
    assert max(found.values(), default=0.0) < TOLERANCE
    assert found.keys() == depends_on(name)
    assert any(part.inertial for part in load.compiled()) == ("inertia" in found)


@pytest.mark.parametrize("name", LOADS)
def test_a_block_that_is_off_is_seen(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """Negative control: any block of any load, a thousandth too large, fails the check."""
    load = LOADS[name](oc6, tmp_path)
    motion = some_motion(load)
    tangents = load.tangents(TIME, motion, RISE)
    for block in errors(load, motion, tangents):
        broken = replace(tangents, **{block: 1.001 * getattr(tangents, block)})
        assert errors(load, motion, broken)[block] > 1000 * TOLERANCE


def test_compiled_code_sees_what_python_returns(oc6: ow.Turbine, tmp_path: Path) -> None:
    """A load written in Python gives the same when it is called from compiled code."""
    load = written_in_python(oc6, tmp_path)
    motion = some_motion(load)
    direct, called = load.forces(TIME, motion, RISE), KernelLoad.forces(load, TIME, motion, RISE)
    assert np.array_equal(direct.force, called.force)
    assert np.array_equal(direct.moment, called.moment)
    blocks = KernelLoad.tangents(load, TIME, motion, RISE).blocks()
    assert np.array_equal(load.tangents(TIME, motion, RISE).blocks(), blocks)


def test_a_secant_is_not_a_tangent(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Negative control: the secant stiffness of a softening soil fails the check."""
    load = LOADS["soil tanh elastic"](oc6, tmp_path)
    assert isinstance(load, SoilSprings)
    motion = some_motion(load)
    tangents = load.tangents(TIME, motion, RISE)
    y = np.hypot(motion.displacement[:, 0], motion.displacement[:, 1])
    secant = -load.curves.secant(y) * load.tributary_length
    broken = np.zeros_like(tangents.stiffness)
    broken[:, [0, 1], [0, 1]] = secant[:, None]
    found = errors(load, motion, replace(tangents, stiffness=broken))
    assert found["stiffness"] > 1000 * TOLERANCE


def test_a_lost_drag_term_is_seen(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Negative control: |w| P without w w' / |w| fails the check."""
    load = LOADS["waves"](oc6, tmp_path)
    motion = some_motion(load)
    tangents = load.tangents(TIME, motion, RISE)
    found = errors(load, motion, replace(tangents, damping=tangents.damping / 2))
    assert found["damping"] > 1000 * TOLERANCE


@pytest.mark.parametrize("name", ["soil tanh secant", "soil tanh initial", "still water"])
def test_tangents_at_rest_are_finite_limits(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """At zero displacement and velocity, where |u| and |w| have no direction, nothing is nan."""
    load = LOADS[name](oc6, tmp_path)
    n = len(load.height)
    zero, axis = np.zeros((n, 3)), np.tile([0.0, 0.0, 1.0], (n, 1))
    tangents = load.tangents(0.0, PointMotion(zero, zero, zero, axis), 0.0)
    assert np.all(np.isfinite(tangents.blocks()))
    if isinstance(load, SoilSprings):
        initial = load.curves.tangent(np.zeros(n)) * load.tributary_length
        assert np.allclose(tangents.stiffness[:, 0, 0], -initial, rtol=1e-12)


def energy_slope(load: Load, motion: PointMotion, parts: tuple[str, ...]) -> Array:
    """(n, 3) derivatives of the energy by central differences, point by point."""
    slope = np.empty((len(load.height), 3))
    for i in range(len(slope)):
        for j in range(3):
            step = np.zeros_like(slope)
            step[i, j] = STEP
            there, back = (load.energy(shifted(motion, parts, d)) for d in (step, -step))
            slope[i, j] = (there - back) / (2 * STEP)
    return slope


ENERGY_TOLERANCE = 1e-6
"""Truncation as above; rounding is 1e-16 of all points' energy over STEP, of one point's force."""


def conservative_error(load: Load, motion: PointMotion) -> float:
    """Difference of the force at rest, elastic or inertial, from minus the energy's slope.

    Elastic, F = -dE/dx, and so for moments. Of kinetic energy, with a momentum dE/dv that is linear
    in v, the force is the same with the acceleration in place of the velocity.
    """
    nothing = np.zeros_like(motion.velocity)
    still = replace(motion, velocity=nothing, angular_velocity=nothing)
    result = load.forces(TIME, still, RISE)
    if isinstance(load, AddedMass):
        assert motion.acceleration is not None
        moving = replace(motion, velocity=motion.acceleration)
        return relative_difference(result.force, -energy_slope(load, moving, ("velocity",)))
    slopes = [
        energy_slope(load, still, parts)
        for parts in (("position", "displacement"), ("rotation_vector",))
    ]
    return relative_difference(np.hstack([result.force, result.moment]), -np.hstack(slopes))


@pytest.mark.parametrize("name", STORING)
def test_forces_are_slopes_of_the_energy(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """What a load says it stores is what its force works."""
    load = LOADS[name](oc6, tmp_path)
    assert conservative_error(load, some_motion(load)) < ENERGY_TOLERANCE


@pytest.mark.parametrize("name", STORING)
def test_a_wrong_energy_is_seen(
    oc6: ow.Turbine, tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: a thousandth too much energy breaks the equality."""
    load = LOADS[name](oc6, tmp_path)
    kind = type(load)
    honest = kind.energy
    monkeypatch.setattr(kind, "energy", lambda self, motion: 1.001 * honest(self, motion))
    assert conservative_error(load, some_motion(load)) > 100 * ENERGY_TOLERANCE


@pytest.mark.parametrize("name", STORING)
def test_power_goes_into_store_or_heat(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """-F.v = dE/dt + heat, on an axis that does not turn."""
    load = LOADS[name](oc6, tmp_path)
    motion = some_motion(load)
    result = load.forces(TIME, motion, RISE)
    assert motion.angular_velocity is not None
    slope = energy_slope(load, motion, ("position", "displacement"))
    gained = np.sum(slope * motion.velocity)
    gained += np.sum(energy_slope(load, motion, ("rotation_vector",)) * motion.angular_velocity)
    gained += np.sum(energy_slope(load, motion, ("velocity",)) * motion.acceleration)
    power = np.hstack([result.force * motion.velocity, result.moment * motion.angular_velocity])
    worked, scale = -np.sum(power), np.sum(np.abs(power))
    assert abs(worked - gained - result.dissipation) < ENERGY_TOLERANCE * scale
    if name.startswith("soil") and not name.endswith("elastic"):
        assert result.dissipation > 1e-3 * scale
    else:
        assert result.dissipation == 0


def test_other_loads_store_nothing(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Waves, the load at the top and what is written in Python work; they hold no energy."""
    others = set(LOADS) - set(STORING)
    sliding = {name for name in others if "sliding" in name}
    rotors = {name for name in others if name.startswith("rotor")}
    assert others - sliding - rotors == {
        "waves",
        "still water",
        "splashing",
        "wind",
        "splash added mass",
        "buoyancy",
        "pressure inside",
        "tower top",
        "damping in proportion to mass",
        "written in Python",
        "friction",
    }
    for name in others - sliding:
        load = LOADS[name](oc6, tmp_path)
        assert load.energy(some_motion(load)) == 0
