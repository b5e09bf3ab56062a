"""Tangents of every point load against central differences of its forces."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.numerics import relative_difference

import offwind_pin as ow
from offwind_pin.dynamics.sea import water_load
from offwind_pin.loads.points import PointLoad, PointMotion, PointTangents
from offwind_pin.loads.soil import SoilSprings
from offwind_pin.loads.tower_top import TowerTopLoad
from offwind_pin.turbines.definition import Array, CurveTable, DepthLine, LinearModulus

TIME, RISE = 2.3, 0.7
STEP, SIZE = 1e-5, 0.05
"""Difference step and size of the motion, in m or m/s; truncation is about (STEP / SIZE)^2 = 4e-8,
rounding 1e-16 SIZE / STEP = 1e-12."""
TOLERANCE = 10 * (STEP / SIZE) ** 2

TABLE = "depth_m,y_m,p_n_per_m\n0,0.01,1e4\n0,1,2e4\n50,0.02,1e7\n50,1,3e7\n"


def soil(oc6: ow.Turbine, folder: Path, kind: str) -> SoilSprings:
    springs = oc6.soil.distributed_springs
    assert springs is not None
    if kind == "linear":
        curve = LinearModulus(kind="linear", modulus=DepthLine(at_mudline=2e8))
        springs = springs.model_copy(update={"curve": curve})
    elif kind == "table":
        (folder / "py.csv").write_text(TABLE)
        curve = CurveTable(kind="table", file=folder / "py.csv")
        springs = springs.model_copy(update={"curve": curve})
    return SoilSprings.along_pile(springs, oc6.site.mudline, oc6.toe)


def make(oc6: ow.Turbine, folder: Path, name: str) -> PointLoad:
    if name.startswith("soil"):
        load = soil(oc6, folder, name.split()[1])
        return replace(load, dashpot_time=0.0) if name.endswith("elastic") else load
    if name == "waves":
        return water_load(oc6, ow.IrregularWaves(2.0, 6.0, seed=2, repeat_period=60.0))
    if name == "still water":
        return water_load(oc6, ow.StillWater())
    history = ow.LoadHistory(np.array([0.0, 5.0]), np.ones((2, 6)) * [[1e6], [2e6]], "test")
    return TowerTopLoad(oc6.yaw_bearing, history, history.at(0.0))


LOADS = [
    "soil linear elastic",
    "soil linear dashpot",
    "soil tanh elastic",
    "soil tanh dashpot",
    "soil table elastic",
    "soil table dashpot",
    "waves",
    "still water",
    "tower top",
]


def some_motion(load: PointLoad) -> PointMotion:
    """Points off their places, moving, on an inclined axis."""
    n = len(load.height)
    rng = np.random.default_rng(n)
    u = rng.uniform(-SIZE, SIZE, (n, 3))
    u[:, :2] += np.sign(u[:, :2]) * SIZE
    v = rng.uniform(-SIZE, SIZE, (n, 3))
    axis = np.array([0.0, 0.0, 1.0]) + rng.uniform(-0.1, 0.1, (n, 3))
    place = u + np.column_stack([np.zeros((n, 2)), load.height])
    return PointMotion(place, u, v, axis / np.linalg.norm(axis, axis=1, keepdims=True))


def by_differences(load: PointLoad, motion: PointMotion) -> tuple[Array, Array]:
    """(n, 3, 3) derivatives of the forces by position and by velocity."""
    n = len(load.height)
    stiffness, damping = np.empty((2, n, 3, 3))
    for i, unit in enumerate(STEP * np.eye(3)):
        there, back = (
            load.forces(
                TIME,
                replace(
                    motion,
                    position=motion.position + d,
                    displacement=motion.displacement + d,
                ),
                RISE,
            ).force
            for d in (unit, -unit)
        )
        stiffness[:, :, i] = (there - back) / (2 * STEP)
        there, back = (
            load.forces(TIME, replace(motion, velocity=motion.velocity + d), RISE).force
            for d in (unit, -unit)
        )
        damping[:, :, i] = (there - back) / (2 * STEP)
    return stiffness, damping


def worst(load: PointLoad, motion: PointMotion, tangents: PointTangents) -> float:
    """Largest difference over the largest entry, of both tangents."""
    result = 0.0
    pairs = zip((tangents.stiffness, tangents.damping), by_differences(load, motion), strict=True)
    for value, reference in pairs:
        if np.any(reference != 0):
            result = max(result, relative_difference(value, reference))
        else:
            assert np.all(value == 0)
    return result


@pytest.mark.parametrize("name", LOADS)
def test_tangents_against_differences(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """dF/dx and dF/dv of the points, every entry."""
    load = make(oc6, tmp_path, name)
    motion = some_motion(load)
    assert worst(load, motion, load.tangents(TIME, motion, RISE)) < TOLERANCE


def test_a_secant_is_not_a_tangent(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Negative control: the secant stiffness of a softening soil fails the check."""
    load = make(oc6, tmp_path, "soil tanh elastic")
    motion = some_motion(load)
    tangents = load.tangents(TIME, motion, RISE)
    y = np.hypot(motion.displacement[:, 0], motion.displacement[:, 1])
    secant = -load.curves.secant(y) * load.tributary_length
    broken = np.zeros_like(tangents.stiffness)
    broken[:, [0, 1], [0, 1]] = secant[:, None]
    assert worst(load, motion, replace(tangents, stiffness=broken)) > 1000 * TOLERANCE


def test_a_lost_drag_term_is_seen(oc6: ow.Turbine, tmp_path: Path) -> None:
    """Negative control: |w| P without w w' / |w| fails the check."""
    load = make(oc6, tmp_path, "waves")
    motion = some_motion(load)
    tangents = load.tangents(TIME, motion, RISE)
    assert worst(load, motion, replace(tangents, damping=tangents.damping / 2)) > 1000 * TOLERANCE


@pytest.mark.parametrize("name", ["soil tanh dashpot", "still water"])
def test_tangents_at_rest_are_finite_limits(oc6: ow.Turbine, tmp_path: Path, name: str) -> None:
    """At zero displacement and velocity, where |u| and |w| have no direction, nothing is nan."""
    load = make(oc6, tmp_path, name)
    n = len(load.height)
    zero, axis = np.zeros((n, 3)), np.tile([0.0, 0.0, 1.0], (n, 1))
    tangents = load.tangents(0.0, PointMotion(zero, zero, zero, axis), 0.0)
    assert np.all(np.isfinite(tangents.stiffness))
    assert np.all(np.isfinite(tangents.damping))
    if name.startswith("soil"):
        initial = load.curves.tangent(np.zeros(n)) * load.tributary_length
        assert np.allclose(tangents.stiffness[:, 0, 0], -initial, rtol=1e-12)
